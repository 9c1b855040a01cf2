"""Objects from USD and USDZ: meshes and simple shapes with preview materials, collision shapes, mass and friction."""

from __future__ import annotations

import io
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.library.body import Body, Inertial, Piece, Points, flat, merged, primitive
from pat3d.assets.library.readers.collision import hulls_of
from pat3d.assets.library.readers.xml import GRAY
from pat3d.assets.mesh.load import MAX_BYTES, MAX_FACES
from pat3d.assets.mesh.texture import MAX_SIDE, Patch
from pat3d.errors import AssetError
from pat3d.geometry.rotations import matrix_of
from pat3d.scene.asset import MAPS


def pxr_module(name: str) -> Any:
    """A module of OpenUSD, whose types no checker knows.

    Raises:
        AssetError: usd-core is not installed.
    """
    try:
        return import_module(f"pxr.{name}")
    except ImportError as error:
        raise AssetError("USD files are read with usd-core: pip install 'pat3d[usd]'.") from error


def read_usd(path: Path, root: Path) -> Body:
    """The object of a USD file, in the unit and with the up axis that the stage says.

    Raises:
        AssetError: usd-core is missing, the file is damaged, it has joints that move, or nothing is to be seen.
    """
    Tf, Usd, UsdGeom, UsdPhysics = (pxr_module(name) for name in ("Tf", "Usd", "UsdGeom", "UsdPhysics"))
    try:
        stage = Usd.Stage.Open(str(path))
    except Tf.ErrorException as error:
        raise AssetError(f"{path.name} cannot be read as USD: {' '.join(str(error).split())[:200]}.") from error
    prims = list(stage.Traverse(Usd.TraverseInstanceProxies()))
    moving = [one.GetName() for one in prims if one.IsA(UsdPhysics.Joint) and not one.IsA(UsdPhysics.FixedJoint)]
    if moving:
        raise AssetError(
            f"it has joints that move ({', '.join(moving[:4])}); libraries hold rigid objects, so fix or remove them."
        )
    rigid = [one for one in prims if one.HasAPI(UsdPhysics.RigidBodyAPI)]
    if len(rigid) > 1:
        raise AssetError(f"it holds {len(rigid)} rigid bodies; one object a file.")
    cache = UsdGeom.XformCache()
    unit = float(UsdGeom.GetStageMetersPerUnit(stage))
    notes: list[str] = []
    seen: list[Piece] = []
    touched: list[Piece] = []
    files: list[Path] = [path]
    for prim in prims:
        piece = piece_of(prim, cache, root, notes, files)
        if piece is None:
            continue
        guide = UsdGeom.Imageable(prim).ComputePurpose() == UsdGeom.Tokens.guide
        if prim.HasAPI(UsdPhysics.CollisionAPI) and guide:
            touched.append(piece)
        elif not guide:
            seen.append(piece)
    hulls: tuple[Points, ...] = ()
    if touched:
        hulls, note = hulls_of(touched)
        notes += [note] if note else []
    root_prim = stage.GetDefaultPrim()
    return Body(
        name=root_prim.GetName() if root_prim else "",
        mesh=merged(seen or touched, notes),
        hulls=hulls,
        touched=tuple(touched),
        metres=unit,
        up="y" if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y else "z",
        declared="the USD stage",
        inertial=inertial_of(prims, cache, unit, float(UsdPhysics.GetStageKilogramsPerUnit(stage))),
        friction=_friction(prims),
        files=tuple(files),
        notes=tuple(notes),
    )


def piece_of(prim: Any, cache: Any, root: Path, notes: list[str], files: list[Path]) -> Piece | None:
    """A shape that is not hidden, in the axes and the unit of the stage; None where `prim` is no such shape.

    Args:
        prim: Usd.Prim.
        cache: UsdGeom.XformCache.
        root: folder that pictures may lie in.
        notes: what is left out is added.
        files: what is read is added.

    Raises:
        AssetError: it is damaged, or too large.
    """
    UsdGeom = pxr_module("UsdGeom")

    if not prim.IsA(UsdGeom.Gprim) or UsdGeom.Imageable(prim).ComputeVisibility() == UsdGeom.Tokens.invisible:
        return None
    piece = _piece(prim, root, notes, files)
    if piece is None:
        return None
    matrix = np.array(cache.GetLocalToWorldTransform(prim), dtype=np.float64).T
    vertices = piece.vertices @ matrix[:3, :3].T + matrix[:3, 3]
    mirrored = np.linalg.det(matrix[:3, :3]) < 0
    faces = piece.faces[:, ::-1] if mirrored else piece.faces
    patch = piece.patch.mirrored() if mirrored else piece.patch
    return replace(piece, vertices=vertices, faces=faces, patch=patch)


def _piece(prim: Any, root: Path, notes: list[str], files: list[Path]) -> Piece | None:
    UsdGeom = pxr_module("UsdGeom")

    colours = UsdGeom.Gprim(prim).GetDisplayColorAttr().Get()
    rgb = tuple(colours[0]) if colours else GRAY
    if prim.IsA(UsdGeom.Mesh):
        return _mesh(prim, rgb, root, notes, files)
    if prim.IsA(UsdGeom.Cube):
        return primitive("box", [float(UsdGeom.Cube(prim).GetSizeAttr().Get())] * 3, rgb)
    if prim.IsA(UsdGeom.Sphere):
        return primitive("sphere", [float(UsdGeom.Sphere(prim).GetRadiusAttr().Get())], rgb)
    for kind, name in ((UsdGeom.Cylinder, "cylinder"), (UsdGeom.Capsule, "capsule")):
        if prim.IsA(kind):
            shape = kind(prim)
            sizes = [float(shape.GetRadiusAttr().Get()), float(shape.GetHeightAttr().Get())]
            along = ("X", "Y", "Z").index(str(shape.GetAxisAttr().Get()))
            # Columns of the rotation that takes z to the axis of the shape.
            turn = np.eye(3)[:, [(along + 1) % 3, (along + 2) % 3, along]]
            return primitive(name, sizes, rgb).placed(turn, np.zeros(3))
    notes.append(f"{prim.GetName()} ({prim.GetTypeName()}) was left out")
    return None


def _mesh(prim: Any, rgb: Any, root: Path, notes: list[str], files: list[Path]) -> Piece | None:
    UsdGeom = pxr_module("UsdGeom")

    mesh = UsdGeom.Mesh(prim)
    points, counts = mesh.GetPointsAttr().Get(), mesh.GetFaceVertexCountsAttr().Get()
    index = mesh.GetFaceVertexIndicesAttr().Get()
    if not points or not counts or not index:
        return None
    counts, index = np.array(counts), np.array(index, dtype=np.int64)
    if counts.sum() != len(index) or index.min() < 0 or index.max() >= len(points):
        raise AssetError(f"{prim.GetName()}: faces refer to points that are not there.")
    if (counts - 2).clip(0).sum() > MAX_FACES:
        raise AssetError(f"{prim.GetName()} has more than {MAX_FACES:,} triangles; simplify it first.")
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
    # A fan for every polygon, by corner numbers, so that texture coordinates of corners follow.
    fans = [
        np.stack([starts[wide], starts[wide] + step, starts[wide] + step + 1], axis=1)
        for step in range(1, int(counts.max()) - 1)
        if (wide := counts >= step + 2).any()
    ]
    corners = np.concatenate(fans)
    if mesh.GetOrientationAttr().Get() == UsdGeom.Tokens.leftHanded:
        corners = corners[:, ::-1]
    faces = index[corners]
    image, tint, surface, maps = _look(prim, root, files, notes)
    uv = _coordinates(prim, index, corners)
    if image is not None and uv is not None:
        patch = Patch(uv=uv, image=image, maps={name: _fitted(one, image.shape) for name, one in maps.items()})
    else:
        patch = flat(len(faces), tint if tint is not None else rgb)
    return Piece(vertices=np.array(points, dtype=np.float64), faces=faces, patch=patch, surface=surface)


def _coordinates(prim: Any, index: Any, corners: Any) -> Points | None:
    UsdGeom = pxr_module("UsdGeom")

    for name in ("st", "st0", "UVMap", "map1"):
        primvar = UsdGeom.PrimvarsAPI(prim).GetPrimvar(name)
        if not primvar or not primvar.HasValue():
            continue
        values = np.array(primvar.ComputeFlattened(), dtype=np.float64)
        if primvar.GetInterpolation() == UsdGeom.Tokens.faceVarying and len(values) == len(index):
            return values[corners]
        if primvar.GetInterpolation() in (UsdGeom.Tokens.vertex, UsdGeom.Tokens.varying) and len(values) > index.max():
            return values[index[corners]]
    return None


def _look(
    prim: Any, root: Path, files: list[Path], notes: list[str]
) -> tuple[Any, Any, dict[str, float], dict[str, Any]]:
    """Picture and colour of the preview material that is bound, None where there is none; numbers and maps beside."""
    UsdShade = pxr_module("UsdShade")

    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    surface = material.ComputeSurfaceSource()[0] if material else None
    if not surface:
        return None, None, {}, {}
    said, maps = {}, {}
    for name in MAPS:
        given = surface.GetInput(name)
        file, channel = _connected(given) if given else (None, "")
        if file is not None:
            image = _picture(file, root, files, notes)
            if image is not None:
                maps[name] = image if name == "normal" else image[..., "rgb".find(channel) if channel in "rgb" else 0]
        elif given and name != "normal" and given.Get() is not None:
            said[name] = float(np.clip(given.Get(), 0.0, 1.0))
    colour = surface.GetInput("diffuseColor")
    if not colour:
        return None, None, said, maps
    file, _ = _connected(colour)
    if file is None:
        return None, None if colour.HasConnectedSource() else colour.Get(), said, maps
    return _picture(file, root, files, notes), None, said, maps


def _connected(given: Any) -> tuple[Any, str]:
    """The picture file that an input is connected to, None where there is none; and the output that it takes."""
    UsdShade = pxr_module("UsdShade")

    source = given.GetConnectedSources()[0] if given.HasConnectedSource() else []
    if not source:
        return None, ""
    reader = UsdShade.Shader(source[0].source.GetPrim())
    return reader.GetInput("file").Get() if reader.GetInput("file") else None, str(source[0].sourceName)


def _fitted(image: Any, shape: tuple[int, ...]) -> Any:
    """A map as large as the picture that it belongs to."""
    from PIL import Image

    return image if image.shape[:2] == shape[:2] else np.asarray(Image.fromarray(image).resize((shape[1], shape[0])))


def _picture(said: Any, root: Path, files: list[Path], notes: list[str]) -> Any:
    from PIL import Image

    Ar = pxr_module("Ar")

    where = said.resolvedPath or said.path
    outer = Path(where.split("[")[0]).resolve()
    if not outer.is_relative_to(root.resolve()) or not outer.is_file() or outer.stat().st_size > MAX_BYTES:
        notes.append(f'"{said.path}" lies outside the library, is missing or too large, and was not read')
        return None
    asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(where))
    try:
        with Image.open(io.BytesIO(bytes(asset.GetBuffer()))) as image:
            image.thumbnail((MAX_SIDE, MAX_SIDE))
            texels = np.asarray(image.convert("RGB"), dtype=np.uint8)
    except (OSError, ValueError, AttributeError, Image.DecompressionBombError) as error:
        notes.append(f'"{said.path}" is no picture that can be read ({type(error).__name__})')
        return None
    files.append(outer)
    return texels


def inertial_of(prims: list[Any], cache: Any, unit: float, kilograms: float) -> Inertial | None:
    """Of the prim that gives a mass, in metres and kilograms."""
    UsdPhysics = pxr_module("UsdPhysics")

    for prim in prims:
        api = UsdPhysics.MassAPI(prim)
        # What stands still may carry the numbers without the schema.
        if not (prim.HasAPI(UsdPhysics.MassAPI) or api.GetMassAttr().HasAuthoredValue()):
            continue
        mass = float(api.GetMassAttr().Get() or 0.0) * kilograms
        if mass <= 0:
            continue
        matrix = np.array(cache.GetLocalToWorldTransform(prim), dtype=np.float64).T
        scale = np.cbrt(abs(np.linalg.det(matrix[:3, :3])))
        rotation = matrix[:3, :3] / scale
        centre, moments = api.GetCenterOfMassAttr().Get(), api.GetDiagonalInertiaAttr().Get()
        said = centre is not None and np.isfinite(np.array(centre)).all()
        at = (matrix[:3, :3] @ np.array(centre) + matrix[:3, 3]) * unit if said else None
        tensor = None
        if moments is not None and np.array(moments).any() and np.linalg.norm(rotation.T @ rotation - np.eye(3)) < 1e-6:
            axes = api.GetPrincipalAxesAttr().Get()
            quat = (axes.GetReal(), *axes.GetImaginary()) if axes is not None else (1.0, 0.0, 0.0, 0.0)
            turn = rotation @ matrix_of(quat if any(quat) else (1.0, 0.0, 0.0, 0.0))
            tensor = turn @ np.diag(np.array(moments, dtype=np.float64)) @ turn.T * kilograms * unit**2 * scale**2
        return Inertial(mass=mass, centre=at, inertia=tensor)
    return None


def _friction(prims: list[Any]) -> float | None:
    UsdPhysics = pxr_module("UsdPhysics")

    for prim in prims:
        if prim.HasAPI(UsdPhysics.MaterialAPI):
            value = UsdPhysics.MaterialAPI(prim).GetStaticFrictionAttr().Get()
            if value:
                return float(value)
    return None
