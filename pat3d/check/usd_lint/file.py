"""The opened file that the rules of the lint look at, and what several of them ask of it."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.exporters.usd.openusd import Prim, Stage, UsdGeom
from pat3d.exporters.usd.stage import Body, bodies, collider_points, loose_colliders, matrix, transformed

SINGLE = 1e-6
"""Relative rounding of numbers kept in single precision, with room."""

Faults = Iterator[tuple[Prim, str]]
"""What a rule finds: a prim, what is wrong with it, and what would be right."""


class LintFile:
    """The stage with its bodies and colliders."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.cache: Any = UsdGeom.XformCache()
        self.bodies = bodies(stage)
        self.loose = loose_colliders(stage, self.bodies)

    @cached_property
    def colliders(self) -> tuple[Prim, ...]:
        """Those of all bodies, and those of none."""
        return (*(prim for body in self.bodies for prim in body.colliders), *self.loose)

    def moving(self) -> Iterator[Body]:
        """The bodies that are not fixed."""
        return (body for body in self.bodies if not body.fixed)

    def world_points(self, collider: Prim) -> NDArray[np.float64] | None:
        """Points that span a collider [m], shape (n, 3); None for shapes that are neither mesh nor cube."""
        points = collider_points(collider)
        return None if points is None else transformed(points, matrix(collider, self.cache))
