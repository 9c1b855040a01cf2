"""Points of the compass, as on a map that lies before the viewer: "north of the bowl" is behind it. A note says so."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words.left_out import quoted
from pat3d.plan.grammar.words.lexing import Token

_POINTS = {"north": "behind", "south": "in front of", "east": "to the right of", "west": "to the left of"}
_BETWEEN = {f"{one}{joint}{two}": (one, two) for one in ("north", "south") for two in ("east", "west")
            for joint in ("", "-")}  # fmt: skip
_LEADS = (("to", "the"), ("on", "the"), ("directly",), ("just",), ("due",))
"""What may stand before the point."""


def compass(text: str, tokens: Sequence[Token]) -> tuple[list[Token], list[str]]:
    """`tokens` of `text` with "north of the bowl" as "behind the bowl", and notes that say so.

    Of "northwest of" the second half is noted alone.
    """
    made: list[Token] = []
    notes: list[str] = []
    at = 0
    while at < len(tokens):
        point = tokens[at].text
        if (point not in _POINTS and point not in _BETWEEN) or at + 1 == len(tokens) or tokens[at + 1].text != "of":
            made.append(tokens[at])
            at += 1
            continue
        words = [token.text for token in made]
        lead = next((len(said) for said in _LEADS if tuple(words[-len(said) :]) == said), 0)
        said = [*made[len(made) - lead :], *tokens[at : at + 2]]
        first, *second = _BETWEEN.get(point, (point,))
        also = f'; "{_POINTS[second[0]]}" it as well is not modelled' if second else ""
        notes.append(f'"{quoted(text, said)}" is read as "{_POINTS[first]}", as on a map{also}.')
        whole = replace(said[0], end=said[-1].end)
        made = [*made[: len(made) - lead], *(replace(whole, text=word) for word in _POINTS[first].split())]
        at += 2
    return made, notes
