"""Containers as they are while something is in them, their lid off or open; and a jar with its lid on."""

from pat3d.assets.catalogue.common import cavity
from pat3d.assets.catalogue.joinery import cavity as room
from pat3d.assets.catalogue.joinery import together
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import hollow
from pat3d.assets.shapes import box, cylinder, frustum, join, tray


@entry("open treasure chest", family="storage", material="wood", colours=("brown", "wood"), accents=("gold",),
       synonyms=("open chest", "open trunk"))  # fmt: skip
def open_treasure_chest(style: Style) -> Build:
    """A chest that things go into: its lid stands open behind them."""
    x, y, z = style.vary(0.5), style.vary(0.32), style.vary(0.22)
    wall, colour, metal = 0.014, style.colour(), style.colour(1)
    lid = box(x, 0.02, 0.8 * y).moved(y=y / 2 - 0.01, z=z - 0.001)
    bands = [box(0.035, 2.0, 2.0).moved(s * 0.34 * x) for s in (-1, 1)]
    lock = box(0.06, 0.03, 0.05).moved(y=-y / 2 - 0.005, z=z - 0.07)
    return Build(
        parts=((join(tray(x, y, z, wall, wall), lid), colour), (lock, metal)),
        regions=(room(x / 2 - wall - 0.002, y / 2 - 0.022, wall, z - wall),),
        paint=((together(bands), metal),),
        mass=style.vary(7.0),
    )


@entry("cookie jar", family="kitchen", synonyms=("biscuit jar",), material="ceramic",
       colours=("cream", "white", "blue"), accents=("brown",))  # fmt: skip
def cookie_jar(style: Style) -> Build:
    """A wide straight jar under a lid with a knob."""
    r, h = style.vary(0.085), style.vary(0.17)
    lid = cylinder(0.97 * r, 0.016).moved(z=h - 0.001)
    knob = frustum(0.016, 0.021, 0.022).moved(z=h + 0.014)
    return Build(
        parts=((frustum(r, r, h), style.colour()), (join(lid, knob), style.colour(1))),
        mass=1.3,
    )


@entry("open cookie jar", family="kitchen", material="ceramic", colours=("cream", "white", "blue"))
def open_cookie_jar(style: Style) -> Build:
    """A wide straight jar without its lid, which a hand goes into."""
    r, h = style.vary(0.085), style.vary(0.17)
    inner = [(r - 0.012, 0.008), (r - 0.006, 0.02), (r - 0.006, h)]
    body = hollow([(r - 0.005, 0), (r, 0.008), (r, h)], inner)
    return Build(parts=((body, style.colour()),), regions=(cavity(inner, 12),), mass=0.9)
