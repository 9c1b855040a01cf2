"""How the URDF files of an export name their meshes: relative to themselves, through a ROS package, or from the root.

Relative paths move with the folder; PyBullet, Drake, yourdfpy and SAPIEN read them. ROS wants `package://`, and
Pinocchio, which looks for a relative path in the folder that the program was started in, takes absolute ones without
being told anything.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.xml_files import read_xml
from pat3d.scene.folder import read_json, write_json
from pat3d.scene.replacement import replaced_file

PACKAGE = "pat3d_scene"
"""Name of the package that the folder of an export is, in package.xml and in scene.dmd.yaml."""

MESH_PATHS = ("relative", "package", "absolute")


def mesh_paths_of(manifest: dict[str, Any]) -> str:
    """How an export's files name their meshes."""
    return str(manifest.get("mesh_paths", MESH_PATHS[0]))


def check_mesh_paths(how: str) -> str:
    """`how`, if it is one of MESH_PATHS.

    Raises:
        SpecError: it is not.
    """
    if how not in MESH_PATHS:
        raise SpecError(f'unknown mesh paths "{how}". Valid: {", ".join(MESH_PATHS)}.')
    return how


def set_mesh_paths(folder: str | Path, how: str, *, home: str | Path | None = None) -> None:
    """Let every URDF file of the export in `folder` name its meshes by paths of the kind `how`.

    Args:
        folder: holds manifest.json.
        how: one of MESH_PATHS.
        home: where the folder will lie, for absolute paths; itself where None.

    Raises:
        SpecError: an unknown kind.
        ExportError: there is no export in `folder`.
    """
    check_mesh_paths(how)
    folder = Path(folder)
    root = Path(folder if home is None else home).resolve()
    path = folder / "manifest.json"
    manifest = read_json(path)
    if "objects" not in manifest:
        raise ExportError(f"{path} is not the manifest of a URDF export.")
    ET.register_namespace("drake", "http://drake.mit.edu")
    for file in sorted(folder.rglob("*.urdf")):
        read_xml(file, "robot")
        robot = ET.parse(file, ET.XMLParser(target=ET.TreeBuilder(insert_comments=True))).getroot()
        for mesh in robot.iter("mesh"):
            inside = mesh_file(mesh.get("filename"), file.parent, folder, root).relative_to(folder.resolve())
            if how == "package":
                mesh.set("filename", f"package://{PACKAGE}/{inside.as_posix()}")
            elif how == "absolute":
                mesh.set("filename", (root / inside).as_posix())
            else:
                beside = file.parent.resolve().relative_to(folder.resolve())
                mesh.set("filename", inside.relative_to(beside).as_posix())
        ET.indent(robot)
        with replaced_file(file) as fresh:
            ET.ElementTree(robot).write(fresh, encoding="utf-8", xml_declaration=True)
    manifest["mesh_paths"] = how
    write_json(path, manifest)


def mesh_file(name: str | None, folder: Path, root: Path, home: Path | None = None) -> Path:
    """The file that a mesh's path in a URDF of `folder` means; it may not leave the export in `root`.

    Args:
        name: the path, of any kind.
        folder: of the URDF file.
        root: of the export.
        home: where absolute paths say that the export lies; `root` itself where None.

    Raises:
        ExportError: it leaves the export.
    """
    top = root.resolve()
    given = name or ""
    if given.startswith(f"package://{PACKAGE}/"):
        path = top / given.removeprefix(f"package://{PACKAGE}/")
    elif Path(given).is_absolute() and home is not None and Path(given).is_relative_to(home):
        path = top / Path(given).relative_to(home)
    else:
        path = folder / given
    path = path.resolve()
    if not given or not path.is_relative_to(top):
        raise ExportError(f'"{name}" is no file inside {root}.')
    return path
