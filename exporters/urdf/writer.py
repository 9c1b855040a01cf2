"""URDF: one file for each object, and where each one stands.

    manifest.json                what stands where: file, pose, whether fixed; attachments and the ground
    objects/<name>/<name>.urdf   mass, inertia, friction, textured mesh and one collision element a convex part
    ground.urdf                  the box that the scene stands on
    load_pybullet.py             loads the folder into PyBullet as it was meant; copy it freely
    load_drake.py                the same for Drake, with what the directives cannot say
    scene.dmd.yaml               Drake's model directives, with package.xml for their paths
    scene.urdf                   the whole scene for viewers, everything welded to the world

A URDF is a tree of joints and knows no loose objects: of a scene file with floating joints PyBullet freezes the
objects and Drake puts them at the origin. So the objects are files of their own, and scene.urdf is for looking at.

Inertias are principal moments about the centre of mass, in a frame turned by roll, pitch and yaw. PyBullet drops
products of inertia below 1e-6, which is all there is in a small object.

Bullet multiplies the friction coefficients of a pair; load_pybullet gives each body the square root of its own, so
that the pair has their geometric mean. Drake takes the harmonic mean.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.assets.materials import surface_of
from pat3d.exporters.common.folder import export_folder
from pat3d.exporters.common.frames import principal_axes, rpy_of, text
from pat3d.exporters.common.objects import GROUND_HALF_THICKNESS, body_names, ground_size, stored_assets, write_meshes
from pat3d.exporters.urdf.mesh_paths import MESH_PATHS, PACKAGE
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.folder import write_json
from pat3d.scene.model import Scene
from pat3d.scene.obj_files import part_file
from pat3d.scene.physics import GRAVITY, ground_friction

FORMAT = "pat3d-urdf"
VERSION = 1

HYDROELASTIC_MODULUS = 1e11
"""[Pa] in Drake. At 1e8 what leans on an edge sinks by 0.3 mm and slides; on a rigid ground stacks walk.
Dissipation is left to Drake: with 10 s/m a fruit in a basket rolls away."""

SPINNING_FRICTION = 0.002
"""[m] in Bullet: the radius of a small contact patch, as in the MJCF."""

LOADERS = ("load_pybullet.py", "load_drake.py")

VIEWERS_ONLY = (
    " For viewers only: everything is welded to the world, so nothing moves in a simulator. "
    "Simulators want manifest.json (load_pybullet.py, load_drake.py). "
)


def write_urdf(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` as URDF files into `folder`, replacing it as a whole.

    Returns:
        The path of manifest.json.

    Raises:
        ExportError: `folder` is a file, holds something else than a URDF export, or cannot be written.
    """
    folder = Path(folder)
    with export_folder(folder, marker="manifest.json", what="URDF") as fresh:
        _write(scene, fresh)
    return folder / "manifest.json"


def _write(scene: Scene, folder: Path) -> None:
    bodies, stored = body_names(scene), stored_assets(scene)
    for obj in scene.objects:
        name = stored[id(obj.asset)]
        if not (folder / "objects" / name).exists():
            write_meshes(obj.asset, folder / "objects" / name)
            robot = _robot(name)
            robot.append(_link(obj.asset, name))
            _save(robot, folder / "objects" / name / f"{name}.urdf")
    _save(_ground(scene), folder / "ground.urdf")
    _save(_for_viewers(scene, bodies, stored), folder / "scene.urdf")
    manifest = _manifest(scene, bodies, stored)
    (folder / "scene.dmd.yaml").write_text(_directives(scene, manifest), encoding="utf-8")
    (folder / "package.xml").write_text(
        f'<package format="2">\n  <name>{PACKAGE}</name>\n</package>\n', encoding="utf-8"
    )
    for loader in LOADERS:
        (folder / loader).write_text(Path(__file__).with_name(loader).read_text(encoding="utf-8"), encoding="utf-8")
    write_json(folder / "manifest.json", manifest)


def _robot(name: str) -> ET.Element:
    return ET.Element("robot", {"name": name, "xmlns:drake": "http://drake.mit.edu"})


def _save(robot: ET.Element, path: Path) -> None:
    ET.indent(robot)
    ET.ElementTree(robot).write(path, encoding="utf-8", xml_declaration=True)


def _link(asset: Asset, name: str, meshes: str = "") -> ET.Element:
    """One object as a link whose frame is the asset's; mesh files are found at `meshes`."""
    link = ET.Element("link", name=name)
    properties = asset.mass_properties
    moments, axes = principal_axes(np.array(properties.inertia))
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz=text(*properties.centre_of_mass), rpy=text(*rpy_of(axes)))
    ET.SubElement(inertial, "mass", value=text(properties.mass))
    ixx, iyy, izz = map(text, moments)
    ET.SubElement(inertial, "inertia", ixx=ixx, iyy=iyy, izz=izz, ixy="0", ixz="0", iyz="0")
    _contact(link, asset.material.friction)
    visual = ET.SubElement(link, "visual", name="visual")
    ET.SubElement(visual, "origin", xyz="0 0 0", rpy="0 0 0")
    ET.SubElement(ET.SubElement(visual, "geometry"), "mesh", filename=f"{meshes}visual.obj")
    if (opacity := surface_of(asset).opacity) < 1.0:
        # SAPIEN takes a colour in place of the texture, so what is opaque has none; PyBullet has no other opacity.
        material = ET.SubElement(visual, "material", name=f"{name}_surface")
        ET.SubElement(material, "color", rgba=f"1 1 1 {opacity:g}")
    for number in range(len(asset.parts)):
        collision = ET.SubElement(link, "collision", name=f"part_{number:03d}")
        _geometry(collision, f"{meshes}{part_file(number)}")
        _proximity(collision, asset.material.friction)
    return link


def _geometry(collision: ET.Element, file: str) -> None:
    """A part as its mesh, boxes too: PyBullet lets bodies sink and walk where its box shape meets a hull."""
    ET.SubElement(collision, "origin", xyz="0 0 0", rpy="0 0 0")
    mesh = ET.SubElement(ET.SubElement(collision, "geometry"), "mesh", filename=file)
    ET.SubElement(mesh, "drake:declare_convex")


def _contact(link: ET.Element, friction: float) -> None:
    """Bullet's extension: friction of the whole link, sliding and about the normal."""
    contact = ET.SubElement(link, "contact")
    ET.SubElement(contact, "lateral_friction", value=text(friction))
    ET.SubElement(contact, "spinning_friction", value=text(SPINNING_FRICTION))


def _proximity(collision: ET.Element, friction: float) -> None:
    """Drake's extension: friction, and a pressure field for hydroelastic contact."""
    properties = ET.SubElement(collision, "drake:proximity_properties")
    ET.SubElement(properties, "drake:mu_static", value=text(friction))
    ET.SubElement(properties, "drake:mu_dynamic", value=text(friction))
    ET.SubElement(properties, "drake:compliant_hydroelastic")
    ET.SubElement(properties, "drake:hydroelastic_modulus", value=text(HYDROELASTIC_MODULUS))


def _ground(scene: Scene) -> ET.Element:
    robot, size, friction = _robot("ground"), ground_size(scene), ground_friction(scene.settling_friction)
    link = ET.SubElement(robot, "link", name="ground")
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "origin", xyz="0 0 0", rpy="0 0 0")
    ET.SubElement(inertial, "mass", value="1")
    ET.SubElement(inertial, "inertia", ixx="1", iyy="1", izz="1", ixy="0", ixz="0", iyz="0")
    _contact(link, friction)
    for kind in ("visual", "collision"):
        element = ET.SubElement(link, kind, name=kind)
        ET.SubElement(element, "origin", xyz=text(0.0, 0.0, -GROUND_HALF_THICKNESS), rpy="0 0 0")
        ET.SubElement(ET.SubElement(element, "geometry"), "box", size=text(*size))
        if kind == "visual":
            material = ET.SubElement(element, "material", name="ground_surface")
            ET.SubElement(material, "color", rgba="0.78 0.76 0.74 1")
        else:
            _proximity(element, friction)
    return robot


def _for_viewers(scene: Scene, bodies: dict[str, str], stored: dict[int, str]) -> ET.Element:
    """Every object welded where it stands."""
    robot = _robot("scene")
    robot.append(ET.Comment(VIEWERS_ONLY))
    ET.SubElement(robot, "link", name="world")
    for obj in scene.objects:
        name = bodies[obj.name]
        robot.append(_link(obj.asset, name, f"objects/{stored[id(obj.asset)]}/"))
        joint = ET.SubElement(robot, "joint", name=f"{name}_weld", type="fixed")
        ET.SubElement(joint, "origin", xyz=text(*obj.pose.position), rpy=text(*rpy_of(obj.pose.rotation)))
        ET.SubElement(joint, "parent", link="world")
        ET.SubElement(joint, "child", link=name)
    return robot


def _manifest(scene: Scene, bodies: dict[str, str], stored: dict[int, str]) -> dict[str, Any]:
    objects = []
    for obj in scene.objects:
        asset, (w, x, y, z) = stored[id(obj.asset)], obj.pose.quat_wxyz
        objects.append(
            {
                "name": bodies[obj.name],
                "object": obj.name,
                "file": f"objects/{asset}/{asset}.urdf",
                "link": asset,
                "fixed": obj.fixed,
                "position": list(obj.pose.position),
                "quat_xyzw": [x, y, z, w],
                "friction": obj.asset.material.friction,
            }
        )
    attachments = [
        {
            "child": bodies[one.child],
            "parent": bodies[one.parent],
            "anchors": [{"child_point": list(child), "parent_point": list(parent)} for child, parent in one.anchors],
        }
        for one in scene.attachments
        if not (scene[one.child].fixed and scene[one.parent].fixed)
    ]
    return {
        "format": FORMAT,
        "version": VERSION,
        "units": "metres, kilograms, z up; poses of the link frames in the world",
        "mesh_paths": MESH_PATHS[0],
        "gravity": [0.0, 0.0, -GRAVITY],
        "ground": {"file": "ground.urdf", "link": "ground", "friction": ground_friction(scene.settling_friction)},
        "objects": objects,
        "attachments": attachments,
    }


def _directives(scene: Scene, manifest: dict[str, Any]) -> str:
    """Drake's model directives; YAML written by hand because of its tags."""
    lines = [
        f"# Paths start with package://{PACKAGE}: tell the parser with package_map().Add({PACKAGE!r}, folder), as",
        "# load_drake.py does. Attachments cannot be said here; load_drake.py adds them.",
        "directives:",
    ]
    lines += _add_model("ground", "ground.urdf") + _weld("ground::ground")
    for entry, obj in zip(manifest["objects"], scene.objects, strict=True):
        name, link, placed = entry["name"], entry["link"], _transform(obj.pose)
        if entry["fixed"]:
            lines += _add_model(name, entry["file"]) + _weld(f"{name}::{link}")
            lines += ["    X_PC:", *(f"      {line}" for line in placed)]
        else:
            lines += _add_model(name, entry["file"])
            lines += ["    default_free_body_pose:", f"      {link}:", *(f"        {line}" for line in placed)]
    return "\n".join(lines) + "\n"


def _add_model(name: str, file: str) -> list[str]:
    return ["- add_model:", f"    name: {name}", f"    file: package://{PACKAGE}/{file}"]


def _weld(child: str) -> list[str]:
    return ["- add_weld:", "    parent: world", f"    child: {child}"]


def _transform(pose: Pose) -> list[str]:
    """A pose as Drake writes transforms; the angle is in degrees."""
    w, *axis = pose.quat_wxyz
    length = float(np.linalg.norm(axis))
    angle = 2.0 * np.degrees(np.arctan2(length, w))
    direction = [value / length for value in axis] if length > 0.0 else [0.0, 0.0, 1.0]
    return [
        f"translation: [{', '.join(map(repr, pose.position))}]",
        f"rotation: !AngleAxis {{angle_deg: {float(angle)!r}, axis: [{', '.join(map(repr, direction))}]}}",
    ]
