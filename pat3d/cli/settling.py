"""`pat3d settle`: finished scene folders whose poses were edited."""

from __future__ import annotations

import argparse

from pat3d.cli.console import console, show_settled, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, fields, option
from pat3d.generation.settings import DEVICES, Settings

SCENE = option("folder", "scene folder that generate or build wrote", metavar="SCENE")
OUT = option("--out", "scene folder to write", metavar="FOLDER", shown="SCENE is replaced")
DEVICE = fields(Settings, {"device": {"choices": DEVICES}}, device="where to simulate")


@command(
    SCENE,
    OUT,
    *DEVICE,
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
