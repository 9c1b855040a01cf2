"""Paper towel, trivet, thermos, oven mitt and placemat."""

from __future__ import annotations

import numpy as np

from pat3d.assets.catalogue.common import disc, height, length, rectangle
from pat3d.assets.catalogue.joinery import drawn, span, together
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import lathe, merged, slab, unseen
from pat3d.assets.shapes import Shape, box, cylinder, ellipsoid, join, soft_box


@entry("paper towel", family="kitchen", synonyms=("paper towel roll", "kitchen roll", "roll of paper towel",
       "paper towels", "roll of paper towels", "kitchen paper"), material="foam", colours=("white",))  # fmt: skip
def paper_towel(style: Style) -> Build:
    """A tall roll standing on its end, its cardboard core showing."""
    r, h = style.vary(0.06), height(style, 0.26, 0.03)
    roll, bore = cylinder(r, h), cylinder(0.019, 1).moved(z=-0.5)
    core = unseen(cylinder(0.0205, 1)).moved(z=-0.5)
    seams = join(*(box(1, 1, 0.0015).moved(z=t * h) for t in (0.25, 0.5, 0.75)))
    dots = merged(
        [
            unseen(ellipsoid(0.004, 0.1, 0.004)).moved(x, -r, z * h)
            for x in (-0.03, 0.0, 0.03)
            for z in (0.12, 0.38, 0.62, 0.88)
        ]
    )
    return Build(
        parts=((Shape(roll.solid - bore.solid, roll.hulls), style.colour()),),
        paint=((unseen(seams), style.shade(style.colour(), 0.88)), (dots, (150, 186, 214)), (core, (184, 146, 102))),
        regions=(disc("on", h, r),),
        mass=0.28,
    )


@entry(
    "trivet",
    family="kitchen",
    synonyms=("pot stand", "hot pad", "pot holder", "potholder", "heat pad"),
    material="cork",
    colours=("cork", "black", "wood"),
)
def trivet(style: Style) -> Build:
    """A thick round mat for hot pots, with a ring of grooves."""
    r = style.vary(0.095)
    grooves = [
        cylinder(a, 0.02).solid - cylinder(a - 0.004, 0.06).moved(z=-0.02).solid for a in (0.35 * r, 0.6 * r, 0.85 * r)
    ]
    rings = merged([Shape(solid, ()).moved(z=0.009) for solid in grooves])
    return Build(
        parts=((cylinder(r, 0.012), style.colour()),),
        regions=(disc("on", 0.012, r),),
        paint=((rings, style.shade(style.colour(), 0.7)),),
        mass=0.16,
    )


@entry("thermos", family="kitchen", synonyms=("thermos flask", "vacuum flask", "travel mug", "insulated bottle",
       "thermos bottle"), material="steel", colours=("steel", "green", "navy", "red"), accents=("black",))  # fmt: skip
def thermos(style: Style) -> Build:
    """A tall insulated flask with a screwed cup on top."""
    r, h = style.vary(0.038), height(style, 0.25)
    body = lathe([(0.95 * r, 0), (r, 0.005), (r, 0.72 * h), (0.84 * r, 0.79 * h)], angles=(-45.0, 0.0, 30.0))
    cup = lathe([(0.86 * r, 0.785 * h), (0.78 * r, 0.99 * h), (0.7 * r, h)], angles=(5.0, 60.0))
    bands = join(*(box(1, 1, 0.008).moved(z=z * h) for z in (0.03, 0.68)))
    return Build(
        parts=((body, style.colour()), (cup, style.colour(1))),
        paint=((unseen(bands), style.colour(1)),),
        regions=(disc("on", h, 0.7 * r),),
        mass=0.62,
    )


@entry(
    "oven mitt",
    family="kitchen",
    synonyms=("oven glove", "oven mitten", "kitchen glove"),
    material="cotton",
    colours=("red", "blue", "green"),
)
def oven_mitt(style: Style) -> Build:
    """A quilted mitten lying flat, its thumb to the front."""
    n = length(style, 0.27)
    palm = soft_box(n, 0.15, 0.034, 0.014)
    thumb = soft_box(0.4 * n, 0.06, 0.03, 0.012).turned("z", -38).moved(0.02 * n, -0.085)
    cuff = soft_box(0.045, 0.165, 0.04, 0.01).moved(-0.48 * n)
    quilt = join(
        *(
            box(0.003, 1, 1).turned("z", turn).moved(x=(k - 3) * 0.13 * n, z=-0.2)
            for k in range(7)
            for turn in (40, -40)
        )
    )
    loop = slab(0.045, 0.014, 0.006, 0.005).moved(-0.48 * n - 0.035)
    main = style.colour()
    quilting = Shape(quilt.solid ^ box(0.86 * n, 0.15, 1).moved(0.05 * n, z=-0.5).solid, ())
    return Build(
        parts=((join(palm, thumb), main), (join(cuff, loop), style.shade(main, 0.72))),
        paint=((quilting, style.shade(main, 0.8)),),
        mass=0.11,
    )


@entry(
    "placemat",
    family="tableware",
    synonyms=("table mat", "place mat"),
    material="bamboo",
    colours=("bamboo", "teal", "gray"),
)
def placemat(style: Style) -> Build:
    """A thin woven mat for one place at the table."""
    x, y, z = length(style, 0.42, 0.03), style.vary(0.3, 0.03), 0.003
    strips = [span((-1, 1), (t * y - 0.003, t * y + 0.003), (-1, 1)) for t in np.linspace(-0.45, 0.45, 16)]
    main = style.colour()
    return Build(
        parts=((box(x, y, z), main),),
        regions=(rectangle("on", z, x, y),),
        paint=((drawn(together(strips)), style.shade(main, 0.82)),),
        mass=0.14,
    )
