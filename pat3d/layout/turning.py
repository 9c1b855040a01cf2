"""Turning what faces something exactly towards it, once everything has its place."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.drop import clear
from pat3d.layout.group import Group

_ENOUGH = math.radians(2.0)
"""What is turned to its target within this [rad] stays as it is."""


def turned_to_targets(groups: Sequence[Group], sights: Sequence[tuple[str, str]], *, gap: float) -> list[Group]:
    """`groups` with every one that has an observer for its root turned to its target, where there is room.

    Args:
        groups: placed side by side.
        sights: observers and targets.
        gap: distance kept [m].
    """
    found = list(groups)
    for observer, target in sights:
        index = next((k for k, group in enumerate(found) if group.name == observer), None)
        bodies = {member.body.name: member for group in found for member in group.members}
        if index is None or target not in bodies:
            continue
        own, there = found[index].root, bodies[target]
        middle = (own.low + own.high) / 2
        way = ((there.low + there.high) / 2 - middle)[:2]
        front = -own.rotation[:2, 1]
        angle = math.atan2(front[0] * way[1] - front[1] * way[0], float(front @ way))
        if abs(angle) < _ENOUGH:
            continue
        rotation = yaw_matrix(angle)
        position = np.array([*(middle - rotation @ middle)[:2], 0.0])
        turned = Group(tuple(member.turned(rotation, position) for member in found[index].members))
        others = [member for k, group in enumerate(found) if k != index for member in group.members]
        if all(clear(member, others, 0.9 * gap) for member in turned.members):
            found[index] = turned
    return found
