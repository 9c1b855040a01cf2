"""A clean scene, one planted fault a rule: the rule finds it, and no other rule complains."""

import numpy as np
import pytest

pytest.importorskip("pxr")
from pxr import Gf, Sdf, Usd, UsdGeom, UsdPhysics, UsdShade, UsdValidation

from pat3d.assets.shapes import box, cylinder, vessel
from pat3d.check.usd_lint.rules import RULES, lint_usd
from pat3d.exporters.usd.writer import write_usd, write_usd_asset
from pat3d.scene.model import Attachment
from tests.scenes import GAP, asset_of, placed, scene_of

CAN = "/World/can"
JOINT = "/World/Joints/bar__beam_00"
PART = f"{CAN}/collision/part_000"
NAN = float("nan")


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    anchors = (((0.0, 0.0, 0.04), (0.0, 0.0, -0.002)),)
    scene = scene_of(
        placed("table", asset_of(box(0.8, 0.5, 0.04)), (0, 0, GAP), fixed=True),
        placed("can", asset_of(cylinder(0.03, 0.08)), (0.1, 0, 0.04 + 2 * GAP)),
        placed("mug", asset_of(vessel([(0.03, 0), (0.04, 0.09)], [(0.026, 0.006), (0.036, 0.09)])), (0, 0, 0.0401)),
        placed("beam", asset_of(box(0.5, 0.1, 0.1)), (0, 0, 1)),
        placed("bar", asset_of(box(0.3, 0.04, 0.04)), (0, 0, 0.958)),
        attachments=(Attachment(child="bar", parent="beam", anchors=anchors),),
    )
    return write_usd(scene, tmp_path_factory.mktemp("lint") / "usd", package=True)


@pytest.fixture
def stage(written, tmp_path):
    """The scene in one flat layer, to plant a fault in."""
    path = tmp_path / "flat.usda"
    Usd.Stage.Open(str(written)).Export(str(path))
    return Usd.Stage.Open(str(path))


def _rules(stage):
    stage.Save()
    return {finding.rule for finding in lint_usd(stage.GetRootLayer().realPath)}


def _prim(stage, path):
    return stage.GetPrimAtPath(path)


def _mass(stage):
    return UsdPhysics.MassAPI(_prim(stage, CAN))


def _friction(stage):
    return UsdPhysics.MaterialAPI(_prim(stage, f"{CAN}/materials/physics"))


def _other_friction(stage):
    material = UsdShade.Material.Define(stage, "/World/other")
    physics = UsdPhysics.MaterialAPI.Apply(material.GetPrim())
    physics.CreateStaticFrictionAttr(0.9)
    physics.CreateDynamicFrictionAttr(0.9)
    UsdShade.MaterialBindingAPI(_prim(stage, PART)).Bind(material)


def _many_vertices(stage):
    points = np.random.default_rng(0).normal(size=(80, 3))
    points *= 0.03 / np.linalg.norm(points, axis=1, keepdims=True)
    UsdGeom.Mesh(_prim(stage, PART)).GetPointsAttr().Set([Gf.Vec3f(*map(float, point)) for point in points])


def _hollow(stage):
    """The can's top pushed down to a tenth of its height: a hull would fill the dent."""
    mesh = UsdGeom.Mesh(_prim(stage, PART))
    points = [Gf.Vec3f(x, y, z) for x, y, z in mesh.GetPointsAttr().Get()]
    faces = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    tops = [face for face in faces.tolist() if all(points[corner][2] > 0.03 for corner in face)]
    middle = len(points)
    rim = {}
    for face in tops:
        for a, b in zip(face, face[1:] + face[:1], strict=True):
            rim.pop((b, a), None) if (b, a) in rim else rim.setdefault((a, b))
    kept = [face for face in faces.tolist() if face not in tops] + [[a, b, middle] for a, b in rim]
    mesh.GetPointsAttr().Set([*points, Gf.Vec3f(0, 0, -0.03)])
    mesh.GetFaceVertexIndicesAttr().Set([corner for face in kept for corner in face])
    mesh.GetFaceVertexCountsAttr().Set([3] * len(kept))


def _nest(stage):
    """The mug moved under the can, where it stands in the world as before."""
    layer = stage.GetRootLayer()
    Sdf.CopySpec(layer, Sdf.Path("/World/mug"), layer, Sdf.Path(f"{CAN}/mug"))
    stage.RemovePrim("/World/mug")
    place = UsdGeom.Xformable(_prim(stage, f"{CAN}/mug")).GetOrderedXformOps()[0]
    place.Set(Gf.Vec3d(-0.1, 0, 1e-4))


def _turned_hinge(stage):
    prim = _prim(stage, JOINT)
    prim.SetTypeName("PhysicsRevoluteJoint")
    UsdPhysics.Joint(prim).GetLocalRot1Attr().Set(Gf.Quatf(0.5, 0.5, 0.5, 0.5))


def _turn(stage, path, w, x, y, z, *, time=None):
    """Turn the prim at `path`, at `time` alone where one is given: a body in double, a part in single precision."""
    prim = UsdGeom.Xformable(_prim(stage, path))
    turns = [op for op in prim.GetOrderedXformOps() if op.GetOpType() == UsdGeom.XformOp.TypeOrient]
    op, kind = (turns[0], Gf.Quatd) if turns else (prim.AddOrientOp(), Gf.Quatf)
    if time is None:
        op.Set(kind(w, x, y, z))
    else:
        op.Set(kind(1, 0, 0, 0))
        op.Set(kind(w, x, y, z), time)


def _twin_scene(stage):
    UsdPhysics.Scene.Define(stage, "/World/Another")


FAULTS = {
    "axis": ("units", lambda stage: UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)),
    "centimetres": ("units", lambda stage: UsdGeom.SetStageMetersPerUnit(stage, 0.01)),
    "default prim": ("units", lambda stage: stage.ClearDefaultPrim()),
    "no physics scene": ("physics-scene", lambda stage: stage.RemovePrim("/World/PhysicsScene")),
    "two physics scenes": ("physics-scene", _twin_scene),
    "gravity": (
        "physics-scene",
        lambda stage: UsdPhysics.Scene(_prim(stage, "/World/PhysicsScene")).GetGravityMagnitudeAttr().Set(981.0),
    ),
    "articulation": ("articulation", lambda stage: UsdPhysics.ArticulationRootAPI.Apply(_prim(stage, CAN))),
    "nested bodies": ("nested-bodies", _nest),
    "missing collider": ("missing-collider", lambda stage: _prim(stage, PART).RemoveAPI(UsdPhysics.CollisionAPI)),
    "disabled collider": (
        "missing-collider",
        lambda stage: UsdPhysics.CollisionAPI(_prim(stage, PART)).CreateCollisionEnabledAttr(False),
    ),
    "no mass": ("mass", lambda stage: _prim(stage, CAN).RemoveProperty("physics:mass")),
    "zero mass": ("mass", lambda stage: _mass(stage).GetMassAttr().Set(0.0)),
    "no centre": ("mass", lambda stage: _prim(stage, CAN).RemoveProperty("physics:centerOfMass")),
    "centre outside": ("mass", lambda stage: _mass(stage).GetCenterOfMassAttr().Set(Gf.Vec3f(0, 0, 0.5))),
    "mass on collider": ("mass-on-collider", lambda stage: UsdPhysics.MassAPI.Apply(_prim(stage, PART))),
    "triangle inequality": (
        "inertia",
        lambda stage: _mass(stage).GetDiagonalInertiaAttr().Set(Gf.Vec3f(1e-5, 1e-5, 2.1e-5)),
    ),
    "no inertia": ("inertia", lambda stage: _mass(stage).GetDiagonalInertiaAttr().Set(Gf.Vec3f(0, 0, 0))),
    "principal axes of zeros": (
        "placement",
        lambda stage: _mass(stage).GetPrincipalAxesAttr().Set(Gf.Quatf(0, 0, 0, 0)),
    ),
    "principal axes of NaN": (
        "placement",
        lambda stage: _mass(stage).GetPrincipalAxesAttr().Set(Gf.Quatf(NAN, 0, 0, 0)),
    ),
    "principal axes twice too long": (
        "placement",
        lambda stage: _mass(stage).GetPrincipalAxesAttr().Set(Gf.Quatf(2, 0, 0, 0)),
    ),
    "body turned by zeros": ("placement", lambda stage: _turn(stage, CAN, 0, 0, 0, 0)),
    "body turned by NaN": ("placement", lambda stage: _turn(stage, CAN, 1, NAN, 0, 0)),
    "body turned by zeros later": ("placement", lambda stage: _turn(stage, CAN, 0, 0, 0, 0, time=12.0)),
    "collider turned by zeros": ("placement", lambda stage: _turn(stage, PART, 0, 0, 0, 0)),
    "collider turned by NaN": ("placement", lambda stage: _turn(stage, PART, NAN, 0, 0, 0)),
    "joint turned by zeros": (
        "placement",
        lambda stage: UsdPhysics.Joint(_prim(stage, JOINT)).GetLocalRot0Attr().Set(Gf.Quatf(0, 0, 0, 0)),
    ),
    "joint turned by NaN": (
        "placement",
        lambda stage: UsdPhysics.Joint(_prim(stage, JOINT)).GetLocalRot1Attr().Set(Gf.Quatf(0, 0, NAN, 0)),
    ),
    "placed at NaN": (
        "placement",
        lambda stage: UsdGeom.Xformable(_prim(stage, CAN)).GetOrderedXformOps()[0].Set(Gf.Vec3d(NAN, 0, 0.1)),
    ),
    "scaled body": (
        "scale",
        lambda stage: UsdGeom.Xformable(_prim(stage, CAN)).AddScaleOp().Set(Gf.Vec3f(1, 1, 0.5)),
    ),
    "scaled collider": (
        "scale",
        lambda stage: UsdGeom.Xformable(_prim(stage, PART)).AddScaleOp().Set(Gf.Vec3f(1, 0.5, 1)),
    ),
    "mirrored collider": (
        "scale",
        lambda stage: UsdGeom.Xformable(_prim(stage, PART)).AddScaleOp().Set(Gf.Vec3f(1, -1, 1)),
    ),
    "triangle mesh": (
        "approximation",
        lambda stage: UsdPhysics.MeshCollisionAPI(_prim(stage, PART)).GetApproximationAttr().Set("none"),
    ),
    "too many vertices": ("hull", _many_vertices),
    "hollow": ("hull", _hollow),
    "flat hull": (
        "hull",
        lambda stage: (
            UsdGeom.Mesh(_prim(stage, PART))
            .GetPointsAttr()
            .Set([(x, y, y) for x in (-0.03, 0.03) for y in (-0.03, 0.03)])
        ),
    ),
    "negative friction": ("friction", lambda stage: _friction(stage).GetStaticFrictionAttr().Set(-0.5)),
    "dynamic above static": ("friction", lambda stage: _friction(stage).GetDynamicFrictionAttr().Set(0.9)),
    "no friction": (
        "friction",
        lambda stage: UsdShade.MaterialBindingAPI(_prim(stage, PART)).UnbindAllBindings(),
    ),
    "friction that MuJoCo misses": ("friction", _other_friction),
    "open joint": (
        "joint",
        lambda stage: UsdPhysics.Joint(_prim(stage, JOINT)).GetLocalPos1Attr().Set((0, 0, 0.1)),
    ),
    "turned hinge": ("joint", _turned_hinge),
    "joint to nothing": (
        "joint",
        lambda stage: UsdPhysics.Joint(_prim(stage, JOINT)).GetBody0Rel().SetTargets(["/World/no"]),
    ),
    "into the table": (
        "penetration",
        lambda stage: UsdGeom.Xformable(_prim(stage, CAN)).GetOrderedXformOps()[0].Set(Gf.Vec3d(0.1, 0, 0.0399)),
    ),
    "into the mug": (
        "penetration",
        lambda stage: UsdGeom.Xformable(_prim(stage, CAN)).GetOrderedXformOps()[0].Set(Gf.Vec3d(0.06, 0, 0.0401)),
    ),
    "into the ground": (
        "penetration",
        lambda stage: UsdGeom.Xformable(_prim(stage, CAN)).GetOrderedXformOps()[0].Set(Gf.Vec3d(1.0, 0, -0.001)),
    ),
}


def test_what_the_exporter_writes_is_clean(written, tmp_path):
    assert lint_usd(written) == ()
    assert lint_usd(written.with_suffix(".usdz")) == ()
    assert lint_usd(write_usd_asset(asset_of(cylinder(0.03, 0.08)), tmp_path / "one")) == ()


def test_the_flat_copy_is_clean_too(stage):
    assert _rules(stage) == set()


@pytest.mark.parametrize("fault", FAULTS)
def test_a_planted_fault_is_found_by_its_rule_alone(fault, stage):
    rule, plant = FAULTS[fault]
    plant(stage)
    assert _rules(stage) == {rule}


def test_every_rule_has_a_planted_fault():
    assert {rule for rule, _ in FAULTS.values()} == set(RULES)


def test_validators_let_most_of_these_faults_pass(stage):
    """Why the lint is there: OpenUSD's validators have nothing to say of a mass that no solid can have."""
    for fault in ("triangle inequality", "negative friction", "missing collider", "into the table", "no physics scene"):
        FAULTS[fault][1](stage)
    registry = UsdValidation.ValidationRegistry()
    assert not UsdValidation.ValidationContext(registry.GetOrLoadAllValidators()).Validate(stage)


def test_a_pair_whose_joint_switches_collision_off_may_overlap(stage):
    joint = UsdPhysics.Joint(_prim(stage, JOINT))
    raised = UsdGeom.Xformable(_prim(stage, "/World/bar")).GetOrderedXformOps()[0]
    raised.Set(Gf.Vec3d(0, 0, 0.961))
    joint.GetLocalPos1Attr().Set((0, 0, 0.037))
    assert _rules(stage) == {"penetration"}
    joint.GetCollisionEnabledAttr().Set(False)
    assert _rules(stage) == set()
