"""Rows told before what stands in them: "Row 1: a cup, a can", "the front row has two cups, the back row three".

Each becomes "a cup and a can are in a row".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.instructions import known_verb
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.links import FINITE
from pat3d.plan.grammar.modifiers import is_colour_word
from pat3d.plan.grammar.vocabulary import Nouns

_HAVING = (("consists", "of"), ("consisting", "of"), ("made", "up", "of"), ("has",), ("contains",), ("holds",),
           ("containing",), ("is", "made", "of"), ("consist", "of"), ("of",))  # fmt: skip
_SIDES = ("end", "side")
_OPPOSITE = {("front", "back"): "in front of", ("back", "front"): "behind", ("first", "second"): "in front of"}
"""How the first row stands to the second."""

_ONE_EACH = (
    ("one and one", "one of them and one", "one and the other", "the front one and the back one",
     "the front row and the back row", "the first and the second", "the front and the back"),
    ("the back one and the front one", "the back row and the front row", "the second and the first"),
)  # fmt: skip
"""What tells two rows apart around their colours, from the front and from the back."""


def told_rows(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with what stands in a row before the row."""
    tokens = _of_two_colours(_end_to_end(tokens))
    words = [token.text for token in tokens]
    colon = words.index(":") if ":" in words else 0
    if words[0] == "row" and colon and words[1].isdecimal():
        return _stand(tokens, list(tokens[colon + 1 : -1]), nouns)
    if words[:2] == ["a", "row"] and (size := _having(words, 2)) and words[2] != "of":
        return _stand(tokens, list(tokens[2 + size : -1]), nouns)
    if words[0] != "the" or words[2:3] != ["row"] or not (size := _having(words, 3)):
        return list(tokens)
    other = next((n for n in range(4, len(words) - 3) if words[n] == "the" and words[n + 2] == "row"), 0)
    relation = _OPPOSITE.get((words[1], words[other + 1])) if other else None
    if relation is None:
        return list(tokens)
    end = other
    while words[end - 1] in (",", "and", "while"):
        end -= 1
    here = list(tokens[3 + size : end])
    behind = list(tokens[other + 3 + _having(words, other + 3) : -1])
    if len(behind) == 1:
        # "The front row has two cups, the back row three."
        behind += [token for token in here if token.text not in lexicon.NUMBERS and not token.text.isdecimal()]
    made = [replace(here[0], text=word) for word in ("a", "row", "of")]
    row = [replace(behind[0], text=word) for word in ("is", *relation.split(), "a", "row", "of")]
    return [*made, *here, *row, *behind, tokens[-1]]


def _end_to_end(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "from one end to the other" as "from left to right", and "of the bench" in it as "on the bench".

    Where something is to be done the other is that end: "move the cup from one end of the bench to the other".
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 6) if words[n : n + 2] == ["from", "one"] and words[n + 2] in _SIDES), -1)
    to = next((n for n in range(at + 3, min(at + 9, len(words) - 2)) if words[n : n + 3] == ["to", "the", "other"]), 0)
    if at < 0 or not to or any(token.mark for token in tokens[at:to]):
        return tokens
    again = words[to + 3] == words[at + 2]
    if known_verb(words[0]):
        other = [] if again else [replace(tokens[to + 2], text=words[at + 2])]
        return [*tokens[: to + 3], *other, *tokens[to + 3 :]]
    place = list(tokens[at + 3 : to])
    if not place or place[-1].text in words[:at] or place[-1].text in lexicon.PRONOUNS:
        place = []
    else:
        place[0] = replace(place[0], text="on")
    row = [replace(tokens[at], text=word) for word in ("from", "left", "to", "right")]
    return [*tokens[:at], *place, *row, *tokens[to + 3 + again :]]


def _of_two_colours(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "two rows of cans, one red and one blue" as "a row of red cans is in front of a row of blue cans".

    "The front one red and the back one blue" says which; where nothing does, the first is in front.
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 9) if words[n : n + 3] == ["two", "rows", "of"]), -1)
    comma = next((n for n in range(len(words) - 6, 2, -1) if words[n] == "," and at >= 0), 0)
    said = words[comma + 1 : -1]
    pair = [word for word in said if is_colour_word(word)]
    rest = " ".join(word for word in said if word not in pair)
    order = next((turn for turn, told in enumerate(_ONE_EACH) if rest in told), -1)
    opens = not at or (words[at - 1] in FINITE and (at == 2 or link_at(tokens, 0) > 0))
    if order < 0 or len(pair) != 2 or pair[0] == pair[1] or not opens:
        return list(tokens)
    end = next(n for n in range(at + 3, comma + 1) if n == comma or words[n] in FINITE or link_at(tokens, n))
    number = at + 3 + (words[at + 3] in lexicon.NUMBERS or words[at + 3].isdecimal())
    front, back = (
        next(token for token in tokens[comma:] if token.text == word) for word in pair[:: -1 if order else 1]
    )
    row = [replace(tokens[at], text=word) for word in ("a", "row", "of")]
    stands = [replace(tokens[at + 1], text=word) for word in ("is", "in", "front", "of")]
    first, second = ([*row, *tokens[at + 3 : number], colour, *tokens[number:end]] for colour in (front, back))
    there = [token for token in tokens[: max(0, at - 1)] if token.text not in ("there", *FINITE)]
    place = [*tokens[end + (words[end] in FINITE) : comma], *there]
    return [*first, *stands, *second, *place, tokens[-1]]


def _having(words: Sequence[str], at: int) -> int:
    return next((len(said) for said in _HAVING if tuple(words[at : at + len(said)]) == said), 0)


def _stand(tokens: Sequence[Token], named: list[Token], nouns: Nouns) -> list[Token]:
    """`named` with an article before each thing that has none, "in a row"."""
    if not named:
        return list(tokens)
    made: list[Token] = []
    for at, token in enumerate(named):
        opens = not at or named[at - 1].mark or named[at - 1].text == "and"
        bare = token.text not in lexicon.DETERMINERS | lexicon.NUMBERS.keys() and not token.text.isdecimal()
        last = next((n for n in range(at, len(named)) if named[n].mark or named[n].text == "and"), len(named)) - 1
        match = nouns.match([named[last].text]) if last >= at else None
        if opens and bare and match is not None and not match.plural:
            made.append(replace(token, text="a"))
        made.append(token)
    row = [replace(named[-1], text=word) for word in ("are", "in", "a", "row")]
    return [*made, *row, tokens[-1]]
