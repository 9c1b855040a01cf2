"""PyBullet: the URDF export through its own loader, with that loader's settings."""

from __future__ import annotations

import math
import sys
from importlib import metadata
from pathlib import Path
from typing import Any

import pybullet
import recording


def drive(export: Path, seconds: float, _: str, lean: float) -> dict[str, Any]:
    """Load manifest.json with the loader that lies beside it, as its documentation says, and run it."""
    sys.path.insert(0, str(export))
    from load_pybullet import load_pybullet

    client = pybullet.connect(pybullet.DIRECT)
    bodies = load_pybullet(export, client)
    moving = {name: body for name, body in bodies.items() if pybullet.getDynamicsInfo(body, -1, client)[0] > 0.0}
    inverse = {}
    for name, body in moving.items():
        info = pybullet.getDynamicsInfo(body, -1, client)
        inverse[name] = pybullet.invertTransform(info[3], info[4])

    def poses() -> dict[str, list[float]]:
        found = {}
        for name, body in moving.items():
            # PyBullet tells where the principal axes are, not the link's frame.
            centre = pybullet.getBasePositionAndOrientation(body, client)
            position, (x, y, z, w) = pybullet.multiplyTransforms(*centre, *inverse[name])
            found[name] = [*position, w, x, y, z]
        return found

    def step(count: int) -> None:
        for _ in range(count):
            pybullet.stepSimulation(client)

    def pull(down: tuple[float, float, float]) -> None:
        pybullet.setGravity(*(strength * share for share in down), physicsClientId=client)

    parameters = pybullet.getPhysicsEngineParameters(client)
    time_step = parameters["fixedTimeStep"]
    strength = math.hypot(*(parameters[f"gravityAcceleration{axis}"] for axis in "XYZ"))
    found = recording.run(step, poses, time_step, seconds, pull, lean)
    settings = {
        "timestep": time_step,
        "solver iterations": parameters["numSolverIterations"],
        "flags": "URDF_INITIALIZE_SAT_FEATURES, URDF_USE_INERTIA_FROM_FILE",
    }
    return {
        "engine": "PyBullet",
        "version": metadata.version("pybullet"),
        "settings": settings,
        "warnings": [],
        "recording": found,
    }


if __name__ == "__main__":
    recording.main(drive)
