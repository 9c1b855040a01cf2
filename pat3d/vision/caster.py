"""Where the rays of a camera meet an asset, wherever it is put: the rays move into its frame, its triangles stay."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.rotations import yaw_matrix
from pat3d.scene.asset import VisualMesh
from pat3d.view.rays import RayScene
from pat3d.vision.camera import Array


@dataclass(frozen=True, kw_only=True, eq=False)
class Placement:
    """A mesh in the world: x_world = scale R x + position."""

    scale: float
    rotation: Array
    """Shape (3, 3)."""
    position: Array
    """Of the mesh's origin [m], shape (3,)."""

    def apply(self, points: Array) -> Array:
        """Points of the mesh [m], shape (n, 3), in the world."""
        return self.scale * np.asarray(points) @ self.rotation.T + self.position


def orientation(yaw: float, pitch: float = 0.0, roll: float = 0.0) -> Array:
    """A turn by `roll` about x, then `pitch` about y, then `yaw` about the vertical [rad]; shape (3, 3)."""
    turned = yaw_matrix(yaw)
    if pitch == roll == 0.0:
        return turned
    (c, s), (a, b) = (math.cos(pitch), math.sin(pitch)), (math.cos(roll), math.sin(roll))
    return turned @ np.array([[c, s * b, s * a], [0.0, a, -b], [-s, c * b, c * a]])


class Caster:
    """A mesh that rays can be sent to."""

    def __init__(self, mesh: VisualMesh) -> None:
        """Centre the mesh in the frame of the rays, whose numbers are of single precision."""
        low, high = mesh.bounds
        self.centre: Array = (low + high) / 2.0
        """Middle of the bounding box [m], shape (3,)."""
        self.radius = float(np.linalg.norm(high - low) / 2.0)
        """Half the diagonal of the bounding box [m]."""
        self.vertices: Array = mesh.vertices
        self._scene = RayScene(((mesh.vertices - self.centre)[mesh.faces] / self.radius).astype(np.float32))

    def half_height(self, rotation: Array) -> float:
        """How far the mesh, turned by `rotation`, reaches below its middle, over its radius [-]."""
        return -float(((self.vertices - self.centre) @ rotation[2]).min()) / self.radius

    def ranges(self, origin: Array, directions: Array, placed: Placement) -> NDArray[np.float32]:
        """How far unit rays, shape (n, 3), from `origin` [m] travel to the mesh [m]; infinite where they miss it."""
        unit = placed.scale * self.radius
        start = ((origin - placed.position) @ placed.rotation / placed.scale - self.centre) / self.radius
        ways = np.ascontiguousarray(directions @ placed.rotation, dtype=np.float32)
        # Rays begin just outside of the mesh: far away, single precision is coarse.
        skipped = max(0.0, float(np.linalg.norm(start)) - 1.1)
        face, far = self._scene.first_faces((start + skipped * ways).astype(np.float32), ways)
        return np.where(face >= 0, (far + np.float32(skipped)) * np.float32(unit), np.float32(np.inf))
