"""Which of a row is meant by its place from one end: "the second mug from the right" of five is the fourth.

Those of a stack are counted from below: "the second book from the top" of five is the fourth.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.failures import UnreadError
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.number_words import ORDINALS, counted_before
from pat3d.plan.grammar.words.vocabulary import Nouns

_FIRST = {"left": "right", "front": "back", "bottom": "top"}
"""The sides that places are counted from, and the sides across from these."""
_LAST = frozenset({*_FIRST.values(), "rear"})
_OF_ALL = (("to", "last"), ("last",))
"""Behind an ordinal, "the second to last cup": counted from the last one."""


def from_one_side(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt with "the second mug from the right" as "the fourth mug", where five were counted.

    Raises:
        UnreadError: it is not known how many there are, or the place has no ordinal up to the fifth.
    """
    made = _from_last(tokens, nouns)
    for at in range(len(made) - 3, 0, -1):
        words = [token.text for token in made[at : at + 3]]
        size = 3 if words[1] == "the" else 2
        side = words[size - 1]
        ordinal = next((n for n in (at - 1, at - 2, at - 3) if n >= 0 and made[n].text in ORDINALS), -1)
        between = [token.text for token in made[ordinal + 1 : at]]
        named = not between or between == ["one"] or nouns.match(between) is not None
        if between == ["drawer"]:
            # Rows of a cabinet, of which three are made.
            continue
        if words[0] != "from" or side not in {*_FIRST, *_LAST} or ordinal < 0 or not named:
            continue
        # "the third from the front row"
        if nouns.match([made[at + size].text]) or made[at + size].text in ("row", "end", "side", "of", "shelf"):
            continue
        place = ORDINALS.index(made[ordinal].text)
        if side in _LAST:
            several = f"{between[-1]}s" if between and between != ["one"] else ""
            number = counted_before(made, ordinal, several) or counted_before(made, ordinal)
            place = number - 1 - place
        if not 0 <= place < len(ORDINALS):
            said = " ".join([made[ordinal].text, *between, *words[:size]])
            across = next((first for first, last in _FIRST.items() if last == side), "left")
            raise UnreadError(
                f'"{said}" (word {made[ordinal].number}): of how many is not said, or there are too many. Say which '
                f'it is from the {across}: "the second of four cups".',
                made[ordinal].number,
            )
        told = replace(made[ordinal], text=ORDINALS[place])
        made[ordinal : at + size] = [told, *made[ordinal + 1 : at]]
    return made


def _from_last(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the second to last cup" as "the third cup", where four were counted."""
    made = list(tokens)
    for at in range(len(tokens) - 3, 0, -1):
        size = next(
            (len(end) for end in _OF_ALL if tuple(t.text for t in tokens[at + 1 : at + 1 + len(end)]) == end), 0
        )
        behind = tokens[at + size + 1].text if at + size + 1 < len(tokens) else ""
        if tokens[at].text not in ORDINALS[1:] or not size or not (behind == "one" or nouns.match([behind])):
            continue
        number = counted_before(tokens, at, f"{behind}s") or counted_before(tokens, at)
        place = number - 1 - ORDINALS.index(tokens[at].text)
        if 0 <= place < len(ORDINALS):
            made[at : at + size + 1] = [replace(tokens[at], text=ORDINALS[place])]
    return made
