"""The stages in order: a sentence or a specification becomes a verified scene in a folder.

    plan -> assets -> layout -> settling -> verification -> files

A layout that does not settle into a verified scene is tried again with another seed; the best attempt is chosen and
the report tells of all. A folder is complete when it appears.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from pat3d.exporters.formats import VIEWS, export
from pat3d.generation.attempts import Attempts
from pat3d.generation.checkpoints import Workspace
from pat3d.generation.report import Report
from pat3d.generation.request import SceneRequest, request_of
from pat3d.generation.settings import Settings
from pat3d.plan.scene_plan import Planner
from pat3d.progress import Clock, CpuBudget, Event, Progress, silent
from pat3d.scene.checksums import record_checksums
from pat3d.scene.folder import check_target, replacing, write_json
from pat3d.scene.io import save_scene
from pat3d.scene.model import Scene

if TYPE_CHECKING:
    from pat3d.exporters.compare import ParityReport

ATTEMPTS = 3
"""Layouts tried before the best one is chosen, its faults reported."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Outcome:
    """A finished run."""

    scene: Scene
    report: Report
    folder: Path


def generate(
    prompt: str,
    *,
    out: str | os.PathLike[str],
    seed: int = Settings.seed,
    friction: float = Settings.friction,
    least_tilt: float = Settings.least_tilt,
    cpu_limit: float | None = Settings.cpu_limit,
    device: str = Settings.device,
    formats: Sequence[str] = Settings.formats,
    resume: bool = Settings.resume,
    allow_proxies: bool = False,
    planner: Planner | None = None,
    progress: Progress = silent,
) -> Scene:
    """Make the scene that `prompt` describes, verify it and write its folder.

    Args:
        prompt: English, such as "a red mug on a wooden table".
        out: folder to write; an earlier scene folder there is replaced once the new one is complete.
        seed: the same seed gives the same scene.
        friction: Coulomb coefficient [-] of every contact while settling; exports carry the materials' own.
        least_tilt: tilt of the ground [degrees], whichever way, that the scene has to stand to be verified.
        cpu_limit: processor time that the scene may take [s]; None for any.
        device: "cpu" or "cuda".
        formats: exchange formats to write.
        resume: keep finished stages beside `out`, and use those whose inputs have not changed.
        allow_proxies: let a plain box stand in for what the catalogue does not have.
        planner: reads the prompt; the offline grammar where None.
        progress: told what is going on.

    Returns:
        The scene; report.json in `out` says whether every check passed.

    Raises:
        PromptError: the prompt cannot be planned.
        LayoutError: something does not fit.
        SpecError: a setting is out of range, or there is no such device.
        SimulationError: the layout cannot be simulated.
        CpuLimitError: `cpu_limit` is spent.
        ExportError: `out` cannot be written.
    """
    settings = Settings(
        seed=seed,
        friction=friction,
        least_tilt=least_tilt,
        cpu_limit=cpu_limit,
        device=device,
        formats=tuple(formats),
        resume=resume,
    )
    return run_prompt(
        prompt, out=out, settings=settings, allow_proxies=allow_proxies, planner=planner, progress=progress
    ).scene


def build(
    spec_path: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str],
    seed: int | None = None,
    friction: float | None = None,
    least_tilt: float = Settings.least_tilt,
    cpu_limit: float | None = Settings.cpu_limit,
    device: str = Settings.device,
    formats: Sequence[str] = Settings.formats,
    resume: bool = Settings.resume,
    progress: Progress = silent,
) -> Scene:
    """Make the scene that a YAML specification describes, verify it and write its folder.

    Args:
        spec_path: the specification; `pat3d build --schema` prints what may be in it.
        out: as for `generate`, like the rest.
        seed: instead of the specification's.
        friction: instead of the specification's.
        least_tilt: tilt of the ground [degrees], whichever way, that the scene has to stand to be verified.
        cpu_limit: processor time that the scene may take, decompositions included [s]; None for any.
        device: "cpu" or "cuda".
        formats: exchange formats to write.
        resume: keep finished stages beside `out`, and use those whose inputs have not changed.
        progress: told what is going on.

    Returns:
        The scene; report.json in `out` says whether every check passed.

    Raises:
        SpecError: the specification is invalid (the message names the line), or there is no such device.
        AssetError: a mesh cannot be used.
        LayoutError: something does not fit.
        SimulationError: the layout cannot be simulated.
        CpuLimitError: `cpu_limit` is spent.
        ExportError: `out` cannot be written.
    """
    return run_spec(
        spec_path,
        out=out,
        seed=seed,
        friction=friction,
        least_tilt=least_tilt,
        cpu_limit=cpu_limit,
        device=device,
        formats=formats,
        resume=resume,
        progress=progress,
    ).scene


def run_prompt(
    prompt: str,
    *,
    out: str | os.PathLike[str],
    settings: Settings,
    allow_proxies: bool = False,
    planner: Planner | None = None,
    progress: Progress = silent,
) -> Outcome:
    """`generate`, with the report."""
    from pat3d.plan.grammar.planner import GrammarPlanner

    folder, clock, budget = check_target(out), Clock(), CpuBudget(settings.cpu_limit)
    with clock("planning"):
        progress(Event(stage="planning"))
        chosen = planner or GrammarPlanner(allow_proxies)
        request = request_of(chosen.plan(prompt), allow_proxies)
        if record := getattr(chosen, "record", dict)():
            request = replace(request, record={**request.record, "planner": record})
    return make(request, folder=folder, settings=settings, clock=clock, progress=budget.watching(progress))


def run_spec(
    spec_path: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str],
    seed: int | None = None,
    friction: float | None = None,
    least_tilt: float = Settings.least_tilt,
    cpu_limit: float | None = Settings.cpu_limit,
    device: str = Settings.device,
    formats: Sequence[str] = Settings.formats,
    resume: bool = Settings.resume,
    progress: Progress = silent,
) -> Outcome:
    """`build`, with the report."""
    from pat3d.generation.spec import load_spec

    folder, clock, budget = check_target(out), Clock(), CpuBudget(cpu_limit)
    with clock("planning"):
        progress(Event(stage="reading the specification"))
        spec = load_spec(spec_path)
    settings = Settings(
        seed=spec.seed if seed is None else seed,
        friction=spec.friction if friction is None else friction,
        least_tilt=least_tilt,
        cpu_limit=cpu_limit,
        device=device,
        formats=tuple(formats),
        resume=resume,
    )
    request, progress = spec.request(budget), budget.watching(progress)
    return make(request, folder=folder, settings=settings, clock=clock, progress=progress)


def make(request: SceneRequest, *, folder: Path, settings: Settings, clock: Clock, progress: Progress) -> Outcome:
    """The stages after planning, and the folder."""
    from pat3d.view.preview import save_preview

    workspace = Workspace(folder, keep=settings.resume)
    with replacing(folder) as fresh:
        attempts = Attempts(
            request,
            seed=settings.seed,
            friction=settings.friction,
            least_tilt=settings.least_tilt,
            device=settings.device,
            workspace=workspace,
            clock=clock,
            progress=progress,
            scratch=fresh.parent,
        )
        chosen = attempts.best_of(ATTEMPTS)
        scene, settled = chosen.checked.scene, chosen.checked.settled
        with clock("files"):
            progress(Event(stage="writing the folder"))
            save_scene(scene, fresh)
            chosen.checked.mjcf.rename(fresh / "mjcf")
            names = tuple(obj.name for obj in scene.objects)
            settled.write(names, fresh)
        with clock("formats"):
            exports = _exports(scene, settings.formats, fresh, folder, progress)
            record_checksums(fresh)
        with clock("preview"):
            progress(Event(stage="drawing the preview"))
            save_preview(scene, fresh / "preview.png")
        report = Report(
            understood=request.record,
            chosen=chosen,
            reused=tuple(workspace.reused),
            seconds=clock.seconds,
            exports=exports,
        )
        write_json(fresh / "report.json", report.as_dict())
    workspace.clear()
    return Outcome(scene=scene, report=report, folder=folder)


def _exports(
    scene: Scene, formats: Sequence[str], fresh: Path, folder: Path, progress: Progress
) -> dict[str, ParityReport]:
    """Write the formats beside the MJCF, which is there, into `fresh`, and read all of them back."""
    from pat3d.exporters.compare import parity

    more = [name for name in formats if name != "mjcf"]
    paths = {"mjcf": fresh / "mjcf", **(export(scene, more, fresh, progress=progress) if more else {})}
    progress(Event(stage="reading the formats back"))
    return {name: parity(scene, path).moved(fresh, folder) for name, path in paths.items() if name not in VIEWS}
