"""Does a scene stay still in every engine? Its exports, each loaded by the engines that read it, and every drift."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pat3d.check.engines.protocol import Absent, Engine, EngineRun, Failed, Format
from pat3d.check.settle import ObjectDrift, SettleReport, creep
from pat3d.errors import CheckError, ExportError
from pat3d.exporters.common.objects import body_names
from pat3d.exporters.formats import export
from pat3d.progress import Event, Progress, silent
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.physics import STILL_SECONDS

TIMEOUT = 900.0
"""Wall time after which an engine is given up [s]."""

Verdict = SettleReport | Absent | Failed


def check_engines(
    scene: Scene,
    engines: Sequence[Engine],
    exports: Path | None = None,
    *,
    seconds: float = STILL_SECONDS,
    timeout: float = TIMEOUT,
    progress: Progress = silent,
) -> tuple[Verdict, ...]:
    """Run `scene` in every engine.

    Args:
        scene: what stands where.
        engines: in the order of the answer.
        exports: folder with exports in folders named for their formats; formats that are missing there are written
            to a temporary folder.
        seconds: simulated time [s].
        timeout: wall time for one engine [s].
        progress: told about every engine.
    """
    verdicts: list[Verdict] = []
    with tempfile.TemporaryDirectory(prefix="pat3d-engines-") as scratch:
        for number, engine in enumerate(engines):
            progress(Event(stage="engines", detail=engine.title, step=number, steps=len(engines)))
            reason = engine.absence()
            if reason is not None:
                verdicts.append(Absent(engine=engine.title, reason=reason))
                continue
            try:
                folder = _exported(scene, engine.format, exports, Path(scratch))
                run = engine.run(folder, seconds, timeout=timeout)
                verdicts.append(drifts(scene, run, seconds))
            except (CheckError, ExportError) as error:
                verdicts.append(Failed(engine=engine.title, reason=str(error)))
    return tuple(verdicts)


def failures(verdicts: Sequence[Verdict]) -> tuple[str, ...]:
    """A line for every engine that did not finish and every object that moved; absent engines are none."""
    lines = []
    for verdict in verdicts:
        if isinstance(verdict, Failed):
            lines.append(verdict.reason)
        elif isinstance(verdict, SettleReport):
            lines += [
                f'"{obj.name}" drifts {max(obj.centre_mm, obj.origin_mm):.2f} mm and {obj.degrees:.2f} degrees in '
                f"{verdict.seconds:g} s of {verdict.engine}."
                for obj in verdict.moved()
            ]
            lines += [f"{verdict.engine} warns: {warning}" for warning in verdict.warnings]
    return tuple(lines)


def drifts(scene: Scene, run: EngineRun, seconds: float) -> SettleReport:
    """How far every object strayed from its pose in `scene` in a run that should have lasted `seconds`.

    Raises:
        CheckError: an object of the scene is missing in the run, or the run stopped early with finite poses.
    """
    slugs, columns = body_names(scene), {name: number for number, name in enumerate(run.names)}
    moving = [obj for obj in scene.objects if not obj.fixed]
    finite = bool(np.isfinite(run.poses).all())
    if finite and run.times[-1] < 0.999 * seconds:
        raise CheckError(f"{run.engine}: the run ended after {run.times[-1]:g} s of {seconds:g} s.")
    found = []
    for obj in moving:
        slug = slugs[obj.name]
        # USD forbids names that start with a digit.
        column = next((columns[name] for name in (obj.name, slug, f"_{slug}") if name in columns), None)
        if column is None:
            raise CheckError(f'{run.engine}: "{obj.name}" is not among the moving bodies: {", ".join(run.names)}.')
        found.append(_drift(obj, run.times, run.poses[:, column]))
    return SettleReport(
        engine=run.engine,
        version=run.version,
        seconds=seconds,
        wall_seconds=run.wall_seconds,
        objects=tuple(found),
        settings=run.settings,
        warnings=run.warnings,
        contacts=None,
    )


def _drift(obj: SceneObject, times: np.ndarray, poses: np.ndarray) -> ObjectDrift:
    """Largest strays over time of one object, and its creep; without bound where it was not finite.

    Args:
        obj: at its pose in the scene.
        times: of the records [s], shape (records,).
        poses: position [m] and quaternion wxyz, shape (records, 7).
    """
    if not np.isfinite(poses).all() or (np.linalg.norm(poses[:, 3:], axis=1) < 1e-6).any():
        lost = dict.fromkeys(("centre_mm", "origin_mm", "degrees", "creep_mm", "creep_degrees"), np.inf)
        return ObjectDrift(name=obj.name, **lost)
    from scipy.spatial.transform import Rotation

    centre = np.array(obj.asset.mass_properties.centre_of_mass)
    turns = Rotation.from_quat(poses[:, 3:], scalar_first=True)
    start = Rotation.from_quat(obj.pose.quat_wxyz, scalar_first=True)
    shift = poses[:, :3] - np.array(obj.pose.position)
    centres = shift + turns.apply(centre) - start.apply(centre)
    late = creep(times, centres[:, None], turns.as_quat(scalar_first=True)[:, None])
    return ObjectDrift(
        name=obj.name,
        creep_mm=None if late is None else float(late[0][0]),
        creep_degrees=None if late is None else float(late[1][0]),
        centre_mm=1e3 * float(np.linalg.norm(centres, axis=1).max()),
        origin_mm=1e3 * float(np.linalg.norm(shift, axis=1).max()),
        degrees=float(np.degrees((start.inv() * turns).magnitude().max())),
    )


def _exported(scene: Scene, name: Format, exports: Path | None, scratch: Path) -> Path:
    """Folder of the export `name`: the one that is there, or one written for the occasion."""
    for root in (exports, scratch):
        if root is not None and (root / name / MAIN[name]).is_file():
            return root / name
    export(scene, (name,), scratch)
    return scratch / name


MAIN: dict[Format, str] = {"mjcf": "scene.xml", "urdf": "manifest.json", "usd": "scene.usdc"}
"""The file that an export of each format is known by."""
