"""On USD."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from benchmarks.attacks.deeds import Deed, more, one, remove, swap


def usd(change: Callable[[Any], Any], file: str = "usd/scene.usdc") -> Deed:
    """Change the stage of a USD layer."""

    def deed(folder: Path) -> Any:
        from pxr import Sdf, Usd

        layer = Sdf.Layer.OpenAsAnonymous(str(one(folder, file)))
        done = change(Usd.Stage.Open(layer))
        layer.Export(str(one(folder, file)))
        return done

    return deed


def attribute(path: str, name: str, value: Any, kind: str = "Float") -> Callable[[Any], Any]:
    """Another value of an attribute, made where there is none; "*" in `path` is the first free object."""

    def change(stage: Any) -> Any:
        from pxr import Sdf

        prim = stage.OverridePrim(path.replace("*", _first(stage)) if "*" in path else path)
        prim.CreateAttribute(name, getattr(Sdf.ValueTypeNames, kind)).Set(value)

    return change


def _first(stage: Any) -> str:
    """Name of the first object of a stage whose references are not loaded."""
    return next(prim.GetName() for prim in stage.GetPrimAtPath("/World").GetChildren() if prim.HasAuthoredReferences())


def fixed_joint(stage: Any) -> None:
    """An object tied to the world."""
    from pxr import UsdPhysics

    made = UsdPhysics.FixedJoint.Define(stage, "/World/hidden")
    made.CreateBody1Rel().SetTargets([f"/World/{_first(stage)}"])


def variant(stage: Any) -> None:
    """A variant that nobody has selected yet."""
    sets = stage.GetPrimAtPath(f"/World/{_first(stage)}").GetVariantSets().AddVariantSet("look")
    sets.AddVariant("other")


def animated(stage: Any) -> None:
    """An object that is elsewhere at another time."""
    from pxr import Gf

    place = stage.GetPrimAtPath(f"/World/{_first(stage)}").GetAttribute("xformOp:translate")
    place.Set(Gf.Vec3d(0, 0, 1), 24)


def units(stage: Any) -> None:
    """Everything a hundred times as small."""
    from pxr import UsdGeom

    UsdGeom.SetStageMetersPerUnit(stage, 0.01)


def crutch(stage: Any) -> None:
    """A collider that nobody sees."""
    from pxr import UsdGeom, UsdPhysics

    cube = UsdGeom.Cube.Define(stage, "/World/crutch")
    cube.CreateVisibilityAttr("invisible")
    UsdPhysics.CollisionAPI.Apply(cube.GetPrim())


def sublayer(folder: Path) -> None:
    """Another layer below the scene."""
    more("usd/more.usda", "#usda 1.0\n")(folder)
    usd(lambda stage: stage.GetRootLayer().subLayerPaths.append("more.usda"))(folder)


def asset_points(stage: Any) -> Any:
    """A visual mesh 5 cm above what collides."""
    from pxr import UsdGeom

    mesh = next(prim for prim in stage.TraverseAll() if prim.IsA(UsdGeom.Mesh) and "visual" in str(prim.GetPath()))
    points = UsdGeom.Mesh(mesh).GetPointsAttr()
    points.Set([(x, y, z + 0.05) for x, y, z in points.Get()])


def asset_part(stage: Any) -> Any:
    """A part that is not convex, where the asset has a part that is no box."""
    from pxr import UsdGeom

    meshes = (prim for prim in stage.TraverseAll() if prim.IsA(UsdGeom.Mesh) and "collision" in str(prim.GetPath()))
    mesh = next(meshes, None)
    if mesh is None:
        return False
    points = UsdGeom.Mesh(mesh).GetPointsAttr()
    held = [tuple(point) for point in points.Get()]
    points.Set([tuple(0.1 * value for value in held[0]), *held[1:]])
    return True


def weight(stage: Any) -> Any:
    """An object of a gram."""
    for prim in stage.TraverseAll():
        if prim.GetAttribute("physics:mass").HasAuthoredValue():
            prim.GetAttribute("physics:mass").Set(0.001)
            return True
    return False


SCENE, FIRST, GROUND_SURFACE = "/World/PhysicsScene", "/World/*", "/World/Ground/materials/physics"

USD: dict[str, Deed] = {
    "gravity 0.5": usd(attribute(SCENE, "physics:gravityMagnitude", 0.5)),
    "gravity sideways": usd(attribute(SCENE, "physics:gravityDirection", (1, 0, 0), "Vector3f")),
    "time step": usd(attribute(SCENE, "physxScene:timeStepsPerSecond", 10, "UInt")),
    "MuJoCo's time step": usd(attribute(SCENE, "mjc:option:timestep", 0.02, "Double")),
    "solver of PhysX": usd(attribute(SCENE, "physxScene:solverType", "PGS", "Token")),
    "fixed joint": usd(fixed_joint),
    "damping": usd(attribute(FIRST, "physxRigidBody:linearDamping", 50.0)),
    "kinematic": usd(attribute(FIRST, "physics:kinematicEnabled", True, "Bool")),
    "no gravity on one": usd(attribute(FIRST, "physxRigidBody:disableGravity", True, "Bool")),
    "starts moving": usd(attribute(FIRST, "physics:velocity", (0, 0, 1), "Vector3f")),
    "mass overridden": usd(attribute(FIRST, "physics:mass", 0.001)),
    "moved 0.01 mm": usd(lambda s: attribute(FIRST, "xformOp:translate", (0.0, 0.0, 1e-5), "Double3")(s)),
    "animated": usd(animated),
    "ground friction": usd(attribute(GROUND_SURFACE, "physics:dynamicFriction", 5.0)),
    "friction combined otherwise": usd(attribute(GROUND_SURFACE, "physxMaterial:frictionCombineMode", "min", "Token")),
    "ground does not collide": usd(attribute("/World/Ground/collision", "physics:collisionEnabled", False, "Bool")),
    "invisible crutch": usd(crutch),
    "variant": usd(variant),
    "centimetres": usd(units),
    "sublayer": sublayer,
    "asset: visual lifted 5 cm": usd(asset_points, "usd/assets/*/*.usdc"),
    "asset: visual lifted by a transform": usd(
        lambda s: attribute(f"{s.GetDefaultPrim().GetPath()}/visual", "xformOp:translate", (0, 0, 0.05), "Double3")(s),
        "usd/assets/*/*.usdc",
    ),
    "asset: part not convex": lambda f: any(
        usd(asset_part, str(p.relative_to(f)))(f) for p in sorted(f.glob("usd/assets/*/*.usdc"))
    ),
    "asset: mass": usd(weight, "usd/assets/*/*.usdc"),
    "asset: layer swapped": swap("usd/assets/*/*.usdc"),
    "asset: texture swapped": swap("usd/assets/*/*.png"),
    "asset: missing": remove("usd/assets/*/*.usdc"),
    "a second scene beside it": more("usd/scene.usda", "#usda 1.0\n"),
}
