"""Shelves, cabinets, carts, pallets, and containers that are closed."""

import math
from collections.abc import Sequence

import numpy as np

from pat3d.assets.catalogue.joinery import (
    BLACK,
    STEEL,
    cavity,
    fronted,
    grid,
    legs,
    lying,
    padded,
    shelf_top,
    span,
    stretch,
    together,
)
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.shapes import box, convex, cylinder, join, tray, turned_solid

WOODS = ("wood", "brown", "tan")


def _boards(half_x: float, half_y: float, tops: Sequence[float], thick: float, top: float):
    """Regions of shelf boards, the one nearest to a hand's height of 0.95 m first and the open top last."""
    enclosed = [
        shelf_top(half_x, half_y, low, height=high - thick - low, enclosed=True)
        for low, high in zip(tops, [*tops[1:], top], strict=True)
    ]
    return (*sorted(enclosed, key=lambda region: abs(region.floor[2] - 0.95)), shelf_top(half_x, half_y, top))


def _count(style: Style, usual: int) -> int:
    """How many boards a shelf has: as its adjectives say, or as is `usual`."""
    return next((count for count in range(2, 7) if f"{count}-tier" in style.adjectives), usual)


@entry("bookshelf", family="storage", material="wood", colours=WOODS, plurals=("bookshelves",),
       synonyms=("bookcase", "book shelf", "book case"))  # fmt: skip
def bookshelf(style: Style) -> Build:
    """A bookcase with a back and open compartments, four where nothing is said."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(0.85) * wide, style.vary(0.32) * deep, style.vary(1.7) * tall
    colour, thick = style.colour(), 0.025
    count = _count(style, max(2, round(z / 0.42)))
    sides = [box(thick, y, z).moved(s * (x - thick) / 2) for s in (-1, 1)]
    back = span((-x / 2, x / 2), (y / 2 - 0.015, y / 2), (0.0, z))
    step = (z - 0.08) / count
    tops = [0.08 + k * step for k in range(count)]
    boards = [box(x - thick, y - 0.01, thick).moved(y=0.005, z=top - thick) for top in [*tops, z]]
    plinth = span((-x / 2 + 0.01, x / 2 - 0.01), (-y / 2 + 0.02, -y / 2 + 0.04), (0.0, 0.07))
    return Build(
        parts=((join(*sides, *boards), colour), (join(back, plinth), style.shade(colour, 0.72))),
        regions=_boards(x / 2 - thick, y / 2 - 0.02, tops, thick, z),
        mass=style.vary(30.0) * z / 1.7,
    )


@entry("shelf", family="storage", material="metal", colours=("steel", "gray", "silver"),
       plurals=("shelves", "metal shelves", "storage shelves"),
       synonyms=("shelving unit", "shelving", "metal shelf", "rack", "storage rack", "storage shelf", "shelf unit",
                 "metal rack", "shelving rack", "spice rack", "shoe rack"))  # fmt: skip
def shelf(style: Style) -> Build:
    """A shelving unit: four posts and four boards."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(0.95) * wide, style.vary(0.42) * deep, style.vary(1.5) * tall
    colour, thick, post = style.colour(), 0.03, 0.035
    count = _count(style, 3 if z < 1.2 else 4)
    tops = [0.15 + k * (z - 0.15) / (count - 1) for k in range(count)]
    boards = [box(x - 0.004, y - 0.004, thick).moved(z=top - thick) for top in tops]
    slots = [
        box(0.006, 3 * y, 0.02).moved(s * (x / 2 - post / 2), 0.0, 0.06 + k * 0.06)
        for s in (-1, 1)
        for k in range(int((z - 0.1) / 0.06))
    ]
    return Build(
        parts=((legs(x, y, z, post), style.shade(colour, 0.7)), (join(*boards), colour)),
        paint=((together(slots), style.shade(colour, 0.35)),),
        regions=_boards(x / 2 - post, y / 2 - post, tops[:-1], thick, z),
        mass=style.vary(16.0),
    )


def _case(style: Style, x: float, y: float, z: float, *, columns: int, rows: int, mass: float, doors: bool) -> Build:
    """A closed cabinet on a plinth with a top board, `columns` by `rows` fronts and their handles."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(x) * wide, style.vary(y) * deep, style.vary(z) * tall
    colour, foot, top = style.colour(), 0.06, 0.02
    front = -y / 2 + 0.015
    panels = grid((-x / 2, x / 2), (foot, z - top), columns, rows, 0.012)
    body, fronts = fronted((-x / 2, x / 2), (front, y / 2), (foot, z - top), panels)
    plinth = box(x - 0.04, y - 0.06, foot + 0.002)
    board = box(x + 0.02, y, top).moved(z=z - top)
    handles = []
    for k, ((left, right), (low, high)) in enumerate(panels):
        if doors:
            inner = right - 0.035 if k % 2 == 0 else left + 0.035
            handles.append(
                box(0.016, 0.03, min(0.16, 0.3 * (high - low))).moved(inner, front - 0.008, (low + high) / 2)
            )
        else:
            handles.append(
                box(0.3 * (right - left), 0.03, 0.016).moved((left + right) / 2, front - 0.008, 0.3 * low + 0.7 * high)
            )
    return Build(
        parts=(
            (join(body, plinth), style.shade(colour, 0.7)),
            (join(board, fronts), colour),
            (join(*handles), style.colour(1)),
        ),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=style.vary(mass),
    )


@entry("cabinet", family="storage", material="wood", colours=WOODS, accents=("black",),
       synonyms=("cupboard", "sideboard", "credenza", "storage cabinet", "buffet cabinet",
                 "kitchen cabinet", "bathroom cabinet", "wall cabinet"))  # fmt: skip
def cabinet(style: Style) -> Build:
    """A low cabinet with two doors."""
    return _case(style, 0.85, 0.42, 0.85, columns=2, rows=1, mass=32.0, doors=True)


@entry("dresser", family="storage", material="wood", colours=WOODS, accents=("gold",),
       synonyms=("chest of drawers", "drawer unit", "bureau", "tallboy"))  # fmt: skip
def dresser(style: Style) -> Build:
    """A chest of six drawers."""
    return _case(style, 1.05, 0.45, 0.82, columns=2, rows=3, mass=45.0, doors=False)


@entry("filing cabinet", family="storage", material="steel", colours=("gray", "silver", "black"), accents=("silver",),
       synonyms=("file cabinet",))  # fmt: skip
def filing_cabinet(style: Style) -> Build:
    """A steel cabinet of three deep drawers."""
    return _case(style, 0.42, 0.55, 1.0, columns=1, rows=3, mass=28.0, doors=False)


@entry("wardrobe", family="storage", material="wood", colours=WOODS, accents=("black",), synonyms=("closet", "armoire"))
def wardrobe(style: Style) -> Build:
    """A tall wardrobe with two doors."""
    return _case(style, 1.0, 0.56, 1.9, columns=2, rows=1, mass=70.0, doors=True)


@entry("cart", family="storage", material="metal", colours=("gray", "steel", "teal", "white"),
       synonyms=("wheeled cart", "trolley", "utility cart", "rolling cart", "serving cart", "tool cart", "push cart",
                 "service trolley"))  # fmt: skip
def cart(style: Style) -> Build:
    """A two-deck cart on four wheels, its handle on the right."""
    wide, deep, _ = stretch(style)
    x, y, z = style.vary(0.95, 0.03) * wide, style.vary(0.5) * deep, style.vary(0.74, 0.04)
    colour, wheel = style.colour(), 0.06
    corners = [(a * (x / 2 - 0.09), b * (y / 2 - 0.07)) for a in (-1, 1) for b in (-1, 1)]
    decks = [box(x, y, 0.03).moved(z=height - 0.03) for height in (0.2, z)]
    left = [box(0.03, 0.03, z - 0.16).moved(-x / 2 + 0.04, s * (y / 2 - 0.04), 0.15) for s in (-1, 1)]
    right = [box(0.03, 0.03, z - 0.02).moved(x / 2 - 0.04, s * (y / 2 - 0.04), 0.15) for s in (-1, 1)]
    bar = box(0.035, y - 0.04, 0.035).moved(x / 2 - 0.04, 0.0, z + 0.12)
    wheels = [lying(wheel, 0.03).turned("z", 90).moved(*corner) for corner in corners]
    forks = [box(0.05, 0.02, 0.1).moved(*corner, 0.08) for corner in corners]
    hubs = [cylinder(0.02, 0.2).turned("x", 90).moved(a, b + 0.1, wheel) for a, b in corners]
    return Build(
        parts=(
            (join(*decks), colour),
            (join(*left, *right, bar, *forks), style.shade(colour, 0.6)),
            (join(*wheels), BLACK),
        ),
        paint=((together(hubs), STEEL),),
        regions=(
            shelf_top(x / 2 - 0.03, y / 2, z, at=(-0.03, 0.0)),
            shelf_top(x / 2 - 0.07, y / 2 - 0.06, 0.2, height=z - 0.23, enclosed=True),
        ),
        mass=style.vary(14.0),
    )


@entry(
    "suitcase",
    family="storage",
    material="plastic",
    colours=("navy", "burgundy", "teal", "gray"),
    synonyms=("luggage", "travel case", "trolley case", "carry-on"),
)
def suitcase(style: Style) -> Build:
    """An upright shell suitcase on wheels, its handle raised."""
    x, y, z = style.vary(0.42), style.vary(0.25), style.vary(0.62)
    colour = style.colour()
    wheels = [
        span((a - 0.02, a + 0.02), (b - 0.025, b + 0.025), (0.0, 0.05))
        for a in (-x / 2 + 0.05, x / 2 - 0.05)
        for b in (-y / 2 + 0.04, y / 2 - 0.04)
    ]
    shell = padded(x, y, z - 0.04, 0.035).moved(z=0.04)
    poles = [box(0.016, 0.016, 0.12).moved(s * 0.09, y / 2 - 0.05, z - 0.02) for s in (-1, 1)]
    grip = padded(0.24, 0.03, 0.03, 0.012).moved(y=y / 2 - 0.05, z=z + 0.09)
    ribs = [box(0.012, 1.0, z - 0.16).moved((k - 2) * x / 6, 0.0, 0.1) for k in range(5)]
    zipper = box(2.0, 0.01, 2.0)
    return Build(
        parts=((shell, colour), (join(*wheels, grip), BLACK), (join(*poles), STEEL)),
        paint=((together(ribs), style.shade(colour, 0.75)), (zipper, style.shade(colour, 0.4))),
        mass=style.vary(4.5),
    )


@entry("barrel", family="storage", material="wood", colours=("wood", "brown"), accents=("gray",),
       synonyms=("wooden barrel", "cask", "keg"))  # fmt: skip
def barrel(style: Style) -> Build:
    """A closed wooden barrel with iron hoops."""
    z, belly = style.vary(0.7), style.vary(0.28)
    profile = [(belly * (1 - 0.2 * (2 * t - 1) ** 2), t * z) for t in np.linspace(0.0, 1.0, 7)]
    hoops = [box(2.0, 2.0, 0.035).moved(z=t * z - 0.018) for t in (0.1, 0.32, 0.68, 0.9)]
    staves = [box(0.006, 2.0, 2 * z).turned("z", 180 * k / 10) for k in range(10)]
    return Build(
        parts=((turned_solid(profile), style.colour()),),
        paint=((together(staves), style.shade(style.colour(), 0.65)), (together(hoops), style.colour(1))),
        mass=style.vary(28.0),
    )


@entry("treasure chest", family="storage", material="wood", colours=("brown", "wood"), accents=("gold",),
       synonyms=("chest", "wooden chest", "pirate chest", "trunk", "storage trunk"))  # fmt: skip
def treasure_chest(style: Style) -> Build:
    """A closed chest with a vaulted lid, metal bands and a lock."""
    x, y, z = style.vary(0.5), style.vary(0.32), style.vary(0.22)
    colour, metal = style.colour(), style.colour(1)
    arch = [(-math.cos(a) * y / 2, z + math.sin(a) * 0.38 * y) for a in np.linspace(0.0, math.pi, 9)]
    lid = convex([(s * x / 2, across, up) for across, up in arch for s in (-1, 1)])
    bands = [box(0.035, 2.0, 2.0).moved(s * 0.34 * x) for s in (-1, 1)]
    edges = [box(2 * x, 2 * y, 0.012).moved(z=z - 0.006), box(2 * x, 2 * y, 0.03)]
    edges += [box(0.03, 0.03, 1.0).moved(a * x / 2, b * y / 2) for a in (-1, 1) for b in (-1, 1)]
    lock = box(0.06, 0.03, 0.08).moved(y=-y / 2 - 0.005, z=z - 0.05)
    return Build(
        parts=((join(box(x, y, z), lid), colour), (lock, metal)),
        paint=((together([*bands, *edges]), metal),),
        mass=style.vary(9.0),
    )


@entry("pallet", family="storage", material="wood", colours=("tan", "wood"), synonyms=("wooden pallet", "skid"))
def pallet(style: Style) -> Build:
    """A shipping pallet: boards on three bearers."""
    x, y, z = style.vary(1.1, 0.04), style.vary(0.8, 0.03), style.vary(0.13, 0.04)
    colour = style.colour()
    bearers = [box(x, 0.09, z - 0.035).moved(y=s * (y / 2 - 0.05), z=0.015) for s in (-1, 0, 1)]
    feet = [box(x, 0.1, 0.016).moved(y=s * (y / 2 - 0.05)) for s in (-1, 0, 1)]
    boards = [box(0.11, y, 0.022).moved((k - 3) * (x - 0.11) / 6, 0.0, z - 0.022) for k in range(7)]
    return Build(
        parts=((join(*boards), colour), (join(*bearers, *feet), style.shade(colour, 0.75))),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=style.vary(18.0),
    )


@entry("cardboard sheet", family="storage", material="cardboard", colours=("cardboard",),
       synonyms=("cardboard panel", "cardboard", "cardboard screen", "sheet of cardboard", "large cardboard sheet",
                 "poster board"))  # fmt: skip
def cardboard_sheet(style: Style) -> Build:
    """A large folded sheet that stands by itself: a Z seen from above."""
    x, z, wing = style.vary(0.6), style.vary(0.8) * stretch(style)[2], style.vary(0.26)
    colour, thick = style.colour(), 0.006
    panel = box(x, thick, z)
    wings = [box(thick, wing, z).moved(s * (x - thick) / 2, s * (wing - thick) / 2) for s in (-1, 1)]
    creases = [box(2.0, 2.0, 0.003).moved(z=t * z) for t in (0.33, 0.66)]
    return Build(
        parts=((panel, colour), (join(*wings), style.shade(colour, 0.94))),
        paint=((together(creases), style.shade(colour, 0.85)),),
        mass=style.vary(0.5),
    )


@entry("drawer organizer", family="storage", material="bamboo", colours=("bamboo", "white", "gray"),
       synonyms=("drawer organiser", "desk organizer", "desk organiser", "organizer", "organizer tray",
                 "cutlery tray", "utensil tray", "silverware tray"))  # fmt: skip
def drawer_organizer(style: Style) -> Build:
    """A flat tray with three compartments."""
    x, y, z = style.vary(0.34), style.vary(0.24), style.vary(0.055)
    colour, wall = style.colour(), 0.008
    across = box(wall, y - wall, z - 0.005).moved(-x / 6)
    along = span((-x / 6, x / 2 - wall / 2), (-wall / 2, wall / 2), (0.0, z - 0.005))
    half, middle = x / 6 - 0.75 * wall, -x / 3 + wall / 4
    return Build(
        parts=((join(tray(x, y, z, wall, 0.006), across, along), colour),),
        regions=(cavity(half, y / 2 - wall, 0.006, z - 0.006, at=(middle, 0.0)),),
        mass=style.vary(0.6),
    )
