"""`pat3d import`: scenes and objects of other programs as scene folders."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from pat3d.cli.console import console, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import DEGREES, LEAST_TILT, command, fields, option
from pat3d.exporters.formats import FORMATS
from pat3d.generation.settings import DEVICES, Settings

if TYPE_CHECKING:
    from pat3d.generation.import_folder import ImportOutcome

MOST_ROWS, MOST_NOTES = 60, 12


@command(
    option("source", "an MJCF, URDF, SDF or USD file, or a folder that holds one", metavar="SOURCE"),
    option("--out", "scene folder to write", metavar="FOLDER", required=True),
    option("--settle", "bring it to rest, and verify it", action="store_true"),
    option(
        "--joints",
        "what has joints: the scene is refused, it stands still where it is, or it is left out",
        choices=("refuse", "fix", "leave-out"),
        default="refuse",
    ),
    option("--keyframe", "of MJCF, name or number", metavar="NAME", shown="the file's poses"),
    option("--root", "folder that meshes and pictures may lie in", metavar="FOLDER", shown="the one above the file's"),
    option("--formats", "exchange formats to write too", nargs="+", metavar="FORMAT", default=("mjcf",)),
    option("--cpu-limit", "processor time for decompositions", type=float, metavar="SECONDS", shown="none"),
    *fields(
        Settings,
        {"friction": {"metavar": "MU"}, "least_tilt": DEGREES, "device": {"choices": DEVICES}},
        friction="of every contact while settling",
        least_tilt=LEAST_TILT,
        device="where to settle",
    ),
    JSON,
    examples="""
    pat3d import kitchen.xml --out scenes/kitchen                  as the file has it
    pat3d import kitchen.usd --settle --out scenes/kitchen         at rest, and verified
    pat3d import lift.xml --joints leave-out --settle --out scenes/lift      without its robot
    pat3d import models/mug/ --out scenes/mug                      the folder of one SDF model
    """,
    notes=f"Then settle, check, edit and export take the folder. Formats: {', '.join(FORMATS)}.",
)
def import_(options: argparse.Namespace) -> int:
    """`pat3d import`."""
    from pat3d.generation.import_folder import import_folder

    with watch(console(stderr=True)) as progress:
        outcome = import_folder(
            options.source,
            out=options.out,
            root=options.root,
            keyframe=options.keyframe,
            joints=options.joints,
            settle=options.settle,
            friction=options.friction,
            least_tilt=options.least_tilt,
            cpu_limit=options.cpu_limit,
            device=options.device,
            formats=options.formats,
            progress=progress,
        )
    if options.json:
        from pat3d.generation.facts import outcome_facts

        facts = outcome_facts(
            outcome.scene,
            folder=options.out,
            failures=outcome.failures,
            verification=outcome.settled.verification if outcome.settled else None,
            exports=outcome.exports,
            notes=outcome.imported.notes,
        )
        print_facts(facts)
    else:
        show(outcome)
    return verdict(outcome.failures)


def show(outcome: ImportOutcome) -> None:
    """Print a row for every object, what was changed, and what to do next."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("object", overflow="fold")
    for title in ("cm", "kg", "friction", "parts"):
        table.add_column(title, justify="right", no_wrap=True)
    table.add_column("moved by settling" if outcome.settled else "")
    for obj in outcome.scene.objects[:MOST_ROWS]:
        asset, moved = obj.asset, outcome.moved.get(obj.name)
        table.add_row(
            obj.name,
            " x ".join(f"{100 * side:.3g}" for side in asset.size),
            f"{asset.mass_properties.mass:.4g}",
            f"{asset.material.friction:.3g}",
            str(len(asset.parts)),
            "fixed" if obj.fixed else "" if moved is None else f"{1e3 * moved:.2f} mm",
        )
    target, read = console(), outcome.imported
    target.print(table)
    more = len(outcome.scene.objects) - MOST_ROWS
    if more > 0:
        target.print(f"and {more} objects more", markup=False)
    target.print(f"{read.format}: {read.kept} collision shapes as they are, {read.cut} cut anew", markup=False)
    if read.left_out:
        target.print(f"left out, since they have joints: {', '.join(read.left_out)}", markup=False)
    for note in read.notes[:MOST_NOTES]:
        target.print(f"note  {note}", markup=False)
    if len(read.notes) > MOST_NOTES:
        target.print(f"and {len(read.notes) - MOST_NOTES} notes more, in report.json", markup=False)
    target.print(f"\nwritten to {outcome.folder}", markup=False, soft_wrap=True)
    if outcome.settled is None:
        target.print("`pat3d settle` brings it to rest, `pat3d check` verifies it as it is.", markup=False)
