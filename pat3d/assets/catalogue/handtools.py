"""More hand tools of workshop, building site and garden; long ones lie along x on flats."""

from __future__ import annotations

from pat3d.assets.catalogue.joinery import (
    STEEL,
    cavity,
    drawn,
    lying,
    padded,
    span,
)
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.rounded import lathe, slab
from pat3d.assets.shapes import box, convex, join, prism, tray

DARK_STEEL: RGB = (112, 116, 124)


@entry("utility knife", family="tools", synonyms=("box cutter", "craft knife", "stanley knife", "cutter knife",
       "cutter"), material="plastic", colours=("yellow", "red", "blue"), accents=("black",))  # fmt: skip
def utility_knife(style: Style) -> Build:
    """A cutter lying on its side, its blade out to the right."""
    n, t = style.vary(0.145), 0.016
    side = [(-n / 2, -0.012), (0.3 * n, -0.013), (n / 2, -0.004), (n / 2, 0.01), (0.2 * n, 0.014), (-n / 2, 0.01)]
    body = convex([(x, y, z) for x, y in side for z in (0.0, t)])
    blade = convex(
        [
            (n / 2 + x, y, t / 2 + z)
            for x, y in ((-0.01, -0.004), (0.022, -0.002), (0.006, 0.008), (-0.01, 0.008))
            for z in (-0.0006, 0.0006)
        ]
    )
    slot = span((-0.2 * n, 0.25 * n), (0.0, 0.005), (t - 0.001, 1))
    slider = box(0.02, 0.009, 0.006).moved(0.08 * n, 0.0025, t - 0.001)
    return Build(
        parts=((body, style.colour()), (blade, STEEL), (slider, style.colour(1))),
        paint=((drawn(slot), style.colour(1)),),
        mass=0.11,
    )


@entry("chisel", family="tools", synonyms=("wood chisel",), material="steel", colours=("wood", "red", "yellow"),
       accents=("steel",))  # fmt: skip
def chisel(style: Style) -> Build:
    """A chisel lying on a flat of its handle."""
    n, r = style.vary(0.24), 0.0135
    grip = lying(r, 0.46 * n, sides=8).moved(-0.27 * n)
    shaft = lying(0.0045, 0.2 * n, sides=6).moved(0.04 * n, 0.0, r - 0.0045)
    blade = convex(
        [
            (x, y, z)
            for x, lo, hi in (
                (0.1 * n, r - 0.005, r + 0.002),
                (0.42 * n, r - 0.005, r + 0.001),
                (0.5 * n, r - 0.005, r - 0.004),
            )
            for y in (-0.01, 0.01)
            for z in (lo, hi)
        ]
    )
    rings = [span((x * n, (x + 0.02) * n), (-1, 1), (-1, 1)) for x in (-0.5, -0.06)]
    return Build(
        parts=((grip, style.colour()), (join(shaft, blade), STEEL)), paint=((drawn(join(*rings)), STEEL),), mass=0.21
    )


@entry("mallet", family="tools", synonyms=("rubber mallet", "wooden mallet", "toy hammer"), material="wood",
       colours=("wood", "black", "red"), accents=("wood",))  # fmt: skip
def mallet(style: Style) -> Build:
    """A mallet standing on its head, its handle upwards."""
    x, n = style.vary(0.12), style.vary(0.28)
    head = padded(x, 0.07, 0.075, 0.008)
    handle = lathe([(0.011, 0.07), (0.012, 0.5 * n), (0.016, 0.9 * n), (0.012, 0.075 + n)], angles=(0.0,), sides=12)
    faces = [span((s * x / 2 - 0.014, s * x / 2 + 0.014), (-1, 1), (-1, 0.08)) for s in (-1, 1)]
    return Build(
        parts=((head, style.colour()), (handle, style.colour(1))),
        paint=((drawn(join(*faces)), style.shade(style.colour(), 0.75)),),
        mass=style.vary(0.55),
    )


@entry("axe", family="tools", synonyms=("hatchet", "ax"), plurals=("axes",), material="steel", colours=("red", "wood",
       "black"))  # fmt: skip
def axe(style: Style) -> Build:
    """A hatchet lying flat, its edge to the front."""
    n, t = style.vary(0.36), 0.026
    handle = slab(n, 0.032, t - 0.004, 0.014).moved(-0.02)
    at = n / 2 - 0.05
    eye = box(0.045, 0.06, t).moved(at, 0.01)
    edge = convex(
        [
            (at + x, y, z)
            for x, y, lo, hi in (
                (-0.022, -0.018, 0.0, t),
                (0.022, -0.018, 0.0, t),
                (-0.05, -0.095, 0.0, 0.006),
                (0.045, -0.095, 0.0, 0.006),
            )
            for z in (lo, hi)
        ]
    )
    bright = span((-1, 1), (-1, -0.08), (-1, 1))
    return Build(
        parts=((handle, style.colour()), (join(eye, edge), DARK_STEEL)),
        paint=((drawn(bright), STEEL),),
        mass=style.vary(0.75),
    )


@entry(
    "crowbar", family="tools", synonyms=("pry bar", "wrecking bar"), material="steel", colours=("red", "blue", "black")
)
def crowbar(style: Style) -> Build:
    """A flat pry bar lying down, its hook to the back."""
    n, t = style.vary(0.4), 0.018
    bar = slab(n, 0.022, t, 0.006)
    hook = [
        (n / 2 - 0.008, -0.011),
        (n / 2 + 0.028, 0.02),
        (n / 2 + 0.034, 0.055),
        (n / 2 + 0.015, 0.075),
        (n / 2 + 0.01, 0.05),
        (n / 2 - 0.008, 0.011),
    ]
    claw = prism(hook, t)
    tip = convex(
        [
            (-n / 2 - x, s * w, z)
            for x, w, h in ((-0.006, 0.011, t), (0.04, 0.016, 0.003))
            for s in (-1, 1)
            for z in (0.0, h)
        ]
    )
    bright = [span((-1, -n / 2 - 0.02), (-1, 1), (-1, 1)), span((-1, 1), (0.058, 1), (-1, 1))]
    return Build(
        parts=((join(bar, claw, tip), style.colour()),), paint=((drawn(join(*bright)), STEEL),), mass=style.vary(0.9)
    )


@entry("trowel", family="tools", synonyms=("garden trowel", "hand shovel", "hand trowel", "garden shovel",
       "small shovel"), material="steel", colours=("green", "red", "wood"), accents=("steel",))  # fmt: skip
def trowel(style: Style) -> Build:
    """A garden trowel lying on its blade and the end of its handle."""
    n, r = style.vary(0.13), 0.015
    grip = lying(r, n, sides=8).moved(-n / 2 - 0.06)
    neck = convex(
        [
            (x, y, z)
            for x, lo, hi in ((-0.062, 0.01, 0.02), (0.01, 0.001, 0.008))
            for y in (-0.006, 0.006)
            for z in (lo, hi)
        ]
    )
    plan = [(0.0, -0.02), (0.02, -0.042), (0.11, -0.036), (0.16, 0.0), (0.11, 0.036), (0.02, 0.042), (0.0, 0.02)]
    blade = convex([(x, y, z) for x, y in plan for z in (0.0, 0.003)])
    ridges = [
        convex(
            [
                (x, s * y, z)
                for x, y, h in ((0.01, 0.03, 0.012), (0.11, 0.03, 0.008))
                for y in (y, y + 0.006)
                for z in (0.0, h)
            ]
        )
        for s in (-1, 1)
    ]
    return Build(parts=((grip, style.colour()), (join(neck, blade, *ridges), style.colour(1))), mass=style.vary(0.25))


@entry("shovel", family="tools", synonyms=("spade", "snow shovel"), material="steel", colours=("black", "green",
       "red"), accents=("wood",))  # fmt: skip
def shovel(style: Style) -> Build:
    """A spade lying down, its blade to the right, its grip to the left."""
    n = style.vary(0.75)
    stick = lying(0.016, n, sides=8).moved(-n / 2 + 0.03)
    socket = convex(
        [(x, y, z) for x, w, h in ((-0.08, 0.02, 0.036), (0.06, 0.09, 0.012)) for y in (-w, w) for z in (0.0, h)]
    )
    plan = [(0.04, -0.1), (0.24, -0.1), (0.32, 0.0), (0.24, 0.1), (0.04, 0.1)]
    blade = convex([(x, y, z) for x, y in plan for z in (0.0, 0.005)])
    grip = lying(0.016, 0.13, sides=8).turned("z", 90).moved(-n + 0.04)
    return Build(
        parts=((stick, style.colour(1)), (join(socket, blade), style.colour()), (grip, style.colour())),
        mass=style.vary(1.8),
    )


@entry("putty knife", family="tools", synonyms=("scraper", "paint scraper", "filling knife"),
       plurals=("putty knives",), material="steel", colours=("red", "wood", "black"))  # fmt: skip
def putty_knife(style: Style) -> Build:
    """A broad scraper lying flat."""
    n = style.vary(0.105)
    grip = slab(n, 0.03, 0.018, 0.012).moved(-n / 2 + 0.01)
    blade = convex([(x, s * w, z) for x, w in ((-0.005, 0.014), (0.09, 0.04)) for s in (-1, 1) for z in (0.006, 0.008)])
    heel = convex([(x, s * 0.012, z) for x, h in ((0.0, 0.016), (0.03, 0.01)) for s in (-1, 1) for z in (0.0, h)])
    return Build(parts=((grip, style.colour()), (join(blade, heel), STEEL)), mass=0.1)


@entry("paint roller", family="tools", synonyms=("roller", "wall roller"), material="foam", colours=("yellow", "blue",
       "white"), accents=("black",))  # fmt: skip
def paint_roller(style: Style) -> Build:
    """A paint roller lying down, its handle to the front."""
    n, r = style.vary(0.2), 0.024
    sleeve = lying(r, n, sides=12)
    path = [(n / 2 - 0.004, 0, r), (n / 2 + 0.022, 0, r), (n / 2 + 0.022, -0.09, r), (0, -0.1, r), (0, -0.15, r)]
    wire = join(
        *(
            box(abs(x1 - x0) + 0.007, abs(y1 - y0) + 0.007, 0.007).moved((x0 + x1) / 2, (y0 + y1) / 2, r - 0.0035)
            for (x0, y0, _), (x1, y1, _) in zip(path, path[1:], strict=False)
            if (x0, y0) != (n / 2 + 0.022, -0.09)
        ),
        convex(
            [
                (x, y + w, z)
                for x, y in ((n / 2 + 0.022, -0.09), (0, -0.1))
                for w in (-0.0035, 0.0035)
                for z in (r - 0.0035, r + 0.0035)
            ]
        ),
    )
    grip = lying(r - 0.006, 0.12, sides=8).turned("z", 90).moved(0.0, -0.205)
    return Build(parts=((sleeve, style.colour()), (wire, STEEL), (grip, style.colour(1))), mass=0.26)


@entry("open toolbox", family="tools", material="metal", colours=("red", "blue", "gray"), accents=("black",),
       plurals=("open toolboxes",), synonyms=("tool tote", "tool tray", "tool caddy"))  # fmt: skip
def open_toolbox(style: Style) -> Build:
    """A tool tray without a lid: two compartments under a carrying bar."""
    x, y, z = style.vary(0.42), style.vary(0.24), style.vary(0.12)
    wall, floor, colour = 0.006, 0.006, style.colour()
    divider = box(x - 2 * wall + 0.001, 0.012, 0.12).moved(z=0.0)
    posts = [box(0.016, 0.012, 0.12).moved(s * (x / 2 - 0.011), 0.0, 0.1) for s in (-1, 1)]
    bar = padded(x - 0.006, 0.026, 0.024, 0.009).moved(z=0.205)
    half = (y / 2 - wall - 0.006) / 2
    return Build(
        parts=((join(tray(x, y, z, wall, floor), divider), colour), (join(*posts, bar), style.colour(1))),
        regions=tuple(
            cavity(x / 2 - wall - 0.001, half - 0.008, floor, z - floor, at=(0.0, s * (half + 0.014))) for s in (-1, 1)
        ),
        mass=style.vary(1.9),
    )
