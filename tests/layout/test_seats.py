"""Seats around tables: at the sides, straight in front of them, turned to them."""

import numpy as np
import pytest

from pat3d.layout.bodies import place_all
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_relations
from pat3d.layout.seats import sides
from pat3d.scene.model import Relation
from tests.layout.things import block, table


def at_each_side(count: int, size: tuple[float, float]) -> dict[tuple[int, int], int]:
    found: dict[tuple[int, int], int] = {}
    for way, _ in sides(count, np.array(size), [np.array([0.42, 0.5])], np.full(2, np.inf)):
        side = (round(float(way[0])), round(float(way[1])))
        found[side] = found.get(side, 0) + 1
    return found


@pytest.mark.parametrize(
    ("count", "size", "expected"),
    [
        (3, (1.2, 0.8), {(0, -1): 1, (0, 1): 1, (-1, 0): 1}),
        (4, (1.2, 0.8), {(0, -1): 2, (0, 1): 2}),
        (4, (0.9, 0.9), {(0, -1): 1, (0, 1): 1, (-1, 0): 1, (1, 0): 1}),
        (6, (1.2, 0.8), {(0, -1): 2, (0, 1): 2, (-1, 0): 1, (1, 0): 1}),
        (6, (0.8, 1.2), {(-1, 0): 2, (1, 0): 2, (0, -1): 1, (0, 1): 1}),
        (8, (1.2, 0.8), {}),
    ],
)
def test_long_sides_take_more_and_no_seat_stands_in_anothers_place(count, size, expected):
    assert at_each_side(count, size) == expected


@pytest.mark.parametrize("count", [3, 4, 5, 6])
def test_chairs_stand_at_the_sides_with_their_fronts_to_the_table(count):
    names = [f"chair {k}" for k in range(count)]
    assets = {"table": table(), **dict.fromkeys(names, block(0.42, 0.5, 0.9, noun="chair"))}
    around = tuple(Relation(child=name, kind="around", parent="table") for name in names)
    poses = arrange(assets, around, seed=1).poses
    assert all(found.holds for found in check_relations(around, assets, poses))
    placed = place_all(assets, poses)
    top = placed["table"]
    for name in names:
        front = -placed[name].rotation[:2, 1]
        ahead = np.array([*((placed[name].low + placed[name].high) / 2)[:2]]) + 0.5 * front
        assert np.all((ahead > top.low[:2]) & (ahead < top.high[:2])), "straight ahead is the table"
        assert np.abs(front).max() == pytest.approx(1.0)


def test_what_is_told_elsewhere_is_in_no_place_at_the_table():
    """One of the chairs is left of a lamp: the ring that was, and every relation, hold."""
    assets = {
        "table": table(),
        **dict.fromkeys("abc", block(0.42, 0.5, 0.9, noun="chair")),
        "lamp": block(0.2, 0.2, 1.4),
    }
    relations = tuple(Relation(child=name, kind="around", parent="table") for name in "abc")
    relations += (Relation(child="a", kind="left_of", parent="lamp"),)
    assert all(one.holds for one in check_relations(relations, assets, arrange(assets, relations, seed=0).poses))


@pytest.mark.parametrize(("width", "expected"), [(1.85, 4), (1.75, 0)])
def test_chairs_stand_at_the_sides_on_a_rug_that_has_room_for_them(width, expected):
    """A table of 0.8 m, chairs of 0.45 m before and behind it and 5 cm between: 1.8 m."""
    seats = [np.array([0.42, 0.45])] * 4
    assert len(sides(4, np.array([1.2, 0.8]), seats, np.array([1.3, width]))) == expected


def test_chairs_around_a_table_on_a_rug_are_around_it():
    chairs = dict.fromkeys("abcd", block(0.42, 0.42, 0.9, noun="chair"))
    assets = {"rug": block(2.4, 1.8, 0.01, noun="rug"), "table": table(), **chairs}
    relations = tuple(Relation(child=name, kind="on", parent="rug") for name in ("table", *chairs))
    around = tuple(Relation(child=name, kind="around", parent="table") for name in chairs)
    poses = arrange(assets, relations + around, seed=0).poses
    assert all(one.holds for one in check_relations(around, assets, poses))


@pytest.mark.parametrize("count", [2, 3])
def test_settings_with_a_side_that_is_told_are_all_seen_from_in_front(count):
    """Fork left and knife right of every plate as the viewer has it, each next to its own plate."""
    kinds = {"plate": (0.26, 0.26, 0.02), "fork": (0.2, 0.023, 0.011), "knife": (0.24, 0.022, 0.012)}
    assets = {"table": table()}
    assets |= {f"{noun} {k}": block(*size, noun=noun) for noun, size in kinds.items() for k in range(count)}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in assets if name != "table")
    told = tuple(
        Relation(child=f"{noun} {k}", kind=kind, parent=f"plate {k}")
        for noun, kind in (("fork", "left_of"), ("knife", "right_of"))
        for k in range(count)
    )
    poses = arrange(assets, (*on, *told), seed=0).poses
    assert all(one.holds for one in check_relations(told, assets, poses))
    middles = {name: np.array(poses[name].position[:2]) for name in assets}
    for k in range(count):
        for noun in ("fork", "knife"):
            assert np.linalg.norm(middles[f"{noun} {k}"] - middles[f"plate {k}"]) < 0.2
