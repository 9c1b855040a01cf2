"""Normals of triangle meshes: of faces, of vertices, and of corners that are shaded smoothly up to a crease."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

CREASE_DEGREES = 40.0
"""Faces meeting at a larger angle than this keep a sharp edge between them."""

_MAX_VALENCE = 512
"""Corners around one vertex up to which normals are smoothed; fans beyond it stay flat."""


def corner_normals(
    vertices: NDArray[np.float64], faces: NDArray[np.int32], crease_degrees: float = CREASE_DEGREES
) -> NDArray[np.float64]:
    """Unit normals of every face corner, shape (faces, 3, 3), smoothed over edges flatter than the crease.

    Args:
        vertices: [m], shape (vertices, 3).
        faces: vertex indices, shape (faces, 3).
        crease_degrees: largest angle between two faces that are shaded as one surface.
    """
    corners = vertices[faces]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(area, axis=1, keepdims=True)
    unit = np.where(length > 0, area / np.where(length > 0, length, 1.0), (0.0, 0.0, 1.0))
    weight = _corner_angles(corners)
    flat = faces.reshape(-1)
    order = np.argsort(flat, kind="stable")
    _, start, count = np.unique(flat[order], return_index=True, return_counts=True)
    # All ordered pairs of corners that share a vertex.
    smooth = count <= _MAX_VALENCE
    start, count = start[smooth], count[smooth]
    pairs = count**2
    group = np.repeat(np.arange(len(count)), pairs)
    within = np.arange(pairs.sum()) - np.repeat(np.cumsum(pairs) - pairs, pairs)
    receiver = order[start[group] + within // count[group]]
    giver = order[start[group] + within % count[group]]
    joined = np.einsum("pi,pi->p", unit[receiver // 3], unit[giver // 3]) >= np.cos(np.radians(crease_degrees))
    receiver, giver = receiver[joined], giver[joined]
    normals = np.zeros((len(flat), 3))
    np.add.at(normals, receiver, unit[giver // 3] * weight.reshape(-1)[giver, None])
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    fallback = np.repeat(unit, 3, axis=0)
    return np.where(size > 1e-12, normals / np.where(size > 1e-12, size, 1.0), fallback).reshape(-1, 3, 3)


def _corner_angles(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angle of every triangle corner [rad], shape (faces, 3)."""
    ahead = np.roll(corners, -1, axis=1) - corners
    back = np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(ahead, back), axis=2)
    return np.arctan2(sine, np.einsum("fci,fci->fc", ahead, back))
