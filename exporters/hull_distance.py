"""How far the colliders that a parser found are from an asset's convex parts."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment
from scipy.spatial import ConvexHull, QhullError
from scipy.spatial.distance import cdist

from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.planes import plane_distances, planes
from pat3d.scene.asset import Asset


def hulls_apart(asset: Asset, found: Sequence[NDArray[np.float64]]) -> float:
    """Largest distance of a convex part from the collider that lies nearest, over the object's longest side.

    Corners beyond the other's faces, either way: Hausdorff's distance of convex sets, or less by the slope of a face.
    Infinite where their number differs or one has no corners, NaN where one spans no volume.

    Args:
        asset: with the parts.
        found: corners of each collider [m] in the asset's frame, each of shape (corners, 3).
    """
    if len(found) != len(asset.parts) or any(len(points) == 0 for points in found):
        return math.inf
    here = np.array([part.bounds.ravel() for part in asset.parts])
    there = np.array([np.concatenate([points.min(axis=0), points.max(axis=0)]) for points in found])
    if not np.isfinite(there).all():
        return math.nan
    length = float(asset.size.max())
    worst = 0.0
    for index, other in zip(*linear_sum_assignment(cdist(here, there)), strict=True):
        part, points = asset.parts[index], np.asarray(found[other], dtype=np.float64)
        beyond = plane_distances(points, planes(part)).max()
        short = plane_distances(part.vertices, _sides(points.shape, points.tobytes())).max()
        # max() would drop a NaN that stands second.
        worst = float(np.max([worst, beyond / length, short / length]))
    return worst


@functools.lru_cache(maxsize=4096)
def _sides(shape: tuple[int, int], corners: bytes) -> NDArray[np.float64]:
    """Planes of the hull of corners [m], as `planes` has them, shape (faces, 4); NaN where they span no volume."""
    points = np.frombuffer(corners).reshape(shape)
    try:
        return ConvexHull(points).equations
    except (QhullError, ValueError):
        # That leaves out corners of slivers, which rounding makes, but has a hull where Qhull gives up.
        try:
            return planes(convex_part(points))
        except AssetError:
            return np.full((1, 4), np.nan)
