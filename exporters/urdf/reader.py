"""A strict reading of what `write_urdf` writes: the manifest, the objects' files, Drake's model directives."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.frames import rotation_of
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.common.xml_files import (
    MeshCorners,
    beside,
    box_corners,
    common,
    in_body_axes,
    numbers,
    only,
    read_xml,
    tensor,
)
from pat3d.exporters.urdf.mesh_paths import PACKAGE, mesh_file
from pat3d.exporters.urdf.writer import FORMAT, VERSION
from pat3d.geometry.pose import Pose
from pat3d.scene.folder import read_json


def read_manifest(folder: Path) -> dict[str, Any]:
    """The manifest of a URDF export.

    Raises:
        ExportError: there is none in `folder`, or it is of another version.
    """
    manifest = read_json(folder / "manifest.json")
    if manifest.get("format") != FORMAT or manifest.get("version") != VERSION:
        raise ExportError(f"{folder / 'manifest.json'} is not a {FORMAT} manifest of version {VERSION}.")
    entries = manifest.get("objects")
    needed = {"name", "file", "link", "fixed", "position", "quat_xyzw", "friction"}
    if not isinstance(entries, list) or not all(isinstance(one, dict) and needed <= set(one) for one in entries):
        raise ExportError(f"{folder / 'manifest.json'}: every object needs {', '.join(sorted(needed))}.")
    return manifest


def read_urdf(folder: str | Path) -> tuple[BodyReadback, ...]:
    """Every object of the export in `folder`: its file, at the pose of the manifest.

    Raises:
        ExportError: anything is missing, unknown or malformed.
    """
    folder = Path(folder)
    meshes, known = MeshCorners(), {}
    bodies = []
    for entry in read_manifest(folder)["objects"]:
        if entry["file"] not in known:
            path = beside(entry["file"], folder, folder)
            known[entry["file"]] = read_robot(path, folder, meshes)
        link, body = known[entry["file"]]
        if entry["link"] != link:
            raise ExportError(f'{entry["file"]} has the link "{link}", not "{entry["link"]}".')
        x, y, z, w = numbers(_words(entry["quat_xyzw"]), 4, "quat_xyzw")
        position = numbers(_words(entry["position"]), 3, "position")
        bodies.append(
            replace(
                body,
                name=entry["name"],
                fixed=bool(entry["fixed"]),
                pose=_pose(position, (w, x, y, z)),
                friction=common([body.friction, float(entry["friction"])]),
            )
        )
    return tuple(bodies)


def read_robot(path: Path, root: Path, meshes: MeshCorners) -> tuple[str, BodyReadback]:
    """The name of the one link of the URDF at `path`, and the link as a body at the origin.

    Raises:
        ExportError: it has several links or joints, or anything is missing or malformed.
    """
    robot = read_xml(path, "robot")
    if robot.find("joint") is not None:
        raise ExportError(f"{path}: one object has no joints.")
    link = only(robot, "link", str(path))
    where = f"{path}: {link.get('name')}"
    inertial = only(link, "inertial", where)
    centre, axes = _origin(inertial, where)
    inertia = only(inertial, "inertia", where).attrib
    moments = tensor(
        *(float(numbers(inertia.get(key), 1, where)[0]) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    )
    collisions = link.findall("collision")
    lateral = only(only(link, "contact", where), "lateral_friction", where).get("value")
    frictions = [float(numbers(lateral, 1, where)[0])]
    for collision in collisions:
        properties = only(collision, "{http://drake.mit.edu}proximity_properties", where)
        for key in ("mu_static", "mu_dynamic"):
            value = only(properties, f"{{http://drake.mit.edu}}{key}", where).get("value")
            frictions.append(float(numbers(value, 1, where)[0]))
    body = BodyReadback(
        name=str(link.get("name")),
        mass=float(numbers(only(inertial, "mass", where).get("value"), 1, where)[0]),
        centre=centre,
        inertia=in_body_axes(moments, axes),
        friction=common(frictions),
        hulls=tuple(_corners(collision, path, root, meshes, where) for collision in collisions),
        pose=Pose(),
        fixed=False,
    )
    return str(link.get("name")), body


def _origin(element: ET.Element, where: str) -> tuple[np.ndarray, np.ndarray]:
    """Position [m] and rotation matrix of an <origin>."""
    origin = only(element, "origin", where)
    return numbers(origin.get("xyz"), 3, where), rotation_of(*numbers(origin.get("rpy"), 3, where))


def _corners(collision: ET.Element, path: Path, root: Path, meshes: MeshCorners, where: str) -> NDArray[np.float64]:
    """Corners of a collider [m], in the frame of its link, shape (corners, 3)."""
    geometry = only(collision, "geometry", where)
    box = geometry.find("box")
    if box is not None:
        corners = box_corners(numbers(box.get("size"), 3, where))
    else:
        mesh = only(geometry, "mesh", where)
        scale = numbers(mesh.get("scale", "1 1 1"), 3, where)
        corners = meshes.of(mesh_file(mesh.get("filename"), path.parent, root)) * scale
    if collision.find("origin") is None:
        return corners
    position, turn = _origin(collision, where)
    return corners @ turn.T + position


def _words(values: Any) -> str:
    return " ".join(map(str, values)) if isinstance(values, list) else ""


def _pose(position: Any, quat_wxyz: Any) -> Pose:
    try:
        return Pose(position=tuple(position), quat_wxyz=tuple(quat_wxyz))
    except SpecError as error:
        raise ExportError(str(error)) from error


def read_directives(folder: str | Path) -> tuple[BodyReadback, ...]:
    """Every object of the export in `folder`: its file, at the pose of scene.dmd.yaml.

    Raises:
        ExportError: anything is missing, unknown or malformed.
    """
    folder = Path(folder)
    path = folder / "scene.dmd.yaml"
    meshes = MeshCorners()
    files: dict[str, str] = {}
    placed: dict[str, tuple[bool, Mapping[str, Any]]] = {}
    try:
        for directive in _load(path)["directives"]:
            ((kind, entry),) = directive.items()
            if kind == "add_model":
                files[entry["name"]] = str(entry["file"]).removeprefix(f"package://{PACKAGE}/")
                for transform in entry.get("default_free_body_pose", {}).values():
                    placed[entry["name"]] = (False, transform)
            else:
                placed[entry["child"].split("::")[0]] = (True, entry.get("X_PC", {}))
        bodies = []
        for name in files:
            if name == "ground":
                continue
            fixed, transform = placed[name]
            _, body = read_robot(beside(files[name], folder, folder), folder, meshes)
            bodies.append(replace(body, name=name, fixed=fixed, pose=_transform(transform)))
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise ExportError(f"{path}: not the directives of a scene ({error}).") from error
    return tuple(bodies)


def _load(path: Path) -> Any:
    """The YAML document at `path`; Drake's one tag becomes plain data."""
    import yaml

    class Loader(yaml.SafeLoader):
        pass

    Loader.add_constructor("!AngleAxis", _plain)
    try:
        if path.stat().st_size > 2**24:
            raise ExportError(f"{path}: larger than {2**24} bytes.")
        return Loader(path.read_text(encoding="utf-8")).get_single_data()
    except OSError as error:
        raise ExportError(f"{path}: cannot be read ({error.strerror or error}).") from error
    except yaml.YAMLError as error:
        raise ExportError(f"{path}: not valid YAML ({error}).") from error


def _plain(loader: Any, node: Any) -> Any:
    return loader.construct_mapping(node, deep=True)


def _transform(transform: Mapping[str, Any]) -> Pose:
    rotation = transform["rotation"]
    half = math.radians(float(rotation["angle_deg"])) / 2.0
    axis = [float(value) for value in rotation["axis"]]
    return _pose(map(float, transform["translation"]), (math.cos(half), *(math.sin(half) * value for value in axis)))
