import numpy as np
import pytest
import torch
from hypothesis import given, settings
from hypothesis import strategies as st

from pat3d.errors import SpecError
from pat3d.geometry.pose import Pose
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_relations
from pat3d.optimize.loss import SemanticLoss, outside_parent, states
from pat3d.optimize.outline import Box
from pat3d.scene.model import Relation
from tests.layout.things import ball, block, mug, pen, table, vessel

LATERALS = ("left_of", "right_of", "in_front_of", "behind", "next_to")


def rel(child: str, kind: str, parent: str) -> Relation:
    return Relation(child=child, kind=kind, parent=parent)  # type: ignore[arg-type]


def crowded():
    """Things on a table with every kind of relation between them."""
    assets = {
        "table": table(),
        "bowl": vessel(0.1, 0.08),
        "ball": ball(),
        "mug": mug(),
        "pen": pen(),
        "a": block(),
        "b": block(),
        "c": block(0.1, 0.04, 0.03),
        "d": block(),
        "e": block(0.04, 0.04, 0.04),
    }
    on = ("bowl", "mug", "a", "b", "c", "d")
    relations = (
        *(rel(name, "on", "table") for name in on),
        rel("ball", "in", "bowl"),
        rel("pen", "in", "mug"),
        rel("e", "on", "a"),
        rel("a", "left_of", "bowl"),
        rel("b", "around", "bowl"),
        rel("c", "around", "bowl"),
        rel("d", "around", "bowl"),
        rel("mug", "behind", "a"),
    )
    return assets, relations


@pytest.mark.parametrize("seed", range(3))
def test_loss_of_a_layout_that_satisfies_everything_is_exactly_zero(seed):
    assets, relations = crowded()
    poses = arrange(assets, relations, seed=seed).poses
    terms = SemanticLoss(assets, relations, poses).terms(states(assets, poses))
    assert {str(relation): float(value) for relation, value in terms.items() if value != 0.0} == {}


def test_corners_outside_the_parent_cost_their_mean_squared_distance():
    """A box of the parent's size, moved by s along x: four of its eight corners are s outside."""
    corners = torch.tensor([[x, y, z] for x in (-0.1, 0.1) for y in (-0.1, 0.1) for z in (0.0, 0.1)]).double()
    parent = Box(torch.tensor([-0.1, -0.1, -0.2]).double(), torch.tensor([0.1, 0.1, 0.0]).double())
    shift = torch.tensor([0.03, 0.0, 0.0]).double()
    assert float(outside_parent(corners + shift, parent)) == pytest.approx(0.03**2 / 2, rel=1e-4)
    # Twice as wide, it may cover the parent, and only what it lacks of that counts.
    assert float(outside_parent(2 * corners + shift, parent)) == 0.0
    wide = outside_parent(2 * corners + torch.tensor([0.13, 0.0, 0.0]).double(), parent)
    assert float(wide) == pytest.approx(0.03**2 / 2, rel=1e-4)


def test_gradient_is_that_of_central_differences_for_every_relation():
    assets, relations = crowded()
    poses = arrange(assets, relations, seed=0).poses
    loss = SemanticLoss(assets, relations, poses)
    rng = np.random.default_rng(0)
    for _ in range(6):
        spread = np.array([0.3, 0.3, 0.1, *[0.2] * 9])
        q = states(assets, poses) + torch.from_numpy(spread * rng.normal(size=(len(assets), 12)))
        q.requires_grad_()
        loss(q).backward()
        direction = torch.from_numpy(rng.normal(size=q.shape))
        h = 1e-6
        with torch.no_grad():
            numeric = float(loss(q + h * direction) - loss(q - h * direction)) / (2 * h)
        assert q.grad is not None
        assert float((q.grad * direction).sum()) == pytest.approx(numeric, rel=1e-5, abs=1e-7)


def test_worlds_are_independent():
    assets, relations = crowded()
    poses = arrange(assets, relations, seed=0).poses
    loss = SemanticLoss(assets, relations, poses)
    rng = np.random.default_rng(1)
    q = states(assets, poses) + torch.from_numpy(0.1 * rng.normal(size=(3, 2, len(assets), 12)))
    together = loss(q)
    assert together.shape == (3, 2)
    torch.testing.assert_close(together[1, 1], loss(q[1, 1]))


@settings(max_examples=150, deadline=None)
@given(
    kind=st.sampled_from(LATERALS),
    x=st.floats(-1.0, 1.0),
    y=st.floats(-1.0, 1.0),
    yaw=st.floats(-3.0, 3.0),
    lift=st.sampled_from([0.0, 0.05, 0.15, 0.3]),
)
def test_lateral_loss_is_positive_where_the_predicate_fails_and_zero_where_it_holds_clearly(kind, x, y, yaw, lift):
    assets = {"child": block(0.12, 0.05, 0.04), "parent": block(0.2, 0.1, 0.1)}
    relations = (rel("child", kind, "parent"),)
    poses = {"child": Pose.from_yaw(yaw, (x, y, lift)), "parent": Pose()}
    holds = check_relations(relations, assets, poses)[0].holds
    q = states(assets, poses)
    value = float(SemanticLoss(assets, relations, poses)(q))
    if not holds:
        assert value > 0.0
    elif value > 0.0:
        # Within the margin of failing: the residual is at most the margin of each of three conditions.
        assert value <= 3 * 1e-3**2 + 1e-12


@settings(max_examples=100, deadline=None)
@given(x=st.floats(-0.2, 0.2), y=st.floats(-0.2, 0.2), yaw=st.floats(-3.0, 3.0))
def test_a_child_off_its_parent_has_a_loss(x, y, yaw):
    assets = {"child": block(0.06, 0.1, 0.05), "parent": block(0.15, 0.1, 0.1)}
    relations = (rel("child", "on", "parent"),)
    start = {"child": Pose(position=(0, 0, 0.1002)), "parent": Pose()}
    loss = SemanticLoss(assets, relations, start)
    poses = {"child": Pose.from_yaw(yaw, (x, y, 0.1002)), "parent": Pose()}
    value = float(loss(states(assets, poses)))
    if not check_relations(relations, assets, poses)[0].holds:
        assert value > 0.0
    if abs(x) < 0.001 and abs(y) < 0.001 and abs(yaw) < 0.01:
        assert value < 1e-6


def test_a_fallen_child_has_a_loss_though_it_is_under_its_parent():
    assets = {"table": table(), "cup": mug()}
    relations = (rel("cup", "on", "table"),)
    loss = SemanticLoss(assets, relations, {"table": Pose(), "cup": Pose(position=(0, 0, 0.742))})
    under = states(assets, {"table": Pose(), "cup": Pose()})
    assert float(loss(under)) > 0.1
    assert bool(loss.lost(loss.terms(under)))


def test_relations_must_name_objects():
    with pytest.raises(SpecError, match="octopus"):
        SemanticLoss({"a": block()}, (rel("octopus", "on", "a"),), {"a": Pose()})


@pytest.mark.parametrize(("inside", "missing"), [(0.0005, 0.0005), (0.0015, 0.0), (-0.002, 0.003)])
def test_the_weight_of_a_child_must_be_over_its_parent_by_the_margin(inside, missing):
    """A block as wide as its parent, whose middle is `inside` the parent's edge: the margin is 1 mm."""
    assets = {"shelf": block(0.1, 0.4, 0.05), "a": block(0.3, 0.05, 0.05)}
    relation = rel("a", "on", "shelf")
    rest = {"shelf": Pose(), "a": Pose(position=(0.0, 0.0, 0.05))}
    loss = SemanticLoss(assets, (relation,), rest)
    moved = {**rest, "a": Pose(position=(0.05 - inside, 0.0, 0.05))}
    off = loss._off(1, 0, states(assets, moved))
    assert float(off) == pytest.approx(missing**2, abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "position", "missing"),
    [
        # The centre is 0.4 mm to that side, of a margin of 1 mm; the boxes are apart in height and do not overlap.
        ("right_of", (0.1004, 0.0, 0.0), 0.0),
        ("right_of", (0.0504, 0.0, 0.0), 0.0006),
        ("left_of", (-0.0504, 0.0, 0.0), 0.0006),
        ("behind", (0.0, 0.0504, 0.0), 0.0006),
        ("in_front_of", (0.0, -0.0512, 0.0), 0.0),
    ],
)
def test_boxes_may_overlap_by_less_than_half_and_the_margin(kind, position, missing):
    """Two blocks of 10 cm overlap by half where their middles are 5 cm apart."""
    assets = {"a": block(0.1, 0.1, 0.1), "b": block(0.1, 0.1, 0.1)}
    poses = {"a": Pose(position=position), "b": Pose()}
    loss = SemanticLoss(assets, (rel("a", kind, "b"),), poses)
    assert float(loss(states(assets, poses))) == pytest.approx(missing**2, abs=1e-12)


@pytest.mark.parametrize(("gap", "missing"), [(0.248, 0.0), (0.2495, 0.0005), (0.26, 0.011)])
def test_next_to_must_hold_by_the_margin(gap, missing):
    """Things of 10 cm are next to one another up to 25 cm apart."""
    assets = {"a": block(0.1, 0.1, 0.1), "b": block(0.1, 0.1, 0.1)}
    poses = {"a": Pose(position=(0.1 + gap, 0.0, 0.0)), "b": Pose()}
    loss = SemanticLoss(assets, (rel("a", "next_to", "b"),), poses)
    assert float(loss(states(assets, poses))) == pytest.approx(missing**2, abs=1e-12)
