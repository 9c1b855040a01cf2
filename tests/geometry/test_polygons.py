import numpy as np
import pytest

from pat3d.geometry.polygons import contains, outline, polygon_gap, polygon_margin

SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
"""Counter-clockwise."""


@pytest.mark.parametrize(
    ("shift", "gap"),
    [
        ((1.5, 0.0), 0.5),
        ((1.3, 1.4), 0.5),
        ((0.0, -3.0), 2.0),
        ((0.5, 0.5), 0.0),
        ((1.0, 0.0), 0.0),
        ((0.0, 0.0), 0.0),
    ],
)
def test_the_gap_between_shifted_squares(shift, gap):
    """3-4-5: diagonal neighbours 0.3 and 0.4 apart have their corners 0.5 apart."""
    assert polygon_gap(SQUARE, SQUARE + shift) == pytest.approx(gap, abs=1e-12)
    assert polygon_gap(SQUARE + shift, SQUARE[::-1]) == pytest.approx(gap, abs=1e-12)


def test_crossed_bars_overlap_though_no_corner_is_inside_the_other():
    bar = np.array([[-2.0, -0.1], [2.0, -0.1], [2.0, 0.1], [-2.0, 0.1]])
    assert polygon_gap(bar, bar[:, ::-1]) == 0.0


def test_one_inside_the_other_has_no_gap():
    assert polygon_gap(0.1 * SQUARE + 0.4, SQUARE) == 0.0


@pytest.mark.parametrize(
    ("point", "inside"), [((0.5, 0.5), True), ((1.0, 0.5), True), ((1.0 + 1e-9, 0.5), False), ((-0.1, 0.5), False)]
)
def test_the_border_belongs_to_a_polygon(point, inside):
    assert contains(SQUARE, np.array(point)) is inside
    assert contains(SQUARE[::-1], np.array(point)) is inside


def test_the_outline_is_the_corners_in_turn_and_a_line_has_its_ends():
    rng = np.random.default_rng(0)
    corners = outline(np.concatenate([rng.uniform(0.1, 0.9, (20, 2)), SQUARE]))
    assert {tuple(corner) for corner in corners} == {tuple(corner) for corner in SQUARE}
    x, y = corners.T
    assert np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)) / 2 == pytest.approx(1.0)  # positive: counter-clockwise
    assert outline(np.array([[0.0, 0.0], [1.0, 2.0], [0.5, 1.0]])).tolist() == [[0.0, 0.0], [1.0, 2.0]]


def test_the_margin_is_the_distance_to_the_nearest_edge_and_negative_outside():
    assert polygon_margin(SQUARE, np.array([0.5, 0.3]), tolerance=0.1) == pytest.approx(0.3)
    assert polygon_margin(SQUARE, np.array([0.5, -0.3]), tolerance=0.1) == pytest.approx(-0.3)
    assert polygon_margin(SQUARE[:2], np.array([0.0, 0.3]), tolerance=0.1) == pytest.approx(-0.2)
    assert polygon_margin(SQUARE[:0], np.zeros(2), tolerance=0.1) == -np.inf
