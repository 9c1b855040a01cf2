"""Where robots stood before: what `place` found is kept by all that it depends on, for this process and for later ones.

A search takes a tenth of a second to seconds, and evaluations ask for the same scenes over and over. What is kept is
bit for bit what the search found.
"""

from __future__ import annotations

import functools
import hashlib
import json
from collections import OrderedDict
from contextlib import suppress
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path
from typing import Any

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.placement import place
from pat3d.envs.grasping.standing import Needs, Placement, Stand
from pat3d.envs.robots.arms import robot_model
from pat3d.envs.robots.pairs import arms_of
from pat3d.scene.cache import cache_root
from pat3d.scene.model import Scene
from pat3d.scene.replacement import write_text

KEPT = 4096
"""Placements that a process remembers; each takes some ten kilobytes."""

FOLDER = "placements"

MAX_BYTES = 2**20
"""Of a record."""

_known: OrderedDict[str, Placement] = OrderedDict()


def placed(scene: Scene, checksum: str | None, robot: str, needs: Needs) -> Placement:
    """What `place` finds; searched for once.

    Args:
        scene: at rest.
        checksum: of the files that MuJoCo loads for it: shapes, masses and poses; None to search again.
        robot: one arm or two.
        needs: what the task asks for.

    Raises:
        TaskError: see `place`; nothing is kept then.
    """
    if checksum is None:
        return place(scene, robot, needs)
    about = repr((checksum, scene.relations, scene.arrangements, scene.attachments, robot, needs))
    robots = "".join(_robot(name) for name in arms_of(robot))
    key = hashlib.sha256(f"{_source()}{robots}{about}".encode()).hexdigest()
    found = _known.get(key)
    if found is None:
        record = cache_root() / FOLDER / f"{key[:32]}.json"
        found = _read(record)
        if found is None:
            found = place(scene, robot, needs)
            with suppress(OSError):
                write_text(record, json.dumps(asdict(found)))
        _known[key] = found
        if len(_known) > KEPT:
            _known.popitem(last=False)
    _known.move_to_end(key)
    return found


def _read(record: Path) -> Placement | None:
    """The placement in a file; None where there is none, or something else."""
    try:
        if record.stat().st_size > MAX_BYTES:
            return None
        told = json.loads(record.read_text(encoding="utf-8"))
        told["grasps"] = _grasps(told["grasps"])
        told["visit"] = tuple(map(tuple, told["visit"]))
        if told["bench"] is not None:
            low, high = told["bench"]
            told["bench"] = (tuple(low), tuple(high))
        if told["other"] is not None:
            told["other"]["grasps"] = _grasps(told["other"]["grasps"])
            told["other"] = Stand(**_fixed(told["other"]))
        return Placement(**_fixed(told))
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None


def _grasps(told: dict[str, Any]) -> dict[str, tuple[Grasp, ...]]:
    return {name: tuple(Grasp(**_fixed(one)) for one in all_) for name, all_ in told.items()}


def _fixed(fields: dict[str, Any]) -> dict[str, Any]:
    """Fields of a frozen class as they were before they were written: lists were tuples."""
    return {name: tuple(value) if isinstance(value, list) else value for name, value in fields.items()}


@functools.lru_cache(maxsize=64)
def _robot(name: str) -> str:
    """SHA-256 of the compiled model of an arm."""
    import mujoco
    import numpy as np

    model = robot_model(name)
    buffer = np.zeros(mujoco.mj_sizeModel(model), dtype=np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return hashlib.sha256(buffer.tobytes()).hexdigest()


@functools.lru_cache(maxsize=1)
def _source() -> str:
    """SHA-256 of the modules that search: other ones may find something else."""
    digest = hashlib.sha256()
    for part in ("grasping", "robots"):
        for source in sorted((Path(str(files("pat3d.envs"))) / part).glob("*.py")):
            digest.update(source.read_bytes())
    return digest.hexdigest()
