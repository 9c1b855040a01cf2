"""Drake: the model directives of the URDF export through their own loader, with that loader's settings."""

from __future__ import annotations

import logging
import sys
from importlib import metadata
from pathlib import Path
from typing import Any

import numpy as np
import recording
from pydrake.multibody.math import SpatialForce
from pydrake.multibody.plant import AddMultibodyPlant, ExternallyAppliedSpatialForce_
from pydrake.systems.analysis import Simulator
from pydrake.systems.framework import DiagramBuilder


class _Messages(logging.Handler):
    def __init__(self) -> None:
        super().__init__(level=logging.WARNING)
        self.texts: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.texts.append(record.getMessage())


def drive(export: Path, seconds: float, _: str, lean: float) -> dict[str, Any]:
    """Load scene.dmd.yaml with the loader that lies beside it and run it."""
    sys.path.insert(0, str(export))
    from load_drake import load_drake, plant_config

    messages = _Messages()
    logging.getLogger("drake").addHandler(messages)
    config = plant_config()
    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(config, builder)
    bodies = load_drake(export, plant)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    simulator.Initialize()
    context = plant.GetMyContextFromRoot(simulator.get_context())
    moving = {name: body for name, body in bodies.items() if body.is_floating_base_body()}
    steps = 0

    def poses() -> dict[str, list[float]]:
        found = {}
        for name, body in moving.items():
            pose = plant.EvalBodyPoseInWorld(context, body)
            turn = pose.rotation().ToQuaternion()
            found[name] = [*pose.translation(), turn.w(), turn.x(), turn.y(), turn.z()]
        return found

    def step(count: int) -> None:
        nonlocal steps
        steps += count
        simulator.AdvanceTo(steps * config.time_step)

    gravity = np.array(plant.gravity_field().gravity_vector())

    def pull(down: tuple[float, float, float]) -> None:
        # Gravity is part of a plant that is finished, so what it lacks pulls at the centres of mass.
        more = np.linalg.norm(gravity) * np.array(down) - gravity
        forces = []
        for body in moving.values():
            force: Any = ExternallyAppliedSpatialForce_[float]()
            force.body_index = body.index()
            force.p_BoBq_B = body.CalcCenterOfMassInBodyFrame(context)
            force.F_Bq_W = SpatialForce(np.zeros(3), body.get_mass(context) * more)
            forces.append(force)
        plant.get_applied_spatial_force_input_port().FixValue(context, forces)

    found = recording.run(step, poses, config.time_step, seconds, pull, lean)
    settings = {
        "timestep": config.time_step,
        "contact model": config.contact_model,
        "contact surface": config.contact_surface_representation,
        "approximation": config.discrete_contact_approximation,
    }
    return {
        "engine": "Drake",
        "version": metadata.version("drake"),
        "settings": settings,
        "warnings": list(dict.fromkeys(messages.texts)),
        "recording": found,
    }


if __name__ == "__main__":
    recording.main(drive)
