"""Meals as things: "a tray with breakfast" has a few things that are usual, "a meal of a roll and two eggs" has those.

"Set the table for dinner", "a lunch box" and "dinner is ready" tell of no things.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.generics import MEALS
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier, looks_like_adjective
from pat3d.plan.grammar.words.vocabulary import Nouns

_KINDS = {name.split()[1]: name for name in MEALS}
_UNNAMED = frozenset({"holder", "stand", "machine"})
"""Words of which an instruction does not say the kind, which is assumed then; a description has to say it."""
_NO_THING = frozenset({"for", "after", "before", "during", "at", "until", "than", "as", "ready", "to", "every"})
"""Words before a meal that is a time, or one that was told of before."""
_OF = tuple(tuple(said.split()) for said in (
    "consisting of", "made up of", "composed of", "made of", "of", "with", "including",
))  # fmt: skip
_ARTICLES = frozenset({"a", "an", "some", "one", "the"})
_MAKING = frozenset({"making", "having", "cooking", "eating", "preparing", "serving", "ordering", "serve", "make"})
_TALKING = frozenset({"i", "we", "i'm", "we're", "picture", "imagine", "envision", "visualize", "visualise", "it's",
    "like", "as"})  # fmt: skip
_JOINTS = frozenset({"and", "for", "consisting"})
_READY = frozenset({"ready", "served", "prepared", "over", "late", "finished", "cooking"})


def served(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with the meals that are things in words of a kind, or as the list of what they consist of."""
    made: list[Token] = []
    words = [token.text for token in tokens]
    at = 0
    while at < len(tokens):
        first = _adjectives_before(made)
        lead = made[first - 1].text if first else ""
        deed = any(token.text in _MAKING for token in made[first:])
        alone = words[at] in _UNNAMED and words.count(words[at]) == 1 and not nouns.match(words[at - 1 : at + 1])
        alone = alone and all(is_colour_word(token.text) for token in made[first:])
        if alone and lead == "the" and known_verb(words[0]) and not nouns.match(words[at : at + 2]):
            # "Put the bottle on the stand"
            made.append(replace(tokens[at], text=f"unnamed {words[at]}"))
            at += 1
            continue
        if words[at] not in _KINDS or words[at] in words[:at] or deed or not _is_thing(tokens, at, lead, nouns):
            made.append(tokens[at])
            at += 1
            continue
        size = _told(tokens, at + 1, nouns)
        article = first - (lead in _ARTICLES)
        if size:
            del made[article:]
            at += 1 + size
            continue
        # "All of the groceries"
        article -= next(
            (n for n in (2, 1) if [each.text for each in made[article - n : article]] == ["all", "of"][:n]), 0
        )
        made[article:first] = []
        made.append(replace(tokens[at], text=_KINDS[words[at]]))
        at += 1
    return made


def _adjectives_before(made: Sequence[Token]) -> int:
    """Where the adjectives begin that `made` ends in: "simple" of "a simple"."""
    first = len(made)
    while first and (is_modifier(made[first - 1].text) or looks_like_adjective(made[first - 1].text)):
        first -= 1
    return first


def _is_thing(tokens: Sequence[Token], at: int, lead: str, nouns: Nouns) -> bool:
    """Whether the meal at `at`, before whose adjectives `lead` stands, is there to be placed."""
    after = tokens[at + 1]
    ends = after.mark or after.text in FINITE | _JOINTS or link_at(tokens, at + 1) > 0
    told = after.text in FINITE and tokens[at + 2].text in _READY and not link_at(tokens, at + 3)
    bagged = lead == "of" and tokens[at - 2].text in ("bag", "bags")
    named = bool(lead) and nouns.match([lead, tokens[at].text]) is not None
    spoken = lead in _NO_THING | lexicon.POSSESSIVES or not _placed(tokens, at)
    return ends and not (told or bagged or named or spoken)


def _placed(tokens: Sequence[Token], at: int) -> bool:
    """Whether what is said around token `at` relates things, and is no talk: "we are having lunch"."""
    start = next((n + 1 for n in range(at, -1, -1) if tokens[n].text in (".", ":")), 0)
    stop = next(n for n in range(at, len(tokens)) if tokens[n].text in (".", ":"))
    related = any(link_at(tokens, n) and tokens[n].text not in ("of", "for") for n in range(start, stop))
    return related and tokens[start].text not in _TALKING


def _told(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The size of "consisting of" at `at`, where a list of things follows; 0 where none does."""
    words = [token.text for token in tokens]
    size = next((len(said) for said in _OF if tuple(words[at : at + len(said)]) == said), 0)
    behind = words[at + size : at + size + 4]
    counted = bool(behind) and (behind[0] in lexicon.DETERMINERS | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys())
    named = any(nouns.match([word]) is not None for word in behind)
    return size if size and named and (counted or words[at] != "with") else 0
