"""Lengths that say how far and not how large: "push the box by 5 cm", "a cup stands 20 cm from the plate"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import Clause
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.left_out import quoted, without
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.measures import is_measure, read_measure

FAR = 0.5
"""From what distance on things are away from each other rather than beside each other [m]."""
_RAISING = frozenset({"lift", "raise", "hoist"})
"""Verbs by which a thing comes to be that far from where it is before."""
_MOVING = frozenset({"lift", "raise", "move", "push", "slide", "shift", "nudge", "shove", "drag", "reposition", "bring",
                     "sweep", "carry"})  # fmt: skip
"""Verbs, besides those of which no task is, that go with how far."""
_WAYS = lexicon.DIRECTIONS | {"up", "down", "upward", "upwards", "downward", "downwards", "left", "right", "out",
                              "away", "and", "then", "apart"}  # fmt: skip
_PARTS = frozenset({"edge", "edges", "side", "sides", "corner", "end", "top", "bottom", "base", "left", "right",
                    "front", "back", "rear", "rim", "middle", "center", "centre", "foot", "tip"})  # fmt: skip


def with_distances(text: str, clause: Clause) -> Clause:
    """`clause` without how far something is moved, and with "20 cm from" as "next to", a metre as "far from"."""
    spans = [span for at in range(1, len(clause.tokens) - 1) if (span := _moved(clause, at)) is not None]
    left_out = tuple(quoted(text, clause.tokens[start:end]) for start, end in spans)
    tokens = tuple(_apart(clause, without(clause.tokens, spans)))
    return replace(clause, tokens=tokens, aside=(*clause.aside, *left_out))


def _moved(clause: Clause, at: int) -> tuple[int, int] | None:
    """Where the length at token `at` says how far something is moved; None where it does not."""
    tokens = clause.tokens
    if not _is_length(tokens[at].text):
        return None
    if tokens[at - 1].text == "by":
        return at - 1, at + 1
    moving = clause.manner == "other" or clause.verb in _MOVING
    ends = tokens[at + 1].mark or tokens[at + 1].text in _WAYS
    if not moving or tokens[at - 1].mark or not ends or link_at(tokens, at + 1):
        return None
    return at, at + 1


def _is_length(word: str) -> bool:
    """Whether `word` is one length of which it is not said what it is the length of."""
    return is_measure(word) and len(read_measure(word).metres) == 1 and read_measure(word).axis is None


def _apart(clause: Clause, tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of `clause` with "20 cm from" as "20 cm next to"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        away = at > 0 and token.text == "from" and is_measure(tokens[at - 1].text)
        if (
            not away
            or clause.verb in _RAISING
            or _from_a_part(tokens, at + 1)
            or lexicon.HANGING & {one.text for one in tokens[:at]}
        ):
            made.append(token)
            continue
        metres = read_measure(tokens[at - 1].text).metres
        far = clause.manner is None and bool(metres) and metres[0] >= FAR
        made += [replace(token, text=word) for word in (("away", "from") if far else ("next", "to"))]
    return made


def _from_a_part(tokens: Sequence[Token], at: int) -> bool:
    """Whether what begins at token `at` is a part of something: "10 cm from the edge of the table"."""
    lead = tokens[at + (tokens[at].text in lexicon.DETERMINERS | lexicon.POSSESSIVES) :]
    return bool(_PARTS & {token.text for token in lead[:2]})
