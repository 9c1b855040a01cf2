"""What happened, and what there is only: as where things are now.

"Has fallen over" becomes "is lying on its side", "peeks out of" "is in", "the only thing on the bench is a cap" "a cap
is on the bench".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon, postures
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.number_words import ORDINALS
from pat3d.plan.grammar.words.unmade import base_verb

_OVER = frozenset({"fall", "tip", "topple", "keel"})
_OUT = frozenset(
    {"come", "peek", "peep", "poke", "stick", "emerge", "protrude", "jut", "spill", "grow", "hang", "peer"}
)
_HELD = {"carried": "carries", "supported": "carries", "contained": "contains", "housed": "contains"}
"""What had something has it."""
_DOWN = frozenset({"fall", "drop", "tumble"})
_THINGS = frozenset({"thing", "things", "object", "objects", "item", "items"})
_RANKS = frozenset({*ORDINALS, "last"})
_LINES = frozenset({"line", "row", "stack", "pile", "series"})


def stated(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` of one sentence with what happened as what is there."""
    return _happened(_only(_member(tokens)))


def _happened(tokens: Sequence[Token]) -> list[Token]:
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 4]]
        perfect = words[0] in ("has", "have", "had")
        verb = base_verb(words[perfect]) if len(words) > 1 + perfect else None
        after = words[1 + perfect :]
        finite = perfect or not words[0].endswith("ing")
        is_ = replace(tokens[at], text="are" if words[0] == "have" or words[0] == verb else "is")
        counted = words[1:2] and (words[1] in lexicon.DETERMINERS or words[1] in lexicon.NUMBERS)
        if words[0] in _HELD and counted and at and made[-1].text not in lexicon.COPULAS and not made[-1].mark:
            made.append(replace(tokens[at], text=_HELD[words[0]]))
            at += 1
            continue
        if verb in _OVER and after[:1] == ["over"] and finite and not postures.is_posture(words[0]):
            lying = replace(tokens[at + perfect], text=postures.token_text("toppled over"))
            made += [is_, lying]
            at += 2 + perfect
        elif verb in _OUT and after[:2] == ["out", "of"] and not perfect and at and finite:
            made += [is_, replace(tokens[at + 1], text="in", end=tokens[at + 2].end)]
            at += 3
        elif verb in _DOWN and after[:1] in (["to"], ["onto"]) and finite and at:
            made += [is_, replace(tokens[at + 1 + perfect], text="on")]
            at += 2 + perfect
        else:
            made.append(tokens[at])
            at += 1
    return made


def _only(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "the only thing on the bench is a cap" as "a cap is on the bench"."""
    words = [token.text for token in tokens]
    if words[:2] != ["the", "only"] or words[2] not in _THINGS or not link_at(tokens, 3):
        return tokens
    verb = next((n for n in range(4, len(words) - 2) if words[n] in lexicon.COPULAS), 0)
    end = next(n for n in range(3, len(words)) if tokens[n].mark)
    if not verb or end < verb or any(token.text in lexicon.COPULAS | {"and"} for token in tokens[verb + 1 : end]):
        return tokens
    return [*tokens[verb + 1 : end], tokens[verb], *tokens[3:verb], *tokens[end:]]


def _member(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "the last in a line of five bottles" as "the last of five bottles"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 5):
        told = words[at - 1] in _RANKS or words[at - 1] in lexicon.SUPERLATIVES
        line = words[at] == "in" and words[at + 1] == "a" and words[at + 2] in _LINES
        if told and line and words[at + 3] == "of" and words[at + 4] in lexicon.NUMBERS:
            return [*tokens[:at], *tokens[at + 3 :]]
    return tokens
