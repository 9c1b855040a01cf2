"""Settled scenes a second: different scenes of a suite side by side on one device, against one after the other.

    python benchmarks/batches.py --device cuda [--scenes 256] [--batch 64 256] [--processes 16]

Scenes are laid out first, by processes; the clock runs from the first model to the last pose, with the kernels loaded.
"""

from __future__ import annotations

import argparse
import multiprocessing
import tempfile
import time
from pathlib import Path

import numpy as np

from pat3d.generation.settle_stage import settle_scene, settle_scenes
from pat3d.scene.model import Scene
from pat3d.sim.compilation import prepare

TARGET = 20.0
"""Settled scenes a second on an H200."""

ALONE = 16
"""Scenes that are settled one after the other."""


def laid_out(place: int) -> Scene | None:
    """The first candidate of a place of a suite, before it settles; None where it has no layout."""
    from pat3d.envs.suites.composition import draft
    from pat3d.envs.suites.request import Request
    from pat3d.envs.suites.unit import FRICTION
    from pat3d.errors import LayoutError
    from pat3d.generation.attempts import Attempts
    from pat3d.generation.checkpoints import Workspace
    from pat3d.generation.request import request_of
    from pat3d.progress import Clock, silent

    made = draft(Request(scenes=10_000, seed=0, objects=(6, 6)), place, 0)
    with tempfile.TemporaryDirectory() as folder:
        attempts = Attempts(
            request_of(made.plan, False),
            seed=made.scene_seed,
            friction=FRICTION,
            device="cpu",
            workspace=Workspace(Path(folder) / "none", keep=False),
            clock=Clock(),
            progress=silent,
            scratch=Path(folder),
        )
        try:
            return attempts.layout()
        except LayoutError:
            return None


def main() -> None:
    """Print a line for each size of batch."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--device", default="cuda")
    parser.add_argument("--scenes", type=int, default=256)
    parser.add_argument("--batch", type=int, nargs="+", default=[64, 256])
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    with multiprocessing.get_context("spawn").Pool(options.processes) as pool:
        scenes = [scene for scene in pool.map(laid_out, range(options.scenes), chunksize=1) if scene is not None]
    objects = np.mean([len(scene.objects) for scene in scenes])
    print(f"{len(scenes)} scenes of {objects:.1f} objects", flush=True)
    for device in dict.fromkeys(("cpu", options.device)):
        prepare(device)
        settle_scene(scenes[0], device=device)
        start = time.perf_counter()
        rests = [settle_scene(scene, device=device) for scene in scenes[:ALONE]]
        rate = len(rests) / (time.perf_counter() - start)
        print(f"{device}, one after the other: {rate:.1f} scenes/s", flush=True)
    for size in options.batch:
        batches = [scenes[first : first + size] for first in range(0, len(scenes), size)]
        start = time.perf_counter()
        rests = [rest for batch in batches for rest in settle_scenes(batch, device=options.device)]
        rate = len(rests) / (time.perf_counter() - start)
        still = sum(rest.at_rest for rest in rests)
        print(
            f"{options.device}, {size} together: {rate:.1f} scenes/s (target {TARGET:g}: {rate / TARGET:.2f} times), "
            f"{still} of {len(rests)} at rest",
            flush=True,
        )


if __name__ == "__main__":
    main()
