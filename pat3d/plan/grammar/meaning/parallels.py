"""Nouns left out in a clause that is built like one before: "the red box holds a ball, and the blue one a book".

What one clause is about is told by its colour, its place or as one of two, and the other clause's subject in the
same way and otherwise: "the second", "the bottom one", "the other". So it is another thing of that kind.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.meaning.likes import with_noun
from pat3d.plan.grammar.words.lexicon import TELLING
from pat3d.plan.grammar.words.vocabulary import Nouns


def told_alike(chunks: Sequence[Chunk], nouns: Nouns, known: Collection[Phrase] = ()) -> list[Chunk]:
    """`chunks` with "the blue box" for "the blue one" where "the red box" stands as it does.

    What a clause begins with may be told as one of the `known` was before.
    """
    made = list(chunks)
    for at, piece in enumerate(chunks):
        if piece.phrase is not None and (like := _like(made, at, known)) is not None:
            told = replace(piece.phrase, definite=piece.phrase.definite and _told_by(piece.phrase)[0] != "other")
            made[at] = replace(piece, phrase=with_noun(told, like, nouns))
    return made


def _told_by(phrase: Phrase) -> tuple[str, object]:
    """By what `phrase` tells its object from its like, and how: by colour, by its place among them, as the other."""
    words = phrase.modifiers
    if words.colours:
        return "colour", words.colours
    places = set(words.adjectives) & TELLING
    return ("place", min(places)) if places and phrase.definite else ("other" if phrase.other else "", "")


def _like(chunks: Sequence[Chunk], at: int, known: Collection[Phrase]) -> Phrase | None:
    """The phrase of which "the second", "a blue one" at chunk `at` names another; None where there is none.

    Of two that may be it is the one of which as much is said: "the red box holds two cups, the blue one ...". What is
    several and told in no way may have it as a member: "a red box with two cups, a blue one and a white one".
    """
    phrase = chunks[at].named
    (by, how), ends = _told_by(phrase), phrase.words.lower().split()[-1:]
    headless = phrase.kind == "pieces" and not phrase.said and (ends in (["one"], ["ones"]) or by in ("place", "other"))
    if headless and by == "place" and at == 0 and not any(one.plural for one in known):
        return next((one for one in reversed([*known]) if one.kind == "object" and _otherwise(one, by, how)), None)
    if not (headless and by and at and chunks[at - 1 - _led(chunks, at)].kind in ("joint", "clause")):
        return None
    named = {piece.named.said for piece in chunks[:at] if piece.phrase is not None and piece.phrase.kind == "object"}
    if by == "other" and any(sum(1 + one.several for one in known if one.said.endswith(name)) > 1 for name in named):
        # "Two pens are on the desk. One pen is in the mug, the other next to it.": of the two.
        return None
    before = [(n, one.phrase) for n, one in enumerate(chunks[:at]) if one.phrase and one.phrase.kind == "object"]
    for n, one in reversed(before):
        if not _otherwise(one, by, how):
            continue
        several = any(other.plural and not _told_by(other)[0] for m, other in before if m > n)
        if _as_much(chunks, n, at) or not several:
            return one
    if by == "colour" and not phrase.definite:
        # "one mug on the desk and a blue one on the shelf"
        placed = (
            one for n, one in before if not one.plural and chunks[n + 1].kind == "rel" and _as_much(chunks, n, at)
        )
        return next(placed, None)
    return None


def _otherwise(one: Phrase, by: str, how: object) -> bool:
    """Whether `one` is told in the manner of `by`, and otherwise than `how`."""
    if by == "other":
        return one.count == 1 and one.opening == "one"
    return not one.possessive and _told_by(one)[0] == by and _told_by(one)[1] != how


def _as_much(chunks: Sequence[Chunk], one: int, other: int) -> bool:
    """Whether the same kind of words stands by chunks `one` and `other`: "in" before both, a verb or "with" behind."""
    if _led(chunks, other):
        return _led(chunks, one) and chunks[one - 1].link == chunks[other - 1].link
    if max(one, other) + 1 >= len(chunks):
        return False
    ours, theirs = chunks[one + 1], chunks[other + 1]
    if ours.link is not None and theirs.link is not None and ours.link == theirs.link:
        return True
    return all(piece.kind == "verb" or (piece.link is not None and piece.link.finite) for piece in (ours, theirs))


def _led(chunks: Sequence[Chunk], at: int) -> bool:
    """Whether a clause, or the sentence, begins with chunk `at` as a place: "in the second"."""
    return at > 0 and chunks[at - 1].kind == "rel" and (at == 1 or chunks[at - 2].kind in ("joint", "clause"))
