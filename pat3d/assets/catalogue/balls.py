"""Small and heavy balls of games."""

from __future__ import annotations

import math

from pat3d.assets.catalogue.joinery import (
    BLACK,
    resting_ball,
    together,
)
from pat3d.assets.catalogue.registry import Build, Style, entry
from pat3d.assets.rounded import merged, spot, tube, unseen
from pat3d.assets.shapes import Shape, box, cylinder


@entry("golf ball", family="basics", material="plastic", colours=("white", "orange"))
def golf_ball(style: Style) -> Build:
    """A golf ball: 42.7 mm, 46 g, with dimples."""
    r = style.vary(0.02135, 0.003)
    golden = math.pi * (3 - math.sqrt(5))
    dimples = []
    for k in range(130):
        z = 1 - 2 * (k + 0.5) / 130
        turn, flat = golden * k, math.sqrt(1 - z * z)
        x, y, up = (1.005 * r * part for part in (flat * math.cos(turn), flat * math.sin(turn), 1 + z))
        dimples.append(spot(0.0012).moved(x, y, up))
    marks = merged(dimples)
    return Build(
        parts=((resting_ball(r), style.colour()),), paint=((marks, style.shade(style.colour(), 0.82)),), mass=0.046
    )


@entry(
    "racquetball",
    family="basics",
    material="rubber",
    colours=("blue", "black"),
    synonyms=("squash ball", "rubber ball"),
)
def racquetball(style: Style) -> Build:
    """A hollow rubber ball: 55.3 mm, 41 g, with its seam."""
    r = style.vary(0.02765, 0.005)
    seam = unseen(box(1, 1, 0.0012)).turned("x", 24).moved(z=r)
    return Build(
        parts=((resting_ball(r), style.colour()),), paint=((seam, style.shade(style.colour(), 0.7)),), mass=0.041
    )


@entry(
    "ping pong ball", family="basics", material="plastic", colours=("white", "orange"), synonyms=("table tennis ball",)
)
def ping_pong_ball(style: Style) -> Build:
    """A table tennis ball: 40 mm, 2.7 g."""
    r = style.vary(0.02, 0.005)
    return Build(parts=((resting_ball(r), style.colour()),), mass=0.0027)


@entry("marble", family="basics", material="glass", colours=("blue", "green", "red", "orange"),
       synonyms=("glass marble",), accents=("white",))  # fmt: skip
def marble(style: Style) -> Build:
    """A large glass marble with a swirl."""
    r = style.vary(0.0125, 0.05)
    swirl = tube([(-0.03, -0.004, r), (0, 0.004, r + 0.005), (0.03, -0.004, r + 0.01)], 0.004, 1, up=(0, 0.5, 1))
    return Build(parts=((resting_ball(r), style.colour()),), paint=((unseen(swirl), style.colour(1)),))


@entry("pool ball", family="basics", material="plastic", colours=("red", "yellow", "blue", "purple", "green"),
       accents=("white",), synonyms=("billiard ball", "snooker ball", "eight ball", "cue ball"))  # fmt: skip
def pool_ball(style: Style) -> Build:
    """A pool ball: 57 mm, 165 g, its number's white disc to the front."""
    r = style.vary(0.0286, 0.005)
    spot_ = Shape(cylinder(0.42 * r, 1).turned("x", 90).solid, ()).moved(z=1.15 * r)
    bar = unseen(box(0.1 * r, 1, 0.46 * r)).moved(y=-0.5, z=0.92 * r)
    return Build(parts=((resting_ball(r), style.colour()),), paint=((spot_, style.colour(1)), (bar, BLACK)), mass=0.165)


@entry("bowling ball", family="basics", material="plastic", colours=("blue", "black", "purple", "red"))
def bowling_ball(style: Style) -> Build:
    """A bowling ball: 216 mm, 5.4 kg, with three finger holes to the eye."""
    r = style.vary(0.108, 0.005)
    body = resting_ball(r)
    holes = [
        cylinder(0.013, 0.06).moved(x, y, 2 * r - 0.05) for x, y in ((-0.018, 0.012), (0.018, 0.012), (0.0, -0.03))
    ]
    solid = body.solid - together([Shape(hole.solid, ()) for hole in holes]).solid
    return Build(parts=((Shape(solid, body.hulls), style.colour()),), mass=style.vary(5.4))
