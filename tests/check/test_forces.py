"""Forces to be drawn hold every object up: their sum is its weight, and they lie inside the friction cones."""

import numpy as np
import pytest

from pat3d.check.forces import contact_forces
from pat3d.scene.physics import GRAVITY
from tests.scenes import tower


def test_forces_of_a_tower_carry_the_weights_above():
    """Of three equal boxes the ground carries three weights, the lowest two and the middle one."""
    scene = tower(3)
    found = contact_forces(scene)
    weight = scene.objects[0].asset.mass_properties.mass * GRAVITY
    total = np.zeros((3, 3))
    for (first, second), force in zip(found.bodies.tolist(), found.forces, strict=True):
        total[first] += force
        if second >= 0:
            total[second] -= force
    assert total == pytest.approx(np.tile([0.0, 0.0, weight], (3, 1)), abs=2e-3 * weight)
    ground = (found.bodies == -1).any(axis=1)
    assert np.abs(found.forces[ground].sum(axis=0)[2]) == pytest.approx(3 * weight, rel=5e-3)


def test_what_nothing_holds_has_no_forces():
    assert len(contact_forces(tower(2, gap=1e-3)).forces) == 0
