"""The picture of `benchmarks/gradients.py`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.gradient_cases import Outcome
from pat3d.view.preview import save_png

_PAPER, _INK, _GRID = (250, 250, 249), (52, 54, 58), (222, 223, 225)
_COLOURS = {"step": (31, 97, 141), "frames": (192, 87, 20), "rest": (60, 130, 70)}
_LABELS = {"step": "one step", "frames": "60 frames", "rest": "to rest"}
_SCALE = 2


def save_picture(outcomes: Sequence[Outcome], targets: dict[str, float], path: Path) -> None:
    """Write the errors of all cases, and below what either side of a smooth and of a kinked map says.

    Args:
        outcomes: of the cases.
        targets: largest error allowed by kind of case.
        path: of the PNG file.
    """
    from PIL import Image, ImageDraw, ImageFont

    names = list(dict.fromkeys(_name(outcome) for outcome in outcomes))
    width, upper, lower = 960, 80 + 24 * len(names), 330
    image = Image.new("RGB", (_SCALE * width, _SCALE * (upper + lower)), _PAPER)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=_SCALE * 14)
    _errors(draw, font, outcomes, names, targets, width, upper)
    rough = [outcome for outcome in outcomes if np.isnan(outcome.errors).any()]
    smooth = [outcome for outcome in outcomes if outcome.case.name == "stack of 2" and outcome.case.kind == "frames"]
    for shown, left, right in ((smooth[:1], 0, width // 2), (rough[-1:], width // 2, width)):
        for outcome in shown:
            _sides(draw, font, outcome, left, right, upper, upper + lower)
    save_png(image.resize((width, upper + lower), Image.Resampling.LANCZOS), path)


def _name(outcome: Outcome) -> str:
    case = outcome.case
    return case.name if case.by == "q0" else f"{case.name}, by {case.by}"


def _text(draw: Any, font: Any, x: float, y: float, text: str, anchor: str, fill: tuple[int, int, int] = _INK) -> None:
    draw.text((_SCALE * x, _SCALE * y), text, fill=fill, font=font, anchor=anchor)


def _line(draw: Any, points: Sequence[tuple[float, float]], fill: tuple[int, int, int], width: float = 1.0) -> None:
    draw.line([(_SCALE * x, _SCALE * y) for x, y in points], fill=fill, width=round(_SCALE * width))


def _dot(draw: Any, x: float, y: float, colour: tuple[int, int, int], hollow: bool = False) -> None:
    x, y, r = _SCALE * x, _SCALE * y, _SCALE * 4
    draw.ellipse((x - r, y - r, x + r, y + r), fill=_PAPER if hollow else colour, outline=colour, width=2 * _SCALE)


def _errors(
    draw: Any,
    font: Any,
    outcomes: Sequence[Outcome],
    names: list[str],
    targets: dict[str, float],
    width: int,
    bottom: int,
) -> None:
    """One row a case, one dot a direction, on a logarithmic axis."""
    left, right, top, last = 300, width - 30, 44, bottom - 36
    low, high = -12, -3

    def x_of(value: float) -> float:
        power = min(max(math.log10(max(value, 1e-300)), low), high)
        return left + (right - left) * (power - low) / (high - low)

    for power in range(low, high + 1):
        _line(draw, [(x_of(10.0**power), top), (x_of(10.0**power), last)], _GRID)
        _text(draw, font, x_of(10.0**power), last + 5, f"1e{power}", "mt")
    for kind in ("step", "frames"):
        _line(draw, [(x_of(targets[kind]), top), (x_of(targets[kind]), last)], _COLOURS[kind], 1.5)
    _text(draw, font, left, 12, "adjoint against central differences: relative error", "lt")
    for place, kind in zip((right - 250, right - 150, right - 40), _COLOURS, strict=True):
        _dot(draw, place - 10, 18, _COLOURS[kind])
        _text(draw, font, place, 12, _LABELS[kind], "lt", _COLOURS[kind])
    for number, name in enumerate(names):
        y = top + 24 * (number + 0.5)
        _text(draw, font, left - 12, y, name, "rm")
        for outcome in outcomes:
            if _name(outcome) == name:
                for error in outcome.errors[np.isfinite(outcome.errors)]:
                    _dot(draw, x_of(error), y, _COLOURS[outcome.case.kind])
        if any(np.isnan(outcome.errors).any() for outcome in outcomes if _name(outcome) == name):
            _text(draw, font, left + 12, y, "not smooth: see below, right", "lm")


def _sides(draw: Any, font: Any, outcome: Outcome, begin: int, end: int, top: int, bottom: int) -> None:
    """Forward and backward differences over the adjoint's derivative, against h."""
    sizes, forward, back = outcome.curve
    left, right, ceiling, floor = begin + 80, end - 30, top + 50, bottom - 56
    most = max(0.02, 1.15 * float(np.abs(np.concatenate([forward, back]) - 1).max()))

    def place(h: float, ratio: float) -> tuple[float, float]:
        share = (math.log10(h) - math.log10(sizes[-1])) / math.log10(sizes[0] / sizes[-1])
        return left + (right - left) * share, (ceiling + floor) / 2 - (floor - ceiling) / 2 * (ratio - 1) / most

    for level in (-1, -0.5, 0, 0.5, 1):
        y = place(sizes[0], 1 + level * most)[1]
        _line(draw, [(left, y), (right, y)], _GRID)
        _text(draw, font, left - 8, y, f"{1 + level * most:.3f}", "rm")
    for h in sizes[::2]:
        x = place(h, 1.0)[0]
        _line(draw, [(x, floor), (x, floor + 5)], _INK)
        _text(draw, font, x, floor + 9, f"{h:.0e}", "mt")
    for values, colour, name, x in (
        (forward, (31, 97, 141), "forward", right - 170),
        (back, (192, 87, 20), "backward", right - 80),
    ):
        _line(draw, [place(h, value) for h, value in zip(sizes, values, strict=True)], colour, 2)
        for h, value in zip(sizes, values, strict=True):
            _dot(draw, *place(h, value), colour)
        _text(draw, font, x, top + 24, name, "lt", colour)
    _text(draw, font, left, top + 6, f"{_name(outcome)}, {_LABELS[outcome.case.kind]}: difference / adjoint", "lt")
    _text(draw, font, (left + right) / 2, bottom - 24, "step h [m]", "mt")
