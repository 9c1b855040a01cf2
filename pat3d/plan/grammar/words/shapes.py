"""Shapes that several objects form together, and which of them a plan can express.

A plan has stacks, rows, rings around something, and flat pyramids, where every thing above the lowest row rests on two;
an arch or a wall it has not.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.errors import PromptError
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.vocabulary import Nouns

UNPLANNED = frozenset({
    "pyramid", "bridge", "arch", "circle", "ring", "semicircle", "triangle", "square", "rectangle", "grid", "matrix",
    "spiral", "cross", "zigzag", "checkerboard", "diagonal", "staircase", "stairway", "arc", "diamond", "hexagon",
    "pentagon", "fan", "star", "wall", "fort", "castle", "cantilever",
})  # fmt: skip
"""What objects may be said to form and no plan expresses; some are objects themselves ("a star")."""
PYRAMID = "pyramid"
GRID = "grid"
COURSES = {3: 2, 6: 3, 10: 4, 15: 5}
"""Objects in a flat pyramid, and how many of them are in its lowest row."""
USUAL_PYRAMID = 6
"""Objects in a pyramid of unstated number."""
_IN_PYRAMIDS = ("can", "soda can", "box", "block", "wooden block", "cube", "brick", "crate", "storage box", "cup",
                "glass")  # fmt: skip
"""What has a level top of its own width, so that one stands on two."""
PLACES = frozenset({"wall", "fan", "star", "fort", "castle", "bridge", "arch", "cross", "diamond"})
"""Shapes that things may also be in or on: "a clock in a wall"."""
RINGS = frozenset({"circle", "ring"})
"""What objects "around" something form anyway."""
_MADE = frozenset({"made", "built", "composed", "formed", "constructed", "assembled", "consisting"})


_BUILDING = frozenset({"make", "build", "form", "create", "construct", "assemble", "arrange", "please"})
_FORMED = frozenset({"pyramid", "tower", "stack", "pile", "row", "line", "column"})
_OPENING = 6
"""Words up to what is built: "please build a tall tower"."""


def shape_said(word: str) -> str | None:
    """The unplanned shape that `word` names, plural or singular, or None."""
    return next((each for each in (word, *singulars(word)) if each in UNPLANNED), None)


def grid_size(words: Sequence[str]) -> tuple[int, int] | None:
    """Rows and columns of words that end in "2x3 grid", or None."""
    found = re.fullmatch(r"(\d{1,2})x(\d{1,2})", words[-2]) if len(words) > 1 and words[-1] == "grid" else None
    return (int(found[1]), int(found[2])) if found else None


def grid_rows(count: int) -> int:
    """Rows of a grid of `count` things of which nobody says how many: as many as columns, or fewer, all full if so."""
    most = math.isqrt(count)
    return next((rows for rows in range(most, 1, -1) if count % rows == 0), most)


def refuse(said: str, number: int) -> PromptError:
    """The error for the shape called `said`, word `number` of the prompt."""
    return PromptError(
        f'"{said}" (word {number}) is an arrangement that cannot be planned. Known are stacks ("three plates in a '
        'stack"), rows ("six cups in two rows", "a 2x3 grid of cups"), rings around something ("four cups around a '
        'jug") and one flat pyramid of cans, boxes or the like, 3, 6, 10 or 15 of them ("a pyramid of six cans").'
    )


def can_be_pyramid(nouns: Nouns, noun: str, count: int) -> bool:
    """Whether so many `noun` can stand in a flat pyramid."""
    return count in COURSES and nouns.of_class(noun, _IN_PYRAMIDS)


def carriers_in_pyramid(at: int, lowest: int) -> tuple[int, ...]:
    """Which two members carry member `at` of a pyramid of `lowest` in its lowest row; none carry the lowest.

    Members are counted from the left of the lowest row on, row by row.
    """
    start, width = 0, lowest
    while at >= start + width:
        start, width = start + width, width - 1
    return (at - width - 1, at - width) if start else ()


def of_what(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a tower made of blocks" as "a tower of blocks"."""
    kept: list[Token] = []
    at = 0
    building = tokens[0].text in _BUILDING
    while at < len(tokens):
        before = kept[-1].text if kept else ""
        formed = building and before in _FORMED and kept[-2].text in ("a", "one") and len(kept) < _OPENING
        if formed and tokens[at].text in ("with", "from", "using") and tokens[at + 1].text not in lexicon.PRONOUNS:
            # "Make a pyramid with six cans"
            kept.append(replace(tokens[at], text="of"))
            at += 1
            continue
        head = shape_said(before) or next(
            (one for one in (before, *singulars(before)) if one in lexicon.STACK_NOUNS), ""
        )
        asked = any(token.text in _BUILDING for token in kept[:3])
        if head and tokens[at].text == "using" and asked:
            kept.append(replace(tokens[at], text="of"))
            at += 1
            continue
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
