import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import (
    about,
    frame_along,
    matrix_of,
    principal_frame,
    quat_of,
    rotation_vector,
    turn,
    yaw_matrix,
    yaw_of,
    yaw_quat,
)  # fmt: skip


@pytest.mark.parametrize("rotation", list(Rotation.random(5, random_state=np.random.default_rng(0))))
def test_matrix_quaternion_and_vector_are_one_rotation(rotation):
    matrix = rotation.as_matrix()
    np.testing.assert_allclose(matrix_of(quat_of(matrix)), matrix, atol=1e-15)
    assert abs(np.dot(quat_of(matrix), rotation.as_quat(scalar_first=True))) == pytest.approx(1.0)
    vector = rotation_vector(matrix)
    np.testing.assert_allclose(turn(vector, float(np.linalg.norm(vector))), matrix, atol=1e-14)


def test_a_quarter_turn_takes_each_axis_to_the_next():
    x, y, z = np.eye(3)
    np.testing.assert_allclose(about("x", math.pi / 2) @ y, z, atol=1e-15)
    np.testing.assert_allclose(about("y", math.pi / 2) @ z, x, atol=1e-15)
    np.testing.assert_allclose(about("z", math.pi / 2) @ x, y, atol=1e-15)
    np.testing.assert_allclose(yaw_matrix(math.pi / 2) @ x, y, atol=1e-15)
    np.testing.assert_allclose(matrix_of(yaw_quat(0.7)), yaw_matrix(0.7), atol=1e-15)
    assert yaw_of(yaw_matrix(-2.0)) == pytest.approx(-2.0)
    assert (turn(np.zeros(3), 1.0) == np.eye(3)).all()


@pytest.mark.parametrize("direction", [(1.0, 0.0, 0.0), (0.0, 0.0, -1.0), (0.6, 0.0, 0.8), (-0.95, 0.0, 0.3122499)])
def test_a_frame_along_a_direction_is_a_rotation_with_it_as_z(direction):
    along = np.array(direction) / np.linalg.norm(direction)
    frame = frame_along(along)
    np.testing.assert_allclose(frame[:, 2], along, atol=1e-15)
    np.testing.assert_allclose(frame.T @ frame, np.eye(3), atol=1e-14)
    assert np.linalg.det(frame) == pytest.approx(1.0)


def test_principal_moments_and_axes_give_the_inertia_back():
    rng = np.random.default_rng(1)
    for _ in range(10):
        root = rng.normal(size=(3, 3))
        inertia = root @ root.T
        moments, quat = principal_frame(inertia)
        axes = matrix_of(quat)
        assert np.linalg.det(axes) == pytest.approx(1.0)
        np.testing.assert_allclose(axes @ np.diag(moments) @ axes.T, inertia, atol=1e-12)


def test_a_quaternion_of_another_length_is_no_pose():
    with pytest.raises(SpecError, match="norm 2"):
        Pose(quat_wxyz=(2.0, 0.0, 0.0, 0.0))
    nearly = Pose(quat_wxyz=(1.0 + 1e-9, 0.0, 0.0, 0.0))
    assert nearly.quat_wxyz == (1.0, 0.0, 0.0, 0.0)
