"""`pat3d edit` and `pat3d vary`: another scene from one that is there."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pat3d.cli.console import console, show_many, show_parity, verdict, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, fields, option
from pat3d.cli.reading import ASSETS, LIBRARIES, PLANNER, PROXIES, planner_of
from pat3d.errors import SpecError
from pat3d.generation.editing.said import EXAMPLES
from pat3d.generation.settings import DEVICES, MAX_SEED, Settings

if TYPE_CHECKING:
    from rich.console import Console

    from pat3d.generation.editing.resettling import Changes
    from pat3d.scene.history import Edit

LITTLE = 0.1
"""What moved by less than this [mm] is told in one line."""

_SCENE = option("folder", "scene folder that generate, build or edit wrote", metavar="SCENE")


class _InOrder(argparse.Action):
    """Edits of all kinds in one list, in the order of the command line."""

    def __call__(self, parser: Any, namespace: Any, values: Any, option_string: str | None = None) -> None:
        edits = [*(getattr(namespace, "edits", None) or []), ((option_string or "").removeprefix("--"), values)]
        namespace.edits = edits


def _edit(verb: str, help: str) -> Any:
    return option(f"--{verb}", f'{help}: "{EXAMPLES[verb]}"', action=_InOrder, dest="edits", metavar="WORDS")


@command(
    _SCENE,
    _edit("add", "put something new somewhere"),
    _edit("remove", "take something away"),
    _edit("move", "by lengths, or to a place"),
    _edit("turn", 'about the vertical; or "on its side", "upside down", "upright"'),
    _edit("replace", "something else in the same place"),
    _edit("scale", "a factor, a percentage, or the longest side"),
    _edit("set", "mass [kg], density [kg/m^3], friction or material"),
    _edit("fix", "hold it where it is"),
    _edit("free", "let it go"),
    option("--out", "scene folder to write", metavar="FOLDER", shown="SCENE is replaced"),
    PLANNER,
    LIBRARIES,
    ASSETS,
    PROXIES,
    *fields(Settings, {"device": {"choices": DEVICES}}, device="where to simulate"),
    JSON,
    examples="""
    pat3d edit scenes/desk --remove "bottom book" --out scenes/desk2
    pat3d edit scenes/desk --add "a coffee mug on the stack of books" --set "coffee mug: mass=0.3"
    pat3d edit scenes/desk --move "vase: 10 cm to the right" --move "red mug: onto the books"
    pat3d edit scenes/desk --replace "the lamp: a plant pot" --turn "laptop: 15 degrees" --out scenes/desk3
    """,
    notes="Edits are done in the order given, then the scene settles from where it was and is verified. One that "
    "cannot be changes no file.",
)
def edit(options: argparse.Namespace) -> int:
    """`pat3d edit`."""
    from pat3d.generation.editing.editable import load
    from pat3d.generation.editing.said import applied

    if not options.edits:
        raise SpecError('say what to edit, as in --remove "bottom book"; see pat3d edit --help.')
    with watch(console(stderr=True)) as progress:
        scene = applied(load(options.folder, planner=planner_of(options)), options.edits)
        done = scene.settle(device=options.device, progress=progress)
        out = Path(options.out if options.out is not None else options.folder)
        written = done.save(out, progress=progress)
    verified = done.verified
    if verified is None:
        return 1
    seconds = dict(verified.clock.seconds)
    if options.json:
        from pat3d.generation.facts import edited_facts, outcome_facts

        outcome = outcome_facts(
            done.scene,
            folder=out,
            failures=written.failures,
            verification=written.verification,
            exports=written.exports,
            seconds=seconds["total"],
        )
        print_facts(edited_facts(outcome, done.edits, verified.changes))
    else:
        target = console()
        show_changes(target, done.edits, verified.changes)
        show_parity(target, written.exports)
        target.print(f"\n{seconds['total']:.1f} s in all; written to: {out}", markup=False, soft_wrap=True)
    return verdict(written.failures)


@command(
    _SCENE,
    option("--count", "variations", type=int, default=10, metavar="N"),
    option("--layout", "other places, by the same relations", action="store_true"),
    option(
        "--objects",
        "same-kind: other objects of the same nouns, from the catalogue",
        choices=("same", "same-kind"),
        default="same",
    ),
    option("--materials", "other masses and friction, each within its material's range", action="store_true"),
    option("--seed", "of the variations", type=int, default=0),
    option("--out", "folder for the scenes, one folder each", metavar="FOLDER", required=True),
    *fields(Settings, {"device": {"choices": DEVICES}}, device="where to simulate"),
    JSON,
    examples="""
    pat3d vary scenes/desk --count 50 --layout --objects same-kind --materials --out suites/desks
    pat3d vary scenes/desk --count 5 --layout --out suites/places       the same command goes on where it stopped
    """,
)
def vary(options: argparse.Namespace) -> int:
    """`pat3d vary`."""
    from pat3d.generation.editing.variations import MAX_VARIATIONS, Variety, vary

    if not 1 <= options.count <= MAX_VARIATIONS:
        raise SpecError(f"--count {options.count}: give 1 to {MAX_VARIATIONS}.")
    if not 0 <= options.seed <= MAX_SEED:
        raise SpecError(f"--seed {options.seed}: give 0 to {MAX_SEED}.")
    variety = Variety(layout=options.layout, objects=options.objects == "same-kind", materials=options.materials)
    rows, errors = [], console(stderr=True)
    with watch(errors) as progress:
        made = vary(
            options.folder,
            options.out,
            count=options.count,
            variety=variety,
            seed=options.seed,
            device=options.device,
            progress=progress,
        )
        for row in made:
            rows.append(row)
            how = "there already" if row.kept else row.state
            errors.print(f"{len(rows)}/{options.count} {row.folder}: {how}", markup=False, soft_wrap=True)
    if options.json:
        print_facts(rows)
    else:
        show_many(console(), rows)
    return max(row.exit_code for row in rows)


def show_changes(target: Console, edits: Sequence[Edit], changes: Changes) -> None:
    """What was edited, what moved by how much, and what the edits broke."""
    for edit in edits:
        target.print(f"done  {edit}", markup=False, soft_wrap=True)
    for what, names in (("added", changes.added), ("removed", changes.removed)):
        if names:
            target.print(f"{what}: {', '.join(names)}", markup=False, soft_wrap=True)
    far = {name: one for name, one in changes.moved.items() if one.mm >= LITTLE or one.degrees >= LITTLE}
    for name, one in sorted(far.items(), key=lambda item: -item[1].mm):
        target.print(f"moved: {name} by {one.mm:.1f} mm and {one.degrees:.1f} degrees", markup=False, soft_wrap=True)
    rest = [one.mm for name, one in changes.moved.items() if name not in far]
    if rest:
        target.print(f"{len(rest)} others moved by at most {max(rest):.2g} mm", markup=False)
    for line in changes.broke:
        target.print(f"broke: {line}", style="yellow", markup=False, soft_wrap=True)
    for note in changes.notes:
        target.print(f"note  {note}", markup=False, soft_wrap=True)
