"""Demonstrations to a file of one of the kinds that other packages read; its name says which."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.demonstrations import Demonstration
from pat3d.policies_eval.datasets.lerobot import is_dataset, write_lerobot
from pat3d.policies_eval.datasets.robomimic import write_robomimic
from pat3d.policies_eval.run.settings import RolloutSettings

ROBOMIMIC = (".hdf5", ".h5")


def require_free(path: str | os.PathLike[str], *, overwrite: bool = False) -> None:
    """Raise EvaluationError unless demonstrations may be written to `path`; they take long to make, so ask first."""
    file = Path(path)
    if file.suffix and file.suffix not in ROBOMIMIC:
        raise EvaluationError(f'demonstrations are FILE.hdf5 or a folder, not "{file.name}".')
    if file.suffix and file.is_dir():
        raise EvaluationError(f"{file} is a folder; give FILE.hdf5, or a folder whose name has no dot.")
    if file.is_file() and not (overwrite and file.suffix):
        raise EvaluationError(f"{file} is there already; choose another --out{', or --overwrite' * bool(file.suffix)}.")
    if file.is_dir() and any(file.iterdir()) and not (overwrite and is_dataset(file)):
        also = ", or --overwrite" if is_dataset(file) else ""
        raise EvaluationError(f"{file} is there already; a dataset is written into a new folder{also}.")


def write_demonstrations(
    shown: Iterable[Demonstration],
    path: str | os.PathLike[str],
    settings: RolloutSettings | None = None,
    *,
    overwrite: bool = False,
) -> int:
    """Write demonstrations for robomimic (FILE.hdf5) or as a LeRobotDataset (a new folder); returns how many.

    Raises:
        EvaluationError: the file or folder is there already, or cannot be written.
    """
    count = 0
    require_free(path, overwrite=overwrite)

    def counted() -> Iterator[Demonstration]:
        nonlocal count
        for one in shown:
            count += 1
            yield one

    if Path(path).suffix:
        write_robomimic(list(counted()), path)
    else:
        write_lerobot(counted(), path, settings, overwrite=overwrite)
    return count
