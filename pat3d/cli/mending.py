"""`pat3d settle` and `pat3d optimize`: finished scene folders whose poses were edited, or whose relations broke."""

from __future__ import annotations

import argparse

from pat3d.cli.console import console, show_optimized, show_settled, verdict, watch
from pat3d.cli.machines import JSON, print_facts
from pat3d.cli.options import command, fields, option
from pat3d.generation.optimize_stage import available, missing
from pat3d.generation.settings import DEVICES, Settings

# The options need the defaults of the optimisation, which loads its packages.
from pat3d.optimize.optimize import OptimizeOptions

_SCENE = option("folder", "scene folder that generate or build wrote", metavar="SCENE")
_OUT = option("--out", "scene folder to write", metavar="FOLDER", shown="SCENE is replaced")
_DEVICE = fields(Settings, {"device": {"choices": DEVICES}}, device="where to simulate")


@command(
    _SCENE,
    _OUT,
    *_DEVICE,
    JSON,
    examples="""
    pat3d settle scenes/desk                     after you edited poses in scenes/desk/scene.json
    pat3d settle scenes/desk --out scenes/desk2  write another folder, leave this one as it is
    """,
)
def settle(options: argparse.Namespace) -> int:
    """`pat3d settle`."""
    from pat3d.generation.settle_folder import settle_folder

    with watch(console(stderr=True)) as progress:
        outcome = settle_folder(options.folder, out=options.out, device=options.device, progress=progress)
    if options.json:
        from pat3d.generation.facts import outcome_facts

        facts = outcome_facts(
            outcome.scene,
            folder=options.out or options.folder,
            failures=outcome.written.failures,
            verification=outcome.written.verification,
            exports=outcome.written.exports,
            seconds=outcome.seconds,
        )
        print_facts(facts)
    else:
        show_settled(console(), outcome)
    return verdict(outcome.written.failures)


@command(
    _SCENE,
    _OUT,
    *fields(
        OptimizeOptions,
        {"seed": {"default": None, "shown": "the scene's"}},
        epochs="gradient steps at most; 0 for none",
        starts="layouts tried before gradients, the scene's own among them",
        seed="of the layouts tried",
    ),
    *_DEVICE,
    examples="""
    pat3d optimize scenes/tower                    mend the scene in its folder
    pat3d optimize scenes/tower --out scenes/mend  write another folder, leave this one as it is
    pat3d optimize scenes/tower --starts 1         gradient steps from the scene's own layout only
    """,
)
def optimize(options: argparse.Namespace) -> int:
    """`pat3d optimize`."""
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
    show_optimized(console(), outcome)
    return verdict(outcome.failures)
