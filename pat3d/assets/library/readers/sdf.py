"""Objects from SDFormat: one model of links that fixed joints hold together."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body, Piece, primitive
from pat3d.assets.library.readers.links import REST, Frame, Links, refuse_moving, shape_of, within
from pat3d.assets.library.readers.xml import GRAY, mesh_piece, numbers, read_root, turned
from pat3d.errors import AssetError
from pat3d.geometry.rotations import matrix_of


def read_sdf(path: Path, root: Path) -> Body:
    """The object of an SDF file: metres, z up.

    Raises:
        AssetError: it holds several models, joints that move or frames of its own, or a mesh is missing.
    """
    models = list(read_root(path).iter("model"))
    if len(models) != 1:
        raise AssetError(f"it holds {len(models)} models; one object a file.")
    model = models[0]
    refuse_moving(model.findall("joint"), ("fixed",))
    links = model.findall("link")
    if len(links) > 1 and len(model.findall("joint")) < len(links) - 1:
        raise AssetError(f"it has {len(links)} links that nothing joins; one object a file.")
    return body_of(links, [pose_of(link) for link in links], path, root, name=model.get("name", ""))


def body_of(links: Sequence[ET.Element], frames: Sequence[Frame], path: Path, root: Path, *, name: str) -> Body:
    """The shapes, the mass and the friction of links that move as one, each placed by its frame in the object's.

    Raises:
        AssetError: a mesh is missing, a pose refers to another frame, or nothing is to be seen.
    """
    found = Links()
    for link, frame in zip(links, frames, strict=True):
        visuals, collisions = link.findall("visual"), link.findall("collision")
        found.seen += [_piece(one, frame, path, root, found.notes) for one in visuals]
        found.touched += [_piece(one, frame, path, root, found.notes) for one in collisions]
        found.alike &= [_said(one) for one in visuals] == [_said(one) for one in collisions]
        for mu in link.findall("collision/surface/friction/ode/mu"):
            found.frictions.append(float(numbers(mu.text, 1)[0]))
        if (inertial := link.find("inertial")) is not None:
            pose = within(frame, pose_of(inertial))
            found.weigh(inertial.findtext("mass"), pose, inertial.find("inertia"), lambda one, key: one.findtext(key))
    meshes = any(link.find("collision/geometry/mesh") is not None for link in links)
    return found.body(name, path, "SDFormat", convex=not (found.alike and meshes))


def pose_of(parent: ET.Element) -> Frame:
    """Rotation and position [m] that an element's <pose> says.

    Raises:
        AssetError: it is relative to a frame other than the enclosing one.
    """
    element = parent.find("pose")
    if element is None or not (element.text or "").strip():
        return REST
    if element.get("relative_to"):
        raise AssetError(f'a pose is relative to "{element.get("relative_to")}"; only poses in the model are read.')
    if element.get("rotation_format") == "quat_xyzw":
        x, y, z, *xyz, w = numbers(element.text, 7)
        return matrix_of((w, *xyz)), np.array([x, y, z])
    values = numbers(element.text, 6)
    angles = np.radians(values[3:]) if element.get("degrees") == "true" else values[3:]
    return turned(*angles), values[:3]


def _piece(one: ET.Element, frame: Frame, path: Path, root: Path, notes: list[str]) -> Piece:
    rotation, position = within(frame, pose_of(one))
    shape = shape_of(one)
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
