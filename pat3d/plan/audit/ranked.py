"""Members of several that were never named as several: "the largest bowl", "the third shelf"."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared

_SUPERLATIVES = frozenset({"largest", "smallest", "biggest"})
_ORDINALS = {"second": 2, "third": 3, "fourth": 4, "fifth": 5, "sixth": 6}


def ranked(it: Compared) -> Iterator[tuple[int, str]]:
    """What is told by its rank among more than the plan has."""
    words = it.said.words
    for mention in it.said.mentions:
        there = len(it.of(mention))
        lead = words[max(mention.first - 1, 0) : mention.start]
        for word in lead:
            if word in _SUPERLATIVES and there == 1 and word not in it.quoted:
                yield mention.start, f'not modelled: "{word}" of "{mention.text}": there is only one'
            rank = _ORDINALS.get(word, 0)
            if "the" in lead and 0 < there < rank and not mention.plural and f"{word} {mention.text}" not in it.quoted:
                yield mention.start, f'counted otherwise: "the {word} {mention.text}"; there are {there}'
