"""Pictures of an optimisation: the loss curve, and the scene before and after."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

from pat3d.errors import SpecError
from pat3d.view.preview import save_png, scene_items

if TYPE_CHECKING:
    from pat3d.optimize.refine import Epoch
    from pat3d.scene.model import Scene

_PAPER, _INK, _GRID = (250, 250, 249), (52, 54, 58), (222, 223, 225)
_LINES = ((31, 97, 141), (192, 87, 20), (60, 130, 70), (125, 70, 140))
_LEAST = 1e-8
"""Loss [m^2] at the bottom of the axis."""


def save_loss_curve(
    history: Sequence[Epoch], path: str | os.PathLike[str], *, width: int = 800, height: int = 480
) -> None:
    """Write the loss of every epoch as a PNG with a logarithmic axis, one line for each start.

    Args:
        history: epochs of an optimisation.
        path: of the PNG file.
        width: [pixel].
        height: [pixel].

    Raises:
        SpecError: there are no epochs to draw.
    """
    if not history:
        raise SpecError("no gradient steps were taken, so there is no loss curve.")
    from PIL import Image, ImageDraw, ImageFont

    scale = 2
    image = Image.new("RGB", (scale * width, scale * height), _PAPER)
    draw = ImageDraw.Draw(image)
    font = ImageFont.load_default(size=scale * 15)
    left, top, right, bottom = scale * 78, scale * 44, scale * (width - 24), scale * (height - 58)
    losses = [max(epoch.loss, _LEAST) for epoch in history]
    low = math.floor(math.log10(min(losses)) + 1e-9)
    high = max(low + 1, math.ceil(math.log10(max(losses)) - 1e-9))
    last = max(1, *(epoch.epoch for epoch in history))

    def place(epoch: Epoch) -> tuple[float, float]:
        share = (math.log10(max(epoch.loss, _LEAST)) - low) / (high - low)
        return left + (right - left) * epoch.epoch / last, bottom - (bottom - top) * share

    for power in range(low, high + 1):
        y = bottom - (bottom - top) * (power - low) / (high - low)
        draw.line([(left, y), (right, y)], fill=_GRID, width=scale)
        draw.text((left - 8 * scale, y), f"1e{power}", fill=_INK, font=font, anchor="rm")
    step = max(1, math.ceil(last / 10))
    for number in range(0, last + 1, step):
        x = left + (right - left) * number / last
        draw.line([(x, bottom), (x, bottom + 5 * scale)], fill=_INK, width=scale)
        draw.text((x, bottom + 8 * scale), str(number), fill=_INK, font=font, anchor="mt")
    draw.line([(left, top), (left, bottom), (right, bottom)], fill=_INK, width=scale)
    draw.text((left, 14 * scale), "semantic loss [m^2]", fill=_INK, font=font, anchor="lt")
    draw.text(((left + right) / 2, scale * (height - 10)), "epoch", fill=_INK, font=font, anchor="mb")
    starts = sorted({epoch.start for epoch in history})
    for k, start in enumerate(starts):
        colour = _LINES[k % len(_LINES)]
        members = [epoch for epoch in history if epoch.start == start]
        points = [place(epoch) for epoch in members]
        draw.line(points, fill=colour, width=2 * scale, joint="curve")
        for (x, y), epoch in zip(points, members, strict=True):
            # Filled: every relation holds at the end of the rollout.
            r = 4 * scale
            draw.ellipse(
                (x - r, y - r, x + r, y + r), fill=_PAPER if epoch.broken else colour, outline=colour, width=2 * scale
            )
        if len(starts) > 1:
            y = 14 * scale
            x = right - (len(starts) - 1 - k) * 90 * scale
            draw.text((x, y), f"start {start + 1}", fill=colour, font=font, anchor="rt")
    draw.text((right, scale * (height - 10)), "filled: every relation holds", fill=_INK, font=font, anchor="rb")
    save_png(image.resize((width, height), Image.Resampling.LANCZOS), path)


def save_before_after(
    before: Scene, after: Scene, path: str | os.PathLike[str], *, width: int = 800, height: int = 600
) -> None:
    """Write both scenes at rest side by side, seen by one camera.

    Args:
        before: settled from the layout as given.
        after: settled from the layout that was found.
        path: of the PNG file.
        width: of each of the two pictures [pixel].
        height: of each of the two pictures [pixel].
    """
    from pat3d.view.preview import side_by_side

    save_png(
        side_by_side(
            [("before optimisation", scene_items(before)), ("after", scene_items(after))], width=width, height=height
        ),
        path,
    )
