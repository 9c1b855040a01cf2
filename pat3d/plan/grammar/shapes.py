"""Shapes that several objects form together, and which of them a plan can express.

Every object of a scene is carried by one other, so a plan has stacks, rows, and rings around something; an arch or a
pyramid, where one thing rests on two, it has not.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.errors import PromptError
from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.lexing import Token, singulars

UNPLANNED = frozenset({
    "pyramid", "bridge", "arch", "circle", "ring", "semicircle", "triangle", "square", "rectangle", "grid", "matrix",
    "spiral", "cross", "zigzag", "checkerboard", "diagonal", "staircase", "stairway", "arc", "diamond", "hexagon",
    "pentagon", "fan", "star", "wall", "fort", "castle", "cantilever",
})  # fmt: skip
"""What objects may be said to form and no plan expresses; some are objects themselves ("a star")."""
_CARRIED_BY_TWO = frozenset({
    "pyramid", "bridge", "arch", "wall", "fort", "castle", "staircase", "stairway", "cantilever",
})  # fmt: skip
PLACES = frozenset({"wall", "fan", "star", "fort", "castle", "bridge", "arch", "cross", "diamond"})
"""Shapes that things may also be in or on: "a clock in a wall"."""
RINGS = frozenset({"circle", "ring"})
"""What objects "around" something form anyway."""
_MADE = frozenset({"made", "built", "composed", "formed", "constructed", "assembled", "consisting"})


def shape_said(word: str) -> str | None:
    """The unplanned shape that `word` names, plural or singular, or None."""
    return next((each for each in (word, *singulars(word)) if each in UNPLANNED), None)


def grid_size(words: Sequence[str]) -> tuple[int, int] | None:
    """Rows and columns of words that end in "2x3 grid", or None."""
    found = re.fullmatch(r"(\d{1,2})x(\d{1,2})", words[-2]) if len(words) > 1 and words[-1] == "grid" else None
    return (int(found[1]), int(found[2])) if found else None


def refuse(said: str, number: int) -> PromptError:
    """The error for the shape called `said`, word `number` of the prompt."""
    why = ": every object of a scene is carried by one other" if said in _CARRIED_BY_TWO else ""
    return PromptError(
        f'"{said}" (word {number}) is an arrangement that cannot be planned{why}. Known are stacks ("three plates in a '
        'stack"), rows ("six cups in two rows", "a 2x3 grid of cups") and rings around something ("four cups around a '
        'jug").'
    )


def of_what(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a tower made of blocks" as "a tower of blocks"."""
    kept: list[Token] = []
    at = 0
    while at < len(tokens):
        before = kept[-1].text if kept else ""
        head = shape_said(before) or next(
            (one for one in (before, *singulars(before)) if one in lexicon.STACK_NOUNS), ""
        )
        if head and tokens[at].text in _MADE:
            after = at + 2 if tokens[at + 1].text == "out" else at + 1
            if tokens[min(after, len(tokens) - 1)].text in ("of", "from"):
                joint = tokens[after]
                kept.append(Token(text="of", start=joint.start, end=joint.end, number=joint.number))
                at = after + 1
                continue
        kept.append(tokens[at])
        at += 1
    return kept
