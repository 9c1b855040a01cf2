"""Convex pieces that few vertices fit: what a reduced part would stick out of is cut in two, and again.

A polyhedron of 64 triangles around a cylinder has 17 sides, whose corners are 1.7 % of the radius beyond it at best;
around a ball they are 8 %. A half needs half as many sides, so its part sticks out by a quarter of that.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.mesh.inflation import inflation
from pat3d.assets.mesh.reduce import reduce_hull
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart

MOST, MOST_SHARE, LEAST = 1e-3, 0.01, 2e-4
"""A part may stick out of its piece by a millimetre [m] and by this share of the object's size, or by the least [m]."""

CUTS = 4
"""A piece is cut so many times at most, into up to 16: parts cost time in every stage and every engine."""

_FLAT = 0.08
"""Share of the surface from which a face is flat, not part of a curved side."""


def allowed(size: float) -> float:
    """How far parts of an object of longest side `size` may stick out of their pieces, both in metres."""
    return max(min(MOST, MOST_SHARE * size), LEAST)


@dataclass(frozen=True, kw_only=True, eq=False)
class Fitted:
    """A convex piece and the part that stands for it."""

    points: NDArray[np.float64]
    """[m], shape (n, 3)."""
    part: ConvexPart
    cuts: int = 0
    """How many times the piece was cut from another."""

    @property
    def excess(self) -> float:
        """How far the part sticks out of the piece [m]."""
        return inflation(self.part, self.points).distance


def fitted(pieces: Sequence[NDArray[np.float64]], limit: float, most: int, cuts: int = CUTS) -> list[Fitted]:
    """Convex pieces whose reduced parts stick out by at most `limit`, if `most` pieces and `cuts` suffice.

    The piece whose part sticks out most is cut in two, until none does or there are `most`.

    Args:
        pieces: points of each [m], shape (n, 3).
        limit: [m].
        most: pieces to end with; those given may be more.
        cuts: most times that a piece is cut.

    Returns:
        The pieces; their hulls together are the hulls of what was given.
    """
    done = [Fitted(points=points, part=reduce_hull(points)) for points in pieces]
    waiting = [(-one.excess, number) for number, one in enumerate(done)]
    heapq.heapify(waiting)
    while waiting and len(done) < most:
        excess, number = heapq.heappop(waiting)
        if -excess <= limit:
            break
        if done[number].cuts == cuts:
            continue
        try:
            halves = [
                Fitted(points=half, part=reduce_hull(half), cuts=done[number].cuts + 1)
                for half in _halves(done[number].points)
            ]
        except (QhullError, AssetError):
            continue
        for place, half in zip((number, len(done)), halves, strict=True):
            done[place : place + 1] = [half]
            heapq.heappush(waiting, (-half.excess, place))
    return done


def _halves(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Both sides of the plane through the middle across the axis along which curved sides turn most."""
    hull = ConvexHull(points)
    corners = points[hull.simplices]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    _, plane = np.unique(np.round(hull.equations, 6), axis=0, return_inverse=True)
    share = np.bincount(plane.reshape(-1), weights=areas) / areas.sum()
    curved = np.where(share[plane.reshape(-1)] < _FLAT, areas, 0.0)
    turning = curved @ hull.equations[:, :3] ** 2
    size = np.ptp(points, axis=0)
    axis = int(np.argmax(turning * size))
    at = float(points[:, axis].min() + size[axis] / 2)
    used = points[hull.vertices]
    edges = np.unique(np.sort(hull.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    first, second = points[edges[:, 0]], points[edges[:, 1]]
    a, b = first[:, axis] - at, second[:, axis] - at
    crossing = a * b < 0.0
    t = (a[crossing] / (a[crossing] - b[crossing]))[:, None]
    seam = first[crossing] + t * (second[crossing] - first[crossing])
    seam[:, axis] = at
    return np.concatenate([used[used[:, axis] <= at], seam]), np.concatenate([used[used[:, axis] >= at], seam])
