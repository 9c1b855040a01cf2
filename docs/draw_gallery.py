"""Draws docs/gallery: a scene for every sentence, and the page docs/gallery.md that shows them.

    python docs/draw_gallery.py               makes what is missing; about 8 s a scene
    python docs/draw_gallery.py --again       makes all anew
    python docs/draw_gallery.py --made scenes/*     takes the pictures of scenes that were made before

Every scene is made as `pat3d generate SENTENCE` makes it, with seed 0, and shown only if it passed its verification.
"""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from PIL import Image

from pat3d.errors import Pat3dError
from pat3d.generation.pipeline import run_prompt
from pat3d.generation.settings import Settings
from pat3d.scene.folder import read_json
from pat3d.scene.naming import slug

DOCS = Path(__file__).resolve().parent
PICTURES = DOCS / "gallery"
WIDTH = 440
"""Of a picture [pixel]."""
CAPTION, GAP = 40, 24
"""Of a preview: height of the words under it, and width between its two pictures [pixel]."""

SENTENCES = (
    "A red mug, a green apple, a banana and a blue bowl on a wooden tray.",
    "A stack of three books with a red mug on top.",
    "A tower of six wooden blocks: red, green, blue, yellow, white and black.",
    "A bowl holding four fruits on a round table.",
    "a laptop, a computer mouse and a glass on a desk",
    "a kitten on top of a pile of five pancakes",
    "Three stacked bowls and five stacked plates.",
    "a cup with two pens, a book and an alarm clock on a desk",
    "a robin sitting on a big basket filled with colorful macarons",
    "A cup, a glass and a soda can on a tray.",
    "A table with a plate, a fork, a knife, a glass and a napkin.",
    "a plush elephant with three hats of different colors stacked on its head",
    "Three tin cans and a water bottle in a box.",
    "a plate with a banana, a mug and a fork on a table",
    "an elegant lounge with a sofa, a coffee table with a small sculpture on it, and a soft rug.",
    "On a desk there is a vase with flowers. Next to it there is a plate with a slice of cake.",
    "A bottle lying on its side in a crate, and three cups upside down in a row on a tray.",
    "a basket with three oranges on the floor",
    "A laptop, a keyboard, a mouse and a desk lamp on a desk with a chair in front.",
    "Three books on end in a row on a desk.",
    "a toy car next to a shoe box and a teapot on the box",
    "An armchair next to a small round table with a cup of coffee on it.",
    "A gray fabric sofa with a big teddy bear, a pink rabbit, a green turtle and two pillows, and two round red floor "
    "cushions in front.",
    "A candle on a book, a jar on a plate, and a golf ball next to the plate.",
    "a bowl with two apples next to a stack of three books on a table",
    "Two soup cans stacked on a wooden table.",
    "Three tennis balls in a basket.",
    "A wooden crate of five oranges, a loaf of bread on a cutting board and a glass bottle on a kitchen table.",
    "a cardboard box with a rubber duck on it and a toaster beside the box",
    "An old wooden radio with a little horse figurine on top stands on a stack of four books, beside a metal cup of "
    "colorful pencils.",
)


def main() -> None:
    """Make what is missing and write the page."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--again", action="store_true", help="make all anew")
    parser.add_argument("--made", nargs="*", default=[], metavar="FOLDER", help="scene folders that are here already")
    options = parser.parse_args()
    PICTURES.mkdir(exist_ok=True)
    for folder in map(Path, options.made):
        take(folder)
    for sentence in SENTENCES:
        if options.again or not picture_of(sentence).is_file():
            try:
                print(f"{picture_of(sentence).name}: {make(sentence)}", flush=True)
            except Pat3dError as error:
                print(f"{sentence}: {error}", flush=True)
    (DOCS / "gallery.md").write_text(page(), encoding="utf-8")


def picture_of(sentence: str) -> Path:
    """Where the picture of a sentence's scene is."""
    return PICTURES / f"{slug(sentence.rstrip('.'))[:60]}.webp"


def make(sentence: str) -> str:
    """Make the scene and draw it; returns how long that took, in words."""
    with tempfile.TemporaryDirectory(prefix="pat3d-gallery-") as scratch:
        folder = Path(scratch) / "scene"
        outcome = run_prompt(sentence, out=folder, settings=Settings(seed=0, formats=("mjcf",)))
        if outcome.report.failures:
            return f"left out: {outcome.report.failures[0]}"
        draw(folder, sentence)
    return f"{outcome.report.seconds['total']:.1f} s"


def take(folder: Path) -> None:
    """Draw the scene in `folder`, where it is one of SENTENCES as `make` would make it."""
    report = read_json(folder / "report.json")
    said = report.get("prompt")
    if said in SENTENCES and report.get("seed") == 0 and report.get("passed") is True and "edits" not in report:
        draw(folder, said)


def draw(folder: Path, sentence: str) -> None:
    """Write the picture of the scene in `folder`."""
    with Image.open(folder / "preview.png") as drawn:
        # Its right half is the settled scene, over a line of words.
        width, height = drawn.size
        seen = drawn.convert("RGB").crop(((width + GAP) // 2, 0, width, height - CAPTION))
        seen.thumbnail((WIDTH, WIDTH))
        seen.save(picture_of(sentence), quality=80, method=6)


def page() -> str:
    """The page, in Markdown."""
    shown = [one for one in SENTENCES if picture_of(one).is_file()]
    cells = [(f"![{one}](gallery/{picture_of(one).name})", one) for one in shown]
    lines = ["| | | |", "| --- | --- | --- |"]
    for start in range(0, len(cells), 3):
        three = [*cells[start : start + 3], *[("", "")] * 3][:3]
        lines += [f"| {' | '.join(one[row] for one in three)} |" for row in range(2)]
    return "\n".join((
        "# Gallery",
        "",
        f"{len(shown)} scenes, each made from the sentence under it by `pat3d generate SENTENCE`, and verified: the",
        "forces balance, nothing overlaps, nothing moves in MuJoCo. `python docs/draw_gallery.py` draws this page.",
        "",
        *lines,
        "",
    ))  # fmt: skip


if __name__ == "__main__":
    main()
