"""Height maps of what stands around an object, in frames turned to the directions in which a gripper may close."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.mesh.regions import height_map
from pat3d.geometry.hulls import ConvexPart
from pat3d.scene.model import SceneObject

Array = NDArray[np.float64]

CELL = 0.0025
"""Side of a cell of the height maps [m]."""


@dataclass(frozen=True, eq=False)
class HeightGrid:
    """Square cells around an object, centred on it."""

    middle: Array
    """[m], shape (2,)."""
    half: int
    """Cells on each side of the middle one."""

    @staticmethod
    def around(low: Array, high: Array) -> HeightGrid:
        """Cells over the rectangle from `low` to `high` [m], shape (2,) each, however it is turned."""
        return HeightGrid((low + high) / 2, math.ceil(float(np.linalg.norm(high - low)) / 2 / CELL))

    def heights(self, objects: Sequence[SceneObject]) -> Array:
        """Highest surface of `objects` over every cell [m], -inf where there is none, shape (n, n)."""
        size = 2 * self.half + 1
        height = np.full((size, size), -np.inf)
        for obj in objects:
            parts = [ConvexPart(vertices=obj.pose.apply(part.vertices), faces=part.faces) for part in obj.asset.parts]
            low, high = bounds(obj)
            if np.any(low[:2] > self.middle + self.half * CELL) or np.any(high[:2] < self.middle - self.half * CELL):
                continue
            cells = math.ceil(float((high - low)[:2].max()) / CELL)
            seen = height_map(parts, max(cells, 8))
            i = np.rint((seen.x - self.middle[0]) / CELL).astype(int) + self.half
            j = np.rint((seen.y - self.middle[1]) / CELL).astype(int) + self.half
            inside_i, inside_j = (i >= 0) & (i < size), (j >= 0) & (j < size)
            np.maximum.at(height, np.ix_(i[inside_i], j[inside_j]), seen.height[np.ix_(inside_i, inside_j)])
        return height

    def turned(self, height: Array, angle: float) -> Array:
        """The map in a frame turned by `angle`: axis 0 runs along it."""
        offset = np.arange(-self.half, self.half + 1)
        u, v = np.meshgrid(offset, offset, indexing="ij")
        i = np.rint(math.cos(angle) * u - math.sin(angle) * v).astype(int) + self.half
        j = np.rint(math.sin(angle) * u + math.cos(angle) * v).astype(int) + self.half
        size = 2 * self.half + 1
        inside = (i >= 0) & (i < size) & (j >= 0) & (j < size)
        turned = np.full(height.shape, -np.inf)
        turned[inside] = height[i[inside], j[inside]]
        return turned

    def world(self, angle: float) -> tuple[Array, Array]:
        """World positions [m] of the cells of a turned map."""
        offset = np.arange(-self.half, self.half + 1) * CELL
        u, v = np.meshgrid(offset, offset, indexing="ij")
        return (
            self.middle[0] + math.cos(angle) * u - math.sin(angle) * v,
            self.middle[1] + math.sin(angle) * u + math.cos(angle) * v,
        )


def bounds(obj: SceneObject) -> tuple[Array, Array]:
    """Corners of the bounding box [m], shape (3,) each, world frame."""
    points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
    return points.min(axis=0), points.max(axis=0)
