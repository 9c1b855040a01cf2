"""A cabinet whose drawers slide: it and each of them are things of their own, held by contact alone.

Sizes do not vary, so that every drawer fits; what slides in where is laid out by pat3d.layout.drawers.
"""

from __future__ import annotations

from pat3d.assets.catalogue.joinery import cavity, shelf_top, span
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.shapes import box, join, tray

WIDTH, DEPTH, HEIGHT = 0.42, 0.46, 0.44
"""Of the cabinet [m]."""
LEVELS = ("top", "middle", "bottom")
"""Its rows, from above; those of the adjectives are open in front, else the first."""
FLOORS = (0.296, 0.168, 0.04)
"""Heights of the floors of the rows [m]."""
WALL, ROOM = 0.016, 0.115
"""Thickness of the cabinet's walls and height of a row [m]."""
SIDE, ABOVE, BEHIND = 0.004, 0.008, 0.006
"""Air on each side of a shut drawer, over it and at its back [m]."""
BOX = (WIDTH - 2 * (WALL + SIDE), DEPTH - WALL - BEHIND, ROOM - ABOVE)
"""Width, depth and height of a drawer without its handle [m]."""
REACH, BAR = 0.06, 0.012
"""Between front and bar of a handle, where fingers go, and the bar's thickness [m]."""
SIDES = 0.05
"""Height of its sides, which are lower than its front, so that a hand gets to what is in it [m]."""
OUTSIDE = 0.18
"""Depth of what is in the open of a drawer that is pulled out [m]."""
GRIP = 0.8
"""Height of the bar as a share of the drawer's."""
_HALF_GRIP = 0.075


@entry("drawer cabinet", family="storage", material="wood", colours=("wood", "brown", "tan"))
def drawer_cabinet(style: Style) -> Build:
    """A cabinet of three rows; drawers slide in those that its adjectives name, the others are shut for good."""
    open_rows = [level in style.adjectives for level in LEVELS]
    if not any(open_rows):
        open_rows[0] = True
    colour, x, front, back = style.colour(), WIDTH / 2, -DEPTH / 2, DEPTH / 2
    walls = [span((s - WALL / 2, s + WALL / 2), (front, back), (0.0, HEIGHT)) for s in (WALL / 2 - x, x - WALL / 2)]
    inner = (WALL - x, x - WALL)
    ceilings = (*(low + ROOM for low in FLOORS), 0.0)
    boards = [span(inner, (front, back), (low, top)) for low, top in zip(ceilings, (HEIGHT, *FLOORS), strict=True)]
    rear = span(inner, (back - WALL, back), (0.0, HEIGHT))
    shut = [low for low, is_open in zip(FLOORS, open_rows, strict=True) if not is_open]
    fronts = [span(inner, (front + 0.004, back - WALL), (low, low + ROOM)) for low in shut]
    # Painted on, so that a hand has room there that pulls at another row.
    slots = [box(0.15, 0.03, BAR).moved(0.0, front, low + GRIP * BOX[2] - BAR / 2) for low in shut]
    return Build(
        parts=(
            (join(*walls, *boards, rear), style.shade(colour, 0.8)),
            *([(join(*fronts), colour)] if fronts else []),
        ),
        paint=((join(*slots), style.shade(colour, 0.3)),) if slots else (),
        regions=(shelf_top(x, DEPTH / 2, HEIGHT),),
        mass=14.0,
    )


def _drawer(style: Style) -> Build:
    x, y, z = BOX
    wall, floor, front = 0.012, 0.008, -y / 2
    bar = span(
        (-_HALF_GRIP, _HALF_GRIP), (front - REACH - BAR, front - REACH), (GRIP * z - BAR / 2, GRIP * z + BAR / 2)
    )
    # The back is high as well: under the row's ceiling it keeps the drawer level when something is put in.
    panels = [span((-x / 2, x / 2), (at, at + wall), (0.0, z)) for at in (front, y / 2 - wall)]
    posts = [
        span((s * _HALF_GRIP - BAR / 2, s * _HALF_GRIP + BAR / 2), (front - REACH - BAR, front + wall / 2),
             (GRIP * z - BAR / 2, GRIP * z + BAR / 2))
        for s in (-1, 1)
    ]  # fmt: skip
    return Build(
        parts=((join(tray(x, y, SIDES, wall, floor), *panels), style.colour()), (join(bar, *posts), style.colour(1))),
        # What of it is in the open when it is pulled out.
        regions=(cavity(x / 2 - wall, OUTSIDE / 2, floor, SIDES - floor, at=(0.0, front + wall + OUTSIDE / 2)),),
        mass=1.4,
    )


@entry("drawer", family="storage", material="wood", colours=("wood", "brown", "tan"), accents=("black",))
def drawer(style: Style) -> Build:
    """A drawer of the cabinet, which is shut: a box with a handle in front."""
    return _drawer(style)


@entry("open drawer", family="storage", material="wood", colours=("wood", "brown", "tan"), accents=("black",))
def open_drawer(style: Style) -> Build:
    """The same, which is pulled out as far as it stays level."""
    return _drawer(style)
