"""Numbers of which only the bounds are said: "between two and four figs", "two to four figs", "two or three figs"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import number_of, numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_JOINTS = frozenset({"to", "or"})
_VAGUE = {number: word for word, number in reversed(lexicon.VAGUE.items()) if word != "couple"}
"""Words by which a number is assumed and not said."""


def ranged(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "between two and four figs" as "several figs": a number within the bounds, which is assumed."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 6]]
        between = words[0] == "between"
        low, joint, high, *rest = [*words[between:], "", "", ""]
        spans = (between and joint == "and") or (not between and joint in _JOINTS)
        spans = spans and 0 < numeral(low) < number_of(high)
        noun = next((word for word in rest if not is_modifier(word)), "")
        if not spans or not (singulars(noun) and nouns.match([noun])):
            made.append(tokens[at])
            at += 1
            continue
        end = at + between + 3
        number = next((n for n in range(numeral(high), numeral(low) - 1, -1) if n in _VAGUE), 0)
        made.append(replace(tokens[at], text=_VAGUE.get(number, low), end=tokens[end - 1].end))
        at = end
    return made
