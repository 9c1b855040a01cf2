"""COLLADA, 3MF and FBX files, which a process of its own writes as GLB for the reader of meshes."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from pat3d.errors import AssetError

FORMATS = {"dae": "pycollada", "3mf": "lxml", "fbx": "ufbx"}
"""Ends of the names of what is converted, and the package of the extra "meshes" that reads each."""

SECONDS = 120
"""Processor time for a file; a million triangles of COLLADA take a tenth of it."""

WAIT = 900.0
"""[s] until a process that does not end is given up, however busy the machine is."""


@dataclass(frozen=True, kw_only=True)
class Converted:
    """A mesh file as GLB, in its own units and axes."""

    glb: bytes
    metres: float
    """[m] of its unit."""
    up: str
    """Its axis that points up."""
    notes: tuple[str, ...]
    opened: tuple[Path, ...]
    """Pictures that it was read with."""


def as_glb(path: Path, root: Path) -> Converted:
    """The file at `path` as GLB; pictures lie below `root`.

    Raises:
        AssetError: the package that reads it is missing, or it cannot be read.
    """
    kind = path.suffix.lower().lstrip(".")
    with tempfile.TemporaryDirectory(prefix="pat3d-") as folder:
        target, told = Path(folder, "mesh.glb"), Path(folder, "told.json")
        command = [sys.executable, "-P", "-m", "pat3d.assets.mesh.convert_worker"]
        command += [str(path.resolve()), str(target), str(told), str(root.resolve()), str(SECONDS)]
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, timeout=WAIT, check=False)
        except subprocess.TimeoutExpired:
            raise AssetError(f'"{path}" was not read within {WAIT:g} s.') from None
        answer = json.loads(told.read_text(encoding="utf-8")) if told.is_file() else {}
        if "missing" in answer:
            raise AssetError(
                f"reading {kind.upper()} needs {FORMATS[kind]}, which is not installed: pip install 'pat3d[meshes]'."
            )
        if "error" in answer or not target.is_file():
            ended = f"its reader ended with code {done.returncode}"
            if done.returncode == -signal.SIGXCPU:
                ended = f"it was given up after {SECONDS} s of processor time"
            why = answer.get("error", ended)
            raise AssetError(f'"{path}" cannot be read as {kind.upper()}: {why}.')
        return Converted(
            glb=target.read_bytes(),
            metres=float(answer["metres"]),
            up=str(answer["up"]),
            notes=tuple(answer["notes"]),
            opened=tuple(map(Path, answer["opened"])),
        )
