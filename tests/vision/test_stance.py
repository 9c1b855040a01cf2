"""What somebody says of how a thing stands decides what its pixels leave open, and nothing else."""

import math

import numpy as np
import pytest

from pat3d.assets.library.store import scaled
from pat3d.assets.shapes import box
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import about, yaw_matrix, yaw_of
from pat3d.vision.caster import Caster
from pat3d.vision.fitting import fit
from pat3d.vision.stance import Stance
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see
from tests.vision.test_fitting import CHIRAL

CAMERA = camera_at((0.2, -0.9, 0.6))
BOOK = asset_of(box(0.2, 0.14, 0.04))


@pytest.mark.parametrize(("facing", "yaw"), [("viewer", 0.0), ("right", 90.0), ("away", 180.0), ("left", -90.0)])
def test_the_front_is_the_negative_y_of_an_asset_as_the_viewer_sees_it(facing, yaw):
    stance, ahead = Stance(facing=facing), np.array([0.0, 0.8, -0.6])
    assert not stance.denies(yaw_matrix(math.radians(yaw + 60.0)), ahead)
    assert not stance.denies(yaw_matrix(math.radians(yaw - 60.0)), ahead)
    assert stance.denies(yaw_matrix(math.radians(yaw + 120.0)), ahead)
    assert stance.denies(yaw_matrix(math.radians(yaw - 120.0)), ahead)
    # A camera on the other side sees it turned by half.
    assert stance.denies(yaw_matrix(math.radians(yaw)), np.array([0.0, -1.0, 0.0]))
    assert not Stance().denies(yaw_matrix(math.radians(yaw)), ahead)


@pytest.mark.parametrize("facing", ["viewer", "away"])
def test_of_turns_that_look_the_same_the_one_that_is_said_is_taken(facing):
    seen = see({"it": (BOOK, Pose.from_yaw(0.2, (0.0, 0.0, 0.0)))}, CAMERA)
    found = fit(seen, CAMERA, "it", Caster(scaled(BOOK, 1.3).visual), stance=Stance(facing=facing))
    true = 0.2 if facing == "viewer" else 0.2 + math.pi
    assert abs(math.remainder(yaw_of(found.placed.rotation) - true, 2 * math.pi)) < math.radians(2.0)
    assert found.placed.scale * 1.3 == pytest.approx(1.0, abs=0.01)


def test_pixels_that_decide_are_not_overruled_by_a_front():
    pose = Pose.from_yaw(0.3, (0.0, 0.0, 0.0))
    found = fit(see({"it": (CHIRAL, pose)}, CAMERA), CAMERA, "it", Caster(CHIRAL.visual), stance=Stance(facing="away"))
    assert yaw_of(found.placed.rotation) == pytest.approx(0.3, abs=0.03)


@pytest.mark.slow
def test_pixels_that_decide_are_not_overruled_by_a_posture():
    pose = Pose.from_yaw(0.3, (0.0, 0.0, 0.0))
    said = Stance(posture="upside down")
    found = fit(see({"it": (CHIRAL, pose)}, CAMERA), CAMERA, "it", Caster(CHIRAL.visual), stance=said)
    assert yaw_of(found.placed.rotation) == pytest.approx(0.3, abs=0.03)
    assert not found.tilted


@pytest.mark.slow
def test_a_thing_of_other_proportions_lies_where_somebody_says_so():
    """A carton lies on its side; the asset for it is thicker, so that drawn upright it looks nearly as like."""
    true, asset = asset_of(box(0.12, 0.1, 0.14)), asset_of(box(0.12, 0.12, 0.14))
    lying = Pose.from_matrix(about("x", math.pi / 2), np.array([0.0, 0.0, 0.05]))
    seen = see({"it": (true, lying)}, CAMERA)
    silent, said = (
        fit(seen, CAMERA, "it", Caster(asset.visual), stance=stance) for stance in (None, Stance(posture="on its side"))
    )
    assert not silent.tilted
    assert said.tilted
