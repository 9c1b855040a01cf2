"""What the files of a library say of its objects beyond their meshes: one beside an object, or tables of many.

Beside it: metadata.json, meta.json and the like, metadata.pbtxt (Google's scanned objects), NAME.json, and Habitat's
NAME.object_config.json. Tables have a row for every identifier, which is the name of the object's file or folder:
Objaverse's metadata/*.json.gz and lvis-annotations.json.gz, ManiSkill's info_*.json, CSV as HSSD and ShapeNet have it.
"""

from __future__ import annotations

import csv
import gzip
import hashlib
import io
import json
import math
import re
import zlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from pat3d.assets.mesh.importing import UpAxis

MAX_BYTES = 1_000_000
"""Of a file beside an object."""
MAX_TABLE_BYTES = 64_000_000
"""Of a table, unpacked."""
MAX_NAMES = 20

BESIDE = ("metadata.json", "meta.json", "annotations.json", "info.json", "metadata.pbtxt")
_TABLE = re.compile(r"metadata|annotation|semantic|categor|info|objects|models", re.IGNORECASE)
"""Of the name of a table, or of the folder that it is in."""
_ENDINGS = (".json", ".json.gz", ".csv")

_TITLES = ("name", "title", "model_cat", "category", "main_category", "class", "label", "noun", "semantic_name")
_LISTS = ("synonyms", "categories")
_IDS = ("uid", "fullid", "id", "object_id", "model_id", "handle")
"""Keys and columns that identify an object, in lower case."""


@dataclass(frozen=True, kw_only=True)
class Metadata:
    """What is said of one object."""

    names: tuple[str, ...] = ()
    """Best first."""
    licence: str = ""
    mass: float | None = None
    """[kg]"""
    density: float | None = None
    """[kg/m^3]"""
    metres: float | None = None
    """[m] of a unit of its mesh."""
    up: UpAxis | None = None
    """Axis that points up."""

    @property
    def digest(self) -> str:
        """A checksum of all of it."""
        return hashlib.sha256(repr(self).encode()).hexdigest()


def metadata_of(paths: Sequence[Path], files: Iterable[Path], root: Path) -> dict[Path, Metadata]:
    """What is said of the objects at `paths`.

    Args:
        paths: of their files.
        files: everything below `root`.
        root: folder of the library.
    """
    holding = Counter(folder for path in paths for folder in _above(path, root))
    identifiers = {
        path: [path.stem.lower(), *(one.name.lower() for one in _above(path, root) if holding[one] == 1)]
        for path in paths
    }
    wanted = {each for some in identifiers.values() for each in some}
    rows: dict[str, list[Metadata]] = {}
    for file in files:
        if file.name.lower().endswith(_ENDINGS) and _is_table(file):
            for key, row in _rows(file):
                if (key := key.lower()) in wanted:
                    rows.setdefault(key, []).append(row)
    found = {}
    for path in paths:
        own = list(_beside(path, [folder for folder in _above(path, root) if holding[folder] == 1]))
        found[path] = _together([*own, *(row for key in identifiers[path] for row in rows.get(key, ()))])
    return found


def _above(path: Path, root: Path) -> list[Path]:
    """The folders of a file up to the library's, nearest first."""
    return [folder for folder in path.parents if folder.is_relative_to(root)]


def _beside(path: Path, own: Sequence[Path]) -> Iterator[Metadata]:
    """What files of the object's own say."""
    candidates = [path.with_suffix(".json"), path.with_suffix(".object_config.json")]
    candidates += [folder / name for folder in own[:2] for name in BESIDE]
    for candidate in candidates:
        text = _text(candidate, MAX_BYTES)
        if candidate.suffix == ".pbtxt" and text:
            yield _said(_pbtxt(text))
        elif isinstance(raw := _json(text), dict):
            yield _said(raw)


def _is_table(file: Path) -> bool:
    return bool(_TABLE.search(file.name) or _TABLE.search(file.parent.name))


def _rows(file: Path) -> Iterator[tuple[str, Metadata]]:
    """Identifier and row of every object of a table; nothing of what is none."""
    text = _text(file, MAX_TABLE_BYTES)
    if file.suffix == ".csv":
        try:
            records: list[Any] = list(csv.DictReader(io.StringIO(text)))
        except csv.Error:
            return
    else:
        raw = _json(text)
        if isinstance(raw, dict):
            for key, value in raw.items():
                if isinstance(value, dict):
                    yield key, _said(value)
                elif isinstance(value, list) and all(isinstance(one, str) for one in value):
                    # LVIS: the identifiers of every category.
                    yield from ((one, Metadata(names=(key,))) for one in value)
            return
        records = raw if isinstance(raw, list) else []
    for record in records:
        if not isinstance(record, dict):
            continue
        low = {str(key).lower(): value for key, value in record.items()}
        for key in _IDS:
            if isinstance(said := low.get(key), str) and said:
                # ShapeNet's full identifiers say the collection before a point: "wss.100f39dce7690f59".
                yield said.rpartition(".")[2], _said(low)
                break


def _together(some: Sequence[Metadata]) -> Metadata:
    """What several say of one object; the first that says something counts."""

    def first(name: str) -> Any:
        return next((value for one in some if (value := getattr(one, name)) is not None), None)

    return Metadata(
        names=tuple(dict.fromkeys(name for one in some for name in one.names))[:MAX_NAMES],
        licence=next((one.licence for one in some if one.licence), ""),
        mass=first("mass"),
        density=first("density"),
        metres=first("metres"),
        up=first("up"),
    )


def _said(raw: Mapping[str, Any]) -> Metadata:
    names = [raw[key] for key in _TITLES if isinstance(raw.get(key), str)]
    for key in _LISTS:
        some = raw.get(key)
        # Objaverse's categories and tags are dicts of what may be seen on the picture too: no names of the object.
        names += [one for one in some if isinstance(one, str)] if isinstance(some, list) else []
    licence = raw.get("license") or raw.get("licence") or ""
    return Metadata(
        names=tuple(name for name in names if 0 < len(name) <= 100)[:MAX_NAMES],
        licence=licence[:200] if isinstance(licence, str) else "",
        mass=_positive(raw.get("mass")),
        density=_positive(raw.get("density")),
        metres=_positive(raw.get("unit")),
        up=_up(raw),
    )


def _positive(said: object) -> float | None:
    if isinstance(said, str):
        try:
            said = float(said)
        except ValueError:
            return None
    good = isinstance(said, int | float) and not isinstance(said, bool) and math.isfinite(said) and said > 0
    return float(cast(float, said)) if good else None


def _up(raw: Mapping[str, Any]) -> UpAxis | None:
    """The axis that points up, where one of the usual keys names it."""
    for key in ("up", "up_axis", "upAxis", "upaxis"):
        if (axis := _axis(raw.get(key))) is not None:
            return axis
    return None


def _axis(said: object) -> UpAxis | None:
    """The axis that "y", "Z_UP", "+z", "0, 1, 0" or [0, 1, 0] names, or None."""
    if isinstance(said, str):
        if word := re.fullmatch(r"\+?(-?[xyz])([ _-]?(up|axis))?", said.strip().lower()):
            return cast(UpAxis, word[1])
        said = [value for part in re.split(r"[^-\d.e]+", said) if part and (value := _number(part)) is not None]
    if isinstance(said, list) and len(said) == 3 and all(isinstance(one, int | float) for one in said):
        large = [at for at in range(3) if abs(said[at]) > 0.99]
        if len(large) == 1 and sum(abs(one) for one in said) < 1.01:
            return cast(UpAxis, ("-" if said[large[0]] < 0 else "") + "xyz"[large[0]])
    return None


def _number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def _pbtxt(text: str) -> dict[str, Any]:
    """Name and categories of a protocol buffer in text form, as Google's scanned objects carry it."""
    name = re.search(r'^name:\s*"([^"]{1,100})"', text, re.MULTILINE)
    categories = re.findall(r'(?:first|second|category):\s*"([^"]{1,100})"', text)
    return {**({"name": name[1]} if name else {}), "categories": categories}


def _text(path: Path, most: int) -> str:
    """What a file says, unpacked; nothing where it is missing, damaged or too large."""
    try:
        if not path.is_file():
            return ""
        with gzip.open(path) if path.suffix == ".gz" else path.open("rb") as file:
            data = file.read(most + 1)
    except (OSError, EOFError, zlib.error):
        return ""
    return "" if len(data) > most else data.decode("utf-8", errors="replace")


def _json(text: str) -> Any:
    try:
        return json.loads(text) if text else None
    except (ValueError, RecursionError):
        return None
