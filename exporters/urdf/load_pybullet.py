"""Load a URDF export of PAT3D into PyBullet, as still as it was settled. Copy this file freely; it needs PyBullet only.

    import pybullet
    from load_pybullet import load_pybullet

    client = pybullet.connect(pybullet.DIRECT)
    bodies = load_pybullet("exports/desk/urdf", client)
    for _ in range(5000):
        pybullet.stepSimulation(physicsClientId=client)

Run as a script it loads the folder it lies in, steps for five seconds and says how far everything moved.
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

TIME_STEP = 0.001
"""[s]"""

SPINNING_FRICTION = 0.002
"""[m], against spin about the contact normal; without it a pen that leans in a cup turns."""


def load_pybullet(folder: str | Path, client: int = 0, *, geometric_friction: bool = True) -> dict[str, int]:
    """Load the ground, every object at its pose and the attachments.

    Args:
        folder: holds manifest.json.
        client: of pybullet.connect; its gravity and contact settings are set.
        geometric_friction: Bullet multiplies the coefficients of two bodies; with this each gets the square root
            of its own, so that a pair has their geometric mean rather than far too little.

    Returns:
        PyBullet's number of every body by its name, the ground's among them.
    """
    import pybullet  # pyright: ignore[reportMissingImports]

    folder = Path(folder)
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    if manifest.get("format") != "pat3d-urdf":
        raise ValueError(f"{folder / 'manifest.json'} is not the manifest of a URDF export of PAT3D.")
    pybullet.setGravity(*manifest["gravity"], physicsClientId=client)
    # At PyBullet's own 1/240 s stacks of hulls creep by millimetres; contact slop lets bodies sink by as much. Its own
    # threshold, the square of 0.3 mm/s, stops the solver so early that what is wedged creeps at that speed.
    pybullet.setPhysicsEngineParameter(
        numSolverIterations=200,
        solverResidualThreshold=0.0,
        contactSlop=0.0,
        fixedTimeStep=TIME_STEP,
        physicsClientId=client,
    )
    # Without the first, hulls keep apart by their margins and everything floats by 1 to 2 mm; without the second,
    # inertias are guessed from the collision shapes.
    flags = pybullet.URDF_INITIALIZE_SAT_FEATURES | pybullet.URDF_USE_INERTIA_FROM_FILE
    bodies: dict[str, int] = {}
    ground = manifest["ground"]
    entries = [{**ground, "name": "ground", "fixed": True, "position": [0, 0, 0], "quat_xyzw": [0, 0, 0, 1]}]
    for entry in entries + manifest["objects"]:
        body = pybullet.loadURDF(
            str(folder / entry["file"]),
            entry["position"],
            entry["quat_xyzw"],
            useFixedBase=entry["fixed"],
            flags=flags,
            physicsClientId=client,
        )
        bodies[entry["name"]] = body
        friction = math.sqrt(entry["friction"]) if geometric_friction else entry["friction"]
        # Without anchors friction holds velocities only, and what is loaded creeps by millimetres a minute.
        pybullet.changeDynamics(
            body,
            -1,
            lateralFriction=friction,
            frictionAnchor=1,
            spinningFriction=SPINNING_FRICTION,
            linearDamping=0.0,
            angularDamping=0.0,
            physicsClientId=client,
        )
    for attachment in manifest["attachments"]:
        _attach(pybullet, client, attachment, bodies)
    return bodies


def _attach(pybullet: Any, client: int, attachment: dict[str, Any], bodies: dict[str, int]) -> None:
    """A point-to-point constraint for every anchor; PyBullet counts points from the centres of mass."""
    child, parent = bodies[attachment["child"]], bodies[attachment["parent"]]
    for anchor in attachment["anchors"]:
        pybullet.createConstraint(
            parent,
            -1,
            child,
            -1,
            pybullet.JOINT_POINT2POINT,
            [0, 0, 0],
            _from_centre(pybullet, client, parent, anchor["parent_point"]),
            _from_centre(pybullet, client, child, anchor["child_point"]),
            physicsClientId=client,
        )


def _from_centre(pybullet: Any, client: int, body: int, point: list[float]) -> list[float]:
    """A point of the link frame in the frame of the body's principal axes."""
    info = pybullet.getDynamicsInfo(body, -1, physicsClientId=client)
    position, quat = pybullet.invertTransform(info[3], info[4])
    return pybullet.multiplyTransforms(position, quat, point, [0, 0, 0, 1])[0]


def main() -> None:
    """Load the folder of this file, step for five seconds, print every body's drift."""
    import pybullet  # pyright: ignore[reportMissingImports]

    client = pybullet.connect(pybullet.GUI if "--gui" in sys.argv[1:] else pybullet.DIRECT)
    bodies = load_pybullet(Path(__file__).parent, client)
    start = {name: pybullet.getBasePositionAndOrientation(body, client) for name, body in bodies.items()}
    for _ in range(5000):
        pybullet.stepSimulation(physicsClientId=client)
    for name, body in bodies.items():
        position, quat = pybullet.getBasePositionAndOrientation(body, client)
        moved = 1e3 * math.dist(position, start[name][0])
        alike = min(1.0, abs(sum(a * b for a, b in zip(quat, start[name][1], strict=True))))
        print(f"{name:32s} {moved:8.3f} mm {math.degrees(2.0 * math.acos(alike)):8.3f} degrees")


if __name__ == "__main__":
    main()
