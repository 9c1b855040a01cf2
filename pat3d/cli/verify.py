"""`pat3d verify`: the initial state of a scene that somebody else wrote, judged and, if wished, settled."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from pat3d.cli.console import console, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, option
from pat3d.errors import CheckError, SpecError
from pat3d.progress import Event
from pat3d.scene.folder import write_json
from pat3d.scene.physics import STILL_SECONDS

if TYPE_CHECKING:
    from pat3d.check.foreign.settling import SettledForeign
    from pat3d.check.foreign.verify import ForeignReport

MAX_SECONDS = 600.0
MOST_ROWS = 60


@command(
    option("file", "a scene as MJCF, URDF, SDF or USD", metavar="FILE"),
    option("--keyframe", "name or number of the keyframe to start from", metavar="NAME", shown="the file's poses"),
    option("--seconds", "simulated time", type=float, default=STILL_SECONDS),
    option("--settle", "write the nearest layout at rest here, as MJCF", metavar="OUT.xml"),
    option("--report", "write everything that was found here, as JSON", metavar="OUT.json"),
    JSON,
    examples="""
    pat3d verify scene.xml
    pat3d verify scene.xml --keyframe home --seconds 60
    pat3d verify kitchen.usd --report kitchen.json
    pat3d verify scene.xml --settle settled.xml          what overlaps or floats comes to rest; robots stay
    """,
)
def verify(options: argparse.Namespace) -> int:
    """`pat3d verify`."""
    from pat3d.check.foreign.load import load_foreign
    from pat3d.check.foreign.settling import settle_foreign, write_settled
    from pat3d.check.foreign.verify import verify_foreign

    if not 0.0 < options.seconds <= MAX_SECONDS:
        raise SpecError(f"--seconds {options.seconds:g}: give more than 0 and at most {MAX_SECONDS:g} s.")
    if options.settle and Path(options.settle).suffix != ".xml":
        raise SpecError(f"--settle {options.settle}: the settled scene is MJCF; give a name that ends in .xml.")
    source = Path(options.file).expanduser()
    scene = load_foreign(source)
    with watch(console(stderr=True)) as progress:
        progress(Event(stage="verifying", detail=source.name))
        report = verify_foreign(scene, keyframe=options.keyframe, seconds=options.seconds)
        settled = None
        if options.settle:
            progress(Event(stage="settling", detail=source.name))
            settled = settle_foreign(scene, keyframe=options.keyframe)
            write_settled(scene, settled, options.settle)
            progress(Event(stage="verifying", detail=Path(options.settle).name))
            again = verify_foreign(load_foreign(options.settle), seconds=options.seconds)
    if options.report:
        write_json(Path(options.report), report.as_dict())
    if options.json:
        from pat3d.cli.documents import foreign_facts

        if settled is not None:
            _require_rest(settled, Path(options.settle))
        print_facts(foreign_facts(report, None if settled is None else (options.settle, settled, again)))
        return verdict(report.failures if settled is None else again.failures)
    show(report)
    if settled is None:
        return verdict(report.failures)
    _tell(settled, Path(options.settle))
    show(again)
    return verdict(again.failures)


def show(report: ForeignReport) -> None:
    """Print a row for every free object, and what overlaps."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("object", overflow="fold")
    for title in ("kg", "not balanced", "overlaps by", "moved", "turned"):
        table.add_column(title, justify="right", no_wrap=True)
    for one in report.objects[:MOST_ROWS]:
        deep = max((pair.depth_mm for pair in report.overlaps if one.name in (pair.first, pair.second)), default=None)
        table.add_row(
            one.name,
            f"{one.mass:.3g}",
            f"{100 * one.unbalanced:.0f} %",
            "-" if deep is None else f"{deep:.2f} mm",
            f"{one.moved_mm:.2f} mm",
            f"{one.turned_degrees:.2f} deg",
        )
    target = console()
    target.print(table)
    more = len(report.objects) - MOST_ROWS
    if more > 0:
        target.print(f"and {more} objects more", markup=False)
    held = f"; {report.held} joints of robots and furniture held" if report.held else ""
    target.print(f"{report.engine}, {report.seconds:g} s{held}", markup=False)
    for note in report.notes:
        target.print(f"note  {note}", markup=False)


def _require_rest(settled: SettledForeign, out: Path) -> None:
    if not settled.at_rest:
        raise CheckError(f"the scene does not come to rest in MuJoCo; {out} holds the last state.")


def _tell(settled: SettledForeign, out: Path) -> None:
    _require_rest(settled, out)
    far = sorted(settled.moved_mm.items(), key=lambda item: -item[1])[:5]
    moved = ", ".join(f'"{name}" {millimetres:.1f} mm' for name, millimetres in far)
    console().print(f"\nsettled: {out} ({moved})\n", markup=False, soft_wrap=True)
