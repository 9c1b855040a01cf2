"""Rollouts that keep few states, and gradients by physical parameters."""

from typing import Any

import numpy as np
import pytest
import torch

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.rollouts import rollout
from pat3d.sim.run import SettleOptions
from tests.sim.builders import add_hull, box_points


def stack(worlds: int = 1) -> Model:
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.08, 0.06), Pose.from_matrix(*turned(0.004, 0.2, (0, 0, 0.0307))))
    add_hull(builder, box_points(0.08, 0.1, 0.06), Pose.from_matrix(*turned(-0.005, 0.7, (0.01, 0.01, 0.0914))))
    return builder.finalize("cpu", worlds=worlds)


def block_on_slope(worlds: int = 1) -> Model:
    """A block on a fixed slope of 20 degrees, on which it slides below mu = tan(0.35) = 0.365."""
    angle = 0.35
    builder = ModelBuilder()
    wedge = np.array([[x, y, z] for y in (-0.2, 0.2) for x, z in ((0, 0), (1.2, 0), (0, 1.2 * np.tan(angle)))])
    add_hull(builder, wedge, Pose(), fixed=True)
    place = np.array([0.4, 0, 0.8 * np.tan(angle)]) + 0.0209 * np.array([np.sin(angle), 0, np.cos(angle)])
    add_hull(builder, box_points(0.06, 0.06, 0.04), Pose.from_matrix(*turned(angle + 5e-3, 1e-3, tuple(place))))
    return builder.finalize("cpu", worlds=worlds)


def turned(tilt: float, yaw: float, place: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """A rotation by `yaw` about z after one by `tilt` about y, and a position."""
    (c, s), (cy, sy) = (np.cos(tilt), np.sin(tilt)), (np.cos(yaw), np.sin(yaw))
    rotation = np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]]) @ np.array([[c, 0, s], [0, 1, 0], [-s, 0, c]])
    return rotation, np.array(place)


def states(model: Model) -> torch.Tensor:
    """Initial states, each world's a little higher than the one before."""
    q0 = model.q0.reshape(model.worlds, -1, 12).copy()
    q0[..., 2] += 1e-3 * np.arange(model.worlds)[:, None] * np.arange(q0.shape[1])
    return torch.tensor(q0, requires_grad=True)


@pytest.mark.parametrize("until", [7, "rest"])
@pytest.mark.parametrize("every", [3, 1000])
def test_recomputed_steps_change_no_bit_of_the_gradient(until, every):
    """Worlds rest after different numbers of steps, and the polish counts friction from states that were not kept."""
    found = []
    for stride in (1, every):
        model = stack(worlds=2)
        q0, mu = states(model), torch.tensor(0.3, requires_grad=True)
        run = rollout(model, q0, until=until, every=stride, friction=mu)
        # The same frames count in both: the first, and of the rest those that both keep.
        assert run.steps[0] == 0
        assert np.all(np.diff(run.steps)[:-1] == stride)
        shared = np.flatnonzero((run.steps % every == 0) | (run.steps == run.steps[-1]))
        weight = torch.from_numpy(np.random.default_rng(0).normal(size=(len(shared), *q0.shape)))
        (run.frames[shared] * weight).sum().backward()
        found.append((run.frames[shared].detach().numpy(), q0.grad, mu.grad, run.steps[-1]))
    (frames, by_state, by_friction, last), (few, few_by_state, few_by_friction, few_last) = found
    assert last == few_last > 6
    np.testing.assert_array_equal(few, frames)
    assert bool(by_state.any())
    assert torch.equal(few_by_state, by_state)
    assert torch.equal(few_by_friction, by_friction)


def test_a_rollout_keeps_as_many_states_as_it_returns_frames():
    run = rollout(stack(), states(stack()), until=25, every=10)
    np.testing.assert_array_equal(run.steps, [0, 10, 20, 25])
    assert run.frames.shape == (4, 1, 2, 12)


def test_frames_changed_in_place_are_noticed():
    model = stack()
    run = rollout(model, states(model), until=2)
    frames = run.frames.detach()
    frames += 1.0
    with pytest.raises(RuntimeError, match="modified by an inplace operation"):
        run.q_end.sum().backward()


@pytest.mark.parametrize("until", [1, 5])
@pytest.mark.parametrize("scene", [stack, block_on_slope])
@pytest.mark.parametrize("name", ["friction", "mass", "d_hat"])
def test_parameters_have_the_gradient_of_central_differences(name, scene, until):
    """Relative steps h are as large as rounding asks where the derivative is small; contacts must not come and go."""
    model = scene()
    q0 = states(model).detach()
    value = {"friction": np.array(0.3), "mass": model.body_mass.numpy()[None], "d_hat": np.array(1e-3)}[name]
    step = 1e-4 if name == "d_hat" else 1e-3
    rng = np.random.default_rng(2)
    weight = torch.from_numpy(rng.normal(size=q0.shape))
    direction = value * (1.0 if value.ndim == 0 else rng.normal(size=value.shape) * model.is_free)

    def loss(parameter: torch.Tensor) -> torch.Tensor:
        given: Any = {name: parameter}
        return (rollout(model, q0, until=until, **given).q_end * weight).sum()

    parameter = torch.tensor(value, requires_grad=True)
    loss(parameter).backward()
    assert parameter.grad is not None
    analytic = float((parameter.grad * torch.from_numpy(np.asarray(direction))).sum())
    # Fourth order in the step.
    with torch.no_grad():
        far, near = (
            float(loss(torch.tensor(value + h * direction)) - loss(torch.tensor(value - h * direction))) / (2 * h)
            for h in (2 * step, step)
        )
    assert abs(analytic) > 1e-7
    assert analytic == pytest.approx((4 * near - far) / 3, rel=1e-5)


def test_a_heavier_twin_slides_the_same_way():
    """Mass cancels: the gradient by a common factor of all masses is zero but for the barrier's compression."""
    model = block_on_slope()
    mass = torch.tensor(model.body_mass.numpy()[None], requires_grad=True)
    run = rollout(model, states(model).detach(), until=4, mass=mass)
    run.q_end[0, 1, 0].backward()
    assert mass.grad is not None
    assert mass.grad[0, 0] == 0
    slid = abs(float((run.q_end - run.frames[1])[0, 1, 0].detach()))
    assert slid > 1e-3
    assert abs(float(mass.grad[0, 1] * mass[0, 1].detach())) < 1e-2 * slid


def test_worlds_have_their_own_friction():
    """One block creeps at most as friction does, the other slides, the less the more friction."""
    model = block_on_slope(worlds=2)
    friction = torch.tensor([0.5, 0.3], requires_grad=True)
    run = rollout(model, torch.tensor(model.q0.reshape(2, 2, 12)), until=6, friction=friction)
    slid = (run.q_end - run.frames[1])[:, 1, 0]
    stuck, sliding = slid.detach().numpy()
    assert abs(stuck) < 5 * 3e-5 < 2e-3 < sliding
    slid.sum().backward()
    assert friction.grad is not None
    assert float(friction.grad[1]) < -1e-2
    assert abs(float(friction.grad[0])) < 1e-2 * abs(float(friction.grad[1]))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"friction": torch.tensor([0.1, 0.2])}, "friction must be a scalar or of shape"),
        ({"friction": -0.1}, "not negative"),
        ({"mass": torch.zeros(1, 2)}, "mass must be finite and positive"),
        ({"mass": torch.tensor([[np.nan, 1.0]])}, "mass must be finite and positive"),
        ({"d_hat": torch.tensor(np.nan)}, "d_hat must be finite"),
        ({"d_hat": torch.tensor(1e-5, requires_grad=True)}, "d_hat has a gradient only above"),
        (
            {
                "d_hat": torch.tensor(5e-4, requires_grad=True),
                "options": SettleOptions(final_d_hat=1e-4, friction_speed=0.02, time_step=0.03),
            },
            "d_hat has a gradient only above",
        ),
        ({"every": 0}, "every=0"),
        ({"until": "done"}, "until must be"),
    ],
)
def test_impossible_requests_are_refused(given, message):
    model = stack()
    with pytest.raises(SimulationError, match=message):
        rollout(model, states(model).detach(), **{"until": 1, **given})
