"""Windows, walls and doors are never made: what a sentence places by them stands somewhere, and a note says so."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import LONGEST, RELATIONS

_STRUCTURES = frozenset({
    "window", "windows", "windowsill", "sill", "ledge", "wall", "walls", "ceiling", "door", "doorway", "corner",
    "corners", "curtain", "curtains", "wallpaper", "fence", "railing", "entrance",
})  # fmt: skip
_MOST = 5
"""Words from a relation word to what it leads to: "by the large south-facing kitchen window"."""


def by_backdrop(it: Compared) -> Iterator[tuple[int, str]]:
    """Notes on the "in front of a window" of a vase that stands there, and on the "on the wall" of a mirror."""
    words = it.said.words
    aside = " ".join(it.plan.set_aside).lower().split()
    for at, word in enumerate(words):
        if word not in _STRUCTURES or word not in aside or any(one.start <= at < one.end for one in it.said.mentions):
            continue
        spans = ((n - size, n) for n in range(at, max(at - _MOST, 0), -1) for size in range(min(LONGEST, n), 0, -1))
        related = ((n, RELATIONS.get(tuple(words[n:end]))) for n, end in spans)
        found = next((n for n, relation in related if relation not in (None, "with", "holding")), None)
        said = " ".join(words[found : at + 1])
        told = any(word in note and "set aside" in note for note in it.plan.notes)
        if found is not None and not told and said not in it.quoted:
            yield found, f'not modelled: "{said}"'
