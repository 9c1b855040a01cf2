"""The catalogue for people: a table of everything, or one object with its picture."""

from __future__ import annotations

import argparse
import hashlib
import json
from collections.abc import Iterator
from contextlib import suppress
from itertools import groupby
from pathlib import Path

from pat3d.assets import catalogue as nouns
from pat3d.assets.catalogue.adjectives import shipped_adjectives, taken
from pat3d.assets.materials import surface_of
from pat3d.cli import nouns_of_yours
from pat3d.cli.console import console, watch
from pat3d.cli.json_output import JSON, print_facts
from pat3d.cli.options import command, option
from pat3d.errors import PromptError, SpecError
from pat3d.progress import Event, Progress
from pat3d.scene.asset import VisualMesh
from pat3d.scene.cache import cache_root
from pat3d.scene.folder import read_json, write_json
from pat3d.scene.naming import slug


@command(
    option("name", "noun or synonym; or what to do with FILE: add, check, remove", metavar="NAME", nargs="?"),
    option("file", "a noun of your own in the shape language, or the name of one to remove", metavar="FILE", nargs="?"),
    option("--sheet", "write pictures of everything", metavar="PNG"),
    option("--out", "picture of NAME", metavar="PNG", shown="./NAME.png"),
    option("--schema", "print the JSON schema of nouns in YAML and stop", action="store_true"),
    option("--seed", "variation of what is drawn", type=int, default=0, shown=""),
    JSON,
    examples="""
    pat3d catalogue                        list everything by family
    pat3d catalogue mug                    one object, with a picture in mug.png
    pat3d catalogue --sheet catalogue.png  pictures of everything
    pat3d catalogue check teapot.yaml      draw a noun of your own, and say what is wrong with it
    pat3d catalogue add teapot.yaml        make it part of what sentences may name
    pat3d catalogue remove teapot
    pat3d catalogue --schema               what such a file may say, as a JSON schema
    """,
)
def catalogue(options: argparse.Namespace) -> int:
    """`pat3d catalogue`."""
    if options.schema:
        from pat3d.assets.nouns.language import SCHEMA

        print(json.dumps(SCHEMA, indent=2))
        return 0
    if options.file is not None or options.name in nouns_of_yours.VERBS:
        return nouns_of_yours.do(options.name, options.file, out=options.out)
    if options.json:
        from pat3d.generation.facts import kinds

        print_facts(kinds(options.name or ""))
        return 0
    if options.name is not None:
        return one(options.name, seed=options.seed, out=options.out)
    if options.out is not None:
        raise SpecError("--out is the picture of one object; name it, or use --sheet for pictures of everything.")
    return everything(seed=options.seed, sheet=options.sheet)


def everything(*, seed: int, sheet: str | None) -> int:
    """Print every noun by family; with `sheet`, draw them all into that PNG file."""
    from rich.table import Table

    target, found = console(), nouns.entries()
    written: list[Path] = []
    with watch(console(stderr=True)) as progress:
        sizes = _sizes(seed, progress)
        if sheet is not None:
            from pat3d.view.preview import contact_sheet

            written = contact_sheet(_drawn(found, seed, progress), sheet, per_page=120)
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("noun", "cm", "also called"):
        table.add_column(title, justify="right" if title == "cm" else "left", overflow="fold")
    for family, entries in groupby(found, key=lambda entry: entry.family):
        table.add_row(family, style="bold")
        for entry in entries:
            table.add_row(f"  {entry.noun}", _centimetres(sizes[entry.noun]), ", ".join(entry.synonyms))
    target.print(table)
    target.print(f"\n{len(found)} nouns. `pat3d catalogue NAME` shows one.")
    for path in written:
        target.print(f"pictures: {path}", markup=False, soft_wrap=True)
    return 0


def _drawn(found: tuple[nouns.Entry, ...], seed: int, progress: Progress) -> Iterator[tuple[str, VisualMesh, float]]:
    """Name, mesh and opacity of every noun, made when it is their turn."""
    for number, entry in enumerate(found):
        progress(Event(stage="drawing", detail=entry.noun, step=number, steps=len(found)))
        asset = nouns.make(entry.noun, seed=seed)
        yield entry.noun, asset.visual, surface_of(asset).opacity


def shipped_sizes() -> Path:
    """Extents of every noun for seed 0 [m], measured when the package was made; see `measure_shipped`."""
    return Path(nouns.__file__).with_name("sizes.json")


def measure_shipped() -> None:
    """Measure `shipped_sizes` and `shipped_adjectives` anew, after a recipe changed; takes a minute.

    python -c "from pat3d.cli.catalogue import measure_shipped; measure_shipped()"
    """
    sizes = {entry.noun: [round(side, 4) for side in _size_of(entry.noun, 0)] for entry in nouns.entries()}
    rows = ",\n".join(f' "{noun}": {size}' for noun, size in sorted(sizes.items()))
    shipped_sizes().write_text(f"{{\n{rows}\n}}\n", encoding="utf-8")
    words = {entry.noun: taken(entry) for entry in nouns.entries()}
    rows = ",\n".join(f' "{noun}": {json.dumps(found)}' for noun, found in sorted(words.items()) if found)
    shipped_adjectives().write_text(f"{{\n{rows}\n}}\n", encoding="utf-8")


def _sizes(seed: int, progress: Progress) -> dict[str, list[float]]:
    """Extents of every noun [m]: those that ship for seed 0; measured, and kept in the cache, for others."""
    found = nouns.entries()
    shipped = read_json(shipped_sizes()) if seed == 0 else {}
    if all(_is_size(shipped.get(entry.noun)) for entry in found):
        return shipped
    recipes = sorted(Path(nouns.__file__).parent.parent.rglob("*.py"))
    digest = hashlib.sha256(b"".join(path.read_bytes() for path in recipes)).hexdigest()
    cache = cache_root() / f"catalogue-{digest[:16]}-{seed}.json"
    sizes = {**shipped, **read_json(cache)}
    unknown = [entry.noun for entry in found if not _is_size(sizes.get(entry.noun))]
    for number, noun in enumerate(unknown):
        progress(Event(stage="measuring", detail=noun, step=number, steps=len(unknown)))
        sizes[noun] = _size_of(noun, seed)
    # A folder that cannot be written only costs the time again.
    with suppress(OSError):
        if unknown:
            cache.parent.mkdir(parents=True, exist_ok=True)
            write_json(cache, sizes)
    return sizes


def _size_of(noun: str, seed: int) -> list[float]:
    return nouns.make(noun, seed=seed).size.tolist()


def _is_size(value: object) -> bool:
    return isinstance(value, list) and len(value) == 3 and all(isinstance(side, float) for side in value)


def _centimetres(size: list[float]) -> str:
    return " x ".join(f"{100 * side:.0f}" if side >= 0.1 else f"{100 * side:.1f}" for side in size)


def one(name: str, *, seed: int, out: str | None) -> int:
    """Print what is known about one noun, and draw it."""
    from pat3d.view.preview import save_turntable

    words = " ".join(name.lower().split())
    entry = nouns.find(words)
    if entry is None:
        near = ", ".join(f'"{other}"' for other in nouns.nearest(words)) or "see `pat3d catalogue`"
        raise PromptError(f'"{name}" is not in the catalogue. Nearest: {near}.')
    asset = nouns.make(entry.noun, seed=seed)
    picture = Path(out) if out is not None else Path(f"{slug(entry.noun)}.png")
    properties, material = asset.mass_properties, asset.material
    places = ", ".join(
        f"{region.kind} ({200 * region.half_size[0]:.0f} x {200 * region.half_size[1]:.0f} cm)"
        for region in asset.regions
    )
    rows = (
        ("family", entry.family),
        ("also called", ", ".join(entry.synonyms) or "-"),
        ("size", " x ".join(f"{100 * side:.1f}" for side in asset.size) + " cm (width, depth, height)"),
        ("mass", f"{properties.mass:.3g} kg"),
        ("material", f"{material.name}: {material.density:.0f} kg/m^3, friction {material.friction:g}"),
        ("colours", ", ".join(entry.colours) + " unless the prompt says otherwise"),
        ("convex parts", f"{len(asset.parts)}, {sum(part.box is not None for part in asset.parts)} of them boxes"),
        ("surface", f"{len(asset.visual.faces)} triangles"),
        ("room for things", places or "-"),
        ("picture", str(picture)),
    )
    save_turntable(asset.visual, picture, caption=entry.noun, opacity=surface_of(asset).opacity)
    target = console()
    target.print(entry.noun, style="bold")
    for label, text in rows:
        target.print(f"  {label:16s} {text}", markup=False, soft_wrap=True)
    return 0
