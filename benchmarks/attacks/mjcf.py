"""On MJCF."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable
from typing import Any

from benchmarks.attacks.deeds import Deed, add, dent, more, put, remove, swap, text, xml

M = "mjcf/scene.xml"
BODY = ".//body[freejoint]"
PART = f"{BODY}/geom[@class='collision']"
SEEN = f"{BODY}/geom[@class='visual']"
GROUND = ".//geom[@name='ground']"


def weld_two(root: ET.Element) -> Any:
    """Two objects that move as one."""
    names = [body.attrib["name"] for body in root.iterfind(BODY)]
    if len(names) < 2:
        return False
    return add(".", "equality/weld", body1=names[0], body2=names[1])(root)


def joint(**attributes: str) -> Callable[[ET.Element], Any]:
    """A free joint with `attributes`, which <freejoint> has not."""

    def change(root: ET.Element) -> None:
        body = root.find(BODY)
        free = body.find("freejoint")  # type: ignore[union-attr]
        free.tag = "joint"  # type: ignore[union-attr]
        free.attrib.update(type="free", **attributes)  # type: ignore[union-attr]

    return change


def unfree(root: ET.Element) -> None:
    """An object that cannot move."""
    body = root.find(BODY)
    body.remove(body.find("freejoint"))  # type: ignore[union-attr, arg-type]
    root.remove(root.find("keyframe"))  # type: ignore[arg-type]


def other_mesh(root: ET.Element) -> Any:
    """An object that looks like another."""
    files = [mesh for mesh in root.iterfind("asset/mesh") if mesh.attrib["name"].endswith("_visual")]
    if len(files) < 2:
        return False
    files[0].attrib["file"] = files[1].attrib["file"]
    return True


def ahead(root: ET.Element) -> None:
    """A keyframe with the first object 5 cm up."""
    key = root.find("keyframe/key")
    words = key.attrib["qpos"].split()  # type: ignore[union-attr]
    words[2] = repr(float(words[2]) + 0.05)
    key.attrib["qpos"] = " ".join(words)  # type: ignore[union-attr]


MJCF: dict[str, Deed] = {
    "weld of two objects": xml(M, weld_two),
    "weld to the world": xml(M, lambda r: add(".", "equality/weld", body1=r.find(BODY).attrib["name"])(r)),
    "connect constraint": xml(
        M, lambda r: add(".", "equality/connect", body1=r.find(BODY).attrib["name"], anchor="0 0 0")(r)
    ),
    "joint damping": xml(M, joint(damping="5")),
    "joint friction loss": xml(M, joint(frictionloss="1")),
    "joint armature": xml(M, joint(armature="10")),
    "no free joint": xml(M, unfree),
    "gravity 0.5": xml(M, put("option", gravity="0 0 -0.5")),
    "gravity aslant": xml(M, put("option", gravity="0.3 0 -9.81")),
    "time step 10 us": xml(M, put("option", timestep="0.00001")),
    "time step 20 ms": xml(M, put("option", timestep="0.02")),
    "integrator": xml(M, put("option", integrator="RK4")),
    "solver": xml(M, put("option", solver="PGS")),
    "iterations": xml(M, put("option", iterations="1")),
    "cone": xml(M, put("option", cone="pyramidal")),
    "impratio": xml(M, put("option", impratio="1")),
    "medium as thick as honey": xml(M, put("option", density="1400", viscosity="10")),
    "wind": xml(M, put("option", wind="1 0 0")),
    "contacts overridden": xml(M, put("option", o_margin="0.01")),
    "gravity flag": xml(M, put("option/flag", gravity="disable")),
    "contact flag": xml(M, put("option/flag", contact="disable")),
    "override flag": xml(M, put("option/flag", override="enable")),
    "sleep flag": xml(M, put("option/flag", island="enable")),
    "compiler": xml(M, put("compiler", boundmass="1")),
    "ground friction": xml(M, put(GROUND, friction="5 0.002 0.0001")),
    "ground rolling friction": xml(M, put(GROUND, friction="0.4 0.002 1")),
    "ground lifted 0.1 mm": xml(M, put(GROUND, pos="0 0 -0.4999")),
    "ground soft": xml(M, put(GROUND, solref="0.5 1")),
    "keyframe": xml(M, ahead),
    "keyframe with speeds": xml(
        M, lambda r: put("keyframe/key", qvel=" ".join(["0.1"] * (6 * len(r.findall(BODY)))))(r)
    ),
    "second keyframe": xml(M, add("keyframe", "key", name="other")),
    "visual mesh swapped": xml(M, other_mesh),
    "visual mesh lifted 5 cm": xml(M, put(SEEN, pos="0 0 0.05")),
    "visual mesh scaled": xml(M, put("asset/mesh", scale="1 1 1.2")),
    "visual mesh file swapped": swap("mjcf/meshes/*/visual.obj"),
    "visual mesh collides": xml(M, put(SEEN, contype="1", conaffinity="1")),
    "texture swapped": swap("mjcf/textures/*.png"),
    "part not convex": dent("mjcf/meshes/*/part_*.obj"),
    "part file swapped": swap("mjcf/meshes/*/part_*.obj"),
    "part that does not collide": xml(M, put(PART, contype="0", conaffinity="0")),
    "part frictionless": xml(M, put(PART, friction="0 0 0")),
    "torsional friction": xml(M, put(PART, friction="0.5 1 1")),
    "condim": xml(M, put(PART, condim="6")),
    "margin": xml(M, put(PART, margin="0.005")),
    "gap": xml(M, put(PART, gap="0.001")),
    "solref": xml(M, put(PART, solref="0.02 1")),
    "solimp": xml(M, put(PART, solimp="0.1 0.2 0.01")),
    "priority": xml(M, put(PART, priority="7")),
    "default class": xml(M, put("default/default[@class='collision']/geom", condim="1")),
    "contact excluded": xml(
        M, lambda r: add(".", "contact/exclude", body1=r.find(BODY).attrib["name"], body2="world")(r)
    ),
    "contact pair": xml(
        M, lambda r: add(".", "contact/pair", geom1="ground", geom2=r.find(PART).attrib["name"], friction="9")(r)
    ),
    "actuator": xml(
        M, lambda r: add(".", "actuator/motor", joint=r.find(f"{BODY}/freejoint").attrib["name"], gear="0 0 1 0 0 0")(r)
    ),
    "sensor": xml(M, lambda r: add(".", "sensor/framepos", objtype="body", objname=r.find(BODY).attrib["name"])(r)),
    "gravity compensation": xml(M, put(BODY, gravcomp="1")),
    "mass": xml(M, put(f"{BODY}/inertial", mass="0.001")),
    "inertia of one": xml(M, put(f"{BODY}/inertial", diaginertia="1 1 1")),
    "moved 0.01 mm": text(M, r'(<body name="[^"]*" pos="\S+ \S+ )(\S+)"', r'\g<1>0.00001"'),
    "not a number": text(M, r'(<body name="[^"]*" pos=")\S+', r"\1nan"),
    "invisible crutch": xml(M, add("worldbody", "geom", type="sphere", size="0.2", pos="0 0 0.1", rgba="0 0 0 0")),
    "one more body": xml(M, add("worldbody", "body/geom", type="box", size="0.1 0.1 0.1")),
    "a million copies": xml(M, lambda r: add("worldbody", "replicate/geom", type="sphere", size="0.01")(r)),
    "include": lambda f: (
        more("mjcf/more.xml", "<mujoco><option gravity='0 0 -0.5'/></mujoco>")(f),
        xml(M, add(".", "include", file="more.xml"))(f),
    ),
    "plugin": xml(M, add(".", "extension/plugin", plugin="mujoco.elasticity.cable")),
    "custom number": xml(M, add("custom", "numeric", name="x", data="1")),
    "entity": text(M, r"^<mujoco", '<!DOCTYPE mujoco [<!ENTITY g "0">]>\n<mujoco'),
    "another encoding": lambda f: (f / M).write_bytes((f / M).read_text(encoding="utf-8").encode("utf-16")),
    "file for 3.3: gravity": xml("mjcf/scene_mujoco_3.3.xml", put("option", gravity="0 0 -0.5")),
    "file for 3.3: weld": xml("mjcf/scene_mujoco_3.3.xml", weld_two),
    "object's own file: mass": xml("mjcf/objects/*.xml", put(".//inertial", mass="9")),
    "object's own file: visual lifted": xml("mjcf/objects/*.xml", put(".//geom[@class='visual']", pos="0 0 0.05")),
    "part missing": remove("mjcf/meshes/*/part_*.obj"),
    "texture missing": remove("mjcf/textures/*.png"),
}
