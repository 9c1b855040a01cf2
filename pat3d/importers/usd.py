"""Scenes from UsdPhysics stages: rigid bodies, static props, loose colliders; units and the up axis are the stage's."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.library.body import Body, Inertial, Piece, merged
from pat3d.assets.library.readers.usd import inertial_of, piece_of
from pat3d.check.foreign.usd import Y_UP
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.pose import Pose
from pat3d.importers.model import GROUND_NAMES, ImportedObject, ImportedScene, is_ground

MAX_OBJECTS = 2000

HULL, BOX = "convexHull", "boundingCube"
"""Approximations that make a mesh collide as its convex hull, or as its bounding box."""


def read_usd_scene(path: Path, root: Path) -> ImportedScene:
    """Everything that collides on the stage at `path`; pictures lie below `root`.

    Raises:
        AssetError: damaged, or a body has shapes that are not read.
        ExportError: usd-core cannot open it, or is missing.
    """
    from pat3d.exporters.usd.openusd import UsdGeom
    from pat3d.exporters.usd.stage import bodies, loose_colliders, open_stage

    stage = open_stage(path)
    reader = _Reader(stage, path, root)
    found = bodies(stage)
    if len(found) > MAX_OBJECTS:
        raise AssetError(f"{path}: more than {MAX_OBJECTS} bodies.")
    jointed = _jointed(stage)
    objects, heights = list[ImportedObject](), list[float]()
    for one in found:
        if not one.colliders:
            reader.notes.append(f'"{one.prim.GetName()}" was left out, since nothing collides with it.')
            continue
        made = reader.object(one.prim, _shapes(one.prim), one.colliders, fixed=one.fixed)
        joint = "" if one.fixed else jointed.get(str(one.prim.GetPath()), "")
        objects.append(replace(made, joint=joint))
    loose: dict[Any, list[Any]] = {}
    for prim in loose_colliders(stage, found):
        if prim.IsA(UsdGeom.Plane):
            heights.append(reader.height(prim))
        else:
            loose.setdefault(prim.GetParent().GetPath(), []).append(prim)
    for colliders in loose.values():
        above = colliders[0].GetParent()
        named = any(GROUND_NAMES.search(prim.GetName()) for prim in (above, *colliders))
        made = reader.object(above, [*_shapes(above), *colliders], tuple(colliders), fixed=True)
        height = is_ground("ground" if named else made.name, made.body, made.pose)
        if height is None:
            objects.append(made)
        else:
            heights.append(height)
    return ImportedScene(
        path=path,
        format="usd",
        objects=tuple(objects),
        ground=max(heights) if heights else None,
        notes=tuple(dict.fromkeys(reader.notes)),
    )


class _Reader:
    """Prims of one stage as objects in metres, z up."""

    def __init__(self, stage: Any, path: Path, root: Path) -> None:
        from pat3d.exporters.usd.openusd import UsdGeom, UsdPhysics

        self.notes: list[str] = []
        self._path, self._root = path, root
        self._files = [path]
        self._cache = UsdGeom.XformCache()
        self._unit = float(UsdGeom.GetStageMetersPerUnit(stage))
        self._kilogram = float(UsdPhysics.GetStageKilogramsPerUnit(stage))
        self._turn = Y_UP if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y else np.eye(3)

    def height(self, prim: Any) -> float:
        """Of the place of `prim` above the origin [m]."""
        place = np.array(self._cache.GetLocalToWorldTransform(prim)).T[:3, 3]
        return float((self._turn @ place)[2] * self._unit)

    def object(self, prim: Any, shapes: list[Any], colliders: tuple[Any, ...], *, fixed: bool) -> ImportedObject:
        """The object whose frame is that of `prim`, of the prims `shapes`, those that collide among them."""
        from pat3d.exporters.usd.openusd import UsdGeom
        from pat3d.exporters.usd.stage import bound_friction, without_scale

        place, _ = without_scale(np.array(self._cache.GetLocalToWorldTransform(prim), dtype=np.float64).T)
        if np.linalg.det(place[:3, :3]) < 0:
            place[:3, :3] = place[:3, :3] @ np.diag([-1.0, 1.0, 1.0])
        # In metres with z up, in the world and in the frame of the prim alike.
        rotation = self._turn @ place[:3, :3] @ self._turn.T
        position = self._unit * (self._turn @ place[:3, 3])
        name = prim.GetDisplayName() or prim.GetName()
        known = {one.GetPath() for one in colliders}
        seen, touched, told = list[Piece](), list[Piece](), list[str]()
        try:
            for shape in dict.fromkeys(shapes):
                piece = piece_of(shape, self._cache, self._root, told, self._files)
                if piece is None:
                    continue
                vertices = (self._unit * (piece.vertices @ self._turn.T) - position) @ rotation
                piece = replace(piece, vertices=vertices)
                if shape.GetPath() in known:
                    touched.append(_as_it_collides(shape, piece))
                if UsdGeom.Imageable(shape).ComputePurpose() != UsdGeom.Tokens.guide:
                    seen.append(piece)
            mesh = merged(seen or touched, told)
        except AssetError as error:
            raise AssetError(f"{self._path}: {prim.GetPath()}: {error}") from error
        frictions = {bound[0] for one in colliders if (bound := bound_friction(one, "physics"))}
        frictions = {value for value in frictions if np.isfinite(value)}
        if len(frictions) > 1:
            told.append(f"it has several frictions ({min(frictions):g} to {max(frictions):g}); the largest counts")
        self.notes += [f'"{name}": {line}' for line in told]
        body = Body(
            name=name,
            mesh=mesh,
            touched=tuple(touched),
            metres=1.0,
            up="z",
            declared="the USD stage",
            inertial=self._inertial(prim, rotation, position),
            friction=max(frictions) if frictions else None,
            files=tuple(self._files),
            notes=tuple(told),
        )
        return ImportedObject(name=name, pose=Pose.from_matrix(rotation, position), body=body, fixed=fixed)

    def _inertial(
        self, prim: Any, rotation: NDArray[np.float64], position: NDArray[np.float64]
    ) -> Inertial | None:  # fmt: skip
        """Mass, centre and inertia in the frame of the object."""
        given = inertial_of([prim], self._cache, self._unit, self._kilogram)
        if given is None:
            return None
        turn = rotation.T @ self._turn
        centre, inertia = given.centre, given.inertia
        return Inertial(
            mass=given.mass,
            centre=None if centre is None else rotation.T @ (self._turn @ centre - position),
            inertia=None if inertia is None else turn @ inertia @ turn.T,
        )


def _shapes(prim: Any) -> list[Any]:
    """Every prim under `prim` that belongs to it, and to no rigid body inside it."""
    from pat3d.exporters.usd.openusd import Usd, UsdPhysics

    found = []
    below = iter(Usd.PrimRange(prim, Usd.TraverseInstanceProxies()))
    for one in below:
        if one != prim and one.HasAPI(UsdPhysics.RigidBodyAPI):
            below.PruneChildren()
        else:
            found.append(one)
    return found


def _as_it_collides(prim: Any, piece: Piece) -> Piece:
    """The hull or the box of a mesh where the file says that it collides as that."""
    from pat3d.exporters.usd.openusd import UsdGeom, UsdPhysics

    how = UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() if prim.IsA(UsdGeom.Mesh) else None
    if how not in (HULL, BOX):
        return piece
    points = piece.vertices
    if how == BOX:
        low, high = points.min(axis=0), points.max(axis=0)
        points = np.array([[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    part = convex_part(points)
    colours = np.full((len(part.faces), 3), 178, dtype=np.uint8)
    patch = replace(piece.patch, uv=np.zeros((len(part.faces), 3, 2)), image=None, colours=colours)
    return replace(piece, vertices=part.vertices, faces=part.faces.astype(np.int64), patch=patch)


def _jointed(stage: Any) -> dict[str, str]:
    """Name of a joint that holds a body, by the body's path."""
    from pat3d.exporters.usd.openusd import Usd, UsdPhysics

    held: dict[str, str] = {}
    for prim in Usd.PrimRange(stage.GetPseudoRoot(), Usd.TraverseInstanceProxies()):
        if prim.IsA(UsdPhysics.Joint):
            joint = UsdPhysics.Joint(prim)
            for relation in (joint.GetBody0Rel(), joint.GetBody1Rel()):
                for path in relation.GetTargets():
                    held.setdefault(str(path), prim.GetName())
    return held
