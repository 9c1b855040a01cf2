"""Poses: rigid transforms of a position and a unit quaternion."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import SpecError
from pat3d.geometry.rotations import matrix_of, quat_of, yaw_quat


@dataclass(frozen=True, kw_only=True)
class Pose:
    """A rigid placement: x_world = R(quat_wxyz) x_local + position."""

    position: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """[m]"""
    quat_wxyz: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    """Unit quaternion, scalar first."""

    def __post_init__(self) -> None:
        position = tuple(float(value) for value in self.position)
        quat = tuple(float(value) for value in self.quat_wxyz)
        if len(position) != 3 or len(quat) != 4 or not all(map(math.isfinite, position + quat)):
            raise SpecError(f"a pose needs 3 finite positions and 4 finite quaternion values, got {position}, {quat}.")
        norm = math.sqrt(sum(value * value for value in quat))
        if abs(norm - 1.0) > 1e-6:
            raise SpecError(f"quat_wxyz {quat} has norm {norm:.6g}; a rotation needs norm 1.")
        object.__setattr__(self, "position", position)
        object.__setattr__(
            self, "quat_wxyz", tuple(value / norm for value in quat) if abs(norm - 1.0) > 1e-15 else quat
        )

    @staticmethod
    def from_matrix(rotation: NDArray[np.float64], position: NDArray[np.float64]) -> Pose:
        """The pose with rotation matrix `rotation`, shape (3, 3), and `position` [m], shape (3,)."""
        x, y, z = map(float, position)
        return Pose(position=(x, y, z), quat_wxyz=quat_of(rotation))

    @staticmethod
    def from_affine(linear: NDArray[np.float64], there: NDArray[np.float64], centre: NDArray[np.float64]) -> Pose:
        """The pose with the rotation nearest to `linear`, shape (3, 3), that takes `centre` to `there` [m]."""
        left, _, right = np.linalg.svd(linear)
        rotation = left @ np.diag([1.0, 1.0, np.linalg.det(left @ right)]) @ right
        return Pose.from_matrix(rotation, there - rotation @ centre)

    @staticmethod
    def from_yaw(yaw: float, position: tuple[float, float, float]) -> Pose:
        """The pose turned by `yaw` [rad] about the vertical through its origin."""
        return Pose(position=position, quat_wxyz=yaw_quat(yaw))

    @property
    def rotation(self) -> NDArray[np.float64]:
        """Rotation matrix, shape (3, 3)."""
        return matrix_of(self.quat_wxyz)

    def apply(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Local points [m], shape (n, 3), in the world frame."""
        return np.asarray(points, dtype=np.float64) @ self.rotation.T + np.array(self.position)
