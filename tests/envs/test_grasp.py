"""Grasps found on height maps, judged against shapes whose answer is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pat3d.envs.grasping.grasp import find_grasps, narrowest
from pat3d.envs.robots.robot import Gripper
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import MassProperties
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset, Material, Region, VisualMesh
from pat3d.scene.model import Scene, SceneObject

GRIPPER = Gripper(
    opening=0.08,
    closed=0.0,
    finger_thickness=0.015,
    finger_width=0.02,
    tip=0.01,
    palm=0.045,
    hand=(0.2, 0.06),
    pad=0.02,
    closing_axis=(0.0, 1.0, 0.0),
)


def bar(name: str, size, position=(0.0, 0.0), yaw: float = 0.0) -> SceneObject:
    """A box of `size` [m] standing on the ground."""
    half = np.array(size) / 2
    part = convex_part(np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (0, 2)]) * half)
    visual = VisualMesh.from_face_colours(part.vertices, part.faces, np.full((len(part.faces), 3), 128, np.uint8))
    properties = MassProperties(
        mass=0.1,
        volume=float(np.prod(size)),
        centre_of_mass=(0.0, 0.0, size[2] / 2),
        inertia=((1e-4, 0.0, 0.0), (0.0, 1e-4, 0.0), (0.0, 0.0, 1e-4)),
    )
    top = Region(kind="on", shape="rectangle", floor=(0.0, 0.0, size[2]), half_size=(size[0] / 2, size[1] / 2))
    asset = Asset(
        noun="bar",
        regions=(top,),
        visual=visual,
        parts=(part,),
        mass_properties=properties,
        material=Material(name="wood", density=500.0, friction=0.5),
    )
    pose = Pose.from_yaw(yaw, (*position, 0.0))
    return SceneObject(name=name, asset=asset, pose=pose, initial_pose=pose)


@pytest.mark.parametrize("yaw", [0.0, 0.4, 1.2, 2.0])
def test_a_bar_is_taken_across_its_narrow_side_wherever_it_points(yaw):
    scene = Scene(objects=(bar("bar", (0.2, 0.04, 0.05), yaw=yaw),))
    grasps = find_grasps(scene, "bar", GRIPPER)
    best = grasps[0]
    off = (best.closing - (yaw + math.pi / 2) + math.pi / 2) % math.pi - math.pi / 2
    assert abs(off) < math.radians(12.0)
    along = np.array([math.cos(yaw), math.sin(yaw)])
    across = np.array([-along[1], along[0]])
    assert abs(np.array(best.position[:2]) @ across) < 0.005
    # Fingertips stay above the ground and below the top by at least the least bite.
    assert 0.003 < best.position[2] < 0.05 - 0.012


@pytest.mark.parametrize(("width", "found"), [(0.07, True), (0.077, True), (0.082, False), (0.12, False)])
def test_what_is_wider_than_the_opening_cannot_be_taken(width, found):
    scene = Scene(objects=(bar("block", (width, width, 0.06)),))
    assert bool(find_grasps(scene, "block", GRIPPER)) == found


def test_a_wall_beside_the_bar_forbids_that_side_alone():
    """Between two walls a cube can be closed on along the walls only."""
    walls = [bar(f"wall {side}", (0.3, 0.02, 0.1), (0.0, side * 0.045)) for side in (-1, 1)]
    scene = Scene(objects=(bar("cube", (0.05, 0.05, 0.09)), *walls))
    grasps = find_grasps(scene, "cube", GRIPPER)
    assert grasps
    for grasp in grasps:
        assert abs(math.cos(grasp.closing)) > 0.9
    # Nothing is left once the cube is also closed in along the walls.
    ends = [bar(f"end {side}", (0.02, 0.07, 0.1), (side * 0.045, 0.0)) for side in (-1, 1)]
    boxed = Scene(objects=(*scene.objects, *ends))
    assert not find_grasps(boxed, "cube", GRIPPER)
    assert find_grasps(boxed, "cube", GRIPPER, among=())


@pytest.mark.parametrize(("height", "found"), [(0.004, False), (0.0075, False), (0.009, True), (0.02, True)])
def test_a_sheet_too_low_for_the_pads_is_no_grasp(height, found):
    assert bool(find_grasps(Scene(objects=(bar("card", (0.05, 0.05, height)),)), "card", GRIPPER)) == found


def test_a_sheet_is_refused_for_its_height_and_a_block_for_its_width():
    pytest.importorskip("robosuite")
    from pat3d.envs.grasping.placement import Needs, place
    from pat3d.errors import TaskError

    for size, said in (((0.05, 0.05, 0.004), "is 4 mm high"), ((0.1, 0.12, 0.1), "100 mm wide")):
        with pytest.raises(TaskError, match=said):
            place(Scene(objects=(bar("thing", size),)), "Panda", Needs(grasp=("thing",)))


def test_something_thinner_than_the_closed_gripper_slips_through():
    from dataclasses import replace

    scene = Scene(objects=(bar("plate", (0.1, 0.006, 0.05)),))
    assert find_grasps(scene, "plate", GRIPPER)
    assert not find_grasps(scene, "plate", replace(GRIPPER, closed=0.02))


def test_the_narrowest_width_of_a_turned_bar_is_its_thickness():
    assert narrowest(bar("bar", (0.2, 0.03, 0.05), yaw=0.7)) == pytest.approx(0.03, rel=2e-2)


def test_inverse_kinematics_reaches_what_forward_kinematics_left():
    pytest.importorskip("robosuite")
    from pat3d.envs.robots.arms import arm_kinematics

    arm, random = arm_kinematics("Panda"), np.random.default_rng(0)
    solved = 0
    for _ in range(20):
        joints = arm.robot.home + random.uniform(-0.4, 0.4, 7)
        position, rotation = arm.hand(joints)
        found = arm.solve(position, rotation)
        if found is None:
            continue
        solved += 1
        at, turned = arm.hand(found)
        assert np.linalg.norm(at - position) < 2e-3
        assert math.acos(min(1.0, (np.trace(turned @ rotation.T) - 1) / 2)) < 0.021
    assert solved >= 18
    assert arm.solve(np.array([1.5, 0.0, 0.3]), np.diag([1.0, -1.0, -1.0])) is None
