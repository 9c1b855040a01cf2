"""Growing a convex decomposition until the union of its parts contains the visual mesh."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.reduce import reduce_hull
from pat3d.assets.mesh.topology import Indices
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.planes import plane_distances, planes

TOLERANCE = 1e-5
"""Points of the visual mesh may stick out of the parts by this much [m]."""

MAX_SAMPLES = 100_000
_CHUNK = 20_000


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
            depth = plane_distances(points[some], sides)
            closer = depth < distance[some]
            distance[some[closer]] = depth[closer]
            nearest[some[closer]] = index
    return np.maximum(distance, 0.0), nearest


def surface_points(vertices: NDArray[np.float64], faces: Indices) -> NDArray[np.float64]:
    """Vertices and evenly spread points of the faces [m], shape (n, 3), at most about MAX_SAMPLES and the vertices."""
    return surface_patches(vertices, faces)[0]


def surface_patches(vertices: NDArray[np.float64], faces: Indices) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The faces cut into small triangles: points [m], shape (n, 3), and triangles of them, shape (m, 3)."""
    used, index = np.unique(faces, return_inverse=True)
    known, index = vertices[used], index.reshape(faces.shape)
    corners = vertices[faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    spacing = 0.01 * float(np.ptp(known, axis=0).max())
    for _ in range(12):
        steps = np.clip(np.ceil(longest / spacing), 1, 64).astype(int)
        if ((steps + 1) * (steps + 2) // 2).sum() <= MAX_SAMPLES:
            break
        spacing *= 1.5
    else:
        return known, index
    points, triangles, count = [known], [index[steps == 1]], len(known)
    for step in np.unique(steps[steps > 1]):
        i, j = np.meshgrid(np.arange(step + 1), np.arange(step + 1), indexing="ij")
        keep = i + j <= step
        number = np.full(keep.shape, -1)
        number[keep] = np.arange(keep.sum())
        weights = np.stack([i[keep], j[keep], step - i[keep] - j[keep]], axis=1) / step
        some = corners[steps == step]
        points.append(np.einsum("wk,fki->fwi", weights, some).reshape(-1, 3))
        up = np.stack([number[:-1, :-1], number[1:, :-1], number[:-1, 1:]], axis=-1).reshape(-1, 3)
        down = np.stack([number[1:, 1:], number[:-1, 1:], number[1:, :-1]], axis=-1).reshape(-1, 3)
        cut = np.concatenate([up, down])
        cut = cut[(cut >= 0).all(axis=1)]
        first = count + len(weights) * np.arange(len(some))
        triangles.append((first[:, None, None] + cut).reshape(-1, 3))
        count += len(weights) * len(some)
    return np.concatenate(points), np.concatenate(triangles)


@dataclass(frozen=True, kw_only=True, eq=False)
class Cover:
    """Parts whose union contains what it should."""

    hulls: list[NDArray[np.float64]]
    """Points that each part was made of, those it was grown by among them [m], each of shape (n, 3)."""
    parts: list[ConvexPart]
    before: float
    """How far points stuck out of the parts at first [m]."""
    after: float
    """How far they do at the end [m]."""


def cover(
    hulls: list[NDArray[np.float64]],
    points: NDArray[np.float64],
    triangles: NDArray[np.int64] | None = None,
    *,
    parts: list[ConvexPart] | None = None,
    rounds: int = 6,
) -> Cover:
    """Reduced parts of point sets `hulls`, grown until they contain `points`, and each triangle as a whole.

    A triangle whose corners are in different parts may stick out between them, so one part gets all three: that which
    is nearest to the furthest of them.

    Args:
        hulls: points of each part [m], each of shape (n, 3).
        points: to be contained [m], shape (n, 3).
        triangles: of the points, to be contained, shape (m, 3); none where None.
        parts: the reduced hulls, where they are known.
        rounds: most times that parts are grown.
    """
    hulls = list(hulls)
    parts = [reduce_hull(hull) for hull in hulls] if parts is None else list(parts)
    alone = np.repeat(np.arange(len(points))[:, None], 3, axis=1)
    wanted = alone if triangles is None else np.concatenate([alone, triangles])
    depth = np.stack([_depth(points, part) for part in parts])
    before = after = 0.0
    for attempt in range(rounds + 1):
        after = max(float(depth.min(axis=0).max(initial=-np.inf)), 0.0)
        before = after if attempt == 0 else before
        distance, nearest = _furthest(depth, wanted)
        if attempt == rounds or distance.max(initial=0.0) <= TOLERANCE:
            break
        stray = distance > 0.1 * TOLERANCE
        for index in np.unique(nearest[stray]):
            given = np.unique(wanted[stray & (nearest == index)])
            hulls[index] = np.concatenate([hulls[index], points[given]])
            parts[index] = reduce_hull(hulls[index])
            depth[index] = _depth(points, parts[index])
    return Cover(hulls=hulls, parts=parts, before=before, after=after)


def _depth(points: NDArray[np.float64], part: ConvexPart) -> NDArray[np.float32]:
    """Largest distance of each point beyond a face of the part [m], or of its bounding box; negative inside."""
    sides = planes(part)
    low, high = part.bounds
    reach = float(np.ptp(part.bounds, axis=0).max())
    found = np.maximum(low - points, points - high).max(axis=1).astype(np.float32)
    chosen = np.flatnonzero(found < 0.5 * reach)
    for start in range(0, len(chosen), _CHUNK):
        some = chosen[start : start + _CHUNK]
        found[some] = plane_distances(points[some], sides)
    return found


def _furthest(
    depth: NDArray[np.float32], triangles: NDArray[np.int64]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """How far each triangle sticks out of the part that it sticks out of least [m], and which part that is."""
    distance = np.full(len(triangles), np.inf)
    nearest = np.zeros(len(triangles), dtype=np.int64)
    for index, one in enumerate(depth):
        out = one[triangles].max(axis=1)
        closer = out < distance
        distance[closer] = out[closer]
        nearest[closer] = index
    return np.maximum(distance, 0.0), nearest
