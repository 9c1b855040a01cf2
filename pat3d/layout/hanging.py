"""Hanging a group under another: the highest free place below a branch, a bar or a hook."""

from __future__ import annotations

import numpy as np

from pat3d.errors import LayoutError
from pat3d.layout.bodies import distance
from pat3d.layout.drop import clear, fall
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map, resting_heights, top_map

CELLS = 48
"""Positions tried across the carrier."""
CLEARANCE = 0.02
"""Height that hanging things keep from the ground [m]."""


def hang(group: Group, carrier: Group, *, gap: float) -> Group:
    """`group`, whose root's origin is at zero, with its top `gap` [m] below the underside of `carrier`'s root.

    Raises:
        LayoutError: no place under the carrier is high enough.
    """
    root = carrier.root
    cell = float((root.high - root.low)[:2].max()) / CELLS
    counts = np.maximum(1, ((root.high - root.low)[:2] / cell).astype(int))
    corner = (root.low + root.high)[:2] / 2 - cell * (counts - 1) / 2
    before = np.ceil((-group.low[:2] + gap + cell) / cell).astype(int)
    shape = tuple(before + np.ceil((group.high[:2] + gap + cell) / cell).astype(int) + 1)
    upper = top_map(group.members, -cell * before, cell, shape, gap + cell / 2)
    under = bottom_map([root], corner - cell * before, cell, tuple(counts + np.array(shape) - 1), cell / 2)
    heights = -resting_heights(-under, -upper) - gap
    x, y = (corner[k] + cell * np.arange(counts[k]) for k in range(2))
    spots = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    middle = (root.low + root.high)[:2] / 2
    allowed = np.isfinite(heights) & (heights + group.low[2] > root.low[2] + CLEARANCE)
    # The whole upper edge wants something level above it (a branch along it), halfway out, rather in front.
    edge = np.argwhere(upper > group.high[2] - 0.01)
    rows, columns = heights.shape
    over = np.mean([under[i : i + rows, j : j + columns] for i, j in edge], axis=0)
    out = np.abs(np.linalg.norm(spots - middle, axis=-1) - 0.25 * float((root.high - root.low)[:2].max()))
    cost = over - np.where(allowed, heights, 0.0) + 0.1 * out + 0.03 * (spots[..., 1] - middle[1])
    cost = np.where(allowed, cost, np.inf)
    for index in np.argsort(cost, axis=None)[:24]:
        i, j = np.unravel_index(index, cost.shape)
        if not np.isfinite(cost[i, j]):
            break
        start = group.shifted(np.array([*spots[i, j], heights[i, j] - 1e-3]))
        if all(clear(member, carrier.members, gap - 2e-4) for member in start.members):
            rise = min(
                fall(member, [root], floor=float(root.high[2]), gap=gap, upwards=True) for member in start.members
            )
            hung = start.shifted(np.array([0.0, 0.0, rise]))
            if any(distance(member, root, 2 * gap) for member in hung.members):
                return hung
    raise LayoutError(
        f'"{group.name}" ({group.size[2]:.2f} m high) cannot hang from "{carrier.name}": nothing of it is that high '
        "above the ground with free air below. Nothing was written."
    )
