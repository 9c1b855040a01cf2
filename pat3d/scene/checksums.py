"""Which files a scene was verified with: SHA-256 of everything it owns, and what has happened to them since.

scene.json holds the checksums of the files in `assets` and in the exports beside it, and one of itself without that
one. An export elsewhere has them in checksums.json. They tell a file that was changed, lost or added by accident or by
somebody who does not know of them; who rewrites file and checksum passes, and is met by the comparison of every export
with what would be written of the scene (`pat3d.exporters.contents`).
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pat3d.errors import ExportError, SpecError
from pat3d.scene.folder import write_json

SCENE = "scene.json"
MANIFEST = "checksums.json"
FORMAT = "pat3d-checksums"

EXPORTS = ("mjcf", "usd", "urdf", "sdf", "html", "glb", "simready")
"""Folders of a scene folder that hold an export each."""

OWNED = ("assets", *EXPORTS)
"""Folders of a scene folder whose files have checksums."""

BYPRODUCTS = frozenset({"__pycache__", ".DS_Store", "Thumbs.db", "desktop.ini"})
"""What Python and file browsers leave in folders."""

MAX_FILES = 200_000
MAX_JSON_BYTES = 64 * 2**20


@dataclass(frozen=True, kw_only=True)
class ChecksumReport:
    """How the files of a folder compare with the checksums that were recorded; names are relative to the folder."""

    recorded: bool
    """Whether there are checksums at all; folders written before there were any have none."""
    changed: tuple[str, ...] = ()
    missing: tuple[str, ...] = ()
    extra: tuple[str, ...] = ()

    @property
    def failures(self) -> tuple[str, ...]:
        """A line for every file that is not as it was when it was written."""
        return (
            *(f"{name} is not the file that was verified: it was changed afterwards." for name in self.changed),
            *(f"{name} is missing; it was there when the scene was verified." for name in self.missing),
            *(f"{name} is not among the files that were verified: it was added afterwards." for name in self.extra),
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """What a person should know although nothing contradicts it."""
        if self.recorded:
            return ()
        return (
            "there are no checksums in this folder, which an earlier version wrote: its files cannot be vouched for, "
            "only compared with what the scene says now.",
        )


def record_checksums(folder: str | Path, names: Iterable[str] = OWNED) -> None:
    """Write the checksums of the folders `names` into scene.json, or into checksums.json where there is no scene.

    Of other folders what was recorded stays, and so does the mark of a scene.json that was edited: writing one export
    anew vouches for nothing else.

    Args:
        folder: a scene folder, or one that holds exports.
        names: folders in it that were just written; those that do not exist lose their checksums.

    Raises:
        ExportError: a file cannot be read or written.
        SpecError: scene.json is damaged.
    """
    folder, fresh = Path(folder), tuple(names)
    path = folder / SCENE
    try:
        own = {name: sha256_of(folder / name) for name in _files(folder, fresh)}
        if not path.is_file():
            kept = _read(folder / MANIFEST).get("checksums", {}) if (folder / MANIFEST).is_file() else {}
            write_json(folder / MANIFEST, {"format": FORMAT, "version": 1, "checksums": _merged(kept, own, fresh)})
            return
        document = _read(path)
        before = document.get("checksum")
        intact = before is None or before == scene_checksum(document)
        document["checksums"] = _merged(document.get("checksums", {}), own, fresh)
        document["checksum"] = scene_checksum(document) if intact else before
        # Not `write_json`: the text of every number has to stay as it is.
        text = json.dumps(document, indent=1, allow_nan=False, ensure_ascii=False)
        temporary = path.with_name(f".{path.name}.part")
        temporary.write_text(text + "\n", encoding="utf-8")
        os.replace(temporary, path)
    except OSError as error:
        raise ExportError(f"{folder}: cannot record its checksums ({error.strerror or error}).") from error


def compare_checksums(folder: str | Path) -> ChecksumReport:
    """What has become of the files of a scene folder, or of a folder of exports, since they were recorded.

    Raises:
        SpecError: scene.json, or checksums.json where there is no scene, cannot be read.
    """
    folder = Path(folder)
    a_scene = (folder / SCENE).is_file()
    document = _read(folder / (SCENE if a_scene else MANIFEST))
    recorded = document.get("checksums")
    if recorded is None:
        return ChecksumReport(recorded=False)
    there = set(_files(folder, OWNED if a_scene else EXPORTS))
    changed = [name for name in sorted(there & set(recorded)) if sha256_of(folder / name) != recorded[name]]
    if a_scene and document.get("checksum") != scene_checksum(document):
        changed.insert(0, SCENE)
    return ChecksumReport(
        recorded=True,
        changed=tuple(changed),
        missing=tuple(sorted(set(recorded) - there)),
        extra=tuple(sorted(there - set(recorded))),
    )


def scene_checksum(document: Mapping[str, Any]) -> str:
    """SHA-256 of what a scene.json says, without its own checksum; of the values, not of their layout in the file."""
    rest = {key: value for key, value in document.items() if key != "checksum"}
    text = json.dumps(rest, sort_keys=True, separators=(",", ":"))
    return hashlib.sha256(text.encode()).hexdigest()


def sha256_of(path: Path) -> str:
    """SHA-256 of a file's content; empty where it cannot be read."""
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return ""


def _merged(kept: Mapping[str, str], own: Mapping[str, str], fresh: tuple[str, ...]) -> dict[str, str]:
    others = {name: value for name, value in kept.items() if name.split("/", 1)[0] not in fresh}
    return dict(sorted({**others, **own}.items()))


def _files(folder: Path, names: Iterable[str]) -> Iterator[str]:
    """Names of the files below the folders `names`, by-products left out.

    Raises:
        SpecError: there are more than a scene has.
    """
    count = 0
    for name in names:
        for path in (folder / name).rglob("*"):
            relative = path.relative_to(folder)
            if BYPRODUCTS.isdisjoint(relative.parts) and path.is_file():
                count += 1
                if count > MAX_FILES:
                    raise SpecError(f"{folder}: more than {MAX_FILES} files.")
                yield relative.as_posix()


def _read(path: Path) -> dict[str, Any]:
    try:
        if path.stat().st_size > MAX_JSON_BYTES:
            raise SpecError(f"{path}: larger than {MAX_JSON_BYTES} bytes.")
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise SpecError(f"{path}: cannot be read ({error.strerror or error}).") from error
    except (ValueError, RecursionError) as error:
        raise SpecError(f"{path}: not valid JSON ({error}).") from error
    if not isinstance(document, dict) or not isinstance(document.get("checksums", {}), dict):
        raise SpecError(f"{path}: no checksums as PAT3D writes them.")
    return document
