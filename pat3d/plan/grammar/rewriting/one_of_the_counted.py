"""One of what was counted before, or more: "two jars, one jar holds a fig" tells of one of the jars."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.english import plural
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_JOINTS = frozenset({":", ";", ",", "-", "and", "while", "where", "with"})
_PLACES = frozenset({
    "on", "in", "inside", "into", "onto", "atop", "beside", "behind", "under", "underneath", "beneath", "below", "near",
    "by", "against", "over", "above", "at",
})  # fmt: skip
_LONG_PLACES = frozenset(
    {("next", "to"), ("close", "to"), ("left", "of"), ("right", "of"), ("front", "of"), ("top", "of")}
)
_HAVING = frozenset({"with", "holds", "holding", "contains", "containing", "carries", "carrying", "has"})
_LONGEST = 4
"""Words of what describes several, with their number."""


def of_the_counted(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two jars, one jar holds a fig" as "two jars, one of the jars holds a fig".

    So is "a fig in one jar", also in a later sentence; "another of the jars" is "another".
    """
    made = _more_of_them(tokens, nouns)
    at = 0
    while at < len(made) - 2:
        at += 1
        words = [token.text for token in made]
        if words[at : at + 3] == ["another", "of", "the"] and (end := _several_end(words, at + 3, nouns)):
            made[at:end] = [replace(made[at], end=made[end - 1].end)]
            continue
        end = _name_end(made, at + 1, nouns) if words[at] in ("one", "1") else 0
        if not end:
            continue
        name = made[end - 1]
        several = plural(name.text)
        behind = words[end : end + _LONGEST + 3]
        if words[at - 1] == "with" and "other" in behind and "." not in behind[: behind.index("other")]:
            # "Two jars, with one jar behind the other"
            comma = [] if words[at - 2] == "," else [replace(made[at - 1], text=",", mark=True)]
            bare = end == at + 2 and made[end + behind.index("other") + 1].mark
            made[at - 1 : end] = [*comma, made[at], *([] if bare else made[at + 1 : end])]
            at -= 2 - len(comma)
            continue
        member = _told_of(words, at, end) or _stands_among(made, at, end, nouns)
        if member or (_led(words, at) and _counts(words[:at], words[at + 1 : end - 1], several)):
            of_those = [replace(made[at], text=text) for text in ("of", "the")]
            made[at + 1 : end] = [*of_those, *made[at + 1 : end - 1], replace(name, text=several)]
    return [each for at, token in enumerate(made) for each in _set_off(made, at, token)]


def _set_off(tokens: Sequence[Token], at: int, token: Token) -> list[Token]:
    """`token` of `tokens`, a comma for the "with" of "two jars next to a box, with one of the jars in it"."""
    words = [each.text for each in tokens[at : at + 3]]
    if words != ["with", "one", "of"] or not at:
        return [token]
    return [] if tokens[at - 1].text == "," else [replace(token, text=",", mark=True)]


def _more_of_them(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "one jar is on a shelf, two are below it" as "two more are below it".

    So is "a jar stands behind two with lids" as "behind two more with lids", and "one with a lid" as "another one".
    """
    made = list[Token]()
    words = [token.text for token in tokens]
    begin = {0, *(n + 1 for n, word in enumerate(words[:-1]) if word == ".")}
    for at, token in enumerate(tokens):
        made.append(token)
        number, behind = numeral(token.text), words[min(at + 1, len(words) - 1)]
        # "One jar is on a shelf. Two are below it."
        start = max((n for n in begin if n < at), default=0)
        first = words[start] in ("a", "an", "one", "1") or (words[start] == "the" and not start)
        if not number or token.text == "both" or not first:
            continue
        several = any(singulars(word) and nouns.match([word]) for word in words[:at])
        verb = behind in FINITE and words[at - 1] in (_JOINTS | {"."} if number > 1 else {"."})
        verb = verb and (number > 1 or not several)
        had = behind in ("with", "without") and (_led(words, at) or words[at - 1] == "between")
        # "A box holds four cans; three are red": of the cans.
        verb = verb and all((numeral(word) or 0) < number for word in words[start + 1 : at])
        end = _name_end(tokens, start + 1, nouns) if (verb or had) and at > start + 2 else 0
        if end and ((verb and words[end] in FINITE) or had) and plural(words[end - 1]) not in words[:at]:
            made.insert(len(made) - (number == 1), replace(token, text="more" if number > 1 else "another"))
    return made


def _name_end(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The token behind the singular name, with what describes it, that begins at token `at`; 0 where none does."""
    words = [token.text for token in tokens]
    first = at
    while first < len(words) and is_modifier(words[first]) and not nouns.match(words[first : first + 2]):
        first += 1
    for size in (3, 2, 1):
        name = nouns.match(words[first : first + size])
        if name is not None:
            return 0 if name.plural else first + size
    return 0


def _several_end(words: Sequence[str], at: int, nouns: Nouns) -> int:
    """The token behind the plural name that begins at token `at`; 0 where none does."""
    names = ((size, nouns.match(words[at : at + size])) for size in (3, 2, 1))
    return next((at + size for size, name in names if name is not None and name.plural), 0)


def _led(words: Sequence[str], at: int) -> bool:
    """Whether the word at `at` is what something is on, in or beside."""
    return words[at - 1] in _PLACES or tuple(words[at - 2 : at]) in _LONG_PLACES


def _told_of(words: Sequence[str], at: int, end: int) -> bool:
    """Whether the clause that "one jar" opens tells what that holds, or how it is, of several counted in the sentence.

    "Two jars on a desk, one jar on a bench" may be three, and does so only where "the other" is told of too.
    """
    start = max((n + 1 for n in range(at) if words[n] == "."), default=0)
    stop = next((n for n in range(at, len(words)) if words[n] == "."), len(words))
    if words[at - 1] not in _JOINTS or not _counts(
        words[start : at - 1], words[at + 1 : end - 1], plural(words[end - 1])
    ):
        return False
    others = any(words[n - 1 : n + 1] == ["the", "other"] for n in range(end + 1, stop))
    is_ = words[end] == "is"
    look = words[end + is_]
    told = (words[at - 1] != "and" and look in _HAVING) or (
        is_modifier(look) and not (words[at - 1] == "and" and is_colour_word(look))
    )
    placed = any(word in lexicon.VERBS | _PLACES for word in words[start : at - 1])
    listed = words[at - 1] == ":" and not placed
    return others or listed or (told and (placed or words[at - 1] == "with"))


def _stands_among(tokens: Sequence[Token], at: int, end: int, nouns: Nouns) -> bool:
    """Whether "one jar" is said to be where one of the jars before can be: "two jars on a desk, one jar in a box".

    "Two jars on a plate, one jar in a box" are three, and so are "two jars on a desk, one jar on a bench"; with "with
    one jar" they are two.
    """
    words = [token.text for token in tokens]
    start = max((n + 1 for n in range(at) if words[n] == "."), default=0)
    stop = next((n for n in range(end, len(words)) if words[n] in (".", ",", ";", "and")), len(words))
    place = next((n for n in range(end, min(end + 4, stop)) if link_at(tokens, n)), 0)
    before = words[start : at - 1]
    several = plural(words[end - 1])
    told = words[at - 1] != "and" or words[end] in FINITE
    if not (place and told) or words[at - 1] not in _JOINTS or not _counts(before, words[at + 1 : end - 1], several):
        return False
    if words[at - 1] == "with":
        return True
    carried = bool({"on", "in", "inside", "atop"} & {*before})
    floor = any(_stands_on_floor(word, nouns) for word in before)
    return (floor or not carried) and not any(_stands_on_floor(word, nouns) for word in words[place:stop])


def _stands_on_floor(word: str, nouns: Nouns) -> bool:
    name = nouns.match([word])
    return word in ("floor", "ground") or (name is not None and nouns.of_class(name.noun, lexicon.FLOOR))


def _counts(words: Sequence[str], described: Sequence[str], noun: str) -> bool:
    """Whether `words` name several that `noun` names, which are all that is `described`."""
    for at in (n for n, word in enumerate(words) if word == noun):
        before = {*words[max(at - _LONGEST, 0) : at]}
        if {*described} <= before and "one" not in words[at - 1 : at] and words[at - 3 : at - 1] != ["one", "of"]:
            return True
    return False
