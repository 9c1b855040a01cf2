"""Textured meshes as graphics cards take them: a vertex for every position with its normal and texture coordinates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.normals import crease_normals
from pat3d.scene.asset import VisualMesh


@dataclass(frozen=True, kw_only=True, eq=False)
class CornerMesh:
    """A mesh whose corners are merged where they are the same."""

    positions: NDArray[np.float32]
    """[m], shape (n, 3)."""
    normals: NDArray[np.float32]
    """Unit vectors, smooth up to creases, shape (n, 3)."""
    uv: NDArray[np.float32]
    """Texture coordinates, v up, shape (n, 2)."""
    faces: NDArray[np.uint32]
    """Indices, counter-clockwise seen from outside, shape (faces, 3)."""


def corner_mesh(mesh: VisualMesh) -> CornerMesh:
    """The corners of `mesh`, merged where position, normal and texture coordinates agree."""
    normals = crease_normals(mesh.vertices, mesh.faces).reshape(-1, 3)
    rows = np.column_stack([mesh.vertices[mesh.faces].reshape(-1, 3), normals, mesh.uv.reshape(-1, 2)])
    rows = rows.astype(np.float32)
    # Signed zeros are one zero, so that equal corners are equal bytes.
    rows += np.float32(0.0)
    keys = np.column_stack([rows[:, :3], np.round(rows[:, 3:6], 3) + np.float32(0.0), rows[:, 6:]])
    _, first, index = np.unique(keys, axis=0, return_index=True, return_inverse=True)
    kept = rows[first]
    return CornerMesh(
        positions=kept[:, :3],
        normals=kept[:, 3:6],
        uv=kept[:, 6:],
        faces=index.reshape(-1, 3).astype(np.uint32),
    )
