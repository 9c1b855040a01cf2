"""Solid modelling for the catalogue: shapes that know both how they look and their exact convex parts.

A `Shape` pairs a smooth closed solid (for looks and mass) with convex polyhedra whose union contains
it (for contact). Round shapes are circumscribed by polyhedra of at most 64 vertices and 64
faces; polyhedral shapes are their own part. Shapes are placed with `moved`, `turned` and `scaled`, which keep
the containment, and joined by listing them: the asset's visual mesh is the boolean union.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

from pat3d.assets.turned import sides_of
from pat3d.errors import AssetError
from pat3d.geometry.rotations import about, frame_along

Vector = tuple[float, float, float]

SMOOTH_SEGMENTS = 48
"""Segments of a full circle in visual meshes."""

THIN = 5e-4
"""Corners of bars may be this far beyond the circle [m]: what lies or is held, and stands on nothing."""


@dataclass(frozen=True, eq=False)
class Shape:
    """A closed solid and convex polyhedra that contain it."""

    solid: manifold3d.Manifold
    hulls: tuple[NDArray[np.float64], ...]
    """Points of each convex part [m], shape (n, 3)."""

    def transformed(
        self, linear: NDArray[np.float64], offset: Sequence[float] | NDArray[np.float64] = (0.0, 0.0, 0.0)
    ) -> Shape:
        """The shape mapped by x -> linear x + offset; `linear` has shape (3, 3)."""
        affine = np.column_stack([linear, np.asarray(offset, dtype=np.float64)])
        hulls = tuple(points @ np.asarray(linear).T + np.asarray(offset) for points in self.hulls)
        return Shape(self.solid.transform(np.ascontiguousarray(affine)), hulls)

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Shape:
        """The shape translated [m]."""
        return self.transformed(np.eye(3), (x, y, z))

    def turned(self, axis: Literal["x", "y", "z"], degrees: float) -> Shape:
        """The shape rotated about an axis through the origin."""
        return self.transformed(about(axis, math.radians(degrees)))

    def scaled(self, x: float, y: float | None = None, z: float | None = None) -> Shape:
        """The shape stretched about the origin; one value scales uniformly."""
        return self.transformed(np.diag([x, x if y is None else y, x if z is None else z]))

    def mirrored(self, axis: Literal["x", "y", "z"]) -> Shape:
        """The shape reflected in the plane through the origin normal to `axis`."""
        return self.transformed(np.diag([-1.0 if name == axis else 1.0 for name in "xyz"]))

    def cut_below(self, z: float) -> Shape:
        """The part above height `z` [m]: round things get a flat base to stand on.

        A convex part with corners too many or too close together gets a simpler, slightly larger base.
        """
        hulls = tuple(_clipped(points, z) for points in self.hulls if points[:, 2].max() > z + 1e-6)
        return Shape(self.solid.trim_by_plane((0.0, 0.0, 1.0), z), hulls)

    def cut_above(self, z: float) -> Shape:
        """The part below height `z` [m]."""
        return self.mirrored("z").cut_below(-z).mirrored("z")


def join(*shapes: Shape) -> Shape:
    """One shape of several (of one colour)."""
    solid = shapes[0].solid
    for shape in shapes[1:]:
        solid = solid + shape.solid
    return Shape(solid, tuple(points for shape in shapes for points in shape.hulls))


def box(x: float, y: float, z: float) -> Shape:
    """A box of the given sizes [m], standing on z = 0, centred in x and y."""
    solid = manifold3d.Manifold.cube((x, y, z)).translate((-x / 2, -y / 2, 0.0))
    corners = np.array([[i, j, k] for i in (-x / 2, x / 2) for j in (-y / 2, y / 2) for k in (0.0, z)])
    return Shape(solid, (corners,))


def convex(points: Sequence[Sequence[float]] | NDArray[np.float64]) -> Shape:
    """The convex hull of a few points [m], shape (n, 3); looks faceted."""
    array = np.ascontiguousarray(points, dtype=np.float64)
    return Shape(manifold3d.Manifold.hull_points(array), (array[ConvexHull(array).vertices],))


def soft_box(x: float, y: float, z: float, radius: float) -> Shape:
    """A box with edges rounded by `radius` [m], standing on z = 0: cushions, soap, phones.

    Its convex part is the box with chamfered edges that circumscribes the rounding.
    """
    radius = min(radius, 0.499 * min(x, y, z))
    inner = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], dtype=np.float64)
    inner *= np.array([x / 2 - radius, y / 2 - radius, z / 2 - radius])
    ball = _sphere_points(radius, 16)
    points = (inner[:, None, :] + ball[None, :, :]).reshape(-1, 3)
    points[:, 2] += z / 2
    # A 45 degree chamfer tangent to the rounding meets each face this far inside its edge.
    cut = radius * (2.0 - math.sqrt(2.0))
    half = np.array([x, y, z]) / 2
    chamfered = []
    for axis in range(3):
        for corner in inner:
            point = np.sign(corner) * (half - cut)
            point[axis] = np.sign(corner[axis]) * half[axis]
            chamfered.append(point + (0.0, 0.0, z / 2))
    return Shape(manifold3d.Manifold.hull_points(np.ascontiguousarray(points)), (np.array(chamfered),))


def frustum(bottom: float, top: float, height: float, sides: int = 0) -> Shape:
    """A cone frustum with bottom and top radii [m], standing on z = 0, axis along z.

    Its part has `sides` sides; 0 for 16 or more, so that it reaches 0.2 mm beyond the circles at most, if 32 suffice.
    """
    sides = sides or sides_of(max(bottom, top))
    solid = manifold3d.Manifold.cylinder(height, bottom, top, SMOOTH_SEGMENTS)
    angle = 2.0 * np.pi * np.arange(sides) / sides
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(sides)], axis=1) / math.cos(math.pi / sides)
    rings = [
        ring * (max(bottom, 1e-4), max(bottom, 1e-4), 0),
        ring * (max(top, 1e-4), max(top, 1e-4), 0) + (0, 0, height),
    ]
    return Shape(solid, (np.concatenate(rings),))


def cylinder(radius: float, height: float, sides: int = 0) -> Shape:
    """An upright cylinder [m] standing on z = 0."""
    return frustum(radius, radius, height, sides)


def cone(radius: float, height: float, sides: int = 0) -> Shape:
    """An upright cone [m] standing on z = 0."""
    return frustum(radius, 0.0, height, sides)


def ellipsoid(rx: float, ry: float | None = None, rz: float | None = None) -> Shape:
    """An ellipsoid with semi-axes [m] centred at the origin; one value makes a sphere."""
    ry = rx if ry is None else ry
    rz = rx if rz is None else rz
    solid = manifold3d.Manifold.sphere(1.0, SMOOTH_SEGMENTS)
    return Shape(solid, (_circumscribed_ball(),)).scaled(rx, ry, rz)


def rod(start: Vector, end: Vector, radius: float, end_radius: float | None = None, sides: int = 0) -> Shape:
    """A round bar between two points [m], tapering to `end_radius`; with 8 sides, more where it is thick."""
    sides = sides or sides_of(max(radius, end_radius or 0.0), THIN, 8)
    a, b = np.asarray(start, dtype=np.float64), np.asarray(end, dtype=np.float64)
    length = float(np.linalg.norm(b - a))
    shape = frustum(radius, radius if end_radius is None else end_radius, length, sides)
    direction = (b - a) / length
    return shape.transformed(frame_along(direction), a)


def bent_rod(points: Sequence[Vector], radius: float, sides: int = 0) -> Shape:
    """Rods along a polyline with round joints: handles, lamp arms, tails."""
    pieces = [rod(a, b, radius, sides=sides) for a, b in zip(points, points[1:], strict=False)]
    joints = [ellipsoid(radius).moved(*point) for point in points[1:-1]]
    # The joints only close the outside of each bend in the picture; the rods' parts overlap there already.
    return Shape(
        join(*pieces, *joints).solid, join(*pieces).hulls + tuple(hull for joint in joints for hull in joint.hulls)
    )


def prism(outline: Sequence[tuple[float, float]], height: float) -> Shape:
    """A simple polygon [m] (counter-clockwise, may be concave) extruded from z = 0 to `height`."""
    section = manifold3d.CrossSection([np.asarray(outline, dtype=np.float64)])
    solid = manifold3d.Manifold.extrude(section, height)
    points = np.asarray(outline, dtype=np.float64)
    hulls = []
    for piece in _convex_pieces(points):
        ring = np.column_stack([points[piece], np.zeros(len(piece))])
        hulls.append(np.concatenate([ring, ring + (0.0, 0.0, height)]))
    return Shape(solid, tuple(hulls))


def turned_solid(profile: Sequence[tuple[float, float]], sides: int = 0) -> Shape:
    """A solid of revolution about z from (radius, z) points with z increasing: bottles, vases, chess pieces.

    Each pair of neighbouring points is one frustum part.
    """
    outline = [(0.0, profile[0][1]), *profile, (0.0, profile[-1][1])]
    hulls = []
    for (r0, z0), (r1, z1) in zip(profile, profile[1:], strict=False):
        if z1 - z0 > 1e-9:
            hulls.extend(frustum(r0, r1, z1 - z0, sides).moved(z=z0).hulls)
    return Shape(_revolved(outline), tuple(hulls))


def vessel(outer: Sequence[tuple[float, float]], inner: Sequence[tuple[float, float]], segments: int = 16) -> Shape:
    """An open vessel of revolution about z: mugs, bowls, vases, baskets.

    Args:
        outer: (radius, z) [m] of the outside, z increasing from the base at z = 0.
        inner: (radius, z) [m] of the cavity, z increasing from its floor to the same rim height.
        segments: convex wedges around, a divisor of SMOOTH_SEGMENTS so that their corners meet those of the picture;
            the cavity loses 1 - cos(pi / segments) of its radius.

    Raises:
        AssetError: `segments` does not divide SMOOTH_SEGMENTS.
    """
    if SMOOTH_SEGMENTS % segments:
        raise AssetError(f"a vessel's segments must divide {SMOOTH_SEGMENTS}, got {segments}.")
    rim = outer[-1][1]
    # Lift the cavity's mouth through the rim so that no coplanar sliver is left.
    cavity = [(0.0, inner[0][1]), *inner, (inner[-1][0], rim + 0.01), (0.0, rim + 0.01)]
    body = _revolved([(0.0, outer[0][1]), *outer, (0.0, rim)])
    solid = body - _revolved(cavity)
    floor = inner[0][1]
    hulls: list[np.ndarray] = []
    below = [point for point in outer if point[1] < floor - 1e-9] + [(_radius_at(outer, floor), floor)]
    for (r0, z0), (r1, z1) in zip(below, below[1:], strict=False):
        hulls.extend(frustum(r0, r1, z1 - z0).moved(z=z0).hulls)
    levels = sorted({round(z, 9) for _, z in (*outer, *inner) if z > floor + 1e-9} | {floor})
    for z0, z1 in zip(levels, levels[1:], strict=False):
        for k in range(segments):
            corners = []
            drawn = range(k * SMOOTH_SEGMENTS // segments, (k + 1) * SMOOTH_SEGMENTS // segments + 1)
            for z in (z0, z1):
                # The outside has the corners of the picture; the inside is flat.
                spokes = [(_radius_at(outer, z), n) for n in drawn]
                spokes += [(_radius_at(inner, z), n) for n in (drawn[0], drawn[-1])]
                for radius, n in spokes:
                    angle = 2 * math.pi * n / SMOOTH_SEGMENTS
                    corners.append((radius * math.cos(angle), radius * math.sin(angle), z))
            hulls.append(np.array(corners))
    return Shape(solid, tuple(hulls))


def tray(x: float, y: float, height: float, wall: float, floor: float, flare: float = 0.0) -> Shape:
    """An open rectangular container [m] standing on z = 0: boxes, drawers, trays, planters.

    `x`, `y` are the outer sizes of the base; the walls lean outwards by `flare` [m] at the rim.
    """
    pieces = [box(x, y, floor)]
    for axis, (length, depth) in enumerate(((x, y), (y, x))):
        for sign in (-1.0, 1.0):
            outer0, inner0 = depth / 2, depth / 2 - wall
            points = []
            for z, shift in ((0.0, 0.0), (height, flare)):
                for along in (-length / 2 - shift, length / 2 + shift):
                    for across in (inner0 + shift, outer0 + shift):
                        point = (along, sign * across, z) if axis == 0 else (sign * across, along, z)
                        points.append(point)
            pieces.append(convex(points))
    return join(*pieces)


def _clipped(points: NDArray[np.float64], z: float) -> NDArray[np.float64]:
    """Vertices, shape (n, 3), of the hull of `points` above height `z`, at most 34 so that it has 64 triangles.

    A base of too many corners becomes a polygon around it: each step drops the edge whose
    neighbours, prolonged until they meet, add the smallest area.
    """
    if points[:, 2].min() >= z - 1e-12:
        return points
    hull = ConvexHull(points)
    # A corner left a hair above the base would be a bump on it, so the edge down to it is prolonged to the base.
    band = z + 0.02 * (points[:, 2].max() - z)
    above = points[[index for index in hull.vertices if points[index, 2] > band]]
    edges = {tuple(sorted(pair)) for a, b, c in hull.simplices for pair in ((a, b), (b, c), (c, a))}
    crossing = []
    for i, j in sorted(edges):
        (low, high) = sorted((points[i], points[j]), key=lambda point: point[2])
        if low[2] <= band < high[2]:
            crossing.append((low + (high - low) * (z - low[2]) / (high[2] - low[2]))[:2])
    base = np.array(crossing)
    base = base[ConvexHull(base).vertices]
    size = float(np.ptp(base, axis=0).max())
    while len(base) > 3:
        added, corner, edge = min(_without_edge(base, k, size) for k in range(len(base)))
        shortest = np.linalg.norm(base - np.roll(base, -1, axis=0), axis=1).min()
        fine = len(base) == 4 or shortest > 0.03 * size
        if not np.isfinite(added) or (len(above) + len(base) <= 34 and fine):
            break
        base[edge] = corner
        base = np.delete(base, (edge + 1) % len(base), axis=0)
    return np.concatenate([above, np.column_stack([base, np.full(len(base), z)])])


def _without_edge(ring: NDArray[np.float64], edge: int, size: float) -> tuple[float, tuple[float, float], int]:
    """(added area, new corner, edge) when a counter-clockwise polygon's neighbours of `edge` are prolonged to meet."""
    before, start, end, after = (ring[(edge + step) % len(ring)] for step in (-1, 0, 1, 2))
    u, v, gap = start - before, after - end, end - start
    turn = u[0] * v[1] - u[1] * v[0]
    if turn <= 1e-9 * size**2:
        return math.inf, (0.0, 0.0), edge
    along = (gap[0] * v[1] - gap[1] * v[0]) / turn
    corner = start + along * u
    area = 0.5 * abs(gap[0] * (corner - start)[1] - gap[1] * (corner - start)[0])
    return (float(area) if along > 0 else math.inf), (float(corner[0]), float(corner[1])), edge


def _revolved(outline: Sequence[tuple[float, float]]) -> manifold3d.Manifold:
    points = np.asarray(outline, dtype=np.float64)
    distinct = np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1) > 1e-9
    section = manifold3d.CrossSection([points[distinct]], manifold3d.FillRule.NonZero)
    return manifold3d.Manifold.revolve(section, SMOOTH_SEGMENTS)


def _radius_at(profile: Sequence[tuple[float, float]], z: float) -> float:
    return float(np.interp(z, [point[1] for point in profile], [point[0] for point in profile]))


def _sphere_points(radius: float, segments: int) -> NDArray[np.float64]:
    sphere = manifold3d.Manifold.sphere(radius, segments).to_mesh64()
    return np.asarray(sphere.vert_properties)[:, :3]


def _circumscribed_ball() -> NDArray[np.float64]:
    """32 vertices and 60 faces around the unit ball (a pentakis dodecahedron, scaled to contain it)."""
    golden = (1 + math.sqrt(5)) / 2
    ico = [(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)]
    dode = [(0, s / golden, t * golden) for s in (-1, 1) for t in (-1, 1)]
    points = [np.roll(p, k) for p in ico for k in range(3)]
    points += [np.array(p) for p in [(i, j, k) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]]
    # The dodecahedron dual to this icosahedron has its cyclic coordinates the other way round.
    points += [np.roll((p[0], p[2], p[1]), k) for p in dode for k in range(3)]
    unit = np.array([p / np.linalg.norm(p) for p in np.asarray(points, dtype=np.float64)])
    inradius = float(np.min(-ConvexHull(unit).equations[:, 3]))
    return unit / inradius


def _convex_pieces(points: NDArray[np.float64]) -> list[list[int]]:
    """Indices of convex polygons that tile a simple counter-clockwise polygon (triangles merged greedily)."""
    triangles = manifold3d.triangulate([points])
    pieces = [list(map(int, triangle)) for triangle in np.asarray(triangles)]

    def convex_ring(ring: list[int]) -> bool:
        p = points[ring]
        a, b = np.roll(p, -1, axis=0) - p, np.roll(p, -2, axis=0) - np.roll(p, -1, axis=0)
        return bool(np.all(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0] > -1e-12))

    merged = True
    while merged:
        merged = False
        for i, first in enumerate(pieces):
            for j, second in enumerate(pieces):
                shared = set(first) & set(second)
                if i >= j or len(shared) != 2:
                    continue
                ring = _merge(first, second, shared)
                if ring is not None and convex_ring(ring):
                    pieces = [piece for k, piece in enumerate(pieces) if k not in (i, j)] + [ring]
                    merged = True
                    break
            if merged:
                break
    return pieces


def _merge(first: list[int], second: list[int], shared: set[int]) -> list[int] | None:
    """The ring around two rings that share one edge, or None if they only share two separate corners."""
    for k in range(len(first)):
        a, b = first[k], first[(k + 1) % len(first)]
        if {a, b} == shared:
            start = second.index(a)
            if second[start - 1] != b:
                return None
            detour = [second[(start + step) % len(second)] for step in range(1, len(second) - 1)]
            return [*first[: k + 1], *detour, *first[k + 1 :]]
    return None
