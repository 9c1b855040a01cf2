"""The camera of a photograph: a pinhole, and where it stands.

Camera axes are those of photographs: x to the right of the picture, y down, z forward. Pixel coordinates run from the
picture's upper left corner, so that the first pixel's centre is at (0.5, 0.5). Depth is measured along z, range along
the ray.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pat3d.errors import SpecError
from pat3d.view.camera import Camera

Array = NDArray[np.float64]

USUAL_ANGLE = 55.0
"""Opening angle across the longer side of a photograph whose camera nobody knows [deg]: a telephone's main camera."""


@dataclass(frozen=True, kw_only=True)
class Pinhole:
    """Intrinsics: how pixels and rays belong together."""

    width: int
    """[pixel], like all that follows."""
    height: int
    fx: float
    fy: float
    cx: float
    cy: float

    def __post_init__(self) -> None:
        numbers = (self.fx, self.fy, self.cx, self.cy)
        if not (self.width >= 8 and self.height >= 8 and all(map(math.isfinite, numbers))):
            raise SpecError(f"a camera needs a picture of 8 pixels or more and finite numbers, got {self}.")
        longest = max(self.width, self.height)
        if not (0.2 * longest <= min(self.fx, self.fy) and max(self.fx, self.fy) <= 50.0 * longest):
            raise SpecError(
                f"focal lengths of {self.fx:g} and {self.fy:g} pixels do not fit a picture of {self.width} x "
                f"{self.height}; from 0.2 to 50 times its longer side are taken."
            )

    @staticmethod
    def of_angle(width: int, height: int, degrees: float = USUAL_ANGLE) -> Pinhole:
        """A camera with square pixels that sees `degrees` across the longer side of its picture."""
        if not 1.0 <= degrees <= 130.0:
            raise SpecError(f"a camera's opening angle is 1 to 130 degrees, got {degrees:g}.")
        focal = max(width, height) / (2.0 * math.tan(math.radians(degrees) / 2.0))
        return Pinhole(width=width, height=height, fx=focal, fy=focal, cx=width / 2.0, cy=height / 2.0)

    def resized(self, width: int, height: int) -> Pinhole:
        """The same camera with a picture of other pixels."""
        x, y = width / self.width, height / self.height
        return Pinhole(width=width, height=height, fx=self.fx * x, fy=self.fy * y, cx=self.cx * x, cy=self.cy * y)

    def slopes(self, x: ArrayLike, y: ArrayLike) -> Array:
        """Points on the plane z = 1 through picture points [pixel], shapes (n,); shape (n, 3)."""
        x, y = np.asarray(x, dtype=np.float64), np.asarray(y, dtype=np.float64)
        return np.stack([(x - self.cx) / self.fx, (y - self.cy) / self.fy, np.ones_like(x)], axis=-1)

    def project(self, points: ArrayLike) -> Array:
        """Picture positions [pixel] of points [m] in camera axes, shape (n, 3) -> (n, 2)."""
        x, y, z = np.moveaxis(np.asarray(points, dtype=np.float64), -1, 0)
        return np.stack([self.cx + self.fx * x / z, self.cy + self.fy * y / z], axis=-1)


@dataclass(frozen=True, kw_only=True, eq=False)
class PlacedCamera:
    """A pinhole in the world."""

    pinhole: Pinhole
    rotation: Array
    """Columns: the camera's x, y and z in the world, shape (3, 3)."""
    position: Array
    """[m], shape (3,)."""

    def __post_init__(self) -> None:
        turned = np.asarray(self.rotation, dtype=np.float64)
        if turned.shape != (3, 3) or not np.allclose(turned.T @ turned, np.eye(3), atol=1e-6):
            raise SpecError("a camera's rotation must be a rotation matrix, shape (3, 3).")
        if np.linalg.det(turned) < 0 or not np.all(np.isfinite(self.position)):
            raise SpecError("a camera's axes must be right-handed and its position finite.")

    def rays(self, x: ArrayLike, y: ArrayLike) -> tuple[Array, Array]:
        """Rays through picture points [pixel], shapes (n,).

        Returns:
            Unit directions in the world, shape (n, 3), and range over depth, shape (n,).
        """
        slopes = self.pinhole.slopes(x, y)
        reach = np.linalg.norm(slopes, axis=-1)
        return (slopes / reach[..., None]) @ self.rotation.T, reach

    def project(self, points: ArrayLike) -> tuple[Array, Array]:
        """Picture positions [pixel], shape (n, 2), and depths [m], shape (n,), of world points, shape (n, 3)."""
        local = (np.asarray(points, dtype=np.float64) - self.position) @ self.rotation
        return self.pinhole.project(local), local[..., 2]


class DrawnCamera(Camera):
    """The camera of a photograph as the renderer takes it: it may be rolled, and its middle off the picture's."""

    def __init__(self, placed: PlacedCamera) -> None:
        """`placed` has square pixels; the renderer knows no others."""
        pinhole, position = placed.pinhole, placed.position
        ahead = position + placed.rotation[:, 2]
        super().__init__(
            position=(float(position[0]), float(position[1]), float(position[2])),
            target=(float(ahead[0]), float(ahead[1]), float(ahead[2])),
            field_of_view=math.degrees(2.0 * math.atan(pinhole.height / (2.0 * pinhole.fy))),
        )
        object.__setattr__(self, "placed", placed)

    placed: PlacedCamera

    @property
    def axes(self) -> Array:
        """Rows: right, up and forward in the world, shape (3, 3)."""
        return self.placed.rotation.T * np.array([[1.0], [-1.0], [1.0]])

    def directions(self, x: ArrayLike, y: ArrayLike, width: int, height: int) -> NDArray[np.float32]:
        """Unit view directions; as for `Camera`."""
        pinhole = self.placed.pinhole
        across, down = np.asarray(x) * (pinhole.width / width), np.asarray(y) * (pinhole.height / height)
        return self.placed.rays(across, down)[0].astype(np.float32)
