"""Shorthand of lists: "desk, lamp left, mug right", "toolbox (hammer, pliers)", "three cups, middle one red"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import LINKS
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Match, Nouns
from pat3d.scene.relations import LATERAL_KINDS

_SIDES = {
    "left": "left", "right": "right", "middle": "middle", "center": "middle", "centre": "middle", "front": "front",
    "back": "back",
}  # fmt: skip
_ON = {
    "left": "on the left side of the", "right": "on the right side of the", "middle": "in the middle of the",
    "front": "at the front of the", "back": "at the back of the",
}  # fmt: skip
"""Places on what has a level top."""
_BESIDE = {
    "left": "to the left of the", "right": "to the right of the", "front": "in front of the", "back": "behind the",
}  # fmt: skip
_ALONE = {"left": "on the left", "right": "on the right", "middle": "in the middle"}
_NEAR = frozenset({"on", "to", "at", "in"})
_OPENED, _CLOSED = ("(", "["), (")", "]")
_THERE = tuple(tuple(said.split()) for said in (
    "inside", "inside it", "in it", "on it", "on top", "on top of it", "within",
))  # fmt: skip
_LONGEST = 30
"""Tokens of a list in brackets."""


def sides(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "desk, lamp left" as "desk, lamp on the left side of the desk", "plate, fork left" beside it.

    Where the first of the list has a side itself, they are sides of one another.
    """
    starts = [0, *(at + 1 for at, token in enumerate(tokens[:-1]) if token.text in (",", ":", "and", "with"))]
    ends = [*(start - 1 for start in starts[1:]), len(tokens) - 1]
    items = [_item(tokens[start:end], nouns) for start, end in zip(starts, ends, strict=True)]
    told = [each for each in items if each is not None]
    if tokens[ends[0]].text not in (",", ":") or items[0] is None:
        return list(tokens)
    first, own, _ = items[0]
    if own and sum(bool(side) for _, side, _ in told) < 2:
        return list(tokens)
    head = [token.text for token in tokens[: ends[0]] if token.text not in lexicon.LEADING]
    head = head[: head.index("of")] if "of" in head else head
    level = nouns.of_class(first.noun, lexicon.LEVEL)
    level = level and not nouns.of_class(first.noun, (*lexicon.DISHES, *lexicon.SEATS))
    made: list[Token] = []
    for start, end, item in zip(starts, ends, items, strict=True):
        side, bare = (item[1], item[2]) if item is not None else ("", False)
        floor = item is not None and nouns.of_class(item[0].noun, lexicon.FLOOR)
        words = (_ALONE if own else _ON if level and not floor else _BESIDE).get(side, "")
        whole = words and (bare or (level and not floor and not own))
        if not whole or (not own and (first.plural or start == 0)):
            made += tokens[start : end + 1]
            continue
        last = _before_side([token.text for token in tokens[start:end]])[0]
        said = [*words.split(), *([] if own else head)]
        place = tokens[start + last : end]
        made += tokens[start : start + last]
        made += [replace(place[0], text=word, end=place[-1].end) for word in said]
        made.append(tokens[end])
    return made


def _before_side(words: Sequence[str]) -> tuple[int, str, bool]:
    """How many of `words` stand before the side that they end in, which that is, and whether it is the word alone."""
    for size in (2, 3, 4):
        said = [*words[-size:], ""]
        phrase = said[0] in _NEAR and said[1] == "the" and said[2] in _SIDES and said[3] in ("", "side")
        if size > 2 and phrase and len(words) > size:
            return len(words) - size, _SIDES[said[2]], False
        if size == 2 and said[0] == "in" and said[1] in ("front", "back") and len(words) > size:
            return len(words) - size, said[1], False
    alone = len(words) > 1 and words[-1] in _SIDES
    return (len(words) - 1, _SIDES[words[-1]], True) if alone else (len(words), "", False)


def _item(tokens: Sequence[Token], nouns: Nouns) -> tuple[Match, str, bool] | None:
    """What "two red cups left" names, its side, and whether that is a word alone; None where it says anything else."""
    words = [token.text for token in tokens]
    last, side, bare = _before_side(words)
    words = words[:last]
    words = words[: words.index("of")] if "of" in words[1:] else words
    while len(words) > 1 and (words[0] in lexicon.LEADING | lexicon.BACKGROUND or words[0].isdecimal()
                              or is_modifier(words[0])):  # fmt: skip
        words = words[1:]
    found = nouns.match(words) if len(words) < 4 else None
    return None if found is None else (found, side, bare)


def out_of_brackets(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a toolbox (hammer, pliers) on a desk" as "a toolbox on a desk. In the toolbox: hammer, pliers".

    Brackets hold the contents of what can have some; of anything else they tell what it is.
    """
    made: list[Token] = []
    told: list[Token] = []
    at = 0
    while at < len(tokens):
        token = tokens[at]
        close = _closing(text, tokens, at)
        start, end = _stripped(tokens, at + 1, close)
        beside = _beside(tokens[at + 1 : close]) if close and made else None
        if beside is not None and (owner := _owner(made, nouns)) is not None:
            # "A box (behind it a jug) holds a pen."
            link, what = beside
            words = [replace(token, text=word, mark=False) for word in ("the", "is")]
            told += [*link, words[0], *owner[1], words[1], *what, replace(tokens[close], text=".")]
            at = close + 1
            continue
        sure = end - start < close - at - 1
        carrier = _owner(made, nouns) if sure else _carrier(made, nouns)
        carrier = carrier if close and tokens[start].text not in _NEAR else None
        if carrier and _contents(tokens[start:end], carrier[0], nouns, sure=sure):
            match, name = carrier
            inside = nouns.of_class(match.noun, (*vessels.HOLLOW, *vessels.OPENED, *vessels.SHUT))
            lead = [replace(token, text=word, mark=False) for word in ("in" if inside else "on", "the")]
            colon, stop = replace(token, text=":"), replace(tokens[close], text=".")
            told += [*lead, *name, colon, *tokens[start:end], stop]
            at = close + 1
            continue
        made.append(token)
        if token.text == ".":
            made, told = [*made, *told], []
        at += 1
    return made


def _stripped(tokens: Sequence[Token], start: int, end: int) -> tuple[int, int]:
    """Where "with four pens inside" in brackets from token `start` to `end` names what is there: its four pens."""
    words = [token.text for token in tokens[start:end]]
    start += words[:1] == ["with"]
    size = max((len(said) for said in _THERE if tuple(words[-len(said) :]) == said), default=0)
    bare = end - size <= start or bool({*words} & lexicon.DETACHED)
    return (end - len(words), end) if bare else (start, end - size)


def _beside(inside: Sequence[Token]) -> tuple[Sequence[Token], Sequence[Token]] | None:
    """The relation and what stands so of "behind it a jug"; None where `inside` tells of no such thing."""
    size = link_at(inside, 0) if len(inside) > 3 else 0
    link = LINKS.get(tuple(token.text for token in inside[:size])) if size else None
    told = link is not None and link.kind in LATERAL_KINDS and inside[size].text == "it"
    one = told and inside[size + 1].text in ("a", "an", "one") and not any(token.mark for token in inside)
    alone = one and not any(
        token.text == "and" or link_at(inside, size + 2 + n) for n, token in enumerate(inside[size + 2 :])
    )
    return (inside[:size], inside[size + 1 :]) if alone else None


def known_again(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "white bowl with six eggs, whisk leaning on bowl" as "... leaning on the bowl", of which one is."""
    made: list[Token] = []
    named: list[tuple[int, Match, list[str]]] = []
    at = 0
    while at < len(tokens):
        size = link_at(tokens, at)
        size = size if tuple(token.text for token in tokens[at : at + size]) in LINKS else 0
        words = [token.text for token in tokens[at + size : at + size + 6]]
        led = next((n for n, word in enumerate(words) if not is_modifier(word)), len(words))
        noun = next((n for n in (3, 2, 1) if led + n <= len(words) and nouns.match(words[led : led + n])), 0)
        match = nouns.match(words[led : led + noun]) if noun else None
        if match is None:
            made += tokens[at : at + max(size, 1)]
            at += max(size, 1)
            continue
        end = at + size + led + noun
        same = [(last, how) for last, other, how in named if other.noun == match.noun and other.said == match.said]
        # "The jar of honey" is the jar of what it was of before.
        again = size and tokens[at].text != "of" and len(same) == 1 and not match.plural and same[0][0] != at
        again = again and {*words[:led]} <= {*same[0][1]} and "several" not in same[0][1]
        made += tokens[at : at + size]
        if again:
            made.append(replace(tokens[at + size], text="the"))
        else:
            number = tokens[at + size - 1].text if at + size else "."
            several = match.plural or numeral(number) > 1 or number in ("each", "every")
            named.append((end, match, [*words[:led], *(["several"] if several else [])]))
        made += tokens[at + size : end]
        at = end
    return made


def _closing(text: str, tokens: Sequence[Token], at: int) -> int:
    """The token that closes the bracket which token `at` opens; 0 where it opens none."""
    if not tokens[at].mark or text[tokens[at].start : tokens[at].end] not in _OPENED:
        return 0
    ends = (n for n in range(at + 2, min(at + _LONGEST, len(tokens))) if tokens[n].mark)
    return next((n for n in ends if text[tokens[n].start : tokens[n].end] in _CLOSED), 0)


def _carrier(before: Sequence[Token], nouns: Nouns) -> tuple[Match, list[Token]] | None:
    """The one thing named last in `before` that may have things in it or on it, and its name with what tells it."""
    owner = _owner(before, nouns)
    tables = (*vessels.HOLLOW, *vessels.OPENED, *lexicon.LEVEL, *lexicon.STORAGE, *vessels.SHUT, *lexicon.SEATS)
    return owner if owner is not None and nouns.of_class(owner[0].noun, tables) else None


def _owner(before: Sequence[Token], nouns: Nouns) -> tuple[Match, list[Token]] | None:
    """The one thing named last in `before`, and its name with what tells it."""
    words = [token.text for token in before]
    size = next((n for n in (3, 2, 1) if n <= len(words) and nouns.match(words[-n:])), 0)
    match = nouns.match(words[-size:]) if size else None
    if match is None or match.plural:
        return None
    start = len(words) - size
    while start and is_modifier(words[start - 1]):
        start -= 1
    return None if start and numeral(words[start - 1]) > 1 else (match, list(before[start:]))


def _contents(inside: Sequence[Token], carrier: Match, nouns: Nouns, *, sure: bool) -> bool:
    """Whether `inside` lists things that `carrier` may have, and does not say in another word what it is.

    It does not where that is `sure`, as "with" or "on it" stands there too.
    """
    items: list[list[str]] = [[]]
    for token in inside:
        if token.text in (",", "and"):
            items.append([])
        else:
            items[-1].append(token.text)
    named: list[str] = []
    for words in filter(None, items):
        at = next((n for n, word in enumerate(words) if n and word in (*_NEAR, "with", "of", "under")), len(words))
        found = nouns.longest(words[:at]) if not all(is_modifier(word) for word in words) else None
        if found is None or found[0].noun == carrier.noun or link_at(inside, 0):
            return False
        named.append(found[0].noun)
    alone = not sure and len(named) == 1 and nouns.of_class(named[0], (*vessels.HOLLOW, *lexicon.FLOOR))
    return bool(named) and not alone
