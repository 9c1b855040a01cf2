"""Assets for the layout tests, made from shapes alone."""

from __future__ import annotations

import manifold3d
import numpy as np

from pat3d.assets import shapes
from pat3d.assets.catalogue.assemble import assemble
from pat3d.assets.catalogue.registry import Build
from pat3d.assets.materials import material
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, Region


def asset(noun: str, shape: shapes.Shape, *regions: Region, mass: float | None = None) -> Asset:
    build = Build(parts=((shape, (180, 140, 90)),), regions=regions, mass=mass)
    return assemble(noun, build, material=material("wood"), scale=1.0, provenance={})


def block(x: float = 0.06, y: float = 0.06, z: float = 0.06, noun: str = "block") -> Asset:
    return asset(noun, shapes.box(x, y, z))


def ball(radius: float = 0.035) -> Asset:
    return asset("ball", shapes.ellipsoid(radius).moved(z=radius), mass=0.05)


def pen(length: float = 0.15, radius: float = 0.004) -> Asset:
    return asset("pen", shapes.cylinder(radius, length, sides=8).turned("y", 90))


def table(x: float = 1.2, y: float = 0.8, z: float = 0.74) -> Asset:
    legs = [
        shapes.box(0.05, 0.05, z - 0.04).moved(x=i * (x / 2 - 0.04), y=j * (y / 2 - 0.04))
        for i in (-1, 1)
        for j in (-1, 1)
    ]
    return asset("table", shapes.join(shapes.box(x, y, 0.04).moved(z=z - 0.04), *legs))


def vessel(radius: float, height: float, wall: float = 0.006, taper: float = 0.8, noun: str = "bowl") -> Asset:
    base = taper * radius
    shape = shapes.vessel([(base, 0.0), (radius, height)], [(base - wall, wall), (radius - wall, height)], segments=12)
    inside = (base - wall) * np.cos(np.pi / 12)
    return asset(
        noun,
        shape,
        Region(kind="in", shape="disc", floor=(0, 0, wall), half_size=(inside, inside), height=height - wall),
        Region(kind="on", shape="disc", floor=(0, 0, height), half_size=(radius, radius)),
    )


def mug() -> Asset:
    return vessel(0.04, 0.1, wall=0.004, taper=0.95, noun="mug")


def shelf(width: float = 0.8, depth: float = 0.3, floors: int = 3, between: float = 0.3) -> Asset:
    boards = [shapes.box(width, depth, 0.02).moved(z=k * between) for k in range(floors + 1)]
    tall = floors * between + 0.02
    sides = [shapes.box(0.02, depth, tall).moved(x=s * (width / 2 + 0.01)) for s in (-1, 1)]
    regions = [
        Region(
            kind="on",
            shape="rectangle",
            floor=(0, 0, k * between + 0.02),
            half_size=(width / 2 - 0.01, depth / 2),
            height=between - 0.02,
            enclosed=True,
        )
        for k in range(floors)
    ]
    return asset("shelf", shapes.join(*boards, *sides), *regions)


def tree_with_branch() -> Asset:
    trunk = shapes.cylinder(0.1, 3.0)
    branch = shapes.box(1.6, 0.12, 0.12).moved(x=0.8, z=2.4)
    return asset("tree", shapes.join(trunk, branch))


def gap_by_manifold(assets: dict[str, Asset], poses: dict[str, Pose], search: float = 0.02) -> tuple[float, str]:
    """Smallest distance between two objects' parts [m], by a library that the layout does not use."""
    solids = {}
    for name, made in assets.items():
        pose = poses[name]
        solids[name] = [
            manifold3d.Manifold(
                manifold3d.Mesh64(vert_properties=pose.apply(part.vertices), tri_verts=part.faces.astype(np.uint64))
            )
            for part in made.parts
        ]
    boxes = {name: [np.reshape(solid.bounding_box(), (2, 3)) for solid in parts] for name, parts in solids.items()}
    best, pair = search, ""
    names = list(solids)
    for i, first in enumerate(names):
        for second in names[i + 1 :]:
            for a, box_a in zip(solids[first], boxes[first], strict=True):
                for b, box_b in zip(solids[second], boxes[second], strict=True):
                    if np.any(box_a[0] - box_b[1] > best) or np.any(box_b[0] - box_a[1] > best):
                        continue
                    gap = 0.0 if not (a ^ b).is_empty() else a.min_gap(b, best)
                    if gap < best:
                        best, pair = gap, f"{first} / {second}"
    return best, pair
