"""Normals, areas and enclosed volume of triangle meshes; normals of corners that are shaded smoothly up to a crease.

Triangles are given by their corners, shape (faces, 3, 3), counter-clockwise seen from outside.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

Corners = NDArray[np.floating[Any]]

CREASE_DEGREES = 40.0
"""Faces meeting at a larger angle than this keep a sharp edge between them."""

_MAX_VALENCE = 512
"""Corners around one vertex up to which normals are smoothed; fans beyond it stay flat."""
_LARGEST_FAN = 256
"""The same of `crease_normals`: pairs grow with the square."""


def area_vectors(corners: Corners) -> NDArray[Any]:
    """Outward normals as long as twice the area of their triangles [m^2], shape (faces, 3)."""
    return np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])


def triangle_areas(corners: Corners) -> NDArray[Any]:
    """Areas of triangles [m^2], shape (faces,)."""
    return np.linalg.norm(area_vectors(corners), axis=1) / 2


def unit_normals(corners: Corners) -> NDArray[Any]:
    """Outward unit normals, shape (faces, 3); zero where a triangle is a line or a point."""
    area = area_vectors(corners)
    return area / np.maximum(np.linalg.norm(area, axis=1, keepdims=True), 1e-300)


def enclosed_volume(corners: Corners) -> float:
    """Volume [m^3] that a closed mesh encloses, by the signed tetrahedra to the origin; negative inside out."""
    return float(np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6.0)


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
    area = area_vectors(corners)
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


def crease_normals(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.float32]:
    """Normals of every face corner: the mean over the faces at its vertex within the crease angle of its own face.

    Faces count by area, so that the slivers of boolean operations, whose own normals are noise, do not show.

    Args:
        vertices: [m], shape (v, 3).
        faces: vertex indices, shape (f, 3).

    Returns:
        Unit normals, shape (f, 3, 3).
    """
    corners = vertices[faces]
    area = area_vectors(corners)
    flat = area / np.maximum(np.linalg.norm(area, axis=1), 1e-300)[:, None]
    vertex_of = faces.reshape(-1)
    order = np.argsort(vertex_of, kind="stable")
    face_of = order // 3
    fan = np.bincount(vertex_of, minlength=len(vertices))
    start = np.cumsum(fan) - fan
    limit = math.cos(math.radians(CREASE_DEGREES))
    # Where every face is within half the crease angle of the mean, all pairs are within the whole.
    weights = [np.bincount(vertex_of, area[:, axis].repeat(3), len(vertices)) for axis in range(3)]
    mean = np.stack(weights, axis=1)
    mean /= np.maximum(np.linalg.norm(mean, axis=1), 1e-300)[:, None]
    apart = np.einsum("ij,ij->i", flat.repeat(3, axis=0), mean[vertex_of]) < math.cos(math.radians(CREASE_DEGREES / 2))
    creased = np.bincount(vertex_of, apart, len(vertices)) > 0
    sums = np.where(creased[vertex_of][:, None], area.repeat(3, axis=0), mean[vertex_of])
    # Corner i of its vertex's fan against the corner `shift` places further round, for all vertices at once.
    rank = np.arange(len(order)) - start.repeat(fan)
    valence, first = fan.repeat(fan), start.repeat(fan)
    active = np.flatnonzero(creased.repeat(fan) & (valence <= _LARGEST_FAN))
    for shift in range(1, _LARGEST_FAN):
        active = active[valence[active] > shift]
        if len(active) == 0:
            break
        theirs = face_of[first[active] + (rank[active] + shift) % valence[active]]
        close = np.einsum("ij,ij->i", flat[face_of[active]], flat[theirs]) > limit
        sums[order[active[close]]] += area[theirs[close]]
    length = np.linalg.norm(sums, axis=1)
    return (sums / np.maximum(length, 1e-300)[:, None]).reshape(-1, 3, 3).astype(np.float32)


def _corner_angles(corners: NDArray[np.float64]) -> NDArray[np.float64]:
    """Angle of every triangle corner [rad], shape (faces, 3)."""
    ahead = np.roll(corners, -1, axis=1) - corners
    back = np.roll(corners, 1, axis=1) - corners
    sine = np.linalg.norm(np.cross(ahead, back), axis=2)
    return np.arctan2(sine, np.einsum("fci,fci->fc", ahead, back))
