"""The ground drop: an object falls from eight times its height, stops at the floor and comes to rest.

The conditions are those of SimReady's test of the same name, run in MuJoCo and with tighter limits: the object reaches
the floor, is never half inside it, and within eight seconds of the first contact lies still without sinking in.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import CheckError
from pat3d.scene.physics import GRAVITY

HEIGHTS = 8.0
"""Drop height in heights of the object."""

REST_SECONDS = 8.0
"""Longest time from first contact to rest [s]."""

TIMESTEP = 0.0005
"""[s]; an object of 0.3 m arrives at 7 m/s."""

STILL_SPEED = 1e-3
"""No point of an object at rest is faster than this [m/s]..."""

STILL_SECONDS = 0.25
"""...for this long [s]."""

SUNK = 1e-4
"""Deepest that an object at rest may be in the floor [m]."""

_EVERY = 10
"""Time steps between two looks at the speed."""


@dataclass(frozen=True, kw_only=True)
class DropReport:
    """How one object fell."""

    height: float
    """Free fall before the first contact [m]."""
    seconds: float
    """From first contact to rest [s]; infinite where it never came to rest or never arrived."""
    deepest: float
    """Deepest point in the floor at any time [m]."""
    sunk: float
    """Deepest point in the floor at the end [m]."""
    size: float
    """Height of the object [m]."""
    tilt: float
    """Angle between the object's vertical before and after [degrees]."""

    @property
    def failures(self) -> tuple[str, ...]:
        """What went wrong, a line each."""
        lines = []
        if math.isinf(self.seconds):
            lines.append(f"it does not come to rest within {REST_SECONDS:g} s of a fall of {self.height:.3g} m.")
        if not self.deepest <= self.size / 2:
            lines.append(f"it falls through the floor: {1e3 * self.deepest:.3g} mm deep.")
        elif not self.sunk <= SUNK:
            lines.append(f"it sinks {1e3 * self.sunk:.3g} mm into the floor.")
        return tuple(lines)

    @property
    def passed(self) -> bool:
        """It landed and rests."""
        return not self.failures

    def as_dict(self) -> dict[str, Any]:
        """Plain data for reports."""
        return {**asdict(self), "passed": self.passed, "failures": list(self.failures)}


def ground_drop(mjcf_path: str | Path, *, heights: float = HEIGHTS) -> DropReport:
    """Drop the one free object of an MJCF scene from `heights` times its height above where it stands.

    Raises:
        CheckError: MuJoCo refuses the file, or it has not exactly one free object.
    """
    import mujoco

    try:
        model = mujoco.MjModel.from_xml_path(str(mjcf_path))
    except (ValueError, mujoco.FatalError) as error:
        raise CheckError(f"MuJoCo {mujoco.__version__} refuses {mjcf_path}: {error}") from error
    if model.njnt != 1 or model.jnt_type[0] != mujoco.mjtJoint.mjJNT_FREE:
        raise CheckError(f"{mjcf_path} has {model.njnt} joints; a drop needs one free object.")
    model.opt.timestep = TIMESTEP
    data = mujoco.MjData(model)
    body = int(model.jnt_bodyid[0])
    points = _points(mujoco, model, body)
    mujoco.mj_forward(model, data)
    upright = data.xmat[body].reshape(3, 3).copy()
    vertical = points @ upright[2]
    size = float(np.ptp(vertical))
    data.qpos[2] += heights * size
    return _fall(mujoco, model, data, body, points, upright, heights * size, size)


def _fall(
    mujoco: Any,
    model: Any,
    data: Any,
    body: int,
    points: NDArray[np.float64],
    upright: NDArray[np.float64],
    height: float,
    size: float,
) -> DropReport:
    limit = math.sqrt(2.0 * height / GRAVITY) + 1.0
    touched = still = math.inf
    deepest = depth = 0.0
    step = 0
    while data.time < (limit if math.isinf(touched) else touched + REST_SECONDS + STILL_SECONDS):
        mujoco.mj_step(model, data)
        depth = -float((points @ data.xmat[body].reshape(3, 3)[2]).min() + data.xpos[body, 2])
        deepest = max(deepest, depth)
        if math.isinf(touched) and data.ncon:
            touched = data.time
        step += 1
        if step % _EVERY:
            continue
        # Of a free joint the translation is the origin's in the world, the rotation in the axes of the body.
        moving = data.qvel[:3] @ data.xmat[body].reshape(3, 3) + np.cross(data.qvel[3:6], points)
        speed = float(np.linalg.norm(moving, axis=1).max())
        if not speed < STILL_SPEED or math.isinf(touched):
            still = math.inf
        elif math.isinf(still):
            still = data.time
        elif data.time - still >= STILL_SECONDS:
            break
    turned = data.xmat[body].reshape(3, 3) @ upright.T
    return DropReport(
        height=height,
        seconds=still - touched if math.isfinite(still) and data.time - still >= STILL_SECONDS else math.inf,
        deepest=deepest,
        sunk=max(depth, 0.0),
        size=size,
        tilt=math.degrees(math.acos(min(1.0, max(-1.0, float(turned[2, 2]))))),
    )


def _points(mujoco: Any, model: Any, body: int) -> NDArray[np.float64]:
    """Corners of everything that collides [m] in the body frame, shape (n, 3)."""
    signs = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)], dtype=np.float64)
    found = []
    for geom in range(model.ngeom):
        if model.geom_bodyid[geom] != body or not model.geom_contype[geom]:
            continue
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_BOX:
            local = signs * model.geom_size[geom]
        else:
            mesh = int(model.geom_dataid[geom])
            start, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
            local = model.mesh_vert[start : start + count].astype(np.float64)
        turn = np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.geom_quat[geom])
        found.append(local @ turn.reshape(3, 3).T + model.geom_pos[geom])
    return np.concatenate(found)
