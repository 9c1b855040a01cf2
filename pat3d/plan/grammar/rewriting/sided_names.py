"""Which of several is meant by its side: "the lemon on the left" of two lemons is the left lemon."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.vocabulary import Nouns

_PLACES: dict[tuple[str, ...], str] = {
    ("on", "the", "left"): "left", ("on", "the", "right"): "right",
    **{("in", "the", middle): "middle" for middle in ("middle", "centre", "center")},
}  # fmt: skip
"""Words behind a name by which it is one of several, and the word before it that says the same."""
_ENDS: dict[tuple[str, ...], str] = {
    ("in", "front"): "front", ("behind",): "back",
    **{(at, "the", side): side for at in ("at", "in") for side in ("front", "back")},
    **{(at, "the", "rear"): "back" for at in ("at", "in")},
    **{
        (at, "the", far, side): side
        for at in ("on", "at", "to")
        for far in ("far", "extreme")
        for side in ("left", "right")
    },
    **{(at, "the", side, "end"): side for at in ("on", "at") for side in ("left", "right")},
    **{(far, "to", "the", side): side for far in ("furthest", "farthest") for side in ("left", "right")},
    **{("between", "the", *others): "middle" for others in (("other", "two"), ("two", "others"), ("others",))},
}  # fmt: skip
"""Those that tell "the one" as well, wherever it stands."""
_LONGEST = max(map(len, _ENDS))
_BEFORE = {"central": "middle", "middlemost": "middle", "rear": "back", "rearmost": "back", "backmost": "back",
           "hindmost": "back", "frontmost": "front", "foremost": "front", "left-hand": "left",
           "right-hand": "right"}  # fmt: skip
_RANKS = lexicon.POSITIONS.keys() | _BEFORE.keys()
_FAR = frozenset({"far", "extreme", "furthest", "farthest"})


def by_side(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the lemon on the left" as "the left lemon", where several lemons were named before."""
    tokens = _plainly(_of_all(tokens), nouns)
    words = [token.text for token in tokens]
    made, at = list[Token](), 0
    while at < len(tokens):
        place, end, side = (
            _place_behind(tokens, at, nouns) if words[at] == "the" and at + 1 < len(words) else (0, 0, "")
        )
        name = singular_of(words[place - 1]) if place else ""
        likes = _likes(words[:at], nouns) if place else set()
        # "Beside the one on the left"; by itself it may be another basket: "the basket on the left ..., the one on"
        landmark = any(at - n >= 0 and link_at(tokens, at - n) == n for n in (1, 2, 3, 4))
        one = name == "one" and bool(likes) and (landmark or tuple(words[place:end]) in _ENDS)
        if place and (name in likes or one):
            told = [tokens[at], replace(tokens[place], text=side), *tokens[at + 1 : place]]
            made += [replace(token, start=tokens[at].start, end=tokens[end - 1].end) for token in told]
            at = end
        else:
            made.append(tokens[at])
            at += 1
    return made


def _of_all(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "the middle cup of the three cups" as "the middle one of the three cups"."""
    made = list(tokens)
    for at in range(len(tokens) - 5):
        words = [token.text for token in tokens[at : at + 7]]
        number = 4 + (words[4] == "the")
        told = words[0] == "the" and words[1] in _RANKS and words[3] == "of" and words[number] in lexicon.NUMBERS
        several = words[number + 1] if number + 1 < len(words) else ""
        if told and words[2] in singulars(several) and all(token.text != several for token in tokens[:at]):
            made[at + 2] = replace(made[at + 2], text="one")
    return made


def _plainly(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the central cup" as "the middle cup", and "the far left one" as "the left one"."""
    words = [token.text for token in tokens]
    made: list[Token] = []
    for at, token in enumerate(tokens):
        behind = words[at + 1 : at + 3]
        far = token.text in _FAR and behind[:1] in (["left"], ["right"])
        named = behind[1:] if far else behind[:1]
        told = (far or token.text in _BEFORE) and words[at - 1] == "the"
        if not told or not {*named} & (_likes(words[:at], nouns) | {"one"}):
            made.append(token)
        elif not far:
            made.append(replace(token, text=_BEFORE[token.text]))
    return made


def _likes(words: Sequence[str], nouns: Nouns) -> set[str]:
    """The names of what `words` name several of."""
    return {one for word in words for one in singulars(word) if nouns.match([word])}


def singular_of(word: str) -> str:
    """`word` itself where it is the name of one thing, nothing where it is a plural."""
    return "" if singulars(word) else word


def _place_behind(tokens: Sequence[Token], at: int, nouns: Nouns) -> tuple[int, int, str]:
    """From where to where "on the left" stands behind "the" and a noun at word `at`, of nothing else; 0 without."""
    words = [token.text for token in tokens]
    if words[at] != "the" or at + 1 == len(words):
        return 0, 0, ""
    name = next((n for n in (3, 2, 1) if nouns.match(words[at + 1 : at + 1 + n])), int(words[at + 1] == "one"))
    place = at + 1 + name
    for size in range(_LONGEST, 0, -1) if name else ():
        said = tuple(words[place : place + size])
        side = _PLACES.get(said) or _ENDS.get(said)
        if side is not None:
            end = place + size
            # "On the left of the plate", "on the left side", "on the left tray" are other places.
            more = end < len(words) and (words[end] in ("of", "side", "hand") or nouns.match([words[end]]))
            # "The cup behind the plate", "the one behind it"
            more = more or (said == ("behind",) and words[end] not in FINITE and not tokens[end].mark)
            return (0, 0, "") if more else (place, end, side)
    return 0, 0, ""
