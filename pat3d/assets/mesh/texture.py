"""From the materials of a mesh's pieces to one texture with texture coordinates per face corner."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

MAX_SIDE = 2048
"""Longest side of a texture [texels]; larger images are scaled down."""

MAX_PIXELS = 100_000_000
MAX_TILES = 4
_GRAY = np.array([178, 178, 178], dtype=np.uint8)
_BORDER = 2


NEUTRAL: dict[str, tuple[int, ...] | int] = {"normal": (128, 128, 255), "roughness": 140, "metallic": 0, "opacity": 255}
"""What a map says where a piece has none: flat, as rough as what nobody says anything of, no metal, seen."""

_MTL = {"norm": "normal", "map_pr": "roughness", "map_pm": "metallic", "map_d": "opacity"}
"""Statements of MTL files, the PBR extension among them, that name the maps."""

OpenImage = Callable[[str], Any]
"""Opens a picture that a material file names, as PIL.Image.Image."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Packed:
    """One texture for all patches."""

    uv: NDArray[np.float64]
    """In [0, 1], shape (faces, 3, 2)."""
    texture: NDArray[np.uint8]
    """RGB, shape (height, width, 3)."""
    maps: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)
    """As those of `VisualMesh`, as large as the texture."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Patch:
    """How one piece looks: an image with texture coordinates, or flat face colours."""

    uv: NDArray[np.float64]
    """Per face corner, v up, any range (images repeat), shape (faces, 3, 2)."""
    image: NDArray[np.uint8] | None = None
    """RGB, shape (height, width, 3)."""
    colours: NDArray[np.uint8] | None = None
    """RGB of every face where there is no image, shape (faces, 3)."""
    maps: Mapping[str, NDArray[np.uint8]] = field(default_factory=dict)
    """As those of `VisualMesh`, as large as the image."""

    @staticmethod
    def of(geometry: Any, notes: list[str], open_image: OpenImage | None = None) -> Patch:
        """The look of a trimesh mesh: texture and maps, base colour, face or vertex colours, else gray."""
        from PIL import Image

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
            found = _maps(material, notes, open_image)
            if image is None and found and visual.uv is not None:
                image = Image.new("RGB", next(iter(found.values())).size, tuple(_GRAY if tint is None else tint))
                tint = None
            if image is not None and visual.uv is not None and len(visual.uv) == len(geometry.vertices):
                uv = np.asarray(visual.uv, dtype=np.float64)[:, :2][geometry.faces]
                if image.size[0] * image.size[1] > MAX_PIXELS:
                    notes.append(f"a texture of {image.size[0]} x {image.size[1]} texels was too large to read")
                elif np.isfinite(uv).all():
                    if max(image.size) > MAX_SIDE:
                        notes.append(f"a texture of {image.size[0]} x {image.size[1]} texels was scaled to {MAX_SIDE}")
                    opacity = _transparency(material, image)
                    found |= {} if opacity is None else {"opacity": opacity}
                    image.thumbnail((MAX_SIDE, MAX_SIDE))
                    texels = np.asarray(image.convert("RGB"), dtype=np.uint8)
                    if tint is not None and (tint < 255).any():
                        texels = (texels * (tint / 255.0)).round().astype(np.uint8)
                    maps = {name: np.asarray(one.resize(image.size), dtype=np.uint8) for name, one in found.items()}
                    return Patch(uv=uv, image=texels, maps=_with_factors(maps, material))
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
    for key, name in (("d", "opacity"), ("pr", "roughness"), ("pm", "metallic")):
        words = (getattr(material, "kwargs", None) or {}).get(key)
        with suppress(TypeError, ValueError):
            if words is not None:
                said[name] = float(np.clip(np.ravel(np.asarray(words, dtype=np.float64))[0], 0.0, 1.0))
    for attribute, what in (
        ("occlusionTexture", "an occlusion map was left out"),
        ("emissiveTexture", "an emission map was left out"),
    ):
        if getattr(material, attribute, None) is not None:
            notes.append(what)
    return said


def _maps(material: Any, notes: list[str], open_image: OpenImage | None) -> dict[str, Any]:
    """The maps of a glTF or an MTL material, as PIL images: RGB for normals, else of one channel."""
    found: dict[str, Any] = {}
    normal = getattr(material, "normalTexture", None)
    if normal is not None:
        found["normal"] = normal
    both = getattr(material, "metallicRoughnessTexture", None)
    if both is not None and _is_small(both):
        _, found["roughness"], found["metallic"] = both.convert("RGB").split()
    words = getattr(material, "kwargs", None) or {}
    for key, name in _MTL.items():
        if key in words and open_image is not None:
            try:
                found[name] = open_image(str(words[key][-1]))
            except (OSError, ValueError, IndexError, TypeError) as error:
                notes.append(f"{key} of a material file cannot be read ({type(error).__name__})")
    if "bump" in words or "map_bump" in words:
        notes.append("a bump map was left out")
    for name in [one for one, image in found.items() if not _is_small(image)]:
        notes.append(f"a {name} map of {found[name].size[0]} x {found[name].size[1]} texels was too large to read")
        del found[name]
    return {name: one.convert("RGB" if name == "normal" else "L") for name, one in found.items()}


def _is_small(image: Any) -> bool:
    return image.size[0] * image.size[1] <= MAX_PIXELS


def _transparency(material: Any, image: Any) -> Any:
    """The alpha channel of a base colour, where its material counts it; None otherwise."""
    mode = getattr(material, "alphaMode", None)
    if mode not in ("BLEND", "MASK") or image.mode not in ("RGBA", "LA"):
        return None
    alpha = image.getchannel("A")
    if alpha.getextrema()[0] == 255:
        return None
    base = getattr(material, "baseColorFactor", None)
    if base is not None and len(base) == 4:
        share = float(base[3]) / (255.0 if np.asarray(base).dtype.kind in "ui" else 1.0)
        alpha = alpha.point([round(value * share) for value in range(256)])
    if mode == "MASK":
        cutoff = getattr(material, "alphaCutoff", None)
        least = 255.0 * (0.5 if cutoff is None else float(cutoff))
        alpha = alpha.point([255 if value >= least else 0 for value in range(256)])
    return alpha


def _with_factors(maps: dict[str, NDArray[np.uint8]], material: Any) -> dict[str, NDArray[np.uint8]]:
    """The maps of roughness and metallic times the factors that glTF gives beside them."""
    for name in ("roughness", "metallic"):
        factor = getattr(material, f"{name}Factor", None)
        if name in maps and factor is not None and np.isfinite(factor) and factor < 1.0:
            maps[name] = (maps[name] * max(float(factor), 0.0)).round().astype(np.uint8)
    return maps


def pack(patches: list[Patch], notes: list[str]) -> Packed:
    """One texture with its maps for all patches."""
    images: list[NDArray[np.uint8]] = []
    layers: list[Mapping[str, NDArray[np.uint8]]] = []
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
        layers.append({})
    start = 0
    for patch in patches:
        if patch.colours is not None:
            row, column = np.divmod(entry[start : start + len(patch.colours)], side)
            start += len(patch.colours)
            centre = np.stack([(column + 0.5) / side, 1.0 - (row + 0.5) / side], axis=1)
            placed.append((0, np.repeat(centre[:, None], 3, axis=1)))
        elif patch.image is not None:
            uv, image = _unrolled(patch.uv, patch.image, notes)
            maps = {name: _unrolled(patch.uv, one, [])[1] for name, one in patch.maps.items()}
            key = b"".join(one.tobytes() + repr(one.shape).encode() for one in (image, *maps.values()))
            if key not in known:
                known[key] = len(images)
                images.append(image)
                layers.append(maps)
            placed.append((known[key], uv))
    texture, boxes = _atlas(images)
    uv = np.concatenate([uv * boxes[index][1] + boxes[index][0] for index, uv in placed])
    stacked = {}
    for name in sorted({name for one in layers for name in one}):
        level = NEUTRAL[name]
        whole = [
            own[name] if name in own else np.full((*image.shape[:2], *np.shape(level)), level, dtype=np.uint8)
            for own, image in zip(layers, images, strict=True)
        ]
        stacked[name] = _atlas(whole)[0]
    return Packed(uv=np.clip(uv, 0.0, 1.0), texture=texture, maps=stacked)


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
    repeated = np.tile(image, (tiles[1], tiles[0], *([1] * (image.ndim - 2))))
    step = int(np.ceil(max(repeated.shape[:2]) / (2 * MAX_SIDE)))
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
    texture = np.zeros((height, width, *images[0].shape[2:]), dtype=np.uint8)
    boxes, top = [], 0
    for image in images:
        rows, columns = image.shape[:2]
        # The border repeats the edge, so filtering does not mix neighbours.
        texture[top : top + rows + 2 * _BORDER, : columns + 2 * _BORDER] = np.pad(
            image, ((_BORDER, _BORDER), (_BORDER, _BORDER), (0, 0))[: image.ndim], mode="edge"
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
