"""Bodies that hang: closed forms of pendulums and hinges, and gradients through attachments."""

import numpy as np
import pytest
import torch

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.model import ATTACHMENT_STRETCH, Model, ModelBuilder, poses_from_states
from pat3d.sim.rollouts import rollout
from pat3d.sim.run import SettleOptions
from pat3d.sim.settling import settle
from tests.sim.builders import add_hull, box_points, random_hull

HOOK = np.array([0.0, 0.0, 1.0])
"""Where the fixed beam holds [m]; so far under it that nothing touches."""


def beam(builder: ModelBuilder) -> int:
    return add_hull(builder, box_points(0.4, 0.1, 0.1), Pose(position=(0, 0, 1.27)), fixed=True)


def hung(points: np.ndarray, points_held: np.ndarray, pose: Pose) -> tuple[Model, int]:
    """The hull of `points` at `pose`, with its `points_held` attached to where they are under a fixed beam."""
    builder = ModelBuilder()
    support = beam(builder)
    body = add_hull(builder, points, pose)
    for point in points_held:
        builder.add_attachment(body, point, support, pose.apply(point[None])[0] - (0, 0, 1.27))
    return builder.finalize("cpu"), body


@pytest.mark.parametrize("seed", range(3))
def test_a_body_hung_at_one_point_ends_with_its_centre_of_mass_below_it(seed):
    rng = np.random.default_rng(seed)
    points = random_hull(rng, 0.2)
    point = points[np.argmax(points[:, 0])]
    model, body = hung(points, point[None], Pose(position=tuple(HOOK - point)))
    settled = settle(model)
    assert settled.at_rest.all()
    pose = poses_from_states(model, settled.q)[body]
    held, centre = pose.apply(point[None])[0], settled.q[body, 0]
    # A stretch of the attachment, and at a residual of 1e-6 of the weight a lever arm of 1e-6 of the body's size.
    np.testing.assert_allclose(held, HOOK, atol=2 * ATTACHMENT_STRETCH)
    np.testing.assert_allclose(centre[:2], HOOK[:2], atol=1e-6)
    assert centre[2] < HOOK[2] - 0.01


def test_an_attachment_point_gives_way_by_the_stated_stretch():
    model, body = hung(box_points(0.1, 0.1, 0.1), np.array([[0, 0, 0.05]]), Pose(position=(0, 0, 0.95)))
    settled = settle(model)
    top = settled.q[body, 0] + 0.05 * settled.q[body, 3]
    np.testing.assert_allclose(top, HOOK - (0, 0, ATTACHMENT_STRETCH), atol=1e-3 * ATTACHMENT_STRETCH)


def test_two_attachment_points_are_a_hinge():
    """A board held at two points of an edge swings down about that edge and keeps its direction along it."""
    corners = np.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0]])
    start = Pose(position=(0.0, 0.1, 1.0))
    model, body = hung(box_points(0.2, 0.2, 0.02), corners, start)
    settled = settle(model, SettleOptions(max_frames=120))
    assert settled.at_rest.all()
    pose = poses_from_states(model, settled.q)[body]
    np.testing.assert_allclose(pose.apply(corners), start.apply(corners), atol=2 * ATTACHMENT_STRETCH)
    np.testing.assert_allclose(pose.rotation @ [0, 1, 0], [0, 0, -1], atol=1e-5)


def test_a_chain_of_two_bodies_hangs_straight():
    builder = ModelBuilder()
    support = beam(builder)
    upper = add_hull(builder, box_points(0.05, 0.05, 0.2), Pose(position=(0, 0, 0.9)))
    lower = add_hull(builder, box_points(0.05, 0.05, 0.1), Pose(position=(0.03, 0, 0.72)), density=100.0)
    builder.add_attachment(upper, np.array([0.0, 0, 0.1]), support, HOOK - (0, 0, 1.27))
    builder.add_attachment(lower, np.array([-0.02, 0, 0.05]), upper, np.array([0.01, 0, -0.13]))
    model = builder.finalize("cpu")
    settled = settle(model)
    assert settled.at_rest.all()
    masses = model.body_mass.numpy()
    common = (masses[[upper, lower], None] * settled.q[[upper, lower], 0]).sum(axis=0) / masses[[upper, lower]].sum()
    np.testing.assert_allclose(common[:2], [0, 0], atol=1e-6)


def test_attached_bodies_still_collide_with_one_another():
    """A block hinged a little under a shelf's edge swings until it lies against the post that is part of the shelf."""
    builder = ModelBuilder()
    wall = add_hull(builder, box_points(0.1, 0.4, 0.6), Pose(position=(-0.05, 0, 0.7)), fixed=True)
    body = add_hull(builder, box_points(0.2, 0.1, 0.1), Pose(position=(0.105, 0, 0.8)))
    point = np.array([-0.1, 0.0, 0.05])
    builder.add_attachment(body, point, wall, np.array([0.055, 0.0, 0.15]))
    model = builder.finalize("cpu")
    settled = settle(model)
    assert settled.at_rest.all()
    turned = settled.q[body, 1:].T
    lowest = (box_points(0.2, 0.1, 0.1) @ turned.T + settled.q[body, 0])[:, 0].min()
    assert 0.0 < lowest < 2e-5
    assert settled.q[body, 0, 0] > 1e-3


@pytest.mark.parametrize(
    ("first", "second", "message"),
    [
        ((0, 0), (0, 0), "two different bodies"),
        ((0, 0), (3, 0), "below 3"),
        ((0, 0), (2, np.nan), "3 finite numbers"),
        ((0, 0), (1, 0), "both fixed"),
    ],
)
def test_impossible_attachments_are_refused(first, second, message):
    builder = ModelBuilder()
    for z, fixed in ((0.1, True), (0.3, True), (0.5, False)):
        add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, z)), fixed=fixed)
    with pytest.raises(SimulationError, match=message):
        builder.add_attachment(first[0], np.full(3, first[1]), second[0], np.full(3, second[1]))


def test_attachments_stay_within_a_world():
    builder = ModelBuilder()
    beam(builder)
    builder.new_world()
    body = add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.5)))
    with pytest.raises(SimulationError, match="different worlds"):
        builder.add_attachment(0, np.zeros(3), body, np.zeros(3))


@pytest.mark.parametrize(("frames", "tolerance"), [(1, 1e-6), (4, 1e-5)])
def test_gradients_flow_through_attachments(frames, tolerance):
    """A rod hung at one end, started aslant, of a block that slides on the ground: central differences."""
    builder = ModelBuilder()
    block = add_hull(builder, box_points(0.2, 0.2, 0.1), Pose(position=(0, 0, 0.0507)))
    rod = add_hull(builder, box_points(0.2, 0.03, 0.03), Pose(position=(0.25, 0, 0.13)))
    builder.add_attachment(rod, np.array([-0.1, 0.0, 0.0]), block, np.array([0.15, 0.0, 0.08]))
    model = builder.finalize("cpu")
    model.attachment_stiffness.fill_(1e5)
    options = SettleOptions(friction=0.3, drop_residual=1e-11)
    rng = np.random.default_rng(0)
    start = torch.tensor(model.q0.reshape(1, -1, 12) + 1e-4 * rng.normal(size=(1, 2, 12)), requires_grad=True)
    weight, direction = (torch.tensor(rng.normal(size=start.shape)) for _ in range(2))

    def loss(q0: torch.Tensor) -> torch.Tensor:
        return (rollout(model, q0, until=frames, options=options).q_end * weight).sum()

    loss(start).backward()
    assert start.grad is not None
    with torch.no_grad():
        step = 1e-7 * direction
        numeric = float(loss(start + step) - loss(start - step)) / 2e-7
    assert float((start.grad * direction).sum()) == pytest.approx(numeric, rel=tolerance)
