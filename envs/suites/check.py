"""Verifies a suite again: files, splits, and every scene's stillness in MuJoCo."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from pat3d.envs.robots.arms import require_robot
from pat3d.envs.suites.folder import MANIFEST, RECORD, SELF, checksum_of, checksum_of_document, read_document
from pat3d.envs.suites.reference import differences
from pat3d.envs.suites.request import Request
from pat3d.envs.suites.sight import UnseenError, require_seen
from pat3d.envs.suites.suite import Entry, Suite
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.rehearsal import workplace
from pat3d.errors import EnvironmentSetupError, Pat3dError, SuiteError, TaskError
from pat3d.scene.io import load_scene


def check_suite(
    suite: Suite, *, settle: bool = True, workers: int = 1, tell: Callable[[int, int], None] = lambda done, of: None
) -> list[str]:
    """What is wrong with a suite, a line each.

    Args:
        suite: a complete one.
        settle: whether MuJoCo simulates every scene again, and the agent's camera looks at it (a second each).
        workers: processes that do so.
        tell: told how many scenes are done, of how many.
    """
    lines = check_manifest(suite) + check_splits(suite) + differences(suite.folder, suite.request)[0]
    request = suite.request
    if settle and request.visible:
        try:
            require_robot(request.robot)
        except EnvironmentSetupError as error:
            lines.append(f"nobody can look whether the objects of the tasks are in view: {error}")
            request = replace(request, visible=0.0)
    job = partial(check_scene, suite.folder.path, request, settle=settle)
    with _mapping(workers if settle else 1) as apply:
        for number, found in enumerate(apply(job, suite.entries)):
            lines += found
            tell(number + 1, len(suite.entries))
    return lines


def check_scene(path: Path, request: Request, entry: Entry, *, settle: bool) -> list[str]:
    """What is wrong with one scene of the suite of a request in the folder `path`."""
    from pat3d.check.settle import settle_in_mujoco

    folder = path / "scenes" / f"{entry.place:06d}"
    try:
        record = read_document(folder / RECORD)
        if record.get("checksum") != entry.checksum:
            return [f"scene {entry.place}: record.json and suite.json differ."]
        told = ("split", "kind", "task", "prompt", "instruction")
        if wrong := [name for name in told if record.get(name) != getattr(entry, name)]:
            return [f"scene {entry.place}: record.json and suite.json differ in {', '.join(wrong)}."]
        if checksum_of(folder) != entry.checksum:
            return [f"scene {entry.place}: its files are not those that were verified (their checksum differs)."]
        lines = check_task(folder, entry)
        if not settle:
            return lines
        lines += check_sight(folder, request, entry)
        report = settle_in_mujoco(folder / "mjcf" / "scene.xml")
    except Pat3dError as error:
        return [f"scene {entry.place}: {error}"]
    moved = [
        f'scene {entry.place}: "{one.name}" drifts {max(one.centre_mm, one.origin_mm):.2f} mm and {one.degrees:.2f} '
        f"degrees in {report.seconds:g} s of MuJoCo {report.version}."
        for one in report.moved()
    ]
    return lines + moved + [f"scene {entry.place}: MuJoCo warns: {warning}" for warning in report.warnings]


def check_task(folder: Path, entry: Entry) -> list[str]:
    """Whether the scene in `folder` allows the task, and the instruction is that task's, made anew from the scene."""
    scene = load_scene(folder)
    try:
        task = parse_task(entry.task)
        task.check(scene)
    except TaskError as error:
        return [f"scene {entry.place}: its task is not one of its scene: {error}"]
    if task.kind != entry.kind or task.instruction(scene) != entry.instruction:
        return [
            f'scene {entry.place}: "{entry.instruction}" is not the instruction of {entry.task}, which is '
            f'"{task.instruction(scene)}".'
        ]
    return []


def check_sight(folder: Path, request: Request, entry: Entry) -> list[str]:
    """Whether the objects of the task are as well in view as the request asks for."""
    if not request.visible:
        return []
    try:
        scene = load_scene(folder)
        work = workplace(scene, folder / "mjcf" / "scene.xml", parse_task(entry.task), request.robot)
        require_seen(work, request.visible)
    except UnseenError as error:
        return [f"scene {entry.place}: {error}"]
    except TaskError as error:
        return [f"scene {entry.place}: nobody can look: {error}"]
    return []


def check_manifest(suite: Suite) -> list[str]:
    """Whether suite.json is as it was written."""
    if SELF not in suite.document:
        return [f"{MANIFEST} has no checksum of itself; generate the suite again from its request."]
    if suite.document[SELF] != checksum_of_document(suite.document):
        return [f"{MANIFEST} was edited: it is not what its checksum ({SELF}) was made of."]
    return []


def check_splits(suite: Suite) -> list[str]:
    """Whether what is held out is held out, and no scene is there twice."""
    scenes = suite.document["scenes"]
    lines = [
        f"scene {scene['place']}: split {scene['split']} and task {scene['kind']}, where the request asks for "
        f"{suite.request.split_of(scene['place'])} and {suite.request.task_of(scene['place'])}."
        for scene in scenes
        if (scene["split"], scene["kind"])
        != (suite.request.split_of(scene["place"]), suite.request.task_of(scene["place"]))
    ]
    for what, of in (("object", "nouns"), ("layout", "structure")):
        parts = {part: _values(scenes, part, of) for part in ("train", f"val/{what}", f"test/{what}")}
        names = list(parts)
        for number, first in enumerate(names):
            for second in names[number + 1 :]:
                if shared := sorted(parts[first] & parts[second]):
                    lines.append(f"{first} and {second} share {of}: {', '.join(map(str, shared))}.")
    seen: dict[str, int] = {}
    for scene in scenes:
        if (first := seen.setdefault(scene["checksum"], scene["place"])) != scene["place"]:
            lines.append(f"scenes {first} and {scene['place']} are the same.")
    return lines


def _values(scenes: list[dict[str, Any]], split: str, key: str) -> set[Any]:
    found: set[Any] = set()
    for scene in scenes:
        if scene["split"] == split:
            value = scene.get(key)
            if value is None:
                raise SuiteError(f"suite.json is damaged: scene {scene['place']} has no {key}.")
            # Structures are a task's own: different tasks may use the same words.
            found |= set(value) if isinstance(value, list) else {f"{scene['kind']}: {value}"}
    return found


@contextmanager
def _mapping(workers: int) -> Iterator[Callable[..., Any]]:
    if workers == 1:
        yield map
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        yield partial(pool.map, chunksize=4)
