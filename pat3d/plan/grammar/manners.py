"""What only tells how things look or are sorted: "in the style of Van Gogh", "by height". Each is named in a note."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar import lexicon
from pat3d.plan.grammar.boundaries import link_at
from pat3d.plan.grammar.denials import Told
from pat3d.plan.grammar.lexing import Token, singulars
from pat3d.plan.grammar.links import FINITE
from pat3d.plan.grammar.numbered import LABELLED, labels_end
from pat3d.plan.grammar.vocabulary import Nouns

_STYLES = (("in", "the", "style", "of"), ("in", "the", "manner", "of"), ("in", "style", "of"))
_MEASURES = frozenset({"height", "size", "length", "width", "weight", "age", "brightness", "volume"})
_CLEARING = frozenset({"clear", "remove", "take", "move", "clean", "wipe"})
_EVERYTHING = frozenset({"everything", "anything", "all"})


def without_manners(tokens: Sequence[Token], nouns: Nouns) -> Told:
    """`tokens` of one sentence, which ends in a stop, without what tells only of looks and order."""
    words = [token.text for token in tokens]
    for told in (_style, _labels, _by_measure, _such_that, _alternate, _all_but):
        if (found := told(tokens, words, nouns)) is not None:
            kept, left_out = found
            rest, more = without_manners(kept, nouns)
            return rest, [*left_out, *more]
    return list(tokens), []


def _style(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "a chair in the style of Van Gogh stands" as "a chair stands"."""
    for at in range(1, len(words) - 2):
        size = next((len(said) for said in _STYLES if tuple(words[at : at + len(said)]) == said), 0)
        if not size:
            continue
        begun = range(at + size + 1, len(words))
        end = next(n for n in begun if tokens[n].mark or words[n] in FINITE or _goes_on(tokens, n, nouns))
        return [*tokens[:at], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def _goes_on(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether something else is told of from token `at` on: "with a cushion", "and a table", not "and the Greeks"."""
    if tokens[at].text == "and":
        end = next(n for n in range(at, len(tokens)) if tokens[n].mark)
        return any(nouns.match([token.text]) is not None for token in tokens[at + 1 : end])
    return link_at(tokens, at) > 0 or tokens[at].text in lexicon.RELATIVES | {"with", "holding", "holds"}


def _labels(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "three bins labelled A, B and C in a row" as "three bins in a row"."""
    for at in range(2, len(words) - 3):
        if words[at] in LABELLED and nouns.match([words[at - 1]]) and (end := labels_end(tokens, at)):
            return [*tokens[:at], *tokens[end:]], [(tokens[at], tokens[end - 1])]
    return None


def _by_measure(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "line up the cups by height" as "line up the cups"."""
    for at in range(2, len(words) - 2):
        if words[at] == "by" and words[at + 1] in _MEASURES and tokens[at + 2].mark:
            return [*tokens[:at], *tokens[at + 2 :]], [(tokens[at], tokens[at + 1])]
    return None


def _such_that(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "put three cans in a box such that the red one is on the left" without the second clause.

    It may name nothing new: of "such that a fork lies beside it" the fork is there.
    """
    at = next((n for n in range(3, len(words) - 3) if words[n : n + 2] == ["such", "that"]), 0)
    if not at:
        return None
    named = set(words[:at])
    for n in range(at + 2, len(words) - 1):
        again = named & {words[n], words[n] + "s", *singulars(words[n])}
        if words[n] in ("a", "an", "another") or (nouns.match([words[n]]) is not None and not again):
            return None
    start = at - (words[at - 1] == ",")
    return [*tokens[:start], tokens[-1]], [(tokens[at], tokens[-2])]


def _alternate(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "three red cups and three blue cups alternate in a row" as "... are in a row"."""
    at = next((n for n in range(3, len(words) - 2) if words[n] == "alternate" and link_at(tokens, n + 1)), 0)
    if not at or words[at - 1] in lexicon.RELATIVES or nouns.match([words[at - 1]]) is None:
        return None
    return [*tokens[:at], replace(tokens[at], text="are"), *tokens[at + 1 :]], [(tokens[at], tokens[at])]


def _all_but(tokens: Sequence[Token], words: list[str], nouns: Nouns) -> Told | None:
    """Read "clear everything off the desk except the laptop" as "the laptop is on the desk"."""
    at = next((n for n in range(3, len(words) - 2) if words[n] == "except"), 0)
    clears = words[0] in _CLEARING and words[1] in _EVERYTHING and words[2] in ("off", "from")
    if not (at and clears and words[3] in lexicon.DETERMINERS) or at > 6:
        return None
    start = at + 1 + (words[at + 1] == "for")
    place = tokens[3:at]
    if words[start] not in lexicon.DETERMINERS or any(link_at(tokens, n) or tokens[n].text == "one"
                                                     for n in range(start, len(tokens))):  # fmt: skip
        return None
    on = [replace(tokens[at], text=word) for word in ("are" if "and" in words[start:] else "is", "on")]
    return [*tokens[start:-1], *on, *place, tokens[-1]], [(tokens[0], tokens[-2])]
