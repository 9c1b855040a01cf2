"""Is the export in a folder the scene in that folder? Poses and masses of an MJCF file against scene.json."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import CheckError
from pat3d.exporters.mjcf import body_names
from pat3d.scene import Scene

POSITION = 1e-6
"""Largest difference of a position that passes [m]."""

ROTATION = 1e-6
"""Largest difference of a unit quaternion that passes."""

MASS = 1e-6
"""Largest relative difference of a mass that passes."""


def differences(scene: Scene, mjcf_path: str | Path) -> tuple[str, ...]:
    """Where the MJCF at `mjcf_path` differs from `scene`, a line for every object; none where they agree.

    Raises:
        CheckError: MuJoCo refuses the file.
    """
    mujoco: Any = import_module("mujoco")
    try:
        model = mujoco.MjModel.from_xml_path(str(mjcf_path))
    except ValueError as error:
        raise CheckError(f"MuJoCo {mujoco.__version__} refuses {mjcf_path}: {error}") from error
    names = body_names(scene)
    bodies = {model.body(number).name: number for number in range(1, model.nbody)}
    lines = []
    for obj in scene.objects:
        number = bodies.pop(names[obj.name], None)
        if number is None:
            lines.append(f'"{obj.name}" is missing from {mjcf_path}.')
            continue
        free = bool(model.body_dofnum[number])
        if free == obj.fixed:
            lines.append(f'"{obj.name}" is {"fixed" if obj.fixed else "free"} in the scene but not in {mjcf_path}.')
        moved = float(np.linalg.norm(model.body_pos[number] - obj.pose.position))
        quat = model.body_quat[number]
        turned = min(float(np.abs(quat - sign * np.array(obj.pose.quat_wxyz)).max()) for sign in (1, -1))
        if moved > POSITION or turned > ROTATION:
            lines.append(f'"{obj.name}" stands elsewhere in {mjcf_path}: {1e3 * moved:.3g} mm away.')
        mass, there = obj.asset.mass_properties.mass, float(model.body_mass[number])
        if free and abs(there - mass) > MASS * mass:
            lines.append(f'"{obj.name}" weighs {there:.4g} kg in {mjcf_path} instead of {mass:.4g} kg.')
    loose = [name for name, number in bodies.items() if model.body_dofnum[number]]
    lines += [f'the body "{name}" of {mjcf_path} is not in the scene.' for name in loose]
    return tuple(lines)
