"""SDF worlds as MuJoCo specifications: models of one link, static or free, with primitives and convex meshes.

Joints between links, height maps and frames other than the enclosing one are refused by name rather than guessed.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.check.foreign.shapes import add_body, add_geom, add_hull, new_spec, set_mass, within
from pat3d.errors import AssetError, CheckError
from pat3d.exporters.common.frames import rotation_of
from pat3d.exporters.common.xml_files import numbers, read_xml, tensor
from pat3d.geometry.pose import Pose

MAX_DEPTH = 8
"""Of models that include models."""


def read_sdf_scene(path: Path) -> tuple[Any, tuple[str, ...]]:
    """The specification of the world, or the models, in the SDF file at `path`, and notes.

    Raises:
        CheckError: malformed, or it says what is not translated; the message says what.
    """
    root = read_xml(path, "sdf")
    spec, notes = new_spec(), []
    world = root.find("world")
    top = root if world is None else world
    if world is not None:
        gravity = world.findtext("gravity")
        if gravity is not None:
            spec.option.gravity = numbers(gravity, 3, f"{path}: gravity")
        if world.find("joint") is not None:
            notes.append("joints of the world were left out: what hangs by them falls.")
    try:
        _models(spec, top, path.parent, Pose(), notes, MAX_DEPTH)
    except AssetError as error:
        raise CheckError(f"{path}: {error}") from error
    if not spec.bodies[1:]:
        raise CheckError(f"{path} holds no model.")
    return spec, tuple(dict.fromkeys(notes))


def _models(
    spec: Any,
    parent: ET.Element,
    folder: Path,
    frame: Pose,
    notes: list[str],
    depth: int,
    joined: frozenset[str] = frozenset(),
) -> None:
    if depth == 0:
        raise CheckError(f"{folder}: models that include models, more than {MAX_DEPTH} deep.")
    for model in parent.findall("model"):
        _model(spec, model, folder, within(frame, _pose(model, notes)), notes, joined=model.get("name") in joined)
    for include in parent.findall("include"):
        target = _resolved(include.findtext("uri"), folder)
        target = target / "model.sdf" if target.is_dir() else target
        held = read_xml(target, "sdf").find("model")
        if held is None:
            raise CheckError(f"{target} holds no model.")
        if include.findtext("name"):
            held.set("name", str(include.findtext("name")))
        if include.find("static") is not None:
            for old in held.findall("static"):
                held.remove(old)
            held.insert(0, include.find("static"))  # type: ignore[arg-type]
        own = _pose(include if include.find("pose") is not None else held, notes)
        _model(spec, held, target.parent, within(frame, own), notes)


def _model(spec: Any, model: ET.Element, folder: Path, frame: Pose, notes: list[str], *, joined: bool = False) -> None:
    name = str(model.get("name"))
    links = model.findall("link")
    fixed = (model.findtext("static") or "").strip().lower() in ("true", "1")
    if (joined or model.find("joint") is not None) and not fixed:
        notes.append(f'"{name}" has joints; it was taken as fixed.')
        fixed = True
    for number, link in enumerate(links):
        where = f'"{name}/{link.get("name")}"'
        own = name if len(links) == 1 else f"{name}/{link.get('name')}"
        body = add_body(spec, own, within(frame, _pose(link, notes)), fixed=fixed)
        _inertial(body, link, where, notes)
        for place, collision in enumerate(link.findall("collision")):
            _collision(spec, body, collision, folder, f"{own}_{number}_{place}", where, notes)
    if model.find("model") is not None:
        ends = [str(end.text).split("::") for end in model.iterfind("joint/*") if end.tag in ("parent", "child")]
        held = frozenset(names[-2] for names in ends if len(names) > 1)
        _models(spec, model, folder, frame, notes, MAX_DEPTH - 1, held)


def _collision(
    spec: Any, body: Any, collision: ET.Element, folder: Path, name: str, where: str, notes: list[str]
) -> None:
    pose = _pose(collision, notes)
    mu = collision.findtext("surface/friction/ode/mu")
    friction = None if mu is None else float(numbers(mu, 1, where)[0])
    shape = next(iter(collision.find("geometry") or ()), None)
    if shape is None:
        raise CheckError(f"{where}: a collision without geometry.")
    if shape.tag == "box":
        half = numbers(shape.findtext("size"), 3, where) / 2
        add_geom(body, "box", tuple(half), pose, friction)
    elif shape.tag == "sphere":
        add_geom(body, "sphere", (float(numbers(shape.findtext("radius"), 1, where)[0]),), pose, friction)
    elif shape.tag in ("cylinder", "capsule"):
        radius, length = (float(numbers(shape.findtext(key), 1, where)[0]) for key in ("radius", "length"))
        add_geom(body, shape.tag, (radius, length / 2), pose, friction)
    elif shape.tag == "plane":
        add_geom(body, "plane", (0.0, 0.0, 0.1), pose, friction)
    elif shape.tag == "mesh":
        from pat3d.assets.mesh.load import load_mesh

        mesh = load_mesh(_resolved(shape.findtext("uri"), folder))
        scale = numbers(shape.findtext("scale") or "1 1 1", 3, where)
        notes.append("meshes that collide were taken as their convex hulls, as MuJoCo takes them.")
        add_hull(spec, body, name, mesh.vertices * (mesh.metres or 1.0) * scale, pose, friction)
    else:
        notes.append(f"{where}: a collision of type <{shape.tag}> was left out.")


def _inertial(body: Any, link: ET.Element, where: str, notes: list[str]) -> None:
    inertial = link.find("inertial")
    if inertial is None or inertial.find("inertia") is None or inertial.find("mass") is None:
        return
    values = [
        float(numbers(inertial.findtext(f"inertia/{key}") or "0", 1, where)[0])
        for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    ]
    mass = float(numbers(inertial.findtext("mass"), 1, where)[0])
    set_mass(body, mass, _pose(inertial, notes), tensor(*values))


def _pose(element: ET.Element, notes: list[str]) -> Pose:
    pose = element.find("pose")
    if pose is None or not (pose.text or "").strip():
        return Pose()
    if pose.get("relative_to"):
        notes.append(f'a pose relative to "{pose.get("relative_to")}" was taken as relative to what encloses it.')
    if pose.get("rotation_format") == "quat_xyzw":
        x, y, z, qx, qy, qz, qw = numbers(pose.text, 7, "pose")
        return Pose(position=(x, y, z), quat_wxyz=(qw, qx, qy, qz))
    x, y, z, *angles = numbers(pose.text, 6, "pose")
    if pose.get("degrees") == "true":
        angles = list(np.radians(angles))
    return Pose.from_matrix(rotation_of(*angles), np.array([x, y, z]))


def _resolved(uri: str | None, folder: Path) -> Path:
    """The file or folder that a URI means; `model://` is looked for beside the file and in the folders above it."""
    name = (uri or "").strip()
    for scheme in ("model://", "package://", "file://"):
        if name.startswith(scheme):
            inner = name.removeprefix(scheme)
            places = [folder, folder / "models", *list(folder.parents)[:3]]
            found = next((place / inner for place in places if (place / inner).exists()), None)
            if found is None:
                raise CheckError(f'"{uri}" is not beside {folder}.')
            return found
    if "://" in name or not name:
        raise CheckError(f'"{uri}" is no file here; nothing is fetched.')
    return folder / name
