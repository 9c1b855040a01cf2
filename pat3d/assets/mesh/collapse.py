"""Edges of a convex hull replaced by points outside of it, until few corners are left.

A point that lies outside every face around an edge takes the place of both its ends: the hull of what is left
contains the hull before (progressive hulls, Sander et al. 2000). It is placed where the volume that it adds is
least, and of the edges that share no face the cheapest go together, so that the hull is made anew some twenty times,
not once an edge. Everything is of unit size.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.mesh.linear_programs import minima
from pat3d.geometry.normals import triangle_areas

COPLANAR = 1e-7
"""Planes closer than this are one."""

_DEAR = 1e-4
"""Cost above which a short edge stays."""

_REACH = 0.3
"""Distance from the corners of the faces around an edge beyond which its point costs more.
It stays within twice that of the hull."""

_SHARE = 4
"""One in so many of the corners that are too many goes at a time."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Kept:
    """What a reduced hull keeps of the hull that it stands for."""

    planes: NDArray[np.float64]
    """Of faces that keep their planes (outward normal, offset), most important first, shape (planes, 4)."""
    low: float
    """Least height of a corner."""
    high: float
    """Greatest height of a corner."""

    def held(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of the planes hold which of `points`, shape (points, planes)."""
        return np.abs(points @ self.planes[:, :3].T + self.planes[:, 3]) < COPLANAR

    def parallel(self, sides: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Which of the planes are those of `sides`, shape (sides, planes)."""
        return np.abs(sides[:, None] - self.planes[None]).max(axis=2) < COPLANAR

    def snapped(self, points: NDArray[np.float64], held: NDArray[np.bool_]) -> NDArray[np.float64]:
        """`points` with the coordinate of every axis-aligned plane that holds them exact."""
        points = points.copy()
        for plane, on in zip(self.planes, held.T, strict=True):
            axis = int(np.argmax(np.abs(plane[:3])))
            if abs(plane[axis]) == 1.0:
                points[on, axis] = -plane[3] / plane[axis]
        for level in (self.low, self.high):
            points[np.abs(points[:, 2] - level) < 1e-12, 2] = level
        return points


def edges_of(hull: ConvexHull) -> NDArray[np.int64]:
    """Ends of every edge, shape (edges, 2)."""
    pairs = np.sort(hull.simplices[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    count = len(hull.points)
    code = np.unique(pairs[:, 0] * count + pairs[:, 1])
    return np.column_stack([code // count, code % count])


def edge_lengths(hull: ConvexHull) -> NDArray[np.float64]:
    """Of every edge of `edges_of`."""
    edges = edges_of(hull)
    return np.linalg.norm(hull.points[edges[:, 0]] - hull.points[edges[:, 1]], axis=1)


def collapsed(corners: NDArray[np.float64], kept: Kept, limit: int, short: float) -> NDArray[np.float64]:
    """Corners left once there are at most `limit` and no edge below `short` can go, shape (n, 3).

    There are more where no edge can go any more.
    """
    points = corners
    known = _Known(corners=points)
    while len(points) > 4:
        try:
            hull = ConvexHull(points)
        except QhullError:
            break
        if len(hull.vertices) < len(points):
            keep = np.sort(hull.vertices).astype(np.int64)
            points = points[keep]
            known.keep(keep)
            continue
        edges = edges_of(hull)
        many = len(points) - limit
        if many <= 0:
            edges = edges[np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1) < short]
        around = _around(hull)
        known.see(hull)
        new = edges[np.isnan(known.cost[edges[:, 0], edges[:, 1]])]
        if len(new):
            cost, outer = _outer_points(hull, around, new, kept)
            known.cost[new[:, 0], new[:, 1]], known.point[new[:, 0], new[:, 1]] = cost, outer
        cost = known.cost[edges[:, 0], edges[:, 1]]
        chosen = _apart(edges, cost, around, many)
        if not len(chosen):
            break
        ends = edges[chosen]
        stay = np.setdiff1d(np.arange(len(points)), ends)
        points = np.concatenate([points[stay], known.point[ends[:, 0], ends[:, 1]]])
        known.replace(stay, len(chosen))
    return points


class _Known:
    """Costs and points of edges, by the indices of their ends, as long as the faces around them stay."""

    def __init__(self, *, corners: NDArray[np.float64]) -> None:
        count = len(corners)
        self.names = np.arange(count)
        self.cost = np.full((count, count), np.nan)
        self.point = np.zeros((count, count, 3))
        self._faces: NDArray[np.int64] | None = None

    def see(self, hull: ConvexHull) -> None:
        """Forget the edges at corners whose faces are not those of the hull before."""
        named = np.sort(self.names[hull.simplices], axis=1).astype(np.int64)
        code = (named[:, 0] << 42) + (named[:, 1] << 21) + named[:, 2]
        if self._faces is not None:
            changed = np.unique(hull.simplices[~np.isin(code, self._faces)])
            self.cost[changed] = self.cost[:, changed] = np.nan
        self._faces = code

    def keep(self, stay: NDArray[np.int64]) -> None:
        """Renumber the corners: those of `stay` are left."""
        self.names = self.names[stay]
        self.cost, self.point = self.cost[np.ix_(stay, stay)], self.point[np.ix_(stay, stay)]

    def replace(self, stay: NDArray[np.int64], added: int) -> None:
        """Renumber the corners: those of `stay`, then `added` new ones."""
        first = int(self.names.max()) + 1
        self.keep(stay)
        self.names = np.concatenate([self.names, first + np.arange(added)])
        self.cost = np.pad(self.cost, (0, added), constant_values=np.nan)
        self.point = np.pad(self.point, ((0, added), (0, added), (0, 0)))


def _around(hull: ConvexHull) -> NDArray[np.bool_]:
    """Which faces are at which corner, shape (corners, faces)."""
    incident = np.zeros((len(hull.points), len(hull.simplices)), dtype=bool)
    incident[hull.simplices.T, np.arange(len(hull.simplices))] = True
    return incident


def _apart(
    edges: NDArray[np.int64], cost: NDArray[np.float64], around: NDArray[np.bool_], many: int
) -> NDArray[np.int64]:
    """The cheapest edges that share no face around them: some of those wanted, or all that are short."""
    wanted = max(1, -(-many // _SHARE)) if many > 0 else len(edges)
    order = np.argsort(cost, kind="stable")
    order = order[np.isfinite(cost[order]) if many > 0 else cost[order] <= _DEAR][: 2 * wanted]
    chosen: list[int] = []
    taken = np.zeros(around.shape[1], dtype=bool)
    for index in order.tolist():
        faces = around[edges[index, 0]] | around[edges[index, 1]]
        if not (faces & taken).any():
            chosen.append(index)
            taken |= faces
        if len(chosen) == wanted:
            break
    return np.array(chosen, dtype=np.int64)


def _outer_points(
    hull: ConvexHull, around: NDArray[np.bool_], edges: NDArray[np.int64], kept: Kept
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """For every edge the point outside the faces around it that adds the least volume, and its cost; inf for none."""
    points, simplices, count = hull.points, hull.simplices, len(edges)
    faces = around[edges[:, 0]] | around[edges[:, 1]]
    rows, columns = np.nonzero(faces)
    areas = triangle_areas(points[simplices])
    weighted = faces.astype(np.float64) @ (areas[:, None] * hull.equations)
    held = kept.held(points)
    fixed = held[edges[:, 0]] | held[edges[:, 1]]
    normals, offsets = _gathered(hull.equations, rows, columns, fixed, kept)
    walls = np.concatenate([np.eye(3), -np.eye(3)])
    low, high = points.min(axis=0) - 2.0 * _REACH, points.max(axis=0) + 2.0 * _REACH
    low[2], high[2] = kept.low, kept.high
    on = np.where(fixed[:, :, None], kept.planes[None], 0.0)
    found, good = minima(
        np.concatenate([normals, on[:, :, :3], -on[:, :, :3], np.broadcast_to(walls, (count, 6, 3))], axis=1),
        np.concatenate([offsets, on[:, :, 3], -on[:, :, 3], np.broadcast_to([*-low, *high], (count, 6))], axis=1),
        weighted[:, :3],
    )
    found = kept.snapped(found, fixed)
    added = (np.einsum("ei,ei->e", found, weighted[:, :3]) + weighted[:, 3]) / 3.0
    gap = (np.einsum("eki,ei->ek", normals, found) + offsets).max(axis=1, initial=0.0)
    square = (found**2).sum(axis=1)[:, None] + (points**2).sum(axis=1) - 2.0 * found @ points.T
    near = np.full((count, len(points)), np.inf)
    corners = simplices[columns]
    near[rows[:, None], corners] = square[rows[:, None], corners]
    far = np.maximum(np.sqrt(np.maximum(near.min(axis=1), 0.0)) - _REACH, 0.0)
    # Needles add little volume and reach far, and where planes are nearly parallel they are hardly above them: squared
    # distances keep them out.
    cost = added + 0.15 * (gap**2 + far**2)
    return np.where(good, cost, np.inf), found


def _gathered(
    sides: NDArray[np.float64],
    rows: NDArray[np.int64],
    columns: NDArray[np.int64],
    fixed: NDArray[np.bool_],
    kept: Kept,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Normals, shape (edges, most, 3), and offsets of the planes around every edge, each once, zeros after them.

    Args:
        sides: planes of the faces, shape (faces, 4).
        rows: edges, ascending.
        columns: a face around each.
        fixed: which kept planes hold the point of each edge, shape (edges, planes); they are left out.
        kept: the planes.
    """
    _, first, same = np.unique(sides, axis=0, return_index=True, return_inverse=True)
    pairs = np.unique(rows * len(sides) + first[same.reshape(-1)][columns])
    rows, columns = pairs // len(sides), pairs % len(sides)
    free = ~(fixed[rows] & kept.parallel(sides)[columns]).any(axis=1)
    rows, columns = rows[free], columns[free]
    counts = np.bincount(rows, minlength=len(fixed))
    place = np.arange(len(rows)) - np.repeat(np.cumsum(counts) - counts, counts)
    gathered = np.zeros((len(fixed), int(counts.max(initial=0)), 4))
    gathered[rows, place] = sides[columns]
    return gathered[:, :, :3], gathered[:, :, 3]
