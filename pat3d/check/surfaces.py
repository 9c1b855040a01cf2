"""Where the true surfaces of a scene are near the contacts of its convex parts.

Every plane in which the convex parts of two objects press on each other is looked at again with the visual meshes: the
objects may press where both meshes are within a distance of the plane.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.contacts import GROUND_INDEX, Contacts
from pat3d.geometry.footprints import Footprint, Plane, corners_of, rectangle
from pat3d.scene.model import Scene

DISTANCES = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 3e-3, 5e-3, 7e-3, 1e-2)
"""[m]; true surfaces are looked for within these of the plane of a contact, in turn. Pictures of round things are
polyhedra of 48 sides, which sag by 0.2 % of a radius: less than the first is nothing."""

LEAST_ALLOWED, SHARE_ALLOWED = 1e-3, 0.01
"""Distance of a true surface from a contact that may carry: a millimetre, and this share of the object's size."""

LEANING = 5.0
"""The same where objects touch in a point or along an edge, in those distances: what leans a little further on leans on
the same, while a floor that is not there carries nothing."""

DEEPER, LEVEL = 3e-4, math.tan(math.radians(1.0))
"""Where parts touch in an area, surfaces may be this much further off than the nearest and carry: a distance [m], or a
share of the area's length. What has to tip by more than what counts as still to reach the low side of a lid does not
lie there."""

TOLERANCE = 1e-5
"""By this much a mesh may stick out of its parts, or end below them [m]."""

FULL = 0.98
"""Share of a window that a flat surface fills at least."""

_BESIDE = 0.3
"""True surfaces may meet this far beside the parts' contact points, as a share of the smaller object's size."""

_ONE_PLANE, _ONE_NORMAL = 1e-4, 1e-6
"""Contact points this close to one plane [m], with normals of this cosine below one, are in it."""

_FLAT = 0.02
"""Width over length from which contact points span an area."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Patch:
    """The contacts of one pair of objects in one plane, and the meshes on both sides of it."""

    bodies: tuple[int, int]
    """Indices of the objects, -1 for the ground; the normal points to the first."""
    plane: Plane
    points: NDArray[np.float64]
    """Contact points of the parts in the plane [m], shape (n, 2)."""
    gap: float
    """Least distance between the parts [m]."""
    window: NDArray[np.float64]
    sides: tuple[Footprint | None, Footprint | None]
    """What the meshes of both objects have there; None for the ground."""
    allowed: tuple[float, float]
    """Distances within which the surfaces of both may carry [m]."""
    deeper: float
    """How much further from the plane than the nearest surfaces others may be and carry [m]."""

    @cached_property
    def air(self) -> float:
        """The least distance within which both surfaces are somewhere, to a thirtieth, or the least of DISTANCES [m].

        Infinite beyond the largest of them.
        """
        first = next((k for k, distance in enumerate(DISTANCES) if len(self.corners(distance))), None)
        if first is None:
            return np.inf
        high, low = DISTANCES[first], DISTANCES[max(first - 1, 0)]
        while high - low > high / 30:
            middle = (low + high) / 2
            low, high = (low, middle) if len(self.corners(middle)) else (middle, high)
        return high

    def corners(self, distance: float, *, limited: bool = False) -> NDArray[np.float64]:
        """Corners in the plane of where both surfaces are within `distance`, and allowed if `limited`, shape (n, 2)."""
        limits = self.allowed if limited else (np.inf, np.inf)
        if limited and np.isfinite(self.deeper):
            distance = min(distance, self.air + self.deeper)
        above, below = (
            rectangle(self.window) if side is None else side.within(min(distance, limit) + self.gap / 2 + TOLERANCE)
            for side, limit in zip(self.sides, limits, strict=True)
        )
        return corners_of(above ^ below)

    def flat(self, number: int, at: NDArray[np.float64], reach: float) -> bool:
        """Whether the mesh on side `number` fills the plane up to `reach` around `at` [m]."""
        side = self.sides[number]
        around = rectangle(np.stack([at - reach, at + reach]))
        return side is None or (side.within(DISTANCES[0]) ^ around).area() > FULL * around.area()


def patches(scene: Scene, contacts: Contacts) -> list[Patch]:
    """The planes in which objects of `scene` touch by `contacts` of their parts."""
    meshes: list[tuple[Any, Any]] = [
        (obj.pose.apply(obj.asset.visual.vertices), obj.asset.visual.faces) for obj in scene.objects
    ]
    sizes = [float(obj.asset.size.max()) for obj in scene.objects]
    found = []
    for members in _planes(contacts):
        first, second = contacts.bodies[members[0]].tolist()
        points, normal = contacts.points[members], contacts.normals[members[0]]
        plane = Plane.through(points.mean(axis=0), normal)
        flat = plane.seen(points)[:, :2]
        beside = _BESIDE * min(sizes[body] for body in (first, second) if body != GROUND_INDEX)
        window = np.stack([flat.min(axis=0) - beside, flat.max(axis=0) + beside])
        length = float(np.ptp(flat, axis=0).max())
        factor, deeper = (1.0, max(DEEPER, LEVEL * length)) if _spans_area(flat) else (LEANING, np.inf)
        found.append(
            Patch(
                bodies=(first, second),
                plane=plane,
                points=flat,
                gap=float(contacts.gaps[members].min()),
                window=window,
                sides=tuple(  # type: ignore[arg-type]
                    None
                    if body == GROUND_INDEX
                    else Footprint(meshes[body][0], meshes[body][1], plane, side, window, DISTANCES[-1])
                    for body, side in ((first, 1.0), (second, -1.0))
                ),
                allowed=tuple(  # type: ignore[arg-type]
                    np.inf if body == GROUND_INDEX else factor * max(LEAST_ALLOWED, SHARE_ALLOWED * sizes[body])
                    for body in (first, second)
                ),
                deeper=deeper,
            )
        )
    return found


def contacts_of(placed: list[tuple[Patch, NDArray[np.float64]]]) -> Contacts:
    """Contacts at the given corners, shape (n, 2), of each patch."""
    count = [len(corners) for _, corners in placed]
    bodies = np.repeat(np.array([patch.bodies for patch, _ in placed], dtype=np.int64).reshape(-1, 2), count, axis=0)
    normals = np.array([patch.plane.axes[2] for patch, _ in placed]).reshape(-1, 3)
    return Contacts(
        bodies=bodies,
        parts=np.full_like(bodies, -1),
        points=np.concatenate([np.zeros((0, 3)), *(patch.plane.lifted(corners) for patch, corners in placed)]),
        normals=np.repeat(normals, count, axis=0),
        gaps=np.repeat(np.array([patch.gap for patch, _ in placed]), count),
    )


def beyond(points: NDArray[np.float64], corners: NDArray[np.float64]) -> float:
    """Distance of the furthest of `points` from the convex polygon with `corners` [m], shapes (n, 2)."""
    middle = corners.mean(axis=0)
    angle = np.arctan2(corners[:, 1] - middle[1], corners[:, 0] - middle[0])
    ring = corners[np.argsort(angle)]
    along = np.roll(ring, -1, axis=0) - ring
    offset = points[:, None] - ring[None]
    length = np.maximum(np.einsum("ki,ki->k", along, along), 1e-300)
    t = np.clip(np.einsum("nki,ki->nk", offset, along) / length, 0.0, 1.0)
    distance = np.linalg.norm(offset - t[..., None] * along, axis=2).min(axis=1)
    left = along[None, :, 0] * offset[:, :, 1] - along[None, :, 1] * offset[:, :, 0]
    return float(np.where((left >= 0.0).all(axis=1), 0.0, distance).max())


def _planes(contacts: Contacts) -> list[NDArray[np.int64]]:
    """Positions of the contacts of each pair of bodies in each plane."""
    planes = []
    for pair in np.unique(contacts.bodies, axis=0):
        members = np.flatnonzero((contacts.bodies == pair).all(axis=1))
        while len(members):
            normal, point = contacts.normals[members[0]], contacts.points[members[0]]
            same = contacts.normals[members] @ normal > 1.0 - _ONE_NORMAL
            same &= np.abs((contacts.points[members] - point) @ normal) < _ONE_PLANE
            planes.append(members[same])
            members = members[~same]
    return planes


def _spans_area(points: NDArray[np.float64]) -> bool:
    """Whether `points` of a plane, shape (n, 2), are neither one spot nor on one line."""
    if len(points) < 3:
        return False
    long, short = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
    return bool(short > _FLAT * long)
