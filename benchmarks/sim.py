"""How fast is the simulator? Every row is a ratio measured in one run, against libuipc on a GPU or MuJoCo on a CPU.

python benchmarks/sim.py --device cuda --libuipc /path/to/python     # rows of the GPU; the python has pyuipc 0.0.29
python benchmarks/sim.py --device cpu                                # rows of the CPU
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import warp as wp
from sim_scenes import DENSITY, Pile, blobs, pile, tower

from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.settle import Run, SettleOptions, settle

TIME_STEP, FRICTION = 0.03, 0.2
FRAMES = 60
"""Frames a scene is timed over."""

WARM_UP = 2
"""Frames before the clock starts: modules load and graphs are recorded in them."""

STILL = 1e-4
"""Motion of a frame under which the peer's bodies count as resting, three times in a row [m]."""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One line of the table."""

    what: str
    ours: str
    peer: str
    ratio: float
    """Peer over ours: above 1 is faster than the peer."""
    note: str = ""

    def __str__(self) -> str:
        return f"| {self.what} | {self.ours} | {self.peer} | {self.ratio:.2g} | {self.note} |"


HEADER = "| what | ours | peer | peer / ours | where the time goes |\n|---|---|---|---|---|"


def model_of(scene: Pile, device: str, worlds: int = 1) -> Model:
    """`scene` in each of `worlds` worlds."""
    builder = ModelBuilder()
    for world in range(worlds):
        if world:
            builder.new_world()
        scene.add_to(builder)
    return builder.finalize(device)


def options_of(scene: Pile) -> SettleOptions:
    """Settings shared with the peer."""
    return SettleOptions(friction=FRICTION, time_step=TIME_STEP, d_hat=0.01 * scene.size)


def frame_times(scene: Pile, device: str, frames: int = FRAMES) -> tuple[list[float], int]:
    """Seconds of every frame after the warm-up, and Newton iterations of all of them."""
    options = options_of(scene)
    stamps: list[float] = []

    def stamp(*_: object) -> None:
        wp.synchronize()
        stamps.append(time.perf_counter())

    run = Run(model_of(scene, device), options, stamp)
    run.refuse_intersections()
    run.set_reach(options.d_hat)
    run.drop(WARM_UP)
    before = run.iterations
    run.drop(WARM_UP + frames)
    return list(np.diff(stamps[WARM_UP - 1 :])), run.iterations - before


def libuipc(scene: Pile, python: str, frames: int) -> dict:
    """What the peer took for the frames of `scene`: seconds and motion [m] of each."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.npz"
        np.savez(
            path, vertices=scene.part.vertices, faces=scene.part.faces, transforms=scene.transforms(),
            density=DENSITY, dt=TIME_STEP, friction=FRICTION, d_hat=0.01 * scene.size,
        )  # fmt: skip
        script = Path(__file__).parent / "peers" / "libuipc.py"
        done = subprocess.run(
            [python, str(script), str(path), str(frames), folder], capture_output=True, text=True, timeout=300
        )
    if done.returncode:
        raise SystemExit(f"libuipc failed on {scene.name}: {done.stderr[-2000:]}{done.stdout[-1000:]}")
    return json.loads(done.stdout.strip().splitlines()[-1])


def one_world(device: str, python: str) -> list[Row]:
    """Milliseconds a frame of one world against the peer."""
    rows = []
    for scene in (tower(10), tower(30), pile(100), blobs(10)):
        times, iterations = frame_times(scene, device)
        peer = libuipc(scene, python, WARM_UP + FRAMES)["seconds"][WARM_UP:]
        ours, theirs = 1e3 * statistics.mean(times), 1e3 * statistics.mean(peer)
        rows.append(
            Row(
                what=f"{scene.name}, ms a frame",
                ours=f"{ours:.2f} (median {1e3 * statistics.median(times):.2f})",
                peer=f"{theirs:.2f} (median {1e3 * statistics.median(peer):.2f})",
                ratio=theirs / ours,
                note=f"{iterations / FRAMES:.1f} Newton iterations of {ours * FRAMES / iterations:.2f} ms",
            )
        )
        print(rows[-1], flush=True)
    return rows


def many_worlds(device: str, python: str, worlds: int = 1024) -> list[Row]:
    """Scenes a second, forward to rest, against the peer one after the other."""
    scene = tower(10)
    settle(model_of(scene, device))
    model = model_of(scene, device, worlds)
    seconds = timed(lambda: settle(model, options_of(scene)))
    peer = libuipc(scene, python, 200)
    still = np.array(peer["motion"]) < STILL
    rest = next((k for k in range(3, len(still)) if still[k - 3 : k].all()), len(still))
    theirs = sum(peer["seconds"][:rest])
    row = Row(
        what=f"{worlds} worlds of 10 cubes to rest, scenes/s", ours=f"{worlds / seconds:.0f}",
        peer=f"{1 / theirs:.1f}", ratio=worlds / seconds * theirs,
        note=f"settled to 1e-6 of the weight at a 15 um barrier; the peer's {rest} frames end at {STILL:g} m a frame",
    )  # fmt: skip
    print(row, flush=True)
    return [row]


def scaling(device: str) -> list[tuple[int, float, float]]:
    """Bodies, ms a frame and iterations a frame of ever larger piles."""
    found = []
    for count in (10, 30, 100, 300, 1000):
        times, iterations = frame_times(pile(count), device, 30)
        found.append((count, 1e3 * statistics.mean(times), iterations / 30))
        print(f"pile of {count}: {found[-1][1]:.2f} ms a frame, {found[-1][2]:.1f} iterations", flush=True)
    slope = np.polyfit(np.log([f[0] for f in found]), np.log([f[1] for f in found]), 1)[0]
    last = np.log(found[-1][1] / found[-2][1]) / np.log(found[-1][0] / found[-2][0])
    print(f"exponent {slope:.2f} over all sizes, {last:.2f} between the last two")
    return found


def timed(call: Callable[[], object]) -> float:
    """Seconds of one call."""
    wp.synchronize()
    start = time.perf_counter()
    call()
    wp.synchronize()
    return time.perf_counter() - start


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--device", choices=("cpu", "cuda"), default="cpu")
    parser.add_argument("--libuipc", metavar="PYTHON", default=sys.executable, help="interpreter that has pyuipc")
    parser.add_argument("--only", nargs="+", choices=("one", "many", "scaling"), default=("one", "many", "scaling"))
    options = parser.parse_args()
    print(HEADER)
    if "one" in options.only:
        one_world(options.device, options.libuipc)
    if "many" in options.only:
        many_worlds(options.device, options.libuipc)
    if "scaling" in options.only:
        scaling(options.device)


if __name__ == "__main__":
    main()
