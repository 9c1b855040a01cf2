"""What a thing is only compared with: the cat of "a cushion shaped like a cat" is no object of the scene."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_RANKED = frozenset({"furthest", "farthest", "further", "farther"})
_STANDS = frozenset({"stands", "stand", "lies", "lie", "sits", "sit", "rests", "rest"})
_LOOKING = frozenset(
    {"shaped", "looking", "looks", "look", "painted", "styled", "designed", "formed", "coloured", "colored"}
)
_RESEMBLING = frozenset({"resembling", "resembles", "resemble", "imitating", "mimicking"})
_FOLDED = frozenset({"folded", "rolled", "twisted", "carved", "shaped", "moulded", "molded", "crumpled"})
_SERVING = frozenset({"serves", "serving", "acts", "acting", "used", "functions", "functioning", "doubles", "doubling"})
_MEASURES = frozenset({"size", "colour", "color", "shape", "form", "height", "length", "width", "likeness", "style"})
_BEFORE = frozenset(
    {"that", "which", "who", "twice", "half", "double", "almost", "exactly", "about", "roughly", "just"}
)
"""Words that belong to what opens a comparison."""
_LONGEST = 5
"""Words of what a thing is compared with."""


def similes(tokens: Sequence[Token], nouns: Nouns) -> list[Span]:
    """Where a thing is compared with another in one sentence, with the commas that set it off at both ends."""
    words = [token.text for token in tokens]
    made: list[Span] = []
    for at in range(1, len(words) - 2):
        before = nouns.match(words[at - 1 : at])
        bears = before is None or any(nouns.of_class(before.noun, each) for each in (lexicon.LEVEL, vessels.HOLLOW))
        if words[at] == "with" and words[at + 2] == "ingredients" and not bears:
            # "A soap with natural ingredients"
            return [(at, at + 3)]
    at = 1
    while at < len(words):
        behind = _opening(words, at)
        end = _thing(tokens, behind, nouns, ranked=words[at] in _RANKED) if behind else 0
        if end:
            start = at - (words[at - 1] in _BEFORE)
            if (
                words[at] in _RANKED
                and words[at - 1] in ("is", "are", "stands", "stand", "lies", "lie")
                and words[at - 2] in _BEFORE
            ):
                start = at - 2
            set_off = start > 0 and words[start - 1] == "," == words[end]
            made.append((start - set_off, end + set_off))
        at = max(end, at + 1)
    return made


def _opening(words: Sequence[str], at: int) -> int:
    """The word behind "shaped like", "as red as", "the size of" at word `at`; 0 where none of them stands there."""
    three = words[at : at + 3]
    if words[at] in _LOOKING and words[at + 1 : at + 2] in (["like"], ["as"]):
        return at + 2
    if words[at] in _FOLDED and three[1:2] in (["into"], ["in"]) and three[2:] in (["a"], ["an"]):
        return at + 2
    if words[at] in _SERVING and words[at + 1 : at + 2] == ["as"]:
        return at + 2
    like = words[at] == "like" and three[1:2] in (["a"], ["an"]) and words[at + 3 : at + 4] == ["."]
    if like or words[at] in _RESEMBLING:
        return at + 1
    # "The cup sitting further away from the can"
    away = words[at + 1 : at + 2] == ["away"] and words[at - 1] not in _STANDS
    if words[at] in _RANKED and words[at + 1 + away : at + 2 + away] == ["from"]:
        return at + 2 + away
    if words[at : at + 2] in (["similar", "to"], ["identical", "to"], ["reminiscent", "of"], ["evocative", "of"]):
        return at + 2
    if three[:1] == ["as"] == three[2:] and three[1] not in ("well", "many", "much", "few", "soon", "far", "long"):
        return at + 3
    size = at + (three[0] == "in")
    measured = words[size] == "the" and set(words[size + 1 : size + 2]) & _MEASURES if size < len(words) else False
    return size + 3 if measured and words[size + 2 : size + 3] == ["of"] else 0


def _thing(tokens: Sequence[Token], start: int, nouns: Nouns, *, ranked: bool) -> int:
    """The end of the name of the catalogue that begins at token `start`; 0 where none does."""
    end = start
    while end < min(start + _LONGEST, len(tokens)) and not tokens[end].mark and not link_at(tokens, end):
        words = [token.text for token in tokens[start : end + 1]]
        led = all(word in lexicon.DETERMINERS | lexicon.POSSESSIVES or is_modifier(word) for word in words[:-1])
        if led and nouns.match(words[-1:]):
            while end + 1 < len(tokens) and nouns.match([token.text for token in tokens[end : end + 2]]):
                end += 1
            # "As tall as the bottle": that is there too, where nothing before has named it.
            there = tokens[start].text in lexicon.DEFINITE
            known = any(token.text == tokens[end].text for token in tokens[:start])
            return end + 1 if ranked or known or not there else 0
        end += 1
    # "Across the cans like a ramp" names nothing that is there.
    plain = tokens[start - 1].text == "like" and tokens[start].text in ("a", "an") and end == start + 2
    return end if plain and tokens[end].text == "." else 0
