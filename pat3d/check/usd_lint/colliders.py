"""Rules on what collides: hulls that are what they say, friction that every reader finds, no overlap."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.penetration import penetration
from pat3d.check.usd_lint.file import Faults, LintFile
from pat3d.errors import AssetError
from pat3d.exporters.usd.openusd import Prim, UsdGeom, UsdPhysics
from pat3d.exporters.usd.stage import bound_friction, collider_points
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import MassProperties
from pat3d.geometry.normals import enclosed_volume
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, Material, VisualMesh
from pat3d.scene.model import GROUND, Scene, SceneObject

MAX_VERTICES = 64
"""More than this PhysX takes from no hull."""

HULL_EXCESS = 0.01
"""Largest part of a hull's volume that is not in the mesh it stands for."""

_UNIT = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def missing_collider(file: LintFile) -> Faults:
    """Rigid bodies without a collider."""
    for body in file.bodies:
        if not body.colliders and not body.fixed:
            yield body.prim, "a rigid body without a collider falls for ever."


def approximation(file: LintFile) -> Faults:
    """Meshes of moving bodies that are no convex hulls to the engine."""
    for body in file.moving():
        for prim in body.colliders:
            if not prim.IsA(UsdGeom.Mesh):
                continue
            kind = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get()
            if not prim.HasAPI(UsdPhysics.MeshCollisionAPI) or kind != UsdPhysics.Tokens.convexHull:
                yield prim, f'a moving mesh collides as "{kind or "none"}"; convexHull is what every engine has.'


def hull(file: LintFile) -> Faults:
    """Hulls that are flat, too large, or stand for a mesh that is hollow."""
    for prim in file.colliders:
        points = collider_points(prim)
        if points is None:
            continue
        if not np.isfinite(points).all():
            yield prim, "its size or a point of it is not finite."
            continue
        try:
            hull = convex_part(points)
        except AssetError as error:
            yield prim, str(error)
            continue
        if len(hull.vertices) > MAX_VERTICES:
            yield prim, f"a hull of {len(hull.vertices)} vertices; PhysX drops those beyond {MAX_VERTICES}."
        if not prim.IsA(UsdGeom.Mesh):
            continue
        mesh = UsdGeom.Mesh(prim)
        counts = np.array(mesh.GetFaceVertexCountsAttr().Get() or [], dtype=np.int64)
        index = np.array(mesh.GetFaceVertexIndicesAttr().Get() or [], dtype=np.int64)
        if len(index) and (index.min() < 0 or index.max() >= len(points) or len(index) != counts.sum()):
            yield prim, "its faces name points that it does not have."
        elif len(counts) and (counts == 3).all():
            inside, whole = _volume(points, index.reshape(-1, 3)), _volume(hull.vertices, hull.faces)
            if abs(inside) < (1.0 - HULL_EXCESS) * whole:
                yield prim, f"its hull has {whole / max(abs(inside), 1e-300):.3g} times the volume of the mesh."


def friction(file: LintFile) -> Faults:
    """Friction that some reader does not find, or that none can have."""
    for prim in file.colliders:
        found = bound_friction(prim, "physics")
        if found is None:
            yield prim, "no physics material is bound; engines then choose a friction each."
            continue
        still, sliding = found
        if not (np.isfinite(found).all() and min(found) >= 0.0):
            yield prim, f"friction {still:g} and {sliding:g}; neither may be negative."
        elif sliding > still:
            yield prim, f"dynamic friction {sliding:g} exceeds static friction {still:g}."
        if bound_friction(prim, "") != found:
            yield prim, "its all-purpose material has another friction or none; MuJoCo reads that one. Bind both."


def overlap(file: LintFile) -> Faults:
    """Bodies inside one another; what a joint joins may be where it says so."""
    filtered = set()
    for prim in file.stage.Traverse():
        if prim.IsA(UsdPhysics.Joint) and not UsdPhysics.Joint(prim).GetCollisionEnabledAttr().Get():
            ends = UsdPhysics.Joint(prim).GetBody0Rel().GetTargets() + UsdPhysics.Joint(prim).GetBody1Rel().GetTargets()
            filtered.add(frozenset(map(str, ends)))
    still = [body for body in file.bodies if body.fixed]
    static = {str(body.prim.GetPath()) for body in still} | {str(prim.GetPath()) for prim in file.loose}
    groups = {str(body.prim.GetPath()): body.colliders for body in file.bodies}
    groups |= {str(prim.GetPath()): (prim,) for prim in file.loose}
    objects = [obj for path, prims in groups.items() if (obj := _object(file, path, prims)) is not None]
    if not objects:
        return
    for found in penetration(Scene(objects=tuple(objects))).hulls:
        pair = {found.first, found.second}
        if GROUND in pair or pair <= static or frozenset(pair) in filtered:
            continue
        message = f"overlaps {found.second} by {1e3 * found.depth:.3g} mm; engines push them apart at the start."
        yield file.stage.GetPrimAtPath(found.first), message


def _volume(points: NDArray[np.float64], faces: NDArray[Any]) -> float:
    return enclosed_volume(points[faces] - points.mean(axis=0))


def _object(file: LintFile, path: str, prims: tuple[Prim, ...]) -> SceneObject | None:
    """The colliders `prims` as an object at rest in the world; None where none has a shape we know."""
    parts: list[ConvexPart] = []
    for prim in prims:
        points = file.world_points(prim)
        try:
            if points is not None and np.isfinite(points).all():
                parts.append(convex_part(points))
        except AssetError:
            continue
    if not parts:
        return None
    first = parts[0]
    asset = Asset(
        noun="collider",
        visual=VisualMesh.from_face_colours(first.vertices, first.faces, np.zeros((len(first.faces), 3), np.uint8)),
        parts=tuple(parts),
        mass_properties=MassProperties(mass=1.0, volume=1.0, centre_of_mass=(0, 0, 0), inertia=_UNIT),
        material=Material(name="any", density=1.0, friction=0.0),
    )
    return SceneObject(name=path, asset=asset, pose=Pose(), initial_pose=Pose())
