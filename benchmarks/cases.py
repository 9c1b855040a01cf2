"""Picture of two episodes: a grasp that succeeds, and one that topples the neighbours of what it should take.

    python benchmarks/cases.py [--out benchmarks/pictures/cases.png]

Both pick the same mug in the same scene from the same start. The first is the scripted policy. The second plans its
grasp as if the mug stood alone, goes there on a straight line, and tries once.
"""

from __future__ import annotations

import argparse
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import find_grasps
from pat3d.envs.tasks.moves import Move, Planner
from pat3d.generation.pipeline import generate
from pat3d.policies_eval.policies.scripted import EXACT, ScriptedPolicy
from pat3d.policies_eval.run.episodes import Setting, episodes_of
from pat3d.policies_eval.run.evaluate import evaluate
from pat3d.policies_eval.run.replay import Replayer
from pat3d.policies_eval.run.settings import RolloutSettings
from pat3d.policies_eval.strip import write_strip

PROMPT = "A small wooden tray with a red mug, two beer bottles, a pepper mill, a shampoo and a candlestick on it."
TASK = "pick:red mug"

STEPS = 140
"""Of an episode."""

SIZE, FINER = (320, 240), 3
"""Of a moment [pixel], and how many times finer it is drawn along either side."""

COLOURS = 160


class Heedless(ScriptedPolicy):
    """The scripted policy without eyes for anything but its object."""

    def _plan(self) -> Planner:
        return Alone(self._env)

    def _rise(self) -> None:
        self._enter("descend")

    def _descend(self) -> NDArray[np.float32] | None:
        return self._go(self._move.at, -1.0, EXACT, "close", patient=True)

    def _failed(self) -> None:
        self._enter("give_up")

    def _give_up(self) -> Any:
        return self._servo.towards(self._move.at + [0.0, 0.0, 0.15], self._rotation, 1.0)[0]


class Alone(Planner):
    """Plans as if the object stood alone on what carries it."""

    def next(self, failures: Mapping[str, int]) -> Move:
        """The best grasp of the task's object."""
        scene, name = self._env.scene, self._env.task.target
        return self.as_move(name, find_grasps(scene, name, self._gripper, among=(scene.parent(name),))[0])


def smaller(image: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """The picture with the mean of FINER x FINER pixels for one."""
    height, width = image.shape[0] // FINER, image.shape[1] // FINER
    return image.reshape(height, FINER, width, FINER, 3).mean(axis=(1, 3)).round().astype(np.uint8)


def main() -> None:
    """Make the scene, do the episodes, and draw them."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", default=str(Path(__file__).parent / "pictures" / "cases.png"))
    parser.add_argument("--work", help="folder of scene and records (a temporary one)")
    parser.add_argument("--camera", default="agentview")
    parser.add_argument("--seed", type=int, default=1, help="of the scene")
    options = parser.parse_args()
    work = Path(options.work or tempfile.mkdtemp(prefix="pat3d-cases-"))
    if not (work / "scene" / "scene.json").is_file():
        generate(PROMPT, out=work / "scene", seed=options.seed)
    episodes = episodes_of([Setting(scene=str(work / "scene"), task=TASK)], 1)
    rows = []
    for policy in (ScriptedPolicy(), Heedless()):
        found = evaluate(
            policy, episodes, work / type(policy).__name__, settings=RolloutSettings(max_steps=STEPS), workers=0
        )
        result = found.results[0]
        events = result.events
        print(f"{type(policy).__name__}: {result.outcome}, {result.steps} steps, toppled: {', '.join(events.toppled)}")
        replayer = Replayer(found)
        moments = [0, round(0.2 * result.steps), round(0.5 * result.steps), result.steps]
        clean = result.success and not events.toppled
        if not clean:
            moments = [0, 25, 45, result.steps]
        drawn = replayer.moments(result, moments, options.camera, (FINER * SIZE[0], FINER * SIZE[1]))
        frames = [smaller(frame) for frame in drawn]
        replayer.close()
        said = "a grasp that leaves the others alone" if clean else f"a grasp that topples: {', '.join(events.toppled)}"
        rows.append((said, frames))
    print(write_strip(rows, options.out, colours=COLOURS), Path(options.out).stat().st_size, "bytes")


if __name__ == "__main__":
    main()
