"""Runs that cannot end well say so, name the bodies, and leave a safe state behind."""

import tempfile

import numpy as np
import pytest
import warp as wp

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.ccd import fractions, safe_step
from pat3d.sim.failure import Status, blocking_pair
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.run import Run, SettleOptions
from pat3d.sim.settling import UnsettledError, settle
from pat3d.sim.solvers.line_search import LONGEST_STEP
from tests.sim.builders import add_hull, box_points
from tests.sim.drops import random_scene
from tests.sim.oracles import IntersectionOracle


@pytest.fixture(autouse=True)
def _dumps_in_the_tests_folder(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))


def boxes(*heights: float, worlds: int | None = None) -> Model:
    builder = ModelBuilder()
    for height in heights:
        add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, height)))
    return builder.finalize("cpu", worlds=worlds)


def test_what_does_not_rest_in_time_raises_with_its_safe_state():
    model = boxes(0.2, 0.4)
    with pytest.raises(UnsettledError, match=r"1 of 1 worlds did not come to rest.*still moving") as caught:
        settle(model, SettleOptions(max_frames=3, max_polish_steps=1))
    settled = caught.value.settled
    assert settled.status == (Status.STILL_MOVING,)
    with np.load(caught.value.path) as saved:
        np.testing.assert_array_equal(saved["q"], settled.q)
        assert list(saved["labels"]) == ["body", "body"]
    Run(model, SettleOptions(), lambda *_: None, settled.q).refuse_intersections()


def test_without_raising_the_status_of_every_world_is_returned():
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.051)))
    builder.new_world()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 2.0)))
    settled = settle(builder.finalize("cpu"), SettleOptions(max_frames=5, max_polish_steps=5), throw=False)
    assert settled.status == (Status.AT_REST, Status.STILL_MOVING)
    np.testing.assert_array_equal(settled.at_rest, [True, False])


class Sinking(Run):
    """Barriers without force, which let bodies sink until collision detection holds them."""

    def __init__(self, model: Model, throw: bool):
        super().__init__(model, SettleOptions(), lambda *_: None)
        self.throw = throw
        self.potential.contact.stiffness.zero_()
        self.set_d_hat(self.options.d_hat)


@pytest.mark.parametrize(("heights", "other"), [((0.06,), "the ground"), ((0.051, 0.16), "the ground")])
def test_a_step_that_nothing_is_allowed_of_raises_with_the_pair_and_the_time(heights, other):
    run = Sinking(boxes(*heights), throw=True)
    with pytest.raises(
        SimulationError, match=rf'cannot go on at step \d+ \(\d+\.\d+ s\): "body" and {other}'
    ) as caught:
        run.drop(30)
    path = str(caught.value).rsplit(" ", 1)[1].rstrip(".")
    with np.load(path) as saved:
        assert saved["q"][0, 0, 2] > 0.05
        assert saved["time"] == pytest.approx(saved["step"] * 0.03)


def test_a_blocked_pair_of_bodies_is_named():
    builder = ModelBuilder()
    builder.add_body(**body("table"), fixed=True, pose=Pose(position=(0, 0, 0.06)))
    builder.add_body(**body("cup"), pose=Pose(position=(0.01, 0.02, 0.17)))
    with pytest.raises(SimulationError, match=r'"(cup|table)" and "(cup|table)" are so close'):
        Sinking(builder.finalize("cpu"), throw=True).drop(30)


def body(label: str) -> dict:
    from pat3d.geometry.hulls import convex_part
    from pat3d.geometry.mass import mass_properties

    part = convex_part(box_points(0.1, 0.1, 0.1))
    properties = mass_properties(part.vertices, part.faces, density=500.0)
    return {
        "parts": [part],
        "mass": properties.mass,
        "volume": properties.volume,
        "label": label,
        "centre": np.array(properties.centre_of_mass),
        "second_moment": properties.second_moment,
    }


def test_a_blocked_world_stops_and_the_others_go_on():
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.051)))
    builder.new_world()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 5.0)))
    run = Sinking(builder.finalize("cpu"), throw=False)
    run.drop(12)
    assert run.halted == {0: Status.BLOCKED}
    heights = run.state()[:, 0, 2]
    assert heights[0] > 0.05
    assert heights[1] < 5 - 12 * 0.008
    assert run.unconverged[0] > 0
    assert run.unconverged[1] == 0


@pytest.mark.parametrize(
    ("height", "down", "motion", "bodies"),
    [
        (5.0, 0.002, 0.002, (-1, -1)),
        # No vertex moves further in one step, whatever the direction asks for.
        (5.0, 2.0, float(LONGEST_STEP), (-1, -1)),
        # Collision detection keeps a tenth of the clearance of 1 mm.
        (0.051, 0.002, 0.9e-3, (0, -1)),
        (0.051, 2.0, 0.9e-3, (0, -1)),
    ],
)
def test_the_motion_that_is_allowed_of_a_fall_and_what_limits_it(height, down, motion, bodies):
    newton = Run(boxes(height), SettleOptions(), lambda *_: None).newton
    direction = np.zeros((1, 4, 3))
    direction[0, 0, 2] = -down
    newton.direction.assign(direction)
    allowed, pair = blocking_pair(newton, 0)
    assert allowed == pytest.approx(motion, rel=1e-6)
    assert pair == bodies


def test_a_state_that_is_not_finite_is_refused():
    model = boxes(0.2)
    q = model.q0.copy()
    q[0, 1, 1] = np.nan
    with pytest.raises(SimulationError, match='"body" is not finite'):
        Run(model, SettleOptions(), lambda *_: None, q).refuse_intersections()


def test_the_step_that_is_safe_is_the_least_that_any_pair_allows():
    model = random_scene("concave", 5)
    rng, steps = np.random.default_rng(0), []
    oracle = IntersectionOracle(model)
    candidates = Candidates(model)
    for scale in (1.0, 3.0, 10.0):
        target = model.q0 + scale * rng.normal(size=(model.bodies, 4, 3)) * 0.1
        start, end = (wp.array(oracle.positions(q), dtype=wp.vec3d, device="cpu") for q in (model.q0, target))
        candidates.rebuild(start, end, 1e-3, 1e-4)
        step = wp.full(1, 1.0, dtype=wp.float64, device="cpu")
        safe_step(model, candidates, start, end, step)
        assert step.numpy()[0] == fractions(model, candidates, start, end).min(initial=1.0)
        steps.append(step.numpy()[0])
    assert min(steps) < 0.9
