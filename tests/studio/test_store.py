"""Saving replaces only what was opened or written here, as a whole, and never at the same time as another studio."""

import fcntl
import os

import pytest

from pat3d.errors import EditError, ExportError, SpecError
from pat3d.mcp_server.root import Root
from pat3d.scene.io import load_scene
from pat3d.studio.store import Store
from tests.studio.bricks import bricks_in


@pytest.fixture
def store(tmp_path):
    bricks_in(tmp_path / "bricks")
    made = Store(Root.at(tmp_path))
    yield made
    made.close()


@pytest.mark.slow
def test_what_was_opened_is_saved_over_it_and_under_other_names(store, tmp_path):
    session = store.opened(tmp_path / "bricks")
    settled = session.select("block").removed().settled()
    assert store.saved(settled, "bricks") == tmp_path / "bricks"
    assert [obj.name for obj in load_scene(tmp_path / "bricks").objects] == ["board", "brick"]
    # Undone to what was opened, saving brings that back, although the folder holds the later scene.
    store.saved(settled.undone().undone(), "bricks")
    assert len(load_scene(tmp_path / "bricks").objects) == 3
    store.saved(settled, "two")
    assert len(load_scene(tmp_path / "two").objects) == 2


def test_what_waits_to_be_settled_is_not_saved(store, tmp_path):
    session = store.opened(tmp_path / "bricks").select("block").removed()
    with pytest.raises(EditError, match="Settle first"):
        store.saved(session, "two")
    assert not (tmp_path / "two").exists()


def test_a_folder_that_was_changed_since_is_not_replaced(store, tmp_path):
    session = store.opened(tmp_path / "bricks")
    path = tmp_path / "bricks" / "scene.json"
    path.write_text(path.read_text() + " ")
    with pytest.raises(ExportError, match="changed since"):
        store.saved(session, "bricks")
    assert path.read_text().endswith(" ")


def test_a_scene_that_was_not_opened_here_is_not_replaced(store, tmp_path):
    bricks_in(tmp_path / "theirs")
    with pytest.raises(ExportError, match="not opened here"):
        store.saved(store.opened(tmp_path / "bricks"), "theirs")


@pytest.mark.parametrize("name", ["../out", "/tmp/out", "", "a/b", ".hidden"])
def test_names_do_not_lead_out_of_the_root(store, tmp_path, name):
    with pytest.raises(SpecError, match="no scene name"):
        store.saved(store.opened(tmp_path / "bricks"), name)


def test_while_another_studio_writes_nothing_is_saved(store, tmp_path):
    session = store.opened(tmp_path / "bricks")
    other = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(other, fcntl.LOCK_EX)
    with pytest.raises(ExportError, match="another studio"):
        store.saved(session, "two")
    os.close(other)
    assert store.saved(session, "two").is_dir()


def test_formats_are_written_beside_the_scene_and_read_back(store, tmp_path):
    paths = store.exported(store.opened(tmp_path / "bricks"), "bricks", ["mjcf", "glb"])
    assert [path.relative_to(tmp_path).parts[:2] for path in paths] == [
        ("bricks-export", "mjcf"),
        ("bricks-export", "glb"),
    ]
    assert all(path.is_file() for path in paths)


def test_names_are_made_of_sentences(store):
    assert store.name_for("A red mug on a stack of books!") == "red-mug-stack-books"
    assert store.name_for("bricks") == "bricks-2"
    assert store.name_for("../..") == "scene"
