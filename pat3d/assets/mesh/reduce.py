"""Reduction of convex hulls: fewer vertices, the original contained, support faces kept.

Edges are replaced by points outside (`collapse`), short ones however few vertices there are, so that what is left is
well spaced. A point that replaces corners of a support face stays in its plane. At last every corner moves in as far as
the faces around it stay outside the original (`tighten`).
"""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from pat3d.assets.mesh.collapse import Kept, collapsed, edge_lengths
from pat3d.assets.mesh.tighten import tightened
from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.normals import triangle_areas

SHORT_EDGE = 0.01
"""Edges shorter than this fraction of the hull's longest side are removed."""

_START_PLANES = 120
"""Hulls with more corners than twice this start from that many of their supporting planes."""


def reduce_hull(points: NDArray[np.float64], max_vertices: int = 64, max_faces: int = 64) -> ConvexPart:
    """A convex part of few, well-spaced vertices that contains the hull of `points`.

    Large flat faces of the hull, above all those that face straight down and up, keep their planes. A
    hull that is within the limits and has no short edges is returned as it is.

    Args:
        points: [m], shape (n, 3).
        max_vertices: most vertices of the part, at least 4.
        max_faces: most triangles of the part, at least 4; a triangulated polyhedron has twice its vertices less 4.

    Raises:
        AssetError: the points span no volume, or the limits admit no polyhedron.
    """
    if min(max_vertices, max_faces) < 4:
        raise AssetError(f"a convex part needs 4 vertices and 4 faces, not {max_vertices} and {max_faces}.")
    limit = min(max_vertices, (max_faces + 4) // 2)
    part = convex_part(points)
    middle = part.bounds.mean(axis=0)
    size = float(np.ptp(part.bounds, axis=0).max())
    corners = (part.vertices - middle) / size
    hull = ConvexHull(corners)
    short = _short_edge(corners, hull)
    if len(corners) <= limit and edge_lengths(hull).min() >= short:
        return part
    kept = Kept(planes=_support_planes(hull), low=float(corners[:, 2].min()), high=float(corners[:, 2].max()))
    start = corners
    if len(corners) > 2 * _START_PLANES:
        start = _few_planes(corners, hull, kept.planes)
    reduced = collapsed(start, kept, limit, short)
    slack = 0.0
    while _unfinished(reduced, limit, short) and not slack:
        # The least important support face gives way; at last, by a hair, the lowest and highest levels.
        slack = 0.0 if len(kept.planes) else 0.1 * short
        kept = Kept(planes=kept.planes[:-1], low=kept.low - slack, high=kept.high + slack)
        reduced = collapsed(reduced, kept, limit, short)
    if len(reduced) > limit:
        reduced = _bounding_box(corners)
    reduced = tightened(reduced, corners, kept, short)
    return _containing(reduced * size + middle, part.vertices)


def _support_planes(hull: ConvexHull) -> NDArray[np.float64]:
    """Planes (outward normal, offset) worth keeping, most important first, shape (planes, 4)."""
    planes, group = _merged_planes(hull.equations)
    corners = hull.points[hull.simplices]
    areas = triangle_areas(corners)
    area = np.bincount(group, weights=areas, minlength=len(planes)) / areas.sum()
    upright = np.abs(planes[:, 2]) > 1 - 1e-9
    wanted = np.flatnonzero((area > 0.05) | (upright & (area > 0.005)))
    order = sorted(wanted, key=lambda k: (not upright[k], -area[k]))[:8]
    planes = planes[order]
    snapped = np.round(planes[:, :3])
    aligned = np.abs(planes[:, :3] - snapped).max(axis=1, initial=0.0) < 1e-9
    planes[aligned, :3] = snapped[aligned]
    # Rounded bottoms and tops become level faces, so that a part is as high as the hull.
    lowest = [0.0, 0.0, -1.0, hull.min_bound[2]]
    highest = [0.0, 0.0, 1.0, -hull.max_bound[2]]
    level = [plane for plane in (lowest, highest) if not (planes[:, 2] == plane[2]).any()]
    planes = np.array([*level, *planes])
    return planes


def _merged_planes(equations: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Distinct planes and, for each equation, the index of its plane."""
    _, first, group = np.unique(np.round(equations, 6), axis=0, return_index=True, return_inverse=True)
    return equations[first], group.reshape(-1)


def _few_planes(corners: NDArray[np.float64], hull: ConvexHull, supports: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the intersection of some supporting half-spaces, spread over the directions of the faces."""
    normals = hull.equations[:, :3]
    chosen = [*supports[:, :3], *np.eye(3), *-np.eye(3)]
    similarity = (normals @ np.array(chosen).T).max(axis=1)
    while len(chosen) < _START_PLANES and similarity.min() < 1 - 1e-4:
        chosen.append(normals[np.argmin(similarity)])
        similarity = np.maximum(similarity, normals @ chosen[-1])
    directions = np.array(chosen)
    offsets = (corners @ directions.T).max(axis=0)
    try:
        points = HalfspaceIntersection(np.column_stack([directions, -offsets]), corners.mean(axis=0)).intersections
        # Corners of the intersection coincide where more than three planes meet.
        points = np.unique(np.round(points, 13), axis=0)
        return points[ConvexHull(points).vertices]
    except QhullError:
        return corners


def _short_edge(corners: NDArray[np.float64], hull: ConvexHull) -> float:
    """Length below which an edge of a hull of unit size is removed; well below the thickness of a thin hull."""
    largest = np.argsort(-triangle_areas(corners[hull.simplices]))[:200]
    depth = -(corners @ hull.equations[largest, :3].T + hull.equations[largest, 3]).min(axis=0)
    return min(SHORT_EDGE, 0.2 * float(depth.min()))


def _unfinished(corners: NDArray[np.float64], limit: int, short: float) -> bool:
    return len(corners) > limit or bool(edge_lengths(ConvexHull(corners)).min() < short)


def _bounding_box(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    low, high = corners.min(axis=0), corners.max(axis=0)
    return np.array(list(itertools.product(*zip(low, high, strict=True))))


def _containing(reduced: NDArray[np.float64], original: NDArray[np.float64]) -> ConvexPart:
    """The part with vertices `reduced`, grown by rounding errors until it contains `original`."""
    part = convex_part(reduced)
    hull = ConvexHull(part.vertices)
    depth = -(hull.equations[:, :3] @ part.vertices.mean(axis=0) + hull.equations[:, 3]).max()
    outside = float((original @ hull.equations[:, :3].T + hull.equations[:, 3]).max())
    if outside <= 1e-12 * depth:
        return part
    centre = part.vertices.mean(axis=0)
    return convex_part(centre + (part.vertices - centre) * (1.0 + 2.0 * outside / depth))
