"""A folder of small objects in every format, as other people leave them."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import trimesh
from PIL import Image

SIDES = (0.06, 0.09, 0.18)
"""Of the cracker box [m]."""

URDF = """<?xml version="0.0"?>
<robot name="sponge"><link name="base">
 <contact><lateral_friction value="0.8"/></contact>
 <inertial><origin xyz="0.01 0 0.02" rpy="0 0 0"/><mass value="0.25"/>
  <inertia ixx="2e-4" ixy="1e-6" ixz="0" iyy="3e-4" iyz="0" izz="4e-4"/></inertial>
 <visual><origin xyz="0 0 0.03"/><geometry><box size="0.1 0.06 0.06"/></geometry>
  <material name="red"><color rgba="0.8 0.1 0.1 1"/></material></visual>
 <collision><origin xyz="-0.025 0 0.03"/><geometry><box size="0.05 0.06 0.06"/></geometry></collision>
 <collision><origin xyz="0.025 0 0.03"/><geometry><box size="0.05 0.06 0.06"/></geometry></collision>
</link></robot>"""

MJCF = """<mujoco model="dumbbell"><worldbody><body name="object" pos="1 2 3" quat="0 1 0 0"><freejoint/>
 <geom type="box" size="0.05 0.01 0.01" density="700" friction="0.6 0.1 0.1"/>
 <geom type="box" size="0.02 0.02 0.02" pos="0.04 0 0" density="700" friction="0.6 0.1 0.1"/>
 <geom type="box" size="0.02 0.02 0.02" pos="-0.04 0 0" density="800" friction="0.6 0.1 0.1"/>
</body></worldbody></mujoco>"""

SDF = """<sdf version="1.7"><model name="brick"><link name="link"><pose>0 0 0.025 0 0 0</pose>
 <inertial><mass>1.5</mass></inertial>
 <visual name="v"><geometry><box><size>0.2 0.1 0.05</size></box></geometry></visual>
 <collision name="c"><geometry><box><size>0.2 0.1 0.05</size></box></geometry>
  <surface><friction><ode><mu>0.7</mu></ode></friction></surface></collision>
</link></model></sdf>"""

DOOR = """<robot name="door">
<link name="a"><visual><geometry><box size="1 1 1"/></geometry></visual></link><link name="b"/>
<joint name="hinge" type="revolute"><parent link="a"/><child link="b"/></joint></robot>"""


def bowl(radius: float = 0.08, height: float = 0.06, wall: float = 0.005) -> trimesh.Trimesh:
    """An open straight vessel in metres, z up."""
    outline = [(0, 0), (radius, 0), (radius, height), (radius - wall, height), (radius - wall, wall), (0, wall)]
    return trimesh.creation.revolve(np.array(outline), sections=32)


def write_objects(folder: Path) -> None:
    """All of them, below `folder`."""
    textured_box(folder / "003_cracker_box" / "google_16k")
    turned = bowl().apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0])).apply_scale(1000)
    (folder / "bowl").mkdir()
    turned.export(folder / "bowl" / "model.stl")
    (folder / "bowl" / "meta.json").write_text(json.dumps({"model_cat": "Bowl", "license": "CC0"}))
    for name, text in (("sponge.urdf", URDF), ("dumbbell.xml", MJCF), ("brick.sdf", SDF), ("door.urdf", DOOR)):
        (folder / name).write_text(text)
    (folder / "broken.obj").write_text("v 0 0 0\nf 1 2 3\n")
    (folder / "garbage.glb").write_bytes(b"glTF\x02\0\0\0 nothing")
    (folder / "bomb.urdf").write_text('<!DOCTYPE x [<!ENTITY a "b">]><robot name="&a;"/>')
    (folder / "notes.xml").write_text("<notes><worldbody/></notes>")
    trimesh.creation.box(SIDES).export(folder / "sponge_collision.stl")


def textured_box(folder: Path) -> None:
    """The cracker box, standing, in metres with z up, once as OBJ with a texture and once as STL without."""
    folder.mkdir(parents=True)
    made = trimesh.creation.box(SIDES)
    made.export(folder / "nontextured.stl")
    picture = np.zeros((8, 8, 3), dtype=np.uint8)
    picture[:, :4], picture[:, 4:] = (200, 30, 30), (30, 30, 200)
    Image.fromarray(picture).save(folder / "texture_map.png")
    (folder / "textured.mtl").write_text("newmtl m\nmap_Kd texture_map.png\n")
    lines = ["mtllib textured.mtl", "usemtl m"]
    lines += [f"v {x:.6f} {y:.6f} {z:.6f}" for x, y, z in made.vertices]
    lines += ["vt 0.25 0.5", "vt 0.75 0.5"]
    lines += [
        f"f {a + 1}/{1 + at % 2} {b + 1}/{1 + at % 2} {c + 1}/{1 + at % 2}" for at, (a, b, c) in enumerate(made.faces)
    ]
    (folder / "textured.obj").write_text("\n".join(lines) + "\n")
