"""The fixed cameras show the robot and its work as near as they can, and every link of a robot is drawn."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.envs.env import TabletopEnv
from pat3d.envs.physics.views import DRAWN_GROUPS
from pat3d.envs.physics.world import ROBOT
from pat3d.envs.rendering.pictures import Pictures
from pat3d.envs.suites.sight import shares
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.rehearsal import workplace
from pat3d.exporters.mjcf.writer import write_mjcf
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

SIDE = 128


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A robot file of one's own."""
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.mark.parametrize("count", [1, 2])
def test_the_work_and_the_hands_or_everything_and_the_whole_robot_are_in_a_square_picture(arm, count):
    """No pixel of the agent's task is on the picture's edge, nor one of any object or the robot on the front camera's.

    The pedestal may be, and of what the task is not about the agent's camera shows the middle.
    """
    env = TabletopEnv(robot=[arm] * count, task="pick:red mug")
    env.reset(seed=0)
    for camera in ("agentview", "frontview"):
        labels = env.pictures.take(camera, SIDE, SIDE, segmentation=True).segmentation
        assert labels is not None
        robot = labels == 1
        assert robot.any()
        if camera == "frontview":
            assert not robot[0].any()
            assert not robot[:, [0, -1]].any()
        model, data = env.simulation.model, env.simulation.data
        view = model.camera(camera).id
        tips = [data.site(one.prefix + one.robot.grip_site).xpos for one in env.simulation.world.arms]
        middles = [obj.pose.apply(obj.asset.visual.bounds).mean(axis=0) for obj in env.scene.objects]
        for point in (*tips, *middles):
            right, up, ahead = data.cam_xmat[view].reshape(3, 3).T @ (point - data.cam_xpos[view])
            half = -ahead * np.tan(np.radians(model.cam_fovy[view] / 2))
            assert max(abs(right), abs(up)) < half
        assert set(np.unique(labels)) >= {1, *range(2, 2 + len(env.scene.objects))}
        for number, obj in enumerate(env.scene.objects):
            if camera == "agentview" and obj.name != "red mug":
                continue
            seen = labels == 2 + number
            assert not seen[[0, -1]].any()
            assert not seen[:, [0, -1]].any()
    env.close()


def test_cameras_are_no_farther_than_needed(arm):
    """What a camera has to show reaches the picture's edge, less the margin."""
    env = TabletopEnv(robot=arm, task="pick:red mug")
    env.reset(seed=0)
    labels = env.pictures.take("frontview", SIDE, SIDE, segmentation=True).segmentation
    assert labels is not None
    rows = np.flatnonzero((labels > 0).any(axis=1))
    # Boxes around round links are a little larger than the links.
    assert rows[0] < 0.12 * SIDE
    labels = env.pictures.take("agentview", SIDE, SIDE, segmentation=True).segmentation
    assert labels is not None
    objects = np.flatnonzero((labels > 1).any(axis=1))
    assert objects[-1] > 0.85 * SIDE
    env.close()


def test_what_is_beside_the_work_does_not_drive_the_agents_camera_away(tmp_path, arm):
    """A long tray is shown whole where the task names it, from farther off; else its middle is enough."""

    def share(task):
        scene = scene_of(
            placed("cube", asset_of(box(0.05, 0.05, 0.05)), (0.0, 0.0, GAP)),
            placed("tray", asset_of(box(0.7, 0.04, 0.02)), (0.0, 0.12, GAP)),
        )
        work = workplace(scene, write_mjcf(scene, tmp_path / task.replace(":", "-")), parse_task(task), arm)
        pictures = Pictures(work.simulation, "cpu")
        return shares(pictures, scene, "agentview", ("cube",))["cube"]

    assert share("pick:cube") > 1.5 * share("stack:cube:tray")


def test_links_that_have_nothing_but_what_collides_are_drawn(arm):
    env = TabletopEnv(robot=arm, task="pick:red mug")
    world = env.simulation.world
    model = world.model
    of_robot = (world.owner == ROBOT) & (model.geom_bodyid > 0)
    assert set(model.geom_bodyid[of_robot]) == set(model.geom_bodyid[of_robot & (model.geom_group < DRAWN_GROUPS)])
    env.close()


@pytest.mark.parametrize("task", ["place:green apple:blue bowl"])
def test_what_a_task_is_about_is_large_in_the_close_camera(arm, task):
    """Half a percent of the picture at least, more than the agent's camera shows of it, and nothing cut off."""
    env = TabletopEnv(robot=arm, task=task)
    env.reset(seed=0)
    names = [obj.name for obj in env.scene.objects]

    def shares(camera):
        labels = env.pictures.take(camera, SIDE, SIDE, segmentation=True).segmentation
        assert labels is not None
        return labels, {name: float((labels == 2 + names.index(name)).mean()) for name in task.split(":")[1:]}

    labels, close = shares("closeview")
    _, wide = shares("agentview")
    for name, share in close.items():
        assert share >= 0.005
        assert share > wide[name]
    target = labels == 2 + names.index(task.split(":")[1])
    assert not target[[0, -1]].any()
    assert not target[:, [0, -1]].any()
    env.close()
