"""Rotations: matrices, quaternions (scalar first) and rotation vectors, and the turns that the layout makes."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Quat = tuple[float, float, float, float]
"""Unit quaternion w, x, y, z: MuJoCo's order."""


def quat_of(rotation: Array) -> Quat:
    """The quaternion of a rotation matrix, shape (3, 3)."""
    from scipy.spatial.transform import Rotation

    w, x, y, z = Rotation.from_matrix(rotation).as_quat(scalar_first=True).tolist()
    return w, x, y, z


def matrix_of(quat_wxyz: Iterable[float]) -> Array:
    """The rotation matrix, shape (3, 3), of a unit quaternion."""
    w, x, y, z = (float(value) for value in quat_wxyz)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def yaw_quat(yaw: float) -> Quat:
    """The quaternion of a turn about z by `yaw` [rad]."""
    return math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)


def yaw_matrix(yaw: float) -> Array:
    """Rotation about z by `yaw` [rad], shape (3, 3)."""
    c, s = np.cos(yaw), np.sin(yaw)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def yaw_of(rotation: Array) -> float:
    """The angle [rad] by which a rotation matrix turns the x axis about z."""
    return math.atan2(rotation[1, 0], rotation[0, 0])


def about(axis: str, angle: float) -> Array:
    """Rotation about a coordinate axis, "x", "y" or "z", by `angle` [rad], shape (3, 3)."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler(axis, angle).as_matrix()


def turn(axis: Array, angle: float) -> Array:
    """Rotation by `angle` [rad] about the direction `axis`, shape (3, 3); the identity for an axis of no length."""
    from scipy.spatial.transform import Rotation

    length = float(np.linalg.norm(axis))
    return np.eye(3) if length < 1e-12 else Rotation.from_rotvec(axis / length * angle).as_matrix()


def rotation_vector(rotation: Array) -> Array:
    """Axis times angle [rad] of a rotation matrix, shape (3,)."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(rotation).as_rotvec()


def principal_frame(inertia: Array) -> tuple[Array, Quat]:
    """Principal moments [kg m^2] in rising order, shape (3,), and the quaternion of their right-handed axes."""
    moments, axes = np.linalg.eigh(np.array(inertia))
    if np.linalg.det(axes) < 0:
        axes[:, 0] *= -1
    return moments, quat_of(axes)


def frame_along(direction: Array) -> Array:
    """A rotation, shape (3, 3), whose z axis is the unit vector `direction`."""
    helper = np.array([1.0, 0.0, 0.0]) if abs(direction[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    side = np.cross(direction, helper)
    side /= np.linalg.norm(side)
    return np.column_stack([np.cross(side, direction), side, direction])
