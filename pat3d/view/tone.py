"""Between stored colours, light and the screen: sRGB transfer and a gentle highlight curve."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

_SHOULDER = 0.72
"""Linear value above which highlights are compressed; colours below pass unchanged."""


def decode(values: ArrayLike) -> NDArray[np.float32]:
    """Linear light of sRGB values in [0, 1] (IEC 61966-2-1), any shape."""
    stored = np.asarray(values, dtype=np.float32)
    return np.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4).astype(np.float32)


def encode(values: ArrayLike) -> NDArray[np.float32]:
    """Encode linear light as sRGB: values in [0, 1], any shape."""
    light = np.clip(np.asarray(values, dtype=np.float32), 0.0, 1.0)
    return np.where(light <= 0.0031308, light * 12.92, 1.055 * light ** (1.0 / 2.4) - 0.055).astype(np.float32)


def compress(light: NDArray[np.float32]) -> NDArray[np.float32]:
    """Map light in [0, inf) to [0, 1): the identity up to the shoulder, then smoothly towards 1."""
    headroom = 1.0 - _SHOULDER
    excess = np.maximum(light - _SHOULDER, 0.0)
    return (np.minimum(light, _SHOULDER) + headroom * (1.0 - np.exp(-excess / headroom))).astype(np.float32)


def quantise(light: NDArray[np.float32], row: NDArray[np.int32], column: NDArray[np.int32]) -> NDArray[np.uint8]:
    """8-bit sRGB of linear light, shape (n, 3), at pixels (`row`, `column`).

    Less than one grey level of a fixed pattern (Jimenez's interleaved gradient noise) is added before
    rounding, without which slow gradients show contour lines.
    """
    pattern = (52.9829189 * ((0.06711056 * column + 0.00583715 * row) % 1.0)) % 1.0
    return np.clip(np.floor(encode(light) * 255.0 + pattern[:, None].astype(np.float32)), 0, 255).astype(np.uint8)


@cache
def linear_table() -> NDArray[np.float32]:
    """Linear light of every 8-bit sRGB value, shape (256,)."""
    return decode(np.arange(256) / 255.0)
