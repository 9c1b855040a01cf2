"""Readers of SDF worlds; Drake reads the directives of a URDF export too."""

from __future__ import annotations

import json
from functools import cache
from importlib import metadata
from pathlib import Path
from typing import Any


def drake(path: Path) -> dict[str, Any]:
    """The directives, or the SDF world, finalized, with hydroelastic contact computed at load."""
    from pydrake.multibody.parsing import Parser  # pyright: ignore[reportMissingImports]
    from pydrake.multibody.plant import AddMultibodyPlant, MultibodyPlantConfig  # pyright: ignore[reportMissingImports]
    from pydrake.multibody.tree import BodyIndex  # pyright: ignore[reportMissingImports]
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
    fixed = {body.index() for body in plant.GetBodiesWeldedTo(plant.world_body())}
    # What hangs moves without floating.
    bodies = [plant.get_body(BodyIndex(number)) for number in range(plant.num_bodies())]
    moving = [body for body in bodies if body.index() not in fixed]
    mass = sum(body.get_mass(context) for body in moving)
    return {"version": metadata.version("drake"), "bodies": len(moving), "mass": float(mass)}


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


PROGRAMS = (drake, libsdformat)
