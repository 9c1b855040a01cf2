"""The long work of a studio, a function each: what goes in and comes out can be sent to another process."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from pat3d.errors import CheckError
from pat3d.generation.editing.editable import EditableScene
from pat3d.generation.editing.said import applied
from pat3d.progress import Event, Progress, silent
from pat3d.scene.model import Scene

Made = tuple[EditableScene, frozenset[str]]
"""A scene, and the names of the objects whose assets are those that went in."""


def warmed(*, progress: Progress = silent) -> None:
    """Load what settling needs, so that the first one does not wait for it."""
    from pat3d.sim.compilation import prepare

    prepare("cpu", progress)


def settled(scene: EditableScene, *, progress: Progress = silent) -> Made:
    """`scene` at rest and verified; see EditableScene.settle."""
    return _marked(scene, scene.settle(progress=progress))


def edited(scene: EditableScene, verb: str, words: str, *, progress: Progress = silent) -> Made:
    """`scene` after one edit in the words of `pat3d edit`."""
    progress(Event(stage=f"{verb}: {words}"))
    return _marked(scene, applied(scene, [(verb, words)]))


def generated(sentence: str, seed: int, folder: Path, *, progress: Progress = silent) -> float:
    """Write the scene that `sentence` describes into `folder`; returns the seconds it took.

    Raises:
        PromptError: the sentence cannot be read.
        LayoutError: something does not fit.
        SimulationError: the layout cannot be simulated.
        CheckError: no attempt passed the verification.
    """
    from pat3d.generation.pipeline import run_prompt
    from pat3d.generation.settings import Settings

    outcome = run_prompt(sentence, out=folder, settings=Settings(seed=seed), progress=progress)
    if outcome.report.failures:
        raise CheckError(f"no attempt passed its verification: {outcome.report.failures[0]}")
    return outcome.report.seconds["total"]


def saved(scene: EditableScene, target: Path, *, progress: Progress = silent) -> None:
    """Write `scene`, which is verified or as it was opened, into the folder `target`."""
    from pat3d.generation.rewrite import copy_folder

    if scene.verified is None:
        progress(Event(stage="writing the folder"))
        copy_folder(scene.folder, target)
    else:
        scene.save(target, progress=progress)


def exported(scene: Scene, formats: Sequence[str], target: Path, *, progress: Progress = silent) -> list[Path]:
    """Write `scene` in `formats` into `target` and read it back; returns the main files.

    Raises:
        CheckError: what was written does not read back as the same scene.
    """
    from pat3d.exporters.compare import parity
    from pat3d.exporters.formats import VIEWS, export

    paths = export(scene, formats, target, progress=progress)
    for kind, path in paths.items():
        if kind not in VIEWS:
            progress(Event(stage="reading back", detail=kind))
            for line in parity(scene, path).failures:
                raise CheckError(line)
    return list(paths.values())


def with_assets_of(made: Made, given: EditableScene) -> EditableScene:
    """The scene of `made` with the very assets of `given` where they are the same, so that pages keep their meshes."""
    found, kept = made
    known = {obj.name: obj.asset for obj in given.scene.objects}
    scene = found.draft.scene
    objects = tuple(replace(obj, asset=known[obj.name]) if obj.name in kept else obj for obj in scene.objects)
    draft = replace(found.draft, scene=replace(scene, objects=objects))
    return replace(found, before=given.before, draft=draft)


def _marked(before: EditableScene, after: EditableScene) -> Made:
    known = {obj.name: obj.asset for obj in before.scene.objects}
    return after, frozenset(obj.name for obj in after.scene.objects if known.get(obj.name) is obj.asset)
