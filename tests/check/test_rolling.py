"""Closed forms of bodies that balance on one another in a point."""

import manifold3d
import numpy as np
import pytest

from pat3d.check.rolling import curvature, rolling
from pat3d.geometry.footprints import Plane

UP = Plane(axes=np.eye(3), offset=0.0)
FLAT = np.zeros((2, 2))


def _round(*radii):
    """Vertices [m] and faces of an ellipsoid that stands on the origin."""
    return _mesh(manifold3d.Manifold.sphere(1.0, 48).scale(radii).translate((0, 0, radii[2])))


def _lying(radius, sides=48):
    """A cylinder 8 radii long that lies along x, on one of its edges."""
    log = manifold3d.Manifold.cylinder(8 * radius, radius, radius, sides, True).rotate((0, 90, 0))
    return _mesh(log.translate((0, 0, radius)))


def _mesh(solid):
    mesh = solid.to_mesh64()
    return np.asarray(mesh.vert_properties)[:, :3], np.asarray(mesh.tri_verts, dtype=np.int32)


def _turned_over(mesh):
    return mesh[0] * [1, 1, -1], mesh[1]


def _curvature(mesh, side=1.0):
    return curvature(*mesh, UP, np.zeros(2), side, float(np.ptp(mesh[0], axis=0).max()))


@pytest.mark.parametrize("radii", [(0.04, 0.04, 0.04), (0.03, 0.03, 0.04), (0.05, 0.04, 0.03)])
def test_the_curvature_of_an_ellipsoid_at_its_end_is_its_height_over_its_width_squared(radii):
    a, b, c = radii
    np.testing.assert_allclose(_curvature(_round(*radii)), np.diag([c / a**2, c / b**2]), rtol=0.01, atol=0.01)


def test_a_box_and_a_can_stand_on_no_point():
    assert _curvature(_mesh(manifold3d.Manifold.cube((1, 1, 1), True).translate((0, 0, 0.5)))) is None
    assert _curvature(_mesh(manifold3d.Manifold.cylinder(0.1, 0.02, 0.02, 48))) is None


@pytest.mark.parametrize("sides", [32, 48, 96])
def test_a_log_that_lies_is_round_across_and_straight_along(sides):
    """It has no vertices between its ends: its edges are lines of the smooth surface."""
    np.testing.assert_allclose(_curvature(_lying(0.05, sides)), np.diag([0.0, 20.0]), rtol=0.01, atol=0.01)


@pytest.mark.parametrize(("a", "c"), [(0.03, 0.05), (0.02, 0.04), (0.02, 0.06)])
def test_a_slender_end_is_looked_at_closer(a, c):
    np.testing.assert_allclose(_curvature(_round(a, a, c)), np.diag([c / a**2] * 2), rtol=0.02, atol=0.01)


def test_a_ball_on_a_floor_is_neutral_and_an_egg_stands_on_neither_end_but_lies():
    ball, end, lying = _round(0.04, 0.04, 0.04), _round(0.03, 0.03, 0.04), _round(0.04, 0.03, 0.03)
    assert rolling(_curvature(ball), FLAT, 0.04) == "neutral"
    assert rolling(_curvature(end), FLAT, 0.04) == "unstable"
    # About its long axis it rolls; along it, it comes back.
    assert rolling(_curvature(lying), FLAT, 0.03) == "neutral"
    assert rolling(_curvature(_round(0.05, 0.05, 0.03)), FLAT, 0.03) == "stable"


CRITICAL = [(0.985, "stable"), (1.015, "unstable")]
"""Heights of a centre of mass over the critical one. Within a hundredth nobody can tell; curvatures of pictures are
known to a third of that."""


@pytest.mark.parametrize(("factor", "expected"), CRITICAL)
@pytest.mark.parametrize("hollow", [0.03, 0.06, 0.2])
def test_a_ball_stays_in_a_hollow_of_a_sphere_up_to_a_height(hollow, factor, expected):
    """Radii r and R, weighted so that its centre of mass is h up: 1/h = 1/r - 1/R."""
    radius = 0.02
    # Of the hollow's surface the body is outside: seen from above the plane it curves up, as the ball does.
    lower = -_curvature(_round(hollow, hollow, hollow))
    height = factor / (1 / radius - 1 / hollow)
    assert rolling(_curvature(_round(radius, radius, radius)), lower, height) == expected


@pytest.mark.parametrize(("factor", "expected"), CRITICAL)
@pytest.mark.parametrize("lower", [0.03, 0.1, 0.5])
def test_a_rounded_block_balances_on_a_ball_up_to_a_height(lower, factor, expected):
    """Radii r and R below a centre h up: 1/h = 1/r + 1/R."""
    upper = 0.05
    height = factor / (1 / upper + 1 / lower)
    below = _turned_over(_round(lower, lower, lower))
    assert rolling(_curvature(_round(upper, upper, upper)), _curvature(below, -1.0), height) == expected


@pytest.mark.parametrize(("factor", "expected"), CRITICAL)
@pytest.mark.parametrize("supports", ["floor", "log", "ball"])
def test_an_egg_lies_up_to_a_height_on_a_floor_on_a_log_and_on_a_ball(supports, factor, expected):
    """Half axes (a, b, c) with c up are bent c/a^2 and c/b^2 below; what is under it adds 0, 1/R across, or 1/R."""
    a, b, c, radius = 0.05, 0.04, 0.03, 0.1
    below = {
        "floor": FLAT,
        "log": _curvature(_turned_over(_lying(radius)), -1.0),
        "ball": _curvature(_turned_over(_round(radius, radius, radius)), -1.0),
    }[supports]
    across = c / b**2 + (0.0 if supports == "floor" else 1 / radius)
    assert rolling(_curvature(_round(a, b, c)), below, factor / max(across, c / a**2)) == expected


@pytest.mark.parametrize(("factor", "expected"), CRITICAL)
@pytest.mark.parametrize("hollow", [0.0, 0.1, 0.3])
def test_a_log_lies_in_a_trough_up_to_a_height(hollow, factor, expected):
    """1/h = 1/r - 1/R, and on a floor its centre is at the critical height itself."""
    radius = 0.05
    lower = -_curvature(_lying(hollow)) if hollow else FLAT
    height = factor / (1 / radius - (1 / hollow if hollow else 0.0))
    assert rolling(_curvature(_lying(radius)), lower, height) == expected


@pytest.mark.parametrize(("factor", "expected"), CRITICAL)
def test_a_flat_slab_stays_on_a_log_while_its_centre_is_lower_than_the_radius(factor, expected):
    log = _curvature(_turned_over(_lying(0.05)), -1.0)
    assert rolling(FLAT, log, 0.05 * factor) == expected
    assert rolling(FLAT, np.diag([1 / 0.05, 0.0]), 0.05 * factor) == expected
