"""Masks that end early, measured by the depth beside them, against masks eroded by a known number of pixels."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.ndimage import binary_erosion

from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.vision.borders import border_lost, bordered
from pat3d.vision.recover import recover
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

BLOCK = asset_of(box(0.3, 0.2, 0.1), noun="block")
STICK = asset_of(box(0.02, 0.02, 0.25), noun="stick")
TRUE = see(
    {
        "block": (BLOCK, Pose.from_yaw(0.2, (0.1, 0.0, 0.0))),
        "stick": (STICK, Pose.from_yaw(0.4, (-0.15, 0.05, 0.0))),
    },
    camera_at((0.3, -0.8, 0.45), (0.0, 0.0, 0.1)),
)


def eroded(lost, noise=0.0):
    kept = sum(binary_erosion(TRUE.instances == number, iterations=lost) if lost else TRUE.instances == number
               for number in (1, 2))  # fmt: skip
    depth = TRUE.depth * (1.0 + noise * np.random.default_rng(0).normal(size=TRUE.depth.shape)).astype(np.float32)
    return replace(TRUE, instances=np.where(kept, TRUE.instances, 0), depth=depth)


@pytest.mark.parametrize("noise", [0.0, 0.05])
@pytest.mark.parametrize("lost", [0, 1, 2])
def test_the_pixels_that_every_border_lost_are_counted(lost, noise):
    assert border_lost(eroded(lost, noise)) == lost


def test_grown_masks_are_the_true_ones_but_for_corners():
    found = bordered(eroded(2), 2).instances
    assert np.count_nonzero(found != TRUE.instances) < 0.02 * np.count_nonzero(TRUE.instances)


def test_what_hides_an_object_does_not_become_its_border():
    """The upper half of the stick is behind something much nearer: there, its mask must not grow."""
    seen = eroded(1)
    rows, columns = np.nonzero(TRUE.instances == 2)
    half = rows < np.median(rows)
    depth, instances = seen.depth.copy(), seen.instances.copy()
    nearer = np.zeros_like(TRUE.instances, dtype=bool)
    nearer[rows[half].min() - 5 : rows[half].max() + 1, columns.min() - 8 : columns.max() + 9] = True
    depth[nearer], instances[nearer] = 0.4, 0
    found = bordered(replace(seen, depth=depth, instances=instances), 1)
    assert not (found.instances[nearer] == 2).any()
    assert np.count_nonzero(found.instances == 2) > np.count_nonzero(instances == 2)


@pytest.mark.slow
def test_a_thin_thing_keeps_its_width_though_its_mask_lost_a_pixel_on_each_side():
    assets = {"block": BLOCK, "stick": STICK}
    found = recover(eroded(1), assets)
    assert found.sized("stick").size == pytest.approx(STICK.size, rel=0.04)
    assert any("by 1 px" in note for note in found.notes)
