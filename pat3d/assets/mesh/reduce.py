"""Reduction of convex hulls: fewer vertices, the original contained, support faces kept.

An edge of the hull is replaced by one point that lies outside every face around the edge, placed where
the volume that this adds is least (progressive hulls, Sander et al. 2000); the hull of the points that
remain contains the one before. The best edge goes first, and short edges go however few vertices there
are, so what is left is well spaced. A point that replaces corners of a support face stays in its plane.
At last every corner moves in as far as the faces around it stay outside the original (a linear program each).
"""

from __future__ import annotations

import functools
import heapq
import itertools
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, HalfspaceIntersection, QhullError

from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.normals import triangle_areas

SHORT_EDGE = 0.01
"""Edges shorter than this fraction of the hull's longest side are removed."""

_COPLANAR = 1e-7
"""Planes of a hull of unit size closer than this are one."""

_NEAR_LEVEL = 0.05
"""Edges closer than this to the lowest or highest level may be replaced by a point on it (unit size)."""

_DEAR = 1e-4
"""Cost above which a short edge stays (unit size)."""

_REACH = 0.3
"""Distance from the corners of the faces around an edge beyond which its point costs more (unit size)."""

_SWEEPS = 6

_START_PLANES = 80
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
    if len(corners) <= limit and _edge_lengths(corners, hull).min() >= short:
        return part
    supports = _support_planes(hull)
    bounds = (float(corners[:, 2].min()), float(corners[:, 2].max()))
    start = corners
    if len(corners) > 2 * _START_PLANES:
        start = _few_planes(corners, hull, supports)
    reduced = _collapse(start, supports, bounds, limit, short)
    slack = 0.0
    while _unfinished(reduced, limit, short) and not slack:
        # The least important support face gives way; at last, by a hair, the lowest and highest levels.
        slack = 0.0 if len(supports) else 0.1 * short
        supports = supports[:-1]
        bounds = (bounds[0] - slack, bounds[1] + slack)
        reduced = _collapse(reduced, supports, bounds, limit, short)
    if len(reduced) > limit:
        reduced = _bounding_box(corners)
    reduced = _tightened(reduced, corners, supports, bounds, short)
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


def _edges(hull: ConvexHull) -> NDArray[np.integer[Any]]:
    pairs = np.sort(hull.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    return np.unique(pairs, axis=0)


def _edge_lengths(corners: NDArray[np.float64], hull: ConvexHull) -> NDArray[np.float64]:
    edges = _edges(hull)
    return np.linalg.norm(corners[edges[:, 0]] - corners[edges[:, 1]], axis=1)


def _unfinished(corners: NDArray[np.float64], limit: int, short: float) -> bool:
    return len(corners) > limit or bool(_edge_lengths(corners, ConvexHull(corners)).min() < short)


def _collapse(
    corners: NDArray[np.float64], supports: NDArray[np.float64], bounds: tuple[float, float], limit: int, short: float
) -> NDArray[np.float64]:
    """Corners left once `limit` holds and no edge below `short` can go (unit size), shape (n, 3)."""
    points = dict(enumerate(corners))
    changed = dict.fromkeys(points, 0)
    found: dict[tuple[int, int], tuple[float, NDArray[np.float64] | None, int]] = {}
    step = 0
    while len(points) > 4:
        names = list(points)
        array = np.array(list(points.values()))
        try:
            hull = ConvexHull(array)
        except QhullError:
            break
        if len(hull.vertices) < len(names):
            points = {names[k]: array[k] for k in hull.vertices}
            continue
        edges = _edges(hull)
        if len(points) <= limit:
            edges = edges[np.linalg.norm(array[edges[:, 0]] - array[edges[:, 1]], axis=1) < short]
        incident: list[set[int]] = [set() for _ in names]
        for face, triangle in enumerate(hull.simplices.tolist()):
            for corner in triangle:
                incident[corner].add(face)
        held = np.abs(array @ supports[:, :3].T + supports[:, 3]) < _COPLANAR

        def evaluate(i: int, j: int, array=array, hull=hull, incident=incident, held=held, step=step):
            around = sorted(incident[i] | incident[j])
            cost, point = _outer_point(
                array[hull.simplices[around]], hull.equations[around], supports[held[i] | held[j]], bounds
            )
            return cost, point, step

        # Costs of edges whose surroundings changed are estimates until such an edge comes first.
        queue = []
        for i, j in edges.tolist():
            key = (names[i], names[j])
            if key not in found or (
                not np.isfinite(found[key][0]) and found[key][2] < max(changed[key[0]], changed[key[1]])
            ):
                found[key] = evaluate(i, j)
            queue.append((found[key][0], i, j))
        heapq.heapify(queue)
        best = None
        while queue:
            cost, i, j = heapq.heappop(queue)
            key = (names[i], names[j])
            if found[key][2] < max(changed[key[0]], changed[key[1]]):
                found[key] = evaluate(i, j)
                heapq.heappush(queue, (found[key][0], i, j))
                continue
            best = (i, j) if np.isfinite(cost) else None
            break
        if best is None:
            break
        cost, point, _ = found[names[best[0]], names[best[1]]]
        if point is None or (len(points) <= limit and cost > _DEAR):
            break
        step += 1
        for corner in np.unique(hull.simplices[sorted(incident[best[0]] | incident[best[1]])]):
            changed[names[corner]] = step
        for corner in best:
            del points[names[corner]]
        name = len(corners) + step
        points[name], changed[name] = point, step
    return np.array(list(points.values()))


def _outer_point(
    triangles: NDArray[np.float64],
    equations: NDArray[np.float64],
    fixed: NDArray[np.float64],
    bounds: tuple[float, float],
) -> tuple[float, NDArray[np.float64] | None]:
    """The point on planes `fixed` and outside all `equations` that adds the least volume, and its cost.

    Args:
        triangles: faces around an edge, shape (faces, 3, 3).
        equations: their outward planes, shape (faces, 4).
        fixed: planes that must hold the point, shape (planes, 4).
        bounds: least and greatest height of the point.
    """
    areas = triangle_areas(triangles)
    planes = _distinct(equations)
    free = planes
    if len(fixed):
        free = planes[np.abs(planes[:, None] - fixed[None]).max(axis=2).min(axis=1) > _COPLANAR]
    level = np.array([[0.0, 0.0, 1.0, -bounds[0]], [0.0, 0.0, -1.0, bounds[1]]])
    heights = triangles[:, :, 2]
    close = [heights.min() - bounds[0] < _NEAR_LEVEL, bounds[1] - heights.max() < _NEAR_LEVEL]
    candidates = _feasible_corners(np.concatenate([free, level[close]]), fixed)
    candidates = candidates[(candidates[:, 2] >= bounds[0] - 1e-12) & (candidates[:, 2] <= bounds[1] + 1e-12)]
    if not len(candidates):
        return np.inf, None
    gap = candidates @ planes[:, :3].T + planes[:, 3]
    added = (candidates @ equations[:, :3].T + equations[:, 3]) @ areas / 3
    # Needles add little volume and reach far, and where planes are nearly parallel they are hardly above them: squared
    # distances keep them out.
    far = np.linalg.norm(candidates[:, None] - triangles.reshape(1, -1, 3), axis=2).min(axis=1) - _REACH
    cost = added + 0.15 * (gap.max(axis=1) ** 2 + np.maximum(far, 0.0) ** 2)
    best = int(np.argmin(cost))
    return float(cost[best]), _snapped(candidates[best], fixed)


def _feasible_corners(free: NDArray[np.float64], fixed: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of {x: n x + d >= 0 for `free`, = 0 for `fixed` planes}, shape (n, 3): where a linear program ends."""
    wanted = 3 - len(fixed)
    if wanted < 0 or not wanted <= len(free) <= 40:
        return np.zeros((0, 3))
    choice = _combinations(len(free), wanted)
    systems = np.concatenate([np.broadcast_to(fixed, (len(choice), *fixed.shape)), free[choice]], axis=1)
    systems = systems[np.abs(np.linalg.det(systems[:, :, :3])) > 1e-6]
    if not len(systems):
        return np.zeros((0, 3))
    corners = np.linalg.solve(systems[:, :, :3], -systems[:, :, 3:])[:, :, 0]
    return np.asarray(
        corners[(corners @ free[:, :3].T + free[:, 3]).min(axis=1, initial=0.0) > -1e-12], dtype=np.float64
    )


@functools.cache
def _combinations(count: int, size: int) -> NDArray[np.int64]:
    """All choices of `size` out of `count` numbers, one a row."""
    rows = list(itertools.combinations(range(count), size))
    return np.array(rows, dtype=np.int64).reshape(len(rows), size)


def _snapped(point: NDArray[np.float64], fixed: NDArray[np.float64]) -> NDArray[np.float64]:
    """`point` with the coordinate of every axis-aligned plane in `fixed` exact."""
    point = point.copy()
    for plane in fixed:
        axis = int(np.argmax(np.abs(plane[:3])))
        if abs(plane[axis]) == 1.0:
            point[axis] = -plane[3] / plane[axis]
    return point


def _tightened(
    corners: NDArray[np.float64],
    inner: NDArray[np.float64],
    supports: NDArray[np.float64],
    bounds: tuple[float, float],
    short: float,
) -> NDArray[np.float64]:
    """Corners moved in, one at a time, while their hull contains `inner` (unit size)."""
    volume = ConvexHull(corners).volume
    for _ in range(_SWEEPS):
        before = volume
        for index in range(len(corners)):
            hull = ConvexHull(corners)
            if index >= len(corners) or len(hull.vertices) < len(corners):
                break
            point = _inner_point(corners, hull, index, inner, supports, bounds)
            if point is None:
                continue
            moved = corners.copy()
            moved[index] = point
            trial = ConvexHull(moved)
            fits = (inner @ trial.equations[:, :3].T + trial.equations[:, 3]).max() < 1e-12
            spaced = _edge_lengths(moved, trial).min() >= min(short, _edge_lengths(corners, hull).min())
            if fits and spaced and trial.volume < volume and len(trial.vertices) == len(moved):
                corners, volume = moved, trial.volume
        if before - volume < 1e-3 * volume:
            break
    return corners


def _inner_point(
    corners: NDArray[np.float64],
    hull: ConvexHull,
    index: int,
    inner: NDArray[np.float64],
    supports: NDArray[np.float64],
    bounds: tuple[float, float],
) -> NDArray[np.float64] | None:
    """Where corner `index` makes the hull smallest while the faces around it stay outside `inner`.

    The planes through each opposite edge that touch `inner` bound it from below, the faces beyond those
    edges from above.
    """
    around = np.flatnonzero((hull.simplices == index).any(axis=1))
    corner = corners[index]
    lower, gradient = [], np.zeros(3)
    for face in around:
        a, b = corners[[k for k in hull.simplices[face] if k != index]]
        normal = hull.equations[face, :3]
        edge = (b - a) / np.linalg.norm(b - a)
        across = (corner - a) - ((corner - a) @ edge) * edge
        gradient += normal * np.linalg.norm(across) * np.linalg.norm(b - a)
        across /= max(float(np.linalg.norm(across)), 1e-300)
        offsets = inner - a
        down, out = -(offsets @ normal), offsets @ across
        angle = np.arctan2(down, out)[np.hypot(down, out) > 1e-9].min(initial=np.pi / 2)
        tangent = np.cos(angle) * normal + np.sin(angle) * across
        lower.append([*tangent, -tangent @ a])
    beyond = hull.equations[np.setdiff1d(np.unique(hull.neighbors[around]), around)]
    fixed = supports[np.abs(supports[:, :3] @ corner + supports[:, 3]) < _COPLANAR]
    limits = np.concatenate([np.array(lower), -beyond, [[0, 0, 1, -bounds[0]], [0, 0, -1, bounds[1]]]])
    if len(fixed):
        limits = limits[(np.abs(limits[:, :3] @ fixed[:, :3].T) < 1 - 1e-9).all(axis=1)]
    candidates = _feasible_corners(_distinct(limits), fixed)
    if not len(candidates):
        return None
    return _snapped(candidates[int(np.argmin(candidates @ gradient))], fixed)


def _distinct(equations: NDArray[np.float64]) -> NDArray[np.float64]:
    """The planes of `equations`, each once."""
    if not len(equations):
        return equations
    same = np.abs(equations[:, None] - equations[None]).max(axis=2) < _COPLANAR
    return equations[np.argmax(same, axis=1) == np.arange(len(equations))]


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
