"""Support polygon and static stability: the centre of mass against the hull of the contacts, seen from above."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pat3d.geometry.polygons import polygon_margin
from pat3d.layout.bodies import Placed
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map, top_map

SAMPLES = 40
"""Cells across the body's footprint."""


def support_margin(group: Group, supports: Sequence[Placed], *, gap: float) -> float:
    """How far the centre of mass is inside the support polygon [m]; negative outside.

    Args:
        group: lowered to `gap` from what carries it.
        supports: what it may rest on.
        gap: distance to the supports [m]; contacts are where the map finds at most 1 mm more.
    """
    low, high = group.low, group.high
    cell = float((high - low)[:2].max()) / SAMPLES
    shape = (int((high - low)[0] / cell) + 2, int((high - low)[1] / cell) + 2)
    under = bottom_map(group.members, low[:2], cell, shape, 0.0)
    over = top_map(supports, low[:2], cell, shape, 0.0)
    between = np.where(np.isfinite(under) & np.isfinite(over), under - np.where(np.isfinite(over), over, 0.0), np.inf)
    touching = between < max(gap, float(between.min())) + 1e-3
    points = low[:2] + cell * np.argwhere(touching & np.isfinite(between))
    return polygon_margin(points, group.centre_of_mass[:2], tolerance=cell)
