"""Solids of manipulation benchmarks: foam and wood blocks, prisms, pegs, boards, and cards."""

from __future__ import annotations

import math

import numpy as np

from pat3d.assets.catalogue.joinery import (
    cavity,
    disc_top,
    drawn,
    lying,
    shelf_top,
    span,
    together,
)
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.colours import COLOURS
from pat3d.assets.rounded import slab, tube, unseen
from pat3d.assets.shapes import Shape, box, convex, cylinder, join, prism, tray

TOY = ("red", "blue", "yellow", "green", "orange", "purple")


@entry("wood block", family="basics", material="wood", colours=("wood", "tan"), synonyms=("block of wood",
       "timber block", "wooden beam"), plurals=("blocks of wood",))  # fmt: skip
def wood_block(style: Style) -> Build:
    """The tall block of the YCB set, standing: 85 by 85 by 200 mm, 729 g."""
    x, z = style.vary(0.085, 0.01), style.vary(0.2, 0.01)
    rings = [
        Shape(cylinder(r, 1).solid - cylinder(r - 0.0016, 3).moved(z=-1).solid, ()).moved(0.02, 0.01, z - 0.001)
        for r in np.arange(0.008, 0.09, 0.009)
    ]
    return Build(
        parts=((box(x, x, z), style.colour()),),
        paint=((together(rings), style.shade(style.colour(), 0.85)),),
        regions=(shelf_top(x / 2, x / 2, z),),
        mass=0.729,
    )


@entry(
    "foam brick",
    family="basics",
    material="foam",
    colours=("red", "terracotta", "blue"),
    synonyms=("foam block", "sponge brick", "toy foam brick", "soft brick"),
)
def foam_brick(style: Style) -> Build:
    """The foam brick of the YCB set, lying: 75 by 50 by 50 mm, 28 g, with three holes to the eye."""
    x, y, z = style.vary(0.075, 0.01), style.vary(0.05, 0.01), style.vary(0.05, 0.01)
    body = box(x, y, z)
    holes = [Shape(cylinder(0.0085, 1).moved(s * 0.29 * x, 0.0, -0.5).solid, ()) for s in (-1, 0, 1)]
    return Build(
        parts=((Shape(body.solid - together(holes).solid, body.hulls), style.colour()),),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=0.028,
    )


@entry(
    "triangular prism",
    family="basics",
    material="wood",
    colours=TOY,
    synonyms=("triangle block", "triangle", "prism", "wedge block", "roof block"),
)
def triangular_prism(style: Style) -> Build:
    """A roof-shaped block lying on its widest side."""
    x, y, z = style.vary(0.06), style.vary(0.035), style.vary(0.035)
    points = [(a, b, h) for b in (-y / 2, y / 2) for a, h in ((-x / 2, 0.0), (x / 2, 0.0), (0.0, z))]
    return Build(parts=((convex(points), style.colour()),))


@entry(
    "hexagonal prism", family="basics", material="wood", colours=TOY, synonyms=("hexagon block", "hexagon", "hex block")
)
def hexagonal_prism(style: Style) -> Build:
    """A six-sided block standing on its end."""
    r, z = style.vary(0.028), style.vary(0.04)
    turn = np.arange(6) * math.pi / 3
    return Build(
        parts=((convex([(r * math.cos(a), r * math.sin(a), h) for a in turn for h in (0.0, z)]), style.colour()),)
    )


@entry("arch", family="basics", material="wood", colours=TOY, synonyms=("arch block", "bridge block", "wooden arch"),
       plurals=("arches",))  # fmt: skip
def arch(style: Style) -> Build:
    """A bridge block standing on its two feet, with a round opening below."""
    x, y, z = style.vary(0.1), style.vary(0.03), style.vary(0.05)
    r, count = 0.3 * x, 6
    pieces = []
    for s in (-1, 1):
        pieces.append(span((s * x / 2, s * r) if s < 0 else (r, x / 2), (-y / 2, y / 2), (0.0, z)))
    angles = np.linspace(0.0, math.pi, count + 1)
    inner = [(r * math.cos(a), 0.62 * z * math.sin(a)) for a in angles]
    for (x0, z0), (x1, z1) in zip(inner, inner[1:], strict=False):
        pieces.append(convex([(a, b, h) for a, h in ((x0, z0), (x1, z1), (x0, z), (x1, z)) for b in (-y / 2, y / 2)]))
    return Build(parts=((join(*pieces), style.colour()),), regions=(shelf_top(x / 2, y / 2, z),), mass=0.06)


@entry("cross block", family="basics", material="wood", colours=TOY, synonyms=("cross", "plus block", "cross shape"))
def cross_block(style: Style) -> Build:
    """A plus-shaped block lying flat."""
    n, w, z = style.vary(0.07), style.vary(0.024), style.vary(0.025)
    return Build(parts=((join(box(n, w, z), box(w, n, z)), style.colour()),))


@entry(
    "l-shaped block",
    family="basics",
    material="wood",
    colours=TOY,
    synonyms=("l block", "l shape", "l-shape", "l shaped block"),
)
def l_block(style: Style) -> Build:
    """An L lying flat: two arms of equal thickness."""
    n, w, z = style.vary(0.075), style.vary(0.025), style.vary(0.025)
    return Build(parts=((join(box(n, w, z), box(w, 0.8 * n, z).moved(-(n - w) / 2, 0.4 * n - w / 2)), style.colour()),))


@entry(
    "t-shaped block",
    family="basics",
    material="wood",
    colours=TOY,
    synonyms=("t block", "t shape", "t-shape", "push-t block", "push t block", "t-block", "t shaped block"),
)
def t_block(style: Style) -> Build:
    """The T of the pushing task, lying flat: a bar of 120 mm and a stem of 90 mm, 30 mm wide."""
    k, z = style.vary(1.0, 0.02), style.vary(0.03)
    bar, stem = box(0.12 * k, 0.03 * k, z).moved(y=0.045 * k), box(0.03 * k, 0.092 * k, z).moved(y=-0.014 * k)
    return Build(parts=((join(bar, stem), style.colour()),))


@entry(
    "star",
    family="basics",
    material="wood",
    colours=("yellow", "gold", "red", "blue"),
    synonyms=("star block", "star shape", "wooden star"),
)
def star(style: Style) -> Build:
    """A five-pointed star lying flat."""
    r, z = style.vary(0.035), style.vary(0.022)
    turn = np.arange(10) * math.pi / 5 + math.pi / 2
    outline = [
        ((r if k % 2 == 0 else 0.45 * r) * math.cos(a), (r if k % 2 == 0 else 0.45 * r) * math.sin(a))
        for k, a in enumerate(turn)
    ]
    solid = prism(outline, z).solid
    core = [(0.45 * r * math.cos(a), 0.45 * r * math.sin(a)) for a in turn[1::2]]
    hulls = [np.array([(x, y, h) for x, y in core for h in (0.0, z)])]
    for k in range(0, 10, 2):
        corners = [outline[k], outline[k - 1], outline[(k + 1) % 10]]
        hulls.append(np.array([(x, y, h) for x, y in corners for h in (0.0, z)]))
    return Build(parts=((Shape(solid, tuple(hulls)), style.colour()),))


@entry(
    "ring",
    family="basics",
    material="wood",
    colours=TOY,
    synonyms=("toy ring", "wooden ring", "torus", "ring toy", "hoop"),
)
def ring(style: Style) -> Build:
    """A thick ring lying flat, open in its middle: it goes over a peg."""
    big, small = style.vary(0.034), style.vary(0.0105)
    turn = np.linspace(0, 2 * np.pi, 49)[:-1]
    path = np.column_stack([big * np.cos(turn), big * np.sin(turn), np.full(48, small)])
    body = tube(path, small, 12, closed=True)
    return Build(parts=((body, style.colour()),))


@entry(
    "peg",
    family="basics",
    material="wood",
    colours=("wood", *TOY[:4]),
    synonyms=("wooden peg", "round peg", "dowel pin"),
)
def peg(style: Style) -> Build:
    """A round peg standing on its end."""
    r, z = style.vary(0.0125), style.vary(0.08)
    return Build(parts=((cylinder(r, z), style.colour()),), regions=(disc_top(r, z),))


@entry(
    "rod",
    family="basics",
    material="wood",
    colours=("wood", "red", "blue"),
    synonyms=("stick", "dowel", "wooden stick", "wooden rod", "baton", "bar stick"),
)
def rod(style: Style) -> Build:
    """A round stick lying on a flat of its convex part."""
    r, n = style.vary(0.01), style.vary(0.25)
    return Build(parts=((lying(r, n, sides=8), style.colour()),))


@entry("disc", family="basics", material="wood", colours=TOY, synonyms=("disk", "puck", "round block", "hockey puck",
       ))  # fmt: skip
def disc_(style: Style) -> Build:
    """A flat round piece lying down."""
    r, z = style.vary(0.038), style.vary(0.024)
    inner = Shape(cylinder(0.8 * r, 1).solid - cylinder(0.74 * r, 3).moved(z=-1).solid, ()).moved(z=z - 0.001)
    return Build(
        parts=((cylinder(r, z), style.colour()),),
        paint=((inner, style.shade(style.colour(), 0.8)),),
        regions=(disc_top(r, z),),
    )


@entry(
    "peg board",
    family="basics",
    material="wood",
    colours=("wood", "tan"),
    synonyms=("pegboard", "peg stand", "peg base"),
)
def peg_board(style: Style) -> Build:
    """A board with three upright pegs in a row, for rings and nuts."""
    x, y, z = style.vary(0.3, 0.03), style.vary(0.12, 0.03), 0.02
    pegs = [
        (cylinder(0.0115, 0.08).moved((k - 1) * 0.32 * x, 0.0, z - 0.001), COLOURS[colour])
        for k, colour in enumerate(("red", "yellow", "blue"))
    ]
    return Build(parts=((slab(x, y, z, 0.012), style.colour()), *pegs), mass=0.5)


@entry(
    "cube tray",
    family="basics",
    material="wood",
    colours=("wood", "tan", "white"),
    synonyms=("sorting tray", "kit tray", "parts tray", "kitting tray", "parts bin", "sorting box"),
)
def cube_tray(style: Style) -> Build:
    """An open tray of two equal compartments, as used for sorting."""
    x, y, h, wall, floor = style.vary(0.36, 0.02), style.vary(0.2, 0.02), style.vary(0.05), 0.008, 0.008
    middle = box(wall, y - wall, h - 0.001)
    half = (x / 2 - 1.5 * wall) / 2
    return Build(
        parts=((join(tray(x, y, h, wall, floor), middle), style.colour()),),
        regions=tuple(
            cavity(half - 0.001, y / 2 - wall - 0.001, floor, h - floor, at=(s * (half + wall / 2), 0.0))
            for s in (-1, 1)
        ),
        mass=0.75,
    )


@entry("chessboard", family="basics", material="wood", colours=("brown", "wood", "black"), accents=("cream",),
       synonyms=("chess board", "checkerboard", "checkers board", "draughts board", "board game"))  # fmt: skip
def chessboard(style: Style) -> Build:
    """A board of 64 squares in a frame, lying flat."""
    side, z = style.vary(0.4, 0.03), 0.016
    cell = 0.9 * side / 8
    light = [
        unseen(box(cell, cell, 0.01)).moved((i - 3.5) * cell, (j - 3.5) * cell, z - 0.001)
        for i in range(8)
        for j in range(8)
        if (i + j) % 2
    ]
    field = unseen(box(8 * cell, 8 * cell, 0.01)).moved(z=z - 0.001)
    main = style.colour()
    return Build(
        parts=((box(side, side, z), style.shade(main, 0.75)),),
        paint=((field, main), (together(light), style.colour(1))),
        regions=(shelf_top(4 * cell, 4 * cell, z),),
        mass=1.2,
    )


@entry(
    "jenga tower",
    family="basics",
    material="wood",
    colours=("tan", "wood"),
    synonyms=("jenga", "block tower", "wooden block tower"),
)
def jenga_tower(style: Style) -> Build:
    """A glued tower of crossed blocks, six layers high."""
    n, z = style.vary(0.075, 0.02), 0.015
    w = n / 3
    layers, tints = [], []
    for level in range(6):
        for k in range(3):
            block = box(n, w - 0.0008, z).moved(y=(k - 1) * w, z=level * z)
            layers.append(block if level % 2 == 0 else block.turned("z", 90))
            tints.append(0.88 + 0.06 * ((level + 2 * k) % 3))
    tower = box(n, n, 6 * z)
    parts = [
        (Shape(block.solid, tower.hulls if k == 0 else ()), style.shade(style.colour(), tint))
        for k, (block, tint) in enumerate(zip(layers, tints, strict=True))
    ]
    return Build(parts=tuple(parts), regions=(shelf_top(n / 2, n / 2, 6 * z),), mass=0.33)


@entry(
    "jenga block",
    family="basics",
    material="wood",
    colours=("tan", "wood"),
    synonyms=("jenga piece", "wooden plank block"),
)
def jenga_block(style: Style) -> Build:
    """One block of the tower, lying flat."""
    x, y, z = style.vary(0.075, 0.02), style.vary(0.025, 0.02), style.vary(0.015, 0.02)
    return Build(parts=((box(x, y, z), style.colour()),), regions=(shelf_top(x / 2, y / 2, z),))


@entry("deck of cards", family="basics", material="cardboard", colours=("red", "blue"), accents=("white",),
       synonyms=("playing cards", "card deck", "pack of cards", "playing card", "cards"),
       plurals=("decks of cards",))  # fmt: skip
def deck_of_cards(style: Style) -> Build:
    """A closed pack of playing cards lying flat."""
    x, y, z = style.vary(0.065, 0.01), style.vary(0.092, 0.01), style.vary(0.019, 0.02)
    frame = span((-0.44 * x, 0.44 * x), (-0.46 * y, 0.46 * y), (z - 0.001, 1))
    inner = span((-0.4 * x, 0.4 * x), (-0.43 * y, 0.43 * y), (z - 0.0012, 1))
    heart = unseen(box(0.018, 0.018, 0.02).turned("z", 45)).moved(z=z - 0.0014)
    sides = span((-1, 1), (-1, 1), (0.2 * z, 0.8 * z))
    edge = Shape(sides.solid - box(x - 0.002, y + 1, 1).moved(z=-0.5).solid, ())
    main = style.colour()
    return Build(
        parts=((box(x, y, z), main),),
        paint=(
            (drawn(frame), style.colour(1)),
            (drawn(inner), main),
            (heart, style.colour(1)),
            (edge, style.shade(main, 0.85)),
        ),
        regions=(shelf_top(x / 2, y / 2, z),),
        mass=0.095,
    )
