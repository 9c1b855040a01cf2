"""Which of several is meant by its side: "the lemon on the left" of two lemons is the left lemon."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token, singulars
from pat3d.plan.grammar.vocabulary import Nouns

_PLACES = {("on", "the", "left"): "left", ("on", "the", "right"): "right", ("in", "the", "middle"): "middle",
           ("in", "the", "centre"): "middle", ("in", "the", "center"): "middle"}  # fmt: skip
_GOING = frozenset({"put", "place", "set", "lay", "stand", "move", "keep", "leave", "position", "arrange"})
"""Verbs that say where a thing is to go: "put the lemon on the left"."""


def by_side(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the lemon on the left" as "the left lemon", where several lemons were named before."""
    tokens = _at_ends(tokens, nouns)
    words = [token.text for token in tokens]
    made, at = list[Token](), 0
    while at < len(tokens):
        place = _place_behind(words, at, nouns) if words[at] == "the" and at + 1 < len(words) else 0
        name = singular_of(words[place - 1]) if place else ""
        likes = {one for word in words[:at] for one in singulars(word) if nouns.match([word])}
        # "Beside the one on the left"; by itself it may be another basket: "the basket on the left ..., the one on"
        landmark = name == "one" and any(at - n >= 0 and link_at(tokens, at - n) == n for n in (1, 2, 3, 4))
        if place and (name in likes or (landmark and likes)) and not _goes(tokens, at, place):
            the, side = tokens[at], tokens[place + 2]
            told = [the, replace(side, text=_PLACES[words[place], words[place + 1], words[place + 2]])]
            made += [replace(token, start=the.start, end=side.end) for token in (*told, *tokens[at + 1 : place])]
            at = place + 3
        else:
            made.append(tokens[at])
            at += 1
    return made


def _at_ends(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the cup at the right end" as "the cup on the right"."""
    made: list[Token] = []
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        side = words[at - 1] in ("left", "right") and words[at - 3 : at - 1] == ["at", "the"] if at > 4 else False
        named = (
            side
            and "the" in words[max(at - 7, 0) : at - 3]
            and (words[at - 4] == "one" or nouns.match([words[at - 4]]))
        )
        if token.text == "end" and named and words[at + 1 : at + 2] != ["of"]:
            made[-3] = replace(made[-3], text="on")
            made[-1] = replace(made[-1], end=token.end)
        else:
            made.append(token)
    return made


def singular_of(word: str) -> str:
    """`word` itself where it is the name of one thing, nothing where it is a plural."""
    return "" if singulars(word) else word


def _place_behind(words: Sequence[str], at: int, nouns: Nouns) -> int:
    """Where "on the left" begins behind "the" and a noun at word `at`, of nothing else; 0 where it does not."""
    name = next((n for n in (3, 2, 1) if nouns.match(words[at + 1 : at + 1 + n])), int(words[at + 1] == "one"))
    place = at + 1 + name
    told = bool(name) and tuple(words[place : place + 3]) in _PLACES
    # "On the left of the plate", "on the left side", "on the left tray" are other places.
    last = place + 3 < len(words) and (words[place + 3] in ("of", "side", "hand") or nouns.match([words[place + 3]]))
    return place if told and not last else 0


def _goes(tokens: Sequence[Token], at: int, place: int) -> bool:
    """Whether the place is where the thing at token `at` is to go, and not by which it is told."""
    asked = at > 0 and tokens[at - 1].text in _GOING
    behind = next((n for n in range(place + 3, len(tokens)) if tokens[n].mark or link_at(tokens, n)), len(tokens))
    return asked and (behind == len(tokens) or tokens[behind].mark)
