"""What each command of `pat3d` does; options are those of `pat3d.cli.main`."""

from __future__ import annotations

import argparse
import json
import tempfile
from dataclasses import replace
from pathlib import Path

from pat3d.cli.console import console, show_mended, show_report, show_verification, watch
from pat3d.cli.reading import AskingPlanner, Decided
from pat3d.errors import SpecError
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import tell


def generate(options: argparse.Namespace) -> int:
    """`pat3d generate`."""
    from pat3d.generation.pipeline import Settings, run_prompt

    if options.out is None:
        raise SpecError("give the folder to write: --out scenes/NAME.")
    settings = Settings(
        seed=options.seed,
        friction=options.friction,
        device=options.device,
        formats=tuple(options.formats),
        resume=options.resume,
    )
    plan = (AskingPlanner if options.ask else GrammarPlanner)(options.allow_proxies).plan(options.prompt)
    console(stderr=True).print(tell(plan), markup=False, soft_wrap=True)
    with watch(console(stderr=True)) as progress:
        outcome = run_prompt(
            options.prompt,
            out=options.out,
            settings=settings,
            allow_proxies=options.allow_proxies,
            planner=Decided(plan),
            progress=progress,
        )
    return _finished(outcome, options.out)


def build(options: argparse.Namespace) -> int:
    """`pat3d build`."""
    if options.schema:
        from pat3d.generation.spec_schema import BUILD_SCHEMA

        print(json.dumps(BUILD_SCHEMA, indent=2))
        return 0
    from pat3d.generation.pipeline import run_spec

    if options.spec is None or options.out is None:
        raise SpecError("give the specification and the folder to write: pat3d build scene.yaml --out scenes/NAME.")
    with watch(console(stderr=True)) as progress:
        outcome = run_spec(
            options.spec,
            out=options.out,
            seed=options.seed,
            friction=options.friction,
            device=options.device,
            formats=tuple(options.formats),
            resume=options.resume,
            progress=progress,
        )
    return _finished(outcome, options.out)


def optimize(options: argparse.Namespace) -> int:
    """`pat3d optimize`."""
    from pat3d.generation.optimize_stage import available, missing

    if not available():
        raise missing()
    from pat3d.generation.optimize_folder import optimize_folder

    with watch(console(stderr=True)) as progress:
        outcome = optimize_folder(
            options.folder,
            out=options.out,
            epochs=options.epochs,
            starts=options.starts,
            seed=options.seed,
            device=options.device,
            progress=progress,
        )
    show_mended(console(), outcome)
    return _verdict(outcome.failures)


def _finished(outcome, out: str) -> int:
    show_report(console(), outcome.report, Path(out))
    return _verdict(outcome.report.failures)


def _verdict(failures: tuple[str, ...]) -> int:
    errors = console(stderr=True)
    for line in failures:
        errors.print(f"pat3d: {line}", markup=False, soft_wrap=True)
    return 1 if failures else 0


def check(options: argparse.Namespace) -> int:
    """`pat3d check`: the scene of scene.json, and the MJCF as it is in the folder; with --engines, only those."""
    if options.engines:
        return _check_engines(options)
    from pat3d.check.settle import settle_in_mujoco
    from pat3d.check.verification import verify
    from pat3d.exporters.compare import differences
    from pat3d.exporters.mjcf.writer import write_mjcf
    from pat3d.scene.io import load_scene

    folder = Path(options.folder)
    scene = load_scene(folder)
    delivered = folder / "mjcf" / "scene.xml"
    with watch(console(stderr=True)) as progress, tempfile.TemporaryDirectory(prefix="pat3d-check-") as scratch:
        verification = verify(scene, write_mjcf(scene, Path(scratch) / "mjcf"), progress)
        failures = list(verification.failures)
        if delivered.is_file():
            failures += differences(scene, delivered)
            found = replace(verification, mujoco=settle_in_mujoco(delivered))
            failures += [f"{line} ({delivered})" for line in found.failures if line not in verification.failures]
    show_verification(console(), scene, verification)
    if not delivered.is_file():
        console().print(f"note  there is no {delivered}; what would be written there was checked.", markup=False)
    return _verdict(tuple(failures))


def _check_engines(options: argparse.Namespace) -> int:
    """`pat3d check --engines`: the drift table; absent engines are told, and fail only when none is here."""
    from pat3d.check.engines.check import check_engines, failures
    from pat3d.check.engines.protocol import Absent
    from pat3d.check.engines.registry import chosen
    from pat3d.cli.console import show_engines
    from pat3d.scene.io import load_scene

    if not 0.0 < options.seconds <= 600.0:
        raise SpecError(f"--seconds {options.seconds:g}: give a simulated time of more than 0 and at most 600 s.")
    engines, folder = chosen(options.engines), Path(options.folder)
    scene = load_scene(folder)
    with watch(console(stderr=True)) as progress:
        verdicts = check_engines(scene, engines, folder, seconds=options.seconds, progress=progress)
    show_engines(console(), scene, verdicts)
    lines = failures(verdicts)
    if all(isinstance(verdict, Absent) for verdict in verdicts):
        lines += ("none of these engines is installed; nothing was measured.",)
    return _verdict(lines)


def export(options: argparse.Namespace) -> int:
    """`pat3d export`."""
    from pat3d.cli import export as export_command

    return export_command.run(options)


def catalogue(options: argparse.Namespace) -> int:
    """`pat3d catalogue`."""
    from pat3d.cli import catalogue as browse

    if options.name is not None:
        return browse.one(options.name, seed=options.seed, out=options.out)
    if options.out is not None:
        raise SpecError("--out is the picture of one object; name it, or use --sheet for pictures of everything.")
    return browse.everything(seed=options.seed, sheet=options.sheet)


def suite(options: argparse.Namespace) -> int:
    """`pat3d suite`."""
    from pat3d.cli import suites

    return suites.run(options)


def doctor(options: argparse.Namespace) -> int:
    """`pat3d doctor`."""
    from pat3d.cli.doctor import examine

    return examine(console())


def evaluate(options: argparse.Namespace) -> int:
    """`pat3d evaluate`."""
    from pat3d.cli import evaluation as commands

    return commands.evaluate(options)


def compare(options: argparse.Namespace) -> int:
    """`pat3d compare`."""
    from pat3d.cli import evaluation as commands

    return commands.compare(options)


def leaderboard(options: argparse.Namespace) -> int:
    """`pat3d leaderboard`."""
    from pat3d.cli import evaluation as commands

    return commands.leaderboard(options)


def replay(options: argparse.Namespace) -> int:
    """`pat3d replay`."""
    from pat3d.cli import evaluation as commands

    return commands.replay(options)


def train(options: argparse.Namespace) -> int:
    """`pat3d train`."""
    from pat3d.cli import evaluation as commands

    return commands.train(options)


def demonstrate(options: argparse.Namespace) -> int:
    """`pat3d demonstrate`."""
    from pat3d.cli import evaluation as commands

    return commands.demonstrate(options)
