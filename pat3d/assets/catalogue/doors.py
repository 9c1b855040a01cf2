"""Furniture whose door turns: its case and the door are things of their own, held by contact alone.

A door has a pin at each end of its edge; they stand in sockets, square holes between four bars of the case. Sizes do
not vary, so that every door fits; how a door is hung is laid out by pat3d.layout.doors. Doors that stand still are
those of pat3d.assets.catalogue.open_fronts.
"""

from __future__ import annotations

from dataclasses import dataclass

from pat3d.assets.catalogue.joinery import BLACK, Range, drawn, legs, shelf_top, span
from pat3d.assets.catalogue.open_fronts import hollow
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.shapes import Shape, box, cylinder, join

LEAF = 0.02
"""Thickness of a door [m]."""
PIN, PIN_LENGTH = 0.005, 0.012
"""Radius of a pin, and what of it is in its socket [m]."""
PLAY = 0.001
"""Air on each side of a pin in its socket [m]."""
COLLAR = 0.007
"""Radius of the ring on which a door stands, and of its edge around the axis, whose corners clear the front [m]."""
RAISED = 0.004
"""Of a door over the bracket of its lower socket and under that of the upper one [m]."""
AIR = 0.004
"""Between a shut door and the front that it covers [m]."""
BRACKET = 0.014
"""Thickness of what a socket is in [m]."""
REACH, BAR = 0.06, 0.012
"""Between door and bar of a handle, where fingers go, and the bar's thickness [m]."""
HALF_GRIP = 0.055
"""Half the length of a bar [m]."""
_GLASS: RGB = (24, 26, 30)
_FRAME = 0.016
"""Of a bracket around the axis [m]: to each side, and before it."""


@dataclass(frozen=True, kw_only=True)
class Doorway:
    """What a door covers, in the frame of its case [m]."""

    size: tuple[float, float, float]
    """Of the case."""
    across: Range
    """From the side where the door turns to the other."""
    up: Range
    """Between the brackets."""
    handle: float
    """Height of the handle."""
    mass: float
    """Of the door [kg]."""
    pane: bool = False
    """Whether the door has a window."""

    @property
    def front(self) -> float:
        """Of the case behind the door, along its depth [m]."""
        return -self.size[1] / 2 + _FRAME + LEAF / 2 + AIR

    @property
    def axis(self) -> tuple[float, float]:
        """Where the door turns [m], seen from above."""
        return self.across[0] + _FRAME, self.front - AIR - LEAF / 2

    @property
    def width(self) -> float:
        """Of the door from its axis [m]."""
        return self.across[1] - self.axis[0] - 0.002

    @property
    def grip(self) -> float:
        """Of the middle of the handle from the axis [m]."""
        return self.width - HALF_GRIP - 0.025

    @property
    def bar(self) -> float:
        """Of the middle of the handle from the lower end of the lower pin [m]."""
        return self.handle - self.up[0] + PIN_LENGTH


DOORWAYS = {
    "microwave": Doorway(
        size=(0.48, 0.38, 0.28), across=(-0.24, 0.115), up=(0.026, 0.266), handle=0.17, mass=0.9, pane=True
    ),
    "cabinet": Doorway(size=(0.4, 0.4, 0.56), across=(-0.2, 0.2), up=(0.054, 0.546), handle=0.38, mass=1.8),
    "fridge": Doorway(size=(0.44, 0.5, 0.74), across=(-0.22, 0.22), up=(0.064, 0.726), handle=0.5, mass=3.0),
}
"""By what the door is of."""


def _sockets(way: Doorway) -> Shape:
    """The brackets at the lower and the upper end of the door, each four bars around its pin."""
    (x, y), hole = way.axis, PIN + PLAY
    bars = []
    for z in ((way.up[0] - BRACKET, way.up[0]), (way.up[1], way.up[1] + BRACKET)):
        before, behind = (y - _FRAME, y - hole), (y + hole, way.front + 0.001)
        beside = (x - _FRAME, x - hole), (x + hole, x + _FRAME)
        bars += [span(across, (before[0], behind[1]), z) for across in beside]
        bars += [span((beside[0][1], beside[1][0]), along, z) for along in (before, behind)]
    return join(*bars)


def _door(style: Style, way: Doorway) -> Build:
    """The door about its axis at the origin, its pins at the ends of it."""
    height = way.up[1] - way.up[0] - 2 * RAISED
    low = PIN_LENGTH + RAISED
    leaf = span((-COLLAR, way.width), (-LEAF / 2, LEAF / 2), (low, low + height))
    ring = cylinder(COLLAR, RAISED + 1e-4, 12).moved(z=PIN_LENGTH)
    pins = [cylinder(PIN, length + 1e-4, 12).moved(z=z)
            for z, length in ((0.0, PIN_LENGTH), (low + height - 1e-4, RAISED + PIN_LENGTH))]  # fmt: skip
    out, up = -LEAF / 2 - REACH, (way.bar - BAR / 2, way.bar + BAR / 2)
    ends = [
        span((x - BAR / 2, x + BAR / 2), (out - BAR, -LEAF / 2 + 1e-3), up)
        for x in (way.grip - HALF_GRIP, way.grip + HALF_GRIP)
    ]
    bar = span((way.grip - HALF_GRIP, way.grip + HALF_GRIP), (out - BAR, out), up)
    rim = 0.03
    pane = span((rim, way.width - rim), (-LEAF, LEAF), (low + rim, low + height - rim))
    return Build(
        parts=((join(leaf, ring, *pins), style.colour()), (join(bar, *ends), style.colour(1))),
        paint=((drawn(pane), _GLASS),) if way.pane else (),
        mass=way.mass,
    )


@entry("hinged microwave", family="appliances", material="steel", colours=("steel",), accents=("gray",))
def hinged_microwave(style: Style) -> Build:
    """A microwave oven without its door, with sockets for one at the left."""
    way = DOORWAYS["microwave"]
    (x, y, z), low, edge = way.size, way.up[0] - BRACKET, way.across[1]
    back = y / 2
    body, _, rooms = hollow((-x / 2, edge), (way.front, back), (low, z), 0.014)
    panel = span((edge - 0.001, x / 2), (way.front, back), (low, z))
    dials = [span((edge + 0.02, x / 2 - 0.02), (-y, way.front + 0.002), (t * z, t * z + 0.03))
             for t in (0.25, 0.5, 0.75)]  # fmt: skip
    feet = legs(x - 0.04, y - 0.1, low + 0.001, 0.03).moved(y=0.02)
    return Build(
        parts=((join(body, panel, _sockets(way)), style.colour()), (feet, BLACK)),
        paint=((drawn(join(*dials)), style.colour(1)),),
        regions=(*rooms, shelf_top(x / 2, (back - way.front) / 2, z, at=(0.0, (back + way.front) / 2))),
        mass=11.0,
    )


@entry("hinged cabinet", family="storage", material="wood", colours=("wood",))
def hinged_cabinet(style: Style) -> Build:
    """A small cabinet with a board inside, without its door, with sockets for one at the left."""
    way = DOORWAYS["cabinet"]
    x, y, z = way.size
    low = way.up[0] - BRACKET
    body, boards, rooms = hollow((-x / 2, x / 2), (way.front, y / 2), (low, z), 0.018, (0.3,))
    plinth = box(x - 0.06, y / 2 - way.front - 0.04, low + 0.001).moved(0.0, (y / 2 + way.front) / 2)
    return Build(
        parts=((join(body, plinth, *boards, _sockets(way)), style.colour()),),
        regions=(*rooms, shelf_top(x / 2, (y / 2 - way.front) / 2, z, at=(0.0, (y / 2 + way.front) / 2))),
        mass=16.0,
    )


@entry("hinged fridge", family="appliances", material="steel", colours=("white",), accents=("steel",))
def hinged_fridge(style: Style) -> Build:
    """A small fridge with two boards, without its door, with sockets for one at the left."""
    way = DOORWAYS["fridge"]
    x, y, z = way.size
    low, middle, deep = way.up[0] - BRACKET, (y / 2 + way.front) / 2, y / 2 - way.front
    floors = [low + 0.03 + k * (z - low - 0.06) / 3 for k in (1, 2)]
    body, boards, rooms = hollow((-x / 2, x / 2), (way.front, y / 2), (low, z), 0.03, floors)
    plinth = box(x - 0.04, deep - 0.04, low + 0.001).moved(0.0, middle)
    return Build(
        parts=((join(body, *boards, _sockets(way)), style.colour()), (plinth, BLACK)),
        regions=(*rooms, shelf_top(x / 2, deep / 2, z, at=(0.0, middle))),
        mass=24.0,
    )


@entry("hinged microwave door", family="appliances", material="steel", colours=("steel",), accents=("steel",))
def microwave_door(style: Style) -> Build:
    """The door of a microwave oven, which is shut."""
    return _door(style, DOORWAYS["microwave"])


@entry("open hinged microwave door", family="appliances", material="steel", colours=("steel",), accents=("steel",))
def open_microwave_door(style: Style) -> Build:
    """The same, which is open."""
    return _door(style, DOORWAYS["microwave"])


@entry("hinged cabinet door", family="storage", material="wood", colours=("wood",), accents=("black",))
def cabinet_door(style: Style) -> Build:
    """The door of a cabinet, which is shut."""
    return _door(style, DOORWAYS["cabinet"])


@entry("open hinged cabinet door", family="storage", material="wood", colours=("wood",), accents=("black",))
def open_cabinet_door(style: Style) -> Build:
    """The same, which is open."""
    return _door(style, DOORWAYS["cabinet"])


@entry("hinged fridge door", family="appliances", material="steel", colours=("white",), accents=("steel",))
def fridge_door(style: Style) -> Build:
    """The door of a fridge, which is shut."""
    return _door(style, DOORWAYS["fridge"])


@entry("open hinged fridge door", family="appliances", material="steel", colours=("white",), accents=("steel",))
def open_fridge_door(style: Style) -> Build:
    """The same, which is open."""
    return _door(style, DOORWAYS["fridge"])
