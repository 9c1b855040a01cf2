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

Rolling = Literal["stable", "neutral", "unstable"]

NEUTRAL = 0.01
"""Share of the critical curvature within which nobody can tell."""

_WINDOW = 0.2
"""Vertices this far beside the contact tell the curvature, as a share of the longest side: a ball's to 0.3 %."""

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
    vertices: NDArray[np.float64], plane: Plane, at: NDArray[np.float64], side: float, size: float
) -> NDArray[np.float64] | None:
    """Curvature of a mesh where it touches a plane [1/m], convex positive, shape (2, 2).

    None where it is flat or not smooth.

    Args:
        vertices: of the mesh [m], shape (n, 3), in the world.
        plane: that it touches.
        at: where, in the plane [m], shape (2,).
        side: 1 for a mesh above the plane, -1 for one below.
        size: the longest side of the mesh [m].
    """
    local = plane.seen(vertices)
    x, y, z = (local - [*at, 0.0]).T
    reach = _WINDOW * size
    near = (np.hypot(x, y) < reach) & (side * z < reach) & (side * z > -0.1 * reach)
    x, y, z = x[near] / reach, y[near] / reach, side * z[near] / reach
    if len(np.unique(np.round(np.column_stack([x, y]), 4), axis=0)) < _LEAST_VERTICES:
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
