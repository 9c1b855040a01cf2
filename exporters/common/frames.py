"""Frames and numbers of the XML formats: exact decimals, principal axes of inertia, roll-pitch-yaw angles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray


def text(*values: float | Iterable[float]) -> str:
    """Numbers as an attribute, each in the shortest form that reads back exactly."""
    return " ".join(repr(float(value)) for value in values)  # type: ignore[arg-type]


def principal_axes(inertia: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Principal moments [kg m^2], shape (3,), and the rotation whose columns are their axes, shape (3, 3).

    Of the 24 orders and signs that make a rotation, the one nearest to the identity: its pitch is far from the
    90 degrees at which roll and yaw cannot be told apart.
    """
    moments, axes = np.linalg.eigh(np.asarray(inertia, dtype=np.float64))
    candidates = [(list(order), _rotation_from(axes[:, list(order)])) for order in itertools.permutations(range(3))]
    order, rotation = max(candidates, key=lambda candidate: round(float(np.trace(candidate[1])), 9))
    return moments[order], rotation


def _rotation_from(axes: NDArray[np.float64]) -> NDArray[np.float64]:
    """`axes` with the signs of the columns that make it a rotation of the smallest angle."""
    signs = np.where(np.diag(axes) < 0, -1.0, 1.0)
    if np.linalg.det(axes) * signs.prod() < 0:
        signs[int(np.argmin(np.abs(np.diag(axes))))] *= -1
    return axes * signs


def rpy_of(rotation: NDArray[np.float64]) -> tuple[float, float, float]:
    """Roll, pitch and yaw [rad] about the fixed x, y and z axes: R = Rz(yaw) Ry(pitch) Rx(roll).

    The roll is taken from what is left after the yaw, so that the three together are exact even where the pitch
    is near 90 degrees and the yaw alone is mostly rounding.
    """
    r = np.asarray(rotation, dtype=np.float64)
    pitch = math.atan2(-r[2, 0], math.hypot(r[0, 0], r[1, 0]))
    yaw = math.atan2(r[1, 0], r[0, 0])
    cosine, sine = math.cos(yaw), math.sin(yaw)
    roll = math.atan2(sine * r[0, 2] - cosine * r[1, 2], cosine * r[1, 1] - sine * r[0, 1])
    return roll, pitch, yaw


def rotation_of(roll: float, pitch: float, yaw: float) -> NDArray[np.float64]:
    """The rotation matrix of roll, pitch and yaw [rad] about the fixed axes, shape (3, 3)."""
    cr, sr, cp, sp, cy, sy = (f(angle) for angle in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )
