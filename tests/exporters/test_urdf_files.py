"""What readers of URDF exports are told: the ground, PyBullet's loader, manifests and directives that are none."""

# ruff: noqa: N802 PyBullet names its functions so.
import json
import math
import sys
import types
import xml.etree.ElementTree as ET
from itertools import count
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box
from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.objects import ground_size
from pat3d.exporters.compare import parity
from pat3d.exporters.contents.compare import contents
from pat3d.exporters.urdf.load_pybullet import load_pybullet
from pat3d.exporters.urdf.mesh_paths import mesh_file, set_mesh_paths
from pat3d.exporters.urdf.reader import read_directives, read_urdf
from pat3d.exporters.urdf.writer import write_urdf
from pat3d.scene.physics import ground_friction
from tests.exporters.things import hung_bar, mixed_scene
from tests.scenes import asset_of, placed, scene_of

DRAKE = "{http://drake.mit.edu}"


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture
def folder(scene, tmp_path):
    return write_urdf(scene, tmp_path / "urdf").parent


def test_the_ground_is_under_every_object_however_far_it_stands_and_ten_metres_wide_at_least():
    one = asset_of(box(0.2, 0.2, 0.2))
    for place in ((0, 0, 0), (1, -1, 0), (30, 0, 0), (-30, 2, 0), (0, 40, 0), (3, -40, 0), (0, 0, 50)):
        scene = scene_of(placed("near", one), placed("far", one, place))
        width, depth, _ = ground_size(scene)
        reach = max(abs(place[0]), abs(place[1])) + 0.1
        assert min(width, depth) >= 10.0
        assert min(width, depth) / 2 > reach + 0.5
        # It does not grow with what is high, nor without need.
        assert max(width, depth) <= max(10.0, 4.0 * reach + 1.0)


def test_the_ground_is_seen_in_a_colour_and_touched_with_its_friction_by_both_engines(scene, folder):
    link = ET.parse(folder / "ground.urdf").getroot().find("link")
    assert link is not None
    assert [child.tag for child in link] == ["inertial", "contact", "visual", "collision"]
    assert [child.tag for child in link.findall("./visual/material")] == ["material"]
    assert link.find("collision/material") is None
    assert link.find(f"visual/{DRAKE}proximity_properties") is None
    friction = ground_friction(scene.settling_friction)
    found = [link.find("contact/lateral_friction")]
    found += [link.find(f"collision/{DRAKE}proximity_properties/{DRAKE}{name}") for name in ("mu_static", "mu_dynamic")]
    assert [float(element.attrib["value"]) for element in found if element is not None] == [friction] * 3
    # Both boxes end at z = 0.
    for kind in ("visual", "collision"):
        origin, size = link.find(f"{kind}/origin"), link.find(f"{kind}/geometry/box")
        assert origin is not None
        assert size is not None
        assert float(origin.attrib["xyz"].split()[2]) + float(size.attrib["size"].split()[2]) / 2 == 0.0


class Recorder(types.ModuleType):
    """In place of PyBullet: notes what it is told; a body's frame of inertia is its mass centre in the URDF."""

    URDF_INITIALIZE_SAT_FEATURES, URDF_USE_INERTIA_FROM_FILE, JOINT_POINT2POINT = 1, 2, 5

    def __init__(self):
        super().__init__("pybullet")
        self.loaded, self.dynamics, self.constraints, self.settings = {}, {}, [], {}
        self._numbers = count(10)

    def setGravity(self, *gravity, physicsClientId):
        self.settings["gravity"] = gravity

    def setPhysicsEngineParameter(self, *, physicsClientId, **settings):
        self.settings |= settings

    def loadURDF(self, file, position, quat, *, useFixedBase, flags, physicsClientId):
        inertial = ET.parse(file).getroot().find("link/inertial/origin")
        assert inertial is not None
        number = next(self._numbers)
        self.loaded[number] = (file, position, quat, useFixedBase, flags)
        self.dynamics[number] = {
            "frame": [[float(word) for word in inertial.attrib[key].split()] for key in ("xyz", "rpy")]
        }
        return number

    def changeDynamics(self, body, link, *, physicsClientId, **values):
        assert link == -1
        self.dynamics[body] |= values

    def getDynamicsInfo(self, body, link, physicsClientId):
        place, turn = self.dynamics[body]["frame"]
        return None, None, None, place, Rotation.from_euler("xyz", turn).as_quat().tolist()

    def invertTransform(self, position, quat):
        back = Rotation.from_quat(quat).inv()
        return (-back.apply(position)).tolist(), back.as_quat().tolist()

    def multiplyTransforms(self, position, quat, point, turn):
        first = Rotation.from_quat(quat)
        return (first.apply(point) + position).tolist(), (first * Rotation.from_quat(turn)).as_quat().tolist()

    def createConstraint(self, parent, _, child, __, kind, axis, at_parent, at_child, *, physicsClientId):
        self.constraints.append((parent, child, kind, at_parent, at_child))


@pytest.fixture
def recorder(monkeypatch):
    made = Recorder()
    monkeypatch.setitem(sys.modules, "pybullet", made)
    return made


@pytest.mark.parametrize("geometric", [True, False])
def test_the_loader_gives_pybullet_every_file_at_its_pose_and_pairs_their_geometric_mean(
    scene, folder, recorder, geometric
):
    """Bullet multiplies the coefficients of a pair, so each body has the square root of its own."""
    bodies = load_pybullet(folder, 3, geometric_friction=geometric)
    assert recorder.settings["gravity"] == (0.0, 0.0, -9.81)
    assert list(bodies) == ["ground", "wooden_table", "red_mug_1", "red_mug_2", "pencil_co", "ball"]
    assert recorder.loaded[bodies["ground"]][:4] == (str(folder / "ground.urdf"), [0, 0, 0], [0, 0, 0, 1], True)
    frictions = [ground_friction(scene.settling_friction)]
    for obj, body in zip(scene.objects, list(bodies.values())[1:], strict=True):
        file, position, quat, fixed, flags = recorder.loaded[body]
        assert ET.parse(file).getroot().tag == "robot"
        assert tuple(position) == obj.pose.position
        np.testing.assert_allclose(Rotation.from_quat(quat).as_matrix(), obj.pose.rotation, atol=1e-14)
        assert fixed == obj.fixed
        # The inertia of the file, not one that is guessed.
        assert flags == recorder.URDF_INITIALIZE_SAT_FEATURES | recorder.URDF_USE_INERTIA_FROM_FILE
        frictions.append(obj.asset.material.friction)
    for body, friction in zip(bodies.values(), frictions, strict=True):
        own = recorder.dynamics[body]
        assert own["lateralFriction"] == pytest.approx(math.sqrt(friction) if geometric else friction)
        assert own["linearDamping"] == own["angularDamping"] == 0.0


def test_the_loader_ties_bodies_by_points_that_coincide_in_the_world(tmp_path, recorder):
    scene = hung_bar()
    bodies = load_pybullet(write_urdf(scene, tmp_path / "urdf").parent)
    (attachment,) = scene.attachments
    expected = attachment.ends(scene["a bar"].pose, scene["the beam"].pose)
    assert len(recorder.constraints) == len(attachment.anchors)
    for number, (parent, child, kind, at_parent, at_child) in enumerate(recorder.constraints):
        assert (parent, child, kind) == (bodies["the_beam"], bodies["a_bar"], recorder.JOINT_POINT2POINT)
        for body, point, end in ((child, at_child, expected[0][number]), (parent, at_parent, expected[1][number])):
            place, turn = recorder.dynamics[body]["frame"]
            local = Rotation.from_euler("xyz", turn).apply(point) + place
            _, position, quat, _, _ = recorder.loaded[body]
            np.testing.assert_allclose(Rotation.from_quat(quat).apply(local) + position, end, atol=1e-12)


@pytest.mark.parametrize("key", ["name", "file", "link", "fixed", "position", "quat_xyzw", "friction"])
@pytest.mark.parametrize("which", [0, -1])
def test_a_manifest_of_which_one_object_lacks_something_is_refused(folder, key, which):
    path = folder / "manifest.json"
    manifest = json.loads(path.read_text())
    del manifest["objects"][which][key]
    path.write_text(json.dumps(manifest))
    with pytest.raises(ExportError, match="every object needs"):
        read_urdf(folder)


@pytest.mark.parametrize("objects", [None, {}, [1], [{}, "b"]])
def test_a_manifest_without_a_list_of_objects_is_refused(folder, objects):
    path = folder / "manifest.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"objects": objects}))
    with pytest.raises(ExportError, match="every object needs"):
        read_urdf(folder)


@pytest.mark.parametrize(("more", "said"), [(0, "not valid YAML"), (1, "larger than")])
def test_directives_of_16_mib_are_read_and_longer_ones_are_not(folder, more, said):
    """The file holds NUL bytes only, which no YAML may: whoever reads it stops at the first."""
    with (folder / "scene.dmd.yaml").open("wb") as file:
        file.truncate(16 * 2**20 + more)
    with pytest.raises(ExportError, match=said):
        read_directives(folder)


@pytest.mark.parametrize("how", ["package", "absolute", "relative"])
def test_meshes_are_named_in_every_way_and_read_back_the_same(tmp_path, monkeypatch, how):
    scene = mixed_scene()
    folder = write_urdf(scene, tmp_path / "u").parent
    set_mesh_paths(folder, how)
    names = [mesh.get("filename", "") for path in folder.rglob("*.urdf") for mesh in ET.parse(path).iter("mesh")]
    start = {"package": "package://pat3d_scene/objects/", "absolute": str(folder.resolve()), "relative": ""}[how]
    assert names
    assert all(name.startswith(start) for name in names)
    if how == "absolute":
        # From anywhere, without being told anything.
        monkeypatch.chdir("/")
        assert all(Path(name).is_file() for name in names)
    assert parity(scene, folder).passed
    report = contents(scene, folder)
    assert report.passed, report.failures
    set_mesh_paths(folder, "relative")
    assert contents(scene, folder).passed


def test_a_mesh_path_out_of_the_export_is_refused(tmp_path):
    folder = write_urdf(mixed_scene(), tmp_path / "u").parent
    for name in ("../../../x.obj", "/etc/x.obj", "package://pat3d_scene/../../x.obj", ""):
        with pytest.raises(ExportError, match="no file inside"):
            mesh_file(name, folder / "objects" / "ball", folder)
    with pytest.raises(SpecError, match="Valid: relative, package, absolute"):
        set_mesh_paths(folder, "file")
