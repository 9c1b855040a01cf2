"""Truth tables read by a person: does the relation hold in this arrangement?"""

import numpy as np
import pytest

from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.layout.predicates import check_relations, relation_holds
from pat3d.scene.model import GROUND, Attachment, Relation
from tests.layout.things import ball, block, table, tree_with_branch, vessel

ASSETS = {
    "a": block(0.1, 0.1, 0.1),
    "b": block(0.1, 0.1, 0.1),
    "c": block(0.1, 0.1, 0.1),
    "sofa": block(2.0, 0.9, 0.8),
    "table": table(),
    "bowl": vessel(0.15, 0.1),
    "apple 1": ball(0.035),
    "apple 2": ball(0.035),
    "tree": tree_with_branch(),
}


def at(**positions):
    return {name.replace("_", " "): Pose(position=position) for name, position in positions.items()}


def holds(child, kind, parent, poses):
    return relation_holds(Relation(child=child, kind=kind, parent=parent), ASSETS, poses)


@pytest.mark.parametrize(
    ("case", "poses", "expected"),
    [
        ("resting on the middle", at(a=(0, 0, 0.10005), b=(0, 0, 0)), True),
        ("over the edge, centre still above", at(a=(0.04, 0, 0.10005), b=(0, 0, 0)), True),
        ("over the edge, centre beside", at(a=(0.06, 0, 0.10005), b=(0, 0, 0)), False),
        ("floating 3 cm above", at(a=(0, 0, 0.13), b=(0, 0, 0)), False),
        ("standing beside", at(a=(0.1005, 0, 0), b=(0, 0, 0)), False),
        ("underneath", at(a=(0, 0, 0), b=(0, 0, 0.10005)), False),
        ("carried through c", at(a=(0, 0, 0.2001), b=(0, 0, 0), c=(0, 0, 0.10005)), True),
        ("above c with air between", at(a=(0, 0, 0.25), b=(0, 0, 0), c=(0, 0, 0.10005)), False),
    ],
)
def test_on(case, poses, expected):
    assert holds("a", "on", "b", poses) is expected, case


def test_a_thing_leaning_on_a_table_leg_is_not_on_the_table():
    poses = at(table=(0, 0, 0), a=(0.56 - 0.025 - 0.0505, 0.36, 0))
    assert not holds("a", "on", "table", poses)


@pytest.mark.parametrize(
    ("case", "poses", "expected"),
    [
        ("on the floor of the bowl", at(bowl=(0, 0, 0), apple_1=(0, 0, 0.0062)), True),
        ("beside the bowl", at(bowl=(0, 0, 0), apple_1=(0.2, 0, 0)), False),
        ("balanced on the rim", at(bowl=(0, 0, 0), apple_1=(0.147, 0, 0.1002)), False),
        ("floating inside", at(bowl=(0, 0, 0), apple_1=(0, 0, 0.03)), False),
        (
            "on an apple inside",
            at(bowl=(0, 0, 0), apple_2=(0, 0, 0.0062), apple_1=(0, 0, 0.0062 + 0.07)),
            True,
        ),
    ],
)
def test_in(case, poses, expected):
    # Circumscribed balls touch at a vertex or a face: measure, then allow for it.
    result = check_relations((Relation(child="apple 1", kind="in", parent="bowl"),), ASSETS, poses, touch=0.004)[0]
    assert result.holds is expected, (case, result.detail)


@pytest.mark.parametrize(
    ("case", "kind", "offset", "expected"),
    [
        ("clearly left", "left_of", (-0.3, 0, 0), True),
        ("clearly right is not left", "left_of", (0.3, 0, 0), False),
        ("clearly right", "right_of", (0.3, 0, 0), True),
        ("left and a little behind", "left_of", (-0.3, 0.2, 0), True),
        ("far behind, slightly left", "left_of", (-0.12, 1.0, 0), False),
        ("far left, slightly behind", "behind", (-1.0, 0.12, 0), False),
        ("nearer to the viewer", "in_front_of", (0, -0.3, 0), True),
        ("away from the viewer", "in_front_of", (0, 0.3, 0), False),
        ("away from the viewer", "behind", (0, 0.3, 0), True),
        ("beside is not in front", "in_front_of", (0.3, -0.01, 0), False),
        ("straight above is not left", "left_of", (0, 0, 0.3), False),
        ("left, on something higher", "left_of", (-0.3, 0, 0.2), True),
    ],
)
def test_sides(case, kind, offset, expected):
    poses = {"a": Pose(position=offset), "b": Pose()}
    assert holds("a", kind, "b", poses) is expected, case


def test_a_cushion_in_front_of_the_left_half_of_a_sofa_is_in_front_and_not_left():
    poses = {"sofa": Pose(), "a": Pose(position=(-0.6, -0.8, 0))}
    assert holds("a", "in_front_of", "sofa", poses)
    assert not holds("a", "left_of", "sofa", poses)


@pytest.mark.parametrize(
    ("case", "offset", "expected"),
    [
        ("5 cm apart", (0.15, 0, 0), True),
        ("5 cm apart, behind", (0, 0.15, 0), True),
        ("a metre apart", (1.1, 0, 0), False),
        ("on top", (0, 0, 0.1), False),
        ("on a shelf a metre higher", (0.15, 0, 1.1), False),
    ],
)
def test_next_to(case, offset, expected):
    poses = {"a": Pose(position=offset), "b": Pose()}
    assert holds("a", "next_to", "b", poses) is expected, case


def test_next_to_scales_with_furniture():
    poses = {"sofa": Pose(), "a": Pose(position=(1.0 + 0.05 + 0.6, 0, 0))}
    assert holds("a", "next_to", "sofa", poses)


def test_around_needs_all_sides():
    relations = tuple(Relation(child=name, kind="around", parent="bowl") for name in "abc")
    ring = {
        name: Pose(position=(0.25 * np.cos(angle), 0.25 * np.sin(angle), 0))
        for name, angle in zip("abc", np.radians([90, 210, 330]), strict=True)
    }
    row = {name: Pose(position=(0.12 * k, -0.25, 0)) for k, name in zip((-1, 0, 1), "abc", strict=True)}
    for offset in np.array([[0.0, 0.0, 0.0], [3.0, -2.0, 0.0]]):
        for poses, expected in ((ring, True), (row, False)):
            there = {name: Pose(position=tuple(pose.position + offset)) for name, pose in poses.items()}
            verdicts = check_relations(relations, ASSETS, {**there, "bowl": Pose(position=tuple(offset))})
            assert {verdict.holds for verdict in verdicts} == {expected}


def test_hanging_needs_contact_below_the_top_and_air_below():
    under = {"tree": Pose(), "a": Pose(position=(0.8, 0, 2.2995))}
    assert holds("a", "hangs_from", "tree", under)
    assert not holds("a", "hangs_from", "tree", {**under, "a": Pose(position=(0.8, 0, 2.2))})
    assert not holds("a", "hangs_from", "tree", {**under, "a": Pose(position=(0.8, 0, 2.5205))})


HUNG = {"tree": Pose(), "a": Pose(position=(0.8, 0, 2.2))}
ROPE = ((0.0, 0.0, 0.1), (0.8, 0.0, 2.3))
"""From the top of "a" to just below the branch."""


@pytest.mark.parametrize(
    ("case", "moved", "expected"),
    [
        ("hanging free", {}, True),
        ("within a millimetre", {"a": Pose(position=(0.8, 0, 2.1993))}, True),
        ("torn off", {"a": Pose(position=(0.8, 0, 2.19))}, False),
        ("standing on its head above the anchor", {"a": Pose(position=(0.8, 0, 2.4), quat_wxyz=(0, 1, 0, 0))}, False),
        ("standing on b", {"b": Pose(position=(0.8, 0, 2.0995))}, False),
        ("carrying c", {"c": Pose(position=(0.8, 0.08, 2.3003))}, True),
        ("beside b, not touching", {"b": Pose(position=(0.91, 0, 2.2))}, True),
    ],
)
def test_hanging_by_an_attachment(case, moved, expected):
    poses = {**HUNG, **moved}
    attachment = Attachment(child="a", parent="tree", anchors=(ROPE,))
    relations = (Relation(child="a", kind="hangs_from", parent="tree"), Relation(child="c", kind="on", parent="a"))
    result = check_relations(relations[: 1 + ("c" in poses)], ASSETS, poses, attachments=(attachment,))[0]
    assert result.holds is expected, (case, result.detail)


def test_an_attached_thing_that_leans_on_the_trunk_does_not_hang_free():
    """The block's side is against the trunk, half a metre from where its long rope is tied."""
    post = {"tree": Pose(), "a": Pose(position=(-0.5495, 0.0, 1.5))}
    attachment = Attachment(child="a", parent="tree", anchors=(((0.3, 0.0, 0.8), (-0.2495, 0.0, 2.3)),))
    trunk = ASSETS["tree"].parts[0].vertices[:, 0]
    x = float(trunk.max()) + 0.0505
    leaning = {"tree": Pose(), "a": Pose(position=(x, 0, 1.5))}
    tied = Attachment(child="a", parent="tree", anchors=(((0.0, 0.0, 0.8), (x, 0.0, 2.3)),))
    relation = Relation(child="a", kind="hangs_from", parent="tree")
    assert relation_holds(relation, ASSETS, {**leaning, "a": Pose(position=(x + 0.01, 0, 1.5))}, touch=0.02) is False
    assert not relation_holds(relation, ASSETS, leaning, attachments=(tied,))
    assert relation_holds(relation, ASSETS, post, attachments=(attachment,))


def test_on_the_ground_is_measured():
    result = check_relations((Relation(child="a", kind="on", parent=GROUND),), ASSETS, at(a=(0, 0, 0.00002)))[0]
    assert result.holds
    assert result.detail == "0.02 mm above the ground"


def test_details_say_what_was_measured():
    poses = at(a=(0, 0, 0.10002), b=(0, 0, 0))
    detail = check_relations((Relation(child="a", kind="on", parent="b"),), ASSETS, poses)[0].detail
    assert detail == "gap 0.02 mm, centre inside the footprint"


def test_a_relation_without_pose_is_refused():
    with pytest.raises(SpecError, match="has no pose"):
        relation_holds(Relation(child="a", kind="on", parent="b"), ASSETS, {"a": Pose()})
