"""The line search: its curve, its first trial, and what it accepts."""

import numpy as np
import pytest
import warp as wp
from scipy.linalg import expm

from pat3d.geometry.pose import Pose
from pat3d.sim.arrays import filled
from pat3d.sim.launch_graph import LaunchGraph
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.solvers import line_search
from pat3d.sim.solvers import newton as newton_module
from pat3d.sim.terms.inertia import Inertia
from pat3d.sim.terms.term import Evaluation
from tests.sim.builders import add_hull, box_points, random_hull
from tests.sim.canonical import edge_on_edge

MOVE, REST, EXACT = 1e-5, 1e-3, 1e-2
"""Tolerances: motion of a full step [m], residual, and residual under which progress is judged by it."""


def hulls(worlds: int = 1) -> Model:
    rng = np.random.default_rng(0)
    builder = ModelBuilder()
    for i in range(2):
        add_hull(builder, random_hull(rng), Pose.from_yaw(0.3 * i, (0, 0, 0.3 + 0.3 * i)))
    return builder.finalize("cpu", worlds=worlds)


def numbers(*values: float) -> wp.array:
    return wp.array(np.array(values), dtype=wp.float64, device="cpu")


def flags(*values: int) -> wp.array:
    return wp.array(np.array(values, dtype=np.int32), dtype=int, device="cpu")


@pytest.mark.parametrize("size", [1e-4, 1e-2, 0.3, 2.0])
def test_the_search_curve_turns_by_the_exponential_of_its_skew_part(size):
    """A(t) = exp(t [w]) (I + t S) A with the skew and symmetric parts of dA A^-1; worlds that do not search stay."""
    model = hulls(worlds=2)
    rng = np.random.default_rng(1)
    q = model.q0 + 0.1 * rng.normal(size=model.q0.shape)
    direction = size * rng.normal(size=q.shape)
    trial = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device="cpu")
    t = 0.7
    x, d = (wp.array(values, dtype=wp.vec3d, device="cpu") for values in (q, direction))
    wp.launch(
        line_search.along_curve,
        dim=model.bodies,
        device="cpu",
        inputs=[model.body_arrays, flags(1, 0), x, d, numbers(t, t)],
        outputs=[trial],
    )
    found = trial.numpy()
    for body in range(2):
        a, rate = q[body, 1:].T, direction[body, 1:].T @ np.linalg.inv(q[body, 1:].T)
        skew, stretch = 0.5 * (rate - rate.T), 0.5 * (rate + rate.T)
        expected = expm(t * skew) @ (np.eye(3) + t * stretch) @ a
        np.testing.assert_allclose(found[body, 1:].T, expected, rtol=0, atol=1e-12)
        np.testing.assert_allclose(found[body, 0], q[body, 0] + t * direction[body, 0], rtol=1e-14)
    np.testing.assert_array_equal(found[2:], q[2:])


@pytest.mark.parametrize("fall", [1e-3, 0.02, 0.04, 5.0])
def test_a_first_trial_moves_no_vertex_further_than_the_longest_step(fall):
    """And takes the full step where that is shorter; to first order, which is exact for a translation."""
    run = Run(hulls(), SettleOptions(), lambda *_: None)
    newton = run.newton
    direction = np.zeros((2, 4, 3))
    direction[1, 0] = [0, 0.6 * fall, -0.8 * fall]
    newton._direction.assign(direction)
    newton._motion.zero_()
    wp.launch(
        line_search.linear_motion,
        dim=len(run.model.vertex_rest),
        device="cpu",
        inputs=[run.model.vertex_arrays, run.model.body_arrays, newton._direction],
        outputs=[newton._motion],
    )
    wp.launch(line_search.first_step, dim=1, device="cpu", inputs=[newton._motion], outputs=[newton._step])
    assert newton.step.numpy()[0] == pytest.approx(min(1.0, float(line_search.LONGEST_STEP) / fall), rel=1e-12)


def decided(**given: float) -> dict[str, float]:
    """What becomes of one world's trial, by default a full step of slope -2 from energy 5 that is safe and downhill."""
    values: dict[str, float] = {
        "unresolved": 1e-12, "slope": -2.0, "motion": 1e-3, "fraction": 1.0, "trial_energy": 4.0,
        "trial_residual": 0.5, "step": 1.0, "energy": 5.0, "residual": 0.7,
    }  # fmt: skip
    whole = {"first": 1, "iterations": 3, "pending": 1, "accepted": 0, "running": 1}
    counts = flags(0, 0, 0, int(given.pop("unsolved", 0)), *[0] * (line_search.COUNTS - 4))
    whole |= {name: int(value) for name, value in given.items() if name in whole}
    values |= {name: value for name, value in given.items() if name in values}
    search = filled(
        line_search.Search,
        tolerances=numbers(MOVE, REST, EXACT),
        **{name: numbers(value) for name, value in values.items()},
        **{name: flags(value) for name, value in whole.items()},
    )
    wp.launch(line_search.decide, dim=1, device="cpu", inputs=[search], outputs=[counts])
    status = counts.numpy()
    return {
        **{name: float(getattr(search, name).numpy()[0]) for name in (*values, *whole)},
        "pending count": int(status[int(line_search.PENDING)]),
        "running count": int(status[int(line_search.RUNNING)]),
    }


def test_a_trial_is_accepted_exactly_where_it_decreases_the_energy_enough():
    """Armijo: by a ten-thousandth of what the slope promises over the step."""
    bound = 5.0 - 1e-4 * 2.0
    for energy, accepted in ((4.0, 1), (bound - 1e-9, 1), (bound + 1e-9, 0), (6.0, 0)):
        end = decided(trial_energy=energy, trial_residual=0.1)
        assert end["accepted"] == accepted
        assert end["pending"] == end["pending count"] == 1 - accepted
        assert end["running count"] == 1
        assert (end["energy"], end["residual"]) == ((energy, 0.1) if accepted else (5.0, 0.7))
        assert end["step"] == (1.0 if accepted else 0.5)
        assert end["iterations"] == 4


def test_near_the_minimum_and_under_rounding_progress_is_a_smaller_residual():
    uphill = {"trial_energy": 6.0}
    assert decided(**uphill, residual=9e-3, trial_residual=8e-3)["accepted"] == 1
    assert decided(**uphill, residual=9e-3, trial_residual=9.5e-3)["accepted"] == 0
    assert decided(**uphill, residual=1.1e-2, trial_residual=1e-3)["accepted"] == 0
    assert decided(**uphill, slope=-1e-13, residual=0.5, trial_residual=0.4)["accepted"] == 1
    assert decided(**uphill, slope=-1e-11, residual=0.5, trial_residual=0.4)["accepted"] == 0


def test_a_step_that_collision_detection_shortens_is_tried_again_a_little_shorter():
    end = decided(fraction=0.4)
    assert end["accepted"] == 0
    assert end["pending count"] == 1
    assert 0.9 * 0.4 < end["step"] < 0.4


def test_a_world_has_converged_where_a_full_step_is_short_and_forces_balance():
    still = {"motion": 0.9 * MOVE, "residual": 0.9 * REST}
    end = decided(**still)
    assert (end["running"], end["pending"], end["accepted"], end["iterations"]) == (0, 0, 0, 3)
    for moving in ({"motion": 1.1 * MOVE}, {"residual": 1.1 * REST}, {"first": 0}):
        assert decided(**still | moving)["running"] == 1


def test_nothing_is_decided_while_systems_are_unsolved():
    end = decided(unsolved=1)
    assert (end["accepted"], end["pending"], end["running"], end["step"]) == (0, 1, 1, 1.0)


def test_hessians_are_exact_below_the_residual_that_asks_for_it():
    exact = flags(0, 0)
    residual = numbers(0.99 * EXACT, 1.01 * EXACT)
    wp.launch(
        line_search.choose_exact,
        dim=2,
        device="cpu",
        inputs=[numbers(MOVE, REST, EXACT), residual],
        outputs=[exact],
    )
    assert exact.numpy().tolist() == [1, 0]


def test_trials_that_are_not_wholly_safe_are_not_evaluated():
    safe = flags(5, 5)
    inputs = [numbers(1.0, 0.999), flags(*[0] * line_search.COUNTS)]
    wp.launch(line_search.select_safe, dim=2, device="cpu", inputs=inputs, outputs=[safe])
    assert safe.numpy().tolist() == [1, 0]


def test_a_world_that_finds_no_step_has_stalled_and_not_converged(monkeypatch):
    monkeypatch.setattr(newton_module, "BACKTRACKS", 0)
    model = hulls(worlds=2)
    run = Run(model, SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    run.potential.inertia.sigma.fill_(1000.0)
    wp.copy(run.potential.inertia.start, run.q)
    result = run.newton.minimise(run.q, np.array([True, False]), move_tolerance=1e-9)
    np.testing.assert_array_equal(result.stalled, [True, False])
    assert not result.converged.any()
    np.testing.assert_array_equal(run.state(), model.q0)


@pytest.mark.parametrize("refused", [False, True])
def test_a_whole_iteration_of_a_single_world_on_a_gpu_is_that_of_a_cpu_in_parts(monkeypatch, refused):
    """To the bit, where the systems are solved alike; those that are refused are solved afterwards."""
    # Only launches of kernels are recorded, not this solver.
    monkeypatch.setattr(LaunchGraph, "run", lambda self, shape=None: self._launches())
    ends, solved = [], {"at once": 0, "afterwards": 0}
    for on_gpu in (False, True):
        run = Run(edge_on_edge(0.3, 4e-4), SettleOptions(), lambda *_: None)
        solver = run.newton.solver

        def solve(hessian, when, solver=solver):
            solved[when] += 1
            solver.unsolved.zero_()
            solver.factorise_and_solve(hessian, np.ones(1, dtype=bool))

        def refuse(hessian, solver=solver):
            solver.unsolved.fill_(1)

        if on_gpu:
            solver.on_gpu = True
            monkeypatch.setattr(
                solver, "launch_solve", refuse if refused else lambda hessian: solve(hessian, "at once")
            )
            monkeypatch.setattr(solver, "solve_unsolved", lambda hessian: solve(hessian, "afterwards"))
        run.set_d_hat(1e-3)
        run.drop(4)
        ends.append((run.state(), run.iterations))
    assert ends[0][1] == ends[1][1] > 4
    # The last direction of every step is found to be short enough, and not gone.
    assert sum(solved.values()) == ends[1][1] + 4
    assert (solved["at once"] == 0) is refused
    np.testing.assert_array_equal(ends[1][0], ends[0][0])
    assert np.abs(ends[0][0] - run.model.q0).max() > 1e-4


def test_one_step_of_free_fall_is_that_of_implicit_euler():
    """By g dt^2 along -z without turning, whatever the mass."""
    model = hulls()
    run = Run(model, SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    run.anchor_friction(np.ones(1, dtype=bool))
    run.record_friction()
    run.step(np.ones(1, dtype=bool), np.ones(1), move_tolerance=1e-9, residual_tolerance=1e-10, max_iterations=50)
    change = run.state() - model.q0
    np.testing.assert_allclose(change[:, 0], np.tile([0, 0, -9.81 * 0.03**2], (2, 1)), rtol=0, atol=1e-11)
    np.testing.assert_allclose(change[:, 1:], 0, atol=1e-11)


def test_inertia_is_that_of_the_bodies_points():
    """Half of sigma times the integral of rho |x - x_n|^2 over a box, by samples, and m g times its centre's rise."""
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.06, 0.04), Pose(position=(0, 0, 1.0)))
    model = builder.finalize("cpu")
    change = np.random.default_rng(2).normal(size=(4, 3))
    inertia = Inertia(model)
    inertia.start.assign(model.q0)
    inertia.sigma.fill_(30.0)
    q = wp.array(model.q0 + change, dtype=wp.vec3d, device="cpu")
    energy, gradient = numbers(0.0), wp.zeros((1, 4), dtype=wp.vec3d, device="cpu")
    at = Evaluation(q=q, position=wp.zeros(8, dtype=wp.vec3d, device="cpu"), active=flags(1))
    for launch in inertia.value_launches(at, energy, gradient):
        launch("cpu")
    axes = [(np.arange(40) + 0.5) / 40 - 0.5] * 3
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3) * [0.1, 0.06, 0.04]
    mass = float(model.body_mass.numpy()[0])
    expected = (
        15.0 * mass * np.mean(np.sum((change[0] + points @ change[1:]) ** 2, axis=1)) + mass * 9.81 * change[0, 2]
    )
    # Midpoints of 40 cells along a side miss 1 / 1600 of the second moment.
    assert energy.numpy()[0] == pytest.approx(expected, rel=1e-3)
