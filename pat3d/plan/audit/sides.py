"""Side words against a plan: "left", "the back", "each end", "the top of a tower", "in the corner of the desk"."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.text import Mention
from pat3d.plan.audit.words import SHAPES_OF_STACKS, THINGS

_AXES = {
    "left": frozenset({"left_of", "right_of"}), "right": frozenset({"left_of", "right_of"}),
    "front": frozenset({"in_front_of", "behind"}), "back": frozenset({"in_front_of", "behind"}),
}  # fmt: skip
"""Relations along which a side is."""
_PLACES = frozenset({"row", "side_by_side", "at_edge", "in_corner", "in_corners", "between", "circle", "facing"})
"""Arrangements that may say a side, too."""
_DETERMINED = frozenset({"the", "to", "far"})
_STOPS = frozenset({".", ";", ":", ",", "!", "?"})
_BOTH_ENDS = frozenset({"each", "either", "both", "every", "opposite"})
_LEVELS = {"top": True, "bottom": False, "base": False, "foot": False}
"""Whether what is there is on the rest."""


def sides(it: Compared) -> Iterator[tuple[int, str]]:
    """Side words of a scene that nothing in the plan answers for, and places that it gives to too many."""
    if not (it.tasks.strip() or it.undone):
        yield from _unanswered(it)
        yield from _middle_one(it)
        yield from _ends(it)
    yield from _levels(it)
    yield from _too_many(it)


def _unanswered(it: Compared) -> Iterator[tuple[int, str]]:
    """The right of "a cup, spoon right", where nothing named in that clause is left or right of anything."""
    words = it.said.words
    for at, word in enumerate(words):
        after = words[at + 1] if at + 1 < len(words) else "."
        ends = not after[0].isalnum() or after == "and"
        related = after == "of" or words[at + 1 : at + 3] == ["side", "of"] or words[at - 1] in ("its", "their")
        if word not in _AXES or related or re.search(rf"\b{word}", it.quoted):
            continue
        if not ends and (words[at - 1] not in _DETERMINED or word in ("front", "back")):
            # "Right next to", "was left on", "is left in the box"
            continue
        start = max((n + 1 for n in range(at) if words[n] in _STOPS), default=0)
        named = [mention for mention in it.said.mentions if start <= mention.start <= at + 2]
        names = {obj.name for mention in named for obj in it.which(mention)}
        joined = after == "and" and bool({*words[at + 2 : at + 4]} & _AXES.keys())
        if not named or joined or ({"it", "them", "one", "other"} | THINGS) & {*words[start:at], after}:
            names = {obj.name for obj in it.plan.objects}
        told = any(kind in _AXES[word] and {a, b} & names for a, kind, b in it.edges)
        told = told or any(one.kind in _PLACES and names & {*one.objects, *one.of} for one in it.plan.arrangements)
        if not told:
            lead = named[-1].text if named and named[-1].end == at else words[at - 1] if at > start else ""
            yield at, f'not modelled: "{f"{lead} {word}".strip()}"'


def _middle_one(it: Compared) -> Iterator[tuple[int, str]]:
    """The middle one of what stands in no order."""
    words = it.said.words
    ordered = any(one.kind in (*_PLACES, "in_middle") for one in it.plan.arrangements)
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    stacked = any(rel.kind == "on" and nouns[rel.child] == nouns.get(rel.parent) for rel in it.plan.relations)
    beside = any(kind in _AXES["left"] | _AXES["front"] for _, kind, _ in it.edges)
    for at in (at for at in range(len(words) - 1) if words[at] == "middle" and words[at + 1] in ("one", "ones")):
        if not (ordered or stacked or beside or "middle" in it.quoted):
            yield at, f'not modelled: "middle {words[at + 1]}"'


def _ends(it: Compared) -> Iterator[tuple[int, str]]:
    """The ends of "a lamp at each end of the shelf": no relation says how far out."""
    words = it.said.words
    for at in (at for at in range(1, len(words)) if words[at] in ("end", "ends") and words[at - 1] in _BOTH_ENDS):
        whole = next((mention for mention in it.said.mentions if at < mention.first <= at + 2), None)
        if words[at + 1 : at + 2] != ["of"] or whole is None or re.search(r"\bends?\b", it.quoted):
            continue
        names = {obj.name for obj in it.which(whole)}
        upon = any(rel.supports and rel.parent in names for rel in it.plan.relations)
        if upon and not any(one.kind in ("at_edge", "row") for one in it.plan.arrangements):
            yield at, f'not modelled: "{words[at - 1]} {words[at]}" of "{whole.text}"'


def _levels(it: Compared) -> Iterator[tuple[int, str]]:
    """What is on nothing where "a ball is at the top of a tower", and carries nothing at its bottom."""
    words = it.said.words
    for at in range(2, len(words) - 3):
        word, said = words[at], " ".join(words[at - 2 : at + 4])
        led = words[at - 2] in ("at", "as") and words[at - 1] == "the" and words[at + 1] == "of"
        if (
            word not in _LEVELS
            or not led
            or words[at + 3] not in SHAPES_OF_STACKS
            or re.search(rf"\b{word}", it.quoted)
        ):
            continue
        before = [mention for mention in it.said.mentions if mention.end <= at - 2][-1:]
        own = {obj.name for mention in before for obj in it.which(mention)}
        if own and not any(rel.kind == "on" and (rel.child if _LEVELS[word] else rel.parent) in own
                           for rel in it.plan.relations):  # fmt: skip
            yield at, f'not as said: "{said}"'


def _too_many(it: Compared) -> Iterator[tuple[int, str]]:
    """What is in a corner too where "a mug with a pen in it, and a lamp in the corner of the desk" are."""
    for one in it.plan.arrangements:
        if one.kind not in ("in_corner", "at_edge", "in_middle", "under") or len(one.objects) < 2:
            continue
        there = [mention for mention in it.said.mentions if {obj.name for obj in it.which(mention)} & {*one.objects}]
        for first, last in pairwise(there):
            claim = next((claim for claim in it.said.claims if claim.of is not None and claim.at >= last.end
                          and {obj.name for obj in it.which(claim.of)} & {*one.of}), None)  # fmt: skip
            if claim is not None and first.noun != last.noun and _apart(it, first, last) and not it.named(first.text):
                yield claim.at, f'"{claim.said}" is read as said of "{first.text}" too'


def _apart(it: Compared, first: Mention, last: Mention) -> bool:
    """Whether `first` and `last` are no list of equals."""
    between = it.said.words[first.end : last.first]
    return not {"both", "all", ".", ";"} & {*between} and bool({*between} - {"and", ",", "of"})
