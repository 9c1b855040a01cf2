import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from pat3d.assets.materials import material, surface_of
from pat3d.assets.shapes import box, convex, join
from pat3d.errors import ExportError
from pat3d.exporters import parity
from pat3d.exporters.mjcf.writer import body_names
from pat3d.exporters.urdf.writer import write_urdf
from pat3d.scene.asset import Material
from pat3d.scene.obj_files import read_obj
from tests.exporters.things import hung_bar, mixed_scene
from tests.scenes import GAP, asset_of, placed, scene_of, tower


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture(scope="module")
def folder(scene, tmp_path_factory):
    return write_urdf(scene, tmp_path_factory.mktemp("out") / "urdf").parent


def test_each_asset_is_one_file_with_its_own_meshes(scene, folder):
    assert sorted(os.listdir(folder / "objects")) == ["ball", "pencil_co", "red_mug_1", "wooden_table"]
    for path in folder.glob("objects/*/*.urdf"):
        link = ET.parse(path).getroot().find("link")
        assert link is not None
        meshes = [mesh.get("filename") for mesh in link.iter("mesh")]
        assert meshes[0] == "visual.obj"
        assert all((path.parent / str(file)).is_file() for file in meshes)


def test_every_part_is_a_convex_mesh_with_the_corners_of_the_part(scene, folder):
    """Boxes too: PyBullet's box shape sinks where it meets a hull."""
    for obj in scene.objects:
        if obj.name == "red mug 2":
            continue
        path = folder / "objects" / body_names(scene)[obj.name]
        robot = ET.parse(path / f"{path.name}.urdf")
        files = [mesh.get("filename") for mesh in robot.iterfind(".//collision//mesh")]
        for file, part in zip(files, obj.asset.parts, strict=True):
            vertices, _, _ = read_obj(path / str(file))
            np.testing.assert_array_equal(vertices, part.vertices)
    assert next(ET.parse(folder / "ground.urdf").iter("box")).get("size") == "10.0 10.0 1.0"


def test_the_manifest_says_what_stands_where(scene, folder):
    manifest = json.loads((folder / "manifest.json").read_text())
    for obj, entry in zip(scene.objects, manifest["objects"], strict=True):
        assert (entry["object"], entry["fixed"]) == (obj.name, obj.fixed)
        assert tuple(entry["position"]) == obj.pose.position
        assert tuple(np.roll(entry["quat_xyzw"], 1)) == obj.pose.quat_wxyz
        assert entry["friction"] == obj.asset.material.friction
    assert manifest["objects"][1]["file"] == manifest["objects"][2]["file"]


def test_our_reading_finds_the_scene_to_rounding(scene, folder):
    report = parity(scene, folder)
    assert report.passed, report.failures
    for reading in report.readings[:2]:
        assert max(error for error in reading.worst.values() if error is not None) < 1e-12


def test_the_scene_for_viewers_says_so_and_has_every_object_in_its_place(scene, folder):
    text = (folder / "scene.urdf").read_text()
    assert "For viewers only" in text
    yourdfpy = pytest.importorskip("yourdfpy")
    robot = yourdfpy.URDF.load(str(folder / "scene.urdf"), load_meshes=False, build_scene_graph=True)
    assert robot.validate()
    for obj in scene.objects:
        transform = robot.get_transform(body_names(scene)[obj.name])
        np.testing.assert_allclose(transform[:3, :3], obj.pose.rotation, atol=1e-14)
        np.testing.assert_allclose(transform[:3, 3], obj.pose.position, atol=1e-15)


def test_pybullet_has_the_masses_the_inertias_and_the_poses(scene, folder):
    """The inertia of a pencil of 2 g has products below 1e-6, which PyBullet drops unless they come as a rotation."""
    pytest.importorskip("pybullet")
    reading = next(one for one in parity(scene, folder).readings if one.reader.startswith("PyBullet"))
    assert reading.failures == ()
    assert reading.worst["inertia"] is not None
    assert reading.worst["inertia"] < 1e-9


def test_pybullet_holds_the_scene_still(tmp_path):
    pybullet = pytest.importorskip("pybullet")
    from pat3d.exporters.urdf.load_pybullet import load_pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        folder = write_urdf(tower(3), tmp_path / "urdf").parent
        bodies = load_pybullet(folder, client)
        start = {name: pybullet.getBasePositionAndOrientation(body, client)[0] for name, body in bodies.items()}
        for _ in range(1000):
            pybullet.stepSimulation(physicsClientId=client)
        for name, body in bodies.items():
            moved = np.subtract(pybullet.getBasePositionAndOrientation(body, client)[0], start[name])
            assert np.linalg.norm(moved) < 5e-4
    finally:
        pybullet.disconnect(client)


def test_pybullet_lets_nothing_creep_and_holds_nothing_that_slides(tmp_path):
    """Friction that only holds velocities lets a tower of four creep by 0.6 mm a minute; a slope still is one."""
    pybullet = pytest.importorskip("pybullet")
    from pat3d.exporters.urdf.load_pybullet import load_pybullet

    def places(bodies):
        return np.array([pybullet.getBasePositionAndOrientation(body, client)[0] for body in bodies.values()])

    client = pybullet.connect(pybullet.DIRECT)
    try:
        bodies = load_pybullet(write_urdf(tower(4), tmp_path / "tower").parent, client)
        for _ in range(1500):
            pybullet.stepSimulation(physicsClientId=client)
        before = places(bodies)
        for _ in range(1500):
            pybullet.stepSimulation(physicsClientId=client)
        # 0.1 mm a minute, for a second and a half.
        assert np.abs(places(bodies) - before).max() < 2.5e-6
        pybullet.resetSimulation(physicsClientId=client)
        slick = Material(name="slick", density=900.0, friction=0.1)
        plate, slab = (asset_of(box(size, size, 0.02), material=slick) for size in (0.6, 0.2))
        scene = scene_of(placed("plate", plate, fixed=True), placed("slab", slab, (0, 0, 0.02 + GAP)))
        body = {"slab": load_pybullet(write_urdf(scene, tmp_path / "slab").parent, client)["slab"]}
        lean, start = math.radians(7.0), places(body)
        pybullet.setGravity(9.81 * math.sin(lean), 0.0, -9.81 * math.cos(lean), physicsClientId=client)
        for _ in range(500):
            pybullet.stepSimulation(physicsClientId=client)
        slid = 9.81 * (math.sin(lean) - 0.1 * math.cos(lean)) * 0.5**2 / 2
        assert places(body)[0, 0] - start[0, 0] == pytest.approx(slid, rel=0.01)
    finally:
        pybullet.disconnect(client)


def test_pybullet_holds_a_saddle_on_a_roof_that_it_would_roll_off_without_friction(tmp_path):
    """At PyBullet's own solver threshold it moves by half a millimetre in 5 s; the gaps are 0.02 mm."""
    pybullet = pytest.importorskip("pybullet")
    from pat3d.exporters.urdf.load_pybullet import load_pybullet

    rise = math.tan(math.radians(30))
    roof = convex([(x, y, z) for x in (-0.1, 0.1) for y, z in ((-0.05, 0), (0.05, 0), (0, 0.05 * rise))])
    legs = [box(0.06, 0.006, 0.04).moved(y=side * 0.023) for side in (-1, 1)]
    wood = Material(name="wood", density=650.0, friction=0.4)
    saddle = asset_of(join(*legs, box(0.08, 0.06, 0.05).moved(y=0.01, z=0.04)), material=wood)
    scene = scene_of(
        placed("roof", asset_of(roof, material=wood), fixed=True),
        placed("saddle", saddle, (0, 0, 0.03 * rise + GAP)),
    )
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = load_pybullet(write_urdf(scene, tmp_path / "urdf").parent, client)["saddle"]
        start = pybullet.getBasePositionAndOrientation(body, client)[0]
        for _ in range(5000):
            pybullet.stepSimulation(physicsClientId=client)
        assert math.dist(pybullet.getBasePositionAndOrientation(body, client)[0], start) < 5e-5
    finally:
        pybullet.disconnect(client)


def test_pybullet_lets_a_hung_bar_hang(tmp_path):
    pybullet = pytest.importorskip("pybullet")
    from pat3d.exporters.urdf.load_pybullet import load_pybullet

    client = pybullet.connect(pybullet.DIRECT)
    try:
        bodies = load_pybullet(write_urdf(hung_bar(), tmp_path / "urdf").parent, client)
        start = pybullet.getBasePositionAndOrientation(bodies["a_bar"], client)[0]
        for _ in range(1000):
            pybullet.stepSimulation(physicsClientId=client)
        assert (
            np.linalg.norm(np.subtract(pybullet.getBasePositionAndOrientation(bodies["a_bar"], client)[0], start))
            < 1e-3
        )
    finally:
        pybullet.disconnect(client)


def test_drake_parses_the_directives_strictly_and_finds_the_scene(scene, folder):
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.001)
    parser = parsing.Parser(plant)
    parser.SetStrictParsing()
    parser.package_map().Add("pat3d_scene", str(folder))
    parser.AddModels(str(folder / "scene.dmd.yaml"))
    reading = next(one for one in parity(scene, folder).readings if one.reader.startswith("Drake"))
    assert reading.failures == ()


def test_attachments_are_in_the_manifest_point_by_point(tmp_path):
    scene = hung_bar()
    manifest = json.loads(write_urdf(scene, tmp_path / "urdf").read_text())
    (entry,) = manifest["attachments"]
    assert (entry["child"], entry["parent"]) == ("a_bar", "the_beam")
    points = tuple((tuple(one["child_point"]), tuple(one["parent_point"])) for one in entry["anchors"])
    assert points == scene.attachments[0].anchors


def test_the_loaders_in_the_folder_stand_alone(folder):
    """They import neither PAT3D nor anything but the standard library until they are called."""
    for name in ("load_pybullet", "load_drake"):
        code = f"import sys; sys.path.insert(0, '.'); import {name}; print([m for m in sys.modules if 'pat3d' in m])"
        done = subprocess.run(
            [sys.executable, "-S", "-c", code], cwd=folder, capture_output=True, text=True, check=True
        )
        assert done.stdout.strip() == "[]"


def test_writing_again_replaces_the_export_and_other_folders_are_refused(scene, tmp_path):
    write_urdf(scene, tmp_path / "u")
    path = write_urdf(tower(2), tmp_path / "u")
    assert os.listdir(path.parent / "objects") == ["box_1"]
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.tex").write_text("")
    with pytest.raises(ExportError, match="not empty"):
        write_urdf(scene, tmp_path / "mine")
    assert sorted(os.listdir(tmp_path)) == ["mine", "u"]


def test_only_what_is_translucent_has_a_colour_beside_its_texture(tmp_path):
    """SAPIEN and what stands on it show a colour of the URDF in place of the mesh's texture."""
    block, pane = asset_of(box(0.1, 0.1, 0.1)), asset_of(box(0.1, 0.1, 0.1), material=material("glass"))
    write_urdf(scene_of(placed("block", block, (0, 0, 0)), placed("pane", pane, (1, 0, 0))), tmp_path / "urdf")

    def colours(name: str) -> list[str]:
        root = ET.parse(tmp_path / "urdf" / "objects" / name / f"{name}.urdf")
        return [str(one.get("rgba")) for one in root.iterfind("link/visual/material/color")]

    assert colours("block") == []
    assert colours("pane") == [f"1 1 1 {surface_of(pane).opacity:g}"]
