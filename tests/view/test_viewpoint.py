import numpy as np
import pytest

from pat3d.geometry.pose import Pose
from pat3d.view.camera import ELEVATION
from pat3d.view.render import frame_items
from pat3d.view.viewpoint import ELEVATIONS, ENOUGH, overlooking, share_seen
from tests.view.shapes import ball, block


def at(x, y, z):
    return Pose(position=(x, y, z), quat_wxyz=(1.0, 0.0, 0.0, 0.0))


BALL = (ball(radius=0.05, detail=2), at(0.0, 0.0, 0.05))


def walled(height):
    """The ball between four walls, 0.3 m apart."""
    along, across = block((0.3, 0.01, height)), block((0.01, 0.3, height))
    low = height / 2.0
    return [
        BALL,
        (along, at(0, -0.15, low)),
        (along, at(0, 0.15, low)),
        (across, at(-0.15, 0, low)),
        (across, at(0.15, 0, low)),
    ]


def elevation(camera):
    """Above the horizon [deg]."""
    toward = np.subtract(camera.position, camera.target)
    return np.degrees(np.arcsin(toward[2] / np.linalg.norm(toward)))


def test_what_stands_in_the_open_is_seen_whole_from_the_usual_camera():
    camera = overlooking([[BALL]], aspect=4 / 3)
    assert elevation(camera) == pytest.approx(ELEVATION)
    assert share_seen([BALL], camera)[0] == 1.0


@pytest.mark.parametrize(("height", "expected"), [(0.05, ELEVATIONS[0]), (0.2, ELEVATIONS[1]), (0.25, ELEVATIONS[2])])
def test_the_camera_rises_as_far_as_walls_demand(height, expected):
    items = walled(height)
    camera = overlooking([items], aspect=4 / 3)
    assert elevation(camera) == pytest.approx(expected)
    assert share_seen(items, camera)[0] >= ENOUGH
    lower = [e for e in ELEVATIONS if e < expected]
    assert all(share_seen(items, frame_items(items, elevation=e))[0] < ENOUGH for e in lower)


def test_what_no_camera_shows_leaves_the_usual_one():
    cover = (block((0.3, 0.3, 0.3)), at(0.0, 0.0, 0.15))
    camera = overlooking([[BALL, cover]], aspect=4 / 3)
    assert elevation(camera) == pytest.approx(ELEVATION)


def test_on_a_stage_the_things_fill_the_picture_and_not_the_stage():
    items = [(block((2.0, 2.0, 0.02)), at(0.0, 0.0, -0.01)), BALL]
    whole, near = (overlooking([items], aspect=4 / 3, stage=stage) for stage in (None, 0))
    mesh, pose = BALL
    width = [np.ptp(one.project(pose.apply(mesh.vertices), 800, 600)[:, 0]) for one in (whole, near)]
    assert width[1] > 2.0 * width[0]
    picture = near.project(pose.apply(mesh.vertices), 800, 600)
    assert (picture >= 0).all()
    assert (picture <= [800, 600]).all()
