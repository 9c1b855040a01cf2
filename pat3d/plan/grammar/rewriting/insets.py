"""What is set into a sentence and moves nothing: coordinates, and in brackets how a deed is done. Each has its note."""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.plan.grammar.words.lexing import Token

_N = r"[+-]?\d+(?:\.\d+)?(?: ?(?:mm|cm|m)\b)?"
_AXIS = r"[xyz] ?[=:] ?" + _N
_NAMED = r"(?:the )?(?:(?:position|coordinates?|location|point|pose|xyz?)s? ?[:=]? ?)"
_COORDINATES = re.compile(
    r"(?:,? ?\b(?:located |positioned |placed )?(?:at|to|near|around|towards?) )?(?:"
    rf"{_NAMED}?[(\[] ?(?:{_N}(?:,? {_N}|, ?{_N}){{1,2}}|{_AXIS}(?:,? (?:and )?{_AXIS}){{0,2}}) ?[)\]]"
    rf"|{_NAMED}?{_AXIS}(?:,? (?:and )?{_AXIS}){{0,2}}|{_NAMED}{_N}(?:,? (?:and )?{_N}){{1,2}})",
    re.IGNORECASE,
)
_MANNER = re.compile(
    r"\((?:(?:with|using|use|by|in) (?:[a-z'-]+ ){0,3}(?:hands?|arms?|finger(?:tip)?s?|grippers?|care|caution)"
    r"|by (?:its|the|their) [a-z]+|(?:very |quite )?[a-z]+ly|(?:(?:be )?careful|mind|do not|don't)[^()]*)[.!]*\)",
    re.IGNORECASE,
)


def without_insets(text: str, tokens: Sequence[Token]) -> tuple[list[Token], list[str]]:
    """`tokens` of `text` without coordinates and without how a deed is done in brackets, and notes of those."""
    notes = list[str]()
    spans = list[tuple[int, int]]()
    for pattern, why in ((_COORDINATES, ": nothing is placed by coordinates."), (_MANNER, "")):
        for found in pattern.finditer(text):
            said = found.group().strip(" ," if why else " ,()!.")
            if why and said[0] in "([" and "m" in said:
                # "Two cups (3 cm, 5 cm)" are as large.
                continue
            spans.append(found.span())
            notes.append(f'not modelled: "{said}"{why}')
    kept = [token for token in tokens if not any(start <= token.start < end for start, end in spans)]
    return kept, notes if any(not token.mark for token in kept) else []
