"""What stands in brackets behind a thing, before it: "a cup (red)" is "a red cup", "plates (4)" are "4 plates"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_FORMATS = frozenset({"landscape", "portrait", "vertical", "horizontal", "square", "format", "orientation", "photo"})


def from_parentheses(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a cup (red)" as "a red cup", "two cups (stacked)" as "two stacked cups"."""
    made, at = list[Token](), 0
    while at < len(tokens):
        token = tokens[at]
        end = next((n for n in range(at + 1, min(at + 14, len(tokens))) if _said(text, tokens[n]) in (")", ".")), at)
        inside = [each for each in tokens[at + 1 : end] if each.text not in (",", "and")]
        opens = token.mark and _said(text, token) == "(" and inside
        colours = sum(is_colour_word(each.text) for each in inside)
        closes = opens and _said(text, tokens[end]) == ")"
        if closes and all(each.text in _FORMATS for each in inside):
            # "A bedroom (landscape)": how the photo is turned.
            at = end + (end < len(tokens) - 1)
        elif closes and colours < 2 and all(is_modifier(each.text) or each.text == "stacked" for each in inside):
            size = next((n for n in (3, 2, 1) if nouns.match([each.text for each in made[-n:]])), 1)
            made[len(made) - size : len(made) - size] = inside
            at = end + 1
        elif closes and len(inside) == 1 and (inside[0].text.isdecimal() or inside[0].text in lexicon.NUMBERS):
            made = _numbered(made, inside[0], nouns)
            at = end + 1
        else:
            made.append(token)
            at += 1
    return made


def _numbered(tokens: Sequence[Token], number: Token, nouns: Nouns) -> list[Token]:
    """`tokens`, which end in "white plates", with `number` before that; as they are where a number stands there."""
    words = [token.text for token in tokens]
    first = len(words) - next((n for n in (3, 2, 1) if n <= len(words) and nouns.match(words[-n:])), 0)
    if first == len(words):
        return [*tokens, number]
    while first and (is_modifier(words[first - 1]) or is_colour_word(words[first - 1])):
        first -= 1
    known = first and (words[first - 1] in lexicon.NUMBERS or words[first - 1].isdecimal())
    lead = first - (first > 0 and words[first - 1] in ("a", "an", "the", "some"))
    before = replace(number, start=tokens[lead].start, end=tokens[lead].start)
    return list(tokens) if known else [*tokens[:lead], before, *tokens[first:]]


def _said(text: str, token: Token) -> str:
    return text[token.start : token.end]
