"""Glassware and instruments of a laboratory bench."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pat3d.assets.catalogue.common import DARK, WHITE, band, cavity, disc, height, length
from pat3d.assets.catalogue.joinery import drawn, lying, span, together
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.rounded import hollow, lathe, merged, ring_of, slab, unseen
from pat3d.assets.shapes import Shape, box, convex, cylinder, frustum, join, soft_box

INK: RGB = (120, 146, 156)


def _scale(radius: float, low: float, high: float, count: int, wide: float) -> Shape:
    """Level marks in front of an upright body of `radius` [m] between two heights."""
    marks = [
        span((-wide * (1 + k % 2), wide * (1 + k % 2)), (-1, -0.3 * radius), (z, z + 0.0014))
        for k, z in enumerate(np.linspace(low, high, count))
    ]
    return Shape(together(marks).solid - cylinder(0.9 * radius, 2).moved(z=-1).solid, ())


@entry(
    "beaker",
    family="laboratory",
    synonyms=("glass beaker", "lab beaker", "laboratory beaker"),
    material="glass",
    colours=("glass",),
)
def beaker(style: Style) -> Build:
    """An open beaker of 250 ml with a lip on its left and a scale in front."""
    r, h, wall = style.vary(0.035), height(style, 0.095), 0.0024
    inner = [(r - wall - 0.003, 0.004), (r - wall, 0.009), (r - wall, h)]
    body = hollow([(r - 0.004, 0), (r, 0.005), (r, h)], inner)
    lip = convex(
        [
            (x, y, z)
            for x, y, z in (
                (0.0025 - r, 0.01, h),
                (0.0025 - r, -0.01, h),
                (-r - 0.007, 0.002, h),
                (-r - 0.007, -0.002, h),
                (-r + 0.0005, 0.003, h - 0.012),
                (-r + 0.0005, -0.003, h - 0.012),
            )
        ]
    )
    return Build(
        parts=((join(body, lip), style.colour()),),
        paint=((_scale(r, 0.3 * h, 0.75 * h, 6, 0.005), INK),),
        regions=(cavity(inner, 12),),
        mass=0.095,
    )


@entry(
    "flask",
    family="laboratory",
    synonyms=("erlenmeyer flask", "conical flask", "erlenmeyer", "lab flask", "glass flask", "laboratory flask"),
    material="glass",
    colours=("glass",),
)
def flask(style: Style) -> Build:
    """An Erlenmeyer flask of 250 ml, open at its neck."""
    r, h, wall = style.vary(0.0425), height(style, 0.14), 0.0026
    neck, shoulder = 0.017, 0.72 * h
    outer = [(0.94 * r, 0), (r, 0.008), (neck, shoulder), (neck, h)]
    inner = [(0.9 * r, 0.005), (r - wall, 0.011), (neck - wall, shoulder), (neck - wall, h)]
    body = hollow(outer, inner, levels=(0.4 * h, shoulder), segments=8)
    return Build(
        parts=((body, style.colour()),),
        paint=((_scale(0.75 * r, 0.14 * h, 0.42 * h, 5, 0.006), INK),),
        regions=(cavity(inner, 8, (0.4 * h, shoulder)),),
        mass=0.125,
    )


@entry("graduated cylinder", family="laboratory", synonyms=("measuring cylinder", "cylinder glass",
       "volumetric cylinder"), material="glass", colours=("glass",), accents=("blue",))  # fmt: skip
def graduated_cylinder(style: Style) -> Build:
    """A tall open measuring cylinder on a broad foot."""
    r, h = style.vary(0.0155), height(style, 0.25)
    foot = join(cylinder(0.036, 0.008), frustum(0.03, 0.016, 0.008).moved(z=0.008))
    inner = [(r - 0.002, 0.004), (r - 0.002, h)]
    tube_ = hollow([(r, 0), (r, h)], inner, segments=12).moved(z=0.012)
    region = cavity(inner, 12)
    return Build(
        parts=((foot, style.colour(1)), (tube_, style.colour())),
        paint=((_scale(r, 0.05, h - 0.03, 19, 0.003), INK),),
        regions=(replace(region, floor=(0.0, 0.0, 0.016)),),
        mass=0.16,
    )


@entry("test tube", family="laboratory", synonyms=("glass tube", "lab tube", "sample tube", "centrifuge tube",
       "falcon tube"), material="glass", colours=("glass", "red", "blue", "green"), accents=("blue",))  # fmt: skip
def test_tube(style: Style) -> Build:
    """A capped tube lying on a flat of its cap and its body."""
    n, r = length(style, 0.115, 0.03), 0.0085
    body = lying(r, n, sides=8)
    tip = lathe([(r, -0.0005), (0.3 * r, 0.014)], angles=(0.0, 30.0), sides=8).turned("y", 90).moved(n / 2, 0.0, r)
    cap = lying(r + 0.0012, 0.016, sides=8).moved(-n / 2 - 0.006)
    lifted = join(body, tip).moved(z=0.0012)
    heel = box(0.01, 0.006, 0.003).moved(n / 2 - 0.012)
    liquid = span((-0.1 * n, 1), (-1, 1), (-1, 1))
    light = style.shade(style.colour(), 0.82)
    return Build(
        parts=((join(lifted, heel), style.colour()), (cap, style.colour(1))),
        paint=((drawn(liquid), light),),
        mass=0.022,
    )


@entry("test tube rack", family="laboratory", synonyms=("tube rack", "rack of test tubes", "test tube holder",
       "test tube stand", "test tubes in a rack"), plurals=("test tube racks", "racks of test tubes"),
       material="plastic", colours=("blue", "white", "wood"), accents=("glass", "red"))  # fmt: skip
def test_tube_rack(style: Style) -> Build:
    """A rack with a row of six filled tubes."""
    x, y, z = length(style, 0.2, 0.03), style.vary(0.055), 0.065
    base, deck = box(x, y, 0.01), box(x, y, 0.008).moved(z=z - 0.008)
    ends = [box(0.008, y, z - 0.002).moved(s * (x / 2 - 0.004)) for s in (-1, 1)]
    tubes, fills = [], []
    for k in range(6):
        at = (k - 2.5) * (x - 0.03) / 6
        tubes.append(lathe([(0.0075, 0.009), (0.0085, 0.015), (0.0085, 0.1)], angles=(0.0,), sides=12).moved(x=at))
        fills.append(span((at - 0.01, at + 0.01), (-1, 1), (0.005, 0.04 + 0.012 * (k % 3))))
    colours = ((200, 60, 60), (90, 160, 90), (80, 120, 200), (220, 180, 70), (150, 90, 170), (226, 140, 70))
    mouths = merged([unseen(cylinder(0.0066, 0.01)).moved((k - 2.5) * (x - 0.03) / 6, 0.0, 0.0985) for k in range(6)])
    bodies = tuple(
        (Shape(fill.solid ^ tube.solid, ()), shade) for fill, tube, shade in zip(fills, tubes, colours, strict=True)
    )
    return Build(
        parts=((join(base, deck, *ends), style.colour()), *((tube, style.colour(1)) for tube in tubes)),
        paint=(*bodies, (mouths, style.shade(style.colour(1), 0.6))),
        mass=0.26,
    )


@entry("petri dish", family="laboratory", synonyms=("culture dish", "agar plate", "cell culture dish"),
       plurals=("petri dishes",), material="glass", colours=("glass",), accents=("red",))  # fmt: skip
def petri_dish(style: Style) -> Build:
    """A flat open dish with a red medium on its floor."""
    r, h = style.vary(0.045, 0.03), style.vary(0.016, 0.04)
    inner = [(r - 0.0024, 0.003), (r - 0.0022, h)]
    body = hollow([(r - 0.0004, 0), (r, h)], inner, segments=16)
    medium = unseen(cylinder(r - 0.004, 0.002)).moved(z=0.0015)
    region = cavity(inner, 16)
    return Build(
        parts=((body, style.colour()),),
        paint=((medium, (206, 120, 110)),),
        regions=(disc("on", 0.003, region.half_size[0]), region),
        mass=0.03,
    )


@entry("pipette", family="laboratory", synonyms=("micropipette", "lab pipette"), material="plastic", colours=("blue",
       "white", "green"), accents=("gray",))  # fmt: skip
def pipette(style: Style) -> Build:
    """A micropipette lying down, its tip to the left, its plunger to the right."""
    k = length(style, 1.0, 0.04)
    grip = slab(0.11, 0.03, 0.024, 0.011).moved(0.05)
    hook = box(0.014, 0.05, 0.02).moved(0.085, 0.005, 0.002)
    shaft = lathe([(0.0095, -0.008), (0.006, 0.08)], angles=(3.0,), sides=8).turned("y", -90).moved(0.0, 0.0, 0.012)
    tip = lathe([(0.0062, 0.078), (0.0016, 0.13)], angles=(5.0,), sides=8).turned("y", -90).moved(0.0, 0.0, 0.012)
    button = (
        lathe([(0.005, 0.1), (0.005, 0.118), (0.011, 0.12), (0.011, 0.126)], angles=(0.0,), sides=8)
        .turned("y", 90)
        .moved(0.0, 0.0, 0.012)
    )
    window = unseen(box(0.03, 0.01, 0.1)).moved(0.05, z=0.02)
    shapes = (
        (join(grip, hook), style.colour()),
        (shaft, style.colour(1)),
        (tip, WHITE),
        (button, style.shade(style.colour(), 0.75)),
    )
    return Build(
        parts=tuple((shape.scaled(k), colour) for shape, colour in shapes),
        paint=((window.scaled(k), DARK),),
        mass=0.085,
    )


@entry("syringe", family="laboratory", synonyms=("medical syringe", "injection syringe"), material="plastic",
       colours=("blue", "white", "orange"), accents=("glass",))  # fmt: skip
def syringe(style: Style) -> Build:
    """A syringe lying on the flats of its barrel's flange and its plunger."""
    k = length(style, 1.0, 0.04)
    r = 0.0095
    barrel = lying(r, 0.085, sides=8).moved(0.0, 0.0, 0.0015)
    flange = box(0.004, 0.034, 2 * r + 0.003).moved(0.042)
    tip = lying(0.0025, 0.02, sides=6).moved(-0.05, 0.0, r - 0.001)
    rod = box(0.05, 0.008, 0.008).moved(0.065, 0.0, r - 0.0025)
    pad = lying(r + 0.0015, 0.004, sides=8).moved(0.092)
    heel = box(0.006, 0.008, 0.004).moved(-0.036)
    marks = [span((x, x + 0.001), (-0.005, 0.005), (r, 1)) for x in np.linspace(-0.033, 0.03, 10)]
    shapes = ((join(barrel, flange, heel), style.colour(1)), (join(rod, pad), style.colour()), (tip, style.colour()))
    fill = span((-0.04, 0.002), (-1, 1), (0.004, 0.013))
    return Build(
        parts=tuple((shape.scaled(k), colour) for shape, colour in shapes),
        paint=((drawn(fill.scaled(k)), style.colour()), (drawn(together(marks).scaled(k)), DARK)),
        mass=0.018,
    )


@entry("vial", family="laboratory", synonyms=("glass vial", "sample vial", "medicine vial"), material="glass",
       colours=("glass", "brown"), accents=("white",))  # fmt: skip
def vial(style: Style) -> Build:
    """A small bottle with a screw cap, 6 cm tall."""
    r, h = style.vary(0.0125), height(style, 0.05)
    body = lathe([(0.94 * r, 0), (r, 0.002), (r, 0.74 * h), (0.6 * r, 0.88 * h), (0.6 * r, h)], cuts=(0.74 * h,))
    cap = cylinder(0.75 * r, 0.013).moved(z=h - 0.003)
    label = unseen(box(1.3 * r, 1, 0.4 * h)).moved(y=-0.5, z=0.2 * h)
    return Build(
        parts=((body, style.colour()), (cap, style.colour(1))),
        paint=((label, WHITE),),
        mass=0.022,
    )


@entry("reagent bottle", family="laboratory", synonyms=("media bottle", "lab bottle"), material="glass",
       colours=("glass", "brown"), accents=("blue",))  # fmt: skip
def reagent_bottle(style: Style) -> Build:
    """A closed reagent bottle with a blue cap and a scale."""
    r, h = style.vary(0.035), height(style, 0.105)
    body = lathe([(0.94 * r, 0), (r, 0.005), (r, 0.72 * h), (0.5 * r, 0.92 * h), (0.5 * r, h)], cuts=(0.72 * h,))
    cap = cylinder(0.58 * r, 0.026).moved(z=h - 0.008)
    ridges = ring_of(unseen(box(0.004, 0.0012, 0.02)).moved(z=h - 0.005), 0.58 * r, 24)
    label = unseen(box(1.1 * r, 1, 0.26 * h)).moved(y=-0.5, z=0.34 * h)
    return Build(
        parts=((body, style.colour()), (cap, style.colour(1))),
        paint=((label, WHITE), (ridges, style.shade(style.colour(1), 0.75))),
        mass=0.33,
    )


@entry("wash bottle", family="laboratory", synonyms=("squeeze bottle", "lab wash bottle"), material="plastic",
       colours=("white", "glass"), accents=("red", "blue"))  # fmt: skip
def wash_bottle(style: Style) -> Build:
    """A squeeze bottle with a bent spout to the left."""
    r, h = style.vary(0.036), height(style, 0.15)
    body = lathe([(0.94 * r, 0), (r, 0.006), (r, 0.8 * h), (0.5 * r, 0.95 * h), (0.5 * r, h)], cuts=(0.8 * h,))
    cap = cylinder(0.58 * r, 0.022).moved(z=h - 0.004)
    stem = box(0.006, 0.006, 0.05).moved(z=h + 0.015)
    spout = convex(
        [
            (x, s * 0.003, z)
            for s in (-1, 1)
            for x, z in ((0.003, h + 0.065), (0.003, h + 0.058), (-0.075, h + 0.035), (-0.075, h + 0.031))
        ]
    )
    label = unseen(box(1.2 * r, 1, 0.3 * h)).moved(y=-0.5, z=0.3 * h)
    return Build(
        parts=((body, style.colour()), (cap, style.colour(1)), (join(stem, spout), style.colour(1))),
        paint=((label, style.shade(style.colour(), 0.85)),),
        mass=0.42,
    )


@entry("specimen jar", family="laboratory", synonyms=("sample jar", "sample container", "specimen cup", "urine cup"),
       material="plastic", colours=("white", "glass"), accents=("orange", "red"))  # fmt: skip
def specimen_jar(style: Style) -> Build:
    """A closed sample cup with a coloured screw lid."""
    r, h = style.vary(0.032), height(style, 0.068)
    body = lathe([(0.86 * r, 0), (0.88 * r, 0.003), (r, 0.86 * h)], angles=(-4.0,), sides=16)
    lid = cylinder(1.08 * r, 0.2 * h).moved(z=0.82 * h)
    label = unseen(box(1.3 * r, 1, 0.34 * h)).moved(y=-0.5, z=0.26 * h)
    return Build(
        parts=((body, style.colour()), (lid, style.colour(1))),
        paint=((label, style.shade(style.colour(), 0.85)), (band(0.1 * h, 0.12 * h), INK)),
        regions=(disc("on", 1.02 * h, r),),
        mass=0.075,
    )


@entry("tip box", family="laboratory", synonyms=("pipette tip box", "pipette tips", "box of pipette tips"),
       material="plastic", colours=("blue", "green", "orange"), accents=("white",))  # fmt: skip
def tip_box(style: Style) -> Build:
    """An open rack box of 96 pipette tips."""
    x, y, z = style.vary(0.12, 0.03), style.vary(0.084, 0.03), style.vary(0.06, 0.03)
    body = soft_box(x, y, z, 0.005)
    tips = [
        cylinder(0.003, 0.006, 8).moved((i - 5.5) * x / 12.8, (j - 3.5) * y / 9, z - 0.001)
        for i in range(12)
        for j in range(8)
    ]
    seen = merged([unseen(tip) for tip in tips])
    cover = box(0.94 * x, 0.88 * y, 0.0052).moved(z=z - 0.0002)
    line = unseen(box(1, 1, 0.004).moved(z=0.7 * z))
    return Build(
        parts=((body, style.colour()), (Shape(seen.solid, cover.hulls), style.colour(1))),
        paint=((line, style.shade(style.colour(), 0.7)),),
        mass=0.13,
    )


@entry("well plate", family="laboratory", synonyms=("microplate", "96-well plate", "multiwell plate",
       "microtiter plate"), material="plastic", colours=("white", "glass", "black"), accents=("red",))  # fmt: skip
def well_plate(style: Style) -> Build:
    """A microplate of 96 wells in the standard footprint of 127.8 by 85.5 mm."""
    x, y, z = style.vary(0.1278, 0.002), style.vary(0.0855, 0.002), 0.0144
    base, top = box(x, y, 0.004), box(x - 0.005, y - 0.005, z)
    wells = merged(
        [
            unseen(cylinder(0.0033, 0.02)).moved((i - 5.5) * 0.009, (j - 3.5) * 0.009, 0.003)
            for i in range(12)
            for j in range(8)
        ]
    )
    filled = merged(
        [
            unseen(cylinder(0.0034, 0.0012)).moved((i - 5.5) * 0.009, (j - 3.5) * 0.009, 0.0026)
            for i in range(4)
            for j in range(8)
        ]
    )
    return Build(
        parts=((base, style.colour()), (Shape(top.solid - wells.solid, top.hulls), style.colour())),
        paint=((filled, (206, 120, 150)),),
        mass=0.05,
    )


@entry("safety goggles", family="laboratory", synonyms=("goggles", "lab goggles", "safety glasses",
       "protective goggles"), material="plastic", colours=("blue", "black", "orange"), accents=("glass",))  # fmt: skip
def safety_goggles(style: Style) -> Build:
    """Goggles standing on the lower edge of their frame, facing the front."""
    x = style.vary(0.165, 0.04)
    frame = convex(
        [
            (s * a * x, y, z)
            for s in (-1, 1)
            for a, y, z in (
                (0.36, -0.045, 0.0),
                (0.36, 0.02, 0.0),
                (0.5, -0.03, 0.03),
                (0.5, 0.035, 0.03),
                (0.46, -0.04, 0.075),
                (0.46, 0.03, 0.075),
            )
        ]
    )
    bridge = unseen(box(0.03, 1, 0.04)).moved(z=-0.015)
    window = join(*(box(0.4 * x, 0.2, 0.048).moved(s * 0.2 * x, -0.12, 0.013) for s in (-1, 1)))
    straps = [box(0.016, 0.05, 0.022).moved(s * (x / 2 - 0.006), 0.045, 0.026) for s in (-1, 1)]
    lens = Shape(window.solid - bridge.solid, ())
    return Build(parts=((frame, style.colour()), (join(*straps), DARK)), paint=((lens, style.colour(1)),), mass=0.09)
