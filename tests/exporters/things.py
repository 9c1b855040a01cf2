"""Scenes that exercise every path of the exporters."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from pat3d.assets.catalogue import make
from pat3d.assets.shapes import box, cylinder, join, vessel
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.model import Attachment, Scene
from tests.scenes import GAP, asset_of, placed, scene_of


def lopsided() -> Asset:
    """A pencil-like asset of 2 g whose principal axes are none of the frame's, with a box at a slant."""
    pencil = join(cylinder(0.0035, 0.17), box(0.02, 0.004, 0.01)).turned("y", 70).turned("z", 20).moved(z=0.05)
    return asset_of(pencil)


def mixed_scene() -> Scene:
    """A fixed table, two mugs of one asset, a pencil in any pose, a ball."""
    rng = np.random.default_rng(1)
    quat = tuple(Rotation.random(random_state=rng).as_quat(scalar_first=True))
    mug = asset_of(vessel([(0.03, 0), (0.04, 0.09)], [(0.026, 0.006), (0.036, 0.09)]))
    return scene_of(
        placed("wooden table", asset_of(box(0.8, 0.5, 0.04)), (0, 0, GAP), fixed=True),
        placed("red mug 1", mug, (0.1, 0, 0.04 + 2 * GAP)),
        placed("red mug 2", mug, (-0.1, 0.1, 0.04 + 2 * GAP)),
        placed("pencil & <co>", lopsided(), pose=Pose(position=(0.3, 0.2, 0.4), quat_wxyz=quat)),  # type: ignore[arg-type]
        placed("ball", make("ball"), (0, -0.2, 0.3)),
    )


def hung_bar(points: tuple[float, ...] = (-0.1, 0.1)) -> Scene:
    """A bar 1 m up, hung by points at `points` along it from a beam that stands on nothing because it is fixed."""
    anchors = tuple(((x, 0.0, 0.04), (x, 0.0, -0.002)) for x in points)
    return scene_of(
        placed("the beam", asset_of(box(0.5, 0.1, 0.1)), (0, 0, 1), fixed=True),
        placed("a bar", asset_of(box(0.3, 0.04, 0.04)), (0, 0, 0.958)),
        attachments=(Attachment(child="a bar", parent="the beam", anchors=anchors),),
    )
