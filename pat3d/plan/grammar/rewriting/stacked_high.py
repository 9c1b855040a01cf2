"""How high things are stacked, and in how many stacks: "boxes are stacked three high, in two stacks" are six boxes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import counted_before, is_number, number_of

_BUILT = frozenset({"tower", "stack", "pile", "column"})
_TWOS = ("stacks", "of", "2")
_STACKS = frozenset({"towers", "stacks", "piles", "columns"})


def stacked_high(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "eight cans are stacked two high" as "eight cans are in four stacks of two"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 1):
        start = at - 1 - bool(singulars(words[at - 1]))
        built = next((n for n in range(start - 1, 0, -1) if words[n] in _BUILT and words[n + 1] == "of"), 0)
        plain = built and not any(is_number(word) or word == "." for word in words[built:start])
        if words[at] == "high" and plain and number_of(words[start]):
            # "A tower of red blocks, six blocks high"
            kept = [*tokens[: built + 2], tokens[start], *tokens[built + 2 : start - (words[start - 1] == ",")]]
            return [*kept, *tokens[at + 1 :]]
    for at in range(3, len(words)):
        if words[at] == "pairs" and words[at - 3 : at - 1] in (["stacked", "in"], ["piled", "in"]):
            # "Eight cans stacked in four pairs"
            return [
                *tokens[: at - 3],
                *tokens[at - 2 : at],
                *(replace(tokens[at], text=word) for word in _TWOS),
                *tokens[at + 1 :],
            ]
    for at in range(1, len(words) - 2):
        number = at + 1 + (words[at + 1] == ",")
        high = number_of(words[number])
        if words[at] not in ("stacked", "piled") or not high or words[number + 1] != "high":
            continue
        stacks, end = _stacks(words, number + 2)
        before = list(tokens[:at])
        head = _counted_head(words, at) if stacks else None
        if head is not None:
            first, said = head
            if said not in (0, high * stacks):
                continue
            amount = replace(tokens[first], text=str(high * stacks), end=tokens[first].start)
            before = [*tokens[:first], *([] if said else [amount]), *tokens[first:at]]
            total = high * stacks
        else:
            total, end = counted_before(tokens, at) or high, number + 2
        if total % high:
            continue
        told = ("in", "a", "stack") if total == high else ("in", str(total // high), "stacks", "of", str(high))
        return [*before, *(replace(tokens[at], text=word) for word in told), *tokens[end:]]
    return list(tokens)


def _stacks(words: Sequence[str], at: int) -> tuple[int, int]:
    """The number of ", in two stacks" at word `at`, and the word behind it; 0 where nothing says how many there are."""
    start = at + (words[at] == ",")
    said = words[start : start + 3]
    if len(said) == 3 and said[0] == "in" and said[2] in _STACKS and (number := number_of(said[1])):
        return number, start + 3 + (start > at and words[start + 3] == ",")
    return 0, at


def _counted_head(words: Sequence[str], at: int) -> tuple[int, int] | None:
    """The first word of what is stacked, named last before word `at`, and its number, 0 without; None where none is."""
    head = next((n for n in range(at - 1, max(at - 4, -1), -1) if singulars(words[n])), None)
    if head is None:
        return None
    first = head
    while first and is_modifier(words[first - 1]) and not is_number(words[first - 1]):
        first -= 1
    return first, number_of(words[first - 1]) if first else 0
