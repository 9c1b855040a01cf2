"""One object of a scene as an MJCF model of its own, for MuJoCo, and for robosuite and RoboCasa.

robosuite's MujocoXMLObject wants a body "object" in a nameless one, collision geoms in group 0 and visual ones in
group 1, paths of files from the file itself, no joint (it makes one), and three sites that say how far the object
reaches. RoboCasa's MJCFObject reads that from a box "reg_bbox" that nothing touches. The same file attaches in
dm_control, where the free joint is given to the frame of the attachment.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from pat3d.exporters.common.frames import text
from pat3d.exporters.mjcf.elements import (
    CONDIM,
    SOLIMP,
    SOLREF,
    add_defaults,
    add_geoms,
    declare_files,
    empty_model,
    inertial,
)
from pat3d.scene.asset import Asset

_SITE = {"size": "0.005", "rgba": "0 0 0 0"}


def object_model(asset: Asset, name: str) -> ET.Element:
    """One object by itself, at the origin; its files are those of the scene.

    No margin and no options: those of the model that it is attached to hold.
    """
    root = empty_model(name, "../")
    add_defaults(root)
    declare_files(asset, name, ET.SubElement(root, "asset"), as_mesh=False)
    body = ET.SubElement(ET.SubElement(root, "worldbody"), "body", name=name)
    ET.SubElement(body, "inertial", inertial(asset.mass_properties))
    ET.SubElement(body, "freejoint", name=name)
    add_geoms(body, name, asset, name, margin=0.0, as_mesh=False)
    return root


def robosuite_model(asset: Asset, name: str) -> ET.Element:
    """One object for robosuite's MujocoXMLObject and RoboCasa's MJCFObject; its files are those of the scene."""
    root = ET.Element("mujoco", model=name)
    ET.SubElement(root, "compiler", angle="radian", inertiafromgeom="false", autolimits="true")
    assets = ET.SubElement(root, "asset")
    declare_files(asset, name, assets, as_mesh=False)
    for element in assets.iterfind("*[@file]"):
        above = "textures" if element.tag == "texture" else "meshes"
        element.set("file", f"../{above}/{element.get('file')}")
    outer = ET.SubElement(ET.SubElement(root, "worldbody"), "body")
    body = ET.SubElement(outer, "body", name="object")
    ET.SubElement(body, "inertial", inertial(asset.mass_properties))
    add_geoms(body, name, asset, name, margin=None, as_mesh=False)
    for geom in body.iterfind("geom"):
        if geom.attrib.pop("class") == "visual":
            geom.attrib.update(type="mesh", group="1", contype="0", conaffinity="0", mass="0")
        else:
            geom.attrib.update(group="0", condim=CONDIM, solref=SOLREF, solimp=SOLIMP, mass="0")
    low, high = asset.bounds
    middle, half = (low + high) / 2, (high - low) / 2
    box = {"name": "reg_bbox", "type": "box", "pos": text(*middle), "size": text(*half), "rgba": "0 0 0 0"}
    ET.SubElement(body, "geom", {**box, "group": "1", "contype": "0", "conaffinity": "0", "mass": "0"})
    ET.SubElement(outer, "site", {**_SITE, "name": "bottom_site", "pos": text(middle[0], middle[1], low[2])})
    ET.SubElement(outer, "site", {**_SITE, "name": "top_site", "pos": text(middle[0], middle[1], high[2])})
    # robosuite takes the first coordinate for the radius; its own objects repeat it in the second.
    radius = max(float(np.linalg.norm(part.vertices[:, :2], axis=1).max()) for part in asset.parts)
    ET.SubElement(outer, "site", {**_SITE, "name": "horizontal_radius_site", "pos": text(radius, radius, 0.0)})
    return root
