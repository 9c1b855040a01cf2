"""UsdPhysics stages as MuJoCo specifications: rigid bodies and static colliders, units and axes from the stage.

Joints are not translated: bodies that they hold are taken as fixed. Meshes that collide are taken as their convex
hulls.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.foreign.shapes import MAX_GEOMS, add_body, add_geom, add_hull, new_spec, set_mass
from pat3d.errors import AssetError, CheckError
from pat3d.geometry.pose import Pose

Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])


def read_usd_scene(path: Path) -> tuple[Any, tuple[str, ...]]:
    """The specification of the stage at `path`, and notes.

    Raises:
        CheckError: not readable, or nothing in it has UsdPhysics colliders.
    """
    from pat3d.exporters.usd.openusd import Usd, UsdGeom, UsdPhysics
    from pat3d.exporters.usd.stage import bodies, loose_colliders, open_stage

    stage = open_stage(path)
    cache = UsdGeom.XformCache()
    unit = float(UsdGeom.GetStageMetersPerUnit(stage))
    kilogram = float(UsdPhysics.GetStageKilogramsPerUnit(stage))
    turn = Y_UP if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y else np.eye(3)
    spec, notes, number = new_spec(), [], 0
    jointed = _jointed(stage)
    found = bodies(stage)
    for one in found:
        rigid, scale = _rigid(np.array(cache.GetLocalToWorldTransform(one.prim)).T, unit, turn)
        fixed = one.fixed
        if not fixed and str(one.prim.GetPath()) in jointed:
            notes.append("bodies with joints were taken as fixed.")
            fixed = True
        body = add_body(spec, str(one.prim.GetPath()).lstrip("/"), rigid, fixed=fixed)
        for prim in one.colliders:
            number = _add(spec, body, prim, cache, rigid, (unit, turn), number, notes)
        if not fixed:
            _mass(body, one.prim, scale, unit, kilogram, notes)
    for prim in loose_colliders(stage, found):
        number = _add(spec, spec.worldbody, prim, cache, Pose(), (unit, turn), number, notes)
    if number == 0:
        raise CheckError(f"{path}: nothing in it collides; UsdPhysics.CollisionAPI is on no prim.")
    for prim in Usd.PrimRange(stage.GetPseudoRoot()):
        if prim.IsA(UsdPhysics.Scene):
            magnitude = float(UsdPhysics.Scene(prim).GetGravityMagnitudeAttr().Get())
            if np.isfinite(magnitude):
                spec.option.gravity = (0.0, 0.0, -magnitude * unit)
    return spec, tuple(dict.fromkeys(notes))


def _rigid(matrix: NDArray[np.float64], unit: float, turn: NDArray[np.float64]) -> tuple[Pose, NDArray[np.float64]]:
    """A transform acting on columns, in metres and z up: its pose and its scale along its own axes, shape (3,)."""
    from pat3d.exporters.usd.stage import without_scale

    rigid, scale = without_scale(matrix)
    rotation = rigid[:3, :3]
    if np.linalg.det(rotation) < 0:
        rotation, scale = rotation @ np.diag([-1.0, 1.0, 1.0]), scale * [-1.0, 1.0, 1.0]
    return Pose.from_matrix(turn @ rotation, turn @ (unit * rigid[:3, 3])), scale


def _add(
    spec: Any,
    body: Any,
    prim: Any,
    cache: Any,
    frame: Pose,
    units: tuple[float, NDArray[np.float64]],
    number: int,
    notes: list[str],
) -> int:
    """Add the collider `prim` to `body`, whose frame in the world is `frame`; returns the count of geoms."""
    from pat3d.exporters.usd.openusd import UsdGeom, UsdPhysics
    from pat3d.exporters.usd.stage import bound_friction, collider_points

    if number >= MAX_GEOMS:
        raise CheckError(f"more than {MAX_GEOMS} colliders.")
    unit, turn = units
    world, scale = _rigid(np.array(cache.GetLocalToWorldTransform(prim)).T, unit, turn)
    local = Pose.from_matrix(
        frame.rotation.T @ world.rotation, frame.rotation.T @ (np.array(world.position) - np.array(frame.position))
    )
    bound = bound_friction(prim, "physics")
    friction = bound[1] if bound and np.isfinite(bound[1]) else None
    scale = scale * unit
    points = collider_points(prim)
    if points is None:
        shape = next(
            (kind for kind in ("Sphere", "Cylinder", "Capsule", "Plane") if prim.IsA(getattr(UsdGeom, kind))), None
        )
        if shape is None:
            notes.append(f"a collider of type {prim.GetTypeName()} was left out.")
            return number
        _primitive(body, shape, prim, local, scale, friction)
        return number + 1
    approximation = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get()
    if prim.IsA(UsdGeom.Mesh) and approximation not in ("convexHull", "boundingCube"):
        notes.append(f'a mesh with approximation "{approximation}" was taken as its convex hull.')
    try:
        add_hull(spec, body, f"hull_{number}", points * scale, local, friction)
    except AssetError as error:
        notes.append(f"{prim.GetPath()} was left out: {error}")
    return number + 1


def _primitive(
    body: Any, kind: str, prim: Any, local: Pose, scale: NDArray[np.float64], friction: float | None
) -> None:
    from pat3d.exporters.usd.openusd import UsdGeom

    along = {"X": 0, "Y": 1, "Z": 2}
    shape = getattr(UsdGeom, kind)(prim)
    axis = along.get(str(shape.GetAxisAttr().Get()), 2) if kind != "Sphere" else 2
    columns = [(axis + 1) % 3, (axis + 2) % 3, axis]
    turned = Pose.from_matrix(local.rotation @ np.eye(3)[:, columns], np.array(local.position))
    if kind == "Plane":
        add_geom(body, "plane", (0.0, 0.0, 0.1), turned, friction)
        return
    radius = float(shape.GetRadiusAttr().Get()) * float(abs(scale[columns[0]]))
    if kind == "Sphere":
        add_geom(body, "sphere", (radius,), turned, friction)
        return
    half = float(shape.GetHeightAttr().Get()) / 2 * float(abs(scale[axis]))
    add_geom(body, kind.lower(), (radius, half), turned, friction)


def _mass(body: Any, prim: Any, scale: NDArray[np.float64], unit: float, kilogram: float, notes: list[str]) -> None:
    """Mass, centre and inertia where MassAPI has all of them; else those of the colliders, with its mass or density."""
    from pat3d.exporters.usd.openusd import UsdPhysics
    from pat3d.exporters.usd.stage import quaternion

    api = UsdPhysics.MassAPI(prim)
    if not prim.HasAPI(UsdPhysics.MassAPI):
        return
    mass = float(api.GetMassAttr().Get() or 0.0) * kilogram
    moments = np.array(api.GetDiagonalInertiaAttr().Get() or (0.0, 0.0, 0.0), dtype=np.float64) * kilogram * unit**2
    centre = np.array(api.GetCenterOfMassAttr().Get() or (np.nan,) * 3, dtype=np.float64)
    if mass > 0 and moments.min() > 0 and np.isfinite(centre).all():
        axes = quaternion(api.GetPrincipalAxesAttr().Get())
        quat = tuple(axes) if np.linalg.norm(axes) > 0.5 else (1.0, 0.0, 0.0, 0.0)
        pose = Pose(position=tuple(map(float, centre * scale * unit)), quat_wxyz=quat)  # type: ignore[arg-type]
        set_mass(body, mass, pose, np.diag(moments))
    elif mass > 0:
        geoms = list(body.geoms)
        notes.append("a mass without an inertia was spread over the colliders evenly.")
        for geom in geoms:
            geom.mass = mass / len(geoms)


def _jointed(stage: Any) -> set[str]:
    """Paths of bodies that a joint holds."""
    from pat3d.exporters.usd.openusd import Usd, UsdPhysics

    held: set[str] = set()
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdPhysics.Joint):
            joint = UsdPhysics.Joint(prim)
            for relation in (joint.GetBody0Rel(), joint.GetBody1Rel()):
                held |= {str(path) for path in relation.GetTargets()}
    return held
