"""One unit of the queue: a candidate for a place of the suite, made, verified, and written or rejected."""

from __future__ import annotations

import os
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pat3d.envs.suites.composition import DRAWS, Draft, draft, pointed
from pat3d.envs.suites.folder import RECORD, SuiteFolder, checksum_of, write_document
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.sight import UnseenError, require_seen
from pat3d.errors import LayoutError, TaskError
from pat3d.generation.attempts import Attempt, Attempts
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.request import request_of
from pat3d.progress import Clock, silent
from pat3d.scene.checksums import record_checksums
from pat3d.scene.io import save_scene
from pat3d.scene.model import GROUND, Scene
from pat3d.scene.physics import SETTLING_FRICTION


def make_unit(folder: SuiteFolder, request: Request, place: int, candidate: int) -> dict[str, Any]:
    """Make a candidate; its scene folder or its rejection is in the suite when this returns.

    Returns:
        How it went, for the log: place, candidate, reason (empty for a scene), seconds by stage.

    Raises:
        OSError, Pat3dError: the folder cannot be written.
    """
    with Making(folder, request, place, candidate) as making:
        with making.working():
            attempt = making.attempts.first()
        return making.conclude(attempt)


class Making:
    """A candidate that is being made, with a folder for its unfinished files while the block lasts."""

    def __init__(self, folder: SuiteFolder, request: Request, place: int, candidate: int) -> None:
        start = time.perf_counter()
        self._folder, self._request, self._place, self._candidate = folder, request, place, candidate
        self._draft, self.clock = draft(request, place, candidate), Clock()
        self._scratch = folder.work / f"{os.getpid()}-{place:06d}-{candidate:02d}"
        self.attempts = Attempts(
            request_of(self._draft.plan, False),
            seed=self._draft.scene_seed,
            friction=SETTLING_FRICTION,
            device=request.device,
            least_tilt=request.least_tilt,
            workspace=Workspace(self._scratch / "none", keep=False),
            clock=self.clock,
            progress=silent,
            scratch=self._scratch,
        )
        self.seconds = time.perf_counter() - start
        """Spent on it [s]."""

    def __enter__(self) -> Making:
        shutil.rmtree(self._scratch, ignore_errors=True)
        self._scratch.mkdir(parents=True)
        return self

    def __exit__(self, *exception: object) -> None:
        shutil.rmtree(self._scratch, ignore_errors=True)

    @contextmanager
    def working(self) -> Iterator[None]:
        """Counts the time of the block."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds += time.perf_counter() - start

    def conclude(self, attempt: Attempt) -> dict[str, Any]:
        """Write the scene of an attempt that passed, or why it is rejected; returns and raises as `make_unit`."""
        with self.working():
            reason, message = self._judged(attempt)
        stages = {name: round(value, 3) for name, value in self.clock.seconds.items() if name != "total"}
        return {
            "place": self._place,
            "candidate": self._candidate,
            "reason": reason,
            "message": message,
            "seconds": round(self.seconds, 3),
            "stages": stages,
        }

    def _judged(self, attempt: Attempt) -> tuple[str, str]:
        """Kind of fault and what is wrong; empty for a scene that is now in the suite."""
        request, place, candidate, made = self._request, self._place, self._candidate, self._draft
        reason, message = _fault(attempt), "; ".join(attempt.failures)
        done: dict[str, Any] = {}
        rolls = _rolling(attempt) if request.stable and not reason else ()
        if rolls:
            reason, message = "rolling", f"on the round side, from where it may roll: {', '.join(rolls)}"
        with self.clock("task"):
            if not reason and attempt.checked is not None:
                for number in range(DRAWS.get(request.task_of(place), 1)):
                    try:
                        made = pointed(self._draft, attempt.checked.scene, number)
                        done = _doable(attempt.checked.scene, attempt.checked.mjcf, made.task, request)
                        reason = ""
                        break
                    except TaskError as error:
                        reason, message = "task", str(error)
                    except UnseenError as error:
                        reason, message = "hardly seen", str(error)
        record = _record(request, place, candidate, made, attempt)
        if reason:
            rejection = {**record, "reason": reason, "message": message}
            write_document(self._folder.rejection(place, candidate), rejection)
        else:
            record |= done
            with self.clock("files"):
                _write(self._folder, request, place, attempt, record, self._scratch, self.clock)
        return reason, message


def _fault(attempt: Attempt) -> str:
    """What kind of fault an attempt has, in a word; empty for none."""
    if attempt.error is not None:
        return "layout" if isinstance(attempt.error, LayoutError) else "simulation"
    if attempt.settled is not None and not attempt.settled.at_rest:
        return "not at rest"
    if attempt.broken:
        return "relations"
    if attempt.checked is None or attempt.passed:
        return ""
    verification = attempt.checked.verification
    if not verification.penetration.passed:
        return "intersection"
    if not verification.mujoco.passed:
        return "MuJoCo"
    return "equilibrium" if not verification.certificate.passed else "relations"


def _rolling(attempt: Attempt) -> tuple[str, ...]:
    """Objects that rest on their round side."""
    support = attempt.checked.verification.certificate.support if attempt.checked is not None else None
    return tuple(name for name, rolls in support.rolling.items() if rolls != "stable") if support else ()


def _doable(scene: Scene, mjcf: Path, task: str, request: Request) -> dict[str, Any]:
    """What a record says of the robot at the task: where it stands, in words, and what is seen [%] where that matters.

    Raises:
        TaskError: it cannot do it.
        UnseenError: something that the task is about is hardly in the picture.
    """
    from pat3d.envs.tasks.naming import called
    from pat3d.envs.tasks.registry import parse_task
    from pat3d.envs.tasks.rehearsal import rehearsed, workplace

    parsed = parse_task(task)
    parsed.check(scene)
    for name in parsed.names:
        if called(scene, name) is None:
            raise TaskError(f'no words tell "{name}" from what is like it.')
    work = workplace(scene, mjcf / "scene.xml", parsed, request.robot)
    # Rehearsing moves the objects.
    seen = {"seen": require_seen(work, request.visible)} if request.visible else {}
    return {"robot": rehearsed(work).describe(), **seen}


def _record(request: Request, place: int, candidate: int, made: Draft, attempt: Attempt) -> dict[str, Any]:
    """Everything known about a candidate that does not depend on the clock."""
    from pat3d.envs.tasks.registry import parse_task

    scene = attempt.scene
    verification = attempt.checked.verification if attempt.checked is not None else None
    numbers = None
    if verification is not None:
        numbers = {
            "mujoco": {
                "version": verification.mujoco.version,
                "seconds": verification.mujoco.seconds,
                "passed": verification.mujoco.passed,
                "mm": verification.mujoco.worst_mm,
                "degrees": verification.mujoco.worst_degrees,
            },
            "intersections": len(verification.penetration.hulls) + len(verification.penetration.visuals),
            "equilibrium": {
                "passed": verification.certificate.passed,
                "residual": verification.certificate.worst,
                "smallest_friction": verification.certificate.smallest_friction,
                "largest_tilt": verification.certificate.largest_tilt,
            },
        }
    return {
        "place": place,
        "candidate": candidate,
        "seed": made.scene_seed,
        "split": request.split_of(place),
        "kind": request.task_of(place),
        "task": made.task,
        "prompt": made.plan.prompt,
        "instruction": parse_task(made.task).instruction(scene) if scene is not None and _told(made, scene) else "",
        "structure": made.structure,
        "moved": list(made.moved),
        "nouns": sorted({obj.noun for obj in made.plan.objects if obj.name in made.moved}),
        "axes": _axes(made, scene),
        "verification": numbers,
        **({"room": request.room_of(place)} if request.rooms else {}),
    }


def _told(made: Draft, scene: Scene) -> bool:
    from pat3d.envs.tasks.registry import parse_task

    try:
        parse_task(made.task).check(scene)
    except TaskError:
        return False
    return True


def _axes(made: Draft, scene: Scene | None) -> dict[str, Any]:
    """How difficult a scene is, along the axes of `pat3d.envs.suites.suite.AXES`."""
    plan = made.plan
    involved = {*made.moved, *made.places}
    parents = {rel.child: rel for rel in plan.relations if rel.supports}
    assets = {obj.name: obj.asset for obj in scene.objects} if scene is not None else {}
    regions = {name for name, asset in assets.items() if asset.region("in") is not None}
    # A plate or a tray has an inside too, but things are on it first of all.
    containers = {name for name in regions if assets[name].regions[0].kind == "in"}

    def height(name: str) -> int:
        relation = parents.get(name)
        if relation is None or relation.parent in regions or relation.kind == "in":
            return 1
        return 1 + height(relation.parent)

    return {
        "objects": len(plan.objects),
        "clutter": sum(obj.name not in involved for obj in plan.objects),
        "container": any(name in containers for name in made.places),
        "stack_height": max(height(obj.name) for obj in plan.objects if obj.name != GROUND),
        "friction": None if scene is None else min(scene[name].asset.material.friction for name in made.moved),
    }


def _write(
    folder: SuiteFolder,
    request: Request,
    place: int,
    attempt: Attempt,
    record: dict[str, Any],
    scratch: Path,
    clock: Clock,
) -> None:
    """Write the scene's folder and move it to its place."""
    from pat3d.view.preview import save_picture

    checked = attempt.checked
    if checked is None:
        return
    fresh = scratch / "scene"
    fresh.mkdir()
    save_scene(checked.scene, fresh)
    checked.mjcf.rename(fresh / "mjcf")
    record_checksums(fresh)
    if request.picture:
        with clock("picture"):
            save_picture(checked.scene, fresh / "preview.png", width=request.picture, height=request.picture * 3 // 4)
    write_document(fresh / RECORD, {**record, "checksum": checksum_of(fresh)})
    target = folder.scene(place)
    target.parent.mkdir(parents=True, exist_ok=True)
    # A worker that outlived its run by a moment may have made the same scene already.
    if not target.exists():
        fresh.rename(target)
