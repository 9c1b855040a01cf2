"""Where something is to be in the end, as what is to be done: "the mug should end up on the tray" is "put it there".

Without a word of the end ("the mug should be on the tray") it is a deed only where the mug was told of before, at
another place: a prompt that begins so describes its scene.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token, singulars

_LEADS = lexicon.DEFINITE | lexicon.POSSESSIVES
_LONGEST = 6
"""Words of what is to be somewhere."""


def _phrases(*said: str) -> tuple[tuple[str, ...], ...]:
    return tuple(sorted((tuple(each.split()) for each in said), key=len, reverse=True))


_AT_LAST = _phrases("in the end", "at the end", "by the end", "when you are done", "afterwards", "finally")
_WISHES = _phrases("i want", "i'd like", "i would like", "i need", "we want", "we need")
_AIMS = _phrases(
    "make sure", "make sure that", "ensure", "ensure that", "see to it", "see to it that", "the goal is that",
    "your goal is that", "the goal is to have", "the goal is to get", "your goal is to have", "your goal is to get",
    "the aim is to have", "the aim is to get", "the aim is that", "the task is to get", "your task is to get", "have",
)  # fmt: skip
_OUGHT = _phrases("should", "must", "has to", "have to", "needs to", "need to", "ought to", "shall", "is to", "are to")
_ENDING = _phrases("end up", "ends up", "wind up", "winds up", "finish up")
_TO_BE = _phrases("to be", "to end up", "to go", "to be put", "to be placed")
_IS = _phrases("is", "are", "to be", "to end up")
_ON_OR_IN = frozenset({"on", "in", "inside", "into", "onto", "atop"})


def done_at_last(sentence: list[Token], before: Sequence[str]) -> list[Token]:
    """`sentence` as an instruction where it tells how something is to be in the end; `before` are the words told."""
    words = [token.text for token in sentence]
    at = _size(words, 0, _AT_LAST)
    last = bool(at)
    at += bool(at) and words[at] == ","
    wish, aim = _size(words, at, _WISHES), _size(words, at, _AIMS)
    first = at + (wish or aim)
    if first >= len(words) - 4 or words[first] not in _LEADS:
        return sentence
    for verb in range(first + 2, min(first + _LONGEST, len(words) - 3)):
        if sentence[verb].mark or words[verb] in ("and", "of", *lexicon.RELATIVES):
            return sentence
        ends, rel = _told(words, verb, wish=bool(wish), aim=bool(aim))
        if not rel:
            if link_at(sentence, verb):
                return sentence
            continue
        closed = _closing(words)
        moved = words[rel] in _ON_OR_IN and _known(words[verb - 1], before)
        # "Make sure that the cup is on the tray" may say what there is.
        told = ends or ((last or closed < len(words) - 1) and words[rel] in _ON_OR_IN) or (moved and not aim)
        if not told or not link_at(sentence, rel):
            return sentence
        put = replace(sentence[first], text="put", start=sentence[0].start)
        return [put, *sentence[first:verb], *sentence[rel:closed], sentence[-1]]
    return sentence


def _told(words: Sequence[str], verb: int, *, wish: bool, aim: bool) -> tuple[bool, int]:
    """Whether "ends up" stands at `verb`, and where the place begins that follows; 0 where no verb stands there."""
    ends = _size(words, verb, _ENDING)
    if wish or aim:
        size = ends or _size(words, verb, _TO_BE if wish else _IS)
        place = words[verb] in _ON_OR_IN
        return bool(ends) or "end" in words[verb : verb + size], verb + size if size or place else 0
    ought = _size(words, verb, _OUGHT)
    ends = _size(words, verb + ought, _ENDING) if ought else ends
    if ends:
        return True, verb + ought + ends
    if ought and words[verb + ought] == "be":
        return False, verb + ought + 1
    return False, verb + 1 if words[verb] in ("goes", "go") else 0


def _closing(words: Sequence[str]) -> int:
    """Where the sentence ends without "in the end"."""
    end = len(words) - 1
    for said in _AT_LAST:
        if tuple(words[end - len(said) : end]) == said:
            end -= len(said)
            return end - (words[end - 1] == ",")
    return end


def _known(word: str, before: Sequence[str]) -> bool:
    """Whether what `word` names was told of among the words `before`, with a place of its own."""
    placed = {*before} & {*_ON_OR_IN, "holds", "hold", "contains", "has"}
    return bool({word, *singulars(word)} & {*before}) and bool(placed)


def _size(words: Sequence[str], at: int, phrases: Sequence[tuple[str, ...]]) -> int:
    """How many words one of `phrases` has that stands at `at`; 0 where none does."""
    return next((len(said) for said in phrases if tuple(words[at : at + len(said)]) == said), 0)
