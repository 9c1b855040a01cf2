"""Gravity and the camera's height from the ground, and from a table where no ground is seen."""

import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.vision.gravity import ground_plane, level_camera
from pat3d.vision.observation import Observation
from pat3d.vision.recover import recover
from tests.scenes import asset_of
from tests.vision.seen import camera_at, see

CUBE = asset_of(box(0.2, 0.2, 0.2))
TABLE = asset_of(box(3.0, 3.0, 0.7))


def off(plane, camera) -> float:
    """Angle [deg] between the plane's normal and the world's vertical."""
    return math.degrees(math.acos(min(1.0, float(plane.up @ camera.rotation[2]))))


@pytest.mark.parametrize(("position", "roll"), [((1.0, -2.0, 1.5), 0.0), ((-2.0, 1.0, 0.8), 15.0), ((0.2, 0.1, 2), 0)])
def test_the_ground_tells_gravity_and_height(position, roll):
    camera = camera_at(position, roll=roll)
    plane = ground_plane(see({"cube": (CUBE, Pose(position=(0.0, 0.0, 0.0)))}, camera))
    assert plane is not None
    assert off(plane, camera) < 0.01
    assert plane.height == pytest.approx(position[2], rel=1e-5)


def test_noise_and_things_that_nobody_labelled_hardly_tilt_the_ground():
    camera = camera_at((1.0, -2.0, 1.5))
    seen = see({"cube": (CUBE, Pose()), "other": (CUBE, Pose(position=(0.5, 0.3, 0.0)))}, camera)
    rng = np.random.default_rng(0)
    depth = seen.depth * (1.0 + 0.05 * rng.normal(size=seen.depth.shape)).astype(np.float32)
    instances = np.where(seen.instances == 2, 0, seen.instances)
    noisy = Observation(camera=seen.camera, depth=depth, instances=instances, names=("cube",))
    assert noisy.noise == pytest.approx(0.05, rel=0.15)
    plane = ground_plane(noisy)
    assert plane is not None
    assert off(plane, camera) < 0.5
    assert plane.height == pytest.approx(1.5, rel=0.01)


def test_a_wall_is_no_ground():
    """A wall that fills the picture behind the object is a plane too, but not one that anything stands on."""
    camera = camera_at((0.0, -2.0, 0.3), (0.0, 0.0, 0.25))
    seen = see({"cube": (CUBE, Pose())}, camera)
    pinhole = seen.camera
    rows, columns = np.mgrid[: pinhole.height, : pinhole.width] + 0.5
    rays, reach = camera.rays(columns.ravel(), rows.ravel())
    wall = ((1.0 - camera.position[1]) / rays[:, 1] / reach).reshape(rows.shape)
    depth = np.where(seen.instances == 0, wall, seen.depth).astype(np.float32)
    assert ground_plane(replace(seen, depth=depth)) is None
    with pytest.raises(LayoutError, match="what is level"):
        recover(replace(seen, depth=depth), {"cube": CUBE})


def test_a_table_tells_gravity_where_no_ground_is_seen():
    camera = camera_at((0.3, -0.8, 1.9), (0.0, 0.0, 0.75), angle=35.0)
    placed = {"table": (TABLE, Pose()), "cube": (CUBE, Pose.from_yaw(0.4, (0.1, 0.0, 0.7)))}
    seen = see(placed, camera)
    assert (seen.instances > 0).all()
    found = recover(seen, {"table": TABLE, "cube": CUBE})
    assert found.camera.position[2] == pytest.approx(1.9, abs=0.01)
    assert any("ground is not seen" in note for note in found.notes)
    assert [str(one) for one in found.relations] == ["cube on table"]


def test_the_frame_has_the_viewer_in_front_and_the_objects_at_the_origin():
    camera = camera_at((2.0, 1.0, 1.5))
    seen = see({"cube": (CUBE, Pose())}, camera)
    plane = ground_plane(seen)
    assert plane is not None
    found = level_camera(seen, plane)
    assert found.position[1] < -1.0
    assert abs(found.position[0]) < 0.1
    assert found.rotation[0, 2] == pytest.approx(0.0, abs=1e-9)
    assert np.linalg.det(found.rotation) == pytest.approx(1.0)
