"""Free space on a top that carries things: whether one more fits there."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import narrowest
from pat3d.scene.asset import Region
from pat3d.scene.model import Scene

Array = NDArray[np.float64]

FINGER_GAP = 0.03
"""Between what stands there and what is put down, for a finger [m]."""

NARROWEST_BASE = 0.4
"""Least width of a base as a share of that of what is put on it."""

_CELL = 0.01
"""Between the spots that are tried [m]."""


def edge_margin(scene: Scene, target: str) -> float:
    """How far inside the edge of a top the middle of `target` has to be [m]."""
    return max(0.01, NARROWEST_BASE * narrowest(scene[target]) / 2)


def has_free_space(scene: Scene, target: str, where: str, top: Region, covering: list[str]) -> bool:
    """Whether `target` can be put on `where` beside everything in `covering`, however it is turned."""
    spots = _spots(top, edge_margin(scene, target))
    own = _outline(scene, target, target)
    radius = float(np.linalg.norm(own - (own.min(axis=0) + own.max(axis=0)) / 2, axis=1).max())
    for name in covering:
        points = _outline(scene, name, where)
        low, high = points.min(axis=0), points.max(axis=0)
        away = np.linalg.norm(np.maximum(np.maximum(low - spots, spots - high), 0.0), axis=1)
        spots = spots[away > radius + FINGER_GAP]
    return len(spots) > 0


def _spots(top: Region, margin: float) -> Array:
    """Points of a floor that are `margin` [m] inside its edge, in the frame of its object [m], shape (n, 2)."""
    half = np.maximum(np.array(top.half_size[:2]) - margin, 0.0)
    x, y = (_CELL * np.arange(-int(side / _CELL), int(side / _CELL) + 1) for side in half)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    if top.shape == "disc":
        points = points[np.linalg.norm(points, axis=1) <= half[0] + 1e-9]
    return np.asarray(points + np.array(top.floor[:2]), dtype=np.float64)


def _outline(scene: Scene, name: str, frame: str) -> Array:
    """Corners of an object as seen from above in the frame of another [m], shape (n, 2)."""
    pose = scene[frame].pose
    points = np.concatenate([scene[name].pose.apply(part.vertices) for part in scene[name].asset.parts])
    return ((points - np.array(pose.position)) @ pose.rotation)[:, :2]
