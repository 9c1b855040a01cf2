"""What an instruction tells of how things stand before it, in a sentence of its own.

"Push the dish with the figs to the lamp" is "the figs are on the dish. Push the dish to the lamp", and "swap the pen in
the jar with the one in the box" is "a pen is in the jar. Another pen is in the box. Swap them".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.english import plural
from pat3d.plan.grammar.rewriting.errands import FILLING
from pat3d.plan.grammar.rewriting.instructions import VERBS, known_verb
from pat3d.plan.grammar.rewriting.wielded import noun_of, wielded
from pat3d.plan.grammar.words import lexicon, postures, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.plan.grammar.words.vocabulary import Nouns

_OPENING = frozenset({"and", "then", ",", "please"})
_LEADS = lexicon.DEFINITE | lexicon.POSSESSIVES
_IN_IT = (["in", "it"], ["on", "it"], ["inside", "it"], ["on", "top"])
_OTHERWISE = frozenset({"from", "of", "out", "off", "that", "which", "and", "or", "then"})
"""Words behind a thing that is had by what is moved, by which it is told where that is or which thing is meant."""
_SWAPPING = frozenset({"swap", "exchange", "trade", "switch"})
_TO = frozenset({"with", "into", "onto", "to"})
_AGAIN = ("do", "the", "same")
_FROM_AN_END = (("from", "the", "left"), ("from", "the", "right"), ("in", "the", "row"), ("in", "the", "line"))
_ARRANGED = lexicon.STACK_NOUNS | lexicon.ROWS | {"top", "bottom"}
_STATES = {"open": "open", "opened": "open", "closed": "closed", "shut": "closed", "empty": "empty"}
_TOPS = (lexicon.LEVEL, lexicon.SEATS, lexicon.DISHES, lexicon.THIN)
_CLEANING = frozenset({"wipe", "clean", "scrub", "sweep", "polish", "vacuum", "mop"})


def told_before(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """`sentence` behind what it tells of how things stand before it."""
    told = _exchanged(sentence, nouns) or _around(sentence, nouns) or _as_it_is(sentence, nouns)
    return told or _carrying(sentence, nouns)


def several_told_by_rank(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "there are some crates" before "take the pen out of the second crate", of which no other is told.

    "The second crate from the left" is one of a row.
    """
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 2):
        name = at + 2 + next((n for n in (3, 2, 1) if nouns.match(words[at + 2 : at + 2 + n])), 0)
        start = next((n + 1 for n in range(at, -1, -1) if words[n] == "."), 0)
        rank = ORDINALS.index(words[at + 1]) if words[at] == "the" and words[at + 1] in ORDINALS else -1
        row = tuple(words[name : name + 3]) in _FROM_AN_END
        if name == at + 2 or rank < 1 - row or words[name - 1] in lexicon.PARTS or singulars(words[name - 1]):
            continue
        many = plural(words[name - 1])
        others = {words[name - 1], many, "one", "ones"} & {*words[:at], *words[name:]}
        others |= _ARRANGED & {*words[start:at], *words[name + 3 * row :]}
        if others or not any(map(known_verb, words[start : start + 2])):
            continue
        number = {2: "several", 3: "several", 4: "many"}.get(rank, "some")
        several = [number, *words[at + 2 : name - 1], many]
        said = [*several, "are", "in", "a", "row", "."] if row else ["there", "are", *several, "."]
        there = [replace(tokens[at], text=word, end=tokens[name - 1].end, mark=word == ".") for word in said]
        return several_told_by_rank([*tokens[:start], *there, *tokens[start:]], nouns)
    return list(tokens)


def _as_it_is(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Tell "with a pen in the box, close the box" as "a pen is in the box", "close the box"; so of what is open."""
    words = [token.text for token in sentence]
    comma = next((n for n in range(3, len(words) - 2) if words[n] == "," and known_verb(words[n + 1])), 0)
    made, rest = list[list[Token]](), list(sentence[1:comma])
    while rest and words[0] == "with":
        stop = next((n for n in range(2, len(rest)) if rest[n].text in (",", "and")), len(rest))
        part, rest = rest[:stop], rest[stop + 1 :]
        verb = next((n for n in range(2, len(part)) if part[n].text in _STATES or postures.is_posture(part[n].text)
                     or (link_at(part, n) and part[n].text != "of")), 0)  # fmt: skip
        thing = noun_of([token.text for token in part[:verb]], nouns)
        if part[0].text not in _LEADS | lexicon.DETERMINERS | lexicon.NUMBERS.keys() or thing is None:
            return []
        where = [replace(part[verb], text=_STATES.get(part[verb].text, part[verb].text)), *part[verb + 1 :]]
        made.append(_told(part[:verb], where, many=thing.plural))
    return [*made, sentence[comma + 1 :]] if made else []


def ones_named(told: Sequence[list[Token]], nouns: Nouns) -> list[list[Token]]:
    """`told` with "the one from the floor" as "the pen from the floor", behind "a pen is on a desk and one ..."."""
    made, kind = list[list[Token]](), list[Token]()
    for sentence in told:
        words = [token.text for token in sentence]
        again = next((n for n in range(len(words) - 5) if tuple(words[n : n + 3]) == _AGAIN), len(words))
        before = sentence[:again] if again else made[-1][:-1] if made else []
        while before and before[-1].text in _OPENING:
            before = before[:-1]
        if (same := _same_with(before, sentence[again:])) is not None:
            made += [[*before, sentence[-1]], same] if again else [same]
            continue
        ones = (n for n in range(len(words) - 4) if words[n : n + 2] == ["the", "one"])
        at = next((n for n in ones if words[n + 2] in ("from", "off") or words[n + 4] in ("floor", "ground")), None)
        named = [replace(token, number=sentence[at + 1].number) for token in kind] if at is not None else []
        made.append([*sentence[: at + 1], *named, *sentence[at + 2 :]] if at is not None and named else sentence)
        more = (n for n in range(3, len(words) - 3) if words[n] == "and" and words[n + 1] in ("one", "another"))
        joint = next((n for n in more if link_at(sentence, n + 2) or link_at(sentence, n + 3)), 0)
        first = next((n for n in range(joint) if words[n] in ("a", "an")), joint)
        sizes = (n for n in (3, 2, 1) if nouns.match(words[first + 1 : first + 1 + n]))
        kind = sentence[first + 1 : first + 1 + next(sizes, 0)] if joint else kind
    return made


def _same_with(before: Sequence[Token], sentence: Sequence[Token]) -> list[Token] | None:
    """The deed `before` done to what `sentence` names: "do the same with the other two"; None where it does not."""
    words = [token.text for token in sentence]
    first = 1 + (len(before) > 1 and before[1].text == "up")
    deed = len(before) > first + 1 and VERBS.get(before[0].text) in ("make", "move", "pick", "other")
    if not deed or before[first].text not in _LEADS or words[3:4] not in (["with"], ["to"], ["for"]):
        return None
    end = next((n for n in range(first + 1, len(before)) if link_at(before, n) or before[n].mark
                or before[n].text == "and"), 0)  # fmt: skip
    if not end or words[4] not in _LEADS or any(token.mark for token in sentence[:-1]) or _TO & {*words[4:]}:
        return None
    several = lexicon.NUMBERS.keys() - {"a", "an", "one"} & {*words} or words[-2] in ("others", "ones", "rest")
    rest = [replace(each, text="them") if several and each.text == "it" else each for each in before[end:]]
    verb = replace(before[0], start=sentence[0].start, end=sentence[-2].end, number=sentence[0].number)
    return [verb, *before[1:first], *sentence[4:-1], *rest, sentence[-1]]


def _told(subject: Sequence[Token], place: Sequence[Token], *, many: bool) -> list[Token]:
    """The sentence that `subject` is at `place`."""
    verb = replace(place[0], text="are" if many else "is")
    return [*subject, verb, *place, replace(place[-1], text=".", mark=True)]


def _carrying(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Tell "push the dish with the figs to the lamp" as "the figs are on the dish", "push the dish to the lamp"."""
    words = [token.text for token in sentence]
    for at in range(len(words) - 4):
        opens = not at or words[at - 1] in _OPENING
        first = at + 1 + (words[at + 1] == "up")
        if not opens or VERBS.get(words[at]) not in ("make", "move", "pick") or words[first] not in _LEADS:
            continue
        had = next((n for n in range(first + 1, len(words)) if sentence[n].mark or link_at(sentence, n)), 0)
        if words[had] != "with" or words.count(words[had - 1]) > 1:
            continue
        ends = (n for n in range(had + 2, len(words)) if sentence[n].mark or link_at(sentence, n)
                or words[n] in _OTHERWISE | lexicon.DIRECTIONS)  # fmt: skip
        end = next(ends, 0)
        if not end or (words[at] in FILLING and words[end] not in ("to", "into", "onto")):
            # "Fill the bowl with the figs on the mat": no bowl with figs is there.
            continue
        owner, thing = noun_of(words[:had], nouns), noun_of(words[had + 1 : end], nouns)
        told = 2 * (words[end : end + 2] in _IN_IT)
        stays = sentence[end + told].mark or words[end + told] in _OTHERWISE or words[end - 1] in lexicon.DETACHED
        if owner is None or thing is None or stays or wielded(sentence[at + 1 : -1], words[at], (), nouns)[1]:
            continue
        inside = nouns.of_class(owner.noun, vessels.HOLLOW)
        level = any(nouns.of_class(owner.noun, each) for each in _TOPS)
        if (inside or level) and not nouns.of_class(thing.noun, vessels.ON_RIMS):
            where = replace(sentence[had], text="in" if inside else "on")
            there = _told(sentence[had + 1 : end], [where, *sentence[first:had]], many=thing.plural)
            return [there, [*sentence[:had], *sentence[end + told :]]]
    return [sentence]


def _exchanged(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Tell "swap the pen in the jar with the one in the box" as where the two pens are, and "swap them"."""
    words = [token.text for token in sentence]
    please = int(words[0] == "please")
    between = next(
        (n for n in range(please + 3, len(words) - 2) if words[n] in ("with", "for", "and") and words[n + 1] in _LEADS),
        0,
    )
    end = len(words) - 1
    if words[please] not in _SWAPPING or not between or any(token.mark for token in sentence[:end]):
        return []
    made = list[list[Token]]()
    things = sentence[please + 1 : between], sentence[between + 1 : end]
    cuts = [next((n for n in range(len(each)) if link_at(each, n)), 0) for each in things]
    names = [noun_of([token.text for token in each[:cut]], nouns) for each, cut in zip(things, cuts, strict=True)]
    one = things[1][cuts[1] - 1].text == "one"
    if not all(cuts) or names[0] is None or (names[1] is None and not one):
        return []
    alike = names[0] == names[1] or (one and cuts[1] == 2)
    for thing, cut, led in zip(things, cuts, ("a", "another"), strict=True):
        named = things[0][cuts[0] - 1] if thing[cut - 1].text == "one" else thing[cut - 1]
        kind = [*thing[1 : cut - 1], named]
        made.append(_told([replace(thing[0], text=led) if alike else thing[0], *kind], thing[cut:], many=False))
    them = replace(sentence[please + 1], text="them", end=sentence[end - 1].end)
    return [*made, [*sentence[: please + 1], them, sentence[-1]]]


def _around(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Tell "wipe the desk around the globe" as "the globe is on the desk", "wipe the desk"."""
    words = [token.text for token in sentence]
    at = words.index("around") if "around" in words else 0
    ends = (n for n in range(at, len(words)) if sentence[n].mark or words[n] in ("and", "then"))
    end = next(n for n in ends if words[n] != "and" or words[n + 1] not in _LEADS)
    first = next((n for n in range(1, at) if words[n] in _LEADS), 0)
    top, mark = (noun_of(words[:n], nouns) for n in (at, end))
    if not first or words[0] not in _CLEANING or top is None or mark is None or words[at + 1] not in _LEADS:
        return []
    if not nouns.of_class(top.noun, lexicon.LEVEL) or nouns.of_class(mark.noun, lexicon.FLOOR):
        return []
    many, where = mark.plural or "and" in words[at:end], [replace(sentence[at], text="on"), *sentence[first:at]]
    there = _told(sentence[at + 1 : end], where, many=many)
    return [there, [replace(sentence[0], end=sentence[end - 1].end), *sentence[1:at], *sentence[end:]]]
