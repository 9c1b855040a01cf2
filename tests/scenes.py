"""Scenes built by hand for tests: assets from shapes, poses given."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from pat3d.assets.shapes import Shape, box
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, Material, Region, VisualMesh
from pat3d.scene.model import Scene, SceneObject

WOOD = Material(name="wood", density=650.0, friction=0.5)
GAP = 2.0e-5
"""[m], as settled scenes float."""


def asset_of(shape: Shape, *, material: Material = WOOD, noun: str = "thing") -> Asset:
    """An asset of `shape` in the frame it is given in."""
    mesh = shape.solid.to_mesh64()
    vertices, faces = np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts).astype(np.int32)
    colours = np.tile(np.array([200, 120, 60], dtype=np.uint8), (len(faces), 1))
    colours[::2] = (60, 120, 200)
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    return Asset(
        noun=noun,
        visual=VisualMesh.from_face_colours(vertices, faces, colours),
        parts=tuple(convex_part(points) for points in shape.hulls),
        mass_properties=mass_properties(vertices, faces, density=material.density),
        material=material,
        regions=(
            Region(
                kind="on",
                shape="rectangle",
                floor=(0.0, 0.0, float(high[2])),
                half_size=(float(high[0] - low[0]) / 2, float(high[1] - low[1]) / 2),
            ),
        ),
        provenance={"source": "test"},
    )


def placed(name: str, asset: Asset, position: Iterable[float] = (0, 0, 0), *, pose: Pose | None = None, fixed=False):
    """An object at `position`, or at `pose`."""
    pose = pose or Pose(position=tuple(position))  # type: ignore[arg-type]
    return SceneObject(name=name, asset=asset, pose=pose, initial_pose=pose, fixed=fixed)


def scene_of(*objects: SceneObject, **settings) -> Scene:
    """A scene of `objects`."""
    return Scene(objects=tuple(objects), **settings)


def tower(count: int, size: tuple[float, float, float] = (0.06, 0.06, 0.06), gap: float = GAP) -> Scene:
    """`count` boxes [m] on top of one another, `gap` [m] apart."""
    asset = asset_of(box(*size), noun="box")
    pitch = size[2] + gap
    return scene_of(*(placed(f"box {k + 1}", asset, (0, 0, gap + k * pitch)) for k in range(count)))
