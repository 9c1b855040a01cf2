"""Gradients and Hessians of every energy term against central differences of its value."""

import numpy as np
import pytest
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder
from pat3d.sim.terms.potential import Potential
from tests.sim.builders import add_hull, box_points, random_hull

D_HAT = 0.02


def crowded_potential(seed: int) -> tuple[Potential, np.ndarray]:
    """Three tilted bodies within the barrier's reach of one another and of the ground, attached, slightly deformed."""
    rng = np.random.default_rng(seed)
    builder = ModelBuilder()
    quat = rng.normal(size=(4, 4)) * 0.05 + [1, 0, 0, 0]
    quat /= np.linalg.norm(quat, axis=1, keepdims=True)
    place = [(0, 0, 0.062), (0.09, 0.01, 0.06), (0.05, 0.02, 0.165)]
    add_hull(builder, box_points(0.08, 0.08, 0.1), Pose(position=place[0], quat_wxyz=tuple(quat[0])))
    add_hull(builder, box_points(0.08, 0.08, 0.1), Pose(position=place[1], quat_wxyz=tuple(quat[1])))
    add_hull(builder, random_hull(rng), Pose(position=place[2], quat_wxyz=tuple(quat[2])))
    for (first, second), points in zip(
        ((0, 1), (0, 2), (0, 2)), np.random.default_rng(seed).normal(size=(3, 2, 3)), strict=True
    ):
        builder.add_attachment(first, 0.05 * points[0], second, 0.05 * points[1])
    model = builder.finalize("cpu")
    model.attachment_stiffness.fill_(2e3)
    potential = Potential(model)
    potential.contact.d_hat = D_HAT
    potential.contact.stiffness.fill_(50.0)
    potential.orthogonality.stiffness.fill_(1e4)
    potential.inertia.sigma.fill_(100.0)
    potential.friction.coefficient.fill_(0.5)
    potential.friction.epsilon = 2e-3
    q = model.q0 + 1e-3 * rng.normal(size=model.q0.shape)
    potential.inertia.start.assign(model.q0)
    potential.friction.reference.assign(model.q0)
    potential.record_friction(wp.array(q, dtype=wp.vec3d, device="cpu"))
    assert potential.friction.count > 20
    return potential, q


def value(potential: Potential, q: np.ndarray) -> float:
    state = wp.array(q, dtype=wp.vec3d, device="cpu")
    potential.cover(state)
    return float(potential.value(state)[0])


def gradient(potential: Potential, q: np.ndarray) -> np.ndarray:
    state = wp.array(q, dtype=wp.vec3d, device="cpu")
    potential.cover(state)
    return potential.gradient(state).numpy().reshape(-1).copy()


@pytest.mark.parametrize("seed", range(4))
def test_gradient_is_the_derivative_of_the_value(seed):
    potential, q = crowded_potential(seed)
    analytic = gradient(potential, q)
    h = 1e-7
    numeric = np.empty_like(analytic)
    for i in range(q.size):
        step = np.zeros(q.size)
        step[i] = h
        numeric[i] = (value(potential, q + step.reshape(q.shape)) - value(potential, q - step.reshape(q.shape))) / (
            2 * h
        )
    # Rounding of an energy of order one over 2h: 1e-9; truncation is smaller.
    np.testing.assert_allclose(numeric, analytic, atol=1e-6 * np.abs(analytic).max())


@pytest.mark.parametrize("seed", range(4))
def test_exact_hessian_is_the_derivative_of_the_gradient(seed):
    potential, q = crowded_potential(seed)
    state = wp.array(q, dtype=wp.vec3d, device="cpu")
    potential.cover(state)
    analytic = potential.hessian(state, exact=True).numpy()[0].copy()
    h = 1e-7
    numeric = np.empty_like(analytic)
    for i in range(q.size):
        step = np.zeros(q.size)
        step[i] = h
        up, down = q + step.reshape(q.shape), q - step.reshape(q.shape)
        numeric[i] = (gradient(potential, up) - gradient(potential, down)) / (2 * h)
    np.testing.assert_allclose(numeric, analytic, atol=2e-6 * np.abs(analytic).max())
    np.testing.assert_allclose(analytic, analytic.T, atol=1e-12 * np.abs(analytic).max())


@pytest.mark.parametrize("seed", range(4))
def test_projected_hessian_is_positive_definite(seed):
    potential, q = crowded_potential(seed)
    state = wp.array(q, dtype=wp.vec3d, device="cpu")
    potential.cover(state)
    matrix = potential.hessian(state, exact=False).numpy()[0]
    assert np.linalg.eigvalsh(matrix).min() > 0
