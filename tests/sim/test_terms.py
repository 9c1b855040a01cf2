"""The protocol of energy terms, and what is derived from it."""

import importlib
import inspect
import pkgutil

import numpy as np
import pytest
import warp as wp

import pat3d.sim.terms
from pat3d.geometry.pose import Pose
from pat3d.sim.compilation import settling_modules
from pat3d.sim.kernel_modules import declared_modules
from pat3d.sim.model import ModelBuilder
from pat3d.sim.terms.orthogonality import Orthogonality
from pat3d.sim.terms.potential import Potential
from pat3d.sim.terms.term import Evaluation, Launch, Term
from tests.sim.builders import add_hull, box_points
from tests.sim.test_potential import crowded_potential


@pytest.fixture(scope="module")
def potential() -> Potential:
    return crowded_potential(0)[0]


def test_every_class_that_is_a_term_is_part_of_the_energy(potential):
    names = [name for _, name, _ in pkgutil.iter_modules(pat3d.sim.terms.__path__, "pat3d.sim.terms.")]
    members = [value for name in names for value in vars(importlib.import_module(name)).values()]
    terms = {
        value
        for value in members
        if inspect.isclass(value) and value is not Term and {"value_launches", "hessian_launches"} <= set(dir(value))
    }
    assert terms == {type(term) for term in potential.terms}
    assert len(potential.terms) == len(terms)


def launches_of(term: Term, potential: Potential) -> list[Launch]:
    q = potential.inertia.start
    at = potential.everywhere(q, potential.positions(q, potential.vertex_positions))
    outputs = potential._energy, potential._gradient
    return [*term.value_launches(at, *outputs), *term.hessian_launches(at, potential.all_active, potential._hessian)]


def test_kernels_of_every_term_are_compiled_beforehand_and_repeat_on_a_gpu(potential):
    declared = {module.name: module for module in declared_modules()}
    for term in potential.terms:
        launches = launches_of(term, potential)
        assert launches
        for name in {launch.kernel.module.name for launch in launches}:
            assert name in settling_modules()
            assert declared[name].most_records > 0


def test_the_energy_and_its_derivatives_are_the_sums_of_the_terms(potential):
    model = potential.model
    q = wp.array(crowded_potential(0)[1], dtype=wp.vec3d, device="cpu")
    total = potential.value(q), potential.gradient(q).numpy().copy(), potential.hessian(q, exact=True).numpy().copy()
    everything = [np.zeros_like(part) for part in total]
    at = potential.everywhere(q, potential.positions(q, potential.vertex_positions))
    for term in potential.terms:
        energy = wp.zeros(1, dtype=wp.float64, device="cpu")
        gradient = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device="cpu")
        hessian = wp.zeros((1, model.unknowns, model.unknowns), dtype=wp.float64, device="cpu")
        for launch in term.value_launches(at, energy, gradient):
            launch("cpu")
        for launch in term.hessian_launches(at, potential.all_active, hessian):
            launch("cpu")
        for sum_, part in zip(everything, (energy, gradient, hessian), strict=True):
            assert part.numpy().any(), f"{term} is at work in this state"
            sum_ += part.numpy()
    for whole, sum_ in zip(total, everything, strict=True):
        np.testing.assert_allclose(whole, sum_, rtol=1e-12, atol=1e-12 * np.abs(whole).max())


def test_at_rest_the_energy_has_no_pull_of_inertia(potential):
    """What remains of inertia's force on a body at the start of its step, and anywhere else, is its weight."""
    model = potential.model
    q = wp.array(crowded_potential(0)[1], dtype=wp.vec3d, device="cpu")
    moving, resting = (potential.gradient(q, inertia=inertia).numpy().copy() for inertia in (True, False))
    mass, moment = model.body_mass.numpy(), model.body_moment.numpy()
    change = q.numpy() - potential.inertia.start.numpy()
    sigma = float(potential.inertia.sigma.numpy()[0])
    np.testing.assert_allclose((moving - resting)[:, 0], sigma * mass[:, None] * change[:, 0], rtol=1e-9, atol=1e-12)
    np.testing.assert_allclose(
        (moving - resting)[:, 1:], sigma * np.einsum("bij,bjk->bik", moment, change[:, 1:]), rtol=1e-6, atol=1e-12
    )


def test_worlds_that_are_not_active_add_nothing(potential):
    q = potential.inertia.start
    none = wp.zeros(1, dtype=int, device="cpu")
    at = potential.everywhere(q, potential.positions(q, potential.vertex_positions))
    at = type(at)(q=at.q, position=at.position, active=none)
    potential.evaluate(at, potential._energy, potential._gradient)
    potential.assemble(at, potential.all_active, potential._hessian)
    assert not potential._energy.numpy().any()
    assert not potential._gradient.numpy().any()
    assert not potential._hessian.numpy().any()


@pytest.mark.parametrize("strain", [-0.2, 0.2])
def test_a_strained_body_has_the_stiffness_of_differences_and_a_convex_stand_in(strain):
    """Compressed, the exact Hessian is indefinite; scenes strain by 1e-5, where the two hardly differ."""
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.08, 0.06), Pose(position=(0, 0, 1.0)))
    model = builder.finalize("cpu")
    term = Orthogonality(model, stiffness=1e4)
    energy = wp.zeros(1, dtype=wp.float64, device="cpu")
    state = model.q0.copy()
    state[:, 1:] = (1 + strain) * np.eye(3) + 0.02 * np.random.default_rng(0).normal(size=(3, 3))
    mask = wp.full(1, 1, dtype=int, device="cpu")

    def at(q: np.ndarray) -> Evaluation:
        return Evaluation(q=wp.array(q, dtype=wp.vec3d, device="cpu"), position=energy, active=mask)

    def gradient(q: np.ndarray) -> np.ndarray:
        found = wp.zeros((1, 4), dtype=wp.vec3d, device="cpu")
        for launch in term.value_launches(at(q), energy, found):
            launch("cpu")
        return found.numpy().ravel()

    def hessian(exact: int) -> np.ndarray:
        found = wp.zeros((1, 12, 12), dtype=wp.float64, device="cpu")
        for launch in term.hessian_launches(at(state), wp.full(1, exact, dtype=int, device="cpu"), found):
            launch("cpu")
        return found.numpy()[0]

    steps = 1e-6 * np.eye(12).reshape(12, 1, 4, 3)
    numeric = np.array([(gradient(state + step) - gradient(state - step)) / 2e-6 for step in steps])
    exact, convex = hessian(1), hessian(0)
    np.testing.assert_allclose(exact, numeric, atol=1e-7 * np.abs(numeric).max())
    assert (np.linalg.eigvalsh(exact).min() < -1.0) == (strain < 0)
    assert np.linalg.eigvalsh(convex).min() > -1e-9
