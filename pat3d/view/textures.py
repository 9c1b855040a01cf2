"""Texture lookup: trilinear in an atlas of mipmaps, or the nearest texel of one image."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pat3d.view.tone import encode, linear_table

_LARGEST = 4096
_FINE = 4096
"""Steps of the table from linear light to 8-bit sRGB."""


class TextureAtlas:
    """All textures of a picture: trilinear lookup in linear light."""

    def __init__(self, textures: Sequence[NDArray[np.uint8]]) -> None:
        texels: list[NDArray[np.uint8]] = []
        tables: dict[int, list[tuple[int, int, int]]] = {}
        start = 0
        for texture in textures:
            if id(texture) in tables:
                continue
            tables[id(texture)] = []
            for level in _chain(texture):
                tables[id(texture)].append((start, level.shape[1], level.shape[0]))
                texels.append(level.reshape(-1, 3))
                start += level.shape[0] * level.shape[1]
        depth = max(len(table) for table in tables.values())
        self._levels = np.array([len(tables[id(texture)]) for texture in textures], dtype=np.int32)
        # Shape (textures, levels, 3): offset, width, height; the smallest level is repeated at the end.
        self._table = np.array(
            [(tables[id(texture)] + tables[id(texture)][-1:] * depth)[:depth] for texture in textures], dtype=np.int64
        )
        self._texels = np.concatenate(texels)

    def colour(
        self, texture: NDArray[np.int32], uv: NDArray[np.float32], footprint: NDArray[np.float32]
    ) -> NDArray[np.float32]:
        """Linear RGB at texture coordinates.

        Args:
            texture: index of each lookup's texture, shape (n,).
            uv: coordinates in [0, 1], v up, shape (n, 2).
            footprint: width of a pixel [texels of the full texture], shape (n,).

        Returns:
            Shape (n, 3).
        """
        last = self._levels[texture] - 1
        lod = np.clip(np.log2(np.maximum(footprint, 1.0)), 0.0, last)
        level = np.minimum(lod.astype(np.int64), last)
        colour = self._bilinear(self._table[texture, level], uv)
        blend = (lod - level).astype(np.float32)
        between = np.flatnonzero(blend > 0.01)
        if len(between):
            coarse = self._bilinear(self._table[texture[between], level[between] + 1], uv[between])
            colour[between] += blend[between, None] * (coarse - colour[between])
        return colour

    def _bilinear(self, table: NDArray[np.int64], uv: NDArray[np.float32]) -> NDArray[np.float32]:
        start, width, height = table[:, 0], table[:, 1], table[:, 2]
        x = np.clip(uv[:, 0] * width - 0.5, 0.0, width - 1.0)
        y = np.clip((1.0 - uv[:, 1]) * height - 0.5, 0.0, height - 1.0)
        x0, y0 = x.astype(np.int64), y.astype(np.int64)
        x1, y1 = np.minimum(x0 + 1, width - 1), np.minimum(y0 + 1, height - 1)
        fx, fy = (x - x0).astype(np.float32)[:, None], (y - y0).astype(np.float32)[:, None]
        table_linear = linear_table()

        def texel(column: NDArray[np.int64], row: NDArray[np.int64]) -> NDArray[np.float32]:
            return table_linear[self._texels[start + row * width + column]]

        top = texel(x0, y0) * (1 - fx) + texel(x1, y0) * fx
        bottom = texel(x0, y1) * (1 - fx) + texel(x1, y1) * fx
        return (top * (1 - fy) + bottom * fy).astype(np.float32, copy=False)


def nearest_texels(image: NDArray[np.float32], uv: NDArray[np.float32]) -> NDArray[np.float32]:
    """Texels of `image`, shape (height, width, k), nearest to coordinates that repeat, v down, shape (n, 2)."""
    row = np.clip((uv[:, 1] % 1.0) * image.shape[0], 0, image.shape[0] - 1).astype(np.int64)
    column = np.clip((uv[:, 0] % 1.0) * image.shape[1], 0, image.shape[1] - 1).astype(np.int64)
    return image[row, column]


def _chain(texture: NDArray[np.uint8]) -> list[NDArray[np.uint8]]:
    """The texture and its halvings, averaged in linear light."""
    step = -(-max(texture.shape[:2]) // _LARGEST)
    levels = [np.ascontiguousarray(texture[::step, ::step, :3])]
    if max(texture.shape[:2]) <= 64:
        # Palettes are small and never magnified enough to alias.
        return levels
    to_display = np.round(encode(np.linspace(0.0, 1.0, _FINE + 1, dtype=np.float32)) * 255.0).astype(np.uint8)
    while min(levels[-1].shape[:2]) >= 2:
        fine = levels[-1]
        rows, columns = fine.shape[0] // 2 * 2, fine.shape[1] // 2 * 2
        mean = np.zeros((rows // 2, columns // 2, 3), dtype=np.float32)
        for i in range(2):
            for j in range(2):
                mean += linear_table()[fine[i:rows:2, j:columns:2]]
        levels.append(to_display[np.round(mean * (_FINE / 4.0)).astype(np.int32)])
    return levels
