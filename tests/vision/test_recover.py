"""Whole pictures: what stands on what comes back with the poses, in metres or from a size."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.library.store import scaled
from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.vision.occlusion import resized
from pat3d.vision.recover import recover
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

BLOCK = asset_of(box(0.3, 0.2, 0.1), noun="block")
BRICK = asset_of(box(0.12, 0.06, 0.08), noun="brick")
CAMERA = camera_at((0.5, -0.8, 0.6))
THINGS = {
    "block": (BLOCK, Pose.from_yaw(0.2, (0.0, 0.0, 0.0))),
    "brick": (BRICK, Pose.from_yaw(1.0, (0.03, 0.0, 0.1))),
}
ASSETS = {"block": scaled(BLOCK, 1.3), "brick": scaled(BRICK, 0.7)}


def apart(found):
    return float(np.linalg.norm(found.fits["brick"].placed.position - found.fits["block"].placed.position))


def test_a_brick_on_a_block_comes_back_as_such():
    found = recover(see(THINGS, CAMERA), ASSETS)
    assert [str(one) for one in found.relations] == ["brick on block"]
    assert found.sized("block").size == pytest.approx(BLOCK.size, rel=0.02)
    assert found.sized("brick").size == pytest.approx(BRICK.size, rel=0.02)
    assert apart(found) == pytest.approx(np.hypot(0.03, 0.1), abs=0.004)
    assert found.notes == ()


def test_depth_that_is_right_up_to_a_factor_takes_its_metres_from_a_size():
    """The same picture with all depths 2.5 times as large is the same scene, once one size is known."""
    true = see(THINGS, CAMERA)
    seen = replace(true, depth=2.5 * true.depth)
    large = recover(seen, ASSETS)
    assert large.sized("block").size == pytest.approx(2.5 * BLOCK.size, rel=0.02)
    found = resized(large, {"block": 0.3}, seen)
    assert found.sized("brick").size == pytest.approx(BRICK.size, rel=0.03)
    assert apart(found) == pytest.approx(np.hypot(0.03, 0.1), abs=0.005)
    assert found.camera.position[2] == pytest.approx(CAMERA.position[2], rel=0.01)
    assert 'follow from the size of "block"' in found.notes[-1]
