import math
from dataclasses import replace

import numpy as np
import pytest

from pat3d.layout.flat import Item, Lateral, Surface
from pat3d.layout.formations import CLOSE, Formation, Wishes
from pat3d.layout.places import INSIDE, _spots
from pat3d.layout.strategies import STRATEGIES, too_many
from pat3d.layout.surfaces import _Search, arrange_flat, natural_gap, ring_angles


def rectangle(x, y, name="rectangle"):
    half = np.array([x, y]) / 2
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    return Item(name=name, low=-half, high=half, outline=corners, centre_of_mass=np.zeros(2), tall=0.1)


def square(side, name="square"):
    return rectangle(side, side, name)


@pytest.mark.parametrize("strategy", [s for s in STRATEGIES if not s.overhang])
@pytest.mark.parametrize(("columns", "rows"), [(1, 1), (4, 3), (7, 1)])
def test_a_grid_that_fills_a_surface_is_not_too_many_and_one_more_is(strategy, columns, rows):
    side, gap = 0.1, strategy.least
    room = np.array([columns, rows]) * (side + gap) - gap
    surface = Surface(half_size=(room[0] / 2, room[1] / 2))
    items = [square(side) for _ in range(columns * rows)]
    assert not too_many(items, surface, strategy)
    assert too_many([*items, square(side)], surface, strategy)


def test_nothing_is_too_much_for_the_ground():
    assert not any(too_many([square(1.0)] * 1000, Surface(), strategy) for strategy in STRATEGIES)


def test_rectangles_stand_apart_on_the_surface():
    items = [square(0.1, f"square {k}") for k in range(5)]
    surface = Surface(half_size=(0.3, 0.12))
    spots = arrange_flat(items, [], surface)
    assert spots is not None
    places = np.array([spots[item.name].position for item in items])
    assert (np.abs(places) + 0.05 <= np.array(surface.half_size) + 1e-9).all()
    apart = np.abs(places[:, None] - places[None]).max(axis=2)[np.triu_indices(5, 1)]
    assert apart.min() >= 0.1 + min(strategy.least for strategy in STRATEGIES) - 1e-6


@pytest.mark.parametrize("order", [("mouse", "laptop"), ("laptop", "mouse")])
def test_a_mouse_is_right_of_the_laptop_that_it_is_next_to_unless_it_is_said_to_be_left(order):
    things = {
        "mouse": replace(rectangle(0.06, 0.1, "mouse"), alike="computer mouse"),
        "laptop": replace(rectangle(0.3, 0.2, "laptop"), alike="laptop"),
    }
    for kind, sign in (("next_to", 1.0), ("left_of", -1.0)):
        for child, parent in (order, order[::-1]) if kind == "next_to" else (("mouse", "laptop"),):
            told = [Lateral(child=child, kind=kind, parent=parent)]
            spots = arrange_flat([things[name] for name in order], told, Surface(half_size=(0.6, 0.4)))
            assert spots is not None
            assert sign * (spots["mouse"].position - spots["laptop"].position)[0] > 0.15


@pytest.mark.parametrize("strategy", [s for s in STRATEGIES if s.overhang])
@pytest.mark.parametrize("count", [1, 20])
def test_what_lies_across_and_stands_over_both_edges_as_far_as_it_may_is_not_too_many(strategy, count):
    """A row of long things that fills its surface and what may stand over it, turned by a quarter where they may be.

    Where none is turned there is no room for one more: as much stands over an edge as the things' own size allows.
    """
    long, wide = 0.4, 0.05
    row = count * (wide + strategy.least) - strategy.least - 2 * strategy.overhang * wide
    inside = (1 - 2 * strategy.overhang) * long
    surface = Surface(half_size=(row / 2, inside / 2))
    if strategy.quarters:
        assert not too_many([rectangle(long, wide)] * count, surface, strategy)
    else:
        assert not too_many([rectangle(wide, long)] * count, surface, strategy)
        assert too_many([rectangle(wide, long)] * (count + 1), surface, strategy)


@pytest.mark.parametrize(("share", "expected"), [(0.299, True), (0.301, False)])
def test_a_thing_stands_over_an_edge_by_three_tenths_of_its_size_at_most(share, expected):
    """Alone in the middle it stands over two opposite edges alike; without leave it stands over none."""
    side = 0.1
    surface = Surface(half_size=((0.5 - share) * side, 0.5))
    assert (arrange_flat([square(side)], [], surface) is not None) is expected
    assert arrange_flat([square(side)], [], surface, overhang=False) is None


@pytest.mark.parametrize("corner", [(1, 1), (-1, 1), (1, -1)])
def test_a_triangle_lies_on_a_round_surface_as_large_as_the_circle_about_its_box_and_no_smaller(corner):
    """Its box is brought to the middle; its corner is half the box's diagonal away, wherever its origin is."""
    side = 0.1
    points = np.array(corner) * side * np.array([[1, 1], [0, 1], [1, 0]])
    low, high = points.min(axis=0), points.max(axis=0)
    item = Item(name="a", low=low, high=high, outline=points, centre_of_mass=points.mean(axis=0), tall=0.1)
    for factor, expected in ((1.01, True), (0.99, False)):
        radius = factor * side / math.sqrt(2)
        found = arrange_flat([item], [], Surface(half_size=(radius, radius), disc=True), overhang=False)
        assert (found is not None) is expected


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


def box(low, high, name, middle=(0.0, 0.0), tall=0.1):
    """A rectangle with its origin anywhere in it, and the middle of its root elsewhere."""
    low, high = np.array(low), np.array(high)
    corners = np.array([low, high, [low[0], high[1]], [high[0], low[1]]])
    return Item(
        name=name, low=low, high=high, outline=corners, centre_of_mass=np.zeros(2), tall=tall, middle=np.array(middle)
    )


def apart(first, at, second, there):
    """Free distance of two rectangles along the axis that has more of it [m], their origins at given points."""
    return max(float(np.max(at + first.low - there - second.high)), float(np.max(there + second.low - at - first.high)))


def searching(items, placed, wishes):
    """A search with some items at their places already."""
    search = _Search(items, [], Surface(), {}, STRATEGIES[0], wishes)
    by_name = {item.name: item for item in items}
    search.offsets = [one.offsets(by_name, [], search._natural) for one in wishes.formations]
    search.placed = {name: (by_name[name], np.array(spot), False) for name, spot in placed.items()}
    return search


def test_the_first_of_a_row_goes_where_the_others_have_room_beside_what_is_there():
    """Things that carry others beside them: the middles of the carriers are in the row, the outlines off them."""
    lead = box((-0.05, -0.03), (0.15, 0.04), "lead", middle=(-0.01, 0.005))
    mates = [
        box((-0.2, -0.05), (0.03, 0.05), "second", middle=(-0.02, 0.01)),
        box((-0.04, -0.1), (0.06, 0.02), "third", middle=(0.01, -0.03)),
    ]
    post = box((-0.02, -0.06), (0.05, 0.01), "post")
    search = searching(
        [lead, *mates, post],
        {"post": (0.3, -0.2)},
        Wishes(formations=(Formation(members=("lead", "second", "third")),)),
    )
    (offsets,) = search.offsets
    ticks = np.linspace(-0.8, 0.8, 41)
    centres = np.stack(np.meshgrid(ticks, ticks + 0.003, indexing="ij"), axis=-1).reshape(-1, 2)
    expected = []
    for centre in centres:
        middle = centre - (lead.low + lead.high) / 2 + lead.middle
        origins = [middle + offsets[mate.name] - offsets["lead"] - mate.middle for mate in mates]
        gaps = [
            (apart(mate, at, post, np.array([0.3, -0.2])), search._gap(mate, post))
            for mate, at in zip(mates, origins, strict=True)
        ]
        expected.append(all(free >= 0.999 * gap for free, gap in gaps))
    assert 50 < sum(expected) < len(expected) - 50
    np.testing.assert_array_equal(search._leaves_room(lead, centres), expected)


def test_a_row_of_things_with_loads_beside_them_is_in_line_by_its_middles_and_clear_of_what_was_there():
    members = [
        box((-0.05, -0.03), (0.15, 0.04), "a", middle=(-0.01, 0.005)),
        box((-0.2, -0.05), (0.03, 0.05), "b", middle=(-0.02, 0.01)),
        box((-0.04, -0.1), (0.06, 0.02), "c", middle=(0.01, -0.03)),
    ]
    post = box((-0.02, -0.06), (0.05, 0.01), "post")
    surface = Surface(half_size=(0.6, 0.4))
    spots = arrange_flat([post, *members], [], surface, wishes=Wishes(formations=(Formation(members=("a", "b", "c")),)))
    assert spots is not None
    middles = np.array([spots[item.name].position + item.middle for item in members])
    np.testing.assert_allclose(middles[:, 1], middles[0, 1], atol=1e-9)
    everything = [post, *members]
    for k, first in enumerate(everything):
        for second in everything[k + 1 :]:
            gap = natural_gap(first.size, second.size) if first is post else CLOSE / 2
            assert apart(first, spots[first.name].position, second, spots[second.name].position) >= 0.998 * gap


def test_what_is_hidden_costs_by_the_share_of_its_width():
    """A tall thing before a flat one, against a flat one in its place: 0.6 of the larger side where all is hidden."""
    behind = box((-0.1, -0.04), (0.1, 0.04), "behind", tall=0.1)
    xs = np.linspace(-0.3, 0.3, 61)
    costs = []
    for tall in (0.5, 0.05):
        before = box((-0.05, -0.03), (0.05, 0.03), "before", tall=tall)
        search = searching([behind, before], {"behind": (0.02, 0.1)}, Wishes())
        spot = np.array([0.02, 0.1])
        centres = np.stack([xs, np.full(len(xs), -0.1)], axis=1)
        costs.append(search._taste(before, centres, (spot + behind.low)[None], (spot + behind.high)[None]))
    shared = np.minimum(xs + 0.05, 0.12) - np.maximum(xs - 0.05, -0.08)
    np.testing.assert_allclose(costs[0] - costs[1], 0.6 * 0.2 * np.clip(shared / 0.1, 0.0, None), atol=1e-12)


@pytest.mark.parametrize("half", [(0.6, 0.4), (0.2, 0.15)])
def test_things_are_put_at_every_edge_and_in_every_corner(half):
    """Three places along an edge for what is not long, as near to it as the layout puts things there."""
    item = box((-0.05, -0.02), (0.01, 0.06), "a")
    surface, inset = Surface(half_size=half), np.minimum(INSIDE[0], INSIDE[1] * np.array(half))
    for kind, at_once in (("at_edge", 1), ("in_corner", 2)):
        spots = np.array(_spots(kind, item, surface))
        free = np.concatenate([np.array(half) - spots - item.high, spots + item.low + np.array(half)], axis=1)
        near = np.isclose(free, np.tile(inset, 2))
        assert (free >= np.tile(inset, 2) - 1e-9).all()
        assert (near.sum(axis=1) == at_once).all()
        assert len(np.unique(spots.round(9), axis=0)) == len(spots)
        # To the right, behind, to the left, in front.
        assert near.sum(axis=0).tolist() == ([1, 3, 1, 3] if kind == "at_edge" else [2, 2, 2, 2])


def test_what_is_long_lies_along_the_edge_before_or_behind():
    item = box((-0.1, -0.02), (0.1, 0.02), "a")
    spots = np.array(_spots("at_edge", item, Surface(half_size=(0.6, 0.4))))
    assert len(spots) == 6
    np.testing.assert_allclose(np.abs(spots[:, 1]), 0.4 - INSIDE[0] - 0.02)
