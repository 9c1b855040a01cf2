"""What a vessel is said to be "with": "a glass with beer" is a glass of beer, and no bottle in a glass."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.vocabulary import Nouns

_VESSELS = tuple(name for name in vessels.HOLLOW if name not in vessels.LARGE_VESSELS)
_LEADS = frozenset({"some", "fresh", "cold", "hot", "warm", "iced"})
_IN_IT = (["in", "it"], ["inside", "it"], ["in", "them"])

_NO_THING = "liquid"
"""A substance that the catalogue has no bottle of."""


def of_drinks(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a glass with some juice in it" as "a glass of juice", where the juice is no bottle of its own.

    What the catalogue makes as its bottle or carton only is meant; "a glass with a juice" names that.
    """
    words = [token.text for token in tokens]
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        first = at + 1 + (at + 1 < len(words) and words[at + 1] in _LEADS)
        end = _drink(words, first, nouns) if words[at] == "with" and at else 0
        if not end or not _is_vessel(words, at, nouns):
            made.append(tokens[at])
            at += 1
            continue
        if words[end] in (",", "and") and _only_lists(tokens, at, end):
            # "A lunch box with rice, a carrot and an egg": the list is what the box is with, and the rice no bag in it.
            made += [tokens[at], replace(tokens[first], text=_NO_THING)]
        else:
            made += [replace(tokens[at], text="of"), *tokens[first:end]]
        at = end + 2 * (words[end : end + 2] in _IN_IT)
    return made


def _only_lists(tokens: Sequence[Token], at: int, end: int) -> bool:
    """Whether a sentence is no more than a vessel, the "with" at token `at` and the list from token `end` on."""
    words = [token.text for token in tokens]
    start = next((n + 1 for n in range(at - 1, -1, -1) if words[n] == "."), 0)
    stop = next((n for n in range(end, len(words)) if words[n] == "."), len(words))
    alone = not any((link_at(tokens, n) and words[n] != "of") or words[n] in FINITE for n in range(end, stop))
    return at - start < 6 and words[start] in ("a", "an", "the") and alone


def _drink(words: Sequence[str], first: int, nouns: Nouns) -> int:
    """The word behind the drink that begins at `first`, made as something of its own; 0 where none does."""
    for end in (first + 2, first + 1):
        name = words[first:end]
        alone = len(name) == end - first and name[-1] in lexicon.SUBSTANCES and nouns.match(name) is not None
        if alone and not (end < len(words) and nouns.match(words[first : end + 1])):
            return end
    return 0


def _is_vessel(words: Sequence[str], end: int, nouns: Nouns) -> bool:
    """Whether what is named right before word `end` is a vessel for drinks."""
    for size in (2, 1):
        name = nouns.match(words[max(end - size, 0) : end])
        if name is not None:
            return nouns.of_class(name.noun, _VESSELS)
    return False
