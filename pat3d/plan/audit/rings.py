"""What several things stand around together: "six chairs around a table and a desk"."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.words import FINITE

_SURROUND = frozenset({"surround", "surrounds", "encircle", "encircles"})
_STOPS = frozenset({".", ";", "!"})


def rings(it: Compared) -> Iterator[tuple[int, str]]:
    """The second of two centres, where nothing stands around it and a verb says that something does."""
    words = it.said.words
    around = {name for a, kind, b in it.edges if kind in ("around", "circle") for name in (a, b)}
    for first, second in pairwise(it.said.mentions):
        before = words[max(first.first - 2, 0) : first.first]
        told = before[-1:] == ["around"] and before[0] in FINITE
        joined = words[first.end : second.first] == ["and"] and (told or bool(_SURROUND & {*before[-1:]}))
        last = second.end >= len(words) or words[second.end] in _STOPS
        own = {obj.name for obj in it.which(second)}
        if joined and last and own and not own & around and not it.named(second.text):
            said = " ".join(words[first.first - 1 : second.end])
            yield second.start, f'not as said: "{said}": nothing stands around "{second.text}"'
