"""Demonstrations as robomimic's HDF5 files: data/demo_k with actions, observations, rewards and ends."""

from __future__ import annotations

import json
import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.envs.registration import ENV_ID
from pat3d.errors import EvaluationError
from pat3d.policies_eval.datasets.demonstrations import Demonstration
from pat3d.scene.replacement import replaced_file

HELD_OUT = 10
"""One demonstration of this many is for validation."""

INSTALL_HINT = "HDF5 files need h5py: pip install 'pat3d[eval]'."


def write_robomimic(demonstrations: Sequence[Demonstration], file: str | os.PathLike[str]) -> None:
    """Write demonstrations.

    Raises:
        EvaluationError: h5py is missing, or another kind of file is named.
    """
    try:
        import h5py
    except ImportError as error:
        raise EvaluationError(INSTALL_HINT) from error
    path = Path(file)
    if path.suffix not in (".hdf5", ".h5"):
        raise EvaluationError(f'demonstrations are FILE.hdf5, not "{path.name}".')
    names = [f"demo_{number}" for number in range(len(demonstrations))]
    with replaced_file(path) as temporary, h5py.File(temporary, "w") as out:
        data = out.create_group("data")
        data.attrs["total"] = sum(len(one.actions) for one in demonstrations)
        # Type 2 is what robomimic calls Gymnasium's environments.
        data.attrs["env_args"] = json.dumps({"env_name": ENV_ID, "type": 2, "env_kwargs": {}})
        if demonstrations and demonstrations[0].interface is not None:
            data.attrs["interface"] = json.dumps(demonstrations[0].interface)
        for name, one in zip(names, demonstrations, strict=True):
            _write(data.create_group(name), one)
        held_out = names[HELD_OUT - 1 :: HELD_OUT]
        for split, chosen in (("train", [name for name in names if name not in held_out]), ("valid", held_out)):
            out.create_dataset(f"mask/{split}", data=np.array(chosen, dtype="S"))


def _write(group: Any, one: Demonstration) -> None:
    steps = len(one.actions)
    ends = np.zeros(steps, dtype=np.int64)
    ends[-1] = 1
    group.attrs["num_samples"] = steps
    group.attrs["instruction"] = one.instruction
    group.attrs["episode"] = json.dumps(one.episode.to_json() | {"scene": Path(one.episode.scene).name})
    if one.interface is not None:
        group.attrs["cameras"] = json.dumps(one.interface["cameras"])
    group.create_dataset("actions", data=one.actions)
    group.create_dataset("executed_actions", data=one.done)
    group.create_dataset("rewards", data=ends.astype(np.float64))
    group.create_dataset("dones", data=ends)
    for name, values in one.observations.items():
        group.create_dataset(f"obs/{name}", data=values)
        # What is seen after the last action is not recorded; robomimic masks it by "dones".
        group.create_dataset(f"next_obs/{name}", data=np.concatenate([values[1:], values[-1:]]))
