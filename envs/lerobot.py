"""Suites for LeRobot's evaluation: what `make_env` of an EnvHub folder returns, and observations under its names."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces

from pat3d.envs.env import TabletopEnv
from pat3d.envs.registration import MAX_EPISODE_STEPS
from pat3d.envs.suites.suite import Suite

_STATE = ("joint_pos", "gripper_pos", "eef_pos", "eef_quat")


def make_env(
    suite: str | os.PathLike[str],
    *,
    n_envs: int = 1,
    use_async_envs: bool = False,
    split: str = "test",
    image_size: tuple[int, int] = (256, 256),
) -> dict[str, dict[int, gymnasium.vector.VectorEnv]]:
    """A vector environment for every kind of task with scenes in `split`: {"pick": {0: env}, "place": {0: env}, ...}.

    Raises:
        SuiteError: no such suite or split.
    """
    found = Suite.open(suite)
    kinds = [kind for kind in found.request.tasks if any(one.kind == kind for one in found.select(split))]
    made: dict[str, dict[int, gymnasium.vector.VectorEnv]] = {}
    for kind in kinds:
        builders: list[Callable[[], gymnasium.Env[Any, Any]]] = [
            partial(_one, os.fspath(suite), split, kind, found.request.robot, image_size) for _ in range(n_envs)
        ]
        together = gymnasium.vector.AsyncVectorEnv if use_async_envs else gymnasium.vector.SyncVectorEnv
        made[kind] = {0: together(builders)}
    return made


def _one(suite: str, split: str, kind: str, robot: str, image_size: tuple[int, int]) -> gymnasium.Env[Any, Any]:
    env = TabletopEnv(suite=suite, split=split, task=kind, robot=robot, obs="rgb", image_size=image_size)
    return gymnasium.wrappers.TimeLimit(PixelsAndState(env), MAX_EPISODE_STEPS)


class PixelsAndState(gymnasium.ObservationWrapper[Any, Any, Any]):
    """Observations as {"pixels": {camera: image}, "agent_pos": state of the robot}."""

    def __init__(self, env: gymnasium.Env[Any, Any]) -> None:
        super().__init__(env)
        inner = env.observation_space
        self._cameras = [key for key in inner if key.endswith("_image")]  # type: ignore[attr-defined]
        low = np.concatenate([inner[key].low for key in _STATE])  # type: ignore[index]
        high = np.concatenate([inner[key].high for key in _STATE])  # type: ignore[index]
        self.observation_space = spaces.Dict(
            {
                "pixels": spaces.Dict({key.removesuffix("_image"): inner[key] for key in self._cameras}),  # type: ignore[index]
                "agent_pos": spaces.Box(low, high, dtype=np.float32),
            }
        )

    @property
    def task_description(self) -> str:
        """What to do, in words."""
        return self.env.unwrapped.instruction  # type: ignore[attr-defined]

    @property
    def task(self) -> str:
        """The task's specification."""
        return self.env.unwrapped.task.spec  # type: ignore[attr-defined]

    def observation(self, observation: Any) -> Any:
        """Under LeRobot's names."""
        return {
            "pixels": {key.removesuffix("_image"): observation[key] for key in self._cameras},
            "agent_pos": np.concatenate([observation[key] for key in _STATE]),
        }
