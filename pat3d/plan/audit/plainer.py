"""A prompt in plainer words before it is compared: turns of phrase that name and claim nothing by their words."""

from __future__ import annotations

import re
from collections.abc import Callable

from pat3d.plan.audit.stacks import with_levels
from pat3d.plan.audit.words import NUMBERS
from pat3d.plan.english import set_apart

_EMPTY = "(?:empty|bare|clear|free|clean)"
_SIDE = "(?:two|three|four|five|six|seven|eight|nine)"
_PICTURE = "(?:picture|photo|image|photograph|scene)"
_DEPICTS = "(?:shows|depicts|displays|features|contains|presents|has|showing|depicting|displaying)"
_SEVERAL = "|".join(NUMBERS)
_LABEL = re.compile(r"\b([a-z]+) ([1-9]|[a-h])\b(?! [a-z]+(?:s|ing)\b)")
_RANKS = ("first", "second", "third", "fourth", "fifth")
_COUNTED = re.compile(r"\b(\d+) \((\w+)\)")
_PLAINER = tuple((re.compile(said), plain) for said, plain in (
    (rf"\b{_SIDE} by {_SIDE}(?= grid\b)|(?<=\bgrid of ){_SIDE} by {_SIDE} ", ""),
    (r"\b((?:night ?|tv |coat |cake |hat)stand)\b(.*)\bthe stand\b", r"\1\2the \1"),
    (r"\bsuch that\b", "so that"),
    (r"\b(?:equal|even|neat|tidy|separate|identical) (?=(?:stacks|piles|towers|rows)\b)", ""),
    (r"\bthe (?:outer (?:ones|two|pair)|two outer ones)(?= (?:are|have|hold|stand)\b)", "the first and last"),
    (r"\b(built|made|tower|stack|pile|row|pyramid) out of\b", r"\1 of"),
    (r"(?:\ban? )?\b(?!and |with |in |on |of )([a-z]{3,}) [(]?x(\d{1,2})\b[)]?", r"\2 \1"),
    (r"\bx(\d{1,2})\b", r"\1"),
    (rf"(^|[.] )(?:throw|toss|chuck|pop) in (?=(?:an?|some|another|{_SEVERAL})\b)", r"\1"),
    (r"\b(\d+) ?pcs?[.]? of ", r"\1 "),
    (r"\bw/o(?=\s)", "without"),
    (r"\bw/(?=\s)", "with"),
    (r"\b(?:twice|half|[a-z]+ times) (?=as many\b)", ""),
    (r"\bas many ((?:[a-z-]+ ){1,3})as\b", r"\1and"),
    (r"\bas many\b(?! as\b)", "several"),
    (r", such as\b", ","),
    (rf"\b(?:(?:\d+|{_SEVERAL}) )?\w+ such as\b ?|,? (?:and )?etc\b[.]?", ""),
    (r"\bnothing (?:but |except |else is (?!.*\bbut\b)[^.;:,]*)", ""),
    (rf"\b(?:is|are) {_EMPTY} (?:except|apart|aside|but|save)(?: for| from)?\b", "holds"),
    (r"\bnot far (?:away )?from\b", "near"),
    (r"\bthere (?:appear|seem|happen)s? to be\b", "there is"),
    (r"\breach for\b", "take"),
    (r"\b(is|are|was|were) out of\b", r"\1 outside"),
    (r"\bin (?:all )?(?:the )?(?:rainbow colou?rs|colou?rs of the rainbow)\b", ""),
    (rf"\b(?:this|the) {_PICTURE} (?:looks like|is of)\b", ""),
    (rf"^(?:this|the|an?) {_PICTURE} {_DEPICTS} (?=(?:an?|the|some|several|{_SEVERAL})\b)", ""),
    (rf"\bin (?:this|the) {_PICTURE}(?=\s*(?:[.;!?]|$)|,? (?:i|we|you|one|there)\b)", ""),
    (r"\b(?:in|into) (?:half|halves|pieces|slices|quarters)\b", ""),
    (r"\b(left|right), of\b", r"\1 of"),
    (r"(?<![\w-])\d{1,2}- (?=[a-z])", ". "),
))  # fmt: skip
"""What is said, and the same in plainer words, in the order in which they are replaced."""


def plainer(prompt: str, find: Callable[[str], str | None]) -> str:
    """`prompt` in lower case and in plainer words; `find` gives the noun that a name means, or None."""
    prompt = re.sub(r"(?<=[^\W\d_])\((e?s)\)", r"\1", set_apart(prompt)).replace("\u2019", "'").lower()
    prompt = _COUNTED.sub(lambda it: it[1] if str(NUMBERS.get(it[2])) == it[1] else it[0], prompt)
    for said, plain in _PLAINER:
        prompt = said.sub(plain, prompt)
    return _ranked(with_levels(prompt), find)


def _ranked(prompt: str, find: Callable[[str], str | None]) -> str:
    """`prompt` with "bin 1 and bin 2" as "first bin and second bin"."""
    labels: dict[str, set[str]] = {}
    for name, label in _LABEL.findall(prompt):
        if find(name):
            labels.setdefault(name, set()).add(label)

    def told(match: re.Match[str]) -> str:
        each = sorted(labels.get(match[1], ()))
        ranked = 2 <= len(each) <= len(_RANKS)
        return f"{_RANKS[each.index(match[2])]} {match[1]}" if ranked else match[0]

    return _LABEL.sub(told, prompt)
