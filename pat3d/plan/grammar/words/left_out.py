"""A sentence without spans of it that are not read, and those spans as they are written."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Span, Token


def without(tokens: Sequence[Token], spans: Sequence[Span]) -> tuple[Token, ...]:
    """`tokens` without `spans`."""
    return tuple(token for at, token in enumerate(tokens) if not any(start <= at < end for start, end in spans))


def without_phrases(tokens: Sequence[Token], phrases: Sequence[tuple[str, ...]]) -> list[Token]:
    """`tokens` without `phrases`, each of four words at most."""
    kept, at = list[Token](), 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 4]]
        size = next((len(each) for each in phrases if tuple(words[: len(each)]) == each), 0)
        if not size:
            kept.append(tokens[at])
        at += size or 1
    return kept


def doing_nothing(tokens: Sequence[Token], spans: Sequence[Span]) -> tuple[Token, ...]:
    """`tokens` without `spans`; of "is playing with a cat" what is left is "and there is a cat": nothing has it."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        ends = next((start for start, end in spans if end == at and token.text == "with"), 0)
        if ends and tokens[ends - 1].text in lexicon.COPULAS:
            made[-1:] = [replace(token, text=word) for word in ("and", "there", "is")]
        elif not any(start <= at < end for start, end in spans):
            made.append(token)
    return tuple(made)


def quoted(text: str, tokens: Sequence[Token]) -> str:
    """`tokens` as they stand in `text`, without quotation marks and marks around them."""
    return text[tokens[0].start : tokens[-1].end].replace('"', "").strip(" ,")
