"""Readers of MJCF."""

from __future__ import annotations

import math
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


PROGRAMS = (mujoco, mjx, mujoco_warp, dm_control, robosuite, robocasa)
