"""One thing that is named again or is one more, and what is named with a landmark or behind one."""

from __future__ import annotations

from collections.abc import Iterator

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.contents import subject
from pat3d.plan.audit.text import Mention
from pat3d.plan.audit.words import ARTICLES, EACH, REPEATS

_FURTHER = REPEATS | {"one", "ones", "other", "others"}
_NEAR = 4
"""Words from "each" to what each has."""
_OWNING = frozenset({"its", "their", "his", "her", "my"})


def again(it: Compared) -> Iterator[tuple[int, str]]:
    """The second burger of "a burger on a plate, fries to the right of the burger"."""
    if (EACH | _FURTHER) & {*it.said.words}:
        return
    landmarks = {claim.of for claim in it.said.claims if claim.of is not None}
    for noun in dict.fromkeys(mention.noun for mention in it.said.mentions):
        named = [mention for mention in it.said.mentions if mention.noun == noun]
        made = [obj for obj in it.plan.objects if obj.noun == noun]
        first, later = named[0], named[1:]
        same = [one for one in later if _same(it, first, one)]
        bare = first.number is None and not ARTICLES & {*it.said.words[first.first : first.start]}
        single = not first.plural and ((bare and landmarks.issuperset(same)) or (first.new and first.number == 1))
        if (
            single
            and len(same) == len(later) > 0
            and len(made) > 1
            and f'counted otherwise: "{first.text}' not in it.quoted
        ):
            yield same[0].start, f'counted otherwise: "{same[0].text}", of which there are {len(made)}'


def _same(it: Compared, first: Mention, later: Mention) -> bool:
    """Whether `later` can only be `first`: "the burger", or "mug" in a list without articles."""
    alike = later.text == first.text and not later.plural and it.said.words[later.start - 1 : later.start] != ["of"]
    return alike and it.said.words[later.first : later.start] in ([], ["the"])


def joined(it: Compared) -> Iterator[tuple[int, str]]:
    """The charger of "a drill next to its battery and charger", of which no place is left."""
    words = it.said.words
    for claim in it.said.claims:
        of = claim.of
        if (
            of is None
            or words[of.end : of.end + 1] != ["and"]
            or not ({*words[of.first : of.start]} & (ARTICLES | _OWNING))
        ):
            continue
        with_it = next((one for one in it.said.mentions if one.start == one.first == of.end + 1), None)
        thing = subject(it, claim) or next((one for one in it.said.mentions[::-1] if one.end <= claim.at), None)
        if with_it is None or with_it.plural != of.plural or thing is None or it.named(with_it.text):
            continue
        own, kinds = {obj.name for obj in it.which(thing)}, it.kinds(claim)
        to, and_to = ({obj.name for obj in it.which(one)} for one in (of, with_it))
        related = [{a for a, kind, b in it.edges if b in names and kind in kinds} & own for names in (to, and_to)]
        if related[0] and not related[1]:
            yield with_it.start, f'"{claim.said} and {with_it.text}": "{with_it.text}" is left out'


def of_the_counted(it: Compared) -> Iterator[tuple[int, str]]:
    """More than six, where "the six blocks" are sorted, "red ones in the left bin, blue ones in the right bin".

    And more than four, where "each table has one" of "four books".
    """
    words = it.said.words
    if {"another", "more", "further", "other", "others"} & {*words}:
        return
    for mention in it.said.mentions:
        like = [one for one in it.said.mentions if one.noun == mention.noun]
        made = sum(obj.noun == mention.noun for obj in it.plan.objects)
        number = mention.number or 0
        parted = {"ones", "one"} & {*words} and words[mention.first - 1] == "the" and not mention.colours
        alone = like == [mention] and parted
        behind = [one for one in like if one.start > mention.end and one.number == 1 and one.part > mention.part]
        shared = len(like) == 2 and behind and EACH & {*words[behind[0].first - _NEAR : behind[0].first]}
        if 1 < number < made and (alone or shared) and not it.named(mention.text):
            yield mention.start, f'counted otherwise: "{mention.text}", of which there are {made}'


def one_more(it: Compared) -> Iterator[tuple[int, str]]:
    """The second table of "a table with a bottle on it and another next to it"."""
    carriers = {rel.parent for rel in it.plan.relations if rel.supports}
    for obj in it.plan.objects:
        like = {one.name for one in it.plan.objects if one.noun == obj.noun and one is not obj}
        further = obj.phrase.lower() in ("another", "another one") and obj.name not in carriers
        if further and like & carriers and '"another' not in it.quoted:
            yield 0, f'"{obj.phrase}" is read as another "{obj.noun}"'


def fronted(it: Compared) -> Iterator[tuple[int, str]]:
    """The mug of "behind the laptop is a lamp, and to the left of it, a mug", where it stands nowhere."""
    words = it.said.words
    for claim in it.said.claims:
        begins = claim.place != "between" and (claim.at == 0 or words[claim.at - 1] in (",", ".", ";", "and"))
        thing = next((one for one in it.said.mentions if one.first == claim.end + 1), None)
        if not begins or words[claim.end : claim.end + 1] != [","] or thing is None or it.named(thing.text):
            continue
        ends = words[thing.end : thing.end + 1] in ([], ["."], [","], [";"], ["and"])
        names, kinds = {obj.name for obj in it.which(thing)}, it.kinds(claim)
        if ends and names and not any(a in names and kind in kinds for a, kind, _ in it.edges):
            yield thing.start, f'"{thing.text}": "{claim.said}" is not read as said of it'


def between_own(it: Compared) -> Iterator[tuple[int, str]]:
    """The screws of "a drill, pliers, a box of screws between them", which are in the box and not beside it."""
    phrases = {obj.name: obj.phrase for obj in it.plan.objects}
    for one in it.plan.arrangements:
        inside = [name for name in one.objects if {*it.above(name)} & {*one.of}] if one.kind == "between" else []
        for name in inside[:1]:
            yield 0, f'"{phrases[name]}" between "{phrases[one.of[0]]}" and "{phrases[one.of[-1]]}": one carries it'
