"""The hand in a grasp, and grasps that move along with what they are of."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.hand import hand_pose
from pat3d.envs.tasks.moves import Planner
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene
from tests.envs.test_grasp import bar

TIP = 0.012
ABOVE = Grasp(position=(0.3, -0.2, 0.05), closing=0.4, bite=0.02, score=1.0, width=0.03)
ASIDE = replace(ABOVE, lean=0.9, heading=2.1)
AXES = [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0), (math.cos(0.3), math.sin(0.3), 0.0)]


@pytest.mark.parametrize("axis", AXES)
@pytest.mark.parametrize("half", [0.0, math.pi / 2, 1.0, math.pi])
def test_a_hand_from_above_points_down_and_closes_where_the_grasp_says_turned_by_its_half(axis, half):
    """The fingertips are in the grasp, and the grip site above them."""
    position, rotation = hand_pose(ABOVE, TIP, axis, back=0.1, half=half)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(rotation) == pytest.approx(1.0)
    np.testing.assert_allclose(rotation @ [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], atol=1e-12)
    closing = ABOVE.closing + half
    np.testing.assert_allclose(rotation @ axis, [math.cos(closing), math.sin(closing), 0.0], atol=1e-12)
    np.testing.assert_allclose(position, [0.3, -0.2, 0.05 + TIP + 0.1], atol=1e-12)


@pytest.mark.parametrize("half", [0.0, 0.7, math.pi])
def test_a_hand_that_leans_is_back_along_its_approach_on_the_side_of_its_heading(half):
    position, rotation = hand_pose(ASIDE, TIP, AXES[0], back=0.1, half=half)
    tips = position + TIP * rotation[:, 2]
    side = [math.cos(ASIDE.heading), math.sin(ASIDE.heading)]
    back = np.array([*(math.sin(ASIDE.lean) * np.array(side)), math.cos(ASIDE.lean)])
    np.testing.assert_allclose(rotation[:, 2], -back, atol=1e-12)
    np.testing.assert_allclose(tips, ASIDE.position + 0.1 * back, atol=1e-12)
    np.testing.assert_allclose(rotation, ASIDE.turn @ hand_pose(ABOVE, TIP, AXES[0], half=half)[1], atol=1e-12)


@pytest.mark.parametrize("grasp", [ABOVE, ASIDE])
@pytest.mark.parametrize("yaw", [0.0, 0.5, -2.0, 3.0])
def test_a_grasp_moves_with_its_object_as_if_both_were_one_body(grasp, yaw):
    """The hand before and after differ by the motion of the object: a turn about z, then a shift."""
    start = Pose.from_yaw(0.3, (0.31, -0.22, 0.0))
    made = bar("bar", (0.2, 0.04, 0.1))
    motion = Pose.from_yaw(yaw, (0.7, -0.1, 0.05))
    now = Pose.from_matrix(motion.rotation @ start.rotation, motion.apply(np.array([start.position]))[0])
    centre = now.apply(np.array([made.asset.mass_properties.centre_of_mass]))[0]
    state = SimpleNamespace(rotation=lambda _: now.rotation, centre=lambda _: centre)
    planner = object.__new__(Planner)
    planner._env = SimpleNamespace(
        scene=Scene(objects=(replace(made, pose=start, initial_pose=start),)),
        simulation=SimpleNamespace(state=state),
        placement=SimpleNamespace(grasps={"bar": (grasp,)}),
    )
    (moved,) = planner._moved("bar")
    before, after = hand_pose(grasp, TIP, AXES[0]), hand_pose(moved, TIP, AXES[0])
    np.testing.assert_allclose(after[0], motion.apply(before[0][None])[0], atol=1e-12)
    np.testing.assert_allclose(after[1], motion.rotation @ before[1], atol=1e-12)
    assert (moved.bite, moved.score, moved.width, moved.lean) == (grasp.bite, grasp.score, grasp.width, grasp.lean)
