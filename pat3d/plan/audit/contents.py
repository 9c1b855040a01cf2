"""What is in a thing and what is not: where "in it" ends, what "holding" is said of, what stands in brackets."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import FINITE, PARTICIPLES, POSED

_NEAR = 3
"""Words from a verb to the relation word behind it."""
CLOSING = frozenset({"lid", "cap", "cork", "stopper"})
"""Last words of what closes a vessel."""


def contents(it: Compared) -> Iterator[tuple[int, str]]:
    """What the plan has in or on another thing than the one that is said to have it."""
    for claim in it.said.claims:
        yield from _held_elsewhere(it, claim)
        yield from _not_inside(it, claim)
        yield from _after_it(it, claim)
    yield from _bracketed(it)


def subject(it: Compared, claim: Claim) -> Mention | None:
    """The name that stands right before `claim`, but for a verb."""
    at = claim.at
    while at > 0 and it.said.words[at - 1] in POSED:
        at -= 1
    return next((mention for mention in it.said.mentions if mention.end == at), None)


def carriers(it: Compared, mention: Mention) -> set[str]:
    """What carries the objects that `mention` names."""
    return {below.parent for obj in it.which(mention) if (below := it.support(obj.name)) is not None}


def _held_elsewhere(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What stands on the table in "a toolbox sits on the table holding a hammer"."""
    words = it.said.words
    if claim.place != "holding" or claim.of is None or words[claim.at] not in PARTICIPLES or it.named(claim.said):
        return
    end = claim.at - (words[claim.at - 1] == ",")
    before = next((one for one in it.said.claims if one.of is not None and one.of.end == end), None)
    if before is None or before.of is None or not FINITE & {*words[max(before.at - _NEAR, 0) : before.at]}:
        return
    below = carriers(it, claim.of)
    if below and below <= {obj.name for obj in it.which(before.of)}:
        yield claim.at, f'"{claim.said}" is read as said of "{before.of.text}"'


def _not_inside(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What is on the shelf in "a mug on the shelf with a spoon in it"."""
    thing = subject(it, claim)
    if (
        claim.of is not None
        or claim.place != "in"
        or it.said.words[claim.end - 1 : claim.end] not in (["it"], ["them"])
    ):
        return
    if thing is None or it.named(thing.text):
        return
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    below = [it.support(obj.name) for obj in it.which(thing)]
    upon = [rel.parent for rel in below if rel and rel.kind == "on" and nouns[rel.parent] in it.furniture]
    if upon and len(upon) == len(below):
        yield claim.at, f'"{thing.text} {claim.said}" is read as on "{upon[0]}"'


def _after_it(it: Compared, claim: Claim) -> Iterator[tuple[int, str]]:
    """What is in the box in "the shelf holds a box with a pen in it and a jar"."""
    words = it.said.words
    if claim.of is not None or claim.place not in ("in", "on", "on top") or words[claim.end - 1 : claim.end] != ["it"]:
        return
    joint = claim.end + (words[claim.end : claim.end + 1] == [","])
    first = subject(it, claim)
    after = next((mention for mention in it.said.mentions if mention.first == joint + 1), None)
    if words[joint : joint + 1] != ["and"] or first is None or after is None or it.named(after.text):
        return
    below = carriers(it, after)
    if below and below <= carriers(it, first) and any(it.support(name) for name in below):
        yield after.start, f'"{" ".join(words[after.first : after.end])}" is read as {claim.place} "{min(below)}" too'


def _bracketed(it: Compared) -> Iterator[tuple[int, str]]:
    """What stands in brackets behind a name and has nothing to do with it: "a toolbox (a hammer, a wrench)"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "(" and ")" in words[at:]):
        end = words.index(")", at)
        owner = next((mention for mention in it.said.mentions if mention.end == at), None)
        inside = [mention for mention in it.said.mentions if at < mention.start < end and it.which(mention)]
        own = {obj.name for obj in it.which(owner)} if owner is not None else set[str]()
        named = {obj.name for mention in inside for obj in it.which(mention)}
        joined = any((a in own and b in named) or (a in named and b in own) for a, _, b in it.edges)
        if owner is not None and own and named and not own & named and not joined and not it.named(inside[0].text):
            yield at, f'"({" ".join(words[at + 1 : end])})" is read as beside "{owner.text}"'.replace(" ,", ",")
