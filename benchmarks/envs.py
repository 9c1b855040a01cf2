"""Control steps a second of PAT3D-v0 against robosuite's own Lift: one core, Panda, state observations, equal rates.

    python benchmarks/envs.py [--scene FOLDER] [--rounds 5]

The two take turns, so that a busy machine slows both.
"""

from __future__ import annotations

import argparse
import logging
import statistics
import time
from typing import Any

import numpy as np

from pat3d.envs.env import TabletopEnv
from pat3d.envs.robots import quiet_robosuite

STEPS = 60
RESETS = 20


def main() -> None:
    """Print one table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default=None, help="scene folder; the shipped scene by default")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--rate", type=float, default=20.0, help="actions a second")
    options = parser.parse_args()
    ours = TabletopEnv(options.scene, control_freq=options.rate)
    theirs = _lift(options.rate)
    random = np.random.default_rng(0)
    actions = random.uniform(-0.3, 0.3, (STEPS, 7)).astype(np.float32)
    ours.reset(seed=0)
    theirs.reset()
    rates: dict[str, list[float]] = {"PAT3D-v0": [], "robosuite Lift": []}
    resets: dict[str, list[float]] = {"PAT3D-v0": [], "robosuite Lift": []}
    for _ in range(options.rounds):
        for name, env in (("PAT3D-v0", ours), ("robosuite Lift", theirs)):
            env.reset()
            env.step(actions[0])
            start = time.perf_counter()
            for action in actions:
                env.step(action)
            rates[name].append(STEPS / (time.perf_counter() - start))
            count = RESETS if env is ours else 3
            start = time.perf_counter()
            for _ in range(count):
                env.reset()
            resets[name].append(1e3 * (time.perf_counter() - start) / count)
    print(f"scene: {len(ours.objects)} moving objects, {ours.simulation.model.ngeom} geoms, {options.rate:g} actions/s")
    for name in rates:
        rate, reset = statistics.median(rates[name]), statistics.median(resets[name])
        print(f"{name:16s} {rate:8.1f} control steps/s   reset {reset:8.2f} ms")
    ratio = statistics.median(a / b for a, b in zip(*rates.values(), strict=True))
    print(f"ratio            {ratio:8.2f}")


def _lift(rate: float) -> Any:
    logging.getLogger("robosuite_logs").setLevel(logging.ERROR)
    with quiet_robosuite():
        import robosuite

        return robosuite.make(
            "Lift", robots="Panda", has_renderer=False, has_offscreen_renderer=False, use_camera_obs=False,
            control_freq=rate, horizon=10**6,
        )  # fmt: skip


if __name__ == "__main__":
    main()
