"""Records that cannot be, tables of policies, and films of datasets, without an environment."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

pa = pytest.importorskip("pyarrow")

from pat3d.errors import EvaluationError  # noqa: E402
from pat3d.policies_eval.analysis.compare import leaderboard  # noqa: E402
from pat3d.policies_eval.datasets import lerobot as lerobot_file  # noqa: E402
from pat3d.policies_eval.datasets.lerobot import write_lerobot  # noqa: E402
from pat3d.policies_eval.run import records  # noqa: E402
from pat3d.policies_eval.run.episodes import Episode  # noqa: E402
from pat3d.policies_eval.run.failures import Events  # noqa: E402
from pat3d.policies_eval.run.records import Evaluation, read_manifest, result_of, row_of  # noqa: E402
from pat3d.policies_eval.run.rollout import Result  # noqa: E402
from pat3d.policies_eval.run.settings import RolloutSettings  # noqa: E402
from tests.policies_eval.test_lerobot_file import LENGTHS, demonstration  # noqa: E402

EVENTS = Events(
    grasped=True, lifted=False, slipped=True, dropped=False, toppled=("a",), collided=(), closest=0.1, highest=0.2
)


def result(index=0, *, success=False, outcome="missed", steps=2, size=7):
    actions = np.random.default_rng(index).uniform(-1, 1, (steps, size)).astype(np.float32)
    episode = Episode(index=index, scene="", task="pick:mug", seed=index)
    return Result(
        episode=episode, outcome=outcome, success=success, steps=steps, events=EVENTS, actions=actions, clipped=3
    )


def evaluation(name, outcomes):
    done = [result(k, success=one == "success", outcome=one) for k, one in enumerate(outcomes)]
    return Evaluation(folder=Path("/runs") / name, manifest={}, results=tuple(done))


def test_a_row_is_the_result_it_was_made_of():
    one = result(3, success=True, outcome="success", steps=5)
    again = result_of(row_of(one))
    assert again.to_json() == one.to_json()
    np.testing.assert_array_equal(again.actions, one.actions)


@pytest.mark.parametrize("size", [0, 1, 7])
def test_a_record_has_no_more_steps_than_any_episode(size, monkeypatch):
    """However many numbers an action has; what has no actions at all may claim as many numbers as steps."""
    monkeypatch.setattr(records, "MAX_STEPS", 10)
    row = row_of(result(steps=10, size=size))
    assert result_of(row).actions.size == 10 * size
    longer = row | {"actions": bytes(4 * (10 * max(size, 1) + max(size, 1)))}
    with pytest.raises(EvaluationError, match="cannot be read"):
        result_of(longer)


@pytest.mark.parametrize("changed", [{"outcome": "won"}, {"steps": None}, {"axes": "["}, {"actions": b"123"}])
def test_a_row_that_none_of_ours_is_like_is_refused(changed):
    with pytest.raises(EvaluationError, match="cannot be read"):
        result_of(row_of(result()) | changed)


def test_a_manifest_may_be_long_but_not_endless(tmp_path):
    """Episodes of thousands of scenes are named in it; nothing of ours fills 64 MiB."""
    manifest = {"format": 1, "policy": "p", "settings": {}, "engine": {}, "episodes": 1}
    manifest["source"] = {"scenes": [f"scenes/{k:05d}" for k in range(10_000)]}
    file = tmp_path / "manifest.json"
    file.write_text(json.dumps(manifest))
    assert file.stat().st_size > 100_000
    assert read_manifest(tmp_path) == manifest
    with file.open("r+b") as stream:
        stream.truncate(64 * 2**20 + 1)
    with pytest.raises(EvaluationError, match="larger than any manifest"):
        read_manifest(tmp_path)


def test_the_leaderboard_is_by_rates_with_the_best_first_and_the_unbegun_last():
    none, half, most = ["missed"] * 4, ["success", "missed"] * 2, ["success"] * 3 + ["policy_error"]
    evaluations = [
        evaluation("empty", []),
        evaluation("half b", half),
        evaluation("none", none),
        evaluation("most", most),
        evaluation("half a", half),
    ]
    rows = leaderboard(evaluations)
    assert [one.name for one, _, _ in rows] == ["most", "half a", "half b", "none", "empty"]
    assert [rate.value for _, rate, _ in rows[:4]] == [0.75, 0.5, 0.5, 0.0]
    assert [errors for _, _, errors in rows] == [1, 0, 0, 0, 0]


class Film:
    """Writes what an MP4 file would hold, uncompressed."""

    def __init__(self, path, size, fps):
        self.size, self.stream = tuple(size), path.open("wb")

    def add(self, frame):
        assert frame.shape == (*self.size, 3)
        self.stream.write(frame.tobytes())

    def close(self):
        self.stream.close()


@pytest.mark.parametrize("limit", [3, 8, 13, 14, 100])
def test_pictures_of_every_camera_are_in_the_films_where_the_episodes_say(tmp_path, monkeypatch, limit):
    """An episode is in one film, which begins anew where it would have more than `limit` frames."""
    monkeypatch.setattr(lerobot_file, "FilmWriter", Film)
    monkeypatch.setattr(lerobot_file, "FILM_FRAMES", limit)
    shown = [demonstration(number, pictures=True) for number in range(len(LENGTHS))]
    shown = [
        replace(one, observations=one.observations | {"front_image": 255 - one.observations["wrist_image"][:, :16]})
        for one in shown
    ]
    write_lerobot(shown, tmp_path / "set", RolloutSettings(control_freq=25.0))
    info = json.loads((tmp_path / "set/meta/info.json").read_text())
    from pyarrow import parquet

    rows = parquet.read_table(tmp_path / "set/meta/episodes/chunk-000/file-000.parquet").to_pylist()
    for camera, height in (("wrist", 32), ("front", 16)):
        key = f"observation.images.{camera}"
        assert info["features"][key]["shape"] == [height, 48, 3]
        lengths: dict[int, int] = {}
        for one, row in zip(shown, rows, strict=True):
            place = {name: row[f"videos/{key}/{name}"] for name in ("chunk_index", "file_index")}
            film = tmp_path / "set" / info["video_path"].format(video_key=key, **place)
            frames = np.frombuffer(film.read_bytes(), np.uint8).reshape(-1, height, 48, 3)
            begin, end = (round(25 * row[f"videos/{key}/{side}_timestamp"]) for side in ("from", "to"))
            assert begin == lengths.get(place["file_index"], 0)
            np.testing.assert_array_equal(frames[begin:end], one.observations[f"{camera}_image"])
            lengths[place["file_index"]] = end
            assert begin == 0 or end <= limit
        assert sum(lengths.values()) == sum(LENGTHS)
        assert len(lengths) == {3: 3, 8: 3, 13: 2, 14: 2, 100: 1}[limit]
    assert info["fps"] == 25
