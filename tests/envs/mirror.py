"""MuJoCo's state as MuJoCo Warp holds it."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import warp as wp

WORLDS = 3


def mirrored(data: Any, control: Any = None) -> Any:
    """MuJoCo's state as MuJoCo Warp holds it, in every world."""

    def array(values, dtype):
        repeated = np.broadcast_to(values, (WORLDS, *np.shape(values)))
        return wp.array(np.ascontiguousarray(repeated), dtype=dtype, device="cpu")

    return SimpleNamespace(
        nworld=WORLDS,
        qpos=array(data.qpos, wp.float32),
        qvel=array(data.qvel, wp.float32),
        qfrc_bias=array(data.qfrc_bias, wp.float32),
        qfrc_passive=array(data.qfrc_passive, wp.float32),
        M=array(data.M[None], wp.float32),
        ctrl=array(data.ctrl, wp.float32) if control is None else control,
        site_xpos=array(data.site_xpos, wp.vec3),
        site_xmat=array(data.site_xmat.reshape(-1, 3, 3), wp.mat33),
        xanchor=array(data.xanchor, wp.vec3),
        xaxis=array(data.xaxis, wp.vec3),
    )
