"""What somebody may do to a scene folder, one function each, for benchmarks/attack.py.

An attack changes the folder it is given, or returns False where the scene has nothing for it. Those on exports have to
be convicted by what the export says, too, in case the checksums are forged. The others change what a scene is
(scene.json, assets): with new checksums they would be another scene.
"""

from __future__ import annotations

import json
import re
import shutil
import xml.etree.ElementTree as ET
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from pat3d.exporters.formats import FORMATS, export
from pat3d.geometry.pose import Pose
from pat3d.scene.checksums import record_checksums
from pat3d.scene.io import load_scene, save_scene
from pat3d.scene.model import Relation, Scene, SceneObject

Deed = Callable[[Path], Any]


@dataclass(frozen=True, kw_only=True)
class Attack:
    """One thing done to a folder."""

    name: str
    kind: str
    """Format, "scene", "assets", or "whole" for a folder that is consistent and false."""
    deed: Deed
    forged: bool
    """Whether new checksums leave it convicted."""


DRAKE = "http://drake.mit.edu"


def xml(file: str, change: Callable[[ET.Element], Any]) -> Deed:
    """Change the tree of an XML file."""

    def deed(folder: Path) -> Any:
        ET.register_namespace("drake", DRAKE)
        tree = ET.parse(_one(folder, file))
        done = change(tree.getroot())
        tree.write(_one(folder, file))
        return done

    return deed


def add(above: str, tag: str, **attributes: str) -> Callable[[ET.Element], Any]:
    """An element more in the first element `above`; several tags with slashes make a branch."""

    def change(root: ET.Element) -> None:
        parent = root if above == "." else root.find(above)
        for name in tag.split("/"):
            parent = ET.SubElement(parent if parent is not None else root, name)
        parent.attrib.update({key.rstrip("_"): value for key, value in attributes.items()})  # type: ignore[union-attr]

    return change


def put(path: str, **attributes: str) -> Callable[[ET.Element], Any]:
    """Other attributes of the first element at `path`."""

    def change(root: ET.Element) -> Any:
        element = root.find(path)
        if element is None:
            return False
        element.attrib.update({key.rstrip("_"): value for key, value in attributes.items()})
        return True

    return change


def say(path: str, text: str) -> Callable[[ET.Element], Any]:
    """Another text of the first element at `path`."""

    def change(root: ET.Element) -> Any:
        element = root.find(path)
        if element is None:
            return False
        element.text = text
        return True

    return change


def text(file: str, pattern: str, to: str) -> Deed:
    """Replace what `pattern` matches first in a text file."""

    def deed(folder: Path) -> Any:
        path = _one(folder, file)
        old = path.read_text(encoding="utf-8")
        new = re.sub(pattern, to, old, count=1, flags=re.DOTALL)
        path.write_text(new, encoding="utf-8")
        return new != old

    return deed


def document(file: str, change: Callable[[Any], Any]) -> Deed:
    """Change a JSON file."""

    def deed(folder: Path) -> Any:
        path = _one(folder, file)
        held = json.loads(path.read_text(encoding="utf-8"))
        done = change(held)
        path.write_text(json.dumps(held, indent=1), encoding="utf-8")
        return done

    return deed


def swap(pattern: str) -> Deed:
    """Let one file be another one of its kind."""

    def deed(folder: Path) -> Any:
        files = sorted(folder.glob(pattern))
        other = next((file for file in files[1:] if file.read_bytes() != files[0].read_bytes()), None)
        if other is None:
            return False
        shutil.copyfile(other, files[0])
        return True

    return deed


def dent(pattern: str) -> Deed:
    """Pull one corner of a part to its middle: it is not convex any more."""

    def deed(folder: Path) -> Any:
        path = _one(folder, pattern)
        lines = path.read_text(encoding="utf-8").split("\n")
        rows = [number for number, line in enumerate(lines) if line.startswith("v ")]
        points = [[float(word) for word in lines[row].split()[1:]] for row in rows]
        middle = [sum(axis) / len(points) for axis in zip(*points, strict=True)]
        lines[rows[0]] = "v " + " ".join(repr(0.9 * m + 0.1 * p) for m, p in zip(middle, points[0], strict=True))
        path.write_text("\n".join(lines), encoding="utf-8")

    return deed


def remove(pattern: str) -> Deed:
    """Lose a file."""
    return lambda folder: _one(folder, pattern).unlink()


def more(file: str, content: str) -> Deed:
    """A file that was not there."""
    return lambda folder: (folder / file).write_text(content, encoding="utf-8")


def usd(change: Callable[[Any], Any], file: str = "usd/scene.usdc") -> Deed:
    """Change the stage of a USD layer."""

    def deed(folder: Path) -> Any:
        from pxr import Sdf, Usd

        layer = Sdf.Layer.OpenAsAnonymous(str(_one(folder, file)))
        done = change(Usd.Stage.Open(layer))
        layer.Export(str(_one(folder, file)))
        return done

    return deed


def attribute(path: str, name: str, value: Any, kind: str = "Float") -> Callable[[Any], Any]:
    """Another value of an attribute, made where there is none; "*" in `path` is the first free object."""

    def change(stage: Any) -> Any:
        from pxr import Sdf

        prim = stage.OverridePrim(path.replace("*", _first(stage)))
        prim.CreateAttribute(name, getattr(Sdf.ValueTypeNames, kind)).Set(value)

    return change


def _first(stage: Any) -> str:
    """Name of the first object of a stage whose references are not loaded."""
    return next(prim.GetName() for prim in stage.GetPrimAtPath("/World").GetChildren() if prim.HasAuthoredReferences())


def _one(folder: Path, pattern: str) -> Path:
    return sorted(folder.glob(pattern))[0]


def scene_of(change: Callable[[Scene], Scene | None]) -> Deed:
    """Another scene, written as whole as an honest one, with exports and checksums."""

    def deed(folder: Path) -> Any:
        changed = change(load_scene(folder))
        if changed is None:
            return False
        formats = [name for name in FORMATS if (folder / name).is_dir()]
        save_scene(changed, folder)
        export(changed, formats, folder)
        record_checksums(folder)
        return True

    return deed


def moved(*, by: tuple[float, float, float] = (0, 0, 0), which: int = -1) -> Callable[[Scene], Scene]:
    """The topmost object (or that number `which` from below) moved by `by` [m]."""

    def change(scene: Scene) -> Scene:
        free = sorted((obj for obj in scene.objects if not obj.fixed), key=lambda obj: obj.pose.position[2])
        return _with(scene, free[which], lambda pose: replace(pose, position=tuple(map(sum, zip(pose.position, by)))))  # noqa: B905

    return change


def turned(scene: Scene) -> Scene:
    """The topmost object tilted by three degrees."""
    free = max((obj for obj in scene.objects if not obj.fixed), key=lambda obj: obj.pose.position[2])
    half = 0.5 * 0.05236
    tilt = Pose(quat_wxyz=(1 - half**2 / 2, half, 0.0, 0.0)).rotation
    return _with(scene, free, lambda pose: Pose.from_matrix(tilt @ pose.rotation, pose.position))  # type: ignore[arg-type]


def _with(scene: Scene, which: SceneObject, change: Callable[[Pose], Pose]) -> Scene:
    objects = (replace(obj, pose=change(obj.pose)) if obj is which else obj for obj in scene.objects)
    return replace(scene, objects=tuple(objects))


def falsely_left(scene: Scene) -> Scene:
    """Two objects whose relation is the reverse of what is asked."""
    left, right = sorted(scene.objects, key=lambda obj: obj.pose.position[0])[:: len(scene.objects) - 1]
    return replace(scene, relations=(*scene.relations, Relation(child=right.name, kind="left_of", parent=left.name)))


def dented(scene: Scene) -> Scene:
    """A part that is not convex, in the scene itself."""
    obj = next(one for one in scene.objects if any(part.box is None for part in one.asset.parts))
    number = next(number for number, part in enumerate(obj.asset.parts) if part.box is None)
    part = obj.asset.parts[number]
    vertices = part.vertices.copy()
    vertices[0] = 0.9 * vertices.mean(axis=0) + 0.1 * vertices[0]
    parts = [*obj.asset.parts]
    parts[number] = replace(part, vertices=vertices)
    asset = replace(obj.asset, parts=tuple(parts))
    return replace(scene, objects=tuple(replace(o, asset=asset) if o.asset is obj.asset else o for o in scene.objects))


M = "mjcf/scene.xml"
BODY = ".//body[freejoint]"
PART = f"{BODY}/geom[@class='collision']"
SEEN = f"{BODY}/geom[@class='visual']"
GROUND = ".//geom[@name='ground']"


def weld_two(root: ET.Element) -> Any:
    names = [body.attrib["name"] for body in root.iterfind(BODY)]
    if len(names) < 2:
        return False
    return add(".", "equality/weld", body1=names[0], body2=names[1])(root)


def joint(**attributes: str) -> Callable[[ET.Element], Any]:
    def change(root: ET.Element) -> None:
        body = root.find(BODY)
        free = body.find("freejoint")  # type: ignore[union-attr]
        free.tag = "joint"  # type: ignore[union-attr]
        free.attrib.update(type="free", **attributes)  # type: ignore[union-attr]

    return change


def unfree(root: ET.Element) -> None:
    body = root.find(BODY)
    body.remove(body.find("freejoint"))  # type: ignore[union-attr, arg-type]
    root.remove(root.find("keyframe"))  # type: ignore[arg-type]


def other_mesh(root: ET.Element) -> Any:
    files = [mesh for mesh in root.iterfind("asset/mesh") if mesh.attrib["name"].endswith("/visual")]
    if len(files) < 2:
        return False
    files[0].attrib["file"] = files[1].attrib["file"]
    return True


def ahead(root: ET.Element) -> None:
    key = root.find("keyframe/key")
    words = key.attrib["qpos"].split()  # type: ignore[union-attr]
    words[2] = repr(float(words[2]) + 0.05)
    key.attrib["qpos"] = " ".join(words)  # type: ignore[union-attr]


MJCF: dict[str, Deed] = {
    "weld of two objects": xml(M, weld_two),
    "weld to the world": xml(M, lambda r: add(".", "equality/weld", body1=r.find(BODY).attrib["name"])(r)),
    "connect constraint": xml(M, lambda r: add(".", "equality/connect", body1=r.find(BODY).attrib["name"], anchor="0 0 0")(r)),
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
    "keyframe with speeds": xml(M, lambda r: put("keyframe/key", qvel=" ".join(["0.1"] * (6 * len(r.findall(BODY)))))(r)),
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
    "contact excluded": xml(M, lambda r: add(".", "contact/exclude", body1=r.find(BODY).attrib["name"], body2="world")(r)),
    "contact pair": xml(M, lambda r: add(".", "contact/pair", geom1="ground", geom2=r.find(PART).attrib["name"], friction="9")(r)),
    "actuator": xml(M, lambda r: add(".", "actuator/motor", joint=r.find(f"{BODY}/freejoint").attrib["name"], gear="0 0 1 0 0 0")(r)),
    "sensor": xml(M, lambda r: add(".", "sensor/framepos", objtype="body", objname=r.find(BODY).attrib["name"])(r)),
    "gravity compensation": xml(M, put(BODY, gravcomp="1")),
    "mass": xml(M, put(f"{BODY}/inertial", mass="0.001")),
    "inertia of one": xml(M, put(f"{BODY}/inertial", diaginertia="1 1 1")),
    "moved 0.01 mm": text(M, r'(<body name="[^"]*" pos="\S+ \S+ )(\S+)"', r'\g<1>0.00001"'),
    "not a number": text(M, r'(<body name="[^"]*" pos=")\S+', r"\1nan"),
    "invisible crutch": xml(M, add("worldbody", "geom", type="sphere", size="0.2", pos="0 0 0.1", rgba="0 0 0 0")),
    "one more body": xml(M, add("worldbody", "body/geom", type="box", size="0.1 0.1 0.1")),
    "a million copies": xml(M, lambda r: add("worldbody", "replicate/geom", type="sphere", size="0.01")(r)),
    "include": lambda f: (more("mjcf/more.xml", "<mujoco><option gravity='0 0 -0.5'/></mujoco>")(f), xml(M, add(".", "include", file="more.xml"))(f)),
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
}  # fmt: skip


def fixed_joint(stage: Any) -> None:
    from pxr import UsdPhysics

    made = UsdPhysics.FixedJoint.Define(stage, "/World/hidden")
    made.CreateBody1Rel().SetTargets([f"/World/{_first(stage)}"])


def variant(stage: Any) -> None:
    sets = stage.GetPrimAtPath(f"/World/{_first(stage)}").GetVariantSets().AddVariantSet("look")
    sets.AddVariant("other")


def animated(stage: Any) -> None:
    from pxr import Gf

    place = stage.GetPrimAtPath(f"/World/{_first(stage)}").GetAttribute("xformOp:translate")
    place.Set(Gf.Vec3d(0, 0, 1), 24)


def units(stage: Any) -> None:
    from pxr import UsdGeom

    UsdGeom.SetStageMetersPerUnit(stage, 0.01)


def crutch(stage: Any) -> None:
    from pxr import UsdGeom, UsdPhysics

    cube = UsdGeom.Cube.Define(stage, "/World/crutch")
    cube.CreateVisibilityAttr("invisible")
    UsdPhysics.CollisionAPI.Apply(cube.GetPrim())


def sublayer(folder: Path) -> None:
    more("usd/more.usda", "#usda 1.0\n")(folder)
    usd(lambda stage: stage.GetRootLayer().subLayerPaths.append("more.usda"))(folder)


def asset_points(stage: Any) -> Any:
    from pxr import UsdGeom

    mesh = next(prim for prim in stage.TraverseAll() if prim.IsA(UsdGeom.Mesh) and "visual" in str(prim.GetPath()))
    points = UsdGeom.Mesh(mesh).GetPointsAttr()
    points.Set([(x, y, z + 0.05) for x, y, z in points.Get()])


def asset_part(stage: Any) -> Any:
    from pxr import UsdGeom

    meshes = (prim for prim in stage.TraverseAll() if prim.IsA(UsdGeom.Mesh) and "collision" in str(prim.GetPath()))
    mesh = next(meshes, None)
    if mesh is None:
        return False
    points = UsdGeom.Mesh(mesh).GetPointsAttr()
    held = [tuple(point) for point in points.Get()]
    points.Set([tuple(0.1 * value for value in held[0]), *held[1:]])
    return True


def weight(stage: Any) -> Any:
    for prim in stage.TraverseAll():
        if prim.GetAttribute("physics:mass").HasAuthoredValue():
            prim.GetAttribute("physics:mass").Set(0.001)
            return True
    return False


SCENE, FIRST, GROUND_SURFACE = "/World/PhysicsScene", "/World/*", "/World/Ground/materials/physics"

USD: dict[str, Deed] = {
    "gravity 0.5": usd(attribute(SCENE, "physics:gravityMagnitude", 0.5)),
    "gravity sideways": usd(attribute(SCENE, "physics:gravityDirection", (1, 0, 0), "Vector3f")),
    "time step": usd(attribute(SCENE, "physxScene:timeStepsPerSecond", 10, "UInt")),
    "MuJoCo's time step": usd(attribute(SCENE, "mjc:option:timestep", 0.02, "Double")),
    "solver of PhysX": usd(attribute(SCENE, "physxScene:solverType", "PGS", "Token")),
    "fixed joint": usd(fixed_joint),
    "damping": usd(attribute(FIRST, "physxRigidBody:linearDamping", 50.0)),
    "kinematic": usd(attribute(FIRST, "physics:kinematicEnabled", True, "Bool")),
    "no gravity on one": usd(attribute(FIRST, "physxRigidBody:disableGravity", True, "Bool")),
    "starts moving": usd(attribute(FIRST, "physics:velocity", (0, 0, 1), "Vector3f")),
    "mass overridden": usd(attribute(FIRST, "physics:mass", 0.001)),
    "moved 0.01 mm": usd(lambda s: attribute(FIRST, "xformOp:translate", (0.0, 0.0, 1e-5), "Double3")(s)),
    "animated": usd(animated),
    "ground friction": usd(attribute(GROUND_SURFACE, "physics:dynamicFriction", 5.0)),
    "friction combined otherwise": usd(attribute(GROUND_SURFACE, "physxMaterial:frictionCombineMode", "min", "Token")),
    "ground does not collide": usd(attribute("/World/Ground/collision", "physics:collisionEnabled", False, "Bool")),
    "invisible crutch": usd(crutch),
    "variant": usd(variant),
    "centimetres": usd(units),
    "sublayer": sublayer,
    "asset: visual lifted 5 cm": usd(asset_points, "usd/assets/*/*.usdc"),
    "asset: visual lifted by a transform": usd(
        lambda s: attribute(f"{s.GetDefaultPrim().GetPath()}/visual", "xformOp:translate", (0, 0, 0.05), "Double3")(s),
        "usd/assets/*/*.usdc",
    ),
    "asset: part not convex": lambda f: any(usd(asset_part, str(p.relative_to(f)))(f) for p in sorted(f.glob("usd/assets/*/*.usdc"))),
    "asset: mass": usd(weight, "usd/assets/*/*.usdc"),
    "asset: layer swapped": swap("usd/assets/*/*.usdc"),
    "asset: texture swapped": swap("usd/assets/*/texture.png"),
    "asset: missing": remove("usd/assets/*/*.usdc"),
    "a second scene beside it": more("usd/scene.usda", "#usda 1.0\n"),
}  # fmt: skip

O = "urdf/objects/*/*.urdf"  # noqa: E741
PROXIMITY = f".//{{{DRAKE}}}proximity_properties"

URDF: dict[str, Deed] = {
    "gravity 0.5": document("urdf/manifest.json", lambda d: d["gravity"].__setitem__(2, -0.5)),
    "attachment": document("urdf/manifest.json", lambda d: d["attachments"].append({"child": "x", "parent": "y"})),
    "fixed": document("urdf/manifest.json", lambda d: d["objects"][0].update(fixed=not d["objects"][0]["fixed"])),
    "moved 0.01 mm": document("urdf/manifest.json", lambda d: d["objects"][0]["position"].__setitem__(0, 1e-5 + d["objects"][0]["position"][0])),
    "friction in the manifest": document("urdf/manifest.json", lambda d: d["objects"][0].update(friction=9.0)),
    "a word more in the manifest": document("urdf/manifest.json", lambda d: d.update(solver="mine")),
    "ground friction": xml("urdf/ground.urdf", put(".//lateral_friction", value="5")),
    "ground lifted": xml("urdf/ground.urdf", put(".//collision/origin", xyz="0 0 -0.4999")),
    "rolling friction": xml(O, add("link/contact", "rolling_friction", value="1")),
    "contact stiffness": xml(O, add("link/contact", "stiffness", value="10")),
    "visual lifted 5 cm": xml(O, put("link/visual/origin", xyz="0 0 0.05")),
    "visual swapped": swap("urdf/objects/*/visual.obj"),
    "texture swapped": swap("urdf/objects/*/texture.png"),
    "part not convex": dent("urdf/objects/*/part_*.obj"),
    "mesh scaled": xml(O, put("link/collision/geometry/mesh", scale="1 1 1.1")),
    "mass": xml(O, put("link/inertial/mass", value="0.001")),
    "inertia of one": xml(O, put("link/inertial/inertia", ixx="1", iyy="1", izz="1")),
    "joint with damping": xml(O, lambda r: (add(".", "link", name="more")(r), add(".", "joint/dynamics", damping="1")(r))),
    "transmission": xml(O, add(".", "transmission", name="t")),
    "dissipation in Drake": xml(O, lambda r: ET.SubElement(r.find(PROXIMITY), f"{{{DRAKE}}}hunt_crossley_dissipation", value="50")),
    "loader sets another gravity": text("urdf/load_pybullet.py", r"(def load_pybullet)", r"GRAVITY_SCALE = 0.1\n\n\n\1"),
    "loader of Drake welds": text("urdf/load_drake.py", r"return ", "return None or "),
    "directives weld": text("urdf/scene.dmd.yaml", r"\Z", "- add_weld:\n    parent: world\n    child: x\n"),
    "directives move": text("urdf/scene.dmd.yaml", r"translation: \[\S+", "translation: [0.123,"),
    "scene for viewers: visual lifted": xml("urdf/scene.urdf", put("link/visual/origin", xyz="0 0 0.05")),
    "package": text("urdf/package.xml", "pat3d_scene", "other"),
}  # fmt: skip

S = "sdf/scene.sdf"
MODEL = ".//model[inertial]"

SDF: dict[str, Deed] = {
    "gravity 0.5": xml(S, lambda r: (add("world", "gravity")(r), say("world/gravity", "0 0 -0.5")(r))),
    "time step": xml(S, lambda r: (add("world", "physics/max_step_size")(r), say("world/physics/max_step_size", "0.1")(r))),
    "wind": xml(S, add("world", "wind/linear_velocity")),
    "plugin": xml(S, add("world", "plugin", name="p", filename="libp.so")),
    "include": xml(S, add("world", "include/uri")),
    "joint to the world": xml(S, add("world", "joint", name="j", type="fixed")),
    "damping": xml(S, add(".//link[inertial]", "velocity_decay/linear")),
    "kinematic": xml(S, lambda r: (add(".//link[inertial]", "kinematic")(r), say(".//link[inertial]/kinematic", "true")(r))),
    "no gravity on one": xml(S, lambda r: (add(".//link[inertial]", "gravity")(r), say(".//link[inertial]/gravity", "false")(r))),
    "static": xml(S, lambda r: (add(".//model[@name!='ground']", "static")(r), say(".//model[@name!='ground']/static", "true")(r))),
    "ground friction": xml(S, say(".//model[@name='ground']//mu", "5")),
    "ground lifted": xml(S, say(".//model[@name='ground']//collision/pose", "0 0 -0.4999 0 0 0 1")),
    "friction of one": xml(S, say(".//model[@name!='ground']//mu2", "9")),
    "bounce": xml(S, add(".//collision/surface", "bounce/restitution_coefficient")),
    "visual lifted 5 cm": xml(S, lambda r: (add(".//link[inertial]/visual", "pose")(r), say(".//link[inertial]/visual/pose", "0 0 0.05 0 0 0")(r))),
    "mass": xml(S, say(".//mass", "0.001")),
    "moved 0.01 mm": xml(S, say(".//model[@name!='ground']/pose", "0.00001 0 0 0 0 0 1")),
    "visual swapped": swap("sdf/models/*/meshes/visual.obj"),
    "part not convex": dent("sdf/models/*/meshes/part_*.obj"),
    "model's own file: mass": xml("sdf/models/*/model.sdf", say(".//mass", "9")),
    "model's config": xml("sdf/models/*/model.config", say("version", "2.0")),
    "texture missing": remove("sdf/models/*/meshes/texture.png"),
}  # fmt: skip

J = "scene.json"

EDITED: dict[str, Deed] = {
    "pose moved 1 mm": document(J, lambda d: d["objects"][0]["pose"]["position"].__setitem__(0, 0.001 + d["objects"][0]["pose"]["position"][0])),
    "friction of a material": document(J, lambda d: next(iter(d["assets"].values()))["material"].update(friction=3.0)),
    "settling friction": document(J, lambda d: d.update(settling_friction=0.9)),
    "mass": document(J, lambda d: next(iter(d["assets"].values()))["mass_properties"].update(mass=0.01)),
    "fixed": document(J, lambda d: d["objects"][0].update(fixed=not d["objects"][0]["fixed"])),
    "relation dropped": document(J, lambda d: d["relations"].pop() if d["relations"] else False),
    "provenance": document(J, lambda d: d["provenance"].update(source="elsewhere")),
    "a checksum": document(J, lambda d: d["checksums"].pop(next(iter(d["checksums"])))),
}  # fmt: skip

ASSETS: dict[str, Deed] = {
    "visual swapped": swap("assets/*/visual.obj"),
    "texture swapped": swap("assets/*/texture.png"),
    "part not convex": dent("assets/*/parts/part_*.obj"),
    "part swapped": swap("assets/*/parts/part_*.obj"),
    "material library": text("assets/*/visual.mtl", "Kd 1 1 1", "Kd 0 0 0"),
    "a file more": more("assets/more.obj", "v 0 0 0\n"),
}

WHOLE: dict[str, Deed] = {
    "floats 0.5 mm": scene_of(moved(by=(0.0, 0.0, 0.0005))),
    "sunk 0.1 mm": scene_of(moved(by=(0.0, 0.0, -0.0001))),
    "sunk 2 mm": scene_of(moved(by=(0.0, 0.0, -0.002))),
    "0.3 m aside in the air": scene_of(moved(by=(0.3, 0.3, 0.1))),
    "tilted 3 degrees": scene_of(turned),
    "a relation that is false": scene_of(falsely_left),
    "a part that is not convex": scene_of(dented),
}


def attacks() -> Iterator[Attack]:
    """All of them."""
    for kind, table in (("mjcf", MJCF), ("usd", USD), ("urdf", URDF), ("sdf", SDF)):
        for name, deed in table.items():
            yield Attack(name=name, kind=kind, deed=deed, forged=True)
    for kind, table in (("scene", EDITED), ("assets", ASSETS), ("whole", WHOLE)):
        for name, deed in table.items():
            yield Attack(name=name, kind=kind, deed=deed, forged=False)
