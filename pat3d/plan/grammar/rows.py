"""Rows told before what stands in them: "Row 1: a cup, a can", "the front row has two cups, the back row three".

Each becomes "a cup and a can are in a row".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.lexing import Token
from pat3d.plan.grammar.vocabulary import Nouns

_HAVING = (("consists", "of"), ("consisting", "of"), ("made", "up", "of"), ("has",), ("contains",), ("holds",),
           ("containing",), ("is", "made", "of"), ("consist", "of"), ("of",))  # fmt: skip
_OPPOSITE = {("front", "back"): "in front of", ("back", "front"): "behind", ("first", "second"): "in front of"}
"""How the first row stands to the second."""


def told_rows(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with what stands in a row before the row."""
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
