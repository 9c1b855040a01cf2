import numpy as np
import pytest
from scipy.spatial import ConvexHull

from pat3d.assets.mesh.inflation import inflation
from pat3d.assets.mesh.reduce import reduce_hull
from pat3d.assets.mesh.split import allowed, fitted


def _disc(radius, height, sides=64):
    angle = 2 * np.pi * np.arange(sides) / sides
    ring = radius * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return np.concatenate([np.column_stack([ring, np.full(sides, z)]) for z in (0.0, height)])


def _rim_excess(pieces, radius):
    """How far the reduced parts of `pieces` reach beyond a circle of `radius` at the base [m]."""
    corners = np.concatenate([reduce_hull(piece).vertices for piece in pieces])
    return float(np.linalg.norm(corners[np.abs(corners[:, 2]) < 1e-9, :2], axis=1).max()) - radius


@pytest.mark.parametrize(("radius", "height"), [(0.05, 0.025), (0.035, 0.15)])
def test_the_parts_of_a_disc_reach_at_most_a_millimetre_and_a_hundredth_beyond_its_rim(radius, height):
    """One part cannot: 17 sides around a circle of 50 mm have corners 0.9 mm beyond it, and ours 1.5 mm."""
    points = _disc(radius, height)
    limit = allowed(float(np.ptp(points, axis=0).max()))
    whole = _rim_excess([points], radius)
    done = fitted([points], limit, most=8)
    pieces = [one.points for one in done]
    assert whole > 1e-3
    assert len(pieces) in (2, 4)
    assert _rim_excess(pieces, radius) <= min(limit, whole / 2)
    assert all(inflation(reduce_hull(piece), piece).distance <= limit for piece in pieces)
    assert all(np.array_equal(one.part.vertices, reduce_hull(one.points).vertices) for one in done)


def test_the_pieces_of_a_hull_fill_it():
    """Volumes of the pieces of a ball add up to the ball's, and every point of it is in one of them."""
    rng = np.random.default_rng(0)
    ball = rng.normal(size=(300, 3))
    ball *= 0.04 / np.linalg.norm(ball, axis=1, keepdims=True)
    pieces = [one.points for one in fitted([ball], 1e-4, most=4)]
    assert len(pieces) == 4
    assert sum(ConvexHull(piece).volume for piece in pieces) == pytest.approx(ConvexHull(ball).volume, rel=1e-9)
    planes = [ConvexHull(piece).equations for piece in pieces]
    inside = [(ball @ one[:, :3].T + one[:, 3]).max(axis=1) < 1e-9 for one in planes]
    assert np.any(inside, axis=0).all()


def test_cuts_run_along_the_axis_of_a_can_and_keep_its_ends_whole_in_height():
    """Halves of half the height would be as round as the can."""
    pieces = [one.points for one in fitted([_disc(0.05, 0.2)], 1e-4, most=4)]
    assert len(pieces) > 1
    assert all(np.ptp(piece[:, 2]) == pytest.approx(0.2) for piece in pieces)


def test_a_box_stays_whole():
    corners = np.array([[x, y, z] for x in (0, 0.1) for y in (0, 0.2) for z in (0, 0.3)])
    (piece,) = fitted([corners], 1e-3, most=8)
    np.testing.assert_array_equal(piece.points, corners)


def test_where_pieces_are_few_the_one_that_sticks_out_most_is_cut():
    """A large disc beside a small one: only the large one's part may be cut."""
    large, small = _disc(0.06, 0.02), _disc(0.02, 0.02) + [0.2, 0.0, 0.0]
    done = fitted([small, large], 1e-4, most=3)
    assert len(done) == 3
    assert [one.cuts for one in done] == [0, 1, 1]
    np.testing.assert_array_equal(done[0].points, small)


def test_more_pieces_than_the_limit_are_left_as_they_are():
    discs = [_disc(0.05, 0.02) + [0.2 * k, 0.0, 0.0] for k in range(3)]
    assert [one.cuts for one in fitted(discs, 1e-5, most=2)] == [0, 0, 0]


@pytest.mark.parametrize(("size", "limit"), [(1.0, 1e-3), (0.05, 5e-4), (0.005, 2e-4)])
def test_a_part_may_stick_out_by_a_millimetre_and_a_hundredth_of_the_size(size, limit):
    assert allowed(size) == pytest.approx(limit)
