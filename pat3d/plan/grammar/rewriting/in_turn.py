"""In which order something is done: "in a specific sequence: red first, then blue". A scene has no order in time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.denials import Told
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.vocabulary import Nouns

_ORDERS = frozenset({"sequence", "order"})
_IN_TIME = frozenset({"starting", "beginning", "first", "then", "next", "finally", "lastly", "last", "followed"})
_OPENING = frozenset({"first", "starting", "beginning"})
_BETWEEN = _IN_TIME | frozenset({"second", "third", "by", "and", ",", ":", "-", "the", "one", "ones", "with"})
"""What stands between the colours of such a list."""
_LONGEST = 6
"""Words from "in" to "sequence"."""


def in_turn(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "stack the blocks in a certain order: red first, then blue" as "stack the blocks"."""
    for at in range(2, len(words) - 2):
        led = _led(tokens, at) if words[at] == "in" else 0
        listed = led or (at + 1 if words[at] in (",", ":", "-") else 0)
        end = _listed(tokens, listed) if listed else 0
        timed = bool(end) and bool(_IN_TIME & set(words[listed:end]))
        hues = [word for word in words[listed:end] if is_colour_word(word)]
        if led and end and not timed and len(hues) in {lexicon.NUMBERS.get(word) for word in words[:at]}:
            # "Three mugs in the order blue, yellow, red"
            row = [] if {"row", "line", "stack", "stacked", "tower"} & {*words[:at]} else ["in", "a", "row"]
            form = [replace(tokens[at], text=word, mark=word == ":") for word in (*row, ":")]
            return [*tokens[:at], *form, *tokens[listed:]], []
        if not end or not (timed or led) or (not led and not _OPENING & set(words[listed:end])):
            continue
        if not led and any(words[n : n + 2] == ["the", "first"] for n in range(listed, end)):
            # "Three jars in a row, the first one red and the last one blue": which is red.
            continue
        start = at - (words[at - 1] == ",")
        return [*tokens[:start], *tokens[end:]], [(tokens[at if led else at + 1], tokens[end - 1])]
    return None


def _led(tokens: Sequence[Token], at: int) -> int:
    """The token behind "in a specific color sequence:" at `at`; 0 where nothing like it stands there."""
    words = [token.text for token in tokens]
    end = next((n for n in range(at + 1, min(at + _LONGEST, len(words))) if words[n] in _ORDERS), 0)
    if not end or any(tokens[n].mark or link_at(tokens, n) for n in range(at + 1, end)):
        return 0
    return end + 1 + (words[end + 1] in (":", ",", "-", "of"))


def _listed(tokens: Sequence[Token], at: int) -> int:
    """The end of "red first, then blue, and finally green" at `at`, which ends the sentence; 0 where there is none."""
    end = at
    while is_colour_word(tokens[end].text) or (tokens[end].text in _BETWEEN and tokens[end].text != "."):
        end += 1
    colours = sum(is_colour_word(token.text) for token in tokens[at:end])
    opens = is_colour_word(tokens[at].text) or tokens[at].text in lexicon.DETERMINERS | _IN_TIME
    return end if colours > 1 and opens and tokens[end].text == "." else 0
