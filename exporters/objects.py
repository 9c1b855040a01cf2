"""What the formats with a folder for each object have in common: names, mesh files, the ground."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pat3d.assets.asset import Asset
from pat3d.exporters.meshes import hull_obj, part_file, write_visual
from pat3d.exporters.mjcf import GROUND_FRICTION, GROUND_HALF_THICKNESS, body_names
from pat3d.scene import Scene

SIDE = 10.0
"""Full width of the ground [m], at least."""


def stored_assets(scene: Scene) -> dict[int, str]:
    """Folder name of every asset of `scene` by its identity; objects that share one share the files."""
    bodies = body_names(scene)
    return {id(obj.asset): bodies[obj.name] for obj in reversed(scene.objects)}


def ground_size(scene: Scene) -> tuple[float, float, float]:
    """Full sizes [m] of the box below z = 0 that is the ground."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    side = max(SIDE, 4.0 * float(np.abs(points[:, :2]).max()) + 1.0)
    return side, side, 2.0 * GROUND_HALF_THICKNESS


def ground_friction(scene: Scene) -> float:
    """Friction coefficient [-] of the ground, as in the MJCF."""
    return max(GROUND_FRICTION, scene.settling_friction)


def write_meshes(asset: Asset, folder: Path) -> None:
    """Write the textured mesh and every part of one asset into `folder`."""
    write_visual(asset.visual, folder)
    for number, part in enumerate(asset.parts):
        (folder / part_file(number)).write_text(hull_obj(part.vertices, part.faces), encoding="utf-8")
