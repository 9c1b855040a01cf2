"""Scenes seen by a camera, for tests of the image path: true depth and masks of placed assets."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.view.camera import Camera
from pat3d.vision.camera import Pinhole, PlacedCamera
from pat3d.vision.drawing import draw
from pat3d.vision.observation import Observation

WIDTH, HEIGHT = 320, 240


def camera_at(
    position: tuple[float, float, float],
    target: tuple[float, float, float] = (0.0, 0.0, 0.05),
    *,
    angle: float = 45.0,
    roll: float = 0.0,
) -> PlacedCamera:
    """A camera that looks at `target`, turned by `roll` [deg] about its axis; `angle` is its vertical one [deg]."""
    looking = Camera(position=position, target=target, field_of_view=angle)
    focal = HEIGHT / (2.0 * math.tan(math.radians(angle) / 2.0))
    turn = math.radians(roll)
    about_z = np.array([[math.cos(turn), -math.sin(turn), 0.0], [math.sin(turn), math.cos(turn), 0.0], [0.0, 0.0, 1.0]])
    return PlacedCamera(
        pinhole=Pinhole(width=WIDTH, height=HEIGHT, fx=focal, fy=focal, cx=WIDTH / 2, cy=HEIGHT / 2),
        rotation=(looking.axes.T * np.array([1.0, -1.0, 1.0])) @ about_z,
        position=np.array(position),
    )


def see(placed: Mapping[str, tuple[Asset, Pose]], camera: PlacedCamera) -> Observation:
    """What `camera` sees of assets at poses over the ground."""
    depth, instances = draw([(asset.visual, pose) for asset, pose in placed.values()], camera)
    return Observation(camera=camera.pinhole, depth=depth, instances=instances, names=tuple(placed))
