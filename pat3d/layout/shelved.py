"""Books as people put them on a shelf: on their lower edge, spines to the viewer, close together, between bookends."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

import numpy as np

from pat3d.layout.bodies import Array
from pat3d.layout.group import Group
from pat3d.scene.arrangements import Arrangement

BOUND = frozenset({"book", "notebook", "spell book", "binder"})
"""Nouns of what is made lying on its back cover, its spine at -x and its lower edge at -y."""
BOOKEND = "bookend"
STOOD = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
"""Rotation of what is bound onto its lower edge, its spine at -y and its back cover at -x."""
ON_END = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
"""Rotation of what is long along x onto the end at -x, its thickness along x: a domino that is to topple the next."""
_ACROSS = 0.9
"""Least cosine between the thickness of what is bound and x, for it to stand in a row."""


def stood(noun: str) -> Array | None:
    """How people stand what lies as it is made, shape (3, 3); None where any side will do."""
    return STOOD if noun in BOUND else ON_END if noun == "domino" else None


def shelved(group: Group) -> bool:
    """Whether `group` is something bound that stands, or leans, with its spine to the viewer, and carries nothing."""
    bound = group.root.body.asset.noun in BOUND and len(group.members) == 1
    return bound and abs(float(group.root.rotation[0, 2])) > _ACROSS


def holds_books(group: Group) -> bool:
    """Whether books stand close to `group`: it is one of them, or a bookend."""
    return shelved(group) or group.root.body.asset.noun == BOOKEND


def bookends(arrangements: Iterable[Arrangement], noun: Callable[[str], str]) -> dict[str, float]:
    """Yaw [rad] of the bookends at the two ends of what is between them: their plates to it, their feet outwards."""
    return {
        name: yaw
        for one in arrangements
        if one.kind == "between" and len(one.of) == 2
        # The plate of a bookend is at -x.
        for name, yaw in zip(one.of, (math.pi, 0.0), strict=True)
        if noun(name) == BOOKEND
    }
