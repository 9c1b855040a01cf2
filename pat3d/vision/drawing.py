"""What a camera would see of placed meshes: the depth of every pixel and the mesh that it shows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pat3d.view.geometry import Geometry, Item
from pat3d.vision.camera import PlacedCamera

SKY = 50.0
"""Ranges from which on the ground is sky [m]."""


def draw(items: Sequence[Item], camera: PlacedCamera) -> tuple[NDArray[np.float32], NDArray[np.int32]]:
    """Depth and masks of meshes over the ground z = 0.

    Returns:
        Depth along the optical axis [m], NaN for the sky, and 1 + index of the item that is seen, 0 for none; both of
        shape (height, width).
    """
    pinhole = camera.pinhole
    rows, columns = np.mgrid[: pinhole.height, : pinhole.width]
    rays, reach = camera.rays(columns.ravel() + 0.5, rows.ravel() + 0.5)
    geometry = Geometry(items)
    origins = np.tile((camera.position - geometry.origin).astype(np.float32), (len(rays), 1))
    directions = rays.astype(np.float32)
    item = geometry.first_items(origins, directions)
    _, far = geometry.first_faces(origins, directions)
    ground = np.where(rays[:, 2] < -1e-6, -camera.position[2] / np.minimum(rays[:, 2], -1e-6), np.inf)
    hit = (item >= 0) & (far <= ground)
    ranges = np.where(hit, far, ground)
    depth = np.where(ranges < SKY, ranges / reach, np.nan).reshape(rows.shape)
    return depth.astype(np.float32), (np.where(hit, item, -1) + 1).reshape(rows.shape).astype(np.int32)
