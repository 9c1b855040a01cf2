"""The record of lagged friction, and derivatives of friction and contact forces by what they were recorded with."""

import numpy as np
import pytest
import warp as wp

from pat3d.geometry.rotations import turn
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.terms.d_hat_derivative import pull_back_d_hat
from pat3d.sim.terms.friction_lag import pull_back_lag
from pat3d.sim.terms.term import Evaluation
from tests.sim.canonical import edge_on_edge


@pytest.mark.parametrize("angle", [0.005, 0.02, 0.3])
def test_normal_forces_push_the_bodies_as_the_barrier_does(angle):
    """The sum of lambda n over a body's contacts is minus dB/dp, also where nearly parallel edges are mollified.

    The mollifier's own derivative acts on the affine part alone, for the edges' directions do not depend on p.
    """
    run = Run(edge_on_edge(angle, 4e-4), SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    run.record_friction()
    potential = run.potential
    energy = wp.zeros(1, dtype=wp.float64, device="cpu")
    gradient = wp.zeros((2, 4), dtype=wp.vec3d, device="cpu")
    at = Evaluation(q=run.q, position=potential.vertex_positions, active=potential.all_active)
    for launch in potential.contact.value_launches(at, energy, gradient):
        launch("cpu")
    record, count = potential.friction.record, potential.friction.count
    forces = record.force.numpy()[:count, None] * record.normal.numpy()[:count]
    bodies = record.bodies.numpy()[:count]
    assert forces[:, 2].any()
    for body in range(2):
        total = forces[bodies[:, 0] == body].sum(axis=0) - forces[bodies[:, 1] == body].sum(axis=0)
        np.testing.assert_allclose(total, -gradient.numpy()[body, 0], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("epsilon", [1e-6, 1e-3])
@pytest.mark.parametrize(("angle", "frame"), [(0.02, None), (0.3, None), (0.02, turn(np.array([1.0, 2.0, 0.5]), 1.0))])
def test_the_force_depends_on_the_recorded_state_as_differences_of_it_say(angle, frame, epsilon):
    """Through normal force, normal, closest points and the mollifier of nearly parallel edges, sliding or sticking.

    Whatever the axes of the bodies: in the first two cases no edge that touches has a height in them.
    """
    model = edge_on_edge(angle, 4e-4, frame)
    run = Run(model, SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    potential, friction = run.potential, run.potential.friction
    friction.epsilon = epsilon
    friction.reference.assign(model.q0)
    rng = np.random.default_rng(0)
    adjoint, direction = rng.normal(size=(2, *model.q0.shape)) * np.array([1, 0.2, 0.2, 0.2])[:, None]
    q = wp.array(model.q0 + 1e-4 * rng.normal(size=model.q0.shape), dtype=wp.vec3d, device="cpu")
    energy = wp.zeros(1, dtype=wp.float64, device="cpu")

    def force(recorded_at: np.ndarray) -> float:
        potential.record_friction(wp.array(recorded_at, dtype=wp.vec3d, device="cpu"))
        gradient = wp.zeros((2, 4), dtype=wp.vec3d, device="cpu")
        for launch in friction.value_launches(potential.everywhere(q, potential.vertex_positions), energy, gradient):
            launch("cpu")
        return float(np.sum(gradient.numpy() * adjoint))

    h = 1e-9
    numeric = (force(model.q0 + h * direction) - force(model.q0 - h * direction)) / (2 * h)
    potential.record_friction(wp.array(model.q0, dtype=wp.vec3d, device="cpu"))
    recorded, reference = (wp.zeros((2, 4), dtype=wp.vec3d, device="cpu") for _ in range(2))
    w = wp.array(adjoint, dtype=wp.vec3d, device="cpu")
    barrier, position = potential.contact.barrier, potential.vertex_positions
    pull_back_lag(friction, potential.candidates, position, barrier, q, w, recorded, reference, wp.zeros_like(energy))
    # A force rounds to 1e-14 of itself, and changes by its own size over a hundredth of the gap: 4e-6 m.
    assert float(np.sum(recorded.numpy() * direction)) == pytest.approx(numeric, rel=1e-5)


@pytest.mark.parametrize("angle", [0.005, 0.02, 0.3])
def test_the_contact_force_depends_on_d_hat_as_differences_say(angle):
    """Nearly parallel edges are turned by the mollifier, whose force depends on the barrier's value."""
    model = edge_on_edge(angle, 4e-4)
    potential = Run(model, SettleOptions(), lambda *_: None).potential
    q = wp.array(model.q0, dtype=wp.vec3d, device="cpu")
    adjoint = np.random.default_rng(1).normal(size=model.q0.shape)
    energy = wp.zeros(1, dtype=wp.float64, device="cpu")

    def force(d_hat: float) -> float:
        potential.contact.d_hat = d_hat
        potential.cover(q)
        gradient = wp.zeros((2, 4), dtype=wp.vec3d, device="cpu")
        for launch in potential.contact.value_launches(
            potential.everywhere(q, potential.vertex_positions), energy, gradient
        ):
            launch("cpu")
        return float(np.sum(gradient.numpy() * adjoint))

    numeric = (force(1e-3 + 1e-9) - force(1e-3 - 1e-9)) / 2e-9
    potential.contact.d_hat = 1e-3
    w, found = wp.array(adjoint, dtype=wp.vec3d, device="cpu"), wp.zeros_like(energy)
    pull_back_d_hat(potential.contact, potential.vertex_positions, w, found)
    assert -found.numpy()[0] == pytest.approx(numeric, rel=1e-6)


@pytest.mark.parametrize("share", [0.0, 0.5, 1 - 1e-9, 1 + 1e-9, 3.0])
def test_the_energy_of_a_slip_is_coulomb_s_smoothed_below_epsilon(share):
    """D = mu sum lambda f0(y): y beyond epsilon, below it the cubic that meets it there with the same slope."""
    model = edge_on_edge(0.3, 4e-4)
    run = Run(model, SettleOptions(friction=0.4), lambda *_: None)
    run.set_d_hat(1e-3)
    run.anchor_friction(np.ones(1, dtype=bool))
    run.record_friction()
    potential, friction = run.potential, run.potential.friction
    friction.epsilon = epsilon = 1e-4
    y = share * epsilon
    slipped = model.q0.copy()
    slipped[1, 0] += y * np.array([0.6, 0.8, 0])
    energy = wp.zeros(1, dtype=wp.float64, device="cpu")
    gradient = wp.zeros((2, 4), dtype=wp.vec3d, device="cpu")
    q = wp.array(slipped, dtype=wp.vec3d, device="cpu")
    for launch in friction.value_launches(potential.everywhere(q, potential.vertex_positions), energy, gradient):
        launch("cpu")
    forces = friction.record.force.numpy()[: friction.count]
    normals = friction.record.normal.numpy()[: friction.count]
    np.testing.assert_allclose(np.abs(normals[forces > 0, 2]), 1, atol=1e-6)
    smoothed = y if y > epsilon else y**2 / epsilon - y**3 / (3 * epsilon**2) + epsilon / 3
    mobilised = min(1.0, 2 * share - share**2) if share < 1 else 1.0
    assert energy.numpy()[0] == pytest.approx(0.4 * forces.sum() * smoothed, rel=1e-6)
    np.testing.assert_allclose(
        gradient.numpy()[1, 0], 0.4 * forces.sum() * mobilised * np.array([0.6, 0.8, 0]), rtol=1e-6, atol=1e-9
    )
