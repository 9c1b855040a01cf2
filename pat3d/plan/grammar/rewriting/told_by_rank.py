"""Which of those that a sentence before counted: by rank, from left to right, from front to back.

Three boxes in a row: "from left to right they hold a fig, a pen and a book" tells of each box what it holds.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.some_by_rank import HOLDING, some_by_rank
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, items_of
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import ORDINALS, number_of
from pat3d.plan.grammar.words.vocabulary import Nouns

_BEFORE = ["one", "in", "front", "of", "the", "other"]


def by_rank(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with those that were counted in a sentence before told by the words for their ranks."""
    told = _another_holds(_front_and_back(some_by_rank(tokens, nouns)))
    return _in_each(_in_turn(told, nouns), nouns)


def counted_in(words: Sequence[str], stop: int, nouns: Nouns) -> tuple[int, str] | None:
    """How many of what the sentence that ends at `stop` counts, where that is one kind of thing; or None."""
    start = next((n + 1 for n in range(stop - 1, -1, -1) if words[n] == "."), 0)
    found: list[tuple[int, str]] = []
    for at in range(start, stop):
        if number_of(words[at]) < 2:
            continue
        name = at + 1
        while name < stop and is_modifier(words[name]):
            name += 1
        match = next((one for n in (3, 2, 1) if (one := nouns.match(words[name : name + n]))), None)
        whole = next((one for n in (3, 2) if (one := nouns.match(words[name - 1 : name - 1 + n]))), None)
        if match is not None and whole is not None and whole.plural and whole.noun != match.noun:
            # "Two plastic crates" are no two crates.
            match = whole
        if match is not None and match.plural:
            found.append((number_of(words[at]), match.said))
    return found[0] if len(found) == 1 else None


def _in_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "in the first, a fig; in the second, a pen" as "in the first box is a fig; in the second ..."."""
    words, found = [token.text for token in tokens], list[tuple[int, int]]()
    ends = (n for n in range(4, len(words) - 1) if words[n] in ORDINALS and words[n + 1] in (",", ".", ";", "and"))
    behind = [n for n in ends if words[n - 1] == "the" and words[n - 2] in ("in", "on") and not tokens[n - 3].mark]
    stop = next((n for n in range(behind[0] - 2, 0, -1) if tokens[n].mark), 0) if len(behind) > 1 else 0
    last = counted_in(words, stop, nouns) if stop else None
    for at in reversed(behind if last is not None else ()):
        # "Three boxes: figs in the first, pens in the second"
        named = [replace(tokens[at], text=word) for word in last[1].split()] if last is not None else []
        tokens = [*tokens[: at + 1], *named, *tokens[at + 1 :]]
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 5):
        led = (tokens[at - 1].mark or words[at - 1] == "and") and words[at] in ("in", "on", "inside")
        side = 2 * (words[at + 2] in ("left", "middle", "right") and words[at + 3] == "one")
        end = at + 2 + (side or words[at + 2] in ORDINALS)
        said = end + (words[end] == "," or words[end] in lexicon.COPULAS)
        if led and words[at + 1] == "the" and end > at + 2 and words[said] in ("a", "an", *lexicon.NUMBERS):
            found.append((end - side // 2, said))
    counted = counted_in(words, found[0][0] - 4, nouns) if len(found) > 1 else None
    made, name = list(tokens), counted[1].split() if counted is not None else []
    for end, said in reversed(found) if name else ():
        verb = "is" if words[said] in ("a", "an", "one") else "are"
        made[end:said] = [replace(tokens[said - 1], text=word, mark=False) for word in (*name, verb)]
    return made


def _front_and_back(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "one in front of the other" as "one behind the other"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words)) if words[n : n + 6] == _BEFORE), -1)
    if at < 0:
        return list(tokens)
    return [*tokens[: at + 1], replace(tokens[at + 1], text="behind", end=tokens[at + 3].end), *tokens[at + 4 :]]


def _another_holds(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "one holds a fig and another a pen" as "one holds a fig and another holds a pen"."""
    made: list[Token] = []
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        made.append(token)
        end = at - (token.text == "one")
        if words[end] != "another" or end < 4 or words[end - 1] not in (",", "and") or at + 1 >= len(words):
            continue
        start = next((n + 1 for n in range(end, -1, -1) if words[n] == "."), 0)
        verb = next((n for n in range(start, end) if words[n] in HOLDING.values()), 0)
        if words[start] == "one" and verb and words[at + 1] in lexicon.DETERMINERS | lexicon.NUMBERS.keys() - {"one"}:
            made.append(replace(tokens[verb], start=token.end, end=token.end))
    return made


def _in_turn(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "from left to right they hold a fig and a pen" as "the first box holds a fig, the second a pen"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 7):
        if words[at : at + 4] != ["from", "left", "to", "right"] or words[at - 1] != ".":
            continue
        they = at + 4 + (words[at + 4] == ",")
        if words[they] != "they" or words[they + 1] not in HOLDING:
            continue
        end = next(n for n in range(they, len(words)) if words[n] == ".")
        items = items_of(tokens[they + 2 : end])
        counted = counted_in(words, at - 1, nouns)
        if counted is None or len(items) != counted[0] or counted[0] > len(ORDINALS):
            continue
        made: list[Token] = []
        for n, item in enumerate(items):
            joint = replace(tokens[they], text=",", mark=True)
            lead = ("the", ORDINALS[n], *counted[1].split(), HOLDING[words[they + 1]])
            made += [*([joint] if n else []), *(replace(item[0], text=word, end=item[0].start) for word in lead), *item]
        return [*tokens[:at], *made, *tokens[end:]]
    return list(tokens)
