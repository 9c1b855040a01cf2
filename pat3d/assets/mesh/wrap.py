"""A closed surface around any triangles, for meshes that bound no solid in themselves."""

from __future__ import annotations

from typing import Any

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import KDTree

from pat3d.errors import AssetError

RESOLUTION = 64
"""Voxels along the longest side."""

MAX_SAMPLES = 2_000_000


def voxel_wrap(
    vertices: NDArray[np.float64], faces: NDArray[np.integer[Any]], resolution: int = RESOLUTION
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """Vertices and faces of a closed surface 0.6 voxels outside the triangles; what they enclose is solid.

    Gaps narrower than a voxel are bridged.

    Args:
        vertices: [m], shape (vertices, 3).
        faces: shape (faces, 3).
        resolution: voxels along the longest side.

    Raises:
        AssetError: the triangles are too many or too thin to sample.
    """
    corners = vertices[faces]
    low = corners.min(axis=(0, 1))
    voxel = float(np.ptp(corners.reshape(-1, 3), axis=0).max()) / resolution
    samples = KDTree(_surface_samples(corners, 0.4 * voxel))
    low = low - 3 * voxel
    shape = np.ceil((corners.max(axis=(0, 1)) + 3 * voxel - low) / voxel).astype(int) + 1
    grid = np.stack(np.meshgrid(*(np.arange(n) for n in shape), indexing="ij"), axis=-1).reshape(-1, 3) * voxel + low
    distance = samples.query(grid, distance_upper_bound=2 * voxel)[0].reshape(shape)
    distance = np.minimum(distance, 2 * voxel)
    label = np.asarray(ndimage.label(distance > 0.9 * voxel)[0])  # type: ignore[index]
    enclosed = (label > 0) & (label != label[0, 0, 0])
    field = 0.6 * voxel - distance
    field[enclosed] = voxel
    values = field.tolist()

    def inside(x: float, y: float, z: float) -> float:
        """Trilinear interpolation of the field, positive inside."""
        u, v, w = (x - low[0]) / voxel, (y - low[1]) / voxel, (z - low[2]) / voxel
        i = min(max(int(u), 0), shape[0] - 2)
        j = min(max(int(v), 0), shape[1] - 2)
        k = min(max(int(w), 0), shape[2] - 2)
        u, v, w = u - i, v - j, w - k
        near, far = values[i], values[i + 1]
        a = near[j][k] * (1 - w) + near[j][k + 1] * w
        b = near[j + 1][k] * (1 - w) + near[j + 1][k + 1] * w
        c = far[j][k] * (1 - w) + far[j][k + 1] * w
        d = far[j + 1][k] * (1 - w) + far[j + 1][k + 1] * w
        return (a * (1 - v) + b * v) * (1 - u) + (c * (1 - v) + d * v) * u

    high = low + (shape - 1) * voxel
    bounds = [*map(float, low), *map(float, high)]
    solid = manifold3d.Manifold.level_set(inside, bounds, voxel).simplify(0.25 * voxel)
    if solid.status() != manifold3d.Error.NoError or solid.is_empty():
        raise AssetError("the mesh encloses nothing, even when wrapped in voxels.")
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3].copy(), np.asarray(mesh.tri_verts, dtype=np.int64)


def _surface_samples(corners: NDArray[np.float64], spacing: float) -> NDArray[np.float64]:
    """Points on every triangle no farther apart than about `spacing` [m], shape (n, 3)."""
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    steps = np.maximum(1, np.ceil(longest / spacing)).astype(int)
    if ((steps + 1) * (steps + 2) // 2).sum() > MAX_SAMPLES:
        raise AssetError("the mesh is too large a soup of long triangles to be wrapped; repair it first.")
    points = []
    for step in np.unique(steps):
        i, j = np.meshgrid(np.arange(step + 1), np.arange(step + 1), indexing="ij")
        keep = i + j <= step
        weights = np.stack([i[keep], j[keep], step - i[keep] - j[keep]], axis=1) / step
        points.append(np.einsum("wk,fki->fwi", weights, corners[steps == step]).reshape(-1, 3))
    return np.concatenate(points)
