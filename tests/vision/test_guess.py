"""A candidate that is nearly right comes to where it was seen, and what touches an object hides it without a cost."""

import math

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import yaw_of
from pat3d.vision.caster import Caster, Placement
from pat3d.vision.guess import Guess, polished
from pat3d.vision.window import Window
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see
from tests.vision.test_fitting import CHIRAL

CAMERA = camera_at((0.5, -0.9, 0.7))


def window_of(placed, name, pixels=1500):
    return Window(see(placed, CAMERA), CAMERA, name, pixels)


def guess_at(window, caster, placed):
    """The guess that is placed so."""
    middle = placed.apply(caster.centre[None])[0] - window.origin
    distance = float(np.linalg.norm(middle))
    plane = np.column_stack([window.right, window.down, -middle / distance])
    across, down, _ = np.linalg.lstsq(plane, -window.middle, rcond=None)[0]
    return Guess(float(across), float(down), distance, placed.scale * caster.radius / distance, yaw_of(placed.rotation))


@pytest.mark.parametrize("seed", range(4))
def test_what_is_nearly_right_comes_to_the_truth(seed):
    """Errors of a few degrees, a few percent and a few millimetres are gone to a thousandth."""
    pose, caster = Pose.from_yaw(0.4, (0.02, -0.05, 0.0)), Caster(CHIRAL.visual)
    window = window_of({"it": (CHIRAL, pose)}, "it")
    truth = guess_at(window, caster, Placement(scale=1.0, rotation=pose.rotation, position=np.array(pose.position)))
    assert truth.cost(window, caster) < 1e-3
    off = truth.moved(np.random.default_rng(seed).uniform(-0.3, 0.3, 5), leans=False)
    before = off.cost(window, caster)
    near, _ = polished(window, caster, off, blur=3.5)
    found, cost = polished(window, caster, near)
    assert cost < 0.02 < before
    assert math.degrees(abs(found.yaw - 0.4)) < 0.2
    placed = found.placed(window, caster)
    assert placed.scale == pytest.approx(1.0, abs=2e-3)
    assert placed.position == pytest.approx(np.array(pose.position), abs=1e-3)


def test_where_no_pixel_is_near_nothing_is_changed():
    caster = Caster(CHIRAL.visual)
    window = window_of({"it": (CHIRAL, Pose())}, "it")
    off = Guess(3.0, 3.0, 1.0, 0.1, 0.0)
    assert polished(window, caster, off) == (off, off.cost(window, caster))


def test_a_slab_under_another_is_where_it_should_be_though_little_of_it_is_seen():
    """Its top lies right behind the front of what lies on it; so wide a slab explains what is seen."""
    slab, lid = asset_of(box(0.3, 0.2, 0.02)), asset_of(box(0.3, 0.2, 0.04))
    stack = {"slab": (slab, Pose()), "lid": (lid, Pose(position=(0.0, 0.0, 0.02)))}
    window, caster = window_of(stack, "slab"), Caster(slab.visual)
    true = Placement(scale=1.0, rotation=np.eye(3), position=np.zeros(3))
    drawn = caster.ranges(window.origin, window.rays, true)
    hidden = np.isfinite(drawn) & ~window.own
    assert np.count_nonzero(hidden) > np.count_nonzero(window.own)
    assert window.cost(drawn) < 0.01
    # Before what lies on it, it would be seen.
    assert window.contradicted((drawn - 0.1).astype(np.float32))[hidden].min() == 1.0
