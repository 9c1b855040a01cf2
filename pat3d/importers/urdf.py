"""Objects and scenes from URDF: one file, or what `pat3d export` writes, where a manifest says what stands where."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from pat3d.assets.library.body import Body
from pat3d.assets.library.readers.links import Frame
from pat3d.assets.library.readers.urdf import body_of, origin_of
from pat3d.assets.library.readers.xml import read_root
from pat3d.errors import AssetError
from pat3d.exporters.urdf.reader import read_manifest
from pat3d.geometry.pose import Pose
from pat3d.importers.model import ImportedObject, ImportedScene
from pat3d.scene.model import Attachment

WORLD = "world"
"""A root link of this name without shapes is the world: what is fixed to it stands, what floats in it is loose."""


def read_urdf_scene(path: Path, root: Path) -> ImportedScene:
    """The objects of a URDF: its root link with all that is fixed to it, and every link that floats.

    Raises:
        AssetError: malformed, a mesh is missing, or the joints are no tree.
    """
    robot = read_root(path)
    if robot.tag != "robot":
        raise AssetError(f"{path}: the root is <{robot.tag}>; expected <robot>.")
    links = {link.get("name", ""): link for link in robot.findall("link")}
    above = _above(robot, links, path)
    roots = [name for name in links if name not in above]
    if len(roots) != 1:
        raise AssetError(f"{path} has {len(roots)} links that no joint holds; a URDF is one tree.")
    empty = links[roots[0]].find("visual") is None and links[roots[0]].find("collision") is None
    world = roots[0] if roots[0] == WORLD and empty else ""
    starts = {
        name: joint
        for name, (parent, joint) in above.items()
        if joint.get("type") == "floating" or (world and parent == world)
    }
    if not world:
        starts = {roots[0]: None, **starts}
    members: dict[str, list[str]] = {start: [] for start in starts}
    moving: dict[str, list[str]] = {start: [] for start in starts}
    frames: dict[str, Frame] = {}
    for name in links:
        if name == world:
            continue
        chain, at = list[str](), name
        while at not in starts:
            chain.append(at)
            at = above[at][0]
        rotation, position = np.eye(3), np.zeros(3)
        for one in reversed(chain):
            joint = above[one][1]
            turn, offset = origin_of(joint.find("origin"))
            rotation, position = rotation @ turn, rotation @ offset + position
            if joint.get("type") != "fixed" and one == name:
                moving[at].append(joint.get("name", "?"))
        frames[name] = rotation, position
        members[at].append(name)
    objects, notes = list[ImportedObject](), list[str]()
    for start, joint in starts.items():
        if all(links[name].find("collision") is None and links[name].find("visual") is None for name in members[start]):
            notes.append(f'"{start}" was left out, since it has no shapes.')
            continue
        if joint is not None and joint.get("type") not in ("fixed", "floating"):
            moving[start].insert(0, joint.get("name", "?"))
        turn, place = (np.eye(3), np.zeros(3)) if joint is None else origin_of(joint.find("origin"))
        try:
            body = body_of(robot, [links[name] for name in members[start]], frames, path, root, name=start)
        except AssetError as error:
            raise AssetError(f'{path}: "{start}": {error}') from error
        objects.append(
            ImportedObject(
                name=robot.get("name", start) if len(starts) == 1 else start,
                pose=Pose.from_matrix(turn, place),
                body=body,
                fixed=joint is not None and joint.get("type") == "fixed",
                joint=", ".join(moving[start][:4]),
            )
        )
    return ImportedScene(path=path, format="urdf", objects=tuple(objects), notes=tuple(notes))


def read_manifest_scene(path: Path) -> ImportedScene:
    """The scene of a URDF export, whose manifest.json is at `path`.

    Raises:
        AssetError: an object's file is missing or malformed.
        ExportError: the manifest is malformed.
    """
    folder = path.parent
    manifest = read_manifest(folder)
    made: dict[Path, Body] = {}
    objects = []
    for entry in manifest["objects"]:
        file = (folder / str(entry["file"])).resolve()
        if not (file.is_relative_to(folder.resolve()) and file.is_file()):
            raise AssetError(f'{path}: "{entry["file"]}" is not there.')
        if file not in made:
            made[file] = read_urdf_scene(file, folder).objects[0].body
        x, y, z, w = map(float, entry["quat_xyzw"])
        objects.append(
            ImportedObject(
                name=str(entry.get("object") or entry["name"]),
                pose=Pose(position=tuple(entry["position"]), quat_wxyz=(w, x, y, z)),
                body=made[file],
                fixed=bool(entry["fixed"]),
            )
        )
    labels = {entry["name"]: one.name for entry, one in zip(manifest["objects"], objects, strict=True)}
    attachments = tuple(
        Attachment(
            child=labels[one["child"]],
            parent=labels[one["parent"]],
            anchors=tuple((tuple(pair["child_point"]), tuple(pair["parent_point"])) for pair in one["anchors"]),
        )
        for one in manifest.get("attachments", [])
    )
    return ImportedScene(path=path, format="urdf", objects=tuple(objects), ground=0.0, attachments=attachments)


def _above(robot: ET.Element, links: dict[str, ET.Element], path: Path) -> dict[str, tuple[str, ET.Element]]:
    """Parent and joint of every link that has one; a tree."""
    above: dict[str, tuple[str, ET.Element]] = {}
    for joint in robot.findall("joint"):
        parent, child = joint.find("parent"), joint.find("child")
        ends = [one.get("link", "") if one is not None else "" for one in (parent, child)]
        if any(end not in links for end in ends):
            raise AssetError(f'{path}: joint "{joint.get("name")}" lacks its parent or its child.')
        if ends[1] in above:
            raise AssetError(f'{path}: the link "{ends[1]}" has two parents.')
        above[ends[1]] = ends[0], joint
    for name in links:
        at, steps = name, 0
        while at in above:
            at, steps = above[at][0], steps + 1
            if steps > len(above):
                raise AssetError(f'{path}: the joints above the link "{name}" form a circle.')
    return above
