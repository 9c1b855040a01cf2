"""The settling stage: a scene laid out becomes a scene at rest."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.progress import Event, Progress, silent
from pat3d.scene.folder import write_pictures, write_trajectory
from pat3d.scene.model import Scene


@dataclass(frozen=True, kw_only=True, eq=False)
class SettledScene:
    """A scene at rest, or as near to it as settling came."""

    poses: tuple[Pose, ...]
    """Of every object, in the order of the scene."""
    states: NDArray[np.float32]
    """Centre of mass [m] and columns of the linear map in every frame, the rest last, shape (frames, objects, 4, 3)."""
    centres: NDArray[np.float64]
    """Centres of mass in the frames of the assets [m], shape (objects, 3)."""
    record: Mapping[str, Any]
    """at_rest, status, unconverged_steps, residual, frames, polish_steps, newton_iterations, time_step."""
    optimisation: Mapping[str, Any] | None = None
    """Of the layout that settled, where there was one; JSON-serialisable."""
    pictures: Mapping[str, bytes] = field(default_factory=dict)
    """PNG files about the optimisation, by name."""

    @property
    def at_rest(self) -> bool:
        """Whether the simulator met its tolerances."""
        return bool(self.record["at_rest"])

    def write(self, names: tuple[str, ...], folder: Path) -> None:
        """Write the settling motion of the objects `names`, and the pictures, into a scene folder."""
        write_trajectory(folder / "trajectory.npz", names, self.states, self.centres, self.record["time_step"])
        write_pictures(self.pictures, folder)

    def of(self, scene: Scene) -> Scene:
        """`scene` with its objects at these poses."""
        objects = tuple(replace(obj, pose=pose) for obj, pose in zip(scene.objects, self.poses, strict=True))
        return replace(scene, objects=objects)


def settle_scene(
    scene: Scene, *, device: str = "cpu", progress: Progress = silent, near_rest: bool = False
) -> SettledScene:
    """Settle `scene` from its initial poses with its settling friction, on Warp's `device`.

    Args:
        scene: laid out.
        device: Warp's name of it.
        progress: told of every step.
        near_rest: whether everything already touches as at rest, see `pat3d.sim.settling.settle`.

    Raises:
        SimulationError: objects intersect at the start, the state degenerates.
    """
    return settle_scenes([scene], device=device, progress=progress, near_rest=near_rest)[0]


def settle_scenes(
    scenes: Sequence[Scene], *, device: str = "cpu", progress: Progress = silent, near_rest: bool = False
) -> tuple[SettledScene, ...]:
    """Settle scenes side by side, a world each; frames, steps and iterations of the records are the whole batch's.

    Raises:
        SimulationError: as `settle_scene`, of any of the scenes; or they ask for different settling friction.
    """
    from pat3d.sim.model import ModelBuilder, poses_from_states
    from pat3d.sim.run import SettleOptions
    from pat3d.sim.settling import settle

    if len({scene.settling_friction for scene in scenes}) != 1:
        raise SimulationError("scenes that settle together need one settling friction.")
    builder = ModelBuilder()
    for scene in scenes:
        builder.new_world()
        builder.add_scene(scene)
    model = builder.finalize(device)
    options = SettleOptions(friction=scenes[0].settling_friction)

    runs = []

    def places() -> Mapping[str, Pose]:
        return dict(zip(model.labels, poses_from_states(model, runs[-1].state()), strict=True))

    def tell(phase: str, step: int, motion: float) -> None:
        # Scenes side by side may have objects of the same name.
        progress(Event(stage=phase, step=step, motion=motion, places=places if len(scenes) == 1 else None))

    progress(Event(stage="settling", step=0))
    found = settle(model, options, tell, throw=False, near_rest=near_rest, watch=runs.append)
    poses = poses_from_states(model, found.q)
    states = np.concatenate([found.trajectory, found.q[None].astype(np.float32)])
    settled = []
    for world, scene in enumerate(scenes):
        bodies = slice(first := sum(len(one.objects) for one in scenes[:world]), first + len(scene.objects))
        settled.append(
            SettledScene(
                poses=tuple(
                    obj.initial_pose if obj.fixed else pose
                    for obj, pose in zip(scene.objects, poses[bodies], strict=True)
                ),
                states=states[:, bodies],
                centres=model.centres[bodies],
                record={
                    "at_rest": bool(found.at_rest[world]),
                    "status": found.status[world].value,
                    "unconverged_steps": int(found.unconverged[world]),
                    "residual": float(found.residual[world]),
                    "frames": found.frames,
                    "polish_steps": found.polish_steps,
                    "newton_iterations": found.newton_iterations,
                    "time_step": options.time_step,
                },
            )
        )
    return tuple(settled)
