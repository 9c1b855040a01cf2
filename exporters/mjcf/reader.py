"""What MuJoCo makes of an MJCF file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import CheckError
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.common.xml_files import box_corners, common, in_body_axes
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
    return tuple(_body(mujoco, model, number) for number in range(1, model.nbody) if model.body_parentid[number] == 0)


def _body(mujoco: Any, model: Any, number: int) -> BodyReadback:
    axes = Pose(quat_wxyz=tuple(model.body_iquat[number])).rotation
    first = model.body_geomadr[number]
    geoms = [geom for geom in range(first, first + model.body_geomnum[number]) if model.geom_contype[geom]]
    return BodyReadback(
        name=model.body(number).name,
        mass=float(model.body_mass[number]),
        centre=model.body_ipos[number].copy(),
        inertia=in_body_axes(np.diag(model.body_inertia[number]), axes),
        friction=common([float(model.geom_friction[geom, 0]) for geom in geoms]),
        hulls=tuple(_corners(mujoco, model, geom) for geom in geoms),
        pose=Pose(position=tuple(model.body_pos[number]), quat_wxyz=tuple(model.body_quat[number])),
        fixed=not model.body_dofnum[number],
    )


def _corners(mujoco: Any, model: Any, geom: int) -> NDArray[np.float64]:
    """Corners [m] of a box or a mesh in the frame of its body, shape (corners, 3); no corners for other shapes."""
    mesh = int(model.geom_dataid[geom])
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_BOX:
        corners = box_corners(2.0 * model.geom_size[geom])
    elif mesh >= 0:
        start, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        corners = model.mesh_vert[start : start + count].astype(np.float64)
    else:
        return np.empty((0, 3))
    return Pose(position=tuple(model.geom_pos[geom]), quat_wxyz=tuple(model.geom_quat[geom])).apply(corners)
