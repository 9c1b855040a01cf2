"""A scene as a USD layer that references one layer an asset.

The prims, and what is below them:

    /World                  the default prim
    /World/PhysicsScene     gravity and the settings of solvers
    /World/Ground           a box whose top is z = 0
    /World/<object>         a reference to assets/<name>/<name>.usdc, at its pose
    /World/Joints/...       what hangs by points
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.exporters.common.margins import contact_margins, flush_boxes
from pat3d.exporters.common.objects import CONTACT_GAP, GROUND_HALF_THICKNESS, body_names, ground_size
from pat3d.exporters.usd.asset_layer import (
    bind_physics,
    define_box,
    define_mesh,
    part_name,
    physics_material,
    place,
    plain_surface,
    set_metadata,
    write_asset,
)
from pat3d.exporters.usd.engine_schemas import extend_joint, extend_margin, extend_scene, shorten_body
from pat3d.exporters.usd.openusd import Gf, Kind, Sdf, Stage, Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade, Vt
from pat3d.geometry.contacts import find_contacts
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Surface
from pat3d.scene.model import Attachment, Scene
from pat3d.scene.physics import GRAVITY, ground_friction

LIGHTING = {"physical": (0.4, 1.5), "omniverse": (400.0, 1500.0)}
"""Luminance of the sky [nit] and irradiance of the sun [lux] in either choice, the first the default."""

_SAME_POINT = 1e-6
"""Anchors closer than this [m], or closer to one line, are one point, or one line."""


def prim_name(slug: str) -> str:
    """The prim name of a slug: itself, or with an underscore before a digit, as USD demands."""
    return f"_{slug}" if slug[0].isdigit() else slug


def write_scene(scene: Scene, folder: Path, *, suffix: str, levels: Sequence[int] = ()) -> Path:
    """Write `scene` and its assets as layers with the file name suffix "usdc" or "usda" into the empty `folder`.

    `levels` are most triangles of coarser levels of detail.
    """
    contacts = find_contacts(scene.objects, CONTACT_GAP)
    margins, flush = contact_margins(scene, contacts), flush_boxes(scene, contacts)
    path = folder / f"scene.{suffix}"
    stage = Usd.Stage.CreateNew(str(path))
    world = UsdGeom.Xform.Define(stage, "/World").GetPrim()
    set_metadata(stage, world)
    Usd.ModelAPI(world).SetKind(Kind.Tokens.assembly)
    stage.GetRootLayer().customLayerData = {
        "pat3d": {
            "prompt": scene.prompt,
            "seed": str(scene.seed),
            "settling_friction": scene.settling_friction,
            **({"levels": Vt.IntArray(list(levels))} if levels else {}),
        }
    }
    physics = UsdPhysics.Scene.Define(stage, "/World/PhysicsScene")
    physics.CreateGravityDirectionAttr(Gf.Vec3f(0.0, 0.0, -1.0))
    physics.CreateGravityMagnitudeAttr(GRAVITY)
    extend_scene(physics.GetPrim())
    _surroundings(stage, scene)
    names = {name: prim_name(slug) for name, slug in body_names(scene).items()}
    stored: dict[int, str] = {}
    uses = Counter(id(obj.asset) for obj in scene.objects)
    for obj, margin in zip(scene.objects, margins, strict=True):
        name, asset = names[obj.name], obj.asset
        if id(asset) not in stored:
            stored[id(asset)] = f"./assets/{name}/{name}.{suffix}"
            (folder / "assets" / name).mkdir(parents=True)
            write_asset(
                asset,
                name,
                folder / stored[id(asset)],
                as_mesh=id(asset) in flush,
                instanceable=uses[id(asset)] > 1,
                levels=levels,
            )
        prim = UsdGeom.Xform.Define(stage, f"/World/{name}").GetPrim()
        prim.GetReferences().AddReference(stored[id(asset)])
        prim.SetDisplayName(obj.name)
        place(prim, obj.pose.position, obj.pose.quat_wxyz)
        if obj.fixed:
            prim.RemoveAPI(UsdPhysics.RigidBodyAPI)
            # The numbers stay for who wants them; the schema belongs on what moves.
            prim.RemoveAPI(UsdPhysics.MassAPI)
            shorten_body(prim)
        for number in range(len(asset.parts) if margin > 0.0 else 0):
            extend_margin(stage.OverridePrim(f"/World/{name}/collision/{part_name(number)}"), margin)
    moving = [one for one in scene.attachments if not (scene[one.child].fixed and scene[one.parent].fixed)]
    if moving:
        UsdGeom.Scope.Define(stage, "/World/Joints")
    for one in moving:
        _joints(stage, scene, names, one)
    stage.Save()
    return path


def _surroundings(stage: Stage, scene: Scene) -> None:
    """The ground, two lights, and a camera where the viewer of the relations stands."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    low, high = points.min(axis=0), points.max(axis=0)
    centre, reach = (low + high) / 2, max(float(np.linalg.norm(high - low)), 0.2)
    side = max(ground_size(scene)[0] / 2, 4.0 * reach)
    UsdGeom.Xform.Define(stage, "/World/Ground")
    materials = UsdGeom.Scope.Define(stage, "/World/Ground/materials").GetPath()
    friction = ground_friction(scene.settling_friction)
    box = define_box(
        stage,
        Sdf.Path("/World/Ground/collision"),
        (0.0, 0.0, -GROUND_HALF_THICKNESS),
        (side, side, GROUND_HALF_THICKNESS),
    )
    bind_physics(box, physics_material(stage, materials.AppendChild("physics"), friction))
    look = UsdShade.Material.Define(stage, materials.AppendChild("visual"))
    colour = plain_surface(stage, look, Surface(roughness=0.9)).CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    colour.Set(Gf.Vec3f(0.56, 0.54, 0.51))
    corners = side * np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
    normals = np.tile([0.0, 0.0, 1.0], (1, 4, 1))
    floor = define_mesh(stage, Sdf.Path("/World/Ground/visual"), corners, np.array([[0, 1, 2, 3]], np.int32), normals)
    UsdShade.MaterialBindingAPI.Apply(floor.GetPrim()).Bind(look)

    _lights(stage)
    camera = UsdGeom.Camera.Define(stage, "/World/Camera")
    eye = centre + 1.5 * reach * np.array([0.0, -1.0, 0.5])
    tilt = float(np.degrees(np.arctan2(1.0, 0.5)))
    camera.AddTranslateOp(UsdGeom.XformOp.PrecisionDouble).Set(Gf.Vec3d(*eye.tolist()))
    camera.AddRotateXOp().Set(tilt)
    camera.CreateClippingRangeAttr(Gf.Vec2f(0.01, 1000.0))
    camera.CreateFocalLengthAttr(25.0)


def _lights(stage: Stage) -> None:
    """A sky and a sun, as bright as the choice of the variant set "lighting" says.

    In UsdLux's own units a white diffuse ground comes out just below white; Blender, Storm and other readers of the
    units take them so. Omniverse's camera has the exposure of a photographer's, for which that is night.
    """
    lights = UsdGeom.Scope.Define(stage, "/World/Lights").GetPrim()
    sky = UsdLux.DomeLight.Define(stage, "/World/Lights/Sky")
    sun = UsdLux.DistantLight.Define(stage, "/World/Lights/Sun")
    sun.CreateAngleAttr(3.0)
    # Irradiance, whatever the angle.
    sun.CreateNormalizeAttr(True)
    sun.AddRotateXYZOp().Set(Gf.Vec3f(35.0, -25.0, 0.0))
    lighting = lights.GetVariantSets().AddVariantSet("lighting")
    for name, (diffuse, direct) in LIGHTING.items():
        lighting.AddVariant(name)
        lighting.SetVariantSelection(name)
        with lighting.GetVariantEditContext():
            sky.CreateIntensityAttr(diffuse)
            sun.CreateIntensityAttr(direct)
    lighting.SetVariantSelection(next(iter(LIGHTING)))


def _joints(stage: Stage, scene: Scene, names: dict[str, str], one: Attachment) -> None:
    """One joint that leaves two bodies the freedom of their anchors, and for MuJoCo a point of every anchor.

    One anchor is a ball joint, anchors on a line are a hinge, others a weld. Ball joints for each would mean the same,
    but two of them between one pair of bodies blow up in PhysX. MuJoCo's schema makes every anchor a connect
    constraint; those beyond the first are joints that constrain nothing for who does not read it.

    The frames come from the poses at rest, so every joint starts closed, whatever its anchors gave way under load. What
    is fixed is the world, to which a joint without a body is tied: a joint to a prim that is no rigid body means the
    same, but not to every reader.
    """
    child, parent = scene[one.child], scene[one.parent]
    points, _ = one.ends(child.pose, parent.pose)
    kind, axes = _freedom(points)
    for number, point in enumerate(points):
        path = f"/World/Joints/{names[one.child]}__{names[one.parent]}_{number:02d}"
        joint = (UsdPhysics.Joint if number else kind).Define(stage, path)
        if not number and kind is not UsdPhysics.FixedJoint:
            joint.CreateAxisAttr(UsdPhysics.Tokens.x)
        frame = Pose.from_matrix(axes, point)
        for obj, body, position, turn in (
            (parent, joint.CreateBody0Rel(), joint.CreateLocalPos0Attr(), joint.CreateLocalRot0Attr()),
            (child, joint.CreateBody1Rel(), joint.CreateLocalPos1Attr(), joint.CreateLocalRot1Attr()),
        ):
            if not obj.fixed:
                body.SetTargets([f"/World/{names[obj.name]}"])
            local = _within(Pose() if obj.fixed else obj.pose, frame)
            position.Set(Gf.Vec3f(*local.position))
            turn.Set(Gf.Quatf(*local.quat_wxyz))
        joint.CreateCollisionEnabledAttr(True)
        extend_joint(joint.GetPrim())


def _freedom(points: NDArray[np.float64]) -> tuple[Any, NDArray[np.float64]]:
    """The type of joint that keeps `points` [m], shape (n, 3), together, and its axes, x along a line of them."""
    spread = points - points.mean(axis=0)
    along = spread[np.argmax(np.linalg.norm(spread, axis=1))]
    if np.linalg.norm(along) < _SAME_POINT:
        return UsdPhysics.SphericalJoint, np.eye(3)
    x = along / np.linalg.norm(along)
    z = np.cross(x, np.eye(3)[np.argmin(np.abs(x))])
    z /= np.linalg.norm(z)
    straight = np.linalg.norm(np.cross(spread, x), axis=1).max() < _SAME_POINT
    return UsdPhysics.RevoluteJoint if straight else UsdPhysics.FixedJoint, np.stack([x, np.cross(z, x), z], axis=1)


def _within(pose: Pose, frame: Pose) -> Pose:
    """`frame` seen from `pose`."""
    place = pose.rotation.T @ (np.array(frame.position) - np.array(pose.position))
    return Pose.from_matrix(pose.rotation.T @ frame.rotation, place)
