import os
from pathlib import Path

import pytest

from pat3d.errors import ExportError
from pat3d.scene.replacement import replaced_file, replaced_folder, scratch_folder, write_bytes, write_text


def halfway(path):
    with replaced_file(path) as temporary:
        temporary.write_text("half")
        assert not path.exists() or path.read_text() == "old"
        raise KeyboardInterrupt


def test_a_file_is_old_or_new_and_nothing_else_is_left(tmp_path):
    path = tmp_path / "deep" / "a.json"
    with pytest.raises(KeyboardInterrupt):
        halfway(path)
    assert list(path.parent.iterdir()) == []
    write_text(path, "old")
    with pytest.raises(KeyboardInterrupt):
        halfway(path)
    assert path.read_text() == "old"
    write_bytes(path, "é".encode())
    assert path.read_text(encoding="utf-8") == "é"
    assert list(path.parent.iterdir()) == [path]


def test_the_temporary_file_has_the_suffix_by_which_libraries_choose_the_format(tmp_path):
    with replaced_file(tmp_path / "film.mp4") as temporary:
        assert temporary.suffix == ".mp4"
        assert temporary.parent == tmp_path
        temporary.touch()


def test_an_earlier_folder_comes_back_when_the_new_one_cannot_take_its_place(tmp_path, monkeypatch):
    folder = tmp_path / "scene"
    folder.mkdir()
    (folder / "a").write_text("old")
    rename = Path.rename

    def failing(self, target):
        if self.name == "new":
            raise OSError(28, "No space left on device")
        return rename(self, target)

    monkeypatch.setattr(Path, "rename", failing)
    with pytest.raises(ExportError, match="No space left"), replaced_folder(folder) as fresh:
        (fresh / "a").write_text("new")
    assert (folder / "a").read_text() == "old"
    assert list(tmp_path.iterdir()) == [folder]


def test_of_the_earlier_folder_only_what_is_kept_and_not_written_again_moves_on(tmp_path):
    folder = tmp_path / "scene"
    folder.mkdir()
    for name in ("mine", "both", "theirs"):
        (folder / name).write_text("old")
    with replaced_folder(folder, keep=lambda name: name != "theirs") as fresh:
        (fresh / "both").write_text("new")
    assert {entry.name: entry.read_text() for entry in folder.iterdir()} == {"mine": "old", "both": "new"}


def test_a_signal_as_soon_as_the_folder_is_there_leaves_nothing(tmp_path, monkeypatch):
    mkdir = os.mkdir

    def interrupted(path, *rest, **named):
        mkdir(path, *rest, **named)
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "mkdir", interrupted)
    with pytest.raises(KeyboardInterrupt), scratch_folder(tmp_path, ".scene-"):
        pass
    with pytest.raises(KeyboardInterrupt), replaced_folder(tmp_path / "scene"):
        pass
    assert list(tmp_path.iterdir()) == []
