"""How a reset moves what stands on a workbench: every group that touches, as a whole, shifted and turned on it.

What is in equilibrium on level ground is so anywhere else on it, turned about the vertical: shift and turn leave
gravity, contacts and friction cones as they were. So nothing has to settle again, and the scene stays the verified one.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

TURN = 10.0
"""A group that may be shifted by a metre along an axis may be turned by so many radians, and by half a turn at most."""

GAP = 0.01
"""Kept at least between a group that was moved and everything else [m]; fingers take what stands there."""

TRIES = 30
"""Poses that are drawn before a group is left where it was."""

LARGEST = 0.15
"""Shift that may be asked for [m]."""


def vary(simulation: Any, random: np.random.Generator, strength: float) -> dict[str, tuple[float, float, float]]:
    """Move the groups of objects in a simulation that was just reset; `restart` it afterwards.

    A group that would come near something else, or touch a robot, is drawn again. On scenes that stand on no workbench,
    and of groups with a fixed object, nothing is moved.

    Args:
        simulation: of a world with a robot.
        random: what is drawn comes from it.
        strength: largest shift along x and along y [m].

    Returns:
        Shift along x and y [m] and turn [rad] about the group's middle of every object that was moved.
    """
    import mujoco

    world, model, data = simulation.world, simulation.model, simulation.data
    if not strength or world.placement.bench is None:
        return {}
    mujoco.mj_fwdPosition(model, data)
    moved: dict[str, tuple[float, float, float]] = {}
    for group in _groups(world, data):
        names = [world.scene.objects[number].name for number in group]
        if any(world.scene.objects[number].fixed for number in group):
            continue
        firsts = [int(world.positions[world.objects.index(name)]) for name in names]
        kept = data.qpos.copy()
        middle = np.mean([kept[first : first + 2] for first in firsts], axis=0)
        for _ in range(TRIES):
            x, y = random.uniform(-strength, strength, 2).tolist()
            yaw = float(random.uniform(-1.0, 1.0) * min(TURN * strength, math.pi))
            for first in firsts:
                _shift(data.qpos[first : first + 7], middle, x, y, yaw)
            mujoco.mj_fwdPosition(model, data)
            if not simulation.touching and _free(world, model, data, group):
                moved |= dict.fromkeys(names, (x, y, yaw))
                break
            data.qpos[:] = kept
            mujoco.mj_fwdPosition(model, data)
    return moved


def _groups(world: Any, data: Any) -> list[list[int]]:
    """Numbers of the objects that touch one another, directly or through others; in the order of the scene."""
    group = list(range(len(world.scene.objects)))
    for first, second in world.owner[data.contact.geom].tolist() if data.ncon else []:
        if first >= 0 and second >= 0 and group[first] != group[second]:
            old, new = max(group[first], group[second]), min(group[first], group[second])
            group = [new if one == old else one for one in group]
    return [[number for number, one in enumerate(group) if one == leader] for leader in sorted(set(group))]


def _shift(pose: Array, middle: Array, x: float, y: float, yaw: float) -> None:
    """Turn a pose (position, wxyz) by `yaw` about the vertical through `middle` and shift it, in place."""
    import mujoco

    turn, turned = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]), np.zeros(4)
    c, s = math.cos(yaw), math.sin(yaw)
    away_x, away_y = pose[:2] - middle
    pose[:2] = middle + [c * away_x - s * away_y + x, s * away_x + c * away_y + y]
    mujoco.mju_mulQuat(turned, turn, pose[3:7])
    pose[3:7] = turned


def _free(world: Any, model: Any, data: Any, group: list[int]) -> bool:
    """Whether no other object is within GAP of a group."""
    import mujoco

    solid = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    own = np.flatnonzero(solid & np.isin(world.owner, group))
    others = np.flatnonzero(solid & (world.owner >= 0) & ~np.isin(world.owner, group))
    if not len(others):
        return True
    centres, reach = data.geom_xpos, model.geom_rbound
    for geom in own.tolist():
        apart = np.linalg.norm(centres[others] - centres[geom], axis=1) - reach[others] - reach[geom]
        for other in others[apart < GAP].tolist():
            if mujoco.mj_geomDistance(model, data, geom, other, GAP, None) < GAP:
                return False
    return True
