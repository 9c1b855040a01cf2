"""What is to be with what has its colour: "each cup on the matching plate", "blocks in bowls of the same color"."""

from __future__ import annotations

import re
from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared

_MATCHING = frozenset({"matching", "corresponding", "respective"})
_TASK = re.compile(r"(?:place|stack):([^:,.]+):([^:,.]+)")
_SUPPORTS = frozenset({"on", "in"})


def matched(it: Compared) -> Iterator[tuple[int, str]]:
    """Pairs of two colours where the sentence asks for one."""
    words = it.said.words
    at = next((at for at, word in enumerate(words) if word in _MATCHING), -1)
    if at < 0 or not {"color", "colors", "colored", "colour", "colours", "coloured"} & {*words[at : at + 4]}:
        return
    colours = {obj.name: {*obj.colours} for obj in it.plan.objects}
    pairs = [(a, b) for a, kind, b in it.edges if kind in _SUPPORTS] + _TASK.findall(it.tasks)
    for child, parent in sorted(pairs):
        own, other = colours.get(child, set()), colours.get(parent, set())
        if own and other and not own & other:
            yield at, f'not as said: "{words[at]}": "{child}" and "{parent}" have two colours'
