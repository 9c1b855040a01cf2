"""What steers the polish: slip, residual and reversals of steps, and how inertia follows."""

from dataclasses import fields

import numpy as np
import pytest
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.run import MOST_INERTIA, Run, SettleOptions
from pat3d.sim.solvers.newton import NewtonResult
from tests.sim.builders import add_hull, box_points


def boxes(worlds: int) -> Model:
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.0507)))
    add_hull(builder, box_points(0.04, 0.04, 0.04), Pose(position=(0, 0, 1.0)))
    return builder.finalize("cpu", worlds=worlds)


def measured(run: Run, change: np.ndarray) -> tuple[np.ndarray, ...]:
    """Measures of a step that changes the state by `change`, shape (bodies, 4, 3)."""
    wp.copy(run.potential.inertia.start, run.q)
    run.q.assign(run.state() + change)
    run.record_friction()
    return run._measures.all()


@pytest.mark.parametrize("part", ["translation", "rotation"])
@pytest.mark.parametrize(("share", "reverses"), [(-0.45, False), (-0.55, True), (-1.5, True), (0.6, False)])
def test_a_step_reverses_the_last_where_it_undoes_more_than_half_of_it(part, share, reverses):
    """In the inner product of point motions: affine parts count times the radius, so both parts weigh alike."""
    run = Run(boxes(3), SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    rng = np.random.default_rng(0)
    change = np.zeros((6, 4, 3))
    rows = slice(0, 1) if part == "translation" else slice(1, 4)
    change[:, rows] = 1e-6 * rng.normal(size=change[:, rows].shape)
    assert not measured(run, change)[3].any(), "the first step has none before it"
    factors = np.repeat([share, 1.0, share], 2)[:, None, None]
    np.testing.assert_array_equal(measured(run, factors * change)[3], [reverses, False, reverses])
    run._measures.forget_last()
    assert not measured(run, -change)[3].any()


def test_bodies_count_by_how_far_their_points_move():
    """A translation that is undone outweighs a rotation that is not where it moves points further, and only then."""
    for size, reverses in ((4.0, True), (0.25, False)):
        model = boxes(1)
        run = Run(model, SettleOptions(), lambda *_: None)
        run.set_d_hat(1e-3)
        step = np.zeros((2, 4, 3))
        step[0, 0, 0] = size * 1e-6
        step[0, 1, 1] = 1e-6 / model.body_radius[0]
        measured(run, step)
        back = step.copy()
        back[0, 0] *= -1
        assert measured(run, back)[3][0] == reverses


def test_slip_is_the_tangential_motion_from_the_friction_anchor():
    run = Run(boxes(2), SettleOptions(), lambda *_: None)
    run.set_d_hat(1e-3)
    run.anchor_friction(np.array([True, True]))
    change = np.zeros((4, 4, 3))
    change[:, 0] = [3e-6, 4e-6, -1e-5]
    change[2:] *= 2
    move, _, slip, _ = measured(run, change)
    np.testing.assert_allclose(slip, [5e-6, 1e-5], rtol=1e-6)
    np.testing.assert_allclose(move, np.sqrt(125) * 1e-6 * np.array([1, 2]), rtol=1e-6)


def weights_of_relax(monkeypatch, moves: list[float], reversals: list[bool]) -> list[float]:
    """Inertia of the steps of a relaxation whose steps are measured as given; none leaves a residual."""
    run = Run(boxes(1), SettleOptions(max_polish_steps=len(moves)), lambda *_: None)
    weights, measures = [], iter(zip(moves, reversals, strict=True))

    def step(active, weight, **_):
        weights.append(float(weight[0]))
        values = {field.name: np.zeros(1, dtype=bool) for field in fields(NewtonResult)}
        return NewtonResult(**values)

    def read():
        move, reverses = next(measures)
        return np.array([move]), np.ones(1), np.ones(1), np.array([reverses])

    monkeypatch.setattr(run, "step", step)
    monkeypatch.setattr(run._measures, "all", read)
    run.relax(1e-3, 1e-6, 1e-8, slow=1e-4, fast=1e-3)
    return weights


def test_inertia_fades_while_steps_are_short_and_returns_when_they_are_long(monkeypatch):
    moves = [5e-5, 5e-5, 5e-4, 2e-3, 5e-5, 0.0]
    assert weights_of_relax(monkeypatch, moves, [False] * 6) == [1, 0.5, 0.25, 0.25, 1, 0.5]
    faded = weights_of_relax(monkeypatch, [0.0] * 30, [False] * 30)
    assert faded[-1] == 1e-6


def test_inertia_damps_steps_that_reverse_one_another(monkeypatch):
    """Sixteen times as much after each reversal, on top of what the length of the step asks for, up to a bound."""
    assert weights_of_relax(monkeypatch, [5e-4] * 4, [True, True, False, True]) == [1, 16, 256, 256]
    assert weights_of_relax(monkeypatch, [5e-5] * 3, [True] * 3) == [1, 8, 64]
    assert weights_of_relax(monkeypatch, [5e-4] * 10, [True] * 10)[-1] == MOST_INERTIA


def test_friction_is_anchored_once_creep_and_slip_are_slow_and_only_then_can_a_world_rest(monkeypatch):
    """A step after slow ones keeps the anchor; one whose slip is large moves it, however short the step was."""
    steps = [(1e-9, 1.0), (1e-9, 0.0), (1e-9, 1.0), (1e-9, 0.0), (1e-9, 0.0), (1e-9, 0.0)]
    run = Run(boxes(1), SettleOptions(max_polish_steps=len(steps)), lambda *_: None)
    anchored, residuals = [], iter([1.0, 1e-9, 1.0, 1.0, 1e-9, 1e-9])
    values = {field.name: np.zeros(1, dtype=bool) for field in fields(NewtonResult)}
    measures = iter(steps)

    def read():
        move, slip = next(measures)
        return np.array([move]), np.array([next(residuals)]), np.array([slip]), np.array([False])

    monkeypatch.setattr(run, "step", lambda *_, **__: NewtonResult(**values))
    monkeypatch.setattr(run, "anchor_friction", lambda worlds: anchored.append(bool(worlds[0])))
    monkeypatch.setattr(run._measures, "all", read)
    rested, residual = run.relax(1e-5, 1e-6, 1e-8, slow=1e-4, fast=1e-3)
    # Balanced after the second step, whose friction counted from its own start; at rest after the first that did not.
    assert anchored == [True, True, False, True, False]
    assert rested[0]
    assert residual[0] == 1e-9


def test_a_drop_ends_after_three_still_frames_in_a_row(monkeypatch):
    run = Run(boxes(1), SettleOptions(), lambda *_: None)
    moves = iter([1e-2, 1e-5, 1e-5, 1e-2, 1e-5, 1e-5, 1e-5, 1e-5])
    monkeypatch.setattr(run, "step", lambda *_, **__: None)
    monkeypatch.setattr(run._measures, "motion", lambda: np.array([next(moves)]))
    run.drop()
    assert run.frames == 7
