"""Export folders appear complete or not at all, and replace only earlier exports."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pat3d.errors import ExportError
from pat3d.scene.replacement import replaced_folder


@contextmanager
def export_folder(folder: Path, *, marker: str, what: str, or_markers: tuple[str, ...] = ()) -> Iterator[Path]:
    """A new folder that takes the place of `folder` when the block ends.

    Args:
        folder: where the export belongs.
        marker: file by which an earlier export of the kind is known.
        what: name of the format, for messages.
        or_markers: other files by which one is known.

    Raises:
        ExportError: `folder` is a file, holds something else than an export of the kind, or cannot be written.
    """
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"{folder} is a file; give a folder to write the {what} into.")
    known = any((folder / name).is_file() for name in (marker, *or_markers))
    if folder.exists() and any(folder.iterdir()) and not known:
        raise ExportError(f"{folder} is not empty and holds no {marker}; give a new folder or an earlier export.")
    with replaced_folder(folder) as fresh:
        yield fresh
