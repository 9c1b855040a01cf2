"""Masks that end early: how many pixels of every border they leave out, as the depth beside them shows.

Before a background that is farther away, the depth along a border tells on which side of it a pixel lies. Of the pixels
k beyond a mask, with the depth z_in of the object beside them and z_out of what is behind,

    z = z_in + a_k (z_out - z_in)

is fitted over all objects of a picture at once: where a_k is under a half, most of these pixels are the objects'. A
pixel on each side of a pen that is six wide is a third of its size, so this is worth knowing.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.vision.observation import Observation

MOST = 3
"""Pixels by which a border may be moved."""
BEHIND = (3.0, 9.0)
"""Where what is behind is looked for, beyond the pixels that may be the object's [pixel]."""
STEP = 0.03
"""By which what is behind has to be farther away, over the depth."""
LEAST = 40
"""Pixels of all borders that have to show such a step."""
NEARER = 0.12
"""What is nearer by this, over the depth, hides the object, and is not its border."""


def border_lost(seen: Observation) -> int:
    """How many pixels of every border the masks leave out; 0 where the depth cannot tell."""
    from scipy.ndimage import distance_transform_edt

    free = (seen.instances == 0) & seen.known
    depth = np.where(seen.known, seen.depth, 0.0).astype(np.float64)
    products, squares, counts = np.zeros(MOST), np.zeros(MOST), np.zeros(MOST, dtype=int)
    for name in seen.names:
        mask = seen.mask(name)
        rows, columns = np.nonzero(mask)
        margin = int(MOST + BEHIND[1]) + 4
        crop = (slice(max(rows.min() - margin, 0), rows.max() + 1 + margin),
                slice(max(columns.min() - margin, 0), columns.max() + 1 + margin))  # fmt: skip
        own, around, z = mask[crop] & seen.known[crop], free[crop], depth[crop]
        away = np.asarray(distance_transform_edt(~mask[crop]))
        behind = around & (away > MOST + BEHIND[0]) & (away <= MOST + BEHIND[1])
        if not own.any() or not behind.any():
            continue
        inner, outer = (_nearest_mean(z, where) for where in (own, behind))
        for k in range(MOST):
            ring = around & (away > k) & (away <= k + 1)
            step = (outer - inner)[ring]
            clear = step > STEP * inner[ring]
            products[k] += float(np.sum((z[ring] - inner[ring])[clear] * step[clear]))
            squares[k] += float(np.sum(step[clear] ** 2))
            counts[k] += int(np.count_nonzero(clear))
    lost = 0
    while lost < MOST and counts[lost] >= LEAST and products[lost] < 0.5 * squares[lost]:
        lost += 1
    return lost


def bordered(seen: Observation, lost: int) -> Observation:
    """`seen` with every mask grown by `lost` pixels, where no other object and nothing nearer is."""
    if lost == 0:
        return seen
    from scipy.ndimage import distance_transform_edt

    found: Any = distance_transform_edt(seen.instances == 0, return_indices=True)
    away, nearest = found
    depth = np.where(seen.known, seen.depth, 0.0).astype(np.float64)
    inner = _nearest_mean(depth, (seen.instances > 0) & seen.known)
    hidden = seen.known & (seen.smooth_depth < (1.0 - NEARER) * inner)
    grown = (seen.instances == 0) & (away <= lost + 0.5) & ~hidden
    return replace(seen, instances=np.where(grown, seen.instances[tuple(nearest)], seen.instances))


def _nearest_mean(z: NDArray[np.float64], where: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Mean of `z` over those pixels `where` that are near the nearest of them, for every pixel."""
    from scipy.ndimage import distance_transform_edt, uniform_filter

    share = uniform_filter(where.astype(np.float64), size=5, mode="constant")
    mean = uniform_filter(np.where(where, z, 0.0), size=5, mode="constant") / np.maximum(share, 1e-9)
    nearest = np.asarray(distance_transform_edt(~where, return_distances=False, return_indices=True))
    return mean[tuple(nearest)]
