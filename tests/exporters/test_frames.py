import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from pat3d.exporters.common.frames import principal_axes, rotation_of, rpy_of, text

angles = st.floats(-np.pi, np.pi)


@settings(deadline=None)
@given(angles, st.sampled_from([0.0, 1e-12, 1e-9, 1e-5, 0.3]), st.sampled_from([-1, 1]), angles)
def test_roll_pitch_yaw_are_exact_up_to_the_pole(roll, off, sign, yaw):
    """Scipy builds the rotation; beside 90 degrees of pitch the angles are arbitrary but their product is not."""
    rotation = Rotation.from_euler("xyz", [roll, sign * (np.pi / 2 - off), yaw]).as_matrix()
    angles = rpy_of(rotation)
    np.testing.assert_allclose(rotation_of(*angles), rotation, atol=1e-15 * 8)
    np.testing.assert_allclose(Rotation.from_euler("xyz", angles).as_matrix(), rotation, atol=1e-15 * 8)


@settings(deadline=None)
@given(st.integers(0, 10_000))
def test_principal_axes_are_a_rotation_that_diagonalises_far_from_the_pole(seed):
    rng = np.random.default_rng(seed)
    frame = Rotation.random(random_state=rng).as_matrix()
    inertia = frame @ np.diag(10.0 ** rng.uniform(-9, 0, 3)) @ frame.T
    moments, axes = principal_axes(inertia)
    assert np.linalg.det(axes) == pytest.approx(1.0)
    np.testing.assert_allclose(axes @ np.diag(moments) @ axes.T, inertia, atol=1e-14 * np.abs(inertia).max())
    # The nearest of the 24 rotations is within about 63 degrees; its pitch never reaches the pole.
    assert np.degrees(np.arccos((np.trace(axes) - 1) / 2)) < 63
    assert abs(rpy_of(axes)[1]) < np.radians(70)


def test_numbers_read_back_exactly():
    values = np.random.default_rng(0).standard_normal(50) * 10.0 ** np.arange(-25, 25)
    assert [float(word) for word in text(*values).split()] == values.tolist()
