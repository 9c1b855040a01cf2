"""What a picture became, side by side: the picture, its masks, its depth, the fits, and the scene at rest."""

from __future__ import annotations

import colorsys

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from pat3d.view.preview import scene_items
from pat3d.view.render import render
from pat3d.vision.camera import DrawnCamera
from pat3d.vision.drawing import draw
from pat3d.vision.observation import Observation
from pat3d.vision.recover import Recovered

Picture = NDArray[np.uint8]


def panels(seen: Observation, found: Recovered, scene: Scene) -> list[tuple[str, Picture]]:
    """Captions and pictures, shape (height, width, 3) each."""
    camera = found.camera
    size = {"width": camera.pinhole.width, "height": camera.pinhole.height}
    fitted = [(found.sized(name).visual, Pose.from_matrix(one.placed.rotation, one.placed.position))
              for name, one in found.fits.items()]  # fmt: skip
    _, drawn = draw(fitted, camera)
    rested = render(scene_items(scene), camera=DrawnCamera(camera), **size)
    return [
        ("picture", _grey(seen) if seen.picture is None else seen.picture),
        ("masks", overlaid(seen, seen.instances)),
        ("depth", depth_picture(seen.depth)),
        ("fitted objects", overlaid(seen, drawn)),
        ("at rest, from the picture's camera", rested),
    ]


def overlaid(seen: Observation, instances: NDArray[np.int32]) -> Picture:
    """The picture under a colour for each object of `instances`."""
    below = (_grey(seen) if seen.picture is None else seen.picture).astype(np.float32)
    colours = np.array(
        [(0.0, 0.0, 0.0), *(colorsys.hsv_to_rgb(0.618 * k % 1.0, 0.75, 1.0) for k in range(len(seen.names)))]
    )
    tint = 255.0 * colours[instances]
    share = np.where(instances > 0, 0.55, 0.0)[..., None]
    return ((1.0 - share) * below + share * tint).astype(np.uint8)


def depth_picture(depth: NDArray[np.float32]) -> Picture:
    """Near is bright, far is dark, unknown is blue."""
    known = np.isfinite(depth)
    near, far = np.quantile(depth[known], [0.02, 0.98])
    shade = 255.0 * (1.0 - 0.85 * np.clip((depth - near) / max(float(far - near), 1e-9), 0.0, 1.0))
    grey = np.repeat(np.where(known, shade, 0.0)[..., None], 3, axis=2)
    grey[~known] = (40.0, 60.0, 120.0)
    return grey.astype(np.uint8)


def _grey(seen: Observation) -> Picture:
    return np.full((*seen.instances.shape, 3), 190, dtype=np.uint8)
