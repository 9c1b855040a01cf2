"""Ways for the hand that the arm can go: poses along a motion of the joints from one posture to another."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.hand import Hand
from pat3d.envs.robots.arms import arm_kinematics
from pat3d.envs.robots.kinematics import PlacedArm

Array = NDArray[np.float64]

JOINT_STEP = 0.12
"""Largest motion of a joint between two poses [rad]."""


class HandPath:
    """Plans for the arm of one environment; what is in the way is not looked at.

    Args:
        env: a TabletopEnv after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env = env
        self._arm = PlacedArm(arm_kinematics(env.robot), env.placement.base_position, env.placement.yaw)

    def through(self, goals: list[Hand]) -> list[Hand] | None:
        """Poses from the present posture through `goals`; None where the arm does not get to one of them."""
        joints: Array = self._env.simulation.arm.copy()
        found: list[Hand] = []
        for position, rotation in goals:
            # The start's posture is far from the joints' limits, where the present one may be near them.
            starts = (joints, np.array(self._env.placement.start))
            ends = [end for start in starts if (end := self._arm.solve(position, rotation, start)) is not None]
            if not ends:
                return None
            end = min(ends, key=lambda one: float(np.abs(one - joints).max()))
            count = max(1, math.ceil(float(np.abs(end - joints).max()) / JOINT_STEP))
            for number in range(1, count + 1):
                found.append(self._arm.hand(joints + (end - joints) * number / count))
            joints = end
        return found
