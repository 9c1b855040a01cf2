"""Making a union of convex parts contain the mesh that people see."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.asset import ConvexPart
from pat3d.assets.reduce import reduce_hull
from pat3d.assets.topology import Indices

TOLERANCE = 1e-5
"""Points of the visual mesh may stick out of the parts by this much [m]."""

MAX_SAMPLES = 100_000
_CHUNK = 20_000


def planes(part: ConvexPart) -> NDArray[np.float64]:
    """Outward unit normals and offsets of a part's faces, inside where n x + d <= 0, shape (faces, 4)."""
    corners = part.vertices[part.faces]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-12 * lengths.max()
    normals = normals[keep] / lengths[keep, None]
    return np.column_stack([normals, -np.einsum("fi,fi->f", normals, corners[keep].mean(axis=1))])


def outside(points: NDArray[np.float64], parts: list[ConvexPart]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """How far each of `points` sticks out of the union of `parts` [m], 0 inside, and its nearest part."""
    distance = np.full(len(points), np.inf)
    nearest = np.zeros(len(points), dtype=np.int64)
    for index, part in enumerate(parts):
        sides = planes(part)
        low, high = part.bounds
        # A point is at least as far from a part as from its bounding box.
        gap = np.maximum(low - points, points - high).max(axis=1)
        chosen = np.flatnonzero((distance > 0.0) & (gap < distance))
        for start in range(0, len(chosen), _CHUNK):
            some = chosen[start : start + _CHUNK]
            depth = (points[some] @ sides[:, :3].T + sides[:, 3]).max(axis=1)
            closer = depth < distance[some]
            distance[some[closer]] = depth[closer]
            nearest[some[closer]] = index
    return np.maximum(distance, 0.0), nearest


def surface_points(vertices: NDArray[np.float64], faces: Indices) -> NDArray[np.float64]:
    """Vertices and evenly spread points of the faces [m], shape (n, 3), at most MAX_SAMPLES and the vertices."""
    used = vertices[np.unique(faces)]
    corners = vertices[faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    spacing = 0.01 * float(np.ptp(used, axis=0).max())
    for _ in range(12):
        steps = np.clip(np.ceil(longest / spacing), 1, 64).astype(int)
        if ((steps + 1) * (steps + 2) // 2).sum() <= MAX_SAMPLES:
            break
        spacing *= 1.5
    else:
        return used
    points = [used]
    for step in np.unique(steps[steps > 1]):
        i, j = np.meshgrid(np.arange(step + 1), np.arange(step + 1), indexing="ij")
        keep = i + j <= step
        weights = np.stack([i[keep], j[keep], step - i[keep] - j[keep]], axis=1) / step
        points.append(np.einsum("wk,fki->fwi", weights, corners[steps == step]).reshape(-1, 3))
    return np.concatenate(points)


def cover(
    hulls: list[NDArray[np.float64]], points: NDArray[np.float64], rounds: int = 4
) -> tuple[list[ConvexPart], float, float]:
    """Reduced parts of point sets `hulls`, grown until they contain `points`.

    A point that sticks out is given to its nearest part.

    Args:
        hulls: points of each part [m], each of shape (n, 3).
        points: to be contained [m], shape (n, 3).
        rounds: most times that parts are grown.

    Returns:
        The parts, how far points stuck out at first and how far they do at the end [m].
    """
    hulls = list(hulls)
    parts = [reduce_hull(hull) for hull in hulls]
    before = after = 0.0
    for attempt in range(rounds + 1):
        distance, nearest = outside(points, parts)
        after = float(distance.max(initial=0.0))
        before = after if attempt == 0 else before
        if after <= TOLERANCE or attempt == rounds:
            break
        stray = distance > 0.1 * TOLERANCE
        for index in np.unique(nearest[stray]):
            hulls[index] = np.concatenate([hulls[index], points[stray & (nearest == index)]])
            parts[index] = reduce_hull(hulls[index])
    return parts, before, after
