"""Building toys and games."""

from __future__ import annotations

from typing import Literal

import numpy as np

from pat3d.assets.catalogue.creature import DARK, WHITE
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import Shape, box, cylinder, ellipsoid, join, soft_box

_Axis = Literal["x", "y", "z"]


@entry("toy brick", family="toys", synonyms=("lego brick", "lego", "lego block", "plastic brick", "building brick",
       "lego duplo", "duplo block", "duplo"),
       colours=("red", "blue", "yellow", "green", "white"))  # fmt: skip
def toy_brick(style: Style) -> Build:
    """A large plastic building brick with two rows of four studs, 6.4 cm long."""
    colour = style.colour()
    pitch = style.vary(0.016, 0.02)
    body = box(4 * pitch, 2 * pitch, 1.2 * pitch)
    studs = join(
        *(
            cylinder(0.3 * pitch, 0.24 * pitch, 8).moved((i - 1.5) * pitch, (j - 0.5) * pitch, 1.19 * pitch)
            for i in range(4)
            for j in range(2)
        )
    )
    return Build(parts=((join(body, studs), colour),), mass=0.012)


@entry(
    "puzzle cube",
    family="toys",
    synonyms=("rubik's cube", "rubiks cube", "rubik cube", "magic cube", "speed cube"),
    colours=("black",),
)
def puzzle_cube(style: Style) -> Build:
    """A 5.7 cm cube with nine coloured stickers to a face, shuffled by seed."""
    side = style.vary(0.057, 0.03)
    pitch = side / 3
    palette: list[RGB] = [(190, 45, 42), (232, 126, 38), (240, 238, 233), (241, 200, 58), (52, 96, 170), (60, 150, 80)]
    order = style.rng.permutation(np.repeat(np.arange(6), 9))
    sticker = box(0.80 * pitch, 0.80 * pitch, 0.004).moved(z=side / 2 - 0.002)
    faces: list[tuple[_Axis, float]] = [("x", 0.0), ("x", 90.0), ("x", 180.0), ("x", 270.0), ("y", 90.0), ("y", 270.0)]
    groups: list[list[Shape]] = [[] for _ in palette]
    for cell, colour in enumerate(order):
        axis, angle = faces[cell // 9]
        placed = sticker.moved((cell % 3 - 1) * pitch, (cell // 3 % 3 - 1) * pitch).turned(axis, angle)
        groups[int(colour)].append(placed.moved(z=side / 2))
    return Build(
        parts=((box(side, side, side), style.colour()),),
        paint=tuple((join(*group), colour) for group, colour in zip(groups, palette, strict=True)),
        mass=0.095,
    )


def _pips(number: int, pitch: float) -> list[tuple[float, float]]:
    """Where the pips of a die's face lie [m]."""
    corners = [(-pitch, -pitch), (pitch, pitch), (-pitch, pitch), (pitch, -pitch), (-pitch, 0.0), (pitch, 0.0)]
    count = number - number % 2
    return corners[:count] + ([(0.0, 0.0)] if number % 2 else [])


@entry("die", family="toys", synonyms=("dice", "game die"), colours=("white", "red"))
def die(style: Style) -> Build:
    """A large game die with rounded edges, 3 cm wide; opposite faces add up to seven."""
    side = style.vary(0.030)
    colour = style.colour()
    turns: dict[int, tuple[_Axis, float]] = {
        1: ("x", 0.0),
        6: ("x", 180.0),
        2: ("x", 90.0),
        5: ("x", 270.0),
        3: ("y", 90.0),
        4: ("y", 270.0),
    }
    pips = [
        ellipsoid(0.085 * side, 0.085 * side, 0.04 * side)
        .moved(x, y, 0.504 * side)
        .turned(axis, angle)
        .moved(z=side / 2)
        for number, (axis, angle) in turns.items()
        for x, y in _pips(number, 0.25 * side)
    ]
    ink = DARK if sum(colour) > 450 else WHITE
    return Build(parts=((soft_box(side, side, side, 0.12 * side), colour),), paint=((join(*pips), ink),))


@entry(
    "domino",
    family="toys",
    synonyms=("domino tile",),
    plurals=("dominoes",),
    material="wood",
    colours=("black", "white"),
)
def domino(style: Style) -> Build:
    """A domino lying face up, 5 cm long."""
    colour = style.colour()
    long, wide, thick = style.vary(0.050), style.vary(0.025), 0.009
    first, second = (int(value) for value in style.rng.integers(1, 7, 2))
    spots = [
        ellipsoid(0.0023, 0.0023, 0.002).moved(x + side * long / 4, y, thick + 0.0003)
        for side, number in ((-1, first), (1, second))
        for x, y in _pips(number, 0.0065)
    ]
    ink = DARK if sum(colour) > 450 else WHITE
    return Build(
        parts=((box(long, wide, thick), colour),),
        paint=((join(*spots, box(0.0012, wide * 0.8, 0.002).moved(z=thick - 0.001)), ink),),
    )
