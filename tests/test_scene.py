import numpy as np
import pytest

from pat3d.errors import SpecError
from pat3d.scene import Pose, Relation, check_tree


def test_pose_matrix_matches_scipy():
    rng = np.random.default_rng(0)
    from scipy.spatial.transform import Rotation

    for _ in range(20):
        rotation = Rotation.random(random_state=rng)
        pose = Pose(quat_wxyz=tuple(rotation.as_quat(scalar_first=True)), position=(1, 2, 3))
        np.testing.assert_allclose(pose.rotation, rotation.as_matrix(), atol=1e-14)


def test_support_cycle_is_refused_with_its_path():
    relations = (Relation(child="a", kind="on", parent="b"), Relation(child="b", kind="in", parent="a"))
    with pytest.raises(SpecError, match="a -> b -> a"):
        check_tree(["a", "b"], relations)


def test_two_supports_are_refused():
    relations = (Relation(child="a", kind="on", parent="b"), Relation(child="a", kind="in", parent="c"))
    with pytest.raises(SpecError, match="two supports"):
        check_tree(["a", "b", "c"], relations)
