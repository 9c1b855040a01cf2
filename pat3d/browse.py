"""The catalogue for people: a table of everything, or one object with its picture."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

from pat3d.assets import catalogue
from pat3d.console import console, watch
from pat3d.errors import PromptError
from pat3d.naming import slug
from pat3d.progress import Event


def everything(*, seed: int, sheet: str | None) -> int:
    """Print every noun by family; with `sheet`, draw them all into that PNG file."""
    from rich.table import Table

    target = console()
    table = Table(box=None, pad_edge=False, header_style="bold")
    for title in ("noun", "cm", "material", "also called"):
        table.add_column(title, justify="right" if title == "cm" else "left", overflow="fold")
    pictures = []
    found = catalogue.entries()
    with watch(console(stderr=True)) as progress:
        number = 0
        for family, entries in groupby(found, key=lambda entry: entry.family):
            table.add_row(f"[bold]{family}[/]")
            for entry in entries:
                progress(Event(stage="making", detail=entry.noun, step=number, steps=len(found)))
                asset = catalogue.make(entry.noun, seed=seed)
                size = " x ".join(f"{100 * side:.0f}" if side >= 0.1 else f"{100 * side:.1f}" for side in asset.size)
                table.add_row(f"  {entry.noun}", size, asset.material.name, ", ".join(entry.synonyms))
                number += 1
                if sheet is not None:
                    pictures.append((entry.noun, asset.visual))
        if sheet is not None:
            from pat3d.view.preview import contact_sheet

            progress(Event(stage=f"drawing {len(pictures)} pictures"))
            written = contact_sheet(pictures, sheet, per_page=120)
    target.print(table)
    target.print(f"\n{len(found)} nouns. `pat3d catalogue NAME` shows one.")
    if sheet is not None:
        for path in written:
            target.print(f"pictures: {path}", markup=False, soft_wrap=True)
    return 0


def one(name: str, *, seed: int, out: str | None) -> int:
    """Print what is known about one noun, and draw it."""
    from pat3d.view.preview import save_turntable

    words = " ".join(name.lower().split())
    entry = catalogue.find(words)
    if entry is None:
        near = ", ".join(f'"{other}"' for other in catalogue.nearest(words)) or "see `pat3d catalogue`"
        raise PromptError(f'"{name}" is not in the catalogue. Nearest: {near}.')
    asset = catalogue.make(entry.noun, seed=seed)
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
    save_turntable(asset.visual, picture, caption=entry.noun)
    target = console()
    target.print(entry.noun, style="bold")
    for label, text in rows:
        target.print(f"  {label:16s} {text}", markup=False, soft_wrap=True)
    return 0
