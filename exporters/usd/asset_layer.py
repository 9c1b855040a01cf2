"""One asset as a USD layer: a rigid body with its look, its colliders and its mass.

    /<name>                 rigid body, mass, centre, principal inertia
    /<name>/visual          what is seen, bound to materials/visual; a layer of its own where it is instanceable;
                            with the choice of its level of detail where there are several
    /<name>/collision/...   one guide a convex part, bound to materials/physics
    /<name>/materials       the textured surface, and the friction

USD keeps mesh points and masses in single precision. Points are therefore stored about the centre of their own part,
whose place is a double: rounding is then relative to the part and not to where it sits.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.assets.materials import surface_of
from pat3d.assets.mesh.simplify import coarser
from pat3d.exporters.usd.engine_schemas import extend_body, extend_collider, extend_material
from pat3d.exporters.usd.openusd import (
    Gf,
    Kind,
    Prim,
    PrimPath,
    Sdf,
    Shape,
    Stage,
    Surface,
    Usd,
    UsdGeom,
    UsdPhysics,
    UsdSemantics,
    UsdShade,
    Vt,
)
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.mass import MassProperties
from pat3d.geometry.normals import corner_normals, triangle_areas, unit_normals
from pat3d.geometry.rotations import principal_frame
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.asset import Surface as Look
from pat3d.scene.obj_files import write_texture

GUIDE_COLOUR = (0.4, 0.6, 0.9)
"""Linear RGB of colliders where guides are shown."""

LEVELS = "lod"
"""The variant set of levels of detail; its variants are lod0, the finest, lod1, ..."""

_TRIES = 16
"""Rounds of moving points apart; what is left then stays."""


def set_metadata(stage: Stage, root: Prim) -> None:
    """Metres, kilograms, Z up, and `root` as what a reference to the layer means."""
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.z)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdPhysics.SetStageKilogramsPerUnit(stage, 1.0)
    stage.SetDefaultPrim(root)


def write_asset(
    asset: Asset,
    name: str,
    path: Path,
    *,
    as_mesh: bool = False,
    instanceable: bool = False,
    levels: Sequence[int] = (),
) -> None:
    """Write `asset` as the USD layer `path`, and its texture beside it.

    Args:
        asset: what to write.
        name: of the root prim.
        path: ends in .usdc or .usda; its folder exists.
        as_mesh: hulls in place of box primitives.
        instanceable: what is seen is kept once, however many objects refer to the layer.
        levels: most triangles of coarser levels of what is seen, variants of the set LEVELS of its prim.
    """
    stage = Usd.Stage.CreateNew(str(path))
    root = UsdGeom.Xform.Define(stage, f"/{name}").GetPrim()
    set_metadata(stage, root)
    Usd.ModelAPI(root).SetKind(Kind.Tokens.component)
    Usd.ModelAPI(root).SetAssetName(name)
    Usd.ModelAPI(root).SetAssetIdentifier(Sdf.AssetPath(f"./{path.name}"))
    UsdSemantics.LabelsAPI.Apply(root, "class").CreateLabelsAttr([asset.noun])
    UsdPhysics.RigidBodyAPI.Apply(root)
    _mass(root, asset.mass_properties)
    extend_body(root)
    materials = UsdGeom.Scope.Define(stage, root.GetPath().AppendChild("materials")).GetPath()
    if instanceable:
        own = path.with_name(f"{name}_visual{path.suffix}")
        _write_visual(asset, name, own, levels)
        seen = UsdGeom.Xform.Define(stage, root.GetPath().AppendChild("visual")).GetPrim()
        seen.GetReferences().AddReference(f"./{own.name}")
        seen.SetInstanceable(True)
    else:
        mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendChild("visual"))
        _seen(stage, asset, name, path.parent, mesh, materials.AppendChild("visual"), mesh.GetPrim(), levels)
    friction = physics_material(stage, materials.AppendChild("physics"), asset.material.friction)
    _label(friction, asset)
    collision = UsdGeom.Xform.Define(stage, root.GetPath().AppendChild("collision")).GetPath()
    for number, part in enumerate(asset.parts):
        _part(stage, collision.AppendChild(part_name(number)), part, friction, as_mesh=as_mesh)
    stage.Save()


def _write_visual(asset: Asset, name: str, path: Path, levels: Sequence[int]) -> None:
    """Write what is seen of `asset` as the USD layer `path`."""
    stage = Usd.Stage.CreateNew(str(path))
    root = UsdGeom.Xform.Define(stage, "/visual").GetPrim()
    set_metadata(stage, root)
    materials = UsdGeom.Scope.Define(stage, "/visual/materials").GetPath()
    mesh = UsdGeom.Mesh.Define(stage, root.GetPath().AppendChild("mesh"))
    _seen(stage, asset, name, path.parent, mesh, materials.AppendChild("visual"), root, levels)
    stage.Save()


def _seen(
    stage: Stage,
    asset: Asset,
    name: str,
    folder: Path,
    mesh: Shape,
    material: PrimPath,
    holder: Prim,
    levels: Sequence[int],
) -> None:
    """Fill the mesh, whose levels `holder` has the choice of, define its material, and write their pictures."""
    # Named by the asset: importers that keep pictures by their file name would give all objects the same.
    write_texture(asset.visual.texture, folder / f"{name}.png")
    maps = {one: f"./{name}_{one}.png" for one in asset.visual.maps}
    for one, file in maps.items():
        write_texture(asset.visual.maps[one], folder / file)
    look = textured_material(stage, material, f"./{name}.png", surface_of(asset), maps)
    _label(look, asset)
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(look)
    finest, *coarse = _levels(asset, levels)
    if not coarse:
        _visual(stage, mesh.GetPath(), finest)
        return
    choice = holder.GetVariantSets().AddVariantSet(LEVELS)
    for number, visual in enumerate((finest, *coarse)):
        choice.AddVariant(f"{LEVELS}{number}")
        choice.SetVariantSelection(f"{LEVELS}{number}")
        with choice.GetVariantEditContext():
            _visual(stage, mesh.GetPath(), visual)
    choice.SetVariantSelection(f"{LEVELS}0")


def _levels(asset: Asset, levels: Sequence[int]) -> list[VisualMesh]:
    """What is seen, and what is left of it with at most so many triangles, where that is less than the level before."""
    found = [asset.visual]
    for triangles in levels:
        visual = coarser(asset, triangles, asset.noun)[0].visual
        if len(visual.faces) < len(found[-1].faces):
            found.append(visual)
    return found


def _label(material: Surface, asset: Asset) -> None:
    """Say what a material is, for sensors and synthetic data."""
    UsdSemantics.LabelsAPI.Apply(material.GetPrim(), "material").CreateLabelsAttr([asset.material.name])


def part_name(number: int) -> str:
    """Prim name of a convex part."""
    return f"part_{number:03d}"


def physics_material(stage: Stage, path: PrimPath, friction: float) -> Surface:
    """A material of static and dynamic `friction` [-] without restitution."""
    material = UsdShade.Material.Define(stage, path)
    physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    physics.CreateStaticFrictionAttr(friction)
    physics.CreateDynamicFrictionAttr(friction)
    physics.CreateRestitutionAttr(0.0)
    extend_material(material.GetPrim())
    return material


def bind_physics(prim: Prim, material: Surface) -> None:
    """Bind a physics material to a collider.

    For physics alone, which is what the schema asks for, and for all purposes too: MuJoCo's reader looks no further,
    and colliders are guides that nothing shades.
    """
    binding = UsdShade.MaterialBindingAPI.Apply(prim)
    binding.Bind(material)
    binding.Bind(material, materialPurpose="physics")


def define_box(
    stage: Stage,
    path: PrimPath,
    centre: tuple[float, float, float],
    half: tuple[float, float, float],
    quat: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0),
) -> Prim:
    """A box collider with half sizes [m] and quat_wxyz about `centre` [m]."""
    cube = UsdGeom.Cube.Define(stage, path)
    cube.CreateSizeAttr(2.0)
    cube.CreateExtentAttr([(-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)])
    place(cube.GetPrim(), centre, quat)
    cube.AddScaleOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*half))
    _make_collider(cube, mesh=False)
    return cube.GetPrim()


def define_mesh(
    stage: Stage, path: PrimPath, points: NDArray[Any], faces: NDArray[np.int32], normals: NDArray[Any]
) -> Shape:
    """A polygonal mesh.

    Args:
        stage: where to define it.
        path: of the prim.
        points: [m], shape (n, 3).
        faces: triangles or quadrilaterals, shape (faces, corners).
        normals: of every face corner, shape (faces, corners, 3).
    """
    mesh = UsdGeom.Mesh.Define(stage, path)
    single = _single(points)
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(single))
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.stack([single.min(axis=0), single.max(axis=0)])))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(len(faces), faces.shape[1], dtype=np.int32)))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(np.ascontiguousarray(faces, dtype=np.int32).reshape(-1)))
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(_single(normals.reshape(-1, 3))))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.faceVarying)
    return mesh


def place(
    prim: Prim, position: tuple[float, float, float], quat: tuple[float, float, float, float] | None = None
) -> None:
    """Author translation [m] and, where given, orientation (quat_wxyz) in double precision."""
    xform = UsdGeom.Xformable(prim)
    xform.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*position))
    if quat is not None:
        xform.AddOrientOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Quatd(*quat))


def _mass(prim: Prim, properties: MassProperties) -> None:
    """Mass, centre and principal inertia."""
    moments, (w, x, y, z) = principal_frame(np.array(properties.inertia))
    first, second, largest = map(float, _single(moments))
    # The largest moment of a sheet is the sum of the others; rounding must not make it more.
    while largest > first + second:
        largest = float(np.nextafter(np.float32(largest), np.float32(0)))
    mass = UsdPhysics.MassAPI.Apply(prim)
    mass.CreateMassAttr(properties.mass)
    mass.CreateCenterOfMassAttr(Gf.Vec3f(*properties.centre_of_mass))
    mass.CreateDiagonalInertiaAttr(Gf.Vec3f(first, second, largest))
    mass.CreatePrincipalAxesAttr(Gf.Quatf(w, x, y, z))


def _visual(stage: Stage, path: PrimPath, mesh: VisualMesh) -> None:
    """The textured mesh."""
    points = _apart(mesh.vertices, mesh.faces)
    prim = define_mesh(stage, path, points, mesh.faces, corner_normals(mesh.vertices, mesh.faces))
    uv, index = np.unique(mesh.uv.reshape(-1, 2), axis=0, return_inverse=True)
    coordinates = UsdGeom.PrimvarsAPI(prim).CreatePrimvar(
        "st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying
    )
    coordinates.Set(Vt.Vec2fArray.FromNumpy(_single(uv)))
    coordinates.SetIndices(Vt.IntArray.FromNumpy(np.ascontiguousarray(index.reshape(-1), dtype=np.int32)))


def _apart(vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> NDArray[np.float32]:
    """`vertices` [m], shape (n, 3), in single precision, no two the same and none on a line with the rest of its face.

    Solids that touch have points in common. Welded they would share edges, and without their narrowest faces they would
    have holes: one broken surface of two whole ones. So such points move by the width of a rounding error instead.
    """
    points = _single(vertices) + np.float32(0.0)
    step = np.spacing(np.abs(points).max())
    for _ in range(_TRIES):
        _, group, count = np.unique(points, axis=0, return_inverse=True, return_counts=True)
        order = np.argsort(group.reshape(-1), kind="stable")
        rank = np.arange(len(points)) - np.repeat(np.cumsum(count) - count, count)
        points[order, 0] += rank.astype(np.float32) * step
        corners = points[faces]
        flat = np.flatnonzero(triangle_areas(corners) == 0.0)
        if len(flat) == 0 and (count == 1).all():
            break
        edges = np.roll(corners[flat], 1, axis=1) - np.roll(corners[flat], -1, axis=1)
        opposite = np.argmax(np.linalg.norm(edges, axis=2), axis=1)
        across = np.argmin(np.abs(edges[np.arange(len(flat)), opposite]), axis=1)
        points[faces[flat, opposite], across] += step
    return points


def textured_material(
    stage: Stage, path: PrimPath, texture: str, look: Look, maps: Mapping[str, str] | None = None
) -> Surface:
    """A UsdPreviewSurface of `look` that takes its colour from the image at `texture`, relative to the layer.

    Where `maps` names a file for "normal", "roughness", "metallic" or "opacity", that comes from there.
    """
    material = UsdShade.Material.Define(stage, path)
    surface = plain_surface(stage, material, look)
    reader = UsdShade.Shader.Define(stage, path.AppendChild("st"))
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    source = reader.CreateOutput("result", Sdf.ValueTypeNames.Float2)

    def picture(name: str, file: str, space: str) -> Any:
        image = UsdShade.Shader.Define(stage, path.AppendChild(name))
        image.CreateIdAttr("UsdUVTexture")
        image.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(Sdf.AssetPath(file))
        image.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set(space)
        for axis in ("wrapS", "wrapT"):
            image.CreateInput(axis, Sdf.ValueTypeNames.Token).Set("repeat")
        image.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(source)
        return image

    colour = surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    colour.ConnectToSource(picture("texture", texture, "sRGB").CreateOutput("rgb", Sdf.ValueTypeNames.Float3))
    for name, file in (maps or {}).items():
        image = picture(f"{name}_map", file, "raw")
        if name == "normal":
            # From bytes to components between -1 and 1.
            image.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(2.0, 2.0, 2.0, 1.0))
            image.CreateInput("bias", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(-1.0, -1.0, -1.0, 0.0))
            target = surface.CreateInput("normal", Sdf.ValueTypeNames.Normal3f)
            target.ConnectToSource(image.CreateOutput("rgb", Sdf.ValueTypeNames.Float3))
        else:
            target = surface.CreateInput(name, Sdf.ValueTypeNames.Float)
            target.ConnectToSource(image.CreateOutput("r", Sdf.ValueTypeNames.Float))
    return material


def plain_surface(stage: Stage, material: Surface, look: Look) -> Prim:
    """The UsdPreviewSurface of `material`, without a colour."""
    surface = UsdShade.Shader.Define(stage, material.GetPath().AppendChild("surface"))
    surface.CreateIdAttr("UsdPreviewSurface")
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(look.roughness)
    surface.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(look.metallic)
    if look.opacity < 1.0:
        surface.CreateInput("opacity", Sdf.ValueTypeNames.Float).Set(look.opacity)
    material.CreateSurfaceOutput().ConnectToSource(surface.CreateOutput("surface", Sdf.ValueTypeNames.Token))
    return surface


def _part(stage: Stage, path: PrimPath, part: ConvexPart, friction: Surface, *, as_mesh: bool) -> None:
    """One convex part as a collider."""
    if part.box is not None and not as_mesh:
        prim = define_box(stage, path, *part.box)
    else:
        centre = part.bounds.mean(axis=0)
        local = part.vertices - centre
        corners = local[part.faces]
        mesh = define_mesh(stage, path, local, part.faces, np.repeat(unit_normals(corners)[:, None], 3, axis=1))
        prim = mesh.GetPrim()
        place(prim, tuple(centre.tolist()))
        UsdPhysics.MeshCollisionAPI.Apply(prim).CreateApproximationAttr(UsdPhysics.Tokens.convexHull)
        _make_collider(mesh, mesh=True)
    bind_physics(prim, friction)


def _make_collider(shape: Shape, *, mesh: bool) -> None:
    """Make `shape` collide, shown only as a guide."""
    shape.CreatePurposeAttr(UsdGeom.Tokens.guide)
    shape.CreateDisplayColorAttr([GUIDE_COLOUR])
    shape.CreateDisplayOpacityAttr([0.5])
    UsdPhysics.CollisionAPI.Apply(shape.GetPrim())
    extend_collider(shape.GetPrim(), mesh=mesh)


def _single(values: NDArray[Any]) -> NDArray[np.float32]:
    return np.ascontiguousarray(values, dtype=np.float32)
