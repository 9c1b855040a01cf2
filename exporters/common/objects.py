"""What the formats with a folder for each object have in common: names, mesh files, the ground."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pat3d.assets.materials import surface_of
from pat3d.scene.asset import Asset
from pat3d.scene.model import Scene
from pat3d.scene.naming import unique_slugs
from pat3d.scene.obj_files import hull_obj, part_file, write_visual

CONTACT_GAP = 1e-4
"""Bodies closer than this rest on one another [m]."""

GROUND_HALF_THICKNESS = 0.5
"""[m]"""

SIDE = 10.0
"""Full width of the ground [m], at least."""


def body_names(scene: Scene) -> dict[str, str]:
    """Name of every object's body in the files: "red mug 1" -> "red_mug_1"."""
    return unique_slugs((obj.name for obj in scene.objects), taken=("world", "ground"))


def stored_assets(scene: Scene) -> dict[int, str]:
    """Folder name of every asset of `scene` by its identity; objects that share one share the files."""
    bodies = body_names(scene)
    return {id(obj.asset): bodies[obj.name] for obj in reversed(scene.objects)}


def ground_size(scene: Scene) -> tuple[float, float, float]:
    """Full sizes [m] of the box below z = 0 that is the ground."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    side = max(SIDE, 4.0 * float(np.abs(points[:, :2]).max()) + 1.0)
    return side, side, 2.0 * GROUND_HALF_THICKNESS


def write_meshes(asset: Asset, folder: Path) -> None:
    """Write the textured mesh and every part of one asset into `folder`."""
    write_visual(asset.visual, folder, surface=surface_of(asset))
    for number, part in enumerate(asset.parts):
        (folder / part_file(number)).write_text(hull_obj(part.vertices, part.faces), encoding="utf-8")
