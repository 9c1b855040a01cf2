"""Two hands at one object: how each is turned where it takes it, and that nothing meets on the way there."""

from __future__ import annotations

import math
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.hand import Hand, hand_pose
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.physics.clearance import Clearance
from pat3d.envs.robots.arms import arm_kinematics, measure_gripper
from pat3d.envs.robots.kinematics import PlacedArm
from pat3d.envs.robots.pairs import SIDES
from pat3d.errors import TaskError

Array = NDArray[np.float64]

LIFT = 0.16
"""How high two hands raise what they take [m]."""


class TakingHand:
    """One of two arms, with a grasp of the object.

    Args:
        env: a TabletopEnv, or a workplace, with two arms.
        side: "left" or "right".
        number: of the pair of grasps, of those that both arms get to.
        half: by which its hand is turned about the approach [rad]: 0, or pi with its fingers exchanged.
    """

    def __init__(self, env: Any, side: str, number: int, half: float) -> None:
        placement, name = env.placement, env.task.names[0]
        own = placement if placement.side == side else placement.other
        arm = env.simulation.world.arm(side)
        gripper, self._home = measure_gripper(arm.robot.name), np.array(arm.start)
        self._arm = PlacedArm(arm_kinematics(arm.robot.name), own.base_position, own.yaw)
        self.tip = gripper.tip
        """How far the fingers reach beyond the grip site [m]."""
        self.fingers = np.array(gripper.open_joints)
        """Joint positions of the open gripper."""
        grasp: Grasp = own.grasps[name][number]
        self.pose: Hand = hand_pose(grasp, gripper.tip, gripper.closing_axis, half=half)
        """Of the hand in its grasp."""

    def joints(self, up: float) -> Array | None:
        """Joint positions of the arm with its hand `up` [m] above its grasp; None out of reach."""
        position, rotation = self.pose
        return self._arm.solve(position + [0.0, 0.0, up], rotation, self._home, self._home)

    @property
    def motion(self) -> float:
        """By how much a joint turns at most from the start to the grasp [rad]."""
        joints = self.joints(0.0)
        return math.inf if joints is None else float(np.abs(joints - self._home).max())


def hands_of(work: Any, *, at_once: bool) -> tuple[dict[str, TakingHand], str]:
    """Both hands, and what speaks against them: nothing where they get to the object and up with it, in nothing else.

    Each hand can be turned either way round. Of the pairs of grasps, best first, the first is taken with which neither
    hand is in the other one, in that way in which the joints move least; where there is none, the best pair is.

    Args:
        work: a TabletopEnv, or a workplace, with two arms.
        at_once: whether both take it where it stands; otherwise the right hand takes it out of the raised left one.
    """
    clearance, name = Clearance(work), work.task.names[0]
    first: tuple[dict[str, TakingHand], str] | None = None
    for number in range(len(work.placement.grasps[name])):
        both = ([TakingHand(work, side, number, half) for half in (0.0, math.pi)] for side in SIDES)
        ways: list[dict[str, TakingHand]] = [dict(zip(SIDES, way, strict=True)) for way in product(*both)]
        for hands in sorted(ways, key=lambda hands: sum(hand.motion for hand in hands.values())):
            fault = _fault(hands, clearance, name, at_once=at_once)
            if not fault:
                return hands, ""
            first = first or (hands, fault)
    if first is None:
        raise TaskError(f'no pair of grasps of "{name}" is known.')
    return first


def rehearse_together(work: Any, *, at_once: bool) -> None:
    """Raise TaskError where something speaks against both hands; see `hands_of`."""
    _, fault = hands_of(work, at_once=at_once)
    if fault:
        raise TaskError(fault)


def _fault(hands: dict[str, TakingHand], clearance: Clearance, name: str, *, at_once: bool) -> str:
    """Why two hands do not get to an object and up with it; nothing where they do."""
    left, right = SIDES
    if at_once:
        heights = [dict.fromkeys(SIDES, up) for up in (HOVER, 0.0, LIFT)]
    else:
        alone = [{left: up} for up in (HOVER, 0.0, LIFT)]
        heights = [*alone, {left: LIFT, right: LIFT + HOVER}, {left: LIFT, right: LIFT}]
    for one in heights:
        postures = {}
        for side, up in one.items():
            joints = hands[side].joints(up)
            if joints is None:
                return f'the {side} arm does not get to "{name}".'
            postures[side] = joints, hands[side].fingers
        met = clearance.met(postures, name)
        if met:
            return f'two hands find no way to "{name}" on which neither is in {met}.'
    return ""
