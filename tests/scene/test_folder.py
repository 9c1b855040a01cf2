import os

import numpy as np
import pytest

from pat3d.errors import ExportError
from pat3d.scene.folder import check_target, finite, read_json, read_trajectory, replacing, write_json, write_trajectory


def test_the_folder_appears_when_the_block_ends(tmp_path):
    target = tmp_path / "deep" / "scene"
    with replacing(target) as fresh:
        (fresh / "scene.json").write_text("new")
        assert not target.exists()
    assert (target / "scene.json").read_text() == "new"
    assert [entry.name for entry in target.parent.iterdir()] == ["scene"]


def interrupted(target):
    with replacing(target) as fresh:
        (fresh / "scene.json").write_text("half")
        raise KeyboardInterrupt


def test_a_failure_leaves_everything_as_it_was(tmp_path):
    kept = tmp_path / "scene"
    kept.mkdir()
    (kept / "scene.json").write_text("old")
    for target in (kept, tmp_path / "deep" / "scene"):
        with pytest.raises(KeyboardInterrupt):
            interrupted(target)
    assert (kept / "scene.json").read_text() == "old"
    assert [entry.name for entry in tmp_path.iterdir()] == ["scene"]


def test_the_user_s_own_files_survive_and_stale_exports_do_not(tmp_path):
    target = tmp_path / "scene"
    (target / "usd").mkdir(parents=True)
    for name in ("scene.json", "notes.txt", "usd/scene.usd"):
        (target / name).write_text("old")
    with replacing(target) as fresh:
        (fresh / "scene.json").write_text("new")
    assert (target / "scene.json").read_text() == "new"
    assert (target / "notes.txt").read_text() == "old"
    assert not (target / "usd").exists()


def test_a_full_disk_is_an_export_error(tmp_path):
    with pytest.raises(ExportError, match="No space left"), replacing(tmp_path / "scene"):
        raise OSError(28, "No space left on device")
    assert not list(tmp_path.iterdir())


def test_folders_that_are_not_ours_to_replace_are_refused(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("x")
    (tmp_path / "photos").mkdir()
    (tmp_path / "photos" / "cat.jpg").write_text("x")
    monkeypatch.chdir(tmp_path)
    for out, words in (
        ("file", "is a file"),
        ("photos", "no scene.json"),
        (".", "inside it"),
        ("/", "inside it"),
        ("file/deeper", "not a folder"),
        ("x" * 300, "File name too long"),
    ):
        with pytest.raises(ExportError, match=words):
            check_target(out)
    (tmp_path / "empty").mkdir()
    assert check_target("empty") == tmp_path / "empty"
    assert check_target("a/b/c") == tmp_path / "a" / "b" / "c"


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_without_permission_is_refused(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(ExportError, match="cannot be made"):
        check_target(tmp_path / "scene")


def test_json_has_no_infinities(tmp_path):
    write_json(tmp_path / "a.json", {"a": (np.float64("inf"), np.int64(2), float("nan")), "b": np.bool_(True)})
    assert read_json(tmp_path / "a.json") == {"a": [None, 2, None], "b": True}
    assert finite({1: np.float32(0.5)}) == {"1": 0.5}


@pytest.mark.parametrize("text", ["", "[1]", "{", "\xff"])
def test_a_damaged_report_reads_as_empty(tmp_path, text):
    (tmp_path / "report.json").write_bytes(text.encode("latin-1"))
    assert read_json(tmp_path / "report.json") == {}
    assert read_json(tmp_path / "none.json") == {}


def test_a_trajectory_reads_back_without_pickle(tmp_path):
    states = np.random.default_rng(0).normal(size=(5, 2, 4, 3)).astype(np.float32)
    write_trajectory(tmp_path / "t.npz", ("red mug", "ä"), states, np.ones((2, 3)), 0.03)
    found = read_trajectory(tmp_path / "t.npz")
    assert found is not None
    assert found["names"].tolist() == ["red mug", "ä"]
    np.testing.assert_array_equal(found["states"], states)
    (tmp_path / "t.npz").write_bytes((tmp_path / "t.npz").read_bytes()[:100])
    assert read_trajectory(tmp_path / "t.npz") is None
