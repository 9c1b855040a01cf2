"""Atomic replacement of files and folders: written under a temporary name beside the target, then renamed.

A reader sees the old contents or the new, never half of either; what fails leaves everything as it was.
"""

from __future__ import annotations

import os
import secrets
import shutil
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from pat3d.errors import ExportError


@contextmanager
def replaced_file(path: Path) -> Iterator[Path]:
    """A temporary path beside `path`, with its suffix, that takes its place when the block ends."""
    path.parent.mkdir(parents=True, exist_ok=True)
    writer = f"{os.getpid()}-{threading.get_native_id()}"
    temporary = path.with_name(f".{path.stem[:100]}.{writer}.part{path.suffix}")
    try:
        yield temporary
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Replace `path` by a file of `text` in UTF-8."""
    with replaced_file(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_bytes(path: Path, data: bytes) -> None:
    """Replace `path` by a file of `data`."""
    with replaced_file(path) as temporary:
        temporary.write_bytes(data)


@contextmanager
def scratch_folder(parent: Path, prefix: str) -> Iterator[Path]:
    """A new folder in `parent` that is gone when the block ends.

    Its name is known before it is made, so that a signal between the two leaves nothing; `tempfile` makes a folder
    first and learns its name after.
    """
    scratch = parent / f"{prefix}{secrets.token_hex(8)}"
    try:
        scratch.mkdir(mode=0o700)
        yield scratch
    finally:
        shutil.rmtree(scratch, ignore_errors=True)


@contextmanager
def replaced_folder(folder: Path, *, keep: Callable[[str], bool] = lambda name: False) -> Iterator[Path]:
    """A new folder that takes the place of `folder` when the block ends, and vanishes if it fails.

    Args:
        folder: with the folders above it, which are made where they are missing.
        keep: whether an entry of the earlier folder, by name, moves into the new one where that has none of the name.

    Raises:
        ExportError: something cannot be written, in the block or after it.
    """
    made = [parent for parent in folder.parents if not parent.exists()]
    done = False
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with scratch_folder(folder.parent, f".{folder.name[:40]}-") as scratch:
            fresh, old = scratch / "new", scratch / "old"
            fresh.mkdir()
            yield fresh
            _swap(fresh, folder, old, keep)
        done = True
    except OSError as error:
        raise ExportError(f"{folder}: cannot be written ({error.strerror or error}).") from error
    finally:
        if not done:
            for parent in made:
                with suppress(OSError):
                    parent.rmdir()


def _swap(fresh: Path, folder: Path, old: Path, keep: Callable[[str], bool]) -> None:
    if not folder.exists():
        fresh.rename(folder)
        return
    folder.rename(old)
    try:
        fresh.rename(folder)
    except OSError:
        old.rename(folder)
        raise
    for entry in list(old.iterdir()):
        if keep(entry.name) and not (folder / entry.name).exists():
            entry.rename(folder / entry.name)


def replace_entries(fresh: Path, folder: Path, names: Sequence[str], scratch: Path) -> None:
    """Move the entries `names` of `fresh` into `folder`, in this order; what they displace comes back if one fails.

    Args:
        fresh: holds every one of them.
        folder: keeps its other entries; where it is missing, `fresh` becomes it.
        names: the last says that all are there.
        scratch: a path on the same disk, not there yet, for what is displaced.
    """
    if not folder.exists():
        fresh.rename(folder)
        return
    scratch.mkdir()
    moved: list[str] = []
    try:
        for name in names:
            if (folder / name).exists():
                (folder / name).rename(scratch / name)
            moved.append(name)
            (fresh / name).rename(folder / name)
    except OSError:
        for name in reversed(moved):
            if (folder / name).exists():
                (folder / name).rename(fresh / f"undone-{name}")
            if (scratch / name).exists():
                (scratch / name).rename(folder / name)
        raise
    shutil.rmtree(scratch, ignore_errors=True)
