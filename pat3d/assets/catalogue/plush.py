"""Soft toys. Dark beads are painted eyes; every toy sits or stands on a flat base."""

from __future__ import annotations

from pat3d.assets.catalogue.creature import (
    DARK,
    WHITE,
    egg,
    eye_colour,
    eyes,
    finish,
    legs,
    limb,
    on_top,
    pair,
    tint,
    young,
)
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import cone, cylinder, ellipsoid, join

PINK: RGB = (232, 160, 164)


def _seated_bear(style: Style, coat: RGB, limbs: RGB, ears: RGB, patches: RGB | None) -> Build:
    """A bear that sits with its legs forward, 33 cm tall."""
    size, at = (0.078, 0.070, 0.070), (0.0, -0.012, 0.238)
    head = egg(size, at)
    spread, reach = style.vary(0.075, 0.12), style.vary(0.04, 0.4)
    arm = limb((0.075, -0.012, 0.165), (0.112, -0.03 - reach, 0.085), 0.030, 0.033)
    leg = limb((0.055, -0.05, 0.040), (spread + 0.018, -0.125, 0.038), 0.042, 0.038)
    foot = egg((0.040, 0.024, 0.050), (spread + 0.022, -0.158, 0.046))
    muzzle = egg((0.038, 0.036, 0.029), (0.0, -0.072, 0.222))
    ear = ellipsoid(0.030, 0.016, 0.030).turned("y", 30).moved(0.060, -0.005, 0.296)
    sight = eyes(size, at, 0.030, 0.254, 0.009)
    paint = [
        (pair(ellipsoid(0.017, 0.008, 0.017).moved(0.060, -0.021, 0.297)), tint(ears, 0.45)),
        (pair(ellipsoid(0.026, 0.010, 0.034).moved(spread + 0.022, -0.182, 0.050)), tint(limbs, 0.45)),
        (egg((0.050, 0.03, 0.046), (0.0, -0.075, 0.130)), tint(coat, 0.35)),
        (egg((0.015, 0.013, 0.010), (0.0, -0.106, 0.234)), DARK),
    ]
    if patches is not None:
        paint.append((pair(ellipsoid(0.019, 0.03, 0.024).moved(0.030, -0.075, 0.252)), patches))
    paint.append((sight, DARK if patches is None else WHITE))
    return finish(
        style,
        [
            (egg((0.088, 0.078, 0.105), (0.0, 0.0, 0.095)), coat),
            (head, coat),
            (muzzle, tint(coat, 0.55)),
            (pair(ear), ears),
            (pair(arm), limbs),
            (join(pair(leg), pair(foot)), limbs),
        ],
        paint=paint,
        regions=[on_top(head, 0.045)],
    )


@entry(
    "teddy bear",
    family="plush",
    synonyms=("bear", "plush bear", "teddy", "stuffed bear", "toy bear", "bear plush", "bear toy"),
    plurals=("teddies",),
    material="plush",
    colours=("brown", "tan", "golden"),
)
def teddy_bear(style: Style) -> Build:
    """A seated bear with a light muzzle."""
    coat = style.colour()
    return _seated_bear(style, coat, coat, coat, None)


@entry("panda", family="plush", synonyms=("plush panda", "panda bear", "toy panda", "stuffed panda"),
       material="plush", colours=("white",), accents=("black",))  # fmt: skip
def panda(style: Style) -> Build:
    """A seated panda with dark limbs, ears and eye patches."""
    return _seated_bear(style, style.colour(), style.colour(1), style.colour(1), style.colour(1))


@entry(
    "elephant",
    family="plush",
    synonyms=("plush elephant", "toy elephant", "stuffed elephant", "elephant plush", "elephant toy"),
    material="plush",
    colours=("gray",),
)
def elephant(style: Style) -> Build:
    """A standing elephant with large ears and a hanging trunk, 28 cm tall."""
    coat = style.colour()
    size, at = (0.072, 0.070, 0.074), (0.0, -0.115, 0.200)
    body = egg((0.092, 0.125, 0.092), (0.0, 0.02, 0.150))
    swing, flap = style.vary(0.03, 0.6), style.vary(24.0, 0.3)
    ear = ellipsoid(0.056, 0.014, 0.066).turned("z", flap).moved(0.104, -0.085, 0.205)
    inner = ellipsoid(0.040, 0.008, 0.050).turned("z", flap).moved(0.106, -0.099, 0.205)
    trunk = [
        limb((0.0, -0.168, 0.190), (0.0, -0.205, 0.115), 0.032, 0.024),
        limb((0.0, -0.205, 0.115), (0.0, -0.215 - swing, 0.062), 0.024, 0.019),
    ]
    tail = limb((0.0, 0.135, 0.17), (0.0, 0.160, 0.10), 0.009, 0.007)
    return finish(
        style,
        [
            (body, coat),
            (egg(size, at), coat),
            (pair(ear), coat),
            (join(*trunk, tail), coat),
            (legs(0.050, 0.055, 0.078, 0.135, 0.038), coat),
        ],
        paint=[(pair(inner), PINK), (eyes(size, at, 0.040, 0.218, 0.009), DARK)],
        regions=[on_top(body, 0.05)],
        size=0.75 if young(style) else 1.0,
    )


@entry("rabbit", family="plush", synonyms=("bunny", "plush rabbit", "plush bunny", "toy rabbit",
       "stuffed rabbit", "stuffed bunny", "bunny rabbit", "rabbit plush", "baby bunny", "baby rabbit",
       "hare"), plurals=("bunnies",), material="plush", colours=("white", "tan", "gray"))  # fmt: skip
def rabbit(style: Style) -> Build:
    """A crouching rabbit with upright ears, 26 cm tall (a baby one 15 cm)."""
    coat, grow = style.colour(), 1.18 if young(style) else 1.0
    size, at = (0.054 * grow, 0.056 * grow, 0.051 * grow), (0.0, -0.062, 0.140)
    tilt, lean = style.vary(14.0, 0.5), style.vary(12.0, 0.5)

    def placed(shape):
        return shape.moved(z=0.058).turned("x", -lean).turned("y", tilt).moved(0.020, -0.055, 0.170 + 0.02 * (grow - 1))

    ear = placed(ellipsoid(0.022, 0.012, 0.066))
    inner = placed(ellipsoid(0.012, 0.010, 0.048).moved(y=-0.010))
    haunch = egg((0.034, 0.052, 0.048), (0.048, 0.035, 0.042))
    foot = limb((0.055, 0.02, 0.014), (0.056, -0.035, 0.012), 0.018, 0.016)
    paw = limb((0.026, -0.062, 0.080), (0.027, -0.082, 0.014), 0.019, 0.017)
    return finish(
        style,
        [
            (egg((0.064, 0.086, 0.070), (0.0, 0.015, 0.066), -12), coat),
            (egg(size, at), coat),
            (pair(ear), coat),
            (join(pair(haunch), pair(foot), pair(paw)), coat),
            (ellipsoid(0.024).moved(0.0, 0.098, 0.050), tint(coat, 0.7)),
        ],
        paint=[
            (pair(inner), PINK),
            (egg((0.030, 0.014, 0.022), (0.0, -0.062 - 0.056 * grow, 0.124)), tint(coat, 0.6)),
            (eyes(size, at, 0.030, 0.150, 0.008), eye_colour(coat)),
            (egg((0.008, 0.012, 0.006), (0.0, -0.062 - 0.056 * grow, 0.134)), PINK),
        ],
        regions=[on_top(egg(size, at), 0.02)],
        size=0.6 if young(style) else 1.0,
    )


@entry("giraffe", family="plush", synonyms=("plush giraffe", "toy giraffe", "stuffed giraffe",
       "giraffe plush", "giraffe toy"), material="plush", colours=("yellow",), accents=("brown",))  # fmt: skip
def giraffe(style: Style) -> Build:
    """A standing giraffe with a long neck and brown patches, 50 cm tall."""
    coat, patch = style.colour(), style.colour(1)
    stretch = 1.12 if "tall" in style.adjectives else 1.0
    crown = 0.415 * stretch
    body = egg((0.058, 0.092, 0.062), (0.0, 0.02, 0.205), 4)
    nape = style.vary(0.105, 0.08)
    neck = limb((0.0, -0.045, 0.225), (0.0, -nape, crown), 0.036, 0.026)
    size, at = (0.030, 0.052, 0.030), (0.0, -nape - 0.030, crown + 0.016)
    horn = limb((0.013, -nape + 0.004, crown + 0.03), (0.017, -nape + 0.008, crown + 0.068), 0.007, 0.009)
    ear = ellipsoid(0.026, 0.009, 0.013).turned("y", -20).moved(0.044, -nape + 0.006, crown + 0.024)
    tail = limb((0.0, 0.105, 0.22), (0.0, 0.125, 0.13), 0.008, 0.011)
    spots = []
    for k in range(16):
        angle, side = style.rng.uniform(0.15, 1.0), (-1.0, 1.0)[k % 2]
        along = (k // 2 + style.rng.uniform(0.2, 0.8)) / 8
        if along < 0.5:
            centre = (side * 0.056 * angle, 0.11 - 0.36 * along, 0.205 + 0.062 * (1 - angle**2) ** 0.5)
            spots.append(ellipsoid(*(style.vary(0.02, 0.3) for _ in range(3))).moved(*centre))
        else:
            t = 2 * along - 1
            centre = (side * 0.030, -0.045 + t * (0.045 - nape), 0.225 + t * (crown - 0.235))
            spots.append(ellipsoid(*(style.vary(0.016, 0.3) for _ in range(3))).moved(*centre))
    return finish(
        style,
        [
            (body, coat),
            (neck, coat),
            (egg(size, at, 14), coat),
            (legs(0.034, 0.035, 0.068, 0.205, 0.022), coat),
            (join(pair(ear), tail), coat),
            (pair(horn), patch),
        ],
        paint=[
            (join(*spots), patch),
            (join(*(cylinder(0.03, 0.04).moved(x, y, -0.02) for x in (-0.034, 0.034) for y in (-0.035, 0.068))), patch),
            (egg((0.026, 0.020, 0.020), (0.0, -nape - 0.082, crown + 0.002)), tint(coat, 0.55)),
            (_side_eyes(size, at), DARK),
        ],
        regions=[on_top(body, 0.035)],
    )


def _side_eyes(size, at):
    """Eyes on the sides of a long head, a little before its middle."""
    return pair(ellipsoid(0.007).moved(0.93 * size[0], at[1] - 0.25 * size[1], at[2] + 0.30 * size[2]))


@entry(
    "plush dog",
    family="plush",
    synonyms=("plush toy dog", "toy dog", "stuffed dog", "dog plush", "dog toy", "plush puppy"),
    plurals=("plush puppies",),
    material="plush",
    colours=("tan", "brown", "cream"),
)
def plush_dog(style: Style) -> Build:
    """A seated floppy-eared dog, 34 cm tall, whose broad flat crown carries hats."""
    coat = style.colour()
    dark = style.shade(coat, 0.62)
    size, at = (0.098, 0.088, 0.088), (0.0, -0.020, 0.268)
    head = egg(size, at).cut_above(0.338)
    droop = style.vary(0.115, 0.1)
    ear = limb((0.064, -0.015, 0.290), (droop, -0.022, 0.205), 0.026, 0.034)
    muzzle = egg((0.048, 0.052, 0.037), (0.0, -0.100, 0.243))
    foreleg = limb((0.045, -0.045, 0.155), (0.050, -0.085, 0.032), 0.034, 0.031)
    paw = egg((0.036, 0.050, 0.034), (0.052, -0.105, 0.022))
    haunch = egg((0.052, 0.082, 0.060), (0.082, 0.005, 0.050), 8)
    tail = limb((0.0, 0.085, 0.040), (style.vary(0.05, 0.5), 0.140, 0.095), 0.020, 0.016)
    return finish(
        style,
        [
            (egg((0.088, 0.085, 0.125), (0.0, 0.015, 0.115)), coat),
            (head, coat),
            (muzzle, tint(coat, 0.55)),
            (pair(ear), dark),
            (join(pair(foreleg), pair(haunch), tail), coat),
            (pair(paw), tint(coat, 0.45)),
        ],
        paint=[
            (egg((0.030, 0.03, 0.045), (0.0, -0.072, 0.165)), tint(coat, 0.45)),
            (egg((0.020, 0.017, 0.014), (0.0, -0.148, 0.258)), DARK),
            (eyes(size, at, 0.036, 0.288, 0.011), DARK),
        ],
        regions=[on_top(head, 0.045)],
    )


@entry(
    "plush cat",
    family="plush",
    synonyms=("plush toy cat", "toy cat", "stuffed cat", "cat plush", "plush kitten"),
    material="plush",
    colours=("gray", "orange", "black"),
)
def plush_cat(style: Style) -> Build:
    """A seated cat with a round head, 28 cm tall."""
    coat = style.colour()
    size, at = (0.082, 0.070, 0.070), (0.0, -0.018, 0.205)
    head = egg(size, at)
    ear = cone(0.030, 0.055, sides=6).scaled(1.0, 0.6, 1.0).turned("y", 16).moved(0.046, -0.012, 0.252)
    foreleg = limb((0.032, -0.055, 0.100), (0.036, -0.090, 0.024), 0.026, 0.026)
    haunch = egg((0.042, 0.065, 0.050), (0.066, 0.005, 0.042))
    tail = limb((0.06, 0.070, 0.022), (0.115, style.vary(-0.03, 0.7), 0.020), 0.019, 0.016)
    return finish(
        style,
        [
            (egg((0.074, 0.075, 0.100), (0.0, 0.005, 0.090)), coat),
            (head, coat),
            (egg((0.036, 0.026, 0.024), (0.0, -0.072, 0.188)), tint(coat, 0.6)),
            (pair(ear), coat),
            (join(pair(foreleg), pair(haunch), tail), coat),
        ],
        paint=[
            (egg((0.040, 0.022, 0.030), (0.0, -0.068, 0.118)), tint(coat, 0.5)),
            (pair(ellipsoid(0.012, 0.01, 0.028).turned("y", 16).moved(0.052, -0.032, 0.272)), PINK),
            (eyes(size, at, 0.034, 0.216, 0.011), eye_colour(coat)),
            (egg((0.009, 0.010, 0.006), (0.0, -0.098, 0.197)), PINK),
        ],
        regions=[on_top(head, 0.03)],
    )
