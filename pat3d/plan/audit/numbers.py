"""Numbers that stand without a noun, "or", sizes and places among likes: what they say of how many, and of which."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from pat3d.assets.colours import find_colour
from pat3d.assets.materials import find_material
from pat3d.plan.audit.compared import KINDS, Compared
from pat3d.plan.audit.text import Mention
from pat3d.plan.audit.words import ADJECTIVES, ARTICLES, CORNERS, EACH, ENDS, FINITE, NUMBERS, POSED, RELATIONS

_BIG = frozenset({"big", "large", "huge", "giant"})
_SMALL = frozenset({"small", "little", "tiny", "mini"})
_SHARES = NUMBERS.keys() - {"a", "an", "another", "single", "both", "dozen", "pair", "couple"}
_REACH = 6
"""Words of "two of them in each of"."""
_STEMS = frozenset({"larg", "bigg", "small", "tall", "short", "long", "wid", "thick", "thinn", "tini", "high", "low"})
"""Of comparatives."""
_AS_MANY = re.compile(
    r"(?<!half )(?<!twice )(?<!times )\bas many ([a-z -]+?) as ([a-z -]+?)(?=[,.;:]|$| are\b| is\b| on\b| in\b)"
)
_OF_THEM = (["of", "them"], ["of", "which"], ["of", "these"], ["of", "those"])


def numbers(it: Compared) -> Iterator[tuple[int, str]]:
    """Numbers of which the plan has others."""
    for find in (_miscounted_shares, _shares_of_each, _shares_of_sides, _all_but, _dozens, _as_many,
                 _in_brackets, _of_one, _stacked, _partly, _compared_sizes, _held_by_other):  # fmt: skip
        yield from find(it)


def had_by_each(it: Compared, mention: Mention) -> bool:
    """Whether several things have one each of `mention`: "two trays hold a burger", "two plates of pizza"."""
    words = it.said.words
    verbs = [
        claim.at
        for claim in it.said.claims
        if claim.place in ("with", "holding") and claim.end <= mention.end and claim.part == mention.part
    ]
    verbs += [mention.first - 1] if words[mention.first - 1 : mention.first] == ["of"] else []
    # "Two bowls with soup and a spoon": with what has no noun.
    verbs = verbs or [at for at, word in enumerate(words[: mention.first]) if word == "with"]
    owned = [one for one in it.said.mentions if one.plural and verbs and one.end <= verbs[-1]]
    owners = {obj.name for obj in it.which(owned[-1])} if owned else set()
    of = [{b for a, _, b in it.edges if a == obj.name and b in owners} for obj in it.of(mention)]
    return len(of) > 1 and all(len(by) == 1 for by in of) and len({min(by) for by in of}) == len(of)


def _miscounted_shares(it: Compared) -> Iterator[tuple[int, str]]:
    """Shares of a number: "ten books: six on the shelf, four on the floor"."""
    words = it.said.words
    if it.tasks.strip() or it.undone:
        return
    for at, word in enumerate(words[:-1]):
        count = NUMBERS.get(word, 0) if word not in ("a", "an", "another", "single", "dozen", "one", "both") else 0
        if not count or (at and words[at - 1] in ("the", "other", "of", "in", "by", "or", "but")):
            continue
        behind = at + 1
        if words[behind : behind + 2] in _OF_THEM:
            behind += 2
        while behind < len(words) and words[behind] in POSED:
            behind += 1
        claim = next((claim for claim in it.said.claims if claim.at == behind and claim.of is not None), None)
        before = [mention for mention in it.said.mentions if mention.end <= at and (mention.number or 2) > count]
        if claim is None or claim.of is None or not before or claim.place not in KINDS:
            continue
        if EACH & {*words[behind : claim.end]}:
            continue
        landmarks = {obj.name for obj in it.which(claim.of)}
        several = max((it.which(mention) for mention in before), key=len)
        there = {a for a, kind, b in it.edges if kind in KINDS[claim.place] and b in landmarks}
        share = [obj for obj in several if obj.name in there]
        if len(several) > 1 and landmarks and len(share) != count and not it.excused(claim):
            yield at, f'counted otherwise: "{word} {claim.said}"; there are {len(share)}'


def _shares_of_each(it: Compared) -> Iterator[tuple[int, str]]:
    """How many there are at each of several: "six apples, two in each of three bowls"."""
    words, mentions = it.said.words, it.said.mentions
    for at in (at for at, word in enumerate(words) if word in EACH and not it.tasks.strip()):
        number = next((n for n in range(at - 1, max(at - _REACH, -1), -1) if words[n] in _SHARES), at)
        place = next(
            (RELATIONS[said] for n in range(number + 1, at) if (said := tuple(words[n:at])) in RELATIONS), None
        )
        if place == "between" or place not in KINDS or {*words[at + 1 : at + 2]} & {"other", *ENDS, *CORNERS}:
            continue
        count, said = NUMBERS[words[number]], " ".join(words[number : at + 1])
        before = [mention for mention in mentions if mention.end <= number and (mention.number or 0) > 1]
        things = [mention for mention in mentions if number < mention.start < at]
        owners = [mention for mention in mentions if at < mention.start and _leads_to(words[at + 1 : mention.start])]
        pairs = [(one, other) for other in owners[:1] or before[::-1] for one in things or before[::-1]
                 if one.noun != other.noun]  # fmt: skip
        even = [(one, other) for one, other in pairs if (one.number or 0) == count * (other.number or 0)]
        for own, owner in (even or pairs)[:1]:
            names = {obj.name for obj in it.of(own)}
            there = {len({a for a, kind, b in it.edges if kind in KINDS[place] and b == obj.name and a in names})
                     for obj in it.which(owner)} - {count}  # fmt: skip
            if names and there:
                yield at, f'counted otherwise: "{said}"; there are {max(there)}'
            total = max((mention.number or 0 for mention in before if mention.noun == own.noun), default=len(names))
            if len(names) > total:
                yield at, f'counted otherwise: "{own.text}", of which there are {len(names)}, with "{said}"'


def _leads_to(words: Sequence[str]) -> bool:
    """Whether `words` stand between "each" and what it is said of: "each of the three small" bowls."""
    return len(words) < _REACH and set(words) <= ARTICLES | ADJECTIVES | {"of"}


def _shares_of_sides(it: Compared) -> Iterator[tuple[int, str]]:
    """How many there are on each of two sides: "four pillows, two on either side of a blanket"."""
    words = it.said.words
    for at, word in enumerate(words):
        if word not in ("either", "each", "both") or words[at + 1 : at + 2] not in (["side"], ["sides"]) or at < 2:
            continue
        count, owner = NUMBERS.get(words[at - 2], 0), words[at + 2 : at + 3] == ["of"]
        of = next((mention for mention in it.said.mentions if mention.start > at), None) if owner else None
        if of is None and not owner:
            # "A table with four chairs, two on each side"
            of = next((each for each in it.said.mentions if each.noun in it.furniture and each.end <= at), None)
        several = [mention for mention in it.said.mentions if mention.end <= at and mention.plural]
        if count < 2 or of is None or not several:
            continue
        names, landmarks = ({obj.name for obj in it.which(mention)} for mention in (several[-1], of))
        for kind in ("left_of", "right_of"):
            there = len({a for a, k, b in it.edges if k == kind and a in names and b in landmarks})
            if names and landmarks and there != count:
                yield at, f'counted otherwise: "{" ".join(words[at - 2 : at + 2])}"; {there} are {kind.split("_")[0]}'
                break


def _all_but(it: Compared) -> Iterator[tuple[int, str]]:
    """What is true of all but some: "all the cups but one are on the tray"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words[:-1]) if word == "but" and words[at + 1] in NUMBERS):
        whole = next((mention for mention in it.said.mentions if mention.end == at and mention.plural), None)
        claim = next((claim for claim in it.said.claims if claim.at > at + 1 and claim.of is not None), None)
        if whole is None or claim is None or claim.of is None or "all" not in words[:at] or claim.place not in KINDS:
            continue
        names, landmarks = ({obj.name for obj in it.which(mention)} for mention in (whole, claim.of))
        there = {a for a, kind, b in it.edges if kind in KINDS[claim.place] and a in names and b in landmarks}
        if names and landmarks and len(there) != len(names) - NUMBERS[words[at + 1]]:
            said = " ".join(words[whole.start : at + 2])
            yield at, f'counted otherwise: "all {said}" {claim.said}; there are {len(there)} of {len(names)}'


def _dozens(it: Compared) -> Iterator[tuple[int, str]]:
    """Several dozens of which there is less than two."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "dozen" and at > 1):
        said = words[at - 2 : at + 1] if words[at - 1] == "of" else words[at - 1 : at + 1]
        mention = next((mention for mention in it.said.mentions if mention.start > at), None)
        if mention is not None and said[0] in ("couple", "few", "several", "two"):
            there = len(it.which(mention))
            if 0 < there < 24:
                yield at, f'counted otherwise: "{" ".join(said)}" of "{mention.text}"; there are {there}'


def _as_many(it: Compared) -> Iterator[tuple[int, str]]:
    """Two kinds of which there are to be as many, and are not."""
    for found in _AS_MANY.finditer(it.plan.prompt.lower()):
        named = [next((each for each in it.said.mentions if each.text in part), None) for part in found.groups()]
        counts = [sum(obj.noun == each.noun for obj in it.plan.objects) for each in named if each is not None]
        if len(counts) == 2 and counts[0] != counts[1]:
            yield 0, f'counted otherwise: "{found[0]}"; there are {counts[0]} and {counts[1]}'


def _stacked(it: Compared) -> Iterator[tuple[int, str]]:
    """Which of some likes are stacked: "five books, three of them stacked", "the red ones are stacked"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word in ("stacked", "piled")):
        end = at
        while end and words[end - 1] in POSED:
            end -= 1
        start = end - (2 if words[max(end - 2, 0) : end] in _OF_THEM else 0)
        mention = next((mention for mention in reversed(it.said.mentions) if mention.end <= start), None)
        claim = next((claim for claim in it.said.claims if claim.at == at + 1), None)
        onto = claim is not None and (claim.of is None or mention is None or claim.of.noun == mention.noun)
        formed = {*words[at + 1 : at + 4]} & {"high", "piles", "stacks", "towers", "columns", "groups"}
        if mention is None or not end or onto or formed:
            continue
        alike = [obj for obj in it.plan.objects if obj.noun == mention.noun]
        towers = [{obj.name, *it.above(obj.name)} & {one.name for one in alike} for obj in alike]
        towers = [tower for tower in towers if not any(tower < other for other in towers)]
        first = mention.first if mention.end == start else max(start - 2, 0)
        first += not words[first][0].isalnum()
        lead = words[first : mention.start if mention.end == start else start]
        number = next((NUMBERS[word] for word in lead if word in _SHARES), 0)
        colour = next((word for word in lead if find_colour(word)), "")
        told = {obj.name for obj in alike if colour and it.has(obj, colour)}
        several = any(len(tower) > 1 for tower in towers)
        said = " ".join(words[first : at + 1])
        if number > 1 and several and all(len(tower) != number for tower in towers) and not it.named(words[at]):
            yield at, f'counted otherwise: "{said}"; of which there are {max(map(len, towers))}'
        elif (
            len(told) > 1
            and any(len(tower) > 1 and tower & told and tower - told for tower in towers)
            and not it.named(words[at])
        ):
            yield at, f'not as said: "{said}"; others are in that stack'
        elif number < 2 and several and words[first - 1] == "and" and any(len(tower) == 1 for tower in towers):
            # "Two blue cubes and one red cube are stacked."
            yield at, f'not as said: "{words[at]}" of all; {sum(len(tower) == 1 for tower in towers)} of them are not'


def _partly(it: Compared) -> Iterator[tuple[int, str]]:
    """Things of one phrase of which only some are where all of them are said to be."""
    for claim in it.said.claims:
        own = next((mention for mention in it.said.mentions if mention.end == claim.at and mention.plural), None)
        if own is None or claim.of is None or claim.place not in KINDS or it.tasks.strip() or it.undone:
            continue
        phrase = " ".join(it.said.words[own.first : own.end])
        group = [obj.name for obj in it.of(own) if obj.phrase.lower() == phrase]
        landmarks = {obj.name for obj in it.which(claim.of)}
        there = {a for a, kind, b in it.edges if kind in KINDS[claim.place] and b in landmarks and a in group}
        if 0 < len(there) < len(group) and len(group) - len(there) != _told_of_them(it.said.words[claim.end :]):
            yield claim.at, f'counted otherwise: "{phrase} {claim.said}"; there are {len(there)}'


def _told_of_them(words: Sequence[str]) -> int:
    """How many the `words` behind a place say are elsewhere: ", two of them on a tray", ", but one is on the floor"."""
    told = (NUMBERS.get(word, 0) for at, word in enumerate(words) if list(words[at + 1 : at + 3]) in _OF_THEM or
            (at and words[at - 1] in ("but", "that") and {*words[at + 1 : at + 2]} & FINITE))  # fmt: skip
    return next(told, 0)


def _held_by_other(it: Compared) -> Iterator[tuple[int, str]]:
    """What "the other one" holds, where the first one holds it: "one bowl holds a key, the other one a nut"."""
    words = it.said.words
    held = [claim for claim in it.said.claims if claim.place == "holding" and claim.of is not None]
    for one, other in pairwise(held):
        between = words[one.end : other.at]
        if one.of is None or other.of is None or "the other" not in " ".join(between) or one.part != other.part:
            continue
        things = [[it.support(obj.name) for obj in it.which(of)] for of in (one.of, other.of)]
        first, second = ({edge.parent for edge in edges if edge is not None} for edges in things)
        holders = {obj.name for mention in it.said.mentions if mention.end <= one.at for obj in it.of(mention)}
        if first & second & holders and not it.excused(other):
            yield other.at, f'not as said: "the other" {other.said}; the same one does'


def _compared_sizes(it: Compared) -> Iterator[tuple[int, str]]:
    """What "which is larger" is said of, where nothing of that name is: "a mug and a bowl, which is larger"."""
    words = it.said.words
    for at in (at for at in range(2, len(words) - 2) if words[at] in ("which", "that")):
        size = words[at + 2]
        if words[at + 1] not in ("is", "are") or size.removesuffix("er") not in _STEMS:
            continue
        end = at - (words[at - 1] == ",")
        other = end - (words[end - 1] in ("one", "ones"))
        before = [mention for mention in it.said.mentions if mention.end <= end]
        own = [mention for mention in before if mention.end == end] or before[:1] * (words[other - 1] == "other")
        if own and not any(size in (*obj.name.split(), *obj.adjectives) for obj in it.of(own[0])):
            yield at, f'not as said: "{size}" of "{own[0].text}"'


def rows(it: Compared) -> Iterator[tuple[int, str]]:
    """A row, or an order from left to right, that no two things of the plan stand in."""
    for one in it.plan.arrangements:
        if one.kind in ("row", "side_by_side", "circle") and len({*one.objects, *one.of}) == 1:
            yield 0, f'not as said: "{one.kind.replace("_", " ")}" of "{one.objects[0]}" alone'
    for row in (one for one in it.plan.arrangements if one.kind == "row" and len(one.objects) > 2):
        for one in it.plan.arrangements:
            # "Three cups in a row on the shelf, the red one in the middle": of the row, not of the shelf.
            ends = {row.objects[0], row.objects[-1]} & set(one.objects)
            if one.kind == "in_middle" and ends and set(one.objects) < set(row.objects):
                name = min(ends)
                of = f' of "{one.of[0]}"' if one.of else ""
                yield 0, f'not as said: "{name}" is at the end of the row, and in the middle{of}'
    stands = any(len(one.objects) > 1 for one in it.plan.arrangements)
    stands = stands or any(not rel.supports for rel in it.plan.relations)
    words = it.said.words
    for said in ("in a row", "in a line", "from left to right", "side by side", "in a circle", "in a ring"):
        size = len(said.split())
        at = next((at for at in range(len(words)) if " ".join(words[at : at + size]) == said), None)
        if at is not None and not stands and len(it.plan.objects) > 1 and said not in it.quoted:
            yield at, f'not as said: "{said}"'


def _in_brackets(it: Compared) -> Iterator[tuple[int, str]]:
    """A number behind which more or less is listed: "three fruits (a fig, a pear)"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "(" and ")" in words[at:]):
        said = next((n for n in range(at - 1, max(at - _REACH, -1), -1) if words[n] in _SHARES), at)
        listed = re.split(r" ?, and | ?, | and ", " ".join(words[at + 1 : words.index(")", at)]))
        plain = not NUMBERS.keys() - {"a", "an"} & {word for each in listed for word in each.split()}
        if said < at and len(listed) > 1 and plain and len(listed) != NUMBERS[words[said]]:
            yield at, f'counted otherwise: "{" ".join(words[said:at])}", of which {len(listed)} are listed'


def _of_one(it: Compared) -> Iterator[tuple[int, str]]:
    """Some of what is one object in the plan: "flowers, one of which lies beside the vase"."""
    words = it.said.words
    for at in (at for at in range(1, len(words) - 2) if words[at + 1 : at + 3] == ["of", "which"]):
        before = [mention for mention in it.said.mentions if mention.end <= at][-1:]
        if words[at] in NUMBERS and before and before[0].plural and len(it.which(before[0])) == 1:
            yield at, f'not as said: "{words[at]} of which"; "{before[0].text}" are one object'


def choices(it: Compared) -> Iterator[tuple[int, str]]:
    """An "or" that the plan takes for "and"."""
    words = it.said.words
    for at in (at for at, word in enumerate(words) if word == "or" and 0 < at < len(words) - 1):
        if '"or"' not in it.quoted and find_colour(words[at - 1]) and find_colour(words[at + 1]):
            yield at, f'"{words[at - 1]} or {words[at + 1]}" is read as "{words[at - 1]} and {words[at + 1]}"'


def sizes(it: Compared) -> Iterator[tuple[int, str]]:
    """One name said in two sizes: "the big and small boxes", "a small big cup"."""
    words = it.said.words
    for mention in it.said.mentions:
        lead = words[max(mention.first, mention.start - 4) : mention.start]
        pair = words[mention.start - 3 : mention.start] if mention.start > 2 else []
        both = [word for word in lead if word in _BIG | _SMALL]
        joined = len(pair) == 3 and pair[1] == "and" and {pair[0], pair[2]} <= ADJECTIVES
        if not joined and not (set(both) & _BIG and set(both) & _SMALL):
            continue
        for word in (pair[0], pair[2]) if joined else both:
            if not any(word in (*obj.name.split(), *obj.adjectives) for obj in it.of(mention)) and not it.named(word):
                yield mention.start, f'not as said: "{word}" of "{mention.text}"'


def shared_colours(it: Compared) -> Iterator[tuple[int, str]]:
    """What is said before two plurals and only the first of them has: "red mugs and bowls", "small cups and jars"."""
    for one, other in pairwise(it.said.mentions):
        joined = it.said.words[one.end : other.start] == ["and"] and one.plural and other.plural
        lead = [word for word in it.said.words[one.first : one.start] if word not in ARTICLES]
        for word in lead if joined and one.number is None else ():
            described = find_colour(word) or find_material(word) or word in ADJECTIVES
            has = [[obj for obj in it.which(mention) if it.has(obj, word)] for mention in (one, other)]
            if described and has[0] and not has[1] and it.which(other):
                yield one.start, f'"{word}" is read as said of "{one.text}" and not of "{other.text}"'


def listed_colours(it: Compared) -> Iterator[tuple[int, str]]:
    """Colours in brackets behind a name of which the plan lacks one: "four boxes (red, blue, green, yellow)"."""
    words = it.said.words
    for mention in it.said.mentions:
        opens = words[mention.end : mention.end + 1] == ["("] and ")" in words[mention.end :]
        close = words.index(")", mention.end) if opens else 0
        inside = [word for word in words[mention.end + 1 : max(close, mention.end + 1)] if word not in (",", "and")]
        if not inside or not all(find_colour(word) for word in inside) or not it.which(mention):
            continue
        for colour in inside:
            if not any(it.has(obj, colour) for obj in it.of(mention)):
                yield mention.start, f'not as said: "{colour}" of "{mention.text}"'
