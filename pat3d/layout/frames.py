"""Cavities and support surfaces in the layout's frame: at the root's origin, axes parallel to the world's."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from pat3d.geometry.rotations import yaw_of
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.containers import Column
from pat3d.layout.flat import Surface
from pat3d.scene.asset import Region

_UPRIGHT = math.cos(math.radians(3.0))


@dataclass(frozen=True, kw_only=True)
class FlatRegion:
    """A floor for children, and the air above it."""

    centre: Array
    """Centre of the floor [m], shape (3,), relative to the root's origin."""
    surface: Surface
    height: float
    """Free height [m]."""
    enclosed: bool
    """Whether something above limits the height of children."""


def upright(body: Placed) -> bool:
    """Whether the body's own vertical is the world's, to 3 degrees."""
    return bool(body.rotation[2, 2] > _UPRIGHT)


def column_of(body: Placed) -> Column | None:
    """The cavity of an upright body, or None; of several compartments the first."""
    return next(iter(columns_of(body)), None)


def columns_of(body: Placed) -> list[Column]:
    """The cavities of an upright body."""
    return [
        Column(
            centre=body.rotation @ np.array(region.floor) + body.position,
            half_size=np.array(region.half_size),
            yaw=yaw_of(body.rotation),
            disc=region.shape == "disc",
            height=region.height if math.isfinite(region.height) else float(body.body.asset.size[2]),
            capped=region.enclosed,
        )
        for region in body.body.asset.regions
        if region.kind == "in" and upright(body)
    ]


def column_at(body: Placed, height: float) -> Column | None:
    """The cavity of an upright body that begins nearest below `height` [m], or else the first; None without."""
    columns = columns_of(body)
    below = [column for column in columns if column.centre[2] <= height]
    return max(below, key=lambda column: float(column.centre[2])) if below else next(iter(columns), None)


def flat_regions(body: Placed, kind: Literal["on", "in"] = "on") -> list[FlatRegion]:
    """Floors for children, best first; the top of the bounding box of a body that lies on its side."""
    regions = [region for region in body.body.asset.regions if region.kind == kind]
    if not upright(body) or not regions:
        half = (body.high - body.low) / 2
        centre = np.array([*(body.low + half)[:2], body.high[2]])
        surface = Surface(half_size=(float(half[0]), float(half[1])))
        return [FlatRegion(centre=centre, surface=surface, height=math.inf, enclosed=False)]
    return [_flat(region, body) for region in regions]


def _flat(region: Region, body: Placed) -> FlatRegion:
    centre = body.rotation @ np.array(region.floor) + body.position
    a, b = region.half_size
    if region.shape != "disc":
        # The largest rectangle of the same proportions, parallel to the axes, inside the turned one.
        c, s = abs(math.cos(yaw_of(body.rotation))), abs(math.sin(yaw_of(body.rotation)))
        x, y = (b, a) if s > c else (a, b)
        c, s = max(c, s), min(c, s)
        share = min(x / (x * c + y * s), y / (x * s + y * c))
        a, b = x * share, y * share
    return FlatRegion(
        centre=centre,
        surface=Surface(half_size=(float(a), float(b)), disc=region.shape == "disc"),
        height=region.height,
        enclosed=region.enclosed,
    )
