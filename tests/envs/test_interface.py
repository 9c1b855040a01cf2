"""What is said of actions, observations and cameras is what they do."""

from __future__ import annotations

import json

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.env import TabletopEnv
from pat3d.envs.interface import describe
from pat3d.geometry.pose import Pose
from tests.envs.own_arm import own_arm

SIDE = 256


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture(scope="module")
def env(arm):
    made = TabletopEnv(robot=arm, task="pick:red mug", image_size=(SIDE, SIDE))
    made.reset(seed=0)
    yield made
    made.close()


def site(env, name):
    """Orientation and place of a site of the robot."""
    found = env.simulation.data.site(f"robot/pat3d/{name}")
    return found.xmat.reshape(3, 3).copy(), found.xpos.copy()


def test_it_is_json_with_the_observations_that_the_environment_gives(env, arm):
    told = json.loads(json.dumps(describe(env)))
    assert set(told["observation"]["state"]) == set(env.observation_space.spaces)
    pictured = TabletopEnv(robot=arm, task="pick:red mug", obs="rgbd")
    for name, space in pictured.observation_space.spaces.items():
        shape = [SIDE, SIDE, *space.shape[2:]] if name.endswith(("_image", "_depth")) else list(space.shape)
        said = told["observation"]["rgbd"][name]
        assert (said["shape"], said["dtype"]) == (shape, str(space.dtype))
    pictured.close()


@pytest.mark.parametrize("camera", ["agentview", "frontview", "closeview", "wrist"])
def test_a_camera_s_intrinsics_and_pose_say_where_in_the_picture_a_point_is(env, camera):
    """The silhouette of an object that nothing hides is where its outermost points are projected."""
    env.reset(seed=0)
    told = describe(env)["cameras"][camera]
    axes, origin = site(env, {"base": "base", "hand": "grip"}[told["frame"]])
    pose = Pose(position=tuple(told["position"]), quat_wxyz=tuple(told["quat_wxyz"]))
    names = [obj.name for obj in env.scene.objects]
    labels = env.pictures.take(camera, SIDE, SIDE, segmentation=True).segmentation
    for name in ("banana", "red mug"):
        rows, columns = np.nonzero(labels == 2 + names.index(name))
        # What is cut by the picture's edge has its middle elsewhere.
        if not len(rows) or {rows.min(), columns.min()} & {0} or {rows.max(), columns.max()} & {SIDE - 1}:
            continue
        obj = env.scene[name]
        world = obj.pose.apply(np.asarray(obj.asset.visual.vertices).reshape(-1, 3))
        seen = pose.rotation.T @ (axes.T @ (world - origin).T - np.array(told["position"])[:, None])
        x, y, depth = np.array(told["intrinsics"]) @ seen
        assert (seen[2] > 0).all()
        assert (x / depth).min() == pytest.approx(columns.min(), abs=2.0)
        assert (x / depth).max() == pytest.approx(columns.max() + 1, abs=2.0)
        assert (y / depth).min() == pytest.approx(rows.min(), abs=2.0)
        return
    assert camera == "wrist"


def test_an_action_moves_the_hand_as_it_is_said_to(env):
    """Half a second of a tenth of the largest change, along every axis of the base."""
    position, rotation, gripper = describe(env)["action"]["parts"]
    assert (position["slice"], rotation["slice"], gripper["slice"]) == ([0, 3], [3, 6], [6, 7])
    for axis in range(3):
        env.reset(seed=1)
        base, _ = site(env, "base")
        _, before = site(env, "grip")
        action = np.zeros(7)
        action[axis] = 0.1
        for _ in range(10):
            env.step(action)
        moved = base.T @ (site(env, "grip")[1] - before)
        assert moved[axis] > 0.9 * np.linalg.norm(moved)
        # Every change is from where the hand is by then, which follows its goals with some delay.
        assert 0.2 * 10 * 0.1 * position["scale"] < moved[axis] < 10 * 0.1 * position["scale"]


def test_positive_values_close_the_gripper(env):
    gripper = describe(env)["action"]["parts"][-1]
    opening = {}
    for word in ("open", "closed"):
        env.reset(seed=0)
        for _ in range(15):
            observation, *_ = env.step(np.append(np.zeros(6), gripper[word]))
        opening[word] = float(np.abs(observation["gripper_pos"]).sum())
    assert opening["open"] > opening["closed"] + 0.02


def test_two_arms_have_their_parts_one_after_the_other(arm):
    env = TabletopEnv(robot=[arm, arm], task="pick:red mug")
    told = describe(env)
    assert [(part["arm"], part["name"], part["slice"]) for part in told["action"]["parts"]] == [
        ("left", "position", [0, 3]),
        ("left", "rotation", [3, 6]),
        ("left", "gripper", [6, 7]),
        ("right", "position", [7, 10]),
        ("right", "rotation", [10, 13]),
        ("right", "gripper", [13, 14]),
    ]
    assert {name: one["arm"] for name, one in told["cameras"].items() if "wrist" in name} == {
        "left_wrist": "left",
        "right_wrist": "right",
    }
    env.close()


@pytest.mark.parametrize("control", ["joint_velocity", "joint_position"])
def test_joints_have_a_scale_each(arm, control):
    env = TabletopEnv(robot=arm, task="pick:red mug", control=control)
    joints, gripper = describe(env)["action"]["parts"]
    assert (joints["slice"], gripper["slice"]) == ([0, 7], [7, 8])
    assert joints["scale"] == {"joint_velocity": 0.5, "joint_position": 0.05}[control]
    env.close()
