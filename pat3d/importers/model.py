"""What the readers of whole scenes return: objects in metres with z up, wherever they came from."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from pat3d.assets.library.body import Body
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Attachment

GROUND_NAMES = re.compile(r"ground|floor", re.IGNORECASE)
"""A level box that does not move and is called so is the ground, as a level plane is whatever its name."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ImportedObject:
    """One rigid object of a file."""

    name: str
    pose: Pose
    """Of its frame in the world."""
    body: Body
    """Shapes, mass and friction in its frame [m]."""
    fixed: bool = False
    joint: str = ""
    """What gives it other freedom than a loose object has, or takes some of that; empty where nothing does."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ImportedScene:
    """What was read from a file."""

    path: Path
    format: str
    """mjcf, urdf, sdf or usd."""
    objects: tuple[ImportedObject, ...]
    ground: float | None = None
    """Height of the ground [m]; None where the file has none."""
    attachments: tuple[Attachment, ...] = ()
    """By the names of the objects."""
    notes: tuple[str, ...] = ()
    """What was left out or assumed."""


def is_ground(name: str, body: Body, pose: Pose) -> float | None:
    """Height of the top [m] where a thing that does not move is the ground: called so, level, flat; else None."""
    if not GROUND_NAMES.search(name):
        return None
    points = pose.apply(body.mesh.vertices)
    low, high = points.min(axis=0), points.max(axis=0)
    top = points[points[:, 2] > high[2] - 1e-6 * max(1.0, float((high - low).max()))]
    # As wide at the top as anywhere: no step, rim or slope above it.
    covered = bool(((top.max(axis=0) - top.min(axis=0))[:2] > 0.999 * (high - low)[:2]).all())
    return float(high[2]) if covered and len(top) >= 4 else None
