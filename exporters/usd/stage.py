"""A USD file opened, and its bodies found: rigid bodies, static props, and the colliders of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError
from pat3d.exporters.usd.openusd import Kind, Prim, Stage, Tf, Usd, UsdGeom, UsdPhysics, UsdShade
from pat3d.exporters.usd.writer import SUFFIXES
from pat3d.scene.obj_files import MAX_FILE_BYTES

MAX_PRIMS = 200_000

_CORNERS = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])


@dataclass(frozen=True, kw_only=True, eq=False)
class Body:
    """A prim that moves, or stands still, as one."""

    prim: Any
    """Usd.Prim"""
    colliders: tuple[Any, ...]
    """Usd.Prim of every collider under it, those of bodies nested in it left out."""
    fixed: bool
    """Not a rigid body, or a kinematic one."""


def open_stage(path: str | Path) -> Stage:
    """The composed stage of a USD file, as it is on disk now.

    Raises:
        ExportError: missing, too large, not USD, or without a default prim.
    """
    path = Path(path)
    if path.suffix not in (*SUFFIXES, ".usd"):
        raise ExportError(f"{path}: not a USD file; its name must end in .usd or {', '.join(SUFFIXES)}.")
    try:
        size = path.stat().st_size
    except OSError as error:
        raise ExportError(f"{path}: cannot be read ({error.strerror}).") from error
    if size > MAX_FILE_BYTES:
        raise ExportError(f"{path}: {size} bytes; at most {MAX_FILE_BYTES}.")
    try:
        stage = Usd.Stage.Open(str(path))
        # Layers stay cached by path for as long as anything holds them.
        stage.Reload()
    except Tf.ErrorException as error:
        raise ExportError(f"{path}: not readable USD ({str(error).strip()}).") from error
    if sum(1 for _, _ in zip(range(MAX_PRIMS + 1), stage.TraverseAll(), strict=False)) > MAX_PRIMS:
        raise ExportError(f"{path}: more than {MAX_PRIMS} prims.")
    return stage


def bodies(stage: Stage) -> tuple[Body, ...]:
    """Rigid bodies, and components that hold colliders outside any rigid body, in the order of the stage."""
    found = []
    range_ = iter(Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()))
    for prim in range_:
        if prim.HasAPI(UsdPhysics.RigidBodyAPI):
            found.append(Body(prim=prim, colliders=tuple(_colliders(prim)), fixed=is_still(prim)))
        elif is_component(prim) and body_above(prim) is None and not _holds_body(prim):
            range_.PruneChildren()
            if colliders := tuple(_colliders(prim)):
                found.append(Body(prim=prim, colliders=colliders, fixed=True))
    return tuple(found)


def loose_colliders(stage: Stage, known: tuple[Body, ...]) -> tuple[Prim, ...]:
    """Colliders that belong to none of the bodies `known`, such as the ground's."""
    taken = {prim.GetPath() for body in known for prim in body.colliders}
    everywhere = Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies())
    return tuple(prim for prim in everywhere if _collides(prim) and prim.GetPath() not in taken)


def is_still(prim: Prim) -> bool:
    """Whether the rigid body `prim` is kinematic or disabled."""
    body = UsdPhysics.RigidBodyAPI(prim)
    return bool(body.GetKinematicEnabledAttr().Get()) or not body.GetRigidBodyEnabledAttr().Get()


def is_component(prim: Prim) -> bool:
    """Whether `prim` is one object: a rigid body, or of the kind that USD calls a component."""
    return prim.HasAPI(UsdPhysics.RigidBodyAPI) or Usd.ModelAPI(prim).GetKind() == Kind.Tokens.component


def body_above(prim: Prim) -> Prim | None:
    """The nearest rigid body above `prim`; None where there is none."""
    parent = prim.GetParent()
    while parent and not parent.HasAPI(UsdPhysics.RigidBodyAPI):
        parent = parent.GetParent()
    return parent or None


def matrix(prim: Prim, cache: Any, base: Prim | None = None) -> NDArray[np.float64]:
    """The 4 x 4 matrix from the frame of `prim` to the world, or to the frame of `base`, acting on columns."""
    place = cache.GetLocalToWorldTransform(prim)
    if base is not None:
        place = place * cache.GetLocalToWorldTransform(base).GetInverse()
    return np.array(place).T


def without_scale(place: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The matrix with unit axes in place of its own, and the lengths of those [-], shape (3,)."""
    lengths = np.linalg.norm(place[:3, :3], axis=0)
    rigid = place.copy()
    rigid[:3, :3] /= np.where(lengths > 0, lengths, 1.0)
    return rigid, lengths


def collider_points(prim: Prim) -> NDArray[np.float64] | None:
    """Points that span a mesh or a cube in its own frame [m], shape (n, 3); None for other shapes."""
    if prim.IsA(UsdGeom.Mesh):
        points = UsdGeom.Mesh(prim).GetPointsAttr().Get()
        return np.array([] if points is None else points, dtype=np.float64).reshape(-1, 3)
    if prim.IsA(UsdGeom.Cube):
        return _CORNERS * float(value(UsdGeom.Cube(prim).GetSizeAttr(), np.nan))
    return None


def transformed(points: NDArray[np.float64], place: NDArray[np.float64]) -> NDArray[np.float64]:
    """Points, shape (n, 3), through a 4 x 4 matrix."""
    return points @ place[:3, :3].T + place[:3, 3]


def bound_friction(prim: Prim, purpose: str) -> tuple[float, float] | None:
    """Static and dynamic friction [-] of the material bound to `prim` for `purpose`; None where there is none."""
    material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(purpose)
    if not material or not material.GetPrim().HasAPI(UsdPhysics.MaterialAPI):
        return None
    physics = UsdPhysics.MaterialAPI(material.GetPrim())
    still, sliding = physics.GetStaticFrictionAttr(), physics.GetDynamicFrictionAttr()
    return float(value(still, np.nan)), float(value(sliding, np.nan))


def quaternion(quat: Any) -> NDArray[np.float64]:
    """A Gf.Quatf or Gf.Quatd as (w, x, y, z), shape (4,)."""
    return np.array([quat.GetReal(), *quat.GetImaginary()], dtype=np.float64)


def value(attribute: Any, absent: Any) -> Any:
    """What a Usd.Attribute holds, or `absent` where it is blocked."""
    held = attribute.Get()
    return absent if held is None else held


def _colliders(prim: Prim) -> Iterator[Prim]:
    range_ = iter(Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))
    for below in range_:
        if below != prim and below.HasAPI(UsdPhysics.RigidBodyAPI):
            range_.PruneChildren()
        elif _collides(below):
            yield below


def _collides(prim: Prim) -> bool:
    return prim.HasAPI(UsdPhysics.CollisionAPI) and UsdPhysics.CollisionAPI(prim).GetCollisionEnabledAttr().Get()


def _holds_body(prim: Prim) -> bool:
    return any(below.HasAPI(UsdPhysics.RigidBodyAPI) for below in Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))
