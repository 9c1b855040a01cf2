"""Things that are called like colours: "behind the plate are mustard and cream" is of no mustard plate."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.vocabulary import Nouns

_STACKING = frozenset({"stack", "put", "place", "move"})
_GOING_ON = frozenset({",", "and", "or"})


def with_their_amount(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "behind the plate are mustard and cream" as "behind the plate are a mustard and a cream".

    What stands behind the verb of a sentence that opens with a place is what is there, not how that place looks.
    """
    words = [token.text for token in tokens]
    link = link_at(tokens, 0)
    verb = next((at for at in range(link + 1, len(words)) if words[at] in lexicon.STANDING), 0) if link else 0
    one = not any(token.mark or token.text in lexicon.DETERMINERS for token in tokens[link + 1 : verb])
    if not verb or not one or not nouns.match(words[verb - 1 : verb]):
        return list(tokens)
    made = list(tokens[: verb + 1])
    for at in range(verb + 1, len(tokens)):
        listed = at == verb + 1 or words[at - 1] in _GOING_ON
        ends = at + 1 < len(words) and (tokens[at + 1].mark or words[at + 1] in _GOING_ON)
        hue = is_colour_word(words[at]) and nouns.match(words[at : at + 1])
        named_later = at + 3 < len(words) and is_colour_word(words[at + 2]) and nouns.match(words[at + 3 : at + 4])
        if listed and ends and hue and not named_later:
            made.append(replace(tokens[at], text="a"))
        made.append(tokens[at])
    return made


def blocks_of_colours(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt without a thing with "stack red on green" as "stack the red block on the green block"."""
    words = [token.text for token in tokens]
    hues = [at for at in range(1, len(words) - 1) if is_colour_word(words[at]) and not nouns.match([words[at]]) and (
        tokens[at + 1].mark or link_at(tokens, at + 1) or words[at + 1] in ("and", "then"))]  # fmt: skip
    others = [word for at, word in enumerate(words) if at not in hues and nouns.match([word])]
    on = any(link_at(tokens, at + 1) for at in hues)
    if words[0] not in _STACKING or len(hues) < 2 or others or not on:
        return list(tokens)
    made: list[Token] = []
    for at, token in enumerate(tokens):
        bare = at in hues and words[at - 1] not in lexicon.DETERMINERS
        made += [replace(token, text="the")] * bare + [token] + [replace(token, text="block")] * (at in hues)
    return made
