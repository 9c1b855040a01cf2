"""Whether the robot's hand gets somewhere: inverse kinematics by damped least squares, within the joint limits."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.robots.inertia import inertia_matrix
from pat3d.envs.robots.robot import Robot

Array = NDArray[np.float64]

POSITION_TOLERANCE = 2e-3
"""[m]"""

ANGLE_TOLERANCE = 0.02
"""[rad]"""

POSTURE_TOLERANCE = 0.02
"""Of a joint that is drawn to a posture, in an iteration [rad]."""

_ITERATIONS = 60
_DAMPING = 1e-3
_ROUNDING = 1e-9
_LARGEST_STEP = 0.4
"""Of any joint in one iteration [rad]."""

_LIMIT_MARGIN = 0.02
"""Kept from the joint limits [rad]."""


class ArmKinematics:
    """The arm of one robot alone, with its base at the origin facing +x.

    Args:
        robot: whose arm it is.
        model: of the robot alone.
    """

    def __init__(self, robot: Robot, model: Any) -> None:
        import mujoco

        self._mujoco = mujoco
        self.robot, self._model = robot, model
        self._data = self._mujoco.MjData(self._model)
        joints = [self._model.joint(joint) for joint in self.robot.arm_joints]
        self._joints = np.array([joint.id for joint in joints])
        self._positions = np.array([int(joint.qposadr[0]) for joint in joints])
        self._dofs = np.array([int(joint.dofadr[0]) for joint in joints])
        limits = np.array([joint.range for joint in joints])
        self._low, self._high = limits[:, 0] + _LIMIT_MARGIN, limits[:, 1] - _LIMIT_MARGIN
        self._site = self._model.site(self.robot.grip_site).id
        self._jacobian = np.zeros((6, self._model.nv))
        self._inertia = np.zeros((self._model.nv, self._model.nv))

    def hand(self, joints: Array) -> tuple[Array, Array]:
        """Position [m] and rotation matrix of the grip site for joint positions [rad]."""
        self._data.qpos[self._positions] = joints
        self._mujoco.mj_kinematics(self._model, self._data)
        return self._data.site_xpos[self._site].copy(), self._data.site_xmat[self._site].reshape(3, 3).copy()

    @property
    def limits(self) -> tuple[Array, Array]:
        """Least and largest joint positions [rad] that are used, shape (joints,) each."""
        return self._low, self._high

    @property
    def length(self) -> float:
        """Of the stretched arm from its second joint to the grip site, the links' lengths added up [m]."""
        self.hand(self.robot.home)
        points = [*self._data.xanchor[self._joints[1:]], self._data.site_xpos[self._site]]
        return float(sum(np.linalg.norm(b - a) for a, b in zip(points, points[1:], strict=False)))

    def jacobian(self, joints: Array) -> Array:
        """Of the grip site's velocity and turn, shape (6, joints)."""
        self.hand(joints)
        self._mujoco.mj_comPos(self._model, self._data)
        j = self._jacobian
        self._mujoco.mj_jacSite(self._model, self._data, j[:3], j[3:], self._site)
        return j[:, self._dofs].copy()

    def heights(self, joints: Array) -> Array:
        """Of the arm's joints above the base, from the third on [m]."""
        self.hand(joints)
        return self._data.xanchor[self._joints[2:], 2].copy()

    def touches_itself(self, joints: Array) -> bool:
        """Whether links of the arm are in one another."""
        self.hand(joints)
        self._mujoco.mj_collision(self._model, self._data)
        return bool((self._data.contact.dist < -1e-3).any())

    def margin(self, joints: Array) -> float:
        """Least distance of a joint from its limits [rad]."""
        return float(np.minimum(joints - self._low, self._high - joints).min()) + _LIMIT_MARGIN

    def solve(
        self, position: Array, rotation: Array, start: Array | None = None, posture: Array | None = None
    ) -> Array | None:
        """Joint positions [rad] that bring the grip site to `position` [m] and `rotation`; None where none are found.

        Args:
            position: in the frame of the base, shape (3,).
            rotation: columns are the axes of the grip site in the frame of the base, shape (3, 3).
            start: where to begin; the robot's home posture by default.
            posture: joint positions to which the arm is drawn as far as that does not move the hand, as its controller
                does; by default it is not.
        """
        joints, drift = np.clip(self.robot.home if start is None else start, self._low, self._high), np.inf
        model, data, jacobian = self._model, self._data, self._jacobian
        for _ in range(_ITERATIONS):
            at, turned = self.hand(joints)
            error = np.concatenate([position - at, _rotation_vector(rotation @ turned.T)])
            there = np.linalg.norm(error[:3]) < POSITION_TOLERANCE and np.linalg.norm(error[3:]) < ANGLE_TOLERANCE
            if there and (posture is None or drift < POSTURE_TOLERANCE):
                return joints
            self._mujoco.mj_comPos(model, data)
            self._mujoco.mj_jacSite(model, data, jacobian[:3], jacobian[3:], self._site)
            j = jacobian[:, self._dofs]
            # Joints at a limit that the step would violate stay there, and the others make up for them.
            free = np.ones(len(joints), dtype=bool)
            for _ in range(3):
                active = j * free
                square = active @ active.T
                step = active.T @ np.linalg.solve(square + _DAMPING * np.eye(6), error)
                if posture is not None:
                    # Undamped, as it would move the hand otherwise; what is heavy to move stays, as under torques.
                    drawn = free * (posture - joints)
                    light = self._inverse_inertia() * free * free[:, None] @ j.T
                    drawn -= light @ np.linalg.solve(j @ light + _ROUNDING * np.eye(6), j @ drawn)
                    step, drift = step + drawn, float(np.abs(drawn).max())
                blocked = ((joints <= self._low) & (step < 0)) | ((joints >= self._high) & (step > 0))
                if not (blocked & free).any():
                    break
                free &= ~blocked
            step *= min(1.0, _LARGEST_STEP / max(float(np.abs(step).max()), 1e-12))
            joints = np.clip(joints + step, self._low, self._high)
        return None

    def _inverse_inertia(self) -> Array:
        """Of the arm in the present posture [1/(kg m^2)], shape (joints, joints)."""
        self._mujoco.mj_makeM(self._model, self._data)
        inertia_matrix(self._model, self._data, self._inertia)
        return np.asarray(np.linalg.inv(self._inertia[np.ix_(self._dofs, self._dofs)]), dtype=np.float64)


class PlacedArm:
    """The arm of one robot where it stands in a world.

    Args:
        arm: alone.
        position: of its base [m], shape (3,).
        yaw: direction in which it faces [rad].
    """

    def __init__(self, arm: ArmKinematics, position: Sequence[float], yaw: float) -> None:
        self._arm, self._origin = arm, np.array(position)
        c, s = np.cos(yaw), np.sin(yaw)
        self._base = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def hand(self, joints: Array) -> tuple[Array, Array]:
        """Position [m] and rotation matrix of the grip site in the world for joint positions [rad]."""
        at, turned = self._arm.hand(joints)
        return self._origin + self._base @ at, self._base @ turned

    def margin(self, joints: Array) -> float:
        """Least distance of a joint from its limits [rad]."""
        return self._arm.margin(joints)

    def solve(self, position: Array, rotation: Array, start: Array, posture: Array | None = None) -> Array | None:
        """Joint positions [rad] that bring the grip site to a pose of the world; None where none are found.

        Args:
            position: [m], shape (3,).
            rotation: shape (3, 3).
            start: joint positions where to begin.
            posture: see ArmKinematics.
        """
        return self._arm.solve(self._base.T @ (position - self._origin), self._base.T @ rotation, start, posture)


def _rotation_vector(rotation: Array) -> Array:
    """Axis times angle [rad] of a rotation matrix, shape (3,)."""
    axis = 0.5 * np.array(
        [
            rotation[2, 1] - rotation[1, 2],
            rotation[0, 2] - rotation[2, 0],
            rotation[1, 0] - rotation[0, 1],
        ]
    )
    sine, cosine = float(np.linalg.norm(axis)), float((np.trace(rotation) - 1.0) / 2.0)
    angle = float(np.arctan2(sine, cosine))
    if sine > 1e-9:
        return axis * (angle / sine)
    if cosine > 0:
        return axis
    # Half a turn: any axis that the rotation keeps.
    symmetric = (rotation + np.eye(3)) / 2.0
    column = symmetric[:, int(np.argmax(np.diag(symmetric)))]
    return np.pi * column / np.linalg.norm(column)
