"""Cut flowers with a bloom of their own shape, lying on it and on the end of their stem."""

from __future__ import annotations

import numpy as np

from pat3d.assets.catalogue.common import LEAF, height, level_lean
from pat3d.assets.catalogue.registry import RGB, Build, Style, entry
from pat3d.assets.rounded import curve, envelope, lathe, merged, ring_of, spot, unseen
from pat3d.assets.shapes import Shape, convex, rod


def _cup(bloom: list[tuple[Shape, RGB]], n: float) -> Shape:
    """One convex part around a bloom that sits on a stem of length `n` [m] along z."""
    seen = np.concatenate([np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3] for shape, _ in bloom])
    return Shape(bloom[0][0].solid, (envelope([*seen, (0.005, 0.0, n - 0.002)]),))


def _cut_flower(n: float, bloom: list[tuple[Shape, RGB]], leaf: Shape) -> Build:
    """A stem of length `n` [m] along z with a bloom at its end, laid down."""
    cup = _cup(bloom, n)
    stem = rod((0, 0, 0), (0, 0, n + 0.004), 0.003, sides=6)
    first, *others = bloom
    shapes = [
        (stem, LEAF),
        (Shape(first[0].solid, cup.hulls), first[1]),
        *((unseen(s), c) for s, c in others),
        (leaf, LEAF),
    ]
    lean = level_lean(cup, stem)
    laid = [(shape.turned("y", lean), colour) for shape, colour in shapes]
    down = -float(laid[0][0].hulls[0][:, 2].min())
    return Build(parts=tuple((shape.moved(z=down), colour) for shape, colour in laid), mass=0.025)


@entry("tulip", family="decor", synonyms=("lily", "crocus"), plurals=("lilies",), material="foliage", colours=("red",
       "yellow", "pink", "purple", "orange"))  # fmt: skip
def tulip(style: Style) -> Build:
    """A cut tulip with a closed cup of six petals and a long leaf."""
    n, r = height(style, 0.26), style.vary(0.021)
    profile = [(0.0035, 0), (0.8 * r, 0.35 * r), (r, 1.1 * r), (0.9 * r, 1.9 * r), (0.6 * r, 2.5 * r)]
    core = lathe(curve(profile, 20)).moved(z=n)
    petal = spot(0.35 * r, 0.52 * r, 1.3 * r, 20).moved(x=0.56 * r, z=n + 1.38 * r)
    main = style.colour()
    outer, inner = ring_of(petal, 0.0, 3), ring_of(petal, 0.0, 3, 60.0)
    bloom = [(core, style.shade(main, 0.85)), (outer, main), (inner, style.shade(main, 0.92))]
    leaf = convex(
        [
            (0, -0.0012, 0.03),
            (0, 0.0012, 0.03),
            (0.02, -0.012, 0.09),
            (0.02, 0.012, 0.09),
            (0.026, 0, 0.17),
            (0.0225, 0, 0.09),
        ]
    )
    return _cut_flower(n, bloom, leaf.turned("z", 160))


@entry("rose", family="decor", synonyms=("red rose", "carnation", "peony"), plurals=("peonies",), material="foliage",
       colours=("red", "pink", "white", "yellow"))  # fmt: skip
def rose(style: Style) -> Build:
    """A cut rose: rings of petals around a bud, two leaves."""
    n, r = height(style, 0.27), style.vary(0.026)
    main = style.colour()
    bloom: list[tuple[Shape, RGB]] = [
        (spot(0.5 * r, 0.5 * r, 0.8 * r, 20).moved(z=n + 0.85 * r), style.shade(main, 0.78))
    ]
    for k, (out, rise, wide, count) in enumerate(((0.22, 0.95, 0.42, 3), (0.42, 0.8, 0.5, 4), (0.62, 0.66, 0.52, 5))):
        petal = spot(0.13 * r, wide * r, 0.62 * r, 20).turned("y", 10 + 12 * k).moved(x=out * r, z=n + rise * r)
        bloom.append((ring_of(petal, 0.0, count, 25.0 * k), style.shade(main, 0.86 + 0.1 * k)))
    leaf = convex(
        [
            (0, -0.0012, 0.1),
            (0, 0.0012, 0.1),
            (0.02, -0.011, 0.125),
            (0.02, 0.011, 0.125),
            (0.04, 0, 0.15),
            (0.021, 0, 0.122),
        ]
    )
    leaves = merged([leaf.turned("z", turn).moved(z=rise) for turn, rise in ((150, 0.0), (215, 0.045))])
    return _cut_flower(n, bloom, leaves)
