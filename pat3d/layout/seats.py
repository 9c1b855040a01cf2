"""Seats around a table that has sides: along them, their fronts to it; longer sides take more."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from pat3d.layout.bodies import Array, Body
from pat3d.layout.flat import Lateral
from pat3d.layout.formations import Formation
from pat3d.layout.group import Group
from pat3d.scene.model import GROUND
from pat3d.scene.relations import OPPOSITE, SIDES

SEATS = frozenset({"chair", "armchair", "stool", "bench"})
"""Nouns that turn towards what they stand around."""
SAT_AT = frozenset({"table", "desk", "workbench", "counter", "bar", "piano", "keyboard"})
"""Nouns of what seats at a side of it are turned to."""
_LONG = 1.4
"""A table this many times as long as wide has two of four seats at each long side."""
_AIR = 0.05
"""Between a seat and the table, and at least between neighbours [m]."""


def sides(count: int, size: Array, seats: Sequence[Array], room: Array) -> list[tuple[Array, float]]:
    """The side of a table at which each of `count` seats is, as a unit vector from its middle, and where along it.

    Args:
        count: of seats, three at least.
        size: of the table along x and y [m], shape (2,).
        seats: widths and depths [m], shape (2,) each.
        room: for all of it, along x and y [m], shape (2,).

    Returns:
        Unit vectors, shape (2,), and distances from the middle of the side [m]; none where the seats do not fit.
    """
    seat, deep = (float(side) for side in np.max(seats, axis=0))
    long = int(np.argmax(size))
    along, across = np.eye(2)[long], np.eye(2)[1 - long]
    square = count == 4 and size[long] < _LONG * size[1 - long]
    ends = 2 if square or (count >= 6 and count % 2 == 0) else count % 2
    each = (count - ends) // 2
    if each * (seat + _AIR) > size[long] + _AIR or seat > size[1 - long] + 2 * _AIR:
        return []
    if np.any(size + 2 * (deep + _AIR) * (across + min(ends, 1) * along) > room):
        return []
    places = [(k + 0.5) / each * float(size[long]) - float(size[long]) / 2 for k in range(each)]
    found = [(sign * across, place) for sign in (-1.0, 1.0) for place in places]
    return found + [(sign * along, 0.0) for sign in (-1.0, 1.0)[:ends]]


def facing(way: Array) -> float:
    """Yaw [rad] of a seat that is `way` of its table, a unit vector; the front of an asset is at -y."""
    return math.atan2(-way[1], -way[0]) + math.pi / 2


def around(laterals: Sequence[Lateral], seats: Sequence[str]) -> dict[str, list[str]]:
    """The tables that three or more of `seats`, and nothing else, stand around, where nothing else places these."""
    found: dict[str, list[str]] = {}
    for lat in laterals:
        if lat.kind == "around":
            found.setdefault(lat.parent, []).append(lat.child)
    placed = [name for lat in laterals for name in (lat.child, lat.parent) if name in seats]
    return {
        table: own
        for table, own in found.items()
        if len(own) > 2 and set(own) <= set(seats) and all(placed.count(name) == 1 for name in own)
    }


def seated(table: str, ways: Mapping[str, tuple[Array, float]], groups: Mapping[str, Group]) -> Formation:
    """The table and its seats, each at its side."""
    top = groups[table].root.high[:2] - groups[table].root.low[:2]
    offsets: dict[str, Array] = {table: np.zeros(2)}
    for name, (way, place) in ways.items():
        own = groups[name].size[:2]
        out = float(np.abs(way) @ (top + own)) / 2 + _AIR
        offsets[name] = out * way + place * np.abs(way[::-1])
    return Formation(members=tuple(offsets), fixed=offsets)


def around_tables(
    bodies: Mapping[str, Body], laterals: Mapping[str, Sequence[Lateral]], free: Collection[str]
) -> dict[str, dict[str, tuple[Array, float]]]:
    """Seats around each table that has sides, as `sides` places them; of what is `free` to stand so alone.

    Args:
        bodies: by name.
        laterals: by what they stand on.
        free: names of what has no place of its own.
    """
    chairs = [name for name in free if SEATS & set(bodies[name].asset.noun.split())]
    found = {}
    for support, own in laterals.items():
        room = np.full(2, np.inf) if support == GROUND else bodies[support].asset.size[:2]
        for table, names in around(own, chairs).items():
            asset = bodies[table].asset
            round_top = any(one.shape == "disc" for one in asset.regions if one.kind == "on")
            if round_top or table not in free or not SAT_AT & set(asset.noun.split()):
                continue
            ways = sides(len(names), asset.size[:2], [bodies[name].asset.size[:2] for name in names], room)
            if ways:
                found[table] = dict(zip(names, ways, strict=True))
    return found


def beside_tables(bodies: Mapping[str, Body], laterals: Sequence[Lateral]) -> dict[str, float]:
    """Yaw [rad] of each seat that stands at a side of a table, its front to it."""
    found = {}
    for lat in laterals:
        nouns = [set(bodies[name].asset.noun.split()) for name in (lat.child, lat.parent)]
        for seat, table, kind, own, other in (
            (lat.child, lat.parent, lat.kind, *nouns),
            (lat.parent, lat.child, OPPOSITE[lat.kind], *reversed(nouns)),
        ):
            if kind in SIDES and SEATS & own and SAT_AT & other and table != seat:
                axis, sign = SIDES[kind]
                found[seat] = facing(sign * np.eye(2)[axis])
    return found
