"""Ranks that share their noun: "the first and third cups are red" tells of the first cup and of the third cup."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import TOLD_BY_PLACE, is_colour_word
from pat3d.plan.grammar.words.vocabulary import Nouns

_RANKS = lexicon.POSITIONS.keys() | lexicon.LEVELS.keys() | TOLD_BY_PLACE
_JOINTS = frozenset({",", "and"})
_PLACING = frozenset({"on", "to", "at", "from", "towards", "toward"})


def with_own_nouns(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the first and third cups" as "the first cup and the third cup"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        ranks = _ranks(tokens, at)
        end = ranks[-1] + 1 if ranks else at
        size, name = _head(tokens, end, nouns, single=len(ranks) == 2) if ranks else (0, [])
        headless = ranks and not size and tokens[end].text in FINITE and tokens[max(at - 1, 0)].text not in _PLACING
        if not size and not headless:
            made.append(tokens[at])
            at += 1
            continue
        after = tokens[end + size]
        # "the first and last ones red"
        own = [after] if is_colour_word(after.text) and tokens[end + size + 1].mark else []
        for rank in ranks:
            joint = [replace(tokens[at], text="and")] if rank != ranks[0] else []
            the = replace(tokens[at], text="the")
            noun = [replace(tokens[rank], text=word) for word in name]
            made += [*joint, the, tokens[rank], *noun, *(own if rank != ranks[-1] else ())]
        at = end + size
    return made


def _ranks(tokens: Sequence[Token], at: int) -> list[int]:
    """Where the ranks of "the first, second and last" stand, which begins at token `at`; none where it is one."""
    found: list[int] = []
    joined = False
    at += 1 if tokens[at].text == "the" else len(tokens)
    while at < len(tokens) - 1 and tokens[at].text in _RANKS:
        found.append(at)
        at += 1
        while tokens[at].text in _JOINTS and at < len(tokens) - 2:
            joined = joined or tokens[at].text == "and"
            at += 1
        if joined and tokens[at].text == "the" and tokens[at + 1].text in _RANKS:
            # "the first and the third cups"
            at += 1
    return found if joined and len(found) > 1 and found[-1] == at - 1 else []


def _head(tokens: Sequence[Token], at: int, nouns: Nouns, *, single: bool) -> tuple[int, list[str]]:
    """How many words the name at token `at` has, and its words in the singular: "the left and the right cup" too."""
    words = [token.text for token in tokens[at : at + 3]]
    if words[:1] == ["ones"]:
        return 1, ["one"]
    for size in (3, 2, 1):
        found = nouns.match(words[:size])
        one = singulars(words[size - 1]) if len(words) >= size else ()
        if found is not None and (one if found.plural else single):
            return size, [*words[: size - 1], next(iter(one if found.plural else ()), words[size - 1])]
    return 0, []
