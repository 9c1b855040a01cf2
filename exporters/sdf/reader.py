"""A strict reading of what `write_sdf` writes."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError, SpecError
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
from pat3d.geometry.pose import Pose


def read_sdf(path: str | Path) -> tuple[BodyReadback, ...]:
    """Every model of the world at `path`, the ground aside; what hangs from another is a model in that one's.

    Raises:
        ExportError: anything is missing, unknown or malformed.
    """
    path = Path(path)
    world = only(read_xml(path, "sdf"), "world", str(path))
    meshes = MeshCorners()
    return tuple(
        body
        for model in world.findall("model")
        if model.get("name") != "ground"
        for body in _bodies(model, path, meshes, Pose())
    )


def _bodies(model: ET.Element, path: Path, meshes: MeshCorners, outer: Pose) -> Iterator[BodyReadback]:
    """A model whose pose is within `outer`, and those in it."""
    where = f"{path}: {model.get('name')}"
    own = _pose(model, where)
    place = Pose.from_matrix(outer.rotation @ own.rotation, outer.apply(np.array([own.position]))[0])
    # To the last bit where nothing encloses it.
    pose = own if outer == Pose() else place
    yield _body(model, path, meshes, pose, where)
    for inner in model.findall("model"):
        yield from _bodies(inner, path, meshes, pose)


def _body(model: ET.Element, path: Path, meshes: MeshCorners, pose: Pose, where: str) -> BodyReadback:
    link = only(model, "link", where)
    inertial = only(link, "inertial", where)
    frame = _pose(inertial, where)
    inertia = only(inertial, "inertia", where)
    moments = tensor(*(_value(inertia, key, where) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")))
    collisions = link.findall("collision")
    frictions = []
    for collision in collisions:
        ode = only(only(only(collision, "surface", where), "friction", where), "ode", where)
        frictions += [_value(ode, key, where) for key in ("mu", "mu2")]
    return BodyReadback(
        name=str(model.get("name")),
        mass=_value(inertial, "mass", where),
        centre=np.array(frame.position),
        inertia=in_body_axes(moments, frame.rotation),
        friction=common(frictions),
        hulls=tuple(_corners(collision, path, meshes, where) for collision in collisions),
        pose=pose,
        fixed=model.findtext("static", "false").strip() in ("true", "1"),
    )


def _value(parent: ET.Element, tag: str, where: str) -> float:
    return float(numbers(only(parent, tag, where).text, 1, where)[0])


def _pose(parent: ET.Element, where: str) -> Pose:
    element = only(parent, "pose", where)
    if element.get("rotation_format") != "quat_xyzw":
        raise ExportError(f"{where}: a pose whose rotation is no quaternion.")
    px, py, pz, x, y, z, w = numbers(element.text, 7, where)
    try:
        return Pose(position=(px, py, pz), quat_wxyz=(w, x, y, z))
    except SpecError as error:
        raise ExportError(f"{where}: {error}") from error


def _corners(collision: ET.Element, path: Path, meshes: MeshCorners, where: str) -> NDArray[np.float64]:
    """Corners of a collider [m], in the frame of its link, shape (corners, 3)."""
    geometry = only(collision, "geometry", where)
    box = geometry.find("box")
    if box is not None:
        corners = box_corners(numbers(only(box, "size", where).text, 3, where))
    else:
        uri = only(only(geometry, "mesh", where), "uri", where).text
        corners = meshes.of(beside(uri, path.parent, path.parent))
    return _pose(collision, where).apply(corners) if collision.find("pose") is not None else corners
