"""Plain solids: boxes, blocks, balls."""

from pat3d.assets.catalogue.joinery import resting_ball
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.shapes import box


@entry(
    "box",
    family="basics",
    synonyms=("carton", "package"),
    material="cardboard",
    colours=("cardboard",),
    plurals=("boxes",),
)
def cardboard_box(style: Style) -> Build:
    """A closed shipping carton with tape."""
    x, y, z = style.vary(0.22), style.vary(0.16), style.vary(0.14)
    tape = box(2 * x, 0.045, 2 * z).moved(z=-z / 2)
    return Build(parts=((box(x, y, z), style.colour()),), paint=((tape, style.shade(style.colour(), 0.8)),), mass=0.4)


@entry("block", family="basics", synonyms=("cube", "toy block", "building block"), material="wood",
       colours=("red", "blue", "yellow", "green", "orange", "purple"))  # fmt: skip
def block(style: Style) -> Build:
    """A child's wooden block."""
    side = style.vary(0.05, 0.03)
    return Build(parts=((box(side * 1.6, side, side), style.colour()),))


@entry(
    "ball",
    family="basics",
    synonyms=("plastic ball",),
    material="plastic",
    colours=("red", "blue", "turquoise", "white"),
)
def ball(style: Style) -> Build:
    """A hollow play ball."""
    radius = style.vary(0.035)
    return Build(parts=((resting_ball(radius), style.colour()),), mass=0.012)
