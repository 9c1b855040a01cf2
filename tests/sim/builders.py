"""Bodies for simulator tests."""

from __future__ import annotations

import numpy as np

from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder


def box_points(x: float, y: float, z: float) -> np.ndarray:
    return np.array([[i, j, k] for i in (-x / 2, x / 2) for j in (-y / 2, y / 2) for k in (-z / 2, z / 2)])


def add_hull(
    builder: ModelBuilder, points: np.ndarray, pose: Pose, *, density: float = 500.0, fixed: bool = False
) -> int:
    """Add the convex hull of `points` as a body whose frame is the points' frame."""
    part = convex_part(points)
    properties = mass_properties(part.vertices, part.faces, density=density)
    return builder.add_body(
        [part],
        mass=properties.mass,
        volume=properties.volume,
        centre=np.array(properties.centre_of_mass),
        second_moment=properties.second_moment,
        pose=pose,
        fixed=fixed,
    )


def random_hull(rng: np.random.Generator, size: float = 0.1) -> np.ndarray:
    points = rng.normal(size=(int(rng.integers(6, 20)), 3))
    return size / 2 * points / np.linalg.norm(points, axis=1, keepdims=True) * rng.uniform(0.5, 1.0, size=3)
