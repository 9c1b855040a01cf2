"""Export folders appear complete or not at all, and replace only earlier exports."""

from __future__ import annotations

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pat3d.errors import ExportError


@contextmanager
def export_folder(folder: Path, *, marker: str, what: str) -> Iterator[Path]:
    """A new folder that takes the place of `folder` when the block ends.

    Args:
        folder: where the export belongs.
        marker: file by which an earlier export of the kind is known.
        what: name of the format, for messages.

    Raises:
        ExportError: `folder` is a file, holds something else than an export of the kind, or cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"{folder} is a file; give a folder to write the {what} into.")
    if folder.exists() and any(folder.iterdir()) and not (folder / marker).is_file():
        raise ExportError(f"{folder} is not empty and holds no {marker}; give a new folder or an earlier export.")
    try:
        folder.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder.parent, prefix=f".{what.lower()}-") as temporary:
            fresh = Path(temporary) / "new"
            fresh.mkdir()
            yield fresh
            if folder.exists():
                folder.rename(Path(temporary) / "old")
            try:
                fresh.rename(folder)
            except OSError:
                shutil.move(Path(temporary) / "old", folder)
                raise
    except OSError as error:
        raise ExportError(f"{folder}: cannot be written ({error.strerror or error}).") from error
