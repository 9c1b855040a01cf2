"""Levels of one piece of furniture, told of as if they stood alone: "the upper tier" of a cart with two tiers.

What is on one of them is on the furniture: "the upper shelf of the cart". A note says that it has no parts of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.number_words import number_of
from pat3d.plan.grammar.words.vocabulary import Nouns

_STOREYED = (*lexicon.TIERS, "shelving unit", "bookcase", "trolley", "dresser", "tv stand", "cake stand", "dish rack",
             "bar cart")  # fmt: skip
"""What has levels where nothing says so."""
_LEVELS = {"level": "levels", "tier": "tiers", "shelf": "shelves", "storey": "storeys", "rack": "racks"}
_HEIGHTS = frozenset(lexicon.LEVELS) | {"middle", "centre", "center", "central", "first", "second", "third", "fourth",
                                        "last", "next", "other"}  # fmt: skip
_OPENING = frozenset({".", ",", ":", "and", "while", "but", "whereas"})
_WITH = frozenset({"with", "has", "having", "of", "featuring", "have"})


def levels_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the upper tier" as "the upper shelf of the cart", the furniture that was named before it."""
    tokens = _on_each(_possessed(tokens, nouns), nouns)
    words = [token.text for token in tokens]
    made: list[Token] = []
    owner = _unnamed(words, nouns)
    owners: set[tuple[str, ...]] = set()
    told = verb = since = False
    at = 0
    while at < len(tokens):
        if whole := _with_levels(words, at, owner if since else (), nouns):
            owner = whole
            match = nouns.match(whole)
            count = lexicon.TIERS.get(match.noun) if match is not None and match.noun not in lexicon.STACKED else None
            if number_of(words[at]) == count:
                # "A cart with two tiers": it is made so.
                made.pop()
            else:
                made += [tokens[at], replace(tokens[at + 1], text="shelves")]
            told, at = True, at + 2
            if words[at] in (":", ",") and words[at + 1] in ("the", "its") and words[at + 2] in _HEIGHTS:
                made = [*_without_on(made), replace(tokens[at], text=".", mark=True)]
                at += 1
            continue
        size, height = _level(words, at, told=told) if owner else (0, "")
        if size:
            after = at + size
            said = ("the", height, "shelf", "of", "the", *owner)
            made += [replace(tokens[at + min(n, size - 1)], text=word) for n, word in enumerate(said)]
            has = words[at - 1] in _OPENING and words[after] == "with"
            if (verb and words[at - 1] in _OPENING and words[after] in lexicon.COUNTING) or has:
                # "The top shelf holds a globe, the bottom one a vase.", "the top one with a globe"
                made.append(replace(tokens[after - 1], text="holds"))
                after += has
            told = True
            at = after + 2 * (words[after] == "of" and words[after + 1] in ("it", "them"))
            continue
        found = next((n for n in (3, 2, 1) if nouns.match(words[at : at + n])), 0)
        match = nouns.match(words[at : at + found]) if found else None
        if match is not None and match.noun in _STOREYED:
            named = tuple(words[at : at + found])
            again = (named in owners and words[at - 1] not in lexicon.DEFINITE) or words[at - 1] in _HEIGHTS
            told = told or (words[at - 1] in _HEIGHTS and words[at + found] == "of")
            owner = () if match.plural or again else named
            owners |= {named}
        since = (since or words[at] in owner) and words[at] != "."
        verb = (verb or (told and (_finite(words[at]) or words[at] == "holding"))) and words[at] != "."
        made += tokens[at : at + max(found, 1)]
        at += max(found, 1)
    return made


def _possessed(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the fridge's top shelf" as "the top shelf of the fridge"."""
    made = list(tokens)
    for at in (n for n in range(1, len(made) - 2) if made[n].text == "'s"):
        height, level = made[at + 1].text, made[at + 2].text
        start = next((n for n in (at - 2, at - 3) if n >= 0 and made[n].text in ("the", "a", "an")), None)
        if start is None or height not in _HEIGHTS or level not in _LEVELS:
            continue
        match = nouns.match([token.text for token in made[start + 1 : at]])
        if match is not None and match.noun in _STOREYED:
            the = replace(made[start], text="the")
            owner = (replace(made[at], text="of"), *made[start:at])
            made[start : at + 3] = [the, made[at + 1], made[at + 2], *owner]
    return made


def _unnamed(words: Sequence[str], nouns: Nouns) -> tuple[str, ...]:
    """The shelf of "a mug on the top shelf and a book on the bottom shelf", which nothing else names."""
    told = {words[n - 1] for n in range(2, len(words)) if words[n] == "shelf" and words[n - 2] == "the"}
    owned = any(
        (match := nouns.match([word])) is not None and match.noun in _STOREYED for word in words if word != "shelf"
    )
    owned = owned or "shelves" in words
    return ("shelf",) if len(told & {*lexicon.LEVELS, "middle"}) > 1 and not owned else ()


def _on_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two cups on each level" of a shelf of three as "6 cups on the shelf"; "each level" is a shelf."""
    words = [token.text for token in tokens]
    made = list(tokens)
    at = next((n for n in range(1, len(words) - 1) if words[n] in ("each", "every") and words[n - 1] == "on"
               and (words[n + 1] in _LEVELS or tokens[n + 1].mark)), 0)  # fmt: skip
    number = next((n for n in range(len(words) - 1) if number_of(words[n]) and words[n + 1] in _LEVELS.values()), -1)
    names = (words[n : n + size] for n in range(len(words)) for size in (3, 2, 1) if n + size < len(words))
    owner = next((name for name in names if (match := nouns.match(name)) is not None and match.noun in _STOREYED
                  and not match.plural), None)  # fmt: skip
    if not at or owner is None:
        return made
    level = words[at + 1] in _LEVELS
    if not level and not 0 <= number < at:
        return made
    end = at + 1 + level
    end += 2 if words[end : end + 2] == ["of", "it"] else 0
    of = end + 2 + len(owner) if words[end] == "of" and words[end + 2 : end + 2 + len(owner)] == owner else 0
    around = (*range(at - 3, max(at - 7, -1), -1), *range(end, min(end + 3, len(words) - 2)))
    counts = (n for n in around if n != number and (number_of(words[n]) or words[n] in ("a", "an", "one")))
    first = next((n for n in counts if not any(tokens[k].mark for k in range(min(n, at), max(n, at)))), -1)
    behind = (n for n in range(first + 1, min(first + 4, len(words))) if nouns.match([words[n]]))
    last = at - 2 if first < at else next(behind, 0)
    if number < 0 or first < 0 or nouns.match([words[last]]) is None:
        if level:
            made[at + 1] = replace(tokens[at + 1], text="shelf")
        return made
    made[first] = replace(tokens[first], text=str((number_of(words[first]) or 1) * number_of(words[number])))
    made[last] = tokens[last] if words[last].endswith("s") else replace(tokens[last], text=f"{words[last]}s")
    made[at : (of or end)] = [replace(tokens[at], text=word) for word in ("the", *owner)]
    return made


def _with_levels(words: Sequence[str], at: int, subject: tuple[str, ...], nouns: Nouns) -> tuple[str, ...]:
    """What has the "two tiers" at token `at`: what stands before "with", or the `subject` of "has"; empty without."""
    number = words[at] in lexicon.NUMBERS.keys() - {"a", "an"} or words[at].isdecimal()
    rows = words[at + 1 : at + 2] == ["rows"] and words[at + 2] != "of"
    if at < 2 or not number or words[at - 1] not in _WITH or not (rows or words[at + 1] in _LEVELS.values()):
        return ()
    if subject and words[at - 1] in ("has", "having"):
        return subject
    end = at - 1 - (words[at - 2] in ("that", "which", "it"))
    for size in (n for n in (3, 2, 1) if n <= end):
        match = nouns.match(words[end - size : end])
        if match is not None and not match.plural and match.noun in _STOREYED:
            return tuple(words[end - size : end])
    return ()


def _level(words: Sequence[str], at: int, *, told: bool) -> tuple[int, str]:
    """The size of "the upper tier" at token `at`, and which it is; 0 where no level is spoken of alone."""
    if (
        words[at - 1] in (",", ":", ";", "and", "on")
        and (words[at] in lexicon.LEVELS or (told and words[at] == "middle"))
        and {*words[at + 1 : at + 2]} & {*_LEVELS}
    ):
        return 2, words[at]
    if words[at] not in ("the", "its", "this") or at + 4 > len(words):
        return 0, ""
    height, head, after = words[at + 1 : at + 4]
    if height in _HEIGHTS and (head in _LEVELS or (told and head == "row")):
        return (0, "") if after == "of" and words[at + 4 : at + 5] not in (["it"], ["them"]) else (3, height)
    subject = words[at - 1] in _OPENING and (_finite(after) or after == "with" or after in lexicon.COUNTING)
    if told and height in _HEIGHTS and head == "one" and (subject or words[at - 1] == "on"):
        return 3, height
    alone = words[at - 1] in _OPENING and (_finite(head) or head in lexicon.COUNTING or head == "holding")
    if told and height in _HEIGHTS and (alone or (words[at - 1] == "on" and head in _OPENING)):
        # "The upper holds a lamp, the lower a plant."
        return 2, height
    if told and height in (*_LEVELS, "one") and head in ("below", "above") and words[at - 1] in (*_OPENING, "on"):
        return (3, "lower" if head == "below" else "upper") if _finite(after) or words[at - 1] == "on" else (0, "")
    return 0, ""


def _finite(word: str) -> bool:
    """Whether `word` says that a level holds something, or is something."""
    link = LINKS.get((word,))
    return word in FINITE and (link is None or link.inverse or word in lexicon.COPULAS)


def _without_on(made: list[Token]) -> list[Token]:
    """`made` without the "on" of "on a cart with two shelves, the upper one holds a can": a sentence of its own."""
    start = next((n for n in range(len(made) - 1, -1, -1) if made[n].text == "."), -1) + 1
    return [*made[:start], *made[start + 1 :]] if made[start].text in ("on", "in") else made
