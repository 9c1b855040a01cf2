"""What is between each two neighbours of several: "three plates in a row, a fork between each pair of plates".

It is told of one pair after the other, behind the sentence that says how many there are.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.lexing import Token, singulars
from pat3d.plan.grammar.modifiers import is_modifier
from pat3d.plan.grammar.number_words import ORDINALS, number_of, numeral
from pat3d.plan.grammar.vocabulary import Nouns

_NEAR = frozenset({"neighbouring", "neighboring", "adjacent", "consecutive", "successive"})
_PAIRS = (["pair", "of"], ["pair"], ["two"], ["2"], ["couple", "of"])
_LEADS = frozenset({"and", "with", "while", "where", "there", "is", "are"})
_VERBS = lexicon.VERBS | lexicon.COPULAS | lexicon.PARTICIPLES | {"placed"}


@dataclass(frozen=True, kw_only=True)
class _Between:
    """A clause that says what is between each two of several."""

    start: int
    end: int
    """Of the clause, with the joint before it."""
    thing: tuple[int, int]
    """What is there: "a fork"."""
    noun: str
    """Of what it is between; empty where that is said before."""


def between_neighbours(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt with "three plates in a row, a fork between each pair" told pair by pair.

    So is "Between each pair of neighbouring plates lies a fork. There are three plates in a row.", where the number of
    plates is said behind it.
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 2) if words[n] == "between"), None)
    told = _clause(tokens, at, nouns) if at is not None else None
    counted = _counted(words, told, nouns) if told is not None else None
    if told is None or counted is None or not 2 < counted[1] <= len(ORDINALS):
        return list(tokens)
    name, number = counted
    last = max(name[1], told.end - 1)
    stop = next((n for n in range(last, len(words)) if words[n] == "."), len(words) - 1)
    single = [*words[name[0] : name[1]], next(iter(singulars(words[name[1]])), words[name[1]])]
    place, thing = tokens[told.thing[1] - 1], tokens[told.thing[0] : told.thing[1]]
    pairs: list[Token] = []
    for one, other in zip(ORDINALS[: number - 1], ORDINALS[1:number], strict=True):
        verb = "are" if number_of(thing[0].text) else "is"
        said = (verb, "between", "the", one, *single, "and", "the", other, *single)
        pairs += [*thing, *(replace(place, text=word, mark=False) for word in said), tokens[stop]]
    kept = [token for n, token in enumerate(tokens[:stop]) if not told.start <= n < told.end]
    kept = kept[1:] if kept and kept[0].text in (".", ",") else kept
    ended = [*kept, *([tokens[stop]] if kept[-1].text != "." else [])]
    return [*ended, *pairs, *tokens[stop + 1 :]]


def _clause(tokens: Sequence[Token], at: int, nouns: Nouns) -> _Between | None:
    """The clause whose "between each pair of" begins at token `at`; None where none does."""
    words = [token.text for token in tokens]
    n = at + 1 + (words[at + 1] in ("each", "every"))
    size = next((len(said) for said in _PAIRS if words[n : n + len(said)] == said), 0) if n > at + 1 else 0
    n += size
    near = words[n] in _NEAR
    n += near
    name = nouns.match([words[n]])
    if not (size or near) or (name is not None and not name.plural):
        return None
    noun, behind = (words[n], n + 1) if name is not None else ("", n)
    stops = (m for m in range(behind, len(words)) if tokens[m].mark or words[m] in ("and", "while"))
    end = next(stops, len(words))
    start = next((m + 1 for m in range(at - 1, -1, -1) if tokens[m].mark or words[m] in ("with", "while")), 0)
    start = at if words[at - 1] in ("and", "while") else start
    first = start
    if start == at:
        # "Between each pair of plates lies a fork."
        first = behind + 1 + (words[behind] == "there")
        thing = (first, end)
        fits = words[first - 1] in _VERBS
    else:
        while words[first] in _LEADS:
            first += 1
        last = at - (words[at - 1] in _VERBS)
        thing = (first, last)
        fits = behind == end
    inside = words[thing[0] : thing[1]]
    fits = fits and bool(inside) and (inside[0] in ("a", "an") or numeral(inside[0]) > 0)
    linked = any(link_at(tokens, m) or words[m] in _VERBS for m in range(*thing))
    if not fits or linked or nouns.longest(inside[1:]) is None:
        return None
    joined = start - (start > 0 and words[start - 1] in (",", "with", "while", ":", "and"))
    joined -= joined > 0 and words[joined] in ("with", "and", "while") and words[joined - 1] == ","
    return _Between(start=joined, end=end, thing=thing, noun=noun)


def _counted(words: Sequence[str], told: _Between, nouns: Nouns) -> tuple[tuple[int, int], int] | None:
    """First and last word of the name of several of which `told` speaks, and how many they are; None without."""
    made: list[tuple[tuple[int, int], int]] = []
    for at, word in enumerate(words):
        if told.start <= at < told.end or not (name := nouns.match([word])) or not name.plural:
            continue
        first = at
        while first and is_modifier(words[first - 1]) and not number_of(words[first - 1]):
            first -= 1
        number = number_of(words[first - 1]) if first else 0
        wanted = nouns.match([told.noun]) if told.noun else name
        if number and wanted is not None and wanted.noun == name.noun:
            made.append(((first, at), number))
    return made[0] if len(made) == 1 else None
