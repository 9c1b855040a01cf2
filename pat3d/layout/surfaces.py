"""Rectangle packing on a flat surface, seen from above: footprints as rectangles, and who stands left of whom.

Things are placed one after another. Each looks for the cheapest free place among those beside what is
already there that satisfy its lateral relations; when none is left the search backs up, and when it runs
dry things move closer together, turn by a quarter, and at last may stand over the edge a little.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from pat3d.layout.bodies import Array
from pat3d.layout.flat import WRONG_HAND, Item, Lateral, Spot, Surface, natural_gap, right_hand
from pat3d.layout.formations import CLOSE, Wishes, far_gap, ring_angles
from pat3d.layout.strategies import STRATEGIES, Strategy, too_many
from pat3d.scene.relations import OPPOSITE, SIDES

BRANCHES = 4
"""Places tried for each thing before backing up."""
CHECKED = 30
"""Cheapest places of each thing that are checked exactly against the edge of the surface."""
BUDGET = 150
"""Places tried in all before a strategy is given up."""
ABOVE = 1e3
"""Overlap [m] that things which stand above one another may have, seen from above."""

NOTHING = Wishes()


def arrange_flat(
    items: Sequence[Item],
    laterals: Sequence[Lateral],
    surface: Surface,
    *,
    pinned: Mapping[str, Array] | None = None,
    overhang: bool = True,
    wishes: Wishes = NOTHING,
) -> dict[str, Spot] | None:
    """Where every item goes, or None where they do not fit.

    Args:
        items: in the order in which they matter.
        laterals: relations among them.
        surface: what they stand on; positions are relative to its centre.
        pinned: items already at a position [m], shape (2,).
        overhang: whether things may stand over the edge a little where they do not fit otherwise.
        wishes: of the arrangements.
    """
    fixed = dict(pinned or {})
    for strategy in STRATEGIES if surface.limited else STRATEGIES[:2]:
        if (strategy.overhang and not overhang) or too_many(items, surface, strategy):
            continue
        found = _Search(items, laterals, surface, fixed, strategy, wishes).run()
        if found is not None:
            return found
    return None


def side_holds(kind: str, low: Array, high: Array, low_p: Array, high_p: Array) -> NDArray[np.bool_]:
    """Whether rectangles `low`..`high`, shape (n, 2), stand `kind` of one rectangle, clear of it along that axis."""
    axis, sign = SIDES[kind]
    clear = (low_p[axis] - high[:, axis]) if sign < 0 else (low[:, axis] - high_p[axis])
    other = 1 - axis
    aside = np.abs((low + high)[:, other] - (low_p + high_p)[other]) / 2
    ahead = np.abs((low + high)[:, axis] - (low_p + high_p)[axis]) / 2
    return (clear > 0) & (aside <= 1.2 * ahead)


@dataclass(eq=False)
class _Search:
    items: Sequence[Item]
    laterals: Sequence[Lateral]
    surface: Surface
    pinned: dict[str, Array]
    strategy: Strategy
    wishes: Wishes = NOTHING
    budget: int = BUDGET
    placed: dict[str, tuple[Item, Array, bool]] = field(default_factory=dict)
    rings: dict[str, float] = field(default_factory=dict)
    offsets: list[dict[str, Array]] = field(default_factory=list)
    """Of every formation that is asked for, relative to a common point [m], shape (2,) each."""

    def run(self) -> dict[str, Spot] | None:
        by_name = {item.name: item for item in self.items}
        self.wishes = self.wishes.among(by_name)
        self.offsets = [one.offsets(by_name, self.laterals, self._natural) for one in self.wishes.formations]
        for name, position in self.pinned.items():
            self.placed[name] = (by_name[name], np.asarray(position, dtype=np.float64), False)
        order = self._order()
        self.rings = ring_angles(self.laterals)
        if not self._extend(order, 0):
            return None
        shift = self._recentring()
        return {
            name: Spot(position=position + (0.0 if name in self.pinned else shift), quarter=quarter)
            for name, (_, position, quarter) in self.placed.items()
        }

    def _order(self) -> list[Item]:
        """Insertion order (or largest first), each followed by what is related to it."""
        waiting = [item for item in self.items if item.name not in self.pinned]
        if self.strategy.largest_first:
            waiting.sort(key=lambda item: -float(np.prod(item.size)))
        done, order = set(self.pinned), []
        while waiting:
            tied = [
                item
                for item in waiting
                if any({item.name, other} == {lat.child, lat.parent} for other in done for lat in self.laterals)
            ]
            formed = [item for item in waiting if any(item.name in offsets for offsets in self.offsets)]
            begun = [item for item in formed if any(self.wishes.together(item.name, other) for other in done)]
            leading = [item for item in waiting if self._leads(item.name)]
            chosen = (begun or formed or tied or leading or waiting)[0]
            waiting.remove(chosen)
            order.append(chosen)
            done.add(chosen.name)
        return order

    def _leads(self, name: str) -> bool:
        """Whether nothing is said about where the item stands: others stand relative to it."""
        return all(lat.child != name for lat in self.laterals)

    def _extend(self, order: list[Item], depth: int) -> bool:
        if depth == len(order):
            return True
        item = order[depth]
        variants = [(item, False)]
        if self.strategy.quarters and item.turnable and item.name not in self.wishes.names:
            variants.append((item.quarter(), True))
        options: list[tuple[float, int, Item, Array, bool]] = []
        for variant, quarter in variants:
            spots, cost = self._candidates(variant)
            found = 0
            for index in np.argsort(cost, kind="stable")[:CHECKED]:
                if not np.isfinite(cost[index]) or found >= BRANCHES:
                    break
                if self._fits(variant, spots[index]):
                    found += 1
                    options.append((float(cost[index]), len(options), variant, spots[index], quarter))
        for _, _, variant, spot, quarter in sorted(options, key=lambda option: option[:2])[:BRANCHES]:
            self.budget -= 1
            if self.budget < 0:
                return False
            self.placed[item.name] = (variant, spot, quarter)
            if self._extend(order, depth + 1):
                return True
            del self.placed[item.name]
        return False

    def _candidates(self, item: Item) -> tuple[Array, Array]:
        """Places for the item's origin, shape (n, 2), and their costs, inf where not allowed."""
        if not self.placed:
            return np.array([-(item.low + item.high) / 2]), np.zeros(1)
        half = item.size / 2
        boxes = [(spot + other.low, spot + other.high, other) for other, spot, _ in self.placed.values()]
        gaps = np.array([self._gap(item, other) for _, _, other in boxes])
        low, high = np.stack([box[0] for box in boxes]), np.stack([box[1] for box in boxes])
        centres = self._forced(item)
        if centres is None:
            centres = self._beside(item, low, high, gaps)
        apart = np.maximum(low[None] - (centres + half)[:, None], (centres - half)[:, None] - high[None]).max(axis=-1)
        cost = np.where(np.all(apart >= 0.999 * gaps, axis=1), 0.0, np.inf)
        if self.surface.limited:
            span = np.maximum(high.max(axis=0), centres + half) - np.minimum(low.min(axis=0), centres - half)
            largest = np.max([other.size for _, _, other in boxes] + [item.size], axis=0)
            space = 2 * np.array(self.surface.half_size) + 2 * self.strategy.overhang * largest
            cost[np.any(span > space + 1e-9, axis=1)] = np.inf
        cost[~self._leaves_room(item, centres)] = np.inf
        cost += self._lateral_cost(item, centres)
        cost += self._taste(item, centres, low, high)
        return centres - (item.low + item.high) / 2, cost

    def _beside(self, item: Item, low: Array, high: Array, gaps: Array) -> Array:
        """Centres beside, centred on and flush with all that is placed [m], shape (n, 2)."""
        half = item.size / 2
        left, right = self._formation_reach(item, half)
        ring = self._ring_spots(item)
        values = []
        for axis in range(2):
            # Beside, centred on, and flush with every placed rectangle.
            edge = [low[:, axis] - gaps - right[axis], high[:, axis] + gaps + left[axis]]
            edge += [(low + high)[:, axis] / 2, low[:, axis] + half[axis], high[:, axis] - half[axis]]
            if self.wishes.places:
                edge.append(np.zeros(1))
            values.append(np.unique(np.round(np.concatenate(edge), 6)))
        centres = np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, 2)
        if ring:
            centres = np.concatenate([np.array(ring), centres])
        return centres

    def _natural(self, item: Item, other: Item) -> float:
        return max(self.strategy.least, self.strategy.spacing * natural_gap(item.size, other.size))

    def _gap(self, item: Item, other: Item) -> float:
        if frozenset((item.name, other.name)) in self.wishes.far:
            return far_gap(item.size, other.size)
        formation = self.wishes.together(item.name, other.name)
        if formation is not None:
            return -ABOVE if formation.overlapping else CLOSE / 2
        pair = {item.name, other.name}
        sights = [one.gap for one in self.wishes.sights if {one.observer, one.target} == pair]
        return max(self._natural(item, other), *sights) if sights else self._natural(item, other)

    def _forced(self, item: Item) -> Array | None:
        """The centre that placed members of its formations leave to `item` [m], shape (1, 2), or none of them."""
        found = []
        for offsets in self.offsets:
            lead = next((name for name in offsets if name in self.placed), None)
            if item.name in offsets and lead is not None:
                other, spot, _ = self.placed[lead]
                found.append(spot + other.middle + offsets[item.name] - offsets[lead])
        if not found:
            return None
        agreed = all(np.allclose(one, found[0], atol=1e-6) for one in found)
        centre = found[0] - item.middle + (item.low + item.high) / 2
        return np.array([centre]) if agreed else np.zeros((0, 2))

    def _formation_reach(self, item: Item, half: Array) -> tuple[Array, Array]:
        """How far `item`, with the formation that it leads, goes from its centre to either side [m], shape (2,)."""
        left, right = half, half
        for offset, mate in self._mates(item):
            left = np.maximum(left, -(offset + mate.low))
            right = np.maximum(right, offset + mate.high)
        return left, right

    def _mates(self, item: Item) -> list[tuple[Array, Item]]:
        """Members of its formations that are not placed, each with its origin's offset from the centre of `item`."""
        found = []
        for offsets in self.offsets:
            if item.name in offsets:
                for mate in self.items:
                    if mate.name in offsets and mate.name != item.name and mate.name not in self.placed:
                        away = item.middle - (item.low + item.high) / 2 - mate.middle
                        found.append((offsets[mate.name] - offsets[item.name] + away, mate))
        return found

    def _leaves_room(self, item: Item, centres: Array) -> NDArray[np.bool_]:
        """Whether all that has to stand around `item` then keeps clear of what is placed, shape (n,)."""
        free = np.ones(len(centres), dtype=bool)
        for offset, mate in self._mates(item):
            for other, spot, _ in self.placed.values():
                low, high = centres + offset + mate.low, centres + offset + mate.high
                apart = np.maximum(spot + other.low - high, low - spot - other.high).max(axis=1)
                free &= apart >= 0.999 * self._gap(mate, other)
        origins = centres - (item.low + item.high) / 2
        for sight in self.wishes.sights:
            for own, sign in ((sight.observer, 1.0), (sight.target, -1.0)):
                facing = sight.target if own == sight.observer else sight.observer
                if item.name == own and facing in self.placed:
                    other, spot, _ = self.placed[facing]
                    free &= sight.meets(sign * (spot + other.middle - origins - item.middle))
        return free

    def _lateral_cost(self, item: Item, centres: Array) -> Array:
        cost = np.zeros(len(centres))
        half = item.size / 2
        for lat in self.laterals:
            if item.name not in (lat.child, lat.parent):
                continue
            other_name = lat.parent if lat.child == item.name else lat.child
            if other_name not in self.placed:
                continue
            other, spot, _ = self.placed[other_name]
            low, high = spot + other.low, spot + other.high
            middle = (low + high) / 2
            kind = lat.kind if lat.child == item.name else OPPOSITE[lat.kind]
            in_line = np.abs(centres - middle)
            if item.walled and other.walled:
                in_line[:, 1] = np.abs(centres[:, 1] + half[1] - high[1])
            separation = np.maximum(0.0, np.maximum(low - (centres + half), centres - half - high))
            distance = np.linalg.norm(separation, axis=1)
            if kind in ("next_to", "around"):
                limit = max(0.22, 0.9 * float(max(item.size.max(), other.size.max())))
                cost[distance > min(limit, 1.0)] = np.inf
                cost += 3.0 * distance
                if kind == "next_to":
                    # Beside means left or right of it, in line, unless there is no free space.
                    cost += 1.5 * in_line[:, 1] + np.where(separation[:, 0] > 0, 0.0, 0.5 * half[1])
                    cost += WRONG_HAND * (right_hand(item, other) * (centres - middle)[:, 0] < 0.0)
                elif lat.child == item.name:
                    angle = np.arctan2(centres[:, 1] - middle[1], centres[:, 0] - middle[0])
                    turn = np.abs((angle - self.rings[item.name] + math.pi) % (2 * math.pi) - math.pi)
                    cost += 3.0 * turn * float(np.linalg.norm(half + other.size / 2))
            else:
                together = self.wishes.together(item.name, other_name)
                if together is None or not together.overlapping:
                    # What leans over another thing is beside it at its foot; the formation has the order.
                    cost[np.logical_not(side_holds(kind, centres - half, centres + half, low, high))] = np.inf
                across = 1 if kind in ("left_of", "right_of") else 0
                cost += 2.0 * distance + 1.5 * in_line[:, across]
        return cost

    def _taste(self, item: Item, centres: Array, low: Array, high: Array) -> Array:
        """Near the middle, in rows along x, and nothing hidden behind something taller."""
        middle = np.zeros(2) if self.wishes.places else (low.min(axis=0) + high.max(axis=0)) / 2
        cost = np.linalg.norm((centres - middle) * np.array([1.0, 1.6]), axis=1)
        half = item.size / 2
        for other, spot, _ in self.placed.values():
            a, b = spot + other.low, spot + other.high
            overlap = np.minimum(centres[:, 0] + half[0], b[0]) - np.maximum(centres[:, 0] - half[0], a[0])
            share = np.clip(overlap / min(item.size[0], other.size[0]), 0.0, 1.0)
            front = centres[:, 1] < (a[1] + b[1]) / 2
            hides = np.where(front, item.tall > 0.7 * other.tall, other.tall > 0.7 * item.tall)
            cost += np.where(hides, 0.6 * share * float(max(item.size.max(), other.size.max())), 0.0)
            if item.alike and item.alike == other.alike:
                cost += 0.3 * np.linalg.norm(centres - (a + b) / 2, axis=1)
        return cost

    def _ring_spots(self, item: Item) -> list[Array]:
        """Places at the item's own angle around the thing that it surrounds."""
        spots = []
        for lat in self.laterals:
            if lat.kind == "around" and lat.child == item.name and lat.parent in self.placed:
                other, spot, _ = self.placed[lat.parent]
                middle = spot + (other.low + other.high) / 2
                for extra in (0.0, 0.06, -0.06, 0.15, -0.15, 0.3, -0.3):
                    angle = self.rings[item.name] + extra
                    direction = np.array([math.cos(angle), math.sin(angle)])
                    need = (other.size + item.size) / 2 + self._gap(item, other)
                    radius = float(np.min(need / np.maximum(np.abs(direction), 1e-9)))
                    spots.append(middle + radius * direction)
        return spots

    def _fits(self, item: Item, spot: Array) -> bool:
        """Whether all that is placed, and `item`, can be shifted together onto the surface."""
        if not self.surface.limited:
            return True
        pieces = [*((other, at) for other, at, _ in self.placed.values()), (item, spot)]
        return self._shift(pieces) is not None

    def _recentring(self) -> Array:
        pieces = [(item, spot) for item, spot, _ in self.placed.values()]
        shift = self._shift(pieces)
        return np.zeros(2) if shift is None else shift

    def _shift(self, pieces: list[tuple[Item, Array]]) -> Array | None:
        """The translation that centres the pieces on the surface, or None where they do not fit it."""
        low = np.min([spot + item.low for item, spot in pieces], axis=0)
        high = np.max([spot + item.high for item, spot in pieces], axis=0)
        shift = np.zeros(2) if self.pinned else -(low + high) / 2
        if not self.surface.limited:
            return shift
        half = np.array(self.surface.half_size)
        for item, spot in pieces:
            if item.name in self.pinned:
                continue
            slack, at = half + self.strategy.overhang * item.size, spot + shift
            if self.surface.disc:
                beyond = np.linalg.norm((item.outline + at) / slack, axis=1).max()
            else:
                beyond = max(np.max((item.high + at) / slack), np.max(-(item.low + at) / slack))
            if beyond > 1.0 + 1e-9:
                return None
            weight = (item.centre_of_mass + at) / half
            most = 1.0 if item.name in self.wishes.places else 0.92
            if (np.linalg.norm(weight) if self.surface.disc else np.abs(weight).max()) > most:
                return None
        return shift
