import math

import numpy as np
import pytest

from pat3d.layout.flat import Item, Lateral, Surface
from pat3d.layout.surfaces import _STRATEGIES, _too_many, arrange_flat, natural_gap, ring_angles


def rectangle(x, y, name="rectangle"):
    half = np.array([x, y]) / 2
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    return Item(name=name, low=-half, high=half, outline=corners, centre_of_mass=np.zeros(2), tall=0.1)


def square(side, name="square"):
    return rectangle(side, side, name)


@pytest.mark.parametrize("strategy", [s for s in _STRATEGIES if not s.overhang])
@pytest.mark.parametrize(("columns", "rows"), [(1, 1), (4, 3), (7, 1)])
def test_a_grid_that_fills_a_surface_is_not_too_many_and_one_more_is(strategy, columns, rows):
    side, gap = 0.1, strategy.least
    room = np.array([columns, rows]) * (side + gap) - gap
    surface = Surface(half_size=(room[0] / 2, room[1] / 2))
    items = [square(side) for _ in range(columns * rows)]
    assert not _too_many(items, surface, strategy)
    assert _too_many([*items, square(side)], surface, strategy)


def test_nothing_is_too_much_for_the_ground():
    assert not any(_too_many([square(1.0)] * 1000, Surface(), strategy) for strategy in _STRATEGIES)


def test_rectangles_stand_apart_on_the_surface():
    items = [square(0.1, f"square {k}") for k in range(5)]
    surface = Surface(half_size=(0.3, 0.12))
    spots = arrange_flat(items, [], surface)
    assert spots is not None
    places = np.array([spots[item.name].position for item in items])
    assert (np.abs(places) + 0.05 <= np.array(surface.half_size) + 1e-9).all()
    apart = np.abs(places[:, None] - places[None]).max(axis=2)[np.triu_indices(5, 1)]
    assert apart.min() >= 0.1 + min(strategy.least for strategy in _STRATEGIES) - 1e-6


@pytest.mark.parametrize("strategy", [s for s in _STRATEGIES if s.overhang and s.quarters])
def test_what_lies_across_and_stands_over_both_edges_as_far_as_it_may_is_not_too_many(strategy):
    """Turned by a quarter it covers the width exactly, and its length less what may stand over the edges."""
    long, wide = 0.4, 0.05
    inside = 1 - 2 * strategy.overhang
    surface = Surface(half_size=(wide * inside / 2, long * inside / 2))
    assert not _too_many([rectangle(long, wide)], surface, strategy)


AXIS = {"left_of": (0, -1), "right_of": (0, 1), "in_front_of": (1, -1), "behind": (1, 1)}


@pytest.mark.parametrize("kind", AXIS)
def test_a_thing_at_a_side_is_in_line_and_a_natural_gap_away(kind):
    first, second = rectangle(0.2, 0.1, "first"), rectangle(0.1, 0.2, "second")
    spots = arrange_flat([first, second], [Lateral(child="second", kind=kind, parent="first")], Surface())
    assert spots is not None
    offset = spots["second"].position - spots["first"].position
    axis, sign = AXIS[kind]
    # Places are rounded to a micrometre.
    apart = float((first.size + second.size)[axis] / 2 + natural_gap(first.size, second.size))
    assert sign * offset[axis] == pytest.approx(apart, abs=2e-6)
    assert offset[1 - axis] == pytest.approx(0.0, abs=2e-6)


@pytest.mark.parametrize("count", [3, 4, 6])
def test_things_around_another_stand_near_their_own_angles_and_as_near_as_their_gap_lets_them(count):
    centre = rectangle(0.5, 0.3, "centre")
    names = [f"chair {k}" for k in range(count)]
    laterals = [Lateral(child=name, kind="around", parent="centre") for name in names]
    spots = arrange_flat([centre, *(square(0.05, name) for name in names)], laterals, Surface())
    assert spots is not None
    gap = natural_gap(centre.size, np.full(2, 0.05))
    for name, angle in ring_angles(laterals).items():
        offset = spots[name].position - spots["centre"].position
        turn = math.atan2(offset[1], offset[0]) - angle
        # The widest step aside that is tried where something is in the way or nearer the middle.
        assert abs(math.remainder(turn, 2 * math.pi)) <= 0.3 + 1e-5
        # Clear of the centre by the gap along one axis at least, and by no more along the other.
        clear = np.abs(offset) - (centre.size + 0.05) / 2
        assert float(clear.max()) == pytest.approx(gap, abs=2e-6)
