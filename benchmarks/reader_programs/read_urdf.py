"""Readers of URDF, each given every object of a manifest."""

from __future__ import annotations

import json
import os
import sys
from importlib import metadata
from pathlib import Path
from typing import Any


def yourdfpy(path: Path) -> dict[str, Any]:
    """Every object's file, with its meshes; no errors."""
    import yourdfpy as package  # pyright: ignore[reportMissingImports]

    return masses(path, lambda file: _yourdfpy(package, file), metadata.version("yourdfpy"))


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
    return masses(path, mass, package.__version__)


def sapien(path: Path) -> dict[str, Any]:
    """Every object's file, what is seen too, with its own texture where it is opaque.

    Its loader makes materials on a Vulkan device at once. Chromium's SwiftShader is one without a graphics card: give
    it with VK_ICD_FILENAMES=/usr/lib/chromium/vk_swiftshader_icd.json.
    """
    import sapien as package  # pyright: ignore[reportMissingImports]

    scene = package.Scene([package.physx.PhysxCpuSystem(), package.render.RenderSystem()])

    def mass(file: Path) -> float:
        # What has no joints is an actor to it, no articulation.
        _, (actor,) = scene.create_urdf_loader().load_multiple(str(file))
        body = actor.find_component_by_type(package.physx.PhysxRigidDynamicComponent)
        seen = actor.find_component_by_type(package.render.RenderBodyComponent)
        if not body.collision_shapes:
            raise ValueError(f"{file.name}: no collision shape was made")
        looks = [part.material for shape in seen.render_shapes for part in shape.parts]
        pictures = [look.base_color_texture for look in looks if look.base_color[3] == 1.0]
        if not looks or any(one is None or Path(one.filename).parent != file.parent for one in pictures):
            raise ValueError(f"{file.name}: it is shown without its texture")
        return float(body.mass)

    return masses(path, mass, metadata.version("sapien"))


def pybullet(path: Path) -> dict[str, Any]:
    """Every object's file."""
    import pybullet as package  # pyright: ignore[reportMissingImports]

    client = package.connect(package.DIRECT)

    def mass(file: Path) -> float:
        body = package.loadURDF(str(file), physicsClientId=client)
        return float(package.getDynamicsInfo(body, -1, physicsClientId=client)[0])

    return masses(path, mass, metadata.version("pybullet"))


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

    return masses(path, mass, metadata.version("cmeel-urdfdom"))


def masses(path: Path, mass: Any, version: str) -> dict[str, Any]:
    """Masses of all objects of a URDF manifest that move."""
    entries = json.loads(path.read_text(encoding="utf-8"))["objects"]
    known: dict[str, float] = {}
    for entry in entries:
        if entry["file"] not in known:
            known[entry["file"]] = mass((path.parent / entry["file"]).resolve())
    moving = [entry for entry in entries if not entry["fixed"]]
    return {"version": version, "bodies": len(moving), "mass": sum(known[entry["file"]] for entry in moving)}


PROGRAMS = (yourdfpy, pinocchio, sapien, pybullet, urdfdom)
