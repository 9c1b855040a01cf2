"""Corners of a convex hull moved in, as far as it still contains what it stands for. Everything is of unit size."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from pat3d.assets.mesh.collapse import Kept, edge_lengths, edges_of
from pat3d.assets.mesh.linear_programs import minima
from pat3d.geometry.normals import triangle_areas

_SWEEPS = 6

_LEAST = 1e-5
"""Share of the volume below which moving a corner is not worth it."""


def tightened(
    corners: NDArray[np.float64], inner: NDArray[np.float64], kept: Kept, short: float
) -> NDArray[np.float64]:
    """Corners of a smaller hull that contains `inner`, as many and none nearer than `short` to another, shape (n, 3).

    Corners that no edge joins move together; where their hull does not do, half of them, and the others after.
    """
    hull = ConvexHull(corners)
    if len(hull.vertices) < len(corners):
        return corners
    for _ in range(_SWEEPS):
        before = hull.volume
        left = list(range(len(corners)))
        while left:
            together = _strangers(left, hull)
            hull = _moved(hull, together, inner, kept, short)
            left = [index for index in left if index not in together]
        if before - hull.volume < 1e-3 * hull.volume:
            break
    return hull.points


def _strangers(candidates: list[int], hull: ConvexHull) -> list[int]:
    """Those of `candidates` that are taken, one after another, where no edge joins them to one that is."""
    joined = np.zeros((len(hull.points), len(hull.points)), dtype=bool)
    edges = edges_of(hull)
    joined[edges[:, 0], edges[:, 1]] = joined[edges[:, 1], edges[:, 0]] = True
    blocked = np.zeros(len(hull.points), dtype=bool)
    chosen = []
    for index in candidates:
        if not blocked[index]:
            chosen.append(index)
            blocked |= joined[index]
    return chosen


def _moved(hull: ConvexHull, chosen: list[int], inner: NDArray[np.float64], kept: Kept, short: float) -> ConvexHull:
    """The hull after those of the `chosen` corners have moved that may."""
    points, good = _inner_points(hull, np.array(chosen), inner, kept)
    spacing = min(short, edge_lengths(hull).min())
    apart = np.linalg.norm(points[:, None] - hull.points, axis=2)
    apart[np.arange(len(chosen)), chosen] = np.inf
    good &= apart.min(axis=1) >= spacing
    chosen = [index for index, fits in zip(chosen, good, strict=True) if fits]
    if not chosen:
        return hull
    corners = hull.points.copy()
    corners[chosen] = points[good]
    trial = ConvexHull(corners)
    if (
        trial.volume < hull.volume
        and len(trial.vertices) == len(corners)
        and (inner @ trial.equations[:, :3].T + trial.equations[:, 3]).max() < 1e-12
        and edge_lengths(trial).min() >= spacing
    ):
        return trial
    if len(chosen) == 1:
        return hull
    for some in (chosen[: len(chosen) // 2], chosen[len(chosen) // 2 :]):
        hull = _moved(hull, some, inner, kept, short)
    return hull


def _inner_points(
    hull: ConvexHull, chosen: NDArray[np.int64], inner: NDArray[np.float64], kept: Kept
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Where each of the `chosen` corners makes the hull smallest while the faces around it stay outside `inner`.

    The planes through each opposite edge that touch `inner` bound it from below, the faces beyond those edges from
    above. No edge joins two of the corners.
    """
    owner, face, at = _faces_at(hull, chosen)
    simplices = hull.simplices[face]
    corner = hull.points[chosen[owner]]
    a = hull.points[simplices[np.arange(len(face)), (at + 1) % 3]]
    b = hull.points[simplices[np.arange(len(face)), (at + 2) % 3]]
    normal = hull.equations[face, :3]
    edge = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
    across = corner - a - np.einsum("fi,fi->f", corner - a, edge)[:, None] * edge
    across /= np.maximum(np.linalg.norm(across, axis=1, keepdims=True), 1e-300)
    down = np.einsum("fi,fi->f", a, normal)[:, None] - normal @ inner.T
    out = across @ inner.T - np.einsum("fi,fi->f", a, across)[:, None]
    angle = np.where(np.hypot(down, out) > 1e-9, np.arctan2(down, out), np.pi / 2).min(axis=1)
    angle = np.minimum(angle, np.pi / 2)[:, None]
    tangent = np.cos(angle) * normal + np.sin(angle) * across
    lower = np.column_stack([tangent, -np.einsum("fi,fi->f", tangent, a)])
    beyond = -hull.equations[hull.neighbors[face, at]]
    areas = triangle_areas(hull.points[simplices])
    count = len(chosen)
    objectives = np.zeros((count, 3))
    np.add.at(objectives, owner, areas[:, None] * normal / 3.0)
    faces = np.bincount(owner, minlength=count)
    place = np.arange(len(owner)) - np.repeat(np.cumsum(faces) - faces, faces)
    limits = np.zeros((count, int(faces.max()), 2, 4))
    limits[owner, place] = np.stack([lower, beyond], axis=1)
    limits = limits.reshape(count, -1, 4)
    levels = np.broadcast_to([[0.0, 0.0, 1.0, -kept.low], [0.0, 0.0, -1.0, kept.high]], (count, 2, 4))
    limits = np.concatenate([limits, levels], axis=1)
    fixed = kept.held(hull.points[chosen])
    same = np.abs(np.einsum("pki,si->pks", limits[:, :, :3], kept.planes[:, :3])) > 1.0 - 1e-9
    limits[(same & fixed[:, None]).any(axis=2)] = 0.0
    on = np.where(fixed[:, :, None], kept.planes[None], 0.0)
    limits = np.concatenate([limits, on, -on], axis=1)
    found, good = minima(limits[:, :, :3], limits[:, :, 3], objectives)
    found = kept.snapped(found, fixed)
    less = np.einsum("pi,pi->p", hull.points[chosen] - found, objectives)
    return found, good & (less > _LEAST * hull.volume)


def _faces_at(
    hull: ConvexHull, chosen: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.int64]]:
    """Every face at one of the corners: which of `chosen`, which face, and where in it; sorted by the first."""
    number = np.full(len(hull.points), -1)
    number[chosen] = np.arange(len(chosen))
    face, at = np.nonzero(number[hull.simplices] >= 0)
    owner = number[hull.simplices[face, at]]
    order = np.argsort(owner, kind="stable")
    return owner[order], face[order], at[order]
