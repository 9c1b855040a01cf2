"""Kitchen and laundry fixtures that stand on the floor: counters, sinks, stoves, machines."""

from __future__ import annotations

from pat3d.assets.catalogue.joinery import (
    BLACK,
    GRAY,
    STEEL,
    cavity,
    dial,
    drawn,
    fronted,
    grid,
    legs,
    shelf_top,
    span,
    stretch,
    strut,
    together,
)
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.rounded import curve, extruded, tube
from pat3d.assets.shapes import Shape, box, cylinder, join

GLASS_BLACK: RGB = (30, 32, 36)
GRANITE: RGB = (96, 96, 100)
WARM = (255, 176, 96)


def _bar(x: float, y: float, z: float, length: float) -> Shape:
    """A level handle [m] on a front at `y`."""
    posts = [box(0.014, 0.03, 0.014).moved(x + s * 0.42 * length, y - 0.012, z) for s in (-1, 1)]
    return join(box(length, 0.016, 0.014).moved(x, y - 0.03, z), *posts)


def _units(style: Style, x: float, y: float, z: float, columns: int) -> tuple[tuple[Shape, RGB], ...]:
    """Base cabinets [m] without a worktop: a drawer above a door in every column, on a plinth."""
    colour, plinth, front = style.colour(), 0.09, -y / 2 + 0.02
    doors = grid((-x / 2, x / 2), (plinth, z - 0.17), columns, 1, 0.008)
    drawers = grid((-x / 2, x / 2), (z - 0.175, z), columns, 1, 0.008)
    body, fronts = fronted((-x / 2, x / 2), (front, y / 2), (plinth, z), [*doors, *drawers])
    foot = span((-x / 2 + 0.01, x / 2 - 0.01), (front + 0.05, y / 2), (0.0, plinth + 0.002))
    handles = [_bar(sum(across) / 2, front, sum(up) / 2, 0.14) for across, up in drawers]
    handles += [_bar(sum(across) / 2, front, up[1] - 0.05, 0.14) for across, up in doors]
    return (
        (body, style.shade(colour, 0.72)),
        (foot, style.shade(colour, 0.5)),
        (fronts, colour),
        (join(*handles), style.colour(1)),
    )


@entry("counter", family="appliances", material="wood", colours=("white", "gray", "navy", "wood"), accents=("steel",
       "gray"), synonyms=("kitchen counter", "countertop", "counter top", "kitchen countertop", "worktop",
       "kitchen worktop", "work surface", "kitchen unit", "base cabinet"))  # fmt: skip
def counter(style: Style) -> Build:
    """Kitchen base cabinets under a stone worktop."""
    wide, deep, _ = stretch(style)
    x, y, z = style.vary(1.5, 0.04) * wide, style.vary(0.62, 0.02) * deep, style.vary(0.91, 0.01)
    top = box(x + 0.02, y + 0.02, 0.035).moved(z=z - 0.035)
    return Build(
        parts=(*_units(style, x, y - 0.02, z - 0.035, max(2, round(x / 0.55))), (top, GRANITE)),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=style.vary(95.0),
    )


@entry("kitchen island", family="appliances", material="wood", colours=("white", "teal", "gray"), accents=("steel",
       "wood"), synonyms=("island", "island counter", "kitchen block"))  # fmt: skip
def kitchen_island(style: Style) -> Build:
    """Base cabinets under a wide wooden top that overhangs them on all sides."""
    x, y, z = style.vary(1.5, 0.04) * stretch(style)[0], style.vary(0.9, 0.03), style.vary(0.92, 0.01)
    top = box(x + 0.12, y + 0.12, 0.04).moved(z=z - 0.04)
    return Build(
        parts=(*_units(style, x, y, z - 0.04, 3), (top, style.colour(2))),
        regions=(shelf_top(x / 2 + 0.05, y / 2 + 0.05, z),),
        mass=style.vary(120.0),
    )


@entry("sink", family="appliances", material="wood", colours=("white", "gray", "navy"), accents=("steel", "steel"),
       synonyms=("kitchen sink", "wash basin", "washbasin", "basin", "sink cabinet", "sink unit"))  # fmt: skip
def sink(style: Style) -> Build:
    """A base cabinet with a steel sink: an open basin on the left, a drainer on the right, a tap behind."""
    x, y, z = style.vary(1.0, 0.03), style.vary(0.62, 0.02), style.vary(0.91, 0.01)
    deep, rim = 0.17, 0.012
    left, right = (-x / 2 + 0.05, -x / 2 + 0.05 + 0.5), (-x / 2 + 0.55, x / 2)
    front, back = (-y / 2, -y / 2 + 0.05), (y / 2 - 0.13, y / 2)
    hole = ((front[1]), back[0])
    low = z - deep - 0.03
    slabs = [
        span((-x / 2, x / 2), front, (low, z)),
        span((-x / 2, x / 2), back, (low, z)),
        span((-x / 2, left[0]), hole, (low, z)),
        span(right, hole, (low, z)),
        span(left, hole, (low, z - deep)),
    ]
    body = join(*slabs)
    parts = _units(style, x, y, low + 0.001, 2)
    lip = Shape(join(*slabs[:4]).solid ^ box(2, 2, rim).moved(z=z - rim).solid, ())
    inner = span((left[0] - 0.001, left[1] + 0.001), (hole[0] - 0.001, hole[1] + 0.001), (z - deep - 0.001, z))
    drain = cylinder(0.035, 0.01).moved((left[0] + left[1]) / 2, 0.0, z - deep - 0.005)
    grooves = [
        box(0.3 * x, 0.006, 0.004).moved(x / 2 - 0.2 * x, hole[0] + 0.05 + 0.055 * k, z - 0.002) for k in range(7)
    ]
    middle = (left[0] + left[1]) / 2
    path = [
        (middle, back[0] + 0.08, z),
        (middle, back[0] + 0.08, z + 0.2),
        (middle, back[0] + 0.01, z + 0.29),
        (middle, back[0] - 0.08, z + 0.27),
        (middle, back[0] - 0.1, z + 0.2),
    ]
    tap = tube(curve(path, 33), 0.012, 6, up=(1, 0, 0))
    base = cylinder(0.026, 0.03).moved(middle, back[0] + 0.08, z - 0.002)
    lever = box(0.07, 0.014, 0.014).moved(middle + 0.045, back[0] + 0.08, z + 0.04)
    steel = style.colour(2)
    return Build(
        parts=(*parts, (body, style.colour()), (join(tap, base, lever), style.shade(steel, 1.1))),
        paint=(
            (lip, steel),
            (drawn(inner), style.shade(steel, 0.92)),
            (drawn(drain), style.shade(steel, 0.45)),
            (drawn(together(grooves)), style.shade(steel, 0.8)),
        ),
        regions=(
            cavity(0.25, (hole[1] - hole[0]) / 2, z - deep, deep, at=(middle, sum(hole) / 2)),
            shelf_top((right[1] - right[0]) / 2, (back[0] + y / 2) / 2, z, at=(sum(right) / 2, (back[0] - y / 2) / 2)),
        ),
        mass=style.vary(38.0),
    )


def _rings(places: list[tuple[float, float, float]], z: float) -> Shape:
    """Painted heating zones, each two rings of (x, y, radius) [m], on a top at height `z`."""
    rings = []
    for x, y, radius in places:
        for outer in (radius, 0.55 * radius):
            ring = cylinder(outer, 0.02).solid - cylinder(outer - 0.006, 0.06).moved(z=-0.02).solid
            rings.append(Shape(ring, ()).moved(x, y, z - 0.01))
    return together(rings)


def _knobs(across: list[float], y: float, z: float, radius: float = 0.018) -> Shape:
    return join(*(dial(radius, 0.025, 8).moved(x, y + 0.002, z) for x in across))


@entry("stove", family="appliances", material="steel", colours=("steel", "white", "black"), accents=("black",),
       synonyms=("oven", "cooker", "kitchen stove", "cooking range", "electric stove", "gas stove", "stove top",
       "stovetop"))  # fmt: skip
def stove(style: Style) -> Build:
    """A free-standing cooker: a glass hob with four zones over an oven."""
    x, y, z = style.vary(0.6, 0.02), style.vary(0.6, 0.02), style.vary(0.9, 0.01)
    colour, front = style.colour(), -y / 2 + 0.03
    body = span((-x / 2, x / 2), (front, y / 2), (0.0, z - 0.012))
    hob = span((-x / 2, x / 2), (-y / 2, y / 2), (z - 0.012, z))
    door = span((-x / 2 + 0.01, x / 2 - 0.01), (-y / 2 + 0.004, front + 0.001), (0.22, z - 0.16))
    drawer = span((-x / 2 + 0.01, x / 2 - 0.01), (-y / 2 + 0.012, front + 0.001), (0.04, 0.2))
    window = span((-0.34 * x, 0.34 * x), (-y, front), (0.32, z - 0.3))
    glow = span((-0.28 * x, 0.28 * x), (-y, front), (0.345, 0.36))
    panel = span((-x / 2 + 0.01, x / 2 - 0.01), (-y, front + 0.001), (z - 0.14, z - 0.02))
    zones = [
        (a * 0.24 * x, b * 0.22 * y, r) for a, b, r in ((-1, -1, 0.105), (1, -1, 0.08), (-1, 1, 0.08), (1, 1, 0.105))
    ]
    knobs = _knobs([(k - 2) * 0.16 * x for k in range(5)], front, z - 0.075)
    handle = _bar(0.0, -y / 2 + 0.004, z - 0.22, 0.8 * x)
    return Build(
        parts=(
            (body, colour),
            (hob, GLASS_BLACK),
            (join(door, drawer), colour),
            (knobs, style.colour(1)),
            (handle, STEEL),
        ),
        paint=(
            (drawn(panel), style.shade(colour, 0.8)),
            (drawn(window), GLASS_BLACK),
            (drawn(glow), WARM),
            (_rings(zones, z), GRAY),
        ),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=style.vary(48.0),
    )


@entry("fridge", family="appliances", material="steel", colours=("white", "steel", "mint", "red"), accents=("steel",),
       synonyms=("refrigerator", "freezer", "fridge freezer", "icebox"))  # fmt: skip
def fridge(style: Style) -> Build:
    """A closed fridge with a freezer drawer below; it carries things on its top."""
    x, y, z = style.vary(0.6, 0.03), style.vary(0.64, 0.02), style.vary(1.55, 0.05) * stretch(style)[2]
    colour, front = style.colour(), -y / 2 + 0.06
    body = span((-x / 2, x / 2), (front, y / 2), (0.0, z))
    doors = [span((-x / 2, x / 2), (-y / 2, front - 0.008), up) for up in ((0.05, 0.36 * z), (0.36 * z + 0.01, z))]
    core = span((-x / 2 + 0.015, x / 2 - 0.015), (front - 0.01, front), (0.06, z - 0.01))
    handles = [
        span((-x / 2 + 0.04, -x / 2 + 0.065), (-y / 2 - 0.035, -y / 2 + 0.001), up)
        for up in ((0.2 * z, 0.34 * z), (0.4 * z, 0.62 * z))
    ]
    return Build(
        parts=(
            (body, style.shade(colour, 0.88)),
            (core, GRAY),
            (join(*doors), colour),
            (join(*handles), style.colour(1)),
        ),
        regions=(shelf_top(x / 2, (y / 2 - front) / 2, z, at=(0.0, (y / 2 + front) / 2)),),
        mass=style.vary(62.0),
    )


def _front_loader(style: Style, name: RGB) -> Build:
    """A cabinet with a round glass door, a drawer and a dial: washing machine and dryer."""
    x, y, z = style.vary(0.6, 0.01), style.vary(0.6, 0.03), style.vary(0.85, 0.01)
    colour, front = style.colour(), -y / 2 + 0.03
    body = span((-x / 2, x / 2), (front, y / 2), (0.012, z))
    feet = legs(x - 0.06, y - 0.12, 0.014, 0.05)
    ring = dial(0.19, 0.031, 16).moved(0.0, front + 0.001, 0.42)
    glass = Shape(dial(0.13, 1.0).solid, ()).moved(0.0, front + 0.1, 0.42)
    rim = Shape(dial(0.165, 1.0).solid, ()).moved(0.0, front + 0.1, 0.42)
    panel = span((-x, x), (-y, front + 0.001), (z - 0.13, z - 0.125))
    drawer = span((-x / 2 + 0.02, -x / 2 + 0.19), (-y, front + 0.001), (z - 0.11, z - 0.02))
    screen = span((0.08 * x, 0.28 * x), (-y, front + 0.001), (z - 0.095, z - 0.04))
    knob = _knobs([0.36 * x], front, z - 0.068, 0.028)
    return Build(
        parts=((body, colour), (feet, BLACK), (ring, style.shade(colour, 0.9)), (knob, style.colour(1))),
        paint=(
            (drawn(panel), style.shade(colour, 0.7)),
            (drawn(drawer), style.shade(colour, 0.84)),
            (drawn(screen), GLASS_BLACK),
            (rim, style.colour(1)),
            (glass, name),
        ),
        regions=(shelf_top(x / 2, (y / 2 - front) / 2, z, at=(0.0, (y / 2 + front) / 2)),),
        mass=style.vary(65.0),
    )


@entry("washing machine", family="appliances", material="steel", colours=("white", "gray"), accents=("steel",),
       synonyms=("washer", "laundry machine", "front loader", "clothes washer"))  # fmt: skip
def washing_machine(style: Style) -> Build:
    """A front-loading washing machine."""
    return _front_loader(style, (70, 92, 112))


@entry("dryer", family="appliances", material="steel", colours=("white", "gray"), accents=("black",),
       synonyms=("tumble dryer", "clothes dryer", "tumble drier"))  # fmt: skip
def dryer(style: Style) -> Build:
    """A tumble dryer, the washing machine's twin with a dark door."""
    return _front_loader(style, (44, 44, 48))


@entry("dishwasher", family="appliances", material="steel", colours=("steel", "white", "black"), accents=("black",),
       plurals=("dishwashers", "dish washers"), synonyms=("dish washer",))  # fmt: skip
def dishwasher(style: Style) -> Build:
    """A closed dishwasher under its own top."""
    x, y, z = style.vary(0.6, 0.01), style.vary(0.6, 0.02), style.vary(0.85, 0.01)
    colour, front = style.colour(), -y / 2 + 0.03
    body = span((-x / 2, x / 2), (front, y / 2), (0.08, z))
    foot = span((-x / 2 + 0.02, x / 2 - 0.02), (front + 0.04, y / 2), (0.0, 0.081))
    door = span((-x / 2 + 0.005, x / 2 - 0.005), (-y / 2, front + 0.001), (0.1, z - 0.03))
    panel = span((-x, x), (-y, front - 0.001), (z - 0.13, z - 0.03))
    light = span((0.3 * x, 0.34 * x), (-y, front - 0.001), (z - 0.086, z - 0.08))
    display = span((-0.1 * x, 0.1 * x), (-y, front - 0.001), (z - 0.1, z - 0.065))
    return Build(
        parts=(
            (body, style.shade(colour, 0.88)),
            (foot, BLACK),
            (door, colour),
            (_bar(0.0, -y / 2, z - 0.17, 0.75 * x), STEEL),
        ),
        paint=(
            (drawn(panel), style.shade(colour, 0.75)),
            (drawn(display), GLASS_BLACK),
            (drawn(light), (120, 220, 140)),
        ),
        regions=(shelf_top(x / 2, (y / 2 - front) / 2, z, at=(0.0, (y / 2 + front) / 2)),),
        mass=style.vary(42.0),
    )


@entry("tv stand", family="appliances", material="wood", colours=("wood", "brown", "white"), accents=("black",),
       synonyms=("tv cabinet", "media console", "tv unit", "tv table", "television stand", "media cabinet",
       "entertainment center", "tv bench", "lowboard"))  # fmt: skip
def tv_stand(style: Style) -> Build:
    """A long low cabinet: two doors and an open bay between them."""
    x, y, z = style.vary(1.4, 0.04) * stretch(style)[0], style.vary(0.4, 0.03), style.vary(0.5, 0.03)
    colour, foot, thick = style.colour(), 0.1, 0.025
    bay, front = 0.22 * x, -y / 2 + 0.015
    parts: list[tuple[Shape, RGB]] = []
    for side in (-1, 1):
        across = (bay, x / 2) if side > 0 else (-x / 2, -bay)
        body, door = fronted(
            across,
            (front, y / 2),
            (foot, z - thick),
            [((across[0] + 0.01, across[1] - 0.01), (foot + 0.01, z - thick - 0.01))],
        )
        knob = box(0.014, 0.03, 0.1).moved(side * (bay + 0.05), front - 0.01, (foot + z) / 2 - 0.04)
        parts += [(body, style.shade(colour, 0.7)), (door, colour), (knob, style.colour(1))]
    top = box(x + 0.02, y, thick).moved(z=z - thick)
    floor = span((-bay - 0.001, bay + 0.001), (front, y / 2), (foot, foot + 0.02))
    back = span((-bay - 0.001, bay + 0.001), (y / 2 - 0.012, y / 2), (foot, z - thick))
    room = z - thick - foot - 0.02
    return Build(
        parts=(
            (join(top, floor), colour),
            (join(back, legs(x - 0.12, y - 0.06, foot + 0.001, 0.04)), style.shade(colour, 0.6)),
            *parts,
        ),
        regions=(
            shelf_top(x / 2, y / 2, z),
            shelf_top(bay - 0.01, y / 2 - 0.03, foot + 0.02, at=(0.0, -0.006), height=room, enclosed=True),
        ),
        mass=style.vary(30.0),
    )


@entry("ironing board", family="appliances", material="metal", colours=("teal", "blue", "gray"), accents=("steel",),
       synonyms=("iron board",))  # fmt: skip
def ironing_board(style: Style) -> Build:
    """A padded board, pointed on its left, on two crossed pairs of legs."""
    x, y, z = style.vary(1.2, 0.03), style.vary(0.36, 0.03), style.vary(0.85, 0.03)

    nose = [
        (-x / 2, -0.05),
        (-x / 2 + 0.05, -0.1),
        (-0.2 * x, -y / 2),
        (x / 2, -y / 2),
        (x / 2, y / 2),
        (-0.2 * x, y / 2),
        (-x / 2 + 0.05, 0.1),
        (-x / 2, 0.05),
    ]
    board = extruded([(a, b) for a, b in nose], 0.04, sides=16).moved(z=z - 0.04)
    reach = 0.36 * x

    bars = [
        strut((s * reach, t * 0.13), (-s * reach * 0.8, t * (0.1 if s > 0 else 0.06)), (0.0, z - 0.04), 0.012)
        for s in (-1, 1)
        for t in (-1, 1)
    ]
    feet = [box(0.04, y, 0.025).moved(s * reach) for s in (-1, 1)]
    return Build(
        parts=((board, style.colour()), (join(*bars, *feet), style.colour(1))),
        regions=(shelf_top(0.3 * x, y / 2 - 0.02, z, at=(0.18 * x, 0.0)),),
        mass=style.vary(5.5),
    )


@entry("conveyor belt", family="appliances", material="metal", colours=("gray", "blue", "green"), accents=("black",),
       synonyms=("conveyor", "conveyer belt", "belt conveyor"))  # fmt: skip
def conveyor_belt(style: Style) -> Build:
    """A level belt between two rails on four legs, its rollers at both ends; it stands still."""
    x, y, z = style.vary(1.4, 0.04) * stretch(style)[0], style.vary(0.45, 0.03), style.vary(0.75, 0.03)
    belt = box(x, y - 0.08, 0.05).moved(z=z - 0.05)
    rails = [box(x, 0.03, 0.09).moved(0.0, s * (y / 2 - 0.015), z - 0.1) for s in (-1, 1)]
    rollers = [
        cylinder(0.03, y - 0.09, 12).turned("x", 90).moved(s * x / 2, (y - 0.09) / 2, z - 0.032) for s in (-1, 1)
    ]
    struts = [box(0.03, y - 0.04, 0.03).moved(s * (x / 2 - 0.12), 0.0, 0.18) for s in (-1, 1)]
    stand = legs(x - 0.2, y - 0.005, z - 0.06, 0.04)
    seams = [span((at, at + 0.004), (-0.45 * y, 0.45 * y), (z - 0.002, z + 0.001)) for at in (-0.3 * x, 0.0, 0.3 * x)]
    return Build(
        parts=(
            (join(*rails), style.colour()),
            (join(stand, *struts), style.shade(style.colour(), 0.75)),
            (belt, style.colour(1)),
            (join(*rollers), STEEL),
        ),
        paint=((drawn(together(seams)), GRAY),),
        regions=(shelf_top(x / 2 - 0.02, y / 2 - 0.045, z),),
        mass=style.vary(38.0),
    )
