"""Demonstrations to a file of one of the kinds that other packages read; its name says which."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.demonstrations import Demonstration
from pat3d.policies_eval.datasets.lerobot import write_lerobot
from pat3d.policies_eval.datasets.robomimic import write_robomimic
from pat3d.policies_eval.run.settings import RolloutSettings


def write_demonstrations(
    shown: Iterable[Demonstration], path: str | os.PathLike[str], settings: RolloutSettings | None = None
) -> int:
    """Write demonstrations for robomimic (FILE.hdf5) or as a LeRobotDataset (a new folder); returns how many.

    Raises:
        EvaluationError: the file or folder cannot be written.
    """
    count = 0

    def counted() -> Iterator[Demonstration]:
        nonlocal count
        for one in shown:
            count += 1
            yield one

    suffix = Path(path).suffix
    if suffix in (".hdf5", ".h5"):
        write_robomimic(list(counted()), path)
    elif suffix:
        raise EvaluationError(f'demonstrations are FILE.hdf5 or a folder, not "{Path(path).name}".')
    else:
        write_lerobot(counted(), path, settings)
    return count
