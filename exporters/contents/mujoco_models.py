"""Two MJCF files compared as MuJoCo compiles them, for files that are laid out otherwise but read the same."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import ExportError
from pat3d.exporters.contents.values import same_numbers, shown

_PHYSICS = ("opt", "body", "geom", "jnt", "dof", "eq", "key", "pair", "exclude", "actuator", "sensor", "tendon", "site")
"""Beginnings of the arrays of MjModel that decide how a scene moves."""

_DERIVED = ("body_iquat", "body_inertia", "body_sameframe", "geom_sameframe", "body_simple", "geom_aabb", "geom_rbound")
"""Axes of inertia, of which there may be several, and what follows from them or from the rest."""


def model_differences(found: Path, expected: Path) -> Iterator[str]:
    """Options, sizes and arrays of MjModel that differ between two files.

    Raises:
        ExportError: MuJoCo refuses one of them.
    """
    mujoco: Any = import_module("mujoco")
    try:
        here, there = (mujoco.MjModel.from_xml_path(str(path)) for path in (found, expected))
    except ValueError as error:
        raise ExportError(f"MuJoCo {mujoco.__version__} refuses {found.name}: {error}") from error
    for name in sorted(name for name in dir(there) if name.startswith("n") and isinstance(getattr(there, name), int)):
        if getattr(here, name) != getattr(there, name):
            yield f"MuJoCo reads {name} = {getattr(here, name)} instead of {getattr(there, name)}"
            return
    for group, mine, theirs in (("opt.", here.opt, there.opt), ("", here, there)):
        for name in sorted(dir(theirs)):
            known = group or (name.startswith(tuple(f"{word}_" for word in _PHYSICS)) and name not in _DERIVED)
            if not known or name.startswith("_") or callable(getattr(theirs, name)):
                continue
            one, other = getattr(mine, name), getattr(theirs, name)
            if isinstance(other, int | float | np.ndarray) and not same_numbers(one, other, 1e-6):
                yield f"MuJoCo reads {group}{name} = {shown(one)} instead of {shown(other)}"
