"""`pat3d check`: a scene folder verified again, here or in other engines."""

from __future__ import annotations

import argparse
from pathlib import Path

from pat3d.cli.console import console, show_engines, show_settings, show_verification, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, option
from pat3d.errors import SpecError
from pat3d.scene.physics import STILL_SECONDS

MAX_SECONDS = 600.0


@command(
    option("folder", "what generate or build wrote", metavar="FOLDER"),
    option(
        "--engines",
        "measure the drift in these engines instead: mujoco, mujoco-oldest, mujoco-newest, newton-mujoco, newton-xpbd, "
        "newton (both), pybullet, drake, physx, or all that are here",
        nargs="+",
        metavar="ENGINE",
    ),
    option(
        "--settings",
        "tell instead what still stands in MuJoCo with other integrators, solvers, cones, time steps and contact "
        "parameters: all, or some of them",
        nargs="+",
        metavar="SETTING",
    ),
    option("--record", "add what the engines did to FOLDER/report.json, the last run of each", action="store_true"),
    JSON,
    option("--seconds", "simulated time; 60 to see what creeps", type=float, default=STILL_SECONDS),
    examples="""
    pat3d check scenes/mug
    pat3d check scenes/mug --seconds 60                    a minute: what creeps?
    pat3d check scenes/mug --engines mujoco,newton,pybullet,drake,physx
    pat3d check scenes/mug --engines all --seconds 60 --record    what creeps where, kept in report.json
    pat3d check scenes/mug --settings all                  other integrators, solvers, time steps: what still stands?
    """,
)
def check(options: argparse.Namespace) -> int:
    """`pat3d check`: everything in the folder; with --engines or --settings, only those."""
    if not 0.0 < options.seconds <= MAX_SECONDS:
        raise SpecError(
            f"--seconds {options.seconds:g}: give a simulated time of more than 0 and at most {MAX_SECONDS:g} s."
        )
    if options.json and (options.engines or options.settings):
        raise SpecError("--json tells of the whole check; leave out --engines and --settings.")
    if options.record and not options.engines:
        raise SpecError("--record keeps what other engines did; give --engines, such as --engines all.")
    if options.engines:
        return _check_engines(options)
    if options.settings:
        return _check_settings(options)
    from pat3d.check.folder import check_folder

    with watch(console(stderr=True)) as progress:
        report = check_folder(options.folder, seconds=options.seconds, progress=progress)
    if options.json and report.scene is not None:
        from pat3d.generation.facts import outcome_facts

        facts = outcome_facts(
            report.scene,
            folder=options.folder,
            failures=report.failures,
            verification=report.verification,
            notes=report.notes,
        )
        print_facts(facts)
        return verdict(report.failures)
    if report.scene is not None and report.verification is not None:
        show_verification(console(), report.scene, report.verification)
    for note in report.notes:
        console().print(f"note  {note}", markup=False)
    return verdict(report.failures)


def _check_settings(options: argparse.Namespace) -> int:
    """What still stands otherwise; fails only when the scene as it is written does not."""
    from pat3d.check.settings import check_settings, chosen_settings

    settings, path = chosen_settings(options.settings), Path(options.folder) / "mjcf" / "scene.xml"
    with watch(console(stderr=True)) as progress:
        reports = check_settings(path, settings, seconds=options.seconds, progress=progress)
    show_settings(console(), reports)
    return 0 if reports[0].report.passed else 1


def _check_engines(options: argparse.Namespace) -> int:
    """The drift table. An engine that is named and absent is a failure; with "all", those that are here count."""
    from pat3d.check.engines.check import check_engines, failures
    from pat3d.check.engines.protocol import Absent
    from pat3d.check.engines.record import record
    from pat3d.check.engines.registry import chosen
    from pat3d.scene.io import load_scene

    engines, folder = chosen(options.engines), Path(options.folder)
    named = {engine.title for engine in chosen([name for name in _words(options.engines) if name != "all"])}
    scene = load_scene(folder)
    with watch(console(stderr=True)) as progress:
        verdicts = check_engines(scene, engines, folder, seconds=options.seconds, progress=progress)
    show_engines(console(), scene, verdicts)
    if options.record:
        console().print(f"recorded in {record(folder, engines, verdicts)}", markup=False)
    absent = [one for one in verdicts if isinstance(one, Absent)]
    lines = [f"{one.engine} was asked for and is not here: {one.reason}" for one in absent if one.engine in named]
    if len(absent) == len(verdicts):
        lines.append("none of these engines is installed; nothing was measured.")
    return verdict((*failures(verdicts), *lines))


def _words(names: list[str]) -> list[str]:
    return [word.strip() for name in names for word in name.split(",")]
