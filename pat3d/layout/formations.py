"""Formations: things on one surface whose places follow from each other, once the first of them stands somewhere.

A row, a circle, what is between, under or leaning on something, and carriers of one thing. A formation gives every
member an offset; the search of pat3d.layout.surfaces then moves it as one.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from pat3d.layout.bodies import Array
from pat3d.layout.flat import Item, Lateral
from pat3d.layout.lateral import reach
from pat3d.scene.relations import SIDES

CLOSE = 0.001
"""Gap between members whose offsets are given [m]."""
CLOSE_BY = 3 * CLOSE
"""Gap between members that nearly touch [m]."""
ASKEW = 10.0
"""Largest angle [degrees] at which the layout has something face another."""
FAR = 1.5
"""Gap of things that are far from each other, against the largest of things that are next to each other."""
_DIRECTIONS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))

Gap = Callable[[Item, Item], float]


@dataclass(frozen=True, kw_only=True)
class Formation:
    """Members that stand in a line or on a ring, or at given offsets."""

    members: tuple[str, ...]
    """In order."""
    centre: tuple[str, ...] = ()
    """What a ring goes around, in a line or a lattice."""
    ring: bool = False
    fixed: Mapping[str, Array] = field(default_factory=dict)
    """Offsets of the members' middles [m], shape (2,) each, where they are given."""
    cells: Mapping[str, tuple[int, int]] = field(default_factory=dict)
    """Column and row of every member, where they stand in several rows with aligned columns."""
    close: frozenset[str] = frozenset()
    """Members of a line that nearly touch each other, as books on a shelf do."""
    steps: Mapping[tuple[str, str], Array] = field(default_factory=dict)
    """From the middle of one member of a line to that of the next [m], shape (2,) each, where it is given."""
    overlapping: bool = False
    """Whether members may lie above one another."""

    @property
    def names(self) -> tuple[str, ...]:
        """Everything whose place belongs to it."""
        return (*self.members, *self.centre)

    def offsets(self, items: Mapping[str, Item], laterals: Sequence[Lateral], gap: Gap) -> dict[str, Array]:
        """Where the middle of every member is, relative to a common point [m], shape (2,) each.

        Args:
            items: outlines, by name.
            laterals: what decides the direction of a line.
            gap: free distance that two items keep [m].
        """
        if self.fixed:
            return dict(self.fixed)
        if self.ring:
            return _ring(self.members, self.centre, items, gap)
        own = [lat for lat in laterals if lat.child in self.members and lat.parent in self.members]
        if self.cells:
            lines = _lattices(self.cells, [items[name] for name in self.members], gap)
        else:
            lines = [self._line([items[name] for name in self.members], np.array(way), gap) for way in _DIRECTIONS]
        return next((line for line in lines if all(_agrees(lat, line) for lat in own)), lines[0])

    def _line(self, items: Sequence[Item], way: Array, gap: Gap) -> dict[str, Array]:
        """Side by side along `way`, a unit vector along an axis, with one gap between all that are not close."""
        free = [CLOSE_BY if {a.name, b.name} <= self.close else None for a, b in pairwise(items)]
        widest = max((gap(a, b) for (a, b), one in zip(pairwise(items), free, strict=True) if one is None), default=0.0)
        at, found = np.zeros(2), {items[0].name: np.zeros(2)}
        for (before, item), one in zip(pairwise(items), free, strict=True):
            apart = _reach(before, way) + (widest if one is None else one) + _reach(item, -way)
            at = at + self.steps.get((before.name, item.name), apart * way)
            found[item.name] = at
        return found


@dataclass(frozen=True, kw_only=True)
class Sight:
    """`observer` is turned towards `way`, a unit vector, and `target` has to be there."""

    observer: str
    target: str
    way: tuple[float, float]
    gap: float = 0.0
    """Least free distance [m]: from a row, all of which faces one thing, it has to be far enough."""
    askew: float = ASKEW
    """Largest angle between `way` and the direction to the target [degrees]."""

    def meets(self, offset: Array) -> NDArray[np.bool_]:
        """Whether `offset` [m], shape (n, 2), from the observer's middle to the target's, is that way."""
        way = np.array(self.way)
        along = offset @ way
        return np.abs(offset @ np.array([-way[1], way[0]])) <= math.tan(math.radians(self.askew)) * along


@dataclass(frozen=True, kw_only=True)
class Wishes:
    """What the arrangements of one surface ask for, beside the lateral relations."""

    formations: tuple[Formation, ...] = ()
    far: frozenset[frozenset[str]] = frozenset()
    """Pairs that keep far from each other."""
    sights: tuple[Sight, ...] = ()
    places: Mapping[str, str] = field(default_factory=dict)
    """Kind of the place on the surface where things are wanted: at_edge, at_end, in_corner, in_middle."""
    tiers: Mapping[str, str] = field(default_factory=dict)
    """Kind of the tier on which things are wanted: on_top_tier, on_bottom_tier and so on."""

    @property
    def names(self) -> frozenset[str]:
        """Everything whose place is asked for."""
        formed = {name for one in self.formations for name in one.names}
        seen = {name for one in self.sights for name in (one.observer, one.target)}
        return frozenset(formed | seen | {name for pair in self.far for name in pair} | set(self.places))

    def together(self, first: str, second: str) -> Formation | None:
        """The formation of which both are members."""
        return next((one for one in self.formations if first in one.names and second in one.names), None)

    def among(self, names: Iterable[str]) -> Wishes:
        """What is asked for of `names` alone."""
        own = set(names)
        return Wishes(
            formations=tuple(one for one in self.formations if own.issuperset(one.names)),
            far=frozenset(pair for pair in self.far if own.issuperset(pair)),
            sights=tuple(one for one in self.sights if {one.observer, one.target} <= own),
            places={name: kind for name, kind in self.places.items() if name in own},
            tiers={name: kind for name, kind in self.tiers.items() if name in own},
        )


def far_gap(first: Array, second: Array) -> float:
    """Gap [m] that things of sizes [m], shape (2,), keep where they are far from each other."""
    return FAR * reach_of_beside(first, second) + 0.02


def reach_of_beside(first: Array, second: Array) -> float:
    """Largest gap [m] at which things of horizontal sizes [m], shape (2,), are next to each other."""
    return float(reach(first, second))


def _lattices(cells: Mapping[str, tuple[int, int]], items: Sequence[Item], gap: Gap) -> list[dict[str, Array]]:
    """Members at the crossings of equally spaced lines, rows along x to the right and to the back first."""
    free = max(gap(first, second) for first, second in combinations(items, 2))
    pitch = np.max([item.high - item.middle for item in items], axis=0) + free
    pitch -= np.min([item.low - item.middle for item in items], axis=0)
    at = {name: np.array(cell, dtype=np.float64) for name, cell in cells.items()}
    ways = [np.diag([i, j]) for i in (1.0, -1.0) for j in (1.0, -1.0)]
    return [{name: pitch * (way @ cell) for name, cell in at.items()} for way in (*ways, *(way[::-1] for way in ways))]


def _reach(item: Item, way: Array) -> float:
    """How far an item goes from its middle along `way`, a unit vector along an axis [m]."""
    corner = np.where(way > 0, item.high, item.low)
    return float((corner - item.middle) @ way)


def _agrees(lat: Lateral, offsets: Mapping[str, Array]) -> bool:
    if lat.kind not in SIDES:
        return True
    axis, sign = SIDES[lat.kind]
    return float((offsets[lat.child] - offsets[lat.parent])[axis]) * sign > 0.0


def _ring(members: Sequence[str], centre: Sequence[str], items: Mapping[str, Item], gap: Gap) -> dict[str, Array]:
    """At equal angles on the smallest ring around `centre` where all keep their gaps."""
    angles = [start_angle(len(members)) + 2 * math.pi * k / len(members) for k in range(len(members))]
    ways = [np.array([math.cos(angle), math.sin(angle)]) for angle in angles]
    inner = _clustered([items[name] for name in centre], gap)
    radius = 0.25 * max(float(items[name].size.max()) for name in members)
    while True:
        found = {name: radius * way for name, way in zip(members, ways, strict=True)} | inner
        if all(_apart(items[a], found[a], items[b], found[b]) >= gap(items[a], items[b]) for a, b in pairs(found)):
            return found
        radius *= 1.02


def _clustered(items: Sequence[Item], gap: Gap) -> dict[str, Array]:
    """`items` near each other [m], shape (2,) each, the middle of all of them at zero."""
    if len(items) < 2:
        return {item.name: np.zeros(2) for item in items}
    cells = (
        lattice([item.name for item in items]) if len(items) > 3 else {one.name: (k, 0) for k, one in enumerate(items)}
    )
    found = _lattices(cells, items, gap)[0]
    low = np.min([found[item.name] + item.low - item.middle for item in items], axis=0)
    high = np.max([found[item.name] + item.high - item.middle for item in items], axis=0)
    return {name: at - (low + high) / 2 for name, at in found.items()}


def lattice(names: Sequence[str]) -> dict[str, tuple[int, int]]:
    """Column and row of each of `names`, where they stand in about as many rows as columns."""
    columns = math.ceil(math.sqrt(len(names)))
    return {name: (k % columns, k // columns) for k, name in enumerate(names)}


def start_angle(count: int) -> float:
    """Angle [rad] of the first of `count` things on a ring: two stand left and right, more leave the front free."""
    return math.pi if count <= 2 else math.pi + math.pi / count


def ring_angles(laterals: Sequence[Lateral]) -> dict[str, float]:
    """Angle [rad], counter-clockwise from +x, of every item that stands around another."""
    angles: dict[str, float] = {}
    for centre in dict.fromkeys(lat.parent for lat in laterals if lat.kind == "around"):
        members = [lat.child for lat in laterals if lat.kind == "around" and lat.parent == centre]
        start = start_angle(len(members))
        for k, name in enumerate(members):
            angles[name] = start + 2 * math.pi * k / len(members)
    return angles


def _apart(first: Item, at: Array, second: Item, there: Array) -> float:
    """Gap between the rectangles of two items whose middles are at given points [m]; negative where they overlap."""
    low_a, high_a = (side - first.middle + at for side in (first.low, first.high))
    low_b, high_b = (side - second.middle + there for side in (second.low, second.high))
    return float(np.maximum(low_a - high_b, low_b - high_a).max())


def close_row(items: Sequence[Item]) -> dict[str, Array]:
    """Offsets from left to right [m], shape (2,) each, of `items` that nearly touch."""
    names = tuple(item.name for item in items)
    return Formation(members=names, close=frozenset(names)).offsets({item.name: item for item in items}, (), _close_by)


def _close_by(_first: Item, _second: Item) -> float:
    return CLOSE_BY


def ring_of_carriers(carriers: Sequence[Item], load: Array) -> dict[str, Array]:
    """Offsets of what carries one thing of size `load` [m], shape (2,): under its ends, or near each other."""
    items = {item.name: item for item in carriers}
    if len(carriers) == 2:
        close = close_row(carriers)
        apart = float(close[carriers[1].name][0])
        outer = _reach(carriers[0], np.array([-1.0, 0.0])) + _reach(carriers[1], np.array([1.0, 0.0]))
        wide = 0.96 * float(load.max()) - outer
        return {carriers[0].name: np.zeros(2), carriers[1].name: np.array([max(apart, wide), 0.0])}
    near = _ring([item.name for item in carriers], (), items, _close_by)
    radius = float(np.linalg.norm(next(iter(near.values()))))
    wide = 0.5 * float(load.min()) - 0.5 * max(float(item.size.max()) for item in carriers)
    return {name: at * max(1.0, wide / radius) for name, at in near.items()}


def pairs(names: Iterable[str]) -> list[tuple[str, str]]:
    """Every two of `names`."""
    return list(combinations(names, 2))
