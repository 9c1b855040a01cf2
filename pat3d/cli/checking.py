"""`pat3d check`: a scene folder verified again, here or in other engines."""

from __future__ import annotations

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path

from pat3d.cli.console import console, show_engines, show_verification, verdict, watch
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
    option("--seconds", "simulated time with --engines", type=float, default=STILL_SECONDS),
    examples="""
    pat3d check scenes/mug
    pat3d check scenes/mug --engines mujoco,newton,pybullet,drake,physx
    """,
)
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
    return verdict(tuple(failures))


def _check_engines(options: argparse.Namespace) -> int:
    """The drift table. An engine that is named and absent is a failure; with "all", those that are here count."""
    from pat3d.check.engines.check import check_engines, failures
    from pat3d.check.engines.protocol import Absent
    from pat3d.check.engines.registry import chosen
    from pat3d.scene.io import load_scene

    if not 0.0 < options.seconds <= MAX_SECONDS:
        raise SpecError(
            f"--seconds {options.seconds:g}: give a simulated time of more than 0 and at most {MAX_SECONDS:g} s."
        )
    engines, folder = chosen(options.engines), Path(options.folder)
    named = {engine.title for engine in chosen([name for name in _words(options.engines) if name != "all"])}
    scene = load_scene(folder)
    with watch(console(stderr=True)) as progress:
        verdicts = check_engines(scene, engines, folder, seconds=options.seconds, progress=progress)
    show_engines(console(), scene, verdicts)
    absent = [one for one in verdicts if isinstance(one, Absent)]
    lines = [f"{one.engine} was asked for and is not here: {one.reason}" for one in absent if one.engine in named]
    if len(absent) == len(verdicts):
        lines.append("none of these engines is installed; nothing was measured.")
    return verdict((*failures(verdicts), *lines))


def _words(names: list[str]) -> list[str]:
    return [word.strip() for name in names for word in name.split(",")]
