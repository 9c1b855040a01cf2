"""What "it", "both" and "the others" mean in a plan, where their sentence leaves a choice."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.contents import carriers, subject
from pat3d.plan.audit.subjects import row_of
from pat3d.plan.audit.text import Claim
from pat3d.plan.audit.words import DEEDS, FINITE, POSED

_BESIDE = frozenset({"beside", "front", "behind", "left", "right", "under", "against"})
_FURTHER = frozenset({"second", "another", "third"})
_NEAR = 5
"""Words from a verb to its relation word."""


def meant(it: Compared) -> Iterator[tuple[int, str]]:
    """Words for what was named before, where the plan takes them for something else than a person would."""
    for claim in it.said.claims:
        if claim.of is None and it.said.words[claim.end - 1 : claim.end] == ["it"] and '"it"' not in it.quoted:
            yield from _on_the_landmark(it, claim)
            yield from _of_the_first(it, claim)
            yield from _first_inside(it, claim)
        yield from _split_landmark(it, claim)
        yield from _all_the_others(it, claim)
        yield from _which_is(it, claim)
    yield from _both(it)


def _first_inside(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What is in the box in "a box with tape and scissors next to it", of which the second alone is beside it."""
    words = it.said.words
    listed = [one for one in it.said.mentions if one.end <= claim.at][-2:]
    if claim.place not in _BESIDE or len(listed) < 2:
        return
    first, last = listed
    led = words[min(first.first, first.start) - 1] == "with" or words[first.first] == "with"
    joined = last.end == claim.at and words[first.end : first.end + 1] == ["and"] and last.start == first.end + 1
    own = {obj.name for obj in it.which(first)}
    beside = {b for a, kind, b in it.edges if a in {obj.name for obj in it.which(last)} and kind in it.kinds(claim)}
    inside = any(set(it.above(name)) & beside for name in own)
    if led and joined and beside and inside:
        yield first.start, f'"{claim.said}" is read as said of "{last.text}" alone: "{first.text}" is in it'


def _on_the_landmark(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What lies on the bed in "a trunk stands next to the bed, and a hat lies on it"."""
    words = it.said.words
    before = [one for one in it.said.claims if one.end <= claim.at and one.of is not None and one.place in _BESIDE]
    if claim.place not in ("on", "on top", "in") or not before or before[-1].of is None:
        return
    told = before[-1]
    first = [mention for mention in it.said.mentions if mention.end <= told.at][-1:]
    clause = first and {*words[first[0].end : told.at]} <= POSED and FINITE & {*words[first[0].end : told.at]}
    things = [one for one in it.said.mentions if told.end <= one.start < claim.at][:1]
    things = things or [one for one in it.said.mentions if one.start >= claim.end][:1]
    if not clause or not things or words[told.end : told.end + 1] not in ([","], ["and"], [";"], ["."]):
        return
    below = carriers(it, things[0])
    landmark = {obj.name for mention in [told.of] if mention for obj in it.which(mention)}
    if below and below <= landmark and not below & {obj.name for obj in it.which(first[0])}:
        yield claim.at, f'"it" of "{claim.said}" is read as "{min(below)}"'


def _of_the_first(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What is left of the tray in "a mug is on the tray, and a second mug is to the left of it"."""
    second = [mention for mention in it.said.mentions if mention.end <= claim.at][-1:]
    if claim.place not in _BESIDE or not second:
        return
    like = {obj.name for obj in it.plan.objects if obj.noun == second[0].noun}
    further = _FURTHER & {*it.said.words[second[0].first : second[0].start]}
    if further and len(like) > 1 and not any({a, b} <= like and kind in it.kinds(claim) for a, kind, b in it.edges):
        yield claim.at, f'"it" of "{claim.said}" is not read as the first "{second[0].text}"'


def _split_landmark(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What is left on the ground in "a jug on the table beside three cups, one of which is blue"."""
    if claim.of is None or claim.place not in _BESIDE or not claim.of.plural or it.tasks.strip() or it.undone:
        return
    own = it.which(claim.of)
    there = [obj for obj in own if any(b == obj.name and kind in it.kinds(claim) for _, kind, b in it.edges)]
    behind = it.said.words[claim.end : claim.end + _NEAR]
    split = any(pair in (("of", "which"), ("of", "them")) for pair in pairwise(behind))
    if split and 0 < len(there) < len(own) and not it.named(claim.of.text):
        yield claim.at, f'"{claim.said}" is read as said of {len(there)} of the {len(own)}'


def _all_the_others(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """All of them, where "one of the cups is behind a can, the others are behind a box"."""
    words = it.said.words
    at = claim.at
    while at > 0 and words[at - 1] in POSED | {"one", "ones"}:
        at -= 1
    if (
        claim.of is None
        or words[at - 2 : at] not in (["the", "others"], ["the", "other"])
        or claim.place not in _BESIDE
    ):
        return
    one = next((n for n in range(at) if words[n : n + 2] == ["one", "of"]), -1)
    whole = next((mention for mention in it.said.mentions if one >= 0 and mention.start > one), None)
    several = [mention for mention in it.said.mentions if mention.plural and mention.end <= max(one, 0)]
    if whole is not None and words[one + 2 : one + 3] == ["them"]:
        whole = several[-1] if several else None
    names = {obj.name for obj in it.which(whole)} if whole is not None else set[str]()
    of = {obj.name for obj in it.which(claim.of)}
    there = {a for a, kind, b in it.edges if a in names and b in of and kind in it.kinds(claim)}
    if len(names) > 1 and there == names and "other" not in it.quoted:
        yield claim.at, f'"{words[at - 1]} ... {claim.said}" is read as said of all {len(names)}'


def _which_is(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """The drum in "a drum and a box, which is under the chair": one thing is."""
    words = it.said.words
    if claim.place not in _BESIDE or words[claim.at - 2 : claim.at] not in (
        ["which", "is"],
        ["which", "lies"],
        ["which", "stands"],
    ):
        return
    last = next((one for one in claim.whose[:1] if not one.plural), None)
    row = row_of(it, last) if last is not None else []
    of = {obj.name for one in [claim.of] if one for obj in it.which(one)}
    for mention in row[:-1]:
        names = {obj.name for obj in it.which(mention)}
        if any(a in names and b in of and kind in it.kinds(claim) for a, kind, b in it.edges):
            yield claim.at, f'"{claim.said}" is read as said of "{mention.text}" too'
            return


def _both(it: Compared) -> Iterator[tuple[int, str]]:
    """What is moved alone where "both" are, and what stands beside both and is made twice."""
    words, moved = it.said.words, it.moved
    for at in (at for at in range(1, len(words)) if words[at] == "both" and '"both' not in it.quoted):
        if words[at - 1] in DEEDS and len(moved) == 1 and words[at + 1 : at + 2] not in (["arms"], ["hands"]):
            yield at, f'"both" is read as "{min(moved)}" alone'
    for claim in it.said.claims:
        thing = subject(it, claim)
        both = "both" in words[claim.at : claim.end]
        if (
            both
            and claim.place in _BESIDE
            and thing is not None
            and thing.number == 1
            and thing.new
            and len(it.which(thing)) > 1
        ):
            yield claim.at, f'counted otherwise: "{thing.text}", of which there are {len(it.which(thing))}'
