"""Camera elevation by visibility: so high that what lies in a container or behind something is in the picture."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.normals import triangle_areas
from pat3d.view.camera import ELEVATION, Camera, frame
from pat3d.view.geometry import Geometry, Item

ELEVATIONS = (ELEVATION, 40.0, 55.0, 70.0)
"""That are tried in this order [deg]: low views show best what things are, high ones what they hold."""

ENOUGH = 0.1
"""Share of an item that has to be seen; of the lowest book of a stack, one hardly sees more from anywhere."""

LEAST_VIEW = 0.25
"""Half of the surface around things that is shown at least [m]."""

_SAMPLES = 256
"""Faces of an item that are looked towards, at most."""


def overlooking(panels: Sequence[Sequence[Item]], *, aspect: float, stage: int | None = None) -> Camera:
    """The lowest of the automatic cameras that shows every item of every panel, or else the most items.

    Args:
        panels: items that are drawn together, each the same items in the same order.
        aspect: width over height of the picture.
        stage: index of the item that carries all others, of which the picture needs only what is around them.
    """
    together = [item for items in panels for item in items]
    points = _framed(panels, stage)
    best, most = frame(points, aspect=aspect), -1
    for elevation in ELEVATIONS:
        camera = frame(points, aspect=aspect, elevation=elevation)
        shown = sum(int(np.count_nonzero(share_seen(items, camera) >= ENOUGH)) for items in panels)
        if shown > most:
            best, most = camera, shown
        if shown == len(together):
            break
    return best


def _framed(panels: Sequence[Sequence[Item]], stage: int | None) -> NDArray[np.float64]:
    """What has to be in the picture [m], shape (n, 3)."""
    items = [item for one in panels for number, item in enumerate(one) if number != stage]
    if stage is None or not items:
        return np.concatenate([pose.apply(mesh.vertices) for one in panels for mesh, pose, *_ in one])
    points = np.concatenate([pose.apply(mesh.vertices) for mesh, pose, *_ in items])
    low, high = points.min(axis=0), points.max(axis=0)
    mesh, pose, *_ = panels[0][stage]
    carrier = pose.apply(mesh.vertices)
    # A little of the surface on every side says what things stand on.
    room = max(LEAST_VIEW, 0.6 * float((high - low)[:2].max()))
    corners = [(low + high)[:2] / 2 + room * np.array([x, y]) for x in (-1, 1) for y in (-1, 1)]
    around = np.clip(corners, carrier[:, :2].min(axis=0), carrier[:, :2].max(axis=0))
    return np.concatenate([points, np.column_stack([around, np.full(4, low[2])])])


def share_seen(items: Sequence[Item], camera: Camera) -> NDArray[np.float64]:
    """How much of every item other items do not hide from the camera; shape (len(items),).

    Of the directions to the middles of an item's faces, front and back, the share in which the item is what one sees,
    by the area of the faces.
    """
    geometry = Geometry(items)
    eye = np.array(camera.position) - geometry.origin
    seen = np.empty(len(items))
    for index, (mesh, pose, *_) in enumerate(items):
        corners = mesh.vertices[mesh.faces[:: -(-len(mesh.faces) // _SAMPLES)]]
        area = triangle_areas(corners)
        rays = pose.apply(corners.mean(axis=1)) - geometry.origin - eye
        rays /= np.linalg.norm(rays, axis=1)[:, None]
        first = geometry.first_items(np.tile(eye, (len(rays), 1)).astype(np.float32), rays.astype(np.float32))
        seen[index] = np.average(first == index, weights=area)
    return seen
