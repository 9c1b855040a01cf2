"""Faults of a USD file that validators let pass and engines punish.

Each rule is a function from the opened file to its findings; `lint_usd` runs them all. A scene without findings has
everything an engine needs to hold it still: one physics scene, masses that a solid can have, colliders on every body
that are what they say, friction that every reader finds, joints that start closed, and no overlap.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.asset import Asset, ConvexPart, MassProperties, Material, VisualMesh
from pat3d.assets.hull import convex_part
from pat3d.check.penetration import penetration
from pat3d.errors import AssetError
from pat3d.exporters.openusd import Prim, Stage, UsdGeom, UsdPhysics
from pat3d.exporters.usd_stage import (
    Body,
    bodies,
    body_above,
    bound_friction,
    collider_points,
    is_component,
    loose_colliders,
    matrix,
    open_stage,
    quaternion,
    transformed,
    value,
    without_scale,
)
from pat3d.scene import GROUND, Pose, Scene, SceneObject

MAX_VERTICES = 64
"""More than this PhysX takes from no hull."""

SINGLE = 1e-6
"""Relative rounding of numbers kept in single precision, with room."""

JOINT_GAP = 1e-4
"""[m], by which the two sides of a joint may be apart at the start."""

JOINT_TURN = 1e-3
"""[rad], by which the two sides of a hinge or weld may be turned at the start."""

HULL_EXCESS = 0.01
"""Largest part of a hull's volume that is not in the mesh it stands for."""

_UNIT = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))

_HINGES = {"PhysicsRevoluteJoint", "PhysicsFixedJoint"}
_BALLS = {"PhysicsSphericalJoint"}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One fault."""

    rule: str
    """Name of the rule, such as "missing-collider"."""
    prim: str
    """Path of the prim in the file."""
    message: str
    """What is wrong and what would be right."""

    def __str__(self) -> str:
        return f"{self.rule}: {self.prim}: {self.message}"


class _File:
    """The opened file, and what several rules ask of it."""

    def __init__(self, stage: Stage) -> None:
        self.stage = stage
        self.cache: Any = UsdGeom.XformCache()
        self.bodies = bodies(stage)
        self.loose = loose_colliders(stage, self.bodies)

    @cached_property
    def colliders(self) -> tuple[Prim, ...]:
        return (*(prim for body in self.bodies for prim in body.colliders), *self.loose)

    def world_points(self, collider: Prim) -> NDArray[np.float64] | None:
        points = collider_points(collider)
        return None if points is None else transformed(points, matrix(collider, self.cache))


def lint_usd(path: str | Path) -> tuple[Finding, ...]:
    """Every fault found in a .usdc, .usda or .usdz file, by rule; none in a file that this package wrote.

    A file whose default prim is a single object needs no physics scene.

    Raises:
        ExportError: not readable.
    """
    file = _File(open_stage(path))
    return tuple(
        Finding(rule=rule, prim=str(prim.GetPath()), message=message)
        for rule, check in RULES.items()
        for prim, message in check(file)
    )


Faults = Iterator[tuple[Prim, str]]


def _units(file: _File) -> Faults:
    stage, root = file.stage, file.stage.GetPseudoRoot()
    if not stage.GetDefaultPrim():
        yield root, "no default prim, so a reference to this file means nothing; author defaultPrim."
    if UsdGeom.GetStageUpAxis(stage) != UsdGeom.Tokens.z or not stage.HasAuthoredMetadata("upAxis"):
        yield root, f"the up axis is {UsdGeom.GetStageUpAxis(stage)}; author Z."
    for name, unit in (
        ("metersPerUnit", UsdGeom.GetStageMetersPerUnit(stage)),
        ("kilogramsPerUnit", UsdPhysics.GetStageKilogramsPerUnit(stage)),
    ):
        if unit != 1.0 or not stage.HasAuthoredMetadata(name):
            yield root, f"{name} is {unit:g}, authored or not; author 1."


def _physics_scene(file: _File) -> Faults:
    default = file.stage.GetDefaultPrim()
    if default and is_component(default):
        return
    scenes = [prim for prim in file.stage.Traverse() if prim.IsA(UsdPhysics.Scene)]
    if len(scenes) != 1:
        yield file.stage.GetPseudoRoot(), f"{len(scenes)} physics scenes; bodies need one for gravity."
    for prim in scenes:
        scene = UsdPhysics.Scene(prim)
        direction = np.array(value(scene.GetGravityDirectionAttr(), (0.0, 0.0, 0.0)), dtype=np.float64)
        magnitude = float(value(scene.GetGravityMagnitudeAttr(), -np.inf))
        # The schema's own defaults, a zero vector and minus infinity, mean earth's gravity.
        down = direction @ (0.0, 0.0, -1.0) >= (1.0 - SINGLE) * np.linalg.norm(direction)
        if not down or not (np.isneginf(magnitude) or 9.0 < magnitude < 10.5):
            yield prim, f"gravity is {magnitude:g} along {tuple(direction.tolist())}; objects rest under 9.81 along -Z."


def _articulation(file: _File) -> Faults:
    for prim in file.stage.Traverse():
        if prim.HasAPI(UsdPhysics.ArticulationRootAPI):
            yield prim, "an articulation root makes one machine of objects that are free; remove it."


def _nested_bodies(file: _File) -> Faults:
    for body in file.bodies:
        above = body_above(body.prim)
        if above is not None and not UsdGeom.Xformable(body.prim).GetResetXformStack():
            yield body.prim, f"a rigid body inside the rigid body {above.GetPath()}; make them siblings."


def _missing_collider(file: _File) -> Faults:
    for body in file.bodies:
        if not body.colliders and not body.fixed:
            yield body.prim, "a rigid body without a collider falls for ever."


def _mass(file: _File) -> Faults:
    for body in _moving(file):
        api = UsdPhysics.MassAPI(body.prim)
        attributes = {
            "mass": api.GetMassAttr(),
            "centerOfMass": api.GetCenterOfMassAttr(),
            "diagonalInertia": api.GetDiagonalInertiaAttr(),
            "principalAxes": api.GetPrincipalAxesAttr(),
        }
        absent = [name for name, attribute in attributes.items() if not attribute.HasAuthoredValue()]
        if absent:
            yield body.prim, f"without authored {', '.join(absent)} every engine makes up its own."
            continue
        mass = attributes["mass"].Get()
        if not (np.isfinite(mass) and mass > 0.0):
            yield body.prim, f"mass {mass:g} kg; it must be positive."
        turn = np.linalg.norm(quaternion(attributes["principalAxes"].Get()))
        if not abs(turn - 1.0) <= 10 * SINGLE:
            yield body.prim, f"principalAxes has norm {turn:.6g}; a rotation needs 1."
        points = [transformed(points, matrix(prim, file.cache, body.prim)) for prim, points in _shapes(body)]
        if points:
            centre = np.array(attributes["centerOfMass"].Get(), dtype=np.float64)
            spread = np.concatenate(points)
            low, high = spread.min(axis=0), spread.max(axis=0)
            if not np.all((centre > low) & (centre < high)):
                yield body.prim, f"the centre of mass {tuple(centre.tolist())} is outside its colliders."


def _mass_on_collider(file: _File) -> Faults:
    for prim in file.colliders:
        if prim.HasAPI(UsdPhysics.MassAPI) and not prim.HasAPI(UsdPhysics.RigidBodyAPI):
            yield prim, "mass on a collider contradicts that of its body; author it on the body alone."


def _inertia(file: _File) -> Faults:
    for body in _moving(file):
        attribute = UsdPhysics.MassAPI(body.prim).GetDiagonalInertiaAttr()
        if not attribute.HasAuthoredValue():
            continue
        moments = np.sort(np.array(attribute.Get(), dtype=np.float64))
        if not (np.isfinite(moments).all() and moments[0] > 0.0):
            yield body.prim, f"principal moments {tuple(moments.tolist())}; all must be positive."
        elif moments[2] > (moments[0] + moments[1]) * (1.0 + SINGLE):
            yield body.prim, f"principal moment {moments[2]:.4g} exceeds the sum of the others, as no solid's can."


def _scale(file: _File) -> Faults:
    for body in file.bodies:
        if fault := _distortion(matrix(body.prim, file.cache)):
            yield body.prim, f"{fault}; bodies turn and may only be scaled alike on all axes."
    for prim in file.colliders:
        # A cube has no other way to be a box than to be scaled, by itself alone.
        frame = prim.GetParent() if prim.IsA(UsdGeom.Cube) else prim
        if frame and (fault := _distortion(matrix(frame, file.cache))):
            yield prim, f"{fault}; engines differ in what that does to a collider."


def _approximation(file: _File) -> Faults:
    for body in _moving(file):
        for prim in body.colliders:
            if not prim.IsA(UsdGeom.Mesh):
                continue
            kind = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get()
            if not prim.HasAPI(UsdPhysics.MeshCollisionAPI) or kind != UsdPhysics.Tokens.convexHull:
                yield prim, f'a moving mesh collides as "{kind or "none"}"; convexHull is what every engine has.'


def _hull(file: _File) -> Faults:
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


def _friction(file: _File) -> Faults:
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


def _joint(file: _File) -> Faults:
    for prim in file.stage.Traverse():
        if not prim.IsA(UsdPhysics.Joint):
            continue
        joint, sides = UsdPhysics.Joint(prim), []
        for ends, position, rotation in (
            (joint.GetBody0Rel(), joint.GetLocalPos0Attr(), joint.GetLocalRot0Attr()),
            (joint.GetBody1Rel(), joint.GetLocalPos1Attr(), joint.GetLocalRot1Attr()),
        ):
            targets = ends.GetTargets()
            end = file.stage.GetPrimAtPath(targets[0]) if targets else file.stage.GetPseudoRoot()
            if not end:
                yield prim, f"{ends.GetName()} names {targets[0]}, which is not in the file."
                break
            place = matrix(end, file.cache) if targets else np.eye(4)
            local = Pose(quat_wxyz=_unit(rotation)).rotation
            axes = without_scale(place)[0][:3, :3] @ local
            point = np.array(value(position, (0.0, 0.0, 0.0)), dtype=np.float64)
            sides.append((transformed(point[None], place)[0], axes))
        if len(sides) < 2:
            continue
        gap = float(np.linalg.norm(sides[0][0] - sides[1][0]))
        if not gap <= JOINT_GAP and prim.GetTypeName() in (
            "PhysicsSphericalJoint",
            "PhysicsRevoluteJoint",
            "PhysicsFixedJoint",
        ):
            yield prim, f"its two sides are {1e3 * gap:.3g} mm apart and snap together at the start."
        if prim.GetTypeName() in _HINGES:
            turn = float(np.linalg.norm(sides[0][1] - sides[1][1]) / np.sqrt(2.0))
            if not turn <= JOINT_TURN:
                yield prim, f"its two sides are turned by {turn:.3g} rad and snap together at the start."


def _penetration(file: _File) -> Faults:
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
    for overlap in penetration(Scene(objects=tuple(objects))).hulls:
        pair = {overlap.first, overlap.second}
        if GROUND in pair or pair <= static or frozenset(pair) in filtered:
            continue
        message = f"overlaps {overlap.second} by {1e3 * overlap.depth:.3g} mm; engines push them apart at the start."
        yield file.stage.GetPrimAtPath(overlap.first), message


RULES = {
    "units": _units,
    "physics-scene": _physics_scene,
    "articulation": _articulation,
    "nested-bodies": _nested_bodies,
    "missing-collider": _missing_collider,
    "mass": _mass,
    "mass-on-collider": _mass_on_collider,
    "inertia": _inertia,
    "scale": _scale,
    "approximation": _approximation,
    "hull": _hull,
    "friction": _friction,
    "joint": _joint,
    "penetration": _penetration,
}


def _moving(file: _File) -> Iterator[Body]:
    return (body for body in file.bodies if not body.fixed)


def _shapes(body: Body) -> Iterator[tuple[Prim, NDArray[np.float64]]]:
    for prim in body.colliders:
        points = collider_points(prim)
        if points is not None and len(points):
            yield prim, points


def _distortion(place: NDArray[np.float64]) -> str | None:
    """What a 4 x 4 matrix does beyond turning, moving and scaling alike, in words."""
    if not np.isfinite(place).all():
        return "placed nowhere, by numbers that are not finite"
    gram = place[:3, :3].T @ place[:3, :3]
    size = float(np.trace(gram)) / 3.0
    if not 1e-12 < size < 1e12:
        return f"scaled by {np.sqrt(size):.3g}"
    if not np.allclose(gram, size * np.eye(3), atol=1e-5 * size):
        return f"scaled by {tuple(np.round(np.sqrt(np.diag(gram)), 6).tolist())} or sheared"
    return "mirrored" if np.linalg.det(place[:3, :3]) < 0.0 else None


def _volume(points: NDArray[np.float64], faces: NDArray[Any]) -> float:
    corners = points[faces] - points.mean(axis=0)
    return float(np.einsum("fi,fi->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))) / 6.0


def _unit(attribute: Any) -> Any:
    """The rotation in a quaternion attribute as quat_wxyz; none where it holds no rotation."""
    quat = value(attribute, None)
    size = 0.0 if quat is None else np.linalg.norm(quaternion(quat))
    return tuple((quaternion(quat) / size).tolist()) if 0.0 < size < np.inf else (1.0, 0.0, 0.0, 0.0)


def _object(file: _File, path: str, prims: tuple[Prim, ...]) -> SceneObject | None:
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
