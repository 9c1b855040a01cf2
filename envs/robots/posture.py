"""A posture to start in: the hand in front of the base, pointing down, far from limits and singular postures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.kinematics import ArmKinematics
from pat3d.envs.robots.robot import Robot
from pat3d.errors import EnvironmentSetupError

Array = NDArray[np.float64]

FORWARD, UPWARD = 0.42, 0.25
"""Where the hand starts, as shares of the length of the arm."""

LOWER = (0.0, -0.15)
"""The same shares for arms that cannot point down so high."""

TRIES = 24
"""Random postures from which a solution is searched."""


def start_posture(robot: Robot, known: Sequence[Array]) -> Robot:
    """`robot` with its start posture and its base turned so that it faces +x.

    Args:
        robot: without one.
        known: postures of the robot's file [rad], shape (joints,) each, which are tried first.

    Raises:
        EnvironmentSetupError: the arm cannot point its hand down.
    """
    arm = ArmKinematics(robot, robot.new_spec().compile())
    length = arm.length
    low, high = arm.limits
    random = np.random.default_rng(0)
    starts = [np.clip(one + [turn, *[0.0] * (len(one) - 1)], low, high) for one in known for turn in _QUARTERS]
    starts += [(low + high) / 2, *(low + random.random((TRIES, len(low))) * (high - low))]
    found = []
    down = np.array([0.0, 0.0, -1.0])
    shares = (1.0, 0.85, 0.7)
    for share, upward in [*((share, UPWARD) for share in shares), *((1.0, lower) for lower in LOWER)]:
        place = share * length * np.array([FORWARD, 0.0, upward])
        for start in starts:
            for side in (1.0, -1.0):
                closing = np.array([0.0, side, 0.0])
                joints = arm.solve(place, np.stack([np.cross(closing, down), closing, down], axis=1), start)
                if joints is not None:
                    found.append((_worth(arm, joints), joints))
        if any(worth > 0.0 for worth, _ in found):
            break
    if not found:
        raise EnvironmentSetupError(
            f"{robot.name}: the arm cannot point its hand down in front of its base, {length:.2f} m long as it is."
        )
    return replace(robot, home=max(found, key=lambda one: one[0])[1])


_QUARTERS = (0.0, np.pi / 2, -np.pi / 2, np.pi)


def _worth(arm: ArmKinematics, joints: Array) -> float:
    """Higher is better: distance from the limits, how well the hand can move, and how high the elbow is."""
    jacobian = arm.jacobian(joints)
    able = float(np.linalg.svd(jacobian, compute_uv=False)[-1]) if jacobian.shape[1] >= 6 else 0.1
    clear = float(arm.heights(joints).min()) - 10.0 * arm.touches_itself(joints)
    # Of postures that differ by whole turns, the least wound up.
    clear -= 0.05 * float(np.abs(joints).max())
    return min(arm.margin(joints), 1.0) + 4.0 * min(able, 0.2) + clear
