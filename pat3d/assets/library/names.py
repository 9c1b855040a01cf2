"""What an object is called: by its file, its folder and its metadata; and which catalogue noun it is like."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, cast

from pat3d.assets.catalogue import lookup
from pat3d.assets.mesh.importing import UpAxis

GENERIC = frozenset({
    "model", "models", "mesh", "meshes", "object", "objects", "obj", "asset", "assets", "visual", "visuals", "textured",
    "nontextured", "scene", "untitled", "base", "body", "geometry", "simple", "reoriented", "google", "16k", "64k",
    "512k", "poisson", "tsdf", "clouds", "normalized", "watertight", "final", "optimized", "decimated", "download",
    "downloads", "dae", "fbx", "glb", "gltf", "stl", "ply", "off", "usd", "usdz", "usda", "usdc", "urdf", "sdf",
    "mjcf", "xml", "material", "materials", "texture", "textures", "low", "high", "poly", "lod", "lod0", "lod1",
    "lod2", "raw", "out", "output", "default", "root", "node", "world", "description", "mobility", "partnet", "link",
    "baselink", "vhacd",
})  # fmt: skip
"""Words of file and folder names that say how it is stored, not what it is."""

COLLISION = re.compile(r"(collision|collider|_col$|_coll$|vhacd|convex|coacd|_hull|_ch\d*$|decomp)", re.IGNORECASE)
"""Stems of collision meshes, which are no objects of their own."""

MAX_WORDS = 4
"""Of a name that a sentence can say."""

_LINKS = frozenset({"with", "of", "for", "in", "on", "and", "without"})

MAX_METADATA_BYTES = 1_000_000
_METADATA = ("metadata.json", "meta.json", "annotations.json", "info.json", "metadata.pbtxt")
_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


@dataclass(frozen=True, kw_only=True)
class Metadata:
    """What files beside the mesh say."""

    names: tuple[str, ...] = ()
    """Best first."""
    licence: str = ""
    mass: float | None = None
    """[kg]"""
    up: UpAxis | None = None
    """Axis that points up."""
    size: float | None = None
    """Longest side [m]."""
    raw: Mapping[str, Any] = field(default_factory=dict)


def words_of(text: str) -> list[str]:
    """Lower-case words of a file or folder name: "035_PowerDrill-v2" -> ["power", "drill"]."""
    parts = re.split(r"[^A-Za-z0-9]+", _CAMEL.sub(" ", text))
    words = [part.lower() for part in parts if part]
    found = [word for word in words if not re.fullmatch(r"v?\d+[a-z]?|[0-9a-f]{16,}", word)]
    # "065-a_cups": a lone letter after a number tells members of a set apart.
    return [word for word in found if len(word) > 1]


def label(path: Path, root: Path, library: str) -> list[str]:
    """Words of the name of the object at `path` (below `root`) in a library called `library`."""
    own = set(words_of(library)) | {library.lower()}

    def telling(text: str) -> list[str]:
        found = [word for word in words_of(text) if word not in GENERIC]
        return [word for word in found if word not in own] or found

    for text in [path.stem, *(part for part in reversed(path.relative_to(root).parts[:-1]))]:
        if found := telling(text):
            return found
    return words_of(path.stem) or ["object"]


def read_metadata(path: Path) -> Metadata:
    """What a metadata file of the object's folder says (GSO, PartNet, Objaverse and the like); empty for none."""
    candidates = [path.with_suffix(".json"), *(path.parent / name for name in _METADATA)]
    candidates += [path.parent.parent / name for name in _METADATA]
    for candidate in candidates:
        try:
            if not candidate.is_file() or candidate.stat().st_size > MAX_METADATA_BYTES:
                continue
            text = candidate.read_text(encoding="utf-8", errors="replace")
            raw = _pbtxt(text) if candidate.suffix == ".pbtxt" else json.loads(text)
        except (OSError, ValueError, RecursionError):
            continue
        if isinstance(raw, dict) and (found := _metadata(raw)) is not None:
            return found
    return Metadata()


def _metadata(raw: Mapping[str, Any]) -> Metadata | None:
    names: list[str] = []
    for key in ("name", "title", "model_cat", "category", "class", "label", "noun", "semantic_name"):
        if isinstance(raw.get(key), str):
            names.append(raw[key])
    for key in ("synonyms", "categories", "tags"):
        for one in raw.get(key, ()) if isinstance(raw.get(key), list) else ():
            said = one.get("name") if isinstance(one, dict) else one
            if isinstance(said, str):
                names.append(said)
    licence = raw.get("license") or raw.get("licence") or ""
    mass = raw.get("mass")
    names = [name for name in names if 0 < len(name) <= 100][:20]
    up = _up(raw)
    if not names and not licence and mass is None and up is None:
        return None
    return Metadata(
        names=tuple(names),
        licence=str(licence)[:200] if isinstance(licence, str) else "",
        mass=float(mass) if isinstance(mass, int | float) and not isinstance(mass, bool) and mass > 0 else None,
        up=up,
        raw=raw,
    )


def _up(raw: Mapping[str, Any]) -> UpAxis | None:
    """The axis that points up, where one of the usual keys names it."""
    for key in ("up", "up_axis", "upAxis", "upaxis"):
        if (axis := _axis(raw.get(key))) is not None:
            return axis
    return None


def _axis(said: object) -> UpAxis | None:
    """The axis that "y", "Z_UP", "+z" or [0, 1, 0] names, or None."""
    if isinstance(said, str):
        word = re.fullmatch(r"\+?(-?[xyz])([ _-]?(up|axis))?", said.strip().lower())
        return cast(UpAxis, word[1]) if word else None
    if isinstance(said, list) and len(said) == 3 and all(isinstance(one, int | float) for one in said):
        large = [at for at in range(3) if abs(said[at]) > 0.99]
        if len(large) == 1 and sum(abs(one) for one in said) < 1.01:
            return cast(UpAxis, ("-" if said[large[0]] < 0 else "") + "xyz"[large[0]])
    return None


def _pbtxt(text: str) -> dict[str, Any]:
    """Name and categories of a protocol buffer in text form, as Google's scanned objects carry it."""
    name = re.search(r'^name:\s*"([^"]{1,100})"', text, re.MULTILINE)
    categories = re.findall(r'(?:first|second|category):\s*"([^"]{1,100})"', text)
    return {**({"name": name[1]} if name else {}), "categories": categories}


def licence_of(path: Path, root: Path) -> str:
    """First line of the licence file nearest to the object, or nothing."""
    for folder in [path.parent, *path.parent.parents]:
        if not folder.is_relative_to(root):
            break
        for name in ("LICENSE", "LICENSE.txt", "LICENSE.md", "LICENCE", "LICENCE.txt", "COPYING"):
            try:
                lines = (folder / name).read_text(encoding="utf-8", errors="replace").splitlines()
            except OSError:
                continue
            return next((found[0][:200] for line in lines if (found := re.search(r"\w.*\S", line))), "")
    return ""


def synonyms_of(words: Sequence[str], metadata: Metadata, known: frozenset[str]) -> tuple[str, tuple[str, ...], str]:
    """The name, other names and the catalogue noun that an object is like (or nothing).

    Args:
        words: of its file's name.
        metadata: what else names it.
        known: nouns and synonyms of the catalogue.
    """
    names: list[str] = []
    like = ""
    for each in [list(words), *(words_of(name) for name in metadata.names)]:
        if not each:
            continue
        # "plate with hole" is a plate.
        cut = next((at for at, word in enumerate(each) if word in _LINKS and at > 0), len(each))
        if cut < len(each):
            names.append(" ".join(each[:MAX_WORDS]))
            each = each[:cut]
        found = _within(each, known)
        like = like or found
        names += [" ".join(each[-MAX_WORDS:] if len(each) > MAX_WORDS else each)]
        if found and found != names[-1]:
            names.append(found)
        # "potted meat can" is a meat can and a can: what stands last tells what it is.
        names += [" ".join(each[at:]) for at in range(max(0, len(each) - MAX_WORDS), len(each))]
    unique = tuple(dict.fromkeys(name for name in names if name))
    return unique[0], unique[1:], like


@cache
def known_names() -> frozenset[str]:
    """Nouns and synonyms of the catalogue."""
    return frozenset(lookup.names())


def _within(words: Sequence[str], known: frozenset[str]) -> str:
    """The catalogue noun among `words` that stands nearest to their end, the longest there."""
    for end in range(len(words), 0, -1):
        for start in range(max(0, end - 3), end):
            name = " ".join(words[start:end])
            for guess in (name, name.removesuffix("s"), name.removesuffix("es")):
                if guess in known:
                    return guess
    return ""
