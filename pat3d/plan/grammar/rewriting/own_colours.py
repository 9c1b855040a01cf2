"""Which one has the colour of what goes there, in one wording: "of the same colour" for "of its own colour"."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.words.lexing import Token

_COLOURS = frozenset({"colour", "color", "colours", "colors"})
_SAME = frozenset({"own", "its", "their", "same", "matching", "corresponding"})


def in_one_way(sentence: list[Token]) -> list[Token]:
    """`sentence` with "the bowl of its own colour", "that matches its colour", as "the bowl of the same colour"."""
    words = [token.text for token in sentence]
    end = next((n for n in range(4, len(words)) if words[n] in _COLOURS), 0)
    start = end
    while start and words[start - 1] in _SAME | {"the", "a"}:
        start -= 1
    if start == end or not {*words[start:end]} & _SAME:
        return sentence
    led = words[start - 2] in ("that", "which") and words[start - 1] in ("matches", "match", "has", "have")
    size = 2 if led else 1 if words[start - 1] in ("of", "with", "in", "matching") else 0
    if not size or start - size < 3:
        return sentence
    said = [replace(sentence[start - size], text=word) for word in ("of", "the", "same")]
    return [*sentence[: start - size], *said, *sentence[end:]]
