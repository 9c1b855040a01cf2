"""Moments of episodes side by side in one picture."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EvaluationError
from pat3d.scene.replacement import replaced_file

GAP = 6
"""Around every picture [pixel]."""

PAPER, INK = (252, 252, 250), (40, 40, 45)


def moments_of(steps: int, count: int) -> list[int]:
    """`count` steps from the first to the last of an episode, evenly spread."""
    return sorted(set(np.linspace(0, steps, count).round().astype(int).tolist()))


def write_strip(
    rows: Sequence[tuple[str, Sequence[NDArray[np.uint8]]]], file: str | os.PathLike[str], *, colours: int = 0
) -> Path:
    """Write a PNG file.

    Args:
        rows: a caption, which may be empty, and pictures of one size for each, shape (height, width, 3).
        file: to write.
        colours: at most so many, for a smaller file; 0 for all.

    Raises:
        EvaluationError: no pictures, or another kind of file is named.
    """
    from PIL import Image, ImageDraw, ImageFont

    path = Path(file)
    if path.suffix.lower() != ".png":
        raise EvaluationError(f'a picture is FILE.png, not "{path.name}".')
    if not rows or not all(len(frames) for _, frames in rows):
        raise EvaluationError("a picture needs a moment to show.")
    height, width = rows[0][1][0].shape[:2]
    font: Any = ImageFont.load_default(size=max(12, height // 14))
    line = max((font.getbbox(text)[3] + GAP for text, _ in rows if text), default=0)
    size = (
        GAP + max(len(frames) for _, frames in rows) * (width + GAP),
        GAP + sum(height + GAP + (line if text else 0) for text, frames in rows),
    )
    sheet: Any = Image.new("RGB", size, PAPER)
    pen, top = ImageDraw.Draw(sheet), GAP
    for text, frames in rows:
        if text:
            pen.text((GAP, top), text, fill=INK, font=font)
            top += line
        for number, frame in enumerate(frames):
            sheet.paste(Image.fromarray(frame), (GAP + number * (width + GAP), top))
        top += height + GAP
    if colours:
        sheet = sheet.quantize(colours, dither=Image.Dither.FLOYDSTEINBERG)
    with replaced_file(path) as temporary:
        sheet.save(temporary, format="PNG", optimize=True)
    return path
