"""What a workshop and a garage hold beside hand tools."""

from __future__ import annotations

import math

import numpy as np

from pat3d.assets.catalogue.joinery import (
    BLACK,
    STEEL,
    WHITE,
    drawn,
    lying,
    padded,
    shelf_top,
    span,
    together,
)
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.rounded import curve, lathe, tube, unseen
from pat3d.assets.shapes import Shape, box, convex, cylinder, frustum, join

DARK_STEEL: RGB = (112, 116, 124)
SCREEN: RGB = (160, 176, 156)


@entry("vise", family="tools", synonyms=("bench vise", "vice", "bench vice"), material="iron", colours=("blue", "gray",
       "red"), accents=("steel",))  # fmt: skip
def vise(style: Style) -> Build:
    """A bench vise standing on its base, its jaws a little open, its screw to the left."""
    k = style.vary(1.0)
    base = box(0.15, 0.12, 0.02)
    post = box(0.09, 0.09, 0.05).moved(0.01, 0.0, 0.019)
    fixed = convex(
        [
            (x, y, z)
            for x, z in ((0.0, 0.068), (0.08, 0.068), (0.08, 0.1), (0.03, 0.13), (0.0, 0.13))
            for y in (-0.05, 0.05)
        ]
    )
    slide = box(0.16, 0.05, 0.035).moved(-0.06, 0.0, 0.066)
    moving = convex(
        [
            (x, y, z)
            for x, z in ((-0.03, 0.066), (-0.09, 0.066), (-0.09, 0.1), (-0.06, 0.13), (-0.03, 0.13))
            for y in (-0.05, 0.05)
        ]
    )
    jaws = [box(0.007, 0.1, 0.028).moved(x, 0.0, 0.103) for x in (-0.0275, -0.0025)]
    screw = lying(0.011, 0.06, sides=8).moved(-0.155, 0.0, 0.073)
    handle = lying(0.0055, 0.14, sides=6).turned("z", 90).moved(-0.178, 0.0, 0.0785)
    shapes = ((join(base, post, fixed, slide, moving), style.colour()), (join(*jaws, screw, handle), style.colour(1)))
    return Build(parts=tuple((shape.scaled(k), colour) for shape, colour in shapes), mass=style.vary(6.0))


@entry("multimeter", family="tools", synonyms=("voltmeter", "multi meter", "digital multimeter"), material="plastic",
       colours=("yellow", "red", "orange"), accents=("black",))  # fmt: skip
def multimeter(style: Style) -> Build:
    """A meter lying on its back: a display, a selector and three sockets."""
    x, y, z = style.vary(0.085), style.vary(0.165), style.vary(0.038)
    body = padded(x, y, z, 0.008)
    face = span((-0.4 * x, 0.4 * x), (-0.44 * y, 0.44 * y), (z - 0.0012, 1))
    screen = span((-0.33 * x, 0.33 * x), (0.2 * y, 0.38 * y), (z - 0.0014, 1))
    digits = together(
        [span((at * x, (at + 0.1) * x), (0.24 * y, 0.34 * y), (z - 0.0016, 1)) for at in (-0.26, -0.12, 0.02, 0.16)]
    )
    knob = join(
        cylinder(0.021, 0.008, 12).moved(0.0, -0.05 * y, z - 0.002),
        box(0.006, 0.04, 0.006).moved(0.0, -0.05 * y, z + 0.005),
    )
    sockets = together(
        [Shape(cylinder(0.0055, 1).solid, ()).moved(at * x, -0.34 * y, z - 0.0016) for at in (-0.26, 0.0, 0.26)]
    )
    return Build(
        parts=((body, style.colour()), (knob, style.colour(1))),
        paint=((drawn(face), (70, 72, 78)), (drawn(screen), SCREEN), (drawn(digits), BLACK), (sockets, (190, 60, 50))),
        mass=style.vary(0.36),
    )


@entry("soldering iron", family="tools", synonyms=("solder iron", "soldering pen"), material="plastic",
       colours=("blue", "red", "yellow"), accents=("steel",))  # fmt: skip
def soldering_iron(style: Style) -> Build:
    """A soldering iron lying on the flats of its handle and collar, its tip to the right."""
    n, r = style.vary(0.12), 0.012
    handle = lying(r, n, sides=8).moved(-n / 2)
    collar = lying(r + 0.001, 0.012, sides=8).moved(0.002)
    shaft = (
        lathe([(0.005, 0.0), (0.005, 0.07), (0.0012, 0.1)], angles=(0.0, 8.0), sides=8)
        .turned("y", 90)
        .moved(0.004, 0.0, r)
    )
    foot = box(0.004, 0.022, r + 0.002).moved(0.012)
    grip = span((-0.32 * n, -0.04 * n), (-1, 1), (-1, 1))
    raised = join(handle, shaft).moved(z=0.001)
    heel = box(0.02, 0.012, 0.004).moved(-n + 0.02)
    return Build(
        parts=((raised, style.colour()), (join(collar, foot), STEEL), (heel, style.colour())),
        paint=((drawn(Shape(grip.solid, ())), BLACK), (drawn(span((0.01, 1), (-1, 1), (-1, 1))), STEEL)),
        mass=0.12,
    )


@entry("glue gun", family="tools", synonyms=("hot glue gun", "heat gun"), material="plastic", colours=("yellow",
       "blue", "orange"), accents=("black",))  # fmt: skip
def glue_gun(style: Style) -> Build:
    """A glue gun lying on its side, its nozzle to the left, its grip to the front."""
    k, t = style.vary(1.0), 0.036
    side = [(-0.06, -0.018), (0.075, -0.022), (0.08, 0.024), (-0.05, 0.024), (-0.075, 0.012)]
    body = convex([(x, y, z) for x, y in side for z in (0.0, t)])
    grip = convex(
        [
            (x, y, z)
            for x, y in ((0.02, -0.018), (0.07, -0.018), (0.09, -0.13), (0.052, -0.135))
            for z in (0.0, t - 0.003)
        ]
    )
    trigger = box(0.016, 0.045, 0.02).moved(0.016, -0.04, 0.008)
    nozzle = frustum(0.013, 0.004, 0.035, 8).turned("y", -90).moved(-0.068, 0.004, t / 2)
    stick = lying(0.0055, 0.05, sides=8).moved(0.1, 0.006, t / 2 - 0.0055)
    vents = together([span((x, x + 0.004), (-0.004, 0.014), (t - 0.001, 1)) for x in np.linspace(-0.03, 0.02, 5)])
    shapes = ((join(body, grip), style.colour()), (join(trigger, nozzle), style.colour(1)), (stick, (236, 230, 214)))
    return Build(
        parts=tuple((shape.scaled(k), colour) for shape, colour in shapes),
        paint=((drawn(vents.scaled(k)), style.colour(1)),),
        mass=0.3,
    )


@entry("jerry can", family="tools", synonyms=("gas can", "fuel can", "petrol can", "oil can", "canister",
       "gasoline can"), material="plastic", colours=("red", "green", "blue"), accents=("black",))  # fmt: skip
def jerry_can(style: Style) -> Build:
    """A closed canister with a carrying bar, a cap at its left and a pressed cross on its side."""
    x, y, z = style.vary(0.26), style.vary(0.14), style.vary(0.24)
    body = padded(x, y, z, 0.02)
    posts = [box(0.02, 0.03, 0.04).moved(at * x, 0.0, z - 0.004) for at in (-0.12, 0.3)]
    bar = padded(0.42 * x + 0.03, 0.032, 0.022, 0.009).moved(0.09 * x, 0.0, z + 0.026)
    cap = cylinder(0.026, 0.045, 12).moved(-0.33 * x, 0.0, z - 0.003)
    cross = together(
        [Shape(box(0.9 * x, 1, 0.012).turned("y", turn).solid, ()).moved(0.0, -0.5, 0.45 * z) for turn in (38, -38)]
    )
    cross = Shape(cross.solid ^ box(0.7 * x, 3, 0.62 * z).moved(z=0.14 * z).solid, ())
    return Build(
        parts=((join(body, *posts, bar), style.colour()), (cap, style.colour(1))),
        paint=((cross, style.shade(style.colour(), 0.72)),),
        mass=1.0,
    )


@entry("tire", family="tools", synonyms=("tyre", "car tire", "wheel", "car tyre", "rubber tire"), material="rubber",
       colours=("black", "gray"), accents=("silver",))  # fmt: skip
def tire(style: Style) -> Build:
    """A car tyre lying flat, open in its middle."""
    big, small = style.vary(0.23), style.vary(0.085)
    turn = np.linspace(0, 2 * np.pi, 49)[:-1]
    path = np.column_stack([big * np.cos(turn), big * np.sin(turn), np.full(48, 1.1 * small)])
    body = tube(path, small, 12, closed=True, flatness=1.1)
    tread = together(
        [
            Shape(cylinder(2 * big, 0.006).solid - cylinder(big + 0.6 * small, 1).moved(z=-0.5).solid, ()).moved(z=h)
            for h in np.linspace(0.8, 1.4, 5) * small
        ]
    )
    ring = Shape(cylinder(big, 1).solid - cylinder(big - 0.012, 3).moved(z=-1).solid, ()).moved(z=2.0 * small)
    main = style.colour()
    other = style.colour(1) if main == BLACK else WHITE
    return Build(parts=((body, main),), paint=((tread, style.shade(main, 0.6)), (ring, other)), mass=style.vary(9.0))


@entry("hacksaw", family="tools", synonyms=("hack saw", "bow saw"), material="steel", colours=("red", "orange",
       "blue"), accents=("steel",))  # fmt: skip
def hacksaw(style: Style) -> Build:
    """A hacksaw lying flat: a bow, a thin blade and a grip at the left."""
    n, t = style.vary(0.3), 0.014
    bow = [
        box(n, 0.014, t).moved(0.0, 0.085),
        box(0.014, 0.1, t).moved(n / 2 - 0.007, 0.042),
        box(0.014, 0.1, t).moved(-n / 2 + 0.007, 0.042),
    ]
    blade = box(n - 0.004, 0.013, 0.0016).moved(0.0, -0.002, t / 2 - 0.0008)
    grip = convex(
        [
            (x, y, z)
            for x, y in (
                (-n / 2, 0.04),
                (-n / 2, -0.012),
                (-n / 2 - 0.1, -0.06),
                (-n / 2 - 0.115, -0.02),
                (-n / 2 - 0.03, 0.06),
            )
            for z in (0.0, 0.024)
        ]
    )
    return Build(parts=((join(*bow), style.colour(1)), (blade, STEEL), (grip, style.colour())), mass=style.vary(0.55))


@entry(
    "spring",
    family="tools",
    synonyms=("coil spring", "metal spring", "steel spring"),
    material="steel",
    colours=("steel", "red", "gray"),
)
def spring(style: Style) -> Build:
    """A compression spring standing on its end: rings of wire to the eye, a tube to contact."""
    r, z, wire = style.vary(0.02), style.vary(0.06), 0.0032
    turn = np.linspace(0, 2 * np.pi, 33)[:-1]
    rounds = [
        unseen(tube(np.column_stack([r * np.cos(turn), r * np.sin(turn), np.full(32, h)]), wire / 2, 4, closed=True))
        for h in np.linspace(wire / 2, z - wire / 2, 8)
    ]
    links = [unseen(box(wire, wire, z - wire).moved(s * r, 0.0, wire / 2)) for s in (-1, 1)]
    reach, hole = (r + wire / 2) / math.cos(math.pi / 12), (r - wire / 2) * math.cos(math.pi / 12)
    turns = np.linspace(0, 2 * np.pi, 13)
    hulls = tuple(
        np.array([(q * math.cos(a), q * math.sin(a), h) for a in pair for q in (hole, reach) for h in (0.0, z)])
        for pair in zip(turns, turns[1:], strict=False)
    )
    return Build(parts=((Shape(join(*rounds, *links).solid, hulls), style.colour()),), mass=0.045)


@entry(
    "l bracket",
    family="tools",
    synonyms=("bracket", "angle bracket", "corner bracket", "l-bracket"),
    material="steel",
    colours=("steel", "gray", "black"),
)
def l_bracket(style: Style) -> Build:
    """A steel angle standing on one leg, two holes in each."""
    n, w, t = style.vary(0.06), style.vary(0.03), 0.003
    low, high = box(n, w, t), box(t, w, n).moved(-n / 2 + t / 2)
    holes = [cylinder(0.003, 0.1).moved(x, 0.0, -0.05) for x in (0.0, 0.36 * n)]
    bores = [cylinder(0.003, 0.1).turned("y", 90).moved(-n / 2 - 0.05, 0.0, z) for z in (0.5 * n, 0.86 * n)]
    cut_low = Shape(low.solid - together([Shape(hole.solid, ()) for hole in holes]).solid, low.hulls)
    cut_high = Shape(high.solid - together([Shape(hole.solid, ()) for hole in bores]).solid, high.hulls)
    return Build(parts=((join(cut_low, cut_high), style.colour()),), mass=0.075)


@entry(
    "beam",
    family="tools",
    synonyms=("aluminium profile", "aluminum profile", "aluminum extrusion", "wooden bar", "metal bar", "steel bar"),
    material="aluminium",
    colours=("silver", "steel"),
)
def beam(style: Style) -> Build:
    """A square bar lying down, a groove along each side."""
    n, w = style.vary(0.3), style.vary(0.03)
    grooves = together(
        [
            span((-1, 1), (-0.15 * w, 0.15 * w), (w - 0.002, 1)),
            span((-1, 1), (-1, -w / 2 + 0.002), (0.35 * w, 0.65 * w)),
            span((-1, 1), (w / 2 - 0.002, 1), (0.35 * w, 0.65 * w)),
        ]
    )
    return Build(
        parts=((box(n, w, w), style.colour()),),
        paint=((drawn(grooves), style.shade(style.colour(), 0.6)),),
        regions=(shelf_top(n / 2, w / 2, w),),
        mass=0.28,
    )


@entry("wall clock", family="room", synonyms=("round clock",), material="plastic", colours=("white", "red", "black"),
       accents=("black", "white"))  # fmt: skip
def wall_clock(style: Style) -> Build:
    """A round clock lying on its back, its face upwards."""
    r, z = style.vary(0.14), 0.035
    rim, face = cylinder(r, z), unseen(cylinder(0.9 * r, 1)).moved(z=z - 0.001)
    ink = BLACK
    marks = together(
        [
            Shape(box(0.1 * r, 0.02 * r, 1).solid, ()).moved(0.78 * r).turned("z", 30 * k).moved(z=z - 0.0012)
            for k in range(12)
        ]
    )
    hands = together(
        [
            Shape(box(0.03 * r, 0.6 * r, 1).solid, ()).moved(0.0, 0.27 * r, z - 0.0012),
            Shape(box(0.42 * r, 0.04 * r, 1).solid, ()).moved(0.18 * r, 0.0, z - 0.0012),
        ]
    )
    return Build(
        parts=((rim, style.colour()),),
        paint=(
            (face, (246, 244, 238)),
            (marks, ink),
            (hands, ink),
            (drawn(span((-1, 1), (-1, 1), (0.0, 0.006))), style.shade(style.colour(), 0.8)),
        ),
        mass=0.75,
    )


@entry("lantern", family="room", synonyms=("oil lamp", "camping lantern", "storm lantern", "hurricane lamp"),
       material="metal", colours=("black", "green", "red"), accents=("cream",))  # fmt: skip
def lantern(style: Style) -> Build:
    """A closed lantern: a base, a light in four posts, a roof with a ring."""
    k, main = style.vary(1.0), style.colour()
    base = frustum(0.07, 0.06, 0.03, 12)
    light = cylinder(0.042, 0.13, 12).moved(z=0.028)
    posts = [
        cylinder(0.005, 0.135, 8).moved(0.053 * math.cos(a), 0.053 * math.sin(a), 0.026)
        for a in (0.785, 2.356, 3.927, 5.498)
    ]
    roof = lathe([(0.066, 0.156), (0.066, 0.166), (0.03, 0.2), (0.016, 0.21)], angles=(0.0, 40.0))
    path = [(-0.02, 0, 0.205), (-0.035, 0, 0.24), (0.0, 0, 0.268), (0.035, 0, 0.24), (0.02, 0, 0.205)]
    loop = tube(curve(path, 29), 0.0035, 4, up=(0, 1, 0))
    shapes = ((join(base, *posts, roof, loop), main), (light, style.colour(1)))
    return Build(parts=tuple((shape.scaled(k), colour) for shape, colour in shapes), mass=0.8)
