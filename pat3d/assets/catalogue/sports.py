"""Balls and other sports things."""

from __future__ import annotations

import math

import manifold3d
import numpy as np

from pat3d.assets.catalogue.creature import DARK, WHITE, finish
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import arc, lathe
from pat3d.assets.shapes import Shape, box, convex, cylinder, join, prism, rod, turned_solid


def _ball(radius: float) -> Shape:
    """A ball [m] flattened a little where it stands on z = 0, so that it stays where it is put."""
    return lathe(arc(radius, -math.degrees(math.asin(0.975)), 90, 48)).moved(z=0.975 * radius)


def _seam(radius: float, width: float, bend: float = 0.25) -> Shape:
    """The closed curve of a tennis ball's or baseball's seam [m], to paint with."""
    turn = np.linspace(0.0, 2.0 * np.pi, 49)
    points = (
        np.stack(
            [
                (1 - bend) * np.cos(turn) + bend * np.cos(3 * turn),
                (1 - bend) * np.sin(turn) - bend * np.sin(3 * turn),
                2.0 * math.sqrt(bend * (1 - bend)) * np.sin(2 * turn),
            ],
            axis=1,
        )
        * radius
    )
    bead = manifold3d.Manifold.sphere(width, 8)
    beads = [bead.translate(tuple(point)) for point in points]
    links = [manifold3d.Manifold.batch_hull([a, b]) for a, b in zip(beads, beads[1:], strict=False)]
    return Shape(manifold3d.Manifold.batch_boolean(links, manifold3d.OpType.Add), ())


def _round(style: Style, radius: float, mass: float, marks: Shape, ink: tuple[int, int, int]) -> Build:
    """A ball whose `marks`, made around the origin, are painted on."""
    turned = marks.turned("x", style.rng.uniform(-25, 25)).turned("z", style.rng.uniform(0, 360))
    return Build(parts=((_ball(radius), style.colour()),), paint=((turned.moved(z=0.975 * radius), ink),), mass=mass)


@entry(
    "soccer ball",
    family="outdoor",
    synonyms=("football", "soccerball"),
    material="leather",
    colours=("white",),
    accents=("black",),
)
def soccer_ball(style: Style) -> Build:
    """A football with dark pentagons, 22 cm wide."""
    radius = style.vary(0.110, 0.02)
    golden = (1 + math.sqrt(5)) / 2
    corners = [np.roll(np.array([0.0, s, t * golden]), k) for s in (-1, 1) for t in (-1, 1) for k in range(3)]
    pentagon = [
        (0.36 * radius * math.cos(2 * math.pi * k / 5), 0.36 * radius * math.sin(2 * math.pi * k / 5)) for k in range(5)
    ]
    patches = []
    for corner in corners:
        axis = corner / float(np.linalg.norm(corner))
        # The pentagon points at a neighbouring corner, as on a real ball.
        near = next(c for c in corners if 0.4 < np.dot(c, corner) / np.dot(corner, corner) < 0.5)
        side = near - np.dot(near, axis) * axis
        side /= float(np.linalg.norm(side))
        frame = np.column_stack([side, np.cross(axis, side), axis])
        patches.append(
            prism(pentagon, 0.4 * radius).moved(z=0.8 * radius).transformed(np.asarray(frame, dtype=np.float64))
        )
    return _round(style, radius, 0.43, join(*patches), style.colour(1))


@entry("basketball", family="outdoor", synonyms=("basket ball",), material="rubber", colours=("orange",))
def basketball(style: Style) -> Build:
    """A basketball with dark seams, 24 cm wide."""
    radius = style.vary(0.120, 0.02)
    size, line = 3 * radius, 0.028 * radius
    planes = [box(line, size, size).moved(z=-size / 2), box(size, size, line).moved(z=-line / 2)]
    for side in (-1, 1):
        ring = (
            cylinder(0.80 * radius, size).solid
            - cylinder(0.80 * radius - 1.3 * line, 2 * size).moved(z=-radius / 2).solid
        )
        planes.append(Shape(ring, ()).moved(z=-size / 2).moved(x=side * 1.12 * radius))
    return _round(style, radius, 0.62, join(*planes), DARK)


@entry("tennis ball", family="outdoor", material="wool", colours=("lime",))
def tennis_ball(style: Style) -> Build:
    """A felt ball with a light seam, 6.7 cm wide."""
    radius = style.vary(0.0335, 0.02)
    return _round(style, radius, 0.058, _seam(radius, 0.055 * radius), WHITE)


@entry("baseball", family="outdoor", synonyms=("softball",), material="leather", colours=("white",))
def baseball(style: Style) -> Build:
    """A leather ball with a red seam, 7.3 cm wide."""
    radius = style.vary(0.0365, 0.015)
    return _round(style, radius, 0.145, _seam(radius, 0.06 * radius), (190, 45, 42))


@entry(
    "bowling pin", family="outdoor", synonyms=("skittle", "pin"), material="wood", colours=("white",), accents=("red",)
)
def bowling_pin(style: Style) -> Build:
    """A bowling pin with two bands around its neck, 38 cm tall."""
    tall = style.vary(0.375, 0.03) / 0.375
    profile = [
        (0.0285, 0.0),
        (0.0480, 0.055),
        (0.0605, 0.115),
        (0.0480, 0.185),
        (0.0260, 0.240),
        (0.0235, 0.265),
        (0.0310, 0.320),
        (0.0270, 0.355),
        (0.012, 0.375),
    ]
    bands = join(*(cylinder(0.2, 0.011).moved(z=z) for z in (0.240, 0.264)))
    return Build(
        parts=((turned_solid(profile, 14).scaled(1, 1, tall), style.colour()),),
        paint=((bands.scaled(1, 1, tall), style.colour(1)),),
        mass=1.5,
    )


@entry(
    "dumbbell",
    family="outdoor",
    synonyms=("hand weight", "barbell", "weight"),
    material="iron",
    colours=("black", "blue"),
)
def dumbbell(style: Style) -> Build:
    """A dumbbell with hexagonal heads, 20 cm long."""
    colour = style.colour()
    radius, half = style.vary(0.040), style.vary(0.105)
    hexagon = [(radius * math.cos(math.pi * k / 3), radius * math.sin(math.pi * k / 3)) for k in range(6)]
    head = prism(hexagon, 0.052).turned("y", 90).turned("x", 90).moved(x=half - 0.052, z=radius * math.cos(math.pi / 6))
    bar = rod((-half + 0.04, 0.0, 0.866 * radius), (half - 0.04, 0.0, 0.866 * radius), 0.0145)
    return finish(style, [(join(head, head.mirrored("x")), colour), (bar, (176, 180, 186))], spread=0.02)


@entry(
    "skateboard",
    family="outdoor",
    synonyms=("skate board", "longboard"),
    material="wood",
    colours=("teal", "red", "purple"),
)
def skateboard(style: Style) -> Build:
    """A skateboard with raised ends and light wheels, 78 cm long."""
    colour = style.colour()
    half, wide = style.vary(0.29, 0.04), 0.10
    deck = box(2 * half, 2 * wide, 0.012).moved(z=0.085)
    arc = [(0.10 * math.sin(a), wide * math.cos(a)) for a in np.linspace(0, math.pi, 7)]
    kick = convex([(half + x, y, z + 0.40 * x) for x, y in arc for z in (0.085, 0.097)])
    wheel = cylinder(0.027, 0.034, 12).turned("x", 90).moved(y=0.017, z=0.0263).cut_below(0.0)
    truck = convex(
        [(x, y, z) for z, r, w in ((0.022, 0.010, 0.075), (0.090, 0.030, 0.030)) for x in (-r, r) for y in (-w, w)]
    )
    axle = join(*(truck.moved(x) for x in (-half * 0.78, half * 0.78)))
    wheels = join(*(wheel.moved(x, side * 0.080) for x in (-half * 0.78, half * 0.78) for side in (-1, 1)))
    return finish(
        style,
        [(join(deck, kick, kick.mirrored("x")), colour), (axle, (150, 152, 156)), (wheels, (238, 230, 208))],
        paint=[(box(4 * half, 0.06, 0.01).moved(z=0.0935), style.shade(colour, 0.6))],
        mass=2.6,
    )
