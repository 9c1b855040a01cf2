"""Birds and a mouse, as small figures and bath toys."""

from __future__ import annotations

import math

from pat3d.assets.catalogue.creature import DARK, WHITE, egg, eyes, finish, foot, legs, limb, on_top, pair, tint, young
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import Shape, box, cone, cylinder, ellipsoid, join

BEAK: RGB = (232, 140, 44)


def _perched(style: Style, *, coat: RGB, belly: RGB, wing: RGB, beak: RGB, crest: bool, bars: bool) -> Build:
    """A songbird on two short legs, 17 cm from beak to tail."""
    pitch = style.vary(-28.0, 0.15)
    body = egg((0.030, 0.052, 0.032), (0.0, 0.006, 0.062), pitch)
    size, at = (0.023, 0.025, 0.023), (0.0, -0.038, 0.102)
    bill = cone(0.0075, 0.024, sides=6).turned("x", 96).moved(0.0, at[1] - 0.020, at[2] - 0.001)
    plume = cone(0.012, 0.034, sides=6).turned("x", -48).moved(0.0, at[1] + 0.004, at[2] + 0.015)
    feather = egg((0.007, 0.046, 0.021), (0.0285, 0.020, 0.064), pitch - 2).turned("z", -3)
    tail = (
        box(0.028, 0.085, 0.006)
        .turned("x", pitch * 0.8)
        .moved(0.0, 0.082, 0.024 + 0.052 * math.sin(math.radians(-pitch)) * 0.2)
    )
    shanks = pair(limb((0.013, 0.002, 0.006), (0.012, 0.008, 0.040), 0.004, 0.006))
    feet = pair(foot(0.014, -0.004, 0.011, 0.044, 0.005))
    front = egg((0.026, 0.045, 0.030), (0.0, -0.022, 0.056), -50)
    paint = [(Shape(front.solid, ()), belly), (egg((0.014, 0.012, 0.012), (0.0, at[1] - 0.020, at[2] - 0.012)), belly)]
    if bars:
        stripes = [box(0.2, 0.004, 0.2).turned("x", 20).moved(0.0, 0.028 + 0.012 * k, -0.06) for k in range(4)]
        side = join(*(box(0.02, 0.06, 0.03).moved(s * 0.036, 0.046, 0.040) for s in (-1, 1)))
        paint.append((Shape(join(*stripes).solid ^ side.solid, ()), WHITE))
        paint.append((Shape(cylinder(0.05, 0.006).turned("x", 40).moved(0.0, -0.026, 0.082).solid, ()), DARK))
    paint.append((eyes(size, at, 0.012, at[2] + 0.006, 0.0038), DARK))
    parts = [
        (join(body, egg(size, at)), coat),
        (pair(feather), wing),
        (tail, wing),
        (bill, beak),
        (join(shanks, feet), (92, 84, 80)),
    ]
    if crest:
        parts.append((plume, coat))
    return finish(style, parts, paint=paint, regions=[on_top(egg(size, at), 0.01)], mass=0.085)


@entry(
    "blue jay", family="animals", synonyms=("bluejay", "jay"), material="wool", colours=("blue",), accents=("white",)
)
def blue_jay(style: Style) -> Build:
    """A crested blue bird with a white breast, barred wings and a dark collar."""
    coat = style.colour()
    return _perched(
        style, coat=coat, belly=style.colour(1), wing=style.shade(coat, 0.75), beak=DARK, crest=True, bars=True
    )


@entry(
    "bird",
    family="animals",
    synonyms=("songbird", "small bird", "robin", "sparrow", "canary", "toy bird", "parrot"),
    material="wool",
    colours=("yellow", "red", "teal", "brown"),
)
def bird(style: Style) -> Build:
    """A small songbird with a light breast."""
    coat = style.colour()
    return _perched(
        style, coat=coat, belly=tint(coat, 0.6), wing=style.shade(coat, 0.72), beak=BEAK, crest=False, bars=False
    )


def _duck_body(style: Style, coat: RGB, wing: RGB, head: RGB) -> tuple[list, Shape, tuple, tuple]:
    size, at = (0.027, 0.028, 0.027), (0.0, -0.028, 0.080)
    skull = egg(size, at)
    bill = egg((0.0145, 0.017, 0.0055), (0.0, -0.060, 0.076), 6)
    feather = egg((0.008, 0.028, 0.017), (0.0355, 0.010, 0.044), -14)
    tail = limb((0.0, 0.036, 0.040), (0.0, style.vary(0.062, 0.05), 0.060), 0.017, 0.006)
    parts = [
        (join(egg((0.039, 0.052, 0.034), (0.0, 0.004, 0.030)), tail), coat),
        (skull, head),
        (pair(feather), wing),
        (bill, BEAK),
    ]
    return parts, skull, size, at


@entry(
    "rubber duck",
    family="toys",
    synonyms=("rubber ducky", "bath duck", "rubber duckie", "toy duck", "yellow duck"),
    material="rubber",
    colours=("yellow",),
)
def rubber_duck(style: Style) -> Build:
    """A hollow bath duck, 11 cm long."""
    coat = style.colour()
    parts, skull, size, at = _duck_body(style, coat, style.shade(coat, 0.93), coat)
    whites = eyes(size, at, 0.011, at[2] + 0.009, 0.0062)
    return finish(
        style,
        parts,
        paint=[(whites, WHITE), (eyes((0.029, 0.030, 0.029), at, 0.0115, at[2] + 0.0095, 0.0044), DARK)],
        regions=[on_top(skull, 0.012)],
        mass=0.055,
    )


@entry("duck", family="animals", synonyms=("mallard", "duckling", "goose"), plurals=("geese",),
       material="wool", colours=("brown", "white"), accents=("green",))  # fmt: skip
def duck(style: Style) -> Build:
    """A resting mallard with a green head, 40 cm long (a baby one 12 cm)."""
    coat = style.colour()
    head = coat if young(style) else style.colour(1)
    parts, skull, size, at = _duck_body(style, coat, style.shade(coat, 0.75), head)
    ring = cylinder(0.04, 0.006).moved(0.0, -0.024, 0.0575)
    collar = [] if young(style) else [(Shape(ring.solid, ()), WHITE)]
    return finish(
        style,
        parts,
        paint=[*collar, (eyes(size, at, 0.014, at[2] + 0.008, 0.004), DARK)],
        regions=[on_top(skull, 0.012)],
        mass=0.022,
        size=1.1 if young(style) else 3.4,
    )


@entry("penguin", family="animals", synonyms=("plush penguin", "toy penguin", "stuffed penguin"),
       material="plush", colours=("black", "navy"), accents=("orange",))  # fmt: skip
def penguin(style: Style) -> Build:
    """An upright plush penguin with a white front, 28 cm tall."""
    coat, beak = style.colour(), style.colour(1)
    size, at = (0.062, 0.058, 0.056), (0.0, -0.006, 0.220)
    open_by = style.vary(12.0, 0.6)
    flipper = egg((0.014, 0.034, 0.070), (0.0, 0.0, -0.05)).turned("y", -open_by).moved(0.076, -0.005, 0.170)
    bill = cone(0.015, 0.036, sides=8).turned("x", 94).moved(0.0, -0.055, 0.216)
    feet = egg((0.034, 0.046, 0.020), (0.036, -0.045, 0.010))
    face = pair(egg((0.023, 0.025, 0.026), (0.020, -0.056, 0.226)))
    return finish(
        style,
        [
            (join(egg((0.080, 0.074, 0.115), (0.0, 0.005, 0.105)), egg(size, at)), coat),
            (pair(flipper), coat),
            (join(bill, pair(feet)), beak),
        ],
        paint=[
            (egg((0.055, 0.05, 0.085), (0.0, -0.055, 0.105)), WHITE),
            (face, WHITE),
            (eyes(size, at, 0.021, 0.232, 0.0085), DARK),
        ],
        regions=[on_top(egg(size, at), 0.03)],
    )


@entry(
    "owl",
    family="animals",
    synonyms=("toy owl", "owl figurine", "plush owl"),
    material="plush",
    colours=("brown", "tan", "gray"),
)
def owl(style: Style) -> Build:
    """An upright owl with large eyes and ear tufts, 20 cm tall."""
    coat = style.colour()
    size, at = (0.056, 0.050, 0.050), (0.0, -0.004, 0.142)
    wing = egg((0.014, 0.040, 0.058), (0.060, 0.008, 0.082)).turned("y", style.vary(2.0, 0.9))
    tuft = cone(0.014, 0.034, sides=6).turned("y", 24).moved(0.030, -0.006, 0.172)
    bill = cone(0.009, 0.026, sides=6).turned("x", 150).moved(0.0, -0.048, 0.146)
    feet = egg((0.018, 0.022, 0.011), (0.024, -0.046, 0.005))
    rings, ring = eyes(size, at, 0.022, 0.152, 0.0185), eyes((0.058, 0.052, 0.052), at, 0.022, 0.152, 0.010)
    rows = [
        ellipsoid(0.0065, 0.01, 0.0045).moved(x, -0.052, z)
        for z, xs in (
            (0.092, (-0.018, 0.0, 0.018)),
            (0.074, (-0.009, 0.009, 0.027, -0.027)),
            (0.056, (-0.018, 0.0, 0.018)),
        )
        for x in xs
    ]
    return finish(
        style,
        [
            (join(egg((0.060, 0.055, 0.085), (0.0, 0.0, 0.080)), egg(size, at)), coat),
            (pair(tuft), coat),
            (pair(wing), style.shade(coat, 0.7)),
            (join(bill, pair(feet)), BEAK),
        ],
        paint=[
            (egg((0.038, 0.04, 0.055), (0.0, -0.042, 0.076)), tint(coat, 0.5)),
            (join(*rows), style.shade(coat, 0.8)),
            (rings, tint(coat, 0.85)),
            (ring, DARK),
        ],
        regions=[on_top(egg(size, at), 0.025)],
    )


@entry(
    "mouse",
    family="animals",
    synonyms=("toy mouse", "rat", "plush mouse"),
    plurals=("mice",),
    material="plush",
    colours=("gray", "white"),
)
def mouse(style: Style) -> Build:
    """A toy mouse with round ears and a long tail, 10 cm long."""
    coat = style.colour()
    body = limb((0.0, 0.020, 0.020), (0.0, -0.038, 0.014), 0.026, 0.009)
    ear = ellipsoid(0.014, 0.005, 0.014).turned("z", 12).moved(0.019, -0.014, 0.043)
    inner = ellipsoid(0.0095, 0.004, 0.0095).moved(0.020, -0.0185, 0.043)
    tail = limb((0.0, 0.042, 0.006), (style.vary(0.022, 0.8), 0.095, 0.004), 0.005, 0.0035)
    feet = legs(0.016, 0.012, 0.020, 0.012, 0.007)
    return finish(
        style,
        [(body, coat), (pair(ear), coat), (join(tail, feet), (230, 160, 156))],
        paint=[
            (pair(inner), (230, 160, 156)),
            (ellipsoid(0.004).moved(0.0, -0.0475, 0.016), DARK),
            (pair(ellipsoid(0.003).moved(0.0095, -0.0335, 0.0215)), DARK),
        ],
        mass=0.02,
    )
