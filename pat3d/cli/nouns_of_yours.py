"""`pat3d catalogue add`, `check` and `remove`: nouns that users write in the shape language."""

from __future__ import annotations

from pathlib import Path

from pat3d.assets.nouns.checking import faults_of
from pat3d.assets.nouns.program import read_noun
from pat3d.assets.nouns.source import keep
from pat3d.assets.nouns.where import COMPOSED, OWN, noun_folder
from pat3d.cli.console import console
from pat3d.errors import SpecError
from pat3d.scene.naming import slug

VERBS = ("add", "check", "remove")


def do(verb: str, file: str | None, *, out: str | None) -> int:
    """One of VERBS on `file`; returns the exit code.

    Raises:
        SpecError: there is no such verb or file, or the file is invalid.
    """
    if verb not in VERBS or file is None:
        raise SpecError(f"pat3d catalogue {' | '.join(VERBS)} FILE: give one of these and a file.")
    return remove(file) if verb == "remove" else check(file, out=out, kept=verb == "add")


def check(file: str, *, out: str | None, kept: bool) -> int:
    """Make the noun in `file`, draw it, say what is wrong; with `kept`, keep it where nothing is."""
    from pat3d.view.preview import save_turntable

    program, target = read_noun(Path(file)), console()
    faults, oddities, made = faults_of(program)
    if made is not None and not kept:
        picture = Path(out) if out is not None else Path(f"{slug(program.entry.noun)}.png")
        save_turntable(made.visual, picture, caption=program.entry.noun)
        size = " x ".join(f"{100 * side:.1f}" for side in made.size)
        target.print(
            f"{program.entry.noun}: {size} cm, {made.mass_properties.mass:.3g} kg, {len(made.parts)} convex parts; "
            f"picture: {picture}",
            markup=False, soft_wrap=True,
        )  # fmt: skip
    for label, lines in (("wrong", faults), ("odd", oddities)):
        for line in lines:
            target.print(f"{label}: {line}", markup=False, soft_wrap=True)
    if faults:
        return 1
    if kept:
        noun = keep(program)
        target.print(f'added: sentences may say "{program.entry.noun}", specifications {noun}', markup=False)
    else:
        target.print("nothing is wrong with it.", markup=False)
    return 0


def remove(name: str) -> int:
    """Forget the noun called `name`, the user's own or a composed one.

    Raises:
        SpecError: there is none.
    """
    for source in (OWN, COMPOSED):
        path = noun_folder(source) / f"{slug(name.rpartition('/')[2])}.yaml"
        if path.is_file():
            path.unlink()
            console().print(f"removed {path}", markup=False, soft_wrap=True)
            return 0
    kept = [path.stem for source in (OWN, COMPOSED) for path in sorted(noun_folder(source).glob("*.yaml"))]
    raise SpecError(f'there is no noun "{name}" of yours. There are: {", ".join(kept) or "none"}.')
