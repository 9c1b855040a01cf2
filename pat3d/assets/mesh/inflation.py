"""How much larger a convex part is than what it stands for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from pat3d.geometry.hulls import ConvexPart


@dataclass(frozen=True, kw_only=True)
class Inflation:
    """How much larger a part is than the hull it replaces."""

    distance: float
    """Largest distance of a vertex of the part from the hull [m]."""
    volume: float
    """Volume added, as a fraction of the hull's volume [-]."""


def inflation(part: ConvexPart, points: NDArray[np.float64]) -> Inflation:
    """How far `part` reaches beyond the hull of `points` [m], shape (n, 3)."""
    hull = ConvexHull(points)
    distance = (part.vertices @ hull.equations[:, :3].T + hull.equations[:, 3]).max()
    return Inflation(
        distance=max(0.0, float(distance)), volume=float(ConvexHull(part.vertices).volume / hull.volume) - 1
    )
