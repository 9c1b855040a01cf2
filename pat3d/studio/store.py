"""The folder that a studio reads and writes, and how two of them keep out of one another's way.

A scene is opened as a copy, so that undo goes back to it whatever happens to the folder. It is saved only over what
this studio opened or wrote itself, under a lock that other studios respect, and always as a whole.
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from pat3d.errors import EditError, ExportError, SpecError
from pat3d.mcp_server.root import NAME, Root
from pat3d.progress import Progress, silent
from pat3d.scene.folder import check_target
from pat3d.studio import jobs
from pat3d.studio.session import Session
from pat3d.studio.worker import Run, here


class Store:
    """Scenes of one root folder, and a scratch folder for copies; `close` removes the copies."""

    def __init__(self, root: Root) -> None:
        """Scenes are read from and written to subfolders of `root`."""
        self.root = root
        self._scratch = tempfile.TemporaryDirectory(prefix="pat3d-studio-")
        self._known: dict[Path, str] = {}
        self._copies = 0

    @property
    def scratch(self) -> Path:
        """Where copies and temporary files are until `close`."""
        return Path(self._scratch.name)

    def close(self) -> None:
        """Remove the copies; sessions that were opened cannot be saved any more."""
        self._scratch.cleanup()

    def fresh(self) -> Path:
        """A folder that is not there yet, for a copy or a new scene."""
        self._copies += 1
        return self.scratch / f"scene-{self._copies}"

    def opened(self, folder: str | Path) -> Session:
        """A copy of the scene in `folder`.

        Raises:
            SpecError: there is no scene, or it is damaged.
        """
        from pat3d.generation.rewrite import copy_folder, read_folder

        source = Path(folder).expanduser()
        read_folder(source, silent)
        copy = self.fresh()
        with _locked(source.resolve()):
            copy_folder(source, copy)
            self._known[source.resolve()] = _state(source)
        return Session.opened(copy)

    def saved(self, session: Session, name: str, progress: Progress = silent, *, run: Run = here) -> Path:
        """Write the scene, which is at rest, into the folder called `name` of the root. `run` does the work.

        Raises:
            SpecError: `name` is none.
            EditError: edits wait to be settled.
            ExportError: the folder holds a scene of somebody else, or cannot be written.
        """
        target = self._target(name)
        if not session.at_rest:
            raise EditError("edits wait to be settled: Settle first, then save. Nothing was written.")
        with _locked(target):
            if _state(target) not in ("", self._known.get(target)):
                raise ExportError(
                    f'"{name}" holds a scene that was not opened here, or that was changed since; give another name. '
                    "Nothing was written."
                )
            run(jobs.saved, session.current, target, progress=progress)
            self._known[target] = _state(target)
        return target

    def exported(
        self, session: Session, name: str, formats: Sequence[str], progress: Progress = silent, *, run: Run = here
    ) -> list[Path]:
        """Write the scene, which is at rest, in `formats` into the folder NAME-export of the root. `run` does the work.

        Raises:
            SpecError: `name` is none, or no format is chosen.
            EditError: edits wait to be settled.
            ExportError: a format's packages are missing, or a folder cannot be written.
            CheckError: what was written does not read back as the same scene.
        """
        if not session.at_rest:
            raise EditError("edits wait to be settled: Settle first, then export. Nothing was written.")
        target = self._target(f"{name}-export")
        with _locked(target):
            return run(jobs.exported, session.scene, tuple(formats), target, progress=progress)

    def name_for(self, words: str) -> str:
        """A name of letters and digits that `words` suggest, and that no folder of the root has."""
        kept = "".join(one if one.isascii() and one.isalnum() else " " for one in words.lower()).split()
        stem = "-".join(word for word in kept if word not in ("a", "an", "the", "on", "of", "and", "with"))[:40]
        stem = stem.strip("-") or "scene"
        taken = {path.name for path in self.root.folder.iterdir()}
        number = 1
        while (found := stem if number == 1 else f"{stem}-{number}") in taken:
            number += 1
        return found

    def _target(self, name: str) -> Path:
        try:
            return check_target(self.root.named(name.strip()))
        except SpecError as error:
            raise SpecError(f"{error} Nothing was written.") from error


def name_of(folder: Path) -> str:
    """The folder's own name where it can be given in a studio, else "scene"."""
    return folder.name if NAME.fullmatch(folder.name) else "scene"


def _state(folder: Path) -> str:
    """A fingerprint of the scene in `folder`; empty where there is none."""
    try:
        return hashlib.sha256((folder / "scene.json").read_bytes()).hexdigest()
    except OSError:
        return ""


@contextmanager
def _locked(folder: Path) -> Iterator[None]:
    """While this lasts no other studio reads or writes the scene in `folder`.

    Raises:
        ExportError: another one does.
    """
    # The folder itself is replaced as a whole; the one it is in stays.
    try:
        above = os.open(next(parent for parent in folder.parents if parent.exists()), os.O_RDONLY)
    except OSError as error:
        raise ExportError(f"{folder}: cannot be reached ({error.strerror or error}). Nothing was written.") from error
    try:
        try:
            fcntl.flock(above, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise ExportError(f"{folder.parent} is being used by another studio; try again.") from error
        yield
    finally:
        os.close(above)
