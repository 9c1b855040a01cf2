"""Objects from SDFormat: one model of links that fixed joints hold together."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body, Inertial, Piece, Points, merged, primitive
from pat3d.assets.library.readers.collision import hulls_of
from pat3d.assets.library.readers.inertials import together
from pat3d.assets.library.readers.xml import GRAY, inertia_of, mesh_piece, numbers, read_root, turned
from pat3d.errors import AssetError
from pat3d.geometry.rotations import matrix_of

Frame = tuple[Points, Points]


def read_sdf(path: Path, root: Path) -> Body:
    """The object of an SDF file: metres, z up.

    Raises:
        AssetError: it holds several models, joints that move or frames of its own, or a mesh is missing.
    """
    models = list(read_root(path).iter("model"))
    if len(models) != 1:
        raise AssetError(f"it holds {len(models)} models; one object a file.")
    model = models[0]
    moving = [joint.get("name", "?") for joint in model.findall("joint") if joint.get("type") != "fixed"]
    if moving:
        raise AssetError(
            f"it has joints that move ({', '.join(moving[:4])}); libraries hold rigid objects, so fix or remove them."
        )
    links = model.findall("link")
    if len(links) > 1 and len(model.findall("joint")) < len(links) - 1:
        raise AssetError(f"it has {len(links)} links that nothing joins; one object a file.")
    return body_of(links, [pose_of(link) for link in links], path, root, name=model.get("name", ""))


def body_of(links: Sequence[ET.Element], frames: Sequence[Frame], path: Path, root: Path, *, name: str) -> Body:
    """The shapes, the mass and the friction of links that move as one, each placed by its frame in the object's.

    Raises:
        AssetError: a mesh is missing, a pose refers to another frame, or nothing is to be seen.
    """
    notes: list[str] = []
    seen: list[Piece] = []
    touched: list[Piece] = []
    inertials: list[Inertial] = []
    frictions: list[float] = []
    same = True
    for link, frame in zip(links, frames, strict=True):
        visuals, collisions = link.findall("visual"), link.findall("collision")
        seen += [_piece(one, frame, path, root, notes) for one in visuals]
        touched += [_piece(one, frame, path, root, notes) for one in collisions]
        same = same and [_said(one) for one in visuals] == [_said(one) for one in collisions]
        for mu in link.findall("collision/surface/friction/ode/mu"):
            frictions.append(float(numbers(mu.text, 1)[0]))
        if (found := _inertial(link.find("inertial"), frame)) is not None:
            inertials.append(found)
    hulls: tuple[Points, ...] = ()
    meshes = any(link.find("collision/geometry/mesh") is not None for link in links)
    if touched and not (same and meshes):
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
        declared="SDFormat",
        inertial=together(inertials),
        friction=frictions[0] if frictions else None,
        files=(path, *mesh.files, *(file for piece in touched for file in piece.files)),
        notes=tuple(notes),
    )


def pose_of(parent: ET.Element) -> Frame:
    """Rotation and position [m] that an element's <pose> says.

    Raises:
        AssetError: it is relative to a frame other than the enclosing one.
    """
    element = parent.find("pose")
    if element is None or not (element.text or "").strip():
        return np.eye(3), np.zeros(3)
    if element.get("relative_to"):
        raise AssetError(f'a pose is relative to "{element.get("relative_to")}"; only poses in the model are read.')
    if element.get("rotation_format") == "quat_xyzw":
        x, y, z, *xyz, w = numbers(element.text, 7)
        return matrix_of((w, *xyz)), np.array([x, y, z])
    values = numbers(element.text, 6)
    angles = np.radians(values[3:]) if element.get("degrees") == "true" else values[3:]
    return turned(*angles), values[:3]


def _piece(one: ET.Element, frame: Frame, path: Path, root: Path, notes: list[str]) -> Piece:
    turn, offset = pose_of(one)
    rotation, position = frame[0] @ turn, frame[0] @ offset + frame[1]
    geometry = one.find("geometry")
    shape = None if geometry is None else next(iter(geometry), None)
    if shape is None:
        raise AssetError(f"a <{one.tag}> has no geometry.")
    if shape.tag == "mesh":
        piece = mesh_piece(shape.findtext("uri", ""), path, root, notes)
        return piece.placed(rotation, position, numbers(shape.findtext("scale"), 3, 1.0))
    diffuse = one.findtext("material/diffuse")
    rgb = GRAY if diffuse is None else tuple(numbers(" ".join(diffuse.split()[:3]), 3))
    if shape.tag == "box":
        sizes = numbers(shape.findtext("size"), 3)
    elif shape.tag == "ellipsoid":
        sizes = numbers(shape.findtext("radii"), 3)
    else:
        names = ("radius",) if shape.tag == "sphere" else ("radius", "length")
        sizes = np.concatenate([numbers(shape.findtext(name), 1) for name in names])
    return primitive(shape.tag, sizes.tolist(), rgb).placed(rotation, position)


def _said(one: ET.Element) -> str:
    geometry = one.find("geometry")
    words = "" if geometry is None else ET.tostring(geometry, encoding="unicode")
    return " ".join(words.split())


def _inertial(element: ET.Element | None, frame: Frame) -> Inertial | None:
    said = None if element is None else element.findtext("mass")
    if element is None or said is None:
        return None
    mass = float(numbers(said, 1)[0])
    if mass <= 0:
        return None
    turn, offset = pose_of(element)
    rotation = frame[0] @ turn
    tensor = inertia_of(element.find("inertia"), lambda one, key: one.findtext(key))
    return Inertial(
        mass=mass,
        centre=frame[0] @ offset + frame[1],
        inertia=None if tensor is None else rotation @ tensor @ rotation.T,
    )
