"""Face planes of convex parts: half-space form n . x + d <= 0 inside, and which of several planes a point is beyond."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import area_vectors

_SAME_PLANE = 1e-6
"""Difference of normals, and of offsets as a share of the size, up to which two faces are one."""


def planes(part: ConvexPart) -> NDArray[np.float64]:
    """Outward unit normals n and offsets d [m] of a part's faces, inside where n . x + d <= 0, shape (faces, 4)."""
    corners = part.vertices[part.faces]
    normals = area_vectors(corners)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-12 * lengths.max()
    normals = normals[keep] / lengths[keep, None]
    return np.column_stack([normals, -np.einsum("fi,fi->f", normals, corners[keep].mean(axis=1))])


def face_count(part: ConvexPart) -> int:
    """Flat faces of a part, coplanar triangles as one."""
    size = float(np.ptp(part.bounds, axis=0).max())
    known = planes(part) / [1.0, 1.0, 1.0, size]
    return len(np.unique(np.round(known / _SAME_PLANE), axis=0))


def plane_distances(points: NDArray[np.float64], sides: NDArray[np.float64]) -> NDArray[np.float64]:
    """Largest signed distance of each of `points` [m], shape (n, 3), to the planes `sides`; negative inside."""
    return (points @ sides[:, :3].T + sides[:, 3]).max(axis=1)
