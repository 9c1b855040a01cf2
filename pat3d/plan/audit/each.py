"""How many there are for each of several: "each", "every" and "either end" against the things of the plan."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.text import Mention
from pat3d.plan.audit.words import ARTICLES, CORNERS, EACH, ENDS, LEADING, NUMBERS, POSED, PRONOUNS

_ASIDE = frozenset({"on", "to", "at", "the", "its", "their", "left", "right"})
"""Words that say on which side of each something is."""
_LEADING_TO_EACH = (["at"], ["on"], ["in"], ["to"], ["beside"], ["next", "to"])
_NEW_HEADS = PRONOUNS | NUMBERS.keys() | {":"}


def for_each(it: Compared) -> Iterator[tuple[int, str]]:
    """Things of which "each", "every" or "either end" wants several, and of which there are fewer."""
    for at, word in enumerate(it.said.words):
        if word not in EACH:
            continue
        place = it.said.words[at + 1] if at + 1 < len(it.said.words) else ""
        if place in ("two", "pair") and it.said.words[at - 1] == "between" and "between" not in it.quoted:
            # "Between every two vases lies a nut": of a row of them the plan has two.
            yield at, f'not arranged: "between {word} {place}"'
        if _dealt(it, at) or {"but", "except", "save"} & set(it.said.words[at + 1 : at + 4]):
            # "Every cup but one": of one less.
            continue
        before = [mention for mention in it.said.mentions if mention.end <= at]
        number = NUMBERS.get(it.said.words[at - 1], 0)
        if number > 1 and not place[:1].isalnum() and [len(it.which(one)) for one in before[-2:]] == [number, number]:
            # "Four knives and four spoons, four each, on a mat": there are four of each.
            continue
        if place in NUMBERS and it.said.words[at + 2 : at + 3] == ["high"]:
            # "Two stacks of boxes, each three high, on a pallet"
            continue
        behind = [mention for mention in it.said.mentions if mention.start > at]
        if place in ENDS or place in CORNERS:
            # "A bench with a plant at either end", but not "two lamps, one at either side"
            wanted = 4 if place in CORNERS else 2
            pair = it.said.words[before[-2].end : before[-1].first] == ["and"] if len(before) > 1 else False
            told = (
                before[-1:] if before and not pair and not _NEW_HEADS & set(it.said.words[before[-1].end : at]) else []
            )
            yield from _fewer(it, at, told, wanted, f"{word} {place}")
            continue
        if word == "either" or place == "other" or (it.said.words[at - 1] == "of" and not place[:1].isalnum()):
            continue
        own = [
            mention
            for mention in behind
            if place == "of" or mention.lead & {word} or mention.start <= at + 2 or mention.first == at + 1
        ]
        if own:
            # "a fork beside each plate", "each plate holds a bun"
            # "Each of two bowls in a crate holds a plum": one crate, by which the bowls are told.
            where = next((claim.of for claim in it.said.claims if place == "of" and claim.at == own[0].end), None)
            goes_on = where is not None and where.end < len(it.said.words) and it.said.words[where.end].isalpha()
            rest = [mention for mention in behind[1:] if mention is not where or not goes_on]
            owners, things = it.which(own[0])[: own[0].number], _led(it, own[0], at, before, rest)
        else:
            plural = [mention for mention in before if mention.plural or (mention.number or 1) > 1]
            led = next((claim for claim in it.said.claims if claim.end == at + 1), None)
            told = [mention for mention in before if led is not None and mention.end == led.at and not mention.plural]
            owners, things = (it.which(plural[-1]) if plural else []), told or _listed(it, behind)
            for mention, last in reversed(list(pairwise(plural))):
                if set(it.said.words[mention.end : last.first]) - {"and", ","} or owners == []:
                    break
                owners = [*owners, *it.which(mention)]
        # "A fork between each two plates": one less than there are plates.
        yield from _fewer(it, at, things, len(owners) - (it.said.words[at - 1] == "between"), word)


def pairs(it: Compared) -> Iterator[tuple[int, str]]:
    """What is on or in each of several, and is there once: "a plant in a pot at each end", "behind each of them"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word in EACH | {"both"}):
        carrier = next((one for one in it.said.mentions if words[one.end : at] in _LEADING_TO_EACH), None)
        claim = next((one for one in it.said.claims if carrier is not None and one.of is carrier), None)
        thing = next((one for one in it.said.mentions if claim is not None and one.end == claim.at), None)
        if carrier is None or claim is None or thing is None or claim.place not in ("in", "on", "on top"):
            continue
        there = len(it.which(thing))
        if carrier.number == thing.number == 1 and there < len(it.which(carrier)) and not it.named(thing.text):
            yield thing.start, f'counted otherwise: "{thing.text}", of which there are {there}'
    for at in (at for at in range(1, len(words)) if words[at : at + 3] == ["each", "of", "them"]):
        thing = next((one for one in it.said.mentions if one.start > at and one.number == 1 and one.new), None)
        verb = {*words[at + 3 : thing.first]} if thing is not None else set[str]()
        if thing is not None and verb and verb <= POSED and len(it.which(thing)) == 1 and not it.named(thing.text):
            yield at, f'not as said: "each of them"; there is one "{thing.text}"'


def one_each(it: Compared) -> Iterator[tuple[int, str]]:
    """What a list behind "each holds one fruit:" has one of, and the plan one for each."""
    for at in (at for at, word in enumerate(it.said.words) if word in EACH):
        several = [one for one in _dealt(it, at) if len(it.which(one)) > 1]
        if several and not it.named(several[0].text):
            yield at, f'counted otherwise: "{several[0].text}", of which there are {len(it.which(several[0]))}'


def _dealt(it: Compared, at: int) -> list[Mention]:
    """What is listed behind a colon as the one thing that each has: "each holds one fruit: a pear and a fig"."""
    words = it.said.words
    colon = next((n for n in range(at, len(words)) if words[n] in (":", ".", ";")), at)
    if words[colon] != ":" or not {"one", "different"} & {*words[at:colon]}:
        return []
    end = next((n for n in range(colon, len(words)) if words[n] in (".", ";")), len(words))
    listed = [one for one in it.said.mentions if colon < one.start < end and not one.plural]
    return listed if len(listed) > 1 and all(one.number in (None, 1) for one in listed) else []


def _led(it: Compared, own: Mention, at: int, before: Sequence[Mention], behind: Sequence[Mention]) -> list[Mention]:
    """What there is one of for each of `own`: named before "beside each plate", behind "each plate holds"."""
    claim = next((claim for claim in it.said.claims if claim.of is own or claim.end == at + 1), None)
    if claim is None:
        return _listed(it, behind)
    if claim.at < at and not before:
        # "Beside each bed is a nightstand with a lamp on it"
        stop = next(
            (n for n in range(at, len(it.said.words)) if it.said.words[n] in (",", ";", ".")), len(it.said.words)
        )
        return [mention for mention in behind if mention.new and mention.end <= stop]
    near = [mention for mention in before if set(it.said.words[mention.end : claim.at]) <= LEADING][-1:]
    for mention in reversed(before[:-1]):
        # "a fork to the left and a knife to the right of each"
        between = set(it.said.words[mention.end : near[0].start]) if near else set()
        if not {"left", "right"} & between or between - {"to", "on", "the", "left", "right", "and"} - ARTICLES:
            break
        near.insert(0, mention)
    return near if claim.at < at else []


def _listed(it: Compared, behind: Sequence[Mention]) -> list[Mention]:
    """The first of `behind`, and what "and" joins to it."""
    made = list(behind[:1])
    for mention in behind[1:]:
        between = set(it.said.words[made[-1].end : mention.start]) - _ASIDE
        if "and" not in between or len(between) > 2 + len(mention.lead) or not mention.new:
            break
        made.append(mention)
    return made


def _fewer(it: Compared, at: int, things: Sequence[Mention], wanted: int, said: str) -> Iterator[tuple[int, str]]:
    for thing in things:
        there = len(it.which(thing))
        if said.split()[-1] in ENDS and 1 < there == thing.number:
            # "two plants on either side of the door"
            continue
        if thing.new and 0 < there < wanted * (thing.number or 1) and not it.named(thing.text):
            yield at, f'not as said: "{said}" wants {wanted * (thing.number or 1)} of "{thing.text}"; there are {there}'
