"""What several have evenly between them, as how many each has: "six apples divided equally between two bowls"."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import counted_before, number_of, numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_DIVIDED = frozenset({"split", "divided", "distributed", "shared", "spread"})
_EVENLY = frozenset({"equally", "evenly"})
_IN_ALL = (("in", "total"), ("in", "all"), ("altogether",), ("overall",), ("in", "each"))
_GROUPS = frozenset({"groups", "clusters"})
_SIDES = re.compile(
    r" , (\w+) (?:on|along|at) (?:each|either|both) (?:long |longer )?sides?(?: of (?:the )?\w+)?(?: ,)? and (\w+)"
    r" (?:on|at) (?:each|either|both) (?:short |shorter )?(?:end|side)s?(?: of (?:the )?\w+)?(?= [,.;])"
)


def shared(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "six apples divided equally between two bowls" as "three apples in each of two bowls"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 3):
        if words[at] not in _DIVIDED:
            continue
        first = at - (words[at - 1] in _EVENLY)
        between = at + 1 + (words[at + 1] in _EVENLY)
        evenly = between > at + 1 or first < at
        among = words[between : between + 1] in (["between"], ["among"], ["over"], ["across"])
        number = between + 1 + (words[between + 1] == "the")
        holders = number_of(words[number]) if number < len(words) else 0
        start = next((n for n in range(first - 1, -1, -1) if number_of(words[n])), None)
        if not (evenly and among and holders and start is not None) or number_of(words[start]) % holders:
            continue
        name = next((n for n in (3, 2, 1) if nouns.match(words[start + 1 : start + 1 + n])), 0)
        if not name:
            continue
        share = number_of(words[start]) // holders
        told = [replace(tokens[between], text=text) for text in ("in", "each", "of")]
        amount = replace(tokens[start], text="one" if share == 1 else str(share))
        return [*tokens[:start], amount, *tokens[start + 1 : start + 1 + name], *told, *tokens[number:]]
    return list(tokens)


def counted_in_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "six apples, two in each of three bowls" as "two apples in each of three bowls".

    Where the shares do not make up the whole they are left as they are: the audit compares them with the plan.
    """
    tokens = _counted_behind(tokens, nouns)
    words = [token.text for token in tokens]
    for each in range(4, len(words) - 2):
        share = each - next((n for n in (3, 2, 1) if link_at(tokens, each - n) == n), each) - 1
        share -= 2 * (words[share - 1 : share + 1] in (["of", "them"], ["of", "these"], ["of", "which"]))
        if words[each] != "each" or share < 3:
            continue
        end = share - (words[share - 1] in ("with", "namely"))
        end -= tokens[end - 1].mark
        start = next((n for n in range(end - 1, -1, -1) if number_of(words[n])), None)
        if start is None or end == share:
            continue
        first = start + 1
        while first < end - 1 and is_modifier(words[first]) and not nouns.match(words[first:end]):
            first += 1
        amount = 1 if words[share] == "one" else number_of(words[share])
        if nouns.match(words[first:end]) and amount * _carriers(tokens, each) == number_of(words[start]):
            behind = share + (3 if words[share + 1] == "of" else 1)
            return [*tokens[:start], replace(tokens[start], text=words[share]), *tokens[start + 1 : end],
                    *tokens[behind:]]  # fmt: skip
    return list(tokens)


def _counted_behind(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a row of jars, five in total" as "a row of five jars", where nothing else is uncounted.

    So is "two groups of jars, three in each group" "two groups of three jars".
    """
    made = list(tokens)
    for at in range(len(tokens) - 3, 1, -1):
        words = [token.text for token in made]
        said = at + 1 + (nouns.match([words[at + 1]]) is not None)
        size = next((len(each) for each in _IN_ALL if tuple(words[said : said + len(each)]) == each), 0)
        if words[at - 1] != "," or not number_of(words[at]) or not size:
            continue
        start = next((n + 1 for n in range(at - 1, -1, -1) if words[n] == "."), 0)
        share = words[said + 1] == "each"
        end = said + size + (share and words[said + 2] in ("group", "cluster"))
        # "Two books on a shelf with vases, five in total" may be of either.
        named = [n for n in range(start, at - 1) if (found := nouns.match([words[n]])) is not None and found.plural]
        if len(named) != 1 or not made[end].mark or (share and not _GROUPS & {*words[start : named[0]]}):
            continue
        first = named[0]
        while first > start and is_modifier(words[first - 1]):
            first -= 1
        if first > start and (number_of(words[first - 1]) or words[first - 1] in ("the", "and")):
            continue
        after = end + (words[end] == ",")
        made = [*made[:first], made[at], *made[first : at - 1], *made[after:]]
    return made


def without_shares(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` without ", three on each side and one at either end" behind "eight chairs around a table".

    The audit names it.
    """
    words = [token.text for token in tokens]
    if sides := _SIDES.search(said := " ".join(words)):
        first, size = said[: sides.start()].count(" "), sides[0].count(" ")
        if 2 * sum(map(numeral, sides.groups())) in map(number_of, words[:first]):
            return [*tokens[: first + 1], *tokens[first + 1 + size :]]
    return list(tokens)


def _carriers(tokens: Sequence[Token], each: int) -> int:
    """How many there are of what "each" at token `each` is said of: "each of three bowls", "each bowl"."""
    words = [token.text for token in tokens]
    after = each + 1 + (words[each + 1] == "of") + ("the" in words[each + 1 : each + 3])
    named = words[min(after, len(words) - 1)]
    if words[each + 1] == "of":
        return number_of(named) or counted_before(tokens, each, named)
    several = [token.text for token in tokens[:each] if named in singulars(token.text)]
    return counted_before(tokens, each, several[-1]) if several else 0
