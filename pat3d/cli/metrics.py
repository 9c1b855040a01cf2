"""`pat3d metrics`: the paper's D and R of scenes, whoever made them."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING

from pat3d.cli.console import console, watch
from pat3d.cli.json_output import JSON
from pat3d.cli.options import command, option
from pat3d.scene.folder import write_json

if TYPE_CHECKING:
    from pat3d.check.metrics.table import Geometry


@command(
    option("scenes", "scene folders, GLB files whose nodes are objects, folders of meshes", nargs="+", metavar="SCENE"),
    option("--report", "write everything that was found here, as JSON", metavar="OUT.json"),
    option("--device", "cpu or cuda", default="cpu"),
    JSON,
    examples="""
    pat3d metrics scenes/mug
    pat3d metrics theirs.glb meshes_of_a_scene --report metrics.json
    """,
    notes="D is the mean path of the vertices until rest, over the scene's diagonal; R the pairs of triangles of "
    "different objects that pass through each other, times edge length over diagonal. Both are 0 for a scene at rest "
    "without intersections.",
)
def metrics(options: argparse.Namespace) -> int:
    """`pat3d metrics`."""
    from pat3d.check.metrics.subject import load_subject
    from pat3d.check.metrics.table import measure, report_of

    subjects = [load_subject(path) for path in options.scenes]
    with watch(console(stderr=True)) as progress:
        found = [measure(subject, device=options.device, progress=progress) for subject in subjects]
    data = report_of(found)
    if options.report:
        write_json(Path(options.report), data)
    if options.json:
        print(json.dumps(data, indent=2, allow_nan=False, ensure_ascii=False))
    else:
        show(found)
    return 0


def show(found: list[Geometry]) -> None:
    """Print a row for every scene, and how it was found."""
    from rich.table import Table

    table = Table(box=None, pad_edge=False, header_style="bold")
    table.add_column("scene", overflow="fold")
    for title in ("objects", "D", "simulated by", "R", "R as delivered"):
        table.add_column(title, justify="right", no_wrap=True)
    for one in found:
        moved = one.displacement
        table.add_row(
            one.name,
            str(one.objects),
            f"{moved.value:.4f}" if math.isfinite(moved.value) else "exploded",
            f"{moved.engine}, {moved.frames} frames",
            "absent" if one.remeshed is None else f"{one.remeshed.value:.2f}",
            f"{one.delivered.value:.2f}",
        )
    target = console()
    target.print(table)
    for one in found:
        moved = one.displacement
        lines = [f"MuJoCo simulated it, because {moved.why}"] if moved.why else []
        lines += [] if moved.at_rest else [f"it was still moving after {moved.frames} frames"]
        lines += [f"R is absent: {one.absent}"] if one.absent else []
        for line in (*lines, *one.notes):
            target.print(f"note  {one.name}: {line}", markup=False)
