"""How far things are turned of which nothing is said: a fork lies anyhow, a clock is looked at from in front."""

from __future__ import annotations

import math

import numpy as np

from pat3d.assets.catalogue.lookup import find

_FRONTED = {"animals": 0.6, "plush": 0.5, "electronics": 0.35, "appliances": 0.3, "decor": 0.6, "room": 0.3}
"""Families of things that have a front, and by how much it may point past the viewer [rad]."""
_LEGIBLE = frozenset({"book", "notebook", "magazine", "newspaper", "letter", "envelope", "clock", "alarm clock"}) | {
    "picture frame", "photo frame", "calendar", "radio", "trophy", "globe", "typewriter", "cash register",
}  # fmt: skip
"""Nouns of other families that are read or looked at from in front."""
_PARALLEL = frozenset({"tray", "cutting board", "mat", "placemat", "rug", "carpet", "tablecloth", "desk pad"})
"""Nouns of things that lie along the edges of what they lie on."""
_ABOUT = math.pi


def free_turn(noun: str, rng: np.random.Generator, *, loaded: bool = False) -> float:
    """By how much a thing is turned by chance [rad], about z, from facing the viewer.

    Args:
        noun: of the thing.
        rng: the source of chance.
        loaded: whether it carries or contains several others.
    """
    most = _most(noun)
    return float(rng.uniform(-most, most)) if not loaded else float(rng.uniform(-1, 1)) * min(most, 0.3)


def _most(noun: str) -> float:
    if noun in _PARALLEL:
        return 0.1
    if noun in _LEGIBLE:
        return 0.6
    entry = find(noun)
    return _FRONTED.get(entry.family, _ABOUT) if entry is not None else _ABOUT
