"""Objects as pages draw them: textured meshes that get simpler with distance, and many convex parts as one mesh."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from pat3d.exporters.glb.writer import textured_mesh
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset

FEW = 400
"""Triangles of which none is left out."""
SHARES = 0.25, 0.1
"""Of the triangles that are left, seen from further and further away."""
SEEN = 1e-3
"""What cannot be seen at a distance, as a share of it [-]: half a pixel of a page that is 800 pixels high."""
METALLIC = 0.4
"""At most, since what is all metal is black under light that it does not reflect."""

OUTWARD = 3e-4
"""How far what covers a mesh is in front of it [m]: neither shines through the other where their faces coincide."""

Mesh = tuple[NDArray[np.float32], NDArray[np.int32]]
"""Vertices [m], shape (n, 3), and faces, shape (m, 3)."""


def glb(asset: Asset) -> bytes:
    """The visual mesh of `asset` with its texture, in the asset frame [m], as a GLB."""
    mesh = textured_mesh(asset, asset.noun)
    material = mesh.visual.material
    material.metallicFactor = min(METALLIC, material.metallicFactor)
    return mesh.export(file_type="glb", include_normals=True)


def levels(asset: Asset) -> tuple[tuple[float, float], ...]:
    """From which distance [m] on which share of the triangles of `asset` is drawn.

    A smooth shape of radius r with n triangles is 3.6 r / n away from its mesh: triangles of area 4 pi r^2 / n, whose
    sides are s^2 = 4 / sqrt(3) of that, sag by s^2 / (8 r). Twice the distance from which that cannot be seen is left
    for what is not smooth.
    """
    count = len(asset.visual.faces)
    if count <= FEW:
        return ()
    radius = float(np.linalg.norm(asset.size)) / 2
    return tuple((2.0 * 3.6 * radius / (SEEN * share * count), share) for share in SHARES)


def joined(meshes: Iterable[tuple[Pose, NDArray[np.float64], NDArray[np.int32]]]) -> Mesh:
    """One mesh of many, each at its pose and a little outward: for a page many small meshes are more work than one."""
    vertices, faces, count = [], [], 0
    for pose, corners, triangles in meshes:
        vertices.append(pose.apply(corners + OUTWARD * _normals(corners, triangles)).astype(np.float32))
        faces.append(np.asarray(triangles, dtype=np.int32) + count)
        count += len(corners)
    return np.concatenate(vertices), np.concatenate(faces)


def _normals(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.float64]:
    """Mean directions of the faces around every vertex, by area; shape (n, 3)."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    found = np.zeros_like(vertices, dtype=np.float64)
    np.add.at(found, faces, np.cross(b - a, c - a)[:, None, :])
    return found / np.maximum(np.linalg.norm(found, axis=1, keepdims=True), 1e-30)
