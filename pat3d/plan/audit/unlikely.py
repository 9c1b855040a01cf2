"""What carries something that hardly anybody puts there, though the two are not named side by side."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.contents import subject
from pat3d.plan.audit.subjects import said_of
from pat3d.scene.relations import RELATION_WORDS

Cost = Callable[[str, str, str], float]
"""How unlikely it is that a noun is carried, in a manner of support, by another."""
_HARDLY = 0.9
"""Cost from which on few things are there."""
_NEVER = 1.5
"""Cost from which on a list that ends there is not all there: a tray is on no saucer."""


def unlikely(it: Compared, cost: Cost, found: Sequence[str]) -> Iterator[str]:
    """Notes on the notebooks of "a lamp, two notebooks stacked on each other" where they lie on the lamp.

    What says so itself ("two notebooks on a lamp") is believed, and what the notes `found` name is named already.
    """
    if {"bottom", "top"} <= {*it.said.words}:
        # "From bottom to top: a plate, a bowl, a napkin"
        return
    objects = {obj.name: obj for obj in it.plan.objects}
    quoted = " ".join((it.quoted, *found)).lower()
    placed = {name for one in it.plan.arrangements if one.kind == "across" for name in one.objects}
    told: set[tuple[str, str]] = set()
    for rel in it.plan.relations:
        if not rel.supports or rel.parent not in objects or rel.child in placed:
            continue
        child, parent = objects[rel.child], objects[rel.parent]
        pair = (child.phrase, parent.phrase)
        named = f'"{child.phrase.lower()}"' in quoted or f'"{parent.phrase.lower()}"' in quoted
        likes, price = child.noun == parent.noun, cost(child.noun, rel.kind, parent.noun)
        if pair in told or named or likes or price < _HARDLY or _side_by_side(it, rel.child, rel.parent):
            continue
        if price >= _NEVER or not _said_of_list(it, rel.child, rel.parent):
            told.add(pair)
            yield f'assumed: "{child.phrase}" {RELATION_WORDS[rel.kind]} "{parent.phrase}"; few things are there'


def _side_by_side(it: Compared, child: str, parent: str) -> bool:
    """Whether words between the names of the two alone say that one carries the other."""
    for claim in it.said.claims:
        before, behind = subject(it, claim), claim.of
        ends = [it.which(one) if one is not None else [] for one in (before, behind)]
        first, second = ({obj.name for obj in one} for one in ends)
        if (child in first and parent in second) or (parent in first and child in second):
            return True
    return False


def _said_of_list(it: Compared, child: str, parent: str) -> bool:
    """Whether the sentence may say of all of a list that it is on `parent`, and `child` is in the list."""
    for claim in it.said.claims:
        if claim.of is None:
            continue
        there = {obj.name for obj in it.which(claim.of)}
        if claim.place in ("with", "holding") and child in there:
            return True
        subjects, _ = said_of(it, claim)
        if parent in there and (not subjects or any(child == obj.name for one in subjects for obj in it.which(one))):
            return True
    return False
