"""Smooth solids with few convex parts: turned bodies, hollow vessels, bent tubes, extrusions.

Each function returns a `Shape` whose picture is fine and whose convex parts are coarser polyhedra
circumscribed about it, at most 64 vertices and 64 faces each. A turned body has few parts, which reach a
millimetre beyond it at most where six of them suffice (see `turned`), and it rests on the flat base of the lowest.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import manifold3d
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.spatial import ConvexHull

from pat3d.assets.shapes import SMOOTH_SEGMENTS, Shape, convex
from pat3d.assets.turned import MOST_CORNERS, allowed, between, outline, rings, turned_parts
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.normals import enclosed_volume
from pat3d.geometry.planes import enclosed

MOST_PLANES = 34
"""Of a part: three meet at each of its 64 corners."""

AT_ONCE = 2
"""Planes that are added to a part before its corners are looked at again."""

Profile = Sequence[tuple[float, float]]


def unseen(shape: Shape) -> Shape:
    """`shape` without convex parts of its own: details that another part of the object contains."""
    return Shape(shape.solid, ())


def spot(rx: float, ry: float | None = None, rz: float | None = None, segments: int = 12) -> Shape:
    """A coarse ellipsoid [m] at the origin without a convex part: seeds, petals, paint."""
    ry, rz = rx if ry is None else ry, rx if rz is None else rz
    return Shape(manifold3d.Manifold.sphere(1.0, segments).scale((rx, ry, rz)), ())


def curve(points: ArrayLike, count: int = 24) -> NDArray[np.float64]:
    """`count` points on a smooth curve through `points` [m], shape (n, d), evenly spread in its parameter."""
    array = np.asarray(points, dtype=np.float64)
    steps = np.linalg.norm(np.diff(array, axis=0), axis=1)
    parameter = np.concatenate([[0.0], np.cumsum(steps)])
    return CubicSpline(parameter, array)(np.linspace(0.0, parameter[-1], count))


def arc(radius: float, start: float, stop: float, count: int = 12) -> NDArray[np.float64]:
    """Points [m] of a circular arc about the origin between two angles [degrees], shape (count, 2)."""
    angle = np.radians(np.linspace(start, stop, count))
    return radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)


def wrapped(solid: manifold3d.Manifold, directions: ArrayLike) -> Shape:
    """A solid with one convex part: the half-spaces along `directions`, shape (n, 3), that touch it."""
    points = np.asarray(solid.to_mesh64().vert_properties)[:, :3]
    return Shape(solid, (circumscribed(points, np.asarray(directions, dtype=np.float64)),))


def lump(points: ArrayLike) -> Shape:
    """The convex hull of many points [m], shape (n, 3), in a part of at most 18 faces: loaves, potatoes."""
    solid = manifold3d.Manifold.hull_points(np.ascontiguousarray(points, dtype=np.float64))
    steps = [(i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1)]
    return wrapped(solid, [step for step in steps if 1 <= sum(map(abs, step)) <= 2])


def lathe(profile: ArrayLike, cuts: Sequence[float] = (), angles: Sequence[float] = (), sides: int = 0) -> Shape:
    """A solid of revolution about z.

    Args:
        profile: (radius, z) [m] from the bottom to the top, shape (n, 2); drawn as it is.
        cuts: heights [m] that divide the body into convex parts in any case (a bottle's shoulder).
        angles: slopes of planes beyond which no part between two cuts reaches [degrees], so that the body can lie on
            them: 0 is an upright wall, 45 faces up.
        sides: of the parts' rings, at least; 0 for as few as are allowed.
    """
    points = np.asarray(profile, dtype=np.float64).copy()
    points[:, 0] = np.maximum(points[:, 0], 0.0)
    line = np.concatenate([[(0.0, points[0, 1])], points, [(0.0, points[-1, 1])]])
    heights = [float(points[:, 1].min()), *cuts, float(points[:, 1].max())]
    return Shape(_revolved(line), tuple(turned_parts(points, heights, angles=angles, sides=sides)))


def rest_angle(profile: ArrayLike, centre: float | None = None) -> float:
    """Slope [degrees] of the side of a solid of revolution on which it rests when laid down; 0 is its widest ring.

    Args:
        profile: (radius, z) [m], shape (n, 2), z increasing.
        centre: z of the centre of mass [m]; None for that of the solid alone.
    """
    points = np.asarray(profile, dtype=np.float64)
    if centre is None:
        heights = np.linspace(points[0, 1], points[-1, 1], 200)
        share = np.interp(heights, points[:, 1], points[:, 0]) ** 2
        centre = float(share @ heights / share.sum())
    slopes = np.linspace(-60.0, 60.0, 481)
    turn = np.radians(slopes)
    # The centre of mass is lowest where it rests.
    height = (points @ np.stack([np.cos(turn), np.sin(turn)])).max(axis=0) - centre * np.sin(turn)
    return float(slopes[np.argmin(height)])


def centre_of(shape: Shape) -> NDArray[np.float64]:
    """Centre of mass of what is seen of a shape, of one density [m], shape (3,)."""
    mesh = shape.solid.to_mesh64()
    vertices = np.asarray(mesh.vert_properties)[:, :3]
    found = mass_properties(vertices, np.asarray(mesh.tri_verts, dtype=np.int32), density=1.0)
    return np.array(found.centre_of_mass)


def envelope(points: ArrayLike) -> NDArray[np.float64]:
    """Corners of a convex part of revolution about z around `points` [m], shape (n, 3)."""
    array = np.asarray(points, dtype=np.float64)
    reach = np.column_stack([np.hypot(array[:, 0], array[:, 1]), array[:, 2]])
    return rings(outline(reach[np.argsort(reach[:, 1], kind="stable")], 0.0, MOST_CORNERS // 16), 16)


def hollow(outer: Profile, inner: Profile, levels: Sequence[float] = (), segments: int = 12) -> Shape:
    """An open vessel of revolution about z, smooth to see: bowls, plates, mugs, vases.

    Args:
        outer: (radius, z) [m] of the outside, z strictly increasing from 0 to the rim.
        inner: (radius, z) [m] of the cavity, z strictly increasing from its floor to the same rim.
        levels: heights [m] that divide the wall into rows of convex parts.
        segments: parts around in a row; a divisor of 48. The cavity loses 1 - cos(pi / segments) of its radius.
    """
    rim, floor = outer[-1][1], inner[0][1]
    outside, inside = _radius_of(outer), _radius_of(inner)
    fine_outer = _sampled(outside, outer, 0.0, rim)
    fine_inner = _sampled(inside, inner, floor, rim)
    body = _revolved(np.concatenate([[(0.0, 0.0)], fine_outer, [(0.0, rim)]]))
    mouth = [(fine_inner[-1, 0], rim + 0.01), (0.0, rim + 0.01)]
    solid = body - _revolved(np.concatenate([[(0.0, floor)], fine_inner, mouth]))
    limit = allowed(max(rim, 2.0 * max(r for r, _ in outer)))
    hulls = turned_parts(between(fine_outer, 0.0, floor), (0.0, floor))
    heights = [floor, *levels, rim]
    step = 2 * math.pi / segments
    for low, high in zip(heights, heights[1:], strict=False):
        out = outline(between(fine_outer, low, high), 0.5 * limit, 4)
        into = _chord(between(fine_inner, low, high), outward=False)
        # The outside has the corners of the picture; the inside is flat.
        drawn = np.asarray(2 * math.pi / SMOOTH_SEGMENTS * np.arange(SMOOTH_SEGMENTS // segments + 1), dtype=np.float64)
        for k in range(segments):
            corners = [_ring(k * step + drawn, r, z) for r, z in out]
            corners += [
                _ring(np.array([k * step, (k + 1) * step]), r, z) for r, z in zip(into, (low, high), strict=True)
            ]
            hulls.append(np.concatenate(corners))
    return Shape(solid, tuple(hulls))


def clear_radius(inner: Profile, levels: Sequence[float] = (), segments: int = 12) -> float:
    """Radius [m] of the widest upright cylinder inside the cavity of `hollow`, from its floor to its rim."""
    heights = [inner[0][1], *levels, inner[-1][1]]
    fine = _sampled(_radius_of(inner), inner, heights[0], heights[-1])
    bands = zip(heights, heights[1:], strict=False)
    narrowest = min(float(_chord(between(fine, *band), outward=False).min()) for band in bands)
    return narrowest * math.cos(math.pi / segments)


def tube(
    path: ArrayLike,
    radius: float | ArrayLike,
    groups: int,
    *,
    up: tuple[float, float, float] = (0.0, 0.0, 1.0),
    closed: bool = False,
    sides: int = 8,
    flatness: float = 1.0,
    loose: bool = False,
) -> Shape:
    """A round bar along a planar curve: handles, spouts, bananas, rings.

    Args:
        path: centres [m], shape (n, 3), dense enough to look smooth.
        radius: [m], one value or shape (n,).
        groups: convex parts along the curve.
        up: normal of the curve's plane.
        closed: joins the last point to the first.
        sides: of each convex part's section, at least; more where a part would reach too far beyond the bar.
        flatness: height of the section along `up` over its width.
        loose: parts keep to `sides`, however far they reach beyond the bar, as a cover for other things.
    """
    centres = np.asarray(path, dtype=np.float64)
    count, around = len(centres), 16
    radii = np.broadcast_to(np.asarray(radius, dtype=np.float64), (count,))
    normal = np.asarray(up, dtype=np.float64) / np.linalg.norm(up)
    ahead, behind = (np.roll(centres, step, axis=0) for step in (-1, 1))
    tangents = ahead - behind if closed else np.gradient(centres, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    across = np.cross(normal, tangents)
    across /= np.linalg.norm(across, axis=1)[:, None]
    angle = 2 * np.pi * np.arange(around) / around
    spread = np.cos(angle)[None, :, None] * across[:, None] + flatness * np.sin(angle)[None, :, None] * normal
    circles = centres[:, None] + radii[:, None, None] * spread
    hulls = []
    limit = allowed(float(np.ptp(circles.reshape(-1, 3), axis=0).max()))
    bounds = np.linspace(0, count if closed else count - 1, groups + 1).round().astype(int)
    for first, last in zip(bounds, bounds[1:], strict=False):
        index = np.arange(first, last + 1) % count
        along = centres[index[-1]] - centres[index[0]]
        along = along / np.linalg.norm(along)
        side = np.cross(normal, along)
        turn = 2 * np.pi * np.arange(sides) / sides
        directions = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * normal
        directions = np.concatenate([directions, [tangents[index[-1]], -tangents[index[0]]]])
        hulls.append(_snug(circles[index].reshape(-1, 3), directions, math.inf if loose else 0.8 * limit))
    return Shape(_skin(circles, centres, closed), tuple(hulls))


def extruded(outline: ArrayLike, height: float, sides: int = 8) -> Shape:
    """A convex outline [m], shape (n, 2), raised from z = 0 to `height`, in one part with `sides` walls."""
    section = manifold3d.CrossSection([np.asarray(outline, dtype=np.float64)])
    turn = 2 * np.pi * np.arange(sides) / sides
    walls = np.stack([np.cos(turn), np.sin(turn), np.zeros(sides)], axis=1)
    return wrapped(manifold3d.Manifold.extrude(section, height), [*walls, (0, 0, 1), (0, 0, -1)])


def slab(x: float, y: float, z: float, corner: float) -> Shape:
    """A board [m] standing on z = 0 whose upright edges are rounded by `corner`."""
    return extruded(rounded_rectangle(x, y, corner), z)


def rounded_rectangle(x: float, y: float, corner: float) -> NDArray[np.float64]:
    """Counter-clockwise outline [m] of a rectangle with round corners, shape (n, 2)."""
    pieces = []
    for k, (i, j) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        centre = np.array([i * (x / 2 - corner), j * (y / 2 - corner)])
        pieces.append(centre + arc(corner, 90.0 * k, 90.0 * (k + 1), 7))
    return np.concatenate(pieces)


def ring_of(shape: Shape, radius: float, count: int, start: float = 0.0) -> Shape:
    """`count` copies of `shape` around z at `radius` [m], turned outwards, the first at `start` [degrees]."""
    return merged([shape.moved(x=radius).turned("z", start + 360.0 * k / count) for k in range(count)])


def merged(shapes: Sequence[Shape]) -> Shape:
    """The same as `join`, in one go: fast for hundreds of small shapes."""
    solid = manifold3d.Manifold.batch_boolean([shape.solid for shape in shapes], manifold3d.OpType.Add)
    return Shape(solid, tuple(points for shape in shapes for points in shape.hulls))


def taper(bottom: tuple[float, float], top: tuple[float, float], height: float) -> Shape:
    """A block [m] standing on z = 0 between rectangles of sizes `bottom` and `top`."""
    levels = ((bottom, 0.0), (top, height))
    return convex([(i * x / 2, j * y / 2, z) for (x, y), z in levels for i in (-1, 1) for j in (-1, 1)])


def lobed(shape: Shape, lobes: int, depth: float) -> Shape:
    """`shape` with `lobes` grooves around z, pressed in by `depth` of the radius; the parts stay as they are."""

    def press(points: NDArray[np.float64]) -> NDArray[np.float64]:
        turn = np.arctan2(points[:, 1], points[:, 0])
        factor = 1.0 - depth * (0.5 + 0.5 * np.cos(lobes * turn)) ** 2
        return points * np.column_stack([factor, factor, np.ones(len(points))])

    return Shape(shape.solid.warp_batch(press), shape.hulls)


def covered(pieces: Sequence[Shape], cover: Shape) -> tuple[Shape, ...]:
    """`pieces` for the picture with the convex parts of `cover`, which contains them, as their only parts."""
    first, *others = pieces
    return (Shape(first.solid, cover.hulls), *(unseen(piece) for piece in others))


def circumscribed(points: NDArray[np.float64], directions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the polyhedron of half-spaces along `directions` that touch `points`."""
    directions = directions / np.linalg.norm(directions, axis=1)[:, None]
    reach = (points @ directions.T).max(axis=0)
    return enclosed(np.column_stack([directions, -reach]), points.mean(axis=0))


def _snug(points: NDArray[np.float64], directions: NDArray[np.float64], limit: float) -> NDArray[np.float64]:
    """`circumscribed`, with planes of the hull's faces added that cut off corners over `limit` [m] beyond it."""
    equations = np.unique(np.round(ConvexHull(points).equations, 9), axis=0)
    while True:
        corners = circumscribed(points, directions)
        beyond = corners @ equations[:, :3].T + equations[:, 3]
        far = np.argsort(-beyond.max(axis=1))
        far = far[beyond.max(axis=1)[far] > limit]
        room = min(MOST_PLANES - len(directions), AT_ONCE)
        if not len(far) or room <= 0:
            return corners
        faces = list(dict.fromkeys(beyond.argmax(axis=1)[far].tolist()))[:room]
        directions = np.concatenate([directions, equations[faces, :3]])


def _ring(turn: NDArray[np.float64], radius: float, z: float) -> NDArray[np.float64]:
    """Points [m] of a circle about z at angles [rad]."""
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), np.full(len(turn), z)])


def _chord(points: NDArray[np.float64], outward: bool) -> NDArray[np.float64]:
    """Radii at the lowest and highest z of the line, parallel to the end points' chord, beyond all points."""
    low, high = points[np.argmin(points[:, 1])], points[np.argmax(points[:, 1])]
    line = low[0] + (points[:, 1] - low[1]) / (high[1] - low[1]) * (high[0] - low[0])
    gap = points[:, 0] - line
    shift = max(0.0, float(gap.max())) if outward else min(0.0, float(gap.min()))
    return np.array([low[0] + shift, high[0] + shift])


def _radius_of(profile: Profile) -> PchipInterpolator:
    points = np.asarray(profile, dtype=np.float64)
    return PchipInterpolator(points[:, 1], points[:, 0])


def _sampled(radius: PchipInterpolator, profile: Profile, low: float, high: float) -> NDArray[np.float64]:
    heights = np.linspace(low, high, 2 if len(profile) == 2 else 16)
    heights = np.unique(np.concatenate([heights, [z for _, z in profile]]))
    return np.column_stack([radius(heights), heights])


def _revolved(outline: ArrayLike) -> manifold3d.Manifold:
    points = np.asarray(outline, dtype=np.float64)
    distinct = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) > 1e-9
    section = manifold3d.CrossSection([points[distinct]], manifold3d.FillRule.NonZero)
    return manifold3d.Manifold.revolve(section, SMOOTH_SEGMENTS)


def _skin(rings: NDArray[np.float64], centres: NDArray[np.float64], closed: bool) -> manifold3d.Manifold:
    """The solid bounded by rings of points, shape (n, around, 3), closed by fans or onto itself."""
    count, around = rings.shape[:2]
    vertices = rings.reshape(-1, 3)
    i, j = np.meshgrid(np.arange(count if closed else count - 1), np.arange(around), indexing="ij")
    a, b = (i * around + j).ravel(), (i * around + (j + 1) % around).ravel()
    after = (i + 1) % count
    c, d = (after * around + j).ravel(), (after * around + (j + 1) % around).ravel()
    faces = [np.column_stack([a, b, d]), np.column_stack([a, d, c])]
    if not closed:
        vertices = np.concatenate([vertices, centres[[0, -1]]])
        k = np.arange(around)
        first, last = count * around, count * around + 1
        final = (count - 1) * around
        faces.append(np.column_stack([np.full(around, first), (k + 1) % around, k]))
        faces.append(np.column_stack([np.full(around, last), final + k, final + (k + 1) % around]))
    triangles = np.concatenate(faces)
    if enclosed_volume(vertices[triangles]) < 0:
        triangles = triangles[:, ::-1]
    mesh = manifold3d.Mesh64(np.ascontiguousarray(vertices), np.ascontiguousarray(triangles, dtype=np.uint64))
    return manifold3d.Manifold(mesh)
