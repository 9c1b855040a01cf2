"""The camera of a photograph agrees with the renderer's, and with itself there and back."""

import math

import numpy as np
import pytest

from pat3d.errors import SpecError
from pat3d.view.camera import Camera
from pat3d.vision.camera import DrawnCamera, Pinhole, PlacedCamera
from tests.vision.seen import HEIGHT, WIDTH, camera_at

X, Y = np.array([0.5, 100.0, 319.5]), np.array([0.5, 200.0, 10.0])


def test_rays_are_those_of_the_renderers_camera():
    looking = Camera(position=(1.0, -2.0, 1.5), target=(0.1, 0.0, 0.1), field_of_view=45.0)
    placed = camera_at((1.0, -2.0, 1.5), (0.1, 0.0, 0.1))
    assert np.allclose(placed.rays(X, Y)[0], looking.directions(X, Y, WIDTH, HEIGHT), atol=1e-6)
    drawn = DrawnCamera(placed)
    assert np.allclose(drawn.axes, looking.axes)
    assert np.allclose(drawn.directions(X, Y, WIDTH, HEIGHT), looking.directions(X, Y, WIDTH, HEIGHT), atol=1e-6)


def test_a_point_on_a_ray_is_projected_to_where_the_ray_began():
    placed = camera_at((1.0, -2.0, 1.5), roll=20.0)
    rays, reach = placed.rays(X, Y)
    pixels, depths = placed.project(placed.position + 3.0 * reach[:, None] * rays)
    assert np.allclose(pixels, np.column_stack([X, Y]))
    assert np.allclose(depths, 3.0)


def test_the_renderer_draws_a_rolled_camera_rolled():
    """A camera turned clockwise sees the world turned the other way: what was on its right moves up."""
    level, rolled = (camera_at((0.0, -2.0, 1.0), roll=roll) for roll in (0.0, 30.0))
    beside = level.position + level.rotation @ [0.5, 0.0, 1.0]
    assert level.project(beside[None])[0][0, 1] == pytest.approx(HEIGHT / 2)
    assert rolled.project(beside[None])[0][0, 1] < HEIGHT / 2
    ray = DrawnCamera(rolled).directions([WIDTH / 2 + 100.0], [HEIGHT / 2], WIDTH, HEIGHT)[0]
    assert np.allclose(ray, rolled.rays([WIDTH / 2 + 100.0], [HEIGHT / 2])[0][0], atol=1e-6)


def test_an_angle_is_that_across_the_longer_side():
    pinhole = Pinhole.of_angle(640, 480, 90.0)
    assert pinhole.fx == pytest.approx(320.0)
    half = pinhole.resized(320, 240)
    assert math.degrees(2 * math.atan(half.width / 2 / half.fx)) == pytest.approx(90.0)


def test_a_mirrored_camera_is_refused():
    pinhole = Pinhole.of_angle(64, 48)
    with pytest.raises(SpecError, match="right-handed"):
        PlacedCamera(pinhole=pinhole, rotation=np.diag([1.0, 1.0, -1.0]), position=np.zeros(3))
    with pytest.raises(SpecError, match="focal lengths"):
        Pinhole(width=640, height=480, fx=1.0, fy=1.0, cx=320.0, cy=240.0)
