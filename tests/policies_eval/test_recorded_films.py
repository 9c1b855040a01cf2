"""Films of a dataset, with a recorder in place of FFmpeg: every one is finished, and statistics are of all pixels."""

from __future__ import annotations

import json

import numpy as np
import pytest

pytest.importorskip("pyarrow")

from pat3d.policies_eval.datasets import lerobot
from pat3d.policies_eval.datasets.demonstrations import Demonstration
from pat3d.policies_eval.run.episodes import Episode


def _demonstration(number, steps):
    """Pictures whose pixels are alike in blocks of 3 x 3, so that every third line says as much as all."""
    random = np.random.default_rng(number)
    blocks = random.integers(20 * number, 255 - 30 * number, (steps, 4, 5, 3)).astype(np.uint8)
    sizes = {"joint_pos": 7, "joint_vel": 7, "gripper_pos": 2, "eef_pos": 3, "eef_quat": 4}
    seen = {name: random.normal(size=(steps, size)) for name, size in sizes.items()}
    actions = np.zeros((steps, 7), dtype=np.float32)
    return Demonstration(
        episode=Episode(index=number, scene="", task="pick:a", seed=0),
        instruction="pick up a",
        observations=seen
        | {f"{name}_image": blocks.repeat(3, axis=1).repeat(3, axis=2) for name in ("wrist", "front")},
        actions=actions,
        done=actions,
    )


class _Film:
    """Notes what it is told."""

    made: list[_Film]

    def __init__(self, path, size, fps):
        self.size, self.fps, self.frames, self.closed = tuple(size), fps, [], 0
        self.made.append(self)

    def add(self, frame):
        assert not self.closed
        self.frames.append(frame)

    def close(self):
        self.closed += 1


@pytest.fixture
def films(monkeypatch):
    monkeypatch.setattr(_Film, "made", [], raising=False)
    monkeypatch.setattr(lerobot, "FilmWriter", _Film)
    return _Film.made


@pytest.mark.parametrize(("most", "lengths"), [(100, [[4, 6, 3]]), (10, [[4, 6], [3]]), (6, [[4], [6], [3]])])
def test_every_film_is_finished_once_and_holds_whole_episodes_up_to_its_length(
    tmp_path, films, monkeypatch, most, lengths
):
    monkeypatch.setattr(lerobot, "FILM_FRAMES", most)
    shown = [_demonstration(number, steps) for number, steps in enumerate((4, 6, 3))]
    lerobot.write_lerobot(shown, tmp_path / "set")
    assert [film.closed for film in films] == [1] * 2 * len(lengths)
    assert [len(film.frames) for film in films] == [sum(part) for part in lengths for _ in range(2)]
    assert {(film.size, film.fps) for film in films} == {((12, 15), 20)}
    frames = np.concatenate([film.frames for film in films[::2]])
    np.testing.assert_array_equal(frames, np.concatenate([one.observations["wrist_image"] for one in shown]))


def test_statistics_of_pictures_are_those_of_all_their_pixels_by_channel(tmp_path, films):
    shown = [_demonstration(number, steps) for number, steps in enumerate((4, 6, 3))]
    lerobot.write_lerobot(shown, tmp_path / "set")
    stats = json.loads((tmp_path / "set/meta/stats.json").read_text())["observation.images.front"]
    pixels = np.concatenate([one.observations["front_image"] for one in shown]).reshape(-1, 3) / 255.0
    for name in ("mean", "std", "min", "max"):
        np.testing.assert_allclose(stats[name], getattr(pixels, name)(axis=0).reshape(3, 1, 1), rtol=1e-12)
    assert stats["count"] == [13]
