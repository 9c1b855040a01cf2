"""The paper's Table 1 on one's own prompts: the method, its start, and what two of its parts are worth.

Of every prompt four scenes are measured: the layout before settling, the scene as generated, the scene without a scene
tree (every object for itself on the ground) and the first layout settled, whatever becomes of it, without another
attempt or optimisation. A sentence has no picture, from which the paper's raw layout comes; where every prompt is
painted first, the objects as they were fitted to that picture are measured, too.
"""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pat3d.check.metrics.appearance import Appearance
from pat3d.check.metrics.subject import Subject, subject_of
from pat3d.check.metrics.table import Geometry, measure
from pat3d.errors import Pat3dError
from pat3d.generation.attempts import Attempts
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.from_image import raw_layout, request_of_recovered
from pat3d.generation.many import folder_names
from pat3d.generation.pictured import understand
from pat3d.generation.pipeline import make, run_prompt
from pat3d.generation.request import SceneRequest, request_of
from pat3d.generation.settings import Settings
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from pat3d.progress import Clock, Event, Progress, silent
from pat3d.scene.folder import key_of, read_json, write_json
from pat3d.scene.model import Scene
from pat3d.scene.versions import versions
from pat3d.vision.looking import Lookers, Photograph
from pat3d.vision.recover import Recovered

COLUMNS = ("clip", "vqa", "D", "R", "plausibility")
"""As the paper has them."""

PUBLISHED: dict[str, tuple[float | None, ...]] = {
    "GraphDreamer": (27.53, 0.46, 0.25, 61.72, 40.0),
    "Blender-MCP": (28.93, 0.56, 1.03, 14.78, 47.7),
    "MIDI": (29.68, 0.63, 0.69, 110.80, 62.7),
    "PAT3D, raw layout": (29.88, 0.64, 0.81, 14.11, 65.5),
    "PAT3D, initialisation": (30.77, 0.70, 2.91, 0.0, 34.2),
    "PAT3D": (31.79, 0.68, 0.0, 0.0, 88.5),
}
"""Table 1 of the paper (ICLR 2026): other prompts, and objects made from pictures."""

RAW = "raw layout"
VARIANTS = (RAW, "initialisation", "no scene tree", "no optimisation", "full method")
"""What is measured here; the first of painted prompts alone."""

Judging = Callable[[Subject], Appearance]


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One variant of one prompt."""

    prompt: str
    variant: str
    values: Mapping[str, float | None]
    """By column; None where it is absent, infinite where the scene burst apart."""
    absent: tuple[str, ...] = ()
    """Why what is absent is."""
    failed: str = ""
    """Why there is no scene at all."""


def table1(
    prompts: Sequence[str],
    out: str | os.PathLike[str],
    *,
    settings: Settings,
    judge: Judging | None = None,
    judged_by: str = "",
    lookers: Lookers | None = None,
    progress: Progress = silent,
) -> Iterator[tuple[Entry, ...]]:
    """The entries of every prompt, as they are found; those that an earlier run kept in `out` are not measured again.

    Args:
        prompts: sentences.
        out: folder of the generated scenes and of what was measured.
        settings: of the scenes.
        judge: says how well a scene shows its prompt, where there are networks for it.
        judged_by: which networks; entries that others judged are measured again.
        lookers: models that paint every prompt and say what the picture shows; None where sentences are planned.
        progress: told what is going on.
    """
    root = Path(out).expanduser()
    settings = replace(settings, resume=True)
    for prompt, name in folder_names(prompts).items():
        file, key = root / f"{name}.json", key_of(versions(), prompt, repr(settings), judged_by, lookers is not None)
        kept = read_json(file)
        if kept.get("key") == key:
            yield tuple(_read(entry) for entry in kept["entries"])
            continue
        root.mkdir(parents=True, exist_ok=True)
        entries = []
        for variant, scene in _variants(prompt, root / name, settings, lookers, progress):
            if isinstance(scene, Pat3dError):
                values: dict[str, float | None] = dict.fromkeys(COLUMNS)
                entries.append(Entry(prompt=prompt, variant=variant, values=values, failed=str(scene)))
                continue
            progress(Event(stage="measuring", detail=f"{name}: {variant}"))
            subject = subject_of(scene, initial=variant == VARIANTS[1])
            seen = None if judge is None else judge(subject)
            entries.append(_entry(prompt, variant, measure(subject, device=settings.device), seen))
        write_json(file, {"key": key, "entries": [_written(entry) for entry in entries]})
        yield tuple(entries)


def means(entries: Sequence[Entry]) -> dict[str, dict[str, float | None]]:
    """Mean of every column over the prompts that have it, by variant."""
    rows: dict[str, dict[str, float | None]] = {}
    for variant in VARIANTS:
        own = [entry for entry in entries if entry.variant == variant]
        rows[variant] = {}
        for column in COLUMNS:
            found = [value for entry in own if (value := entry.values[column]) is not None]
            rows[variant][column] = sum(found) / len(found) if found else None
    return rows


def _variants(
    prompt: str, folder: Path, settings: Settings, lookers: Lookers | None, progress: Progress
) -> Iterator[tuple[str, Scene | Pat3dError]]:
    left = list(VARIANTS if lookers is not None else VARIANTS[1:])
    try:
        if lookers is None:
            plan = GrammarPlanner().plan(prompt)
            request, treeless = request_of(plan, False), replace(plan, relations=(), arrangements=(), task=None)
            outcome = run_prompt(prompt, out=folder, settings=settings, progress=progress)
        else:
            one = understand(Photograph(), prompt=prompt, seed=settings.seed, lookers=lookers, progress=progress)
            yield left.pop(0), raw_layout(one.found, prompt=prompt)
            request, treeless = one.request, replace(one.found, relations=())
            outcome = make(request, folder=folder, settings=settings, clock=Clock(), progress=progress)
    except Pat3dError as error:
        yield from ((variant, error) for variant in left)
        return
    initial, alone, unoptimised, full = left
    yield initial, outcome.scene
    yield alone, _alone(treeless, prompt, folder, settings, progress)
    chosen = outcome.report.chosen
    once = len(chosen.tried) == 1 and (chosen.best.settled is None or chosen.best.settled.optimisation is None)
    yield unoptimised, outcome.scene if once else _first(request, folder, settings, progress)
    yield full, outcome.scene


def _alone(
    treeless: ScenePlan | Recovered, prompt: str, folder: Path, settings: Settings, progress: Progress
) -> Scene | Pat3dError:
    """What a plan or a picture without relations becomes."""
    try:
        if isinstance(treeless, ScenePlan):
            return _first(request_of(treeless, False), folder, settings, progress)
        return _first(request_of_recovered(treeless, prompt=prompt), folder, settings, progress)
    except Pat3dError as error:
        return error


def _first(request: SceneRequest, folder: Path, settings: Settings, progress: Progress) -> Scene | Pat3dError:
    """The first layout of a request, settled, whether it holds or not."""
    with tempfile.TemporaryDirectory(prefix="pat3d-table1-") as scratch:
        attempts = Attempts(
            request,
            seed=settings.seed,
            friction=settings.friction,
            device=settings.device,
            least_tilt=settings.least_tilt,
            workspace=Workspace(Path(scratch) / folder.name, keep=False),
            clock=Clock(),
            progress=progress,
            scratch=Path(scratch),
        )
        attempt = attempts.first()
        return attempt.error or attempt.scene or Pat3dError("no scene")


def _entry(prompt: str, variant: str, found: Geometry, seen: Appearance | None) -> Entry:
    scores = {} if seen is None else {name: getattr(seen, name) for name in ("clip", "vqa", "plausibility")}
    absent = [found.absent] if found.remeshed is None else []
    absent += [f"{name}: {one.absent}" for name, one in scores.items() if one is not None and one.absent]
    values: dict[str, float | None] = {
        "D": found.displacement.value,
        "R": None if found.remeshed is None else found.remeshed.value,
        **{name: None if one is None else one.value for name, one in scores.items()},
    }
    return Entry(
        prompt=prompt, variant=variant, values={name: values.get(name) for name in COLUMNS}, absent=tuple(absent)
    )


def _written(entry: Entry) -> dict[str, Any]:
    values = {name: "burst" if value == math.inf else value for name, value in entry.values.items()}
    return {**vars(entry), "values": values}


def _read(data: Mapping[str, Any]) -> Entry:
    values = {name: math.inf if value == "burst" else value for name, value in data["values"].items()}
    return Entry(**{**data, "values": values, "absent": tuple(data["absent"])})
