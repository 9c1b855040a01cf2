"""Load a URDF export of PAT3D into Drake, as still as it was settled. Copy this file freely; it needs Drake only.

    from pydrake.multibody.plant import AddMultibodyPlant
    from pydrake.systems.framework import DiagramBuilder
    from load_drake import load_drake, plant_config

    builder = DiagramBuilder()
    plant, scene_graph = AddMultibodyPlant(plant_config(), builder)
    load_drake("exports/desk/urdf", plant)
    plant.Finalize()

Run as a script it loads the folder it lies in, simulates five seconds and says how far everything moved.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

PACKAGE = "pat3d_scene"


def plant_config(time_step: float = 0.0005) -> Any:
    """Settings that hold a scene still: hydroelastic contact and SAP, which knows ball constraints.

    Triangles give a patch several contact points where polygons give it one, on which a fruit in a basket rolls. At
    two milliseconds a step what leans in a cup slides by centimetres.
    """
    from pydrake.multibody.plant import MultibodyPlantConfig  # pyright: ignore[reportMissingImports]

    return MultibodyPlantConfig(
        time_step=time_step,
        contact_model="hydroelastic_with_fallback",
        contact_surface_representation="triangle",
        discrete_contact_approximation="sap",
    )


def load_drake(folder: str | Path, plant: Any) -> dict[str, Any]:
    """Add scene.dmd.yaml and the attachments to `plant`, which must not be finalized yet.

    Returns:
        Drake's body of every object by its name.
    """
    from pydrake.multibody.parsing import Parser  # pyright: ignore[reportMissingImports]

    folder = Path(folder)
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    if manifest.get("format") != "pat3d-urdf":
        raise ValueError(f"{folder / 'manifest.json'} is not the manifest of a URDF export of PAT3D.")
    parser = Parser(plant)
    parser.package_map().Add(PACKAGE, str(folder.resolve()))
    parser.AddModels(str(folder / "scene.dmd.yaml"))
    bodies = {
        entry["name"]: plant.GetBodyByName(entry["link"], plant.GetModelInstanceByName(entry["name"]))
        for entry in manifest["objects"]
    }
    for attachment in manifest["attachments"]:
        child, parent = bodies[attachment["child"]], bodies[attachment["parent"]]
        for anchor in attachment["anchors"]:
            plant.AddBallConstraint(parent, anchor["parent_point"], child, anchor["child_point"])
    return bodies


def main() -> None:
    """Load the folder of this file, simulate five seconds, print every body's drift."""
    import numpy as np
    from pydrake.multibody.plant import AddMultibodyPlant  # pyright: ignore[reportMissingImports]
    from pydrake.systems.analysis import Simulator  # pyright: ignore[reportMissingImports]
    from pydrake.systems.framework import DiagramBuilder  # pyright: ignore[reportMissingImports]

    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlant(plant_config(), builder)
    bodies = load_drake(Path(__file__).parent, plant)
    plant.Finalize()
    simulator = Simulator(builder.Build())
    context = plant.GetMyContextFromRoot(simulator.get_context())
    start = {name: plant.EvalBodyPoseInWorld(context, body) for name, body in bodies.items()}
    simulator.AdvanceTo(5.0)
    for name, body in bodies.items():
        moved = start[name].inverse() @ plant.EvalBodyPoseInWorld(context, body)
        degrees = np.degrees(moved.rotation().ToAngleAxis().angle())
        print(f"{name:32s} {1e3 * np.linalg.norm(moved.translation()):8.3f} mm {degrees:8.3f} degrees")


if __name__ == "__main__":
    main()
