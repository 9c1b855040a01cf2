"""Moments of episodes in one picture."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.errors import EvaluationError
from pat3d.policies_eval.strip import GAP, moments_of, write_strip


def frame(brightness):
    return np.full((20, 30, 3), brightness, dtype=np.uint8)


def test_every_moment_is_in_the_picture_in_its_place(tmp_path):
    image = pytest.importorskip("PIL.Image")
    rows = [("", [frame(10), frame(90)]), ("said", [frame(160), frame(200)])]
    found = np.asarray(image.open(write_strip(rows, tmp_path / "a.png")))
    assert found.shape[1] == 3 * GAP + 60
    for column, (upper, lower) in enumerate(((10, 160), (90, 200))):
        x = GAP + column * (30 + GAP)
        assert (found[GAP : GAP + 20, x : x + 30] == upper).all()
        assert (found[-GAP - 20 : -GAP, x : x + 30] == lower).all()
    # The caption is between the rows.
    assert (found[GAP + 20 + GAP : -GAP - 20] < 100).any()


def test_fewer_colours_make_a_picture_with_no_more_than_those(tmp_path):
    image = pytest.importorskip("PIL.Image")
    noise = np.random.default_rng(0).integers(0, 256, (20, 30, 3)).astype(np.uint8)
    found = image.open(write_strip([("", [noise])], tmp_path / "a.png", colours=16)).convert("RGB")
    assert len(found.getcolors()) <= 16


def test_moments_are_spread_from_start_to_end_without_repetition():
    assert moments_of(90, 4) == [0, 30, 60, 90]
    assert moments_of(2, 5) == [0, 1, 2]
    assert moments_of(0, 4) == [0]


@pytest.mark.parametrize(("rows", "name"), [([], "a.png"), ([("", [])], "a.png"), ([("", [frame(1)])], "a.jpg")])
def test_nothing_to_show_and_other_formats_are_errors(tmp_path, rows, name):
    with pytest.raises(EvaluationError):
        write_strip(rows, tmp_path / name)
    assert list(tmp_path.iterdir()) == []
