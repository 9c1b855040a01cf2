"""Places laid at a table: fork left of the plate, knife and spoon right of it, glass above the knife, napkin outside.

What is said of single things goes before: who is told to be elsewhere is in no place setting.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

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
_GAP = 0.015
"""Between neighbours [m]."""


@dataclass(frozen=True, kw_only=True)
class Setting:
    """One place at the table."""

    formation: Formation
    turns: Mapping[str, float]
    """How its members are turned [rad]."""
    home: Array
    """Direction from the middle of the table to who sits there, as shares of half the table, shape (2,)."""


def place_settings(groups: Mapping[str, Group], laterals: Sequence[Lateral], wishes: Wishes) -> list[Setting]:
    """The places that `groups`, all on one surface, make up; none without a plate and something to eat with."""
    free = [name for name in groups if name not in wishes.names]
    by_noun: dict[str, list[str]] = {}
    for name in free:
        by_noun.setdefault(groups[name].root.body.asset.noun, []).append(name)
    plates = by_noun.get(_PLATE, [])
    if not plates or not any(by_noun.get(noun) for noun in _CUTLERY):
        return []
    found = []
    for seat, plate in enumerate(plates):
        members: dict[str, str] = {}
        for noun in (*_CUTLERY, *_DRINKS, "napkin"):
            own = by_noun.get(noun, [])
            if seat < len(own) and len(groups[own[seat]].members) == 1:
                members[noun] = own[seat]
        drink = next((members[noun] for noun in _DRINKS if noun in members), None)
        laid = {noun: name for noun, name in members.items() if noun not in _DRINKS or name == drink}
        front, column, columns = _seat(seat, len(plates))
        home = np.array([0.0 if columns == 1 else (column / (columns - 1) - 0.5) * 1.6, -1.0 if front else 1.0])
        setting = _laid(plate, laid, groups, 0.0 if front else math.pi, home)
        found.append(_without_the_told(setting, laterals))
    return [one for one in found if one is not None]


def _seat(seat: int, seats: int) -> tuple[bool, int, int]:
    """Whether a seat is in front of the table, and which of how many there it is."""
    before = -(-seats // 2)
    return (True, seat, before) if seat < before else (False, seat - before, seats - before)


def _laid(plate: str, laid: Mapping[str, str], groups: Mapping[str, Group], yaw: float, home: Array) -> Setting:
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
            offsets[name] = np.array([right, clear])
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
    return Setting(formation=formation, turns={k: v for k, v in setting.turns.items() if k in kept}, home=setting.home)


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
