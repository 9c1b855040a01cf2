"""What many recipes share: proportions from adjectives, cavities, floors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Literal

import numpy as np
from scipy.optimize import root_scalar

from pat3d.assets.catalogue.registry import Style
from pat3d.assets.rounded import clear_radius, unseen
from pat3d.assets.shapes import Shape, box
from pat3d.scene.asset import Region

CREAM = (244, 236, 214)
LEAF = (86, 134, 62)
STALK = (112, 84, 52)
STEEL = (178, 182, 188)
DARK = (52, 48, 46)
WHITE = (242, 240, 236)
GOLDEN_CRUST = (206, 146, 74)


def height(style: Style, value: float, spread: float = 0.06) -> float:
    """A height [m] varied by seed, more when asked for "tall", less when asked for "short" or "shallow"."""
    factor = 1.3 if style.adjectives & {"tall", "high", "deep"} else 1.0
    factor *= 0.75 if style.adjectives & {"short", "shallow", "low", "flat"} else 1.0
    return style.vary(value * factor, spread)


def length(style: Style, value: float, spread: float = 0.06) -> float:
    """A length [m] varied by seed, more when asked for "long", less when asked for "short"."""
    factor = 1.3 if style.adjectives & {"long", "wide"} else 1.0
    factor *= 0.75 if style.adjectives & {"short", "narrow"} else 1.0
    return style.vary(value * factor, spread)


def cavity(inner: Sequence[tuple[float, float]], segments: int, levels: Sequence[float] = ()) -> Region:
    """The free cylinder inside a vessel made by `hollow` with the same arguments."""
    radius = clear_radius(inner, levels, segments)
    return Region(
        kind="in",
        shape="disc",
        floor=(0.0, 0.0, inner[0][1]),
        half_size=(radius, radius),
        height=inner[-1][1] - inner[0][1],
    )


def disc(kind: Literal["on", "in"], z: float, radius: float, height: float = math.inf) -> Region:
    """A round floor [m] centred on the object."""
    return Region(kind=kind, shape="disc", floor=(0.0, 0.0, z), half_size=(radius, radius), height=height)


def rectangle(kind: Literal["on", "in"], z: float, x: float, y: float, height: float = math.inf) -> Region:
    """A rectangular floor [m] of full sizes x and y centred on the object."""
    return Region(kind=kind, shape="rectangle", floor=(0.0, 0.0, z), half_size=(x / 2, y / 2), height=height)


def band(low: float, high: float) -> Shape:
    """Everything between two heights [m], as paint."""
    return unseen(box(1, 1, high - low).moved(z=low))


def level_lean(first: Shape, second: Shape) -> float:
    """Angle about y [degrees, 45 to 135] that lays two shapes on an axis along z with equal lowest points."""

    def gap(degrees: float) -> float:
        low = [np.concatenate(shape.turned("y", degrees).hulls)[:, 2].min() for shape in (first, second)]
        return float(low[0] - low[1])

    return float(root_scalar(gap, bracket=(45.0, 135.0), xtol=1e-13).root)
