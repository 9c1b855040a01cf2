"""A part of several, as its number: "half of the six figs" is "three of the six figs", and so is "every second fig".

Of how many is not said, it is some of them, and a note says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

from pat3d.plan.english import plural
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.left_out import quoted
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_colour_word
from pat3d.plan.grammar.words.number_words import counted_before, number_of, numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_PARTS = {"half": 2, "halves": 2, "third": 3, "thirds": 3, "quarter": 4, "quarters": 4, "fifth": 5, "fifths": 5}
_EVERY = {"other": 2, "second": 2, "third": 3, "fourth": 4}
_OF_SEVERAL = {"is": "are", "has": "have", "holds": "hold", "contains": "contain", "stands": "stand", "lies": "lie",
               "carries": "carry", "bears": "bear", "sits": "sit"}  # fmt: skip
_ALL = frozenset({"the", "these", "those", "my", "all"})

Share = tuple[Fraction, int, list[Token]]
"""A share, where what it is of begins, and the words for that."""


def in_numbers(text: str, tokens: Sequence[Token], nouns: Nouns) -> tuple[list[Token], list[str]]:
    """`tokens` of `text` with parts of several as numbers, and notes of what is not known of them."""
    made, notes, at, start, whole, rest = list(tokens), list[str](), 0, 0, 0, ""
    while at < len(made) - 2:
        words = [token.text for token in made[at : at + 3]]
        start, whole, rest = (at + 1, 0, "") if words[0] == "." else (start, whole, rest)
        if rest and words == ["the", "other", "half"]:
            made[at + 2] = replace(made[at + 2], text=rest)
        if words[0] == "half" and is_colour_word(words[1]) and made[at - 1].text in (",", ":", "and") and (
                rest or (at > 1 and singulars(made[at - 2].text))):  # fmt: skip
            # "Six pens, half red, half blue"
            made[at + 1 : at + 1] = [replace(made[at], text=word) for word in ("of", "them")]
        every = _every(made, at, nouns)
        found = every or _part(made, at, start, nouns)
        at += 1
        if found is None:
            continue
        share, end, ones = found
        noun = ones[-1].text if ones and ones[-1].text not in ("them", "which") else ""
        number = next((number_of(token.text) for token in ones if number_of(token.text)), 0)
        # "Half of them red and half of them blue": both of all.
        here = number or (whole if not noun else 0) or counted_before(made[start : at - 1], at - 1 - start, noun)
        total = whole = here or counted_before(made, at - 1, noun)
        known = share * total >= 1 and (every is not None or (share * total).denominator == 1)
        if (every or not ones) and not known:
            continue
        count = int(share * total)
        said, rest = f'"{quoted(text, made[at - 1 : end + len(ones)])}"', str(total - count) if known else "ones"
        which = "; which ones is not modelled." if every else "."
        if not (known and here and share == Fraction(1, 2)) or every:
            notes.append(f"{said} is read as {count} of them{which}" if known else f"{said}: of how many is not said.")
        told = [("one" if count == 1 else str(count)) if known else "some", *(["of"] if ones else [])]
        if every:
            are = replace(made[end + 1], text=_OF_SEVERAL[made[end + 1].text])
            ones = [replace(made[end], text="them"), are]
        made[at - 1 : end + len(ones)] = [*(replace(made[at - 1], text=word) for word in told), *ones]
    return made, notes


def _part(tokens: Sequence[Token], at: int, start: int, nouns: Nouns) -> Share | None:
    """What "two thirds of the six figs" at token `at` is a share of, in the sentence that begins at `start`."""
    words = [token.text for token in tokens]
    first = at + (words[at] in ("a", "one") or numeral(words[at]) in (2, 3))
    share = Fraction(numeral(words[at]) or 1, _PARTS[words[first]]) if words[first] in _PARTS else Fraction(2)
    of = first + 1 + (words[first + 1] == "of")
    if share >= 1 or (at and words[at - 1] in (*_PARTS, "the", "a", "other")):
        return None
    if words[start : start + 2] == ["of", "the"] and words[of] in lexicon.COPULAS:
        # "Of the six figs, half are dry"
        return share, of, []
    if words[of] in ("them", "which") and of > first + 1:
        return share, of, list(tokens[of : of + 1])
    last = next((n for n in range(of + 1, min(of + 5, len(words))) if (found := nouns.match([words[n]]))
                 and found.plural), 0)  # fmt: skip
    led = words[of] in _ALL and (of > first + 1 or words[first] == "half") and "of" not in words[of:last]
    return (share, of, list(tokens[of : last + 1])) if last and led else None


def _every(tokens: Sequence[Token], at: int, nouns: Nouns) -> Share | None:
    """What "every second fig is" at token `at` is a share of: where that is named, and its plural."""
    words = [token.text for token in tokens[at : at + 4]]
    begins = not at or tokens[at - 1].mark or tokens[at - 1].text == "and"
    if not begins or words[0] != "every" or words[1] not in _EVERY or words[3] not in _OF_SEVERAL:
        return None
    found = nouns.match(words[2:3])
    several = plural(words[2]) if found is not None and not found.plural else ""
    if words[2] == "one":
        # "Six cups in a row, every second one is red"
        before = (token.text for token in reversed(tokens[:at]) if singulars(token.text))
        several = next((word for word in before if nouns.match([word])), "")
    return (Fraction(1, _EVERY[words[1]]), at + 2, [replace(tokens[at + 2], text=several)]) if several else None
