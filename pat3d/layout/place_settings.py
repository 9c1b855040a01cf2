"""Places laid at a table: fork left of the plate, knife and spoon right of it, glass above the knife, napkin outside.

What is said of single things goes before: who is told to be elsewhere is in no place setting.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations, product

import numpy as np
import shapely

from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.bodies import Array
from pat3d.layout.flat import Lateral
from pat3d.layout.formations import Formation, Wishes
from pat3d.layout.group import Group
from pat3d.scene.relations import SIDES

_PLATE = "plate"
_CUTLERY = {"fork": -math.pi / 2, "knife": math.pi / 2, "spoon": -math.pi / 2}
"""How each is turned, as made, for its head to point away from who sits in front [rad]."""
_DRINKS = ("wine glass", "glass", "cup", "mug")
_ABREAST = 3
"""Settings that one side of a table has room for."""
_GAP = 0.015
"""Between neighbours [m]."""
_LEAST = 0.005
"""The same of two settings [m]."""
_GLASS_ASIDE = (1.0, 0.6)
"""Where the glass is tried on a round table, over the distance of the knife from the middle of the plate."""
_STEP = 0.01
"""By which the plates of a round table are tried nearer to its middle [m]."""
_RIM = 0.02
"""Between a plate and the rim of a round table [m]."""


@dataclass(frozen=True, kw_only=True)
class Setting:
    """One place at the table."""

    formation: Formation
    turns: Mapping[str, float]
    """How its members are turned [rad]."""
    home: Array
    """Direction from the middle of the table to who sits there, as shares of half the table, shape (2,)."""
    origins: Mapping[str, Array] = field(default_factory=dict)
    """Where its members stand on a round table, from its middle [m], shape (2,) each."""


def place_settings(
    groups: Mapping[str, Group], laterals: Sequence[Lateral], wishes: Wishes, *, radius: float | None = None
) -> list[Setting]:
    """The places that `groups`, all on one surface, make up; none without a plate and something to eat with.

    Three and more are spread evenly around a round table of `radius` [m], where it has room for that; else half of them
    are in front and half behind.
    """
    free = [name for name in groups if name not in wishes.names]
    by_noun: dict[str, list[str]] = {}
    for name in free:
        by_noun.setdefault(groups[name].root.body.asset.noun, []).append(name)
    plates = by_noun.get(_PLATE, [])
    if not plates or not any(by_noun.get(noun) for noun in _CUTLERY):
        return []
    found = []
    seats = []
    # Left and right are as the viewer has them: who sits opposite has the fork on the other side.
    told = [lat for lat in laterals if lat.kind in ("left_of", "right_of") and {lat.child, lat.parent} & {*plates}]
    sided = len(plates) <= _ABREAST and any({lat.child, lat.parent} <= {*free} for lat in told)
    for seat, plate in enumerate(plates):
        members: dict[str, str] = {}
        for noun in (*_CUTLERY, *_DRINKS, "napkin"):
            own = by_noun.get(noun, [])
            if seat < len(own) and len(groups[own[seat]].members) == 1:
                members[noun] = own[seat]
        drink = next((members[noun] for noun in _DRINKS if noun in members), None)
        laid = {noun: name for noun, name in members.items() if noun not in _DRINKS or name == drink}
        seats.append((plate, laid))
        front, column, columns = (True, seat, len(plates)) if sided else _seat(seat, len(plates))
        home = np.array([0.0 if columns == 1 else (column / (columns - 1) - 0.5) * 1.6, -1.0 if front else 1.0])
        setting = _laid(plate, laid, groups, 0.0 if front else math.pi, home)
        found.append(_without_the_told(setting, laterals))
    around = _around(seats, groups, laterals, radius) if radius is not None and len(seats) > 2 else []
    return around or [one for one in found if one is not None]


def _around(
    seats: Sequence[tuple[str, Mapping[str, str]]],
    groups: Mapping[str, Group],
    laterals: Sequence[Lateral],
    radius: float,
) -> list[Setting]:
    """Settings at equal angles on a disc of `radius` [m], the first in front; none where they do not fit."""
    angles = [2 * math.pi * seat / len(seats) for seat in range(len(seats))]
    furthest = radius - _RIM - max(float(groups[plate].size[:2].max()) for plate, _ in seats) / 2
    for aside, out in product(_GLASS_ASIDE, np.arange(furthest, 0.5 * furthest, -_STEP)):
        made = [
            _laid(plate, laid, groups, yaw, np.array([math.sin(yaw), -math.cos(yaw)]), aside=aside)
            for (plate, laid), yaw in zip(seats, angles, strict=True)
        ]
        kept = [one for each in made if (one := _without_the_told(each, laterals)) is not None]
        if len(kept) < len(made):
            return []
        placed = [_moved_out(one, float(out), groups) for one in kept]
        outlines = [one for _, each in placed for one in each]
        reach = max(float(np.linalg.norm(shapely.get_coordinates(one), axis=1).max()) for one in outlines)
        if reach < radius - _RIM / 2 and all(shapely.distance(*pair) > _LEAST for pair in combinations(outlines, 2)):
            return [one for one, _ in placed]
    return []


def _moved_out(setting: Setting, out: float, groups: Mapping[str, Group]) -> tuple[Setting, list[shapely.Geometry]]:
    """`setting` with its plate `out` [m] from the middle of the table, and the outlines of its members there."""
    origins: dict[str, Array] = {}
    outlines: list[shapely.Geometry] = []
    for name, at in setting.formation.fixed.items():
        standing = turned(groups[name], setting.turns[name]) if name in setting.turns else groups[name]
        points = np.concatenate([member.vertices[:, :2] for member in standing.members])
        origins[name] = out * setting.home + at - ((standing.root.low + standing.root.high) / 2)[:2]
        outlines.append(shapely.MultiPoint(points + origins[name]).convex_hull)
    return replace(setting, origins=origins), outlines


def _seat(seat: int, seats: int) -> tuple[bool, int, int]:
    """Whether a seat is in front of the table, and which of how many there it is."""
    before = -(-seats // 2)
    return (True, seat, before) if seat < before else (False, seat - before, seats - before)


def _laid(
    plate: str, laid: Mapping[str, str], groups: Mapping[str, Group], yaw: float, home: Array, *, aside: float = 1.0
) -> Setting:
    """Offsets of all members from the plate, as who sits there has them, turned by `yaw` [rad]."""
    half = {name: groups[name].size[:2] / 2 for name in (plate, *laid.values())}
    turns = {name: yaw + _CUTLERY.get(noun, 0.0) for noun, name in laid.items()}
    wide = {name: half[name][1] if noun in _CUTLERY else half[name][0] for noun, name in laid.items()}
    offsets: dict[str, Array] = {plate: np.zeros(2)}
    for side, nouns in ((-1.0, ("fork", "napkin")), (1.0, ("knife", "spoon"))):
        edge = float(half[plate][0])
        for noun in nouns:
            if noun in laid:
                name = laid[noun]
                offsets[name] = np.array([side * (edge + _GAP + wide[name]), 0.0])
                edge += _GAP + 2 * float(wide[name])
    for noun in _DRINKS:
        if noun in laid:
            name = laid[noun]
            right = next((offsets[laid[one]][0] for one in ("knife", "spoon") if one in laid), float(half[plate][0]))
            long = [float(half[other][0]) for what, other in laid.items() if what in _CUTLERY]
            clear = max([float(half[plate][1]), *long]) + _GAP + float(half[name][1])
            offsets[name] = np.array([aside * right, clear])
    rotation = yaw_matrix(yaw)[:2, :2]
    fixed = {name: rotation @ at for name, at in offsets.items()}
    return Setting(formation=Formation(members=tuple(fixed), fixed=fixed), turns=turns, home=home)


def _without_the_told(setting: Setting, laterals: Sequence[Lateral]) -> Setting | None:
    """The setting without what relations want elsewhere; None where nothing is left of it."""
    kept = dict(setting.formation.fixed)
    for lat in laterals:
        inside = [name for name in (lat.child, lat.parent) if name in kept]
        if not inside or (len(inside) == 2 and _agrees(lat, kept)):
            continue
        plate = setting.formation.members[0]
        for name in inside:
            if name != plate:
                kept.pop(name, None)
    if len(kept) < 2:
        return None
    formation = Formation(members=tuple(kept), fixed=kept)
    return replace(setting, formation=formation, turns={k: v for k, v in setting.turns.items() if k in kept})


def _agrees(lat: Lateral, at: Mapping[str, Array]) -> bool:
    if lat.kind not in SIDES:
        return lat.kind == "next_to"
    axis, sign = SIDES[lat.kind]
    away = at[lat.child] - at[lat.parent]
    return float(away[axis]) * sign > abs(float(away[1 - axis]))


def turned(group: Group, angle: float) -> Group:
    """`group`, at the origin, turned so that its root's yaw is `angle` [rad]."""
    rotation = group.root.rotation
    now = math.atan2(rotation[1, 0], rotation[0, 0])
    return group.turned(yaw_matrix(angle - now))
