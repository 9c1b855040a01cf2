"""Items, surfaces and lateral relations of a flat arrangement, seen from above: the input of rectangle packing."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from pat3d.layout.bodies import Array

_MOUSE, _COMPUTERS = "computer mouse", frozenset({"laptop", "keyboard", "computer"})
"""Most people's mouse is right of what they type on."""
WRONG_HAND = 0.5
"""What the other side weighs [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Item:
    """What is placed: the outline of a group relative to its root's origin."""

    name: str
    low: Array
    """Lower corner of the bounding rectangle [m], shape (2,)."""
    high: Array
    """Upper corner [m], shape (2,)."""
    outline: Array
    """Points whose hull is the footprint [m], shape (n, 2)."""
    centre_of_mass: Array
    """[m], shape (2,)."""
    tall: float
    """Height above the surface [m]."""
    alike: str = ""
    """What it is; things alike keep closer together."""
    turnable: bool = True
    """Whether it may be turned by a quarter to fit."""
    walled: bool = False
    """Whether it is furniture that stands with its back to a wall."""
    middle: Array = field(default_factory=lambda: np.zeros(2))
    """Middle of the root's bounding box [m], shape (2,): what is aligned in rows."""

    @property
    def size(self) -> Array:
        """Extents [m], shape (2,)."""
        return self.high - self.low

    def quarter(self) -> Item:
        """The item turned by 90 degrees about its origin."""
        turn = np.array([[0.0, -1.0], [1.0, 0.0]])
        corners = np.array([self.low, self.high]) @ turn.T
        return Item(
            name=self.name,
            low=corners.min(axis=0),
            high=corners.max(axis=0),
            outline=self.outline @ turn.T,
            centre_of_mass=turn @ self.centre_of_mass,
            tall=self.tall,
            alike=self.alike,
            turnable=False,
            walled=self.walled,
            middle=turn @ self.middle,
        )


@dataclass(frozen=True, kw_only=True)
class Surface:
    """A free rectangle or disc, or the unlimited ground."""

    half_size: tuple[float, float] = (math.inf, math.inf)
    """Half extents along x and y [m]."""
    disc: bool = False

    @property
    def limited(self) -> bool:
        """Whether it has an edge."""
        return math.isfinite(self.half_size[0])

    @property
    def area(self) -> float:
        """Area [m^2], infinite without an edge."""
        return (math.pi if self.disc else 4.0) * self.half_size[0] * self.half_size[1]


@dataclass(frozen=True, kw_only=True)
class Lateral:
    """`child` stands `kind` of `parent`, both on this surface."""

    child: str
    kind: str
    parent: str


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where an item's origin goes, relative to the centre of the surface."""

    position: Array
    """[m], shape (2,)."""
    quarter: bool = False
    """Whether it was turned by 90 degrees."""


def right_hand(item: Item, other: Item) -> float:
    """1 where `item` belongs right of `other` if nothing is said, -1 where left of it, 0 where anywhere."""
    if item.alike == _MOUSE and other.alike in _COMPUTERS:
        return 1.0
    return -1.0 if other.alike == _MOUSE and item.alike in _COMPUTERS else 0.0


def natural_gap(first: Array, second: Array) -> float:
    """Distance [m] at which a person stands two things of sizes [m], shape (2,), side by side."""
    small = min(float(np.sqrt(first[0] * first[1])), float(np.sqrt(second[0] * second[1])))
    return float(np.clip(0.3 * small, 0.03, 0.08)) if small < 0.5 else float(np.clip(0.15 * small, 0.08, 0.25))
