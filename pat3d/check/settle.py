"""Does the written scene stay still? MuJoCo loads it as any user would, runs it, and every drift is measured."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import CheckError
from pat3d.scene.physics import STILL_SECONDS

SAMPLE_STEPS = 5
"""Time steps between two measurements of the drift."""


@dataclass(frozen=True, kw_only=True)
class ObjectDrift:
    """The furthest one object strayed from its pose at load, over the whole run."""

    name: str
    centre_mm: float
    """Displacement of the centre of mass [mm]."""
    origin_mm: float
    """Displacement of the body origin [mm]."""
    degrees: float
    """Rotation [degrees]."""


@dataclass(frozen=True, kw_only=True)
class SettleReport:
    """How a physics engine moved the scene."""

    engine: str
    version: str
    seconds: float
    """Simulated time [s]."""
    wall_seconds: float
    objects: tuple[ObjectDrift, ...]
    """Every object with degrees of freedom."""
    settings: Mapping[str, Any]
    """Time step, cone, solver and the other options the run used."""
    warnings: tuple[str, ...]
    """What the engine complained about while loading or stepping; none for a good scene."""
    contacts: int | None
    """Contact points at the end of the run, where the engine tells."""

    @property
    def worst_mm(self) -> float:
        """Largest displacement of any centre of mass or origin [mm]."""
        return max((max(obj.centre_mm, obj.origin_mm) for obj in self.objects), default=0.0)

    @property
    def worst_degrees(self) -> float:
        """Largest rotation of any object [degrees]."""
        return max((obj.degrees for obj in self.objects), default=0.0)

    def moved(self, *, mm: float = 1.0, degrees: float = 1.0) -> tuple[ObjectDrift, ...]:
        """The objects that strayed by `mm` or `degrees` or more (or to nowhere)."""
        return tuple(
            obj for obj in self.objects if not (obj.centre_mm < mm and obj.origin_mm < mm and obj.degrees < degrees)
        )

    @property
    def passed(self) -> bool:
        """No warning, and every object within 1 mm and 1 degree."""
        return not self.warnings and not self.moved()

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        return {**asdict(self), "worst_mm": self.worst_mm, "worst_degrees": self.worst_degrees, "passed": self.passed}


def settle_in_mujoco(mjcf_path: str | Path, seconds: float = STILL_SECONDS) -> SettleReport:
    """Load an MJCF file with MuJoCo, simulate it untouched, and measure how far everything strays.

    Args:
        mjcf_path: the file, loaded from the path as any user would; poses are those of the bodies.
        seconds: simulated time [s].

    Raises:
        CheckError: MuJoCo refuses the file; the message is MuJoCo's.
    """
    import mujoco

    messages: list[str] = []
    before = mujoco.get_mju_user_warning()
    # Without a handler MuJoCo appends its warnings to a log file in the working directory.
    mujoco.set_mju_user_warning(messages.append)
    try:
        start = time.perf_counter()
        try:
            model = mujoco.MjModel.from_xml_path(str(mjcf_path))
        except ValueError as error:
            raise CheckError(f"MuJoCo {mujoco.__version__} refuses {mjcf_path}: {error}") from error
        data = mujoco.MjData(model)
        drift = _run(mujoco, model, data, seconds)
        wall = time.perf_counter() - start
    finally:
        mujoco.set_mju_user_warning(before)
    for kind, stat in zip(mujoco.mjtWarning.__members__, data.warning, strict=False):
        if stat.number:
            messages.append(f"{kind.removeprefix('mjWARN_').lower()}: {stat.number} times")
    return SettleReport(
        engine="MuJoCo",
        version=mujoco.mj_versionString(),
        seconds=seconds,
        wall_seconds=wall,
        objects=drift,
        settings=_settings(mujoco, model),
        warnings=tuple(dict.fromkeys(messages)),
        contacts=int(data.ncon),
    )


def _run(mujoco: Any, model: Any, data: Any, seconds: float) -> tuple[ObjectDrift, ...]:
    """Step the model and return the worst drift of every moving body."""
    free = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
    bodies = model.jnt_bodyid[free]
    mujoco.mj_forward(model, data)
    origin, centre, quat = data.xpos[bodies].copy(), data.xipos[bodies].copy(), data.xquat[bodies].copy()
    worst = np.zeros((3, len(bodies)))
    left = max(1, round(seconds / model.opt.timestep))
    while left > 0:
        mujoco.mj_step(model, data, nstep=min(SAMPLE_STEPS, left))
        left -= SAMPLE_STEPS
        # The positions that a step leaves behind lag half a step; the joint state does not.
        mujoco.mj_kinematics(model, data)
        worst[0] = np.maximum(worst[0], np.linalg.norm(data.xipos[bodies] - centre, axis=1))
        worst[1] = np.maximum(worst[1], np.linalg.norm(data.xpos[bodies] - origin, axis=1))
        worst[2] = np.maximum(worst[2], _angle(data.xquat[bodies], quat))
        if data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number or not np.isfinite(data.qpos).all():
            # The state was reset after an explosion: the drift is unbounded.
            worst[:] = np.inf
            break
    names = [_object_name(mujoco, model, body) for body in bodies]
    return tuple(
        ObjectDrift(name=name, centre_mm=float(c), origin_mm=float(o), degrees=float(a))
        for name, c, o, a in zip(names, 1e3 * worst[0], 1e3 * worst[1], np.degrees(worst[2]), strict=True)
    )


def _angle(now: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Angle between unit quaternions [rad], exact for small ones, shape (n,)."""
    cosine = np.einsum("ni,ni->n", now, start)
    aligned = now * np.where(cosine < 0, -1.0, 1.0)[:, None]
    return 4.0 * np.arcsin(np.clip(np.linalg.norm(aligned - start, axis=1) / 2.0, 0.0, 1.0))


def _object_name(mujoco: Any, model: Any, body: int) -> str:
    """The object's own name where the file carries one, else the body's."""
    name = model.body(body).name or f"body {body}"
    text = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, name)
    if text < 0:
        return name
    start = model.text_adr[text]
    return bytes(model.text_data[start : start + model.text_size[text]]).rstrip(b"\0").decode("utf-8", "replace")


def _settings(mujoco: Any, model: Any) -> dict[str, Any]:
    option = model.opt

    def name(enum: Any, value: int) -> str:
        return enum(value).name.split("_")[-1].lower()

    multiccd = getattr(mujoco.mjtDisableBit, "mjDSBL_MULTICCD", None)
    if multiccd is not None:
        several = not option.disableflags & multiccd
    else:
        several = bool(option.enableflags & mujoco.mjtEnableBit.mjENBL_MULTICCD)
    return {
        "timestep": option.timestep,
        "cone": name(mujoco.mjtCone, option.cone),
        "impratio": option.impratio,
        "integrator": name(mujoco.mjtIntegrator, option.integrator),
        "solver": name(mujoco.mjtSolver, option.solver),
        "iterations": int(option.iterations),
        "multiccd": bool(several),
        "sample_steps": SAMPLE_STEPS,
    }
