"""What scenes and single objects of MJCF have in common: settings of contact, meshes, geoms, inertia."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np

from pat3d.assets.materials import surface_of
from pat3d.exporters.common.frames import text
from pat3d.geometry.mass import MassProperties
from pat3d.geometry.rotations import principal_frame
from pat3d.scene.asset import Asset
from pat3d.scene.obj_files import part_file

TORSIONAL_FRICTION = 0.002
"""[m], spin about the contact normal; the radius of a small contact patch."""

ROLLING_FRICTION = 0.0001
"""[m]"""

CONDIM = "4"
"""Contact forces along the normal, the two tangents, and a torque about the normal."""

SOLREF = "0.004 1"
"""Two time steps [s], critically damped."""

SOLIMP = "0.99 0.999 0.0001"

HULL_MESH = {"inertia": "convex", "smoothnormal": "false"}
VISUAL_MESH = {"inertia": "shell"}


def save_xml(root: ET.Element, path: Path) -> None:
    """Write `root` indented."""
    ET.indent(root)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=False)


def empty_model(model: str, above: str = "") -> ET.Element:
    """An empty model whose meshes and textures lie in the folder `above`."""
    root = ET.Element("mujoco", model=model)
    ET.SubElement(
        root,
        "compiler",
        angle="radian",
        meshdir=f"{above}meshes",
        texturedir=f"{above}textures",
        inertiafromgeom="false",
        autolimits="true",
    )
    return root


def add_defaults(root: ET.Element) -> None:
    """The classes "visual" and "collision" that geoms refer to."""
    default = ET.SubElement(root, "default")
    visual = ET.SubElement(default, "default", {"class": "visual"})
    ET.SubElement(visual, "geom", type="mesh", group="2", contype="0", conaffinity="0", mass="0")
    collision = ET.SubElement(default, "default", {"class": "collision"})
    ET.SubElement(
        collision, "geom", group="3", condim=CONDIM, solref=SOLREF, solimp=SOLIMP, mass="0", rgba="0.4 0.6 0.9 0.5"
    )


def declare_files(asset: Asset, name: str, assets: ET.Element, *, as_mesh: bool) -> None:
    """Declare the files of one asset; those of its boxes where they are meshes."""
    ET.SubElement(assets, "texture", name=name, type="2d", file=f"{name}.png")
    for one in asset.visual.maps:
        ET.SubElement(assets, "texture", name=f"{name}_{one}", type="2d", file=f"{name}_{one}.png")
    surface = surface_of(asset)
    material = ET.SubElement(
        assets,
        "material",
        name=name,
        # What MuJoCo's own renderer draws with; others read the two that follow.
        specular=text(0.2 + 0.6 * surface.metallic),
        shininess=text(round(0.65 * (1.0 - surface.roughness), 4)),
        roughness=text(surface.roughness),
        metallic=text(surface.metallic),
    )
    if asset.visual.maps:
        for role, one in (("rgb", name), *((one, f"{name}_{one}") for one in asset.visual.maps)):
            ET.SubElement(material, "layer", role=role, texture=one)
    else:
        material.set("texture", name)
    if surface.opacity < 1.0 and "opacity" not in asset.visual.maps:
        material.set("rgba", text(1.0, 1.0, 1.0, surface.opacity))
    ET.SubElement(assets, "mesh", VISUAL_MESH, name=f"{name}_visual", file=f"{name}/visual.obj")
    for number, part in enumerate(asset.parts):
        if part.box is None or as_mesh:
            file = f"{name}/{part_file(number)}"
            ET.SubElement(assets, "mesh", HULL_MESH, name=f"{name}_part_{number:03d}", file=file)


def add_geoms(body: ET.Element, name: str, asset: Asset, stored: str, *, margin: float | None, as_mesh: bool) -> None:
    """The geoms of one body, drawn from the files of asset `stored`; no margin is written where it is None."""
    ET.SubElement(body, "geom", {"class": "visual"}, name=f"{name}_visual", mesh=f"{stored}_visual", material=stored)
    friction = text(asset.material.friction, TORSIONAL_FRICTION, ROLLING_FRICTION)
    for number, part in enumerate(asset.parts):
        geom = ET.SubElement(body, "geom", {"class": "collision"}, name=f"{name}_part_{number:03d}", friction=friction)
        if margin is not None:
            geom.set("margin", text(margin))
        if part.box is None or as_mesh:
            geom.set("type", "mesh")
            geom.set("mesh", f"{stored}_part_{number:03d}")
        else:
            centre, half, quat = part.box
            geom.set("type", "box")
            geom.set("pos", text(*centre))
            geom.set("size", text(*half))
            if quat != (1.0, 0.0, 0.0, 0.0):
                geom.set("quat", text(*quat))


def inertial(properties: MassProperties) -> dict[str, str]:
    """Mass, centre and principal inertia.

    MuJoCo's own diagonalisation of fullinertia stops at 1e-12 kg m^2 off the diagonal, a tenth of a per cent
    of a pencil; numpy's is exact to rounding.
    """
    moments, quat = principal_frame(np.array(properties.inertia))
    return {
        "pos": text(*properties.centre_of_mass),
        "quat": text(*quat),
        "mass": text(properties.mass),
        "diaginertia": text(*moments),
    }
