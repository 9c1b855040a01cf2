import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from pat3d.errors import ExportError
from pat3d.exporters import parity
from pat3d.exporters.sdf.writer import write_sdf
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Attachment, Scene
from tests.exporters.things import hung_bar, mixed_scene


@pytest.fixture(scope="module")
def scene():
    return mixed_scene()


@pytest.fixture(scope="module")
def path(scene, tmp_path_factory):
    return write_sdf(scene, tmp_path_factory.mktemp("out") / "sdf")


def loose_hung_bar() -> Scene:
    """The bar hung from a beam that is loose, and turned with it."""
    turn = Pose.from_yaw(0.4, (0.3, 0.2, 0.1))
    scene = hung_bar()
    return replace(
        scene,
        objects=tuple(
            replace(
                obj,
                fixed=False,
                pose=Pose.from_matrix(turn.rotation @ obj.pose.rotation, turn.apply(np.array([obj.pose.position]))[0]),
            )
            for obj in scene.objects
        ),
    )


def test_the_world_reads_back_as_the_scene(scene, path):
    report = parity(scene, path)
    assert report.passed, report.failures
    assert report.largest < 1e-12


def test_only_the_table_and_the_ground_are_static(path):
    world = ET.parse(path).find("world")
    assert world is not None
    static = [model.get("name") for model in world.findall("model") if model.findtext("static") == "true"]
    assert static == ["ground", "wooden_table"]


def test_every_model_is_whole_by_itself(path):
    for model in sorted((path.parent / "models").iterdir()):
        assert ET.parse(model / "model.config").findtext("sdf") == "model.sdf"
        root = ET.parse(model / "model.sdf").getroot()
        for uri in root.iter("uri"):
            assert (model / str(uri.text)).is_file()
        hulls = [mesh.get("optimization") for mesh in root.iterfind(".//collision//mesh")]
        assert set(hulls) <= {"convex_hull"}


def test_drake_parses_the_world_without_a_warning(scene, path):
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(0.001)
    parser = parsing.Parser(plant)
    parser.SetStrictParsing()
    assert len(parser.AddModels(str(path))) == len(scene.objects) + 1


@pytest.mark.parametrize(
    ("points", "kind"), [((0.0,), "ball"), ((-0.1, 0.1), "revolute"), ((-0.1, 0.0, 0.1), "revolute")]
)
def test_attachments_become_the_joint_with_the_same_freedom(tmp_path, points, kind):
    joint = ET.parse(write_sdf(hung_bar(points), tmp_path / "sdf")).find("world/model[@name='a_bar']/joint")
    assert joint is not None
    assert (joint.get("type"), joint.findtext("parent"), joint.findtext("child")) == (kind, "world", "link")
    pose = joint.find("pose")
    assert pose is not None
    np.testing.assert_allclose(
        [float(word) for word in str(pose.text).split()[:3]], [np.mean(points), 0, 0.04], atol=1e-15
    )
    if kind == "revolute":
        axis = [float(word) for word in str(joint.findtext("axis/xyz")).split()]
        np.testing.assert_allclose(np.abs(axis), [1, 0, 0], atol=1e-12)


def test_what_hangs_from_something_loose_is_a_model_in_that_one(tmp_path):
    scene = loose_hung_bar()
    path = write_sdf(scene, tmp_path / "sdf")
    beam = ET.parse(path).find("world/model[@name='the_beam']")
    assert beam is not None
    (joint,) = beam.findall("joint")
    assert (joint.findtext("parent"), joint.findtext("child")) == ("link", "a_bar::link")
    report = parity(scene, path)
    assert report.passed, report.failures


def test_drake_swings_what_hangs_from_something_loose(tmp_path):
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    from pydrake.multibody.plant import MultibodyPlant

    scene = loose_hung_bar()
    plant = MultibodyPlant(0.001)
    parser = parsing.Parser(plant)
    parser.SetStrictParsing()
    parser.AddModels(str(write_sdf(scene, tmp_path / "sdf")))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    (floating,) = plant.GetFloatingBaseBodies()
    assert plant.get_body(floating).scoped_name().get_full() == "the_beam::link"
    # A quaternion and a position of the beam, and the angle of the hinge.
    assert plant.num_positions() == 8
    bar = plant.GetBodyByName("link", plant.GetModelInstanceByName("the_beam::a_bar"))
    np.testing.assert_allclose(
        plant.EvalBodyPoseInWorld(context, bar).GetAsMatrix4()[:3],
        np.column_stack([scene["a bar"].pose.rotation, scene["a bar"].pose.position]),
        atol=1e-14,
    )


def test_drake_swings_what_hangs_from_something_fixed(tmp_path):
    """A bar on a hinge 20 mm above its middle turns about the hinge's line and about nothing else."""
    parsing = pytest.importorskip("pydrake.multibody.parsing")
    from pydrake.multibody.plant import MultibodyPlant

    scene = hung_bar()
    path = write_sdf(scene, tmp_path / "sdf")
    assert parity(scene, path).passed
    plant = MultibodyPlant(0.001)
    parser = parsing.Parser(plant)
    parser.SetStrictParsing()
    parser.AddModels(str(path))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    bar = plant.GetBodyByName("link", plant.GetModelInstanceByName("a_bar"))
    assert plant.num_positions() == 1
    plant.SetPositions(context, [np.pi / 2])
    turned = plant.EvalBodyPoseInWorld(context, bar)
    start = np.array(scene["a bar"].pose.position)
    hinge = start + [0.0, 0.0, 0.04]
    np.testing.assert_allclose(np.linalg.norm(turned.translation() - hinge), 0.04, atol=1e-12)
    np.testing.assert_allclose(np.abs(turned.rotation().matrix()[0]), [1.0, 0.0, 0.0], atol=1e-12)


def test_rings_are_refused(tmp_path):
    scene, more = loose_hung_bar(), []
    anchors = scene.attachments[0].anchors
    for child, parent in (("the beam", "third"), ("third", "a bar")):
        more.append(Attachment(child=child, parent=parent, anchors=anchors))
    third = replace(scene.objects[0], name="third")
    ring = replace(scene, objects=(*scene.objects, third), attachments=(*scene.attachments, *more))
    with pytest.raises(ExportError, match="hangs from itself"):
        write_sdf(ring, tmp_path / "sdf")


def test_what_hangs_from_two_objects_is_refused_with_the_formats_that_can_say_it(tmp_path):
    scene = hung_bar()
    second = replace(scene.objects[0], name="other beam")
    twice = (*scene.attachments, Attachment(child="a bar", parent="other beam", anchors=scene.attachments[0].anchors))
    with pytest.raises(ExportError, match="mjcf or urdf"):
        write_sdf(replace(scene, objects=(*scene.objects, second), attachments=twice), tmp_path / "sdf")
    assert not (tmp_path / "sdf").exists()
