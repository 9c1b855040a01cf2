"""MJCF: a scene that MuJoCo holds as still as it was settled.

The contact settings are the ones that keep equilibria to hundredths of a millimetre: stiff contacts
of two time steps, the elliptic cone with impratio 10, the implicitfast integrator, and several
contact points for each pair of convex meshes (multiccd). MuJoCo's default contacts let towers creep by
centimetres whatever their start.

MuJoCo gives a pair of geoms the larger of their two friction coefficients, so a pair slides no
earlier than its rougher side says.
"""

from __future__ import annotations

import shutil
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from pathlib import Path

import numpy as np

from pat3d.assets.asset import Asset, MassProperties
from pat3d.errors import ExportError
from pat3d.exporters.meshes import hull_obj, visual_obj, write_texture
from pat3d.naming import unique_slugs
from pat3d.scene import Pose, Scene

TIMESTEP = 0.002
"""[s]"""

GROUND_FRICTION = 0.4
"""Sliding friction [-] of the ground; with MuJoCo's rule, the least that anything on it has."""

TORSIONAL_FRICTION = 0.002
"""[m], spin about the contact normal; the radius of a small contact patch."""

ROLLING_FRICTION = 0.0001
"""[m]"""

CONDIM = "4"
"""Contact forces along the normal, the two tangents, and a torque about the normal."""

HULL_MESH = {"inertia": "convex", "smoothnormal": "false"}
VISUAL_MESH = {"inertia": "shell"}


def body_names(scene: Scene) -> dict[str, str]:
    """MuJoCo's body name of every object: "red mug 1" -> "red_mug_1"."""
    return unique_slugs((obj.name for obj in scene.objects), taken=("world", "ground"))


def write_mjcf(scene: Scene, folder: str | Path) -> Path:
    """Write `scene` as scene.xml with its meshes and textures into `folder`, replacing it as a whole.

    Returns:
        The path of scene.xml.

    Raises:
        ExportError: `folder` is a file, or a folder that holds something else than an MJCF export.
    """
    folder = Path(folder)
    if folder.exists() and not folder.is_dir():
        raise ExportError(f"{folder} is a file; give a folder to write the MJCF into.")
    if folder.exists() and any(folder.iterdir()) and not (folder / "scene.xml").is_file():
        raise ExportError(f"{folder} is not empty and holds no scene.xml; give a new folder or an earlier export.")
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=folder.parent, prefix=".mjcf-") as temporary:
        fresh = Path(temporary) / "new"
        fresh.mkdir()
        root = _document(scene, fresh)
        ET.indent(root)
        ET.ElementTree(root).write(fresh / "scene.xml", encoding="utf-8", xml_declaration=False)
        if folder.exists():
            folder.rename(Path(temporary) / "old")
        try:
            fresh.rename(folder)
        except OSError:
            shutil.move(Path(temporary) / "old", folder)
            raise
    return folder / "scene.xml"


def _document(scene: Scene, folder: Path) -> ET.Element:
    """The whole MJCF; meshes and textures are written into `folder` on the way."""
    root = ET.Element("mujoco", model="pat3d scene")
    ET.SubElement(root, "compiler", angle="radian", meshdir="meshes", texturedir="textures",
                  inertiafromgeom="false", autolimits="true")  # fmt: skip
    option = ET.SubElement(root, "option", timestep=_text(TIMESTEP), integrator="implicitfast",
                           cone="elliptic", impratio="10")  # fmt: skip
    # On by default only since MuJoCo 3.9; without it a hull rests on a single point and falls over.
    ET.SubElement(option, "flag", multiccd="enable", nativeccd="enable")
    _look(root, scene)
    _defaults(root)
    names = body_names(scene)
    custom = ET.SubElement(root, "custom")
    assets = ET.SubElement(root, "asset")
    world = ET.SubElement(root, "worldbody")
    _ground_and_lights(assets, world, scene)
    stored: dict[int, str] = {}
    state: list[float] = []
    for obj in scene.objects:
        name = names[obj.name]
        ET.SubElement(custom, "text", name=name, data=obj.name)
        if id(obj.asset) not in stored:
            stored[id(obj.asset)] = name
            _write_asset(obj.asset, name, assets, folder)
        body = ET.SubElement(world, "body", name=name, **_placement(obj.pose))
        ET.SubElement(body, "inertial", _inertial(obj.asset.mass_properties))
        if not obj.fixed:
            ET.SubElement(body, "freejoint", name=name)
            state += [*obj.pose.position, *obj.pose.quat_wxyz]
        _geoms(body, name, obj.asset, stored[id(obj.asset)])
    if state:
        ET.SubElement(ET.SubElement(root, "keyframe"), "key", name="home", qpos=_text(*state))
    return root


def _look(root: ET.Element, scene: Scene) -> None:
    low, high = _bounds(scene)
    ET.SubElement(root, "statistic", center=_text(*((low + high) / 2)),
                  extent=_text(float(np.linalg.norm(high - low)) / 2))  # fmt: skip
    visual = ET.SubElement(root, "visual")
    ET.SubElement(visual, "global", offwidth="1920", offheight="1080", azimuth="90", elevation="-25")
    ET.SubElement(visual, "headlight", ambient="0.35 0.35 0.35", diffuse="0.35 0.35 0.35", specular="0.1 0.1 0.1")
    ET.SubElement(visual, "quality", shadowsize="4096")
    ET.SubElement(visual, "map", znear="0.01", zfar="100")


def _defaults(root: ET.Element) -> None:
    default = ET.SubElement(root, "default")
    visual = ET.SubElement(default, "default", {"class": "visual"})
    ET.SubElement(visual, "geom", type="mesh", group="2", contype="0", conaffinity="0", mass="0")
    collision = ET.SubElement(default, "default", {"class": "collision"})
    ET.SubElement(collision, "geom", group="3", condim=CONDIM, solref="0.004 1", solimp="0.99 0.999 0.0001",
                  margin="0", mass="0", rgba="0.4 0.6 0.9 0.5")  # fmt: skip


def _ground_and_lights(assets: ET.Element, world: ET.Element, scene: Scene) -> None:
    low, high = _bounds(scene)
    centre, reach = (low + high) / 2, max(float(np.linalg.norm(high - low)), 0.2)
    ET.SubElement(assets, "texture", type="skybox", builtin="gradient", rgb1="0.78 0.84 0.9", rgb2="0.95 0.96 0.97",
                  width="256", height="1536")  # fmt: skip
    ET.SubElement(assets, "texture", name="ground", type="2d", builtin="checker", rgb1="0.80 0.79 0.77",
                  rgb2="0.74 0.73 0.71", width="512", height="512")  # fmt: skip
    ET.SubElement(assets, "material", name="ground", texture="ground", texrepeat="2 2", texuniform="true",
                  specular="0.1", shininess="0.1", reflectance="0")  # fmt: skip
    friction = max(GROUND_FRICTION, scene.settling_friction)
    ET.SubElement(world, "geom", {"class": "collision"}, name="ground", type="plane", size="0 0 0.05", group="0",
                  material="ground", rgba="1 1 1 1",
                  friction=_text(friction, TORSIONAL_FRICTION, ROLLING_FRICTION))  # fmt: skip
    for name, offset, diffuse, shadow in (
        ("key", (-1.0, -1.2, 2.0), "0.65 0.63 0.6", "true"),
        ("fill", (1.5, -0.6, 1.5), "0.25 0.26 0.28", "false"),
    ):
        position = centre + 2.0 * reach * np.array(offset)
        ET.SubElement(world, "light", name=name, type="directional", pos=_text(*position),
                      dir=_text(*(centre - position)), diffuse=diffuse, castshadow=shadow)  # fmt: skip
    # The viewer of the relations: from -y, a little above, looking at the middle of the scene.
    eye = centre + 1.5 * reach * np.array([0.0, -1.0, 0.5])
    ET.SubElement(world, "camera", name="front", pos=_text(*eye), fovy="45", xyaxes="1 0 0 0 0.4472135955 0.894427191")


def _write_asset(asset: Asset, name: str, assets: ET.Element, folder: Path) -> None:
    """Write the files of one asset and declare them."""
    meshes = folder / "meshes" / name
    meshes.mkdir(parents=True)
    (meshes / "visual.obj").write_text(visual_obj(asset.visual), encoding="utf-8")
    write_texture(asset.visual.texture, folder / "textures" / f"{name}.png")
    ET.SubElement(assets, "texture", name=name, type="2d", file=f"{name}.png")
    ET.SubElement(assets, "material", name=name, texture=name, specular="0.2", shininess="0.3")
    ET.SubElement(assets, "mesh", VISUAL_MESH, name=f"{name}/visual", file=f"{name}/visual.obj")
    for number, part in enumerate(asset.parts):
        if part.box is None:
            file = f"part_{number:03d}.obj"
            (meshes / file).write_text(hull_obj(part.vertices, part.faces), encoding="utf-8")
            ET.SubElement(assets, "mesh", HULL_MESH, name=f"{name}/part_{number:03d}", file=f"{name}/{file}")


def _geoms(body: ET.Element, name: str, asset: Asset, stored: str) -> None:
    """The geoms of one body, drawn from the files of asset `stored`."""
    ET.SubElement(body, "geom", {"class": "visual"}, name=f"{name}/visual", mesh=f"{stored}/visual", material=stored)
    friction = _text(asset.material.friction, TORSIONAL_FRICTION, ROLLING_FRICTION)
    for number, part in enumerate(asset.parts):
        geom = ET.SubElement(body, "geom", {"class": "collision"}, name=f"{name}/part_{number:03d}", friction=friction)
        if part.box is None:
            geom.set("type", "mesh")
            geom.set("mesh", f"{stored}/part_{number:03d}")
        else:
            centre, half, quat = part.box
            geom.set("type", "box")
            geom.set("pos", _text(*centre))
            geom.set("size", _text(*half))
            if quat != (1.0, 0.0, 0.0, 0.0):
                geom.set("quat", _text(*quat))


def _inertial(properties: MassProperties) -> dict[str, str]:
    """Mass, centre and principal inertia.

    MuJoCo's own diagonalisation of fullinertia stops at 1e-12 kg m^2 off the diagonal, a tenth of a per cent
    of a pencil; numpy's is exact to rounding.
    """
    from scipy.spatial.transform import Rotation

    moments, axes = np.linalg.eigh(np.array(properties.inertia))
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    quat = Rotation.from_matrix(axes).as_quat(scalar_first=True)
    return {
        "pos": _text(*properties.centre_of_mass),
        "quat": _text(*quat),
        "mass": _text(properties.mass),
        "diaginertia": _text(*moments),
    }


def _placement(pose: Pose) -> dict[str, str]:
    return {"pos": _text(*pose.position), "quat": _text(*pose.quat_wxyz)}


def _bounds(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Corners of the box around every object's parts [m], shape (3,) each."""
    points = np.concatenate([obj.pose.apply(part.vertices) for obj in scene.objects for part in obj.asset.parts])
    return points.min(axis=0), points.max(axis=0)


def _text(*values: float | Iterable[float]) -> str:
    """Numbers as an attribute, each in the shortest form that reads back exactly."""
    return " ".join(repr(float(value)) for value in values)  # type: ignore[arg-type]
