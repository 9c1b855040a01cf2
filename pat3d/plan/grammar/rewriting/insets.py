"""What is set into a sentence and moves nothing: coordinates, how large the room is, how a picture is taken.

So is, in brackets, how a deed is done. Each has its note.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from pat3d.plan.grammar.rewriting.rooms import ROOMS
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

_METRES = r"(?<![\d.])(?:[2-9]|\d\d+)(?:\.\d+)?(?: ?-?(?:m|met(?:er|re)s?|ft|feet|foot)\b)?"
_AREA = rf"(?:{_METRES} ?(?:x|\u00d7|by) ?{_METRES}(?<=[a-z])|\d+ ?(?:square (?:met(?:er|re)s?|feet|foot)|sqm))"
_ROOM_SIZE = re.compile(
    rf"^(?:an? |the |my |in )*(?:[a-z'-]+,? ){{0,4}}?(?:{'|'.join(sorted(ROOMS))})\b"
    rf"(?:(?P<own>, ?(?:about |measuring )*{_AREA},|(?:,? (?:of|is|that is|which is|measuring|about))* ?\(?{_AREA}\)?)"
    # At the end, where it is no rug that measures so much.
    rf"|[^.]*[^.,;(](?<!rug)(?<!carpet)(?<!mat)(?<!bed)(?P<end>(?:[,;.] ?| ?\()(?:about )?{_AREA}\)?)\W*$)",
    re.IGNORECASE,
)
_SEEN = r"(?:as )?(?:seen|viewed|photographed|captured|shown|pictured|filmed|camera|view|shot)"
_VIEW = re.compile(
    rf"(?:,? ?\b(?<!\ba ){_SEEN})?(?: from the (?:side|front|top))?,? ?\b(?:at|from) (?:an? |the )?"
    r"(?:eye|table|tabletop|desk|counter|ground|floor|surface|low)[ -]level(?: (?:view|shot|angle))?\b"
    rf"|,? ?\b{_SEEN} from (?:the |an? )?(?:[a-z]+ )?(?:below|underneath|angle|distance|afar|doorway|corner)\b(?! of)"
    r"|(?:,|\bas) ?(?:as )?(?:seen|viewed) in (?:a|the) mirror\b"
    r"|^with (?:an? |the )?(?:(?!(?:of|and|on|in|with) )[\w'-]+ ){1,3}(?:look|style|vibe|feel|mood),",
    re.IGNORECASE,
)
_INSETS = (
    (_COORDINATES, ": nothing is placed by coordinates."),
    (_ROOM_SIZE, ": no room is made."),
    (_MANNER, ""),
    (_VIEW, ""),
)


def without_insets(text: str, tokens: Sequence[Token]) -> tuple[list[Token], list[str]]:
    """`tokens` of `text` without coordinates and without how a deed is done in brackets, and notes of those."""
    notes = list[str]()
    spans = list[tuple[int, int]]()
    for pattern, why in _INSETS:
        for found in pattern.finditer(text):
            which = next((name for name, said in found.groupdict().items() if said), 0)
            said = found[which].strip(" ," if pattern is _COORDINATES else " ,;()!.")
            if pattern is _COORDINATES and said[0] in "([" and "m" in said:
                # "Two cups (3 cm, 5 cm)" are as large.
                continue
            spans.append(found.span(which))
            notes.append(f'not modelled: "{said}"{why}')
    kept = [token for token in tokens if not any(start <= token.start < end for start, end in spans)]
    return kept, notes if any(not token.mark for token in kept) else []
