"""Random scenes that fall: what a robust simulator must bring to rest without ever intersecting."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import trimesh

from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from tests.sim.builders import box_points, random_hull

KINDS = ("convex", "concave", "thin", "tiny-beside-huge", "sharp", "lumpy")
"""Hulls; unions of hulls; plates of 0.5 mm; mass ratios of a million; needle pyramids; surfaces in clusters."""


def add_parts(builder: ModelBuilder, parts: list[ConvexPart], pose: Pose, *, density: float) -> int:
    """Add a body whose mass is that of its parts, overlaps counted twice."""
    each = [mass_properties(part.vertices, part.faces, density=density) for part in parts]
    mass = sum(properties.mass for properties in each)
    centre = sum((p.mass * np.array(p.centre_of_mass) for p in each), np.zeros(3)) / mass
    moment = np.zeros((3, 3))
    for properties in each:
        offset = np.array(properties.centre_of_mass) - centre
        moment += properties.second_moment + properties.mass * np.outer(offset, offset)
    return builder.add_body(parts, mass=mass, volume=mass / density, centre=centre, second_moment=moment, pose=pose)


def random_body(kind: str, rng: np.random.Generator) -> list[ConvexPart]:
    """Parts of a body of `kind` about its origin, at most about 0.15 m across."""
    if kind == "concave":
        parts = []
        for _ in range(int(rng.integers(2, 5))):
            points = random_hull(rng, 0.08) if rng.random() < 0.5 else box_points(*rng.uniform(0.01, 0.1, 3))
            parts.append(convex_part(points + rng.uniform(-0.04, 0.04, 3)))
        return parts
    if kind == "thin":
        return [convex_part(box_points(*rng.uniform(0.03, 0.12, 2), 5e-4))]
    if kind == "sharp":
        base = int(rng.integers(3, 7))
        angle = 2 * np.pi * np.arange(base) / base
        radius, height = rng.uniform(0.002, 0.01), rng.uniform(0.06, 0.12)
        ring = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.zeros(base)], axis=1)
        return [convex_part(np.vstack([ring, [[0.0, 0.0, height]]]) - [0, 0, height / 2])]
    if kind == "lumpy":
        sphere = trimesh.creation.icosphere(subdivisions=2)
        x = np.asarray(sphere.vertices)
        waves = rng.uniform(-5, 5, (3, 3))
        lumps = 1 + 0.12 * np.sin(x @ waves + rng.uniform(0, 6, 3)).sum(axis=1)
        vertices = rng.uniform(0.02, 0.05) * lumps[:, None] * x * rng.uniform(0.5, 1.0, 3)
        return [ConvexPart(vertices=vertices, faces=np.asarray(sphere.faces, dtype=np.int32))]
    return [convex_part(random_hull(rng) * rng.uniform(0.3, 1.2))]


def add_random_bodies(builder: ModelBuilder, kind: str, seed: int) -> None:
    """Add four bodies of `kind` above one another, in random orientations, to the present world."""
    rng = np.random.default_rng([KINDS.index(kind), seed])
    height = 0.02
    for i in range(4):
        scale, density = 1.0, float(10 ** rng.uniform(1.5, 3.5))
        if kind == "tiny-beside-huge":
            scale, density = (2.0, 1000.0) if i % 2 else (0.02, 1000.0)
        parts = [ConvexPart(vertices=part.vertices * scale, faces=part.faces) for part in random_body(kind, rng)]
        quat = rng.normal(size=4)
        radius = max(np.linalg.norm(part.vertices, axis=1).max() for part in parts)
        height += radius + 0.002
        place = (*(rng.uniform(-0.03, 0.03, 2) * scale), height)
        height += radius
        add_parts(builder, parts, Pose(position=place, quat_wxyz=tuple(quat / np.linalg.norm(quat))), density=density)


def random_scene(kind: str, seed: int) -> Model:
    """One world of four bodies of `kind`."""
    return random_scenes(kind, [seed])


def random_scenes(kind: str, seeds: Sequence[int]) -> Model:
    """A world of four bodies of `kind` for every seed."""
    builder = ModelBuilder()
    for seed in seeds:
        builder.new_world()
        add_random_bodies(builder, kind, seed)
    return builder.finalize("cpu")
