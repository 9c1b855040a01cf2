"""What stands around a scene: who wishes for it, asks for it or imagines it. "Can you make me a scene where ..."."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.vocabulary import Nouns

_MAKING = (
    r"(?:make(?! (?:me |us )?an? (?:tower|stack|pile|row|line|column|pyramid|circle|ring))|create|generate|draw|design"
    r"|render|produce|model|set up|show|imagine|give)(?: me| us)?"
)
_TAKEN = (
    r"(?: (?:is |was |has been )?(?:taken|shot|seen|captured|viewed)(?: (?:from )?(?:the |an? )?[a-z]+)?(?: and)?)?"
)
"""How a picture was made."""
_FRAMES = "|".join((
    rf"(?:please )?(?:can|could|would|will) (?:you|we)(?: please| kindly| maybe)? {_MAKING}",
    r"(?:can|could|may|might) (?:i|we)(?: please)? (?:have|get|see)",
    rf"(?:i|we|i'd|we'd|i'll|we'll)(?: can| would| could| should| will| do)?(?: really| just| also)? (?:want|need|like"
    rf"|love|prefer|imagine|picture|have|see|use|count)(?: (?:you )?to (?:see|have|get|{_MAKING}))?",
    r"(?:i'm|we're|i am|we are) (?:thinking of|imagining|picturing|looking for|looking at|envisioning)",
    r"(?:let's|let us|lets) (?:have|see|imagine|picture|say|create|add)",
    r"(?:think of|imagine|picture|consider|suppose|envision|visuali[sz]e)(?: that)?",
    r"make it(?: so that| so| such that)?",
    r"have(?! the )",
    r"(?:maybe|perhaps|how about|what about)",
    r"there(?: ought to| has to| have to| needs to| need to| could| might| may| would| will) be",
    r"(?:is it|would it be) possible to (?:have|see|get)",
    r"(?:one|you) (?:(?:can |could )?see|have)",
    r"(?:show|give) (?:me|us)(?: something like)?",
    r"(?:(?:can|could|may|might) there (?:be|are)|(?:here|there) there are)",
    r"(?:make sure|ensure)(?: that)? there (?:is|are)",
    r"the robot (?:finds|will find|should find)",
    r"(?:this is|it is|it's|it shows|this shows)",
    rf"(?:the|this|our|my) (?:[a-z]+ )?(?:picture|image|photo|photograph|scene|shot|rendering|render){_TAKEN}"
    r" (?:shows|has|contains|consists of|depicts|displays|features|presents|captures|includes|looks like|is of)",
    r"an? (?:[a-z]+ )?(?:photo|photograph|image|picture|shot) (?:showing|depicting|displaying)",
    r"(?:an? )?(?:[a-z-]+ (?:, )?){0,3}(?:shot|view|close-up|closeup|image|photo|photograph|photography)"
    r" (?:captures|capturing|reveals)",
    r"one of the (?:pictures|images|photos|photographs|scenes|shots) (?:shows|depicts|displays|features|captures)",
    r"(?:take|have) a(?: [a-z]+)? look at",
))  # fmt: skip
_SCENE = (
    r"(?:(?:please )?(?:create|generate|make|design|render|draw|set up|show|build|produce|depict)(?: me| us)? )?"
    r"(?:a|the|this|some) (?:[a-z]+ )?(?:scene|scenario|setup|set-up|situation|environment|image|simulation)"
    r"(?: where| in which| that (?:has|contains|shows|includes)| :)"
)
_THERE = r"(?: there (?:is|are))?"
_OPENING = tuple(
    re.compile(rf"(?:{said}) ") for said in (rf"(?:{_FRAMES})(?: {_SCENE}{_THERE})", rf"{_SCENE}{_THERE}", _FRAMES)
)
_LONGEST = 16
"""Words of the longest frame."""
_OWNERS = frozenset({"i", "we"})
_HAVING = frozenset({"have", "keep", "see", "want", "need", "find"})
_DUTIES = (("has", "to"), ("have", "to"), ("needs", "to"), ("need", "to"), ("ought", "to"))


def begun(tokens: Sequence[Token], at: int, nouns: Nouns) -> int:
    """The token from `at` on where the scene begins behind who wishes for it; `at` where nobody does."""
    words = [token.text for token in tokens[at : at + _LONGEST]]
    told = f"{' '.join(words)} "
    for pattern in _OPENING:
        if (found := pattern.match(told)) is None:
            continue
        after = at + len(found.group().split())
        if after < len(tokens) - 1 and _begins(tokens, after, nouns):
            return after
    return at


def _begins(tokens: Sequence[Token], at: int, nouns: Nouns) -> bool:
    """Whether a phrase that names or counts something begins at token `at`."""
    word = tokens[at].text
    leads = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
    plural = bool(singulars(word)) and nouns.match([word]) is not None
    return word in leads or word.isdecimal() or plural


def owned(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "on my desk I have a lamp" as "on my desk there is a lamp"."""
    words = [token.text for token in tokens]
    if not link_at(tokens, 0):
        return list(tokens)
    at = next((n for n in range(2, min(len(words) - 2, 9)) if words[n] in _OWNERS and words[n + 1] in _HAVING), 0)
    if not at or any(tokens[n].mark and n != at - 1 for n in range(at)):
        return list(tokens)
    there = [replace(tokens[at], text="there"), replace(tokens[at + 1], text="is")]
    return [*tokens[: at - tokens[at - 1].mark], *there, *tokens[at + 2 :]]


def without_duties(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a fork has to be on the left" as "a fork is on the left", and "that's got" as "that has"."""
    words = [token.text for token in tokens]
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        duty = tuple(words[at : at + 2]) in _DUTIES and words[at + 2 : at + 3] == ["be"] and link_at(tokens, at + 3)
        got = words[at] in ("'s", "has", "have") and words[at + 1 : at + 2] == ["got"] and at > 0
        if duty and at:
            made.append(replace(tokens[at], text="is", end=tokens[at + 2].end))
            at += 3
        elif got:
            made.append(replace(tokens[at], text="have" if words[at] == "have" else "has", end=tokens[at + 1].end))
            at += 2
        else:
            made.append(tokens[at])
            at += 1
    return made
