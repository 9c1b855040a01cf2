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
from scaling_plot import save_scaling
from sim_scenes import DENSITY, Pile, blobs, pile, tower

from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.settling import settle

TIME_STEP, FRICTION = 0.03, 0.2
FRAMES = 60
"""Frames a scene is timed over."""

WARM_UP = 2
"""Frames before the clock starts: modules load and graphs are recorded in them."""

PARTS = ("one", "many", "scaling", "gradients", "mujoco")

LARGEST_EXPONENT = 1.2
"""With which the cost of a frame may grow with the number of bodies."""

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
    scene.add_to(builder)
    return builder.finalize(device, worlds=worlds)


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
    run.set_d_hat(options.d_hat)
    run.drop(WARM_UP)
    before = run.iterations
    run.drop(WARM_UP + frames)
    return list(np.diff(stamps[WARM_UP - 1 :])), run.iterations - before


def libuipc(scene: Pile, python: str, frames: int) -> dict:
    """What the peer took for the frames of `scene`: seconds and motion [m] of each."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "scene.npz"
        np.savez(
            path,
            vertices=scene.part.vertices,
            faces=scene.part.faces,
            transforms=scene.transforms(),
            density=DENSITY,
            dt=TIME_STEP,
            friction=FRICTION,
            d_hat=0.01 * scene.size,
        )
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
    settle(model_of(scene, device), throw=False)
    model = model_of(scene, device, worlds)
    seconds = timed(lambda: settle(model, options_of(scene), throw=False))
    peer = libuipc(scene, python, 200)
    still = np.array(peer["motion"]) < STILL
    rest = next((k for k in range(3, len(still)) if still[k - 3 : k].all()), len(still))
    theirs = sum(peer["seconds"][:rest])
    row = Row(
        what=f"{worlds} worlds of 10 cubes to rest, scenes/s",
        ours=f"{worlds / seconds:.0f}",
        peer=f"{1 / theirs:.1f}",
        ratio=worlds / seconds * theirs,
        note=f"settled to 1e-6 of the weight at a 15 um barrier; the peer's {rest} frames end at {STILL:g} m a frame",
    )
    print(row, flush=True)
    return [row]


def scaling(device: str, plot: Path | None = None) -> list[tuple[int, float, float]]:
    """Bodies, ms a frame and iterations a frame of ever larger piles; the picture of it goes to `plot`."""
    found = []
    for count in (10, 30, 100, 300, 1000):
        times, iterations = frame_times(pile(count), device, 30)
        found.append((count, 1e3 * statistics.mean(times), iterations / 30))
        print(f"pile of {count}: {found[-1][1]:.2f} ms a frame, {found[-1][2]:.1f} iterations", flush=True)
    slope = np.polyfit(np.log([f[0] for f in found]), np.log([f[1] for f in found]), 1)[0]
    last = np.log(found[-1][1] / found[-2][1]) / np.log(found[-1][0] / found[-2][0])
    print(f"exponent {slope:.2f} over all sizes, {last:.2f} between the last two")
    if plot is not None:
        save_scaling([(count, milliseconds) for count, milliseconds, _ in found], LARGEST_EXPONENT, plot)
    return found


def gradients(device: str, frames: int = 300) -> list[Row]:
    """Seconds of an optimisation iteration, forward and backward, and memory of many worlds."""
    import torch

    from pat3d.sim.rollouts import rollout

    rows = []
    many = [(tower(10), 256)] if wp.get_device(device).is_cuda else []
    for scene, worlds in ((tower(10), 1), (pile(10), 1), *many):
        model = model_of(scene, device, worlds)
        q0 = torch.tensor(model.q0.reshape(worlds, -1, 12), requires_grad=True)
        count = frames if worlds == 1 else 30
        rollout(model, q0, until=3, options=options_of(scene)).q_end.sum().backward()
        forward: list = []
        ahead = timed(
            lambda m=model, q=q0, n=count, s=scene, out=forward: out.append(
                rollout(m, q, until=n, options=options_of(s))
            )
        )
        loss = (forward[0].frames[::10, :, :, :3] ** 2).sum()
        back = timed(loss.backward)
        note = f"forward {ahead:.2f} s, backward {back:.2f} s"
        if wp.get_device(device).is_cuda:
            place = wp.get_device(device)
            note += f", {(place.total_memory - place.free_memory) / 1e9:.1f} GB in use"
        row = Row(
            what=f"{scene.name}, {worlds} worlds, {count} frames there and back, s",
            ours=f"{ahead + back:.2f}",
            peer="2.5 x forward",
            ratio=2.5 * ahead / (ahead + back),
            note=note,
        )
        print(row, flush=True)
        rows.append(row)
    return rows


def against_mujoco(prompts: list[str]) -> list[Row]:
    """Seconds to rest on the CPU of generated scenes, and what MuJoCo takes for its 5 s on the same file."""
    from pat3d.check.settle import settle_in_mujoco
    from pat3d.generation.pipeline import generate
    from pat3d.generation.settle_stage import settle_scene

    seconds, ratios = [], []
    for prompt in prompts:
        with tempfile.TemporaryDirectory() as folder:
            scene = generate(prompt, out=f"{folder}/scene")
            ours = min(timed(lambda s=scene: settle_scene(s)) for _ in range(2))
            theirs = timed(lambda f=folder: settle_in_mujoco(Path(f) / "scene" / "mjcf" / "scene.xml"))
        seconds.append(ours)
        ratios.append(theirs / ours)
        hulls = sum(len(obj.asset.parts) for obj in scene.objects)
        print(
            f"{ours:.2f} s, MuJoCo {theirs:.2f} s, {len(scene.objects)} bodies of {hulls} hulls: {prompt[:60]}",
            flush=True,
        )
    row = Row(
        what=f"{len(prompts)} prompts to rest, s",
        ours=f"{statistics.median(seconds):.2f} (worst {max(seconds):.2f})",
        peer="MuJoCo, 5 s simulated",
        ratio=statistics.median(ratios),
        note=f"worst ratio {min(ratios):.2g}",
    )
    print(row)
    return [row]


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
    parser.add_argument("--only", nargs="+", choices=PARTS, help="parts to run (all that fit)")
    parser.add_argument("--prompts", type=Path, default=Path(__file__).parent / "prompts.txt", help="for the CPU")
    parser.add_argument("--plot", type=Path, help="PNG of the cost over the number of bodies")
    options = parser.parse_args()
    gpu = options.device == "cuda"
    parts = options.only or (("one", "many", "scaling", "gradients") if gpu else ("gradients", "mujoco"))
    print(HEADER)
    if "one" in parts:
        one_world(options.device, options.libuipc)
    if "many" in parts:
        many_worlds(options.device, options.libuipc)
    if "scaling" in parts:
        scaling(options.device, options.plot)
    if "gradients" in parts:
        gradients(options.device)
    if "mujoco" in parts:
        lines = [line.strip() for line in options.prompts.read_text(encoding="utf-8").splitlines()]
        against_mujoco([line for line in lines if line and not line.startswith("#")])


if __name__ == "__main__":
    main()
