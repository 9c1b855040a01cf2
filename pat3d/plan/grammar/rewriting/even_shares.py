"""What several have in all and each of them has a share of: "six apples, two in each of three bowls"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import counted_before, number_of
from pat3d.plan.grammar.words.vocabulary import Nouns


def counted_in_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "six apples, two in each of three bowls" as "two apples in each of three bowls".

    Where the shares do not make up the whole they are left as they are: the audit compares them with the plan.
    """
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


def _carriers(tokens: Sequence[Token], each: int) -> int:
    """How many there are of what "each" at token `each` is said of: "each of three bowls", "each bowl"."""
    words = [token.text for token in tokens]
    after = each + 1 + (words[each + 1] == "of") + ("the" in words[each + 1 : each + 3])
    named = words[min(after, len(words) - 1)]
    if words[each + 1] == "of":
        return number_of(named) or counted_before(tokens, each, named)
    several = [token.text for token in tokens[:each] if named in singulars(token.text)]
    return counted_before(tokens, each, several[-1]) if several else 0
