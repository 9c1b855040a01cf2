"""Verbs that a later clause leaves out: "one holds a pear, the other two figs" with "the other holds two figs".

What stands where the verb would be is told from a longer name by what comes next: "the other two figs" is no verb's gap
where figs were named before. So the verb is put back before a sentence is cut into phrases.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE, LINKS, SIDES
from pat3d.plan.grammar.words.modifiers import TOLD_BY_PLACE, is_colour_word, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_JOINTS = frozenset({",", "and", "while", "but", "whereas", ":"})
_ONES = frozenset({"one", "ones"})
_TOLD = (
    lexicon.POSITIONS.keys() | lexicon.LEVELS.keys() | TOLD_BY_PLACE | {"other", "others", "last", "former", "latter"}
)
"""Words between "the" and a noun that is not said."""
_OF_ONE = {"have": "has", "hold": "holds", "contain": "contains", "carry": "carries", "bear": "bears"}
_REACH = 8
"""Words of a place: "to the right of the small red box"."""
_TELLING = lexicon.RELATIVES | lexicon.STANDING | {"each", "every"}
_SIDED = frozenset({"left", "right"})
_ARTICLES = frozenset({"a", "an", "some", "the"})


def ungapped(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with the verb in every clause that leaves it out."""
    tokens = _another_there(_set_apart(_same_landmark(tokens), nouns), nouns)
    made: list[Token] = []
    verb: Token | None = None
    copula: Token | None = None
    at = 0
    while at < len(tokens):
        token = tokens[at]
        if token.text in FINITE and _has_object(tokens, at):
            verb = token
        if token.text in lexicon.COPULAS and _describes(tokens[min(at + 1, len(tokens) - 1)].text):
            copula = token
        made.append(token)
        at += 1
        if token.text not in _JOINTS:
            continue
        if told := _of_the_kind(tokens, at, nouns):
            made += [*tokens[at : at + told[0]], replace(tokens[at + told[0] - 1], text=told[1])]
            at += told[0]
            continue
        size = _subject(tokens, at, nouns) if verb is not None else 0
        if size and verb is not None and (noun := _number_alone(tokens, at + size, nouns)) is not None:
            subject, number = tokens[at : at + size], tokens[at + size]
            made += [*subject, replace(subject[-1], text=_OF_ONE.get(verb.text, verb.text)), number]
            made.append(replace(noun, start=number.start, end=number.end))
            at += size + 1
        elif size and verb is not None and _gap(tokens, at, size, nouns):
            one = tokens[at + size - 1].text not in ("others", "ones")
            said = _OF_ONE.get(verb.text, verb.text) if one else verb.text
            made += [*tokens[at : at + size], replace(tokens[at + size - 1], text=said)]
            at += size
        elif copula is not None and (size := _quality(tokens, at, nouns)):
            made += [*tokens[at : at + size], replace(tokens[at + size - 1], text=copula.text)]
            at += size
        elif told := _place(tokens, at, nouns):
            end, after = told
            there = [replace(tokens[end - 1], text=word) for word in ("there", "is")]
            made += [*_described(tokens[at:end], tokens[:at], nouns), *there]
            at = after
    return made


def _set_apart(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the mug is behind the jar and the fork left of both" as "..., and the fork left of both".

    What has a place beside something is told of, and is no second landmark.
    """
    words = [token.text for token in tokens]
    for at in (at for at, word in enumerate(words) if word == "and"):
        stands = (n for n in range(max(at - _REACH, 1), at) if words[n - 1] in lexicon.STANDING and link_at(tokens, n))
        link = next(stands, at)
        place = next((n for n in range(at + 2, min(at + _REACH, len(words))) if link_at(tokens, n)), 0)
        behind = place + link_at(tokens, place)
        beside = LINKS.get(tuple(words[place:behind])) if place else None
        near = words[link + link_at(tokens, link) : at]
        if not near or words[link] == "between" or near[0] == "both" or beside is None or words[behind] == "it":
            continue
        end = next((n for n in range(behind, len(words)) if tokens[n].mark or words[n] == "and"), len(words) - 1)
        plain = not any(tokens[n].mark for n in range(link, end))
        plain = plain and not any(link_at(tokens, n) for n in (*range(at - len(near), at), *range(behind, end)))
        plain = plain and not _TELLING & {*words[link:end]} and words[at + 1] in lexicon.DETERMINERS
        plain = plain and all(nouns.longest(said) for said in (near, words[at + 1 : place]))
        if plain and beside.kind in LATERAL_KINDS and end > behind:
            return [*tokens[:at], replace(tokens[at], text=",", end=tokens[at].start, mark=True), *tokens[at:]]
    return list(tokens)


def _another_there(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "one cup is behind a jar on a table, another cup by a can" as "..., another cup is by a can"."""
    words = [token.text for token in tokens]
    name = next((n for n in (2, 1) if words[0] == "one" and nouns.match(words[1 : 1 + n])), 0)
    told = name and words[1 + name] in lexicon.COPULAS
    for at in range(4 + name, len(words) - 3) if told else ():
        noun = at + 1 + (words[at : at + 2] == ["the", "other"])
        end = noun + (1 if words[noun] in _ONES else name if words[noun : noun + name] == words[1 : 1 + name] else 0)
        further = words[at - 1] in _JOINTS and (words[at] == "another" or noun > at + 1)
        link = LINKS.get(tuple(words[end : end + link_at(tokens, end)])) if further else None
        if link is not None and link.kind in LATERAL_KINDS and not FINITE & {*words[end:]}:
            verb = replace(tokens[end - 1], text=words[1 + name])
            # "One cup is by a jar on the table, another by a can": on that table too.
            told_on = (n for n in range(at - 3, at - 7, -1) if words[n : n + 2] in (["on", "the"], ["in", "the"]))
            on = next(told_on, at - 1)
            place = [replace(token, start=tokens[-2].end, end=tokens[-2].end) for token in tokens[on : at - 1]]
            return [*tokens[:end], verb, *tokens[end:-1], *place, tokens[-1]]
    return list(tokens)


def _of_the_kind(tokens: Sequence[Token], at: int, nouns: Nouns) -> tuple[int, str] | None:
    """The words of "the blue cups" at token `at`, and the verb of "the red cups are on one tray and the blue cups on".

    What stands beside its like is told of its place, and is no second thing that the first ones are on.
    """
    words = [token.text for token in tokens]
    verb = next((n for n, word in enumerate(words[:at]) if word in FINITE), 0)
    ends = (n for n in range(at + 1, len(words)) if tokens[n].mark or link_at(tokens, n) or words[n] in FINITE)
    link = next(ends, 0)
    if words[at] != "the" or words[0] != "the" or verb < 2 or not link_at(tokens, link) or words[link] in FINITE:
        return None
    first, second = (nouns.match([words[n - 1]]) for n in (verb, link))
    end = next(n for n in range(link, len(words)) if tokens[n].mark)
    alike = first is not None and second is not None and (first.noun, first.plural) == (second.noun, second.plural)
    if not alike or FINITE & {*words[link:end]} or not all(map(_describes, words[at + 1 : link - 1])):
        return None
    return (link - at, words[verb]) if link > at + 2 and words[link - 2] != words[verb - 2] else None


def _same_landmark(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "the knife is right of the plate and the fork on the left" as "... on the left of the plate"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 4):
        size = link_at(tokens, at)
        aside = LINKS.get(tuple(words[at : at + size])) if size else None
        if aside is None or words[at + size - 1] != "of" or not _SIDED & {*words[at : at + size]}:
            continue
        joint = next((n for n in range(at + size, len(words)) if tokens[n].mark or words[n] in _JOINTS), 0)
        if joint > len(words) - 4:
            continue
        landmark = tokens[at + size : joint]
        second = joint + 1 + (words[joint] == "," and words[joint + 1] in _JOINTS)
        side = next((n for n in range(second + 1, min(second + 6, len(words))) if link_at(tokens, n)), 0)
        end = side + link_at(tokens, side) if side else 0
        named = words[second] in _ARTICLES and _SIDED & {*words[side:end]} and not any(
            link_at(tokens, n) for n in range(at + size, joint))  # fmt: skip
        had = any(word in lexicon.HAVING for word in words[:at]) or not FINITE & {*words[:at]}
        if end and named and tuple(words[side:end]) in SIDES and words[end] != "of" and tokens[end].mark and not had:
            own = next(iter(_SIDED & {*words[side:end]}))
            place = [own if word in _SIDED else word for word in words[at : at + size]]
            said = [*place, "the", *(token.text for token in landmark if token.text not in _ARTICLES)]
            again = [replace(tokens[side], text=word, end=tokens[end - 1].end) for word in said]
            return [*tokens[:side], *again, *tokens[end:]]
    return list(tokens)


def _number_alone(tokens: Sequence[Token], at: int, nouns: Nouns) -> Token | None:
    """What "two" at token `at` counts where the clause ends with it: the apples of "the first holds one apple"."""
    number, after = tokens[at], tokens[min(at + 1, len(tokens) - 1)]
    counts = number.text in lexicon.NUMBERS or number.text.isdecimal()
    if not counts or not (after.mark or after.text in _JOINTS):
        return None
    verb = next((n for n in range(at - 1, 0, -1) if _has_object(tokens, n)), 0)
    lead = tokens[verb + 1].text if verb else ""
    counted = lead in _ARTICLES or lead in lexicon.NUMBERS or lead.isdecimal()
    noun = next((n for n in range(verb + 2, min(verb + 5, at)) if not _describes(tokens[n].text)), at)
    return tokens[noun] if counted and noun < at and nouns.match([tokens[noun].text]) else None


def _quality(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The words of the subject at token `at` behind which only a quality stands: "the second blue"; 0 for none."""
    size = _subject(tokens, at, nouns)
    after = tokens[min(at + size + 1, len(tokens) - 1)]
    told = size and _describes(tokens[at + size].text) and tokens[at + size - 1].text not in _ONES
    return size if told and (after.mark or after.text in _JOINTS) else 0


def _place(tokens: Sequence[Token], at: int, nouns: Nouns) -> tuple[int, int] | None:
    """Where "in another, which is red," at token `at` ends, and where what is there begins; None for no such place.

    The sentence begins with such a place too: "in a bowl there are figs, and in another, plums".
    """
    size = link_at(tokens, at)
    if size and tokens[at + size - 1].text in ("left", "right") and tokens[at + size].text in _ONES:
        # "On the right one"
        size = 1
    one = _subject(tokens, at + size, nouns) if size and link_at(tokens, 0) else 0
    if not one or not any(token.text in lexicon.COPULAS for token in tokens[:at]):
        return None
    end = at + size + one
    if tokens[end].text == "," and tokens[end + 1].text in ("which", "that"):
        end = next((n for n in range(end + 2, len(tokens)) if tokens[n].mark), end)
    after = end + (tokens[end].text == ",")
    return (end, after) if end < len(tokens) - 1 and _gap(tokens, after, 0, nouns) else None


def _described(place: Sequence[Token], first: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`place` with "in another, which is bigger" as "in a bigger bowl", where the sentence begins "in a bowl"."""
    words = [token.text for token in place]
    noun = next((token for token in first if nouns.match([token.text])), None)
    if noun is None or words[-4:-1] not in ([",", "which", "is"], [",", "that", "is"]) or words[-5] != "another":
        return list(place)
    return [*place[:-5], replace(place[-5], text="a"), place[-1], replace(place[-1], text=noun.text)]


def _has_object(tokens: Sequence[Token], at: int) -> bool:
    """Whether the verb at token `at` has its object behind it, and no other verb or place."""
    link = LINKS.get((tokens[at].text,))
    return link is not None and link.finite and link.inverse and link.manner in ("with", "hold")


def _subject(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The words of "the other", "the second one", "a blue one", "the right drawer" at token `at`; 0 for none."""
    words = [token.text for token in tokens[at : at + 5]]
    if words[:1] == ["another"]:
        return 1 + (words[1] in _ONES or (_named(tokens, at, words[1]) and nouns.match([words[1]]) is not None))
    if words[0] not in ("the", "a", "an") or len(words) < 4:
        return 0
    if words[1] in _TOLD and (words[0] == "the" or words[1] in TOLD_BY_PLACE):
        head = words[2] in _ONES or (_named(tokens, at, words[2]) and nouns.match([words[2]]) is not None)
        return (2 + head) if head or words[0] == "the" else 0
    if _describes(words[1]) and words[2] in _ONES:
        return 3
    noun = next((n for n, word in enumerate(words) if n and not _describes(word)), len(words))
    behind = words[noun + 1 : noun + 2]
    told = words[0] == "the" and behind and (behind[0] in ("a", "an") or _several(behind[0]))
    return noun + 1 if told and nouns.match([words[noun]]) else 0


def _describes(word: str) -> bool:
    return is_colour_word(word) or is_modifier(word)


def _gap(tokens: Sequence[Token], at: int, size: int, nouns: Nouns) -> bool:
    """Whether an object stands right behind the subject of `size` words at token `at`, and no verb in its clause."""
    behind, start = tokens[at + size], at + size
    end = start
    while not tokens[end].mark and tokens[end].text not in ("and", "while", "but", "whereas"):
        if tokens[end].text in FINITE:
            return False
        end += 1
    if end == start or behind.text in lexicon.PRONOUNS or link_at(tokens, start):
        return False
    lead = start
    while lead < end and (tokens[lead].text in _ARTICLES or _several(tokens[lead].text) or tokens[lead].text == "one"):
        lead += 1
    named = [word for word in (token.text for token in tokens[lead:end]) if nouns.match([word])]
    if not named:
        return False
    if behind.text in _ARTICLES:
        return True
    open_ended = tokens[start - 1].text not in _ONES
    # "the other two cups", "the left books" are names where such things were named before.
    return not (open_ended and _named(tokens, at, named[0])) and (_several(behind.text) or bool(singulars(named[0])))


def _named(tokens: Sequence[Token], end: int, word: str) -> bool:
    """Whether `word`, or the one thing or several of it, was named before token `end`."""
    forms = {word, *singulars(word)}
    return any(forms & {token.text, *singulars(token.text)} for token in tokens[:end])


def _several(word: str) -> bool:
    return (word in lexicon.NUMBERS and word not in ("one", "both")) or word.isdecimal()
