"""A perturbed mass is a perturbed density: everything that follows from it changes alike, and comes back."""

from dataclasses import replace

import numpy as np
import pytest

from pat3d.policies_eval.run.perturb import Perturbation


def test_inertia_follows_the_mass_and_both_come_back(runner, episode):
    runner.start(episode)
    model, bodies = runner.env.simulation.model, runner.env.simulation.world.bodies
    mass, inertia, whole = model.body_mass.copy(), model.body_inertia.copy(), model.body_subtreemass.copy()
    _, _, drawn = runner.start(replace(episode, perturbation=Perturbation(mass=1.0)))
    model = runner.env.simulation.model
    for name, factor in drawn["mass"].items():
        body = bodies[name]
        assert abs(factor - 1.0) > 1e-6
        assert model.body_mass[body] == pytest.approx(factor * mass[body])
        np.testing.assert_allclose(model.body_inertia[body], factor * inertia[body])
    added = sum((factor - 1.0) * mass[bodies[name]] for name, factor in drawn["mass"].items())
    assert model.body_subtreemass[0] - whole[0] == pytest.approx(added)
    runner.start(episode)
    np.testing.assert_array_equal(runner.env.simulation.model.body_mass, mass)
    np.testing.assert_array_equal(runner.env.simulation.model.body_inertia, inertia)
