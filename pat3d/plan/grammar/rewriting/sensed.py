"""What is only smelled, heard, tasted or felt: "it smells like oil", "the sound of a piano fills the room"."""

from __future__ import annotations

from collections.abc import Sequence

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.unmade import base_verb, is_quality
from pat3d.plan.grammar.words.vocabulary import Nouns

_SENSING = frozenset({"smell", "sound", "taste", "feel", "reek", "stink"})
_SENSED = frozenset({"smell", "scent", "aroma", "odour", "odor", "fragrance", "sound", "sounds", "noise", "taste",
    "flavour", "flavor", "whiff"})  # fmt: skip
_LED = lexicon.DETERMINERS | lexicon.POSSESSIVES
_AROUND = _LED | lexicon.RELATIVES | lexicon.COPULAS | {"with", "faint", "faintly", "strongly", "slightly"}
"""Words before what is sensed that go with it."""


def sensed(tokens: Sequence[Token], nouns: Nouns) -> list[Span]:
    """Where one sentence tells of what is only sensed."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3):
        noun = words[at] in _SENSED and words[at + 1] == "of"
        doing = base_verb(words[at]) or words[at].removesuffix("s")
        verb = at and doing in _SENSING and words[at + 1] in ("like", "of") and words[at - 1] not in ("i", "we")
        if not noun and not verb:
            continue
        start, end = at, _listed(tokens, at + 2, nouns)
        while start and (words[start - 1] in _AROUND or is_quality(words[start - 1])):
            start -= 1
        # "The scent of oranges fills the room", "hangs over the table"
        end += bool(noun) and not (tokens[end].mark or words[end] == "and" or link_at(tokens, end))
        size = link_at(tokens, end) if noun else 0
        where = bool(size) and is_quality(words[end + size + 1])
        # "With the smell of bread in the air, a cup ..."
        end += size + 2 * where if where or words[end - 1] in FINITE else 0
        end += words[end] == "," and (not start or words[start - 1] == ",")
        return [(start - (start > 0 and words[start - 1] == "," and tokens[end].mark), end)]
    return []


def _listed(tokens: Sequence[Token], end: int, nouns: Nouns) -> int:
    """The end of the list from token `end` on of what is sensed, which goes on with articles or without any."""
    led, words = tokens[end].text in _LED, [token.text for token in tokens]
    while (end := end + 1) < len(tokens) - 1:
        joint = 0 if words[end] not in (",", "and") else 1 + (words[end + 1] == "and")
        alike = (words[end + joint] in _LED) == led and not (led and words[end] == ",")
        verb = words[end] in FINITE or (base_verb(words[end]) and not nouns.match([words[end]]))
        if (joint and not alike) or (not joint and (verb or tokens[end].mark or words[end] in _AROUND)):
            break
        if link_at(tokens, end):
            break
        end += joint + led - 1 if joint else 0
    return end
