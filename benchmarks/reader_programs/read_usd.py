"""Readers of USD, and NVIDIA's converters to it."""

from __future__ import annotations

from importlib import metadata
from pathlib import Path
from typing import Any

from read_urdf import masses


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

    return masses(path, mass, metadata.version("urdf-usd-converter"))


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


PROGRAMS = (openusd, newton, blender, ovphysx, mujoco_usd_converter, urdf_usd_converter)
