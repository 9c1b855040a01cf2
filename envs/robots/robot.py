"""A robot as environments use it: one arm with a parallel gripper, described by the names of its parts.

Where a robot comes from, Menagerie, a file of one's own or robosuite, makes no difference to placement, grasp planning,
tasks and worlds: they go by joints, by the geometry of the hand, and by two sites that every robot has.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

STRIDE = 0.2
"""By how much of half its way a gripper moves in a control step."""


@dataclass(frozen=True, kw_only=True)
class Gripper:
    """What a parallel gripper can take, measured in the frame of its grip site with the fingers open."""

    opening: float
    """Free width between the pads [m]."""
    closed: float
    """Width that is left between the pads of the closed gripper [m]."""
    finger_thickness: float
    """Of a finger, from the pad outwards [m]."""
    finger_width: float
    """Of a finger, across the closing direction [m]."""
    tip: float
    """How far the fingers reach beyond the grip site along the approach direction [m]."""
    palm: float
    """How far the palm is behind the fingertips [m]."""
    hand: tuple[float, float]
    """Width of the hand along and across the closing direction [m]."""
    pad: float
    """Height of the pads, from the tips backwards [m]."""
    closing_axis: tuple[float, float, float]
    """Direction in which the fingers close, in the frame of the grip site; the approach is +z."""
    open_joints: tuple[float, ...] = ()
    """Positions of the gripper's joints when it is open."""
    closed_joints: tuple[float, ...] = ()
    """The same when it is closed."""
    throat: float = math.inf
    """How far behind the fingertips [m] linkages make the gap between the fingers narrower than the opening."""

    @property
    def deepest(self) -> float:
        """Bite of what goes in until it meets the palm or the linkages [m]."""
        return min(self.palm, self.throat)

    def joints(self, width: float) -> Array:
        """Positions of the gripper's joints when its pads are about `width` [m] apart."""
        share = min(1.0, max(0.0, (width - self.closed) / (self.opening - self.closed)))
        return np.array(self.closed_joints) + share * (np.array(self.open_joints) - np.array(self.closed_joints))


class FingerDrive(Protocol):
    """Turns what the last value of an action says into the target of every finger, and remembers the last."""

    current_action: Any
    """Of the gripper's actuators, in [-1, 1]."""

    def format_action(self, action: Array) -> Any:
        """The new targets, shape (gripper actuators,): +1 and -1 are the ends of an actuator's range."""
        ...


class SteadyDrive:
    """Moves every finger towards where it is closed (positive actions) or open (negative ones) at one speed.

    Args:
        closing: of every gripper actuator, +1 where the upper end of its range closes the gripper, else -1.
    """

    def __init__(self, closing: tuple[float, ...]) -> None:
        self._closing = np.array(closing)
        self.current_action: Any = -self._closing

    def format_action(self, action: Array) -> Any:
        """See FingerDrive."""
        moved = self.current_action + STRIDE * np.sign(action) * self._closing
        self.current_action = np.clip(moved, -1.0, 1.0)
        return self.current_action


@dataclass(frozen=True, kw_only=True, eq=False)
class Robot:
    """One arm with its gripper."""

    name: str
    new_spec: Callable[[], Any] = field(repr=False)
    """A fresh mujoco.MjSpec of the robot standing at the origin, facing +x, its arm driven by torques."""
    arm_joints: tuple[str, ...]
    """Hinges one after the other, from the base to the hand."""
    arm_actuators: tuple[str, ...]
    """Torques [N m] of the arm's joints, in their order."""
    gripper_joints: tuple[str, ...]
    gripper_actuators: tuple[str, ...]
    home: Array
    """Joint positions at the start [rad], shape (arm joints,)."""
    gripper_home: Array
    """Finger joint positions at the start, shape (gripper joints,)."""
    grip_site: str
    """Between the fingers: +z is the approach."""
    base_site: str
    """The frame in which actions move the hand."""
    wrist_camera: str
    fingers: tuple[tuple[str, ...], tuple[str, ...]]
    """All geoms of the left and of the right finger that collide."""
    payload: float
    """What it carries [kg]."""
    new_drive: Callable[[], FingerDrive] = field(repr=False)
    """A fresh drive of the fingers."""
    owned: tuple[str, ...] = ()
    """How the names of its bodies begin in a world where they have no common prefix."""
    robosuite: Any = None
    """What only robosuite's arms have: see `pat3d.envs.robots.robosuite_arms`."""


def finger_targets(model: Any, robot: Robot, action: Array, prefix: str = "") -> Array:
    """Controls of the gripper's actuators for targets in [-1, 1], shape (gripper actuators,)."""
    limits = np.array([model.actuator(prefix + name).ctrlrange for name in robot.gripper_actuators])
    return limits.mean(axis=1) + 0.5 * np.ptp(limits, axis=1) * action
