"""From the command line to a verified folder, once, on a small scene; the tests look at what it left."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import pat3d
from pat3d.cli.main import main
from pat3d.errors import ExportError, PromptError
from pat3d.exporters.compare import differences
from pat3d.plan.scene_plan import PlannedObject, ScenePlan
from pat3d.scene.folder import read_trajectory
from pat3d.scene.model import Relation

PROMPT = "a red mug on a wooden box"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("scenes") / "mug"
    assert main(["generate", PROMPT, "--out", str(out), "--seed", "5", "--resume"]) == 0
    return out


@pytest.fixture(scope="module")
def report(folder):
    return json.loads((folder / "report.json").read_text())


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def test_the_folder_holds_what_a_scene_folder_holds_and_nothing_lies_beside_it(folder):
    assert {entry.name for entry in folder.iterdir()} == {
        "scene.json",
        "assets",
        "mjcf",
        "report.json",
        "preview.png",
        "trajectory.npz",
    }
    assert [entry.name for entry in folder.parent.iterdir()] == ["mug"]
    assert (folder / "mjcf" / "scene.xml").is_file()


def test_the_report_verifies_the_scene(report):
    assert report["passed"]
    assert report["failures"] == []
    verification = report["verification"]
    assert verification["certificate"]["worst"] <= 1e-3
    assert verification["penetration"]["hulls"] == verification["penetration"]["visuals"] == []
    assert verification["mujoco"]["worst_mm"] < 1.0
    assert verification["relations"]["held"] == verification["relations"]["count"] == 1
    assert {"planning", "assets", "layout", "settling", "verification", "preview", "total"} <= set(report["seconds"])
    assert len(report["attempts"]) == 1
    assert [obj["fixed"] for obj in report["objects"]] == [False, False]


def test_scene_json_loads_and_the_mug_stands_on_the_box(folder):
    scene = pat3d.load_scene(folder)
    assert (scene.prompt, scene.seed, scene.settling_friction) == (PROMPT, 5, 0.2)
    assert scene.relations == (Relation(child="red mug", kind="on", parent="wooden box"),)
    top = scene["wooden box"].asset.size[2]
    assert scene["red mug"].pose.position[2] == pytest.approx(top, abs=1e-3)
    assert scene["red mug"].initial_pose.position[2] > scene["red mug"].pose.position[2]


def test_the_export_has_the_poses_of_the_scene(folder):
    scene = pat3d.load_scene(folder)
    body = ET.parse(folder / "mjcf" / "scene.xml").find("worldbody/body[@name='red_mug']")
    assert body is not None
    np.testing.assert_allclose([float(v) for v in body.attrib["pos"].split()], scene["red mug"].pose.position)


def test_the_trajectory_starts_at_the_layout_and_ends_at_rest(folder):
    scene = pat3d.load_scene(folder)
    found = read_trajectory(folder / "trajectory.npz")
    assert found is not None
    assert found["states"].dtype == np.float32
    assert found["names"].tolist() == [obj.name for obj in scene.objects]
    for frame, poses in ((0, [obj.initial_pose for obj in scene.objects]), (-1, [obj.pose for obj in scene.objects])):
        for state, centre, pose in zip(found["states"][frame], found["centres"], poses, strict=True):
            np.testing.assert_allclose(state[0], pose.apply(centre[None])[0], atol=1e-6)


def test_the_preview_is_a_picture(folder):
    with Image.open(folder / "preview.png") as picture:
        assert picture.size[0] > 1000
        assert np.asarray(picture.convert("L")).std() > 10


def test_check_passes_the_scene_and_fails_it_once_it_is_tampered_with(folder, tmp_path, capfd):
    assert main(["check", str(folder)]) == 0
    shutil.copytree(folder, tmp_path / "bad")
    path = tmp_path / "bad" / "scene.json"
    document = json.loads(path.read_text())
    lifted = next(obj for obj in document["objects"] if obj["name"] == "red mug")
    lifted["pose"]["position"][2] += 0.01
    path.write_text(json.dumps(document))
    capfd.readouterr()
    assert main(["check", str(tmp_path / "bad")]) == 1
    errors = capfd.readouterr().err
    assert '"red mug" is not in equilibrium' in errors
    assert '"red mug" drifts' in errors
    assert "broken: red mug on wooden box" in errors


def test_check_convicts_an_export_that_differs_from_the_scene(folder, tmp_path, capfd):
    shutil.copytree(folder, tmp_path / "bad")
    path = tmp_path / "bad" / "mjcf" / "scene.xml"
    tree = ET.parse(path)
    body = tree.find("worldbody/body[@name='red_mug']")
    assert body is not None
    x, y, z = (float(value) for value in body.attrib["pos"].split())
    body.set("pos", f"{x} {y} {z + 0.05}")
    tree.write(path)
    assert main(["check", str(tmp_path / "bad")]) == 1
    errors = capfd.readouterr().err
    assert "mjcf/scene.xml is not the file that was verified" in errors
    assert '"red mug" stands elsewhere' in errors
    assert '<body "red_mug"> has pos=' in errors


def test_an_export_that_is_still_but_elsewhere_or_heavier_is_told_apart(folder, tmp_path):
    shutil.copytree(folder / "mjcf", tmp_path / "mjcf")
    scene, path = pat3d.load_scene(folder), tmp_path / "mjcf" / "scene.xml"
    assert differences(scene, path) == ()
    tree = ET.parse(path)
    body = tree.find("worldbody/body[@name='red_mug']")
    box = tree.find("worldbody/body[@name='wooden_box']/inertial")
    assert body is not None
    assert box is not None
    x, y, z = body.attrib["pos"].split()
    body.set("pos", f"{float(x) + 0.001} {y} {z}")
    box.set("mass", "5")
    world = tree.find("worldbody")
    assert world is not None
    ghost = ET.SubElement(world, "body", name="ghost", pos="3 0 1")
    ET.SubElement(ghost, "inertial", mass="1", pos="0 0 0", diaginertia="1 1 1")
    ET.SubElement(ghost, "freejoint")
    tree.write(path)
    told = "\n".join(differences(scene, path))
    assert '"red mug" stands elsewhere' in told
    assert "1 mm away" in told
    assert '"wooden box" weighs 5 kg' in told
    assert '"ghost"' in told


def test_resuming_a_finished_scene_repeats_no_stage_and_changes_no_bit(folder, tmp_path):
    copy = tmp_path / "mug"
    shutil.copytree(folder, copy)
    assert main(["generate", PROMPT, "--out", str(copy), "--seed", "5", "--resume"]) == 0
    report = json.loads((copy / "report.json").read_text())
    assert report["reused"] == ["layout 1", "settling 1"]
    assert not {"assets", "layout", "settling"} & set(report["seconds"])
    before, after = files(folder), files(copy)
    assert set(before) == set(after)
    assert {name for name in before if before[name] != after[name]} == {"report.json"}


def test_the_same_seed_gives_the_same_scene_and_an_earlier_folder_is_replaced(folder, tmp_path):
    """Without --resume nothing is taken from the earlier folder, and the result is the same to the last bit."""
    copy = tmp_path / "mug"
    shutil.copytree(folder, copy)
    (copy / "scene.json").write_text("{}")
    (copy / "notes.txt").write_text("mine")
    scene = pat3d.generate(PROMPT, out=copy, seed=5)
    assert (copy / "scene.json").read_bytes() == (folder / "scene.json").read_bytes()
    assert (copy / "mjcf" / "scene.xml").read_bytes() == (folder / "mjcf" / "scene.xml").read_bytes()
    assert (copy / "notes.txt").read_text() == "mine"
    assert scene["red mug"].pose == pat3d.load_scene(folder)["red mug"].pose


class _StoppedError(Exception):
    pass


def test_an_interrupted_run_goes_on_after_the_last_finished_stage(tmp_path):
    out = tmp_path / "ball"

    def stop(event):
        if event.stage == "verifying":
            raise _StoppedError

    with pytest.raises(_StoppedError):
        pat3d.generate("a ball", out=out, resume=True, progress=stop)
    assert [entry.name for entry in tmp_path.iterdir()] == ["ball.partial"]
    seen = []
    pat3d.generate("a ball", out=out, resume=True, progress=lambda event: seen.append(event.stage))
    assert "settling" not in seen
    assert [entry.name for entry in tmp_path.iterdir()] == ["ball"]


def test_an_interrupted_run_leaves_nothing_unless_asked_to(tmp_path):
    def stop(event):
        if event.stage == "settling":
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pat3d.generate("a ball", out=tmp_path / "deep" / "ball", progress=stop)
    assert list(tmp_path.iterdir()) == []


HELD = """
import contextlib, runpy, sys, time
from pat3d.scene import replacement

make = replacement.scratch_folder

@contextlib.contextmanager
def held(*arguments):
    with make(*arguments) as folder:
        time.sleep(600)
        yield folder

replacement.scratch_folder = held
sys.argv[0] = "pat3d"
runpy.run_module("pat3d", run_name="__main__", alter_sys=True)
"""
"""`python -m pat3d` that stops where its temporary folder is there: how fast it is decides nothing."""


@pytest.mark.skipif(sys.platform == "win32", reason="signals differ")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_ends_the_command_with_130_and_no_debris(tmp_path, number):
    """The command is stopped as soon as its temporary folder is there."""
    command = [sys.executable, "-c", HELD, "generate", PROMPT, "--out", str(tmp_path / "scene")]
    path = os.pathsep.join([str(Path(pat3d.__file__).parents[1]), os.environ.get("PYTHONPATH", "")])
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": path},
        # A test run in the background inherits an ignored interrupt.
        preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),
    )
    end = time.monotonic() + 600
    while process.poll() is None and not any(tmp_path.iterdir()) and time.monotonic() < end:
        time.sleep(0.01)
    process.send_signal(number)
    _, errors = process.communicate(timeout=600)
    # 130 to a shell in both cases: Python ends by the signal itself where it fell into a definition made by `exec`,
    # a dataclass of a module being imported say, although the command caught it.
    assert process.returncode in (130, -signal.SIGINT)
    assert errors.strip().endswith("pat3d: interrupted")
    assert "Traceback" not in errors
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_any_planner_will_do(tmp_path):
    class Fixed:
        def plan(self, prompt):
            return ScenePlan(prompt=prompt, objects=(PlannedObject(name="thing", noun="block"),))

    scene = pat3d.generate("whatever", out=tmp_path / "scene", planner=Fixed())
    assert [obj.name for obj in scene.objects] == ["thing"]


def test_unknown_words_are_named_with_the_nearest_known(tmp_path, capfd):
    assert main(["generate", "a flurble on a table", "--out", str(tmp_path / "x")]) == 2
    errors = capfd.readouterr().err.strip().splitlines()
    assert "flurble" in errors[-1]
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--friction", "-1"], "friction"),
        (["--friction", "nan"], "friction"),
        (["--seed", "-1"], "seed"),
        (["--formats", "fbx"], "mjcf"),
    ],
)
def test_settings_out_of_range_are_refused(tmp_path, capfd, arguments, words):
    assert main(["generate", "a ball", "--out", str(tmp_path / "x"), *arguments]) == 2
    assert words in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_device_that_is_not_there_is_refused_and_the_others_are_listed(tmp_path, capfd):
    import warp

    if warp.is_cuda_available():
        pytest.skip("there is one")
    assert main(["generate", "a ball", "--out", str(tmp_path / "x"), "--device", "cuda"]) == 2
    assert "Valid: cpu" in capfd.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_foreign_folder_is_not_touched(tmp_path):
    (tmp_path / "x").mkdir()
    (tmp_path / "x" / "thesis.tex").write_text("precious")
    with pytest.raises(ExportError, match=r"no scene\.json"):
        pat3d.generate("a ball", out=tmp_path / "x")
    with pytest.raises(PromptError):
        pat3d.generate("", out=tmp_path / "y")
    assert (tmp_path / "x" / "thesis.tex").read_text() == "precious"
    assert [entry.name for entry in tmp_path.iterdir()] == ["x"]
