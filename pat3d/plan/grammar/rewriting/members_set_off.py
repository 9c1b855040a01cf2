"""A group and its members set off behind it: "the red toys, a car and a ball, are in the box" are a car and a ball."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.rewriting.enumerated import items_of, joined, kind_at, start_of
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_SET_OFF = frozenset({",", "-"})
_VARIED = frozenset({"other", "different", "various", "several"})
_LONGEST = 24
"""Tokens of a list of members."""


def members_set_off(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the red toys, a car and a ball, are in it" as "the red car and the red ball are in it".

    Each has what is said of all; where another number is said, the list goes on from the group.
    """
    words = [token.text for token in tokens]
    for at in (n for n in range(2, len(words) - 6) if tokens[n].text in _SET_OFF):
        kind, generic = kind_at(words, at, nouns)
        items = words[at - 1] in lexicon.ITEMS and bool(singulars(words[at - 1]))
        name = at - 1 if items else kind
        close = next((n for n in range(at + 4, min(at + _LONGEST, len(words) - 1)) if words[n] == words[at]
                      and (words[n + 1] in FINITE or link_at(tokens, n + 1))), 0)  # fmt: skip
        listed = items_of(tokens[at + 1 : close])
        first = start_of(words, name)
        named = len(listed) > 1 and all(item[0].text in ("a", "an", "one") and nouns.match([item[-1].text])
                                        for item in listed)  # fmt: skip
        plain = not any(link_at(tokens, n) or words[n] in FINITE for n in range(at + 1, close))
        counted = next((numeral(word) for word in words[first:name] if numeral(word) > 1), len(listed))
        if not (generic or items) or not named or not plain or counted != len(listed) or first == name:
            continue
        alike = [token for token in tokens[first:name] if is_modifier(token.text) and token.text not in _VARIED]
        definite = bool({"the", "all", "these"} & {*words[first:name]})
        whole = joined([[item[0], *alike, *item[1:]] for item in listed], definite, tokens[close])
        first -= 2 * (words[first - 2 : first] == ["all", "of"])
        return [*tokens[:first], *whole, *tokens[close + 1 :]]
    return list(tokens)
