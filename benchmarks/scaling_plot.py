"""The picture of how the cost of a frame grows with the number of bodies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pat3d.view.preview import save_png

_PAPER, _INK, _GRID = (250, 250, 249), (52, 54, 58), (222, 223, 225)
_OURS, _BOUND = (31, 97, 141), (192, 87, 20)
_SCALE, _WIDTH, _HEIGHT, _MARGIN = 2, 640, 400, 64


def save_scaling(found: Sequence[tuple[int, float]], bound: float, path: Path) -> None:
    """Write milliseconds a frame over bodies, both logarithmic, with the line of the exponent `bound` beside it.

    Args:
        found: bodies and milliseconds a frame, at least two.
        bound: largest exponent allowed.
        path: of the PNG file.
    """
    from PIL import Image, ImageDraw, ImageFont

    bodies, times = np.array(found, dtype=np.float64).T
    limit = times[0] * (bodies / bodies[0]) ** bound
    low, high = (
        10.0 ** math.floor(math.log10(times.min())),
        10.0 ** math.ceil(math.log10(max(limit.max(), times.max()))),
    )
    image = Image.new("RGB", (_SCALE * _WIDTH, _SCALE * _HEIGHT), _PAPER)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=_SCALE * 13)

    def at(x: float, y: float) -> tuple[float, float]:
        across = math.log(x / bodies[0]) / math.log(bodies[-1] / bodies[0])
        up = math.log(y / low) / math.log(high / low)
        return (
            _SCALE * (_MARGIN + across * (_WIDTH - 2 * _MARGIN)),
            _SCALE * (_HEIGHT - _MARGIN - up * (_HEIGHT - 1.75 * _MARGIN)),
        )

    for power in range(round(math.log10(low)), round(math.log10(high)) + 1):
        left, right = at(bodies[0], 10.0**power), at(bodies[-1], 10.0**power)
        draw.line([left, right], fill=_GRID, width=_SCALE)
        draw.text((left[0] - 8, left[1]), f"{10.0**power:g}", fill=_INK, font=font, anchor="rm")
    for count in bodies:
        x, y = at(count, low)
        draw.text((x, y + 8), f"{count:g}", fill=_INK, font=font, anchor="mt")
    draw.text((_SCALE * _WIDTH / 2, _SCALE * (_HEIGHT - 14)), "bodies in the pile", fill=_INK, font=font, anchor="mm")
    draw.text((_SCALE * 12, _SCALE * 14), "ms a frame", fill=_INK, font=font, anchor="lm")
    draw.line([at(x, y) for x, y in zip(bodies, limit, strict=True)], fill=_BOUND, width=2 * _SCALE)
    draw.text(at(bodies[-1], limit[-1]), f"exponent {bound:g} ", fill=_BOUND, font=font, anchor="rs")
    points = [at(x, y) for x, y in zip(bodies, times, strict=True)]
    draw.line(points, fill=_OURS, width=2 * _SCALE)
    for (x, y), value in zip(points, times, strict=True):
        draw.ellipse([x - 7, y - 7, x + 7, y + 7], fill=_OURS)
        draw.text((x + 12, y + 6), f"{value:.3g}", fill=_OURS, font=font, anchor="lt")
    save_png(np.asarray(image.resize((_WIDTH, _HEIGHT), Image.Resampling.LANCZOS)), path)
