"""Frog, turtle and what lives in the sea."""

from __future__ import annotations

import math

from pat3d.assets.catalogue.creature import DARK, WHITE, egg, eyes, finish, foot, limb, on_top, pair, tint
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.shapes import Shape, box, cone, convex, cylinder, ellipsoid, join


@entry("frog", family="animals", synonyms=("toad", "toy frog", "frog figurine"), material="rubber", colours=("green",))
def frog(style: Style) -> Build:
    """A squatting frog with bulging eyes, 9 cm long."""
    coat = style.colour()
    body = egg((0.032, 0.044, 0.024), (0.0, 0.006, 0.027), -16)
    bulge = ellipsoid(0.0095).moved(0.0165, -0.026, 0.050)
    thigh = egg((0.014, 0.026, 0.015), (0.036, 0.022, 0.014), 6)
    hind = foot(0.044, -0.004, 0.012, 0.030, 0.005)
    arm = limb((0.026, -0.022, 0.024), (0.034, -0.036, 0.006), 0.0085, 0.007)
    fore = foot(0.036, -0.046, 0.011, 0.024, 0.005)
    mouth = cylinder(0.06, 0.0022).turned("x", 8).moved(0.0, -0.045, 0.0295)
    pupils = pair(ellipsoid(0.0055).moved(0.0195, -0.0335, 0.0525))
    return finish(
        style,
        [
            (join(body, pair(bulge)), coat),
            (join(pair(thigh), pair(arm)), coat),
            (join(pair(hind), pair(fore)), style.shade(coat, 0.85)),
        ],
        paint=[
            (egg((0.03, 0.03, 0.014), (0.0, -0.035, 0.013)), tint(coat, 0.55)),
            (Shape(mouth.solid ^ box(0.05, 0.03, 0.1).moved(y=-0.045).solid, ()), style.shade(coat, 0.4)),
            (pair(ellipsoid(0.0075).moved(0.0185, -0.0315, 0.052)), (242, 220, 120)),
            (pupils, DARK),
        ],
        regions=[on_top(body, 0.012)],
        mass=0.06,
    )


@entry(
    "turtle", family="animals", synonyms=("tortoise", "toy turtle", "sea turtle", "turtle figurine"), colours=("green",)
)
def turtle(style: Style) -> Build:
    """A toy turtle with a domed, patterned shell, 15 cm long."""
    coat = style.colour()
    shell = egg((0.050, 0.058, 0.038), (0.0, 0.008, 0.014)).cut_below(0.006)
    shell_colour = style.shade(coat, 0.66)
    size, at = (0.019, 0.022, 0.018), (0.0, -0.072, style.vary(0.030, 0.12))
    neck = limb((0.0, -0.040, 0.018), (0.0, -0.066, at[2] - 0.006), 0.012)
    fore = ellipsoid(0.030, 0.017, 0.010).turned("z", style.vary(32.0, 0.3)).moved(0.052, -0.032, 0.008)
    hind = ellipsoid(0.022, 0.015, 0.010).turned("z", -38).moved(0.042, 0.054, 0.008)
    tail = cone(0.009, 0.024, sides=6).turned("x", -92).moved(0.0, 0.058, 0.010)
    rims = [
        (0.0, 0.008),
        *((0.033 * math.cos(a), 0.008 + 0.038 * math.sin(a)) for a in (math.radians(60 * k + 30) for k in range(6))),
    ]
    plates = join(*(cylinder(0.0135, 0.1, 6).moved(x, y, 0.02) for x, y in rims))
    return finish(
        style,
        [
            (shell, shell_colour),
            (join(egg(size, at), neck, tail), coat),
            (join(pair(fore), pair(hind)), coat),
            (egg((0.044, 0.052, 0.02), (0.0, 0.008, 0.010)), tint(coat, 0.4)),
        ],
        paint=[
            (
                Shape(plates.solid ^ egg((0.0505, 0.0585, 0.0385), (0.0, 0.008, 0.014)).solid, ()),
                style.shade(coat, 1.18),
            ),
            (eyes(size, at, 0.0115, at[2] + 0.006, 0.0034), DARK),
        ],
        regions=[on_top(shell, 0.02)],
        mass=0.075,
    )


@entry(
    "starfish",
    family="animals",
    synonyms=("sea star", "toy starfish"),
    plurals=("starfishes",),
    material="rubber",
    colours=("orange",),
)
def starfish(style: Style) -> Build:
    """A five-armed starfish with light bumps, 14 cm across."""
    coat = style.colour()
    start = style.rng.uniform(0.0, 72.0)
    arms, bumps = [], []
    for k in range(5):
        angle, long = math.radians(start + 72 * k), style.vary(0.058, 0.10)
        c, s = math.cos(angle), math.sin(angle)
        arms.append(limb((0.008 * c, 0.008 * s, 0.0), (long * c, long * s, 0.0), 0.020, 0.008).scaled(1.0, 1.0, 0.85))
        bumps += [
            ellipsoid(r).moved(d * c, d * s, z)
            for d, r, z in ((0.018, 0.0045, 0.0165), (0.032, 0.0038, 0.0135), (0.045, 0.003, 0.0105))
        ]
    return finish(
        style,
        [(join(*arms), coat)],
        paint=[(join(ellipsoid(0.006).moved(z=0.017), *bumps), tint(coat, 0.6))],
        mass=0.05,
    )


@entry("fish", family="animals", synonyms=("goldfish", "toy fish", "fish toy"), plurals=("fishes",),
       material="rubber", colours=("orange", "blue", "red"))  # fmt: skip
def fish(style: Style) -> Build:
    """A fish lying on its side, 15 cm long."""
    coat = style.colour()
    body = ellipsoid(0.052, 0.030, 0.016).moved(z=0.011)
    spread = style.vary(0.030, 0.12)
    tail = convex(
        [
            (x, y, z)
            for x, y, h in (
                (0.038, -0.007, 0.006),
                (0.038, 0.007, 0.006),
                (0.092, -spread, 0.004),
                (0.080, 0.0, 0.004),
                (0.092, spread, 0.004),
            )
            for z in (0.010 - h, 0.010 + h)
        ]
    )
    fins = join(
        convex(
            [
                (x, y, z)
                for x, y in ((-0.018, 0.022), (0.024, 0.020), (0.034, 0.044), (0.006, 0.046))
                for z in (0.007, 0.014)
            ]
        ),
        convex([(x, y, z) for x, y in ((-0.004, -0.024), (0.020, -0.020), (0.028, -0.040)) for z in (0.007, 0.014)]),
    )
    gill = cylinder(0.020, 0.1).solid - cylinder(0.0175, 0.3).moved(z=-0.05).solid
    gill = gill.trim_by_plane((1.0, 0.0, 0.0), 0.008).translate((-0.042, 0.0, 0.0))
    return finish(
        style,
        [(body, coat), (join(tail, fins), style.shade(coat, 0.8))],
        paint=[
            (Shape(gill.translate((0, 0, 0.01)), ()), style.shade(coat, 0.6)),
            (ellipsoid(0.0065).moved(-0.034, 0.006, 0.0225), WHITE),
            (ellipsoid(0.004).moved(-0.0345, 0.006, 0.0245), DARK),
        ],
        mass=0.09,
    )


@entry("octopus", family="animals", synonyms=("plush octopus", "toy octopus"), plurals=("octopuses",
       "octopi"), material="plush", colours=("purple", "pink", "teal"))  # fmt: skip
def octopus(style: Style) -> Build:
    """A plush octopus on eight arms, 20 cm tall."""
    coat = style.colour()
    size, at = (0.070, 0.068, 0.072), (0.0, 0.0, 0.118)
    arms = []
    for k in range(8):
        angle, reach = math.radians(45 * k + 22.5), style.vary(0.125, 0.12)
        c, s = math.cos(angle), math.sin(angle)
        arms.append(limb((0.030 * c, 0.030 * s, 0.060), (reach * c, reach * s, 0.010), 0.026, 0.017))
    smile = cylinder(0.020, 0.2, 16).turned("x", 90).solid - cylinder(0.0175, 0.4).turned("x", 90).moved(y=0.1).solid
    smile = smile.trim_by_plane((0.0, 0.0, -1.0), 0.009).translate((0.0, 0.0, 0.112))
    return finish(
        style,
        [(egg(size, at), coat), (join(*arms), style.shade(coat, 0.88))],
        paint=[
            (Shape(smile, ()), DARK),
            (eyes(size, at, 0.028, 0.130, 0.015), WHITE),
            (eyes((0.073, 0.071, 0.075), at, 0.028, 0.131, 0.0095), DARK),
        ],
        regions=[on_top(egg(size, at), 0.03)],
    )
