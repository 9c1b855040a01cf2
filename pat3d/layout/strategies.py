"""How closely things may stand, from their natural gaps on to turned by a quarter and over the edge a little."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from pat3d.layout.flat import Item, Surface


@dataclass(frozen=True, kw_only=True)
class Strategy:
    """What a search for places allows itself."""

    spacing: float
    """Factor on the natural gaps."""
    least: float
    """Smallest gap [m]."""
    quarters: bool = False
    largest_first: bool = False
    overhang: float = 0.0
    """Share of an item's size that may stand over the edge."""


STRATEGIES = (
    Strategy(spacing=1.0, least=0.02),
    Strategy(spacing=0.5, least=0.01),
    Strategy(spacing=0.0, least=0.01),
    Strategy(spacing=0.0, least=0.004, largest_first=True),
    Strategy(spacing=0.0, least=0.01, quarters=True),
    Strategy(spacing=0.0, least=0.004, quarters=True, largest_first=True),
    Strategy(spacing=0.0, least=0.004, overhang=0.15, largest_first=True),
    Strategy(spacing=0.0, least=0.004, quarters=True, largest_first=True, overhang=0.3),
)
"""In the order in which they are tried; on the ground, which has no edge, the first two."""


def too_many(items: Sequence[Item], surface: Surface, strategy: Strategy) -> bool:
    """Whether the items cannot lie side by side, however they are arranged.

    Grown by half a gap on every side they still do not overlap, and lie in the surface's rectangle grown likewise (and
    by what may stand over the edge).
    """
    if not surface.limited:
        return False
    sizes = np.array([item.size for item in items])
    widest = np.full(2, sizes.max()) if strategy.quarters else sizes.max(axis=0)
    space = 2 * np.array(surface.half_size) + 2 * strategy.overhang * widest + strategy.least
    return float(np.prod(sizes + strategy.least, axis=1).sum()) > 1.001 * float(np.prod(space))
