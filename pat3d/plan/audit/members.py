"""What is said of several things, and which of them have it in the plan: "both", "two of the three", "they"."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from pat3d.assets.colours import find_colour
from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.numbers import had_by_each
from pat3d.plan.audit.subjects import row_of
from pat3d.plan.audit.text import Claim, Mention
from pat3d.plan.audit.words import EACH, FORMED, HEADLESS, NUMBERS, POSED
from pat3d.scene.relations import SUPPORT_KINDS

_OPPOSED = tuple(frozenset(pair) for pair in (
    ("left", "right"), ("top", "bottom"), ("upper", "lower"), ("front", "back"), ("first", "second"), ("big", "small"),
    ("large", "small"), ("larger", "smaller"), ("full", "empty"), ("clean", "dirty"), ("heavy", "light"),
))  # fmt: skip
"""Words that tell one thing from its like."""
_MULTIPLYING = (
    EACH | FORMED | {"other", "another", "per", "stack", "both", "pairs", "pair", "respectively", "dozen", "same"}
)
_POSED = re.compile(r"\b(all|both|they are|each) (?:\w+ ){0,2}?(upside down|lying|on their sides?|on its side)\b")
_THERE = frozenset({"there", "is", "are"})
_PLURALS = frozenset({"they", "them", "both"})


def shares(it: Compared) -> Iterator[tuple[int, str]]:
    """What only some of several have though it is said of more."""
    for find in (_held_by_all, _the_rest, _by_colour, _told_apart, _gapped, _all_posed, _unstacked,
                 _plural_pronouns, _all_but_one, _told_together, _out_of_each,
                 _counted_list):  # fmt: skip
        yield from find(it)


def _held_by_all(it: Compared) -> Iterator[tuple[int, str]]:
    """What both, all or two of the three hold: as many hold it."""
    words = it.said.words
    for claim in it.said.claims:
        thing = claim.of
        if claim.place not in ("with", "holding") or thing is None or thing.number != 1 or thing.plural:
            continue
        if EACH & {*words[claim.end : claim.end + 2]} or words[claim.at].endswith(("ed", "ing")):
            continue
        at = claim.at
        while at and words[at - 1] in POSED:
            at -= 1
        owner, wanted = _owner(it, at)
        plain = words[claim.at] == "with" and words[at - 1] not in NUMBERS
        if owner is None or wanted < 2 or words[claim.at - 1] == "," or plain:
            continue
        if any(each.of is owner for each in it.said.claims):
            # "A bench between two trees has a bag": the bench.
            continue
        names, things = ({obj.name for obj in it.which(one)} for one in (owner, thing))
        have = {b for a, _, b in it.edges if b in names and a in things}
        if names and things and len(have) < wanted and not it.excused(claim):
            said = " ".join(words[owner.first : owner.end])
            yield claim.at, f'not as said: "{claim.said}" of {wanted} of "{said}"; {len(have)} of them have it'


def _owner(it: Compared, at: int) -> tuple[Mention | None, int]:
    """What several things end at word `at`, and how many of them are meant."""
    words = it.said.words
    if at and NUMBERS.get(words[at - 1], 0) > 1:
        # "Three cups, two with a spoon"
        several = [one for one in it.said.mentions if one.end <= at - 1 and (one.number or 0) > NUMBERS[words[at - 1]]]
        return (several[-1] if several else None), NUMBERS[words[at - 1]]
    owner = next((one for one in it.said.mentions if one.end == at), None)
    if owner is None:
        return None, 0
    lead = [word for word in words[max(owner.first - 3, 0) : owner.first + 1] if word != "the"]
    if "of" in lead:
        before = lead[lead.index("of") - 1]
        return owner, NUMBERS.get(before, 0)
    if {"other", "remaining"} & {*words[max(owner.first - 2, 0) : owner.start]}:
        return owner, owner.number or 0
    several = {"both", "all"} & {*words[max(owner.first - 2, 0) : owner.start]} or (owner.number or 0) > 1
    there = len(it.which(owner))
    # "One of three bowls holds a lime, the other two bowls hold an egg."
    return owner, min(there, owner.number or there) if several else 0


def _the_rest(it: Compared) -> Iterator[tuple[int, str]]:
    """The number of "the first of three crates, the other two crates": three."""
    words = it.said.words
    for mention in it.said.mentions:
        lead = words[mention.first - 2 : mention.start]
        if not {"other", "remaining"} & {*lead} or words[mention.first - 2] == "each":
            continue
        before = [one for one in it.said.mentions if one.noun == mention.noun and one.end <= mention.first]
        total = max((one.number or 0 for one in before), default=0)
        there = len({obj.name for one in (*before, mention) for obj in it.of(one)})
        if total > 1 and there > total and not it.named(mention.text):
            yield mention.start, f'counted otherwise: "the other {mention.text}"; there are {there}, not {total}'


def _by_colour(it: Compared) -> Iterator[tuple[int, str]]:
    """How many there are of one kind in one colour: "two red, two blue and a green one"."""
    words = it.said.words
    if _MULTIPLYING & {*words}:
        return
    told: dict[tuple[str, str], list[int]] = {}
    for mention in it.said.mentions:
        each = had_by_each(it, mention)
        if mention.number is not None and mention.new and len(mention.colours) == 1 and "or" not in words and not each:
            told.setdefault((mention.noun, mention.colours[0]), []).append(mention.number)
    for at in range(1, len(words) - 1):
        colour, number = find_colour(words[at]), NUMBERS.get(words[at - 1])
        stands = words[at + 1] in (",", ".", "and", ")", "one", "ones", ";")
        plural = [one for one in it.said.mentions if one.end <= at - 1 and one.plural and (one.number or 0) > 1]
        if colour and number and stands and plural:
            told.setdefault((plural[-1].noun, colour), []).append(number)
    for (noun, colour), numbers in told.items():
        own = [obj for obj in it.plan.objects if obj.noun == noun and [find_colour(c) for c in obj.colours] == [colour]]
        if own and not max(numbers) <= len(own) <= sum(numbers) and not it.named(colour):
            yield 0, f'counted otherwise: "{colour}" of "{noun}", of which there are {len(own)}'


def _told_apart(it: Compared) -> Iterator[tuple[int, str]]:
    """Two that a word tells apart, and one object for both: "in left bowl and in right bowl"."""
    for one, other in pairwise(it.said.mentions):
        later = [mention for mention in it.said.mentions if mention.start > one.start and mention.noun == one.noun]
        other = later[0] if later else other
        pair = next((pair for pair in _OPPOSED if pair & one.lead and pair & other.lead
                     and not pair & one.lead & other.lead), None)  # fmt: skip
        alone = one.noun == other.noun and not one.plural and not other.plural and len(it.of(one)) == 1
        if pair is not None and alone and "are read as one" not in it.quoted and not it.tiered(other):
            said = [next(iter(pair & mention.lead)) for mention in (one, other)]
            yield other.start, f'"{said[0]} {one.text}" and "{said[1]} {other.text}" are read as one'


def _gapped(it: Compared) -> Iterator[tuple[int, str]]:
    """What a second one holds, where the verb is not said again: "one contains a plum, the other two figs"."""
    words = it.said.words
    for claim in it.said.claims:
        if claim.place not in ("holding", "with") or claim.of is None or words[claim.at].endswith("ing"):
            continue
        for at in range(claim.of.end, len(words) - 2):
            if words[at] in (".", ";") or claim.part != claim.of.part:
                break
            head = words[at] in ("the", "a", "an") and words[at - 1] in (",", "and")
            size = 1 + (find_colour(words[at + 1]) is not None) if head else 0
            last = words[at + size] if size else ""
            if not size or last not in HEADLESS | {"one"} or (last == "one" and size == 1):
                continue
            end = at + size + 1 + (last != "one" and words[at + size + 1] == "one")
            thing = next((one for one in it.said.mentions if one.first == end), None)
            if thing is None:
                continue
            first, second = ({rel.parent for rel in it.plan.relations if rel.supports and rel.child in {
                obj.name for obj in it.which(one)}} for one in (claim.of, thing))  # fmt: skip
            level = words[at + 1] in ("top", "middle", "bottom", "upper", "lower")
            if first & second and not (level or it.named(thing.text)):
                yield at, f'not as said: "{" ".join(words[at : thing.end])}"; it is where "{claim.of.text}" is'
            break


def _all_posed(it: Compared) -> Iterator[tuple[int, str]]:
    """A posture of all of several: "three cups in a row, all upside down"."""
    text = " ".join(it.said.words)
    for found in _POSED.finditer(text):
        at = text[: found.start()].count(" ")
        before = [one for one in it.said.mentions if one.end <= at and (one.number or 0) > 1]
        turned = {one.object for one in it.plan.postures}
        if not before:
            continue
        names = {obj.name for obj in it.which(before[-1])}
        if 0 < len(names & turned) < len(names) and not it.named(found[2]):
            yield at, f'not as said: "{found[0]}" of "{before[-1].text}"; {len(names & turned)} of {len(names)} are'


def _unstacked(it: Compared) -> Iterator[tuple[int, str]]:
    """What is stacked and stands side by side."""
    words = it.said.words
    if it.tasks.strip() or it.undone:
        return
    nouns = {obj.name: obj.noun for obj in it.plan.objects}
    upon = any(rel.kind in ("on", "in") and nouns.get(rel.parent, "") not in ("", *it.furniture)
               for rel in it.plan.relations)  # fmt: skip
    for at, word in enumerate(words):
        said = word in ("stacked", "piled") or words[at - 2 : at + 1] in (["in", "a", "stack"], ["in", "a", "pile"])
        if said and not upon and len(nouns) > 1 and word not in it.quoted and words[at + 1 : at + 2] != ["with"]:
            yield at, f'not as said: "{word}"'


def _plural_pronouns(it: Compared) -> Iterator[tuple[int, str]]:
    """What "they" and "them" are, of what the sentence before names together."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word in _PLURALS):
        start = max((n + 1 for n in range(at) if words[n] in (".", ";")), default=0)
        own = [one for one in it.said.mentions if start <= one.start < at]
        before = [one for one in it.said.mentions if one.end < start]
        if not start or not before or any(one.plural or (one.number or 0) > 1 for one in own):
            continue
        part = [one for one in before if one.part == before[-1].part]
        told = next((each for one in part if len(each := _list_from(it, part, one)) > 1), [])
        moved = it.moved
        single = len(moved) == 1 and not any(one.plural or (one.number or 0) > 1 for one in before) and not told
        if single and words[at] != "they" and not own:
            yield at, f'"{words[at]}" is read as "{min(moved)}" alone'
        if len(told) < 2 or len(own) > 1:
            continue
        names = [{obj.name for obj in it.which(one)} for one in told]
        held = [bool(each & (_meant(it, at, start))) for each in names]
        if any(held) and not all(held):
            lacking = next(one for one, holds in zip(told, held, strict=True) if not holds)
            yield at, f'"{words[at]}" is not read as said of "{lacking.text}"'


def _list_from(it: Compared, part: Sequence[Mention], first: Mention) -> list[Mention]:
    """`first` and what follows it in a list."""
    last = next((one for one in reversed(part) if first in row_of(it, one, _THERE)), first)
    landmarks = [claim.of for claim in it.said.claims]
    return [one for one in row_of(it, last, _THERE) if one.start >= first.start and one not in landmarks]


def _meant(it: Compared, at: int, start: int) -> set[str]:
    """The objects of which the plan has what is said of the pronoun at word `at`, of a sentence from `start`."""
    words = it.said.words
    end = next((n for n in range(at, len(words)) if words[n] in (".", ";")), len(words))
    if it.tasks.strip():
        return it.moved
    colour = next((word for word in words[at:end] if find_colour(word)), None)
    if colour is not None and words[at + 1 : at + 2] == ["are"]:
        return {obj.name for obj in it.plan.objects if it.has(obj, colour)}
    if "upside" in words[at:end] or "lying" in words[at:end]:
        return {one.object for one in it.plan.postures}
    claim = next((one for one in it.said.claims if start <= one.at < end), None)
    if claim is None:
        return set()
    return _related(it, claim, at)


def _related(it: Compared, claim: Claim, at: int) -> set[str]:
    kinds = it.kinds(claim)
    if claim.of is None and claim.end - 1 >= at:
        behind = {obj.name for one in it.said.mentions if one.part == claim.part for obj in it.which(one)}
        return {b for a, kind, b in it.edges if kind in kinds and a in behind}
    if claim.of is None or claim.at < at:
        return set()
    of = {obj.name for obj in it.which(claim.of)}
    return {a for a, kind, b in it.edges if kind in kinds and b in of}


def _all_but_one(it: Compared) -> Iterator[tuple[int, str]]:
    """Of what "every cup but one" leaves one out, where no note does."""
    words = it.said.words
    for mention in it.said.mentions:
        lead = words[max(mention.first - 1, 0) : mention.start]
        behind = words[mention.end : mention.end + 2]
        apart = behind[:1] == ["but"] and behind[1:] in (["one"], ["two"], ["the"], ["three"])
        things = [obj.name for obj in it.which(mention)]
        having = {b for _, kind, b in it.edges if b in things and kind in SUPPORT_KINDS}
        left_out = len(things) > 1 and len(having) == len(things) - NUMBERS.get("".join(behind[1:]), 1)
        if apart and {"every", "each"} & {*lead} and "but" not in it.quoted and not left_out:
            yield mention.end, f'not modelled: "{" ".join(behind)}" of "{mention.text}"'


def _told_together(it: Compared) -> Iterator[tuple[int, str]]:
    """Colours of one object that the sentence says apart, and one of a landmark that is said of something else."""
    words = it.said.words
    for obj in it.plan.objects:
        pairs = [(find_colour(one), find_colour(other)) for one, other in pairwise(obj.colours)]
        for pair in pairs:
            places = [[at for at, word in enumerate(words) if find_colour(word) == colour] for colour in pair]
            near = any(abs(one - other) < 4 for one in places[0] for other in places[1])
            if all(places) and not near:
                yield 0, f'not as said: "{pair[0]} and {pair[1]}" of "{obj.phrase}"'
    for at in range(4, len(words) - 1):
        clause = words[at - 2 : at] == ["which", "is"] and words[at - 3] == "," and words[at - 4] == "one"
        own = [obj for obj in it.plan.objects if clause and it.has(obj, words[at])]
        alone = own and all(sum(like.noun == obj.noun for like in it.plan.objects) == 1 for obj in own)
        if alone and find_colour(words[at]):
            yield at, f'not as said: "{words[at]}" of "{" ".join(words[at - 5 : at - 3])}"'


def _out_of_each(it: Compared) -> Iterator[tuple[int, str]]:
    """What is to be taken from each of several, where the task takes one."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "each" and words[at - 1] in ("from", "of", "in", "on")):
        owner = next((one for one in it.said.mentions if one.start > at), None)
        count = len(it.which(owner)) if owner is not None else 0
        if len(it.moved) == 1 and count > 1 and it.plan.task is not None:
            yield at, f'not as said: "{words[at - 1]} each"; the task moves one thing'


def _counted_list(it: Compared) -> Iterator[tuple[int, str]]:
    """The number before a colon, of which the list behind it has made more."""
    words = it.said.words
    for mention in it.said.mentions:
        numbered = [one for one in it.said.mentions if one.noun == mention.noun and one.number is not None]
        behind = ":" in words[: mention.start] and numbered == [mention] and not _MULTIPLYING & {*words}
        if (words[mention.end : mention.end + 1] != [":"] and not behind) or (mention.number or 0) < 2:
            continue
        there = sum(obj.noun == mention.noun for obj in it.plan.objects)
        if there > (mention.number or 0) and not it.named(mention.text):
            yield mention.start, f'counted otherwise: "{mention.text}", of which there are {there}'
