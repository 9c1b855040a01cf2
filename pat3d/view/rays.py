"""Ray tracing on the CPU: view rays of a pinhole camera, an embree scene of triangles, and what its hits interpolate.

Previews (pat3d.view.render) and observations (pat3d.envs.rendering.raytrace) both draw with it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float32]


def pinhole_rays(
    axes: NDArray[np.floating[Any]], x: ArrayLike, y: ArrayLike, width: int, height: int, field_of_view: float
) -> tuple[Array, Array]:
    """Unit view directions through picture points, and how much further than the picture's plane each one reaches.

    Args:
        axes: rows right, up and forward in the world frame, shape (3, 3).
        x: points [pixel] from the left edge; the first pixel's centre is 0.5. Shape (n,).
        y: points [pixel] from the top edge, shape (n,).
        width: of the whole picture [pixel].
        height: of the whole picture [pixel].
        field_of_view: vertical opening angle [deg].

    Returns:
        World directions, shape (n, 3), and distances along them to the plane at distance 1, shape (n,).
    """
    scale = 2.0 * math.tan(math.radians(field_of_view) / 2.0) / height
    right, up, forward = axes.astype(np.float32)
    along_x = (np.asarray(x, dtype=np.float32) - np.float32(width / 2.0)) * np.float32(scale)
    along_y = (np.float32(height / 2.0) - np.asarray(y, dtype=np.float32)) * np.float32(scale)
    rays = forward + along_x[:, None] * right + along_y[:, None] * up
    reach = np.sqrt(1.0 + along_x**2 + along_y**2)
    rays /= reach[:, None]
    return rays, reach


@dataclass(frozen=True, eq=False)
class FirstHits:
    """Where rays first meet triangles; `which` lists the rays that do."""

    which: NDArray[np.int64]
    """Indices of the rays, shape (m,)."""
    face: NDArray[np.int32]
    """Index of the triangle, shape (m,)."""
    distance: Array
    """[m], shape (m,)."""
    weights: Array
    """Of the triangle's corners in the point that is hit, shape (m, 3)."""

    def at(self, values: Array) -> Array:
        """`values` of the corners of every triangle, shape (faces, 3, k), where the rays hit, shape (m, k)."""
        return np.einsum("ij,ijk->ik", self.weights, values[self.face])


class RayScene:
    """Triangles in an embree scene."""

    def __init__(self, corners: Array) -> None:
        """Build the scene.

        Args:
            corners: of the triangles [m], shape (faces, 3, 3).
        """
        from embreex.mesh_construction import TriangleMesh
        from embreex.rtcore_scene import EmbreeScene

        # The scene keeps no reference to what it was built from; the mesh object must live as long.
        self._scene: Any = EmbreeScene()
        self._mesh = TriangleMesh(self._scene, np.ascontiguousarray(corners, dtype=np.float32))

    def occluded(self, origins: Array, directions: Array) -> NDArray[np.bool_]:
        """Whether each ray, shape (n, 3), meets any triangle."""
        return self._scene.run(origins, directions, query="OCCLUDED") >= 0

    def first_faces(self, origins: Array, directions: Array) -> tuple[NDArray[np.int32], Array]:
        """Face index (-1 for none) and distance [m] of each ray's first hit, shapes (n,)."""
        found = self._scene.run(origins, directions, output=1)
        return found["primID"], found["tfar"]

    def hits(self, origin: NDArray[np.floating[Any]], directions: Array, nearer: Array | None = None) -> FirstHits:
        """First hits of rays.

        Args:
            origin: of all of them [m], shape (3,), or of each, shape (n, 3).
            directions: unit vectors, shape (n, 3).
            nearer: hits count that are nearer than this [m], shape (n,).
        """
        one = origin.astype(np.float32, copy=False)
        origins = np.tile(one, (len(directions), 1)) if one.ndim == 1 else np.ascontiguousarray(one)
        found = self._scene.run(origins, directions, output=1)
        hit = found["primID"] >= 0
        which = np.flatnonzero(hit if nearer is None else hit & (found["tfar"] < nearer))
        u, v = found["u"][which], found["v"][which]
        return FirstHits(which, found["primID"][which], found["tfar"][which], np.stack([1.0 - u - v, u, v], axis=1))


def unit(vectors: Array) -> Array:
    """Vectors, shape (n, 3), at length 1; those of no length stay."""
    length = np.maximum(np.linalg.norm(vectors, axis=1), 1e-20)
    return (vectors / length[:, None]).astype(np.float32, copy=False)
