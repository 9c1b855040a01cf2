"""On URDF and SDF."""

from __future__ import annotations

import xml.etree.ElementTree as ET

from benchmarks.attacks.deeds import DRAKE, Deed, add, dent, document, put, remove, say, swap, text, xml

OWN = "urdf/objects/*/*.urdf"
PROXIMITY = f".//{{{DRAKE}}}proximity_properties"

URDF: dict[str, Deed] = {
    "gravity 0.5": document("urdf/manifest.json", lambda d: d["gravity"].__setitem__(2, -0.5)),
    "attachment": document("urdf/manifest.json", lambda d: d["attachments"].append({"child": "x", "parent": "y"})),
    "fixed": document("urdf/manifest.json", lambda d: d["objects"][0].update(fixed=not d["objects"][0]["fixed"])),
    "moved 0.01 mm": document(
        "urdf/manifest.json",
        lambda d: d["objects"][0]["position"].__setitem__(0, 1e-5 + d["objects"][0]["position"][0]),
    ),
    "friction in the manifest": document("urdf/manifest.json", lambda d: d["objects"][0].update(friction=9.0)),
    "a word more in the manifest": document("urdf/manifest.json", lambda d: d.update(solver="mine")),
    "ground friction": xml("urdf/ground.urdf", put(".//lateral_friction", value="5")),
    "ground lifted": xml("urdf/ground.urdf", put(".//collision/origin", xyz="0 0 -0.4999")),
    "rolling friction": xml(OWN, add("link/contact", "rolling_friction", value="1")),
    "contact stiffness": xml(OWN, add("link/contact", "stiffness", value="10")),
    "visual lifted 5 cm": xml(OWN, put("link/visual/origin", xyz="0 0 0.05")),
    "visual swapped": swap("urdf/objects/*/visual.obj"),
    "texture swapped": swap("urdf/objects/*/texture.png"),
    "part not convex": dent("urdf/objects/*/part_*.obj"),
    "mesh scaled": xml(OWN, put("link/collision/geometry/mesh", scale="1 1 1.1")),
    "mass": xml(OWN, put("link/inertial/mass", value="0.001")),
    "inertia of one": xml(OWN, put("link/inertial/inertia", ixx="1", iyy="1", izz="1")),
    "joint with damping": xml(
        OWN, lambda r: (add(".", "link", name="more")(r), add(".", "joint/dynamics", damping="1")(r))
    ),
    "transmission": xml(OWN, add(".", "transmission", name="t")),
    "dissipation in Drake": xml(
        OWN, lambda r: ET.SubElement(r.find(PROXIMITY), f"{{{DRAKE}}}hunt_crossley_dissipation", value="50")
    ),
    "loader sets another gravity": text(
        "urdf/load_pybullet.py", r"(def load_pybullet)", r"GRAVITY_SCALE = 0.1\n\n\n\1"
    ),
    "loader of Drake welds": text("urdf/load_drake.py", r"return ", "return None or "),
    "directives weld": text("urdf/scene.dmd.yaml", r"\Z", "- add_weld:\n    parent: world\n    child: x\n"),
    "directives move": text("urdf/scene.dmd.yaml", r"translation: \[\S+", "translation: [0.123,"),
    "scene for viewers: visual lifted": xml("urdf/scene.urdf", put("link/visual/origin", xyz="0 0 0.05")),
    "package": text("urdf/package.xml", "pat3d_scene", "other"),
}

S = "sdf/scene.sdf"
MODEL = ".//model[inertial]"

SDF: dict[str, Deed] = {
    "gravity 0.5": xml(S, lambda r: (add("world", "gravity")(r), say("world/gravity", "0 0 -0.5")(r))),
    "time step": xml(
        S, lambda r: (add("world", "physics/max_step_size")(r), say("world/physics/max_step_size", "0.1")(r))
    ),
    "wind": xml(S, add("world", "wind/linear_velocity")),
    "plugin": xml(S, add("world", "plugin", name="p", filename="libp.so")),
    "include": xml(S, add("world", "include/uri")),
    "joint to the world": xml(S, add("world", "joint", name="j", type="fixed")),
    "damping": xml(S, add(".//link[inertial]", "velocity_decay/linear")),
    "kinematic": xml(
        S, lambda r: (add(".//link[inertial]", "kinematic")(r), say(".//link[inertial]/kinematic", "true")(r))
    ),
    "no gravity on one": xml(
        S, lambda r: (add(".//link[inertial]", "gravity")(r), say(".//link[inertial]/gravity", "false")(r))
    ),
    "static": xml(
        S, lambda r: (add(".//model[@name!='ground']", "static")(r), say(".//model[@name!='ground']/static", "true")(r))
    ),
    "ground friction": xml(S, say(".//model[@name='ground']//mu", "5")),
    "ground lifted": xml(S, say(".//model[@name='ground']//collision/pose", "0 0 -0.4999 0 0 0 1")),
    "friction of one": xml(S, say(".//model[@name!='ground']//mu2", "9")),
    "bounce": xml(S, add(".//collision/surface", "bounce/restitution_coefficient")),
    "visual lifted 5 cm": xml(
        S,
        lambda r: (
            add(".//link[inertial]/visual", "pose")(r),
            say(".//link[inertial]/visual/pose", "0 0 0.05 0 0 0")(r),
        ),
    ),
    "mass": xml(S, say(".//mass", "0.001")),
    "moved 0.01 mm": xml(S, say(".//model[@name!='ground']/pose", "0.00001 0 0 0 0 0 1")),
    "visual swapped": swap("sdf/models/*/meshes/visual.obj"),
    "part not convex": dent("sdf/models/*/meshes/part_*.obj"),
    "model's own file: mass": xml("sdf/models/*/model.sdf", say(".//mass", "9")),
    "model's config": xml("sdf/models/*/model.config", say("version", "2.0")),
    "texture missing": remove("sdf/models/*/meshes/texture.png"),
}
