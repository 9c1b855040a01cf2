"""Shares of what was counted, set off behind it within a list: "three cups (one red, two blue) and two grey pens".

The colours are of the cups; where another noun follows in the list they could be taken for its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, items_of, singulars
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_LEADING = lexicon.DETERMINERS | lexicon.NUMBERS.keys()
_OPENING = {"(": ")", ",": ",", "-": "-", "\u2014": "\u2014", "\u2013": "\u2013", "[": "]"}
_REST = (("the", "other"), ("the", "others"), ("the", "rest"), ("the", "remaining"), ("the", "last"))
_PARTLY = frozenset({"partly", "partially", "halfway", "half", "just", "right", "still"})
"""Words before where one of several is."""
_LONGEST = 24
"""Tokens of what is set off."""

Share = tuple[int, list[Token]]
"""How many, and the words for them."""


def by_share(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "three cups (one red, two blue) and a pen" as "one red cup, two blue cups and a pen"."""
    made = _headed(_of_them(list(tokens), nouns), nouns)
    at = 1
    while at < len(made) - 4:
        told = _told(text, made, at, nouns)
        if told is None:
            at += 1
        else:
            made, at = told
    return made


def _headed(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "cubes: three red, one green" as "three red cubes, one green cube"."""
    words = [token.text for token in tokens]
    name = next(
        (n for n in (3, 2, 1) if words[n : n + 1] == [":"] and (one := nouns.match(words[:n])) and one.plural), 0
    )
    end, said = name + 1, list[list[Token]]()
    while name and numeral("".join(words[end : end + 1])) and is_colour_word("".join(words[end + 1 : end + 2])):
        said.append([*tokens[end : end + 2], *_named(numeral(words[end]), tokens[:name], nouns)])
        after = next((n for n in range(end + 2, len(words)) if words[n] not in (",", "and")), len(words))
        goes_on = after > end + 2 and numeral("".join(words[after : after + 1]))
        end = after if goes_on and is_colour_word("".join(words[after + 1 : after + 2])) else end + 2
    joints = [replace(tokens[name], text="and" if n == len(said) - 1 else ",", mark=n < len(said) - 1)
              for n in range(1, len(said))]  # fmt: skip
    listed = [
        each for joint, item in zip([[], *([one] for one in joints)], said, strict=False) for each in (*joint, *item)
    ]
    return [*listed, *tokens[end:]] if len(said) > 1 else tokens


def told_behind(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt with "four figs, one of which is dry, and a pear" as "four figs and a pear".

    That "one of the figs is dry" is told behind: set off it would end the list, and the pear be somewhere else.
    """
    tokens = _told_last(tokens)
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 7):
        which = next((n for n in (at + 1, at + 2) if words[n : n + 2] == ["of", "which"]), 0) if words[at] == "," else 0
        number = at + 1 if which == at + 2 else at + 3
        verb = at + 4
        plain = which and numeral(words[number]) and words[verb] in lexicon.COPULAS and not link_at(tokens, verb + 1)
        rest = tuple(words[verb + 4 : verb + 6]) in _REST
        if rest or not plain or words[verb + 2 : verb + 4] != [",", "and"] or nouns.match([words[at - 1]]) is None:
            continue
        end = next((n for n in range(verb + 4, len(words)) if words[n] == "."), len(words))
        stop = replace(tokens[verb + 2], text=".", mark=True)
        the = replace(tokens[which], text="the")
        apart = [tokens[number], tokens[which], the, tokens[at - 1], *tokens[verb : verb + 2]]
        said = [*(replace(each, start=tokens[at + 1].start, end=tokens[verb + 1].end) for each in apart), stop]
        return [*tokens[:at], *tokens[verb + 3 : end], stop, *said, *tokens[end + 1 :]]
    return list(tokens)


def _told_last(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "two jars, one with figs, one with nuts, both on a tray" as "... nuts. Both are on a tray".

    So is "two jars and two figs, one of the figs on a tray"; "a cup by a book, both on a desk" are "both of them".
    """
    words = [token.text for token in tokens]
    for at in (n for n in range(2, len(words) - 3) if words[n] == ","):
        start = max((n + 1 for n in range(at) if words[n] == "."), default=0)
        stop = next((n for n in range(at, len(words)) if words[n] == "."), len(words))
        some = words[at + 1 : at + 4] == ["one", "of", "the"] and words[at + 4] in words[start:at]
        end = at + 2 if words[at + 1] == "both" else at + 5 if some else stop
        place = end + (words[end] in _PARTLY)
        placed = end < stop and (words[end] == "are" or (words[end] != "of" and link_at(tokens, place) > 0))
        apart = (some or "one" in words[start:at]) and not {",", "and", "are"} & {*words[end:stop]}
        if placed and apart:
            verb = replace(tokens[at], text="is" if some else "are", mark=False)
            return [*tokens[:at], replace(tokens[at], text="."), *tokens[at + 1 : end], verb, *tokens[end:]]
        if placed and not some:
            return [*tokens[:end], *(replace(tokens[end - 1], text=word) for word in ("of", "them")), *tokens[end:]]
    return list(tokens)


def _of_them(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "apples, ten of them, in a box" and "apples in a box, ten of them" as "ten apples in a box"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 2):
        if words[at : at + 2] != ["of", "them"] or numeral(words[at - 1]) < 2 or not tokens[at + 2].mark:
            continue
        start = at - 1 - (words[at - 2] in ("about", "maybe", "perhaps", "roughly", "around"))
        first = words[:3].index("of") + 1 if words[0] in ("a", "the") and "of" in words[:3] else 0
        name = next((n for n in (3, 2, 1) if (one := nouns.match(words[first : first + n])) and one.plural), 0)
        if not name or words[start - 1] not in (",", "-") or (first and first + name != start - 1):
            continue
        behind = tokens[at + 2 :] if words[at + 2] == "." or first + name < start - 1 else tokens[at + 3 :]
        number = replace(tokens[at - 1], start=tokens[first].start, end=tokens[first].start)
        return [*tokens[:first], number, *tokens[first : start - 1], *behind]
    return tokens


def _told(text: str, tokens: Sequence[Token], at: int, nouns: Nouns) -> tuple[list[Token], int] | None:
    """`tokens` with what is set off at token `at` told by shares, and the token behind that; None where nothing is."""
    words = [token.text for token in tokens]
    closing = _OPENING.get(text[tokens[at].start : tokens[at].end]) if tokens[at].mark else None
    name = next((at - n for n in (3, 2, 1) if n <= at and (one := nouns.match(words[at - n : at])) and one.plural), at)
    first = name
    while first and (is_modifier(words[first - 1]) and words[first - 1] not in _LEADING):
        first -= 1
    total = numeral(words[first - 1]) if first else 0
    if not closing or name == at or total < 2:
        return None
    for close in range(at + 4, min(at + _LONGEST, len(tokens) - 1)):
        if text[tokens[close].start : tokens[close].end] != closing:
            continue
        shares = _shares(tokens[at + 1 : close], total)
        # "(two of them red, the other blue)" speaks of the cups by pronouns wherever it stands.
        bracket = closing != ","
        pronouns = bracket and {*words[at:close]} & {"them", "other", "others", "rest", "remaining"}
        if shares and (pronouns or _goes_on(words, close + (bracket and words[close + 1] in (",", "and")), nouns)):
            phrases = [[*_numbered(count, said), *tokens[first:name], *_named(count, tokens[name:at], nouns)]
                       for count, said in shares]  # fmt: skip
            comma = replace(tokens[at], text=",", mark=True)
            whole = [token for phrase in phrases for token in (*phrase, comma)][:-1]
            after = close + (bracket or words[close + 1] == "and")
            return [*tokens[: first - 1], *whole, *tokens[after:]], first - 1 + len(whole)
        if closing != ",":
            return None
    return None


def _shares(tokens: Sequence[Token], total: int) -> list[Share]:
    """The shares of `total` that "one red, two blue" or "two of them red, the other blue" tells; or none."""
    shares: list[Share] = []
    for item in items_of(tokens):
        words = tuple(token.text for token in item)
        if words[:2] in _REST:
            left = total - sum(count for count, _ in shares)
            size = 2 + (len(words) > 2 and (words[2] in ("one", "ones") or numeral(words[2]) == left))
            shares.append((left, item[size:]))
        else:
            size = 1 + 2 * (words[1:3] in (("of", "them"), ("of", "which")))
            shares.append((numeral(words[0]), item[size:]))
    described = all(count > 0 and said and all(is_modifier(one.text) for one in said) for count, said in shares)
    return shares if len(shares) > 1 and described and sum(count for count, _ in shares) == total else []


def _goes_on(words: Sequence[str], at: int, nouns: Nouns) -> bool:
    """Whether another noun phrase of the list follows behind the joint at token `at`."""
    if words[at] not in (",", "and"):
        return False
    at += 1 + (words[at + 1] == "and")
    while at < len(words) - 1 and (words[at] in _LEADING or words[at].isdecimal() or is_modifier(words[at])):
        at += 1
    return any(nouns.match(words[at : at + size]) for size in (1, 2, 3))


def _numbered(count: int, said: Sequence[Token]) -> list[Token]:
    return [replace(said[0], text=str(count) if count > 1 else "one"), *said]


def _named(count: int, name: Sequence[Token], nouns: Nouns) -> list[Token]:
    """The plural `name` as it is after `count`: "cup" after one."""
    *before, head = name
    words = [token.text for token in before]
    single = (one for one in singulars(head.text) if (found := nouns.match([*words, one])) and not found.plural)
    return [*before, replace(head, text=next(single, head.text) if count == 1 else head.text)]
