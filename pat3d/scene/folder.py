"""The scene folder on disk: what belongs to it, when it may be replaced, its reports, pictures and trajectory."""

from __future__ import annotations

import hashlib
import json
import os
import zipfile
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager, suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError
from pat3d.scene.replacement import replaced_folder, write_bytes, write_text

OWN = (
    "scene.json",
    "assets",
    "mjcf",
    "usd",
    "urdf",
    "sdf",
    "html",
    "glb",
    "simready",
    "report.json",
    "summary.json",
    "preview.png",
    "picture.png",
    "photograph.png",
    "trajectory.npz",
    "loss.png",
    "before_after.png",
)
"""What a scene folder holds; anything else in it is the user's and is kept."""

MAX_REPORT_BYTES = 16 * 2**20
MAX_PICTURE_BYTES = 16 * 2**20


def check_target(out: str | os.PathLike[str]) -> Path:
    """The folder to write, with links followed.

    Raises:
        ExportError: it is a file, the current folder, or a folder with files that is not a scene folder.
    """
    folder = Path(out).expanduser()
    try:
        folder = folder.resolve()
        if folder.exists() and not folder.is_dir():
            raise ExportError(f"{out} is a file; give a folder. Nothing was written.")
        if folder == Path.cwd() or folder == Path(folder.anchor):
            raise ExportError(f"{out} cannot be replaced as a whole; name a folder inside it. Nothing was written.")
        if folder.is_dir() and not (folder / "scene.json").is_file() and any(folder.iterdir()):
            raise ExportError(f"{out} holds files but no scene.json; give a new folder. Nothing was written.")
        above = next(parent for parent in folder.parents if parent.exists())
        if not above.is_dir() or not os.access(above, os.W_OK | os.X_OK):
            raise ExportError(f"{out} cannot be made: {above} is not a folder that can be written.")
    except OSError as error:
        raise ExportError(f"{out}: {error.strerror or error}. Nothing was written.") from error
    return folder


def replacing(folder: Path) -> AbstractContextManager[Path]:
    """A new scene folder that takes the place of `folder` when the block ends; the user's own files move into it.

    Raises:
        ExportError: nothing can be written there.
    """
    return replaced_folder(folder, keep=lambda name: name not in OWN)


def key_of(*inputs: Any) -> str:
    """A fingerprint of JSON data."""
    return hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest()


def write_json(path: Path, document: Mapping[str, Any]) -> None:
    """Write `document`, numbers that are not finite as null."""
    text = json.dumps(finite(document), indent=1, allow_nan=False, ensure_ascii=False)
    write_text(path, text + "\n")


def read_json(path: Path) -> dict[str, Any]:
    """The object in a JSON file; empty where there is none or it is damaged."""
    try:
        if path.stat().st_size > MAX_REPORT_BYTES:
            return {}
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError):
        return {}
    return document if isinstance(document, dict) else {}


def finite(value: Any) -> Any:
    """Plain JSON data: tuples as lists, numpy numbers as Python's, infinities and NaN as None."""
    if isinstance(value, Mapping):
        return {str(key): finite(child) for key, child in value.items()}
    if isinstance(value, list | tuple):
        return [finite(child) for child in value]
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value) if np.isfinite(value) else None
    return value


def write_pictures(pictures: Mapping[str, bytes], folder: Path) -> None:
    """Write picture files by name."""
    for name, data in pictures.items():
        write_bytes(folder / name, data)


def read_pictures(names: Sequence[str], folder: Path) -> dict[str, bytes]:
    """Those of the named files that are there and of a sensible size."""
    found = {}
    for name in names:
        path = folder / name
        with suppress(OSError):
            if path.stat().st_size <= MAX_PICTURE_BYTES:
                found[name] = path.read_bytes()
    return found


def write_trajectory(
    path: Path, names: tuple[str, ...], states: NDArray[np.float32], centres: NDArray[np.float64], time_step: float
) -> None:
    """Write the settling motion.

    Args:
        path: of the npz file.
        names: of the objects.
        states: centre of mass [m] and columns of the linear map of every object in every frame, the state at rest
            last, shape (frames, objects, 4, 3).
        centres: centres of mass in the frames of the assets [m], shape (objects, 3).
        time_step: artificial time between frames [s].
    """
    with path.open("wb") as file:
        np.savez_compressed(
            file,
            names=np.array(names),
            states=np.asarray(states, dtype=np.float32),
            centres=centres,
            time_step=np.float64(time_step),
        )


def read_trajectory(path: Path) -> dict[str, NDArray[Any]] | None:
    """The arrays of `write_trajectory`, or None where there are none or they are damaged."""
    try:
        with np.load(path, allow_pickle=False) as data:
            return {name: data[name] for name in ("names", "states", "centres", "time_step")}
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
