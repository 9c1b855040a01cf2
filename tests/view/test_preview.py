import sys

import numpy as np
import pytest
from PIL import Image

from pat3d.errors import SpecError
from pat3d.view.gl import gl_renderer
from pat3d.view.preview import contact_sheet, save_picture, save_preview, save_turntable
from tests.view.shapes import ball, block, scene


def test_preview_shows_both_states_side_by_side_with_captions(tmp_path):
    path = tmp_path / "new folder" / "preview.png"
    save_preview(scene(), path, width=240, height=180)
    with Image.open(path) as image:
        assert image.format == "PNG"
        picture = np.array(image)
    assert picture.shape[1] == 2 * 240 + 3 * 8
    left, right = picture[8:188, 8:248].astype(int), picture[8:188, 256:496].astype(int)

    def red_rows(panel):
        return np.flatnonzero((panel[..., 0] - panel[..., 2] > 80).any(axis=1))

    assert red_rows(left).min() < red_rows(right).min() - 20  # The ball starts above where it rests.
    strip = picture[188:]
    assert strip[:, 60:200].min() < 90
    assert strip[:, 300:440].min() < 90
    assert [file.name for file in path.parent.iterdir()] == ["preview.png"]


def test_a_failed_write_leaves_the_old_file_and_no_other(tmp_path, monkeypatch):
    path = tmp_path / "picture.png"
    save_picture(scene(), path, width=80, height=60)
    before = path.read_bytes()

    def full_disk(*_, **__):
        raise OSError("no space left")

    monkeypatch.setattr(Image.Image, "save", full_disk)
    with pytest.raises(OSError, match="no space"):
        save_picture(scene(), path, width=64, height=48)
    assert path.read_bytes() == before
    assert list(tmp_path.iterdir()) == [path]


def test_contact_sheet_has_a_cell_for_every_entry_on_as_many_pages_as_needed(tmp_path):
    entries = [(f"thing {k}", ball() if k % 2 else block(), 1.0) for k in range(5)]
    (single,) = contact_sheet(iter(entries), tmp_path / "all.png", columns=3, width=64, height=48)
    with Image.open(single) as image:
        assert image.width == 3 * (64 + 6) + 6
    pages = contact_sheet(entries, tmp_path / "some.png", columns=2, width=64, height=48, per_page=2)
    assert [page.name for page in pages] == ["some.png", "some-2.png", "some-3.png"]
    assert all(page.exists() for page in pages)


def test_long_captions_stay_inside_their_cell(tmp_path):
    entries = [("a very long name that cannot fit under a small picture", block(), 1.0), ("", block(), 1.0)]
    (page,) = contact_sheet(entries, tmp_path / "long.png", width=64, height=48)
    with Image.open(page) as image:
        picture = np.array(image.convert("L"))
    assert picture[54:, 76:].min() > 200
    assert picture[54:, :70].min() < 120


def test_turntable_shows_every_side(tmp_path):
    colours = np.repeat(np.array([[200, 40, 40], [40, 60, 200]], dtype=np.uint8), 6, axis=0)
    mesh = block()
    two_faced = type(mesh).from_face_colours(
        mesh.vertices,
        mesh.faces,
        np.where(mesh.vertices[mesh.faces].mean(axis=1)[:, 1:2] < 0, colours[:1], colours[-1:]),
    )
    path = tmp_path / "turn.png"
    save_turntable(two_faced, path, caption="block", views=2, width=120, height=100)
    with Image.open(path) as image:
        picture = np.array(image).astype(int)
    assert picture.shape[1] == 2 * (120 + 6) + 6
    front, back = picture[56, 66], picture[56, 192]
    assert front[0] > front[2] + 50
    assert back[2] > back[0] + 50


def test_sheets_that_cannot_be_made_are_refused(tmp_path):
    with pytest.raises(SpecError, match="at least one entry"):
        contact_sheet([], tmp_path / "none.png")
    with pytest.raises(SpecError, match="1 to 16"):
        save_turntable(block(), tmp_path / "none.png", views=0)
    assert list(tmp_path.iterdir()) == []


def test_the_probe_of_gl_answers_without_raising(monkeypatch):
    assert gl_renderer("egl", timeout=0.001) is None
    assert gl_renderer("no such kind") is None
    monkeypatch.setattr(sys, "executable", "/no/such/python")
    assert gl_renderer("egl") is None
