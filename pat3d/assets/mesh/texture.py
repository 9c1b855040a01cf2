"""From the materials of a mesh's pieces to one texture with texture coordinates per face corner."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

MAX_SIDE = 2048
"""Longest side of a texture [texels]; larger images are scaled down."""

MAX_PIXELS = 100_000_000
MAX_TILES = 4
_GRAY = np.array([178, 178, 178], dtype=np.uint8)
_BORDER = 2


@dataclass(frozen=True, kw_only=True, eq=False)
class Patch:
    """How one piece looks: an image with texture coordinates, or flat face colours."""

    uv: NDArray[np.float64]
    """Per face corner, v up, any range (images repeat), shape (faces, 3, 2)."""
    image: NDArray[np.uint8] | None = None
    """RGB, shape (height, width, 3)."""
    colours: NDArray[np.uint8] | None = None
    """RGB of every face where there is no image, shape (faces, 3)."""

    @staticmethod
    def of(geometry: Any, notes: list[str]) -> Patch:
        """The look of a trimesh mesh: texture, base colour, face or vertex colours, else gray."""
        count = len(geometry.faces)
        blank = np.zeros((count, 3, 2))
        visual = geometry.visual
        if visual.kind == "texture":
            material = visual.material
            if hasattr(material, "materials"):
                notes.append("a mesh with several materials in one piece took its first one")
                material = material.materials[0]
            image = getattr(material, "baseColorTexture", None)
            image = getattr(material, "image", None) if image is None else image
            factor = getattr(material, "baseColorFactor", None)
            if factor is None and image is None:
                factor = getattr(material, "diffuse", None)
            tint = _rgb(factor)
            if image is not None and visual.uv is not None and len(visual.uv) == len(geometry.vertices):
                uv = np.asarray(visual.uv, dtype=np.float64)[:, :2][geometry.faces]
                if image.size[0] * image.size[1] > MAX_PIXELS:
                    notes.append(f"a texture of {image.size[0]} x {image.size[1]} texels was too large to read")
                elif np.isfinite(uv).all():
                    if max(image.size) > MAX_SIDE:
                        notes.append(f"a texture of {image.size[0]} x {image.size[1]} texels was scaled to {MAX_SIDE}")
                    if image.mode in ("RGBA", "LA"):
                        notes.append("the transparency of a texture was left out")
                    image.thumbnail((MAX_SIDE, MAX_SIDE))
                    texels = np.asarray(image.convert("RGB"), dtype=np.uint8)
                    if tint is not None and (tint < 255).any():
                        texels = (texels * (tint / 255.0)).round().astype(np.uint8)
                    return Patch(uv=uv, image=texels)
            return Patch(uv=blank, colours=np.tile(_GRAY if tint is None else tint, (count, 1)))
        if visual.kind == "face":
            return Patch(uv=blank, colours=np.asarray(visual.face_colors, dtype=np.uint8)[:, :3])
        if visual.kind == "vertex":
            mixed = np.asarray(visual.vertex_colors, dtype=np.float64)[:, :3][geometry.faces].mean(axis=1)
            # Sixteen levels a channel keep the palette small where colours blend.
            return Patch(uv=blank, colours=(np.round(mixed / 17.0) * 17.0).astype(np.uint8))
        return Patch(uv=blank, colours=np.tile(_GRAY, (count, 1)))

    def mirrored(self) -> Patch:
        """The same look for faces whose corner order is reversed."""
        return replace(self, uv=self.uv[:, ::-1])


def surface_said(geometry: Any, notes: list[str]) -> dict[str, float]:
    """Roughness, metallic and opacity [-] that a trimesh mesh's material says, means where a map says them."""
    material: Any = getattr(geometry.visual, "material", None)
    if hasattr(material, "materials"):
        material = material.materials[0]
    said: dict[str, float] = {}
    both = getattr(material, "metallicRoughnessTexture", None)
    for name, channel in (("roughness", 1), ("metallic", 2)):
        factor = getattr(material, f"{name}Factor", None)
        if both is not None and both.size[0] * both.size[1] <= MAX_PIXELS:
            mean = float(np.asarray(both.convert("RGB").resize((64, 64)), dtype=np.float64)[:, :, channel].mean()) / 255
            factor = mean * (1.0 if factor is None else float(factor))
        if factor is not None and np.isfinite(factor):
            said[name] = float(np.clip(factor, 0.0, 1.0))
    base = getattr(material, "baseColorFactor", None)
    if getattr(material, "alphaMode", None) == "BLEND" and base is not None and len(base) == 4:
        alpha = float(base[3])
        said["opacity"] = float(np.clip(alpha / 255.0 if np.asarray(base).dtype.kind in "ui" else alpha, 0.0, 1.0))
    dissolve = (getattr(material, "kwargs", None) or {}).get("d")
    if dissolve is not None:
        said["opacity"] = float(np.clip(np.ravel(np.asarray(dissolve, dtype=np.float64))[0], 0.0, 1.0))
    for attribute, what in (
        ("normalTexture", "a normal map was left out"),
        ("occlusionTexture", "an occlusion map was left out"),
        ("emissiveTexture", "an emission map was left out"),
        ("metallicRoughnessTexture", "of a metallic-roughness map the means were taken"),
    ):
        if getattr(material, attribute, None) is not None:
            notes.append(what)
    return said


def pack(patches: list[Patch], notes: list[str]) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """One texture for all patches, and coordinates into it in [0, 1], shape (faces, 3, 2)."""
    images: list[NDArray[np.uint8]] = []
    placed: list[tuple[int, NDArray[np.float64]]] = []
    known: dict[bytes, int] = {}
    flat = [patch.colours for patch in patches if patch.colours is not None]
    palette, entry = (
        np.unique(np.concatenate(flat), axis=0, return_inverse=True) if flat else (np.zeros((0, 3), np.uint8), _GRAY)
    )
    entry = entry.reshape(-1)
    side = int(np.ceil(np.sqrt(len(palette))))
    if flat:
        grid = np.zeros((side * side, 3), dtype=np.uint8)
        grid[: len(palette)] = palette
        images.append(np.kron(grid.reshape(side, side, 3), np.ones((4, 4, 1), dtype=np.uint8)))
    start = 0
    for patch in patches:
        if patch.colours is not None:
            row, column = np.divmod(entry[start : start + len(patch.colours)], side)
            start += len(patch.colours)
            centre = np.stack([(column + 0.5) / side, 1.0 - (row + 0.5) / side], axis=1)
            placed.append((0, np.repeat(centre[:, None], 3, axis=1)))
        elif patch.image is not None:
            uv, image = _unrolled(patch.uv, patch.image, notes)
            key = image.tobytes() + repr(image.shape).encode()
            if key not in known:
                known[key] = len(images)
                images.append(image)
            placed.append((known[key], uv))
    texture, boxes = _atlas(images)
    uv = np.concatenate([uv * boxes[index][1] + boxes[index][0] for index, uv in placed])
    return np.clip(uv, 0.0, 1.0), texture


def _unrolled(
    uv: NDArray[np.float64], image: NDArray[np.uint8], notes: list[str]
) -> tuple[NDArray[np.float64], NDArray[np.uint8]]:
    """Coordinates within [0, 1] of an image that repeats as often as the faces need."""
    if uv.min() >= -1e-9 and uv.max() <= 1.0 + 1e-9:
        return uv, image
    uv = uv - np.floor(uv.min(axis=1, keepdims=True) + 1e-9)
    tiles = np.ceil(uv.reshape(-1, 2).max(axis=0) - 1e-9).clip(1, MAX_TILES).astype(int)
    if (uv > tiles + 1e-9).any():
        notes.append(f"a texture that repeats more than {MAX_TILES} times within a face was cut off there")
    repeated = np.tile(image, (tiles[1], tiles[0], 1))
    step = int(np.ceil(max(repeated.shape) / (2 * MAX_SIDE)))
    return uv / tiles, repeated[::step, ::step]


def _atlas(
    images: list[NDArray[np.uint8]],
) -> tuple[NDArray[np.uint8], list[tuple[NDArray[np.float64], NDArray[np.float64]]]]:
    """Images stacked in one, and the lower corner and size of each in its coordinates."""
    if len(images) == 1:
        return images[0], [(np.zeros(2), np.ones(2))]
    from PIL import Image

    # Keep the stack, and every image in it, within bounds.
    factor = min(1.0, 4 * MAX_SIDE / sum(image.shape[0] + 2 * _BORDER for image in images))
    if factor < 1.0:
        images = [
            np.asarray(Image.fromarray(image).resize([max(1, int(n * factor)) for n in image.shape[1::-1]]))
            for image in images
        ]
    width = max(image.shape[1] for image in images) + 2 * _BORDER
    height = sum(image.shape[0] + 2 * _BORDER for image in images)
    texture = np.zeros((height, width, 3), dtype=np.uint8)
    boxes, top = [], 0
    for image in images:
        rows, columns = image.shape[:2]
        # The border repeats the edge, so filtering does not mix neighbours.
        texture[top : top + rows + 2 * _BORDER, : columns + 2 * _BORDER] = np.pad(
            image, ((_BORDER, _BORDER), (_BORDER, _BORDER), (0, 0)), mode="edge"
        )
        low = np.array([_BORDER / width, 1.0 - (top + _BORDER + rows) / height])
        boxes.append((low, np.array([columns / width, rows / height])))
        top += rows + 2 * _BORDER
    return texture, boxes


def _rgb(colour: Any) -> NDArray[np.uint8] | None:
    """8-bit RGB of a trimesh colour in bytes or in [0, 1], or None."""
    if colour is None:
        return None
    values = np.asarray(colour)[:3]
    if values.dtype.kind == "f":
        values = np.round(np.clip(values, 0.0, 1.0) * 255.0)
    return values.astype(np.uint8)
