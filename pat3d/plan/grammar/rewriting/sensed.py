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
_SENSED = frozenset({"smell", "smells", "scent", "scents", "aroma", "aromas", "odour", "odor", "fragrance", "sound",
    "sounds", "noise", "noises", "taste", "flavour", "flavor", "whiff"})  # fmt: skip
_ARTICLES = lexicon.DETERMINERS | lexicon.POSSESSIVES
_AROUND = _ARTICLES | lexicon.RELATIVES | lexicon.COPULAS | {"with", "faint", "faintly", "strongly", "slightly"}
"""Words before what is sensed that go with it."""


def sensed(tokens: Sequence[Token], nouns: Nouns) -> list[Span]:
    """Where one sentence tells of what is only sensed."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 3):
        noun = words[at] in _SENSED and words[at + 1] == "of"
        verb = base_verb(words[at]) or words[at]
        if not noun and not (verb in _SENSING and words[at + 1] in ("like", "of") and at):
            continue
        start, end = at, _listed(tokens, at + 2, nouns)
        while (start and words[start - 1] in _AROUND) or (is_quality(words[start - 1]) and start):
            start -= 1
        if noun and not tokens[end].mark and words[end] != "and" and not link_at(tokens, end):
            # "The scent of oranges fills the room", "hangs over the table"
            end += 1
        size = link_at(tokens, end)
        if noun and size and (words[end - 1] in FINITE or is_quality(words[end + size + 1])):
            # "With the smell of bread in the air, a cup ..."
            end += size + 2 * is_quality(words[end + size + 1])
        end += words[end] == "," and (not start or words[start - 1] == ",")
        return [(start - (start > 0 and words[start - 1] == "," and tokens[end].mark), end)]
    return []


def _listed(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The end of the list of what is sensed from token `at` on, which goes on as it begins, with articles or none."""
    led, end = tokens[at].text in _ARTICLES, at + 1
    while end < len(tokens) - 1:
        joint = 0 if tokens[end].text not in (",", "and") else 1 + (tokens[end + 1].text == "and")
        alike = (tokens[end + joint].text in _ARTICLES) == led and not (led and tokens[end].text == ",")
        ends = (tokens[end].mark and not joint) or tokens[end].text in FINITE | _AROUND or link_at(tokens, end)
        verb = not joint and base_verb(tokens[end].text) and not nouns.match([tokens[end].text])
        if ends or verb or (joint and not alike):
            break
        end += joint + led if joint else 1
    return end
