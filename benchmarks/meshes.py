"""Is every mesh that people have verified, or refused with a reason, within a limit of processor time?

    python benchmarks/meshes.py [--packages FOLDER ...] [--cpu-limit 60] [--only NAME ...]

Thirty meshes that other packages ship (pybullet_data, gymnasium_robotics, robosuite): scans, thin and hollow things,
several bodies in a file, huge ones, soups of triangles, sheets. Each is built standing on the ground, 20 cm at its
longest, in a process of its own and without cached decompositions. The packages are found where they are installed, or
unpacked in --packages. Exit code 1 where a build crashes, says nothing, or takes more than its limit and a tenth.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import yaml

MESHES = (
    ("closed", "robosuite/models/assets/objects/meshes/bottle.obj"),
    ("closed", "robosuite/models/assets/objects/meshes/can.obj"),
    ("closed", "robosuite/models/assets/objects/meshes/milk.obj"),
    ("several bodies", "robosuite/models/assets/objects/meshes/handles.obj"),
    ("scan", "robosuite/models/assets/objects/meshes/bread.obj"),
    ("scan", "pybullet_data/duck.obj"),
    ("scan", "pybullet_data/bunny.obj"),
    ("patches", "pybullet_data/soccerball.obj"),
    ("several bodies", "pybullet_data/teddy2_VHACD_CHs.obj"),
    ("several bodies", "pybullet_data/lego/lego.obj"),
    ("hollow", "pybullet_data/objects/mug.obj"),
    ("hollow", "pybullet_data/tray/tray_textured.obj"),
    ("hollow", "pybullet_data/toys/concave_box.obj"),
    ("several bodies", "pybullet_data/toys/shape_sorter.obj"),
    ("several bodies", "pybullet_data/table/table.obj"),
    ("closed", "pybullet_data/torus/torus_textured.obj"),
    ("sheet", "pybullet_data/cloth_z_up.obj"),
    ("sheet", "pybullet_data/terrain.obj"),
    ("sheet", "pybullet_data/roboschool/models_outdoor/stadium/part0.obj"),
    ("huge", "pybullet_data/samurai_monastry.obj"),
    ("thin", "pybullet_data/bicycle/files/frame_scaled.stl"),
    ("thin", "pybullet_data/bicycle/files/wheel_scaled.stl"),
    ("several bodies", "pybullet_data/kiva_shelf/meshes/pod_lowres.stl"),
    ("soup", "pybullet_data/a1/meshes/trunk.obj"),
    ("soup", "pybullet_data/franka_panda/meshes/visual/link6.obj"),
    ("soup", "pybullet_data/mini_cheetah/meshes/mini_upper_link.obj"),
    ("closed, 57,640 faces", "pybullet_data/differential/diff_ring.stl"),
    ("several bodies", "gymnasium_robotics/envs/assets/adroit_hand/resources/meshes/forearm_Cy_PlateAsmbly.stl"),
    ("several bodies", "gymnasium_robotics/envs/assets/kitchen_franka/kitchen_assets/meshes/kettle.stl"),
    ("several bodies", "gymnasium_robotics/envs/assets/stls/hand/palm.stl"),
)
"""What each is, and where it lies."""

WHERE = re.compile(r'^\w+Error: (scene\.yaml:\d+:\d+: )?(objects\[0\](\.\w+)?: )?("thing": )?')
"""Of an error's message, what says where in the specification it is."""

SIZE = 0.2
"""Longest side [m], since the files have all kinds of units."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """What came of one mesh."""

    name: str
    what: str
    parts: int
    verdict: str
    """"verified", "not verified", "refused" or "CRASH"."""
    seconds: float
    """Of the processor, the interpreter's start included."""
    reason: str

    def __str__(self) -> str:
        parts = str(self.parts) if self.parts else ""
        return f"| {self.name} | {self.what} | {parts} | {self.verdict} | {self.seconds:.0f} | {self.reason} |"


def found(path: str, packages: list[Path]) -> Path | None:
    """Where the file of a package lies."""
    package, rest = path.split("/", 1)
    for folder in packages:
        if (folder / path).is_file():
            return folder / path
    spec = importlib.util.find_spec(package)
    file = Path(spec.origin).parent / rest if spec and spec.origin else None
    return file if file is not None and file.is_file() else None


def build(what: str, mesh: Path, limit: float, folder: Path) -> Row:
    """Build one mesh, standing on the ground."""
    spec = {"objects": [{"name": "thing", "mesh": str(mesh), "size": SIZE}]}
    (folder / "scene.yaml").write_text(yaml.safe_dump(spec), encoding="utf-8")
    command = [sys.executable, "-m", "pat3d", "build", "scene.yaml", "--out", "out", "--cpu-limit", str(limit)]
    environment = {**os.environ, "PAT3D_CACHE": str(folder / "cache")}
    before = os.times()
    done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    after = os.times()
    seconds = after.children_user + after.children_system - before.children_user - before.children_system
    lines = [line.removeprefix("pat3d: ") for line in done.stderr.splitlines() if line.startswith("pat3d: ")]
    report = folder / "out" / "report.json"
    parts = json.loads(report.read_text(encoding="utf-8"))["objects"][0]["parts"] if report.is_file() else 0
    verdict = {0: "verified", 1: "not verified", 2: "refused"}.get(done.returncode, "CRASH")
    if done.returncode and not lines:
        verdict, lines = "CRASH", done.stderr.strip().splitlines()[-1:]
    reason = "" if done.returncode == 0 else WHERE.sub("", lines[0]).replace(str(mesh), mesh.name)
    return Row(name=mesh.name, what=what, parts=parts, verdict=verdict, seconds=seconds, reason=reason)


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--packages", nargs="+", type=Path, default=[], help="folders with unpacked packages")
    parser.add_argument("--cpu-limit", type=float, default=60.0, metavar="SECONDS", help="for one mesh")
    parser.add_argument("--only", nargs="+", help="file names")
    options = parser.parse_args()
    print("| mesh | kind | convex parts | result | CPU seconds | reason |")
    print("| --- | --- | ---: | --- | ---: | --- |")
    rows, absent = [], []
    for what, path in MESHES:
        if options.only and Path(path).name not in options.only:
            continue
        mesh = found(path, [folder.resolve() for folder in options.packages])
        if mesh is None:
            absent.append(path)
            continue
        with tempfile.TemporaryDirectory(prefix="pat3d-mesh-") as folder:
            rows.append(build(what, mesh, options.cpu_limit, Path(folder)))
        print(rows[-1], flush=True)
    for path in absent:
        print(f"not here: {path}", file=sys.stderr)
    bad = [row for row in rows if row.verdict == "CRASH" or row.seconds > 1.1 * options.cpu_limit + 5.0]
    count = {verdict: sum(row.verdict == verdict for row in rows) for verdict in dict.fromkeys(r.verdict for r in rows)}
    print(f"\n{len(rows)} meshes: " + ", ".join(f"{number} {verdict}" for verdict, number in count.items()))
    for row in bad:
        print(f"crashed or over the limit: {row.name}, {row.seconds:.0f} s")
    return 1 if bad or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
