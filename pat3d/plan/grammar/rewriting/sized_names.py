"""Which of several is meant by its size: "the larger of the two combs" is the large comb where one was named so."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import prod
from operator import itemgetter

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.sizes import extents
from pat3d.plan.grammar.words.vocabulary import Nouns

_LARGE, _SMALL = ("large", "big", "huge"), ("small", "little", "tiny")
_COMPARED = {
    **dict.fromkeys(("larger", "bigger", "largest", "biggest"), _LARGE),
    **dict.fromkeys(("smaller", "smallest", "littlest", "tiniest"), _SMALL),
    **dict.fromkeys(("taller", "tallest"), ("tall",)), **dict.fromkeys(("shorter", "shortest"), ("short",)),
    **dict.fromkeys(("longer", "longest"), ("long",)),
}  # fmt: skip
"""Comparatives, with what things are called of which they may be said."""
_BY: dict[str, tuple[Callable[..., tuple[str, ...]], Callable[[tuple[float, ...]], float]]] = {
    **dict.fromkeys(("largest", "biggest"), (max, prod)), **dict.fromkeys(("smallest", "tiniest"), (min, prod)),
    "tallest": (max, itemgetter(2)), "shortest": (min, itemgetter(2)), "longest": (max, max),
}  # fmt: skip
_LEFT = frozenset({"remaining", "other", "last", "third", "medium", "medium-sized"})
"""Ranks of unlike things, by what they are told; and what is left then."""
_ENDS = {"smallest": "smaller", "largest": "larger", "biggest": "bigger"}


def by_size(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the larger comb" as "the large comb" behind a sentence with a large comb and another."""
    made = _of_the_listed(_both_ends(tokens, nouns), nouns)
    at = 1
    while at < len(made) - 2:
        words = [token.text for token in made]
        named = _named(words, at, nouns) if words[at] in _COMPARED and words[at - 1] == "the" else None
        stop = next((n for n in range(at, 0, -1) if words[n] == "."), 0)
        if named is not None and stop:
            first, end, noun = named
            sizes = _sizes(words[:stop], noun, nouns)
            of = first - at > 1
            size = next((word for word in _COMPARED[words[at]] if word in sizes), words[at] if of and sizes else "")
            if size:
                name = made[first:end]
                if of:
                    single = (one for one in singulars(name[-1].text) if nouns.match([*words[first : end - 1], one]))
                    name = [*name[:-1], replace(name[-1], text=next(single, name[-1].text))]
                made[at:end] = [replace(made[at], text=size), *name]
        at += 1
    return made


def _of_the_listed(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a fig and a melon, the largest fruit on the left" as "a fig and a melon, the melon on ..."."""
    words, listed, made = [token.text for token in tokens], dict[tuple[str, ...], tuple[float, ...]](), list(tokens)
    ranks = [at for at in range(1, len(words) - 1) if words[at - 1] == "the" and words[at] in (*_BY, *_LEFT)]
    for at in range(ranks[0] if ranks and words[ranks[0]] in _BY else 0):
        size = next((n for n in (3, 2, 1) if nouns.match(words[at : at + n])), 0)
        found = nouns.match(words[at : at + size])
        first = next((n for n in range(at - 1, 0, -1) if not is_modifier(words[n])), 0)
        if found is not None and words[first] in ("a", "an") and not nouns.of_class(found.noun, lexicon.FLOOR):
            listed[tuple(words[at : at + size])] = extents(found.noun)
    if len(listed) < 2 or not all(listed.values()):
        return tokens
    of = {at: pick(listed, key=lambda name, by=by: by(listed[name]))
          for at in ranks if words[at] in _BY for pick, by in (_BY[words[at]],)}  # fmt: skip
    left = [name for name in listed if name not in of.values()]
    for at in reversed(ranks):
        head = at + 1 + (words[at + 1] in {*lexicon.ITEMS, *lexicon.GENERICS, "one", "thing"})
        ends = tokens[head].mark or link_at(tokens, head) or words[head] in FINITE | {"and"}
        if not ends or (at not in of and len(left) != 1):
            return tokens
        made[at:head] = [replace(tokens[at], text=word, end=tokens[head - 1].end) for word in (of.get(at) or left[0])]
    return made


def _both_ends(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the smallest bowl inside the largest bowl" as "the smaller ... the larger bowl", which are two."""
    words = [token.text for token in tokens]
    ends = [at for at in range(1, len(words) - 1) if words[at] in _ENDS and words[at - 1] == "the"]
    names = [nouns.match([words[at + 1]]) for at in ends]
    kinds = {_COMPARED[words[at]] for at in ends}
    found = {name.noun for name in names if name is not None and not name.plural}
    others = [word for word in words if (name := nouns.match([word])) is not None and name.noun in found]
    if len(ends) != 2 or None in names or len(found) != 1 or len(kinds) != 2 or len(others) != 2:
        return list(tokens)
    return [replace(token, text=_ENDS[token.text]) if at in ends else token for at, token in enumerate(tokens)]


def _named(words: Sequence[str], at: int, nouns: Nouns) -> tuple[int, int, str] | None:
    """Where the name begins and ends behind "larger" at `at`, "of the two" between them, and its noun; or None."""
    first = at + 1
    if words[first] == "one" and words[first + 1] == "of":
        first += 1
    if words[first : first + 2] == ["of", "the"]:
        first += 2 + (words[first + 2] in lexicon.NUMBERS)
    for size in (3, 2, 1):
        found = nouns.match(words[first : first + size])
        if found is not None and found.plural == (first > at + 1):
            return first, first + size, found.noun
    return None


def _sizes(words: Sequence[str], noun: str, nouns: Nouns) -> set[str]:
    """How large things of `noun` are said to be; an empty word where of one or several nothing is said."""
    made: set[str] = set()
    at = 0
    while at < len(words):
        size = next((n for n in (3, 2, 1) if (found := nouns.match(words[at : at + n])) and found.noun == noun), 0)
        if size:
            first = at
            while first and is_modifier(words[first - 1]):
                first -= 1
            made |= {*words[first:at]} & {word for each in _COMPARED.values() for word in each} or {""}
        at += size or 1
    return made
