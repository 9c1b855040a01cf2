"""What an object is called: by its file, its folder and its metadata; and which catalogue noun it is like."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from pat3d.assets.catalogue import lookup

GENERIC = frozenset({
    "model", "models", "mesh", "meshes", "object", "objects", "obj", "objs", "asset", "assets", "visual", "visuals",
    "textured",
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

_CAMEL = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


def words_of(text: str) -> list[str]:
    """Lower-case words of a file or folder name, accents left out: "035_PowerDrill-v2" -> ["power", "drill"]."""
    plain = unicodedata.normalize("NFKD", text.replace("ß", "ss")).encode("ascii", "ignore").decode("ascii")
    parts = re.split(r"[^A-Za-z0-9]+", _CAMEL.sub(" ", plain))
    words = [part.lower() for part in parts if part]
    found = [word for word in words if not re.fullmatch(r"v?\d+[a-z]?|[0-9a-f]{16,}", word)]
    # "065-a_cups": a lone letter after a number tells members of a set apart.
    return [word for word in found if len(word) > 1]


def label(path: Path, home: Path, root: Path, library: str) -> tuple[list[str], bool]:
    """Words of the name of the object at `path`, and whether a file or folder of its own says them.

    Args:
        path: of its file.
        home: folder that is the object's own.
        root: folder of the library, above it.
        library: name of the library.
    """
    own = set(words_of(library)) | {library.lower()}

    def telling(text: str) -> list[str]:
        found = [word for word in words_of(text) if word not in GENERIC]
        return [word for word in found if word not in own] or found

    if found := telling(path.stem):
        return found, True
    folder = path.parent
    while folder.is_relative_to(root) and folder != root:
        if found := telling(folder.name):
            return found, folder.is_relative_to(home)
        folder = folder.parent
    return words_of(path.stem) or ["object"], False


def home_of(path: Path, root: Path) -> Path:
    """The folder of the object at `path` that is its own: above those that only say how it is stored.

    A folder called by a number or a checksum tells objects apart.
    """
    folder = path.parent
    while folder != root:
        raw = {part for part in re.split(r"[^a-z0-9]+", folder.name.lower()) if part}
        words = set(words_of(folder.name))
        if not any(some and some <= GENERIC for some in (raw, words)):
            break
        folder = folder.parent
    return folder


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


def synonyms_of(words: Sequence[str], titles: Sequence[str], known: frozenset[str]) -> tuple[str, tuple[str, ...], str]:
    """The name, other names and the catalogue noun that an object is like (or nothing).

    Args:
        words: of its name.
        titles: what else it is called.
        known: nouns and synonyms of the catalogue.
    """
    names: list[str] = []
    like = ""
    for each in [list(words), *map(title_words, titles)]:
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


def title_words(title: str) -> list[str]:
    """Words of a title, those that only say how it is made left out: "Fruit Bowl (Low Poly)" is a fruit bowl."""
    found = words_of(title)
    return [word for word in found if word not in GENERIC] or found


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
