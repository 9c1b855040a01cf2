"""Stacks of irregular blocks that fall over when they are simply aligned."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pat3d.assets import shapes
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Relation
from tests.layout.things import asset


def irregular_block(rng: np.random.Generator, angle: float, side: float = 0.1, height: float = 0.05) -> Asset:
    """A block whose top is smaller, off towards `angle` and slightly tilted, and whose weight is on the other side."""
    towards = np.array([np.cos(angle), np.sin(angle)])
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    bottom = 0.5 * side * corners
    top = bottom * rng.uniform(0.5, 0.65) + 0.14 * side * towards
    tilt = np.tan(np.radians(rng.uniform(-1.5, 1.5, 2)))
    points = [*[(*xy, 0.0) for xy in bottom], *[(*xy, height + float(tilt @ xy)) for xy in top]]
    made = asset("block", shapes.convex(points))
    properties = made.mass_properties
    centre = np.array(properties.centre_of_mass) - np.array([*(rng.uniform(0.28, 0.34) * side * towards), 0.0])
    return replace(made, mass_properties=replace(properties, centre_of_mass=tuple(map(float, centre))))


def stack(seed: int, count: int = 6) -> tuple[dict[str, Asset], tuple[Relation, ...], dict[str, Pose]]:
    """Blocks one on another, the middles of their boxes aligned, 3 mm apart."""
    rng = np.random.default_rng(seed)
    angle = rng.uniform(-np.pi, np.pi)
    assets = {f"block {k + 1}": irregular_block(rng, angle + rng.uniform(-0.5, 0.5)) for k in range(count)}
    names = list(assets)
    relations = [Relation(child=a, kind="on", parent=b) for a, b in zip(names[1:], names[:-1], strict=True)]
    poses, height = {}, 0.003
    for name, made in assets.items():
        low, high = made.bounds
        middle = (low + high) / 2
        poses[name] = Pose(position=(-middle[0], -middle[1], height - low[2]))
        height += high[2] - low[2] + 0.003
    return assets, tuple(relations), poses
