"""Denoising of sampled light: averages along surfaces, over the tile of pixels that shares a sample set."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]

# (offset [pixel], weight). One period of a 4-pixel pattern, centred: every place of the tile counts once.
_TILE = ((-2, 0.5), (-1, 1.0), (0, 1.0), (1, 1.0), (2, 0.5))
# After that, the two kinds of tiles in an 8-pixel pattern: both count the same.
_PAIR = ((-4, 0.5), (0, 1.0), (4, 0.5))


def smooth(light: Array, surface: NDArray[np.int32], position: Array, normal: Array, pixel: Array) -> Array:
    """Mean of `light` over neighbouring pixels of the same smooth surface.

    Args:
        light: what to average, shape (h, w, 4): three channels with a pattern of 8 x 8 pixels, one with 4 x 4.
        surface: which item each pixel shows; negative pixels are left out. Shape (h, w).
        position: world points [m], shape (h, w, 3).
        normal: unit normals, shape (h, w, 3).
        pixel: size of a pixel on the surface, seen straight on [m], shape (h, w).
    """
    for axis in (1, 0):
        light = _along(light, surface, position, normal, pixel, axis, _TILE)
    wide, fine = light[..., :3], light[..., 3:]
    for axis in (1, 0):
        wide = _along(wide, surface, position, normal, pixel, axis, _PAIR)
        # A second round rounds off the steps that a box leaves at the border of a shadow.
        fine = _along(fine, surface, position, normal, pixel, axis, _TILE)
    return np.concatenate([wide, fine], axis=2)


def _along(
    light: Array,
    surface: NDArray[np.int32],
    position: Array,
    normal: Array,
    pixel: Array,
    axis: int,
    taps: tuple[tuple[int, float], ...],
) -> Array:
    total, weights = light.copy(), np.ones(light.shape[:2], dtype=np.float32)
    for offset, weight in taps:
        if offset == 0 or abs(offset) >= light.shape[axis]:
            continue
        here, there = _shifted(offset, axis)
        same = (surface[here] == surface[there]) & (surface[here] >= 0)
        n, m = normal[here], normal[there]
        same &= n[..., 0] * m[..., 0] + n[..., 1] * m[..., 1] + n[..., 2] * m[..., 2] > 0.85
        step = position[there] - position[here]
        away = np.abs(n[..., 0] * step[..., 0] + n[..., 1] * step[..., 1] + n[..., 2] * step[..., 2])
        same &= away < 2.5 * pixel[here]
        share = same.astype(np.float32) * np.float32(weight)
        total[here] += light[there] * share[..., None]
        weights[here] += share
    total /= weights[..., None]
    return total


def _shifted(offset: int, axis: int) -> tuple[tuple[slice, ...], tuple[slice, ...]]:
    """Slices that pair every pixel with the one `offset` further along `axis`."""
    front, back = slice(max(0, -offset), -offset or None), slice(max(0, offset), min(0, offset) or None)
    if offset < 0:
        front, back = slice(-offset, None), slice(None, offset)
    return ((slice(None),) * axis + (front,), (slice(None),) * axis + (back,))
