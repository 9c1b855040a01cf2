"""Objects from URDF: links that fixed joints hold together, with their shapes, mass and friction."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body, Inertial, Piece, Points, flat, merged, primitive
from pat3d.assets.library.readers.collision import hulls_of
from pat3d.assets.library.readers.inertials import together
from pat3d.assets.library.readers.xml import GRAY, inertia_of, mesh_piece, numbers, read_root, turned
from pat3d.errors import AssetError

Frame = tuple[Points, Points]


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
    notes: list[str] = []
    seen: list[Piece] = []
    touched: list[Piece] = []
    inertials: list[Inertial] = []
    frictions: list[float] = []
    same, lost = True, False
    for link in links:
        frame = frames[link.get("name", "")]
        shapes = {}
        for kind, into in (("visual", seen), ("collision", touched)):
            for one in link.findall(kind):
                rgb = _colour(one.find("material"), colours)
                shapes.setdefault(kind, []).append(_named(one))
                try:
                    into.append(_piece(one, frame, rgb, path, root, notes))
                except AssetError as error:
                    if kind == "visual":
                        raise
                    notes.append(f"a collision shape was left out, so the picture's mesh is cut instead: {error}")
                    lost = True
        same = same and (shapes.get("visual") == shapes.get("collision"))
        if (found := _inertial(link.find("inertial"), frame)) is not None:
            inertials.append(found)
        said = link.find("contact/lateral_friction")
        if said is not None:
            frictions.append(float(numbers(said.get("value"), 1)[0]))
    for element in robot.findall(".//gazebo/mu1"):
        frictions.append(float(numbers(element.text, 1)[0]))
    hulls: tuple[Points, ...] = ()
    meshes = any(_named(one).startswith("mesh") for link in links for one in link.findall("collision"))
    if touched and not lost and not (same and meshes):
        hulls, note = hulls_of(touched)
        notes += [note] if note else []
    mesh = merged(seen or touched, notes)
    return Body(
        name=name,
        mesh=mesh,
        hulls=hulls,
        touched=tuple(touched),
        metres=1.0,
        up="z",
        declared="URDF",
        inertial=together(inertials),
        friction=frictions[0] if frictions else None,
        files=(path, *mesh.files, *(file for piece in touched for file in piece.files)),
        notes=tuple(notes),
    )


def _frames(robot: ET.Element) -> dict[str, Frame]:
    """Rotation and position of every link at rest."""
    links = {link.get("name", "") for link in robot.findall("link")}
    if not links:
        raise AssetError("the URDF has no link.")
    joints = robot.findall("joint")
    moving = [joint.get("name", "?") for joint in joints if joint.get("type") not in ("fixed", "floating")]
    if moving:
        raise AssetError(
            f"it has joints that move ({', '.join(moving[:4])}); libraries hold rigid objects, so fix or remove them."
        )
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
        return np.eye(3), np.zeros(3)
    return turned(*numbers(element.get("rpy"), 3, 0.0)), numbers(element.get("xyz"), 3, 0.0)


def _piece(one: ET.Element, frame: Frame, rgb, path: Path, root: Path, notes: list[str]) -> Piece:
    turn, offset = origin_of(one.find("origin"))
    rotation, position = frame[0] @ turn, frame[0] @ offset + frame[1]
    geometry = one.find("geometry")
    shape = None if geometry is None else next(iter(geometry), None)
    if shape is None:
        raise AssetError(f"a <{one.tag}> has no geometry.")
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


def _inertial(element: ET.Element | None, frame: Frame) -> Inertial | None:
    mass = None if element is None else element.find("mass")
    if element is None or mass is None:
        return None
    value = float(numbers(mass.get("value"), 1)[0])
    if value <= 0:
        return None
    turn, offset = origin_of(element.find("origin"))
    rotation = frame[0] @ turn
    tensor = inertia_of(element.find("inertia"), lambda one, key: one.get(key))
    return Inertial(
        mass=value,
        centre=frame[0] @ offset + frame[1],
        inertia=None if tensor is None else rotation @ tensor @ rotation.T,
    )


def _rgb(material: ET.Element) -> tuple[float, ...] | None:
    colour = material.find("color")
    return None if colour is None else tuple(numbers(colour.get("rgba"), 4)[:3])


def _colour(material: ET.Element | None, known: dict[str | None, tuple[float, ...] | None]):
    """The colour of a visual; white is what exporters write for "as in the mesh"."""
    if material is None:
        return None
    found = _rgb(material) or known.get(material.get("name"))
    return None if found is None or min(found) > 0.99 else found
