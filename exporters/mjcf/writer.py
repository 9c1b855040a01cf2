"""MJCF: a scene that MuJoCo holds as still as it was settled.

    scene.xml             the scene, with the keyframe "home"
    scene_mujoco_3.3.xml  the same for MuJoCo 3.3
    scene_mjx.xml         the same for MJX, which knows no contact margins
    objects/<name>.xml    one object by itself, to load alone or to `<attach>` to a scene of one's own
    robosuite/<name>.xml  the same for robosuite's MujocoXMLObject, and without a joint for dm_control's attach
    meshes/ textures/     what all draw from

What it takes, as measured with MuJoCo 3.9:

- Stiff contacts of two time steps, the elliptic cone with impratio 10, implicitfast. With the default
  contacts towers creep by centimetres whatever their start.
- A contact margin of just the gap at which the bodies rest. MuJoCo feels nothing before surfaces overlap, so
  without it a tower whose bodies float 0.02 mm apart lands one body a time step and drops 2 mm.
- Several contact points for a pair of convex meshes (multiccd), found to 1e-11 m (ccd_tolerance): at its
  default of 1e-6 m a margin of hundredths of a millimetre throws hulls into the air.
- The ground that collides is a box. The collider of planes and meshes returns three points that change from
  step to step, and a hull walks 8 mm in 5 s on it.
- Boxes are box primitives, except where two of equal width rest flush to a micrometre: there the box-box
  collider reports contacts as deep as the box is wide, and meshes of eight vertices do not.
- The box-box collider of MuJoCo 3.3 reports half of every gap, so that boxes jump within their margins and a stack
  of books walks 5 mm in 5 s. The file for it has meshes of eight vertices for all boxes.
- Attachments are connect constraints, a ball joint for every anchor, as stiff as the contacts. Every free object keeps
  its free joint, so that the joint state is its pose whether it hangs or stands.

MuJoCo gives a pair of geoms the larger of their friction coefficients and the sum of their margins (up to 3.4 the
larger of these too).
"""

from __future__ import annotations

import sys
import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence, Set
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.exporters.common.folder import export_folder
from pat3d.exporters.common.frames import text
from pat3d.exporters.common.margins import contact_margins, flush_boxes, largest_margins
from pat3d.exporters.common.objects import CONTACT_GAP, GROUND_HALF_THICKNESS, body_names, ground_size
from pat3d.exporters.mjcf.elements import (
    ROLLING_FRICTION,
    SOLIMP,
    SOLREF,
    TORSIONAL_FRICTION,
    add_defaults,
    add_geoms,
    declare_files,
    empty_model,
    inertial,
    save_xml,
)
from pat3d.exporters.mjcf.objects import object_model, robosuite_model
from pat3d.geometry.contacts import find_contacts
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from pat3d.scene.obj_files import hull_obj, part_file, visual_obj, write_texture
from pat3d.scene.physics import ground_friction

SCENE = "scene.xml"
FOR_MUJOCO_3_3 = "scene_mujoco_3.3.xml"
FOR_MJX = "scene_mjx.xml"

TIMESTEP = 0.002
"""[s]"""

CCD_TOLERANCE = 1e-11
"""Accuracy of the distance between convex meshes [m]."""


def write_mjcf(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` with its meshes and textures into `folder`, replacing it as a whole.

    Returns:
        The path of scene.xml.

    Raises:
        ExportError: `folder` is a file, or a folder that holds something else than an MJCF export.
    """
    folder = Path(folder)
    with export_folder(folder, marker=SCENE, what="MJCF") as fresh:
        (fresh / "objects").mkdir()
        (fresh / "robosuite").mkdir()
        contacts = find_contacts(scene.objects, CONTACT_GAP)
        stored = _write_assets(scene, fresh)
        margins, flush = contact_margins(scene, contacts), flush_boxes(scene, contacts)
        save_xml(_document(scene, stored, margins, flush), fresh / SCENE)
        save_xml(_document(scene, stored, largest_margins(scene, contacts), set(stored)), fresh / FOR_MUJOCO_3_3)
        save_xml(_document(scene, stored, [None] * len(margins), flush), fresh / FOR_MJX)
    forget_cached_meshes()
    return folder / SCENE


def forget_cached_meshes() -> None:
    """Empty the mesh cache of a MuJoCo that this process has loaded.

    MuJoCo keeps compiled meshes by path and modification time in whole seconds, so a mesh that is written again
    within the second would be taken for the old one.
    """
    mujoco: Any = sys.modules.get("mujoco")
    if mujoco is not None and hasattr(mujoco, "mj_clearCache"):
        mujoco.mj_clearCache(mujoco.mj_getCache())


def _document(
    scene: Scene, stored: Mapping[int, str], margins: Sequence[float | None], as_mesh: Set[int]
) -> ET.Element:
    """The whole MJCF.

    Args:
        scene: what stands where.
        stored: the name under which each asset's files lie, by the asset's identity.
        margins: contact margin of every object [m], None for none.
        as_mesh: identities of the assets whose boxes are meshes.
    """
    root = empty_model("pat3d scene")
    option = ET.SubElement(
        root,
        "option",
        timestep=text(TIMESTEP),
        integrator="implicitfast",
        cone="elliptic",
        impratio="10",
        ccd_tolerance=text(CCD_TOLERANCE),
    )
    # On by default only since MuJoCo 3.9; without it a hull rests on a single point and falls over.
    ET.SubElement(option, "flag", multiccd="enable")
    _look(root, scene)
    add_defaults(root)
    names = body_names(scene)
    custom = ET.SubElement(root, "custom")
    assets = ET.SubElement(root, "asset")
    world = ET.SubElement(root, "worldbody")
    _ground_and_lights(assets, world, scene)
    declared: set[int] = set()
    state: list[float] = []
    for obj, margin in zip(scene.objects, margins, strict=True):
        name, asset = names[obj.name], id(obj.asset)
        ET.SubElement(custom, "text", name=name, data=obj.name)
        if asset not in declared:
            declared.add(asset)
            declare_files(obj.asset, stored[asset], assets, as_mesh=asset in as_mesh)
        body = ET.SubElement(world, "body", {"name": name, **_placement(obj.pose)})
        ET.SubElement(body, "inertial", inertial(obj.asset.mass_properties))
        if not obj.fixed:
            ET.SubElement(body, "freejoint", name=name)
            state += [*obj.pose.position, *obj.pose.quat_wxyz]
        add_geoms(body, name, obj.asset, stored[asset], margin=margin, as_mesh=asset in as_mesh)
    _attachments(root, names, scene)
    if state:
        ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="home", qpos=text(*state))
    return root


def _look(root: ET.Element, scene: Scene) -> None:
    low, high = _bounds(scene)
    ET.SubElement(
        root, "statistic", center=text(*((low + high) / 2)), extent=text(float(np.linalg.norm(high - low)) / 2)
    )
    visual = ET.SubElement(root, "visual")
    ET.SubElement(visual, "global", offwidth="1920", offheight="1080", azimuth="90", elevation="-25")
    ET.SubElement(visual, "headlight", ambient="0.35 0.35 0.35", diffuse="0.35 0.35 0.35", specular="0.1 0.1 0.1")
    ET.SubElement(visual, "quality", shadowsize="4096")
    ET.SubElement(visual, "map", znear="0.01", zfar="100")


def _ground_and_lights(assets: ET.Element, world: ET.Element, scene: Scene) -> None:
    low, high = _bounds(scene)
    centre, reach = (low + high) / 2, max(float(np.linalg.norm(high - low)), 0.2)
    ET.SubElement(
        assets,
        "texture",
        type="skybox",
        builtin="gradient",
        rgb1="0.78 0.84 0.9",
        rgb2="0.95 0.96 0.97",
        width="256",
        height="1536",
    )
    ET.SubElement(
        assets,
        "texture",
        name="ground",
        type="2d",
        builtin="checker",
        rgb1="0.80 0.79 0.77",
        rgb2="0.74 0.73 0.71",
        width="512",
        height="512",
    )
    ET.SubElement(
        assets,
        "material",
        name="ground",
        texture="ground",
        texrepeat="2 2",
        texuniform="true",
        specular="0.1",
        shininess="0.1",
        reflectance="0",
    )
    friction = ground_friction(scene.settling_friction)
    ET.SubElement(
        world,
        "geom",
        {"class": "visual"},
        name="ground_visual",
        type="plane",
        size="0 0 0.05",
        group="0",
        material="ground",
    )
    side = max(ground_size(scene)[0] / 2, 4.0 * reach)
    ET.SubElement(
        world,
        "geom",
        {"class": "collision"},
        name="ground",
        type="box",
        pos=text(0, 0, -GROUND_HALF_THICKNESS),
        size=text(side, side, GROUND_HALF_THICKNESS),
        friction=text(friction, TORSIONAL_FRICTION, ROLLING_FRICTION),
    )
    for name, offset, diffuse, shadow in (
        ("key", (-1.0, -1.2, 2.0), "0.65 0.63 0.6", "true"),
        ("fill", (1.5, -0.6, 1.5), "0.25 0.26 0.28", "false"),
    ):
        position = centre + 2.0 * reach * np.array(offset)
        ET.SubElement(
            world,
            "light",
            name=name,
            directional="true",
            pos=text(*position),
            dir=text(*(centre - position)),
            diffuse=diffuse,
            castshadow=shadow,
        )
    # The viewer of the relations: from -y, a little above, looking at the middle of the scene.
    eye = centre + 1.5 * reach * np.array([0.0, -1.0, 0.5])
    ET.SubElement(world, "camera", name="front", pos=text(*eye), fovy="45", xyaxes="1 0 0 0 0.4472135955 0.894427191")


def _attachments(root: ET.Element, names: dict[str, str], scene: Scene) -> None:
    """A connect constraint for every anchor of objects that are not both fixed.

    MuJoCo takes the point of the second body from the poses in the file, where both points are one.
    """
    moving = [one for one in scene.attachments if not (scene[one.child].fixed and scene[one.parent].fixed)]
    if not moving:
        return
    equality = ET.SubElement(root, "equality")
    for one in moving:
        child, parent = names[one.child], names[one.parent]
        for number, (point, _) in enumerate(one.anchors):
            ET.SubElement(
                equality,
                "connect",
                name=f"{child}_anchor_{number:02d}",
                body1=child,
                body2=parent,
                anchor=text(*point),
                solref=SOLREF,
                solimp=SOLIMP,
            )


def _write_assets(scene: Scene, folder: Path) -> dict[int, str]:
    """Write the files of every asset into `folder` once, under the first name that has it; returns those names."""
    names, stored = body_names(scene), {}
    for obj in scene.objects:
        if id(obj.asset) in stored:
            continue
        asset, name = obj.asset, names[obj.name]
        stored[id(asset)] = name
        meshes = folder / "meshes" / name
        meshes.mkdir(parents=True)
        (meshes / "visual.obj").write_text(visual_obj(asset.visual), encoding="utf-8")
        write_texture(asset.visual.texture, folder / "textures" / f"{name}.png")
        for one, image in asset.visual.maps.items():
            write_texture(image, folder / "textures" / f"{name}_{one}.png")
        for number, part in enumerate(asset.parts):
            (meshes / part_file(number)).write_text(hull_obj(part.vertices, part.faces), encoding="utf-8")
        save_xml(object_model(asset, name), folder / "objects" / f"{name}.xml")
        save_xml(robosuite_model(asset, name), folder / "robosuite" / f"{name}.xml")
    return stored


def _placement(pose: Pose) -> dict[str, str]:
    return {"pos": text(*pose.position), "quat": text(*pose.quat_wxyz)}


def _bounds(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Corners of the box around every object's parts [m], shape (3,) each."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    return points.min(axis=0), points.max(axis=0)
