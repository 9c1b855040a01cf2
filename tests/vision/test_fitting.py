"""Assets are found again at the size, place and orientation at which a camera saw them."""

import math

import numpy as np
import pytest

from pat3d.assets.library.store import scaled
from pat3d.assets.shapes import box, join
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import about, yaw_matrix
from pat3d.vision.caster import Caster, Placement, orientation
from pat3d.vision.fitting import fit, stood
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

CHIRAL = asset_of(
    join(
        box(0.20, 0.06, 0.05),
        box(0.06, 0.12, 0.05).moved(-0.07, 0.08, 0.0),
        box(0.04, 0.04, 0.08).moved(0.08, 0.0, 0.045),
    )
)
"""No turn and no mirror image of it looks the same, so every wrong sign shows."""
CUBE = asset_of(box(0.1, 0.1, 0.1))
CAMERA = camera_at((0.5, -0.9, 0.7))


def errors(found, asset, pose, factor):
    """Of the middle of the bounding box [m], the scale [-] and the orientation [deg]."""
    low, high = asset.visual.bounds
    middle = (low + high)[None] / 2
    centre = np.linalg.norm(found.placed.apply(middle * factor) - pose.apply(middle))
    turn = np.trace(found.placed.rotation.T @ pose.rotation)
    return float(centre), abs(found.placed.scale * factor - 1.0), math.degrees(math.acos(min(1.0, (turn - 1.0) / 2.0)))


@pytest.mark.parametrize("yaw", [0.3, 1.9, -2.5])
def test_size_place_and_yaw_come_back(yaw):
    pose, factor = Pose.from_yaw(yaw, (0.05, -0.1, 0.0)), 1.4
    found = fit(see({"it": (CHIRAL, pose)}, CAMERA), CAMERA, "it", Caster(scaled(CHIRAL, factor).visual))
    centre, scale, turn = errors(found, CHIRAL, pose, factor)
    assert centre < 0.003
    assert scale < 0.01
    assert turn < 2.0
    assert not found.tilted
    assert found.overlap > 0.95


def test_what_something_hides_is_found_by_what_is_left():
    pose = Pose.from_yaw(0.7, (0.0, 0.0, 0.0))
    screen = Pose(position=(0.12, -0.12, 0.05))
    seen = see({"it": (CHIRAL, pose), "screen": (CUBE, screen)}, CAMERA)
    alone = see({"it": (CHIRAL, pose)}, CAMERA)
    assert seen.mask("it").sum() < 0.85 * alone.mask("it").sum()
    centre, scale, turn = errors(fit(seen, CAMERA, "it", Caster(scaled(CHIRAL, 0.8).visual)), CHIRAL, pose, 0.8)
    assert centre < 0.005
    assert scale < 0.02
    assert turn < 3.0


def test_a_thing_on_its_side_is_found_lying():
    rotation = yaw_matrix(0.5) @ about("x", math.pi / 2)
    pose = Pose.from_matrix(rotation, np.array([0.0, 0.0, 0.03]))
    found = fit(see({"it": (CHIRAL, pose)}, CAMERA), CAMERA, "it", Caster(CHIRAL.visual))
    assert found.tilted
    centre, scale, turn = errors(found, CHIRAL, pose, 1.0)
    assert centre < 0.01
    assert scale < 0.04
    assert turn < 8.0


def test_standing_on_the_ground_makes_up_for_a_depth_that_is_wrong():
    """Depth of the object alone is 6 % too large, as of models that see an object before a far background."""
    pose = Pose.from_yaw(0.3, (0.05, -0.1, 0.0))
    seen = see({"it": (CHIRAL, pose)}, CAMERA)
    seen.depth[seen.mask("it")] *= 1.06
    caster = Caster(CHIRAL.visual)
    free = fit(seen, CAMERA, "it", caster)
    assert errors(free, CHIRAL, pose, 1.0)[1] > 0.04
    standing = stood(seen, CAMERA, "it", caster, free, 0.0)
    low = standing.placed.apply(CHIRAL.visual.vertices)[:, 2].min()
    assert low == pytest.approx(0.0, abs=1e-6)
    assert errors(standing, CHIRAL, pose, 1.0)[1] < 0.02


def test_ranges_are_those_of_the_mesh_in_the_world():
    caster = Caster(CUBE.visual)
    placed = Placement(scale=2.0, rotation=yaw_matrix(math.pi / 4), position=np.array([1.0, 0.0, 0.0]))
    ways = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    ranges = caster.ranges(np.array([0.0, 0.0, 0.1]), ways, placed)
    assert ranges[0] == pytest.approx(1.0 - 0.1 * math.sqrt(2.0), abs=1e-6)
    assert np.isinf(ranges[1])


def test_orientations_are_turns_about_x_then_y_then_z():
    expected = yaw_matrix(0.3) @ about("y", 0.4) @ about("x", -0.7)
    assert np.allclose(orientation(0.3, 0.4, -0.7), expected)
