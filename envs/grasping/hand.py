"""Where the hand is when it takes something."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp

Array = NDArray[np.float64]

Hand = tuple[Array, Array]
"""Position [m] and rotation of the grip site in the world."""


def hand_rotation(closing: float, closing_axis: Sequence[float]) -> Array:
    """Rotation of the grip site, pointing down, whose closing axis lies at angle `closing` [rad]; shape (3, 3)."""
    down = np.array([0.0, 0.0, -1.0])
    along = np.array([math.cos(closing), math.sin(closing), 0.0])
    local = np.array(closing_axis)
    world = np.stack([along, np.cross(down, along), down], axis=1)
    own = np.stack([local, np.cross([0.0, 0.0, 1.0], local), [0.0, 0.0, 1.0]], axis=1)
    return world @ own.T


def hand_pose(grasp: Grasp, tip: float, closing_axis: Sequence[float], *, back: float = 0.0, half: float = 0.0) -> Hand:
    """Position [m] and rotation of the grip site in a grasp, or `back` [m] before it.

    Args:
        grasp: in the world.
        tip: how far the fingertips are beyond the grip site [m].
        closing_axis: of the gripper, in the frame of the grip site.
        back: along the approach.
        half: turn about the approach [rad]: half a turn takes the object with the fingers exchanged.
    """
    rotation = hand_rotation(grasp.closing + half, closing_axis)
    offset = np.array([0.0, 0.0, tip + back])
    if grasp.lean:
        rotation, offset = grasp.turn @ rotation, grasp.turn @ offset
    return np.array(grasp.position) + offset, rotation
