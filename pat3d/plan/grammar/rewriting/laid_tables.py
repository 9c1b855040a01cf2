"""What a table is to be laid with: "set the table for two: plate, fork on the left" is to put them on the table.

Where each is to go there, and for how many, is no task: a note names it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.enumerated import items_of
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.left_out import quoted
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_LAYING = (("set", "up"), ("lay", "out"), ("set",), ("lay",), ("prepare",), ("dress",), ("arrange",))
_SIDES = frozenset({"left", "right", "front", "back", "above", "below", "top", "center", "centre", "middle"})


def laid_tables(text: str, told: Sequence[list[Token]], nouns: Nouns) -> tuple[list[list[Token]], list[str]]:
    """The sentences `told` of `text` with what a table is laid with as what is put on it, and what is not of that."""
    made: list[list[Token]] = []
    away: list[str] = []
    for sentence in told:
        laid = _laid(sentence, nouns) or _places(sentence)
        if laid is None:
            made.append(sentence)
            continue
        put, spans = laid
        made.append(put)
        away += [quoted(text, span) for span in spans]
    return made, away


def _laid(tokens: list[Token], nouns: Nouns) -> tuple[list[Token], list[Sequence[Token]]] | None:
    """`tokens` as "put the plate and the fork on the table", and the words that are not read; None for another."""
    words = [token.text for token in tokens]
    verb = next((len(said) for said in _LAYING if tuple(words[: len(said)]) == said), 0)
    colon = words.index(":") if ":" in words else 0
    if not verb or colon < verb + 2 or words[verb] not in lexicon.DETERMINERS | lexicon.POSSESSIVES:
        return None
    end = next(n for n in range(verb + 1, colon + 1) if n == colon or link_at(tokens, n) or words[n] == "for")
    table = nouns.match(words[end - 1 : end])
    if table is None or not nouns.of_class(table.noun, lexicon.LEVEL):
        return None
    spans: list[Sequence[Token]] = [tokens[end:colon]] if end < colon else []
    things: list[Token] = []
    items = items_of(tokens[colon + 1 : -1])
    if all(item[0].text in lexicon.COUNTING and _named(item, nouns) == len(item) for item in items):
        # "Lay the table for three: three bowls and three cups" is the scene to make, as "put three bowls on it" is.
        return None
    for item in items:
        size = _named(item, nouns)
        if not size:
            return None
        joint = [replace(item[0], text="and")] if things else []
        things += [*joint, *_the(item[:size])]
        spans += [item[size:]] if size < len(item) else []
    if not things:
        return None
    on = replace(tokens[colon], text="on", mark=False)
    return [replace(tokens[0], text="put"), *things, on, *tokens[verb:end], tokens[-1]], spans


def _places(tokens: list[Token]) -> tuple[list[Token], list[Sequence[Token]]] | None:
    """`tokens` "lay two places at the table" as "two plates and two forks and two knives on the table"."""
    words = [token.text for token in tokens]
    end = 3 + (words[3:4] in (["setting"], ["settings"]))
    if words[0] not in ("lay", "set") or not numeral(words[1]) or words[2] not in ("place", "places") or ":" in words:
        return None
    setting = [replace(tokens[1], text=word) for word in ("plates", "and", "forks", "and", "knives")]
    laid = [each for thing in setting for each in ([thing] if thing.text == "and" else [tokens[1], thing])]
    rest = [replace(one, text="on") if one.text == "at" else one for one in tokens[end:]]
    return [*laid, *rest], [tokens[1:end]]


def _named(item: Sequence[Token], nouns: Nouns) -> int:
    """How many words of `item` name a thing: two of "fork on the left"; none where it tells of no thing, or a deed."""
    words = [token.text for token in item]
    bare = words[0] not in lexicon.DETERMINERS | lexicon.NUMBERS.keys()
    if (not bare and len(words) == 1) or (known_verb(words[0]) and nouns.match(words[:1]) is None):
        return 0
    first = int(not bare)
    ends = (n for n in range(first + 1, len(words)) if link_at(item, n) or words[n] in _SIDES)
    end = next(ends, len(words))
    size = next((n for n in (3, 2, 1) if n <= end - first and nouns.match(words[end - n : end])), 0)
    return end if size and all(is_modifier(word) for word in words[first : end - size]) else 0


def _the(named: Sequence[Token]) -> list[Token]:
    """`named` as what is there: "a fork" and "fork" as "the fork", "two forks" as "the two forks"."""
    the = replace(named[0], text="the")
    if named[0].text in lexicon.DETERMINERS - {"each", "every"} or named[0].text == "one":
        return [the, *named[1:]]
    return [the, *named]
