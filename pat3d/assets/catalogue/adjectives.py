"""Which adjectives a noun takes: those that its recipe makes something of, and those that it is as it comes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue.lookup import make_entry, style_of
from pat3d.assets.catalogue.registry import Entry
from pat3d.assets.variant import USUAL
from pat3d.scene.asset import Asset

OUTLINE = 0.03
"""By what share the outline seen from above may be smaller than a rectangle's, or other than an ellipse's."""

EQUAL = 0.05
"""By what share sides may differ that count as equal."""

FLAT, LONG = 0.2, 3.0
"""Height over the longer side of what is flat; the longer side over the shorter of what is long."""


class _Asked(frozenset[str]):
    """An empty set of adjectives that remembers which it was asked for."""

    def __new__(cls) -> _Asked:
        made = super().__new__(cls)
        made.words = set()
        return made

    words: set[str]

    def __contains__(self, word: object) -> bool:
        self.words.add(str(word))
        return False

    def __and__(self, others: Iterable[object]) -> frozenset[str]:
        self.words.update(map(str, others))
        return frozenset()

    __rand__ = __and__


def shipped_adjectives() -> Path:
    """The adjectives of every noun that has some, found when the package was made."""
    return Path(__file__).with_name("adjectives.json")


def taken(entry: Entry) -> list[str]:
    """The adjectives of an entry, sorted."""
    return sorted(asked(entry) | natural(make_entry(entry, entry.noun)))


def asked(entry: Entry) -> set[str]:
    """The adjectives that the recipe looks for."""
    words, (style, _) = _Asked(), style_of(entry, entry.noun, USUAL)
    entry.recipe(replace(style, adjectives=words))
    return words.words


def natural(asset: Asset) -> set[str]:
    """Shapes that an asset has without being asked."""
    x, y, z = asset.size
    wide, narrow = max(x, y), min(x, y)
    corners = np.concatenate([part.vertices[:, :2] for part in asset.parts])
    share = ConvexHull(corners).volume / (x * y)
    found = set()
    if share > 1.0 - OUTLINE:
        found |= {"square"} if wide < (1.0 + EQUAL) * narrow else {"rectangular"}
    elif abs(share - np.pi / 4) < OUTLINE and wide < (1.0 + EQUAL) * narrow:
        found.add("round")
    if z < FLAT * wide:
        found |= {"flat", "thin", "low"}
    if wide > LONG * narrow:
        found |= {"long", "narrow"}
    if z > LONG * wide:
        found |= {"tall", "high", "slim", "narrow"}
    return found
