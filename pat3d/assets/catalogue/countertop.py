"""Small kitchen machines that stand on a counter."""

from __future__ import annotations

import numpy as np

from pat3d.assets.catalogue.joinery import (
    BLACK,
    GRAY,
    STEEL,
    WHITE,
    cavity,
    dial,
    disc_top,
    drawn,
    legs,
    padded,
    shelf_top,
    span,
)
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.catalogue.tableware import ear
from pat3d.assets.rounded import clear_radius, curve, hollow, lathe, slab, tube
from pat3d.assets.shapes import Shape, box, convex, cylinder, ellipsoid, join, soft_box

SCREEN: RGB = (30, 34, 40)
GREEN_LIGHT: RGB = (120, 220, 140)
COFFEE: RGB = (58, 38, 28)
GLASS: RGB = (190, 212, 220)


def _glazed_case(style: Style, x: float, y: float, z: float, door: float) -> tuple[tuple, tuple]:
    """Parts and paint of a case on feet [m] with a window in its door, `door` of the width, and controls beside it."""
    colour, low, front = style.colour(), 0.012, -y / 2 + 0.02
    body = span((-x / 2, x / 2), (front, y / 2), (low, z))
    edge = -x / 2 + door * x
    leaf = span((-x / 2 + 0.004, edge), (-y / 2, front + 0.001), (low + 0.004, z - 0.004))
    window = span((-x / 2 + 0.035, edge - 0.035), (-y, front - 0.002), (low + 0.04, z - 0.04))
    handle = span((edge - 0.022, edge - 0.008), (-y / 2 - 0.03, -y / 2 + 0.001), (low + 0.03, z - 0.03))
    feet = legs(x - 0.04, y - 0.06, low + 0.001, 0.03)
    parts = ((body, colour), (leaf, style.shade(colour, 0.9)), (handle, STEEL), (feet, BLACK))
    return parts, ((drawn(window), SCREEN),)


@entry("microwave", family="appliances", material="steel", colours=("black", "white", "steel", "red"),
       accents=("gray",), synonyms=("microwave oven",))  # fmt: skip
def microwave(style: Style) -> Build:
    """A closed microwave oven with a keypad and a clock."""
    x, y, z = style.vary(0.48, 0.03), style.vary(0.36, 0.03), style.vary(0.28, 0.03)
    parts, paint = _glazed_case(style, x, y, z, 0.74)
    clock = span((0.28 * x, 0.46 * x), (-y, -y / 2 + 0.022), (0.78 * z, 0.88 * z))
    digits = span((0.33 * x, 0.41 * x), (-y, -y / 2 + 0.022), (0.81 * z, 0.85 * z))
    keys = [span(((0.29 + 0.06 * i) * x, (0.335 + 0.06 * i) * x), (-y, -y / 2 + 0.022),
                 ((0.2 + 0.14 * j) * z, (0.29 + 0.14 * j) * z)) for i in range(3) for j in range(4)]  # fmt: skip
    return Build(
        parts=parts,
        paint=(*paint, (drawn(clock), SCREEN), (drawn(digits), GREEN_LIGHT), (drawn(join(*keys)), style.colour(1))),
        regions=(shelf_top(x / 2, y / 2 - 0.01, z, at=(0.0, 0.01)),),
        mass=style.vary(11.5),
    )


@entry("toaster oven", family="appliances", material="steel", colours=("steel", "red", "black"), accents=("black",),
       synonyms=("mini oven", "countertop oven"))  # fmt: skip
def toaster_oven(style: Style) -> Build:
    """A small oven with a window and three dials."""
    x, y, z = style.vary(0.42, 0.03), style.vary(0.3, 0.03), style.vary(0.24, 0.03)
    parts, paint = _glazed_case(style, x, y, z, 0.76)
    dials = join(*(dial(0.019, 0.02, 8).moved(0.39 * x, -y / 2 + 0.021, t * z) for t in (0.25, 0.5, 0.75)))
    glow = span((-0.4 * x, 0.16 * x), (-y, -y / 2 + 0.018), (0.3 * z, 0.33 * z))
    return Build(
        parts=(*parts, (dials, style.colour(1))),
        paint=(*paint, (drawn(glow), (255, 160, 80))),
        regions=(shelf_top(x / 2, y / 2 - 0.01, z, at=(0.0, 0.01)),),
        mass=style.vary(5.0),
    )


@entry(
    "coffee machine",
    family="appliances",
    material="plastic",
    colours=("black", "steel", "red", "white"),
    accents=("steel",),
    synonyms=("coffee maker", "coffeemaker", "espresso machine", "espresso maker", "drip coffee maker"),
)
def coffee_machine(style: Style) -> Build:
    """A machine with an open bay for a cup on its drip tray, below the spout."""
    x, y, z = style.vary(0.22, 0.03), style.vary(0.34, 0.03), style.vary(0.34, 0.03)
    colour, tray, head = style.colour(), 0.035, 0.66 * z
    bay = 0.42 * y
    back = span((-x / 2, x / 2), (-y / 2 + bay, y / 2), (0.0, z))
    foot = span((-x / 2, x / 2), (-y / 2, -y / 2 + bay + 0.001), (0.0, tray))
    top = span((-x / 2, x / 2), (-y / 2 + 0.02, -y / 2 + bay + 0.001), (head, z))
    spout = box(0.05, 0.045, 0.036).moved(y=-y / 2 + 0.5 * bay, z=head - 0.035)
    wand = box(0.012, 0.012, 0.11).moved(x / 2 - 0.022, -y / 2 + 0.07, head - 0.109)
    grid = [
        span((-0.42 * x, 0.42 * x), (at, at + 0.006), (tray - 0.002, tray + 0.001))
        for at in (-y / 2 + 0.02 + 0.018 * k for k in range(6))
    ]
    panel = span((-0.3 * x, 0.3 * x), (-y, -y / 2 + 0.022), (0.78 * z, 0.93 * z))
    lamp = span((0.2 * x, 0.24 * x), (-y, -y / 2 + 0.022), (0.84 * z, 0.87 * z))
    room = head - 0.036 - tray
    hold = min(0.3 * x, 0.4 * bay)
    return Build(
        parts=((join(back, foot), style.shade(colour, 0.85)), (top, colour), (join(spout, wand), style.colour(1))),
        paint=((drawn(join(*grid)), STEEL), (drawn(panel), style.shade(STEEL, 0.8)), (drawn(lamp), GREEN_LIGHT)),
        regions=(
            shelf_top(hold, hold, tray, at=(0.0, -y / 2 + 0.5 * bay), height=room, enclosed=True),
            shelf_top(x / 2, y / 2 - 0.01, z, at=(0.0, 0.01)),
        ),
        mass=style.vary(4.5),
    )


@entry("blender", family="appliances", material="plastic", colours=("red", "black", "white", "mint"),
       accents=("steel",), synonyms=("food blender", "smoothie maker", "liquidiser"))  # fmt: skip
def blender(style: Style) -> Build:
    """A closed jug with a handle on a motor base with a dial."""
    k = style.vary(1.0, 0.04)
    colour = style.colour()
    base = lathe([(0.085, 0), (0.085, 0.02), (0.07, 0.09), (0.055, 0.125)], angles=(0.0, 25.0))
    jug = lathe([(0.048, 0.12), (0.058, 0.15), (0.07, 0.34)], angles=(-5.0,), sides=16)
    lid = join(
        lathe([(0.073, 0.335), (0.073, 0.355), (0.066, 0.362)], angles=(0.0,)), cylinder(0.025, 0.02).moved(z=0.36)
    )
    handle = ear(0.055, 0.18, 0.32, 0.055, 0.016)
    knob = dial(0.02, 0.03, 8).moved(0.0, -0.07, 0.058)
    marks = join(*(span((-0.02, 0.02), (-1, 0), (h, h + 0.003)) for h in (0.19, 0.23, 0.27)))
    shapes = ((base, colour), (jug, GLASS), (lid, colour), (handle, style.shade(colour, 0.75)), (knob, style.colour(1)))
    return Build(
        parts=tuple((shape.scaled(k), shade) for shape, shade in shapes),
        paint=((drawn(marks.scaled(k)), WHITE),),
        mass=style.vary(2.8),
    )


@entry("stand mixer", family="appliances", material="metal", colours=("red", "mint", "cream", "black"),
       accents=("steel",), synonyms=("mixer", "kitchen mixer", "food mixer"))  # fmt: skip
def stand_mixer(style: Style) -> Build:
    """A tilt-head mixer facing left, its steel bowl under the beater."""
    k, colour = style.vary(1.0, 0.04), style.colour()
    foot = slab(0.34, 0.2, 0.035, 0.07)
    column = convex(
        [
            (x, s * y, z)
            for s in (-1, 1)
            for x, y, z in ((0.06, 0.055, 0.03), (0.15, 0.055, 0.03), (0.07, 0.05, 0.26), (0.15, 0.05, 0.26))
        ]
    )
    head = soft_box(0.34, 0.12, 0.12, 0.05).moved(-0.005, 0.0, 0.235)
    bowl = hollow([(0.06, 0), (0.1, 0.06), (0.105, 0.13)], [(0.056, 0.005), (0.097, 0.06), (0.102, 0.13)], segments=8)
    beater = cylinder(0.012, 0.06, 8).moved(-0.085, 0.0, 0.18)
    knob = dial(0.014, 0.02, 8).moved(0.1, -0.059, 0.29)
    band = span((-1, 1), (-1, 1), (0.288, 0.296))
    shapes = ((join(foot, column, head), colour), (bowl.moved(-0.075, 0.0, 0.034), STEEL), (join(beater, knob), STEEL))
    return Build(
        parts=tuple((shape.scaled(k), shade) for shape, shade in shapes),
        paint=((drawn(band.scaled(k)), style.colour(1)),),
        mass=style.vary(9.0),
    )


@entry("air fryer", family="appliances", material="plastic", colours=("black", "white", "teal"), accents=("steel",),
       synonyms=("airfryer", "deep fryer", "fryer"))  # fmt: skip
def air_fryer(style: Style) -> Build:
    """A rounded fryer with a drawer, its handle in front."""
    x, y, z = style.vary(0.27, 0.03), style.vary(0.3, 0.03), style.vary(0.31, 0.03)
    colour = style.colour()
    body = padded(x, y, z, 0.045)
    handle = join(
        box(0.04, 0.05, 0.03).moved(y=-y / 2 - 0.02, z=0.33 * z),
        box(0.05, 0.025, 0.06).moved(y=-y / 2 - 0.05, z=0.28 * z),
    )
    seam = [span((-x, x), (-1, -y / 2 + 0.06), (t * z, t * z + 0.004)) for t in (0.12, 0.58)]
    screen = span((-0.28 * x, 0.28 * x), (-y, -y / 2 + 0.03), (0.68 * z, 0.82 * z))
    digits = span((-0.1 * x, 0.1 * x), (-y, -y / 2 + 0.03), (0.72 * z, 0.78 * z))
    return Build(
        parts=((body, colour), (handle, style.colour(1))),
        paint=((drawn(join(*seam)), style.shade(colour, 0.5)), (drawn(screen), SCREEN), (drawn(digits), GREEN_LIGHT)),
        mass=style.vary(4.8),
    )


@entry("rice cooker", family="appliances", material="plastic", colours=("white", "red", "gray"), accents=("steel",),
       synonyms=("slow cooker", "pressure cooker", "multicooker", "instant pot", "crock pot"))  # fmt: skip
def rice_cooker(style: Style) -> Build:
    """A round closed cooker with a domed lid, two grips and a panel."""
    r, z, colour = style.vary(0.135, 0.03), style.vary(0.19, 0.03), style.colour()
    body = lathe([(0.9 * r, 0), (r, 0.02), (r, z)], angles=(-45.0, 0.0))
    lid = lathe(
        [(0.98 * r, z - 0.001), (0.9 * r, z + 0.025), (0.5 * r, z + 0.045), (0.2 * r, z + 0.048)], angles=(20.0, 50.0)
    )
    knob = lathe([(0.018, z + 0.045), (0.025, z + 0.06), (0.022, z + 0.07)], angles=(0.0,))
    grips = join(*(soft_box(0.05, 0.09, 0.025, 0.008).moved(s * (r + 0.012), 0.0, 0.8 * z) for s in (-1, 1)))
    panel = span((-0.3 * r, 0.3 * r), (-1, 0), (0.2 * z, 0.6 * z))
    lamp = span((-0.08 * r, 0.08 * r), (-1, 0), (0.4 * z, 0.48 * z))
    seam = span((-1, 1), (-1, 1), (z - 0.006, z + 0.001))
    return Build(
        parts=((body, colour), (lid, style.shade(colour, 0.92)), (join(knob, grips), BLACK)),
        paint=((drawn(panel), style.shade(STEEL, 0.8)), (drawn(lamp), (240, 120, 60)), (drawn(seam), style.colour(1))),
        mass=style.vary(3.2),
    )


@entry("hot plate", family="appliances", material="steel", colours=("black", "white", "steel"), accents=("gray",),
       synonyms=("hob", "cooktop", "flat stove", "portable stove", "induction cooktop", "electric hob", "burner",
       "induction hob", "hotplate", "tabletop stove", "camping stove"))  # fmt: skip
def hot_plate(style: Style) -> Build:
    """A flat cooker with one zone on top and a dial in front; pots stand on it."""
    x, y, z = style.vary(0.29, 0.03), style.vary(0.32, 0.03), style.vary(0.062, 0.03)
    colour = style.colour()
    body = box(x, y, z - 0.008).moved(z=0.004)
    feet = legs(x - 0.05, y - 0.05, 0.005, 0.03)
    glass = box(x - 0.008, y - 0.008, 0.005).moved(z=z - 0.005)
    at = 0.03
    zone = cylinder(0.1, 0.01).solid - cylinder(0.092, 0.03).moved(z=-0.01).solid
    inner = cylinder(0.055, 0.01).solid - cylinder(0.05, 0.03).moved(z=-0.01).solid
    rings = [Shape(solid, ()).moved(y=at, z=z - 0.004) for solid in (zone, inner)]
    knob = dial(0.016, 0.02, 8).moved(0.28 * x, -y / 2 + 0.001, 0.5 * z)
    lamp = span((-0.3 * x, -0.26 * x), (-y, -y / 2 + 0.01), (0.45 * z, 0.58 * z))
    return Build(
        parts=(
            (body, colour),
            (feet, BLACK),
            (glass, style.shade(colour, 0.9) if colour == BLACK else SCREEN),
            (knob, style.colour(1)),
        ),
        paint=((rings[0], (190, 70, 50)), (rings[1], GRAY), (drawn(lamp), (230, 80, 60))),
        regions=(shelf_top(x / 2 - 0.02, x / 2 - 0.02, z, at=(0.0, 0.0)),),
        mass=style.vary(2.4),
    )


@entry("moka pot", family="appliances", material="aluminium", colours=("silver", "red", "black"), accents=("black",),
       synonyms=("stovetop coffee maker", "espresso pot", "percolator"))  # fmt: skip
def moka_pot(style: Style) -> Build:
    """An eight-sided stovetop pot with a waist, a spout on its left and a handle on its right."""
    k, colour = style.vary(1.0, 0.04), style.colour()

    def octagon(low: float, high: float, z0: float, z1: float) -> Shape:
        turn = (np.arange(8) + 0.5) * np.pi / 4
        return convex([(r * np.cos(a), r * np.sin(a), z) for r, z in ((low, z0), (high, z1)) for a in turn])

    lower, upper = octagon(0.052, 0.038, 0.0, 0.075), octagon(0.038, 0.05, 0.073, 0.155)
    lid = octagon(0.051, 0.02, 0.154, 0.172)
    knob = cylinder(0.009, 0.018, 8).moved(z=0.171)
    spout = convex([(-0.03, -0.018, 0.154), (-0.03, 0.018, 0.154), (-0.07, -0.003, 0.152), (-0.07, 0.003, 0.152),
                    (-0.035, -0.008, 0.115), (-0.035, 0.008, 0.115)])  # fmt: skip
    handle = join(
        box(0.06, 0.016, 0.014).moved(0.07, 0.0, 0.14),
        convex(
            [(x, y, z) for x, z in ((0.085, 0.14), (0.1, 0.15), (0.1, 0.06), (0.09, 0.06)) for y in (-0.009, 0.009)]
        ),
    )
    shapes = ((join(lower, upper, lid, spout), colour), (join(knob, handle), style.colour(1)))
    seam = span((-0.06, 0.06), (-1, 1), (0.07, 0.079))
    return Build(
        parts=tuple((shape.scaled(k), shade) for shape, shade in shapes),
        paint=((drawn(seam.scaled(k)), style.shade(colour, 0.8)),),
        mass=style.vary(0.55),
    )


@entry("coffee pot", family="appliances", material="glass", colours=("glass",), accents=("black",),
       synonyms=("coffee carafe", "coffee jug", "glass carafe"))  # fmt: skip
def coffee_pot(style: Style) -> Build:
    """An open glass carafe with coffee in its colour band and a black handle on its right."""
    r, z = style.vary(0.062, 0.04), style.vary(0.15, 0.04)
    outer = [(0.86 * r, 0), (r, 0.25 * z), (r, 0.45 * z), (0.7 * r, 0.86 * z), (0.74 * r, z)]
    inner = [
        (0.82 * r, 0.006),
        (r - 0.004, 0.26 * z),
        (r - 0.004, 0.45 * z),
        (0.7 * r - 0.004, 0.86 * z),
        (0.74 * r - 0.004, z),
    ]
    levels = (0.48 * z, 0.86 * z)
    body = hollow(outer, inner, levels=levels, segments=8)
    handle = ear(0.72 * r, 0.3 * z, 0.95 * z, 0.9 * r, 0.016)
    collar = span((-1, 1), (-1, 1), (0.88 * z, 2 * z))
    free = clear_radius(inner, levels, 8)
    region = cavity(free, free, inner[0][1], z - inner[0][1], round_=True)
    return Build(
        parts=((body, style.colour()), (handle, style.colour(1))),
        paint=((drawn(collar), style.colour(1)),),
        regions=(region,),
        mass=0.42,
    )


@entry("kitchen scale", family="appliances", material="plastic", colours=("white", "black", "mint"),
       accents=("steel",), synonyms=("food scale", "scale", "weighing scale", "digital scale"))  # fmt: skip
def kitchen_scale(style: Style) -> Build:
    """A flat scale with a round steel plate and a display in front."""
    x, y, colour = style.vary(0.17, 0.04), style.vary(0.21, 0.04), style.colour()
    body = slab(x, y, 0.02, 0.02)
    plate = cylinder(0.44 * x, 0.006).moved(y=0.1 * y, z=0.019)
    screen = span((-0.24 * x, 0.24 * x), (-0.46 * y, -0.32 * y), (0.018, 0.03))
    digits = span((-0.12 * x, 0.12 * x), (-0.42 * y, -0.36 * y), (0.018, 0.03))
    return Build(
        parts=((body, colour), (plate, style.colour(1))),
        paint=((drawn(screen), (120, 140, 120)), (drawn(digits), SCREEN)),
        regions=(shelf_top(0.3 * x, 0.3 * x, 0.025, at=(0.0, 0.1 * y)),),
        mass=style.vary(0.5),
    )


@entry("waffle maker", family="appliances", material="plastic", colours=("black", "red", "steel"), accents=("steel",),
       synonyms=("waffle iron", "sandwich maker", "panini press"))  # fmt: skip
def waffle_maker(style: Style) -> Build:
    """A closed round iron on a foot, its handle in front."""
    r, colour = style.vary(0.105, 0.03), style.colour()
    foot = cylinder(0.8 * r, 0.02)
    shells = join(
        lathe([(0.8 * r, 0.018), (r, 0.045)], angles=(-40.0,)), lathe([(r, 0.048), (0.86 * r, 0.085)], angles=(20.0,))
    )
    core = cylinder(0.96 * r, 0.01).moved(z=0.042)
    grip = soft_box(0.04, 0.11, 0.022, 0.008).moved(y=-r - 0.03, z=0.05)
    lamp = ellipsoid(0.012, 0.012, 0.05).moved(y=-0.6 * r, z=0.085)
    return Build(
        parts=((join(foot, shells), colour), (core, style.colour(1)), (grip, style.shade(colour, 0.7))),
        paint=((drawn(lamp), (230, 80, 60)),),
        regions=(disc_top(0.86 * r, 0.085),),
        mass=style.vary(1.9),
    )


@entry("faucet", family="appliances", material="steel", colours=("steel", "gold", "black"), accents=("steel",),
       synonyms=("water tap", "kitchen faucet", "kitchen tap"))  # fmt: skip
def faucet(style: Style) -> Build:
    """A mixer tap with an arched spout on a round base plate."""
    z, colour = style.vary(0.24, 0.04), style.colour()
    base = cylinder(0.045, 0.012)
    stem = cylinder(0.02, 0.08, 12).moved(z=0.011)
    path = [(0, 0, 0.08), (0, 0, 0.8 * z), (0, -0.05, z), (0, -0.11, 0.9 * z), (0, -0.12, 0.68 * z)]
    spout = tube(curve(path, 33), 0.011, 5, up=(1, 0, 0))
    lever = join(
        cylinder(0.011, 0.03, 8).turned("y", 90).moved(0.015, 0.0, 0.05),
        box(0.012, 0.012, 0.07).moved(0.05, 0.0, 0.045),
    )
    counterweight = cylinder(0.034, 0.02).moved(z=0.011)
    return Build(
        parts=((join(base, counterweight, stem, spout, lever), colour),),
        mass=style.vary(1.6),
    )
