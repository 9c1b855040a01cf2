"""`pat3d optimize`: finished scene folders whose relations broke."""

from __future__ import annotations

import argparse

from pat3d.cli.console import console, show_optimized, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, fields
from pat3d.cli.settling import DEVICE, OUT, SCENE
from pat3d.generation.optimize_stage import available, missing

# The options need the defaults of the optimisation, which loads its packages.
from pat3d.optimize.optimize import OptimizeOptions


@command(
    SCENE,
    OUT,
    *fields(
        OptimizeOptions,
        {"seed": {"default": None, "shown": "the scene's"}},
        epochs="gradient steps at most; 0 for none",
        starts="layouts tried before gradients, the scene's own among them",
        seed="of the layouts tried",
    ),
    *DEVICE,
    JSON,
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
    if options.json:
        from pat3d.cli.documents import optimized_facts
        from pat3d.generation.facts import outcome_facts

        facts = outcome_facts(
            outcome.scene,
            folder=outcome.folder,
            failures=outcome.failures,
            verification=outcome.verification,
            exports=outcome.exports,
            seconds=outcome.seconds,
        )
        kept = outcome.optimized.settled is not None
        print_facts(optimized_facts(facts, outcome.optimized.record(kept=kept), outcome.edited))
    else:
        show_optimized(console(), outcome)
    return verdict(outcome.failures)
