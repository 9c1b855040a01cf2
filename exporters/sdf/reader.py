"""A strict reading of what `write_sdf` writes."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pat3d.errors import ExportError, SpecError
from pat3d.exporters.common.readback import BodyReadback
from pat3d.exporters.common.xml_files import Volumes, beside, common, in_body_axes, numbers, only, read_xml, tensor
from pat3d.geometry.pose import Pose


def read_sdf(path: str | Path) -> tuple[BodyReadback, ...]:
    """Every model of the world at `path`, the ground aside; what hangs from another is a model in that one's.

    Raises:
        ExportError: anything is missing, unknown or malformed.
    """
    path = Path(path)
    world = only(read_xml(path, "sdf"), "world", str(path))
    volumes = Volumes()
    return tuple(
        body
        for model in world.findall("model")
        if model.get("name") != "ground"
        for body in _bodies(model, path, volumes, Pose())
    )


def hangs(path: str | Path) -> bool:
    """Whether two models of the world at `path` are joined by what moves; a damaged file has no joints."""
    try:
        return any(joint.get("type") != "fixed" for joint in read_xml(Path(path), "sdf").iterfind("world/joint"))
    except ExportError:
        return False


def _bodies(model: ET.Element, path: Path, volumes: Volumes, outer: Pose) -> Iterator[BodyReadback]:
    """A model whose pose is within `outer`, and those in it."""
    where = f"{path}: {model.get('name')}"
    own = _pose(model, where)
    place = Pose.from_matrix(outer.rotation @ own.rotation, outer.apply(np.array([own.position]))[0])
    # To the last bit where nothing encloses it.
    pose = own if outer == Pose() else place
    yield _body(model, path, volumes, pose, where)
    for inner in model.findall("model"):
        yield from _bodies(inner, path, volumes, pose)


def _body(model: ET.Element, path: Path, volumes: Volumes, pose: Pose, where: str) -> BodyReadback:
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
        hull_volume=sum(_volume(collision, path, volumes, where) for collision in collisions),
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


def _volume(collision: ET.Element, path: Path, volumes: Volumes, where: str) -> float:
    geometry = only(collision, "geometry", where)
    box = geometry.find("box")
    if box is not None:
        return float(np.prod(numbers(only(box, "size", where).text, 3, where)))
    return volumes.of(beside(only(only(geometry, "mesh", where), "uri", where).text, path.parent, path.parent))
