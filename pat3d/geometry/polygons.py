"""Convex polygons in the plane: footprints, the gap between two, whether one contains a point, and how deep inside."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

Array = NDArray[np.float64]

ON_THE_BORDER = 1e-11
"""Points at most this far outside [m] count as on the border: flush boxes differ by rounding."""


def outline(points: Array) -> Array:
    """Corners of the convex hull of points [m], shape (n, 2), counter-clockwise; the two ends of points on a line."""
    try:
        return points[ConvexHull(points).vertices]
    except QhullError:
        return np.stack([points.min(axis=0), points.max(axis=0)])


def polygon_gap(first: Array, second: Array) -> float:
    """Distance [m] between two convex polygons, corners in order, shape (n, 2); 0 where they overlap."""
    return float(shapely.distance(shapely.Polygon(first), shapely.Polygon(second)))


def contains(polygon: Array, point: Array) -> bool:
    """Whether a point, shape (2,), is inside a polygon, corners in order, shape (n, 2), or on its border."""
    return bool(shapely.dwithin(shapely.Polygon(polygon), shapely.Point(point), ON_THE_BORDER))


def polygon_margin(points: Array, centre: Array, *, tolerance: float) -> float:
    """Distance [m] from `centre`, shape (2,), to the border of the hull of `points`, shape (n, 2); negative outside.

    Points on a line or a single point give minus the distance to the nearest, plus `tolerance` [m].
    """
    if len(points) == 0:
        return -np.inf
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return tolerance - float(np.linalg.norm(points - centre, axis=1).min())
    return -float(np.max(hull.equations[:, :2] @ centre + hull.equations[:, 2]))
