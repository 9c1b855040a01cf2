"""What a robot would touch in a posture: MuJoCo's own collision detection on a copy of the present state."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.physics.world import FLOOR, ROBOT, SUPPORT
from pat3d.scene.model import GROUND

Array = NDArray[np.float64]

DEPTH = 0.002
"""Overlaps up to this [m] count as none: inverse kinematics is as exact."""

OTHER = -4
"""Owner of the geoms of an arm that has nothing to do for the task: in the way like anything else."""

BETWEEN_ARMS = 0.005
"""Two arms keep this from one another [m]: they come by other ways than through the postures that are looked at."""

NOTICED = 0.008
"""Things further apart than this [m] are clear of one another."""


class Clearance:
    """Asks about postures of the arm of one environment, among its objects as they are now.

    Args:
        env: a TabletopEnv after its reset.
    """

    def __init__(self, env: Any) -> None:
        import mujoco

        self._mujoco = mujoco
        self._simulation, self._world = env.simulation, env.simulation.world
        self._model = self._world.model
        self._data = self._mujoco.MjData(self._model)
        robot = self._world.robot
        self._arm = self._addresses(robot.arm_joints)
        self._fingers = self._addresses(robot.gripper_joints)
        self._numbers = {obj.name: number for number, obj in enumerate(self._world.scene.objects)}
        self._names = {number: name for name, number in self._numbers.items()} | {SUPPORT: GROUND, FLOOR: GROUND}
        self._names[OTHER] = "the other arm"
        self._owner = np.where(self._world.idle, OTHER, self._world.owner)

    def _addresses(self, joints: tuple[str, ...]) -> NDArray[np.int64]:
        return np.array(
            [int(self._model.joint(self._world.prefix + name).qposadr[0]) for name in joints], dtype=np.int64
        )

    def obstacle(self, joints: Array, fingers: Array, carried: str = "", shift: Array | None = None) -> str:
        """Name of what the robot, or what it carries, would be in; nothing where it is free.

        Args:
            joints: of the arm [rad].
            fingers: joint positions of the gripper.
            carried: an object that the robot may be in; none by default.
            shift: by which `carried` is moved from where it is [m], shape (3,); without one, the robot alone counts.
        """
        number = self._numbers.get(carried, ROBOT)
        owners = self._overlaps(carried, shift, joints, fingers)
        moved = (owners == ROBOT) | (owners == number if shift is not None else False)
        # Of the two one moves along, and the other is none of the robot's.
        own = (owners == ROBOT) | (owners == number)
        met = owners[moved.any(axis=1) & ~own.all(axis=1)]
        return "" if not len(met) else self._names[int(next(one for one in met[0] if one not in (ROBOT, number)))]

    def met(self, postures: Mapping[str, tuple[Array, Array]], carried: str) -> str:
        """Name of what two arms would be in, but for an object that they may touch; nothing where they are free.

        Args:
            postures: joint positions of an arm and of its gripper, by its side; other arms stay where they are.
            carried: the object.
        """
        data, model = self._data, self._model
        data.qpos[:] = self._simulation.data.qpos
        for side, (joints, fingers) in postures.items():
            arm = self._world.arm(side)
            for names, values in ((arm.robot.arm_joints, joints), (arm.robot.gripper_joints, fingers)):
                data.qpos[[int(model.joint(arm.prefix + name).qposadr[0]) for name in names]] = values
        self._mujoco.mj_kinematics(model, data)
        self._mujoco.mj_collision(model, data)
        if self._nearest(self._owner == OTHER, BETWEEN_ARMS) < BETWEEN_ARMS:
            return "the other arm"
        owners = self._owner[data.contact.geom[data.contact.dist < -DEPTH]]
        arms = (owners == ROBOT) | (owners == OTHER)
        number = self._numbers[carried]
        met = owners[arms.any(axis=1) & ~arms.all(axis=1) & (owners != number).all(axis=1)]
        return "" if not len(met) else self._names[int(next(one for one in met[0] if one not in (ROBOT, OTHER)))]

    def fits(self, name: str, shift: Array) -> bool:
        """Whether an object moved by `shift` [m] is in no other and not in the ground, the robot left out."""
        owners = self._overlaps(name, shift)
        return not ((owners == self._numbers[name]).any(axis=1) & (owners != ROBOT).all(axis=1)).any()

    def distance(self, joints: Array, fingers: Array, carried: str = "") -> float:
        """How far the robot would be from all objects but `carried` [m], at most NOTICED; see `obstacle`."""
        self._overlaps(carried, None, joints, fingers)
        others = (self._owner >= 0) | (self._owner == OTHER)
        return self._nearest(others & (self._owner != self._numbers.get(carried, ROBOT)), NOTICED)

    def _nearest(self, others: NDArray[np.bool_], nearest: float) -> float:
        """How far the robot is from other geoms [m], at most `nearest`; the poses are computed already."""
        model, data = self._model, self._data
        collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
        about = np.flatnonzero(collides & others)
        for geom in np.flatnonzero(collides & (self._owner == ROBOT)).tolist():
            reach = model.geom_rbound[geom] + model.geom_rbound[about] + nearest
            near = np.linalg.norm(data.geom_xpos[about] - data.geom_xpos[geom], axis=1) < reach
            for other in about[near].tolist():
                nearest = min(nearest, self._mujoco.mj_geomDistance(model, data, geom, other, nearest, None))
        return nearest

    def _overlaps(
        self, carried: str, shift: Array | None, joints: Array | None = None, fingers: Array | None = None
    ) -> NDArray[np.int64]:
        """Whose the geoms of every pair are that overlap by more than DEPTH, shape (pairs, 2)."""
        model, data, world = self._model, self._data, self._world
        data.qpos[:] = self._simulation.data.qpos
        if joints is not None:
            data.qpos[self._arm], data.qpos[self._fingers] = joints, fingers
        if shift is not None:
            first = int(world.positions[world.objects.index(carried)])
            data.qpos[first : first + 3] += shift
        self._mujoco.mj_kinematics(model, data)
        self._mujoco.mj_collision(model, data)
        return self._owner[data.contact.geom[data.contact.dist < -DEPTH]]
