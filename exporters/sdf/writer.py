"""SDF: a world for Gazebo, with every object as a model that can be used alone.

    scene.sdf                  the world: ground, objects where they rest, joints where something hangs
    models/<name>/model.sdf    one object by itself, with model.config for Gazebo's model path
    models/<name>/meshes/      its textured mesh and convex parts

The world repeats the models rather than including them, so that it loads from any folder without a model path. Drake
reads it as well, with its own elements for hydroelastic contact. There is no light in the world, because Drake warns of
one; Gazebo's ambient light shows it.

SDF joins bodies in trees. An attachment becomes the joint with the same freedom: a ball for one point, a hinge for
two, a weld for three or more that are not in line. Drake takes joints in models alone, so what hangs from something
fixed has its joint, to the world, in its own model, and what hangs from something loose is a model in that one's.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from pat3d.assets.materials import surface_of
from pat3d.errors import ExportError
from pat3d.exporters.common.folder import export_folder
from pat3d.exporters.common.frames import principal_axes, text
from pat3d.exporters.common.objects import GROUND_HALF_THICKNESS, body_names, ground_size, stored_assets, write_meshes
from pat3d.exporters.urdf.writer import HYDROELASTIC_MODULUS
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Scene
from pat3d.scene.obj_files import map_file, part_file
from pat3d.scene.physics import ground_friction

VERSION = "1.9"
"""Of the SDF specification: what Gazebo Fortress reads, and everything newer converts.

That a mesh is convex can be said from 1.11 on; what is older ignores the attribute and refuses the version."""

LINK = "link"
"""Name of the one link of every model; its frame is the asset's."""

_IN_LINE = 1e-6
"""Anchors nearer to one line than this [m] leave a hinge."""


def write_sdf(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` as an SDF world with its models into `folder`, replacing it as a whole.

    Returns:
        The path of scene.sdf.

    Raises:
        ExportError: `folder` is a file, holds something else than an SDF export, or cannot be written; or an object
            hangs from two others, which SDF cannot say.
    """
    folder = Path(folder)
    hung = _hung(scene)
    with export_folder(folder, marker="scene.sdf", what="SDF") as fresh:
        _write(scene, fresh, hung)
    return folder / "scene.sdf"


def _write(scene: Scene, folder: Path, hung: dict[str, _Hung]) -> None:
    bodies, stored = body_names(scene), stored_assets(scene)
    root = _root()
    world = ET.SubElement(root, "world", name="scene")
    world.append(_ground(scene))
    models: dict[str, ET.Element] = {}
    for obj in scene.objects:
        name = stored[id(obj.asset)]
        if not (folder / "models" / name).exists():
            _write_model(obj.asset, name, folder / "models" / name)
        models[obj.name] = _model(obj.asset, bodies[obj.name], f"models/{name}/meshes/", fixed=obj.fixed)
    for obj in scene.objects:
        model, body, above = models[obj.name], bodies[obj.name], hung.get(obj.name)
        if above is None or above.parent is None:
            model.insert(0, _pose(obj.pose))
            world.append(model)
            if above is not None:
                model.append(_joint(f"{body}_hangs", above.points, LINK, "world"))
        else:
            model.insert(0, _pose(_within(scene[above.parent].pose, obj.pose)))
            models[above.parent].append(model)
            models[above.parent].append(_joint(f"{body}_hangs", above.points, f"{body}::{LINK}", LINK))
    _save(root, folder / "scene.sdf")


def _write_model(asset: Asset, name: str, folder: Path) -> None:
    """One object by itself, as Gazebo keeps models."""
    write_meshes(asset, folder / "meshes")
    root = _root()
    root.append(_model(asset, name, "meshes/", fixed=False))
    _save(root, folder / "model.sdf")
    config = ET.Element("model")
    ET.SubElement(config, "name").text = name
    ET.SubElement(config, "version").text = "1.0"
    ET.SubElement(config, "sdf", version=VERSION).text = "model.sdf"
    ET.SubElement(config, "description").text = asset.noun
    _save(config, folder / "model.config")


def _root() -> ET.Element:
    return ET.Element("sdf", {"version": VERSION, "xmlns:drake": "http://drake.mit.edu"})


def _save(root: ET.Element, path: Path) -> None:
    ET.indent(root)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _model(asset: Asset, name: str, meshes: str, *, fixed: bool) -> ET.Element:
    """One object; its mesh files are found at `meshes`."""
    model = ET.Element("model", name=name)
    if fixed:
        ET.SubElement(model, "static").text = "true"
    link = ET.SubElement(model, "link", name=LINK)
    properties = asset.mass_properties
    moments, axes = principal_axes(np.array(properties.inertia))
    inertial = ET.SubElement(link, "inertial")
    inertial.append(_pose(Pose.from_matrix(axes, np.array(properties.centre_of_mass))))
    ET.SubElement(inertial, "mass").text = text(properties.mass)
    inertia = ET.SubElement(inertial, "inertia")
    for key, value in zip(("ixx", "iyy", "izz"), moments, strict=True):
        ET.SubElement(inertia, key).text = text(value)
    for key in ("ixy", "ixz", "iyz"):
        ET.SubElement(inertia, key).text = "0"
    visual = ET.SubElement(link, "visual", name="visual")
    _mesh(visual, f"{meshes}visual.obj")
    _look(visual, asset, meshes)
    for number, part in enumerate(asset.parts):
        collision = ET.SubElement(link, "collision", name=f"part_{number:03d}")
        _geometry(collision, part, f"{meshes}{part_file(number)}")
        _surface(collision, asset.material.friction)
    return model


def _look(visual: ET.Element, asset: Asset, meshes: str) -> None:
    """How the surface looks, for Gazebo: its pictures and, where there is none, roughness and metalness as numbers."""
    look, maps = surface_of(asset), asset.visual.maps
    material = ET.SubElement(visual, "material")
    for key in ("ambient", "diffuse"):
        ET.SubElement(material, key).text = f"1 1 1 {look.opacity:g}"
    metal = ET.SubElement(ET.SubElement(material, "pbr"), "metal")
    ET.SubElement(metal, "albedo_map").text = f"{meshes}texture.png"
    for name, key in (("normal", "normal_map"), ("roughness", "roughness_map"), ("metallic", "metalness_map")):
        if name in maps:
            ET.SubElement(metal, key).text = meshes + map_file(name)
    ET.SubElement(metal, "roughness").text = f"{look.roughness:g}"
    ET.SubElement(metal, "metalness").text = f"{look.metallic:g}"
    if look.opacity < 1.0:
        ET.SubElement(visual, "transparency").text = f"{1.0 - look.opacity:g}"


def _geometry(collision: ET.Element, part: ConvexPart, file: str) -> None:
    """A box where the part is exactly one, else its mesh."""
    if part.box is None:
        mesh = _mesh(collision, file)
        mesh.set("optimization", "convex_hull")
        ET.SubElement(mesh, "drake:declare_convex")
        return
    centre, half, quat = part.box
    collision.append(_pose(Pose(position=centre, quat_wxyz=quat)))
    box = ET.SubElement(ET.SubElement(collision, "geometry"), "box")
    ET.SubElement(box, "size").text = text(*(2.0 * side for side in half))


def _mesh(element: ET.Element, file: str) -> ET.Element:
    mesh = ET.SubElement(ET.SubElement(element, "geometry"), "mesh")
    ET.SubElement(mesh, "uri").text = file
    return mesh


def _surface(collision: ET.Element, friction: float) -> None:
    """Friction, which Gazebo and Drake read from the same place, and Drake's pressure field."""
    ode = ET.SubElement(ET.SubElement(ET.SubElement(collision, "surface"), "friction"), "ode")
    for key in ("mu", "mu2"):
        ET.SubElement(ode, key).text = text(friction)
    properties = ET.SubElement(collision, "drake:proximity_properties")
    ET.SubElement(properties, "drake:compliant_hydroelastic")
    ET.SubElement(properties, "drake:hydroelastic_modulus").text = text(HYDROELASTIC_MODULUS)


def _ground(scene: Scene) -> ET.Element:
    model = ET.Element("model", name="ground")
    ET.SubElement(model, "static").text = "true"
    link = ET.SubElement(model, "link", name=LINK)
    for kind in ("visual", "collision"):
        element = ET.SubElement(link, kind, name=kind)
        element.append(_pose(Pose(position=(0.0, 0.0, -GROUND_HALF_THICKNESS))))
        box = ET.SubElement(ET.SubElement(element, "geometry"), "box")
        ET.SubElement(box, "size").text = text(*ground_size(scene))
        if kind == "visual":
            material = ET.SubElement(element, "material")
            for key in ("ambient", "diffuse"):
                ET.SubElement(material, key).text = "0.78 0.76 0.74 1"
        else:
            _surface(element, ground_friction(scene.settling_friction))
    return model


def _pose(pose: Pose, relative_to: str | None = None) -> ET.Element:
    w, x, y, z = pose.quat_wxyz
    element = ET.Element("pose", rotation_format="quat_xyzw")
    if relative_to is not None:
        element.set("relative_to", relative_to)
    element.text = text(*pose.position, x, y, z, w)
    return element


@dataclass(frozen=True, kw_only=True)
class _Hung:
    """How an object hangs."""

    parent: str | None
    """The object that holds it; None for one that is fixed, which SDF calls the world."""
    points: np.ndarray
    """Where it is held [m], in its own frame, shape (n, 3)."""


def _hung(scene: Scene) -> dict[str, _Hung]:
    """What hangs, by its name: one end of every attachment of objects that are not both fixed.

    Raises:
        ExportError: an object hangs from two, or in a ring.
    """
    found: dict[str, _Hung] = {}
    for one in scene.attachments:
        ends = (one.child, one.parent)
        if scene[one.child].fixed:
            ends = (one.parent, one.child)
        child, parent = ends
        if scene[child].fixed:
            continue
        if child in found:
            raise ExportError(f'"{child}" hangs from two objects, which SDF cannot say; write mjcf or urdf instead.')
        above: str | None = None if scene[parent].fixed else parent
        points = np.array([pair[ends.index(one.child)] for pair in one.anchors])
        found[child] = _Hung(parent=above, points=points)
        while above is not None:
            if above == child:
                raise ExportError(f'"{child}" hangs from itself by others, which SDF cannot say; write mjcf instead.')
            above = found[above].parent if above in found else None
    return found


def _within(outer: Pose, pose: Pose) -> Pose:
    """`pose` as `outer` sees it."""
    place = outer.rotation.T @ (np.array(pose.position) - np.array(outer.position))
    return Pose.from_matrix(outer.rotation.T @ pose.rotation, place)


def _joint(name: str, points: np.ndarray, child: str, parent: str) -> ET.Element:
    """The joint that leaves the freedom which `points` of the child [m], shape (n, 3), leave when they are held."""
    middle = points.mean(axis=0)
    singular = np.linalg.svd(points - middle)
    spread = np.append(singular[1], [0.0, 0.0, 0.0])
    kind = "ball" if spread[0] < _IN_LINE else "revolute" if spread[1] < _IN_LINE else "fixed"
    joint = ET.Element("joint", name=name, type=kind)
    joint.append(_pose(Pose(position=tuple(map(float, middle))), child))  # type: ignore[arg-type]
    ET.SubElement(joint, "parent").text = parent
    ET.SubElement(joint, "child").text = child
    if kind == "revolute":
        axis = ET.SubElement(joint, "axis")
        ET.SubElement(axis, "xyz").text = text(*singular[2][0])
    return joint
