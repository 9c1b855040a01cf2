"""How an object of a picture stands and where its front points, as somebody says of it.

Pixels of a thing that looks nearly the same from both sides do not tell which of them is seen, and those of an asset of
other proportions not whether it lies; words decide where drawings are nearly as good as one another, and nowhere else.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from pat3d.vision.camera import Array

Posture = Literal["usual", "on its side", "upside down", "leaning"]
Facing = Literal["viewer", "away", "left", "right", "unclear"]

FRONT = np.array([0.0, -1.0, 0.0])
"""Of every asset in its own frame."""


@dataclass(frozen=True, kw_only=True)
class Stance:
    """What is said of one object."""

    posture: Posture = "usual"
    """Whether it stands or lies as such things usually do."""
    facing: Facing = "unclear"
    """Where its front points, as the viewer sees it."""

    @property
    def fallen(self) -> bool:
        """Whether it is said not to be upright."""
        return self.posture != "usual"

    def denies(self, rotation: Array, ray: Array) -> bool:
        """Whether the front of an asset at `rotation`, shape (3, 3), points to the half opposite to what is said.

        Args:
            rotation: z up.
            ray: direction from the camera to the object, shape (3,).
        """
        if self.facing == "unclear":
            return False
        away = np.array([ray[0], ray[1], 0.0])
        right = np.array([ray[1], -ray[0], 0.0])
        wanted = {"viewer": -away, "away": away, "left": -right, "right": right}[self.facing]
        return float((rotation @ FRONT) @ wanted) < 0.0
