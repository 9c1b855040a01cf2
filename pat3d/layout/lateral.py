"""Beside one another: what left_of, right_of, in_front_of, behind and next_to mean, in numbers.

The one place for it. The predicates of scenes (pat3d.layout.predicates) look at the poses of a scene, the judges of
tasks (pat3d.envs.tasks.beside_judge) at those of a simulation: a task is done when the scene's relation would hold. The
residuals that lead there (pat3d.optimize.lateral) share the constants. The viewer stands at -y and looks along +y.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.polygons import contains, outline, polygon_gap
from pat3d.scene.relations import SIDES

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

OVERLAPPING = 0.5
"""Boxes on two sides of one another overlap along the axis by at most this share of the smaller one."""

ASIDE = math.sqrt(3.0)
"""Tangent of 60 degrees: what is on a side is off the axis by at most that angle, or the boxes overlap across it."""

NEAR, FAR = 0.25, 1.0
"""The largest gap of things next to one another is the longest of their horizontal sides, but at least and at most
this [m]."""

APART = 0.1
"""Between the heights that things next to one another span, at most [m]."""


class Box(NamedTuple):
    """Lower and upper corners of bounding boxes [m], shape (..., 3)."""

    low: Array
    high: Array


class Sided(NamedTuple):
    """Whether things are on a side of others, and what was measured, each of the shape of the boxes' first axes."""

    holds: Mask
    along: Array
    """How far the middle is to that side [m]."""
    overlap: Array
    """Of the boxes along the axis, as a share of the smaller one; negative where they are apart."""
    aside: Array
    """How far the middle is aside, across the axis [m]."""
    aligned: Mask
    """Whether the offset is mostly along the axis, or the boxes overlap across it."""


def on_side(kind: str, child: Box, parent: Box) -> Sided:
    """Whether children are left_of, right_of, in_front_of or behind their parents (`kind`)."""
    axis, sign = SIDES[kind]
    offset = (child.low + child.high - parent.low - parent.high) / 2
    along = sign * offset[..., axis]
    both = np.minimum(child.high, parent.high) - np.maximum(child.low, parent.low)
    smaller = np.minimum(child.high - child.low, parent.high - parent.low)[..., axis]
    aside = np.abs(offset[..., 1 - axis])
    aligned = (both[..., 1 - axis] > 0.0) | (aside <= ASIDE * along)
    holds = (along > 0.0) & (both[..., axis] <= OVERLAPPING * smaller) & aligned
    return Sided(holds, along, both[..., axis] / smaller, aside, aligned)


def reach(first: Array, second: Array) -> Array:
    """Largest gaps [m] at which things of horizontal sizes [m], shape (..., 2), are next to each other."""
    return np.clip(np.maximum(first.max(axis=-1), second.max(axis=-1)), NEAR, FAR)


def height_gap(first: Box, second: Box) -> Array:
    """Between the heights that boxes span [m]; 0 where they overlap."""
    between = np.maximum(first.low - second.high, second.low - first.high)[..., 2]
    return np.asarray(np.maximum(between, 0.0))


class Seen(NamedTuple):
    """One thing at a pose."""

    footprint: Array
    """Outline seen from above [m], shape (n, 2), counter-clockwise."""
    centre: Array
    """Of mass, seen from above [m], shape (2,)."""
    box: Box

    @staticmethod
    def of(points: Array, centre: Array) -> Seen:
        """The thing with these corners [m], shape (n, 3), and this centre of mass [m], shape (3,)."""
        return Seen(outline(points[:, :2]), centre[:2], Box(points.min(axis=0), points.max(axis=0)))

    def shifted(self, by: Array) -> Seen:
        """The same, moved in the plane by [m], shape (2,)."""
        up = np.array([*by, 0.0])
        return Seen(self.footprint + by, self.centre + by, Box(self.box.low + up, self.box.high + up))


class Beside(NamedTuple):
    """Whether two things are next to each other, and what was measured."""

    holds: bool
    gap: float
    """Between the footprints [m]."""
    limit: float
    """The largest gap [m]."""
    apart: float
    """Between the heights that they span [m]."""
    stacked: bool
    """Whether the centre of one is over the other."""


def next_to(child: Seen, parent: Seen, *, farther: float = 1.0) -> Beside:
    """Whether two things are next to each other, with a largest gap that is `farther` times the usual one."""
    sizes = [(one.box.high - one.box.low)[:2] for one in (child, parent)]
    limit = farther * float(reach(*sizes))
    gap = polygon_gap(child.footprint, parent.footprint)
    apart = float(height_gap(child.box, parent.box))
    stacked = contains(parent.footprint, child.centre) or contains(child.footprint, parent.centre)
    return Beside(gap <= limit and apart <= APART and not stacked, gap, limit, apart, stacked)


def related(kind: str, child: Seen, parent: Seen) -> bool:
    """Whether `child` is left_of, right_of, in_front_of, behind or next_to `parent` (`kind`)."""
    return bool(on_side(kind, child.box, parent.box).holds) if kind in SIDES else next_to(child, parent).holds
