"""The gallery of a library: `index.html` with a picture, the convex parts, the facts and the doubts of every object."""

from __future__ import annotations

import html
from pathlib import Path

import numpy as np

from pat3d.assets.library.index import Library
from pat3d.assets.library.store import Entry
from pat3d.errors import Pat3dError
from pat3d.progress import Event, Progress
from pat3d.scene.asset import Asset, VisualMesh
from pat3d.scene.replacement import replaced_file, write_text

_STYLE = """
body{font:14px/1.45 system-ui,sans-serif;margin:2em;color:#222;background:#fafafa}
main{display:grid;grid-template-columns:repeat(auto-fill,minmax(330px,1fr));gap:1em;align-items:start}
article{min-width:0;overflow-wrap:anywhere;background:#fff;border:1px solid #ddd;border-radius:6px;padding:.8em}
img{width:100%;background:#eee}h2{font-size:15px;margin:.3em 0}
dl{display:grid;grid-template-columns:6em 1fr;gap:.1em .6em;margin:.4em 0}dt{color:#777}dd{margin:0}
.doubt{background:#fff3d6;border-left:3px solid #d99a00;padding:.2em .5em;margin:.3em 0}
.refused{background:#fde8e6;border-left:3px solid #b3261e;padding:.2em .5em}
"""


def write_gallery(library: Library, *, pictures: bool, progress: Progress) -> Path:
    """Write `index.html` and the pictures that are missing into the index; returns the page."""
    if pictures:
        missing = [entry for entry in library.ready if not _picture(library, entry).is_file()]
        for number, entry in enumerate(missing):
            progress(Event(stage="drawing", detail=entry.key, step=number, steps=len(missing)))
            try:
                draw(library.asset(entry.key), _picture(library, entry))
            except Pat3dError:
                continue
    # What asks for an answer comes first, what cannot be used last.
    order = sorted(library.entries, key=lambda entry: (entry.state != "ready", not entry.doubts))
    cards = "\n".join(_card(library, entry) for entry in order)
    counts = f"{len(library.ready)} of {len(library.entries)} objects are ready"
    page = library.folder / "index.html"
    write_text(
        page,
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{html.escape(library.name)}</title>'
        f"<style>{_STYLE}</style><h1>{html.escape(library.name)}</h1><p>{counts}; of "
        f"{html.escape(str(library.source))}. A library.yaml there settles doubts.</p><main>{cards}</main></html>\n",
    )
    return page


def draw(asset: Asset, path: Path) -> None:
    """Write the object from two sides, and its convex parts in colours from the same."""
    from PIL import Image

    from pat3d.view.preview import save_turntable

    with replaced_file(path) as temporary:
        above, below = temporary.with_suffix(".seen.png"), temporary.with_suffix(".parts.png")
        try:
            save_turntable(asset.visual, above, views=2, width=320, height=260)
            save_turntable(_parts(asset), below, views=2, width=320, height=260)
            with Image.open(above) as first, Image.open(below) as second:
                sheet = Image.new("RGB", (first.width, first.height + second.height))
                sheet.paste(first, (0, 0))
                sheet.paste(second, (0, first.height))
                sheet.save(temporary, format="PNG", optimize=True)
        finally:
            for one in (above, below):
                one.unlink(missing_ok=True)


def _parts(asset: Asset) -> VisualMesh:
    """The convex parts as one mesh, each in a colour of its own."""
    hues = np.arange(len(asset.parts)) * 0.618034 % 1.0
    colours = 0.5 + 0.35 * np.cos(2 * np.pi * (hues[:, None] + np.array([0.0, 1 / 3, 2 / 3])))
    starts = np.cumsum([0] + [len(part.vertices) for part in asset.parts])
    counts = [len(part.faces) for part in asset.parts]
    return VisualMesh.from_face_colours(
        np.concatenate([part.vertices for part in asset.parts]),
        np.concatenate([part.faces + start for part, start in zip(asset.parts, starts, strict=False)]),
        np.repeat(np.round(255 * colours).astype(np.uint8), counts, axis=0),
    )


def _picture(library: Library, entry: Entry) -> Path:
    return library.folder / "objects" / f"{entry.key}.png"


def _card(library: Library, entry: Entry) -> str:
    title = f"<h2>{html.escape(f'{library.name}/{entry.key}')}</h2>"
    if entry.state != "ready":
        told = f'<p class="refused">{html.escape(entry.reason)}</p><p>{html.escape(entry.path)}</p>'
        return f"<article>{title}{told}</article>"
    facts = entry.facts
    rows = {
        "called": ", ".join((entry.name, *entry.synonyms)),
        "size": " x ".join(f"{100 * side:.1f}" for side in facts["size"]) + " cm",
        "unit": f"{facts['unit']['value']} ({facts['unit']['reason']})",
        "up": f"{facts['up']['value']} ({facts['up']['reason']})",
        "mass": f"{facts['mass']:.3g} kg, {facts['mass_from']}",
        "places": ", ".join(
            f"{one['kind']} {200 * one['half_size'][0]:.0f} x {200 * one['half_size'][1]:.0f} cm"
            for one in facts["places"]
        ),
        "parts": str(facts["parts"]),
        "licence": str(facts["licence"]),
        "file": entry.path,
    }
    told = "".join(f"<dt>{html.escape(key)}</dt><dd>{html.escape(value)}</dd>" for key, value in rows.items())
    doubts = "".join(f'<p class="doubt">{html.escape(doubt)}</p>' for doubt in entry.doubts)
    shown = _picture(library, entry)
    image = f'<img loading="lazy" alt="" src="objects/{shown.name}">' if shown.is_file() else ""
    return f"<article>{image}{title}<dl>{told}</dl>{doubts}</article>"
