"""The adjoint against central differences of tightly converged rollouts.

Bodies are tilted by milliradians: exactly parallel faces make the closest features switch inside any difference
interval. Steps of 1e-7 balance truncation against what rollouts converged to their rounding leave.
"""

import numpy as np
import pytest
import torch
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.adjoint import backward
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.recording import RecordedRun, Recording
from pat3d.sim.rollouts import rollout
from pat3d.sim.run import SettleOptions
from tests.sim.builders import add_hull, box_points
from tests.sim.canonical import edge_on_edge


def tilted(x: float, y: float, z: float, quat: tuple[float, float, float, float]) -> Pose:
    values = np.array(quat) / np.linalg.norm(quat)
    return Pose(position=(x, y, z), quat_wxyz=tuple(values))


def stack() -> Model:
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.08, 0.06), tilted(0, 0, 0.0312, (1, 0.0025, 0.003, 0.1)))
    add_hull(builder, box_points(0.08, 0.1, 0.06), tilted(0.01, 0.01, 0.0935, (1, -0.0025, 0.002, 0.3)))
    return builder.finalize("cpu")


def slope(angle: float = 0.35) -> Model:
    """A block on a fixed wedge, on a slope of 20 degrees: sliding at mu = 0.3."""
    builder = ModelBuilder()
    wedge = np.array([[x, y, z] for y in (-0.2, 0.2) for x, z in ((0, 0), (1.2, 0), (0, 1.2 * np.tan(angle)))])
    add_hull(builder, wedge, Pose(), fixed=True)
    place = np.array([0.4, 0, 0.8 * np.tan(angle)]) + 0.0209 * np.array([np.sin(angle), 0, np.cos(angle)])
    half = (angle + 5e-3) / 2
    add_hull(builder, box_points(0.06, 0.06, 0.04), tilted(*place, (np.cos(half), 1e-3, np.sin(half), 1e-3)))
    return builder.finalize("cpu")


def round_on_block() -> Model:
    rng = np.random.default_rng(0)
    builder = ModelBuilder()
    points = rng.normal(size=(30, 3))
    add_hull(builder, box_points(0.1, 0.08, 0.06), tilted(0, 0, 0.0312, (1, 0.0025, 0.003, 0.1)))
    add_hull(
        builder, 0.04 * points / np.linalg.norm(points, axis=1, keepdims=True), tilted(0.03, 0.01, 0.103, (1, 0, 0, 0))
    )
    return builder.finalize("cpu")


def relative_error(model: Model, until, frames=(-1,), friction: float = 0.3, h: float = 1e-7) -> float:
    """Of the directional derivative of a random linear loss of the given frames, over random directions."""
    rng = np.random.default_rng(1)
    start = torch.tensor(model.q0.reshape(1, -1, 12), requires_grad=True)
    weights = {frame: torch.tensor(rng.normal(size=start.shape)) for frame in frames}

    def loss(q0: torch.Tensor) -> torch.Tensor:
        run = rollout(model, q0, until=until, friction=friction)
        return sum(((run.frames[frame] * weight).sum() for frame, weight in weights.items()), torch.zeros(()))

    loss(start).backward()
    worst = 0.0
    for _ in range(2):
        direction = rng.normal(size=start.shape) * np.where(np.arange(12) < 3, 1.0, 0.2)
        direction[:, ~model.is_free] = 0.0
        step = torch.tensor(h * direction)
        with torch.no_grad():
            numeric = float(loss(start + step) - loss(start - step)) / (2 * h)
        analytic = float((start.grad * torch.tensor(direction)).sum())
        worst = max(worst, abs(numeric - analytic) / abs(analytic))
    return worst


def nearly_parallel_edges() -> Model:
    """Edges that the mollifier weighs with 0.64, close enough that the first step's friction has their normal force."""
    return edge_on_edge(0.02, 5e-4)


@pytest.mark.parametrize("scene", [stack, slope, round_on_block, nearly_parallel_edges])
def test_one_step_has_the_gradient_of_central_differences(scene):
    assert relative_error(scene(), 1) < 1e-6


@pytest.mark.parametrize("scene", [stack, slope, round_on_block, nearly_parallel_edges])
def test_four_steps_with_losses_on_two_frames(scene):
    assert relative_error(scene(), 4, frames=(2, -1)) < 1e-5


def test_the_lagged_normal_and_closest_points_matter(monkeypatch):
    """Without the lag's derivative a rolling body's gradient is visibly wrong, so the test above would see it."""
    monkeypatch.setattr("pat3d.sim.adjoint.pull_back_lag", lambda *_: None)
    assert relative_error(slope(), 3) > 1e-3


@pytest.mark.parametrize(("scene", "friction"), [(stack, 0.3), (slope, 0.5), (round_on_block, 0.3)])
def test_settling_to_rest_has_the_gradient_of_central_differences(scene, friction):
    """Through the coarse polish, the shrinking barrier and steps whose friction counts from an anchor."""
    assert relative_error(scene(), "rest", frames=(-3, -1), friction=friction) < 1e-6


@pytest.mark.parametrize("scene", [stack, round_on_block])
def test_an_anchor_that_stays_behind_carries_its_share_of_the_gradient(scene):
    """Friction of all steps counts from the first state, on which later states depend anything but one to one.

    A residual of a few 1e-10 of the weight, which rounding leaves, moves the weighted end by 4e-14 m: 2e-7 of the
    derivative over twice a step of 2e-6, and more than 1e-6 over any below 4e-7. Truncation is 1e5 h^2 (4e-7 there), of
    which extrapolation from 2 h and h leaves the fourth order, 1e-8.
    """
    model = scene()
    rng = np.random.default_rng(3)
    weight, direction = rng.normal(size=(2, *model.q0.shape)) * model.is_free[:, None, None]

    def run(q0: np.ndarray) -> tuple[Recording, np.ndarray]:
        recorded = RecordedRun(model, SettleOptions(), np.array([0.5]), 1, q0)
        recorded.set_d_hat(1e-3)
        recorded.potential.friction.epsilon = 1e-3
        everything = np.ones(1, dtype=bool)
        recorded.anchor_friction(everything)
        for _ in range(4):
            recorded.record_friction()
            recorded.step(
                everything,
                np.ones(1),
                move_tolerance=1e-5,
                residual_tolerance=1e-9,
                exact_below=1e-2,
                max_iterations=100,
            )
        record, states = recorded.recorded()
        return record, np.stack([state.numpy() for state in states])

    record, states = run(model.q0)
    losses = np.zeros_like(states)
    losses[-1] = weight
    kept, by_kept = (wp.array(x, dtype=wp.vec3d, device="cpu") for x in (states, losses))
    analytic = float(np.sum(backward(record, kept, by_kept).q0 * direction))
    h = 2e-6
    far, near = (
        np.sum((run(model.q0 + x * direction)[1][-1] - run(model.q0 - x * direction)[1][-1]) * weight) / (2 * x)
        for x in (2 * h, h)
    )
    assert analytic == pytest.approx((4 * near - far) / 3, rel=1e-6)


def test_gradient_of_a_settled_scene():
    """Through the shrinking barrier and the anchored polish; a box that drops flat keeps x and y."""
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.08, 0.06), Pose(position=(0, 0, 0.032)))
    model = builder.finalize("cpu")
    q0 = torch.tensor(model.q0.reshape(1, 1, 12), requires_grad=True)
    run = rollout(model, q0, until="rest")
    assert run.at_rest.all()
    run.q_end[0, 0, :2].sum().backward()
    assert q0.grad is not None
    np.testing.assert_allclose(q0.grad[0, 0, :2], [1.0, 1.0], atol=1e-6)
