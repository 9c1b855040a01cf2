"""Does an export say what would be written of its scene, and nothing else?

The scene is written anew, and the two folders are compared file by file: bytes first, and where those differ element by
element, so that what differs has a name. Options, constraints, joints, keyframes, meshes, pictures, loaders: whatever
the writers do not write is a difference. It is independent of checksums, and of the readers of `parity`, which ask
other packages what they understand.
"""

from __future__ import annotations

import filecmp
import shutil
import tempfile
import zipfile
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from pat3d.errors import Pat3dError
from pat3d.exporters.compare import locate
from pat3d.exporters.contents.mujoco_models import model_differences
from pat3d.exporters.contents.texts import json_differences, obj_differences, png_differences, text_differences
from pat3d.exporters.contents.values import FOREIGN
from pat3d.exporters.contents.xml_trees import xml_differences
from pat3d.exporters.formats import export
from pat3d.exporters.urdf.mesh_paths import MESH_PATHS, check_mesh_paths, mesh_paths_of, set_mesh_paths
from pat3d.scene.checksums import BYPRODUCTS, MANIFEST
from pat3d.scene.folder import read_json
from pat3d.scene.model import Scene

MAX_LINES = 6
"""Told of one file."""

MAX_PACKAGE_BYTES = 2**30

_XML = (".xml", ".urdf", ".sdf", ".config")
_USD = (".usdc", ".usda", ".usd")


@dataclass(frozen=True, kw_only=True)
class ContentsReport:
    """What an export says that its scene does not, or the reverse."""

    format: str
    path: str
    """Main file."""
    failures: tuple[str, ...]
    """A line for every difference."""
    identical: bool
    """Every byte is what would be written here and now."""

    @property
    def passed(self) -> bool:
        """It says what the scene says."""
        return not self.failures

    @property
    def foreign(self) -> bool:
        """There is something in it that other programs should not be let loose on."""
        return any(FOREIGN in line for line in self.failures)


def contents(scene: Scene, path: str | Path, *, anew: Path | None = None) -> ContentsReport:
    """Compare everything in the folder of the export at `path` with what would be written of `scene`.

    Args:
        scene: what the export is of.
        path: a written file, or its folder.
        anew: the folder of what is written of `scene` in this format; a temporary one where not given.

    Raises:
        ExportError: there is no export at `path`, or its format cannot be written here.
    """
    kind, main = locate(Path(path))
    folder = main.parent
    with tempfile.TemporaryDirectory(prefix="pat3d-contents-") as scratch:
        if anew is None:
            package = (folder / "scene.usdz").is_file()
            usd: dict[str, Any] = {"text": main.suffix == ".usda", "package": package} if kind == "usd" else {}
            anew = export(scene, (kind,), scratch, **usd)[kind].parent
        if kind == "urdf" and (how := mesh_paths_of(read_json(folder / "manifest.json"))) != MESH_PATHS[0]:
            anew = Path(shutil.copytree(anew, Path(scratch) / "paths"))
            set_mesh_paths(anew, check_mesh_paths(how), home=folder)
        lines = tuple(f"{folder / name}: {line}." for name, line in _folders(folder, anew))
        same = (filecmp.cmp(folder / name, anew / name, shallow=False) for name in _names(anew))
        identical = not lines and all(same)
    return ContentsReport(format=kind, path=str(main), failures=lines, identical=identical)


def _folders(found: Path, expected: Path) -> Iterator[tuple[str, str]]:
    """(file, what is different in it) of two folders."""
    here, there = _names(found), _names(expected)
    for name in sorted(here - there - {MANIFEST}):
        yield name, f"is a file that {FOREIGN}"
    for name in sorted(there - here):
        yield name, "is missing"
    for name in sorted(here & there):
        if filecmp.cmp(found / name, expected / name, shallow=False):
            continue
        lines = _file(found / name, expected / name)
        try:
            told = list(islice(lines, MAX_LINES + 1))
        except Pat3dError as error:
            told = [str(error).removeprefix(f"{name}: ").rstrip(".")]
        yield from ((name, line) for line in told[:MAX_LINES])
        if len(told) > MAX_LINES:
            yield name, "differs in more than that"


def _names(folder: Path) -> set[str]:
    relative = (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())
    return {path.as_posix() for path in relative if BYPRODUCTS.isdisjoint(path.parts)}


def _file(found: Path, expected: Path) -> Iterator[str]:
    """What differs between two files of one name."""
    suffix = expected.suffix
    if suffix in _XML:
        lines = list(xml_differences(found, expected))
        # Only what reads the same is handed to MuJoCo: a file may ask for a million copies of something.
        if not lines and suffix == ".xml" and expected.name != "package.xml":
            lines = list(model_differences(found, expected))
        yield from lines
    elif suffix in _USD:
        from pat3d.exporters.contents.usd_layers import layer_differences

        yield from layer_differences(found, expected)
    elif suffix == ".usdz":
        yield from _packages(found, expected)
    elif suffix == ".json":
        yield from json_differences(found, expected)
    elif suffix == ".obj":
        yield from obj_differences(found, expected)
    elif suffix == ".png":
        yield from png_differences(found, expected)
    else:
        yield from text_differences(found, expected)


def _packages(found: Path, expected: Path) -> Iterator[str]:
    """What differs between two .usdz files, which are archives of layers and pictures."""
    with tempfile.TemporaryDirectory(prefix="pat3d-usdz-") as scratch:
        folders = []
        for number, path in enumerate((found, expected)):
            folders.append(Path(scratch) / str(number))
            try:
                with zipfile.ZipFile(path) as archive:
                    if sum(member.file_size for member in archive.infolist()) > MAX_PACKAGE_BYTES:
                        yield f"holds more than {MAX_PACKAGE_BYTES} bytes"
                        return
                    if len(set(archive.namelist())) != len(archive.namelist()):
                        yield "holds two files of one name"
                        return
                    archive.extractall(folders[-1])
            except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError, RuntimeError) as error:
                yield f"cannot be read ({error})"
                return
        yield from (f"{name} {line}" for name, line in _folders(*folders))
