"""Instruments and burners of a laboratory bench."""

from __future__ import annotations

from dataclasses import replace

from pat3d.assets.catalogue.common import DARK, STEEL, disc, height
from pat3d.assets.catalogue.joinery import dial, drawn, lying, span
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import lathe, slab, unseen
from pat3d.assets.shapes import Shape, box, convex, cylinder, frustum, join


@entry("microscope", family="laboratory", synonyms=("optical microscope", "light microscope", "lab microscope"),
       material="metal", colours=("white", "black", "blue"), accents=("black",))  # fmt: skip
def microscope(style: Style) -> Build:
    """A microscope with a stage, a turret and a tilted eyepiece to the front."""
    k = style.vary(1.0, 0.04)
    foot = slab(0.16, 0.2, 0.03, 0.03)
    arm = convex(
        [
            (s * 0.028, y, z)
            for s in (-1, 1)
            for y, z in ((0.05, 0.028), (0.095, 0.028), (0.09, 0.29), (0.03, 0.29), (0.045, 0.18))
        ]
    )
    stage = box(0.13, 0.13, 0.014).moved(y=-0.02, z=0.12)
    post = box(0.03, 0.04, 0.02).moved(y=0.05, z=0.11)
    lamp = frustum(0.032, 0.026, 0.03, 12).moved(y=-0.02, z=0.028)
    head = box(0.05, 0.11, 0.05).moved(y=0.01, z=0.24)
    turret = frustum(0.02, 0.028, 0.02, 12).moved(y=-0.02, z=0.222)
    lens = frustum(0.008, 0.012, 0.05, 12).moved(y=-0.02, z=0.175)
    tube_ = cylinder(0.02, 0.1, 12).turned("x", 42).moved(y=-0.01, z=0.27)
    eye = cylinder(0.014, 0.035, 12).turned("x", 42).moved(y=-0.01 - 0.066, z=0.27 + 0.073)
    knobs = dial(0.024, 0.018).turned("z", 90).moved(-0.026 + 0.0, 0.07, 0.075)
    other = dial(0.024, 0.018).turned("z", -90).moved(0.026, 0.07, 0.075)
    slide = unseen(box(0.07, 0.022, 0.01)).moved(y=-0.02, z=0.13)
    main, dark = style.colour(), style.colour(1) if style.colour(1) != style.colour() else STEEL
    shapes = (
        (join(foot, arm, head), main),
        (join(stage, post, lamp, turret, knobs, other), dark),
        (join(lens, eye), STEEL),
        (tube_, main),
    )
    return Build(
        parts=tuple((shape.scaled(k), colour) for shape, colour in shapes),
        paint=((slide.scaled(k), (196, 220, 226)),),
        mass=3.6,
    )


@entry("magnetic stirrer", family="laboratory", synonyms=("stirrer", "lab hot plate", "stir plate", "heating plate"),
       material="plastic", colours=("white", "blue"), accents=("blue",))  # fmt: skip
def magnetic_stirrer(style: Style) -> Build:
    """A stirrer with a round plate on top and two dials in a sloping front."""
    x, y, z = style.vary(0.16), style.vary(0.22), style.vary(0.1)
    body = convex(
        [
            (s * x / 2, yy, zz)
            for s in (-1, 1)
            for yy, zz in ((-y / 2, 0.0), (y / 2, 0.0), (y / 2, z), (-0.22 * y, z), (-y / 2, 0.5 * z))
        ]
    )
    plate = cylinder(0.44 * x, 0.012).moved(y=0.16 * y, z=z - 0.001)
    dials = join(*(cylinder(0.017, 0.03, 12).turned("x", 50).moved(s * 0.25 * x, -0.33 * y, 0.66 * z) for s in (-1, 1)))
    screen = span((-0.12 * x, 0.12 * x), (-1, -0.4 * y), (0.3 * z, 0.46 * z))
    other = style.colour(1) if style.colour(1) != style.colour() else DARK
    return Build(
        parts=((body, style.colour()), (plate, STEEL), (dials, other)),
        paint=((drawn(screen), DARK),),
        regions=(replace(disc("on", z + 0.011, 0.44 * x), floor=(0.0, 0.16 * y, z + 0.011)),),
        mass=2.4,
    )


@entry("bunsen burner", family="laboratory", synonyms=("gas burner", "lab burner"), material="brass", colours=("steel",
       "gold"), accents=("black",))  # fmt: skip
def bunsen_burner(style: Style) -> Build:
    """A burner: an upright tube with a collar on a heavy round base, its gas inlet to the right."""
    h = height(style, 0.15)
    base = lathe([(0.042, 0), (0.042, 0.008), (0.02, 0.018)], angles=(0.0, 60.0))
    stack = lathe([(0.009, 0.016), (0.0085, h)], angles=(0.0,), sides=12)
    collar = lathe([(0.013, 0.035), (0.013, 0.055)], angles=(0.0,), sides=12)
    inlet = lying(0.005, 0.05, sides=6).moved(0.03, 0.0, 0.02)
    hole = Shape(dial(0.005, 0.1).solid, ()).moved(z=0.045)
    bore = unseen(cylinder(0.0065, 0.02)).moved(z=h - 0.002)
    return Build(
        parts=((base, style.colour(1)), (join(stack, collar, inlet), style.colour())),
        paint=((hole, DARK), (bore, DARK)),
        mass=0.4,
    )
