"""scene.json says of every file in the folder whether it is the one that was written."""

import json
import shutil

import pytest

from pat3d.exporters import export
from pat3d.scene.checksums import compare_checksums, record_checksums, scene_checksum
from pat3d.scene.io import load_scene, save_scene
from tests.scenes import tower


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("scene") / "tower"
    scene = tower(2)
    save_scene(scene, folder)
    export(scene, ("mjcf", "urdf"), folder)
    record_checksums(folder)
    return folder


@pytest.fixture
def folder(whole, tmp_path):
    shutil.copytree(whole, tmp_path / "tower")
    return tmp_path / "tower"


def files(folder):
    return sorted(path for path in folder.rglob("*") if path.is_file())


def test_every_file_is_vouched_for_and_an_untouched_folder_has_no_failures(folder):
    recorded = set(json.loads((folder / "scene.json").read_text())["checksums"])
    assert recorded == {path.relative_to(folder).as_posix() for path in files(folder)} - {"scene.json"}
    report = compare_checksums(folder)
    assert report.recorded
    assert report.failures == report.notes == ()


def test_a_single_bit_of_any_file_is_seen_and_named(folder):
    for path in files(folder):
        content = path.read_bytes()
        if path.name == "scene.json":
            path.write_text(path.read_text().replace('"seed": 0', '"seed": 1'))
        else:
            path.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
        assert compare_checksums(folder).changed == (path.relative_to(folder).as_posix(),)
        path.write_bytes(content)
    assert compare_checksums(folder).failures == ()


def test_missing_and_extra_files_are_named(folder):
    (folder / "mjcf" / "scene.xml").unlink()
    (folder / "urdf" / "more.urdf").write_text("<robot/>")
    report = compare_checksums(folder)
    assert report.missing == ("mjcf/scene.xml",)
    assert report.extra == ("urdf/more.urdf",)
    assert len(report.failures) == 2


def test_what_python_and_file_browsers_leave_behind_is_no_fault(folder):
    (folder / "urdf" / "__pycache__").mkdir()
    (folder / "urdf" / "__pycache__" / "load_pybullet.cpython-311.pyc").write_bytes(b"0")
    (folder / "assets" / ".DS_Store").write_bytes(b"0")
    (folder / "notes.txt").write_text("mine")
    assert compare_checksums(folder).failures == ()


def test_the_layout_of_scene_json_is_no_fault_but_its_values_are(folder):
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    path.write_text(json.dumps(document, indent=4, sort_keys=True))
    assert compare_checksums(folder).failures == ()
    document["objects"][0]["pose"]["position"][2] += 1e-9
    path.write_text(json.dumps(document))
    assert compare_checksums(folder).changed == ("scene.json",)


def test_a_folder_without_checksums_loads_and_says_that_nothing_vouches_for_it(folder):
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    del document["checksums"], document["checksum"]
    path.write_text(json.dumps(document))
    assert len(load_scene(folder).objects) == 2
    report = compare_checksums(folder)
    assert not report.recorded
    assert report.failures == ()
    assert "cannot be vouched for" in report.notes[0]


def test_recording_changes_no_number_of_the_scene(whole):
    scene, again = tower(2), load_scene(whole)
    for one, other in zip(scene.objects, again.objects, strict=True):
        assert one.pose == other.pose
        assert (one.asset.visual.vertices == other.asset.visual.vertices).all()


def test_writing_one_export_anew_vouches_for_nothing_else(folder):
    (folder / "urdf" / "ground.urdf").write_text("<robot/>")
    part = next(folder.glob("assets/*/parts/*.obj"))
    part.write_text(part.read_text() + "\n")
    export(load_scene(folder), ("mjcf",), folder)
    record_checksums(folder, ("mjcf",))
    assert set(compare_checksums(folder).changed) == {"urdf/ground.urdf", part.relative_to(folder).as_posix()}


def test_an_edited_scene_json_stays_marked_when_an_export_is_recorded(folder):
    path = folder / "scene.json"
    document = json.loads(path.read_text())
    document["prompt"] = "something else"
    path.write_text(json.dumps(document))
    export(load_scene(folder), ("mjcf",), folder)
    record_checksums(folder, ("mjcf",))
    assert "scene.json" in compare_checksums(folder).changed


def test_exports_elsewhere_have_a_list_of_their_own(folder, tmp_path):
    out = tmp_path / "elsewhere"
    export(load_scene(folder), ("mjcf", "sdf"), out)
    record_checksums(out, ("mjcf", "sdf"))
    assert compare_checksums(out).failures == ()
    (out / "sdf" / "scene.sdf").write_text("<sdf/>")
    assert compare_checksums(out).changed == ("sdf/scene.sdf",)


def test_the_scene_s_own_checksum_covers_those_of_the_files(folder):
    document = json.loads((folder / "scene.json").read_text())
    assert document["checksum"] == scene_checksum(document)
    document["checksums"].popitem()
    assert document["checksum"] != scene_checksum(document)
