"""Lowering a body onto others until a gap remains: conservative advancement along the vertical.

Two convex parts that are s apart along a unit vector n cannot come nearer than `gap` before moving (s - gap) / |n_z|
towards each other along z, so steps of that length never pass through. n is the direction between the closest points
that fcl finds, or z itself, whichever allows more; s is measured on the vertices, since fcl's own distance of nearly
parallel faces can be a millimetre too large.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pat3d.layout.bodies import Placed, distance, part_distance

TOLERANCE = 5e-5
"""A cast ends when no pair allows a longer step than this [m]."""


def fall(body: Placed, obstacles: Sequence[Placed], *, floor: float, gap: float, upwards: bool = False) -> float:
    """How far `body` moves down (or up) until it is `gap` [m] from an obstacle or from the plane z = floor.

    Args:
        body: at a start where it is at least `gap` from every obstacle.
        obstacles: what may stop it.
        floor: height of the plane below (above, when `upwards`) [m]; infinite for none.
        gap: distance kept [m].
        upwards: cast upwards instead.

    Returns:
        The distance [m]; 0 where it cannot move.
    """
    sign = 1.0 if upwards else -1.0
    limit = max(0.0, (floor - float(body.high[2])) if upwards else (float(body.low[2]) - floor)) - gap
    pairs = [(other, i, j) for other in obstacles for i, j in _column_pairs(body, other, gap, sign)]
    moved = 0.0
    for _ in range(200):
        here = body.shifted(np.array([0.0, 0.0, sign * moved])) if moved else body
        step = limit - moved
        for other, i, j in pairs:
            if sign < 0:
                between = here.part_low[i, 2] - other.part_high[j, 2]
            else:
                between = other.part_low[j, 2] - here.part_high[i, 2]
            if between - gap >= step:
                continue
            closest = part_distance(here.part(i), other.part(j))
            if closest.distance <= 0.0:
                return max(0.0, moved - gap)
            normal = (closest.second - closest.first) / closest.distance
            # Towards the other body is positive.
            toward = sign * normal[2]
            if toward <= 1e-6:
                continue
            apart = (other.part_vertices(j) @ normal).min() - (here.part_vertices(i) @ normal).max()
            step = min(step, max((float(apart) - gap) / toward, float(between) - gap))
        if step <= TOLERANCE:
            return max(0.0, moved + min(step, 0.0))
        moved += step
    return moved


def clear(body: Placed, obstacles: Sequence[Placed], gap: float) -> bool:
    """Whether `body` is at least `gap` [m] from every obstacle."""
    return all(distance(body, other, gap) is None for other in obstacles)


def _column_pairs(body: Placed, other: Placed, gap: float, sign: float) -> list[tuple[int, int]]:
    """Pairs of parts of which one is in the other's vertical column and not already behind it."""
    if np.any(body.low[:2] - gap > other.high[:2]) or np.any(other.low[:2] - gap > body.high[:2]):
        return []
    apart = np.maximum(
        body.part_low[:, None, :2] - other.part_high[None, :, :2],
        other.part_low[None, :, :2] - body.part_high[:, None, :2],
    ).max(axis=-1)
    if sign < 0:
        ahead = body.part_high[:, None, 2] > other.part_low[None, :, 2]
    else:
        ahead = body.part_low[:, None, 2] < other.part_high[None, :, 2]
    return [(int(i), int(j)) for i, j in np.argwhere((apart < gap) & ahead)]
