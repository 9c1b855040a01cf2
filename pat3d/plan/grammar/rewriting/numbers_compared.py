"""Numbers by their bounds, and kinds of one number: "more than three cups", "an equal number of cups and plates"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.number_words import numeral

_SAME = frozenset({"same", "equal"})
_COUNTED = frozenset({"number", "amount", "quantity", "count"})


def plainly_compared(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "more than three cups" as "at least four cups", "an equal number of cups" as "as many cups"."""
    made = list(tokens)
    for at in range(len(made) - 1, -1, -1):
        for told in (_same_number, _bounds):
            if (found := told(made, [token.text for token in made], at)) is not None:
                made = found
    return made


def _put(token: Token, *words: str, end: Token | None = None) -> list[Token]:
    """`words` in the place of `token`, or of the tokens from there to `end`."""
    return [replace(token, text=word, end=(end or token).end) for word in words]


def _same_number(tokens: list[Token], words: list[str], at: int) -> list[Token] | None:
    """Read "an equal number of cups" as "as many cups", and "an equal number of cups and plates" as these."""
    article = words[at] in ("an", "the")
    word = at + article
    if words[word : word + 1] == [] or words[word] not in _SAME or words[word + 1 : word + 2] == []:
        return None
    several = words[word + 1] in ("numbers", "amounts", "quantities")
    if words[word + 2 : word + 3] != ["of"] or not (several or (article and words[word + 1] in _COUNTED)):
        return None
    behind = word + 3
    stop = next((n for n in range(behind, len(words)) if tokens[n].mark), behind)
    told = at and words[at - 1] in ("and", "plus")
    joint = next((n for n in range(behind + 1, min(behind + 4, stop)) if words[n] == "and"), 0)
    if several or (not told and joint and "as" not in words[behind:stop]):
        if not joint:
            return None
        as_many = _put(tokens[at], "as", "many", end=tokens[behind - 1])
        return [*tokens[:at], *as_many, *tokens[behind:joint], *_put(tokens[joint], "as"), *tokens[joint + 1 :]]
    if at and words[at - 1] in lexicon.HAVING and words[word] == "equal":
        # "Two bowls with an equal number of figs": of figs in either.
        return None
    return [*tokens[:at], *_put(tokens[at], "as", "many", end=tokens[behind - 1]), *tokens[behind:]]


def _bounds(tokens: list[Token], words: list[str], at: int) -> list[Token] | None:
    """Read "more than three cups" as "at least four cups", and "no more than three" as "at most three"."""
    than = words[at : at + 2] in (["more", "than"], ["fewer", "than"], ["less", "than"])
    more = words[at] == "more"
    number = numeral(words[at + 2]) if than and at + 3 < len(words) else 0
    if number < 2 - more or words[at + 2] in ("both", "couple", "single"):
        return None
    if tokens[at + 3].mark or words[at + 3] == "of":
        return None
    no = at > 0 and words[at - 1] in ("no", "not")
    start = at - no
    told = number if no else number + 1 if more else number - 1
    bound = _put(tokens[start], "at", "most" if more == no else "least", end=tokens[at + 1])
    return [*tokens[:start], *bound, replace(tokens[at + 2], text=str(told)), *tokens[at + 3 :]]
