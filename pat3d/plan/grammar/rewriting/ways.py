"""How often, until when and in which way something is done or stands: "twice", "until it clicks", "parallel to"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.denials import Told
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import JOINERS
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.unmade import base_verb
from pat3d.plan.grammar.words.vocabulary import Nouns

_STARTING = frozenset({"start", "begin", "finish", "end", "proceed", "continue"})
_OPENING = frozenset({"let's", "let", "'s", "us", "first", "then", "now", "please", ",", "and", "next", "finally",
                      "you", "should", "can", "could", "will", "must", "to"})  # fmt: skip
_EACH_OTHER = (("each", "other"), ("one", "another"), ("eachother",))
_BOUNDS = lexicon.BACKGROUND | frozenset({"wall", "walls", "window", "ground", "floor", "edge", "side"})
_ROWS = frozenset({"row", "rows", "line", "lines", "column", "columns", "stacks"})


def begun(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "let's start by moving the mug" as "let's move the mug"."""
    at = next((n for n, word in enumerate(words) if word not in _OPENING), 0)
    by = at + 1 + (words[at + 1 : at + 2] in (["off"], ["out"]))
    if words[at] not in _STARTING or by + 2 >= len(words) or words[by] not in ("by", "with"):
        return None
    verb = base_verb(words[by + 1]) if words[by + 1].endswith("ing") else None
    if verb is None or nouns.match([words[by + 1]]) is not None:
        return None
    doing = replace(tokens[by + 1], text=verb, number=tokens[at].number)
    return [*tokens[:at], doing, *tokens[by + 2 :]], []


def often(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "press the button twice", "flip it two times", without how often."""
    for at in range(2, len(words) - 1):
        times = words[at + 1] == "times" and (numeral(words[at]) > 1 or words[at] in lexicon.VAGUE)
        end = at + 1 + times
        again = times or words[at] in ("twice", "thrice")
        after = tokens[min(end, len(tokens) - 1)]
        if again and (after.mark or after.text in ("and", "then", "in", "with")) and words[at - 1] not in JOINERS:
            return [*tokens[:at], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def until(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "push the box until it reaches the edge" without until when."""
    for at in range(2, len(words) - 2):
        if words[at] in ("until", "till") and words[at + 1] not in ("then", "now"):
            end = next(n for n in range(at, len(words)) if tokens[n].mark)
            start = at - (words[at - 1] == ",")
            return [*tokens[:start], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def parallel(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "two pens parallel to each other" as "two pens side by side", "parallel to a ruler" as "next to" it."""
    for at in range(1, len(words) - 3):
        if words[at] != "parallel" or words[at + 1] not in ("to", "with"):
            continue
        other = next((said for said in _EACH_OTHER if tuple(words[at + 2 : at + 2 + len(said)]) == said), ())
        if other:
            several = any(singulars(word) or numeral(word) > 1 or word in ("and", "them") for word in words[:at])
            beside = [replace(tokens[at], text=word) for word in ("side", "by", "side")]
            end = at + 2 + len(other)
            told = [*tokens[:at], *beside, *tokens[end:]]
            # Two rows that are parallel stand one behind the other.
            return (told, [(tokens[at], tokens[end - 1])]) if several and not _ROWS & {*words[:at]} else None
        stop = next(n for n in range(at, len(words)) if tokens[n].mark)
        if words[at + 2] not in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it"} or _BOUNDS & {*words[at:stop]}:
            return None
        return [*tokens[:at], replace(tokens[at], text="next"), *tokens[at + 1 :]], [(tokens[at], tokens[at + 1])]
    return None
