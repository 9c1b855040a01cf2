import numpy as np
import pytest

from pat3d.layout.flat import Item, Surface
from pat3d.layout.surfaces import _STRATEGIES, _too_many, arrange_flat


def square(side, name="square"):
    half = np.full(2, side / 2)
    corners = half * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]])
    return Item(name=name, low=-half, high=half, outline=corners, centre_of_mass=np.zeros(2), tall=0.1)


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
