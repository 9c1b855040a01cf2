"""Demonstrations as a LeRobotDataset of format v3.0: a folder of Parquet files, films, and what is said about them.

meta/info.json                                 features, totals, where files are
meta/stats.json                                statistics of every feature over all frames
meta/interface.json                            frames, units, conventions and cameras, see pat3d.envs.interface
meta/tasks.parquet                             instructions and their numbers
meta/episodes/chunk-000/file-000.parquet       a row an episode: where its frames are, and its statistics
data/chunk-000/file-000.parquet                a row a frame
videos/CAMERA/chunk-000/file-000.mp4           frames of many episodes, one after the other
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.observations import state_keys
from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.demonstrations import Demonstration
from pat3d.policies_eval.policies.lerobot import IMAGES
from pat3d.policies_eval.run.records import arrow
from pat3d.policies_eval.run.settings import RolloutSettings
from pat3d.policies_eval.video import FilmWriter
from pat3d.scene.replacement import replaced_folder

VERSION = "v3.0"


CHUNK = 1000
"""Files in a folder."""

DATA_BYTES, FILM_FRAMES = 100 * 2**20, 20_000
"""Of one Parquet file before compression, and of one film."""

QUANTILES = {"q01": 0.01, "q10": 0.10, "q50": 0.50, "q90": 0.90, "q99": 0.99}

_FILE = "chunk-{chunk_index:03d}/file-{file_index:03d}"
DATA_PATH, VIDEO_PATH = f"data/{_FILE}.parquet", f"videos/{{video_key}}/{_FILE}.mp4"
EPISODES_PATH, TASKS_PATH = f"meta/episodes/{_FILE}.parquet", "meta/tasks.parquet"

_COUNTERS = ("frame_index", "episode_index", "index", "task_index")

Values = dict[str, NDArray[Any]]
"""By feature, the first axis along the frames."""


def is_dataset(folder: Path) -> bool:
    """Whether `folder` holds a LeRobotDataset."""
    return (folder / "meta" / "info.json").is_file()


def write_lerobot(
    demonstrations: Iterable[Demonstration],
    folder: str | os.PathLike[str],
    settings: RolloutSettings | None = None,
    *,
    overwrite: bool = False,
) -> None:
    """Write demonstrations; they are taken one at a time, so that pictures of many need not fit into memory.

    Args:
        demonstrations: one or more.
        folder: to be made; not there yet, or empty.
        settings: of the environment in which they were done.
        overwrite: replace a dataset that is there, once the new one is complete.

    Raises:
        EvaluationError: pyarrow is missing, `folder` holds something, or the control frequency is no whole number.
    """
    settings, path = settings or RolloutSettings(), Path(folder)
    arrow()
    replaced = overwrite and is_dataset(path)
    if path.exists() and not replaced and (not path.is_dir() or any(path.iterdir())):
        raise EvaluationError(f"{path} is there already; a dataset is written into a new folder.")
    if settings.control_freq != round(settings.control_freq):
        raise EvaluationError(f"datasets have whole frames a second, not {settings.control_freq:g}.")
    with replaced_folder(path) as fresh:
        writer = _Writer(fresh, settings)
        for one in demonstrations:
            writer.add(one)
        writer.close()


class _Writer:
    """Files of one dataset, which grow with every demonstration."""

    def __init__(self, root: Path, settings: RolloutSettings) -> None:
        self._root, self._settings = root, settings
        self._fps = round(settings.control_freq)
        self._features: dict[str, dict[str, Any]] = {}
        self._tasks: dict[str, int] = {}
        self._episodes: list[dict[str, Any]] = []
        self._frames = 0
        self._pending: list[Values] = []
        self._bytes = self._file = 0
        self._films: dict[str, FilmWriter] = {}
        self._film_file = self._film_frames = 0
        self._totals: dict[str, Totals] = {}
        self._interface: dict[str, Any] | None = None
        self._cameras: list[Any] = []

    def add(self, one: Demonstration) -> None:
        """Take in one episode."""
        if one.interface is not None:
            self._interface = self._interface or one.interface
            self._cameras.append(one.interface["cameras"])
        steps, number = len(one.actions), len(self._episodes)
        values, pictures = _values_of(one)
        task = self._tasks.setdefault(one.instruction, len(self._tasks))
        values |= {
            "timestamp": (np.arange(steps) / self._fps).astype(np.float32),
            "frame_index": np.arange(steps, dtype=np.int64),
            "episode_index": np.full(steps, number, dtype=np.int64),
            "index": np.arange(self._frames, self._frames + steps, dtype=np.int64),
            "task_index": np.full(steps, task, dtype=np.int64),
        }
        features = self._features_of(values, pictures)
        if self._features and features != self._features:
            raise EvaluationError(
                f'demonstration {number} ("{one.instruction}") has observations of another shape than the first; '
                "one dataset holds one robot and one kind of observation."
            )
        self._features = features
        size = sum(array.nbytes for array in values.values())
        if self._pending and self._bytes + size > DATA_BYTES:
            self._write_data()
        row: dict[str, Any] = {
            "episode_index": number,
            "tasks": [one.instruction],
            "length": steps,
            **_place("data", self._file),
            "dataset_from_index": self._frames,
            "dataset_to_index": self._frames + steps,
            **_place("meta/episodes", 0),
            **self._film(pictures, steps),
        }
        for name, array in (values | pictures).items():
            row |= {f"stats/{name}/{kind}": found.tolist() for kind, found in _statistics(array).items()}
            self._totals.setdefault(name, Totals()).add(array)
        self._episodes.append(row)
        self._pending.append(values)
        self._bytes += size
        self._frames += steps

    def close(self) -> None:
        """Write what is left, and what is said about everything."""
        if not self._episodes:
            raise EvaluationError("a dataset needs at least one demonstration.")
        self._write_data()
        for film in self._films.values():
            film.close()
        pa = arrow()
        _write_table(pa.Table.from_pylist(self._episodes), self._root / _filled(EPISODES_PATH, 0))
        _write_table(_tasks_table(pa, self._tasks), self._root / TASKS_PATH)
        info = {
            "codebase_version": VERSION,
            "robot_type": self._settings.robot.lower(),
            "total_episodes": len(self._episodes),
            "total_frames": self._frames,
            "total_tasks": len(self._tasks),
            "chunks_size": CHUNK,
            "data_files_size_in_mb": DATA_BYTES // 2**20,
            "video_files_size_in_mb": 200,
            "fps": self._fps,
            "splits": {"train": f"0:{len(self._episodes)}"},
            "data_path": DATA_PATH,
            "video_path": VIDEO_PATH if self._films else None,
            "features": self._features,
        }
        stats = {
            name: {kind: found.tolist() for kind, found in total.result().items()}
            for name, total in self._totals.items()
        }
        contents = {"info": info, "stats": stats}
        if self._interface is not None:
            contents["interface"] = {**self._interface, "cameras_of_episodes": self._cameras}
        for name, content in contents.items():
            (self._root / "meta" / f"{name}.json").write_text(json.dumps(content, indent=4) + "\n", encoding="utf-8")

    def _features_of(self, values: Values, pictures: Values) -> dict[str, dict[str, Any]]:
        """What info.json says of every feature."""
        found: dict[str, dict[str, Any]] = {}
        for name, array in pictures.items():
            height, width = array.shape[1:3]
            found[name] = {
                "dtype": "video",
                "shape": [height, width, 3],
                "names": ["height", "width", "channels"],
                "info": {
                    "video.height": height,
                    "video.width": width,
                    "video.codec": "h264",
                    "video.pix_fmt": "yuv420p",
                    "video.is_depth_map": False,
                    "video.fps": self._fps,
                    "video.channels": 3,
                    "has_audio": False,
                },
            }
        for name, array in values.items():
            shape = list(array.shape[1:]) or [1]
            found[name] = {"dtype": str(array.dtype), "shape": shape, "names": _names(name, shape[0])}
        return found

    def _film(self, pictures: Values, steps: int) -> dict[str, Any]:
        """Append an episode to the films; returns where it is in them."""
        if self._films and self._film_frames + steps > FILM_FRAMES:
            for film in self._films.values():
                film.close()
            self._films.clear()
            self._film_file, self._film_frames = self._film_file + 1, 0
        begin, end = self._film_frames / self._fps, (self._film_frames + steps) / self._fps
        row: dict[str, Any] = {}
        for name, images in pictures.items():
            if name not in self._films:
                path = self._root / _filled(VIDEO_PATH, self._film_file, video_key=name)
                path.parent.mkdir(parents=True, exist_ok=True)
                self._films[name] = FilmWriter(path, images.shape[1:3], self._fps)
            for image in images:
                self._films[name].add(image)
            row |= _place(f"videos/{name}", self._film_file)
            row |= {f"videos/{name}/from_timestamp": begin, f"videos/{name}/to_timestamp": end}
        self._film_frames += steps
        return row

    def _write_data(self) -> None:
        """Write the frames that are pending into a file of their own."""
        pa = arrow()
        columns = {}
        for name in self._pending[0]:
            array = np.concatenate([values[name] for values in self._pending])
            flat = pa.array(array.reshape(-1))
            columns[name] = flat if array.ndim == 1 else pa.FixedSizeListArray.from_arrays(flat, array.shape[1])
        _write_table(pa.table(columns), self._root / _filled(DATA_PATH, self._file))
        self._pending, self._bytes, self._file = [], 0, self._file + 1


class Totals:
    """Statistics over all frames; those of pictures from their episodes."""

    def __init__(self) -> None:
        self._arrays: list[NDArray[Any]] = []
        self._parts: list[dict[str, NDArray[Any]]] = []

    def add(self, array: NDArray[Any]) -> None:
        """Take in the values of an episode, the frames first."""
        if array.ndim == 4:
            self._parts.append(_statistics(array))
        else:
            self._arrays.append(array)

    def result(self) -> dict[str, NDArray[Any]]:
        """Least, largest, mean, standard deviation, quantiles and count."""
        if self._arrays:
            return _statistics(np.concatenate(self._arrays))
        counts = np.array([part["count"][0] for part in self._parts], dtype=np.float64)
        stacked = {name: np.stack([part[name] for part in self._parts]) for name in self._parts[0]}
        weights = (counts / counts.sum()).reshape(-1, 1, 1, 1)
        mean = (weights * stacked["mean"]).sum(axis=0)
        variance = (weights * (stacked["std"] ** 2 + (stacked["mean"] - mean) ** 2)).sum(axis=0)
        found = {name: (weights * stacked[name]).sum(axis=0) for name in QUANTILES}
        return found | {
            "min": stacked["min"].min(axis=0),
            "max": stacked["max"].max(axis=0),
            "mean": mean,
            "std": np.sqrt(variance),
            "count": np.array([int(counts.sum())]),
        }


def _values_of(one: Demonstration) -> tuple[Values, Values]:
    """Numbers and pictures of a demonstration under LeRobot's names."""
    seen, steps = one.observations, len(one.actions)
    ends = np.arange(steps) == steps - 1
    values: Values = {
        "observation.state": np.concatenate([seen[name] for name in state_keys(seen)], axis=1).astype(np.float32)
    }
    if "target" in seen:
        values["observation.environment_state"] = seen["target"].astype(np.float32)
    values |= {
        "action": one.actions.astype(np.float32),
        # With the push of an unsteady hand; what led to the next observation.
        "executed_action": one.done.astype(np.float32),
        "next.reward": ends.astype(np.float32),
        "next.done": ends,
        "next.success": ends,
    }
    pictures = {
        f"{IMAGES}{name.removesuffix('_image')}": array for name, array in seen.items() if name.endswith("_image")
    }
    return values, pictures


def _statistics(array: NDArray[Any]) -> dict[str, NDArray[Any]]:
    """Over the frames; of pictures over their pixels too, by channel in [0, 1], shape (3, 1, 1)."""
    values, axis = array.astype(np.float64), 0
    if array.ndim == 4:
        # A tenth of the pictures' lines says as much.
        values, axis = values[:, ::3, ::3] / 255.0, (0, 1, 2)  # type: ignore[assignment]
    found = {
        "min": values.min(axis=axis),
        "max": values.max(axis=axis),
        "mean": values.mean(axis=axis),
        "std": values.std(axis=axis),
        **dict(zip(QUANTILES, np.quantile(values, list(QUANTILES.values()), axis=axis), strict=True)),
    }
    shape = (3, 1, 1) if array.ndim == 4 else (-1,)
    return {name: np.asarray(value).reshape(shape) for name, value in found.items()} | {"count": np.array([len(array)])}


def _names(feature: str, size: int) -> list[str] | None:
    """Of the values of a feature."""
    if feature in ("action", "executed_action"):
        return ["x", "y", "z", "rx", "ry", "rz", "gripper"] if size == 7 else [f"action_{k}" for k in range(size)]
    if feature == "observation.environment_state":
        pose = [f"target_{name}" for name in ("x", "y", "z", "qw", "qx", "qy", "qz")]
        return [*pose, "goal_x", "goal_y", "goal_z"]
    if feature == "observation.state":
        hand = ["eef_x", "eef_y", "eef_z", "eef_qw", "eef_qx", "eef_qy", "eef_qz"]
        return [*(f"joint_{k}" for k in range(size - len(hand))), *hand]
    return None


def _tasks_table(pa: Any, tasks: Mapping[str, int]) -> Any:
    """Instructions as the index of a pandas table, which is how LeRobot looks them up."""
    table = pa.table({"task_index": pa.array(list(tasks.values()), pa.int64()), "task": pa.array(list(tasks))})
    kinds = {"task_index": ("int64", "int64"), "task": ("unicode", "object")}
    described = {
        "index_columns": ["task"],
        "column_indexes": [],
        "pandas_version": "2.0.0",
        "columns": [
            {"name": name, "field_name": name, "pandas_type": kind, "numpy_type": numpy_kind, "metadata": None}
            for name, (kind, numpy_kind) in kinds.items()
        ],
    }
    return table.replace_schema_metadata({"pandas": json.dumps(described)})


def _place(prefix: str, number: int) -> dict[str, int]:
    return {f"{prefix}/chunk_index": number // CHUNK, f"{prefix}/file_index": number % CHUNK}


def _filled(pattern: str, number: int, **more: str) -> str:
    return pattern.format(chunk_index=number // CHUNK, file_index=number % CHUNK, **more)


def _write_table(table: Any, path: Path) -> None:
    from pyarrow import parquet

    path.parent.mkdir(parents=True, exist_ok=True)
    parquet.write_table(table, path, compression="snappy")
