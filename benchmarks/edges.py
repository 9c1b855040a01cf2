"""Does support end at the true edge of a mesh? Boards laid with their weight just inside and just outside of it.

python -m benchmarks.edges FOLDER_OR_MESH [...] [--size 0.1] [--jobs 16] --work work/edges

Every mesh is imported, stood on its base and fixed. The highest level of its surface is its top; towards four sides a
plank of 10 cm and a board that covers the whole top are laid on it with their weight 1, 3 and 5 mm inside and outside
of where the top ends. What stands is said by MuJoCo on the mesh's own triangles (benchmarks/edge_judge.py): a plank
whose weight is inside the rim of a bowl falls into it, and what is round has no edge and is left out. What stands
should be verified and what falls refused, at least 95 % each way. Exit code 1 where that is not so. What is in --work
is not done again. No network is needed.
"""

from __future__ import annotations

import argparse
import hashlib
import math
import os
import sys
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.edge_judge import Shadow, outcome
from pat3d.assets.mesh.importing import import_mesh
from pat3d.assets.shapes import box
from pat3d.check.certificate import certify
from pat3d.errors import Pat3dError
from pat3d.scene.asset import Asset
from pat3d.scene.folder import read_json, write_json
from tests.scenes import asset_of, placed, scene_of

OFFSETS = (0.001, 0.003, 0.005)
"""[m]"""

TOP = 1e-4
"""Surfaces this close to the highest point [m] are the top."""

PLANK = (0.1, 0.02)
"""Length and breadth [m]."""

THICK = 0.006
"""[m]"""

BESIDE = 0.01
"""A board reaches this far beyond the top [m]."""

GOAL = 0.95
SUFFIXES = frozenset({".obj", ".stl", ".ply", ".off", ".glb"})


def shadows(asset: Asset) -> Iterator[tuple[dict[str, Any], Shadow]]:
    """Where boards are laid, with the words for it."""
    vertices = asset.visual.vertices
    top = vertices[vertices[:, 2] > vertices[:, 2].max() - TOP, :2]
    for side in range(4):
        yaw = math.pi / 2 * side
        along, across = np.array([math.cos(yaw), math.sin(yaw)]), np.array([-math.sin(yaw), math.cos(yaw)])
        edge, width = float((top @ along).max()), float(np.ptp(top @ along))
        end = top[top @ along > edge - TOP] @ across
        low, high = float((top @ across).min()), float((top @ across).max())
        for offset in (*OFFSETS, *(-offset for offset in OFFSETS)):
            # Over a narrow ridge the inside of one edge is the outside of the other.
            if -offset > width / 2:
                continue
            for kind, at, size in (
                ("plank", (float(end.min()) + float(end.max())) / 2, PLANK),
                ("board", (low + high) / 2, (2 * (width + BESIDE), high - low + 2 * BESIDE)),
            ):
                centre = (edge + offset) * along + at * across
                words = {"kind": kind, "side": side, "offset_mm": 1e3 * offset}
                yield words, Shadow(centre=(float(centre[0]), float(centre[1])), yaw=yaw, size=size)


def verified(asset: Asset, board: Asset, shadow: Shadow) -> bool:
    """Whether `board` on the convex parts of `asset` has a certificate."""
    count = np.cumsum([0, *(len(part.vertices) for part in asset.parts)])
    faces = np.concatenate([part.faces + start for part, start in zip(asset.parts, count[:-1], strict=True)])
    polygons = shadow.over(np.concatenate([part.vertices for part in asset.parts]), faces)
    if not polygons:
        return False
    pose = shadow.laid(polygons)
    scene = scene_of(placed("mesh", asset, fixed=True), placed("board", board, pose=pose))
    return certify(scene, margin=True).passed


def measure(path: Path, size: float, work: Path, cpu_limit: float, again: bool) -> dict[str, Any]:
    """What came of one mesh, from `work` where it is there; `again` keeps what the judge said, and nothing else."""
    key = hashlib.sha256(path.read_bytes() + f"{size:g}".encode()).hexdigest()[:12]
    file = work / "results" / f"{path.stem}-{key}.json"
    known = read_json(file)
    if known and not (again and known["cases"]):
        return known
    told = [case["outcome"] for case in known.get("cases", ())]
    start = time.process_time()
    document: dict[str, Any] = {"mesh": path.name, "cases": []}
    try:
        asset = import_mesh(path, size=size, cache_dir=work / "cache", cpu_limit=cpu_limit)
        places = list(shadows(asset))
        for number, (words, shadow) in enumerate(places):
            board = asset_of(box(*shadow.size, THICK))
            seen = told[number] if len(told) == len(places) else outcome(asset, board, shadow)
            document["cases"].append({**words, "outcome": seen, "verified": verified(asset, board, shadow)})
    except Pat3dError as error:
        document["refused"] = str(error)
    document["seconds"] = round(time.process_time() - start, 1)
    file.parent.mkdir(parents=True, exist_ok=True)
    write_json(file, document)
    return document


def shares(cases: list[dict[str, Any]]) -> tuple[tuple[int, int], tuple[int, int]]:
    """(verified, of how many) of what stands, (refused, of how many) of what falls."""
    held = [case["verified"] for case in cases if case["outcome"] == "stands"]
    fell = [not case["verified"] for case in cases if case["outcome"] == "falls"]
    return (sum(held), len(held)), (sum(fell), len(fell))


def row(name: str, cases: list[dict[str, Any]], more: str = "") -> str:
    """A line of the table, with every case in which the two disagree."""
    (good, held), (refused, fell) = shares(cases)
    wrong = [
        f"    {case['kind']} {case['offset_mm']:+g} mm, side {case['side']}: "
        f"{case['outcome']}, {'verified' if case['verified'] else 'refused'}"
        for case in cases
        if case["outcome"] != "slopes" and case["verified"] is not (case["outcome"] == "stands")
    ]
    return "\n".join([f"{name:32} stand {good}/{held} verified  fall {refused}/{fell} refused  {more}", *wrong])


def meshes(given: list[Path]) -> list[Path]:
    """The files of `given`, of folders all meshes in them."""
    found = []
    for path in given:
        inside = sorted(path.rglob("*")) if path.is_dir() else [path]
        found += [one for one in inside if one.suffix.lower() in SUFFIXES]
    return found


def main() -> int:
    """Print a table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", nargs="+", type=Path, help="mesh files, or folders of them")
    parser.add_argument("--size", type=float, default=0.1, help="longest side of each mesh [m]")
    parser.add_argument("--jobs", type=int, default=1, help="meshes at a time")
    parser.add_argument("--cpu-limit", type=float, default=120.0, help="to import one mesh [s]")
    parser.add_argument("--again", action="store_true", help="certify anew, with the judge's verdicts from --work")
    parser.add_argument("--work", type=Path, default=Path("work/edges"), help="decompositions and results")
    given = parser.parse_args()
    work = given.work.resolve()
    every, cases = meshes(given.meshes), []
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    with ProcessPoolExecutor(given.jobs, mp_context=get_context("spawn")) as pool:
        waiting = [(path, pool.submit(measure, path, given.size, work, given.cpu_limit, given.again)) for path in every]
        for path, done in waiting:
            document = done.result()
            if "refused" in document:
                print(f"{path.name:32} {document['refused']}", flush=True)
                continue
            cases += document["cases"]
            print(row(path.name, document["cases"], f"{document['seconds']:.0f} s"), flush=True)
    by_place = {
        place: [case for case in cases if (case["offset_mm"] < 0.0) is (place == "inside")]
        for place in ("inside", "outside")
    }
    for place, some in by_place.items():
        count = Counter(case["outcome"] for case in some)
        print(f"{place}: {', '.join(f'{count[outcome]} {outcome}' for outcome in count)} of {len(some)}")
    print(row("all", cases).splitlines()[0])
    return 0 if cases and all(count >= GOAL * of for count, of in shares(cases)) else 1


if __name__ == "__main__":
    sys.exit(main())
