"""Which files of a folder are objects: descriptions first, then meshes that no description uses, each once."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from pat3d.assets.library.names import COLLISION, GENERIC, home_of, label, words_of
from pat3d.errors import AssetError

DESCRIPTIONS = {
    "urdf": "urdf", "sdf": "sdf", "xml": "mjcf", "mjcf": "mjcf", "usd": "usd", "usda": "usd", "usdc": "usd",
    "usdz": "usd",
}  # fmt: skip
"""Kind of description by the end of the file's name."""

MESHES = ("glb", "gltf", "obj", "dae", "fbx", "3mf", "ply", "off", "stl")
"""Mesh formats, those that carry most first."""

_WORDS = re.compile(r"[^a-z0-9]+")

MAX_FILES = 200_000
MAX_HEAD = 2_000_000
_REFERENCE = re.compile(r"""(?:filename|file|uri)\s*(?:=|>)\s*["']?([^"'<>]+\.\w{2,5})""")


@dataclass(frozen=True, kw_only=True)
class Found:
    """One object of a folder."""

    path: Path
    kind: str
    """"mesh", "mjcf", "urdf", "sdf" or "usd"."""
    words: tuple[str, ...]
    """Of its name."""
    told: bool = True
    """Whether its own file or folder says them, and not a folder of many."""
    others: tuple[Path, ...] = ()
    """Files that hold the same object in another way, and are not read."""


def discover(root: Path, library: str) -> list[Found]:
    """The objects below `root`, sorted by path.

    Raises:
        AssetError: it is no folder, or holds too many files.
    """
    if not root.is_dir():
        raise AssetError(f"{root} is no folder; give the folder that holds the objects.")
    files = sorted(files_below(root))
    used: set[tuple[str, str]] = set()
    for path in files:
        # Pieces that a description includes name meshes as well.
        if path.suffix.lower().lstrip(".") in DESCRIPTIONS:
            for said in _REFERENCE.findall(_head(path)):
                name = Path(said.strip())
                used |= {(name.parent.name, name.stem), *([] if name.parent.name else [(path.parent.name, name.stem)])}
    # Files with the same name in the same object's folder are one object; a description comes before meshes.
    groups: dict[tuple[Path, tuple[str, ...]], list[tuple[tuple, Path, str]]] = {}
    for path in files:
        kind, ending = _kind(path), path.suffix.lower().lstrip(".")
        if kind is None:
            if ending not in MESHES or COLLISION.search(path.stem) or (path.parent.name, path.stem) in used:
                continue
            kind = "mesh"
        rank = (
            list(dict.fromkeys(DESCRIPTIONS.values())).index(kind) if kind != "mesh" else 10,
            bool({"nontextured", "visual"} & set(words_of(path.stem))),
            MESHES.index(ending) if ending in MESHES else 0,
            "16k" not in str(path),
            len(path.parts),
            str(path),
        )
        own = tuple(word for word in _WORDS.split(path.stem.lower()) if word and word not in GENERIC)
        groups.setdefault((home_of(path, root), own), []).append((rank, path, kind))
    found = []
    for members in groups.values():
        members.sort(key=lambda one: one[0])
        _, path, kind = members[0]
        words, told = label(path, home_of(path, root), root, library)
        others = tuple(one[1] for one in members[1:])
        found.append(Found(path=path, kind=kind, words=tuple(words), told=told, others=others))
    return sorted(found, key=lambda one: str(one.path))


def files_below(root: Path) -> Iterator[Path]:
    """Every file of the folder that is not hidden.

    Raises:
        AssetError: they are too many.
    """
    count = 0
    for folder, folders, names in os.walk(root):
        folders[:] = sorted(name for name in folders if not name.startswith((".", "__")))
        for name in sorted(names):
            count += 1
            if count > MAX_FILES:
                raise AssetError(f"{root} holds more than {MAX_FILES:,} files; give a folder within it.")
            path = Path(folder, name)
            if not name.startswith(".") and path.is_file():
                yield path


def _kind(path: Path) -> str | None:
    kind = DESCRIPTIONS.get(path.suffix.lower().lstrip("."))
    if path.suffix.lower() != ".xml":
        return kind
    head = _head(path, 20_000)
    # Any tool writes XML; pieces that MJCF includes (<mujocoinclude>) are no objects.
    return "mjcf" if re.search(r"<mujoco[\s>]", head) and "<worldbody" in _head(path) else None


def _head(path: Path, size: int = MAX_HEAD) -> str:
    try:
        with path.open("rb") as file:
            return file.read(size).decode("utf-8", errors="replace")
    except OSError:
        return ""
