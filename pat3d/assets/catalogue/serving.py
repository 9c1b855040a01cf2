"""What a table or a bar is laid with beside plates and glasses."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pat3d.assets.catalogue.common import STEEL, band, cavity, disc, height, length, rectangle
from pat3d.assets.catalogue.joinery import cavity as box_cavity
from pat3d.assets.catalogue.joinery import drawn, span
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.catalogue.tableware import ear
from pat3d.assets.rounded import curve, hollow, lathe, merged, slab, tube, unseen
from pat3d.assets.shapes import Shape, box, convex, cylinder, ellipsoid, frustum, join, soft_box, tray


@entry("wok", family="kitchen", synonyms=("wok pan", "stir fry pan"), material="iron", colours=("black", "gray"),
       accents=("wood",))  # fmt: skip
def wok(style: Style) -> Build:
    """A deep round pan on a small flat base, its long handle on its right."""
    r, h = style.vary(0.155), height(style, 0.09)
    inner = [(0.42 * r, 0.005), (0.78 * r, 0.45 * h), (r - 0.004, h)]
    body = hollow([(0.42 * r, 0), (0.8 * r, 0.42 * h), (r, h)], inner, levels=(0.45 * h,), segments=12)
    path = [(0.95 * r, 0, 0.92 * h), (r + 0.05, 0, h + 0.012), (r + 0.17, 0, h + 0.035)]
    handle = tube(curve(path, 13), np.linspace(0.009, 0.0115, 13), 2, up=(0, 1, 0), flatness=1.3)
    return Build(
        parts=((body, style.colour()), (handle, style.colour(1))), regions=(cavity(inner, 12, (0.45 * h,)),), mass=1.4
    )


@entry(
    "cleaver",
    family="kitchen",
    synonyms=("meat cleaver", "chopper"),
    material="steel",
    colours=("black", "brown", "wood"),
)
def cleaver(style: Style) -> Build:
    """A broad chopping knife lying flat, its edge to the front."""
    n = length(style, 0.17)
    blade = convex([(x, y, z) for x, y in ((0.0, -0.05), (n, -0.052), (n, 0.034), (0.0, 0.03)) for z in (0.0, 0.003)])
    hole = cylinder(0.006, 0.1).moved(n - 0.018, 0.018, -0.05)
    grip = slab(0.115, 0.026, 0.018, 0.01).moved(-0.054, 0.014)
    rivets = merged([unseen(cylinder(0.0035, 0.02)).moved(x, 0.014, 0.012) for x in (-0.02, -0.054, -0.088)])
    edge = span((-1, 1), (-1, -0.04), (-1, 1))
    return Build(
        parts=((Shape(blade.solid - hole.solid, blade.hulls), STEEL), (grip, style.colour())),
        paint=((rivets, STEEL), (drawn(edge), style.shade(STEEL, 1.15))),
        mass=0.32,
    )


@entry(
    "egg cup",
    family="tableware",
    synonyms=("eggcup", "egg holder"),
    material="porcelain",
    colours=("white", "yellow", "blue"),
)
def egg_cup(style: Style) -> Build:
    """A small cup on a foot that holds one egg."""
    r, stem = style.vary(0.026), 0.026
    inner = [(0.55 * r, 0.005), (r - 0.003, 0.032)]
    bowl = hollow([(0.55 * r, 0), (r, 0.032)], inner, segments=12)
    foot = join(cylinder(0.024, 0.004), frustum(0.02, 0.0085, stem).moved(z=0.003))
    region = cavity(inner, 12)
    return Build(
        parts=((join(bowl.moved(z=stem), foot), style.colour()),),
        regions=(replace(region, floor=(0.0, 0.0, stem + 0.005)),),
        mass=0.07,
    )


@entry("sugar bowl", family="tableware", synonyms=("sugar pot", "sugar basin"), material="porcelain", colours=("white",
       "blue", "cream"), accents=("gold",))  # fmt: skip
def sugar_bowl(style: Style) -> Build:
    """A round lidded bowl with two ears and a knob."""
    r = style.vary(0.048)
    body = lathe(curve([(0.6 * r, 0), (0.95 * r, 0.35 * r), (r, 0.8 * r), (0.82 * r, 1.3 * r)], 22))
    lid = lathe([(0.84 * r, 1.28 * r), (0.7 * r, 1.45 * r), (0.25 * r, 1.6 * r)], angles=(30.0, 50.0))
    knob = ellipsoid(0.0095).moved(z=1.7 * r)
    ears = join(*(ear(0.86 * r, 0.4 * r, 1.15 * r, 0.42 * r, 0.008, 3).turned("z", turn) for turn in (0, 180)))
    rim = unseen(box(1, 1, 0.05 * r)).moved(z=1.25 * r)
    main = style.colour()
    return Build(
        parts=((join(body, ears), main), (lid, main), (knob, main)), paint=((rim, style.colour(1)),), mass=0.34
    )


@entry("butter dish", family="tableware", synonyms=("covered dish", "cheese dish"), plurals=("butter dishes",),
       material="porcelain", colours=("white", "mint", "blue"))  # fmt: skip
def butter_dish(style: Style) -> Build:
    """A closed dish: a flat plate under a cover with a knob."""
    x, y = length(style, 0.18, 0.03), style.vary(0.11, 0.03)
    plate, cover = slab(x, y, 0.012, 0.02), soft_box(0.82 * x, 0.76 * y, 0.058, 0.012).moved(z=0.01)
    knob = lathe([(0.008, 0.066), (0.013, 0.078), (0.011, 0.086)], angles=(0.0,))
    line = band(0.011, 0.015)
    dark = style.shade(style.colour(), 0.8)
    return Build(parts=((join(plate, cover, knob), style.colour()),), paint=((line, dark),), mass=0.6)


@entry(
    "cake stand",
    family="tableware",
    synonyms=("cake plate stand", "pedestal plate", "serving stand"),
    material="porcelain",
    colours=("white", "mint", "pink"),
)
def cake_stand(style: Style) -> Build:
    """A flat round plate on a foot."""
    r, h = style.vary(0.15, 0.03), height(style, 0.11)
    foot = lathe([(0.09, 0), (0.085, 0.008), (0.03, 0.025), (0.022, 0.5 * h)], cuts=(0.03,), angles=(0.0, 40.0))
    neck = lathe([(0.022, 0.49 * h), (0.03, 0.8 * h), (0.075, h - 0.012)], angles=(-30.0, 0.0))
    plate = lathe([(0.97 * r, h - 0.013), (r, h - 0.007), (0.98 * r, h)], angles=(0.0,))
    edge = band(h - 0.006, h - 0.001)
    return Build(
        parts=((join(foot, neck, plate), style.colour()),),
        regions=(disc("on", h, 0.98 * r),),
        paint=((edge, style.shade(style.colour(), 0.82)),),
        mass=1.3,
    )


@entry(
    "cocktail shaker",
    family="kitchen",
    synonyms=("shaker bottle", "protein shaker"),
    material="steel",
    colours=("steel", "copper", "black"),
)
def cocktail_shaker(style: Style) -> Build:
    """A closed steel shaker with a cap."""
    r, h = style.vary(0.043), height(style, 0.16)
    body = lathe([(0.72 * r, 0), (0.74 * r, 0.004), (r, h)], angles=(-6.0,), sides=16)
    shoulder = lathe([(r, h - 0.001), (0.96 * r, h + 0.018), (0.5 * r, h + 0.045)], angles=(0.0, 40.0))
    cap = lathe([(0.5 * r, h + 0.044), (0.46 * r, h + 0.07), (0.3 * r, h + 0.077)], angles=(0.0, 60.0))
    seam = band(h - 0.002, h + 0.001)
    main = style.colour()
    return Build(parts=((join(body, shoulder, cap), main),), paint=((seam, style.shade(main, 0.7)),), mass=0.36)


@entry(
    "ice cream scoop",
    family="kitchen",
    synonyms=("ice-cream scoop", "ice cream spoon"),
    material="steel",
    colours=("red", "black", "mint"),
)
def ice_cream_scoop(style: Style) -> Build:
    """A scoop lying on its bowl and the end of its thick handle."""
    n = length(style, 0.12)
    bowl = hollow([(0.014, 0), (0.026, 0.022)], [(0.012, 0.003), (0.0235, 0.022)], segments=8)
    neck = convex(
        [
            (x, y, z)
            for x, lo, hi in ((0.021, 0.011, 0.02), (0.06, 0.013, 0.022))
            for y in (-0.005, 0.005)
            for z in (lo, hi)
        ]
    )
    grip = convex(
        [
            (x, y, z)
            for x, lo, hi in ((0.05, 0.009, 0.025), (0.05 + n, 0.0, 0.022))
            for y in (-0.012, 0.012)
            for z in (lo, hi)
        ]
    )
    return Build(parts=((join(bowl, neck), STEEL), (grip, style.colour())), mass=0.15)


@entry(
    "wine rack",
    family="kitchen",
    synonyms=("bottle rack", "wine holder"),
    material="wood",
    colours=("wood", "black", "brown"),
)
def wine_rack(style: Style) -> Build:
    """A low rack of two ends and two pairs of rails; bottles lie across its top."""
    x, y, z = length(style, 0.4, 0.03), style.vary(0.22, 0.03), style.vary(0.13, 0.03)
    ends = [box(0.018, y, z - 0.012).moved(s * (x / 2 - 0.009)) for s in (-1, 1)]
    rails = [box(x, 0.022, 0.022).moved(0.0, s * (y / 2 - 0.025), z - 0.022) for s in (-1, 1)]
    rails += [box(x - 0.01, 0.018, 0.018).moved(0.0, s * (y / 2 - 0.025), 0.25 * z) for s in (-1, 1)]
    deck = box(x - 0.02, y - 0.02, 0.008).moved(z=z - 0.01)
    slats = merged([unseen(box(0.012, y - 0.1, 1)).moved(at) for at in np.linspace(-0.42, 0.42, 8) * x])
    top = Shape(deck.solid - slats.solid, deck.hulls)
    return Build(
        parts=((join(*ends, *rails), style.colour()), (top, style.shade(style.colour(), 0.85))),
        regions=(rectangle("on", z - 0.002, x - 0.06, y - 0.075),),
        mass=0.9,
    )


@entry("cookie tin", family="kitchen", synonyms=("biscuit tin", "cake tin", "round tin"), material="steel",
       colours=("blue", "red", "green"), accents=("white",))  # fmt: skip
def round_tin(style: Style) -> Build:
    """A closed round tin with a lid and a ring of decoration."""
    r, h = style.vary(0.095), height(style, 0.08)
    body, lid = (
        cylinder(r, h),
        lathe([(r + 0.003, 0.68 * h), (r + 0.003, h + 0.002), (r - 0.002, h + 0.005)], angles=(0.0,)),
    )
    ring = Shape(cylinder(0.8 * r, 1).solid - cylinder(0.7 * r, 3).moved(z=-1).solid, ()).moved(z=h + 0.003)
    star = unseen(cylinder(0.32 * r, 1)).moved(z=h + 0.003)
    return Build(
        parts=((body, style.colour()), (lid, style.colour())),
        paint=((band(0.25 * h, 0.4 * h), style.colour(1)), (ring, style.colour(1)), (star, style.colour(1))),
        regions=(disc("on", h + 0.005, r),),
        mass=0.55,
    )


@entry(
    "bar caddy",
    family="kitchen",
    synonyms=("desk caddy", "bottle carrier", "shower caddy", "book caddy"),
    material="steel",
    colours=("black", "steel", "wood"),
)
def bar_caddy(style: Style) -> Build:
    """An open carrier of two compartments with an upright handle between them."""
    x, y, z, wall, floor = length(style, 0.26, 0.03), style.vary(0.17, 0.03), style.vary(0.11, 0.03), 0.006, 0.006
    divider = box(0.012, y - 0.01, z - 0.002)
    posts = [box(0.012, 0.012, 0.13).moved(0.0, s * (0.5 * y - 0.03), z - 0.01) for s in (-1, 1)]
    bar = box(0.018, y - 0.045, 0.018).moved(z=z + 0.11)
    half = (x / 2 - wall - 0.006) / 2
    return Build(
        parts=(
            (join(tray(x, y, z, wall, floor), divider), style.colour()),
            (join(*posts, bar), style.shade(style.colour(), 0.7)),
        ),
        regions=tuple(
            box_cavity(half - 0.007, y / 2 - wall - 0.001, floor, z - floor, at=(s * (half + 0.0125), 0.0))
            for s in (-1, 1)
        ),
        mass=0.8,
    )


@entry(
    "kitchen thermometer",
    family="kitchen",
    synonyms=("thermometer", "meat thermometer", "food thermometer"),
    material="steel",
    colours=("red", "black", "white"),
)
def kitchen_thermometer(style: Style) -> Build:
    """A probe thermometer lying flat: a head with a display and a long needle."""
    n = length(style, 0.12)
    head = slab(0.1, 0.03, 0.017, 0.012).moved(-0.05)
    needle = box(n, 0.004, 0.004).moved(n / 2 - 0.002)
    screen = unseen(box(0.034, 0.018, 0.02)).moved(-0.04, z=0.015)
    digits = unseen(box(0.02, 0.009, 0.02)).moved(-0.04, z=0.0152)
    return Build(
        parts=((head, style.colour()), (needle, STEEL)),
        paint=((screen, (160, 176, 156)), (digits, (40, 44, 48))),
        mass=0.05,
    )
