"""Scenes whose poses were edited: `pat3d settle` brings them to rest, `pat3d optimize` starts from where things are."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest

import pat3d
from pat3d.check.verification import verify
from pat3d.cli.main import main
from pat3d.errors import LayoutError
from pat3d.exporters.compare import differences
from pat3d.generation import edited as module
from pat3d.generation.edited import edited, laid_out_as_posed
from pat3d.geometry.pose import Pose
from pat3d.layout.clearance import pair_distances
from pat3d.scene.model import Relation, Scene, SceneObject


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scenes") / "mug"
    assert main(["generate", "a red mug on a wooden box", "--out", str(folder), "--seed", "5"]) == 0
    return folder


@pytest.fixture
def folder(made, tmp_path):
    shutil.copytree(made, tmp_path / "mug")
    return tmp_path / "mug"


def move(folder, name, offset, key="pose"):
    """Edit scene.json as a person would."""
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    entry = next(obj for obj in document["objects"] if obj["name"] == name)
    entry[key]["position"] = [a + b for a, b in zip(entry[key]["position"], offset, strict=True)]
    path.write_text(json.dumps(document))


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def clear(scene):
    pairs = pair_distances({o.name: o.asset for o in scene.objects}, {o.name: o.initial_pose for o in scene.objects})
    return all(pair.distance > 0.0 for pair in pairs)


@pytest.mark.slow
def test_an_edit_is_seen_where_the_trajectory_ends_elsewhere(folder):
    scene = pat3d.load_scene(folder)
    assert edited(scene, folder) == frozenset()
    for offset, names in (((5e-5, 0, 0), {"red mug"}), ((1e-6, 0, 0), set())):
        obj = scene["red mug"]
        pose = replace(obj.pose, position=tuple(np.add(obj.pose.position, offset)))
        objects = tuple(replace(one, pose=pose) if one is obj else one for one in scene.objects)
        assert edited(replace(scene, objects=objects), folder) == names
    # Turned by 0.3 degrees about its own centre of mass.
    obj = scene["red mug"]
    centre = np.array([obj.asset.mass_properties.centre_of_mass])
    pose = Pose.from_yaw(0.005, (0.0, 0.0, 0.0))
    shift = obj.pose.apply(centre)[0] - pose.apply(centre)[0]
    turned = replace(obj, pose=replace(pose, position=tuple(shift)))
    objects = tuple(turned if one.name == "red mug" else one for one in scene.objects)
    assert edited(replace(scene, objects=objects), folder) == {"red mug"}
    (folder / "trajectory.npz").unlink()
    assert edited(replace(scene, objects=objects), folder) == frozenset()


def test_settle_brings_an_object_that_was_lifted_back_to_rest_and_writes_the_whole_folder(folder, capfd):
    before = pat3d.load_scene(folder)
    (folder / "notes.txt").write_text("mine")
    move(folder, "red mug", (0.005, 0.0, 0.03))
    assert main(["check", str(folder)]) == 1
    assert main(["settle", str(folder)]) == 0
    assert "edited since it settled: red mug" in capfd.readouterr().out
    scene = pat3d.load_scene(folder)
    rest, start = scene["red mug"].pose, scene["red mug"].initial_pose
    assert start.position == pytest.approx(np.add(before["red mug"].pose.position, (0.005, 0.0, 0.03)))
    assert rest.position == pytest.approx(np.add(before["red mug"].pose.position, (0.005, 0.0, 0.0)), abs=1e-3)
    assert scene["wooden box"].pose.position == pytest.approx(before["wooden box"].pose.position, abs=1e-4)
    report = json.loads((folder / "report.json").read_text())
    assert report["passed"]
    assert "inputs" not in report
    assert differences(scene, folder / "mjcf" / "scene.xml") == ()
    assert (folder / "notes.txt").read_text() == "mine"
    assert edited(scene, folder) == frozenset()
    assert main(["check", str(folder)]) == 0


def test_settle_into_another_folder_leaves_the_edited_one_as_it_is(folder, tmp_path):
    move(folder, "red mug", (0.0, 0.0, 0.01))
    before = files(folder)
    assert main(["settle", str(folder), "--out", str(tmp_path / "other")]) == 0
    assert files(folder) == before
    assert json.loads((tmp_path / "other" / "report.json").read_text())["passed"]


def test_an_object_that_was_pushed_into_its_support_is_lifted_out_and_settles(folder):
    before = pat3d.load_scene(folder)
    move(folder, "red mug", (0.0, 0.0, -0.02))
    assert main(["settle", str(folder)]) == 0
    scene = pat3d.load_scene(folder)
    assert clear(scene)
    assert scene["red mug"].pose.position == pytest.approx(before["red mug"].pose.position, abs=1e-3)


def test_an_object_that_was_put_beside_its_support_fails_with_what_is_broken(folder, capfd):
    move(folder, "red mug", (0.6, 0.0, 0.0))
    assert main(["settle", str(folder)]) == 1
    assert "broken: red mug on wooden box" in capfd.readouterr().err
    assert pat3d.load_scene(folder)["red mug"].pose.position[2] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.slow
def test_optimize_settles_from_the_edited_poses_and_does_not_say_that_all_is_well(folder, capfd):
    before = pat3d.load_scene(folder)
    move(folder, "red mug", (0.005, 0.0, 0.03))
    assert main(["optimize", str(folder)]) == 0
    said = capfd.readouterr().out
    assert "edited since it settled: red mug" in said
    assert "left as it is" not in said
    scene = pat3d.load_scene(folder)
    assert scene["red mug"].pose.position == pytest.approx(
        np.add(before["red mug"].pose.position, (0.005, 0.0, 0.0)), abs=1e-3
    )
    assert verify(scene, folder / "mjcf" / "scene.xml").failures == ()
    assert main(["optimize", str(folder)]) == 0
    assert "left as it is" in capfd.readouterr().out


@pytest.mark.slow
def test_optimize_mends_an_edit_that_broke_a_relation(folder, capfd):
    """The mug was put beside its box; the optimisation may find it a place on it again, or says that it did not."""
    move(folder, "red mug", (0.6, 0.0, 0.0))
    code = main(["optimize", str(folder), "--epochs", "0"])
    told = capfd.readouterr()
    scene = pat3d.load_scene(folder)
    held = scene["red mug"].pose.position[2] > 0.5 * scene["wooden box"].asset.size[2]
    assert (code == 0) == held
    assert held or "broken: red mug on wooden box" in told.err


def stack(block, positions, fixed=()):
    """Blocks named a, b, c, each on the one before."""
    names = "abc"[: len(positions)]
    objects = tuple(
        SceneObject(
            name=name, asset=block, pose=Pose(position=p), initial_pose=Pose(position=(9, 9, 9)), fixed=name in fixed
        )
        for name, p in zip(names, positions, strict=True)
    )
    relations = tuple(Relation(child=up, kind="on", parent=low) for low, up in zip(names, names[1:], strict=False))
    return Scene(objects=objects, relations=relations)


@pytest.fixture(scope="module")
def block():
    from pat3d.assets import catalogue

    return catalogue.make("cube", seed=0)


def test_poses_that_are_clear_are_the_layout_as_they_are(block):
    side = float(block.size[2])
    scene = laid_out_as_posed(stack(block, [(0, 0, 1e-5), (0, 0, side + 2e-5)]))
    assert [obj.initial_pose for obj in scene.objects] == [obj.pose for obj in scene.objects]
    assert scene["b"].initial_pose.position == (0, 0, side + 2e-5)


def test_what_is_lifted_takes_along_what_it_carries_and_no_further_than_it_has_to(block):
    side = float(block.size[2])
    sunk = [(0, 0, 1e-5), (0, 0, 0.8 * side), (0, 0, 1.8 * side + 1e-5)]
    scene = laid_out_as_posed(stack(block, sunk))
    assert clear(scene)
    lifts = [obj.initial_pose.position[2] - before[2] for obj, before in zip(scene.objects, sunk, strict=True)]
    assert lifts[0] == 0.0
    assert lifts[1] == pytest.approx(0.2 * side + 1e-5 + module.GAP, abs=module.GAP)
    assert lifts[2] == pytest.approx(lifts[1], abs=2 * module.GAP)
    # What floats over its support keeps its height above it, though it would be clear without.
    floating = [(0, 0, 1e-5), (0, 0, side - 1e-3), (0, 0, 2 * side + 5e-3)]
    scene = laid_out_as_posed(stack(block, floating))
    lifts = [obj.initial_pose.position[2] - before[2] for obj, before in zip(scene.objects, floating, strict=True)]
    assert lifts[2] == pytest.approx(lifts[1], abs=1e-12)
    assert lifts[1] > 1e-3


def test_of_two_that_intersect_the_edited_one_is_lifted(block):
    side = float(block.size[2])
    scene = replace(stack(block, [(0, 0, 1e-5), (0.5 * side, 0, 2e-5)]), relations=())
    assert laid_out_as_posed(scene, {"a"})["b"].initial_pose.position == (0.5 * side, 0, 2e-5)
    assert laid_out_as_posed(scene, {"a"})["a"].initial_pose.position[2] > side
    assert laid_out_as_posed(scene, {"b"})["a"].initial_pose.position == (0, 0, 1e-5)


def test_what_is_under_the_ground_comes_up_and_what_is_fixed_stays(block):
    scene = laid_out_as_posed(stack(block, [(0, 0, -0.5)]))
    assert scene["a"].initial_pose.position[2] == pytest.approx(0.0, abs=2 * module.GAP)
    side = float(block.size[2])
    scene = laid_out_as_posed(stack(block, [(0, 0, 0), (0, 0, 0.5 * side)], fixed=("a",)))
    assert scene["a"].initial_pose.position == (0, 0, 0)
    assert clear(scene)


def test_what_no_lift_helps_is_refused(block, monkeypatch):
    monkeypatch.setattr(module, "_MAX_LIFT", 2e-3)
    with pytest.raises(LayoutError, match='"a" intersects something even'):
        laid_out_as_posed(stack(block, [(0, 0, -0.5)]))


def test_a_folder_without_a_scene_is_refused(tmp_path, capfd):
    assert main(["settle", str(tmp_path / "nowhere")]) == 2
    assert "not a folder" in capfd.readouterr().err
