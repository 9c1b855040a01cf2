"""What recipes of furniture and tools share: spans, pads, legs, regions, and cheap convex parts.

The parts made here keep contact simple: a padded box or a book looks soft or detailed, yet is simulated
as the one exact box around it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import HalfspaceIntersection

from pat3d.assets.catalogue.registry import RGB, Style
from pat3d.assets.colours import COLOURS
from pat3d.assets.rounded import arc, lathe
from pat3d.assets.shapes import THIN, Shape, box, convex, cylinder, frustum, join, soft_box, turned_solid
from pat3d.assets.turned import sides_of
from pat3d.scene.asset import Region

Range = tuple[float, float]

WHITE: RGB = COLOURS["white"]
BLACK: RGB = COLOURS["black"]
GRAY: RGB = COLOURS["gray"]
STEEL: RGB = COLOURS["steel"]
GOLD: RGB = COLOURS["gold"]
WOOD: RGB = COLOURS["wood"]
CREAM: RGB = COLOURS["cream"]
BROWN: RGB = COLOURS["brown"]
RED: RGB = COLOURS["red"]


def span(x: Range, y: Range, z: Range) -> Shape:
    """The box between the given bounds [m]."""
    size = (x[1] - x[0], y[1] - y[0], z[1] - z[0])
    return box(*size).moved((x[0] + x[1]) / 2, (y[0] + y[1]) / 2, z[0])


def dressed(looks: Shape, parts: Shape) -> Shape:
    """`looks` to the eye, simulated with the convex parts of `parts`, which must contain it."""
    return Shape(looks.solid, parts.hulls)


def drawn(shape: Shape) -> Shape:
    """`shape` to the eye alone: for detail that lies inside the convex parts of something else."""
    return Shape(shape.solid, ())


def cut(shape: Shape, *holes: Shape) -> Shape:
    """`shape` with `holes` cut into its looks; its convex parts stay as they are."""
    solid = shape.solid
    for hole in holes:
        solid = solid - hole.solid
    return Shape(solid, shape.hulls)


def padded(x: float, y: float, z: float, radius: float) -> Shape:
    """A box that looks rounded by `radius` [m], standing on z = 0 and simulated as the exact box."""
    return dressed(soft_box(x, y, z, radius), box(x, y, z))


def puck(radius: float, height: float, edge: float) -> Shape:
    """A round pad whose rim looks rounded by `edge` [m], simulated as one prism."""
    steps = [math.radians(angle) for angle in (0, 22.5, 45, 67.5, 90)]
    side = [(radius - edge + edge * math.sin(a), edge - edge * math.cos(a)) for a in steps]
    top = [(r, height - z) for r, z in reversed(side)]
    return dressed(turned_solid([*side, *top]), cylinder(radius, height))


def fronted(x: Range, y: Range, z: Range, panels: Sequence[tuple[Range, Range]]) -> tuple[Shape, Shape]:
    """A carcass [m] simulated as one box, and its doors or drawers: `panels` are (x, z) ranges of the front."""
    carcass = dressed(span(x, (y[0] + 0.006, y[1]), z), span(x, y, z))
    fronts = together([span(across, (y[0], y[0] + 0.01), up) for across, up in panels])
    return carcass, drawn(fronts)


def grid(x: Range, z: Range, columns: int, rows: int, gap: float) -> list[tuple[Range, Range]]:
    """Panels [m] that fill x by z in columns and rows, `gap` apart and from the border."""
    dx, dz = (x[1] - x[0] - gap) / columns, (z[1] - z[0] - gap) / rows
    return [
        ((x[0] + gap + i * dx, x[0] + (i + 1) * dx), (z[0] + gap + j * dz, z[0] + (j + 1) * dz))
        for j in range(rows)
        for i in range(columns)
    ]


def strut(bottom: Range, top: Range, z: Range, half: float, top_half: float | None = None) -> Shape:
    """A square bar that may lean, with level ends at heights `z`, centred on `bottom` and `top` [m]."""
    points = []
    for (x, y), height, size in ((bottom, z[0], half), (top, z[1], half if top_half is None else top_half)):
        points += [(x + i * size, y + j * size, height) for i in (-1, 1) for j in (-1, 1)]
    return convex(points)


def legs(x: float, y: float, height: float, thick: float) -> Shape:
    """Four upright square legs [m] whose outer faces span x by y."""
    i, j = (x - thick) / 2, (y - thick) / 2
    return join(*(box(thick, thick, height).moved(a * i, b * j) for a in (-1, 1) for b in (-1, 1)))


def splayed_legs(x: float, y: float, height: float, half: float, splay: float) -> Shape:
    """Four legs leaning outwards by `splay` [m]; their feet's outer edges span x by y."""
    i, j = x / 2 - half, y / 2 - half
    return join(
        *(
            strut((a * i, b * j), (a * (i - splay), b * (j - splay)), (0.0, height), half * 0.7, half)
            for a in (-1, 1)
            for b in (-1, 1)
        )
    )


def lying(radius: float, length: float, end_radius: float | None = None, sides: int = 0) -> Shape:
    """A round bar along x [m], centred on x = 0, lying on z = 0 with a flat of its convex part below."""
    sides = sides or sides_of(max(radius, end_radius or 0.0), THIN, 12)
    bar = frustum(radius, radius if end_radius is None else end_radius, length, sides)
    return bar.turned("z", 180 / sides).turned("y", 90).moved(x=-length / 2, z=radius)


def dial(radius: float, length: float, sides: int = 0) -> Shape:
    """A round bar along y [m], from y = 0 towards the front, centred on x = z = 0."""
    sides = sides or sides_of(radius, THIN, 12)
    return cylinder(radius, length, sides).turned("z", 180 / sides).turned("x", 90)


def spot(radius: float, height: float) -> Shape:
    """A coarse upright cylinder [m] to paint small round keys with."""
    return Shape(manifold3d.Manifold.cylinder(height, radius, radius, 16), ())


def leaning(shape: Shape, slope: float) -> Shape:
    """The shape sheared backwards: y grows by `slope` times z."""
    return shape.transformed(np.array([[1.0, 0.0, 0.0], [0.0, 1.0, slope], [0.0, 0.0, 1.0]]))


def wrapped(shape: Shape) -> Shape:
    """A convex shape with one part: the polytope of its 18 support planes along axes and box edges."""
    axes = [np.eye(3)[i] * s for i in range(3) for s in (-1, 1)]
    edges = [np.roll((a, b, 0.0), k) for a in (-1, 1) for b in (-1, 1) for k in range(3)]
    points = np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3]
    low, high = points.min(axis=0), points.max(axis=0)
    # Planes are taken in the unit cube, so that flat things are cut across their edges too.
    unit = (points - low) / (high - low)
    planes = np.array([[*normal, -float((unit @ normal).max())] for normal in (*axes, *edges)])
    corners = HalfspaceIntersection(planes, np.array([0.5, 0.5, 0.5])).intersections
    corners = np.unique(np.round(corners, 12), axis=0)
    corners[np.abs(corners) < 1e-9] = 0.0
    return Shape(shape.solid, (low + corners * (high - low),))


def trimmed(shape: Shape, floor: float = 0.0) -> Shape:
    """The part of a convex shape above z = `floor`, as one convex part."""
    return wrapped(Shape(shape.solid.trim_by_plane((0.0, 0.0, 1.0), floor), shape.hulls))


def resting_ball(radius: float, x: float = 0.0, y: float = 0.0) -> Shape:
    """A ball on z = 0, lying on the flat base of its lowest part."""
    return lathe(arc(radius, -90, 90, 49)).moved(x, y, radius)


def blade(points: NDArray[np.float64] | Sequence[Sequence[float]], thickness: float) -> Shape:
    """A thin convex leaf through `points` [m], thickened along the vertical."""
    array = np.asarray(points, dtype=np.float64)
    return convex(np.concatenate([array - (0, 0, thickness / 2), array + (0, 0, thickness / 2)]))


def together(shapes: Sequence[Shape]) -> Shape:
    """Many shapes as one, joined at once; for grids of keys or ticks."""
    solid = manifold3d.Manifold.batch_boolean([shape.solid for shape in shapes], manifold3d.OpType.Add)
    return Shape(solid, tuple(points for shape in shapes for points in shape.hulls))


def shelf_top(
    half_x: float, half_y: float, z: float, *, at: Range = (0.0, 0.0), height: float = math.inf, enclosed: bool = False
) -> Region:
    """A rectangle to put things on, at height `z` [m]."""
    return Region(
        kind="on", shape="rectangle", floor=(*at, z), half_size=(half_x, half_y), height=height, enclosed=enclosed
    )


def disc_top(radius: float, z: float) -> Region:
    """A disc to put things on, at height `z` [m]."""
    return Region(kind="on", shape="disc", floor=(0.0, 0.0, z), half_size=(radius, radius))


def cavity(
    half_x: float, half_y: float, z: float, height: float, *, round_: bool = False, at: Range = (0.0, 0.0)
) -> Region:
    """The free space of an open container above its floor at `z` [m]."""
    return Region(
        kind="in",
        shape="disc" if round_ else "rectangle",
        floor=(*at, z),
        half_size=(half_x, half_y),
        height=height,
    )


def stretch(style: Style) -> tuple[float, float, float]:
    """Factors on width, depth and height that the adjectives ask for."""
    words = style.adjectives
    wide = 1.35 if words & {"long", "wide"} else 0.75 if words & {"narrow", "short"} else 1.0
    tall = 1.3 if words & {"tall", "high"} else 0.7 if words & {"low"} else 1.0
    return wide, 1.25 if "deep" in words else 1.0, tall
