"""Four-legged animals: living dogs and cats, and farm and wild animals as toy figures."""

from __future__ import annotations

from dataclasses import dataclass

from pat3d.assets.catalogue.creature import (
    DARK,
    Coloured,
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
from pat3d.assets.shapes import Shape, cone, cylinder, ellipsoid, join

PINK: RGB = (230, 160, 156)


@dataclass(frozen=True, kw_only=True)
class _Frame:
    """A standing four-legged body [m], facing -y."""

    body: Shape
    legs: Shape
    neck: Shape
    head: Shape
    snout: Shape
    size: tuple[float, float, float]
    """Semi-axes of the head."""
    at: tuple[float, float, float]
    """Centre of the head."""
    muzzle: tuple[float, float, float]
    """Centre of the ball at the end of the snout."""

    def coloured(self, coat: RGB) -> list[Coloured]:
        return [(join(self.body, self.legs, self.neck, self.head, self.snout), coat)]


def _standing(
    *,
    long: float,
    deep: float,
    high: float,
    leg: float,
    head: float,
    reach: float,
    rise: float,
    snout: float,
    wide: float = 1.0,
) -> _Frame:
    """A body `long` and 2 `deep` [m] with its axis at height `high`, its head `reach` before and `rise` above it."""
    half = long / 2
    body = limb((0.0, half - deep, high), (0.0, deep - half, high), deep, 0.95 * deep).scaled(wide, 1.0, 1.0)
    at = (0.0, -half - reach, high + rise)
    size = (head, 1.1 * head, head)
    muzzle = (0.0, at[1] - 0.8 * head - snout, at[2] - 0.45 * head)
    return _Frame(
        body=body,
        legs=legs(wide * 0.92 * deep - leg, half - 0.95 * deep, half - 0.85 * deep, high, leg),
        neck=limb((0.0, -half + 0.85 * deep, high + 0.3 * deep), at, 0.62 * deep, 0.8 * head),
        head=egg(size, at),
        snout=limb((0.0, at[1] - 0.45 * head, at[2] - 0.2 * head), muzzle, 0.66 * head, 0.55 * head),
        size=size,
        at=at,
        muzzle=muzzle,
    )


def _sitting(style: Style, coat: RGB, *, head: Shape, high: float, ruff: float) -> list[Coloured]:
    """Trunk, haunches, forelegs and paws of a sitting dog or cat that carries `head` at height `high` [m]."""
    trunk = limb((0.0, 0.065, 0.080), (0.0, -0.030, 0.195), 0.074, 0.060)
    neck = limb((0.0, -0.035, 0.215), (0.0, -0.062, high), ruff, 0.9 * ruff)
    haunch = egg((0.042, 0.075, 0.060), (0.055, 0.055, 0.056))
    foreleg = limb((0.036, -0.055, 0.165), (0.040, -0.075, 0.024), 0.025, 0.023)
    paw = egg((0.026, 0.038, 0.021), (0.041, -0.092, 0.015))
    lighter = tint(coat, 0.35) if style.rng.random() < 0.5 else coat
    return [
        (join(trunk, neck, head), coat),
        (join(pair(haunch), pair(foreleg)), coat),
        (pair(paw), lighter),
    ]


@entry("dog", family="animals", synonyms=("puppy", "small dog", "pup", "little dog"),
       plurals=("puppies",), material="wool", colours=("tan", "brown", "golden", "white"))  # fmt: skip
def dog(style: Style) -> Build:
    """A small sitting dog with drooping ears, 36 cm tall."""
    coat = style.colour()
    dark = style.shade(coat, 0.6)
    size, at = (0.054, 0.060, 0.052), (0.0, -0.075, 0.308)
    snout = limb((0.0, -0.120, 0.296), (0.0, -0.166, 0.286), 0.030, 0.024)
    droop = style.vary(0.066, 0.12)
    ear = limb((0.042, -0.055, 0.342), (droop, -0.062, 0.280), 0.014, 0.021)
    tail = limb((0.0, 0.120, 0.050), (style.vary(0.04, 0.9), 0.195, 0.095), 0.016, 0.010)
    head = egg(size, at)
    return finish(
        style,
        [
            *_sitting(style, coat, head=head, high=0.285, ruff=0.050),
            (snout, tint(coat, 0.35)),
            (pair(ear), dark),
            (tail, coat),
        ],
        paint=[
            (egg((0.030, 0.03, 0.05), (0.0, -0.085, 0.185)), tint(coat, 0.5)),
            (egg((0.014, 0.013, 0.011), (0.0, -0.188, 0.294)), DARK),
            (eyes(size, at, 0.026, 0.322, 0.008), eye_colour(coat)),
        ],
        regions=[on_top(head, 0.03)],
        mass=5.5,
        size=0.72 if young(style) else 1.0,
    )


@entry("cat", family="animals", synonyms=("kitten", "kitty", "house cat"), plurals=("kitties",),
       material="wool", colours=("gray", "orange", "black", "white"))  # fmt: skip
def cat(style: Style) -> Build:
    """A sitting cat with pricked ears and its tail around its feet, 34 cm tall."""
    coat = style.colour()
    size, at = (0.050, 0.048, 0.044), (0.0, -0.070, 0.285)
    head = egg(size, at)
    ear = cone(0.021, 0.044, sides=6).scaled(1.0, 0.6, 1.0).turned("y", 14).moved(0.029, -0.062, 0.312)
    inner = ellipsoid(0.009, 0.008, 0.022).turned("y", 14).moved(0.033, -0.076, 0.328)
    side = 1.0 if style.rng.random() < 0.5 else -1.0
    tail = join(
        limb((side * 0.03, 0.125, 0.020), (side * 0.105, 0.075, 0.017), 0.015),
        limb((side * 0.105, 0.075, 0.017), (side * 0.100, style.vary(-0.03, 0.5), 0.015), 0.015, 0.012),
    )
    stripes = [cylinder(0.3, 0.011).turned("x", 90 - 40 * k / 4).moved(0.0, 0.05 + 0.035 * k, 0.20) for k in range(4)]
    back = egg((0.1, 0.10, 0.10), (0.0, 0.115, 0.16))
    bands = join(*stripes)
    tabby = [(Shape(bands.solid ^ back.solid, ()), style.shade(coat, 0.72))] if style.rng.random() < 0.6 else []
    return finish(
        style,
        [
            *_sitting(style, coat, head=head, high=0.265, ruff=0.038),
            (egg((0.024, 0.020, 0.017), (0.0, -0.108, 0.272)), tint(coat, 0.5)),
            (pair(ear), coat),
            (tail, coat),
        ],
        paint=[
            *tabby,
            (pair(inner), PINK),
            (egg((0.028, 0.03, 0.045), (0.0, -0.085, 0.185)), tint(coat, 0.5)),
            (egg((0.007, 0.008, 0.005), (0.0, -0.127, 0.278)), PINK),
            (eyes(size, at, 0.022, 0.293, 0.0075), eye_colour(coat)),
        ],
        regions=[on_top(head, 0.02)],
        mass=4.0,
        size=0.6 if "kitten" in style.adjectives or young(style) else 1.0,
    )


@entry(
    "cow",
    family="animals",
    synonyms=("cow figurine", "toy cow", "cow figure", "cattle", "bull", "small cow figurine"),
    colours=("white", "brown"),
    accents=("black",),
)
def cow(style: Style) -> Build:
    """A patched toy cow with horns and an udder, 13 cm long."""
    coat, patch = style.colour(), style.colour(1)
    frame = _standing(long=0.104, deep=0.023, high=0.052, leg=0.0075, head=0.0125, reach=0.006, rise=0.022, snout=0.006)
    _, y, z = frame.at
    horn = limb((0.007, y + 0.002, z + 0.009), (0.0165, y + 0.001, z + 0.020), 0.0032, 0.0022)
    ear = ellipsoid(0.009, 0.0035, 0.005).turned("y", 18).moved(0.0185, y + 0.002, z + 0.003)
    tail = limb((0.0, 0.050, 0.064), (0.0, 0.059, 0.030), 0.0028, 0.004)
    udder = egg((0.0115, 0.014, 0.010), (0.0, 0.022, 0.031))
    spots = [
        ellipsoid(*(style.vary(0.013, 0.35) for _ in range(3))).moved(
            side * 0.021, style.rng.uniform(-0.045, 0.045), 0.056 + style.rng.uniform(-0.012, 0.014)
        )
        for side in (-1, 1, -1, 1, -1)
    ]
    return finish(
        style,
        [*frame.coloured(coat), (join(pair(ear), tail), coat), (pair(horn), tint((200, 170, 120), 0.4)), (udder, PINK)],
        paint=[
            (join(*spots), patch),
            (cylinder(0.08, 0.016).moved(y=0.0, z=-0.008), style.shade(patch, 0.9)),
            (ellipsoid(0.010).moved(*frame.muzzle).moved(y=-0.004), PINK),
            (eyes(frame.size, frame.at, 0.008, z + 0.004, 0.0026), DARK),
        ],
        regions=[on_top(frame.body, 0.012)],
        mass=0.09,
    )


@entry("pig", family="animals", synonyms=("piglet", "toy pig", "pig figurine"), colours=("pink",))
def pig(style: Style) -> Build:
    """A round toy pig with a flat snout, 10 cm long."""
    coat = style.colour()
    frame = _standing(
        long=0.088, deep=0.026, high=0.042, leg=0.0085, head=0.019, reach=0.002, rise=0.010, snout=0.003, wide=1.05
    )
    _, y, z = frame.at
    ear = cone(0.009, 0.016, sides=6).scaled(1, 0.5, 1).turned("x", 25).turned("y", 25).moved(0.0115, y, z + 0.012)
    tail = limb((0.0, 0.042, 0.052), (0.004, 0.049, 0.058), 0.003)
    nose = cylinder(0.0095, 0.008, 12).turned("x", 90).moved(0.0, frame.muzzle[1] - 0.005, frame.muzzle[2])
    holes = pair(ellipsoid(0.002).moved(0.0035, frame.muzzle[1] - 0.013, frame.muzzle[2]))
    return finish(
        style,
        [*frame.coloured(coat), (join(pair(ear), tail), coat), (nose, style.shade(coat, 0.9))],
        paint=[(holes, style.shade(coat, 0.45)), (eyes(frame.size, frame.at, 0.009, z + 0.006, 0.0026), DARK)],
        regions=[on_top(frame.body, 0.012)],
        mass=0.08,
    )


@entry(
    "sheep", family="animals", synonyms=("lamb", "toy sheep", "sheep figurine"), colours=("cream",), accents=("black",)
)
def sheep(style: Style) -> Build:
    """A woolly toy sheep with a dark face, 10 cm long."""
    coat, face = style.colour(), style.colour(1)
    frame = _standing(long=0.080, deep=0.019, high=0.048, leg=0.006, head=0.0125, reach=0.004, rise=0.018, snout=0.006)
    _, y, z = frame.at
    fleece = join(
        egg((0.029, 0.040, 0.026), (0.0, 0.004, 0.052)),
        egg((0.022, 0.020, 0.019), (0.0, -0.026, 0.060)),
        egg((0.022, 0.020, 0.020), (0.0, 0.032, 0.057)),
    )
    ear = ellipsoid(0.009, 0.0035, 0.005).turned("y", 25).moved(0.017, y + 0.002, z + 0.001)
    return finish(
        style,
        [
            (fleece, coat),
            (join(frame.head, frame.snout, pair(ear)), face),
            (frame.legs, face),
            (egg((0.011, 0.010, 0.007), (0.0, y + 0.004, z + 0.011)), coat),
        ],
        paint=[(eyes(frame.size, frame.at, 0.008, z + 0.003, 0.0028), (236, 232, 220))],
        regions=[on_top(egg((0.029, 0.040, 0.026), (0.0, 0.004, 0.052)), 0.012)],
        mass=0.07,
    )


@entry("horse", family="animals", synonyms=("pony", "toy horse", "horse figurine"), plurals=("ponies",),
       colours=("brown", "chocolate"), accents=("black",))  # fmt: skip
def horse(style: Style) -> Build:
    """A standing toy horse with mane and tail, 16 cm long."""
    coat, mane = style.colour(), style.colour(1)
    frame = _standing(long=0.120, deep=0.022, high=0.078, leg=0.0075, head=0.0125, reach=0.010, rise=0.052, snout=0.014)
    _, y, z = frame.at
    ear = cone(0.005, 0.013, sides=6).turned("y", 8).moved(0.006, y + 0.004, z + 0.009)
    crest = limb((0.0, -0.036, 0.104), (0.0, y + 0.010, z + 0.010), 0.007, 0.006)
    tail = limb((0.0, 0.056, 0.088), (0.0, style.vary(0.074, 0.06), 0.040), 0.007, 0.008)
    return finish(
        style,
        [*frame.coloured(coat), (pair(ear), coat), (join(crest, tail), mane)],
        paint=[
            (cylinder(0.1, 0.018).moved(z=-0.009), style.shade(mane, 0.9)),
            (ellipsoid(0.004, 0.03, 0.008).turned("x", 35).moved(0.0, y - 0.016, z + 0.003), tint(coat, 0.85)),
            (pair(ellipsoid(0.0026).moved(0.0115, y - 0.006, z + 0.004)), DARK),
        ],
        regions=[on_top(frame.body, 0.012)],
        mass=0.12,
    )


@entry("lion", family="animals", synonyms=("toy lion", "lion figurine"), colours=("golden", "tan"), accents=("brown",))
def lion(style: Style) -> Build:
    """A standing toy lion with a mane, 14 cm long."""
    coat, mane = style.colour(), style.colour(1)
    frame = _standing(long=0.104, deep=0.020, high=0.050, leg=0.008, head=0.0155, reach=0.002, rise=0.024, snout=0.006)
    _, y, z = frame.at
    ruff = cylinder(0.030, 0.022, 12).turned("x", 90).moved(0.0, y + 0.020, z - 0.003)
    ear = ellipsoid(0.005, 0.0035, 0.005).moved(0.0125, y - 0.002, z + 0.0135)
    tail = limb((0.0, 0.050, 0.060), (0.0, 0.080, 0.038), 0.003)
    tuft = limb((0.0, 0.080, 0.038), (0.0, 0.086, 0.034), 0.006)
    return finish(
        style,
        [*frame.coloured(coat), (join(pair(ear), tail), coat), (join(ruff, tuft), mane)],
        paint=[
            (
                ellipsoid(0.0075, 0.005, 0.007).moved(0.0, frame.muzzle[1] - 0.008, frame.muzzle[2] - 0.002),
                tint(coat, 0.6),
            ),
            (ellipsoid(0.004, 0.006, 0.003).moved(0.0, frame.muzzle[1] - 0.008, frame.muzzle[2] + 0.004), DARK),
            (eyes(frame.size, frame.at, 0.007, z + 0.005, 0.0025), DARK),
        ],
        regions=[on_top(frame.body, 0.012)],
        mass=0.09,
    )


@entry(
    "dinosaur",
    family="animals",
    synonyms=("toy dinosaur", "dino", "dinosaur figurine"),
    colours=("green", "olive", "teal"),
)
def dinosaur(style: Style) -> Build:
    """A long-necked toy dinosaur with a row of back plates, 22 cm long."""
    coat = style.colour()
    body = egg((0.030, 0.052, 0.030), (0.0, 0.0, 0.055))
    lift = style.vary(0.140, 0.08)
    neck = join(
        limb((0.0, -0.030, 0.064), (0.0, -0.066, 0.105), 0.020, 0.014),
        limb((0.0, -0.066, 0.105), (0.0, -0.074, lift), 0.014, 0.011),
    )
    size, at = (0.0135, 0.022, 0.013), (0.0, -0.086, lift + 0.006)
    tail = join(
        limb((0.0, 0.030, 0.054), (0.0, 0.080, 0.034), 0.022, 0.012),
        limb((0.0, 0.080, 0.034), (0.0, 0.128, 0.026), 0.012, 0.004),
    )
    plates = [
        cone(r, 2.2 * r, sides=6).scaled(0.35, 1.0, 1.0).moved(0.0, y, z)
        for r, y, z in (
            (0.008, -0.056, 0.102),
            (0.010, -0.022, 0.080),
            (0.011, 0.006, 0.083),
            (0.010, 0.034, 0.074),
            (0.008, 0.062, 0.054),
        )
    ]
    return finish(
        style,
        [
            (join(body, neck, egg(size, at, 10), tail), coat),
            (legs(0.020, 0.027, 0.027, 0.052, 0.0125), coat),
            (join(*plates), style.shade(coat, 0.6)),
        ],
        paint=[
            (egg((0.022, 0.05, 0.014), (0.0, 0.0, 0.026)), tint(coat, 0.4)),
            (pair(ellipsoid(0.003).moved(0.011, -0.092, lift + 0.011)), DARK),
        ],
        regions=[on_top(body, 0.012)],
        mass=0.11,
    )
