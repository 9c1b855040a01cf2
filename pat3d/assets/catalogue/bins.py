"""Crates, boxes, bins and baskets that are open at the top."""

import math

from pat3d.assets.catalogue.joinery import cavity, drawn, dressed, legs, stretch, together
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.shapes import Shape, box, join, tray, vessel


@entry(
    "crate",
    family="storage",
    material="wood",
    colours=("wood", "tan", "brown"),
    synonyms=("wooden crate", "fruit crate", "open crate"),
)
def crate(style: Style) -> Build:
    """An open crate of wooden slats."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(0.46) * wide, style.vary(0.32) * deep, style.vary(0.24) * tall
    colour, wall = style.colour(), 0.02
    slats, step = [], z / 3
    for k in range(3):
        low, high = (0.0 if k == 0 else k * step + 0.008), (z if k == 2 else (k + 1) * step - 0.008)
        for s in (-1, 1):
            slats.append(box(x, 0.01, high - low).moved(0.0, s * (y / 2 - 0.005), low))
            slats.append(box(0.01, y, high - low).moved(s * (x / 2 - 0.005), 0.0, low))
    posts = legs(x - 0.004, y - 0.004, z - 0.001, wall - 0.002)
    whole = tray(x, y, z, wall, 0.015)
    looks = join(box(x - 0.002, y - 0.002, 0.015), posts)
    return Build(
        parts=((dressed(together(slats), whole), colour), (drawn(looks), style.shade(colour, 0.8))),
        regions=(cavity(x / 2 - wall, y / 2 - wall, 0.015, z - 0.015),),
        mass=style.vary(2.8),
    )


@entry(
    "storage box",
    family="storage",
    material="plastic",
    colours=("blue", "gray", "teal", "white"),
    synonyms=(
        "storage bin",
        "plastic bin",
        "plastic box",
        "storage container",
        "tote",
        "open box",
        "plastic crate",
        "plastic tub",
        "tub",
        "plastic container",
        "storage tub",
    ),
    plurals=("storage boxes", "plastic boxes", "open boxes"),
)
def storage_box(style: Style) -> Build:
    """An open plastic box with flared walls, a rim and grips."""
    wide, deep, tall = stretch(style)
    x, y, z = style.vary(0.38) * wide, style.vary(0.26) * deep, style.vary(0.2) * tall
    colour = style.colour()
    rim = [box(x + 0.055, 0.016, 0.016).moved(0.0, s * (y / 2 + 0.015), z - 0.016) for s in (-1, 1)]
    rim += [box(0.016, y + 0.055, 0.016).moved(s * (x / 2 + 0.015), 0.0, z - 0.016) for s in (-1, 1)]
    grip = box(3 * x, 0.1, 0.025).moved(z=0.75 * z)
    return Build(
        parts=((tray(x, y, z, 0.006, 0.006, flare=0.015), colour), (join(*rim), style.shade(colour, 0.85))),
        paint=((grip, style.shade(colour, 0.6)),),
        regions=(cavity(x / 2 - 0.007, y / 2 - 0.007, 0.006, z - 0.006),),
        mass=style.vary(0.9),
    )


def _bin(style: Style, bottom: float, top: float, z: float, wall: float) -> tuple[Shape, float]:
    """An open round bin and the radius that is free at its floor; square when asked."""
    if "square" in style.adjectives:
        return tray(2 * bottom, 2 * bottom, z, wall, wall, flare=top - bottom), bottom - wall
    shape = vessel([(bottom, 0.0), (top, z)], [(bottom - wall, wall), (top - wall, z)], segments=12)
    return shape, (bottom - wall) * math.cos(math.pi / 12)


@entry("bin", family="storage", material="plastic", colours=("gray", "black", "white", "blue"),
       synonyms=("trash can", "waste basket", "wastebasket", "garbage can", "trash bin", "rubbish bin", "dustbin",
                 "waste bin", "recycling bin", "paper basket", "wastepaper basket"))  # fmt: skip
def waste_bin(style: Style) -> Build:
    """An open waste bin with a darker band below the rim."""
    z, bottom, top = style.vary(0.32) * stretch(style)[2], style.vary(0.11), style.vary(0.14)
    shape, free = _bin(style, bottom, max(top, bottom + 0.01), z, 0.008)
    band = box(2.0, 2.0, 0.03).moved(z=z - 0.035)
    square = "square" in style.adjectives
    region = cavity(free, free, 0.008, z - 0.008, round_=not square)
    return Build(
        parts=((shape, style.colour()),),
        paint=((band, style.shade(style.colour(), 0.7)),),
        regions=(region,),
        mass=style.vary(1.1),
    )


@entry(
    "laundry basket",
    family="storage",
    material="wicker",
    colours=("wicker", "white", "beige"),
    synonyms=("hamper", "laundry hamper", "laundry bin", "clothes basket"),
)
def laundry_basket(style: Style) -> Build:
    """A tall open basket with woven bands."""
    z, bottom, top = style.vary(0.45) * stretch(style)[2], style.vary(0.19), style.vary(0.225)
    shape, free = _bin(style, bottom, max(top, bottom + 0.02), z, 0.014)
    bands = [box(2.0, 2.0, 0.018).moved(z=(k + 0.5) * z / 8) for k in range(8)]
    rim = box(2.0, 2.0, 0.1).moved(z=z - 0.025)
    square = "square" in style.adjectives
    return Build(
        parts=((shape, style.colour()),),
        paint=((together(bands), style.shade(style.colour(), 0.82)), (rim, style.shade(style.colour(), 0.6))),
        regions=(cavity(free, free, 0.014, z - 0.014, round_=not square),),
        mass=style.vary(1.6),
    )
