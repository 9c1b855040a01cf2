"""What a person sees in the terminal: progress while it runs, a summary at the end."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.progress import Event, Progress

if TYPE_CHECKING:
    from rich.console import Console

    from pat3d.check.certificate import Certificate
    from pat3d.check.engines.check import Verdict
    from pat3d.check.settings import SettingReport
    from pat3d.check.settle import ObjectDrift, SettleReport
    from pat3d.check.verification import Verification
    from pat3d.exporters.compare import ParityReport
    from pat3d.generation.many import Row
    from pat3d.generation.optimize_folder import Outcome
    from pat3d.generation.report import Report
    from pat3d.generation.settle_folder import Outcome as SettledOutcome
    from pat3d.scene.model import Scene

QUIET_SECONDS = 5.0
"""A log that is no terminal hears of a stage in progress at most this often."""


def console(*, stderr: bool = False) -> Console:
    """A console that writes plain text where the stream is no terminal."""
    from rich.console import Console

    made = Console(stderr=stderr, highlight=False, emoji=False)
    if not made.is_terminal:
        made = Console(stderr=stderr, highlight=False, emoji=False, width=120)
    return made


def verdict(failures: Sequence[str]) -> int:
    """Print a line for every failure on stderr; returns the exit code."""
    errors = console(stderr=True)
    for line in failures:
        errors.print(f"pat3d: {line}", markup=False, soft_wrap=True)
    return 1 if failures else 0


@contextmanager
def watch(target: Console) -> Iterator[Progress]:
    """Shows a run's events on `target`: one live line in a terminal, a few plain lines elsewhere."""
    if not target.is_terminal:
        yield _Lines(target).tell
        return
    from rich.markup import escape
    from rich.progress import Progress as Live
    from rich.progress import SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TimeElapsedColumn(), TextColumn("{task.description}"))
    with Live(*columns, console=target, transient=True) as live:
        task = live.add_task("starting", total=None)
        yield lambda event: live.update(task, description=escape(_words(event)))


class _Lines:
    def __init__(self, target: Console) -> None:
        self._console = target
        self._start = self._last = time.perf_counter()
        self._stage = ""

    def tell(self, event: Event) -> None:
        now = time.perf_counter()
        if event.stage == self._stage and now - self._last < QUIET_SECONDS:
            return
        self._stage, self._last = event.stage, now
        self._console.print(f"{now - self._start:6.1f} s  {_words(event)}", markup=False)


def _words(event: Event) -> str:
    text = event.stage
    if event.step is not None and event.steps is not None:
        text += f" {event.step + 1}/{event.steps}"
    elif event.step:
        text += f", step {event.step}"
    if event.motion is not None:
        text += f", moving {_length(event.motion)}"
    if event.loss is not None:
        text += f", loss {event.loss:.2g} m^2"
    return f"{text}: {event.detail}" if event.detail else text


def _length(metres: float) -> str:
    """A length in words that fit it."""
    for limit, factor, unit in ((1e-6, 1e9, "nm"), (1e-3, 1e6, "um"), (1.0, 1e3, "mm")):
        if metres < limit:
            return f"{metres * factor:.3g} {unit}"
    return f"{metres:.3g} m"


def show_verification(target: Console, scene: Scene, verification: Verification) -> None:
    """The table of a scene's objects, and what the checks found."""
    from rich.table import Table

    drifts = {obj.name: obj for obj in verification.mujoco.objects}
    gaps: dict[str, float] = {}
    for gap in verification.penetration.gaps:
        for name in (gap.first, gap.second):
            gaps[name] = min(gap.distance, gaps.get(name, gap.distance))
    support = verification.certificate.support
    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("object", overflow="fold")
    table.add_column("rests on", overflow="fold")
    for title in ("mass kg", "drift mm", "drift deg", "unbalanced", "gap mm", "air mm", "excess mm"):
        table.add_column(title, justify="right")
    for obj in scene.objects:
        drift = drifts.get(obj.name)
        residual = verification.certificate.residuals.get(obj.name)
        table.add_row(
            obj.name,
            ("fixed by the user, afloat" if obj.name in verification.penetration.afloat else "fixed")
            if obj.fixed
            else ", ".join(scene.carriers(obj.name)),
            f"{obj.asset.mass_properties.mass:.3g}",
            "-" if drift is None else f"{max(drift.centre_mm, drift.origin_mm):.3f}",
            "-" if drift is None else f"{drift.degrees:.3f}",
            "-" if residual is None else f"{residual:.0e}",
            f"{1e3 * gaps[obj.name]:.3f}" if obj.name in gaps else "-",
            _millimetres(support and support.air, obj.name),
            _millimetres(support and support.excess, obj.name),
        )
    target.print(table)
    target.print()
    certificate, overlaps, mujoco = verification.certificate, verification.penetration, verification.mujoco
    least = certificate.smallest_friction
    margin = "" if least is None else f"; holds down to {least:.3g}" if math.isfinite(least) else "; holds at none"
    if certificate.largest_tilt is not None and not certificate.unbalanced:
        margin += f"; stands a tilt of {_tilt(certificate)}"
    held = [found for found in verification.relations if found.holds]
    verdicts = {
        "equilibrium": "pass" if certificate.passed else "FAIL",
        "intersections": "pass" if overlaps.passed else "FAIL",
        "MuJoCo": "pass" if mujoco.passed else "FAIL",
        "relations": "FAIL" if verification.broken or verification.unmet else "pass",
    }
    texts = {
        "equilibrium": f"unbalanced by at most {certificate.worst:.0e} of the weight at friction "
        f"{certificate.friction:g}{margin}",
        "intersections": f"{len(overlaps.hulls)} pairs of hulls, {len(overlaps.visuals)} of surfaces; "
        f"{overlaps.volume_ratio:.2g} of the volume shared",
        "MuJoCo": f"{mujoco.version}, {mujoco.seconds:g} s: at most {mujoco.worst_mm:.3f} mm and "
        f"{mujoco.worst_degrees:.3f} degrees{_creep(mujoco)}; {len(mujoco.warnings)} warnings",
        "relations": f"{len(held)} of {len(verification.relations)} hold",
    }
    for name, verdict in verdicts.items():
        target.print(verdict, style={"pass": "green", "FAIL": "bold red"}[verdict], end="  ")
        target.print(f"{name}: {texts[name]}", markup=False)
    for name, rolls in (support.rolling if support else {}).items():
        if rolls != "stable":
            target.print(
                f"      {name}: {rolls} on its round side; flat sides of its convex part hold it", markup=False
            )


def _millimetres(lengths: Mapping[str, float] | None, name: str) -> str:
    """The length [m] of object `name` in millimetres, or a dash."""
    return f"{1e3 * lengths[name]:.1f}" if lengths and name in lengths else "-"


def _tilt(certificate: Certificate) -> str:
    """The tilt that a scene stands, and what does not stand more."""
    first = certificate.first_to_go
    after = f", then {', '.join(first)} {'goes' if len(first) == 1 else 'go'}" if first else " at least"
    return f"{certificate.largest_tilt:.2g} degrees{after}"


def show_parity(target: Console, reports: Mapping[str, ParityReport]) -> None:
    """One line for every format of a scene folder."""
    for name, report in reports.items():
        readers = ", ".join(reading.reader for reading in report.readings)
        target.print("pass" if report.passed else "FAIL", style="green" if report.passed else "bold red", end="  ")
        target.print(f"{name}: read back by {readers}; off by at most {report.largest:.0e}", markup=False)


def show_engines(target: Console, scene: Scene, verdicts: Sequence[Verdict]) -> None:
    """The drift of every object in every engine, and the settings they ran with."""
    from rich.table import Table

    from pat3d.check.engines.protocol import Absent, Failed

    runs = [verdict for verdict in verdicts if not isinstance(verdict, Absent | Failed)]
    table = Table(box=None, pad_edge=False, header_style="bold")
    creeps = any(run.worst_creep_mm is not None for run in runs)
    table.add_column("mm, degrees" + ("; and a minute at the end" if creeps else ""), overflow="fold")
    for run in runs:
        table.add_column(f"{run.engine} {run.version}", justify="right", overflow="fold")
    drifts = [{obj.name: obj for obj in run.objects} for run in runs]
    for obj in scene.objects:
        table.add_row(obj.name, *(_drifted(drift.get(obj.name)) for drift in drifts))
    if runs:
        target.print(table)
        target.print()
    for verdict in verdicts:
        if isinstance(verdict, Absent):
            target.print("none", style="yellow", end="  ")
            target.print(f"{verdict.engine}: {verdict.reason}", markup=False)
        elif isinstance(verdict, Failed):
            target.print("FAIL", style="bold red", end="  ")
            target.print(verdict.reason, markup=False)
        else:
            settings = ", ".join(f"{key} {value}" for key, value in verdict.settings.items())
            style = "green" if verdict.passed else "bold red"
            target.print("pass" if verdict.passed else "FAIL", style=style, end="  ")
            target.print(
                f"{verdict.engine} {verdict.version}, {verdict.seconds:g} s in {verdict.wall_seconds:.1f} s: at most "
                f"{verdict.worst_mm:.3f} mm and {verdict.worst_degrees:.3f} degrees{_creep(verdict)} ({settings})",
                markup=False,
            )


def _drifted(obj: ObjectDrift | None) -> str:
    """How far an object strayed in a run, and how fast it still moves at its end where that is known."""
    if obj is None:
        return "fixed"
    text = f"{max(obj.centre_mm, obj.origin_mm):.3f}, {obj.degrees:.3f}"
    return text if obj.creep_mm is None else f"{text}; {obj.creep_mm:.2g}, {obj.creep_degrees:.2g}"


def _creep(report: SettleReport) -> str:
    """How fast the fastest object still moves at the end of a run."""
    if report.worst_creep_mm is None or report.worst_creep_degrees is None:
        return ""
    return f", at the end {report.worst_creep_mm:.2g} mm and {report.worst_creep_degrees:.2g} degrees a minute"


def show_settings(target: Console, reports: Sequence[SettingReport]) -> None:
    """A row for every way to simulate the scene."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("MuJoCo with", overflow="fold")
    for title in ("drift mm", "drift deg", "mm/min", "deg/min"):
        table.add_column(title, justify="right")
    table.add_column("")
    for one in reports:
        report = one.report
        creep = (report.worst_creep_mm, report.worst_creep_degrees)
        table.add_row(
            one.setting.title,
            f"{report.worst_mm:.3f}",
            f"{report.worst_degrees:.3f}",
            *("-" if value is None else f"{value:.2g}" for value in creep),
            "[green]stands[/]" if report.passed else "[bold red]moves[/]",
        )
    target.print(table)
    target.print(
        f"\n{reports[0].report.seconds:g} s each; what stands strays less than 1 mm and 1 degree. Verified is the "
        "scene as written.",
        markup=False,
    )


def show_report(target: Console, report: Report, folder: Path) -> None:
    """The summary that ends a run."""
    from pat3d.generation.optimize_stage import TORCH, available

    chosen = report.chosen
    best = chosen.best
    show_verification(target, chosen.checked.scene, chosen.checked.verification)
    show_optimisation(target, chosen.checked.settled.optimisation)
    show_parity(target, report.exports)
    for note in (*_said_back(report.understood), *best.notes):
        target.print(f"note  {note}", markup=False)
    if report.failures and chosen.checked.settled.optimisation is None and not available():
        target.print(f"note  the layout was not optimised, for want of torch: {TORCH}", markup=False)
    if len(chosen.tried) > 1:
        target.print(f"note  attempt {best.number + 1} of {len(chosen.tried)} was kept", markup=False)
    for line in _critic_words(report.critic):
        target.print(line, markup=False)
    if report.reused:
        target.print(f"note  taken from an earlier run: {', '.join(report.reused)}", markup=False)
    target.print(f"\n{report.seconds['total']:.1f} s in all; written to:", markup=False)
    mains = [f"{name}/{Path(export.path).name}" for name, export in report.exports.items()]
    show_files(target, folder, mains)


def _critic_words(critic: Mapping[str, Any] | None) -> tuple[str, ...]:
    """What a critic said of the scene that was kept, and what came of planning again."""
    if critic is None:
        return ()
    rounds = critic["rounds"]
    kept = next(one for one in rounds if one["kept"])
    answers = kept["answers"]
    agreed = sum(one["answer"] == "yes" for one in answers)
    lines = [f"critic  {critic['model']}: yes to {agreed} of {len(answers)} questions"]
    lines += [f"critic  {one['question']} {one['answer']}: {one['seen']}" for one in answers if one["answer"] != "yes"]
    if len(rounds) > 1:
        lines.append(f"critic  planned once more; {'that' if rounds[1]['kept'] else 'the first'} scene was kept")
    return tuple(lines)


def _said_back(understood: Mapping[str, Any]) -> tuple[str, ...]:
    """What the planner assumed or left out, and what it took for scenery."""
    aside = "; ".join(understood.get("set_aside", ()))
    other = understood.get("otherwise")
    return (
        *understood.get("notes", ()),
        *((f"set aside: {aside}",) if aside else ()),
        *((f"it may also be read so: {other}",) if other else ()),
    )


def show_optimized(target: Console, outcome: Outcome) -> None:
    """The summary that ends `pat3d optimize`."""
    _show_edited(target, outcome.edited)
    if outcome.verification is None:
        if outcome.skipped:
            target.print("every relation holds already; the scene is left as it is", markup=False)
        else:
            show_optimisation(target, outcome.optimized.record(kept=False))
            target.print("the scene is left as it is", markup=False)
        return
    show_verification(target, outcome.scene, outcome.verification)
    if outcome.skipped:
        target.print("every relation holds where the edited scene came to rest", markup=False)
    else:
        show_optimisation(target, outcome.optimized.record(kept=outcome.optimized.settled is not None))
    target.print(f"\n{outcome.seconds:.1f} s in all; written to:", markup=False)
    show_files(target, outcome.folder)


def show_settled(target: Console, outcome: SettledOutcome) -> None:
    """The summary that ends `pat3d settle`."""
    _show_edited(target, outcome.edited)
    show_verification(target, outcome.scene, outcome.written.verification)
    name, metres = max(outcome.moved.items(), key=lambda item: item[1])
    target.print(f"came to rest at most {_length(metres)} from where it was put ({name})", markup=False)
    target.print(f"\n{outcome.seconds:.1f} s in all; written to:", markup=False)
    show_files(target, outcome.folder)


def _show_edited(target: Console, names: Sequence[str]) -> None:
    if names:
        target.print(f"note  edited since it settled: {', '.join(names)}", markup=False)


def show_many(target: Console, rows: Sequence[Row]) -> None:
    """A line for every prompt of a file."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("scene", overflow="fold")
    for title in ("objects", "drift mm", "s"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("")
    colours = {"verified": "green", "faulty": "bold red", "refused": "bold red"}
    for row in rows:
        figures = ("-", "-", "-")
        if row.state != "refused":
            figures = (str(row.objects), f"{row.drift_mm:.3f}", "kept" if row.kept else f"{row.seconds:.1f}")
        said = f": {row.message}".replace("[", r"\[") if row.message else ""
        table.add_row(row.folder, *figures, f"[{colours[row.state]}]{row.state}[/]{said}")
    target.print(table)
    good = sum(row.state == "verified" for row in rows)
    target.print(f"\n{good} of {len(rows)} scenes verified", markup=False)


def show_optimisation(target: Console, record: Mapping[str, Any] | None) -> None:
    """What an optimisation did, from its record; nothing where there was none."""
    from pat3d.generation.optimize_stage import in_words

    if record is not None:
        target.print(f"optimisation: {in_words(record)}", markup=False)


def show_files(target: Console, folder: Path, exports: Sequence[str] = ("mjcf/scene.xml",)) -> None:
    """The files of a scene folder that a person would open."""
    from pat3d.generation.optimize_stage import PICTURES

    for name in ("scene.json", *exports, "report.json", "preview.png", *PICTURES):
        if (folder / name).is_file():
            target.print(f"  {folder / name}", markup=False, soft_wrap=True)
