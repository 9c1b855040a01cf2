"""Where true surfaces are: the part of a triangle mesh that lies close to one side of a plane.

Convex parts reach beyond the surfaces that people see, so a contact between parts is only a promise. What two bodies
really have near the plane of a contact is a region of that plane for each, its footprint; they can press on each other
where both footprints are.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import manifold3d
import numpy as np
from numpy.typing import NDArray

_UNIT = 1e6
"""Clipping counts in micrometres: its resolution is absolute."""

_BEHIND = 1e-4
"""Surfaces up to this far on the wrong side of the plane [m] are at it: contact points lie midway in their gap."""

_AWAY = 1e-6
"""Cosine from which a face looks away from the plane."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Plane:
    """A plane with axes of its own."""

    axes: NDArray[np.float64]
    """Rows: two directions in the plane, and its unit normal, shape (3, 3)."""
    offset: float
    """Along the normal [m]."""

    @classmethod
    def through(cls, point: NDArray[np.float64], normal: NDArray[np.float64]) -> Plane:
        """The plane through `point` [m] across the unit vector `normal`."""
        axis = np.eye(3)[np.argmin(np.abs(normal))]
        first = np.cross(normal, axis)
        first /= np.linalg.norm(first)
        axes = np.asarray(np.stack([first, np.cross(normal, first), normal]), dtype=np.float64)
        return cls(axes=axes, offset=float(point @ normal))

    def seen(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Coordinates (along, across, height) of `points` [m], shape (..., 3)."""
        local = points @ self.axes.T
        local[..., 2] -= self.offset
        return local

    def lifted(self, flat: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points of the plane with coordinates `flat` [m], shape (n, 2), in the world."""
        return flat @ self.axes[:2] + self.offset * self.axes[2]


class Footprint:
    """What one closed mesh has near a plane, inside a window of it."""

    def __init__(
        self,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int32],
        plane: Plane,
        side: float,
        window: NDArray[np.float64],
        reach: float,
    ) -> None:
        """Find the triangles of a mesh that may matter.

        Args:
            vertices: [m], shape (vertices, 3), in the world.
            faces: counter-clockwise seen from outside, shape (faces, 3).
            plane: that the mesh is near to.
            side: 1 for what lies above the plane, -1 below.
            window: lower and upper corner in the plane [m], shape (2, 2).
            reach: largest distance from the plane that will be asked for [m].
        """
        local = plane.seen(vertices)
        local[:, 2] *= side
        corners = local[faces]
        low, high = corners.min(axis=1), corners.max(axis=1)
        near = (low[:, 2] <= reach) & (high[:, 2] >= -_BEHIND)
        near &= (low[:, :2] <= window[1]).all(axis=1) & (high[:, :2] >= window[0]).all(axis=1)
        corners, self._low, self._high = corners[near], low[near, 2], high[near, 2]
        u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        cross = np.cross(u, v)
        facing = cross[:, 2] * side <= _AWAY * np.linalg.norm(cross, axis=1)
        # Seen from above a face that looks down is clockwise; clipping keeps the order.
        clockwise = cross[:, 2] < 0.0
        corners[clockwise] = corners[clockwise, ::-1]
        self._corners, self._low, self._high = corners[facing], self._low[facing], self._high[facing]
        self._window = window

    def within(self, distance: float) -> manifold3d.CrossSection:
        """The region, in micrometres, where the mesh is at most `distance` [m] from the plane."""
        chosen = (self._low <= distance) & (self._high >= -_BEHIND)
        whole = chosen & (self._high <= distance) & (self._low >= -_BEHIND)
        polygons = list(_UNIT * self._corners[whole][:, :, :2])
        for one in self._corners[chosen & ~whole].tolist():
            cut = _clipped(_clipped(one, 1.0, distance), -1.0, _BEHIND)
            if len(cut) >= 3:
                polygons.append(_UNIT * np.array(cut)[:, :2])
        if not polygons:
            return manifold3d.CrossSection()
        region = manifold3d.CrossSection(polygons, manifold3d.FillRule.NonZero)
        return region ^ rectangle(self._window)


def rectangle(window: NDArray[np.float64]) -> manifold3d.CrossSection:
    """All of a window [m], shape (2, 2), in micrometres."""
    (a, b), (c, d) = _UNIT * window
    return manifold3d.CrossSection([np.array([(a, b), (c, b), (c, d), (a, d)])])


def corners_of(region: Any, directions: int = 16) -> NDArray[np.float64]:
    """Corners [m] of the convex hull of a region in micrometres, the furthest towards some directions, shape (n, 2)."""
    polygons = [one for one in region.hull().to_polygons() if len(one)]
    if not polygons:
        return np.zeros((0, 2))
    points = np.concatenate(polygons)
    angle = 2 * np.pi * np.arange(directions) / directions
    furthest = np.argmax(points @ np.stack([np.cos(angle), np.sin(angle)]), axis=0)
    return np.asarray(points[np.unique(furthest)] / _UNIT, dtype=np.float64)


def _clipped(polygon: list[list[float]], sign: float, limit: float) -> list[list[float]]:
    """The part of a polygon in space, its corners (x, y, height), with `sign` times its height at most `limit`."""
    kept = []
    for k, b in enumerate(polygon):
        a = polygon[k - 1]
        over_a, over_b = sign * a[2] - limit, sign * b[2] - limit
        if (over_a < 0.0 < over_b) or (over_b < 0.0 < over_a):
            t = over_a / (over_a - over_b)
            kept.append([p + t * (q - p) for p, q in zip(a, b, strict=True)])
        if over_b <= 0.0:
            kept.append(b)
    return kept
