"""The first two, the last three, another two of several: told by the rank of each, or as so many of them.

"Four bowls on a table: the first two hold nuts" is told of the first bowl and of the second bowl.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import ORDINALS, number_of, numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

HOLDING = {"hold": "holds", "contain": "contains", "carry": "carries"}
_ENDS = ("first", "last")
_JOINTS = frozenset({"and", "while"})
_OTHERS = frozenset({"others", "more"})


@dataclass(frozen=True, kw_only=True)
class Counted:
    """Several things of which a number was said."""

    number: int
    name: tuple[str, ...]
    """In the singular."""
    at: int
    """Their number among the words."""
    end: int


def some_by_rank(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the first two hold a pen" as "the first cup and the second cup hold a pen".

    So is "another two hold a pen" behind "the first holds a fig"; behind "one holds a fig" it is "two hold a pen".
    """
    made = list(tokens)
    at = 1
    while at < len(made) - 3:
        told = _end_of_several(made, at, nouns) or _another_few(made, at, nouns)
        made, at = told if told is not None else (made, at + 1)
    return made


def counted_before(words: Sequence[str], at: int, nouns: Nouns, noun: str = "") -> Counted | None:
    """What was counted last before the word at `at`, of `noun` where that is given; None where nothing was."""
    for n in range(at - 1, -1, -1):
        if number_of(words[n]) < 2:
            continue
        name = n + 1
        while name < at and is_modifier(words[name]):
            name += 1
        sizes = ((size, nouns.match(words[name : name + size])) for size in (3, 2, 1) if name + size <= at)
        size, match = next(((size, one) for size, one in sizes if one is not None and one.plural), (0, None))
        if match is not None and (not noun or match.noun == noun):
            return Counted(number=number_of(words[n]), name=tuple(match.said.split()), at=n, end=name + size)
    return None


def _end_of_several(tokens: list[Token], at: int, nouns: Nouns) -> tuple[list[Token], int] | None:
    """`tokens` with "the first two" at token `at` told by their ranks, and where to read on; None where it is not."""
    words = [token.text for token in tokens]
    many = number_of(words[at + 2])
    if words[at] != "the" or words[at + 1] not in _ENDS or many < 2:
        return None
    names = ((size, nouns.match(words[at + 3 : at + 3 + size])) for size in (3, 2, 1))
    size, named = next(((size, one) for size, one in names if one is not None and one.plural), (0, None))
    counted = counted_before(words, at, nouns, named.noun if named is not None else "")
    if counted is None and named is not None and (verb := _verb_before(tokens, at)) is not None:
        # "The first two hold balls, the last two books"
        return _end_of_several([*tokens[: at + 3], verb, *tokens[at + 3 :]], at, nouns)
    behind = at + 3 + size
    verb = words[behind] in lexicon.VERBS | lexicon.COPULAS | HOLDING.keys()
    subject = verb and (tokens[at - 1].mark or words[at - 1] in _JOINTS)
    start = next(n for n in range(at - 1, -2, -1) if n < 0 or tokens[n].mark)
    single = {"a", "an", "the", "one"} & {*words[start + 1 : at]}
    landmark = bool(named) and not subject and not single and link_at(tokens, at - 1) > 0
    if counted is None or many >= counted.number or not (subject or landmark):
        return None
    first = 0 if words[at + 1] == "first" else counted.number - many
    return _ranked(tokens, (at, behind), range(first, first + many), counted, nouns)


def _verb_before(tokens: Sequence[Token], at: int) -> Token | None:
    """The verb by which those named before token `at` in its sentence are said to hold something."""
    for token in reversed(tokens[:at]):
        if token.text == "." or token.text in HOLDING or token.text in HOLDING.values():
            holds = next((verb for verb, single in HOLDING.items() if token.text in (verb, single)), "")
            return replace(token, text=holds) if holds else None
    return None


def _another_few(tokens: list[Token], at: int, nouns: Nouns) -> tuple[list[Token], int] | None:
    """`tokens` with "another two", "two others" at token `at` as those behind what was told of before, if they are."""
    words = [token.text for token in tokens]
    another = words[at] == "another" and number_of(words[at + 1]) > 1
    others = number_of(words[at]) > 1 and words[at + 1] in _OTHERS
    plain = number_of(words[at]) > 1 and words[at + 1] in HOLDING and _bare_plural(words, at + 2, nouns)
    if not (another or others or plain) or not (tokens[at - 1].mark or words[at - 1] in _JOINTS):
        return None
    many, behind = number_of(words[at + another]), at + 1 + (another or others)
    counted = counted_before(words, at, nouns)
    told = _told_before(words, counted, at) if counted is not None else None
    onward = words[behind] in lexicon.VERBS | lexicon.COPULAS | HOLDING.keys() or link_at(tokens, behind)
    if counted is None or told is None or not onward or told + many > counted.number:
        return None
    if words[counted.end + 1 : counted.end + 3] == ["the", "first"] or ["the", "first"] in _pairs(
        words, counted.end, at
    ):
        return _ranked(tokens, (at, behind), range(told, told + many), counted, nouns)
    of_them = ["of", "them"] if words[behind] in HOLDING else []
    few = [tokens[at + another], *(replace(tokens[at + another], text=word) for word in of_them)]
    return [*tokens[:at], *few, *tokens[behind:]], at + len(few)


def _pairs(words: Sequence[str], start: int, end: int) -> list[list[str]]:
    return [list(words[n : n + 2]) for n in range(start, end - 1)]


def _told_before(words: Sequence[str], counted: Counted, at: int) -> int | None:
    """How many of those `counted` are told of one by one before the word at `at`; None where none is.

    "Three pens on a desk, one in a jar" may be four: nothing says where the three are where the one is one of them.
    """
    marks = [n for n in range(counted.end, at) if words[n] in (":", ".", ",", "-")]
    if not marks or (words[marks[0]] == "," and marks[0] != counted.end):
        return None
    told = 0
    for n in range(marks[0] + 1, at):
        opens = words[n - 1] in (":", ".", ",", "-", "and", "while")
        ranked = words[n] in ORDINALS and words[n - 1] == "the"
        if opens and words[n] in ("one", "another"):
            told += 1
        elif opens and number_of(words[n]):
            told += numeral(words[n])
        elif ranked:
            told = ORDINALS.index(words[n]) + 1
    return told or None


def _bare_plural(words: Sequence[str], at: int, nouns: Nouns) -> bool:
    name = nouns.match(words[at : at + 1])
    return name is not None and name.plural


def _ranked(
    tokens: list[Token], span: tuple[int, int], ranks: range, counted: Counted, nouns: Nouns
) -> tuple[list[Token], int] | None:
    """`tokens` with those of `ranks` named in the place of `span`, and where to read on; None without words for them.

    What begins with them is a sentence of its own; what each of them holds is told of each where it is a bare plural.
    """
    at, behind = span
    if ranks.stop > len(ORDINALS):
        return None
    words = [token.text for token in tokens]
    named = [
        [replace(tokens[at], text=word, mark=False) for word in ("the", ORDINALS[n], *counted.name)] for n in ranks
    ]
    before = tokens[:at]
    if before[-1].mark and before[-1].text != ".":
        before = [*before[:-1], replace(before[-1], text=".")]
    comma, and_ = (replace(tokens[at], text=word, mark=word == ",") for word in (",", "and"))
    end = next(n for n in range(behind, len(words)) if tokens[n].mark or words[n] in ("and", "while"))
    made: list[Token] = []
    if words[behind] in HOLDING and _bare_plural(words, behind + 1, nouns):
        verb = replace(tokens[behind], text=HOLDING[words[behind]])
        for one in named:
            made += [*([comma] if made else []), *one, verb, *tokens[behind + 1 : end]]
        behind = end
    else:
        for n, one in enumerate(named):
            made += [*([and_ if n == len(named) - 1 else comma] if made else []), *one]
        if words[end] == "each" or words[end - 1] == "each":
            each = end - (words[end - 1] == "each")
            return [*before, *made, *tokens[behind:each], *tokens[each + 1 :]], at + len(made)
    return [*before, *made, *tokens[behind:]], at + len(made)
