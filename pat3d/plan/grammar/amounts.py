"""Numbers said otherwise than before their noun, in plainer words: "as many forks as plates", "three of each"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.lexing import Token, singulars
from pat3d.plan.grammar.modifiers import is_modifier
from pat3d.plan.grammar.vocabulary import Nouns

_ABOUT = frozenset({"about", "approximately", "roughly", "around", "exactly"})


def counted(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with every number before its noun."""
    return _of_each(_equal(_any_of(_rounded(tokens)), nouns), nouns)


def _is_number(word: str) -> bool:
    return word in lexicon.NUMBERS or word.isdecimal() or word.startswith("_")


def _rounded(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "about ten" as "ten"."""
    single = ("a", "an", "one", "both")
    follows = zip(tokens, [*tokens[1:], tokens[-1]], strict=True)
    return [token for token, after in follows
            if not (token.text in _ABOUT and _is_number(after.text) and after.text not in single)]  # fmt: skip


def _any_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "any of the screws" as "one of the screws"."""
    made = list(tokens)
    for at, token in enumerate(made[:-2]):
        if token.text == "any" and made[at + 1].text == "of":
            made[at] = replace(token, text="one")
    return made


def _equal(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "as many forks as plates" as "forks and plates", "two cups and as many jars" as "two jars"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 3) if words[n : n + 2] == ["as", "many"]), None)
    if at is None or (at and words[at - 1] in ("half", "twice", "times")):
        return list(tokens)
    end = next((n for n in range(at + 3, min(at + 6, len(words))) if words[n] == "as"), None)
    if end is not None and words[end + 1] == "there":
        return list(tokens)
    if end is not None:
        namely = next(
            (n for n in range(end, len(words) - 1) if words[n] == "namely" and _is_number(words[n + 1])), None
        )
        if namely is not None:
            number = tokens[namely + 1]
            end_of = namely - (words[namely - 1] == ",")
            tokens = [*tokens[: end + 1], number, *tokens[end + 1 : end_of], *tokens[namely + 2 :]]
            words = [token.text for token in tokens]
        joint = replace(tokens[end], text="and")
        number = next((n for n in range(end + 1, min(end + 3, len(words))) if _is_number(words[n])), None)
        same = [tokens[number]] if number is not None else []
        return [*tokens[:at], *same, *tokens[at + 2 : end], joint, *tokens[end + 1 :]]
    before = next(
        (n for n in range(at - 1, -1, -1) if _is_number(words[n]) and lexicon.NUMBERS.get(words[n], 2) > 1), None
    )
    if before is None or not any(nouns.match(words[n : n + 1]) for n in range(before, at)):
        return list(tokens)
    return [*tokens[:at], replace(tokens[at], text=words[before]), *tokens[at + 2 :]]


def _of_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "mugs and bowls, three of each," as "three mugs and three bowls"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(1, len(words) - 3)
               if _is_number(words[n]) and words[n + 1 : n + 3] == ["of", "each"] and tokens[n + 3].mark),
              None)  # fmt: skip
    if at is None or words[at - 1] not in (",", ":", "-"):
        return list(tokens)
    made = [*tokens[: at - 1], *tokens[at + 3 + (words[at + 3] == ",") :]]
    heads = [n for n in range(at - 1) if singulars(words[n]) and nouns.match([words[n]])]
    for head in reversed(heads[-2:]):
        first = head
        while first and is_modifier(words[first - 1]) and not _is_number(words[first - 1]):
            first -= 1
        if not first or not _is_number(words[first - 1]):
            made.insert(first, replace(tokens[at], start=tokens[first].start, end=tokens[first].start))
    return made
