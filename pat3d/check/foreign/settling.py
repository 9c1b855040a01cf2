"""The nearest layout at rest of a scene that is not ours, and the file written anew with it.

Objects creep down to rest: velocities are taken away after every few steps, so that what overlaps is pressed apart
and not thrown, and what floats sinks and does not bounce. Then they are let go, until nothing moves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.foreign.load import ForeignScene
from pat3d.check.foreign.state import Held, owners, start
from pat3d.errors import CheckError
from pat3d.scene.replacement import write_text

SLOWLY = 0.02
"""Fastest that anything may sink or be pressed apart at first [m/s] and [rad/s]."""

CREEPING_SECONDS, FREE_SECONDS = 20.0, 30.0
"""Longest simulated time of either phase [s]."""

STILL = 1e-4
"""Speed below which an object is at rest [m/s], [rad/s]..."""

STILL_FOR = 0.5
"""...for as long as this [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SettledForeign:
    """Where everything came to rest."""

    qpos: NDArray[np.float64]
    """Joint state, shape (nq,)."""
    moved_mm: dict[str, float]
    """How far each object is from where it was [mm]."""
    at_rest: bool


def settle_foreign(
    scene: ForeignScene, *, keyframe: str | None = None, alive: Callable[[], None] = lambda: None
) -> SettledForeign:
    """Let the objects of `scene` come to rest in MuJoCo, with mechanisms held.

    Raises:
        CheckError: MuJoCo refuses the file, or it explodes.
    """
    import mujoco

    model = scene.compile()
    data = start(model, keyframe)
    who, held = owners(model), Held(model, data)
    before = data.subtree_com[who.roots].copy()
    step = float(model.opt.timestep)
    at_rest = False
    for slowly, seconds in ((True, CREEPING_SECONDS), (False, FREE_SECONDS)):
        quiet = 0.0
        for number in range(round(seconds / step)):
            mujoco.mj_step(model, data)
            held.put_back(data)
            if not np.isfinite(data.qpos).all() or data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
                raise CheckError(f"{scene.path}: the scene explodes in MuJoCo, even slowly; nothing was settled.")
            speed = float(np.abs(data.qvel).max(initial=0.0))
            if slowly:
                np.clip(data.qvel, -SLOWLY, SLOWLY, out=data.qvel)
            quiet = quiet + step if speed < (SLOWLY / 4 if slowly else STILL) else 0.0
            if quiet >= STILL_FOR:
                at_rest = not slowly
                break
            if number % 100 == 0:
                alive()
    data.qvel[:] = 0.0
    mujoco.mj_forward(model, data)
    away = 1e3 * np.linalg.norm(data.subtree_com[who.roots] - before, axis=1)
    return SettledForeign(
        qpos=data.qpos.copy(), moved_mm=dict(zip(who.names, map(float, away), strict=True)), at_rest=at_rest
    )


def write_settled(scene: ForeignScene, settled: SettledForeign, out: str | Path) -> Path:
    """Write `scene` as MJCF with its objects where they came to rest, in their bodies' poses and in a keyframe.

    Meshes and textures are named where they are, by absolute paths.

    Raises:
        CheckError: MuJoCo cannot write the model.
    """
    import mujoco

    out = Path(out)
    model = scene.compile()
    spec = scene.spec
    for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE):
        body = spec.bodies[int(model.jnt_bodyid[joint])]
        at = int(model.jnt_qposadr[joint])
        body.pos, body.quat = settled.qpos[at : at + 3], settled.qpos[at + 3 : at + 7]
        body.alt.type = mujoco.mjtOrientation.mjORIENTATION_QUAT
    home = Path(spec.modelfiledir or scene.path.parent).resolve()
    for name in ("meshdir", "texturedir"):
        folder: Any = getattr(spec, name)
        setattr(spec, name, str((home / (folder or ".")).resolve()))
    spec.add_key(name="settled", qpos=settled.qpos)
    try:
        spec.compile()
        text = spec.to_xml()
    except (ValueError, mujoco.FatalError) as error:
        raise CheckError(f"{scene.path}: MuJoCo cannot write it anew: {' '.join(str(error).split())}") from error
    write_text(out, text)
    return out
