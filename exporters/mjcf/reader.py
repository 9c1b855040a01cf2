"""What MuJoCo makes of an MJCF file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import CheckError
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.common.xml_files import common, convex_volume, in_body_axes
from pat3d.geometry.pose import Pose


def read_mjcf(path: str | Path) -> tuple[BodyReadback, ...]:
    """Every body on the world of the model at `path`, as MuJoCo compiles it.

    Raises:
        CheckError: MuJoCo refuses the file.
    """
    import mujoco

    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, mujoco.FatalError) as error:
        raise CheckError(f"MuJoCo {mujoco.__version__} refuses {path}: {error}") from error
    volumes: dict[int, float] = {}
    return tuple(
        _body(mujoco, model, number, volumes) for number in range(1, model.nbody) if model.body_parentid[number] == 0
    )


def _body(mujoco: Any, model: Any, number: int, volumes: dict[int, float]) -> BodyReadback:
    axes = Pose(quat_wxyz=tuple(model.body_iquat[number])).rotation
    first = model.body_geomadr[number]
    geoms = [geom for geom in range(first, first + model.body_geomnum[number]) if model.geom_contype[geom]]
    return BodyReadback(
        name=model.body(number).name,
        mass=float(model.body_mass[number]),
        centre=model.body_ipos[number].copy(),
        inertia=in_body_axes(np.diag(model.body_inertia[number]), axes),
        friction=common([float(model.geom_friction[geom, 0]) for geom in geoms]),
        hull_volume=sum(_volume(mujoco, model, geom, volumes) for geom in geoms),
        pose=Pose(position=tuple(model.body_pos[number]), quat_wxyz=tuple(model.body_quat[number])),
        fixed=not model.body_dofnum[number],
    )


def _volume(mujoco: Any, model: Any, geom: int, volumes: dict[int, float]) -> float:
    """Volume [m^3] of what collides for a box or the hull of a mesh; NaN for other shapes."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_BOX:
        return float(8.0 * np.prod(model.geom_size[geom]))
    mesh = int(model.geom_dataid[geom])
    if mesh < 0:
        return float("nan")
    if mesh not in volumes:
        start, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        volumes[mesh] = convex_volume(model.mesh_vert[start : start + count].astype(np.float64))
    return volumes[mesh]
