"""The record of lagged friction."""

import numpy as np
import pytest
import warp as wp

from pat3d.sim.run import Run, SettleOptions
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
