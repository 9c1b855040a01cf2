"""Do any two objects overlap? Asked of libraries that are not ours: FCL for meshes and hulls, manifold3d for volumes.

The same question is put to the convex parts (what engines collide) and to the visual meshes (what a person
sees). The gaps are distances between the surfaces of the convex parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import area_vectors
from pat3d.geometry.pose import Pose
from pat3d.scene.model import GROUND, Scene, SceneObject

CLOSE = 1e-3
"""[m]; gaps are listed for pairs closer than this."""

GROUND_TOLERANCE = 1e-9
"""[m]; rounding of a vertex that lies on the ground."""


@dataclass(frozen=True, kw_only=True)
class Overlap:
    """Two objects that intersect, or one that reaches into the ground."""

    first: str
    second: str
    depth: float
    """Deepest penetration of the convex parts [m]; of the surface into the ground."""
    volume: float | None
    """Volume shared by the visual meshes [m^3]; None where a mesh is not closed, or for the ground."""


@dataclass(frozen=True, kw_only=True)
class Gap:
    """Least distance between the convex parts of two objects, or of one and the ground."""

    first: str
    second: str
    distance: float
    """[m]"""


@dataclass(frozen=True, kw_only=True)
class PenetrationReport:
    """What overlaps, and how close the rest come."""

    hulls: tuple[Overlap, ...]
    """Pairs whose convex parts intersect."""
    visuals: tuple[Overlap, ...]
    """Pairs whose visual meshes intersect."""
    gaps: tuple[Gap, ...]
    """Pairs within a millimetre that do not intersect."""
    afloat: tuple[str, ...]
    """Fixed objects that nothing is within a millimetre of: the user fixed them, and no force holds them."""
    volume_ratio: float
    """Volume shared by pairs of visual meshes over the volume of all objects [-].

    The sum over unordered pairs of objects of the volume of the intersection of
    their closed visual meshes, divided by the sum of the objects' volumes. Zero if and only if no two solids overlap.
    """

    @property
    def passed(self) -> bool:
        """No pair intersects, neither on hulls nor on visual meshes, and nothing reaches into the ground."""
        return not self.hulls and not self.visuals

    @property
    def least_gap(self) -> float:
        """Smallest listed gap [m]; infinite if nothing is close."""
        return min((gap.distance for gap in self.gaps), default=float("inf"))

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        return {**asdict(self), "passed": self.passed}


def penetration(scene: Scene) -> PenetrationReport:
    """Check every pair of objects, and every object against the ground, for intersection."""
    objects = scene.objects
    hulls = [_hull_soup(obj) for obj in objects]
    visuals = [(obj.pose.apply(obj.asset.visual.vertices), obj.asset.visual.faces) for obj in objects]
    deep: list[Overlap] = []
    seen: list[Overlap] = []
    gaps: list[Gap] = []
    shared = 0.0
    for i, first in enumerate(objects):
        for name, found, soup in ((deep, gaps, hulls), (seen, None, visuals)):
            lowest = float(soup[i][0][:, 2].min())
            if lowest < -GROUND_TOLERANCE:
                name.append(Overlap(first=first.name, second=GROUND, depth=-lowest, volume=None))
            elif found is not None and lowest < CLOSE:
                found.append(Gap(first=first.name, second=GROUND, distance=max(lowest, 0.0)))
        for j in range(i):
            second = objects[j]
            overlap = None
            if _boxes_meet(hulls[i][0], hulls[j][0], CLOSE):
                distance = _distance(hulls[i], hulls[j])
                if distance <= 0.0 or _contained(first, second) or _contained(second, first):
                    overlap = Overlap(
                        first=first.name,
                        second=second.name,
                        depth=_depth(first, second),
                        volume=_shared_volume(visuals[i], visuals[j]),
                    )
                    deep.append(overlap)
                elif distance < CLOSE:
                    gaps.append(Gap(first=first.name, second=second.name, distance=distance))
            if _boxes_meet(visuals[i][0], visuals[j][0], 0.0):
                volume = overlap.volume if overlap else _shared_volume(visuals[i], visuals[j])
                if _collide(visuals[i], visuals[j]) or (volume or 0.0) > 0.0:
                    depth = overlap.depth if overlap else 0.0
                    seen.append(Overlap(first=first.name, second=second.name, depth=depth, volume=volume))
                    shared += volume or 0.0
    total = sum(obj.asset.mass_properties.volume for obj in objects)
    near = {name for pair in (*deep, *gaps) for name in (pair.first, pair.second)}
    return PenetrationReport(
        hulls=tuple(deep),
        visuals=tuple(seen),
        gaps=tuple(gaps),
        afloat=tuple(obj.name for obj in objects if obj.fixed and obj.name not in near),
        volume_ratio=shared / total,
    )


Soup = tuple[NDArray[np.float64], NDArray[np.int32]]
"""World vertices [m] and triangles."""


def _hull_soup(obj: SceneObject) -> Soup:
    """All convex parts of an object as one set of triangles."""
    starts = np.cumsum([0, *(len(part.vertices) for part in obj.asset.parts)])
    vertices = np.concatenate([part.vertices for part in obj.asset.parts])
    faces = np.concatenate([part.faces + start for part, start in zip(obj.asset.parts, starts, strict=False)])
    return obj.pose.apply(vertices), faces.astype(np.int32)


def _boxes_meet(a: NDArray[np.float64], b: NDArray[np.float64], reach: float) -> bool:
    """Whether the bounding boxes of two point sets come within `reach` [m]."""
    return bool(np.all(a.min(axis=0) - reach <= b.max(axis=0)) and np.all(b.min(axis=0) - reach <= a.max(axis=0)))


def _bvh(soup: Soup) -> Any:
    import fcl

    vertices, faces = soup
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(faces))
    model.addSubModel(np.ascontiguousarray(vertices), np.ascontiguousarray(faces))
    model.endModel()
    return fcl.CollisionObject(model)


def _distance(a: Soup, b: Soup) -> float:
    """Least distance between two surfaces [m]; not positive where they intersect."""
    import fcl

    return float(fcl.distance(_bvh(a), _bvh(b), fcl.DistanceRequest(), fcl.DistanceResult()))


def _collide(a: Soup, b: Soup) -> bool:
    """Whether two surfaces intersect."""
    import fcl

    return fcl.collide(_bvh(a), _bvh(b), fcl.CollisionRequest(), fcl.CollisionResult()) > 0


def _contained(inner: SceneObject, outer: SceneObject) -> bool:
    """Whether a part of one object lies inside a part of the other (their surfaces then need not meet)."""
    into = Pose(quat_wxyz=outer.pose.quat_wxyz).rotation
    for part in inner.asset.parts:
        point = inner.pose.apply(part.vertices[:1])
        local = (point - np.array(outer.pose.position)) @ into
        if any(_inside(local[0], hull) for hull in outer.asset.parts):
            return True
    return False


def _inside(point: NDArray[np.float64], part: ConvexPart) -> bool:
    corners = part.vertices[part.faces]
    return bool(np.all(np.einsum("fi,fi->f", area_vectors(corners), point - corners[:, 0]) < 0.0))


def _depth(first: SceneObject, second: SceneObject) -> float:
    """Deepest penetration between the convex parts of two objects [m], by FCL's expanding polytope."""
    import fcl

    def shapes(obj: SceneObject) -> Sequence[tuple[NDArray[np.float64], Any]]:
        made = []
        for part in obj.asset.parts:
            vertices = np.ascontiguousarray(obj.pose.apply(part.vertices))
            flat = np.column_stack([np.full(len(part.faces), 3), part.faces]).astype(np.int64).reshape(-1)
            made.append((vertices, fcl.CollisionObject(fcl.Convex(vertices, len(part.faces), flat))))
        return made

    deepest = 0.0
    others = shapes(second)
    for vertices, shape in shapes(first):
        for counterpart, other in others:
            if _boxes_meet(vertices, counterpart, 0.0):
                result = fcl.CollisionResult()
                fcl.collide(shape, other, fcl.CollisionRequest(num_max_contacts=1, enable_contact=True), result)
                deepest = max([deepest, *(abs(contact.penetration_depth) for contact in result.contacts)])
    return float(deepest)


def _shared_volume(a: Soup, b: Soup) -> float | None:
    """Volume of the intersection of two closed meshes [m^3], or None if either is not closed."""
    import manifold3d

    solids = []
    for vertices, faces in (a, b):
        mesh = manifold3d.Mesh64(np.ascontiguousarray(vertices), np.ascontiguousarray(faces, dtype=np.uint64))
        solid = manifold3d.Manifold(mesh)
        if solid.status() != manifold3d.Error.NoError:
            return None
        solids.append(solid)
    return float((solids[0] ^ solids[1]).volume())
