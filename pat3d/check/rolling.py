"""Does what touches in one point roll away? Second-order stability of a smooth body on another.

A body whose centre of mass is h above the point where it touches rests, on smooth surfaces of curvature matrices A and
B [1/m] there (convex is positive), in a minimum of its potential if every eigenvalue of A + B is below 1 / h. Turned by
t = (A + B) s it moves its contact by s and its centre by h t: it comes back where the contact gets ahead of the centre.
A ball on a flat floor is neutral, on another ball it rolls off, an egg lies on its side and not on its end.

Curvatures are those of a polynomial of fourth order through the vertices of a mesh near the contact; where that does
not fit, the surface has an edge or a flat there, and is none of these.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.footprints import Plane
from pat3d.geometry.normals import area_vectors

Rolling = Literal["stable", "neutral", "unstable"]

NEUTRAL = 0.01
"""Share of the critical curvature within which nobody can tell."""

_WINDOW = 0.2
"""Vertices this far beside the contact tell the curvature, as a share of the longest side: a ball's to 0.3 %."""

_BENT = 0.5
"""A window should be no wider, to either side, than this share of the radius of curvature in it."""

_REFINED = 0.2
"""By more than this share a closer look finds another surface, such as the rounding of an edge."""

_CLOSER = 6
"""Windows that are tried for lines, each half as wide as the one before."""

_PARALLEL = 0.99
"""Cosine of the angle between lines along which a surface is straight."""

_FLAT = 1e-9
"""Faces with normals of this cosine below one are in one plane."""

_GAP = 0.5
"""Distance of lines, as a share of the window, from which what is between them may be flat."""

_STEPS = 7
"""Points of a line across a window."""

_LEAST_VERTICES = 16

_LEAST_RISE = 1e-4
"""Rise over the reach below which a surface is flat."""

_MISFIT = 0.02
"""Error of the polynomial as a share of the height it spans, from which a surface is not smooth."""


def rolling(upper: NDArray[np.float64], lower: NDArray[np.float64], height: float) -> Rolling:
    """Whether a body rolls away.

    Args:
        upper: its curvature at the contact [1/m], convex positive, shape (2, 2).
        lower: that of what is under it, in the same axes, shape (2, 2).
        height: of its centre of mass over the contact [m].
    """
    largest = float(np.linalg.eigvalsh(upper + lower).max()) * height
    if largest > 1.0 + NEUTRAL:
        return "unstable"
    return "neutral" if largest > 1.0 - NEUTRAL else "stable"


def curvature(
    vertices: NDArray[np.float64],
    faces: NDArray[np.int32],
    plane: Plane,
    at: NDArray[np.float64],
    side: float,
    size: float,
) -> NDArray[np.float64] | None:
    """Curvature of a mesh where it touches a plane [1/m], convex positive, shape (2, 2).

    None where it is flat or not smooth.

    Args:
        vertices: of the mesh [m], shape (n, 3), in the world.
        faces: shape (m, 3).
        plane: that it touches.
        at: where, in the plane [m], shape (2,).
        side: 1 for a mesh above the plane, -1 for one below.
        size: the longest side of the mesh [m].
    """
    local = (plane.seen(vertices) - [*at, 0.0]) * [1.0, 1.0, side]
    reach = _WINDOW * size
    found = _fitted(_within(local, reach), reach)
    if found is None:
        return _ruled(local, _edges(local, faces), reach)
    # What is slender is rounder than a window of its length: looked at closer, as long as there is enough to see.
    while (bent := float(np.abs(np.linalg.eigvalsh(found)).max()) * reach) > _BENT:
        reach *= max(0.5, _BENT / bent)
        closer = _fitted(_within(local, reach), reach)
        if closer is None or np.abs(closer - found).max() > _REFINED * np.abs(found).max():
            break
        found = closer
    return found


def _within(points: NDArray[np.float64], reach: float) -> NDArray[np.float64]:
    """Those of `points` (along, across, height) near the origin [m]."""
    near = np.hypot(points[:, 0], points[:, 1]) < reach
    return points[near & (points[:, 2] < reach) & (points[:, 2] > -0.1 * reach)]


def _ruled(local: NDArray[np.float64], edges: NDArray[np.int64], reach: float) -> NDArray[np.float64] | None:
    """Curvature of what is straight along one way: a log has no vertices between its ends, but lines.

    Windows are made smaller until it is smooth there, and seen to be as round as it is.
    """
    smooth = None
    start, along = local[edges[:, 0]], local[edges[:, 1]] - local[edges[:, 0]]
    flat = np.linalg.norm(along[:, :2], axis=1)
    for _ in range(_CLOSER):
        long = flat > 2.0 * reach
        middle = -np.einsum("ei,ei->e", start[long, :2], along[long, :2]) / flat[long] ** 2
        steps = middle[:, None] + np.linspace(-0.9, 0.9, _STEPS) * (reach / flat[long, None])
        points = start[long, None] + steps[:, :, None] * along[long, None]
        beside = np.hypot(points[..., 0], points[..., 1]) < reach
        on = beside & (steps > 0.0) & (steps < 1.0) & (np.abs(points[..., 2]) < reach)
        ways = along[long][on.any(axis=1), :2] / flat[long][on.any(axis=1), None]
        found = _fitted(_within(points[on], reach), reach) if len(ways) else None
        if found is not None and (np.abs(ways @ ways[0]) > _PARALLEL).all() and _dense(points[on], ways[0], reach):
            smooth = found
            if float(np.abs(np.linalg.eigvalsh(found)).max()) * reach <= _BENT:
                break
        elif smooth is not None:
            break
        reach *= 0.5
    return smooth


def _dense(points: NDArray[np.float64], way: NDArray[np.float64], reach: float) -> bool:
    """Whether lines along `way` are so close that nothing between them can be flat."""
    across = np.sort(points[:, :2] @ [-way[1], way[0]])
    return bool(np.diff(across).max() < _GAP * reach)


def _edges(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.int64]:
    """Edges of a mesh between faces that are not in one plane, shape (n, 2): diagonals of flat sides are below it."""
    normals = area_vectors(vertices[faces])
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    every, owner = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), np.arange(3 * len(faces)) // 3
    order = np.lexsort(every.T)
    every, owner = every[order], owner[order]
    pairs = np.flatnonzero((every[1:] == every[:-1]).all(axis=1))
    cosine = np.einsum("ei,ei->e", normals[owner[pairs]], normals[owner[pairs + 1]])
    return np.asarray(every[pairs[cosine < 1.0 - _FLAT]], dtype=np.int64)


def _fitted(points: NDArray[np.float64], reach: float) -> NDArray[np.float64] | None:
    """Curvature [1/m] at the origin of a surface through `points` [m]; None where it is flat or not smooth."""
    x, y, z = points.T / reach
    if len(np.unique(np.round(points[:, :2] / reach, 4), axis=0)) < _LEAST_VERTICES:
        return None
    if np.ptp(z) < _LEAST_RISE:
        return None
    terms = np.column_stack([x**i * y**j for i in range(5) for j in range(5 - i)])
    powers = [(i, j) for i in range(5) for j in range(5 - i)]
    found, *_ = np.linalg.lstsq(terms, z, rcond=None)
    if np.abs(terms @ found - z).max() > _MISFIT * max(float(np.ptp(z)), 1e-12):
        return None
    xx, xy, yy = (float(found[powers.index(power)]) for power in ((2, 0), (1, 1), (0, 2)))
    return np.array([[2 * xx, xy], [xy, 2 * yy]]) / reach
