"""What stands against or below another thing of the same surface: leaning on it, or under its overhang.

What leans is stood on end, its thinnest side to what it leans on, and tilted. A ladder on floor and wall of friction mu
stands up to a tilt of atan(2 mu / (1 - mu^2)), 22 degrees at the friction that scenes settle with; it falls back where
its centre of mass is not beyond its lower edge, which thick things only have at a large tilt.
"""

from __future__ import annotations

import math

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import turn
from pat3d.layout.bodies import Array, Body, Placed, distance
from pat3d.layout.drop import clear
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map
from pat3d.layout.shelved import BOUND, STOOD

LEAST_TILT, LARGEST_TILT = math.radians(12.0), math.radians(20.0)
BEYOND = math.radians(6.0)
"""Tilt [rad] beyond the one at which the centre of mass is over the lower edge."""
AIR = 0.005
"""Room [m] above what is under something."""
_TRIED = 15
"""Places across what something is put under."""
_UP = np.array([0.0, 0.0, 1.0])


def leaning_rotation(body: Body, way: Array) -> Array:
    """The rotation matrix, shape (3, 3), with which `body` stands on end and leans towards `way`, shape (3,).

    Raises:
        LayoutError: it is too thick to lean.
    """
    low, high = body.vertices.min(axis=0), body.vertices.max(axis=0)
    size = high - low
    long = 2 if size[2] > 0.999 * size.max() else int(np.argmax(size))
    thin = min((k for k in range(3) if k != long), key=lambda k: float(size[k]))
    # The front (-y), or the top of what lies flat, is turned away from what it leans on.
    sign = 1.0 if thin == 1 else -1.0
    axes = np.zeros((3, 3))
    axes[:, long], axes[:, thin] = _UP, sign * way
    rest = 3 - long - thin
    axes[:, rest] = np.cross(axes[:, (rest + 1) % 3], axes[:, (rest + 2) % 3])
    if body.asset.noun in BOUND and abs(way[0]) > abs(way[1]):
        axes = STOOD
    tilt = max(LEAST_TILT, math.atan2(float(size[thin]), float(size[long])) + BEYOND)
    if tilt > LARGEST_TILT:
        raise LayoutError(
            f'"{body.name}" ({size[long]:.2f} m long, {size[thin]:.2f} m thick) is too thick to lean against anything: '
            "it would stand by itself or slide. Nothing was written."
        )
    return turn(np.cross(_UP, way), tilt) @ axes


def leaning_offset(group: Group, wall: Group, way: Array, gap: float) -> Array:
    """Where the middle of `group`, turned already, is from that of `wall` so that it nearly touches it [m], shape (2,).

    Raises:
        LayoutError: it passes by.
    """
    low_wall = wall.shifted(np.array([0.0, 0.0, gap - float(wall.low[2])]))
    middle = (low_wall.root.low + low_wall.root.high) / 2
    own = (group.root.low + group.root.high) / 2
    start = group.shifted(np.array([*(middle - own)[:2], gap - float(group.low[2])]))
    back = (
        float((start.high - low_wall.low)[:2] @ np.abs(way[:2]))
        if way[:2].sum() > 0
        else float((low_wall.high - start.low)[:2] @ np.abs(way[:2]))
    )
    start = start.shifted(-way * (back + gap))
    furthest = 2.0 * (back + gap) + float(np.linalg.norm(low_wall.size[:2]))
    moved = 0.0
    while moved < furthest:
        here = start.shifted(way * moved)
        free = _distance(here, low_wall) - gap
        if free < 2e-5:
            away = (here.root.low + here.root.high) / 2 - middle
            return away[:2]
        moved += free
    raise LayoutError(f'"{group.name}" finds nothing of "{wall.name}" to lean against. Nothing was written.')


def under_offset(group: Group, cover: Group, gap: float) -> Array:
    """Where the middle of `group` is from that of `cover` so that it has room below it [m], shape (2,).

    Raises:
        LayoutError: it has none.
    """
    over = cover.shifted(np.array([0.0, 0.0, gap - float(cover.low[2])]))
    middle, half = (over.root.low + over.root.high) / 2, (over.root.high - over.root.low) / 2
    own = (group.root.low + group.root.high) / 2
    start = group.shifted(np.array([*(middle - own)[:2], gap - float(group.low[2])]))
    steps = np.stack(np.meshgrid(*[np.linspace(-0.8, 0.8, _TRIED)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    for step in steps[np.argsort(np.linalg.norm(steps, axis=1), kind="stable")]:
        offset = step * half[:2]
        here = start.shifted(np.array([*offset, 0.0]))
        if covered(here.root, over.root, AIR) and all(clear(one, over.members, AIR) for one in here.members):
            return offset
    raise LayoutError(
        f'"{group.name}" ({group.size[0]:.2f} x {group.size[1]:.2f} x {group.size[2]:.2f} m) does not fit under '
        f'"{cover.name}". Nothing was written.'
    )


def covered(body: Placed, cover: Placed, air: float) -> bool:
    """Whether the underside of `cover` is over the centre of mass of `body`, and `air` [m] above its top."""
    above = float(bottom_map([cover], body.centre_of_mass[:2], 1.0, (1, 1), 0.0)[0, 0])
    return math.isfinite(above) and above >= float(body.high[2]) + air


def _distance(group: Group, wall: Group) -> float:
    found = [distance(one, other) for one in group.members for other in wall.members]
    return min(one.distance for one in found if one is not None)
