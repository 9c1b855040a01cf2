"""What judging and observing many worlds costs, beside their physics; one CPU core, no GPU.

    python benchmarks/judging.py [--worlds 2048] [--scenes FOLDER ...]

States after random actions on the CPU stand for those of the worlds. One task of every kind that the scene allows;
milliseconds of processor time a control step of all worlds.
"""

from __future__ import annotations

import argparse
import time
from typing import Any

import numpy as np

from pat3d.envs.env import TabletopEnv
from pat3d.envs.observations import Observer
from pat3d.envs.physics.loading import load
from pat3d.envs.physics.snapshot import Snapshot
from pat3d.envs.physics.state import States
from pat3d.envs.tasks.registry import TASKS, possible_tasks
from pat3d.errors import TaskError

STEPS = 200
"""Control steps of the episode whose states are drawn."""

MOMENT = ("xpos", "xmat", "xipos", "qvel", "sites", "site_xmat", "touching", "pinched")
"""What a snapshot holds of a moment."""


class Drawn(States):
    """Worlds in states of one episode, drawn at random."""

    def __init__(self, env: TabletopEnv, worlds: int) -> None:
        super().__init__(env.simulation.world, worlds)
        self._states, random, kept = env.simulation.states, np.random.default_rng(0), []
        env.reset(seed=0)
        for _ in range(STEPS):
            kept.append(self._now())
            action = random.uniform(-1.0, 1.0, env.simulation.controller.size)
            env.step(action.astype(np.float32))
        first, drawn = np.zeros(worlds, dtype=np.int64), random.integers(0, STEPS, worlds)
        for chosen in (first, drawn):
            arrays = {name: np.stack([kept[number][name] for number in chosen]) for name in kept[0]}
            self.qpos, self.xquat = arrays.pop("qpos"), arrays.pop("xquat")
            self.snapshot = Snapshot(**arrays, **self._about)
            if chosen is first:
                self.take_start(self.everyone)

    def _now(self) -> dict[str, Any]:
        states = self._states
        arrays = {name: getattr(states.snapshot, name) for name in MOMENT}
        arrays |= {"qpos": states.qpos, "xquat": states.xquat}
        return {name: values[0].copy() for name, values in arrays.items()}

    def refresh(self) -> None:
        """There is nothing to read."""


def environments(folder: str | None) -> Any:
    """An environment for the first task of every kind that the scene and the robot allow."""
    scene = load(folder).scene
    for kind in TASKS:
        for task in possible_tasks(scene):
            if task.kind == kind:
                try:
                    env = TabletopEnv(folder, task=task)
                except TaskError:
                    continue
                yield env
                break


def least(what: Any, times: int = 10) -> float:
    """Least processor time of several runs [ms]."""
    found = []
    for _ in range(times):
        begun = time.process_time()
        what()
        found.append(1e3 * (time.process_time() - begun))
    return min(found)


def main() -> None:
    """Measure scene after scene."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--worlds", type=int, default=2048)
    parser.add_argument("--scenes", nargs="+", default=[None], help="scene folders; the shipped scene by default")
    options = parser.parse_args()
    for folder in options.scenes:
        for env in environments(folder):
            states = Drawn(env, options.worlds)
            judge, observer = env.task.judge(states), Observer(env._spec, states.world)
            seconds = np.full(options.worlds, 1.0 / env.control_freq)
            verdicts = judge.update(seconds)
            judging = least(lambda judge=judge, seconds=seconds: judge.update(seconds)) + least(states.upsets)
            observing = least(lambda o=observer, s=states, v=verdicts: o.observe(s, v))
            what = f"{len(env.objects)} objects, {env.task.spec}"
            print(f"{what}: judging {judging:.1f} ms, observing {observing:.1f} ms", flush=True)


if __name__ == "__main__":
    main()
