"""Birds, reptiles and sea animals, as small figures and bath toys."""

from __future__ import annotations

import math

from pat3d.assets.catalogue.creature import DARK, WHITE, egg, eyes, finish, legs, limb, on_top, pair, tint, young
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import Shape, box, cone, convex, cylinder, ellipsoid, join

BEAK: RGB = (232, 140, 44)


def _foot(x: float, y: float, wide: float, long: float, thick: float) -> Shape:
    """A flat three-toed foot [m]: a wedge that widens to the front."""
    outline = [
        (x - wide * 0.3, y + long * 0.5),
        (x + wide * 0.3, y + long * 0.5),
        (x + wide, y - long * 0.5),
        (x - wide, y - long * 0.5),
    ]
    return convex([(px, py, z) for px, py in outline for z in (0.0, thick)])


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
    feet = pair(_foot(0.014, -0.004, 0.011, 0.044, 0.005))
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


@entry("frog", family="animals", synonyms=("toad", "toy frog", "frog figurine"), material="rubber", colours=("green",))
def frog(style: Style) -> Build:
    """A squatting frog with bulging eyes, 9 cm long."""
    coat = style.colour()
    body = egg((0.032, 0.044, 0.024), (0.0, 0.006, 0.027), -16)
    bulge = ellipsoid(0.0095).moved(0.0165, -0.026, 0.050)
    thigh = egg((0.014, 0.026, 0.015), (0.036, 0.022, 0.014), 6)
    hind = _foot(0.044, -0.004, 0.012, 0.030, 0.005)
    arm = limb((0.026, -0.022, 0.024), (0.034, -0.036, 0.006), 0.0085, 0.007)
    fore = _foot(0.036, -0.046, 0.011, 0.024, 0.005)
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
