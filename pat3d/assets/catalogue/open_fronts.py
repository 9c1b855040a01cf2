"""Furniture and appliances as they are while something is in them: their doors open, their compartments free.

Closed ones are made in pat3d.assets.catalogue.storage, appliances and countertop, in the same sizes. Doors stand still:
they are parts of what they belong to.
"""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.assets.catalogue.joinery import BLACK, STEEL, WHITE, Range, drawn, legs, shelf_top, span, stretch
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import Shape, box, join
from pat3d.scene.asset import Region

_AJAR = 100.0
"""Angle by which doors are open [degrees]."""
_LEAF = 0.02
"""Thickness of doors [m]."""


def hollow(x: Range, y: Range, z: Range, wall: float, floors: Sequence[float] = (), board: float = 0.015):
    """A carcass [m] that is open in front, with boards whose tops are at `floors`; and its compartments, best first.

    The best is the one nearest to a hand's height of 0.95 m.
    """
    inner = (x[0] + wall, x[1] - wall)
    sides = [span(side, y, z) for side in ((x[0], x[0] + wall), (x[1] - wall, x[1]))]
    rear = span(inner, (y[1] - wall, y[1]), z)
    ends = [span(inner, (y[0], y[1] - wall), up) for up in ((z[0], z[0] + wall), (z[1] - wall, z[1]))]
    boards = [span(inner, (y[0] + 0.02, y[1] - wall), (top - board, top)) for top in floors]
    lows = [z[0] + wall, *floors]
    highs = [*(top - board for top in floors), z[1] - wall]
    middle, deep = (y[0] + 0.02 + y[1] - wall) / 2, (y[1] - wall - y[0] - 0.02) / 2
    rooms = [
        Region(kind="in", shape="rectangle", floor=((x[0] + x[1]) / 2, middle, low),
               half_size=((x[1] - x[0]) / 2 - wall - 0.01, deep - 0.01), height=high - low, enclosed=True)
        for low, high in zip(lows, highs, strict=True)
    ]  # fmt: skip
    ranked = sorted(rooms, key=lambda room: abs(room.floor[2] - 0.95))
    return join(*sides, rear, *ends), boards, tuple(ranked)


def _door(width: float, up: Range, hinge: tuple[float, float], side: int) -> Shape:
    """A leaf of a door [m] that is open, at `hinge` (x, y): at the left (-1) or at the right (1) end of its front."""
    leaf = span((0.0, width) if side < 0 else (-width, 0.0), (-_LEAF, 0.0), up)
    return leaf.turned("z", side * _AJAR).moved(*hinge)


def _case(style: Style, x: float, y: float, z: float, boards: int, mass: float) -> Build:
    """A wooden cabinet on a plinth with two open doors and as many boards inside."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(x) * wide, style.vary(y) * deep, style.vary(z) * tall
    colour, foot, top, wall = style.colour(), 0.06, 0.02, 0.02
    front = -y / 2 + 0.015
    low, high = foot, z - top
    floors = [low + wall + k * (high - low - 2 * wall) / (boards + 1) for k in range(1, boards + 1)]
    body, shelves, rooms = hollow((-x / 2, x / 2), (front, y / 2), (low, high + 0.001), wall, floors)
    plinth = box(x - 0.04, y - 0.06, foot + 0.002)
    cover = box(x + 0.02, y, top).moved(z=high)
    doors = [
        _door(x / 2 - 0.004, (low + 0.005, high - 0.005), (s * (x / 2 - 0.001), front + 0.001), s) for s in (-1, 1)
    ]
    return Build(
        parts=((join(body, plinth, *shelves), style.shade(colour, 0.8)), (join(cover, *doors), colour)),
        regions=(*rooms, shelf_top(x / 2, y / 2, z)),
        mass=style.vary(mass),
    )


@entry("open cabinet", family="storage", material="wood", colours=("wood", "brown", "tan"),
       synonyms=("open cupboard", "open kitchen cabinet", "opened cabinet", "opened cupboard"))  # fmt: skip
def open_cabinet(style: Style) -> Build:
    """A low cabinet with two open doors and a board inside."""
    return _case(style, 0.85, 0.42, 0.85, 1, 32.0)


@entry("open wardrobe", family="storage", material="wood", colours=("wood", "brown", "tan"),
       synonyms=("open closet", "opened wardrobe", "opened closet"))  # fmt: skip
def open_wardrobe(style: Style) -> Build:
    """A tall wardrobe with two open doors and three boards inside."""
    return _case(style, 1.0, 0.56, 1.9, 3, 70.0)


def _counter_case(style: Style, x: float, y: float, z: float, door: float, mass: float, *, down: bool) -> Build:
    """A small oven on feet with its door open, `door` of the width: to the left, or downwards; controls beside it."""
    x, y, z = style.vary(x, 0.03), style.vary(y, 0.03), style.vary(z, 0.03)
    colour, low, front = style.colour(), 0.012, -y / 2 + 0.02
    edge = -x / 2 + door * x
    body, _, rooms = hollow((-x / 2, edge), (front, y / 2), (low, z), 0.014)
    panel = span((edge - 0.001, x / 2), (front, y / 2), (low, z))
    if down:
        leaf = span((-x / 2 + 0.004, edge - 0.004), (front - (z - low) + 0.02, front + 0.001), (low, low + 0.012))
    else:
        leaf = _door(edge + x / 2 - 0.006, (low + 0.004, z - 0.004), (-x / 2 + 0.001, front + 0.001), -1)
    feet = legs(x - 0.04, y - 0.06, low + 0.001, 0.03)
    dials = [span((edge + 0.02, x / 2 - 0.02), (-y, front + 0.002), (t * z, t * z + 0.03)) for t in (0.25, 0.5, 0.75)]
    return Build(
        parts=((join(body, panel), colour), (leaf, style.shade(colour, 0.9)), (feet, BLACK)),
        paint=((drawn(join(*dials)), style.colour(1)),),
        regions=(*rooms, shelf_top(x / 2, y / 2 - 0.01, z, at=(0.0, 0.01))),
        mass=style.vary(mass),
    )


@entry("open microwave", family="appliances", material="steel", colours=("black", "white", "steel", "red"),
       accents=("gray",), synonyms=("open microwave oven", "opened microwave"))  # fmt: skip
def open_microwave(style: Style) -> Build:
    """A microwave oven whose door is open to the left."""
    return _counter_case(style, 0.48, 0.36, 0.28, 0.74, 11.5, down=False)


@entry("open toaster oven", family="appliances", material="steel", colours=("steel", "red", "black"),
       accents=("black",), synonyms=("opened toaster oven",))  # fmt: skip
def open_toaster_oven(style: Style) -> Build:
    """A small oven whose door is down."""
    return _counter_case(style, 0.42, 0.3, 0.24, 0.76, 5.0, down=True)


def _kitchen_case(
    style: Style, z: float, room: Range, boards: Sequence[float], mass: float, cover: RGB | None = None
) -> Build:
    """A kitchen appliance 0.6 m wide, the door of its `room` (a range of heights [m]) folded down."""
    x, y, z = style.vary(0.6, 0.01), style.vary(0.6, 0.02), style.vary(z, 0.01)
    colour, front = style.colour(), -y / 2 + 0.03
    body, racks, rooms = hollow((-x / 2, x / 2), (front, y / 2), room, 0.025, boards, 0.012)
    above = span((-x / 2, x / 2), (front, y / 2), (room[1] - 0.001, z - 0.012))
    hob = span((-x / 2, x / 2), (-y / 2, y / 2), (z - 0.0121, z))
    below = span((-x / 2 + 0.01, x / 2 - 0.01), (front + 0.01, y / 2), (0.0, room[0] + 0.001))
    leaf = span((-x / 2 + 0.01, x / 2 - 0.01), (front - (room[1] - room[0]) + 0.02, front + 0.001),
                (room[0], room[0] + _LEAF))  # fmt: skip
    return Build(
        parts=(
            (join(body, above, below), style.shade(colour, 0.9)),
            (hob, cover or colour),
            (leaf, colour),
            *([(join(*racks), STEEL)] if racks else []),
        ),
        regions=(*rooms, shelf_top(x / 2, y / 2, z)),
        mass=style.vary(mass),
    )


@entry("open oven", family="appliances", material="steel", colours=("steel", "white", "black"),
       synonyms=("opened oven",))  # fmt: skip
def open_oven(style: Style) -> Build:
    """A cooker whose oven is open, with a rack in the middle of it."""
    return _kitchen_case(style, 0.9, (0.22, 0.74), (0.48,), 48.0, (38, 38, 42))


@entry("open dishwasher", family="appliances", material="steel", colours=("steel", "white", "black"),
       synonyms=("opened dishwasher",))  # fmt: skip
def open_dishwasher(style: Style) -> Build:
    """A dishwasher whose door is down, with a rack over another."""
    return _kitchen_case(style, 0.85, (0.1, 0.82), (0.46,), 42.0)


@entry("open fridge", family="appliances", material="steel", colours=("white", "steel", "mint", "red"),
       accents=("steel",), synonyms=("open refrigerator", "opened fridge", "opened refrigerator"))  # fmt: skip
def open_fridge(style: Style) -> Build:
    """A fridge with two boards, its door open to the left, over a freezer drawer."""
    x, y, z = style.vary(0.6, 0.03), style.vary(0.64, 0.02), style.vary(1.55, 0.05) * stretch(style)[2]
    colour, front, low = style.colour(), -y / 2 + 0.06, 0.36 * z
    floors = [low + 0.03 + k * (z - low - 0.06) / 3 for k in (1, 2)]
    body, boards, rooms = hollow((-x / 2, x / 2), (front, y / 2), (low, z), 0.03, floors)
    chest = span((-x / 2, x / 2), (front, y / 2), (0.0, low + 0.001))
    drawer = span((-x / 2, x / 2), (-y / 2, front + 0.001), (0.05, low - 0.01))
    door = _door(x - 0.01, (low + 0.01, z), (-x / 2 + 0.001, front + 0.001), -1)
    handle = span((-x / 2 + 0.04, -x / 2 + 0.065), (-y / 2 - 0.035, -y / 2 + 0.001), (0.2 * z, 0.34 * z))
    return Build(
        parts=(
            (join(body, chest), style.shade(colour, 0.88)),
            (join(*boards), WHITE),
            (join(drawer, door), colour),
            (handle, style.colour(1)),
        ),
        regions=(*rooms, shelf_top(x / 2, (y / 2 - front) / 2, z, at=(0.0, (y / 2 + front) / 2))),
        mass=style.vary(62.0),
    )
