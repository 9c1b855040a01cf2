"""Which of two kinds there are more of: "more cups than plates on the shelf" are several cups and some plates there.

Where one of the two is counted elsewhere the other is counted by it: "three spoons and two more forks than spoons".
Where both are, nothing is added: the audit says where what is counted is otherwise.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pat3d.plan.grammar.rewriting.numbers_compared import plainly_compared
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_OPENING = frozenset({"are", "were", "is", "being", "has", "have", "holds", "hold", "contains", "contain", "with",
                      "there", "and", "put", "place", "add", "set"})  # fmt: skip
_ENDING = FINITE | {"and"}
_MORE = {"more": 1, "fewer": -1, "less": -1}
_WORDS = {1: ("several", "some"), -1: ("some", "several")}
"""What there are of either where nothing counts them."""
_LONGEST = 12
"""Words from "more" to the name behind "than"."""
_LEADS = frozenset({"there", "are", "is", "being", "were", "with", "and", "but", ",", "so", "that"})


@dataclass(frozen=True, kw_only=True)
class _Comparison:
    at: int
    """Its first token: "more", "two" of "two more", "as" of "as many"."""
    end: int
    more: int
    """How many more there are of the first; 0 for "as many"."""
    exact: bool
    """Whether it says how many more."""
    first: Span
    place: Span
    """Where the first are, between the two names."""
    second: Span


@dataclass(frozen=True, kw_only=True)
class _Counted:
    """What of a comparison stands elsewhere."""

    start: int
    """The token where the name, or the number before it, begins."""
    behind: int
    """The token behind the number."""
    number: int
    told: bool
    """Whether the number is said."""


def outnumbering(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "there are more mugs on the tray than pens" as "there are several mugs and some pens on the tray".

    How many of each is assumed so that the one kind outnumbers the other.
    """
    made = plainly_compared(tokens)
    for at in range(len(made) - 4, -1, -1):
        found = _comparison(made, at, nouns) if at < len(made) - 3 else None
        if found is not None:
            made = _rewritten(made, found)
    return made


def _comparison(tokens: Sequence[Token], at: int, nouns: Nouns) -> _Comparison | None:
    """The comparison that begins at token `at`, or None."""
    words = [token.text for token in tokens[at : at + 3]]
    exact = words[1] in _MORE and numeral(words[0]) > 0
    equal = words[:2] == ["as", "many"]
    opens = not at or tokens[at - 1].text in _OPENING or tokens[at - 1].mark
    if not opens or not (exact or equal or words[0] in _MORE):
        return None
    start = at + 1 + (exact or equal)
    than = next((n for n in range(start + 1, min(at + _LONGEST, len(tokens) - 1))
                 if tokens[n].text == ("as" if equal else "than")), 0)  # fmt: skip
    if not than or any(each.mark for each in tokens[at:than]) or than + 4 > len(tokens):
        return None
    place = next((n for n in range(start + 1, than) if link_at(tokens, n)), than)
    second = than + 1 + 2 * (tokens[than + 1].text == "there")
    second += tokens[second].text == "the"
    end = second
    while end < len(tokens) and not (tokens[end].mark or link_at(tokens, end) or tokens[end].text in _ENDING):
        end += 1
    more = 0 if equal else numeral(words[0]) * _MORE[words[1]] if exact else _MORE[words[0]]
    named = (second, end) if end > second else (start, place) if place < than else (second, second)
    if not (_names(tokens[start:place], nouns) and _names(tokens[slice(*named)], nouns)):
        return None
    return _Comparison(at=at, end=end, more=more, exact=exact, first=(start, place), place=(place, than), second=named)


def _names(tokens: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `tokens` name something: "green mugs"."""
    return bool(tokens) and nouns.longest([token.text for token in tokens]) is not None


def _rewritten(made: list[Token], it: _Comparison) -> list[Token]:
    """`made` with what `it` says counted."""
    if it.second == it.first:
        return made
    if numeral(made[it.second[0]].text):
        return made
    first, second = (_elsewhere(made, it, span) for span in (it.first, it.second))
    if first is not None and second is not None:
        return _restated(made, it, first, second)
    if second is not None and second.told and (second.number + it.more) > 0:
        return _one_counted(made, it, it.first, second.number + it.more)
    if first is not None and first.told and (first.number - it.more) > 0:
        return _one_counted(made, it, it.second, first.number - it.more)
    if it.more == 0 and it.second[0] > it.place[1] + 2 and made[it.end].mark:
        # "As many forks as there are knives"
        return [*made[: it.place[1] + 1], *made[it.second[0] :]]
    if it.more == 0 or not (it.exact or all(singulars(made[end - 1].text) for _, end in (it.first, it.second))):
        return made
    many, some = _WORDS[1 if it.more > 0 else -1]
    if it.exact:
        counts = (str(lexicon.BARE_PLURAL + abs(it.more)), "some")
        many, some = counts if it.more > 0 else counts[::-1]
    joined = [replace(made[it.place[1]], text=word) for word in ("and", some)]
    counted = [replace(made[it.at], text=many), *_several(made, it.first), *joined, *_several(made, it.second)]
    return [*made[: it.at], *counted, *made[slice(*it.place)], *made[it.end :]]


def _several(made: list[Token], span: Span) -> list[Token]:
    """The name at `span`, of several: "one more fork" counts forks."""
    *looks, head = made[slice(*span)]
    return [*looks, head if singulars(head.text) else replace(head, text=f"{head.text}s")]


def _one_counted(made: list[Token], it: _Comparison, span: Span, number: int) -> list[Token]:
    """`made` with `number` of what stands at `span` in the place of the comparison `it`."""
    *looks, head = made[slice(*span)]
    single = singulars(head.text)[:1] if number == 1 else ()
    name = _several(made, span) if number > 1 else [*looks, replace(head, text=single[0]) if single else head]
    count = replace(made[it.at], text=_word(number, it))
    return [*made[: it.at], count, *name, *made[slice(*it.place)], *made[it.end :]]


def _word(number: int, it: _Comparison) -> str:
    """What `number` is put as: in a word of which a note says that it is assumed, where `it` does not tell it."""
    vague = {3: "some", 4: "several", 5: "many"} if it.more and not it.exact else {}
    return "one" if number == 1 else vague.get(number, str(number))


def _elsewhere(made: list[Token], it: _Comparison, span: Span) -> _Counted | None:
    """Where the name at `span` of comparison `it` stands before it or behind its colon, counted rather than not."""
    *looks, head = (token.text for token in made[slice(*span)])
    heads, found = {head, *singulars(head)}, list[_Counted]()
    for n, token in enumerate(made):
        told = n < it.at or (n > it.end and made[it.end].text == ":")
        if not told or not heads & {token.text, *singulars(token.text)}:
            continue
        start = n
        while start and is_modifier(made[start - 1].text) and not _counts(made[start - 1].text):
            start -= 1
        said, word = [token.text for token in made[start:n]], made[start - 1].text if start else ""
        if looks != said[len(said) - len(looks) :]:
            continue
        if numeral(word) or word in ("a", "an"):
            found.append(_Counted(start=start - 1, behind=start, number=numeral(word) or 1, told=True))
        elif word in lexicon.VAGUE:
            few = start - 1 - (start > 1 and made[start - 2].text == "a")
            found.append(_Counted(start=few, behind=start, number=lexicon.VAGUE[word], told=False))
        elif word not in lexicon.DETERMINERS | lexicon.POSSESSIVES and singulars(made[n].text):
            found.append(_Counted(start=start, behind=start, number=lexicon.BARE_PLURAL, told=False))
    return min(found, key=lambda one: (not one.told, one.start == one.behind), default=None)


def _counts(word: str) -> bool:
    return numeral(word) > 0 or word in lexicon.VAGUE or word in ("a", "an")


def _restated(made: list[Token], it: _Comparison, first: _Counted, second: _Counted) -> list[Token]:
    """`made` without the comparison `it` of two kinds that stand elsewhere, and there with numbers that it allows."""
    a, b = _allowed(it, first, second)
    told = _without(made, it)
    shift = len(told) - len(made)
    for one, number in sorted(((first, a), (second, b)), key=lambda each: -each[0].start):
        if number != one.number:
            at = shift if one.start >= it.end else 0
            count = replace(told[one.start + at], text=_word(number, it))
            told[one.start + at : one.behind + at] = [count]
    return told


def _allowed(it: _Comparison, first: _Counted, second: _Counted) -> tuple[int, int]:
    """How many there are of either: as `it` has them, where not both are counted."""
    a, b = first.number, second.number
    more = a - b
    fits = more == it.more if it.exact or not it.more else more * it.more > 0
    if fits or (first.told and second.told):
        return a, b
    if first.told:
        return a, max(a - it.more, 1)
    if second.told:
        return max(b + it.more, 1), b
    return lexicon.BARE_PLURAL + max(it.more, 0), lexicon.BARE_PLURAL + max(-it.more, 0)


def _without(made: list[Token], it: _Comparison) -> list[Token]:
    """`made` without the comparison `it`; what it says of where they are is kept."""
    lead = it.at
    while lead and made[lead - 1].text in _LEADS:
        lead -= 1
    place = made[slice(*it.place)]
    end = it.end
    while link_at(made, end) and not place and not made[end].mark:
        place = made[end : (end := next(n for n in range(end, len(made)) if made[n].mark))]
    opens = not lead or made[lead - 1].mark
    if place or (lead == it.at and not opens):
        the, both = replace(made[it.at], text="the"), replace(made[it.at], text="and")
        are = [replace(made[it.at], text="are")] if opens and lead < it.at else []
        there = [the, *_several(made, it.first), both, the, *_several(made, it.second), *are, *place]
        return [*made[: lead if are else it.at], *there, *made[end:]]
    if lead and made[lead - 1].mark:
        lead -= 1
    return [*made[:lead], *made[end + (not lead and (made[end].mark or made[end].text == "and")) :]]
