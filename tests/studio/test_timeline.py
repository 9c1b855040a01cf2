"""The motion of settling as it is played: recorded frames become poses, and damaged recordings are none."""

import json

import numpy as np
import pytest

from pat3d.geometry.pose import Pose
from pat3d.scene.folder import read_trajectory, write_trajectory
from pat3d.studio.session import Session
from pat3d.studio.timeline import MAX_FRAMES, losses, timeline_of
from tests.studio.bricks import bricks_in

NAMES = ("board", "brick", "block")
CENTRES = np.array([[0.0, 0.0, 0.01], [0.0, 0.0, 0.02], [0.01, 0.0, 0.02]])


@pytest.fixture
def folder(tmp_path):
    return bricks_in(tmp_path / "bricks")


def states(frames):
    """Objects that come down from 1 cm per frame, the block turned by 0.1 rad about the vertical per frame."""
    made = np.zeros((frames, 3, 4, 3))
    made[:, :, 1:] = np.eye(3)
    for frame in range(frames):
        left = frames - 1 - frame
        made[frame, :, 0] = CENTRES + (0.0, 0.0, 0.01 * left)
        pose = Pose.from_yaw(0.1 * left, (0.0, 0.0, 0.0))
        # Rows of a state are the columns of its linear map, a little stretched.
        made[frame, 2, 1:] = 1.0001 * pose.rotation.T
        made[frame, 2, 0] = pose.rotation @ CENTRES[2] + (0.0, 0.0, 0.01 * left)
    return made.astype(np.float32)


def test_frames_are_poses_and_the_last_one_is_the_rest(folder):
    write_trajectory(folder / "trajectory.npz", NAMES, states(5), CENTRES, 0.03)
    found = timeline_of(Session.opened(folder))
    assert found is not None
    assert len(found) == 5
    first = found.poses(0)
    assert first["board"].position == pytest.approx((0.0, 0.0, 0.04), abs=1e-7)
    assert first["block"].position == pytest.approx((0.0, 0.0, 0.04), abs=1e-7)
    np.testing.assert_allclose(first["block"].rotation, Pose.from_yaw(0.4, (0, 0, 0)).rotation, atol=1e-7)
    np.testing.assert_allclose(found.farthest()[:2], [40.0, 30.0], rtol=0.02)
    assert found.farthest()[-1] == 0.0


def test_a_long_recording_is_thinned_and_keeps_its_end(folder):
    write_trajectory(folder / "trajectory.npz", NAMES, states(2 * MAX_FRAMES + 1), CENTRES, 0.03)
    found = timeline_of(Session.opened(folder))
    assert found is not None
    assert len(found) <= MAX_FRAMES
    assert found.poses(len(found) - 1)["board"].position == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)


@pytest.mark.parametrize("wrong", ["names", "shape", "nan", "junk", "absent"])
def test_a_recording_that_does_not_fit_is_none(folder, wrong):
    names, made = NAMES, states(4)
    if wrong == "names":
        names = ("board", "brick", "vase")
    if wrong == "shape":
        made = made[:, :2]
    if wrong == "nan":
        made[1] = np.nan
    file = folder / "trajectory.npz"
    write_trajectory(file, names, made, CENTRES, 0.03)
    if wrong == "junk":
        file.write_bytes(b"PK junk")
    if wrong == "absent":
        file.unlink()
    assert timeline_of(Session.opened(folder)) is None


def test_an_edit_has_the_motion_of_its_own_settling(folder):
    session = Session.opened(folder).edited("move", "brick: 2 cm left")
    assert timeline_of(session) is None
    settled = session.settled()
    found = timeline_of(settled)
    assert found is not None
    assert read_trajectory(folder / "trajectory.npz") is None
    for name, pose in found.poses(len(found) - 1).items():
        assert pose.position == pytest.approx(settled.scene[name].pose.position, abs=1e-6)


def test_losses_of_an_optimisation_are_read_and_damaged_ones_left_out(folder):
    history = [{"loss": 0.5}, {"loss": 0.25}, {"loss": None}, "x"]
    (folder / "report.json").write_text(json.dumps({"optimisation": {"history": history}}))
    assert losses(Session.opened(folder)) == [(0, 0.5), (1, 0.25)]
    (folder / "report.json").write_text(json.dumps({"optimisation": None}))
    assert losses(Session.opened(folder)) == []
