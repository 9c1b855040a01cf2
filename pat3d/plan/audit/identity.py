"""Which names of a sentence mean one thing and which mean several, and what a thing that is named is made as.

A plan that makes one bowl of "the bowl on the left" and "the bowl on the right", two beds of "the bed", or a cat of "a
cat toy" is wrong whatever else it has right.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from pat3d.plan.audit.compared import Compared
from pat3d.plan.audit.text import Claim, Mention, singulars
from pat3d.plan.audit.words import (
    BREAKING,
    EACH,
    GUESTS,
    NUMBERS,
    PACKETS,
    PIECES,
    PLACING,
    POSED,
    POURED,
    REPEATS,
    REQUESTS,
    SIDES,
    SILENT,
    SINGLE,
    TOGETHER,
    UNCOUNTED,
)
from pat3d.scene.relations import OPPOSITE, RELATION_WORDS

_SEVERAL = (REPEATS - EACH) | {"second", "third", "fourth", "fifth"}
"""Words by which there are several of what is named in the singular."""
_AS_MANY = re.compile(r"as many|\b(?:same|equal|twice the|half the|double the|times the) (?:number|amount)")
_TENS = re.compile(r".*(teen|ty)|twenty-.*|hundred")

_TOOLS = "hammer saw chisel drill wrench screwdriver pliers workbench toolbox plank rasp clamp vise sandpaper"
_NAMESAKES = {
    "washer": "bolt bolts nut nuts screw screws wrench spanner hardware toolbox tray",
    "file": f"{_TOOLS} binder", "plane": _TOOLS, "letter": "envelope envelopes",
    "glove": "bat baseball ball", "clip": "paper papers document documents page",
    "computer": "laptop laptops tablet", "keys": "piano", **dict.fromkeys(("rice", "pasta", "noodles"), ""),
    "brush": "dustpan broom mop sponge sink dish dishes soap comb razor toilet bathtub pot pan shoe shoes dog cat",
    "red bull": "cow cows farm barn field horse sheep pasture fence",
}  # fmt: skip
"""Names of things that the catalogue has by another name only, and in what company they are meant; empty in any."""
_WORN = {"cap": "bottle bottles pen pens marker markers jar jars tube thermos"}
"""What is made to be worn, and of what it is a part as well."""
_FAST = frozenset({"cord", "cable", "handle", "strap", "hose", "plug", "wire", "string", "chain"})
"""Parts that come off nothing, though there are things of that name too."""
_BARE = frozenset({"bar", "level", "tube", "trunk", "card", "rack", "stick", "pea"})
"""Names that alone mean one of several things, of which the catalogue has another name."""
_ARM = re.compile(r"\b(?:left|right|both|one|other) (?:arm|hand|gripper)s?\b|\b(?:arm|hand|gripper) (?:[a-d]|\d)\b")
_SOLD = frozenset({"soup", "sauce", "coffee", "tea", "sugar"})
_ALWAYS = frozenset({"instead", "namely", "respectively", "half", "twice"})
"""First words of what is always read as a guess; the others only where something ends on the ground."""


def confused(it: Compared) -> Iterator[tuple[int, str]]:
    """Objects that are several names in one, or several of what is one, and what is made as something else."""
    yield from ((0, note) for note in _contradictory(it))
    yield from _merged(it)
    yield from _multiplied(it)
    yield from ((0, note) for note in _numbered(it))
    yield from _beheaded(it)
    yield from _parts_as_things(it)
    yield from _unpacked(it)
    yield from _made_otherwise(it)
    yield from _unasked(it)
    yield from _arms(it)
    yield from _loose(it)


def _contradictory(it: Compared) -> Iterator[str]:
    """Two that are on both sides of one another."""
    told = {(rel.child, rel.kind, rel.parent) for rel in it.plan.relations}
    for child, kind, parent in sorted(told):
        other = OPPOSITE.get(kind, "")
        if kind < other and ((child, other, parent) in told or (parent, kind, child) in told):
            yield f'"{child}" is read as {RELATION_WORDS[kind]} and {RELATION_WORDS[other]} "{parent}"'


def _merged(it: Compared) -> Iterator[tuple[int, str]]:
    """Two definite names with different places behind them, and one object for both."""
    for one, other in pairwise([mention for mention in it.said.mentions if side_of(it, mention)]):
        sides = side_of(it, one), side_of(it, other)
        if one.noun == other.noun and one.colours == other.colours and sides[0] != sides[1] and len(it.which(one)) == 1:
            yield other.start, f'"{one.text} {sides[0]}" and "{other.text} {sides[1]}" are read as one'
    landmarks = [claim.of for claim in it.said.claims]
    told = [(mention, claim) for mention in it.said.mentions for claim in it.said.claims
            if claim.at == mention.end and it.said.words[mention.first] == "the" and not mention.plural]  # fmt: skip
    for one, its in told:
        for other, place in told:
            same = one.start < other.start and one.noun == other.noun and one.colours == other.colours
            if not same or not (one in landmarks or other in landmarks) or len(it.which(other)) != 1:
                continue
            if its.said != place.said and its.place != "between" and not _stays(its, place):
                yield other.start, f'"{one.text} {its.said}" and "{other.text} {place.said}" are read as one'


def side_of(it: Compared, mention: Mention) -> str:
    """The side behind a definite name that tells it from its like: "the bowl on the left"."""
    said = it.said.words[mention.end : mention.end + 3]
    definite = it.said.words[mention.first] == "the" and not mention.plural
    led = said[:2] in (["on", "the"], ["to", "the"], ["at", "the"]) and said[2:] and said[2] in SIDES
    return " ".join(said) if definite and led and it.said.words[mention.end + 3 : mention.end + 4] != ["of"] else ""


def _stays(one: Claim, other: Claim) -> bool:
    """Whether both may be said of one thing: it is on the table, and beside the box."""
    sides = {one.place, other.place}
    same = one.of is not None and other.of is not None and one.of.noun == other.of.noun
    return not (sides in ({"left", "right"}, {"front", "behind"}) and same) and len(sides) > 1


def _multiplied(it: Compared) -> Iterator[tuple[int, str]]:
    """What is singular, and of which there are several though no word multiplies it."""
    words = it.said.words
    each = [at for at, word in enumerate(words) if word in EACH and not {*words[at + 1 : at + 2]} & GUESTS]
    own = (["of", "them"], ["of", "which"])
    led = [at for at in each if (set(words[at + 1 : at + 2]) & (BREAKING - {"of"}) and words[at - 1] not in PLACING)
           or (words[at - 1] == "," and words[at + 1 : at + 3] in own)]  # fmt: skip
    for mention in it.said.mentions:
        alone = sum(other.noun == mention.noun for other in it.said.mentions) == 1
        if not alone or mention.plural or mention.number not in (None, 1):
            continue
        there = sum(obj.noun == mention.noun and not it.headless(obj) for obj in it.plan.objects)
        near = set(words[max(mention.first - 2, 0) : mention.first]) & (EACH | {"of"})
        # "A sofa with two cushions, each on its side": one sofa; "a fork beside each plate": as many as plates.
        one = words[mention.first] == "the" or (bool(led) and led == each and mention.end <= led[0])
        if there > 1 and one and not near and not _SEVERAL & set(words):
            yield (
                mention.start,
                f'counted otherwise: "{words[mention.first]} {mention.text}", of which there are {there}',
            )


def _numbered(it: Compared) -> Iterator[str]:
    """How many there are of what is said in the plural, where neither the sentence nor a note says it."""
    if set(it.said.words) & EACH:
        return
    for mention in it.said.mentions:
        several = it.of(mention)
        phrases = {obj.phrase.lower() for obj in several}
        said = {word for phrase in phrases for word in phrase.split()}
        vague = said & {"lot", "lots", "number", "few", "several", "many"}
        counted = not vague and any(word in NUMBERS or word.isdecimal() or _TENS.fullmatch(word) for word in said)
        counted = counted or any(_AS_MANY.search(phrase) for phrase in phrases)
        # "Apples in a box, ten of them"
        of_them = (n for n, word in enumerate(it.said.words) if it.said.words[n + 1 : n + 3] == ["of", "them"])
        counted = counted or any(NUMBERS.get(it.said.words[n]) == len(several) for n in of_them)
        listed = it.said.words[mention.end : mention.end + 1] == ["("] or "colors" in it.said.words
        counted = counted or listed or mention.number is not None or mention.noun in SINGLE or not mention.plural
        if counted or len(several) < 2 or len(phrases) != 1 or any(word in REPEATS for word in it.said.words):
            continue
        if not any(phrase in it.quoted for phrase in phrases) and mention.text not in it.quoted:
            yield f'"{mention.text}": {len(several)} assumed.'


def _beheaded(it: Compared) -> Iterator[tuple[int, str]]:
    """What is called by the last word of its phrase and made as what describes it: the cat of "a cat toy"."""
    words = it.said.words
    for mention in it.said.mentions:
        head = words[mention.end] if mention.end < len(words) else "."
        if not head[0].isalpha() or head in BREAKING | POSED or (head in SILENT and head not in ("toy", "toys")):
            continue
        for obj in it.of(mention)[:1]:
            own = {*obj.name.split(), *obj.noun.split(), *obj.adjectives}
            last = obj.phrase.lower().split()[-1:]
            if last == [head] and not own & {head, *singulars(head)} and head not in it.quoted:
                yield mention.start, f'"{mention.text} {head}" is made as a "{obj.noun}"'


def _parts_as_things(it: Compared) -> Iterator[tuple[int, str]]:
    """A part that is called like a thing: "a spoon with its bowl in the cup"."""
    words = it.said.words
    for claim in it.said.claims:
        part = claim.of
        if claim.place != "with" or part is None or words[part.first] != "its" or part.text in it.told:
            continue
        own = [obj for obj in it.which(part) if obj.phrase.lower() == " ".join(words[part.first : part.end])]
        if own and own[0].noun not in ("lid", "saucer") and any(behind.at == part.end for behind in it.said.claims):
            yield part.start, f'"its {part.text}" is made as a thing of its own'
    for obj in it.plan.objects:
        said = obj.phrase.lower().split()
        if (
            said[:1] in (["its"], ["their"])
            and {said[-1], *singulars(said[-1])} & _FAST
            and obj.phrase.lower() not in it.told
        ):
            yield 0, f'"{obj.phrase}" is made as a thing of its own'


def _unpacked(it: Compared) -> Iterator[tuple[int, str]]:
    """What comes in a bottle or is a slice, and is made without it, or whole."""
    words = it.said.words
    for at, word in enumerate(words[:-2]):
        packet = {word, *singulars(word)} & (PACKETS | PIECES)
        if not packet or words[at + 1] != "of":
            continue
        inside = next((mention for mention in it.said.mentions if mention.first <= at + 2 < mention.end), None)
        own = it.which(inside) if inside is not None else []
        if word in ("piece", "pieces") and words[at + 2] in UNCOUNTED:
            continue
        packed = any(packet & set(f"{obj.name} {obj.noun}".split()) for obj in it.plan.objects)
        if own and not packed and all(obj.noun == inside.noun and obj.noun not in POURED for obj in own if inside):
            yield at, f'"{word} of {words[at + 2]}" is made as "{own[0].noun}"'


def _made_otherwise(it: Compared) -> Iterator[tuple[int, str]]:
    """What the catalogue makes as another thing that goes by its name in other company: the washer on a bolt."""
    for obj in it.plan.objects:
        words = re.findall(r"[a-z]+", obj.phrase.lower())
        if any(f'"{obj.phrase.lower()}" is {told}' in it.quoted for told in ("made", "read")):
            # "A rice cake" that is made as a cookie says so.
            continue
        for said, company in _NAMESAKES.items():
            name = said.split()
            # What a prompt of chess calls a knight has the name of a chess knight.
            told = [*words, *(re.findall(r"[a-z]+", obj.name.lower()) if len(name) > 1 else ())]
            called = any([*told[max(n + 1 - len(name), 0) : n], one] == name
                         for n, word in enumerate(told) for one in (word, *singulars(word)))  # fmt: skip
            meant = not company or {*company.split()} & ({*it.said.words} - {*words})
            made = obj.noun.split()
            own = said == obj.noun or ({*made} <= {*words} and not {*made} <= {*name})
            if called and meant and not own and f'"{said}"' not in it.quoted:
                yield 0, f'"{said}" is made as a "{obj.noun}"'
                break
        for said, whole in _WORN.items():
            worn = obj.noun == said and {*whole.split()} & {*it.said.words} and "baseball" not in words
            if worn and words[-1] in it.said.words:
                yield it.said.words.index(words[-1]), f'"{said}" is made as one to wear'
        shared = {*obj.noun.split()} & {*words}
        alone = _BARE & {words[-1], *singulars(words[-1])} if words and not shared else set[str]()
        # "The soup" is made as a can of it.
        alone |= _SOLD & {*words[-1:]} if set[str]() < shared <= _SOLD and obj.noun not in _SOLD else set[str]()
        # "Apples on the shelf and cookies on the rack"
        named = " ".join(f"{one.noun} {one.phrase}" for one in it.plan.objects)
        alone |= {"rack"} & {*it.said.words} if obj.noun == "shelf" and "rack" not in named else set[str]()
        for said in sorted(alone):
            yield 0, f'"{said}" is made as a "{obj.noun}"'


def _unasked(it: Compared) -> Iterator[tuple[int, str]]:
    """A request that is neither a task nor said to be none."""
    start = [word for word in it.said.words if word not in ("please", "could", "can", "you", "now", "just")][:3]
    if not start:
        return
    asked = it.tasks.strip() or it.undone or "is read as the scene" in it.quoted
    scene = start[0] in ("give", "show") and {*start[1:]} & {"a", "an", "scene"}
    scene = scene or start[:2] in (["put", "together"], ["set", "up"])
    # "Set two cubes on top of each other", but "Stack of two cubes"
    putting = start[0] in ("set", "stack") and len(start) > 1 and (start[1] in NUMBERS or start[1].isdecimal())
    if (start[0] in REQUESTS or putting) and not asked and not scene and "task" not in it.quoted:
        yield 0, f'not modelled: "{start[0]}": no task is made of it.'


def _arms(it: Compared) -> Iterator[tuple[int, str]]:
    """Which arm is to act, which no task says."""
    for found in _ARM.finditer(" ".join(it.said.words)):
        if (it.tasks.strip() or it.undone) and found[0] not in it.quoted:
            yield 0, f'not modelled: "{found[0]}": a task does not say which arm acts.'


def _loose(it: Compared) -> Iterator[tuple[int, str]]:
    """Words that join what they name to the rest in more than one way, and how they are read."""
    words = it.said.words
    for at in range(len(words)):
        size = next((len(each) for each in TOGETHER if tuple(words[at : at + len(each)]) == each), 0)
        if not size:
            continue
        end = next((n for n in range(at + size, len(words)) if not words[n][0].isalnum()), len(words))
        named = [mention for mention in it.said.mentions if at + size <= mention.start < end]
        text = " ".join(words[at:end])
        ground = any(not it.above(obj.name) for mention in named for obj in it.which(mention))
        done = it.tasks.strip() and all(obj.name in it.tasks for mention in named for obj in it.which(mention))
        if named and not done and (ground or words[at] in _ALWAYS) and not it.named(named[0].text):
            yield at, f'"{text}" is read as: {"; ".join(dict.fromkeys(_where(it, mention) for mention in named))}'


def _where(it: Compared, mention: Mention) -> str:
    """Where what `mention` names is."""
    objects = it.which(mention)
    places = dict.fromkeys(
        f"{RELATION_WORDS[rel.kind]} {rel.parent}" if rel is not None else "on the ground"
        for obj in objects
        for rel in [next((rel for rel in it.plan.relations if rel.child == obj.name and rel.supports), None)]
    )
    return f"{mention.text} {' and '.join(places)}" if objects else f"no {mention.text}"
