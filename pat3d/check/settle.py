"""Does the written scene stay still? MuJoCo loads it as any user would, runs it, and every drift is measured."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import CheckError
from pat3d.scene.physics import STILL_SECONDS

SAMPLE_STEPS = 5
"""Time steps between two measurements of the drift."""

CREEP_SECONDS = 30.0
"""A shorter run [s] cannot tell creep from the last of the settling, which may take some seconds."""

CREEP_MM = 0.1
"""Objects that are slower than this late in a run [mm a minute] stand still for as long as anybody watches..."""

CREEP_DEGREES = 0.05
"""...and turn less than this [degrees a minute]."""

Change = Callable[[Any], None]
"""Something done to an MjModel before it is simulated."""


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
    creep_mm: float | None = None
    """Speed of the centre of mass late in the run [mm a minute], see `creep`; None after a short run."""
    creep_degrees: float | None = None
    """Rotation late in the run [degrees a minute]."""


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

    @property
    def worst_creep_mm(self) -> float | None:
        """Largest speed late in the run [mm a minute]; None after a short run."""
        return max((obj.creep_mm for obj in self.objects if obj.creep_mm is not None), default=None)

    @property
    def worst_creep_degrees(self) -> float | None:
        """Largest rotation late in the run [degrees a minute]."""
        return max((obj.creep_degrees for obj in self.objects if obj.creep_degrees is not None), default=None)

    def creeping(self) -> tuple[ObjectDrift, ...]:
        """The objects that still move late in the run, though they may not have come far."""
        return tuple(
            obj
            for obj in self.objects
            if (obj.creep_mm is not None and not obj.creep_mm < CREEP_MM)
            or (obj.creep_degrees is not None and not obj.creep_degrees < CREEP_DEGREES)
        )

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
        return {
            **asdict(self),
            "worst_mm": self.worst_mm,
            "worst_degrees": self.worst_degrees,
            "worst_creep_mm_per_minute": self.worst_creep_mm,
            "worst_creep_degrees_per_minute": self.worst_creep_degrees,
            "passed": self.passed,
        }


def creep(
    times: NDArray[np.float64], centres: NDArray[np.float64], quats: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]] | None:
    """How fast bodies move late in a run: from the mean pose of its third quarter to that of its last.

    Means, because an object that trembles by a micrometre goes nowhere.

    Args:
        times: of the records [s], shape (records,).
        centres: of mass [m], shape (records, bodies, 3).
        quats: unit quaternions, any sign, shape (records, bodies, 4).

    Returns:
        [mm a minute] and [degrees a minute], shape (bodies,) each; None for runs of less than CREEP_SECONDS.
    """
    start, end = float(times[0]), float(times[-1])
    if end - start < 0.99 * CREEP_SECONDS:
        return None
    third = (times >= start + 0.5 * (end - start)) & (times < start + 0.75 * (end - start))
    last = times >= start + 0.75 * (end - start)
    if not (third.any() and last.any()):
        return None
    minutes = float(times[last].mean() - times[third].mean()) / 60.0
    aligned = quats * np.where(np.einsum("rbi,bi->rb", quats, quats[-1]) < 0, -1.0, 1.0)[:, :, None]
    before, after = aligned[third].mean(axis=0), aligned[last].mean(axis=0)
    before, after = (mean / np.linalg.norm(mean, axis=1, keepdims=True) for mean in (before, after))
    shift = np.linalg.norm(centres[last].mean(axis=0) - centres[third].mean(axis=0), axis=1)
    return 1e3 * shift / minutes, np.degrees(_angle(after, before)) / minutes


def settle_in_mujoco(
    mjcf_path: str | Path,
    seconds: float = STILL_SECONDS,
    change: Change | None = None,
    alive: Callable[[], None] = lambda: None,
) -> SettleReport:
    """Load an MJCF file with MuJoCo, simulate it untouched, and measure how far everything strays.

    Args:
        mjcf_path: the file, loaded from the path as any user would; poses are those of the bodies.
        seconds: simulated time [s].
        change: done to the compiled model first, to ask what other settings would do.
        alive: called between time steps.

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
        except (ValueError, mujoco.FatalError) as error:
            raise CheckError(f"MuJoCo {mujoco.__version__} refuses {mjcf_path}: {error}") from error
        if change is not None:
            change(model)
        data = mujoco.MjData(model)
        try:
            drift = _run(mujoco, model, data, seconds, alive)
        except mujoco.FatalError as error:
            # A collider that returns more contacts than there is room for stops MuJoCo, and is this scene's fault.
            messages.append(f"stopped: {error}")
            drift = _lost(mujoco, model)
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


def _run(mujoco: Any, model: Any, data: Any, seconds: float, alive: Callable[[], None]) -> tuple[ObjectDrift, ...]:
    """Step the model and return the worst drift of every moving body."""
    free = np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
    bodies = model.jnt_bodyid[free]
    mujoco.mj_forward(model, data)
    origin, centre, quat = data.xpos[bodies].copy(), data.xipos[bodies].copy(), data.xquat[bodies].copy()
    worst = np.zeros((3, len(bodies)))
    records: list[tuple[float, NDArray[np.float64], NDArray[np.float64]]] = []
    left = max(1, round(seconds / model.opt.timestep))
    while left > 0:
        alive()
        mujoco.mj_step(model, data, nstep=min(SAMPLE_STEPS, left))
        left -= SAMPLE_STEPS
        # The positions that a step leaves behind lag half a step; the joint state does not.
        mujoco.mj_kinematics(model, data)
        records.append((data.time, data.xipos[bodies], data.xquat[bodies]))
        worst[0] = np.maximum(worst[0], np.linalg.norm(records[-1][1] - centre, axis=1))
        worst[1] = np.maximum(worst[1], np.linalg.norm(data.xpos[bodies] - origin, axis=1))
        worst[2] = np.maximum(worst[2], _angle(records[-1][2], quat))
        if data.warning[mujoco.mjtWarning.mjWARN_BADQACC].number or not np.isfinite(data.qpos).all():
            # The state was reset after an explosion: the drift is unbounded.
            worst[:] = np.inf
            records = []
            break
    late = creep(*map(np.array, zip(*records, strict=True))) if records else (worst[0], worst[2])
    names = [object_name(mujoco, model, body) for body in bodies]
    return tuple(
        ObjectDrift(
            name=name,
            centre_mm=float(1e3 * worst[0, k]),
            origin_mm=float(1e3 * worst[1, k]),
            degrees=float(np.degrees(worst[2, k])),
            creep_mm=None if late is None else float(late[0][k]),
            creep_degrees=None if late is None else float(late[1][k]),
        )
        for k, name in enumerate(names)
    )


def _lost(mujoco: Any, model: Any) -> tuple[ObjectDrift, ...]:
    """Every moving body, anywhere."""
    bodies = model.jnt_bodyid[np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)]
    return tuple(
        ObjectDrift(name=object_name(mujoco, model, body), centre_mm=np.inf, origin_mm=np.inf, degrees=np.inf)
        for body in bodies
    )


def _angle(now: np.ndarray, start: np.ndarray) -> np.ndarray:
    """Angle between unit quaternions [rad], exact for small ones, shape (n,)."""
    cosine = np.einsum("ni,ni->n", now, start)
    aligned = now * np.where(cosine < 0, -1.0, 1.0)[:, None]
    return 4.0 * np.arcsin(np.clip(np.linalg.norm(aligned - start, axis=1) / 2.0, 0.0, 1.0))


def object_name(mujoco: Any, model: Any, body: int) -> str:
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
