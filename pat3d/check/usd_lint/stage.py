"""Rules on the stage and on where its prims are: units, gravity, hierarchy, placement."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.usd_lint.file import SINGLE, Faults, LintFile
from pat3d.exporters.usd.openusd import Usd, UsdGeom, UsdPhysics
from pat3d.exporters.usd.stage import body_above, is_component, matrix, quaternion, value

QUATERNIONS = {"quath": 2e-3, "quatf": 10 * SINGLE, "quatd": 10 * SINGLE}
"""How far the norm of a quaternion may be from 1, by its type in USD; doubles often come from single precision."""

MAX_SAMPLES = 1000
"""Time samples of one attribute that are looked at."""


def units(file: LintFile) -> Faults:
    """Metres, kilograms and Z up, authored, and a default prim."""
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


def physics_scene(file: LintFile) -> Faults:
    """One physics scene with earth's gravity along -Z; none in the file of a single object."""
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


def articulation(file: LintFile) -> Faults:
    """No articulations."""
    for prim in file.stage.Traverse():
        if prim.HasAPI(UsdPhysics.ArticulationRootAPI):
            yield prim, "an articulation root makes one machine of objects that are free; remove it."


def nested_bodies(file: LintFile) -> Faults:
    """Rigid bodies inside rigid bodies."""
    for body in file.bodies:
        above = body_above(body.prim)
        if above is not None and not UsdGeom.Xformable(body.prim).GetResetXformStack():
            yield body.prim, f"a rigid body inside the rigid body {above.GetPath()}; make them siblings."


def placement(file: LintFile) -> Faults:
    """Quaternions of zeros or NaN, of which every reader makes something else, and places that are not finite."""
    faulty = False
    for prim in Usd.PrimRange(file.stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        for attribute in prim.GetAuthoredAttributes():
            if (norm := _worst_norm(attribute)) is not None:
                faulty = True
                yield prim, f"{attribute.GetName()} holds a quaternion of norm {norm:.6g}; a rotation needs 1."
    if faulty:
        return
    for prim in (*(body.prim for body in file.bodies), *file.loose):
        if not np.isfinite(matrix(prim, file.cache)).all():
            yield prim, "placed nowhere, by numbers that are not finite."


def _worst_norm(attribute: Any) -> float | None:
    """The norm furthest from 1 that a quaternion of the attribute has at any time; None where all are rotations."""
    allowed = QUATERNIONS.get(str(attribute.GetTypeName().scalarType))
    if allowed is None or not attribute.HasAuthoredValue():
        return None
    times = attribute.GetTimeSamples()[:MAX_SAMPLES]
    norms = np.concatenate([_norms(attribute.Get()), *(_norms(attribute.Get(time)) for time in times)])
    wrong = norms[~(np.abs(norms - 1.0) <= allowed)]
    return float(wrong[np.argmax(np.abs(wrong - 1.0))]) if len(wrong) else None


def _norms(held: Any) -> NDArray[np.float64]:
    """Norms of a quaternion or an array of them."""
    if held is None:
        return np.empty(0)
    quats = [held] if hasattr(held, "GetReal") else held
    return np.array([np.linalg.norm(quaternion(quat)) for quat in quats], dtype=np.float64)


def scale(file: LintFile) -> Faults:
    """Scales that differ by axis, shear and mirror images, which engines treat differently."""
    for body in file.bodies:
        if fault := _distortion(matrix(body.prim, file.cache)):
            yield body.prim, f"{fault}; bodies turn and may only be scaled alike on all axes."
    for prim in file.colliders:
        # A cube has no other way to be a box than to be scaled, by itself alone.
        frame = prim.GetParent() if prim.IsA(UsdGeom.Cube) else prim
        if frame and (fault := _distortion(matrix(frame, file.cache))):
            yield prim, f"{fault}; engines differ in what that does to a collider."


def _distortion(place: NDArray[np.float64]) -> str | None:
    """What a finite 4 x 4 matrix does beyond turning, moving and scaling alike, in words."""
    if not np.isfinite(place).all():
        return None
    gram = place[:3, :3].T @ place[:3, :3]
    size = float(np.trace(gram)) / 3.0
    if not 1e-12 < size < 1e12:
        return f"scaled by {np.sqrt(size):.3g}"
    if not np.allclose(gram, size * np.eye(3), atol=1e-5 * size):
        return f"scaled by {tuple(np.round(np.sqrt(np.diag(gram)), 6).tolist())} or sheared"
    return "mirrored" if np.linalg.det(place[:3, :3]) < 0.0 else None
