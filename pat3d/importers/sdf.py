"""Scenes from SDFormat: models with their links, static or free, included ones too."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from pat3d.assets.library.readers.links import Frame
from pat3d.assets.library.readers.sdf import body_of, pose_of
from pat3d.assets.library.readers.xml import address, numbers, read_root
from pat3d.errors import AssetError
from pat3d.geometry.pose import Pose
from pat3d.importers.model import ImportedObject, ImportedScene, is_ground

MAX_DEPTH = 8
"""Of models that include models."""

MAX_MODELS = 2000


def read_sdf_scene(path: Path, root: Path) -> ImportedScene:
    """Every model of an SDF world or model file; meshes and models lie below `root`.

    A link that no joint holds is an object; links that fixed joints hold together are one, and fixed where such a joint
    holds it to the world.

    Raises:
        AssetError: malformed, a file is missing, or a pose refers to a frame of its own.
    """
    top = read_root(path)
    if top.tag != "sdf":
        raise AssetError(f"{path}: the root is <{top.tag}>; expected <sdf>.")
    world = top.find("world")
    outer = top if world is None else world
    notes: list[str] = []
    # An end in another model is "model::link", after the names of the models around it.
    ends = [(_end(joint, end).split("::"), joint) for joint in outer.iter("joint") for end in ("child", "parent")]
    hung = {names[-2]: joint for names, joint in ends if len(names) > 1}
    objects, heights = list[ImportedObject](), list[float]()
    for one in _things(outer, path, root, notes):
        if not isinstance(one, ImportedObject):
            heights.append(one)
            continue
        height = is_ground(one.name, one.body, one.pose) if one.fixed else None
        if height is not None:
            heights.append(height)
        elif one.name in hung and not one.joint:
            what = f'the joint "{hung[one.name].get("name", "?")}"'
            objects.append(ImportedObject(name=one.name, pose=one.pose, body=one.body, fixed=one.fixed, joint=what))
        else:
            objects.append(one)
    return ImportedScene(
        path=path,
        format="sdf",
        objects=tuple(objects),
        ground=max(heights) if heights else None,
        notes=tuple(dict.fromkeys(notes)),
    )


def _things(outer: ET.Element, path: Path, root: Path, notes: list[str]) -> Iterator[ImportedObject | float]:
    """Every object, and the height [m] of every level plane."""
    for number, (model, frame, file) in enumerate(_models(outer, path, root, (np.eye(3), np.zeros(3)), MAX_DEPTH)):
        if number >= MAX_MODELS:
            raise AssetError(f"{path}: more than {MAX_MODELS} models.")
        name = model.get("name", "?")
        try:
            yield from _of_model(model, frame, file, root, notes)
        except AssetError as error:
            raise AssetError(f'{file}: "{name}": {error}') from error


def _models(
    outer: ET.Element, path: Path, root: Path, frame: Frame, depth: int
) -> Iterator[tuple[ET.Element, Frame, Path]]:
    """Every model with its frame in the world and the file that it is in, included and nested ones too."""
    if depth == 0:
        raise AssetError(f"{path}: models in models, more than {MAX_DEPTH} deep.")
    for model in outer.findall("model"):
        own = _within(frame, pose_of(model))
        yield model, own, path
        yield from _models(model, path, root, own, depth - 1)
    for include in outer.findall("include"):
        file = _included(include.findtext("uri", ""), path, root)
        held = read_root(file).find("model")
        if held is None:
            raise AssetError(f"{file} holds no model.")
        if include.findtext("name"):
            held.set("name", include.findtext("name", ""))
        static = include.find("static")
        if static is not None:
            for old in held.findall("static"):
                held.remove(old)
            held.insert(0, static)
        own = _within(frame, pose_of(include if include.find("pose") is not None else held))
        yield held, own, file
        yield from _models(held, file, root, own, depth - 1)


def _included(uri: str, path: Path, root: Path) -> Path:
    """The file of an included model: itself, or model.sdf in its folder."""
    if uri.strip().endswith(".sdf"):
        return address(uri, path, root)
    return address(f"{uri.strip().rstrip('/')}/model.sdf", path, root)


def _of_model(
    model: ET.Element, frame: Frame, path: Path, root: Path, notes: list[str]
) -> Iterator[ImportedObject | float]:
    name, links, joints = model.get("name", "?"), model.findall("link"), model.findall("joint")
    static = (model.findtext("static") or "").strip().lower() in ("true", "1")
    moving = [joint.get("name", "?") for joint in joints if joint.get("type") != "fixed"]
    welds = [{_end(joint, key) for key in ("parent", "child")} for joint in joints if joint.get("type") == "fixed"]
    tied = {end for ends in welds if "world" in ends for end in ends}
    poses = {link.get("name", "?"): pose_of(link) for link in links}
    for group in _joined(links, joints):
        fixed = static or any(link.get("name") in tied for link in group)
        # An object of several links keeps the frame of its model; a single link has its own.
        single = len(group) == 1
        own = poses[group[0].get("name", "?")] if single else (np.eye(3), np.zeros(3))
        frames = [(np.eye(3), np.zeros(3))] if single else [poses[link.get("name", "?")] for link in group]
        turn, place = _within(frame, own)
        pose = Pose.from_matrix(turn, place)
        label = name if len(group) == len(links) else f"{name}/{group[0].get('name', '?')}"
        plane = group[0].find("collision/geometry/plane")
        if plane is not None:
            normal = turn @ numbers(plane.findtext("normal") or "0 0 1", 3)
            if normal[2] > (1.0 - 1e-6) * np.linalg.norm(normal):
                yield float(place[2])
            else:
                notes.append(f'the plane "{label}", which is not level, was left out.')
            continue
        if all(link.find("collision") is None for link in group):
            notes.append(f'"{label}" was left out, since nothing collides with it.')
            continue
        body = body_of(group, frames, path, root, name=label)
        joint = ", ".join(moving[:4])
        yield ImportedObject(name=label, pose=pose, body=body, fixed=fixed, joint="" if fixed else joint)


def _joined(links: list[ET.Element], joints: list[ET.Element]) -> list[list[ET.Element]]:
    """Links that fixed joints hold together, in the order of the file."""
    leader = {link.get("name", "?"): link.get("name", "?") for link in links}

    def first(name: str) -> str:
        while leader.get(name, name) != name:
            name = leader[name]
        return name

    for joint in joints:
        ends = [first(_end(joint, key)) for key in ("parent", "child")]
        if joint.get("type") == "fixed" and all(end in leader for end in ends):
            leader[ends[1]] = ends[0]
    groups: dict[str, list[ET.Element]] = {}
    for link in links:
        groups.setdefault(first(link.get("name", "?")), []).append(link)
    return list(groups.values())


def _end(joint: ET.Element, key: str) -> str:
    """Name of the link at one end of a joint; "world" for the world."""
    end = joint.find(key)
    if end is None:
        return ""
    return (end.findtext("link_name") or end.text or "").strip()


def _within(outer: Frame, inner: Frame) -> Frame:
    return outer[0] @ inner[0], outer[0] @ inner[1] + outer[1]
