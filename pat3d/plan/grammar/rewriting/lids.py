"""Lids told by what they close: "a pot with its lid on", "the pot's lid", "the lid of the pot", "on its lid"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.outcomes import TAKING
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.plan.holders import FLAT, holds

_NEAR = 3
"""Words before a lid that is asked for: "take off the lid"."""
_OWNER = 5
"""Words of what a lid is of."""


def on_its_lid(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a box with a doll sitting on its lid" as "a box with a doll sitting on it"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 2):
        owned = words[at] == "on" and words[at + 1] == "its" and words[at + 2] in lexicon.DETACHED
        if owned and "with" in words[:at]:
            return [*tokens[: at + 1], replace(tokens[at + 1], text="it", end=tokens[at + 2].end), *tokens[at + 3 :]]
    return list(tokens)


def lid_on(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a pot with its lid on" as "a pot with its lid on it"."""
    made: list[Token] = []
    for at, token in enumerate(tokens):
        made.append(token)
        closing = token.text == "on" and at > 2 and tokens[at - 1].text in vessels.ON_RIMS
        if (
            closing
            and (tokens[at + 1].mark or tokens[at + 1].text == "and")
            and "with" in (tokens[at - 2].text, tokens[at - 3].text)
        ):
            made.append(replace(token, text="it"))
    return made


def lid_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the pot's lid" and "the lid of the pot" as "the lid", which "take the lid of the pot" is on.

    What is hinged is no thing of its own.
    """
    words = [token.text for token in tokens]
    lids = (at for at in range(1, len(words) - 1) if words[at] in vessels.ON_RIMS and words[at - 1] in ("the", "'s"))
    for lid in lids:
        owned = words[lid - 1] == "'s"
        start = lid + 2
        if owned:
            start = next((at for at in range(lid - 2, max(lid - _OWNER, -1), -1) if words[at] == "the"), lid)
        elif words[lid + 1 : lid + 3] != ["of", "the"]:
            continue
        end = lid - 1 if owned else next((at for at in range(start + 1, len(words)) if nouns.match([words[at]])), 0) + 1
        vessel = nouns.match(words[end - 1 : end]) if start + 1 < end <= start + _OWNER else None
        described = vessel is not None and all(is_modifier(word) for word in words[start + 1 : end - 1])
        if vessel is None or not described or not (holds(vessel.noun) or vessel.noun in FLAT):
            continue
        the = tokens[start if owned else lid - 1]
        before = tokens[: start if owned else lid - 1]
        taken = words[0] in TAKING and len(before) < _NEAR
        owner = [replace(tokens[lid], text="on"), *tokens[start:end]] if taken else []
        after = list(tokens[max(lid + 1, end) :])
        it = next((n for n in range(1, len(after)) if after[n].mark or after[n].text == "it"), 0)
        if it and after[it].text == "it" and link_at(after, it - 1):
            # "The lid of the pot lies beside it"
            after[it : it + 1] = tokens[start:end]
        return lid_of([*before, replace(the, text="the"), tokens[lid], *owner, *after], nouns)
    return list(tokens)
