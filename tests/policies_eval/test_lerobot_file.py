"""LeRobotDatasets: everything that the format v3.0 says of a folder holds for what is written."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

pa = pytest.importorskip("pyarrow")

import pyarrow.parquet as pq  # noqa: E402

from pat3d.errors import EvaluationError  # noqa: E402
from pat3d.policies_eval.datasets import lerobot as lerobot_file  # noqa: E402
from pat3d.policies_eval.datasets.demonstrations import Demonstration  # noqa: E402
from pat3d.policies_eval.datasets.files import write_demonstrations  # noqa: E402
from pat3d.policies_eval.datasets.lerobot import write_lerobot  # noqa: E402
from pat3d.policies_eval.run.episodes import Episode  # noqa: E402
from pat3d.policies_eval.run.settings import RolloutSettings  # noqa: E402

LENGTHS = (5, 8, 3)
WORDS = ("pick up the mug", "please pick up the mug", "pick up the mug")


def demonstration(number, *, pictures=False, joints=7):
    random, steps = np.random.default_rng(number), LENGTHS[number]
    seen = {
        "joint_pos": random.normal(size=(steps, joints)),
        "joint_vel": random.normal(size=(steps, joints)),
        "gripper_pos": random.normal(size=(steps, 2)),
        "eef_pos": random.normal(size=(steps, 3)),
        "eef_quat": random.normal(size=(steps, 4)),
    }
    if pictures:
        # A brightness for every frame, so that a film says which frame it shows.
        frames = (20 + 14 * (sum(LENGTHS[:number]) + np.arange(steps))).astype(np.uint8)
        seen["wrist_image"] = np.broadcast_to(frames[:, None, None, None], (steps, 32, 48, 3))
    else:
        seen["target"] = random.normal(size=(steps, 10))
    actions = random.uniform(-1, 1, (steps, 7)).astype(np.float32)
    return Demonstration(
        episode=Episode(index=number, scene="", task="pick:mug", seed=number),
        instruction=WORDS[number],
        observations=seen,
        actions=actions,
        done=actions / 2,
    )


@pytest.fixture
def shown():
    return [demonstration(number) for number in range(len(LENGTHS))]


def test_the_interface_is_written_with_the_cameras_of_every_episode(tmp_path, shown):
    told = [replace(one, interface={"robot": "x", "cameras": {"wrist": k}}) for k, one in enumerate(shown)]
    write_lerobot(told, tmp_path / "set")
    written = json.loads((tmp_path / "set/meta/interface.json").read_text())
    assert written["robot"] == "x"
    assert written["cameras_of_episodes"] == [{"wrist": k} for k in range(len(shown))]


def read(folder, pattern="data/*/*.parquet"):
    return pa.concat_tables([pq.read_table(file) for file in sorted(folder.glob(pattern))])


def test_info_counts_what_is_there_and_describes_every_column(tmp_path, shown):
    write_lerobot(shown, tmp_path / "set")
    info = json.loads((tmp_path / "set/meta/info.json").read_text())
    assert (info["codebase_version"], info["fps"], info["robot_type"]) == ("v3.0", 20, "panda")
    assert (info["total_episodes"], info["total_frames"], info["total_tasks"]) == (3, 16, 2)
    assert info["splits"] == {"train": "0:3"}
    assert info["video_path"] is None
    table = read(tmp_path / "set")
    assert set(table.column_names) == set(info["features"])
    for name, feature in info["features"].items():
        kind, (size,) = table.schema.field(name).type, feature["shape"]
        value = kind if size == 1 else kind.value_type
        assert size == 1 or kind == pa.list_(value, size)
        assert value.to_pandas_dtype() == np.dtype(feature["dtype"]).type
        assert feature["names"] is None or len(feature["names"]) == size
        assert "/" not in name


def test_frames_are_the_demonstrations_one_after_the_other(tmp_path, shown):
    write_lerobot(shown, tmp_path / "set")
    table = read(tmp_path / "set").to_pydict()
    for name in ("actions", "done"):
        key = {"actions": "action", "done": "executed_action"}[name]
        assert np.array_equal(np.array(table[key], np.float32), np.concatenate([getattr(one, name) for one in shown]))
    state = np.array(table["observation.state"])
    assert np.allclose(state[:, :7], np.concatenate([one.observations["joint_pos"] for one in shown]))
    assert np.allclose(state[:, 9:12], np.concatenate([one.observations["eef_pos"] for one in shown]))
    assert table["index"] == list(range(16))
    assert table["episode_index"] == [0] * 5 + [1] * 8 + [2] * 3
    assert table["frame_index"] == [*range(5), *range(8), *range(3)]
    assert np.allclose(table["timestamp"], np.array(table["frame_index"]) / 20)
    assert table["task_index"] == [0] * 5 + [1] * 8 + [0] * 3
    assert [k for k, done in enumerate(table["next.done"]) if done] == [4, 12, 15]


def test_episodes_say_where_their_frames_are_in_however_many_files(tmp_path, shown, monkeypatch):
    monkeypatch.setattr(lerobot_file, "DATA_BYTES", 1)
    monkeypatch.setattr(lerobot_file, "CHUNK", 2)
    write_lerobot(shown, tmp_path / "set")
    info = json.loads((tmp_path / "set/meta/info.json").read_text())
    for number, row in enumerate(read(tmp_path / "set", "meta/episodes/*/*.parquet").to_pylist()):
        place = {name: row[f"data/{name}"] for name in ("chunk_index", "file_index")}
        table = pq.read_table(tmp_path / "set" / info["data_path"].format(**place))
        assert set(table["episode_index"].to_pylist()) == {number}
        assert table["index"].to_pylist() == list(range(row["dataset_from_index"], row["dataset_to_index"]))
        assert (row["episode_index"], row["length"], row["tasks"]) == (number, LENGTHS[number], [WORDS[number]])
    assert (tmp_path / "set/data/chunk-001/file-000.parquet").is_file()


def test_tasks_are_the_index_of_a_pandas_table(tmp_path, shown):
    write_lerobot(shown, tmp_path / "set")
    table = pq.read_table(tmp_path / "set/meta/tasks.parquet")
    assert table.to_pydict() == {"task_index": [0, 1], "task": list(WORDS[:2])}
    said = json.loads(table.schema.metadata[b"pandas"])
    assert said["index_columns"] == ["task"]
    assert [one["field_name"] for one in said["columns"]] == table.column_names
    pandas = pytest.importorskip("pandas")
    frame = pandas.read_parquet(tmp_path / "set/meta/tasks.parquet")
    assert frame.iloc[1].name == WORDS[1]
    assert int(frame.loc[WORDS[1]].task_index) == 1


def test_statistics_are_those_of_the_frames(tmp_path, shown):
    write_lerobot(shown, tmp_path / "set")
    stats = json.loads((tmp_path / "set/meta/stats.json").read_text())
    table = read(tmp_path / "set")
    assert set(stats) == set(table.column_names)
    rows = read(tmp_path / "set", "meta/episodes/*/*.parquet").to_pylist()
    action = np.array(table["action"].to_pylist())
    for values, found in ((action, stats["action"]), (action[5:13], _under(rows[1], "stats/action/"))):
        assert np.allclose(found["mean"], values.mean(axis=0))
        assert np.allclose(found["std"], values.std(axis=0))
        assert np.allclose(found["min"], values.min(axis=0))
        assert np.allclose(found["max"], values.max(axis=0))
        for name, share in (("q01", 0.01), ("q10", 0.1), ("q50", 0.5), ("q90", 0.9), ("q99", 0.99)):
            assert np.allclose(found[name], np.quantile(values, share, axis=0))
        assert found["count"] == [len(values)]
    assert np.shape(stats["timestamp"]["mean"]) == (1,)


def _under(row, prefix):
    return {name.removeprefix(prefix): value for name, value in row.items() if name.startswith(prefix)}


def test_films_hold_every_frame_where_the_episodes_say(tmp_path, monkeypatch):
    ffmpeg = pytest.importorskip("imageio_ffmpeg")
    monkeypatch.setattr(lerobot_file, "FILM_FRAMES", 14)
    shown = [demonstration(number, pictures=True) for number in range(len(LENGTHS))]
    write_lerobot(shown, tmp_path / "set", RolloutSettings(control_freq=25.0))
    info = json.loads((tmp_path / "set/meta/info.json").read_text())
    key = "observation.images.wrist"
    assert info["features"][key]["dtype"] == "video"
    assert info["features"][key]["shape"] == [32, 48, 3]
    assert key not in read(tmp_path / "set").column_names
    begins = []
    for one, row in zip(shown, read(tmp_path / "set", "meta/episodes/*/*.parquet").to_pylist(), strict=True):
        place = _under(row, f"videos/{key}/")
        film = tmp_path / "set" / info["video_path"].format(video_key=key, **place)
        reader = ffmpeg.read_frames(str(film))
        said = next(reader)
        assert (said["size"], said["fps"]) == ((48, 32), 25.0)
        brightness = [float(np.frombuffer(frame, np.uint8).mean()) for frame in reader]
        begin = round(place["from_timestamp"] * 25)
        assert place["to_timestamp"] - place["from_timestamp"] == pytest.approx(len(one.actions) / 25)
        expected = one.observations["wrist_image"][:, 0, 0, 0]
        assert np.allclose(brightness[begin : begin + len(expected)], expected, atol=4)
        begins.append((place["file_index"], begin))
    assert begins == [(0, 0), (0, 5), (1, 0)]
    stats = json.loads((tmp_path / "set/meta/stats.json").read_text())[key]
    everything = np.concatenate([one.observations["wrist_image"] for one in shown]) / 255
    assert np.shape(stats["mean"]) == (3, 1, 1)
    assert np.allclose(np.ravel(stats["mean"]), everything.mean())
    assert np.allclose(np.ravel(stats["std"]), everything.std())
    assert np.allclose(np.ravel(stats["min"]), everything.min())
    assert np.allclose(np.ravel(stats["max"]), everything.max())
    # Quantiles of films are means of the episodes' own, by their lengths.
    parts = [one.observations["wrist_image"] / 255 for one in shown]
    for name, share in (("q01", 0.01), ("q50", 0.5), ("q99", 0.99)):
        mean = sum(len(part) * np.quantile(part, share) for part in parts) / len(everything)
        assert np.allclose(np.ravel(stats[name]), mean)


def test_a_folder_that_holds_something_is_left_alone(tmp_path, shown):
    (tmp_path / "set").mkdir()
    (tmp_path / "set/mine").write_text("x")
    with pytest.raises(EvaluationError, match="new folder"):
        write_lerobot(shown, tmp_path / "set")
    assert [file.name for file in tmp_path.rglob("*")] == ["set", "mine"]


def test_a_dataset_is_replaced_only_where_that_is_asked_for_and_only_by_a_complete_one(tmp_path, shown):
    write_lerobot(shown, tmp_path / "set")
    before = (tmp_path / "set/meta/info.json").read_bytes()
    with pytest.raises(EvaluationError, match="new folder"):
        write_lerobot(shown[:1], tmp_path / "set")
    with pytest.raises(EvaluationError, match="at least one"):
        write_lerobot([], tmp_path / "set", overwrite=True)
    assert (tmp_path / "set/meta/info.json").read_bytes() == before
    write_lerobot(shown[:1], tmp_path / "set", overwrite=True)
    assert json.loads((tmp_path / "set/meta/info.json").read_text())["total_episodes"] == 1
    assert [entry.name for entry in tmp_path.iterdir()] == ["set"]


@pytest.mark.parametrize(
    ("given", "settings", "said"),
    [
        ([], RolloutSettings(), "at least one"),
        ([demonstration(0), demonstration(1, joints=6)], RolloutSettings(), "another shape"),
        ([demonstration(0)], RolloutSettings(control_freq=12.5), "whole frames"),
    ],
)
def test_what_makes_no_dataset_is_an_error_and_leaves_nothing(tmp_path, given, settings, said):
    with pytest.raises(EvaluationError, match=said):
        write_lerobot(given, tmp_path / "set", settings)
    assert list(tmp_path.iterdir()) == []


def test_the_name_decides_the_format(tmp_path, shown):
    pytest.importorskip("h5py")
    assert write_demonstrations(shown, tmp_path / "a.hdf5") == 3
    assert write_demonstrations(iter(shown), tmp_path / "a") == 3
    assert (tmp_path / "a/meta/info.json").is_file()
    assert (tmp_path / "a.hdf5").is_file()
    with pytest.raises(EvaluationError, match=r"FILE\.hdf5 or a folder"):
        write_demonstrations(shown, tmp_path / "a.zip")


def test_the_command_writes_what_the_scripted_policy_did(tmp_path, capsys):
    pytest.importorskip("robosuite")
    from pat3d.cli.main import main

    arguments = ["demonstrate", "--episodes", "2", "--noise", "0", "--max-steps", "150", "--out", str(tmp_path / "set")]
    assert main(arguments) == 0
    assert "2 demonstrations of 2" in capsys.readouterr().out
    table = read(tmp_path / "set")
    assert len(set(table["episode_index"].to_pylist())) == 2
    actions = np.array(table["action"].to_pylist())
    assert np.abs(actions).max() <= 1.0
    assert np.array_equal(actions, np.array(table["executed_action"].to_pylist()))
    assert main(["demonstrate", "--episodes", "1", "--out", str(tmp_path / "set")]) == 2
