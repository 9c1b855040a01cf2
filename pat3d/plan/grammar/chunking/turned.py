"""Of what a posture behind a place is said: "a mug stands on the tray, upside down" is of the mug."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.chunking.chunks import Chunk
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.modifiers import NO_MODIFIERS, Modifiers
from pat3d.plan.grammar.words.vocabulary import Nouns

_PARTICIPLES = ("turned", "tipped", "lying", "laid", "knocked", "toppled", "flipped", "rotated", "spun", "overturned")
"""Postures that follow the noun they are said of: "on a bowl turned upside down"."""


def turned(chunks: Sequence[Chunk], said: Modifiers, nouns: Nouns) -> list[Chunk] | None:
    """`chunks`, which end before the measure or posture `said`, with that told of what it is said of.

    None where nothing before it in its clause is an object.
    """
    if said.postures and (told := _behind_place(chunks, said, nouns)) is not None:
        return told
    last = len(chunks) - 1
    for at in range(last, -1, -1):
        phrase = chunks[at].phrase
        if chunks[at].kind == "clause":
            return None
        member = phrase is not None and at == last and (phrase.kind == "pieces" or phrase.head == "another")
        if phrase is not None and (phrase.kind in ("object", "unknown") or member):
            return _marked(chunks, [*_headless(chunks, at), at], said)
    return None


def _behind_place(chunks: Sequence[Chunk], said: Modifiers, nouns: Nouns) -> list[Chunk] | None:
    """`chunks` with the posture `said` of what the clause is about.

    None where it is said of what was named last: of what nothing stands by, or of the vessel below a ball.
    """
    comma = bool(chunks) and chunks[-1].kind == "joint" and chunks[-1].text == ","
    at = last = len(chunks) - 1 - comma
    while at > 1 and chunks[at].kind == "noun" and chunks[at - 1].kind == "rel":
        at -= 2
    if at == last:
        several = _several(chunks, last) if comma else []
        return _marked(chunks, several, said) if several else None
    place, verb = chunks[at + 1], chunks[at].kind == "verb"
    subject = _subject(chunks, at - 1 if verb else at)
    carried = place.relation.kind in ("on", "in") and place.relation.manner == "place"
    if not subject or not (carried or (comma and verb)):
        # "a mug next to a glass upside down"
        return None
    below, lead = chunks[last].named, chunks[subject[-1]].named
    vessel = nouns.of_class(below.noun, vessels.HOLLOW) and place.relation.kind == "on"
    rolls = lead.kind == "object" and not nouns.of_class(lead.noun, vessels.HOLLOW)
    if vessel and not comma and (rolls or said.postures[0].lower().startswith(_PARTICIPLES)):
        # "A ball lies on a bowl turned upside down", where nothing stands but over its foot.
        return None
    if verb:
        return [*chunks[: at + 1], Chunk(kind="quality", modifiers=said), *chunks[at + 1 :]]
    return _marked(chunks, subject, said)


def _marked(chunks: Sequence[Chunk], heads: Sequence[int], said: Modifiers) -> list[Chunk]:
    made = list(chunks)
    for head in heads:
        named = made[head].named
        made[head] = replace(made[head], phrase=replace(named, modifiers=named.modifiers.marked_as(said)))
    return made


def _several(chunks: Sequence[Chunk], last: int) -> list[int]:
    """The phrases of "there are a mug and a cup", which ends at chunk `last`."""
    at = last
    while at > 1 and chunks[at].kind == "noun" and chunks[at - 1].kind == "joint":
        at -= 2
    verb = chunks[at - 1] if 0 < at < last else None
    told = (
        verb is not None
        and verb.kind in ("verb", "there")
        and verb.words[-1:] != ()
        and verb.words[-1] in lexicon.OF_SEVERAL
    )
    return list(range(at, last + 1, 2)) if told else []


def _headless(chunks: Sequence[Chunk], last: int) -> list[int]:
    """The phrases before the one at chunk `last` that have its noun: "a red, a green and a blue cup upside down"."""
    heads: list[int] = []
    at = last - 2
    while at >= 0 and chunks[at + 1].kind == "joint" and (phrase := chunks[at].phrase) is not None:
        named = phrase.kind != "pieces" or phrase.closing in ("one", "ones")
        # "One upside down, the rest upright"
        if named or phrase.definite or phrase.modifiers == NO_MODIFIERS or phrase.modifiers.postures:
            break
        heads.insert(0, at)
        at -= 2
    return heads


def _subject(chunks: Sequence[Chunk], at: int) -> list[int]:
    """The phrases up to chunk `at` of a list that ends there; none where that is no object of the scene."""
    phrase = chunks[at].phrase if at >= 0 else None
    if phrase is None or phrase.kind not in ("object", "unknown", "pronoun", "pieces"):
        return []
    there = next((n for n in range(at, -1, -1) if chunks[n].kind == "there"), None)
    between = range(at, at - 1, -1) if there is None else range(at, there, -1)
    return sorted(n for n in between if chunks[n].kind == "noun")
