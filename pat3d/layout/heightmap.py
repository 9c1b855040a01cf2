"""Height maps of convex parts: where can a body come to rest when it is lowered from above?

The top of the obstacles and the underside of a body are sampled on one grid; sliding one over the other
gives the resting height for every position at once. Parts are widened by half a cell (and the body by
the gap it must keep), so a height read from the map is free of intersection up to the sampling.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from pat3d.layout.bodies import Array, Placed

_VERTICAL = 1e-6


def top_map(bodies: Sequence[Placed], origin: Array, cell: float, shape: tuple[int, int], widen: float) -> Array:
    """Highest point of `bodies` over every cell [m], shape `shape`; -inf where there is none.

    Args:
        bodies: what is sampled.
        origin: centre of cell (0, 0) [m], shape (2,).
        cell: spacing [m].
        shape: cells along x and y.
        widen: horizontal radius by which every part grows [m].
    """
    return _sample(bodies, origin, cell, shape, widen, upper=True)


def bottom_map(bodies: Sequence[Placed], origin: Array, cell: float, shape: tuple[int, int], widen: float) -> Array:
    """Lowest point of `bodies` over every cell [m]; +inf where there is none. Arguments as in `top_map`."""
    return _sample(bodies, origin, cell, shape, widen, upper=False)


def resting_heights(top: Array, bottom: Array) -> Array:
    """Height at which a body with underside `bottom` rests on `top`, for every offset of the two maps.

    Args:
        top: heights of the obstacles [m], shape (a + k - 1, b + l - 1).
        bottom: underside relative to the body's origin [m], shape (k, l), inf outside the body.

    Returns:
        Height of the body's origin [m], shape (a, b); -inf where nothing is below.
    """
    rows, columns = top.shape[0] - bottom.shape[0] + 1, top.shape[1] - bottom.shape[1] + 1
    heights = np.full((rows, columns), -np.inf)
    for i, j in np.argwhere(np.isfinite(bottom)):
        np.maximum(heights, top[i : i + rows, j : j + columns] - bottom[i, j], out=heights)
    return heights


def _sample(
    bodies: Sequence[Placed], origin: Array, cell: float, shape: tuple[int, int], widen: float, *, upper: bool
) -> Array:
    field = np.full(shape, -np.inf if upper else np.inf)
    reach = np.array([widen, widen])
    for body in bodies:
        normals_all = body.body.normals @ body.rotation.T
        offsets_all = body.body.offsets + normals_all @ body.position
        first = np.ceil((body.part_low[:, :2] - reach - origin) / cell).astype(int)
        last = np.floor((body.part_high[:, :2] + reach - origin) / cell).astype(int)
        first, last = np.maximum(first, 0), np.minimum(last, np.array(shape) - 1)
        for part in np.flatnonzero(np.all(first <= last, axis=1)):
            (i0, j0), (i1, j1) = first[part], last[part]
            own = body.body.part_faces[part]
            normals, offsets = normals_all[own], offsets_all[own]
            offsets = offsets + widen * np.hypot(normals[:, 0], normals[:, 1])
            x = origin[0] + cell * np.arange(i0, i1 + 1)
            y = origin[1] + cell * np.arange(j0, j1 + 1)
            left = offsets[:, None, None] - normals[:, 0, None, None] * x[:, None] - normals[:, 1, None, None] * y
            up, down = normals[:, 2] > _VERTICAL, normals[:, 2] < -_VERTICAL
            side = ~(up | down)
            high = np.min(left[up] / normals[up, 2, None, None], axis=0)
            low = np.max(left[down] / normals[down, 2, None, None], axis=0)
            inside = (high >= low) & np.all(left[side] >= 0.0, axis=0)
            view = field[i0 : i1 + 1, j0 : j1 + 1]
            if upper:
                np.maximum(view, np.where(inside, np.minimum(high, body.part_high[part, 2]), -np.inf), out=view)
            else:
                np.minimum(view, np.where(inside, np.maximum(low, body.part_low[part, 2]), np.inf), out=view)
    return field
