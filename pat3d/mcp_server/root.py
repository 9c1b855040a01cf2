"""The one folder that a server may read and write: scenes are its subfolders, by plain names."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from pat3d.errors import SpecError

NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")
"""A name that is a folder everywhere and leads nowhere else."""


@dataclass(frozen=True)
class Root:
    """Scenes in one folder."""

    folder: Path
    """Absolute, without links."""

    @staticmethod
    def at(folder: str | Path) -> Root:
        """The root at `folder`, made where it is missing.

        Raises:
            SpecError: it is a file, or cannot be made.
        """
        path = Path(folder).expanduser()
        try:
            path.mkdir(parents=True, exist_ok=True)
            path = path.resolve(strict=True)
        except OSError as error:
            raise SpecError(f"{folder}: not a folder for scenes ({error.strerror or error}).") from error
        return Root(path)

    def named(self, name: str) -> Path:
        """The folder called `name`, whether it is there or not.

        Raises:
            SpecError: the name is none, or leads out of the root.
        """
        if NAME.fullmatch(name) is None:
            raise SpecError(f'"{name[:80]}" is no scene name; valid: letters, digits, "-" and "_", at most 64.')
        path = self.folder / name
        if path.is_symlink() or (path.exists() and path.resolve().parent != self.folder):
            raise SpecError(f'"{name}" leads out of the folder for scenes.')
        return path

    def scene(self, name: str) -> Path:
        """The folder of the scene called `name`.

        Raises:
            SpecError: there is none.
        """
        path = self.named(name)
        if not (path / "scene.json").is_file():
            known = ", ".join(self.scenes()[:50]) or "none yet"
            raise SpecError(f'there is no scene "{name}". Scenes: {known}.')
        return path

    def scenes(self) -> list[str]:
        """Names of the scenes that are there."""
        found = [path for path in self.folder.iterdir() if not path.is_symlink() and (path / "scene.json").is_file()]
        return sorted(path.name for path in found if NAME.fullmatch(path.name))
