"""What a USD file says of its bodies, read with OpenUSD: the other half of a verification of the export."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from pat3d.errors import ExportError
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.usd.openusd import Prim, UsdGeom, UsdPhysics
from pat3d.exporters.usd.stage import (
    Body,
    bodies,
    bound_friction,
    collider_points,
    matrix,
    open_stage,
    quaternion,
    transformed,
    without_scale,
)
from pat3d.geometry.pose import Pose


def read_usd(path: str | Path) -> tuple[BodyReadback, ...]:
    """Every rigid body and static prop of a .usdc, .usda or .usdz file; the ground is neither.

    Raises:
        ExportError: not readable, a body without authored mass properties or out of shape, or a collider that is
            neither mesh nor cube.
    """
    stage = open_stage(path)
    cache = UsdGeom.XformCache()
    return tuple(_read(body, cache, path) for body in bodies(stage))


def _read(body: Body, cache: Any, path: str | Path) -> BodyReadback:
    prim = body.prim
    place, scale = without_scale(matrix(prim, cache))
    if not (np.isfinite(place).all() and np.linalg.det(place[:3, :3]) > 0.5 and np.ptp(scale) < 1e-5 * scale.max()):
        raise ExportError(f"{path}: {prim.GetPath()} is not just turned and moved; make it so.")
    mass, centre, inertia = mass_properties(prim, path)
    return BodyReadback(
        # USD takes no name that starts with a digit.
        name=prim.GetName()[1:] if prim.GetName()[:1] == "_" and prim.GetName()[1:2].isdigit() else prim.GetName(),
        mass=mass,
        centre=centre,
        inertia=inertia,
        friction=_friction(body),
        hulls=tuple(_corners(collider, body, cache, path) for collider in body.colliders),
        pose=Pose.from_matrix(place[:3, :3], place[:3, 3]),
        fixed=body.fixed,
    )


def mass_properties(prim: Prim, path: str | Path) -> tuple[float, NDArray[np.float64], NDArray[np.float64]]:
    """Mass [kg], centre [m] and inertia tensor about it [kg m^2], in the axes of `prim`.

    Raises:
        ExportError: one of them is not authored.
    """
    api = UsdPhysics.MassAPI(prim)
    attributes = (
        api.GetMassAttr(),
        api.GetCenterOfMassAttr(),
        api.GetDiagonalInertiaAttr(),
        api.GetPrincipalAxesAttr(),
    )
    still = not prim.HasAPI(UsdPhysics.RigidBodyAPI)
    if not (still or prim.HasAPI(UsdPhysics.MassAPI)) or not all(one.HasAuthoredValue() for one in attributes):
        raise ExportError(f"{path}: {prim.GetPath()} needs mass, centreOfMass, diagonalInertia and principalAxes.")
    mass, centre, moments, axes = (attribute.Get() for attribute in attributes)
    turn = quaternion(axes)
    if not (np.isfinite(turn).all() and np.linalg.norm(turn) > 0.0):
        raise ExportError(f"{path}: the principalAxes of {prim.GetPath()} are no rotation.")
    rotation = Rotation.from_quat(turn, scalar_first=True).as_matrix()
    inertia = rotation @ np.diag(np.array(moments, dtype=np.float64)) @ rotation.T
    return float(mass), np.array(centre, dtype=np.float64), inertia


def _friction(body: Body) -> float:
    """The one friction of every collider; NaN where they differ or one has none."""
    found = {bound_friction(collider, "physics") for collider in body.colliders}
    values = {value for pair in found if pair is not None for value in pair}
    return values.pop() if len(values) == 1 and None not in found else float("nan")


def _corners(collider: Prim, body: Body, cache: Any, path: str | Path) -> NDArray[np.float64]:
    """Points that span a collider [m], in the frame of its body, shape (points, 3)."""
    points = collider_points(collider)
    if points is None:
        raise ExportError(f"{path}: {collider.GetPath()} is a {collider.GetTypeName()}; colliders are Mesh or Cube.")
    return transformed(points, matrix(collider, cache, body.prim))
