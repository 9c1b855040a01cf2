"""What a policy sees: dictionaries of float32 arrays with bounds where there are any, and pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Literal, get_args

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from pat3d.envs.simulation import Simulation
from pat3d.envs.tasks.task import Verdict
from pat3d.envs.world import PREFIX, World
from pat3d.errors import EnvironmentSetupError

Observation = dict[str, NDArray[Any]]

ObsKind = Literal["state", "rgb", "rgbd"]
OBSERVATIONS: tuple[str, ...] = get_args(ObsKind)

JOINT_MARGIN = 0.1
"""Joint limits are soft: positions may pass them by this much [rad], or the fingers by as many metres."""

LARGEST_DEPTH = 100.0
"""[m]"""

FARTHEST = 100.0
"""Positions are within this of the origin along every axis [m]; what flew further is reported there."""

FASTEST = 100.0
"""Joint velocities are reported up to this [rad/s]."""


@dataclass(frozen=True, kw_only=True)
class ObservationSpec:
    """Which observations an environment gives."""

    kind: str
    """state: robot, objects and target. rgb: robot and pictures. rgbd: with depth."""
    cameras: tuple[str, ...]
    height: int
    width: int
    segmentation: bool
    max_objects: int
    """Rows of "objects"; those beyond the scene's moving objects are zero."""

    def __post_init__(self) -> None:
        if self.kind not in OBSERVATIONS:
            raise EnvironmentSetupError(f'no observation "{self.kind}". Observations: {", ".join(OBSERVATIONS)}.')

    def space(self, world: World) -> spaces.Dict:
        """The observation space for a robot; it is the same for every scene."""
        model, robot = world.model, world.robot
        arm = np.array([model.joint(PREFIX + name).range for name in robot.arm_joints])
        fingers = np.array([model.joint(PREFIX + name).range for name in robot.gripper_joints])
        unit = np.ones(4, dtype=np.float32)
        entries: dict[str, spaces.Space[Any]] = {
            "joint_pos": _box(arm[:, 0] - JOINT_MARGIN, arm[:, 1] + JOINT_MARGIN),
            "joint_vel": _box(np.full(len(arm), -FASTEST), np.full(len(arm), FASTEST)),
            "gripper_pos": _box(fingers[:, 0] - JOINT_MARGIN, fingers[:, 1] + JOINT_MARGIN),
            "eef_pos": _box(np.full(3, -FARTHEST), np.full(3, FARTHEST)),
            "eef_quat": _box(-unit, unit),
        }
        if self.kind == "state":
            pose = np.concatenate([np.full(3, FARTHEST), unit])
            rows = np.tile(pose, (self.max_objects, 1))
            entries["objects"] = _box(-rows, rows)
            whole = np.concatenate([pose, np.full(3, FARTHEST)])
            entries["target"] = _box(-whole, whole)
            return spaces.Dict(entries)
        shape = (self.height, self.width)
        for camera in self.cameras:
            entries[f"{camera}_image"] = spaces.Box(0, 255, (*shape, 3), np.uint8)
            if self.kind == "rgbd":
                entries[f"{camera}_depth"] = spaces.Box(0.0, LARGEST_DEPTH, (*shape, 1), np.float32)
            if self.segmentation:
                entries[f"{camera}_segmentation"] = spaces.Box(0, 65535, (*shape, 1), np.uint16)
        return spaces.Dict(entries)


class Observer:
    """Reads observations from one simulation."""

    def __init__(self, spec: ObservationSpec, simulation: Simulation) -> None:
        self._spec, self._simulation = spec, simulation
        world, model = simulation.world, simulation.model
        if len(world.objects) > spec.max_objects:
            raise EnvironmentSetupError(
                f"the scene has {len(world.objects)} moving objects, the observation space {spec.max_objects}; "
                f"make the environment with max_objects={len(world.objects)} or more."
            )
        self._mujoco: Any = import_module("mujoco")
        joints = [model.joint(PREFIX + name) for name in world.robot.arm_joints]
        self._positions = np.array([int(joint.qposadr[0]) for joint in joints])
        self._velocities = np.array([int(joint.dofadr[0]) for joint in joints])
        fingers = [model.joint(PREFIX + name) for name in world.robot.gripper_joints]
        self._fingers = np.array([int(joint.qposadr[0]) for joint in fingers])
        self._bodies = np.array([world.bodies[name] for name in world.objects], dtype=np.int64)

    def observe(self, verdict: Verdict, pictures: Any) -> Observation:
        """The observation of the present state.

        Args:
            verdict: names the target and its goal.
            pictures: a `pat3d.envs.pictures.Pictures`; not used for state observations.
        """
        data, state, spec = self._simulation.data, self._simulation.state, self._spec
        found: dict[str, Any] = {
            "joint_pos": data.qpos[self._positions],
            "joint_vel": data.qvel[self._velocities],
            "gripper_pos": data.qpos[self._fingers],
            "eef_pos": state.hand,
            "eef_quat": self._quat_of(state.hand_rotation),
        }
        observation: Observation = {name: np.asarray(value, dtype=np.float32) for name, value in found.items()}
        np.clip(observation["joint_vel"], -FASTEST, FASTEST, out=observation["joint_vel"])
        if spec.kind == "state":
            objects = np.zeros((spec.max_objects, 7), dtype=np.float32)
            count = len(self._bodies)
            objects[:count, :3], objects[:count, 3:] = data.xpos[self._bodies], data.xquat[self._bodies]
            pose = (state.position(verdict.target), state.quat_wxyz(verdict.target), verdict.goal)
            target = np.concatenate(pose).astype(np.float32)
            observation["objects"] = objects.clip(-FARTHEST, FARTHEST, out=objects)
            observation["target"] = target.clip(-FARTHEST, FARTHEST, out=target)
            return observation
        for camera in spec.cameras:
            picture = pictures.take(
                camera, spec.height, spec.width, depth=spec.kind == "rgbd", segmentation=spec.segmentation
            )
            observation[f"{camera}_image"] = picture.image
            if spec.kind == "rgbd":
                observation[f"{camera}_depth"] = np.clip(picture.depth, 0.0, LARGEST_DEPTH)[..., None]
            if spec.segmentation:
                observation[f"{camera}_segmentation"] = picture.segmentation[..., None]
        return observation

    def _quat_of(self, rotation: NDArray[np.float64]) -> NDArray[np.float64]:
        """Quaternion (wxyz) of a rotation matrix, its largest value positive: it never jumps by a sign alone."""
        quat = np.zeros(4)
        self._mujoco.mju_mat2Quat(quat, rotation.reshape(-1))
        return quat if quat[np.argmax(np.abs(quat))] > 0 else -quat


def object_row(observation: Observation, objects: Sequence[str], name: str) -> NDArray[np.float32]:
    """Position [m] and orientation (wxyz) of object `name` in a state observation, shape (7,)."""
    return observation["objects"][list(objects).index(name)]


def _box(low: Any, high: Any) -> spaces.Box:
    return spaces.Box(np.asarray(low, dtype=np.float32), np.asarray(high, dtype=np.float32), dtype=np.float32)
