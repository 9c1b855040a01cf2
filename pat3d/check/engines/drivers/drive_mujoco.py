"""MuJoCo, any version: the MJCF export with its own options."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import recording


def file_for(version: str) -> str:
    """Name of the scene's file for a MuJoCo of this version."""
    return "scene_mujoco_3.3.xml" if version.startswith("3.3.") else "scene.xml"


def drive(export: Path, seconds: float, _: str, lean: float) -> dict[str, Any]:
    """Load the scene's file as it is and run it."""
    messages: list[str] = []
    mujoco.set_mju_user_warning(messages.append)
    file = file_for(mujoco.mj_versionString())
    model = mujoco.MjModel.from_xml_path(str(export / file))
    data = mujoco.MjData(model)
    free = model.jnt_bodyid[np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)]
    names = {int(body): model.body(body).name for body in free}

    def poses() -> dict[str, list[float]]:
        # The positions that a step leaves behind lag by a step; the joint state does not.
        mujoco.mj_kinematics(model, data)
        return {name: [*data.xpos[body], *data.xquat[body]] for body, name in names.items()}

    strength = float(np.linalg.norm(model.opt.gravity))

    def pull(down: tuple[float, float, float]) -> None:
        model.opt.gravity[:] = strength * np.array(down)

    def step(count: int) -> None:
        mujoco.mj_step(model, data, nstep=count)

    found = recording.run(step, poses, model.opt.timestep, seconds, pull, lean)
    for kind, stat in zip(mujoco.mjtWarning.__members__, data.warning, strict=False):
        if stat.number:
            messages.append(f"{kind.removeprefix('mjWARN_').lower()}: {stat.number} times")
    option = model.opt
    settings = {
        "file": file,
        "timestep": option.timestep,
        "cone": mujoco.mjtCone(option.cone).name.removeprefix("mjCONE_").lower(),
        "impratio": option.impratio,
        "integrator": mujoco.mjtIntegrator(option.integrator).name.removeprefix("mjINT_").lower(),
        "solref": [float(value) for value in model.geom_solref[-1]],
        "largest margin [m]": float(model.geom_margin.max()),
    }
    return {
        "engine": "MuJoCo",
        "version": mujoco.mj_versionString(),
        "settings": settings,
        "warnings": list(dict.fromkeys(messages)),
        "recording": found,
    }


if __name__ == "__main__":
    recording.main(drive)
