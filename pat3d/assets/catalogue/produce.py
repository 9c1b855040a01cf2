"""More fruit and vegetables, each lying or standing on a flat base of its convex part."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.catalogue.common import CREAM, LEAF, STALK, length
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import (
    centre_of,
    curve,
    lathe,
    lobed,
    lump,
    merged,
    rest_angle,
    ring_of,
    spot,
    tube,
    unseen,
)
from pat3d.assets.shapes import Shape, box, cone, ellipsoid, join, rod


def _egg_profile(rx: float, ry: float, blunt: float = 0.0) -> NDArray[np.float64]:
    angle = np.radians(np.linspace(-80.0, 80.0, 24))
    return np.column_stack([ry * np.cos(angle) * (1 - blunt * np.sin(angle)), rx * np.sin(angle)])


def _egg(rx: float, ry: float, rz: float, blunt: float = 0.0) -> Shape:
    """An ellipsoid of semi-axes [m] lying on a small flat, thicker at its left end by `blunt`."""
    profile = _egg_profile(rx, ry, blunt)
    lean = rest_angle(profile)
    shape = lathe(profile, angles=(lean,)).turned("y", 90 + lean).scaled(1, 1, rz / ry)
    return shape.moved(z=-float(np.concatenate(shape.hulls)[:, 2].min()))


def _speckles(style: Style, count: int, reach: tuple[float, float, float], size: float) -> Shape:
    """Small spots on an ellipsoid of semi-axes `reach` [m] whose lowest point is the origin."""
    spots = []
    for _ in range(count):
        way = style.rng.normal(size=3)
        x, y, z = way / np.linalg.norm(way) * reach
        spots.append(spot(size, segments=8).moved(float(x), float(y), float(z) + reach[2]))
    return merged(spots)


@entry(
    "kiwi", family="food", synonyms=("kiwi fruit", "kiwifruit"), material="fruit", colours=("brown",), accents=("lime",)
)
def kiwi(style: Style) -> Build:
    """A brown kiwi on its side."""
    k = style.vary(1.0)
    body = _egg(0.034 * k, 0.025 * k, 0.0245 * k)
    fuzz = _speckles(style, 60, (0.034 * k, 0.025 * k, 0.0245 * k), 0.0014)
    return Build(parts=((body, style.colour()),), paint=((fuzz, style.shade(style.colour(), 1.3)),))


@entry("mango", family="food", plurals=("mangoes", "mangos"), material="fruit", colours=("orange", "green", "coral"))
def mango(style: Style) -> Build:
    """A mango lying on its side, blushing on one end."""
    k = style.vary(1.0)
    body = _egg(0.056 * k, 0.04 * k, 0.037 * k, 0.16)
    blush = ellipsoid(0.05 * k).moved(x=-0.05 * k, z=0.07 * k)
    return Build(parts=((body, style.colour()),), paint=((unseen(blush), (206, 74, 54)),))


@entry("avocado", family="food", plurals=("avocados", "avocadoes"), material="fruit", colours=("green", "olive"))
def avocado(style: Style) -> Build:
    """A dark avocado lying on its side."""
    k = style.vary(1.0)
    body = _egg(0.052 * k, 0.033 * k, 0.033 * k, 0.3)
    dark = style.shade(style.colour(), 0.75)
    fine = _speckles(style, 70, (0.05 * k, 0.033 * k, 0.033 * k), 0.0016)
    return Build(
        parts=((body, dark),), paint=((fine, style.colour()), (spot(0.007).moved(x=0.052 * k, z=0.033 * k), STALK))
    )


@entry("coconut", family="food", material="fruit", colours=("brown", "chocolate"))
def coconut(style: Style) -> Build:
    """A hairy coconut with three eyes."""
    k = style.vary(1.0)
    body = _egg(0.06 * k, 0.055 * k, 0.055 * k)
    strands = merged(
        [unseen(box(0.2, 0.0016, 0.3)).turned("x", turn).moved(z=0.055 * k) for turn in np.linspace(0, 165, 16)]
    )
    eyes = join(
        *(spot(0.008).moved(-0.058 * k, 0.017 * np.cos(a), 0.055 * k + 0.017 * np.sin(a)) for a in (0.5, 2.6, 4.7))
    )
    return Build(
        parts=((body, style.colour()),),
        paint=((strands, style.shade(style.colour(), 1.25)), (eyes, style.shade(style.colour(), 0.4))),
        mass=0.65,
    )


@entry("pomegranate", family="food", material="fruit", colours=("crimson", "red"))
def pomegranate(style: Style) -> Build:
    """A pomegranate with its crown."""
    r = style.vary(0.042)
    angle = np.radians(np.linspace(-78.0, 70.0, 24))
    body = lathe(np.column_stack([r * np.cos(angle), 0.95 * r * (np.sin(angle) + 0.978)]))
    crown = lathe([(0.2 * r, 1.8 * r), (0.18 * r, 1.95 * r), (0.34 * r, 2.25 * r)], angles=(0.0,), sides=6)
    return Build(parts=((body, style.colour()), (crown, style.shade(style.colour(), 0.8))))


@entry("blueberry", family="food", plurals=("blueberries",), material="fruit", colours=("indigo", "navy"))
def blueberry(style: Style) -> Build:
    """A large blueberry with its crown."""
    r = style.vary(0.0105)
    angle = np.radians(np.linspace(-75.0, 75.0, 20))
    body = lathe(np.column_stack([r * np.cos(angle), 0.9 * r * (np.sin(angle) + 0.966)]))
    star = unseen(ring_of(box(0.004, 0.0016, 0.1).moved(x=0.002), 0.0, 5)).moved(z=1.6 * r)
    return Build(parts=((body, style.colour()),), paint=((star, style.shade(style.colour(), 0.5)),), mass=0.0042)


@entry("raspberry", family="food", synonyms=("blackberry",), plurals=("raspberries", "blackberries"), material="fruit",
       colours=("crimson", "red", "purple"))  # fmt: skip
def raspberry(style: Style) -> Build:
    """A raspberry standing on its wide end."""
    k = style.vary(1.0)
    cover = lathe([(0.0118, 0), (0.0132, 0.006), (0.0095, 0.017), (0.0035, 0.0225)], angles=(0.0, 32.0, 60.0))
    beads = []
    for row, (r, z, count) in enumerate(
        ((0.0092, 0.0042, 11), (0.0088, 0.0092, 10), (0.0066, 0.0142, 8), (0.0034, 0.0182, 5))
    ):
        beads.append(ring_of(spot(0.003, segments=10), r, count, 14 * row).moved(z=z))
    seen = join(*beads).solid + lathe([(0.009, 0), (0.0095, 0.008), (0.004, 0.018)]).solid
    inside = seen ^ lathe([(0.0118, 0), (0.0132, 0.006), (0.0095, 0.017), (0.0035, 0.0225)]).solid
    return Build(parts=((Shape(inside, cover.hulls).scaled(k), style.colour()),), mass=0.005)


@entry("broccoli", family="food", synonyms=("broccoli head", "head of broccoli"), material="fruit", colours=("green",),
       accents=("lime",))  # fmt: skip
def broccoli(style: Style) -> Build:
    """A head of broccoli standing on its stalk."""
    k = style.vary(1.0)
    stalk = lathe([(0.019, 0), (0.017, 0.04), (0.03, 0.07)], cuts=(0.04,), angles=(0.0,))
    crown = lathe([(0.03, 0.055), (0.062, 0.075), (0.06, 0.1), (0.035, 0.122), (0.01, 0.127)])
    buds = []
    for ring, (r, z, count) in enumerate(((0.046, 0.077, 10), (0.038, 0.098, 8), (0.018, 0.109, 5), (0.0, 0.112, 1))):
        for n in range(count):
            turn = 2 * np.pi * (n + 0.4 * ring) / count
            buds.append(spot(float(style.vary(0.0145, 0.12)), segments=14).moved(r * np.cos(turn), r * np.sin(turn), z))
    head = merged(buds).solid ^ crown.solid
    core = lathe([(0.028, 0.058), (0.045, 0.08), (0.03, 0.108)]).solid
    main = style.colour()
    return Build(
        parts=((stalk.scaled(k), style.shade(style.colour(1), 0.9)), (Shape(head + core, crown.hulls).scaled(k), main)),
        mass=0.28,
    )


@entry(
    "cabbage",
    family="food",
    synonyms=("head of cabbage", "lettuce", "head of lettuce", "iceberg lettuce"),
    material="fruit",
    colours=("lime", "green", "purple"),
)
def cabbage(style: Style) -> Build:
    """A round head with overlapping leaves and veins."""
    r = style.vary(0.078)
    angle = np.radians(np.linspace(-72.0, 86.0, 28))
    body = lobed(lathe(np.column_stack([r * np.cos(angle), 0.9 * r * (np.sin(angle) + 0.951)])), 7, 0.05)
    leaves = join(*(ellipsoid(0.9 * r, 0.6 * r, r).moved(x=0.62 * r).turned("z", 72 * n) for n in range(5)))
    veins = ring_of(unseen(box(0.3, 0.003, 0.4)), 0.0, 10).moved(z=-0.1)
    main = style.colour()
    return Build(
        parts=((body, main),),
        paint=((unseen(leaves), style.shade(main, 0.86)), (veins, style.shade(main, 1.2))),
        mass=0.9,
    )


@entry("corn", family="food", synonyms=("corn cob", "corn on the cob", "ear of corn", "cob of corn",
       "maize", "sweet corn"), plurals=("ears of corn", "corn cobs"), material="fruit",
       colours=("yellow",), accents=("lime",))  # fmt: skip
def corn(style: Style) -> Build:
    """A cob of corn lying down, its husk at the left."""
    n, r = length(style, 0.17), style.vary(0.023)
    t = np.linspace(0, 1, 25)
    profile = np.column_stack([r * np.sqrt(np.clip(1.02 - np.abs(2 * t - 0.75) ** 4 / 2.6, 0.12, 1)), n * (t - 0.5)])
    cob = lathe(profile, angles=(0.0, 25.0)).turned("y", 90).moved(z=r)
    low = -float(np.concatenate(cob.hulls)[:, 2].min())
    cob = cob.moved(z=low)
    lines = [box(0.0014, 1, 1).moved(x=x, z=-0.5) for x in np.arange(-0.34 * n, 0.5 * n, 0.0075)]
    rows = [box(1, 0.0012, 1).moved(z=-0.5).turned("x", turn).moved(z=r) for turn in range(0, 180, 15)]
    husk = lathe([(1.06 * r, -0.34 * n), (0.5 * r, -0.5 * n), (0.3 * r, -0.62 * n)][::-1], angles=(0.0, -25.0)).turned(
        "y", 90
    )
    husk = husk.moved(z=-float(np.concatenate(husk.hulls)[:, 2].min()))
    return Build(
        parts=((cob, style.colour()), (husk, style.colour(1))),
        paint=(
            (
                unseen(Shape(join(*lines, *rows).solid ^ box(0.84 * n, 1, 1).moved(x=0.1 * n, z=-0.4).solid, ())),
                style.shade(style.colour(), 0.8),
            ),
        ),
        mass=0.26,
    )


@entry("garlic", family="food", synonyms=("garlic bulb", "bulb of garlic", "head of garlic"),
       plurals=("heads of garlic",), material="fruit", colours=("white", "cream"))  # fmt: skip
def garlic(style: Style) -> Build:
    """A bulb of garlic with its cloves and a dry neck."""
    k = style.vary(1.0)
    points = [(0.014, 0), (0.027, 0.008), (0.03, 0.018), (0.016, 0.034), (0.005, 0.042), (0.0045, 0.058)]
    body = lobed(lathe(curve(points, 24), cuts=(0.036,)), 8, 0.07)
    lines = ring_of(unseen(box(0.1, 0.0014, 0.1)), 0.0, 8)
    return Build(
        parts=((body.scaled(k), style.colour()),), paint=((lines, style.shade(style.colour(), 0.82)),), mass=0.06
    )


@entry("chili pepper", family="food", synonyms=("chili", "chilli", "chilli pepper", "hot pepper", "jalapeno",
       "red chili"), material="fruit", colours=("red", "green"), accents=("green",))  # fmt: skip
def chili_pepper(style: Style) -> Build:
    """A curved pod lying flat with a green stalk."""
    n = length(style, 0.11)
    t = np.linspace(0, 1, 33)
    radius = 0.0092 * np.sqrt(np.clip(1 - t**2.2, 0.02, 1)) * np.clip(0.55 + 3 * t, 0, 1)
    path = np.column_stack([n * t, 0.24 * n * (t - 0.5) ** 2, np.maximum(radius, 0.0012)])
    stalk = np.column_stack(
        [np.linspace(-0.028, 0.003, 9), 0.06 * n * np.ones(9) + np.linspace(0.004, 0, 9), np.full(9, 0.005)]
    )
    body = tube(path, np.maximum(radius, 0.0012), 4)
    stem = tube(stalk, np.linspace(0.0022, 0.0042, 9), 1)
    return Build(parts=((body, style.colour()), (stem, LEAF)), mass=0.02)


@entry("radish", family="food", plurals=("radishes",), material="fruit", colours=("crimson", "burgundy"))
def radish(style: Style) -> Build:
    """A round root lying on its side, its root to the left, its stalks to the right."""
    k = style.vary(1.0)
    profile = _egg_profile(0.025, 0.021)
    root = rod((-0.02, 0, 0.0), (-0.052, 0, -0.009), 0.004, 0.0012, sides=6)
    stalks = join(
        *(rod((0.018, 0.3 * y, 0.0), (0.062, y, abs(y) - 0.005), 0.0025, sides=6) for y in (-0.012, 0.0, 0.012))
    )
    whole = join(lathe(profile).turned("y", 90), root, stalks)
    lean = rest_angle(profile, float(centre_of(whole)[0]))
    body = lathe(profile, angles=(lean,)).turned("y", 90)
    down = -float(np.concatenate(body.turned("y", lean).hulls)[:, 2].min())
    body, root, stalks = (shape.turned("y", lean).moved(z=down) for shape in (body, root, stalks))
    white = unseen(box(0.1, 1, 1)).moved(x=-0.072, z=-0.5)
    return Build(
        parts=((body.scaled(k), style.colour()), (root.scaled(k), CREAM), (stalks.scaled(k), LEAF)),
        paint=((white, CREAM),),
        mass=0.04,
    )


@entry("sweet potato", family="food", synonyms=("yam",), plurals=("sweet potatoes",), material="fruit",
       colours=("terracotta", "coral"))  # fmt: skip
def sweet_potato(style: Style) -> Build:
    """A long knobbly root, pointed at both ends."""
    n, r = length(style, 0.085), style.vary(0.032)
    points = style.rng.normal(size=(160, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    taper = np.column_stack(
        [np.sign(points[:, 0]) * np.abs(points[:, 0]) ** 1.0 * n, points[:, 1] * r, points[:, 2] * 0.9 * r]
    )
    body = lump(taper)
    low = float(np.concatenate(body.hulls)[:, 2].min())
    marks = _speckles(style, 14, (n, r, 0.9 * r), 0.004)
    return Build(parts=((body.moved(z=-low), style.colour()),), paint=((marks, style.shade(style.colour(), 0.7)),))


@entry(
    "celery",
    family="food",
    synonyms=("celery stalk", "stalk of celery", "leek", "green onion", "spring onion"),
    material="fruit",
    colours=("lime", "green"),
)
def celery(style: Style) -> Build:
    """A ribbed stalk lying down, pale at the left, leafy at the right."""
    n, r = length(style, 0.26), 0.014
    x = np.linspace(0, 1, 17)
    radius = np.interp(x, [0, 0.1, 0.8, 1], [1.2 * r, r, 0.8 * r, 0.6 * r])
    stem = tube(np.column_stack([n * (x - 0.5), 0 * x, 0.7 * radius]), radius, 2, flatness=0.7)
    leaves = join(
        *(
            ellipsoid(0.034, 0.014, 0.011).turned("z", turn).moved(0.5 * n + 0.018, y, 0.0112)
            for turn, y in ((28, 0.016), (-28, -0.016), (0, 0.0))
        )
    )
    leaves = leaves.moved(z=-float(np.concatenate(leaves.hulls)[:, 2].min()))
    pale = unseen(box(0.3 * n, 1, 1)).moved(x=-0.5 * n, z=-0.5)
    ribs = join(*(box(n, 0.0012, 0.2).moved(y=y, z=0.004) for y in (-0.007, -0.0035, 0.0, 0.0035, 0.007)))
    ribs = Shape(ribs.solid ^ box(0.96 * n, 1, 1).solid, ())
    main = style.colour()
    return Build(
        parts=((stem, main), (leaves, LEAF)),
        paint=((pale, style.shade(main, 1.25)), (ribs, style.shade(main, 0.82))),
        mass=0.06,
    )


@entry("ginger", family="food", synonyms=("ginger root", "piece of ginger"), material="fruit", colours=("tan", "beige"))
def ginger(style: Style) -> Build:
    """A knobbly root lying flat."""
    k = style.vary(1.0)
    knobs = (
        (0, 0, 0.017, 0.03, 10),
        (0.032, 0.008, 0.014, 0.022, 35),
        (-0.03, -0.006, 0.015, 0.022, -20),
        (0.008, 0.026, 0.011, 0.018, 80),
        (-0.018, -0.026, 0.01, 0.016, 100),
    )
    parts = []
    for x, y, r, n, turn in knobs:
        parts.append(_egg(n, r, r).turned("z", turn).moved(x, y))
    rings = join(*(box(0.0016, 1, 1).moved(x=x, z=-0.5) for x in np.linspace(-0.05, 0.05, 9)))
    return Build(
        parts=((join(*parts).scaled(k), style.colour()),),
        paint=((unseen(rings), style.shade(style.colour(), 0.82)),),
        mass=0.07,
    )


@entry("fig", family="food", material="fruit", colours=("purple", "indigo"))
def fig(style: Style) -> Build:
    """A fig standing on its round end."""
    k = style.vary(1.0)
    body = lobed(
        lathe(curve([(0.013, 0), (0.024, 0.012), (0.02, 0.03), (0.006, 0.048), (0.004, 0.056)], 22), cuts=(0.036,)),
        14,
        0.03,
    )
    return Build(
        parts=((body.scaled(k), style.colour()),), paint=((unseen(cone(0.3, 0.3)).moved(z=0.05 * k), LEAF),), mass=0.045
    )


@entry("walnut", family="food", synonyms=("chestnut",), material="wood", colours=("tan", "wood"))
def walnut(style: Style) -> Build:
    """A walnut in its shell, with the seam around it."""
    k = style.vary(1.0)
    body = _egg(0.021 * k, 0.017 * k, 0.0165 * k)
    seam = unseen(box(0.1, 0.0025, 0.1)).moved(z=-0.02)
    marks = _speckles(style, 26, (0.021 * k, 0.017 * k, 0.0165 * k), 0.0018)
    dark = style.shade(style.colour(), 0.75)
    return Build(parts=((body, style.colour()),), paint=((marks, dark), (seam, dark)), mass=0.012)
