"""Parts of recipes that are cut back to what is seen (pat3d/assets/catalogue/trimmed.py)."""

import itertools

import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.distance import pdist

from pat3d.assets.catalogue import assemble, make
from pat3d.assets.catalogue.trimmed import MORE, MOST_PARTS, trimmed
from pat3d.assets.shapes import Shape, box, cylinder, ellipsoid, join, soft_box
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.planes import enclosed, face_count

SIZE = (0.3, 0.2, 0.1)
LIMIT = 1e-3


def _cushion(radius=0.02):
    """A box rounded to the eye, with the whole box for its part."""
    return Shape(soft_box(*SIZE, radius).solid, box(*SIZE).hulls)


def _points(shape):
    return np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3]


def _outside(points, hulls):
    """How far each point [m] is outside of all `hulls`, shape (n,)."""
    equations = [ConvexHull(hull).equations for hull in hulls]
    return np.min([(points @ one[:, :3].T + one[:, 3]).max(axis=1) for one in equations], axis=0)


def _reach(shape):
    """How far the corners of parts are beyond the hull of what is seen [m]."""
    equations = ConvexHull(_points(shape)).equations
    corners = np.concatenate(shape.hulls)
    return float((corners @ equations[:, :3].T + equations[:, 3]).max())


@pytest.mark.parametrize("radius", [0.005, 0.012, 0.02])
def test_corners_of_a_box_around_a_cushion_are_cut_off(radius):
    before = _cushion(radius)
    (after,) = trimmed([before], 1.0)
    # The picture of the rounding has flat sides.
    assert _reach(before) == pytest.approx(radius * (np.sqrt(3) - 1), rel=0.07)
    assert _reach(after) < 0.3 * _reach(before)
    assert _outside(_points(after), after.hulls).max() < 1e-9
    assert len(after.hulls) <= 1 + MORE
    for hull in after.hulls:
        part = convex_part(hull)
        assert len(part.vertices) <= 64
        assert face_count(part) <= 64
        assert pdist(part.vertices).min() > 2e-4
        # No part grows, and base and top are where they were.
        assert _outside(hull, before.hulls).max() < 1e-9
        assert (hull[:, 2].min(), hull[:, 2].max()) == pytest.approx((0.0, SIZE[2]), abs=1e-12)


def test_a_small_rounding_ends_within_what_is_allowed():
    assert _reach(trimmed([_cushion(0.005)], 1.0)[0]) <= LIMIT


def test_the_flat_of_a_base_is_as_large_as_what_is_seen_of_it():
    radius = 0.02
    (after,) = trimmed([_cushion(radius)], 1.0)
    corners = np.concatenate(after.hulls)
    base = ConvexHull(corners[corners[:, 2] < 1e-9, :2])
    inner = [[i * (SIZE[0] / 2 - radius), j * (SIZE[1] / 2 - radius)] for i, j in itertools.product((-1, 1), repeat=2)]
    assert (np.array(inner) @ base.equations[:, :2].T + base.equations[:, 2]).max() < 1e-9


def test_what_is_close_already_keeps_its_parts_as_they_are():
    shapes = [box(0.1, 0.1, 0.02), cylinder(0.01, 0.05).moved(z=0.02)]
    for before, after in zip(shapes, trimmed(shapes, 1.0), strict=True):
        assert [np.array_equal(*pair) for pair in zip(before.hulls, after.hulls, strict=True)] == [True]


def test_details_that_lie_in_the_part_of_another_stay_in_it():
    """A knob without a part of its own, in a box around a thin board; the corners over it are not cut off."""
    board = Shape(box(0.2, 0.2, 0.02).solid, box(0.2, 0.2, 0.05).hulls)
    knob = Shape(box(0.01, 0.01, 0.05).moved(0.09, 0.09).solid, ())
    after = trimmed([board, knob], 1.0)
    hulls = [hull for shape in after for hull in shape.hulls]
    for shape in after:
        assert _outside(_points(shape), hulls).max() < 1e-9
    assert np.concatenate(hulls)[:, 2].max() == pytest.approx(0.05)
    far = np.array([[-0.095, -0.095, 0.049]])
    assert _outside(far, [board.hulls[0]])[0] < 0.0
    assert _outside(far, hulls)[0] > 0.01


def test_a_part_is_halved_where_64_corners_are_too_few_and_an_object_of_many_parts_is_not():
    potato = Shape(ellipsoid(0.06, 0.04, 0.035).solid, box(0.12, 0.08, 0.07).moved(z=-0.035).hulls)
    (alone,) = trimmed([potato], 1.0)
    assert 2 <= len(alone.hulls) <= 1 + MORE
    assert _outside(_points(alone), alone.hulls).max() < 1e-9
    legs = [box(0.01, 0.01, 0.01).moved(0.02 * k, 0.2) for k in range(MOST_PARTS - 1)]
    assert len(trimmed([potato, *legs], 1.0)[0].hulls) == 1
    assert _reach(alone) < 0.6 * _reach(trimmed([potato, *legs], 1.0)[0])


def test_what_is_allowed_is_meant_for_the_object_as_it_will_be():
    """A doll's cushion, drawn 25 times as large: its part reaches 0.16 mm beyond it, and 0.2 are allowed."""
    assert len(trimmed([_cushion(0.005)], 0.04)[0].hulls[0]) == 8
    assert len(trimmed([_cushion(0.005)], 1.0)[0].hulls[0]) > 8


@pytest.mark.parametrize("seed", range(3))
def test_rounding_of_the_last_digit_changes_nothing(seed):
    noise = 1.0 + 1e-13 * np.random.default_rng(seed).normal(size=3)
    first, other = (trimmed([shape], 1.0)[0] for shape in (_cushion(), _cushion().scaled(*noise)))
    assert len(first.hulls) == len(other.hulls)
    for one, same in zip(first.hulls, other.hulls, strict=True):
        np.testing.assert_allclose(same, one, atol=1e-9)


def test_joined_shapes_are_looked_at_part_by_part():
    pair = join(_cushion(), _cushion().moved(x=1.0))
    (after,) = trimmed([pair], 1.0)
    assert _outside(_points(after), after.hulls).max() < 1e-9
    assert min(len(hull) for hull in after.hulls) > 8


@pytest.mark.parametrize("seed", range(5))
def test_the_corners_inside_of_planes_are_those_of_the_hull_they_are_taken_from(seed):
    points = np.random.default_rng(seed).normal(size=(12, 3))
    hull = ConvexHull(points)
    found = enclosed(hull.equations, points.mean(axis=0))
    assert len(found) == len(hull.vertices)
    expected = points[hull.vertices]
    assert np.abs(found[:, None] - expected[None]).max(axis=2).min(axis=0).max() < 1e-9


def test_what_rests_on_heads_keeps_its_recipe_s_parts(monkeypatch):
    """With corners cut three hats on an elephant balance on too little."""
    looked_at = []

    def noted(shapes, scale):
        looked_at.append(shapes)
        return trimmed(shapes, scale)

    monkeypatch.setattr(assemble, "trimmed", noted)
    for noun in sorted(assemble.WORN):
        make(noun, seed=97)
    assert not looked_at
    make("mug", seed=97)
    assert looked_at
