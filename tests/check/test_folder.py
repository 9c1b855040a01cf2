"""`pat3d check` of a folder: files, contents, readers, then the scene; nothing unknown is simulated."""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.check import folder as checking
from pat3d.check.folder import check_folder
from pat3d.check.parts import part_failures
from pat3d.check.settle import creep
from pat3d.exporters import export
from pat3d.scene.checksums import record_checksums
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Relation
from tests.exporters.things import mixed_scene
from tests.scenes import GAP, asset_of, placed, scene_of, tower


def written(scene, folder, formats=("mjcf", "urdf")):
    save_scene(scene, folder)
    export(scene, formats, folder)
    record_checksums(folder)
    return folder


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return written(tower(2), tmp_path_factory.mktemp("scene") / "tower")


@pytest.fixture
def folder(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "tower")
    return tmp_path / "tower"


@pytest.fixture
def simulated(monkeypatch):
    """Files that were simulated."""
    paths = []

    def verify(scene, path, progress, *, seconds):
        paths.append(path)
        return real(scene, path, progress, seconds=0.1)

    real = checking.verify
    monkeypatch.setattr(checking, "verify", verify)
    return paths


def test_an_honest_folder_passes_and_the_delivered_file_is_what_is_simulated(folder, simulated):
    report = check_folder(folder)
    assert report.failures == report.notes == ()
    assert simulated == [folder / "mjcf" / "scene.xml"]


@pytest.mark.parametrize(
    ("before", "after", "words"),
    [
        ('timestep="0.002"', 'timestep="0.000001"', 'timestep="0.000001" instead of "0.002"'),
        (
            "</worldbody>",
            '<replicate count="99999999"><geom size="1"/></replicate></worldbody>',
            "<replicate> is there",
        ),
    ],
)
def test_a_tampered_file_is_convicted_and_never_simulated(folder, simulated, before, after, words):
    path = folder / "mjcf" / "scene.xml"
    text = path.read_text()
    assert before in text
    path.write_text(text.replace(before, after))
    failures = "\n".join(check_folder(folder).failures)
    assert "mjcf/scene.xml is not the file that was verified" in failures
    assert words in failures
    assert simulated
    assert all(not str(path).startswith(str(folder)) for path in simulated)


def test_forged_checksums_do_not_help(folder, simulated):
    path = folder / "urdf" / "manifest.json"
    path.write_text(path.read_text().replace("-9.81", "-0.5"))
    record_checksums(folder)
    assert any("gravity is [0.0, 0.0, -0.5]" in line for line in check_folder(folder).failures)


def test_an_earlier_folder_passes_with_the_note_that_nothing_vouches_for_it(folder, simulated):
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    del document["checksums"], document["checksum"]
    path.write_text(json.dumps(document))
    report = check_folder(folder)
    assert report.failures == ()
    assert "cannot be vouched for" in report.notes[0]


def test_exports_without_their_scene_are_compared_with_their_checksums(folder, tmp_path):
    out = tmp_path / "out"
    export(load_scene(folder), ("mjcf",), out)
    record_checksums(out, ("mjcf",))
    report = check_folder(out)
    assert report.passed
    assert "nothing else" in report.notes[0]
    (out / "mjcf" / "scene.xml").write_text("<mujoco/>")
    assert not check_folder(out).passed


def test_a_relation_that_was_asked_for_and_does_not_hold_is_a_failure(tmp_path, simulated):
    cube = asset_of(box(0.1, 0.1, 0.1))
    left, right = placed("left", cube, (-0.3, 0, GAP)), placed("right", cube, (0.3, 0, GAP))
    scene = scene_of(left, right)
    for child, parent, passed in (("left", "right", True), ("right", "left", False)):
        relation = Relation(child=child, kind="left_of", parent=parent)
        asked = replace(scene, relations=(*scene.relations, relation))
        report = check_folder(written(asked, tmp_path / child, ("mjcf",)))
        assert report.passed is passed, report.failures
    assert any(line.startswith("not met: right left_of left") for line in report.failures)


def test_parts_are_convex_and_boxes_are_boxes():
    scene = mixed_scene()
    assert part_failures(scene) == ()
    mug = scene["red mug 1"].asset
    number = next(number for number, part in enumerate(mug.parts) if part.box is None)
    part = mug.parts[number]
    vertices = part.vertices.copy()
    vertices[0] = 0.9 * vertices.mean(axis=0) + 0.1 * vertices[0]
    parts = [*mug.parts]
    parts[number] = replace(part, vertices=vertices)
    dented = replace(scene["red mug 1"], asset=replace(mug, parts=tuple(parts)))
    assert "is not convex" in part_failures(replace(scene, objects=(dented,), relations=()))[0]
    table = scene["wooden table"]
    (plank,) = table.asset.parts
    centre, half, quat = plank.box
    swollen = replace(plank, box=(centre, (half[0], half[1], 1.01 * half[2]), quat))
    other = replace(table, asset=replace(table.asset, parts=(swollen,)))
    assert "is not the box" in part_failures(replace(scene, objects=(other,), relations=()))[0]


def test_creep_is_speed_a_minute_and_trembling_is_none():
    times = np.linspace(0.0, 60.0, 6001)
    centres = np.zeros((6001, 3, 3))
    centres[:, 0, 0] = 2e-6 * times
    centres[:, 1, 2] = 1e-5 * np.sin(40.0 * times)
    half = 0.5 * np.radians(0.01) * times
    quats = np.tile([1.0, 0.0, 0.0, 0.0], (6001, 3, 1))
    quats[:, 2] = np.stack([np.cos(half), 0 * half, 0 * half, np.sin(half)], axis=1)
    quats[::2, 2] *= -1.0
    mm, degrees = creep(times, centres, quats)
    assert mm == pytest.approx([0.12, 0.0, 0.0], abs=1e-3)
    assert degrees == pytest.approx([0.0, 0.0, 0.6], abs=1e-6)


def test_a_short_run_says_nothing_of_creep():
    """After five seconds some scenes still settle by a micrometre a second, and then stop."""
    times = np.linspace(0.0, 5.0, 501)
    assert creep(times, np.zeros((501, 1, 3)), np.tile([1.0, 0.0, 0.0, 0.0], (501, 1, 1))) is None
