"""Fingers and hands made of boxes: what is found and measured is what was drawn, also where both sides differ."""

from __future__ import annotations

import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from pat3d.envs.robots.arms import make_robot
from pat3d.envs.robots.description import Description
from pat3d.envs.robots.fingers import BEHIND_TIP, find_grip, geom_points
from pat3d.envs.robots.fingers import _inner as inner
from pat3d.envs.robots.fingers import _slice as cut
from pat3d.envs.robots.structure import find_parts
from pat3d.errors import EnvironmentSetupError
from tests.envs.own_arm import own_arm

TOLD = Description(name="own", mjcf=Path("own.xml"))
PAD = 'name="{}_pad" type="box" size="0.01 0.006 0.03" pos="0 0 0.03"'
"""Of either finger; the tips are 14 cm ahead of the hand's frame."""


def changed(**fingers: str) -> str:
    """The arm with other pads: size and place of each by the name of its finger."""
    text = own_arm()
    for name, pad in fingers.items():
        assert PAD.format(name) in text
        text = text.replace(PAD.format(name), f'name="{name}_pad" type="box" {pad}')
    return text


def grip_of(text: str):
    model = mujoco.MjModel.from_xml_string(text)
    model.opt.gravity[:] = 0.0
    return model, find_grip(model, find_parts(model, TOLD), TOLD)


def names(model, side) -> list[str]:
    return [model.geom(geom).name for geom in side]


def test_the_grip_is_twelve_millimetres_behind_the_longer_finger_s_tip():
    for left, right in ((0.03, 0.025), (0.025, 0.03)):
        _, grip = grip_of(
            changed(
                left=f'size="0.01 0.006 {left}" pos="0 0 {left}"', right=f'size="0.01 0.006 {right}" pos="0 0 {right}"'
            )
        )
        assert grip.position[2] == pytest.approx(0.08 + 2 * 0.03 - BEHIND_TIP, abs=1e-4)


def test_the_grip_is_half_way_between_pads_of_unlike_thickness():
    """The left pad is 4 mm thicker on its inside, so that the middle of what is free is 2 mm to the right."""
    model, grip = grip_of(changed(left='size="0.01 0.008 0.03" pos="0 0.002 0.03"'))
    across, closing, approach = grip.rotation.T
    np.testing.assert_allclose(approach, [0.0, 0.0, 1.0], atol=1e-6)
    np.testing.assert_allclose(np.abs(closing), [0.0, 1.0, 0.0], atol=1e-6)
    np.testing.assert_allclose(np.cross(closing, approach), across, atol=1e-9)
    assert grip.position[1] == pytest.approx(0.002, abs=3e-4)
    # Sides go along the closing direction, the one that it points away from first.
    order = ["left_pad", "right_pad"] if closing[1] > 0.0 else ["right_pad", "left_pad"]
    assert [names(model, side) for side in grip.fingers] == [[name] for name in order]


def test_the_grip_is_above_pads_that_are_beside_the_hand_s_middle():
    _, grip = grip_of(
        changed(left='size="0.01 0.006 0.03" pos="0.02 0 0.03"', right='size="0.01 0.006 0.03" pos="0.02 0 0.03"')
    )
    assert grip.position[0] == pytest.approx(0.02, abs=1e-4)


def test_the_end_of_the_range_that_closes_is_found_whichever_it_is():
    """Both fingers slide out with their joints, or in with a tendon that pulls the other way."""
    text = own_arm()
    _, opening = grip_of(text)
    assert opening.closing == (-1.0,)
    np.testing.assert_allclose(opening.open_joints, 0.04, atol=2e-3)
    turned = text.replace('coef="0.5"', 'coef="-0.5"').replace('ctrlrange="0 0.04"', 'ctrlrange="-0.04 0"')
    _, closing = grip_of(turned)
    assert closing.closing == (1.0,)
    np.testing.assert_allclose(closing.open_joints, 0.04, atol=2e-3)
    np.testing.assert_allclose(closing.position, opening.position, atol=1e-4)


def test_fingers_that_hardly_move_or_do_not_collide_are_refused_by_name():
    """A millimetre is play."""
    for text in (
        own_arm().replace('range="0 0.04"', 'range="0 0.001"'),
        own_arm().replace('mass="0.05" condim="4"', 'mass="0.05" contype="0" conaffinity="0"'),
    ):
        with pytest.raises(
            EnvironmentSetupError, match=r"own: the fingers do not move .* gripper_actuators in own\.yaml"
        ):
            grip_of(text)


@pytest.fixture(scope="module")
def equipped(tmp_path_factory):
    """The model of an arm whose left pad is of rubber and whose right one is of ice."""
    path = tmp_path_factory.mktemp("robots") / "equipped.xml"
    left, right = own_arm().split('name="right_pad"')
    path.write_text(
        left + 'name="right_pad"' + right.replace('friction="1.5 0.01 0.0001"', 'friction="0.4 0.02 0.0001"', 1)
    )
    robot = make_robot(str(path))
    return robot, robot.new_spec().compile()


def test_pads_slide_no_more_easily_than_rubber_and_turn_as_their_file_says(equipped):
    _, model = equipped
    np.testing.assert_allclose(model.geom("left_pad").friction, [1.5, 0.01, 0.0001])
    np.testing.assert_allclose(model.geom("right_pad").friction, [1.0, 0.02, 0.0001])


def test_the_wrist_camera_looks_at_the_grip_with_both_open_fingertips_in_its_picture(equipped):
    """From 14 cm behind and 7 cm beside, upright as seen from there, with 75 degrees of view as robosuite's have."""
    robot, model = equipped
    data = mujoco.MjData(model)
    for name, value in zip(robot.gripper_joints, robot.gripper_home, strict=True):
        data.joint(name).qpos = value
    mujoco.mj_kinematics(model, data)
    mujoco.mj_camlight(model, data)
    camera, site = data.cam(robot.wrist_camera), data.site(robot.grip_site)
    axes, frame = camera.xmat.reshape(3, 3), site.xmat.reshape(3, 3)
    np.testing.assert_allclose((camera.xpos - site.xpos) @ frame, [0.07, 0.0, -0.14], atol=1e-9)
    seen = (site.xpos - camera.xpos) @ axes
    np.testing.assert_allclose(seen, [0.0, 0.0, -math.hypot(0.14, 0.07)], atol=1e-9)
    assert (frame[:, 0] @ axes)[1] > 0.8
    opening = math.tan(math.radians(float(model.cam(robot.wrist_camera).fovy[0])) / 2)
    assert math.degrees(2 * math.atan(opening)) == pytest.approx(75.0)
    for side in robot.fingers:
        x, y, z = ((geom_points(model, data, model.geom(side[0]).id) - camera.xpos) @ axes).T
        ahead = np.argmax(-z)
        assert abs(x[ahead]) < -z[ahead] * opening
        assert abs(y[ahead]) < -z[ahead] * opening


CUBE = np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
OCTAHEDRON = np.array([axis * sign for axis in np.eye(3) for sign in (1.0, -1.0)])
UP = np.array([0.0, 0.0, 1.0])


def test_a_slice_of_a_hull_has_the_corners_of_its_cuts():
    """At height h an octahedron is a square with corners 1 - |h| from the axis, and the waist is a corner itself."""
    for low, high in ((0.2, 0.5), (-0.5, 0.3), (-0.9, -0.1)):
        points = cut(OCTAHEDRON, UP, low, high)
        assert points[:, 2].min() == pytest.approx(low)
        assert points[:, 2].max() == pytest.approx(high)
        np.testing.assert_allclose(np.abs(points[:, :2]).sum(axis=1) + np.abs(points[:, 2]), 1.0, atol=1e-12)
        waist = 0.0 if low < 0.0 < high else min(abs(low), abs(high))
        np.testing.assert_allclose(np.abs(points[:, :2]).max(axis=0), 1.0 - waist, atol=1e-12)
    assert len(cut(OCTAHEDRON, UP, 1.1, 1.2)) == 0
    np.testing.assert_array_equal(cut(CUBE, UP, -2.0, 2.0), CUBE)
    # A slice along another direction, and within the cube, whose corners are all outside of it.
    across = cut(CUBE, np.array([1.0, 0.0, 0.0]), -0.25, 0.5)
    assert set(np.round(across[:, 0], 12)) == {-0.25, 0.5}
    np.testing.assert_allclose(np.abs(across[:, 1:]).max(axis=0), 1.0)
    # What is flat has no hull, and nothing between its corners counts.
    assert len(cut(CUBE[CUBE[:, 0] > 0.0], UP, -0.5, 0.5)) == 0


def test_the_free_width_between_two_fingers_is_that_of_their_innermost_points():
    """Octahedra beside one another narrow the gap between them from tips to waist."""
    sides = ([OCTAHEDRON - [0.0, 2.0, 0.0]], [OCTAHEDRON + [0.0, 2.0, 0.0], CUBE + [0.0, 5.0, 0.0]])
    assert inner(sides, -0.1, 0.1) == pytest.approx((-1.0, 1.0))
    assert inner(sides, 0.5, 0.7) == pytest.approx((-1.5, 1.5))
    assert inner(sides, 3.0, 4.0) == (-math.inf, math.inf)
