"""Sports gear, helmets and what grows outside."""

from __future__ import annotations

import numpy as np

from pat3d.assets.catalogue.joinery import (
    cavity,
    disc_top,
    drawn,
    padded,
    resting_ball,
    shelf_top,
    span,
    together,
)
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import curve, extruded, lathe, slab, tube, unseen
from pat3d.assets.shapes import Shape, box, cylinder, join, tray


@entry("helmet", family="outdoor", material="plastic", colours=("yellow", "white", "red", "blue"), accents=("black",),
       synonyms=("hard hat", "safety helmet", "bike helmet", "bicycle helmet", "construction helmet"))  # fmt: skip
def helmet(style: Style) -> Build:
    """A hard hat standing on its brim, closed to contact, its peak to the front."""
    k = style.vary(1.0, 0.04)
    dome = [(0.125, 0.0), (0.125, 0.05), (0.108, 0.1), (0.065, 0.138), (0.015, 0.15)]
    shell = lathe(curve(dome, 24)).scaled(0.9, 1.08, 1)
    brim = extruded(
        np.column_stack([0.14 * np.cos(t := np.linspace(0, 2 * np.pi, 49)[:-1]), 0.165 * np.sin(t) - 0.018]),
        0.009,
        sides=16,
    )
    ribs = unseen(join(*(box(0.01, 1, 0.2).moved(s * 0.03, -0.0, 0.06) for s in (-1, 0, 1))))
    return Build(
        parts=((shell.scaled(k), style.colour()), (brim.scaled(k), style.colour())),
        paint=((ribs.scaled(k), style.shade(style.colour(), 0.8)),),
        mass=0.36,
    )


@entry("kettlebell", family="outdoor", material="iron", colours=("black", "red", "blue"), synonyms=("kettle bell",))
def kettlebell(style: Style) -> Build:
    """A cast kettlebell of four kilograms with an arched handle."""
    k = style.vary(1.0, 0.03)
    body = lathe(curve([(0.04, 0), (0.062, 0.025), (0.068, 0.06), (0.058, 0.098), (0.03, 0.118)], 24))
    path = [
        (-0.046, 0, 0.09),
        (-0.058, 0, 0.13),
        (-0.036, 0, 0.165),
        (0.036, 0, 0.165),
        (0.058, 0, 0.13),
        (0.046, 0, 0.09),
    ]
    handle = tube(curve(path, 41), 0.0135, 6, up=(0, 1, 0))
    return Build(parts=((join(body, handle).scaled(k), style.colour()),), mass=4.0 * k**3)


@entry(
    "yoga block",
    family="outdoor",
    material="foam",
    colours=("purple", "teal", "blue", "pink"),
    synonyms=("yoga brick",),
)
def yoga_block(style: Style) -> Build:
    """A foam block lying on its broad side."""
    x, y, z = style.vary(0.225, 0.02), style.vary(0.15, 0.02), style.vary(0.08, 0.03)
    return Build(
        parts=((padded(x, y, z, 0.006), style.colour()),),
        regions=(shelf_top(x / 2 - 0.006, y / 2 - 0.006, z),),
        mass=0.15,
    )


@entry(
    "yoga mat",
    family="outdoor",
    material="rubber",
    colours=("purple", "teal", "blue", "pink"),
    synonyms=("exercise mat", "gym mat"),
)
def yoga_mat(style: Style) -> Build:
    """A mat spread on the floor with a seam around it; when rolled, standing on its end with its spiral showing."""
    main, dark = style.colour(), style.shade(style.colour(), 0.7)
    if "rolled" not in style.adjectives:
        x, y, z = style.vary(1.73, 0.03), style.vary(0.61, 0.03), 0.006
        edge = Shape(box(2, 2, 1).solid - box(x - 0.03, y - 0.03, 3).moved(z=-1).solid, ())
        return Build(
            parts=((box(x, y, z), main),), paint=((edge, dark),), regions=(shelf_top(x / 2, y / 2, z),), mass=1.1
        )
    r, z = style.vary(0.058), style.vary(0.61, 0.03)
    discs = [
        (cylinder(a, 1).solid, cylinder(a - 0.0022, 3).moved(z=-1).solid) for a in np.arange(0.012, 0.95 * r, 0.009)
    ]
    rings = together([Shape(outer - inner, ()).moved(z=z - 0.001) for outer, inner in discs])
    flap = unseen(box(0.0025, 0.02, 3)).moved(0.2 * r, -r, -1)
    return Build(
        parts=((cylinder(r, z), main),), paint=((rings, dark), (flap, dark)), regions=(disc_top(r, z),), mass=1.1
    )


@entry("baseball bat", family="outdoor", material="wood", colours=("wood", "tan", "red"), accents=("black",),
       synonyms=("bat", "wooden bat"))  # fmt: skip
def baseball_bat(style: Style) -> Build:
    """A bat lying on the flats of its barrel and its knob."""
    n = style.vary(0.8, 0.03)
    profile = [
        (0.0245, -n / 2),
        (0.0245, -n / 2 + 0.012),
        (0.0125, -n / 2 + 0.03),
        (0.0125, -0.2 * n),
        (0.024, 0.12 * n),
        (0.0325, 0.32 * n),
        (0.0325, 0.46 * n),
        (0.022, n / 2),
    ]
    barrel = lathe(profile, cuts=(-n / 2 + 0.024, -0.1 * n), angles=(0.0, 20.0), sides=6).turned("y", 90)
    heights = [hull[:, 2].min() for hull in barrel.hulls]
    low = -min(heights)
    heel = box(0.03, 0.036, low + float(heights[0]) + 0.004).moved(-n / 2 + 0.012, 0.0, 0.0)
    grip = span((-n / 2 + 0.02, -0.2 * n), (-1, 1), (-1, 1))
    return Build(
        parts=((barrel.moved(z=low), style.colour()), (heel, style.colour(1))),
        paint=((drawn(grip), style.colour(1)),),
        mass=0.9,
    )


@entry("ping pong paddle", family="outdoor", material="wood", colours=("red", "black", "blue"), accents=("wood",),
       synonyms=("table tennis paddle", "table tennis racket", "table tennis bat", "ping pong bat", "paddle",
       "ping-pong paddle"))  # fmt: skip
def ping_pong_paddle(style: Style) -> Build:
    """A table tennis bat lying flat."""
    k = style.vary(1.0, 0.03)
    turn = np.linspace(0, 2 * np.pi, 49)[:-1]
    blade = extruded(np.column_stack([0.079 * np.cos(turn), 0.075 * np.sin(turn)]), 0.012, sides=16)
    handle = slab(0.105, 0.028, 0.024, 0.01).moved(0.12)
    wood = span((0.062, 0.08), (-1, 1), (-1, 1))
    edge = Shape(box(1, 1, 0.004).solid, ()).moved(z=0.004)
    return Build(
        parts=((blade.scaled(k), style.colour()), (handle.scaled(k), style.colour(1))),
        paint=((drawn(wood).scaled(k), style.colour(1)), (edge.scaled(k), style.colour(1))),
        mass=0.17,
    )


@entry(
    "frisbee",
    family="outdoor",
    material="plastic",
    colours=("red", "blue", "yellow", "green"),
    synonyms=("flying disc", "flying disk"),
)
def frisbee(style: Style) -> Build:
    """A flying disc lying on its rim, closed to contact."""
    r = style.vary(0.135, 0.03)
    body = lathe(
        curve([(r - 0.003, 0), (r, 0.008), (0.97 * r, 0.02), (0.85 * r, 0.027), (0.3 * r, 0.031), (0.02, 0.032)], 20),
        angles=(0.0, 45.0, 75.0),
    )
    rings = together(
        [
            Shape(cylinder(a, 1).solid - cylinder(a - 0.004, 3).moved(z=-1).solid, ())
            for a in (0.35 * r, 0.6 * r, 0.8 * r)
        ]
    ).moved(z=0.015)
    return Build(parts=((body, style.colour()),), paint=((rings, style.shade(style.colour(), 0.8)),), mass=0.16)


@entry("volleyball", family="outdoor", material="leather", colours=("white", "yellow"), accents=("blue",),
       synonyms=("beach ball", "handball"))  # fmt: skip
def volleyball(style: Style) -> Build:
    """A volleyball: 210 mm, 270 g, with coloured panels."""
    r = style.vary(0.105, 0.01)
    panel = box(1, 0.5 * r, 1).moved(z=-0.5).turned("x", 20).moved(z=r)
    seams = together([Shape(box(1, 0.003, 3).solid, ()).moved(0.0, at * r, -1) for at in (-0.6, -0.2, 0.2, 0.6)])
    return Build(
        parts=((resting_ball(r), style.colour()),),
        paint=((unseen(panel), style.colour(1)), (seams, style.shade(style.colour(), 0.75))),
        mass=0.27,
    )


@entry(
    "planter",
    family="outdoor",
    material="ceramic",
    colours=("terracotta", "white", "gray"),
    synonyms=("window box", "plant box", "flower box"),
)
def planter(style: Style) -> Build:
    """A long open box for plants."""
    x, y, z = style.vary(0.42), style.vary(0.17), style.vary(0.16)
    rim = [box(x + 0.03, 0.014, 0.02).moved(0.0, s * (y / 2 + 0.006), z - 0.02) for s in (-1, 1)]
    rim += [box(0.014, y + 0.03, 0.02).moved(s * (x / 2 + 0.006), 0.0, z - 0.02) for s in (-1, 1)]
    return Build(
        parts=((tray(x, y, z, 0.008, 0.01), style.colour()), (join(*rim), style.shade(style.colour(), 0.88))),
        regions=(cavity(x / 2 - 0.009, y / 2 - 0.009, 0.01, z - 0.01),),
        mass=2.2,
    )
