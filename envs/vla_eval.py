"""A suite as a benchmark of vla-eval (allenai/vla-evaluation-harness), whose model servers then run on it.

    benchmarks:
      - benchmark: "pat3d.envs.vla_eval:SuiteBenchmark"
        params: {suite: suites/tabletop, split: test}

Every scene of the split is a task; the episodes of a task differ in the robot's start. Actions have the conventions of
LIBERO: changes of the hand's pose in [-1, 1] of 5 cm and 0.5 rad (axis-angle, in the base), positive closes.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np
from vla_eval.benchmarks.base import StepBenchmark, StepResult  # pyright: ignore[reportMissingImports]
from vla_eval.specs import GRIPPER_CLOSE_POS, IMAGE_RGB, LANGUAGE, POSITION_DELTA, ROTATION_AA, DimSpec  # pyright: ignore[reportMissingImports]

from pat3d.envs.registration import IMAGE_SIDE
from pat3d.envs.rendering.opengl import VARIABLE
from pat3d.envs.suites.suite import Suite
from pat3d.errors import EnvironmentSetupError

ACTION_SIZE = 7


class SuiteBenchmark(StepBenchmark):
    """The scenes of one split of a suite.

    Args:
        suite: folder.
        split: of it; None for all scenes.
        cameras: whose pictures the policy gets.
        image_size: height and width of the pictures [pixel].
        seed: of the first episode of every task; the k-th has `seed` + k.
        send_state: whether "states" is sent: the hand's position [m] and orientation (axis-angle) in the world, and the
            gripper's joints.

    Raises:
        SuiteError: no such suite or split.
        EnvironmentSetupError: the suite's robot has two arms.
    """

    render_backends: ClassVar[frozenset[str]] = frozenset({"gpu", "cpu"})

    @classmethod
    def configure_render(cls, mode: str) -> dict[str, str]:
        """On the CPU rays are traced; otherwise what works decides."""
        chosen = {VARIABLE: "cpu"} if mode == "cpu" else {}
        os.environ.update(chosen)
        return chosen

    def __init__(
        self,
        suite: str,
        split: str | None = "test",
        cameras: Sequence[str] = ("agentview", "wrist"),
        image_size: Sequence[int] = (IMAGE_SIDE, IMAGE_SIDE),
        seed: int = 0,
        send_state: bool = True,
    ) -> None:
        super().__init__()
        self._suite, self._split, self._cameras = Suite.open(suite), split, tuple(cameras)
        self._entries = self._suite.select(split)
        self._size, self._seed, self._send_state = (int(image_size[0]), int(image_size[1])), seed, send_state
        self._env: Any = None
        self._steps = 0

    def get_tasks(self) -> list[dict[str, Any]]:
        """A task for every scene."""
        name = self._suite.folder.path.resolve().name
        return [
            {"name": f"{entry.place:06d} {entry.instruction}", "suite": name, "index": index, "task": entry.task}
            for index, entry in enumerate(self._entries)
        ]

    def reset(self, task: dict[str, Any]) -> Any:
        """The first observation of a task's next episode."""
        env = self._made()
        seed = self._seed + int(task.get("episode_idx", 0))
        observation, info = env.reset(seed=seed, options={"index": int(task["index"])})
        self._instruction, self._steps = info["instruction"], 0
        self._recorder.record_video(observation[f"{self._cameras[0]}_image"])
        return observation

    def step(self, action: dict[str, Any]) -> StepResult:
        """Do one action; values out of [-1, 1] are clipped."""
        values = np.asarray(action.get("actions", action.get("action")), dtype=np.float32)
        if values.shape != (ACTION_SIZE,):
            raise EnvironmentSetupError(f"an action is {ACTION_SIZE} numbers, got shape {values.shape}.")
        observation, reward, success, broken, info = self._made().step(values)
        self._steps += 1
        done = success or broken or self._steps >= self._made().horizon
        self._recorder.record_video(observation[f"{self._cameras[0]}_image"])
        self._recorder.record_step(reward=float(reward), done=bool(done), success=bool(success), action=values)
        return StepResult(obs=observation, reward=float(reward), done=bool(done), info=info)

    def make_obs(self, raw_obs: Any, task: dict[str, Any]) -> dict[str, Any]:
        """Pictures, the instruction and the state under the names of vla-eval's own benchmarks."""
        images = {name: np.ascontiguousarray(raw_obs[f"{name}_image"]) for name in self._cameras}
        found: dict[str, Any] = {"images": images, "task_description": self._instruction}
        if self._send_state:
            found["states"] = _state(raw_obs)
        return found

    def get_step_result(self, step_result: StepResult) -> dict[str, Any]:
        """Success, and how far the task is."""
        info = step_result.info
        return {"success": bool(info.get("success", False)), "progress": float(info.get("progress", 0.0))}

    def get_metric_keys(self) -> dict[str, str]:
        """Means of both."""
        return {"success": "mean", "progress": "mean"}

    def get_metadata(self) -> dict[str, Any]:
        """The longest task's steps; every episode ends with its own task's."""
        moves = max(int(entry.axes["objects"]) for entry in self._entries)
        from pat3d.envs.config import TabletopConfig
        from pat3d.envs.tasks.task import steps_for

        longest = steps_for(moves, TabletopConfig.control_freq)
        return {"max_steps": longest, "suite": self._suite.folder.path.resolve().name, "split": self._split}

    def get_action_spec(self) -> dict[str, DimSpec]:
        """LIBERO's."""
        return {"position": POSITION_DELTA, "rotation": ROTATION_AA, "gripper": GRIPPER_CLOSE_POS}

    def get_observation_spec(self) -> dict[str, DimSpec]:
        """Pictures, language and state."""
        told = {**dict.fromkeys(self._cameras, IMAGE_RGB), "language": LANGUAGE}
        if self._send_state:
            fingers = int(self._made().observation_space["gripper_pos"].shape[0])
            told["state"] = DimSpec("state", 6 + fingers, f"eef_pos3_axisangle3_gripper{fingers}")
        return told

    def get_hold_action(self, last_action: dict[str, Any] | None) -> dict[str, Any]:
        """No change of the hand, and fingers that stay as they are."""
        return {"actions": np.zeros(ACTION_SIZE, dtype=np.float32)}

    def render(self) -> np.ndarray | None:
        """The present picture of the first camera."""
        return None if self._env is None else self._env.pictures.take(self._cameras[0], *self._size).image

    def cleanup(self) -> None:
        """Free the environment."""
        if self._env is not None:
            self._env.close()
            self._env = None

    def _made(self) -> Any:
        """The environment, made when it is first needed."""
        if self._env is None:
            from pat3d.envs.env import TabletopEnv

            self._env = TabletopEnv(
                suite=self._suite.folder.path,
                split=self._split,
                obs="rgb",
                cameras=self._cameras,
                image_size=self._size,
                index=None,
            )
            size = self._env.action_space.shape[0]
            if size != ACTION_SIZE:
                raise EnvironmentSetupError(f"vla-eval's actions are of one arm; {self._env.robot} has {size} values.")
        return self._env


def _state(observation: Any) -> np.ndarray:
    """Position, axis-angle and gripper, shape (6 + fingers,)."""
    from scipy.spatial.transform import Rotation

    turn = Rotation.from_quat(observation["eef_quat"], scalar_first=True).as_rotvec()
    return np.concatenate([observation["eef_pos"], turn, observation["gripper_pos"]]).astype(np.float32)
