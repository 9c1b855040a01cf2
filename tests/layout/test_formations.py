"""Rings, joined outlines and the sharing out of shelves, on things whose origin is not in their middle."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pat3d.layout.bodies import Body
from pat3d.layout.flat import Item, Lateral
from pat3d.layout.formations import Formation, pairs
from pat3d.layout.group import Group
from pat3d.layout.layout import arrange
from pat3d.layout.places import _joined
from pat3d.layout.tops import item_of
from pat3d.scene.arrangements import crossing
from pat3d.scene.model import Relation
from tests.layout.things import ball, block, shelf


def items(count: int, seed: int) -> dict[str, Item]:
    """Boxes of 2 to 30 cm beside their origins."""
    rng = np.random.default_rng(seed)
    found = {}
    for name in "abcdefgh"[:count]:
        (x, y), aside = rng.uniform(0.02, 0.3, 2), rng.uniform(-0.2, 0.2, 2)
        item = item_of(Group((Body(name, block(x, y)).at(np.eye(3), np.zeros(3)),)), turnable=False)
        found[name] = replace(
            item, low=item.low + aside, high=item.high + aside, outline=item.outline + aside, middle=aside
        )
    return found


def rectangle(item: Item, middle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Its corners [m] where its middle is at `middle`."""
    return middle - item.size / 2, middle + item.size / 2


@pytest.mark.parametrize("centre", [(), ("a",)])
@pytest.mark.parametrize("count", [3, 5, 8])
def test_a_ring_is_even_keeps_all_gaps_and_is_hardly_larger_than_it_has_to_be(count, centre):
    def gap(first: Item, second: Item) -> float:
        return 0.01 + 0.1 * float(first.size[0] + second.size[0])

    def least_excess(offsets: dict[str, np.ndarray]) -> float:
        """Of the free distance of two rectangles, along the axis that separates them, over their gap."""
        return min(
            float(np.maximum(low - other_high, other_low - high).max()) - gap(things[a], things[b])
            for a, b in pairs(offsets)
            for low, high in [rectangle(things[a], offsets[a])]
            for other_low, other_high in [rectangle(things[b], offsets[b])]
        )

    things = items(count, seed=count)
    members = tuple(name for name in things if name not in centre)
    offsets = Formation(members=members, centre=centre, ring=True).offsets(things, (), gap)
    around = np.array([offsets[name] for name in members]) @ [1, 1j]
    np.testing.assert_allclose(np.abs(around), abs(around[0]))
    np.testing.assert_allclose(np.roll(around, -1) / around, np.exp(2j * np.pi / len(members)), atol=1e-9)
    assert not any(offsets[name].any() for name in centre)
    # Rings grow by steps of 2 %.
    assert least_excess(offsets) >= -1e-12
    assert least_excess({name: at / 1.02 for name, at in offsets.items()}) < 0.0


def test_rows_that_cross_are_a_lattice_of_equal_steps_whatever_the_sizes():
    """Two rows of three with their columns, of boxes of 2 to 30 cm: the least equal steps that keep gaps."""
    things = items(6, seed=4)
    rows = [("a", "b", "c"), ("d", "e", "f")]
    columns = [("a", "d"), ("b", "e"), ("c", "f")]
    (cells,) = crossing([*rows, *columns])
    assert cells == {"a": (0, 0), "b": (1, 0), "c": (2, 0), "d": (0, 1), "e": (1, 1), "f": (2, 1)}
    for order in (rows + columns, columns + rows, [columns[2], *rows, *columns[:2]]):
        (found,) = crossing(order)
        at = {name: np.array(cell) for name, cell in found.items()}
        steps = {tuple(at[b] - at[a]) for row in rows for a, b in zip(row, row[1:], strict=False)}
        assert len(steps) == 1, "the rows run one way, wherever the reading of them begins"
    behind = (Lateral(child="d", kind="behind", parent="a"), Lateral(child="a", kind="right_of", parent="b"))
    offsets = Formation(members=tuple(cells), cells=cells).offsets(things, behind, lambda _a, _b: 0.01)
    across, back = offsets["b"] - offsets["a"], offsets["d"] - offsets["a"]
    for name, (column, row) in cells.items():
        np.testing.assert_allclose(offsets[name] - offsets["a"], column * across + row * back, atol=1e-12)
    assert across[0] < 0.0, "the relation has the first on the right"
    assert back[1] > 0.0
    largest = np.max([item.size for item in things.values()], axis=0)
    np.testing.assert_allclose(np.abs(across + back), largest + 0.01)


def test_rows_that_cannot_cross_stay_rows():
    assert crossing([("a", "b", "c")]) == []
    assert crossing([("a", "b"), ("c", "d")]) == []
    assert crossing([("a", "b", "c"), ("a", "b", "c")]) == [], "one row said twice"
    assert crossing([("a", "b"), ("b", "c"), ("c", "a")]) == [], "a triangle"


def test_the_outline_of_a_formation_is_that_of_all_its_members_where_they_stand():
    things = items(3, seed=1)
    offsets = {"a": np.array([0.4, 0.0]), "b": np.array([0.0, 0.5]), "c": np.array([-0.3, -0.2])}
    joined = _joined("b", offsets, things)
    # The origin of the lead is at zero, so its middle is where the item has it; the others' are as far as they stand.
    middles = {name: things["b"].middle + at - offsets["b"] for name, at in offsets.items()}
    lows, highs = zip(*(rectangle(things[name], middle) for name, middle in middles.items()), strict=True)
    np.testing.assert_allclose(joined.low, np.min(lows, axis=0))
    np.testing.assert_allclose(joined.high, np.max(highs, axis=0))
    np.testing.assert_allclose(joined.outline.min(axis=0), joined.low)
    np.testing.assert_allclose(joined.outline.max(axis=0), joined.high)
    np.testing.assert_allclose(joined.middle, (joined.low + joined.high) / 2)


@pytest.mark.parametrize("seed", range(3))
def test_what_stands_beside_another_is_on_its_shelf_and_others_are_on_their_own(seed):
    assets = {
        "shelf": shelf(), "ball": ball(), "box": block(0.2, 0.15, 0.2, noun="box"), "hat": block(noun="hat"),
        "cup": block(0.05, 0.05, 0.08, noun="cup"),
    }  # fmt: skip
    relations = tuple(Relation(child=name, kind="on", parent="shelf") for name in assets if name != "shelf")
    relations += (Relation(child="cup", kind="left_of", parent="ball"),)
    poses = arrange(assets, relations, seed=seed).poses
    floor = {name: round(poses[name].position[2] + assets[name].bounds[0, 2], 2) for name in assets}
    assert floor["cup"] == floor["ball"]
    assert len({floor["ball"], floor["box"], floor["hat"]}) == 3
