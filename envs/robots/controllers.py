"""Actions to motor torques: operational-space and joint controllers for any arm that is driven by torques.

osc             x'' = kp (x* - x) - kd x', the same for the turn, as torques of the joints: see operational_space
joint_position  torque = M (kp (q* - q) - kd q') + bias
joint_velocity  torque = M kv (q'* - q') + bias

The bias makes up for gravity, for velocities and for springs of the joints. Their friction the drives make up for by
themselves, see `pat3d.envs.robots.assembly`. M has the armature of the joints.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.inertia import inertia_matrix
from pat3d.envs.robots.robot import Robot, finger_targets
from pat3d.errors import EnvironmentSetupError

Array = NDArray[np.float64]

CONTROLS = ("osc", "joint_velocity", "joint_position")

STIFFNESS = {"osc": 150.0, "joint_position": 50.0}
"""kp [1/s^2]; damping is critical."""

SPEED_GAIN = 25.0
"""kv [1/s]."""

LARGEST = {"osc": (0.05, 0.05, 0.05, 0.5, 0.5, 0.5), "joint_velocity": (0.5,), "joint_position": (0.05,)}
"""What an action of 1 asks for: changes of the hand's position [m] and orientation [rad], [rad/s], [rad]."""


class Controller(Protocol):
    """Turns actions in [-1, 1] into controls of one robot: arm first, the gripper's opening last."""

    @property
    def size(self) -> int:
        """Number of values of an action."""
        ...

    def reset(self) -> None:
        """Forget every earlier action; the present joint positions become the posture to keep."""
        ...

    def set_action(self, action: Array) -> None:
        """Take an action, shape (size,), at the start of a control step; positions must be up to date."""
        ...

    def control(self) -> None:
        """Write the torques of this physics step; positions and velocities must be up to date."""
        ...


def make_controller(model: Any, data: Any, robot: Robot, prefix: str, kind: str, control_freq: float) -> Controller:
    """The controller of `kind` for a robot in a world: robosuite's own for its arms, else one of this module.

    Raises:
        EnvironmentSetupError: no such kind; says what there is.
    """
    if kind not in CONTROLS:
        raise EnvironmentSetupError(f'no control "{kind}". Controls: {", ".join(CONTROLS)}.')
    if robot.robosuite is not None:
        from pat3d.envs.robots.robosuite_controllers import RobosuiteController

        return RobosuiteController(model, data, robot, prefix, kind, control_freq)
    return TorqueController(model, data, robot, prefix, kind)


class TorqueController:
    """Actions in [-1, 1] of one robot as torques of its arm and targets of its fingers.

    osc: changes of the hand's position (5 cm) and orientation (0.5 rad, axis-angle) in the frame of the robot's base.
    joint_velocity: joint velocities (0.5 rad/s). joint_position: changes of the joint positions (0.05 rad).
    The last value closes the gripper (positive) or opens it (negative), by a tenth of its range a control step.
    """

    def __init__(self, model: Any, data: Any, robot: Robot, prefix: str, kind: str) -> None:
        self.kind, self._model, self._data, self._robot = kind, model, data, robot
        joints = [model.joint(prefix + name) for name in robot.arm_joints]
        self._positions = np.array([int(joint.qposadr[0]) for joint in joints])
        self._dofs = np.array([int(joint.dofadr[0]) for joint in joints])
        self._actuators = np.array([model.actuator(prefix + name).id for name in robot.arm_actuators])
        self._limits = np.ascontiguousarray(model.actuator_ctrlrange[self._actuators].T)
        self._fingers = np.array([model.actuator(prefix + name).id for name in robot.gripper_actuators], dtype=np.int64)
        count = len(robot.gripper_actuators)
        self._middle = finger_targets(model, robot, np.zeros(count), prefix)
        self._reach = finger_targets(model, robot, np.ones(count), prefix) - self._middle
        self._site, self._base = model.site(prefix + robot.grip_site).id, model.site(prefix + robot.base_site).id
        self._scale = np.broadcast_to(np.array(LARGEST[kind]), 6 if kind == "osc" else len(joints))
        self._bias = np.zeros(model.nv)
        self._inertia = np.zeros((model.nv, model.nv))
        self._operational: Any = None
        if kind == "osc":
            from pat3d.envs.robots.operational_space import OperationalSpace

            ids = [joint.id for joint in joints]
            self._operational = OperationalSpace(
                model, data, ids, self._site, self._actuators, self._limits, self._bias, uncoupled=False
            )
            self._kp = np.full(6, STIFFNESS["osc"])
            self._kd = 2.0 * np.sqrt(self._kp)
        self.reset()

    @property
    def size(self) -> int:
        """Number of values of an action."""
        return len(self._scale) + 1

    def reset(self) -> None:
        """Forget every earlier action; the present joint positions become the posture to keep."""
        self._drive = self._robot.new_drive()
        self._posture = self._data.qpos[self._positions].copy()
        self._aim(np.zeros(len(self._scale)))

    def set_action(self, action: Array) -> None:
        """Take an action, shape (size,), at the start of a control step; positions must be up to date."""
        self._aim(action[:-1] * self._scale)
        targets = np.asarray(self._drive.format_action(action[-1:]), dtype=np.float64)
        self._data.ctrl[self._fingers] = self._middle + self._reach * targets

    def _aim(self, change: Array) -> None:
        data = self._data
        if self.kind == "osc":
            base = data.site_xmat[self._base].reshape(3, 3)
            turn = base @ rotation_by(change[3:]) @ base.T
            self._goal = data.site_xpos[self._site] + base @ change[:3]
            self._goal_rotation = np.ascontiguousarray(turn @ data.site_xmat[self._site].reshape(3, 3))
        elif self.kind == "joint_position":
            self._goal = data.qpos[self._positions] + change
        else:
            self._goal = change.copy()

    def control(self) -> None:
        """Write the torques of this physics step; positions and velocities must be up to date."""
        data = self._data
        np.subtract(data.qfrc_bias, data.qfrc_passive, out=self._bias)
        if self.kind == "osc":
            self._operational.apply(self._goal, self._goal_rotation, self._kp, self._kd, self._posture)
        else:
            self._follow()

    def _follow(self) -> None:
        """Torques towards positions or velocities of the joints."""
        data = self._data
        speed = data.qvel[self._dofs]
        if self.kind == "joint_position":
            kp = STIFFNESS["joint_position"]
            wanted = kp * (self._goal - data.qpos[self._positions]) - 2.0 * math.sqrt(kp) * speed
        else:
            wanted = SPEED_GAIN * (self._goal - speed)
        self._write(self._mass() @ wanted + self._bias[self._dofs])

    def _mass(self) -> Array:
        inertia_matrix(self._model, self._data, self._inertia)
        return self._inertia[np.ix_(self._dofs, self._dofs)]

    def _write(self, torques: Array) -> None:
        self._data.ctrl[self._actuators] = np.minimum(np.maximum(torques, self._limits[0]), self._limits[1])


class SeveralArms:
    """Several arms of one world; an action is theirs one after the other."""

    def __init__(self, arms: Sequence[Controller]) -> None:
        self._arms = tuple(arms)
        self._ends = np.cumsum([0, *(arm.size for arm in arms)]).tolist()

    @property
    def size(self) -> int:
        """Number of values of an action."""
        return int(self._ends[-1])

    def reset(self) -> None:
        """See Controller."""
        for arm in self._arms:
            arm.reset()

    def set_action(self, action: Array) -> None:
        """See Controller."""
        for number, arm in enumerate(self._arms):
            arm.set_action(action[self._ends[number] : self._ends[number + 1]])

    def control(self) -> None:
        """See Controller."""
        for arm in self._arms:
            arm.control()


def rotation_by(turn: Array) -> Array:
    """The matrix of a rotation vector [rad], shape (3, 3) (Rodrigues)."""
    x, y, z = turn
    angle = math.sqrt(x * x + y * y + z * z)
    if angle < 1e-12:
        return np.eye(3)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]) / angle
    return np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
