"""What readers of scene formats make of a file, each run in an environment of its own.

    python reader_programs.py READER FILE ...

Prints one line of JSON for every file: the version, how many bodies can move, and what they weigh together [kg], or an
error. Needs the reader's own package and nothing else, least of all ours.
"""

from __future__ import annotations

import json
import math
import os
import sys
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any


def mujoco(path: Path) -> dict[str, Any]:
    """Compiled, and stepped for a tenth of a second."""
    import mujoco as package

    model = package.MjModel.from_xml_path(str(path))
    data = package.MjData(model)
    package.mj_step(model, data, nstep=50)
    free = [int(model.jnt_bodyid[k]) for k in range(model.njnt) if model.jnt_type[k] == package.mjtJoint.mjJNT_FREE]
    if not math.isfinite(float(data.qpos.sum())):
        raise ValueError("the state is not finite after a tenth of a second")
    return {"version": package.__version__, "bodies": len(free), "mass": float(sum(model.body_mass[free]))}


def mjx(path: Path) -> dict[str, Any]:
    """Put on a device, which is where MJX refuses what it does not know; XLA takes minutes to compile a step."""
    import mujoco as package
    from mujoco import mjx as xla  # pyright: ignore[reportMissingImports]

    model = package.MjModel.from_xml_path(str(path))
    there = xla.put_model(model)
    xla.make_data(model)
    free = [int(model.jnt_bodyid[k]) for k in range(model.njnt) if model.jnt_type[k] == package.mjtJoint.mjJNT_FREE]
    mass = float(sum(float(there.body_mass[body]) for body in free))
    return {"version": metadata.version("mujoco-mjx"), "bodies": len(free), "mass": mass}


def mujoco_warp(path: Path) -> dict[str, Any]:
    """Put on a device and stepped once."""
    import mujoco as package
    import mujoco_warp  # pyright: ignore[reportMissingImports]

    model = package.MjModel.from_xml_path(str(path))
    there = mujoco_warp.put_model(model)
    data = mujoco_warp.put_data(model, package.MjData(model))
    mujoco_warp.step(there, data)
    if not math.isfinite(float(data.qpos.numpy().sum())):
        raise ValueError("the state is not finite after a step")
    free = [int(model.jnt_bodyid[k]) for k in range(model.njnt) if model.jnt_type[k] == package.mjtJoint.mjJNT_FREE]
    return {"version": metadata.version("mujoco-warp"), "bodies": len(free), "mass": float(sum(model.body_mass[free]))}


def dm_control(path: Path) -> dict[str, Any]:
    """The scene parsed by dm_control.mjcf; every object of it attached to an arena by a free joint, and compiled."""
    from dm_control import mjcf  # pyright: ignore[reportMissingImports]

    physics = mjcf.Physics.from_mjcf_model(mjcf.from_path(str(path)))
    objects = sorted((path.parent / "robosuite").glob("*.xml"))
    arena = mjcf.RootElement(model="arena")
    for file in objects:
        arena.attach(mjcf.from_path(str(file))).add("freejoint")
    attached = mjcf.Physics.from_mjcf_model(arena)
    if attached.model.njnt != len(objects):
        raise ValueError(f"{attached.model.njnt} joints for {len(objects)} objects after attach")
    free = [int(physics.model.jnt_bodyid[k]) for k in range(physics.model.njnt) if physics.model.jnt_type[k] == 0]
    mass = float(sum(physics.model.body_mass[free]))
    return {"version": metadata.version("dm_control"), "bodies": len(free), "mass": mass}


def robosuite(path: Path) -> dict[str, Any]:
    """Every object by MujocoXMLObject, each compiled alone; as many as there are files."""
    import tempfile

    from robosuite.models.base import MujocoXML  # pyright: ignore[reportMissingImports]
    from robosuite.models.objects import MujocoXMLObject  # pyright: ignore[reportMissingImports]

    files = sorted((path.parent / "robosuite").glob("*.xml"))
    for file in files:
        with tempfile.TemporaryDirectory() as folder:
            arena = Path(folder) / "arena.xml"
            arena.write_text("<mujoco><worldbody/></mujoco>")
            world, thing = MujocoXML(str(arena)), MujocoXMLObject(str(file), name="thing")
            world.merge_assets(thing)
            world.worldbody.append(thing.get_obj())
            world.get_model()
    return {"version": metadata.version("robosuite"), "objects": len(files)}


def robocasa(path: Path) -> dict[str, Any]:
    """Every object by RoboCasa's MJCFObject at half its size, asked for its region, compiled; as many as there are."""
    import shutil
    import tempfile

    from robocasa.models.objects.objects import MJCFObject  # pyright: ignore[reportMissingImports]
    from robosuite.models.base import MujocoXML  # pyright: ignore[reportMissingImports]

    files = sorted((path.parent / "robosuite").glob("*.xml"))
    with tempfile.TemporaryDirectory() as folder:
        # It writes a file beside the one that it reads.
        copy = Path(shutil.copytree(path.parent, Path(folder) / "mjcf"))
        for file in sorted((copy / "robosuite").glob("*.xml")):
            arena = Path(folder) / "arena.xml"
            arena.write_text("<mujoco><worldbody/></mujoco>")
            world, thing = MujocoXML(str(arena)), MJCFObject("thing", str(file), scale=0.5)
            tall = float(thing.top_offset[2] - thing.bottom_offset[2])
            if not (tall > 0.0 and thing.horizontal_radius > 0.0 and len(thing.get_bbox_points()) == 8):
                raise ValueError(f"{file.name}: its region is {tall} m tall")
            world.merge_assets(thing)
            world.worldbody.append(thing.get_obj())
            world.get_model()
    return {"version": metadata.version("rpent-robocasa365"), "objects": len(files)}


def yourdfpy(path: Path) -> dict[str, Any]:
    """Every object's file, with its meshes; no errors."""
    import yourdfpy as package  # pyright: ignore[reportMissingImports]

    return _objects(path, lambda file: _yourdfpy(package, file), metadata.version("yourdfpy"))


def _yourdfpy(package: Any, file: Path) -> float:
    robot = package.URDF.load(str(file), build_collision_scene_graph=True, load_collision_meshes=True)
    if not robot.validate():
        raise ValueError(f"{file.name}: {robot.errors[:2]}")
    (link,) = robot.link_map.values()
    if not robot.scene.geometry or not robot.collision_scene.geometry:
        raise ValueError(f"{file.name}: its meshes were not found")
    return float(link.inertial.mass)


def pinocchio(path: Path) -> dict[str, Any]:
    """Every object's file with its collision meshes, started from the root folder without any package folder."""
    import pinocchio as package  # pyright: ignore[reportMissingImports]

    def mass(file: Path) -> float:
        # One free link: its inertia is the root joint's.
        model = package.buildModelFromUrdf(str(file), package.JointModelFreeFlyer())
        geometry = package.buildGeomFromUrdf(model, str(file), package.GeometryType.COLLISION)
        if not geometry.ngeoms:
            raise ValueError(f"{file.name}: no geometry was read")
        return float(model.inertias[1].mass)

    os.chdir("/")
    return _objects(path, mass, package.__version__)


def sapien(path: Path) -> dict[str, Any]:
    """Every object's file, without what is seen: SAPIEN's loader makes materials on a graphics device at once."""
    import tempfile
    import xml.etree.ElementTree as ET

    import sapien as package  # pyright: ignore[reportMissingImports]

    scene = package.Scene([package.physx.PhysxCpuSystem()])

    def mass(file: Path) -> float:
        tree = ET.parse(file)
        for link in tree.getroot().findall("link"):
            for visual in link.findall("visual"):
                link.remove(visual)
        loader = scene.create_urdf_loader()
        with tempfile.TemporaryDirectory() as folder:
            for beside in file.parent.iterdir():
                (Path(folder) / beside.name).symlink_to(beside)
            bare = Path(folder) / "without_visuals.urdf"
            tree.write(bare)
            # What has no joints is an actor to it, no articulation.
            _, (actor,) = loader.load_multiple(str(bare))
        body = actor.find_component_by_type(package.physx.PhysxRigidDynamicComponent)
        if not body.collision_shapes:
            raise ValueError(f"{file.name}: no collision shape was made")
        return float(body.mass)

    return _objects(path, mass, metadata.version("sapien"))


def pybullet(path: Path) -> dict[str, Any]:
    """Every object's file."""
    import pybullet as package  # pyright: ignore[reportMissingImports]

    client = package.connect(package.DIRECT)

    def mass(file: Path) -> float:
        body = package.loadURDF(str(file), physicsClientId=client)
        return float(package.getDynamicsInfo(body, -1, physicsClientId=client)[0])

    return _objects(path, mass, metadata.version("pybullet"))


def _objects(path: Path, mass: Any, version: str) -> dict[str, Any]:
    """Masses of all objects of a URDF manifest that move."""
    entries = json.loads(path.read_text(encoding="utf-8"))["objects"]
    known: dict[str, float] = {}
    for entry in entries:
        if entry["file"] not in known:
            known[entry["file"]] = mass((path.parent / entry["file"]).resolve())
    moving = [entry for entry in entries if not entry["fixed"]]
    return {"version": version, "bodies": len(moving), "mass": sum(known[entry["file"]] for entry in moving)}


def drake(path: Path) -> dict[str, Any]:
    """The directives, or the SDF world, finalized, with hydroelastic contact computed at load."""
    from pydrake.multibody.parsing import Parser  # pyright: ignore[reportMissingImports]
    from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig  # pyright: ignore[reportMissingImports]
    from pydrake.systems.framework import DiagramBuilder  # pyright: ignore[reportMissingImports]

    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(
        MultibodyPlantConfig(time_step=1e-3, contact_model="hydroelastic_with_fallback"), builder
    )
    parser = Parser(plant)
    if path.name == "manifest.json":
        parser.package_map().Add("pat3d_scene", str(path.parent))
        parser.AddModels(str(path.parent / "scene.dmd.yaml"))
    else:
        parser.AddModels(str(path))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    builder.Build().CreateDefaultContext()
    free = sorted(plant.GetFloatingBaseBodies())
    mass = sum(plant.get_body(index).get_mass(context) for index in free)
    return {"version": metadata.version("drake"), "bodies": len(free), "mass": float(mass)}


def urdfdom(path: Path) -> dict[str, Any]:
    """Every object's file through check_urdf, the parser of ROS."""
    import re
    import subprocess
    import xml.etree.ElementTree as ET

    prefix = Path(sys.prefix) / "lib" / f"python3.{sys.version_info.minor}" / "site-packages" / "cmeel.prefix"
    program, environment = prefix / "bin" / "check_urdf", {**os.environ, "LD_LIBRARY_PATH": str(prefix / "lib")}

    def mass(file: Path) -> float:
        command = [str(program), str(file)]
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
        if done.returncode or not re.search(r"[Ss]uccessfully", done.stdout):
            raise ValueError(f"{file.name}: {(done.stderr or done.stdout).strip()[:200]}")
        # It prints the tree of links and no masses.
        return float(ET.parse(file).getroot().find("link/inertial/mass").get("value"))  # pyright: ignore

    return _objects(path, mass, metadata.version("cmeel-urdfdom"))


def libsdformat(path: Path) -> dict[str, Any]:
    """The world and every model file by libsdformat, Gazebo's own parser, without an error.

    Version 12 knows SDF 1.9 and warns of the hint that a mesh is convex, which later ones know.
    """
    import subprocess

    models = sorted(path.parent.glob("models/*/model.sdf"))
    done = subprocess.run([_read_sdf(), str(path), *map(str, models)], capture_output=True, text=True, check=False)
    if done.returncode:
        raise ValueError((done.stderr or done.stdout).strip().splitlines()[-1][-200:])
    return json.loads(done.stdout.splitlines()[0])


@cache
def _read_sdf() -> str:
    """read_sdf.cc, compiled for the libsdformat that is installed; it goes when the machine clears its temporaries."""
    import subprocess
    import tempfile

    flags = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    said = subprocess.run(flags, capture_output=True, text=True, check=False)
    if said.returncode:
        raise RuntimeError("libsdformat is not installed: apt install g++ pkg-config libsdformat-dev")
    program = str(Path(tempfile.mkdtemp(prefix="pat3d-")) / "read_sdf")
    source = str(Path(__file__).with_name("read_sdf.cc"))
    made = ["g++", "-std=c++17", source, "-o", program, *said.stdout.split()]
    subprocess.run(made, check=True, capture_output=True)
    return program


def mujoco_usd_converter(path: Path) -> dict[str, Any]:
    """Our MJCF as NVIDIA's converter writes it as USD."""
    import tempfile

    import mujoco_usd_converter as package  # pyright: ignore[reportMissingImports]

    with tempfile.TemporaryDirectory() as folder:
        made = package.Converter().convert(str(path), folder)
        return {"version": metadata.version("mujoco-usd-converter"), **_rigid(made.path)}


def urdf_usd_converter(path: Path) -> dict[str, Any]:
    """Our URDF as NVIDIA's converter writes it as USD, every object's file."""
    import tempfile

    import urdf_usd_converter as package  # pyright: ignore[reportMissingImports]

    def mass(file: Path) -> float:
        with tempfile.TemporaryDirectory() as folder:
            # The converter fixes the root link of a robot to the world.
            return float(_rigid(package.Converter().convert(str(file), folder).path, fixed_too=True)["mass"])

    return _objects(path, mass, metadata.version("urdf-usd-converter"))


def _rigid(path: str, *, fixed_too: bool = False) -> dict[str, Any]:
    """Count and mass of the rigid bodies of a stage; those that a fixed joint ties to the world only `fixed_too`."""
    from pxr import Usd, UsdPhysics  # pyright: ignore[reportMissingImports]

    stage = Usd.Stage.Open(path)
    joints = [UsdPhysics.FixedJoint(prim) for prim in stage.Traverse() if prim.IsA(UsdPhysics.FixedJoint)]
    ends = [[*one.GetBody0Rel().GetTargets(), *one.GetBody1Rel().GetTargets()] for one in joints]
    rigid = {prim.GetPath(): prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)}
    tied = {path for pair in ends for path in pair if sum(end in rigid for end in pair) == 1}
    moving = [prim for path, prim in rigid.items() if fixed_too or path not in tied]
    mass = sum(float(UsdPhysics.MassAPI(prim).GetMassAttr().Get()) for prim in moving)
    return {"bodies": len(moving), "mass": mass}


def ovphysx(path: Path) -> dict[str, Any]:
    """Taken into PhysX on the CPU as Isaac Sim takes it, and stepped."""
    import ovphysx as package  # pyright: ignore[reportMissingImports]
    import ovstage  # pyright: ignore[reportMissingImports]
    from ovphysx.samples.python_samples.schema_support import (  # pyright: ignore[reportMissingImports]
        physx_schema_paths,
    )
    from ovphysx.types import ObjectScope, SimObjectType  # pyright: ignore[reportMissingImports]

    roots = [*map(str, physx_schema_paths()), str(package.newton_schema_root())]
    ovstage.population.register_usd_schemas(roots)
    stage = ovstage.Stage("scene")
    ovstage.population.open_usd(stage, str(path), ordinal=1, domains=ovstage.PopulationDomain.ALL)
    stage.advance_write_floor(ordinal=1).wait()
    physx = package.PhysX()
    physx.wait_task(physx.attach_ovstage(stage, read_ordinal=1))
    physx.step_sync(0.001)
    with physx.read_sync(SimObjectType.RIGID_BODY, ["position"], scope=ObjectScope.ALL) as result:
        bodies = sum(len(result.dictionary.get_path_strings(group.prim_list)) for group in result.groups)
    physx.wait_task(physx.detach_ovstage())
    return {"version": metadata.version("ovphysx"), "bodies": bodies}


def openusd(path: Path) -> dict[str, Any]:
    """Opened and composed; no error or warning of the validators that come with it."""
    from pxr import Usd, UsdPhysics, UsdValidation  # pyright: ignore[reportMissingImports]

    stage = Usd.Stage.Open(str(path))
    registry = UsdValidation.ValidationRegistry()
    issues = UsdValidation.ValidationContext(registry.GetOrLoadAllValidators()).Validate(stage)
    if issues:
        raise ValueError(issues[0].GetErrorAsString())
    moving = [prim for prim in stage.Traverse() if prim.HasAPI(UsdPhysics.RigidBodyAPI)]
    mass = sum(float(UsdPhysics.MassAPI(prim).GetMassAttr().Get()) for prim in moving)
    return {"version": metadata.version("usd-core"), "bodies": len(moving), "mass": mass}


def newton(path: Path) -> dict[str, Any]:
    """Parsed into a model and finalized on the CPU."""
    import newton as package  # pyright: ignore[reportMissingImports]

    builder = package.ModelBuilder()
    builder.add_usd(str(path))
    masses = [float(mass) for mass in builder.body_mass if mass > 0.0]
    builder.finalize(device="cpu")
    return {"version": metadata.version("newton"), "bodies": len(masses), "mass": sum(masses)}


def blender(path: Path) -> dict[str, Any]:
    """Imported by Blender: its meshes, and the pictures that differ."""
    import bpy  # pyright: ignore[reportMissingImports]
    import numpy as np

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.wm.usd_import(filepath=str(path))
    pictures = set()
    for image in bpy.data.images:
        if image.size[0] > 0:
            values = np.empty(len(image.pixels), dtype=np.float32)
            image.pixels.foreach_get(values)
            pictures.add((tuple(image.size), values.tobytes()))
    meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    return {"version": bpy.app.version_string, "meshes": len(meshes), "pictures": len(pictures)}


PROGRAMS = {
    function.__name__: function
    for function in (
        mujoco,
        mjx,
        mujoco_warp,
        dm_control,
        robosuite,
        robocasa,
        yourdfpy,
        pinocchio,
        sapien,
        pybullet,
        urdfdom,
        urdf_usd_converter,
        drake,
        libsdformat,
        openusd,
        mujoco_usd_converter,
        ovphysx,
        newton,
        blender,
    )
}


def main(reader: str, files: list[str]) -> None:
    """Read one file after the other; the line of each tells its name."""
    for file in files:
        try:
            found = PROGRAMS[reader](Path(file).resolve())
        except Exception as error:
            # Whatever a reader raises is the answer to whether it reads the file.
            lines = [line for line in str(error).splitlines() if line.strip()]
            found = {"error": f"{type(error).__name__}: {lines[-1] if lines else ''}"}
        print("\n" + json.dumps({"file": file, **found}), flush=True)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2:])
