"""From a neat packing to things as people leave them: apart from each other over the surface, each turned its own way.

The packing (pat3d.layout.surfaces) satisfies everything that is said, and stays where there is no room. From it, things
are moved towards places that are spread by chance over the surface within an arm's reach, first those together that
relations tie to each other, then each by itself. A move is taken where footprints keep apart, relations hold and the
surface carries; formations (rows, circles, places at a table) move as one and are not turned.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
import shapely
from shapely.affinity import affine_transform

from pat3d.layout.bodies import Array
from pat3d.layout.flat import Item, Lateral, Spot, Surface
from pat3d.layout.formations import Wishes, far_gap
from pat3d.layout.surfaces import side_holds
from pat3d.scene.relations import OPPOSITE, SIDES

REACH = (0.42, 0.34)
"""Half extents of what an arm beside the surface gets to easily, along x and y [m]."""
GROUND_REACH = (0.28, 0.2)
"""The same for things on the ground: a robot's bench with all of them has to stay small [m]."""
APART = 0.015
"""Least gap between footprints [m]."""
_RIM = 0.015
"""Least distance from an edge of the surface [m]."""
_CROWDED = 0.5
"""Share of the surface from which things that cover it stay where they are packed."""
_BESIDE = 0.12
"""Gap up to which things are left that are said to be next to each other [m]."""
_ASIDE = 0.3
"""Gap up to which things are left of which one is said to be at a side of the other [m]."""
_ROUNDS, _TRIES = 4, 12
_HIDDEN = 0.05
"""What being behind something taller weighs, in squares of distance [m^2]."""
_FURNITURE = 0.6
"""Larger things stay where they are packed [m]."""


@dataclass(frozen=True, kw_only=True)
class Loose:
    """Where an item's origin goes, and how it is turned about it."""

    position: Array
    """Relative to the centre of the surface [m], shape (2,)."""
    turn: float
    """[rad]"""


@dataclass(kw_only=True, eq=False)
class _State:
    """Where an item is."""

    item: Item
    position: Array
    turn: float = 0.0
    low: Array = field(default_factory=lambda: np.zeros(2))
    high: Array = field(default_factory=lambda: np.zeros(2))
    shape: shapely.Polygon = field(default_factory=shapely.Polygon)

    def at(self, position: Array, turn: float) -> _State:
        """The item elsewhere."""
        c, s = math.cos(turn), math.sin(turn)
        points = self.item.outline @ np.array([[c, s], [-s, c]]) + position
        return _State(
            item=self.item,
            position=position,
            turn=turn,
            low=points.min(axis=0),
            high=points.max(axis=0),
            shape=shapely.Polygon(points) if turn != self.turn or self.shape.is_empty else _moved(self, position),
        )

    @property
    def middle(self) -> Array:
        """Of the outline's box [m], shape (2,)."""
        return (self.low + self.high) / 2


def _moved(state: _State, position: Array) -> shapely.Polygon:
    x, y = position - state.position
    return affine_transform(state.shape, [1.0, 0.0, 0.0, 1.0, x, y])


def loosen(
    items: Sequence[Item],
    spots: Mapping[str, Spot],
    laterals: Sequence[Lateral],
    surface: Surface,
    wishes: Wishes,
    *,
    turns: Mapping[str, float],
    rng: np.random.Generator,
    held: Iterable[str] = (),
    homes: Mapping[str, Array] | None = None,
) -> dict[str, Loose]:
    """Everything as people would leave it, from where it is packed.

    Args:
        items: what stands on the surface.
        spots: where it is packed.
        laterals: relations among the items.
        surface: what they stand on.
        wishes: of the arrangements.
        turns: by how much every item would like to be turned [rad]; missing for not at all.
        rng: the source of chance.
        held: items that stay where they are.
        homes: directions from the middle in which items are wanted, as shares of half the surface, shape (2,).
    """
    if any(spot.quarter for spot in spots.values()) or _crowded(items, surface):
        return {item.name: Loose(position=spots[item.name].position, turn=0.0) for item in items}
    return _Loosening(items, spots, laterals, surface, wishes, dict(turns), rng, set(held), dict(homes or {})).run()


def _crowded(items: Sequence[Item], surface: Surface) -> bool:
    return sum(float(np.prod(item.size)) for item in items) > _CROWDED * surface.area


class _Loosening:
    def __init__(
        self,
        items: Sequence[Item],
        spots: Mapping[str, Spot],
        laterals: Sequence[Lateral],
        surface: Surface,
        wishes: Wishes,
        turns: dict[str, float],
        rng: np.random.Generator,
        held: set[str],
        homes: dict[str, Array],
    ) -> None:
        self.laterals, self.surface, self.rng, self.turns, self.homes = laterals, surface, rng, turns, homes
        self.wishes = wishes.among(item.name for item in items)
        self.states = {
            item.name: _State(item=item, position=np.zeros(2), turn=math.nan).at(spots[item.name].position, 0.0)
            for item in items
        }
        self.units = self._united(self._rigid())
        large = {name for name, state in self.states.items() if float(state.item.size.max()) > _FURNITURE}
        walled = {name for name, state in self.states.items() if state.item.walled}
        self.furnished = bool(large) and not surface.limited
        frozen = held | set(self.wishes.places) | (large | walled if not surface.limited else set())
        self.frozen = {name for unit in self.units if frozen & set(unit) for name in unit}
        """What stays where it is packed, with all that is in one formation with it."""

    def run(self) -> dict[str, Loose]:
        for bodies in (self._united([*self.units, *self._tied()]), self.units):
            free = [body for body in bodies if not self.frozen & set(body)]
            if bodies is not self.units:
                free = [body for body in free if not self.furnished or len(body) > 1]
            homes = self._homes(free)
            for _ in range(_ROUNDS):
                for index in self.rng.permutation(len(free)):
                    self._move(free[index], homes[index], turning=bodies is self.units)
        return {name: Loose(position=state.position, turn=state.turn) for name, state in self.states.items()}

    def _rigid(self) -> list[tuple[str, ...]]:
        """What keeps its relative places: formations, rings, who faces whom."""
        groups = [one.names for one in self.wishes.formations]
        groups += [(one.observer, one.target) for one in self.wishes.sights]
        return groups + [(lat.child, lat.parent) for lat in self.laterals if lat.kind == "around"]

    def _tied(self) -> list[tuple[str, ...]]:
        return [(lat.child, lat.parent) for lat in self.laterals]

    def _united(self, groups: Iterable[tuple[str, ...]]) -> list[tuple[str, ...]]:
        """All items, in the smallest sets that no group is split by."""
        label = {name: name for name in self.states}
        for group in groups:
            own = [name for name in group if name in label]
            merged = {label[name] for name in own}
            label = {name: label[own[0]] if old in merged else old for name, old in label.items()}
        return [tuple(name for name in label if label[name] == one) for one in dict.fromkeys(label.values())]

    def _homes(self, bodies: Sequence[tuple[str, ...]]) -> list[Array]:
        """Where the middle of every body is wanted [m], shape (2,) each."""
        half = self._half()
        found: list[Array] = []
        sizes: list[float] = []
        for body in bodies:
            low, high = self._box(body)
            room = np.maximum(half - (high - low) / 2, 0.0)
            size = float(np.linalg.norm(high - low)) / 2
            wanted = next((self.homes[name] for name in body if name in self.homes), None)
            if wanted is not None:
                # Up to the edge, however far an arm reaches.
                edge = np.array(self.surface.half_size) - 2 * _RIM - (high - low) / 2
                found.append(np.maximum(edge, 0.0) * wanted)
            elif self.furnished or (len(bodies) > 1 and self._anchored(body)):
                # Chance moves little what relations place, and what stands about in a room.
                found.append((low + high) / 2 + (0.2 if self.furnished else 0.04) * self.rng.uniform(-1, 1, 2))
            else:
                few = 0.55 if len(bodies) == 1 else 1.0
                options = [few * room * _in_disc(self.rng) for _ in range(4)]
                clear = [[float(np.linalg.norm(at - one)) - size for one in found] for at in options]
                nearest = [min(np.subtract(one, sizes).tolist(), default=0.0) for one in clear]
                found.append(options[int(np.argmax(nearest))])
            sizes.append(size)
        return found

    def _anchored(self, body: tuple[str, ...]) -> bool:
        """Whether a relation ties the body to another."""
        return any((lat.child in body) != (lat.parent in body) for lat in self.laterals)

    def _half(self) -> Array:
        if self.surface.limited:
            return np.minimum(np.array(self.surface.half_size) - _RIM, REACH)
        low, high = self._box(tuple(self.states))
        return np.maximum(GROUND_REACH, 0.55 * (high - low))

    def _box(self, body: Iterable[str]) -> tuple[Array, Array]:
        states = [self.states[name] for name in body]
        return np.min([one.low for one in states], axis=0), np.max([one.high for one in states], axis=0)

    def _move(self, body: tuple[str, ...], home: Array, *, turning: bool) -> None:
        """Bring the body nearer to its home, and turn it, as far as everything else allows."""
        low, high = self._box(body)
        now = (low + high) / 2
        turn = self.turns.get(body[0], 0.0) if turning and len(body) == 1 else self.states[body[0]].turn
        scale = float(np.linalg.norm(home - now))
        best = self._worth(body, {name: self.states[name] for name in body}, home, turn)
        shares = [1.0, 1.0, *self.rng.uniform(0.0, 1.0, _TRIES - 2)]
        for k, share in enumerate(shares):
            away = share * (home - now)
            if k:
                away = away + (0.03 + 0.25 * scale) * self.rng.uniform(-1.0, 1.0, 2)
            for angle in dict.fromkeys((turn, self.states[body[0]].turn)):
                moved = {}
                for name in body:
                    state = self.states[name]
                    moved[name] = state.at(state.position + away, angle if len(body) == 1 else state.turn)
                worth = self._worth(body, moved, home, turn)
                if worth < best and self._allowed(body, moved):
                    best = worth
                    self.states.update(moved)
                    now = now + away
                    break

    def _worth(self, body: tuple[str, ...], moved: Mapping[str, _State], home: Array, turn: float) -> float:
        """Squared distance from home [m^2], with what an unwanted direction and being hidden weigh."""
        states = list(moved.values())
        low = np.min([one.low for one in states], axis=0)
        high = np.max([one.high for one in states], axis=0)
        cost = float(np.sum(((low + high) / 2 - home) ** 2))
        if len(body) == 1:
            cost += 0.02 * abs(math.remainder(states[0].turn - turn, 2 * math.pi))
        for state in states:
            for name, other in self.states.items():
                if name not in moved:
                    cost += _HIDDEN * max(_hides(state, other), _hides(other, state))
        return cost

    def _allowed(self, body: tuple[str, ...], moved: Mapping[str, _State]) -> bool:
        if not all(self._carried(state) for state in moved.values()):
            return False
        for state in moved.values():
            for name, other in self.states.items():
                if name not in moved and not self._apart(state, other):
                    return False
        ends = {**self.states, **moved}
        return all(
            self._holds(lat, ends[lat.child], ends[lat.parent])
            for lat in self.laterals
            if (lat.child in moved or lat.parent in moved) and not {lat.child, lat.parent} <= set(body)
        )

    def _carried(self, state: _State) -> bool:
        """Whether the item is on the surface, clear of its edge."""
        if not self.surface.limited:
            return True
        half = np.array(self.surface.half_size) - _RIM
        if self.surface.disc:
            corners = shapely.get_coordinates(state.shape)
            return bool(np.linalg.norm(corners, axis=1).max() <= half[0])
        return bool(np.all(state.high <= half) and np.all(state.low >= -half))

    def _apart(self, state: _State, other: _State) -> bool:
        pair = frozenset((state.item.name, other.item.name))
        gap = far_gap(state.item.size, other.item.size) if pair in self.wishes.far else APART
        if np.any(state.low - other.high > gap) or np.any(other.low - state.high > gap):
            return True
        return float(shapely.distance(state.shape, other.shape)) >= gap

    def _holds(self, lat: Lateral, child: _State, parent: _State) -> bool:
        """Whether a relation holds as well as the packing has it, and nearby."""
        gap = float(shapely.distance(child.shape, parent.shape))
        if lat.kind not in SIDES:
            return gap <= _BESIDE or gap <= 0.4 * float(max(child.item.size.max(), parent.item.size.max()))
        kinds = ((lat.kind, child, parent), (OPPOSITE[lat.kind], parent, child))
        there = all(bool(side_holds(kind, a.low[None], a.high[None], b.low, b.high)[0]) for kind, a, b in kinds)
        axis = SIDES[lat.kind][0]
        off = abs(float((child.middle - parent.middle)[1 - axis]))
        straight = off <= 0.5 * abs(float((child.middle - parent.middle)[axis]))
        return (
            there and straight and gap <= max(_ASIDE, 0.6 * float(max(child.item.size.max(), parent.item.size.max())))
        )


def _hides(front: _State, back: _State) -> float:
    """How much of `back` is behind a `front` that is as tall or taller, as the viewer at -y sees it: 0 to 1."""
    if front.middle[1] > back.middle[1] or front.item.tall < 0.7 * back.item.tall or front.item.tall < 0.03:
        return 0.0
    overlap = min(front.high[0], back.high[0]) - max(front.low[0], back.low[0])
    return float(np.clip(overlap / max(float(back.high[0] - back.low[0]), 1e-6), 0.0, 1.0))


def _in_disc(rng: np.random.Generator) -> Array:
    """A point of the unit disc, shape (2,), evenly by chance."""
    angle, radius = rng.uniform(0.0, 2 * math.pi), math.sqrt(rng.uniform())
    return radius * np.array([math.cos(angle), math.sin(angle)])
