"""A suite's folder: where its parts are, whose it is at the moment, and checksums.

    suite.json          the request, versions, splits and every scene with its checksum; rewritten at the end of a run
    scenes/000123/      a scene folder with record.json (task, split, axes, verification); complete when it appears
    rejected/000123-00.json   why a candidate for a place did not become its scene
    index.html          one page with pictures and numbers
    README.md           its card: what it is, what it measures and what not, how to cite it
    env.py              make_env, for LeRobot
    log.jsonl           what took how long; the only file that differs between two runs of the same request
    .work/              unfinished scenes; emptied when a run begins and ends

The queue is the folder itself: a place is done when its scene is there, and its next candidate is the first without
a rejection. Both appear by renaming, so that a run may be killed at any moment.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pat3d.errors import ExportError, SuiteError
from pat3d.scene import replacement
from pat3d.scene.folder import finite

MANIFEST, SCENES, REJECTED, WORK, LOCK, LOG, PAGE, HUB = (
    "suite.json",
    "scenes",
    "rejected",
    ".work",
    ".lock",
    "log.jsonl",
    "index.html",
    "env.py",
)
RECORD = "record.json"
SELF = "manifest_sha256"
"""Key of suite.json's checksum of itself."""
FORMAT, VERSION = "pat3d-suite", 2

MAX_MANIFEST_BYTES = 2 * 2**30
MAX_SCENE_FILES = 20_000

_REJECTION = re.compile(r"(\d{6})-(\d{2})\.json")
_SCENE = re.compile(r"\d{6}")


def scene_name(place: int) -> str:
    """Of the folder of a place's scene."""
    return f"{place:06d}"


class SuiteFolder:
    """The files of a suite."""

    def __init__(self, path: str | os.PathLike[str]) -> None:
        self.path = Path(path).expanduser().resolve()

    def scene(self, place: int) -> Path:
        """Folder of a place's scene, from 0."""
        return self.path / SCENES / scene_name(place)

    def rejection(self, place: int, candidate: int) -> Path:
        """File on why a candidate was rejected, both from 0."""
        return self.path / REJECTED / f"{scene_name(place)}-{candidate:02d}.json"

    @property
    def work(self) -> Path:
        """For unfinished scenes."""
        return self.path / WORK

    def done(self) -> set[int]:
        """Places whose scenes are there."""
        return {int(one.name) for one in _entries(self.path / SCENES) if _SCENE.fullmatch(one.name)}

    def rejected(self) -> dict[int, int]:
        """How many candidates of a place were rejected, where any were."""
        known: dict[int, set[int]] = {}
        for one in _entries(self.path / REJECTED):
            if match := _REJECTION.fullmatch(one.name):
                known.setdefault(int(match[1]), set()).add(int(match[2]))
        return {place: next(n for n in range(len(numbers) + 1) if n not in numbers) for place, numbers in known.items()}

    def check_usable(self) -> None:
        """Raise ExportError where the folder is a file, or has other things in it than a suite."""
        try:
            if self.path.exists() and not self.path.is_dir():
                raise ExportError(f"{self.path} is a file; give a folder. Nothing was written.")
            others = [one.name for one in _entries(self.path)]
            if others and MANIFEST not in others:
                raise ExportError(f"{self.path} holds files but no {MANIFEST}; give a new folder. Nothing was written.")
        except OSError as error:
            raise ExportError(f"{self.path}: {error.strerror or error}.") from error

    @contextmanager
    def locked(self) -> Iterator[None]:
        """Have the folder to oneself; another process that tries is told whose it is.

        The lock is the system's and ends with the process, however that ends; the file only tells who has it.

        Raises:
            SuiteError: another process has it.
            ExportError: nothing can be written there.
        """
        # There is none on Windows, where suites can be used but not made.
        import fcntl

        try:
            self.path.mkdir(parents=True, exist_ok=True)
            handle = os.open(self.path / LOCK, os.O_RDWR | os.O_CREAT, 0o644)
        except OSError as error:
            raise ExportError(f"{self.path}: cannot be written ({error.strerror or error}).") from error
        try:
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                owner = os.pread(handle, 200, 0).decode(errors="replace").strip() or "another process"
                raise SuiteError(
                    f"{self.path} is in use by {owner}; wait for it, or end it and run the same command again."
                ) from None
            os.ftruncate(handle, 0)
            os.pwrite(handle, f"process {os.getpid()} on {os.uname().nodename}\n".encode(), 0)
            yield
            os.ftruncate(handle, 0)
        finally:
            os.close(handle)

    def clear_work(self) -> None:
        """Remove what unfinished runs left."""
        shutil.rmtree(self.work, ignore_errors=True)


def write_document(path: Path, document: Any) -> None:
    """Write JSON under a temporary name first; equal documents give equal bytes.

    Raises:
        ExportError: it cannot be written.
    """
    text = json.dumps(finite(document), indent=1, allow_nan=False, ensure_ascii=False) + "\n"
    write_text(path, text)


def write_text(path: Path, text: str) -> None:
    """Write a text file under a temporary name first.

    Raises:
        ExportError: it cannot be written.
    """
    try:
        replacement.write_text(path, text)
    except OSError as error:
        raise ExportError(f"{path}: cannot be written ({error.strerror or error}).") from error


def read_document(path: Path, limit: int = MAX_MANIFEST_BYTES) -> dict[str, Any]:
    """The object in a JSON file.

    Raises:
        SuiteError: there is none, or it is damaged or too large.
    """
    try:
        if path.stat().st_size > limit:
            raise SuiteError(f"{path}: larger than {limit} bytes.")
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise SuiteError(f"{path}: cannot be read ({error.strerror or error}).") from error
    except (ValueError, RecursionError) as error:
        raise SuiteError(f"{path}: damaged ({error}).") from error
    if not isinstance(document, dict):
        raise SuiteError(f"{path}: damaged (no JSON object).")
    return document


def checksum_of_document(document: Mapping[str, Any]) -> str:
    """SHA-256 over a suite.json without SELF, whatever its white space and the order of its keys."""
    content = finite({name: value for name, value in document.items() if name != SELF})
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def checksum_of(folder: Path) -> str:
    """SHA-256 over relative names and contents of all files in a scene's folder but record.json, which holds it.

    Raises:
        SuiteError: it cannot be read, or has more files than a scene has.
    """
    digest = hashlib.sha256()
    try:
        paths = sorted(path for path in folder.rglob("*") if path.is_file() and path != folder / RECORD)
        if len(paths) > MAX_SCENE_FILES:
            raise SuiteError(f"{folder}: {len(paths)} files; a scene has at most {MAX_SCENE_FILES}.")
        for path in paths:
            content = path.read_bytes()
            digest.update(f"{path.relative_to(folder).as_posix()}\0{len(content)}\0".encode())
            digest.update(content)
    except OSError as error:
        raise SuiteError(f"{folder}: cannot be read ({error.strerror or error}).") from error
    return digest.hexdigest()


def _entries(folder: Path) -> list[Path]:
    return sorted(one for one in folder.iterdir() if one.name != LOCK) if folder.is_dir() else []
