"""A pinhole camera and its automatic framing.

The viewer stands at -y and looks along +y, a little from the right and from above, far enough away
that every point is in the picture.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from pat3d.errors import SpecError
from pat3d.view.rays import pinhole_rays

AZIMUTH = 20.0
"""Default direction of the camera [deg], from -y (straight in front) towards +x (the right)."""
ELEVATION = 25.0
"""Default height of the camera above the horizon [deg]."""
FIELD_OF_VIEW = 28.0
"""Default vertical opening angle [deg]: long enough to keep verticals calm."""


@dataclass(frozen=True, kw_only=True)
class Camera:
    """A pinhole camera with square pixels, upright in the picture."""

    position: tuple[float, float, float]
    """[m]"""
    target: tuple[float, float, float]
    """Point in the middle of the picture [m]."""
    field_of_view: float = FIELD_OF_VIEW
    """Vertical opening angle [deg]."""

    def __post_init__(self) -> None:
        if not np.all(np.isfinite([*self.position, *self.target])) or self.position == self.target:
            raise SpecError(f"a camera needs two distinct finite points, got {self.position} and {self.target}.")
        if not 1.0 <= self.field_of_view <= 120.0:
            raise SpecError(f"the camera's field of view must be 1 to 120 degrees, got {self.field_of_view}.")

    @property
    def axes(self) -> NDArray[np.float64]:
        """Rows: right, up and forward in the world frame, shape (3, 3)."""
        forward = np.subtract(self.target, self.position).astype(np.float64)
        forward /= np.linalg.norm(forward)
        right = np.cross(forward, (0.0, 0.0, 1.0))
        # Straight up or down there is no horizon; the picture's right stays +x.
        right = np.array([1.0, 0.0, 0.0]) if np.linalg.norm(right) < 1e-6 else right / np.linalg.norm(right)
        return np.stack([right, np.cross(right, forward), forward])

    def directions(self, x: ArrayLike, y: ArrayLike, width: int, height: int) -> NDArray[np.float32]:
        """Unit view directions through picture points.

        Args:
            x: points [pixel] from the left edge; the first pixel's centre is 0.5. Shape (n,).
            y: points [pixel] from the top edge, shape (n,).
            width: of the whole picture [pixel].
            height: of the whole picture [pixel].

        Returns:
            World directions, shape (n, 3).
        """
        return pinhole_rays(self.axes, x, y, width, height, self.field_of_view)[0]

    def project(self, points: ArrayLike, width: int, height: int) -> NDArray[np.float64]:
        """Picture positions [pixel] of world points [m] in front of the camera, shape (n, 3) -> (n, 2)."""
        local = (np.asarray(points, dtype=np.float64) - np.array(self.position)) @ self.axes.T
        scale = height / (2.0 * math.tan(math.radians(self.field_of_view) / 2.0))
        return np.stack(
            [width / 2.0 + scale * local[:, 0] / local[:, 2], height / 2.0 - scale * local[:, 1] / local[:, 2]], axis=1
        )


def frame(
    points: ArrayLike,
    *,
    aspect: float = 4.0 / 3.0,
    azimuth: float = AZIMUTH,
    elevation: float = ELEVATION,
    field_of_view: float = FIELD_OF_VIEW,
    margin: float = 0.08,
) -> Camera:
    """The camera closest to `points` that sees all of them.

    With the view direction fixed, a point is in the picture when it lies inside four planes through
    the camera; each pair of opposite planes gives the closest distance and the centre in closed form.

    Args:
        points: what must be seen [m], shape (n, 3).
        aspect: width over height of the picture.
        azimuth: direction of the camera [deg], from -y towards +x.
        elevation: height of the camera above the horizon [deg], -89 to 89.
        field_of_view: vertical opening angle [deg].
        margin: free border as a fraction of the picture on each side.

    Raises:
        SpecError: a value is out of range or a point is not finite.
    """
    cloud = np.asarray(points, dtype=np.float64).reshape(-1, 3)
    if len(cloud) == 0 or not np.all(np.isfinite(cloud)):
        raise SpecError("a camera cannot frame points that are missing or not finite.")
    if not (-89.0 <= elevation <= 89.0 and math.isfinite(azimuth)):
        raise SpecError(f"camera elevation must be -89 to 89 degrees and azimuth finite, got {elevation}, {azimuth}.")
    if not (0.0 <= margin < 0.45 and 0.05 <= aspect <= 20.0 and 1.0 <= field_of_view <= 120.0):
        raise SpecError(
            f"framing needs margin 0 to 0.45, aspect 0.05 to 20, field of view 1 to 120; "
            f"got {margin}, {aspect}, {field_of_view}."
        )
    turn, lift = math.radians(azimuth), math.radians(elevation)
    forward = -np.array([math.cos(lift) * math.sin(turn), -math.cos(lift) * math.cos(turn), math.sin(lift)])
    axes = Camera(position=(0.0, 0.0, 0.0), target=(forward[0], forward[1], forward[2])).axes
    local = cloud @ axes.T
    tangent = math.tan(math.radians(field_of_view) / 2.0) * (1.0 - 2.0 * margin)
    centre, depths = np.zeros(3), []
    for axis, slope in ((0, tangent * aspect), (1, tangent)):
        high = np.max(local[:, axis] - slope * local[:, 2])
        low = np.max(-local[:, axis] - slope * local[:, 2])
        centre[axis] = (high - low) / 2.0
        depths.append(-(high + low) / (2.0 * slope))
    # A single point has no size: stay a hand's breadth away from the nearest point.
    centre[2] = min(*depths, float(local[:, 2].min()) - 0.05)
    position = centre @ axes
    middle = position + axes[2] * (float(local[:, 2].mean()) - centre[2])
    return Camera(
        position=(float(position[0]), float(position[1]), float(position[2])),
        target=(float(middle[0]), float(middle[1]), float(middle[2])),
        field_of_view=field_of_view,
    )
