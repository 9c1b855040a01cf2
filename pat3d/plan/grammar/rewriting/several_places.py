"""Several places of one thing, each in a clause of its own: "behind the plate, left of the bowl, and near the can"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE, LINKS


def in_several_places(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of one sentence with every place of its subject said of it, behind it."""
    return _each_place(list(tokens))


def _known(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of a phrase, spoken of as known: "the fork and the knife" for "a fork and a knife"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        counted = token.text in lexicon.NUMBERS and token.text not in ("a", "an")
        if token.text in ("a", "an") or (counted and (not at or tokens[at - 1].text != "the")):
            made.append(replace(token, text="the"))
        if token.text not in ("a", "an"):
            made.append(token)
    return made


def _each_place(tokens: list[Token]) -> list[Token]:
    """`tokens` with "the mug is behind the plate, left of the bowl, and near the can" as three clauses.

    "It is" behind a comma is said of the same.
    """
    words = [token.text for token in tokens]
    verb = next((n for n in range(1, len(words)) if tokens[n].mark or words[n] in FINITE or link_at(tokens, n)), 0)
    if words[verb] not in FINITE or words[0] not in lexicon.DETERMINERS | lexicon.NUMBERS.keys():
        return tokens
    after = verb + 1 + (words[verb + 1] in lexicon.PARTICIPLES and not link_at(tokens, verb + 1))
    if not _says_where(tokens, after):
        return tokens
    parts: list[tuple[int, int]] = []
    starts = [after, *(n + 1 + (words[n + 1] == "and") for n in range(after, len(words) - 1) if words[n] == ",")]
    for start, stop in zip(starts, [*starts[1:], len(words) - 1], strict=True):
        end = stop - (start != starts[-1]) * (1 + (words[stop - 1] == "and"))
        begin = start + 2 * (words[start : start + 2] in (["it", "is"], ["they", "are"]))
        if not _says_where(tokens, begin) or any(word in FINITE for word in words[begin:end]):
            return tokens
        parts.append((begin, end))
    if len(parts) < 3:
        return tokens
    made = list(tokens[: parts[0][1]])
    for start, end in parts[1:]:
        made += [replace(tokens[start], text=",", mark=True), replace(tokens[start], text="and", mark=False)]
        made += [*_known(tokens[:verb]), tokens[verb], *tokens[start:end]]
    return [*made, tokens[-1]]


def _says_where(tokens: Sequence[Token], at: int) -> bool:
    size = link_at(tokens, at)
    link = LINKS.get(tuple(token.text for token in tokens[at : at + size]))
    return link is not None and not link.inverse and not link.finite
