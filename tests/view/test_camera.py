import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from pat3d.errors import SpecError
from pat3d.view.camera import Camera, frame


@settings(max_examples=50, deadline=None)
@given(
    seed=st.integers(0, 1000),
    aspect=st.floats(0.4, 3.0),
    azimuth=st.floats(-180.0, 180.0),
    elevation=st.floats(-80.0, 80.0),
    scale=st.sampled_from([0.01, 0.3, 5.0]),
)
def test_framing_shows_every_point_and_fills_one_direction(seed, aspect, azimuth, elevation, scale):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(40, 3)) * scale + rng.normal(size=3)
    camera = frame(points, aspect=aspect, azimuth=azimuth, elevation=elevation, margin=0.1)
    height = 500.0
    width = aspect * height
    seen = camera.project(points, int(width), int(height)) / np.array([int(width), int(height)])
    assert seen.min() > 0.1 - 0.01
    assert seen.max() < 0.9 + 0.01
    if scale > 0.01:  # A small thing is kept at a distance instead.
        filled = seen.max(axis=0) - seen.min(axis=0)
        assert filled.max() == pytest.approx(0.8, abs=0.01)


def test_default_view_is_from_the_front_right_and_above():
    camera = frame(np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]))
    x, y, z = camera.position
    assert y < -1.0
    assert 0.0 < x < -y
    assert z > 1.0
    right, up, forward = camera.axes
    assert right[0] > 0.9
    assert up[2] > 0.9
    assert forward[1] > 0.8


def test_directions_and_projection_are_inverse():
    camera = Camera(position=(1.0, -2.0, 1.5), target=(0.1, 0.2, 0.3), field_of_view=40.0)
    x, y = np.array([0.5, 100.0, 333.3]), np.array([10.0, 119.5, 200.0])
    points = np.array(camera.position) + 2.5 * camera.directions(x, y, 400, 240)
    np.testing.assert_allclose(camera.project(points, 400, 240), np.stack([x, y], axis=1), atol=1e-3)


def test_camera_above_looks_straight_down_with_x_to_the_right():
    camera = Camera(position=(0.0, 0.0, 2.0), target=(0.0, 0.0, 0.0))
    np.testing.assert_allclose(camera.axes, [[1, 0, 0], [0, 1, 0], [0, 0, -1]], atol=1e-12)


@pytest.mark.parametrize("points", [np.zeros((0, 3)), np.array([[np.nan, 0.0, 0.0]])])
def test_framing_nothing_is_refused(points):
    with pytest.raises(SpecError, match="frame"):
        frame(points)


def test_framing_names_the_valid_ranges():
    with pytest.raises(SpecError, match="-89 to 89"):
        frame(np.eye(3), elevation=90.0)
    with pytest.raises(SpecError, match="1 to 120"):
        frame(np.eye(3), field_of_view=170.0)
