"""Does `pat3d build` verify scenes of meshes that other packages ship?

A pantry shelf and a crowded tray, with robosuite's bottle, can, cereal, milk, bread and lemon and pybullet_data's mug,
duck and tray (in their own units, some not watertight), read from those packages where they are installed or from
unpacked copies:

python benchmarks/real_meshes.py [--robosuite FOLDER] [--pybullet-data FOLDER] [--cold]

With --write FOLDER the specifications and their meshes are put there instead, for transfer.py --specs FOLDER/*.yaml.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import yaml

ROBOSUITE = "models/assets/objects/meshes"
GROCERIES = {
    "cereal": {"size": 0.2, "mass": 0.4, "material": "cardboard"},
    "milk": {"size": 0.18, "mass": 1.0, "material": "cardboard"},
    "can": {"size": 0.12, "mass": 0.35, "material": "steel"},
    "bottle": {"size": 0.2, "mass": 0.5, "material": "glass"},
    "bread": {"size": 0.14, "mass": 0.3, "material": "bread"},
    "lemon": {"size": 0.08, "mass": 0.1, "material": "fruit"},
}


def grocery(name: str) -> dict:
    """Specification of one of robosuite's objects."""
    return {"name": name, "mesh": f"robosuite/{name}.obj", **GROCERIES[name]}


def pantry() -> dict:
    """All six groceries on a catalogue shelf."""
    objects = [{"name": "shelf", "noun": "shelf", "fixed": True}, *map(grocery, GROCERIES)]
    return {"objects": objects, "relations": [{"child": n, "kind": "on", "parent": "shelf"} for n in GROCERIES]}


def tray() -> dict:
    """A mug, a duck and three groceries crowded in a tray."""
    objects = [
        {"name": "tray", "mesh": "pybullet/tray/tray_textured.obj", "scale": 0.3, "mass": 0.8, "material": "plastic"},
        {"name": "mug", "mesh": "pybullet/objects/mug.obj", "mass": 0.3, "material": "ceramic"},
        {"name": "duck", "mesh": "pybullet/duck.obj", "up": "y", "size": 0.12, "mass": 0.08, "material": "rubber"},
        *map(grocery, ("can", "lemon", "bread")),
    ]
    return {
        "objects": objects,
        "relations": [{"child": o["name"], "kind": "in", "parent": "tray"} for o in objects[1:]],
    }


def package_folder(package: str, given: Path | None) -> Path | None:
    """Where an installed or unpacked package's files lie."""
    if given is not None:
        return given
    spec = importlib.util.find_spec(package)
    return Path(spec.origin).parent if spec and spec.origin else None


def unpack(folder: Path, robosuite: Path, pybullet: Path | None) -> None:
    """Copy the meshes to where the specifications look for them."""
    shutil.copytree(robosuite / ROBOSUITE, folder / "robosuite")
    if pybullet is not None:
        shutil.copytree(pybullet, folder / "pybullet")


def build(name: str, spec: dict, workspace: Path, cache: Path) -> bool:
    """Build one scene, print its row, and tell whether it was verified."""
    (workspace / f"{name}.yaml").write_text(yaml.safe_dump(spec), encoding="utf-8")
    start = time.perf_counter()
    done = subprocess.run(
        [sys.executable, "-m", "pat3d", "build", f"{name}.yaml", "--out", f"out_{name}"],
        cwd=workspace,
        env={**os.environ, "PAT3D_CACHE": str(cache)},
        capture_output=True,
        text=True,
        check=False,
    )
    seconds = time.perf_counter() - start
    path = workspace / f"out_{name}" / "report.json"
    if not path.is_file():
        print(f"| {name} | no scene: {done.stderr.strip().splitlines()[-1]} |")
        return False
    report = json.loads(path.read_text(encoding="utf-8"))
    worst = max((obj.get("drift_mm") or 0.0) for obj in report["objects"])
    turned = max((obj.get("drift_degrees") or 0.0) for obj in report["objects"])
    parts = sum(obj["parts"] for obj in report["objects"])
    print(
        f"| {name} | {len(report['objects'])} | {parts} | {worst:.3f} | {turned:.3f} "
        f"| {'yes' if report['passed'] else 'NO: ' + '; '.join(report['failures'])} | {seconds:.1f} |"
    )
    return bool(report["passed"])


def main() -> int:
    """Print the table; exit code 1 unless every scene is verified."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--robosuite", type=Path, help="folder of an unpacked robosuite package")
    parser.add_argument("--pybullet-data", type=Path, help="folder of an unpacked pybullet_data package")
    parser.add_argument("--cold", action="store_true", help="decompose anew instead of reading the cache")
    parser.add_argument("--write", type=Path, metavar="FOLDER", help="write the specifications there, build nothing")
    options = parser.parse_args()
    robosuite = package_folder("robosuite", options.robosuite)
    pybullet = package_folder("pybullet_data", options.pybullet_data)
    if robosuite is None:
        print("robosuite is not installed; give an unpacked copy with --robosuite.", file=sys.stderr)
        return 2
    scenes = {"pantry shelf": pantry()}
    if pybullet is None:
        print("pybullet_data is not installed; the tray is left out (or give --pybullet-data).", file=sys.stderr)
    else:
        scenes["crowded tray"] = tray()
    if options.write is not None:
        unpack(options.write, robosuite, pybullet)
        for name, spec in scenes.items():
            path = options.write / f"{name.replace(' ', '_')}.yaml"
            path.write_text(yaml.safe_dump(spec), encoding="utf-8")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        workspace = Path(folder)
        unpack(workspace, robosuite, pybullet)
        cache = (
            workspace / "cache" if options.cold else Path(os.environ.get("PAT3D_CACHE", "~/.cache/pat3d")).expanduser()
        )
        print("| scene | objects | convex parts | drift mm | drift deg | verified | seconds |")
        print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
        verified = [build(name, spec, workspace, cache) for name, spec in scenes.items()]
        return 0 if all(verified) else 1


if __name__ == "__main__":
    sys.exit(main())
