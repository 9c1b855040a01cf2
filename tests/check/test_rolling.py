"""Closed forms of bodies that balance on one another in a point."""

import manifold3d
import numpy as np
import pytest

from pat3d.check.rolling import curvature, rolling
from pat3d.geometry.footprints import Plane

UP = Plane(axes=np.eye(3), offset=0.0)
FLAT = np.zeros((2, 2))


def _round(*radii):
    """Vertices of an ellipsoid [m] that stands on the origin."""
    mesh = manifold3d.Manifold.sphere(1.0, 48).scale(radii).translate((0, 0, radii[2])).to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3]


def _curvature(vertices, side=1.0):
    return curvature(vertices, UP, np.zeros(2), side, float(np.ptp(vertices, axis=0).max()))


@pytest.mark.parametrize("radii", [(0.04, 0.04, 0.04), (0.03, 0.03, 0.04), (0.05, 0.04, 0.03)])
def test_the_curvature_of_an_ellipsoid_at_its_end_is_its_height_over_its_width_squared(radii):
    a, b, c = radii
    np.testing.assert_allclose(_curvature(_round(*radii)), np.diag([c / a**2, c / b**2]), rtol=0.01, atol=0.01)


def test_a_box_and_a_can_stand_on_no_point():
    box = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (0, 1)], dtype=float)
    can = np.asarray(manifold3d.Manifold.cylinder(0.1, 0.02, 0.02, 48).to_mesh64().vert_properties)[:, :3]
    assert _curvature(box) is None
    assert _curvature(can) is None


def test_a_ball_on_a_floor_is_neutral_and_an_egg_stands_on_neither_end_but_lies():
    ball, end, lying = _round(0.04, 0.04, 0.04), _round(0.03, 0.03, 0.04), _round(0.04, 0.03, 0.03)
    assert rolling(_curvature(ball), FLAT, 0.04) == "neutral"
    assert rolling(_curvature(end), FLAT, 0.04) == "unstable"
    # About its long axis it rolls; along it, it comes back.
    assert rolling(_curvature(lying), FLAT, 0.03) == "neutral"
    assert rolling(_curvature(_round(0.05, 0.05, 0.03)), FLAT, 0.03) == "stable"


@pytest.mark.parametrize(("factor", "expected"), [(0.95, "unstable"), (1.05, "stable")])
def test_a_ball_in_a_hollow_of_a_sphere_has_a_critical_radius(factor, expected):
    """Weighted so that its centre of mass is 1.5 r up, it stays in hollows of radius below 3 r: 1/r - 1/R = 1/h."""
    radius = 0.02
    hollow = 3.0 * radius / factor
    mesh = _round(hollow, hollow, hollow)
    # Of the hollow's surface the body is outside: seen from above the plane it curves up, as the ball does.
    lower = -_curvature(mesh)
    assert rolling(_curvature(_round(radius, radius, radius)), lower, 1.5 * radius) == expected


@pytest.mark.parametrize(("factor", "expected"), [(0.98, "stable"), (1.02, "unstable")])
def test_a_rounded_block_balances_on_a_ball_up_to_a_height(factor, expected):
    """Radii r and R below a centre h up: 1/h = 1/r + 1/R."""
    upper, lower = 0.05, 0.1
    height = factor / (1 / upper + 1 / lower)
    below = _round(lower, lower, lower) * [1, 1, -1]
    assert rolling(_curvature(_round(upper, upper, upper)), _curvature(below, -1.0), height) == expected


def test_a_flat_slab_on_a_cylinder_stays_while_its_centre_is_lower_than_the_radius():
    cylinder = np.diag([1 / 0.05, 0.0])
    assert rolling(FLAT, cylinder, 0.049) == "stable"
    assert rolling(FLAT, cylinder, 0.051) == "unstable"
