"""What arrangements mean for the layout: on which surface each is brought about, who turns where, who stands in line.

Arrangements are said of any objects; what the layout moves are the things that stand on one surface, each with all that
it carries. `Intents` takes the one to the other in names alone; `wishes` adds the geometry once these things are built.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from pat3d.layout.bodies import Array
from pat3d.layout.flat import Lateral, natural_gap
from pat3d.layout.formations import Formation, Sight, Wishes, close_row, lattice, pairs, ring_of_carriers, start_angle
from pat3d.layout.group import Group
from pat3d.layout.leaning import leaning_offset, leaning_offsets, under_offsets
from pat3d.layout.shelved import holds_books
from pat3d.layout.tops import item_of
from pat3d.scene.arrangements import LINES, TIERS, Arrangement, crossing
from pat3d.scene.relations import GROUND, SIDES

_AHEAD = 17.0
"""Angle [degrees] at which the ends of a row see what all of it faces."""
_PLACES = {"in_corners": "in_corner", "at_ends": "at_end"}
"""Where the layout puts each single thing, of which it finds no two a place where another is."""
_STRAIGHT = 2.0
"""The same of the one in its middle."""
_FACING = ((1.0, 0.0), (-1.0, 0.0), (0.0, -1.0), (0.0, 1.0))
"""Where the first, second, ... of several that face one thing have it."""


@dataclass(frozen=True, kw_only=True)
class Intent:
    """One arrangement among the things that stand on one surface."""

    arrangement: Arrangement
    support: str
    stands_for: Mapping[str, str]
    """What each object of the arrangement is moved with: itself, or what carries it."""

    def moved(self, names: Sequence[str]) -> tuple[str, ...]:
        """What `names` are moved with."""
        return tuple(self.stands_for[name] for name in names)


class Intents:
    """All arrangements of a scene, by surface."""

    def __init__(
        self,
        arrangements: Sequence[Arrangement],
        path: Callable[[str], list[str]],
        kinds: Mapping[str, str],
        laterals: Mapping[str, Sequence[Lateral]],
        spans: Mapping[str, Sequence[str]],
    ) -> None:
        """Sort `arrangements`.

        Args:
            arrangements: of the scene.
            path: an object, what it stands on, and so on to the ground.
            kinds: support relation of every object that has one.
            laterals: by surface.
            spans: objects with several carriers, and these.
        """
        self.laterals, self.spans, self.path = laterals, spans, path
        self.by_surface: dict[str, list[Intent]] = {}
        self.notes: list[str] = []
        self.yaws: dict[str, float] = {name: 0.0 for carriers in spans.values() for name in carriers}
        """Of objects that must not be turned by chance [rad]."""
        self.leaning: dict[str, Array] = {}
        """Objects that lean, and unit vectors, shape (3,), to what they lean on."""
        self._sights: dict[str, list[Sight]] = {}
        self.targets: list[tuple[str, str]] = []
        """Who faces what."""
        # Who faces what depends on the circles and rows that they stand in.
        audiences = [row for one in arrangements if (row := self._audience(one, arrangements)) is not None]
        for one in sorted([*arrangements, *audiences], key=lambda one: one.kind == "facing"):
            known = len(self.notes)
            intent = self._placed(one, kinds)
            if one in audiences:
                # Nobody has asked for that row.
                del self.notes[known:]
            if intent is not None:
                self.by_surface.setdefault(intent.support, []).append(intent)
                self._turn(intent)

    def _audience(self, one: Arrangement, others: Sequence[Arrangement]) -> Arrangement | None:
        """The row in which several stand that face one thing, where nothing else is said of their places."""
        if one.kind != "facing" or not one.of or len(one.objects) < 2:
            return None
        beside = [name for lats in self.laterals.values() for lat in lats for name in (lat.child, lat.parent)]
        said = {*beside, *(name for other in others if other is not one for name in other.objects)}
        return None if said & {*one.objects} else Arrangement(kind="row", objects=one.objects)

    def wishes(self, support: str, groups: Mapping[str, Group], build: Callable[[str], Group], gap: float) -> Wishes:
        """What is asked for on `support`.

        Args:
            support: what `groups` stand on.
            groups: everything that stands there, built, by name.
            build: makes the group of an object with several carriers.
            gap: distance that objects keep [m].

        Raises:
            LayoutError: something has no room under, or nothing to lean on.
        """
        lines = [intent for intent in self.by_surface.get(support, []) if intent.arrangement.kind in LINES]
        below: dict[str, list[str]] = {}
        leaners: dict[str, dict[str, tuple[Group, Array]]] = {}
        grids = crossing([row for one in lines if set(row := one.moved(one.arrangement.objects)) <= set(groups)])
        formations, far = [Formation(members=tuple(cells), cells=cells) for cells in grids], set()
        places, tiers = {}, {}
        rows = [one for one in self._rows(lines, groups, gap) if not any(set(one.members) <= set(c) for c in grids)]
        formations += rows
        for intent in self.by_surface.get(support, []):
            one, objects, of = (
                intent.arrangement,
                intent.moved(intent.arrangement.objects),
                intent.moved([] if intent.arrangement.rule.on_it else intent.arrangement.of),
            )
            if not {*objects, *of} <= set(groups) or one.kind in LINES or _within(one.kind, objects, of, rows):
                continue
            if one.kind == "between" and len(of) == 2:
                formations.append(Formation(members=(of[0], *objects, of[1])))
            elif one.kind == "between":
                formations.append(Formation(members=of, centre=objects, ring=True))
            elif one.kind == "circle":
                formations.append(Formation(members=objects, centre=of, ring=True))
            elif one.kind == "far_from":
                far |= {frozenset(pair) for pair in ([(a, b) for a in objects for b in of] if of else pairs(objects))}
            elif one.kind == "leaning_against":
                leaners.setdefault(of[0], {})[objects[0]] = (groups[objects[0]], self.leaning[objects[0]])
            elif one.kind == "under":
                below.setdefault(of[0], []).extend(name for name in objects if name not in below.get(of[0], ()))
            elif one.kind in TIERS:
                tiers |= dict.fromkeys(objects, one.kind)
            elif one.rule.on_it:
                places |= dict.fromkeys(objects, _PLACES.get(one.kind, one.kind))
                together = one.kind == "in_corner" and len(objects) > 1
                if together and not any({*objects} & {*other.names} for other in formations):
                    formations.append(Formation(members=objects, cells=lattice(objects)))
        for wall, leaning in leaners.items():
            fixed = {wall: np.zeros(2), **leaning_offsets(leaning, groups[wall], gap)}
            formations.append(Formation(members=tuple(fixed), fixed=fixed, overlapping=True))
        for cover, names in below.items():
            away = under_offsets([groups[name] for name in names], groups[cover], gap)
            fixed = {cover: np.zeros(2), **dict(zip(names, away, strict=True))}
            formations.append(Formation(members=tuple(fixed), fixed=fixed, overlapping=True))
        for name, carriers in self.spans.items():
            feet = self._carriers_on(support, name)
            laid = any(one.fixed and set(feet) <= set(one.members) for one in formations)
            if len(feet) == len(carriers) and set(feet) <= set(groups) and not laid:
                items = [item_of(groups[one], turnable=False) for one in feet]
                fixed = ring_of_carriers(items, build(name).size[:2])
                formations.append(Formation(members=tuple(feet), fixed=fixed))
        sights = tuple(
            replace(one, gap=back, askew=_STRAIGHT) if (back := self._back(one, support, groups)) else one
            for one in self._sights.get(support, [])
            if {one.observer, one.target} <= set(groups)
        )
        return Wishes(formations=tuple(formations), far=frozenset(far), sights=sights, places=places, tiers=tiers)

    def _rows(self, lines: Sequence[Intent], groups: Mapping[str, Group], gap: float) -> list[Formation]:
        """Rows, each with what it is between, and with those leaning that lean on their neighbours."""
        made = []
        for line in lines:
            members = line.moved(line.arrangement.objects)
            beside = self.by_surface[line.support]
            around = [one for one in beside if one.arrangement.kind == "between" and len(one.arrangement.of) == 2]
            ends = next(
                (one.moved(one.arrangement.of) for one in around if one.moved(one.arrangement.objects) == members), ()
            )
            members = (*ends[:1], *members, *ends[1:])
            if set(members) <= set(groups):
                made.append(self._row(members, line.support, groups, gap))
        return made

    def _row(self, members: tuple[str, ...], support: str, groups: Mapping[str, Group], gap: float) -> Formation:
        """A row; close together what are books, or where two neighbours carry something, as in a pyramid."""
        carried = {frozenset(carriers) for carriers in self.spans.values()}
        if all(frozenset(pair) in carried for pair in pairwise(members)):
            fixed = close_row([item_of(groups[one], turnable=False) for one in members])
            return Formation(members=members, fixed=fixed)
        steps: dict[tuple[str, str], Array] = {}
        for intent in self.by_surface[support]:
            one = intent.arrangement
            if one.kind == "leaning_against":
                name, other = intent.moved((one.objects[0], one.of[0]))
                if (name, other) in pairwise(members) or (other, name) in pairwise(members):
                    away = leaning_offset(groups[name], groups[other], self.leaning[name], gap)
                    steps |= {(other, name): away, (name, other): -away}
        close = frozenset(name for name in members if holds_books(groups[name]))
        return Formation(members=members, close=close, steps=steps, overlapping=bool(steps))

    def _back(self, sight: Sight, support: str, groups: Mapping[str, Group]) -> float:
        """How far from its target the row of an observer stands [m], so that its ends too have it nearly ahead."""
        rows = [one for one in self.by_surface.get(support, []) if one.arrangement.kind in LINES]
        for row in (one.moved(one.arrangement.objects) for one in rows):
            if sight.observer in row and set(row) <= set(groups):
                sizes = [groups[name].size[:2] for name in row]
                pitch = max(float(one[0]) for one in sizes) + max(natural_gap(*pair) for pair in pairwise(sizes))
                aside = max(row.index(sight.observer), len(row) - 1 - row.index(sight.observer)) * pitch
                return aside / math.tan(math.radians(_AHEAD))
        return 0.0

    def _placed(self, one: Arrangement, kinds: Mapping[str, str]) -> Intent | None:
        """On which surface `one` is brought about; None, with a note, where the layout cannot."""
        paths = {name: self.path(name) for name in one.names}
        if one.rule.on_it:
            support = one.of[0]
            astray = [name for name in one.objects if paths[name][1] != support or name in self.spans]
            upon = ("on", "in") if one.kind in TIERS else ("on",)
            if astray or any(kinds[name] not in upon for name in one.objects):
                self.notes.append(f'"{one}" is left aside: not all of it lies on "{support}" alone.')
                return None
            return Intent(arrangement=one, support=support, stands_for={name: name for name in one.objects})
        first = paths[one.names[0]]
        support = next(name for name in first if all(name in path for path in paths.values()))
        if support in one.names:
            self.notes.append(f'"{one}" is left aside: "{support}" carries the others.')
            return None
        moved = {name: path[path.index(support) - 1] for name, path in paths.items()}
        stack = one.kind == "leaning_against" and len({moved[name] for name in one.of}) == 1
        if len(set(moved.values())) < len(moved) and not (stack and moved[one.objects[0]] != moved[one.of[0]]):
            self.notes.append(f'"{one}" is left aside: some of it stands on one thing.')
            return None
        if support != GROUND and any(kinds[name] != "on" for name in moved.values()):
            self.notes.append(f'"{one}" is left aside: things inside "{support}" lie as they fit.')
            return None
        if one.kind in ("leaning_against", "under") and any(moved[name] != name for name in one.objects):
            self.notes.append(f'"{one}" is left aside: they do not stand on the same thing.')
            return None
        return Intent(arrangement=one, support=support, stands_for=moved)

    def _turn(self, intent: Intent) -> None:
        """Who of `intent` is turned where."""
        one = intent.arrangement
        if one.rule.on_it:
            self.yaws.setdefault(intent.support, 0.0)
        elif one.kind in LINES:
            self.yaws |= {name: self.yaws.get(name, 0.0) for name in one.objects}
        elif one.kind == "leaning_against":
            way = self._way(intent, one.objects[0], one.of[0]) or (0.0, 1.0)
            self.leaning[one.objects[0]] = np.array([*way, 0.0])
            self.yaws |= dict.fromkeys((one.objects[0], *intent.moved(one.of), *one.of), 0.0)
        elif one.kind == "facing":
            targets = one.of * len(one.objects) if one.of else one.objects[::-1]
            sights = self._sights.setdefault(intent.support, [])
            line = self._line(intent) if one.of else ()
            ahead = next((way for name in line if (way := self._way(intent, name, one.of[0]))), (0.0, 1.0))
            for number, (observer, target) in enumerate(zip(one.objects, targets, strict=True)):
                ring = self._ring_angle(intent, observer, target)
                if ring is not None:
                    way = (-math.cos(ring), -math.sin(ring))
                else:
                    way = ahead if line else self._way(intent, observer, target) or _FACING[number % len(_FACING)]
                    pair = intent.moved((observer, target))
                    # Of a row, the middle one has the target straight ahead.
                    if not line or observer == line[len(line) // 2]:
                        sights.append(Sight(observer=pair[0], target=pair[1], way=way))
                if not line:
                    # What stands in a row stays turned alike.
                    self.targets.append((observer, target))
                # The front of an asset is at -y.
                self.yaws[observer] = math.atan2(way[1], way[0]) + math.pi / 2

    def _line(self, intent: Intent) -> tuple[str, ...]:
        """The row in which all objects of `intent` stand, if there is one."""
        for other in self.by_surface.get(intent.support, []):
            one = other.arrangement
            if one.kind in LINES and set(intent.arrangement.objects) <= set(one.objects):
                return tuple(name for name in one.objects if name in intent.arrangement.objects)
        return ()

    def _way(self, intent: Intent, name: str, other: str) -> tuple[float, float] | None:
        """From `name` to `other` as a lateral relation has it."""
        own, there = intent.moved((name, other))
        for lat in self.laterals.get(intent.support, ()):
            if lat.kind in SIDES and {lat.child, lat.parent} == {own, there}:
                axis, sign = SIDES[lat.kind]
                along = -float(sign) if lat.child == own else float(sign)
                return (along, 0.0) if axis == 0 else (0.0, along)
        return None

    def _ring_angle(self, intent: Intent, name: str, centre: str) -> float | None:
        """Angle [rad] of `name` in a ring around `centre`, if there is one."""
        rings = [one for one in self.by_surface.get(intent.support, []) if one.arrangement.kind == "circle"]
        members = next((one.arrangement.objects for one in rings if centre in one.arrangement.of), ())
        if not members:
            around = [lat for lat in self.laterals.get(intent.support, ()) if lat.kind == "around"]
            members = tuple(lat.child for lat in around if lat.parent == centre)
        if name not in members:
            return None
        return start_angle(len(members)) + 2 * math.pi * members.index(name) / len(members)

    def _carriers_on(self, support: str, name: str) -> list[str]:
        """What stands on `support` under the carriers of `name`, where `name` is put down on `support` too."""
        paths = [self.path(one) for one in self.spans[name]]
        if self.path(name)[1] != support:
            return []
        return list(dict.fromkeys(path[path.index(support) - 1] for path in paths))


def _within(kind: str, objects: Sequence[str], of: Sequence[str], rows: Sequence[Formation]) -> bool:
    """Whether one of `rows` has it that `objects` are between, or lean on, `of`."""
    if kind == "between" and len(of) == 2:
        return any(row.members == (of[0], *objects, of[1]) for row in rows)
    return kind == "leaning_against" and any((objects[0], of[0]) in row.steps for row in rows)
