"""What a reader of a written file reports about every body, in one form for every format.

The readers of the formats return these; whether they agree with the Scene is decided elsewhere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.pose import Pose


@dataclass(frozen=True, kw_only=True, eq=False)
class BodyReadback:
    """One body of a written scene, as the format's own parser sees it."""

    name: str
    """Body name in the file, a slug of the object's name."""
    mass: float
    """[kg]"""
    centre: NDArray[np.float64]
    """Centre of mass [m] in the body frame, shape (3,)."""
    inertia: NDArray[np.float64]
    """Inertia tensor [kg m^2] about the centre of mass, in the axes of the body frame, shape (3, 3)."""
    friction: float
    """Sliding friction coefficient [-] of the body's colliders."""
    hulls: tuple[NDArray[np.float64], ...]
    """Corners of each collider [m] in the body frame, each of shape (corners, 3)."""
    pose: Pose
    """Of the body frame in the world."""
    fixed: bool
    """Whether the body is static in the file."""
