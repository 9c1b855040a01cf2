"""Garden, street and playground: pools, trees, swings, cones, cans, extinguishers."""

from __future__ import annotations

import math

from pat3d.assets.catalogue.creature import DARK, WHITE, finish, limb, tint
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import (
    Shape,
    box,
    cylinder,
    ellipsoid,
    frustum,
    join,
    prism,
    rod,
    soft_box,
    turned_solid,
    vessel,
)
from pat3d.scene.asset import Region

SOIL: RGB = (74, 52, 38)
STEEL: RGB = (176, 180, 186)


@entry(
    "inflatable pool",
    family="outdoor",
    synonyms=("pool", "kiddie pool", "paddling pool", "wading pool", "swimming pool", "inflatable swimming pool"),
    colours=("blue", "turquoise"),
)
def inflatable_pool(style: Style) -> Build:
    """A round paddling pool of two inflated rings, 1.2 m wide and 0.2 m high, open at the top."""
    colour = style.colour()
    radius, high = style.vary(0.60, 0.05), style.vary(0.20)
    inner, floor = radius - 0.085, 0.02
    wall = vessel([(radius, 0.0), (radius, high)], [(inner, floor), (inner, high)], segments=16)
    # Two bulging rings show in the picture; the parts are the straight wall around them.
    bulges = [
        (
            radius - 0.045 * (1.0 - math.cos(math.radians(angle))),
            high * (0.25 + 0.5 * k + 0.25 * math.sin(math.radians(angle))),
        )
        for k in range(2)
        for angle in range(-90, 91 if k else 90, 15)
    ]
    wall = Shape(turned_solid(bulges).solid - cylinder(inner, 1.0).moved(z=floor).solid, wall.hulls)
    band = cylinder(2.0, high).moved(z=high * 0.5)
    ring = Shape(band.solid - cylinder(inner + 0.02, 1.0).moved(z=-0.5).solid, ())
    free = inner * math.cos(math.pi / 16)
    return Build(
        parts=((wall, colour),),
        paint=((ring, tint(colour, 0.55)),),
        regions=(
            Region(kind="in", shape="disc", floor=(0.0, 0.0, floor), half_size=(free, free), height=high - floor),
        ),
        mass=4.0,
    )


@entry("tree", family="outdoor", synonyms=("oak tree", "apple tree", "big tree", "garden tree"),
       material="wood", colours=("green",), accents=("brown",))  # fmt: skip
def tree(style: Style) -> Build:
    """A broad tree, 4 m tall, with wide roots and one level branch 2.2 m up that a swing can hang from."""
    leaves, bark = style.colour(), style.colour(1)
    low = 2.2
    trunk = join(
        frustum(0.62, 0.26, 0.35, sides=12),
        frustum(0.26, 0.17, 2.75, sides=10).moved(z=0.30),
    )
    side = 1.0 if style.rng.random() < 0.5 else -1.0
    # Thinner towards its end, level below.
    branch = rod((0.0, 0.0, low), (side * style.vary(1.75, 0.05), 0.0, low - 0.025), 0.085, 0.060)
    other = limb((0.0, 0.0, 2.30), (-side * 0.75, style.vary(0.15, 0.9), 2.95), 0.08, 0.06)
    crown = [
        ellipsoid(style.vary(1.10), style.vary(1.0), style.vary(0.72)).moved(z=3.45),
        ellipsoid(style.vary(0.70), 0.75, 0.52).moved(-side * 0.85, 0.1, 3.05),
        ellipsoid(style.vary(0.65), 0.70, 0.50).moved(side * 0.80, -0.1, 3.15),
        ellipsoid(0.65, style.vary(0.62), 0.50).moved(side * 0.10, -0.65, 3.20),
    ]
    return finish(
        style,
        [
            (join(trunk, branch, other), bark),
            (crown[0], leaves),
            (join(*crown[1:3]), style.shade(leaves, 0.9)),
            (crown[3], style.shade(leaves, 1.08)),
        ],
        mass=260.0,
        spread=0.03,
    )


@entry(
    "swing", family="outdoor", synonyms=("rope swing", "tree swing", "wooden swing"), material="wood", colours=("wood",)
)
def swing(style: Style) -> Build:
    """A swing's seat board with two ropes 1.9 m up to where they are tied."""
    colour, rope = style.colour(), (206, 184, 138)
    wide, deep, high = style.vary(0.52, 0.04), style.vary(0.22, 0.04), style.vary(1.88, 0.02)
    at = wide / 2 - 0.045
    ropes = join(*(rod((x, 0.0, 0.02), (x, 0.0, high), 0.011, sides=6) for x in (-at, at)))
    knots = join(*(cylinder(0.022, 0.045, 8).moved(x, 0.0, 0.030) for x in (-at, at)))
    seat = Region(kind="on", shape="rectangle", floor=(0.0, 0.0, 0.035), half_size=(at - 0.03, deep / 2))
    return Build(
        parts=((box(wide, deep, 0.035), colour), (join(ropes, knots), rope)),
        regions=(seat,),
        anchors=tuple((x, 0.0, high) for x in (-at, at)),
        mass=3.2,
    )


@entry(
    "fire extinguisher",
    family="outdoor",
    synonyms=("extinguisher",),
    material="steel",
    colours=("red",),
    accents=("black",),
)
def fire_extinguisher(style: Style) -> Build:
    """A steel bottle with lever, gauge, hose and label, 50 cm tall."""
    colour, trim = style.colour(), style.colour(1)
    radius, high = style.vary(0.075, 0.04), style.vary(0.38, 0.05)
    bottle = turned_solid(
        [(radius * 0.92, 0.0), (radius, 0.02), (radius, high - 0.06), (radius * 0.72, high - 0.015), (0.026, high)], 16
    )
    neck = cylinder(0.022, 0.055, 10).moved(z=high - 0.005)
    head = box(0.036, 0.060, 0.034).moved(z=high + 0.040)
    lever = join(
        box(0.022, 0.115, 0.010).turned("x", -14).moved(0.0, -0.062, high + 0.078),
        box(0.022, 0.105, 0.010).turned("x", 3).moved(0.0, -0.062, high + 0.046),
    )
    out = radius + 0.018
    hose = join(
        limb((0.012, 0.0, high + 0.055), (out, 0.0, high + 0.020), 0.010),
        limb((out, 0.0, high + 0.020), (out + 0.006, 0.0, high * 0.45), 0.010),
        limb((out + 0.006, 0.0, high * 0.45), (out + 0.004, 0.0, high * 0.22), 0.015),
    )
    gauge = cylinder(0.016, 0.014, 10).turned("x", 90).moved(-0.010, -0.022, high + 0.040)
    label = Shape(
        cylinder(1.0, high * 0.36).moved(z=high * 0.30).solid ^ box(radius * 1.35, 1.0, 1.0).moved(y=-0.5).solid, ()
    )
    return finish(
        style,
        [(bottle, colour), (join(neck, head, gauge), STEEL), (join(lever, hose), trim)],
        paint=[
            (label, WHITE),
            (box(radius * 0.8, 1.0, high * 0.06).moved(y=-0.5, z=high * 0.56), colour),
            (box(radius * 1.0, 1.0, high * 0.02).moved(y=-0.5, z=high * 0.46), DARK),
            (box(radius * 1.0, 1.0, high * 0.02).moved(y=-0.5, z=high * 0.38), DARK),
        ],
        mass=7.5,
        spread=0.02,
    )


@entry("watering can", family="outdoor", synonyms=("garden can",), material="steel", colours=("green", "blue", "gray"))
def watering_can(style: Style) -> Build:
    """A can with a long spout, a rose and a handle, 30 cm tall."""
    colour = style.colour()
    high = style.vary(0.19)
    body = frustum(0.090, 0.080, high)
    reach = style.vary(0.215)
    spout = rod((-0.06, 0.0, 0.045), (-reach, 0.0, high + 0.045), 0.017, 0.012)
    dx, dz = reach - 0.06, high
    size = math.hypot(dx, dz)
    tip = (-reach - 0.034 * dx / size, 0.0, high + 0.045 + 0.034 * dz / size)
    rose = rod((-reach + 0.004, 0.0, high + 0.04), tip, 0.014, 0.036)
    handle = [(0.074, 0.0, 0.045), (0.145, 0.0, 0.070), (0.150, 0.0, 0.140), (0.074, 0.0, high - 0.020)]
    top = [
        (-0.060, 0.0, high - 0.005),
        (-0.040, 0.0, high + 0.075),
        (0.040, 0.0, high + 0.075),
        (0.060, 0.0, high - 0.005),
    ]
    bars = [limb(a, b, 0.009) for path in (handle, top) for a, b in zip(path, path[1:], strict=False)]
    return finish(
        style,
        [(body, colour), (join(spout, rose), colour), (join(*bars), style.shade(colour, 0.75))],
        paint=[(cylinder(0.068, 0.02).moved(z=high - 0.002), (52, 60, 64))],
        mass=0.9,
    )


@entry(
    "flower pot",
    family="outdoor",
    synonyms=("flowerpot", "plant pot", "clay pot", "terracotta pot", "garden pot"),
    material="ceramic",
    colours=("terracotta",),
)
def flower_pot(style: Style) -> Build:
    """A tapering clay pot with a rim, open, 16 cm tall."""
    colour = style.colour()
    high, wide = style.vary(0.16), style.vary(0.088)
    pot = vessel([(wide * 0.68, 0.0), (wide * 0.95, high)], [(wide * 0.58, 0.014), (wide * 0.87, high)], segments=8)
    ring = [(wide * 0.98, 0.0), (wide, high * 0.22)]
    rim = Shape(
        vessel(ring, [(wide * 0.80, -0.001), (wide * 0.87, high * 0.22)]).solid,
        vessel(ring, [(wide * 0.80, 0.0), (wide * 0.87, high * 0.22)], segments=8).hulls,
    ).moved(z=high * 0.78)
    pot = join(pot, rim)
    free = wide * 0.58 * math.cos(math.pi / 8)
    return _pot(pot, colour, free, high)


def _pot(pot: Shape, colour: RGB, free: float, high: float) -> Build:
    region = Region(kind="in", shape="disc", floor=(0.0, 0.0, 0.014), half_size=(free, free), height=high - 0.014)
    return Build(parts=((pot, colour),), regions=(region,))


@entry("traffic cone", family="outdoor", synonyms=("safety cone", "road cone", "pylon"), colours=("orange",))
def traffic_cone(style: Style) -> Build:
    """A road cone with two light bands on a square foot, 50 cm tall."""
    colour = style.colour()
    high = style.vary(0.47)
    foot = soft_box(0.30, 0.30, 0.030, 0.010)
    body = frustum(0.115, 0.026, high).moved(z=0.025)
    bands = join(*(cylinder(0.3, high * 0.14).moved(z=0.025 + high * level) for level in (0.34, 0.64)))
    return finish(style, [(foot, style.shade(colour, 0.85)), (body, colour)], paint=[(bands, WHITE)], mass=1.6)


@entry(
    "mailbox",
    family="outdoor",
    synonyms=("letter box", "letterbox", "post box", "postbox"),
    material="steel",
    colours=("red", "blue"),
)
def mailbox(style: Style) -> Build:
    """A round-topped mailbox on a post, 1.1 m tall."""
    colour = style.colour()
    high = style.vary(0.85, 0.05)
    post, foot = box(0.09, 0.09, high), box(0.34, 0.34, 0.03)
    lower = box(0.20, 0.46, 0.14).moved(z=high - 0.005)
    arch = cylinder(0.10, 0.46, 16).turned("x", 90).moved(0.0, 0.23, high + 0.135)
    flag = join(
        box(0.012, 0.035, 0.16).moved(0.104, 0.05, high + 0.08), box(0.012, 0.11, 0.06).moved(0.104, 0.015, high + 0.20)
    )
    door = cylinder(0.080, 0.05).turned("x", 90).moved(0.0, -0.21, high + 0.135)
    return finish(
        style,
        [(join(lower, arch), colour), (join(post, foot), (122, 80, 50)), (flag, (222, 170, 50))],
        paint=[(door, style.shade(colour, 0.8)), (box(0.09, 0.05, 0.012).moved(0.0, -0.23, high + 0.15), DARK)],
        mass=9.0,
    )


def _sector(radius: float, start: float) -> Shape:
    """An eighth of a tall disc [m] from angle `start` [degrees]."""
    ends = [(radius * math.cos(math.radians(a)), radius * math.sin(math.radians(a))) for a in (start, start + 45.0)]
    return prism([(0.0, 0.0), *ends], 4.0)


@entry(
    "parasol",
    family="outdoor",
    synonyms=("beach umbrella", "open umbrella", "patio umbrella", "garden umbrella", "sun umbrella"),
    material="fabric",
    colours=("red", "blue", "yellow"),
)
def parasol(style: Style) -> Build:
    """An open parasol with light panels on a heavy round foot, 2.1 m tall."""
    colour = style.colour()
    high, wide = style.vary(2.0, 0.04), style.vary(0.95, 0.05)
    canopy = frustum(wide, 0.03, 0.34, sides=8).moved(z=high - 0.36)
    panels = join(*(_sector(2.0, 45.0 * k) for k in range(0, 8, 2)))
    rim = Shape(panels.solid - cylinder(0.06, 4.0).solid, ())
    pole = cylinder(0.022, high, 8).moved(z=0.02)
    foot = frustum(0.26, 0.18, 0.09)
    knob = ellipsoid(0.03).moved(z=high + 0.02)
    return finish(
        style,
        [(canopy, colour), (join(pole, knob), (176, 128, 82)), (foot, (120, 122, 126))],
        paint=[(Shape(rim.solid.trim_by_plane((0.0, 0.0, 1.0), high - 0.5), ()), tint(colour, 0.8))],
        mass=14.0,
    )


@entry("garden gnome", family="outdoor", synonyms=("gnome", "lawn gnome", "dwarf"), material="ceramic",
       colours=("blue", "green"), accents=("red",))  # fmt: skip
def garden_gnome(style: Style) -> Build:
    """A bearded gnome with a pointed hat, 30 cm tall."""
    coat, colour = style.colour(), style.colour(1)
    beard = ellipsoid(0.033, 0.022, 0.050).moved(0.0, -0.034, 0.134)
    boots = join(*(ellipsoid(0.030, 0.046, 0.030).moved(x, -0.022, 0.012) for x in (-0.033, 0.033)))
    arms = join(*(limb((s * 0.055, 0.0, 0.135), (s * 0.062, -0.040, 0.085), 0.019, 0.017) for s in (-1, 1)))
    face, at = ellipsoid(0.040), (0.0, -0.002, 0.180)
    return finish(
        style,
        [
            (turned_solid([(0.058, 0.015), (0.064, 0.060), (0.045, 0.155)], 12), coat),
            (face.moved(*at), (232, 190, 160)),
            (join(beard, ellipsoid(0.026, 0.012, 0.009).moved(0.0, -0.042, 0.168)), WHITE),
            (frustum(0.045, 0.004, style.vary(0.115, 0.1), sides=10).moved(z=0.192), colour),
            (boots, (84, 52, 34)),
            (arms, coat),
            (ellipsoid(0.010).moved(0.0, -0.043, 0.180), (226, 160, 136)),
        ],
        paint=[
            (cylinder(0.2, 0.014).moved(z=0.072), (84, 52, 34)),
            (join(*(ellipsoid(0.0055).moved(x, -0.037, 0.189) for x in (-0.015, 0.015))), DARK),
        ],
    )
