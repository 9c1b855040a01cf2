"""What the recipes of animals and figures share: flat bases, pairs of limbs, faces, lighter shades."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import manifold3d
import numpy as np
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue.registry import RGB, Build, Style
from pat3d.assets.shapes import Shape, convex, ellipsoid, join
from pat3d.geometry.rotations import frame_along
from pat3d.scene.asset import Region

DARK: RGB = (34, 30, 32)
"""Eyes, noses, tyres."""
WHITE: RGB = (240, 238, 233)

Coloured = tuple[Shape, RGB]


def pair(shape: Shape) -> Shape:
    """`shape` and its mirror image on the other side of the body (in the plane x = 0)."""
    return join(shape, shape.mirrored("x"))


def grounded(*parts: Coloured) -> tuple[Coloured, ...]:
    """The parts cut off flat at z = 0."""
    return tuple((shape.cut_below(0.0), colour) for shape, colour in parts)


def tint(colour: RGB, amount: float = 0.5) -> RGB:
    """`colour` mixed with `amount` of cream white: bellies and muzzles."""
    return tuple(round(c + amount * (w - c)) for c, w in zip(colour, (250, 244, 232), strict=True))  # type: ignore[return-value]


def eye_colour(coat: RGB) -> RGB:
    """A dark eye, or an amber one on a dark coat."""
    return DARK if sum(coat) > 210 else (222, 168, 66)


def on_top(shape: Shape, radius: float) -> Region:
    """A round place [m] for children on the highest point of a shape's convex parts."""
    points = np.concatenate(shape.hulls)
    top = points[points[:, 2] > points[:, 2].max() - 1e-6].mean(axis=0)
    centre = 0.5 * (points.min(axis=0) + points.max(axis=0))
    return Region(
        kind="on",
        shape="disc",
        floor=(float(centre[0]), float(centre[1]), float(top[2])),
        half_size=(radius, radius),
    )


def dots(x: float, y: float, z: float, radius: float) -> Shape:
    """A pair of balls to paint a pair of eyes with."""
    return pair(ellipsoid(radius).moved(x, y, z))


def legs(x: float, front: float, back: float, height: float, radius: float) -> Shape:
    """Four upright legs [m] standing on z = 0 at +-x, y = -front and y = back, rounded off at `height`."""
    leg = limb((0.0, 0.0, 0.0), (0.0, 0.0, height - radius), radius).cut_below(0.0)
    return join(*(leg.moved(side * x, y) for side in (-1, 1) for y in (-front, back)))


def young(style: Style) -> bool:
    """Whether a baby animal was asked for: smaller, with a larger head."""
    return bool(style.adjectives & {"baby", "young", "newborn"})


def egg(size: Sequence[float], at: Sequence[float], nod: float = 0.0) -> Shape:
    """An ellipsoid with semi-axes `size` [m], its front tilted down by `nod` degrees, centred at `at`."""
    return ellipsoid(*size).turned("x", nod).moved(*at)


def surface_y(size: Sequence[float], at: Sequence[float], x: float, z: float) -> float:
    """The y [m] at which the front of the upright ellipsoid `egg(size, at)` passes over (x, z)."""
    rest = 1.0 - ((x - at[0]) / size[0]) ** 2 - ((z - at[2]) / size[2]) ** 2
    return at[1] - size[1] * float(np.sqrt(max(rest, 0.0)))


def eyes(size: Sequence[float], at: Sequence[float], x: float, z: float, radius: float) -> Shape:
    """A pair of balls centred on the front of the head `egg(size, at)`, to paint its eyes with."""
    return dots(x, surface_y(size, at, x, z), z, radius)


def limb(start: Sequence[float], end: Sequence[float], radius: float, end_radius: float | None = None) -> Shape:
    """A round-ended, tapering limb between two ball centres [m]; one convex part.

    The part is the hull of two balls' circumscribed prisms: an octagon in profile, eight-sided about
    the axis, six-sided where the radii differ and more rings are needed.
    """
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    radii = (radius, radius if end_radius is None else end_radius)
    length = float(np.linalg.norm(b - a))
    balls = [
        manifold3d.Manifold.sphere(r, 32).translate((0.0, 0.0, z)) for r, z in zip(radii, (0.0, length), strict=True)
    ]
    sides = 8 if radii[0] == radii[1] else 6
    angle = 2.0 * np.pi * (np.arange(sides) + 0.5) / sides
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=1) / np.cos(np.pi / sides)
    chamfer = np.sqrt(2.0) - 1.0
    levels = [
        (r * wide, z + r * up)
        for r, z in zip(radii, (0.0, length), strict=True)
        for wide, up in ((chamfer, -1.0), (1.0, -chamfer), (1.0, chamfer), (chamfer, 1.0))
    ]
    points = np.concatenate([np.column_stack([ring * r, np.full(sides, z)]) for r, z in levels])
    shape = Shape(manifold3d.Manifold.batch_hull(balls), (points[_extreme(points)],))
    direction = (b - a) / length
    return shape.transformed(frame_along(direction), a.tolist())


def _extreme(points: np.ndarray) -> np.ndarray:
    """Indices of the corners of the hull, without points that only rounding lifts off a face."""
    centre = points.mean(axis=0)
    corners = ConvexHull(points).vertices
    kept = list(corners)
    for index in corners:
        others = [k for k in kept if k != index]
        equations = ConvexHull(points[others]).equations
        if np.max(equations[:, :3] @ (centre + (points[index] - centre) * (1 - 1e-9)) + equations[:, 3]) <= 0:
            kept = others
    return np.array(kept)


def finish(
    style: Style,
    parts: Sequence[Coloured],
    *,
    paint: Sequence[Coloured] = (),
    regions: Sequence[Region] = (),
    mass: float | None = None,
    size: float = 1.0,
    spread: float = 0.04,
) -> Build:
    """A build with a flat base at z = 0, scaled by `size` and stretched a little by seed along each axis."""
    sx, sy, sz = (size * style.vary(1.0, spread) for _ in range(3))
    return Build(
        parts=tuple((shape.scaled(sx, sy, sz), colour) for shape, colour in grounded(*parts)),
        paint=tuple((shape.scaled(sx, sy, sz), colour) for shape, colour in paint),
        regions=tuple(
            replace(
                region,
                floor=(region.floor[0] * sx, region.floor[1] * sy, region.floor[2] * sz),
                half_size=(region.half_size[0] * min(sx, sy), region.half_size[1] * min(sx, sy)),
                height=region.height * sz,
            )
            for region in regions
        ),
        mass=None if mass is None else mass * sx * sy * sz,
    )


def foot(x: float, y: float, wide: float, long: float, thick: float) -> Shape:
    """A flat three-toed foot [m]: a wedge that widens to the front."""
    outline = [
        (x - wide * 0.3, y + long * 0.5),
        (x + wide * 0.3, y + long * 0.5),
        (x + wide, y - long * 0.5),
        (x - wide, y - long * 0.5),
    ]
    return convex([(px, py, z) for px, py in outline for z in (0.0, thick)])
