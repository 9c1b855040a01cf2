"""Many small linear programs in three unknowns at once, by the dual simplex method.

minimise c . x  subject to  n_k . x + d_k >= 0 for every k

Three active constraints make a vertex x. While a constraint is violated, the most violated one replaces that of the
three which keeps c a non-negative combination of their normals, so c . x only grows and what holds all is the minimum.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

TOLERANCE = 1e-12
"""Violation that counts as none, for problems of unit size."""

_FAR = 16.0
"""Distance of the three planes that every program starts with, below what it minimises."""

_LEAST = 1e-9
"""Pivots smaller than this would make vertices of planes that are nearly parallel."""

_STEPS = 40


def minima(
    normals: NDArray[np.float64], offsets: NDArray[np.float64], objectives: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """The lowest vertex of every program, shape (programs, 3), and whether there is one.

    Coordinates are of order one. Rows of zeros in `normals` and `offsets` are no constraints.

    Args:
        normals: unit vectors n, shape (programs, constraints, 3).
        offsets: d, shape (programs, constraints).
        objectives: c, shape (programs, 3).
    """
    count = len(objectives)
    length = np.linalg.norm(objectives, axis=1, keepdims=True)
    down = objectives / np.maximum(length, 1e-300)
    normals = np.concatenate([_around(down), normals], axis=1)
    offsets = np.concatenate([np.full((count, 3), _FAR), offsets], axis=1)
    basis = np.tile(np.arange(3), (count, 1))
    found = np.zeros((count, 3))
    good = np.zeros(count, dtype=bool)
    open_ = np.flatnonzero(length[:, 0] > 0.0)
    for _ in range(_STEPS):
        if not len(open_):
            break
        rows, active = open_[:, None], basis[open_]
        inverse = _inverse(normals[rows, active])
        x = -np.einsum("pij,pj->pi", inverse, offsets[rows, active])
        slack = np.einsum("pki,pi->pk", normals[open_], x) + offsets[open_]
        entering = np.argmin(slack, axis=1)
        here = np.arange(len(open_))
        done = slack[here, entering] >= -TOLERANCE
        ended = open_[done]
        found[ended], good[ended] = x[done], (active[done] > 2).all(axis=1)
        # y: the combination of the active normals that is c; share: that which is the entering normal.
        y = np.einsum("pi,pij->pj", down[open_], inverse)
        share = np.einsum("pi,pij->pj", normals[open_, entering], inverse)
        usable = share > _LEAST
        ratio = np.where(usable, np.maximum(y, 0.0) / np.where(usable, share, 1.0), np.inf)
        leaving = np.argmin(ratio, axis=1)
        go = ~done & np.isfinite(ratio[here, leaving])
        basis[open_[go], leaving[go]] = entering[go]
        open_ = open_[go]
    return found, good


def _around(down: NDArray[np.float64]) -> NDArray[np.float64]:
    """Three unit vectors around each of `down`, whose combination it is, shape (n, 3, 3)."""
    least = np.eye(3)[np.argmin(np.abs(down), axis=1)]
    u = np.cross(down, least)
    u /= np.maximum(np.linalg.norm(u, axis=1, keepdims=True), 1e-300)
    v = np.cross(down, u)
    angle = 2.0 * np.pi * np.arange(3) / 3.0
    spread = np.cos(angle)[:, None] * u[:, None] + np.sin(angle)[:, None] * v[:, None]
    return (down[:, None] + spread) / np.sqrt(2.0)


def _inverse(matrices: NDArray[np.float64]) -> NDArray[np.float64]:
    """Inverses of 3 x 3 matrices by their rows' cross products, shape (n, 3, 3)."""
    first, second = matrices[:, [1, 2, 0]], matrices[:, [2, 0, 1]]
    columns = first[:, :, [1, 2, 0]] * second[:, :, [2, 0, 1]] - first[:, :, [2, 0, 1]] * second[:, :, [1, 2, 0]]
    determinant = np.einsum("pi,pi->p", matrices[:, 0], columns[:, 0])
    determinant = np.where(np.abs(determinant) > 1e-300, determinant, 1e-300)
    return columns.transpose(0, 2, 1) / determinant[:, None, None]
