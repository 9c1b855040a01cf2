import math
import os
import xml.etree.ElementTree as ET
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box, cylinder, ellipsoid
from pat3d.check.settle import settle_in_mujoco
from pat3d.errors import ExportError
from pat3d.exporters.compare import parity
from pat3d.exporters.mjcf.writer import FOR_MJX, FOR_MUJOCO_3_3, body_names, write_mjcf
from tests.exporters.things import hung_bar, mixed_scene
from tests.scenes import GAP, asset_of, placed, scene_of, tower


@pytest.fixture
def scene():
    return mixed_scene()


@pytest.fixture
def model(scene, tmp_path):
    return mujoco.MjModel.from_xml_path(str(write_mjcf(scene, tmp_path / "mjcf")))


def test_mass_centre_and_inertia_reload_to_rounding(scene, model):
    for obj in scene.objects:
        body = model.body(body_names(scene)[obj.name])
        properties = obj.asset.mass_properties
        axes = Rotation.from_quat(body.iquat, scalar_first=True).as_matrix()
        inertia = axes @ np.diag(body.inertia) @ axes.T
        assert np.isclose(body.mass[0], properties.mass, rtol=1e-12)
        np.testing.assert_allclose(body.ipos, properties.centre_of_mass, atol=1e-12)
        np.testing.assert_allclose(inertia, properties.inertia, atol=1e-9 * np.abs(properties.inertia).max())


def test_hull_vertices_are_in_the_world_where_the_scene_has_them(scene, model):
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    checked = 0
    for obj in scene.objects:
        name = body_names(scene)[obj.name]
        for number, part in enumerate(obj.asset.parts):
            geom = model.geom(f"{name}_part_{number:03d}")
            expected = obj.pose.apply(part.vertices)
            rotation = data.geom_xmat[geom.id].reshape(3, 3)
            if geom.type[0] == mujoco.mjtGeom.mjGEOM_BOX:
                signs = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)])
                local = signs * geom.size
                tolerance = 1e-12
            else:
                mesh = geom.dataid[0]
                start, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
                local = model.mesh_vert[start : start + count].astype(np.float64)
                tolerance = 1e-7  # MuJoCo keeps mesh vertices in single precision.
            found = local @ rotation.T + data.geom_xpos[geom.id]
            assert len(found) == len(expected)
            distance = np.linalg.norm(found[:, None] - expected[None], axis=2)
            assert distance.min(axis=0).max() < tolerance
            checked += 1
    assert checked == sum(len(obj.asset.parts) for obj in scene.objects)


def test_boxes_are_box_primitives_and_the_rest_are_meshes(scene, model):
    assert model.geom("wooden_table_part_000").type[0] == mujoco.mjtGeom.mjGEOM_BOX
    assert model.geom("red_mug_1_part_000").type[0] == mujoco.mjtGeom.mjGEOM_MESH


def test_only_collision_geoms_collide_and_only_they_are_in_group_3(scene, model):
    for geom in map(model.geom, range(model.ngeom)):
        visual = geom.name.endswith("_visual")
        assert bool(geom.contype[0]) == bool(geom.conaffinity[0]) == (not visual)
        assert geom.group[0] == (3 if not visual else 0 if geom.name == "ground_visual" else 2)


def test_keyframe_and_body_poses_agree(scene, model):
    data = mujoco.MjData(model)
    start = data.qpos.copy()
    mujoco.mj_resetDataKeyframe(model, data, model.key("home").id)
    np.testing.assert_array_equal(data.qpos, start)
    for obj in scene.objects:
        if not obj.fixed:
            address = model.jnt_qposadr[model.joint(body_names(scene)[obj.name]).id]
            np.testing.assert_allclose(start[address : address + 3], obj.pose.position, atol=0)
            np.testing.assert_allclose(start[address + 3 : address + 7], obj.pose.quat_wxyz, atol=1e-15)


def test_fixed_objects_have_no_joint(scene, model):
    assert model.body("wooden_table").dofnum[0] == 0
    assert model.nv == 6 * 4


def test_contact_settings_are_the_measured_ones(model):
    assert model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC
    assert model.opt.integrator == mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    assert (model.opt.impratio, model.opt.timestep) == (10, 0.002)
    assert not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_MULTICCD
    geom = model.geom("red_mug_1_part_000")
    np.testing.assert_allclose(geom.solref, (0.004, 1))
    np.testing.assert_allclose(geom.solimp[:3], (0.99, 0.999, 0.0001))
    assert geom.friction[0] == 0.5


def test_mujoco_adds_the_margins_of_a_pair():
    """The exporter splits the gap of a pair over its two bodies; an engine that took the larger would drop them."""
    xml = """<mujoco><worldbody><geom type="sphere" size="1" margin="0.1"/>
      <body pos="0 0 2.15"><freejoint/><geom type="sphere" size="1" margin="0.1"/></body></worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon == 1
    assert data.contact.includemargin[0] == pytest.approx(0.2)


def test_margins_cover_the_gaps_of_every_supporting_pair(tmp_path):
    """Two bodies 20 um apart under load feel each other in the first step."""
    model = mujoco.MjModel.from_xml_path(str(write_mjcf(tower(4), tmp_path / "m")))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pairs = {tuple(sorted(model.geom_bodyid[pair])) for pair in data.contact.geom[data.contact.efc_address >= 0]}
    assert pairs == {(0, 1), (1, 2), (2, 3), (3, 4)}
    assert max(data.contact.includemargin) < 2 * GAP


def test_flush_boxes_become_meshes_and_offset_ones_stay_boxes(tmp_path):
    assert 'type="box" pos' not in write_mjcf(tower(2), tmp_path / "flush").read_text().split("<body", 1)[1]
    asset = asset_of(box(0.06, 0.06, 0.06))
    offset = scene_of(placed("a", asset, (0, 0, GAP)), placed("b", asset, (1e-4, 2e-4, 0.06 + 2 * GAP)))
    assert 'type="mesh"' not in write_mjcf(offset, tmp_path / "offset").read_text().split("<body", 1)[1].replace(
        'class="visual"', ""
    )


def test_the_file_for_mujoco_3_3_has_no_box_but_the_ground_and_the_same_bodies(scene, model, tmp_path):
    """Its box-box collider reports half of a gap."""
    other = mujoco.MjModel.from_xml_path(str(write_mjcf(scene, tmp_path / "m").with_name(FOR_MUJOCO_3_3)))
    boxes = np.flatnonzero((other.geom_type == mujoco.mjtGeom.mjGEOM_BOX) & (other.geom_contype > 0))
    assert [other.geom(geom).name for geom in boxes] == ["ground"]
    for name in ("body_pos", "body_quat", "body_mass", "body_inertia", "body_ipos", "geom_friction", "geom_solref"):
        np.testing.assert_array_equal(getattr(other, name), getattr(model, name))
    np.testing.assert_array_equal(other.key_qpos, model.key_qpos)
    assert parity(scene, tmp_path / "m" / FOR_MUJOCO_3_3).passed


def test_the_file_for_mujoco_3_3_gives_every_pair_one_margin_that_covers_its_gap(tmp_path):
    """It takes the larger margin of a pair, not the sum."""
    path = write_mjcf(tower(4), tmp_path / "m").with_name(FOR_MUJOCO_3_3)
    margins = [float(geom.get("margin")) for geom in ET.parse(path).iter("geom") if geom.get("margin")]
    assert len(margins) == 4
    assert all(GAP < margin < 2 * GAP for margin in margins)
    assert settle_in_mujoco(path, 1.0).passed


def test_it_loads_from_any_working_directory_after_being_moved(scene, tmp_path, monkeypatch):
    write_mjcf(scene, tmp_path / "here")
    os.rename(tmp_path / "here", tmp_path / "there")
    monkeypatch.chdir("/")
    mujoco.MjModel.from_xml_path(str(tmp_path / "there" / "scene.xml"))
    monkeypatch.chdir(tmp_path / "there")
    mujoco.MjModel.from_xml_path("scene.xml")


def test_shared_assets_are_written_once(scene, tmp_path):
    path = write_mjcf(scene, tmp_path / "m")
    assert sorted(os.listdir(path.parent / "meshes")) == ["ball", "pencil_co", "red_mug_1", "wooden_table"]
    assert ET.parse(path).find(".//body[@name='red_mug_2']/geom").get("mesh") == "red_mug_1_visual"  # type: ignore[union-attr]


def test_texture_and_normals_reach_mujoco(model):
    mesh = model.mesh("red_mug_1_visual")
    assert model.mesh_texcoordadr[mesh.id] >= 0
    assert model.mat_texid[model.material("red_mug_1").id].max() >= 0


def test_writing_again_replaces_the_export_and_other_folders_are_refused(scene, tmp_path):
    write_mjcf(scene, tmp_path / "m")
    path = write_mjcf(tower(2), tmp_path / "m")
    assert os.listdir(path.parent / "meshes") == ["box_1"]
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("")
    with pytest.raises(ExportError, match="not empty"):
        write_mjcf(scene, tmp_path / "mine")
    assert os.listdir(tmp_path / "mine") == ["thesis.tex"]
    assert sorted(os.listdir(tmp_path)) == ["m", "mine"]


def test_a_table_top_ball_of_a_gram_keeps_its_inertia(tmp_path):
    """Inertias of 1e-8 kg m^2, where MuJoCo's own diagonalisation of fullinertia would stop short."""
    asset = asset_of(ellipsoid(0.004, 0.006, 0.02).turned("x", 33).turned("z", 50).moved(z=0.03))
    model = mujoco.MjModel.from_xml_path(str(write_mjcf(scene_of(placed("bean", asset)), tmp_path / "m")))
    axes = Rotation.from_quat(model.body("bean").iquat, scalar_first=True).as_matrix()
    inertia = axes @ np.diag(model.body("bean").inertia) @ axes.T
    expected = np.array(asset.mass_properties.inertia)
    np.testing.assert_allclose(inertia, expected, atol=1e-9 * expected.max())


def test_a_mesh_written_again_within_the_second_is_not_taken_for_the_old_one(tmp_path):
    """MuJoCo caches meshes by path and whole seconds; a stale hull under new poses explodes."""
    counts = []
    for sides in (8, 12):
        scene = scene_of(placed("can", asset_of(cylinder(0.03, 0.08, sides)), (0, 0, GAP)))
        model = mujoco.MjModel.from_xml_path(str(write_mjcf(scene, tmp_path / "m")))
        counts.append(int(model.mesh_vertnum[model.mesh("can_part_000").id]))
    assert counts == [16, 24]


def test_attachments_are_connect_constraints_that_hold_still(tmp_path):
    path = write_mjcf(hung_bar(), tmp_path / "mjcf")
    model = mujoco.MjModel.from_xml_path(str(path))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert list(model.eq_type) == [mujoco.mjtEq.mjEQ_CONNECT] * 2
    # Three rows each, nothing out of place.
    assert data.nefc == 6
    np.testing.assert_allclose(data.efc_pos, 0.0, atol=1e-12)
    report = settle_in_mujoco(path, 2.0)
    assert report.passed
    assert report.worst_mm < 0.01


def test_a_hung_bar_swings_about_the_line_of_its_anchors(tmp_path):
    """Small oscillations of a bar hung at its upper edge: period 2 pi sqrt(I / (m g l)) of the physical pendulum."""
    scene = hung_bar()
    model = mujoco.MjModel.from_xml_path(str(write_mjcf(scene, tmp_path / "mjcf")))
    data = mujoco.MjData(model)
    data.qvel[3] = 0.1
    data.qvel[1] = 0.1 * 0.04
    bar = scene["a bar"].asset.mass_properties
    arm = 0.04 - bar.centre_of_mass[2]
    period = 2 * np.pi * np.sqrt((bar.inertia[0][0] + bar.mass * arm**2) / (bar.mass * 9.81 * arm))
    crossings, before = [], 0.0
    while data.time < 2.2 * period:
        mujoco.mj_step(model, data)
        angle = data.qpos[4]
        if before < 0.0 <= angle:
            crossings.append(data.time)
        before = angle
    assert crossings[1] - crossings[0] == pytest.approx(period, rel=0.02)


def test_attachments_of_fixed_objects_are_left_out(tmp_path):
    scene = hung_bar()
    fixed = tuple(replace(obj, fixed=True) for obj in scene.objects)
    path = write_mjcf(replace(scene, objects=fixed), tmp_path / "mjcf")
    assert mujoco.MjModel.from_xml_path(str(path)).neq == 0


def test_every_object_loads_alone_and_attaches_with_its_mass_and_parts(scene, tmp_path):
    folder = write_mjcf(scene, tmp_path / "mjcf").parent
    said: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(said.append)
    try:
        files = sorted((folder / "objects").iterdir())
        assert [file.stem for file in files] == ["ball", "pencil_co", "red_mug_1", "wooden_table"]
        models = [f'<model name="{file.stem}" file="{file}"/>' for file in files]
        frames = [
            f'<frame pos="{k} 0 0"><attach model="{file.stem}" prefix="my_"/></frame>' for k, file in enumerate(files)
        ]
        world = "".join(frames)
        alone = [mujoco.MjModel.from_xml_path(str(file)) for file in files]
        together = mujoco.MjModel.from_xml_string(
            f"<mujoco><asset>{''.join(models)}</asset><worldbody>{world}</worldbody></mujoco>"
        )
    finally:
        mujoco.set_mju_user_warning(before)
    assert said == []
    names = body_names(scene)
    for file, model in zip(files, alone, strict=True):
        asset = next(obj.asset for obj in scene.objects if names[obj.name] == file.stem)
        assert model.nv == 6
        for body in (model.body(file.stem), together.body(f"my_{file.stem}")):
            assert body.mass[0] == pytest.approx(asset.mass_properties.mass, rel=1e-12)
            assert body.geomnum[0] == len(asset.parts) + 1


@pytest.mark.parametrize("x", [0.0, 4.99, 30.0])
def test_the_ground_reaches_under_what_stands_far_from_the_origin(x, tmp_path):
    scene = scene_of(placed("block", asset_of(box(0.1, 0.1, 0.1)), (x, -x, GAP)))
    report = settle_in_mujoco(write_mjcf(scene, tmp_path / "mjcf"), 0.2)
    assert report.worst_mm < 0.1


@pytest.mark.parametrize("side", [0.02, 0.5, 4.0])
def test_lights_and_camera_are_outside_of_the_scene_and_look_at_its_middle(side, tmp_path):
    """The key light is to the left and the other to the right, the camera in front between them, and all are above.

    They are further away than the scene is long, but not by much.
    """
    one = asset_of(box(side, side, side))
    scene = scene_of(placed("a", one, (3.0, -2.0, GAP)), placed("b", one, (3.0 + 2 * side, -2.0 + side, GAP)))
    model = mujoco.MjModel.from_xml_path(str(write_mjcf(scene, tmp_path / "m")))
    length = math.sqrt(9.0 + 4.0 + 1.0) * side
    reach, middle = max(length, 0.2), np.array([3.0 + side, -2.0 + side / 2, side / 2 + GAP])
    eye, frame = model.camera("front").pos, np.zeros(9)
    mujoco.mju_quat2Mat(frame, model.camera("front").quat)
    places = [*((model.light(name).pos, model.light(name).dir) for name in ("key", "fill")), (eye, -frame[2::3])]
    for place, ahead in places:
        np.testing.assert_allclose((middle - place) / np.linalg.norm(middle - place), ahead, atol=1e-6)
        assert place[2] > middle[2]
        assert length < np.linalg.norm(place - middle) < 6.0 * reach
    (key, _), (fill, _), _ = places
    assert key[0] < middle[0] < fill[0]
    assert max(key[1], fill[1], eye[1]) < middle[1]
    # Of a larger scene they are further away, to the same scale.
    np.testing.assert_allclose((key - middle) / reach, 2.0 * np.array([-1.0, -1.2, 2.0]), atol=1e-5)
    assert eye[0] == pytest.approx(middle[0])
    assert bool(model.light("key").castshadow[0]) > bool(model.light("fill").castshadow[0])


def test_no_name_holds_a_slash(tmp_path):
    """dm_control refuses names with one, since it builds scopes of attached models from it."""
    write_mjcf(mixed_scene(), tmp_path / "m")
    for path in (tmp_path / "m").rglob("*.xml"):
        names = [element.get("name", "") for element in ET.parse(path).iter()]
        assert not [name for name in names if "/" in name], path


def test_the_file_for_mjx_is_the_scene_without_margins(tmp_path):
    scene = mixed_scene()
    path = write_mjcf(scene, tmp_path / "m").with_name(FOR_MJX)
    model = mujoco.MjModel.from_xml_path(str(path))
    assert not model.geom_margin.any()
    assert not model.geom_gap.any()
    assert parity(scene, path).passed


def test_objects_load_in_robosuite(tmp_path):
    """Its own class finds the body and the sites, gives it a free joint, and the model compiles and weighs the same."""
    objects = pytest.importorskip("robosuite.models.objects")
    base = pytest.importorskip("robosuite.models.base")
    scene = mixed_scene()
    folder = write_mjcf(scene, tmp_path / "m").parent / "robosuite"
    for path in sorted(folder.glob("*.xml")):
        asset = next(obj.asset for obj in scene.objects if body_names(scene)[obj.name] == path.stem)
        loaded = objects.MujocoXMLObject(str(path), name="thing")
        assert loaded.bottom_offset[2] == pytest.approx(asset.bounds[0, 2], abs=1e-9)
        assert loaded.top_offset[2] == pytest.approx(asset.bounds[1, 2], abs=1e-9)
        assert loaded.horizontal_radius >= np.linalg.norm(asset.visual.vertices[:, :2], axis=1).max() - 1e-6
        arena = tmp_path / "arena.xml"
        arena.write_text("<mujoco><worldbody/></mujoco>")
        world = base.MujocoXML(str(arena))
        world.merge_assets(loaded)
        world.worldbody.append(loaded.get_obj())
        model = world.get_model()
        assert model.body_mass.sum() == pytest.approx(asset.mass_properties.mass, rel=1e-9)
        assert model.njnt == 1
        assert model.ngeom >= len(asset.parts) + 1
        # RoboCasa reads its size from a box that touches nothing.
        (box,) = [model.geom(k) for k in range(model.ngeom) if model.geom(k).name == "thing_reg_bbox"]
        assert 2 * box.size == pytest.approx(asset.bounds[1] - asset.bounds[0])
        assert (int(box.contype[0]), int(box.conaffinity[0])) == (0, 0)
