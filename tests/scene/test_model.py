import numpy as np
import pytest

from pat3d.assets.shapes import box
from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Attachment, Relation, check_tree
from tests.scenes import asset_of, placed, scene_of


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


PAIR = ((0, 0, 1), (0, 0, 2))


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"child": "b"}, "itself"),
        ({"parent": "ground"}, "never the ground"),
        ({"anchors": ()}, "1 to 64 pairs"),
        ({"anchors": (((0, 0, 1), (0, 0)),)}, "1 to 64 pairs"),
        ({"anchors": (((0, 0, np.nan), (0, 0, 0)),)}, "finite"),
        ({"anchors": ("up", "down")}, "1 to 64 pairs"),
    ],
)
def test_attachments_without_meaning_are_refused(settings, message):
    with pytest.raises(SpecError, match=message):
        Attachment(**{"child": "a", "parent": "b", "anchors": (PAIR,), **settings})


def test_the_ends_of_an_attachment_follow_the_poses():
    attachment = Attachment(child="a", parent="b", anchors=(PAIR,))
    upside_down = Pose(position=(0, 0, 5), quat_wxyz=(0, 1, 0, 0))
    on_child, on_parent = attachment.ends(upside_down, Pose(position=(1, 0, 0)))
    np.testing.assert_allclose(on_child, [[0, 0, 4]])
    np.testing.assert_allclose(on_parent, [[1, 0, 2]])


def test_a_scene_attaches_what_is_in_it_and_once():
    block = asset_of(box(0.1, 0.1, 0.1))
    objects = (placed("a", block), placed("b", block, (0, 0, 1)))
    stray, twice = (
        Attachment(child="a", parent="moon", anchors=(PAIR,)),
        Attachment(child="b", parent="a", anchors=(PAIR,)),
    )
    with pytest.raises(SpecError, match="moon"):
        scene_of(*objects, attachments=(stray,))
    with pytest.raises(SpecError, match="attached twice"):
        scene_of(*objects, attachments=(Attachment(child="a", parent="b", anchors=(PAIR,)), twice))
