"""Objects from URDF: links that fixed joints hold together, with their shapes, mass and friction."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body, Piece, flat, primitive
from pat3d.assets.library.readers.links import REST, Frame, Links, refuse_moving, shape_of, within
from pat3d.assets.library.readers.xml import GRAY, mesh_piece, numbers, read_root, turned
from pat3d.errors import AssetError


def read_urdf(path: Path, root: Path) -> Body:
    """The object of a URDF file: metres, z up.

    Raises:
        AssetError: it has joints that move, a mesh is missing, or nothing is to be seen.
    """
    robot = read_root(path)
    return body_of(robot, robot.findall("link"), _frames(robot), path, root, name=robot.get("name", ""))


def body_of(
    robot: ET.Element, links: Sequence[ET.Element], frames: Mapping[str, Frame], path: Path, root: Path, *, name: str
) -> Body:
    """The shapes, the mass and the friction of links that move as one, placed by their frames in that of the object.

    Raises:
        AssetError: a mesh is missing, or nothing is to be seen.
    """
    colours = {one.get("name"): _rgb(one) for one in robot.findall("material")}
    found, lost = Links(), False
    for link in links:
        frame = frames[link.get("name", "")]
        shapes = {}
        for kind, into in (("visual", found.seen), ("collision", found.touched)):
            for one in link.findall(kind):
                rgb = _colour(one.find("material"), colours)
                shapes.setdefault(kind, []).append(_named(one))
                try:
                    into.append(_piece(one, frame, rgb, path, root, found.notes))
                except AssetError as error:
                    if kind == "visual":
                        raise
                    told = f"a collision shape was left out, so the picture's mesh is cut instead: {error}"
                    found.notes.append(told)
                    lost = True
        found.alike &= shapes.get("visual") == shapes.get("collision")
        if (inertial := link.find("inertial")) is not None and (mass := inertial.find("mass")) is not None:
            pose = within(frame, origin_of(inertial.find("origin")))
            found.weigh(mass.get("value", ""), pose, inertial.find("inertia"), lambda one, key: one.get(key))
        said = link.find("contact/lateral_friction")
        if said is not None:
            found.frictions.append(float(numbers(said.get("value"), 1)[0]))
    for element in robot.findall(".//gazebo/mu1"):
        found.frictions.append(float(numbers(element.text, 1)[0]))
    meshes = any(_named(one).startswith("mesh") for link in links for one in link.findall("collision"))
    return found.body(name, path, "URDF", convex=not lost and not (found.alike and meshes))


def _frames(robot: ET.Element) -> dict[str, Frame]:
    """Rotation and position of every link at rest."""
    links = {link.get("name", "") for link in robot.findall("link")}
    if not links:
        raise AssetError("the URDF has no link.")
    joints = robot.findall("joint")
    refuse_moving(joints, ("fixed", "floating"))
    if any(joint.get("type") == "floating" for joint in joints):
        raise AssetError("it has several bodies that float; one object a file.")
    above: dict[str, tuple[str, Frame]] = {}
    for joint in joints:
        parent, child = joint.find("parent"), joint.find("child")
        if parent is None or child is None:
            raise AssetError(f'joint "{joint.get("name")}" lacks its parent or its child.')
        above[child.get("link", "")] = (parent.get("link", ""), origin_of(joint.find("origin")))
    found: dict[str, Frame] = {}
    for link in links:
        rotation, position, at, steps = np.eye(3), np.zeros(3), link, 0
        while at in above and steps <= len(above):
            at, (turn, offset) = above[at]
            rotation, position, steps = turn @ rotation, turn @ position + offset, steps + 1
        found[link] = rotation, position
    if len(links - above.keys()) > 1:
        raise AssetError(f"it has {len(links - above.keys())} bodies that nothing joins; one object a file.")
    return found


def origin_of(element: ET.Element | None) -> Frame:
    """Rotation and position [m] of an <origin>; none where there is none."""
    if element is None:
        return REST
    return turned(*numbers(element.get("rpy"), 3, 0.0)), numbers(element.get("xyz"), 3, 0.0)


def _piece(one: ET.Element, frame: Frame, rgb, path: Path, root: Path, notes: list[str]) -> Piece:
    rotation, position = within(frame, origin_of(one.find("origin")))
    shape = shape_of(one)
    if shape.tag == "mesh":
        piece = mesh_piece(shape.get("filename", ""), path, root, notes)
        if rgb is not None and not any(file.suffix.lower() == ".mtl" for file in piece.files) and _untextured(piece):
            piece = Piece(
                vertices=piece.vertices, faces=piece.faces, patch=flat(len(piece.faces), rgb), files=piece.files
            )
        return piece.placed(rotation, position, numbers(shape.get("scale"), 3, 1.0))
    sizes = {
        "box": lambda: numbers(shape.get("size"), 3),
        "sphere": lambda: numbers(shape.get("radius"), 1),
        "cylinder": lambda: np.concatenate([numbers(shape.get("radius"), 1), numbers(shape.get("length"), 1)]),
        "capsule": lambda: np.concatenate([numbers(shape.get("radius"), 1), numbers(shape.get("length"), 1)]),
    }
    if shape.tag not in sizes:
        raise AssetError(f"a <{shape.tag}> is not read; box, sphere, cylinder, capsule and mesh are.")
    return primitive(shape.tag, sizes[shape.tag]().tolist(), rgb or GRAY).placed(rotation, position)


def _untextured(piece: Piece) -> bool:
    return piece.patch.image is None or piece.patch.image.size <= 48


def _named(one: ET.Element) -> str:
    """Shape of a visual or collision in words: equal for equal shapes."""
    geometry = one.find("geometry")
    shape = None if geometry is None else next(iter(geometry), None)
    return "" if shape is None else f"{shape.tag} {sorted(shape.attrib.items())}"


def _rgb(material: ET.Element) -> tuple[float, ...] | None:
    colour = material.find("color")
    return None if colour is None else tuple(numbers(colour.get("rgba"), 4)[:3])


def _colour(material: ET.Element | None, known: dict[str | None, tuple[float, ...] | None]):
    """The colour of a visual; white is what exporters write for "as in the mesh"."""
    if material is None:
        return None
    found = _rgb(material) or known.get(material.get("name"))
    return None if found is None or min(found) > 0.99 else found
