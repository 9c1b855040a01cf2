"""Where bodies touch: contact points between convex parts, and with the ground.

Two convex polyhedra that nearly touch do so at vertices of one near the surface of the other, and where two
edges cross; for two faces these are the corners of their overlap. Bodies of a settled scene rest 1e-5 to
1e-4 m apart, so a point counts as touching up to an activation distance.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.geometry.edges import sharp_edges
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import unit_normals
from pat3d.geometry.pose import Pose

GROUND_INDEX = -1
"""Body index of the ground in `Contacts.bodies`."""

_TOUCHING = 1e-9
"""[m]; below this the direction between two points is rounding, and the features' own normal is used."""

_LEAST_STEP = 1e-6
"""[m]; a tenth of the shortest step along a surface."""

_RISE = 0.05
"""Height over a plane, as a share of a step, from which a surface rises from it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Contacts:
    """Contact points between bodies."""

    bodies: NDArray[np.int64]
    """Indices of the first and the second body, -1 for the ground; shape (contacts, 2)."""
    parts: NDArray[np.int64]
    """Which convex part of each body, -1 for the ground; shape (contacts, 2)."""
    points: NDArray[np.float64]
    """Midway between the two surfaces [m], shape (contacts, 3)."""
    normals: NDArray[np.float64]
    """Unit, from the second body towards the first, shape (contacts, 3)."""
    gaps: NDArray[np.float64]
    """Distance between the two surfaces [m], negative where they overlap, shape (contacts,)."""

    def __len__(self) -> int:
        return len(self.gaps)

    def pick(self, index: NDArray) -> Contacts:
        """The contacts at `index` (positions or a mask)."""
        return Contacts(
            bodies=self.bodies[index],
            parts=self.parts[index],
            points=self.points[index],
            normals=self.normals[index],
            gaps=self.gaps[index],
        )


class WorldPart:
    """One convex part at its object's pose, with what distance queries need."""

    def __init__(self, part: ConvexPart, pose: Pose) -> None:
        """Place `part` at `pose`."""
        self.vertices = pose.apply(part.vertices)
        self.triangles = self.vertices[part.faces]
        self.normals = unit_normals(self.triangles)
        self.offsets = np.einsum("fi,fi->f", self.normals, self.triangles[:, 0])
        self.low, self.high = self.vertices.min(axis=0), self.vertices.max(axis=0)
        self.edges = self.vertices[sharp_edges(part)]

    def near(self, other: WorldPart, reach: float) -> bool:
        """Whether the bounding boxes come within `reach` [m]."""
        return bool(np.all(self.low - reach <= other.high) and np.all(other.low - reach <= self.high))

    def closest(self, points: NDArray[np.float64]) -> tuple[NDArray, NDArray, NDArray]:
        """Closest surface point, outward direction and signed distance of `points` [m], shape (k, 3).

        Returns:
            surface points (k, 3), unit directions away from the part (k, 3), distances (k,), negative inside.
        """
        height = points @ self.normals.T - self.offsets
        foot, squared = _closest_on_triangles(points, self.triangles)
        rows = np.arange(len(points))
        best = np.argmin(squared, axis=1)
        distance, surface = np.sqrt(squared[rows, best]), foot[rows, best]
        direction = points - surface
        deepest = np.argmax(height, axis=1)
        inside = height[rows, deepest] < 0.0
        facing = self.normals[np.where(distance < _TOUCHING, best, deepest)]
        flat = inside | (distance < _TOUCHING)
        unit = np.where(flat[:, None], facing, direction / np.where(flat, 1.0, distance)[:, None])
        depth = height[rows, deepest]
        surface = np.where(inside[:, None], points - depth[:, None] * self.normals[deepest], surface)
        return surface, unit, np.where(inside, depth, distance)


class Body(Protocol):
    """What can touch: convex parts at a pose."""

    @property
    def parts(self) -> Sequence[ConvexPart]:
        """In the body's frame."""
        ...

    @property
    def pose(self) -> Pose:
        """Of the body's frame in the world."""
        ...

    @property
    def fixed(self) -> bool:
        """Whether it never moves."""
        ...


def find_contacts(objects: Sequence[Body], activation: float = 2e-4) -> Contacts:
    """Every contact between different objects, and between objects and the ground.

    Args:
        objects: at their poses; two fixed ones are not tested against one another.
        activation: surfaces closer than this touch [m].
    """
    placed = [[WorldPart(part, obj.pose) for part in obj.parts] for obj in objects]
    low = np.array([np.min([part.low for part in parts], axis=0) for parts in placed])
    high = np.array([np.max([part.high for part in parts], axis=0) for parts in placed])
    rows: list[tuple] = []
    for i, parts in enumerate(placed):
        if not objects[i].fixed:
            for p, part in enumerate(parts):
                rows += _ground_rows(i, p, part, activation)
        for j in range(i):
            apart = np.any(low[i] - activation > high[j]) or np.any(low[j] - activation > high[i])
            if apart or (objects[i].fixed and objects[j].fixed):
                continue
            rows += _pair_rows(i, parts, j, placed[j], activation)
    if not rows:
        return Contacts(
            bodies=np.zeros((0, 2), dtype=np.int64),
            parts=np.zeros((0, 2), dtype=np.int64),
            points=np.zeros((0, 3)),
            normals=np.zeros((0, 3)),
            gaps=np.zeros(0),
        )
    bodies, members, points, normals, gaps = zip(*rows, strict=True)
    return Contacts(
        bodies=np.array(bodies, dtype=np.int64),
        parts=np.array(members, dtype=np.int64),
        points=np.array(points),
        normals=np.array(normals),
        gaps=np.array(gaps),
    )


def corners_of_planes(contacts: Contacts) -> NDArray[np.int64]:
    """Positions of the fewest contacts that can carry exactly the same loads, in order.

    Where one pair of bodies touches in one plane with one normal, forces inside the convex hull of the points are
    combinations of forces at its corners with the same friction cone; only the corners are kept.
    """
    keep: list[int] = []
    for pair in np.unique(contacts.bodies, axis=0):
        members = np.flatnonzero((contacts.bodies == pair).all(axis=1))
        while len(members):
            normal, point = contacts.normals[members[0]], contacts.points[members[0]]
            same = contacts.normals[members] @ normal > 1.0 - 1e-10
            same &= np.abs((contacts.points[members] - point) @ normal) < 1e-4
            keep += _corners(contacts.points, members[same], normal)
            members = members[~same]
    return np.array(sorted(keep), dtype=np.int64)


def merged(contacts: Contacts) -> Contacts:
    """Fewer contacts that can carry exactly the same loads."""
    return contacts.pick(corners_of_planes(contacts))


def four_of_each(contacts: Contacts) -> Contacts:
    """At most four contacts for every pair of parts in one plane, spread as far as they go.

    Engines keep so many of a face (MuJoCo's and Bullet's meshes do): what stands on a round foot stands on a square in
    it, and rocks from one to the next.
    """
    keep: list[int] = []
    pairs = np.concatenate([contacts.bodies, contacts.parts], axis=1)
    for pair in np.unique(pairs, axis=0):
        members = np.flatnonzero((pairs == pair).all(axis=1))
        while len(members):
            normal = contacts.normals[members[0]]
            same = contacts.normals[members] @ normal > 1.0 - 1e-10
            keep += _spread(contacts.points, _corners(contacts.points, members[same], normal))
            members = members[~same]
    return contacts.pick(np.array(sorted(keep), dtype=np.int64))


def _spread(points: NDArray[np.float64], members: list[int]) -> list[int]:
    """Of corners of a plane polygon the two furthest apart, and the furthest on either side of their line."""
    if len(members) <= 4:
        return members
    own = points[members]
    apart = np.linalg.norm(own[:, None] - own[None], axis=2)
    first, second = np.unravel_index(np.argmax(apart), apart.shape)
    along = (own[second] - own[first]) / apart[first, second]
    across = own - own[first] - ((own - own[first]) @ along)[:, None] * along
    furthest = int(np.argmax(np.linalg.norm(across, axis=1)))
    side = across @ across[furthest]
    return [members[k] for k in dict.fromkeys((int(first), int(second), furthest, int(np.argmin(side))))]


def _corners(points: NDArray[np.float64], members: NDArray[np.int64], normal: NDArray[np.float64]) -> list[int]:
    """Those of `members` that are corners of the convex hull of their points seen along `normal`."""
    axis = np.eye(3)[np.argmin(np.abs(normal))]
    across = np.cross(normal, axis)
    across /= np.linalg.norm(across)
    flat = points[members] @ np.stack([across, np.cross(normal, across)], axis=1)
    _, first = np.unique(np.round(flat / 1e-7), axis=0, return_index=True)
    members, flat = members[first], flat[first]
    if len(members) < 3:
        return members.tolist()
    try:
        return members[ConvexHull(flat).vertices].tolist()
    except QhullError:
        along = flat - flat.mean(axis=0)
        line = along @ np.linalg.svd(along, full_matrices=False)[2][0]
        return [int(members[np.argmin(line)]), int(members[np.argmax(line)])]


def _ground_rows(body: int, number: int, part: WorldPart, activation: float) -> list[tuple]:
    touching = part.vertices[part.vertices[:, 2] < activation]
    up = np.array([0.0, 0.0, 1.0])
    return [((body, GROUND_INDEX), (number, -1), np.array([x, y, z / 2]), up, z) for x, y, z in touching.tolist()]


def _pair_rows(i: int, first: list[WorldPart], j: int, second: list[WorldPart], activation: float) -> list[tuple]:
    """Contacts between two bodies."""
    rows = []
    for p, a in enumerate(first):
        for q, b in enumerate(second):
            if not a.near(b, activation):
                continue
            for on_first, on_second, normal, gap in _part_contacts(a, b, activation):
                # A seam between two parts of a body is no corner: the surface there is the nearest part's.
                if _on_seam(on_first, on_second, normal, second, q, gap):
                    continue
                if _on_seam(on_second, on_first, -normal, first, p, gap):
                    continue
                rows.append(((i, j), (p, q), (on_first + on_second) / 2, normal, gap))
    return rows


def _part_contacts(a: WorldPart, b: WorldPart, activation: float):
    """(point on a, point on b, unit normal from b to a, gap) of every contact between two parts."""
    for source, target, sign in ((a, b, 1.0), (b, a, -1.0)):
        close = np.all(
            (source.vertices > target.low - activation) & (source.vertices < target.high + activation), axis=1
        )
        points = source.vertices[close]
        if not len(points):
            continue
        surface, direction, distance = target.closest(points)
        for k in np.flatnonzero(distance < activation):
            pair = (points[k], surface[k]) if sign > 0 else (surface[k], points[k])
            yield *pair, sign * direction[k], float(distance[k])
    yield from _edge_contacts(a, b, activation)


def _edge_contacts(a: WorldPart, b: WorldPart, activation: float):
    first, second = _edges_near(a, b, activation), _edges_near(b, a, activation)
    if not len(first) or not len(second):
        return
    u, v = first[:, 1] - first[:, 0], second[:, 1] - second[:, 0]
    cross = np.cross(u[:, None], v[None])
    size = np.linalg.norm(cross, axis=2)
    lengths = np.linalg.norm(u, axis=1)[:, None] * np.linalg.norm(v, axis=1)[None]
    crossing = size > 1e-6 * lengths
    square = np.where(crossing, size, 1.0) ** 2
    between = second[None, :, 0] - first[:, None, 0]
    s = np.einsum("abi,abi->ab", np.cross(between, v[None]), cross) / square
    t = np.einsum("abi,abi->ab", np.cross(between, u[:, None]), cross) / square
    crossing &= (s > 0) & (s < 1) & (t > 0) & (t < 1)
    separation = np.abs(np.einsum("abi,abi->ab", between, cross)) / np.sqrt(square)
    for k, m in np.argwhere(crossing & (separation < activation)):
        on_a, on_b = first[k, 0] + s[k, m] * u[k], second[m, 0] + t[k, m] * v[m]
        normal = cross[k, m] / size[k, m]
        if normal @ (a.vertices.mean(axis=0) - b.vertices.mean(axis=0)) < 0:
            normal = -normal
        # Both parts must lie on their own side, or the edges pass each other without supporting anything.
        above = ((a.vertices - on_a) @ normal).min() > -activation
        if above and ((b.vertices - on_b) @ normal).max() < activation:
            yield on_a, on_b, normal, float((on_a - on_b) @ normal)


def _edges_near(part: WorldPart, other: WorldPart, reach: float) -> NDArray[np.float64]:
    low, high = part.edges.min(axis=1), part.edges.max(axis=1)
    close = np.all((low < other.high + reach) & (high > other.low - reach), axis=1)
    return part.edges[close]


def _on_seam(
    point: NDArray[np.float64],
    foot: NDArray[np.float64],
    normal: NDArray[np.float64],
    parts: list[WorldPart],
    own: int,
    gap: float,
) -> bool:
    """Whether `point` touches another of `parts` instead, not part `own` at `foot`, `gap` [m] below it along `normal`.

    Another part is closer, and part `own` does not rise from it: where it does, the two form a hollow, such as a bowl's
    floor and wall, and what lies in it leans on both.
    """
    slack = 1e-7 + 0.01 * abs(gap)
    for number, part in enumerate(parts):
        if number == own or np.any(point < part.low - gap) or np.any(point > part.high + gap):
            continue
        # The height over the highest plane bounds the distance from below, which spares most exact queries.
        if (part.normals @ point - part.offsets).max() < gap - slack:
            surface, away, distance = (found[0] for found in part.closest(point[None]))
            if distance < gap - slack and not _rises(foot, normal, surface, away, parts, own, gap):
                return True
    return False


def _rises(
    foot: NDArray[np.float64],
    normal: NDArray[np.float64],
    base: NDArray[np.float64],
    up: NDArray[np.float64],
    parts: list[WorldPart],
    own: int,
    gap: float,
) -> bool:
    """Whether a step from `foot` along `up`, part `own` is open and above the plane through `base` across `up`."""
    along = up - (up @ normal) * normal
    size = float(np.linalg.norm(along))
    if size < _RISE:
        return False
    step = 10.0 * max(gap, _LEAST_STEP)
    ahead = parts[own].closest((foot + step / size * along)[None])[0][0]
    if (ahead - base) @ up < _RISE * step:
        return False
    above = ahead + _RISE * step * normal
    return all(number == own or (part.normals @ above - part.offsets).max() > 0.0 for number, part in enumerate(parts))


def _closest_on_triangles(
    points: NDArray[np.float64], triangles: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Closest point on each of m triangles to each of k points, and the squared distance; (k, m, 3), (k, m)."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ab, ac = b - a, c - a
    ap = points[:, None] - a[None]
    d00, d01, d11 = (np.einsum("mi,mi->m", x, y) for x, y in ((ab, ab), (ab, ac), (ac, ac)))
    d20, d21 = np.einsum("kmi,mi->km", ap, ab), np.einsum("kmi,mi->km", ap, ac)
    denominator = np.maximum(d00 * d11 - d01 * d01, 1e-300)
    v = (d11 * d20 - d01 * d21) / denominator
    w = (d00 * d21 - d01 * d20) / denominator
    best = a + v[..., None] * ab + w[..., None] * ac
    squared = np.where((v >= 0) & (w >= 0) & (v + w <= 1), np.sum((points[:, None] - best) ** 2, axis=2), np.inf)
    for start, end in ((a, b), (b, c), (c, a)):
        along = end - start
        length = np.maximum(np.einsum("mi,mi->m", along, along), 1e-300)
        t = np.clip(np.einsum("kmi,mi->km", points[:, None] - start, along) / length, 0.0, 1.0)
        foot = start + t[..., None] * along
        distance = np.sum((points[:, None] - foot) ** 2, axis=2)
        better = distance < squared
        squared = np.where(better, distance, squared)
        best = np.where(better[..., None], foot, best)
    return best, squared
