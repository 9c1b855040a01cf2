"""Scenes that benchmarks of the simulator share with its peers: closed meshes at poses, nothing else."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder

DENSITY = 500.0
"""[kg/m^3]"""

CUBE = 0.05
"""Edge of the cubes [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Pile:
    """Bodies of one shape."""

    name: str
    part: ConvexPart
    """The surface, in a frame about its centre; not necessarily convex."""
    poses: tuple[Pose, ...]
    size: float
    """Longest side of the shape's box [m]."""

    def add_to(self, builder: ModelBuilder) -> None:
        """Add the bodies to the present world."""
        properties = mass_properties(self.part.vertices, self.part.faces, density=DENSITY)
        for pose in self.poses:
            builder.add_body(
                [self.part],
                mass=properties.mass,
                volume=properties.volume,
                centre=np.array(properties.centre_of_mass),
                second_moment=properties.second_moment,
                pose=pose,
            )

    def transforms(self) -> NDArray[np.float64]:
        """Homogeneous matrices of the bodies, shape (bodies, 4, 4)."""
        matrices = np.tile(np.eye(4), (len(self.poses), 1, 1))
        matrices[:, :3, :3] = [pose.rotation for pose in self.poses]
        matrices[:, :3, 3] = [pose.position for pose in self.poses]
        return matrices


def cube() -> ConvexPart:
    """A cube about the origin."""
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float64)
    return convex_part(0.5 * CUBE * corners)


def tower(count: int, seed: int = 0) -> Pile:
    """Cubes above each other, a little turned and shifted, two millimetres apart."""
    rng = np.random.default_rng(seed)
    poses = [
        Pose.from_yaw(rng.uniform(-0.2, 0.2), (*rng.uniform(-0.002, 0.002, 2), 0.5 * CUBE + 0.002 + (CUBE + 0.002) * i))
        for i in range(count)
    ]
    return Pile(name=f"tower of {count} cubes", part=cube(), poses=tuple(poses), size=CUBE)


def pile(count: int, seed: int = 0) -> Pile:
    """Layers of cubes, every one turned and shifted at random, that fall on each other."""
    rng = np.random.default_rng(seed)
    side = max(2, int(np.ceil((count / 4) ** 0.5)))
    poses = []
    for i in range(count):
        layer, place = divmod(i, side * side)
        x, y = (np.array(divmod(place, side)) - 0.5 * (side - 1)) * 1.45 * CUBE
        z = 0.75 * CUBE + 1.5 * CUBE * layer
        shift = rng.uniform(-0.1, 0.1, 3) * CUBE * (1, 1, 0)
        poses.append(Pose.from_yaw(rng.uniform(-0.3, 0.3), (x + shift[0], y + shift[1], z)))
    return Pile(name=f"pile of {count} cubes", part=cube(), poses=tuple(poses), size=CUBE)


def blobs(count: int, vertices: int = 1869, seed: int = 0) -> Pile:
    """A column of lumpy, non-convex bodies with as many vertices as a scanned figurine."""
    i = np.arange(vertices) + 0.5
    polar, turn = np.arccos(1 - 2 * i / vertices), np.pi * (1 + 5**0.5) * i
    sphere = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], axis=1)
    faces = convex_part(sphere).faces
    order = _same_points(convex_part(sphere).vertices, sphere)
    lumps = 1 + 0.22 * np.sin(5 * sphere[:, 0] + 1) * np.sin(4 * sphere[:, 1]) + 0.1 * np.cos(6 * sphere[:, 2])
    points = 0.05 * lumps[order, None] * sphere[order]
    part = ConvexPart(vertices=points, faces=faces)
    part = ConvexPart(vertices=points - mass_properties(points, faces, density=1.0).centre_of_mass, faces=faces)
    size = float(np.ptp(part.vertices, axis=0).max())
    rng = np.random.default_rng(seed)
    lowest = -part.vertices[:, 2].min()
    poses = []
    for k in range(count):
        layer, place = divmod(k, 2)
        x = (place - 0.5) * 1.15 * size + rng.uniform(-0.1, 0.1) * size
        poses.append(Pose(position=(x, rng.uniform(-0.1, 0.1) * size, 0.005 + lowest + 1.15 * size * layer)))
    return Pile(name=f"{count} blobs of {vertices} vertices", part=part, poses=tuple(poses), size=size)


def _same_points(found: NDArray[np.float64], given: NDArray[np.float64]) -> NDArray[np.int64]:
    """Index in `given` of every point of `found`."""
    from scipy.spatial import cKDTree

    return cKDTree(given).query(found)[1]
