"""Each verb of the shape language, made by the functions that the catalogue's recipes call."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from pat3d.assets import rounded, shapes
from pat3d.assets.catalogue.joinery import resting_ball
from pat3d.assets.shapes import Shape
from pat3d.errors import AssetError


def _triple(point: Any) -> tuple[float, float, float]:
    x, y, z = point
    return float(x), float(y), float(z)


def _three(said: Mapping[str, Any]) -> tuple[float, float, float]:
    return _triple(said["size"])


def _triples(points: Any) -> list[tuple[float, float, float]]:
    return [_triple(point) for point in points]


def _pairs(points: Any) -> list[tuple[float, float]]:
    return [(float(a), float(b)) for a, b in points]


def _rising(points: Any) -> list[tuple[float, float]]:
    profile = _pairs(points)
    if any(second[1] <= first[1] for first, second in zip(profile, profile[1:], strict=False)):
        raise AssetError("z must increase from each point of the profile to the next.")
    if min(radius for radius, _ in profile) < 0:
        raise AssetError("radii must not be negative.")
    return profile


def _sides(said: Mapping[str, Any], usual: int) -> int:
    return int(said.get("sides", usual))


def _tube(said: Mapping[str, Any]) -> Shape:
    path, radius = np.array(_triples(said["path"])), said["radius"]
    count = said.get("smooth")
    if count:
        if isinstance(radius, list):
            steps = np.linspace(0.0, 1.0, int(count))
            radius = np.interp(steps, np.linspace(0.0, 1.0, len(radius)), radius)
        path = rounded.curve(path, int(count))
    return rounded.tube(
        path, radius, int(said["groups"]), up=tuple(said.get("up", (0.0, 0.0, 1.0))),
        closed=bool(said.get("closed", False)), sides=_sides(said, 8), flatness=float(said.get("flatness", 1.0)),
    )  # fmt: skip


def _lathe(said: Mapping[str, Any]) -> Shape:
    profile = np.array(_pairs(said["profile"]))
    if said.get("smooth"):
        profile = rounded.curve(profile, int(said["smooth"]))
    return rounded.lathe(profile, said.get("cuts", ()), said.get("angles", ()), sides=int(said.get("sides", 0)))


MADE: Mapping[str, Callable[[Any], Shape]] = {
    "box": lambda said: shapes.box(*said),
    "soft_box": lambda said: shapes.soft_box(*_three(said), radius=said["radius"]),
    "slab": lambda said: rounded.slab(*_three(said), corner=said["corner"]),
    "taper": lambda said: rounded.taper(tuple(said["bottom"]), tuple(said["top"]), said["height"]),
    "frustum": lambda said: shapes.frustum(said["bottom"], said["top"], said["height"], _sides(said, 0)),
    "cylinder": lambda said: shapes.cylinder(said["radius"], said["height"], _sides(said, 0)),
    "cone": lambda said: shapes.cone(said["radius"], said["height"], _sides(said, 0)),
    "ellipsoid": lambda said: shapes.ellipsoid(*said),
    "spot": lambda said: rounded.spot(*said),
    "rod": lambda said: shapes.rod(
        _triple(said["from"]), _triple(said["to"]), said["radius"], said.get("end_radius"), _sides(said, 0)
    ),
    "bent_rod": lambda said: shapes.bent_rod(_triples(said["points"]), said["radius"], _sides(said, 0)),
    "tube": _tube,
    "hull": lambda said: shapes.convex(_triples(said)),
    "lump": lambda said: rounded.lump(_triples(said)),
    "prism": lambda said: shapes.prism(_pairs(said["outline"]), said["height"]),
    "extruded": lambda said: rounded.extruded(_pairs(said["outline"]), said["height"], _sides(said, 8)),
    "revolve": lambda said: shapes.turned_solid(_rising(said["profile"]), _sides(said, 0)),
    "lathe": _lathe,
    "vessel": lambda said: shapes.vessel(_rising(said["outer"]), _rising(said["inner"]), int(said.get("segments", 16))),
    "hollow": lambda said: rounded.hollow(
        _rising(said["outer"]), _rising(said["inner"]), said.get("levels", ()), int(said.get("segments", 12))
    ),
    "ball": lambda said: resting_ball(said),
    "tray": lambda said: shapes.tray(
        *_three(said), wall=said["wall"], floor=said["floor"], flare=said.get("flare", 0.0)
    ),
}
"""What makes a shape of every verb's numbers, but for `join` and `use`."""


def stepped(shape: Shape, step: str, said: Any) -> Shape:
    """`shape` after one step of `then`."""
    if step == "move":
        return shape.moved(*said)
    if step == "turn":
        ((axis, degrees),) = said.items()
        return shape.turned(axis, degrees)
    if step == "scale":
        factors = said if isinstance(said, list) else [said]
        if min(factors) <= 0:
            raise AssetError(f"factors must be positive, got {factors}; mirror turns things over.")
        return shape.scaled(*factors)
    if step == "mirror":
        return shape.mirrored(said)
    if step == "cut_below":
        return shape.cut_below(said)
    if step == "cut_above":
        return shape.cut_above(said)
    if step == "line":
        copies = [shape.moved(*(at * side for side in said["step"])) for at in range(int(said["count"]))]
        return rounded.merged(copies)
    if step == "circle":
        return rounded.ring_of(shape, said["radius"], int(said["count"]), float(said.get("start", 0.0)))
    if step == "lobed":
        return rounded.lobed(shape, int(said["lobes"]), float(said["depth"]))
    return rounded.unseen(shape)
