import os
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.distance import cdist
from scipy.spatial.transform import Rotation

pytest.importorskip("pxr")
from pxr import Usd, UsdGeom, UsdLux, UsdPhysics, UsdShade, UsdValidation

from pat3d.assets.catalogue import make
from pat3d.assets.shapes import box, cylinder, join, vessel
from pat3d.errors import ExportError
from pat3d.exporters.compare import parity
from pat3d.exporters.mjcf.writer import body_names
from pat3d.exporters.usd.reader import read_usd
from pat3d.exporters.usd.writer import write_usd, write_usd_asset
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.model import Attachment
from tests.scenes import GAP, asset_of, placed, scene_of, tower


def _lopsided() -> Asset:
    """A pencil-like asset of 2 g whose principal axes are none of the frame's."""
    pencil = join(cylinder(0.0035, 0.17), box(0.02, 0.004, 0.01)).turned("y", 70).turned("z", 20).moved(z=0.05)
    return asset_of(pencil)


def _sheet() -> Asset:
    """A tilted sheet of 0.3 mm far from the origin of its frame: what single precision treats worst."""
    return asset_of(
        join(box(0.3, 0.2, 0.0003), cylinder(0.002, 0.1)).turned("x", 37).turned("y", 21).moved(0.8, 0, 1.9)
    )


@pytest.fixture(scope="module")
def scene():
    quat = tuple(Rotation.random(random_state=np.random.default_rng(1)).as_quat(scalar_first=True))
    mug = asset_of(vessel([(0.03, 0), (0.04, 0.09)], [(0.026, 0.006), (0.036, 0.09)]))
    return scene_of(
        placed("wooden table", asset_of(box(0.8, 0.5, 0.04)), (0, 0, GAP), fixed=True),
        placed("red mug 1", mug, (0.1, 0, 0.04 + 2 * GAP)),
        placed("red mug 2", mug, (-0.1, 0.1, 0.04 + 2 * GAP)),
        placed("pencil & <co>", _lopsided(), pose=Pose(position=(0.3, 0.2, 0.4), quat_wxyz=quat)),  # type: ignore[arg-type]
        placed("ball", make("ball"), (0, -0.2, 0.3)),
        placed("3D sheet", _sheet(), pose=Pose(position=(2.0, 1.0, 1.0), quat_wxyz=quat)),  # type: ignore[arg-type]
        prompt="a “table”",
    )


@pytest.fixture(scope="module", params=["scene.usdc", "scene.usda", "scene.usdz"])
def written(request, scene, tmp_path_factory):
    """The scene in each of the three forms."""
    folder = tmp_path_factory.mktemp("usd") / "out"
    path = write_usd(scene, folder, text=request.param == "scene.usda", package=request.param == "scene.usdz")
    return path.with_name(request.param)


def _hung_bar(anchors, **settings):
    """A bar 1 m up, hung from a beam that stands on nothing because it is fixed."""
    return scene_of(
        placed("the beam", asset_of(box(0.5, 0.1, 0.1)), (0, 0, 1), fixed=True),
        placed("a bar", asset_of(box(0.3, 0.04, 0.04)), (0, 0, 0.958)),
        attachments=(Attachment(child="a bar", parent="the beam", anchors=tuple(anchors)),),
        **settings,
    )


PAIR = [((x, 0.0, 0.04), (x, 0.0, -0.002)) for x in (-0.1, 0.1)]


def _messages(path):
    registry = UsdValidation.ValidationRegistry()
    context = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators())
    return [error.GetErrorAsString() for error in context.Validate(Usd.Stage.Open(str(path)))]


def test_every_validator_of_openusd_is_content(written):
    assert len(UsdValidation.ValidationRegistry().GetOrLoadAllValidators()) >= 30
    assert _messages(written) == []


def test_every_validator_is_content_with_a_hinge_and_with_an_asset_alone(tmp_path):
    assert _messages(write_usd(_hung_bar(PAIR), tmp_path / "hung")) == []
    assert _messages(write_usd_asset(_lopsided(), tmp_path / "one", "pencil")) == []


def test_the_file_says_what_the_scene_says_to_a_millionth(scene, written):
    found = {body.name: body for body in read_usd(written)}
    names = body_names(scene)
    assert sorted(found) == sorted(names.values())
    for obj in scene.objects:
        body, expected = found[names[obj.name]], obj.asset.mass_properties
        inertia = np.array(expected.inertia)
        assert body.mass == pytest.approx(expected.mass, rel=1e-6)
        np.testing.assert_allclose(
            body.centre, expected.centre_of_mass, atol=1e-6 * np.linalg.norm(expected.centre_of_mass)
        )
        np.testing.assert_allclose(body.inertia, inertia, atol=1e-6 * np.abs(inertia).max())
        assert body.friction == pytest.approx(obj.asset.material.friction, rel=1e-6)
        assert len(body.hulls) == len(obj.asset.parts)
        for points, part in zip(body.hulls, obj.asset.parts, strict=True):
            # OpenUSD keeps points in single precision; a cube's corners have an order of their own.
            apart = cdist(points, part.vertices)
            assert max(apart.min(axis=0).max(), apart.min(axis=1).max()) < 1e-7 * obj.asset.size.max()
        np.testing.assert_allclose(body.pose.position, obj.pose.position, atol=1e-12)
        np.testing.assert_allclose(body.pose.rotation, obj.pose.rotation, atol=1e-8)
        assert body.fixed == obj.fixed


@pytest.mark.filterwarnings("ignore:LoadUsdPhysicsFromRange:DeprecationWarning")
def test_openusds_own_physics_parser_finds_the_same_mass_and_colliders(scene, written):
    """UsdPhysics' mass computation is another reader of the same attributes, with colliders that offer a wrong mass."""
    stage = Usd.Stage.Open(str(written))
    parsed = UsdPhysics.LoadUsdPhysicsFromRange(stage, ["/"])
    names = body_names(scene)
    moving = {f"/World/{name}" for name in names.values()} - {"/World/wooden_table", "/World/3d_sheet"}
    paths, _ = parsed[UsdPhysics.ObjectType.RigidBody]
    assert {str(path) for path in paths} == moving | {"/World/_3d_sheet"}
    assert UsdPhysics.ObjectType.Articulation not in parsed
    assert len(parsed[UsdPhysics.ObjectType.Scene][0]) == 1
    shapes = sum(
        len(parsed[kind][0])
        for kind in (UsdPhysics.ObjectType.CubeShape, UsdPhysics.ObjectType.MeshShape)
        if kind in parsed
    )
    assert shapes == 1 + sum(len(obj.asset.parts) for obj in scene.objects)

    def wrong(prim):
        information = UsdPhysics.RigidBodyAPI.MassInformation()
        information.volume = 1.0
        return information

    for obj in scene.objects:
        if obj.fixed or obj.name == "3D sheet":
            continue
        body = UsdPhysics.RigidBodyAPI(stage.GetPrimAtPath(f"/World/{names[obj.name]}"))
        mass, moments, centre, axes = body.ComputeMassProperties(wrong)
        rotation = Rotation.from_quat([*axes.GetImaginary(), axes.GetReal()]).as_matrix()
        inertia = np.array(obj.asset.mass_properties.inertia)
        assert mass == pytest.approx(obj.asset.mass_properties.mass, rel=1e-6)
        np.testing.assert_allclose(centre, obj.asset.mass_properties.centre_of_mass, atol=1e-6)
        np.testing.assert_allclose(rotation @ np.diag(moments) @ rotation.T, inertia, atol=2e-6 * np.abs(inertia).max())


def test_hulls_and_boxes_are_in_the_world_where_the_scene_has_them(scene, written):
    stage = Usd.Stage.Open(str(written))
    cache = UsdGeom.XformCache()
    corners = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
    for obj in scene.objects:
        name = body_names(scene)[obj.name]
        for number, part in enumerate(obj.asset.parts):
            prim = stage.GetPrimAtPath(f"/World/{name.replace('3d', '_3d')}/collision/part_{number:03d}")
            local = np.array(UsdGeom.Mesh(prim).GetPointsAttr().Get()) if prim.IsA(UsdGeom.Mesh) else corners
            place = np.array(cache.GetLocalToWorldTransform(prim))
            found = local.astype(np.float64) @ place[:3, :3] + place[3, :3]
            expected = obj.pose.apply(part.vertices)
            assert len(found) == len(expected)
            assert np.linalg.norm(found[:, None] - expected[None], axis=2).min(axis=0).max() < 3e-8


def test_colliders_are_guides_with_extents_and_normals_and_without_mass(scene, written):
    stage = Usd.Stage.Open(str(written))
    colliders = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.CollisionAPI)]
    assert len(colliders) == 1 + sum(len(obj.asset.parts) for obj in scene.objects)
    for prim in colliders:
        assert UsdGeom.Gprim(prim).GetPurposeAttr().Get() == UsdGeom.Tokens.guide
        assert not prim.HasAPI(UsdPhysics.MassAPI)
        extent = np.array(UsdGeom.Boundable(prim).GetExtentAttr().Get())
        np.testing.assert_allclose(extent, UsdGeom.Boundable.ComputeExtentFromPlugins(UsdGeom.Boundable(prim), 0))
        if prim.IsA(UsdGeom.Mesh):
            mesh = UsdGeom.Mesh(prim)
            assert UsdPhysics.MeshCollisionAPI(prim).GetApproximationAttr().Get() == UsdPhysics.Tokens.convexHull
            corners = np.array(mesh.GetPointsAttr().Get())[np.array(mesh.GetFaceVertexIndicesAttr().Get())]
            outward = np.einsum("ci,ci->c", np.array(mesh.GetNormalsAttr().Get()), corners)
            assert len(outward) == len(corners)
            assert (outward > 0).all()


def test_boxes_are_cubes_and_flush_ones_are_hulls(tmp_path):
    asset = asset_of(box(0.06, 0.06, 0.06))
    offset = scene_of(placed("a", asset, (0, 0, GAP)), placed("b", asset, (1e-4, 2e-4, 0.06 + 2 * GAP)))
    for scene, kind in ((offset, "Cube"), (tower(2), "Mesh")):
        stage = Usd.Stage.Open(str(write_usd(scene, tmp_path / kind)))
        bodies = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
        assert [prim.GetChild("collision").GetChild("part_000").GetTypeName() for prim in bodies] == [kind, kind]


def test_both_readers_of_materials_find_the_friction(scene, written):
    stage = Usd.Stage.Open(str(written))
    for obj in scene.objects[:4]:
        prim = stage.GetPrimAtPath(f"/World/{body_names(scene)[obj.name]}/collision/part_000")
        for purpose in ("physics", ""):
            material, _ = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial(purpose)
            physics = UsdPhysics.MaterialAPI(material.GetPrim())
            assert physics.GetDynamicFrictionAttr().Get() == pytest.approx(obj.asset.material.friction)
            assert physics.GetStaticFrictionAttr().Get() == pytest.approx(obj.asset.material.friction)


def test_units_axis_gravity_and_default_prim_are_authored(written):
    stage = Usd.Stage.Open(str(written))
    for name, value in (("metersPerUnit", 1.0), ("kilogramsPerUnit", 1.0), ("upAxis", "Z"), ("defaultPrim", "World")):
        assert stage.GetPseudoRoot().GetMetadata(name) == value
    scene = UsdPhysics.Scene(stage.GetPrimAtPath("/World/PhysicsScene"))
    assert tuple(scene.GetGravityDirectionAttr().Get()) == (0, 0, -1)
    assert scene.GetGravityMagnitudeAttr().Get() == pytest.approx(9.81)


def test_fixed_objects_are_no_rigid_bodies(written):
    stage = Usd.Stage.Open(str(written))
    table = stage.GetPrimAtPath("/World/wooden_table")
    assert not [prim for prim in Usd.PrimRange(table) if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    assert not [name for name in table.GetPrimTypeInfo().GetAppliedAPISchemas() if "RigidBody" in name]
    assert not table.HasAPI(UsdPhysics.MassAPI)
    assert stage.GetPrimAtPath("/World/ball").HasAPI(UsdPhysics.RigidBodyAPI)


def test_shared_assets_are_written_once_and_names_are_kept(scene, tmp_path):
    path = write_usd(scene, tmp_path / "u")
    assert sorted(os.listdir(path.parent / "assets")) == ["_3d_sheet", "ball", "pencil_co", "red_mug_1", "wooden_table"]
    stage = Usd.Stage.Open(str(path))
    assert stage.GetPrimAtPath("/World/pencil_co").GetDisplayName() == "pencil & <co>"
    assert stage.GetRootLayer().customLayerData["pat3d"]["prompt"] == "a “table”"


def test_what_is_seen_of_equal_objects_is_kept_once(scene, written):
    stage = Usd.Stage.Open(str(written))
    mugs = [stage.GetPrimAtPath(f"/World/red_mug_{number}/visual") for number in (1, 2)]
    assert all(prim.IsInstance() for prim in mugs)
    assert mugs[0].GetPrototype() == mugs[1].GetPrototype()
    assert not stage.GetPrimAtPath("/World/ball/visual").IsInstance()
    # Colliders stay apart: each has the contact margin of its own object.
    assert not stage.GetPrimAtPath("/World/red_mug_1/collision").IsInstanceProxy()


def test_the_texture_reaches_the_surface_from_any_place(scene, tmp_path, monkeypatch):
    write_usd(scene, tmp_path / "here")
    os.rename(tmp_path / "here", tmp_path / "there")
    monkeypatch.chdir("/")
    stage = Usd.Stage.Open(str(tmp_path / "there" / "scene.usdc"))
    visual = stage.GetPrimAtPath("/World/red_mug_2/visual/mesh")
    material, _ = UsdShade.MaterialBindingAPI(visual).ComputeBoundMaterial("")
    surface, _, _ = material.ComputeSurfaceSource()
    source = surface.GetInput("diffuseColor").GetConnectedSources()[0][0].source
    file = UsdShade.Shader(source.GetPrim()).GetInput("file").Get()
    assert file.resolvedPath == str(tmp_path / "there" / "assets" / "red_mug_1" / "red_mug_1.png")
    coordinates = UsdGeom.PrimvarsAPI(visual).GetPrimvar("st")
    expected = scene["red mug 2"].asset.visual.uv.reshape(-1, 2)
    np.testing.assert_allclose(np.array(coordinates.ComputeFlattened()), expected, atol=1e-6)


def test_solids_that_touch_stay_whole_with_points_and_areas_of_their_own(tmp_path):
    """Two cubes with an edge in common, 3 m out, and a face that single precision makes a line."""
    shape = box(0.1, 0.1, 0.1)
    one = asset_of(shape.moved(3.0, 0.0, 0.0))
    other = one.visual.vertices + (0.1, 0.1, 0.0)
    sliver = np.array([[3.0, 0.0, 0.5], [3.1, 0.0, 0.5], [3.05, 1e-12, 0.5]])
    vertices = np.concatenate([one.visual.vertices, other, sliver])
    count = len(other)
    faces = np.concatenate([one.visual.faces, one.visual.faces + count, [[2 * count, 2 * count + 1, 2 * count + 2]]])
    mesh = VisualMesh.from_face_colours(vertices, faces.astype(np.int32), np.zeros((len(faces), 3), np.uint8))
    path = write_usd_asset(replace(one, visual=mesh), tmp_path / "u", "cubes")
    stage = Usd.Stage.Open(str(path))
    visual = UsdGeom.Mesh(stage.GetPrimAtPath("/cubes/visual"))
    points = np.array(visual.GetPointsAttr().Get())
    index = np.array(visual.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    np.testing.assert_array_equal(index, faces)
    assert len(np.unique(points, axis=0)) == len(points)
    corners = points[index]
    assert np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).all()
    np.testing.assert_allclose(points, vertices, atol=1e-6)


def test_the_package_holds_everything_and_opens_alone(scene, tmp_path):
    path = write_usd(scene, tmp_path / "u", package=True).with_suffix(".usdz")
    moved = path.rename(tmp_path / "alone.usdz")
    names = zipfile.ZipFile(moved).namelist()
    assert names[0] == "scene.usdc"
    assert sum(name.endswith(".png") for name in names) == 5
    assert len(read_usd(moved)) == len(scene.objects)


def test_the_same_scene_gives_the_same_bytes(scene, tmp_path):
    first, second = (write_usd(scene, tmp_path / name).parent for name in "ab")
    for file in first.rglob("*.usdc"):
        assert file.read_bytes() == (second / file.relative_to(first)).read_bytes()


def test_writing_again_replaces_the_export_and_other_folders_are_refused(scene, tmp_path):
    write_usd(scene, tmp_path / "u", package=True)
    path = write_usd(tower(2), tmp_path / "u", text=True)
    assert sorted(os.listdir(tmp_path / "u")) == ["assets", "scene.usda"]
    assert [body.name for body in read_usd(path)] == ["box_1", "box_2"]
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("")
    with pytest.raises(ExportError, match="not empty"):
        write_usd(scene, tmp_path / "mine")
    with pytest.raises(ExportError, match="is a file"):
        write_usd(scene, tmp_path / "mine" / "thesis.tex")
    assert sorted(os.listdir(tmp_path)) == ["mine", "u"]


def test_a_file_written_again_is_read_anew_while_the_old_one_is_open(tmp_path):
    path = write_usd(tower(2), tmp_path / "u")
    held = Usd.Stage.Open(str(path))
    write_usd(tower(3), tmp_path / "u")
    assert len(read_usd(path)) == 3
    assert held


def test_what_is_no_usd_is_refused(tmp_path):
    for name, text, words in (
        ("a.usda", "not usd", "not readable"),
        ("b.usdc", "", "not readable"),
        ("c.usdz", "PK", "not readable"),
        ("d.txt", "", "must end in"),
    ):
        (tmp_path / name).write_text(text)
        with pytest.raises(ExportError, match=words):
            read_usd(tmp_path / name)
    with pytest.raises(ExportError, match="cannot be read"):
        read_usd(tmp_path / "absent.usdc")


def _sides(stage, joint):
    """Position and axes of both sides of a joint in the world."""
    cache = UsdGeom.XformCache()
    for ends, place, turn in (
        (joint.GetBody0Rel(), joint.GetLocalPos0Attr().Get(), joint.GetLocalRot0Attr().Get()),
        (joint.GetBody1Rel(), joint.GetLocalPos1Attr().Get(), joint.GetLocalRot1Attr().Get()),
    ):
        world = np.eye(4)
        if ends.GetTargets():
            world = np.array(cache.GetLocalToWorldTransform(stage.GetPrimAtPath(ends.GetTargets()[0]))).T
        local = Rotation.from_quat([*turn.GetImaginary(), turn.GetReal()]).as_matrix()
        yield world[:3, :3] @ np.array(place) + world[:3, 3], world[:3, :3] @ local


def _turned(scene, fixed):
    """`scene` in another place, its attached object 0.02 mm lower, as under load."""
    turned = Pose.from_matrix(Rotation.from_euler("xyz", [0.1, 0.2, 0.3]).as_matrix(), np.array([0.2, 0.1, 3.0]))
    objects = []
    for obj, drop in zip(scene.objects, (0.0, 2e-5), strict=True):
        position = turned.apply(np.array([obj.pose.position]))[0] - (0.0, 0.0, drop)
        objects.append(replace(obj, pose=Pose.from_matrix(turned.rotation, position), fixed=fixed and obj.fixed))
    return replace(scene, objects=tuple(objects))


def _constraints(joint, origin, axes):
    """Motions (velocity of the origin of the world, spin) that a joint forbids, as rows, by its type alone."""
    rows = {"PhysicsJoint": 0, "PhysicsSphericalJoint": 3, "PhysicsRevoluteJoint": 5, "PhysicsFixedJoint": 6}
    point = np.hstack([np.eye(3), -np.cross(np.eye(3), origin)])
    spin = np.hstack([np.zeros((3, 3)), axes.T[[2, 1, 0]]])
    return np.vstack([point, spin])[: rows[str(joint.GetPrim().GetTypeName())]]


@pytest.mark.parametrize("fixed", [True, False])
@pytest.mark.parametrize(
    ("anchors", "freedom"),
    [
        (PAIR[:1], 3),
        (PAIR, 1),
        ([*PAIR, ((0.0, 0.0, 0.04), (0.0, 0.0, -0.002))], 1),
        ([*PAIR, ((0.0, 0.01, 0.04), (0.0, 0.01, -0.002))], 0),
    ],
)
def test_joints_leave_the_motions_that_the_anchors_leave_and_start_closed(anchors, freedom, fixed, tmp_path):
    """Points that stay together forbid the rows of their Jacobian; the joint forbids the same space of motions."""
    scene = _turned(_hung_bar(anchors), fixed)
    stage = Usd.Stage.Open(str(write_usd(scene, tmp_path / "u")))
    joints = [UsdPhysics.Joint(prim) for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)]
    ends, _ = scene.attachments[0].ends(scene["a bar"].pose, scene["the beam"].pose)
    assert len(joints) == len(anchors)
    forbidden = []
    for joint, end in zip(joints, ends, strict=True):
        # What is fixed is no rigid body: the joint is tied to the world.
        parents = [str(path) for path in joint.GetBody0Rel().GetTargets()]
        assert parents == ([] if fixed else ["/World/the_beam"])
        assert [str(path) for path in joint.GetBody1Rel().GetTargets()] == ["/World/a_bar"]
        # Hung things collide with what they hang from, in the scene and here.
        assert joint.GetCollisionEnabledAttr().Get()
        (first, axes), (second, others) = _sides(stage, joint)
        np.testing.assert_allclose(first, end, atol=3e-7)
        np.testing.assert_allclose(second, end, atol=3e-7)
        np.testing.assert_allclose(axes, others, atol=5e-7)
        forbidden.append(_constraints(joint, first, axes))
        # MuJoCo keeps the bodies free and connects the points.
        schemas = joint.GetPrim().GetPrimTypeInfo().GetAppliedAPISchemas()
        assert {"MjcEqualityConnectAPI", "MjcEqualityAPI"} <= set(schemas)
    expected = np.vstack([np.hstack([np.eye(3), -np.cross(np.eye(3), end)]) for end in ends])
    found = np.vstack(forbidden)
    ranks = [np.linalg.matrix_rank(rows, tol=1e-4) for rows in (expected, found, np.vstack([expected, found]))]
    assert ranks == [6 - freedom] * 3
    assert len(found) == 6 - freedom


def test_attachments_of_fixed_objects_are_left_out(tmp_path):
    scene = _hung_bar(PAIR)
    fixed = replace(scene, objects=tuple(replace(obj, fixed=True) for obj in scene.objects))
    stage = Usd.Stage.Open(str(write_usd(fixed, tmp_path / "u")))
    assert not [prim for prim in stage.Traverse() if prim.IsA(UsdPhysics.Joint)]


def test_settings_of_single_engines_are_on_the_prims_they_read(tmp_path):
    """Names and values that PhysX, Newton and MuJoCo look for; contact margins only where bodies rest."""
    scene = scene_of(
        placed("can", asset_of(cylinder(0.03, 0.08)), (0, 0, GAP)),
        placed("kite", asset_of(cylinder(0.03, 0.08)), (0, 0, 2)),
    )
    stage = Usd.Stage.Open(str(write_usd(scene, tmp_path / "u")))
    part = stage.GetPrimAtPath("/World/can/collision/part_000")
    for prim, schema, name, value in (
        (stage.GetPrimAtPath("/World/PhysicsScene"), "MjcSceneAPI", "mjc:option:cone", "elliptic"),
        (stage.GetPrimAtPath("/World/PhysicsScene"), "NewtonSceneAPI", "newton:timeStepsPerSecond", 1000),
        (stage.GetPrimAtPath("/World/can"), "PhysxRigidBodyAPI", "physxRigidBody:maxDepenetrationVelocity", 0.1),
        (stage.GetPrimAtPath("/World/can"), "PhysxRigidBodyAPI", "physxRigidBody:enableSpeculativeCCD", True),
        (part, "PhysxCollisionAPI", "physxCollision:restOffset", 0.0),
        (part, "PhysxConvexHullCollisionAPI", "physxConvexHullCollision:minThickness", 1e-5),
        (part, "NewtonCollisionAPI", "newton:contactGap", 0.0),
        (part, "MjcCollisionAPI", "mjc:condim", 4),
        (part, "MjcCollisionAPI", "mjc:margin", 1.2 * GAP),
    ):
        assert schema in prim.GetPrimTypeInfo().GetAppliedAPISchemas()
        attribute = prim.GetAttribute(name)
        assert attribute.Get() == (value if isinstance(value, str) else pytest.approx(value))
        assert not attribute.IsCustom()
    floating = stage.GetPrimAtPath("/World/kite/collision/part_000")
    assert not floating.GetAttribute("mjc:margin")
    assert not part.GetAttribute("newton:contactMargin")


def test_an_asset_alone_is_a_rigid_body_by_its_noun(tmp_path):
    path = write_usd_asset(make("mug"), tmp_path / "mug")
    assert sorted(os.listdir(path.parent)) == ["mug.png", "mug.usdc"]
    (body,) = read_usd(path)
    assert (body.name, body.fixed) == ("mug", False)
    assert body.mass == pytest.approx(make("mug").mass_properties.mass, rel=1e-6)


def test_no_two_textures_of_a_package_share_a_name(scene, tmp_path):
    path = write_usd(scene, tmp_path / "u", package=True).with_suffix(".usdz")
    with zipfile.ZipFile(path) as archive:
        pictures = [Path(name).name for name in archive.namelist() if name.endswith(".png")]
    assert len(pictures) == len({id(obj.asset) for obj in scene.objects})
    assert len(set(pictures)) == len(pictures)


def test_a_package_beside_text_layers_holds_binary_ones(scene, tmp_path):
    path = write_usd(scene, tmp_path / "u", text=True, package=True)
    assert path.suffix == ".usda"
    assert parity(scene, path).passed
    package = path.with_suffix(".usdz")
    with zipfile.ZipFile(package) as archive:
        layers = [name for name in archive.namelist() if ".usd" in name]
        assert layers
        assert all(archive.read(name).startswith(b"PXR-USDC") for name in layers)
    assert parity(scene, package).passed


def test_lights_are_in_physical_units_and_have_a_choice_for_omniverse(scene, tmp_path):
    """A white ground under a sky of 0.4 nit and a sun of 1.5 lux at 41 degrees is lit to 0.4 + 1.5 cos / pi < 1."""
    stage = Usd.Stage.Open(str(write_usd(scene, tmp_path / "u")))
    sky, sun = (stage.GetPrimAtPath(f"/World/Lights/{name}") for name in ("Sky", "Sun"))

    def lit():
        return UsdLux.LightAPI(sky).GetIntensityAttr().Get() + UsdLux.LightAPI(sun).GetIntensityAttr().Get() / np.pi

    assert UsdLux.LightAPI(sun).GetNormalizeAttr().Get()
    assert 0.5 < lit() < 1.0
    stage.GetPrimAtPath("/World/Lights").GetVariantSets().GetVariantSet("lighting").SetVariantSelection("omniverse")
    assert lit() > 500.0


def test_steel_is_metallic_and_glass_is_seen_through(tmp_path):
    scene = scene_of(
        placed("steel pan", make("pan", material="steel"), (0, 0, GAP)),
        placed("glass", make("glass", material="glass"), (0.5, 0, GAP)),
    )
    stage = Usd.Stage.Open(str(write_usd(scene, tmp_path / "u")))
    pan, glass = (
        UsdShade.Shader(stage.GetPrimAtPath(f"/World/{name}/materials/visual/surface"))
        for name in ("steel_pan", "glass")
    )
    assert pan.GetInput("metallic").Get() == 1.0
    assert not pan.GetInput("opacity")
    assert glass.GetInput("metallic").Get() == 0.0
    assert 0.0 < glass.GetInput("opacity").Get() < 1.0
    assert glass.GetInput("roughness").Get() < 0.1
