"""What friction counts from when recorded steps are run again: every world's own state, wherever it is kept."""

import numpy as np
import pytest
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.model import ModelBuilder
from pat3d.sim.recording import Recording, Replay
from pat3d.sim.run import SettleOptions
from pat3d.sim.tape import StepRecord
from tests.sim.builders import add_hull, box_points

EVERY, WORLDS, BODIES = 3, 4, 2
STEPS = 8


@pytest.fixture(scope="module")
def model():
    builder = ModelBuilder()
    for k in range(BODIES):
        add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.06 + 0.11 * k)))
    return builder.finalize("cpu", worlds=WORLDS)


def array(values):
    return wp.array(values, dtype=wp.vec3d, device="cpu")


@pytest.mark.parametrize(
    ("k", "numbers"),
    [
        (4, [3, 3, 3, 3]),
        (5, [5, 5, 5, 5]),
        (5, [3, 4, 5, 4]),
        (5, [0, 4, 3, 5]),
        (7, [0, 3, 6, 7]),
        (7, [2, 3, 7, 0]),
        (7, [4, 2, 4, 6]),
    ],
)
def test_every_world_counts_from_the_state_with_its_number(model, k, numbers):
    """States of this stretch, kept ones before it, and ones that were not kept, which the record has on its own."""
    every_state = np.random.default_rng(0).normal(size=(STEPS + 1, model.bodies, 4, 3))
    of_body = np.repeat(np.arange(WORLDS), BODIES)
    expected = every_state[np.array(numbers)[of_body], np.arange(model.bodies)]
    first = k // EVERY * EVERY
    lost = [number < first and number % EVERY != 0 for number in numbers]
    steps = [
        StepRecord(
            active=np.ones(WORLDS, dtype=bool),
            sigma=np.ones(WORLDS),
            d_hat=1e-3,
            lag_d_hat=1e-3,
            epsilon=1e-5,
            reference=np.array(numbers),
        )
    ] * STEPS
    kept = [*range(0, STEPS, EVERY), STEPS]
    record = Recording(
        model=model,
        options=SettleOptions(),
        friction=np.full(WORLDS, 0.5),
        kept=np.array(kept),
        every=EVERY,
        steps=steps,
        calls=[],
        references={first: array(expected)} if any(lost) else {},
    )
    inner = [array(every_state[number]) for number in range(first, k + 1)]
    found = Replay(record).reference(k, first, inner, array(every_state[kept]))
    np.testing.assert_array_equal(found.numpy(), expected)
