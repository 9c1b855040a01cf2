"""Control steps a second of PAT3D-v0 against robosuite's own Lift: one core, Panda, state observations, equal rates.

    python benchmarks/envs.py [--scene FOLDER] [--rounds 5] [--rate 20]

Without --scene: the shipped scene, and one of ten objects that is made on the spot. Environments take turns and the
processor's time is what counts, so that other work on the machine slows all alike. By default objects at rest sleep
until something touches them; the rows with sleep=False step everything all the time.
"""

from __future__ import annotations

import argparse
import logging
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

import pat3d
from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping.scripted import ScriptedPick
from pat3d.envs.robots.robosuite_arms import quiet_robosuite

STEPS = 60
RESETS = 20

TEN = (
    "A wooden tray with a red mug, a green apple, a banana and a blue bowl on it, a stack of two books beside it, "
    "a yellow cube, a soda can and a salt shaker."
)
"""Ten objects, of which five touch the ground and one another in 70 points."""


def main() -> None:
    """Print a table for every scene."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", default=None, help="scene folder")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--rate", type=float, default=20.0, help="actions a second")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        scenes = [options.scene] if options.scene else [None, str(Path(scratch) / "ten")]
        if not options.scene:
            pat3d.generate(TEN, out=scenes[1], seed=0)
        for scene in scenes:
            _table(scene, options.rounds, options.rate)


def _table(scene: str | None, rounds: int, rate: float) -> None:
    ours = TabletopEnv(scene, control_freq=rate)
    awake = TabletopEnv(scene, control_freq=rate, sleep=False)
    theirs = _lift(rate)
    actions = np.random.default_rng(0).uniform(-0.3, 0.3, (STEPS, 7)).astype(np.float32)
    runs: dict[str, Callable[[], float]] = {
        "robosuite Lift": lambda: _random(theirs, actions),
        "PAT3D-v0": lambda: _random(ours, actions),
        "PAT3D-v0, sleep=False": lambda: _random(awake, actions),
        "PAT3D-v0, a scripted pick": lambda: _pick(ours),
        "... with sleep=False": lambda: _pick(awake),
    }
    rates: dict[str, list[float]] = {name: [] for name in runs}
    for _ in range(rounds):
        for name, run in runs.items():
            rates[name].append(run())
    contacts = awake.simulation.data.ncon
    print(
        f"\n{scene or 'shipped scene'}: {len(ours.objects)} moving objects, {ours.simulation.model.ngeom} geoms, "
        f"{contacts} contacts, {rate:g} actions/s"
    )
    for name, found in rates.items():
        ratio = statistics.median(a / b for a, b in zip(found, rates["robosuite Lift"], strict=True))
        print(f"{name:28s} {statistics.median(found):8.1f} control steps/s   ratio {ratio:5.2f}", flush=True)
    print(f"{'reset':28s} PAT3D-v0 {_reset(ours, RESETS):.2f} ms, Lift {_reset(theirs, 3):.0f} ms", flush=True)
    theirs.close()


def _random(env: Any, actions: Any) -> float:
    """Control steps a second of processor time while the arm wanders about."""
    env.reset()
    env.step(actions[0])
    start = time.process_time()
    for action in actions:
        env.step(action)
    return len(actions) / (time.process_time() - start)


def _pick(env: TabletopEnv) -> float:
    """The same while the arm picks something up."""
    env.reset(seed=0)
    hand, spent = ScriptedPick(env), 0.0
    for _ in range(STEPS):
        action = hand.action()
        start = time.process_time()
        env.step(action)
        spent += time.process_time() - start
    return STEPS / spent


def _reset(env: Any, count: int) -> float:
    """Of processor time [ms]."""
    start = time.process_time()
    for _ in range(count):
        env.reset()
    return 1e3 * (time.process_time() - start) / count


def _lift(rate: float) -> Any:
    logging.getLogger("robosuite_logs").setLevel(logging.ERROR)
    with quiet_robosuite():
        import robosuite

        return robosuite.make(
            "Lift",
            robots="Panda",
            has_renderer=False,
            has_offscreen_renderer=False,
            use_camera_obs=False,
            control_freq=rate,
            horizon=10**6,
        )


if __name__ == "__main__":
    main()
