"""Are real objects of other people indexed, or refused with a reason; and do scenes of them verify?

    python benchmarks/library.py --packages FOLDER ... [--scenes 50] [--jobs 1] [--workers 1] [--out FOLDER]

Objects that other packages ship (robosuite, pybullet_data, pybullet_object_models) are looked for where they are
installed and, unpacked, in the folders of --packages; they are copied into one folder, which is indexed as a user
would. Then: seconds for an object, cold and warm; how often unit and up axis of a bare mesh are right, where every mesh
of the set whose truth is known is written anew in other units and with other axes up; random scenes of five objects of
the library on a table, as `pat3d build` makes them, `--jobs` of them side by side. With the same --out a run that was
interrupted goes on where it was. Exit code 1 where a scene that was verified intersects or moves, or an object is lost
without a reason.
"""

from __future__ import annotations

import argparse
import importlib.util
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
import yaml

NAME = "bench"
STILL_MM, STILL_DEGREES = 1.0, 1.0
"""What a verified scene may move by in MuJoCo."""
WANTED = {
    "pybullet_object_models": ("ycb_objects",),
    "robosuite": ("models/assets/objects", "models/assets/textures"),
    "pybullet_data": (
        "objects", "tray", "lego", "jenga", "domino", "table", "table_square", "torus", "toys", "kiva_shelf",
        "duck.obj", "duck.mtl", "duckCM.png", "duck_vhacd.obj", "duck_vhacd.urdf", "teddy_vhacd.urdf",
        "teddy2_VHACD_CHs.obj", "soccerball.urdf", "soccerball.obj", "soccerball.mtl", "soccerball.png", "bunny.obj",
        "block.urdf", "cube_small.urdf", "checker_blue.png", "cube.obj", "cube.mtl", "cube.png",
        *(f"random_urdfs/{number:03d}" for number in range(12)),
    ),
}  # fmt: skip
"""Folders and files of each package."""

METRES_Z_UP = ("YcbBanana", "YcbCrackerBox", "YcbFoamBrick", "YcbGelatinBox", "YcbMasterChefCan", "YcbMustardBottle",
               "YcbPottedMeatCan", "YcbPowerDrill", "YcbScissors", "YcbTomatoSoupCan")  # fmt: skip
"""Scans whose files are in metres with z up, as their descriptions say."""


def main() -> int:
    """Run it all; returns the exit code."""
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--packages", nargs="*", default=[], type=Path)
    options.add_argument("--scenes", type=int, default=50)
    options.add_argument("--workers", type=int, default=None)
    options.add_argument("--jobs", type=int, default=1, help="scenes that are built side by side")
    options.add_argument(
        "--out", type=Path, default=None, help="keep index, objects and scenes here; a run goes on there"
    )
    chosen = options.parse_args()
    root = (chosen.out or Path(tempfile.mkdtemp(prefix="pat3d-library-"))).resolve()
    root.mkdir(parents=True, exist_ok=True)
    os.environ["PAT3D_DATA"] = str(root / "data")
    objects = collected(root / "objects", chosen.packages)
    lost = indexed(objects, chosen.workers)
    guessed(objects, root / "guesses")
    bad = scenes(root / "scenes", chosen.scenes, max(1, chosen.jobs))
    return 1 if lost or bad else 0


def collected(target: Path, packages: list[Path]) -> Path:
    """Copy what is wanted of every package that is found into `target`."""
    for package, entries in WANTED.items():
        places = [place for folder in packages for place in folder.rglob(package) if place.is_dir()]
        spec = importlib.util.find_spec(package)
        places += [Path(place) for place in (spec.submodule_search_locations or [])] if spec else []
        home = next((place for place in places if any((place / entry).exists() for entry in entries)), None)
        if home is None:
            print(f"{package}: not found")
            continue
        for entry in entries:
            source, copy = home / entry, target / package / entry
            if copy.exists() or not source.exists():
                continue
            copy.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, copy)
            else:
                shutil.copy(source, copy)
    return target


def indexed(objects: Path, workers: int | None) -> int:
    """Index the folder twice, and say what came of it; returns how many objects are neither ready nor explained."""
    from pat3d.assets.library.index import add_library

    begun = time.perf_counter()
    library = add_library(objects, NAME, workers=workers, progress=_progress)
    cold = time.perf_counter() - begun
    begun = time.perf_counter()
    library = add_library(objects, NAME, workers=workers)
    warm = time.perf_counter() - begun
    refused = [entry for entry in library.entries if entry.state == "refused"]
    print(f"{len(library.entries)} objects: {len(library.ready)} ready, {len(refused)} refused")
    for kind, count in sorted(Counter(entry.kind for entry in library.entries).items()):
        good = sum(entry.kind == kind for entry in library.ready)
        print(f"  {kind}: {good} of {count}")
    for entry in refused:
        print(f"  refused {entry.path}: {entry.reason}")
    spent = sorted((entry.processor for entry in library.ready), reverse=True)
    clock = sorted((entry.seconds for entry in library.ready), reverse=True)
    print(f"cold: {cold:.0f} s in all; processor median {statistics.median(spent):.1f} s, most {spent[:3]} s")
    print(f"      clock median {statistics.median(clock):.1f} s, most {clock[:3]} s (with whatever else runs here)")
    print(f"warm: {1e3 * warm / len(library.entries):.1f} ms an object for looking at all again")
    times, spent = [], []
    for entry in library.ready:
        begun, used = time.perf_counter(), time.process_time()
        library.asset(entry.key)
        times.append(time.perf_counter() - begun)
        spent.append(time.process_time() - used)
    print(f"      {1e3 * statistics.median(times):.1f} ms for an asset, at most {1e3 * max(times):.0f} ms")
    print(f"      {1e3 * statistics.median(spent):.1f} ms of the processor, at most {1e3 * max(spent):.0f} ms")
    losses = [entry.facts["cavity_loss"] for entry in library.ready if entry.facts.get("cavity_loss") is not None]
    reach = [entry.facts["sticks_out"] or 0.0 for entry in library.ready]
    if losses:
        print(f"cavities: {len(losses)}, radius lost {100 * max(losses):.2f} % at most")
    print(f"pictures stick out of convex parts by {1e3 * max(reach):.4f} mm at most")
    doubts = Counter(doubt.split(":")[0] for entry in library.ready for doubt in entry.doubts)
    print(f"doubts: {dict(doubts)}")
    return sum(entry.state == "refused" and not entry.reason for entry in library.entries)


def guessed(objects: Path, scratch: Path) -> None:
    """Write the meshes whose truth is known in other units and axes, and count how often the index is right."""
    import trimesh

    from pat3d.assets.library.guess import SURE, guess_unit
    from pat3d.assets.library.indexing import typical_of
    from pat3d.assets.library.names import known_names, synonyms_of, words_of
    from pat3d.assets.library.readers.meshes import read_mesh
    from pat3d.assets.library.upright import guess_up
    from pat3d.assets.mesh.importing import METRES, TO_Z_UP

    scratch.mkdir(parents=True, exist_ok=True)
    counts: Counter[str] = Counter()
    wrong = []
    for folder in METRES_Z_UP:
        found = sorted((objects / "pybullet_object_models" / "ycb_objects" / folder).glob("textured*.obj"))
        if not found:
            continue
        scan = trimesh.load(found[0], process=False, force="mesh")
        _, _, like = synonyms_of([word for word in words_of(folder) if word != "ycb"], (), known_names())
        for unit in ("m", "cm", "mm"):
            for up in ("z", "y"):
                path = scratch / f"{folder}.stl"
                vertices = np.asarray(scan.vertices) / METRES[unit] @ np.array(TO_Z_UP[up], dtype=float)
                trimesh.Trimesh(vertices, scan.faces, process=False).export(path)
                body, typical = read_mesh(path, scratch), typical_of(like)
                for truth, guess in ((unit, guess_unit(body, typical)), (up, guess_up(body, typical))):
                    kind = "unit" if truth is unit else "up"
                    right, sure = guess.value == truth, guess.confidence >= SURE
                    counts[f"{kind} {'right' if right else 'wrong'}, {'sure' if sure else 'flagged'}"] += 1
                    if not right and sure:
                        wrong.append(f"{folder} in {unit}, {up} up: {kind} {guess.value} ({guess.reason})")
    print(f"guesses of unit and up axis of bare meshes: {dict(sorted(counts.items()))}")
    for line in wrong:
        print(f"  wrong and sure: {line}")


@dataclass(frozen=True, kw_only=True)
class Built:
    """What came of one scene."""

    number: int
    state: Literal["verified", "faulty", "refused"]
    told: str
    drift: float = 0.0
    """Largest in MuJoCo [mm]."""
    turn: float = 0.0
    """Largest in MuJoCo [degrees]."""
    intersections: int = 0


def scenes(folder: Path, count: int, jobs: int) -> int:
    """Build random scenes of five objects; returns how many verified ones intersect or move."""
    from pat3d.assets.library.index import open_library

    library = open_library(NAME)
    small = [entry.key for entry in library.ready if 0.03 < max(entry.facts["size"]) < 0.3]
    folder.mkdir(parents=True, exist_ok=True)
    done = []
    with ThreadPoolExecutor(jobs) as pool:
        for future in as_completed([pool.submit(built, folder, number, small, jobs) for number in range(count)]):
            done.append(future.result())
            print(f"  scene {done[-1].number}: {done[-1].state}, {done[-1].told}", flush=True)
    verified = [one for one in done if one.state == "verified"]
    wrong = [one for one in verified if one.intersections or one.drift >= STILL_MM or one.turn >= STILL_DEGREES]
    states = dict(Counter(one.state for one in done))
    print(f"scenes of five objects: {states}; {100 * len(verified) / max(len(done), 1):.0f} % verified (target 90)")
    print(f"intersections in all: {sum(one.intersections for one in done)} pairs (target 0)")
    if verified:
        print(
            f"verified scenes in MuJoCo, 5 s: {max(one.drift for one in verified):.3f} mm and "
            f"{max(one.turn for one in verified):.3f} degrees at most (target {STILL_MM:g} and {STILL_DEGREES:g})"
        )
    return len(wrong)


def built(folder: Path, number: int, keys: Sequence[str], jobs: int) -> Built:
    """Scene `number` of five of the objects `keys`; one that was finished is read, not built again."""
    picked = np.random.default_rng([20, number]).choice(len(keys), size=5, replace=False)
    names = [f"{keys[index].replace('_', ' ')} {at}" for at, index in enumerate(picked)]
    objects = [{"name": name, "noun": f"{NAME}/{keys[index]}"} for name, index in zip(names, picked, strict=True)]
    spec = {
        "seed": number,
        "objects": [{"name": "table", "noun": "table", "fixed": True}, *objects],
        "relations": [{"child": name, "kind": "on", "parent": "table"} for name in names],
    }
    path, out = folder / f"{number:03d}.yaml", folder / f"{number:03d}"
    path.write_text(yaml.safe_dump(spec, sort_keys=False))
    if not (out / "report.json").is_file():
        command = [sys.executable, "-m", "pat3d", "build", str(path), "--out", str(out), "--cpu-limit", "600"]
        # Several processes with a thread a core each would wait for one another.
        alone = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"} if jobs > 1 else {}
        made = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **alone})
        if not (out / "report.json").is_file():
            told = (made.stderr.strip().splitlines() or ["it said nothing"])[-1][:300]
            return Built(number=number, state="refused", told=told)
    report = json.loads((out / "report.json").read_text())
    found = report["verification"]["penetration"]
    pairs = len(found["hulls"]) + len(found["visuals"])
    if not report["passed"]:
        told = "; ".join(map(str, report["failures"]))[:300]
        return Built(number=number, state="faulty", told=told, intersections=pairs)
    drift = max(obj.get("drift_mm") or 0.0 for obj in report["objects"])
    turn = max(obj.get("drift_degrees") or 0.0 for obj in report["objects"])
    told = f"{drift:.3f} mm and {turn:.3f} degrees in 5 s"
    return Built(number=number, state="verified", told=told, drift=drift, turn=turn, intersections=pairs)


def _progress(event) -> None:
    if event.step is not None:
        print(f"  {event.step + 1}/{event.steps} {event.detail}", file=sys.stderr, flush=True)


if __name__ == "__main__":
    raise SystemExit(main())
