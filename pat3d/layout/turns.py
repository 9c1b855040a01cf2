"""How far things are turned of which nothing is said: a fork lies anyhow, a clock is looked at from in front."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np

from pat3d.assets.catalogue.lookup import find
from pat3d.layout.bodies import Body
from pat3d.scene.arrangements import LINES, Arrangement

_FRONTED = {"animals": 0.6, "plush": 0.5, "electronics": 0.35, "appliances": 0.3, "decor": 0.6, "room": 0.3}
"""Families of things that have a front, and by how much it may point past the viewer [rad]."""
_LEGIBLE = frozenset({"book", "notebook", "magazine", "newspaper", "letter", "envelope", "clock", "alarm clock"}) | {
    "picture frame", "photo frame", "calendar", "radio", "trophy", "globe", "typewriter", "cash register",
}  # fmt: skip
"""Nouns of other families that are read or looked at from in front."""
_PARALLEL = frozenset({"tray", "cutting board", "mat", "placemat", "rug", "carpet", "tablecloth", "desk pad"})
"""Nouns of things that lie along the edges of what they lie on."""
_ABOUT = math.pi
_SLENDER = 2.5
"""Length over width from which on a thing is slender."""


def free_turn(noun: str, rng: np.random.Generator, *, loaded: bool = False) -> float:
    """By how much a thing is turned by chance [rad], about z, from facing the viewer.

    Args:
        noun: of the thing.
        rng: the source of chance.
        loaded: whether it carries or contains several others.
    """
    most = _most(noun)
    return float(rng.uniform(-most, most)) if not loaded else float(rng.uniform(-1, 1)) * min(most, 0.3)


def abreast(
    arrangements: Iterable[Arrangement], bodies: Mapping[str, Body], carriers: Mapping[str, Body | None]
) -> dict[str, float]:
    """Yaw [rad] of the slender things of a row: a person lays pens side by side, not end to end.

    Args:
        arrangements: of the scene.
        bodies: all objects; the slender are long along their x axis.
        carriers: of all that may be turned, what it lies on; None for the ground.
    """
    rows = [one.objects for one in arrangements if one.kind in LINES and carriers.keys() >= {*one.objects}]
    return {name: math.pi / 2 for row in rows if all(_fits(bodies[one], carriers[one]) for one in row) for name in row}


def _fits(body: Body, carrier: Body | None) -> bool:
    """Whether `body` is slender, and what it lies on deep enough for it across."""
    length, width, _ = body.asset.size
    depth = math.inf if carrier is None else float(carrier.asset.size[1])
    regions = carrier.asset.regions if carrier is not None else ()
    depth = max((2 * one.half_size[1] for one in regions if one.kind == "on"), default=depth)
    return _SLENDER * width < length < depth


def _most(noun: str) -> float:
    if noun in _PARALLEL:
        return 0.1
    if noun in _LEGIBLE:
        return 0.6
    entry = find(noun)
    return _FRONTED.get(entry.family, _ABOUT) if entry is not None else _ABOUT
