"""Lists that say of what kind counted things are: "three fruits (an apple, a fig and a pear)", "two cans: corn, tuna".

What is listed behind a count is what was counted, once. In a list of colours "orange" is one of them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.assets.colours import COLOURS
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.rewriting.set_off_shares import by_share
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier, looks_like_adjective
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_BOTTLED = frozenset({"ketchup", "mustard", "mayonnaise", "vinegar"})
"""What is made in its bottle."""
_LEADING = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | lexicon.VAGUE.keys()
_VARIED = frozenset({"other", "different", "various", "several", "identical", "separate", "exactly",
                     "following"})  # fmt: skip
_MANY_COLOURED = frozenset({
    "different", "differently", "matching", "colored", "coloured", "colorful", "colourful", "rainbow", "multicolored",
    "rainbow-colored", "rainbow-coloured", "multicoloured",
})  # fmt: skip
"""Words that a list of the colours says too."""
_ALTERNATING = frozenset({"alternate", "alternating", "alternately", "alternates"})
_LONGEST = 24
"""Tokens of a list in brackets."""

Item = list[Token]


def enumerated(text: str, tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with what is listed in the place of what was counted."""
    told = _set_off_colours(_apposed(by_share(text, tokens, nouns), nouns), nouns)
    tokens = _all_alike(_with_heads(told, nouns))
    return _oranges(_kinds(_in_brackets(text, tokens, nouns), nouns), nouns)


def _apposed(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two cups, a red cup and a blue cup" as "two cups, a red one and a blue one": two, not four."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 6):
        kind = nouns.match([words[at]])
        lead = words[max(at - 3, 0) : at]
        said = next((word for word in lead if word in lexicon.NUMBERS or word.isdecimal()), "0")
        number = lexicon.NUMBERS.get(said, int(said) if said.isdecimal() else 0)
        if any(map(is_colour_word, lead)):
            # "Two red apples, a blue apple and a green apple" are four.
            continue
        if kind is None or not kind.plural or number < 2 or words[at + 1] not in (",", ":"):
            continue
        heads: list[int] = []
        first = at + 2
        while words[first] in ("a", "an", "one"):
            near = range(first + 2, min(first + 5, len(words)))
            head = next((n for n in near if words[n] in singulars(words[at])), 0)
            if not head or any(tokens[n].mark or words[n] == "and" for n in range(first, head)):
                break
            heads.append(head)
            joint = next(n for n in range(head, len(words)) if tokens[n].mark or words[n] == "and")
            first = joint + 1 + (words[joint] == "," and words[joint + 1] == "and")
            if words[joint] == "." or first >= len(words):
                break
        if len(heads) == number:
            return [replace(token, text="one") if n in heads else token for n, token in enumerate(tokens)]
    return tokens


def alternating(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "cups that alternate between white and blue" as "alternating white and blue cups"."""
    words = [token.text for token in tokens]
    at = next((n for n, word in enumerate(words) if word in _ALTERNATING), 0)
    first = at + 1 + (words[at + 1 : at + 2] == ["between"])
    colours = words[first : first + 3]
    if (
        not at
        or len(colours) < 3
        or colours[1] != "and"
        or not is_colour_word(colours[0])
        or (not is_colour_word(colours[2]) or not (tokens[first + 3].mark or link_at(tokens, first + 3)))
    ):
        return list(tokens)
    start = at - (words[at - 1] in (",", "that", "which"))
    start -= words[start - 1] == ","
    end = next((n for n in range(start, 0, -1) if nouns.match([words[n - 1]]) and singulars(words[n - 1])), 0)
    if not end or any(tokens[n].mark for n in range(end, start)):
        return list(tokens)
    told = [replace(tokens[at], text="alternating"), *tokens[first : first + 3]]
    return [*tokens[: end - 1], *told, *tokens[end - 1 : start], *tokens[first + 3 :]]


def items_of(tokens: Sequence[Token]) -> list[Item]:
    """The members of the list `tokens`."""
    made: list[Item] = [[]]
    for token in tokens:
        if token.text in (",", "and"):
            made.append([])
        else:
            made[-1].append(token)
    return [item for item in made if item]


def start_of(words: Sequence[str], end: int) -> int:
    """Where the phrase begins of which the noun ends before token `end`."""
    start = end
    while start and (words[start - 1] in _LEADING | _VARIED | _MANY_COLOURED or is_modifier(words[start - 1])):
        start -= 1
    return start


def _described(words: Sequence[str], first: int) -> int:
    """Where the phrase begins of which the known words begin at `first`: "every organic" fruit, "kitchen" utensils."""
    word = words[first - 1] if first else "."
    ends = first == 1 or looks_like_adjective(word) or (first > 1 and words[first - 2] in _LEADING)
    if not ends or not word.isalpha() or word in ("and", "of", "with", "are", "is") or known_verb(word):
        return first
    return start_of(words, first - 1)


def kind_at(words: Sequence[str], end: int, nouns: Nouns) -> tuple[int, bool]:
    """Where the plural name begins that ends before token `end`, and whether it is of a kind of things: "fruits"."""
    for size in (3, 2, 1):
        said = words[end - size : end] if size <= end else []
        ends = [" ".join([*said[:-1], one]) for one in singulars(said[-1])] if said else []
        if any(one in lexicon.GENERICS for one in ends) or (size == 1 and said and said[0] in lexicon.MASS_GENERICS):
            return end - size, True
        found = nouns.match(said) if said else None
        if found is not None and found.plural:
            return end - size, False
    return end, False


def _in_brackets(text: str, tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the tools (a saw and a file)" as "the saw and the file", "mugs (red, blue)" as "2 red, blue mugs".

    Where the number that is said is another the list stays in its brackets, and is read as a remark.
    """
    words = [token.text for token in tokens]
    for at in range(1, len(tokens) - 2):
        if not (tokens[at].mark and text[tokens[at].start : tokens[at].end] == "("):
            continue
        close = next((n for n in range(at + 2, min(at + _LONGEST, len(tokens)))
                      if text[tokens[n].start : tokens[n].end] == ")"), 0)  # fmt: skip
        listed = items_of(tokens[at + 1 : close])
        end, said = _different(words, at)
        name, generic = kind_at(words, end, nouns)
        if not close or len(listed) < 2 or name == end:
            continue
        first = start_of(words, name)
        count = next((numeral(word) for word in words[first:name] if numeral(word) > 1), said)
        if all(len(item) == 1 and is_colour_word(item[0].text) for item in listed):
            if count in (0, len(listed)):
                told = any(numeral(word) == count for word in words[first:name]) if count else False
                number = [] if told else [replace(tokens[name], text=str(len(listed)))]
                comma = replace(tokens[at], text=",", mark=True)
                colours = [one for item in listed for one in (item[0], comma)][:-1]
                lead = _described(words, name)
                kept = [token for token in tokens[lead:name] if token.text not in _MANY_COLOURED]
                made = [*tokens[:lead], *number, *kept, *colours, *tokens[name:end], *tokens[close + 1 :]]
                return _in_brackets(text, made, nouns)
        elif all(len(item) == 2 and numeral(item[0].text) and is_colour_word(item[1].text) for item in listed):
            if not count:
                # "the cups (one red, two blue)"
                total = sum(numeral(item[0].text) for item in listed)
                return [*tokens[:name], replace(tokens[name], text=str(total)), *tokens[name:]]
        elif _is_it(listed, count, generic, nouns):
            first = _described(words, first)
            definite = not count or bool({"the", "all", "these"} & set(words[first:name]))
            whole = joined(listed, definite, tokens[close])
            if words[first - 1] == "and" and (other := kind_at(words, first - 1, nouns))[1]:
                # "all fruits and vegetables (an apple, a leek)"
                first = _described(words, start_of(words, other[0]))
            return _in_brackets(text, [*tokens[:first], *whole, *tokens[close + 1 :]], nouns)
    return tokens


def _different(words: Sequence[str], at: int) -> tuple[int, int]:
    """Where what ends before token `at` ends without "of five different colours", and the number there."""
    if words[at - 1] in ("colors", "colours") and "of" in words[max(at - 4, 0) : at]:
        of = max(n for n in range(at) if words[n] == "of")
        if {*words[of + 1 : at - 1]} <= {"different", "various", *lexicon.NUMBERS}:
            return of, next((numeral(word) for word in words[of:at] if numeral(word)), 0)
    return at, 0


def _is_it(listed: Sequence[Item], count: int, generic: bool, nouns: Nouns) -> bool:
    """Whether the things of the list are those that were counted."""
    named = all(nouns.longest([token.text for token in item]) for item in listed)
    headless = all(is_colour_word(item[-1].text) for item in listed)
    total = sum(numeral(item[0].text) or 1 for item in listed)
    return named and not headless and (generic or total == count)


def joined(listed: Sequence[Item], definite: bool, mark: Token) -> list[Token]:
    """The things of the list as a list of phrases, `definite` or not."""
    made: list[Token] = []
    for n, item in enumerate(listed):
        article = replace(item[0], text="the" if definite else "a")
        led = item[0].text in _LEADING
        plural = bool(singulars(item[-1].text))
        if led and definite and item[0].text in ("a", "an"):
            item = [article, *item[1:]]
        elif (led and definite and item[0].text not in lexicon.DETERMINERS) or not (led or (plural and not definite)):
            item = [article, *item]
        if n:
            made.append(replace(mark, text="and" if n == len(listed) - 1 else ",", mark=n < len(listed) - 1))
        made += item
    return made


def _set_off_colours(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "three mugs, red, green and blue, stand" (or ":") as "three red, green and blue mugs stand"."""
    words = [token.text for token in tokens]
    for at in range(2, len(tokens) - 3):
        if words[at] not in (",", ":") or not is_colour_word(words[at + 1]):
            continue
        end = at + 1
        while end < len(tokens) and (words[end] in (",", "and") or is_colour_word(words[end])):
            end += 1
        listed, (name, _) = items_of(tokens[at + 1 : end]), kind_at(words, at, nouns)
        lead = words[start_of(words, name) : name]
        count = next((numeral(word) for word in lead if numeral(word) > 1 and not {*lead} & _MANY_COLOURED), 0)
        if (words[end - 1] == "," or words[end] == ".") and len(listed) == count:
            comma = replace(tokens[at], text=",")
            colours = [one for item in listed for one in (item[0], comma)][:-1]
            return [*tokens[:name], *colours, *tokens[name:at], *tokens[end:]]
    return tokens


def _with_heads(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "salt and pepper shakers" as "salt shakers and pepper shakers": salt is no thing of its own."""
    words = [token.text for token in tokens]
    for at in (n for n in range(1, len(words) - 3) if words[n] == "and" and words[n - 1] in lexicon.SUBSTANCES):
        name = at + 1 + (words[at + 1] in _LEADING)
        head = tokens[min(name + 1, len(tokens) - 1)]
        # "A glass of wine and a wine bottle": the wine is in the glass.
        fills = words[at - 2] in ("of", "with")
        names = not head.mark and nouns.match([words[at - 1], head.text]) and nouns.match([words[name], head.text])
        if names and not fills:
            # "The salt and pepper shakers" are one of each.
            pair = words[at - 2] == "the"
            one = next(iter(singulars(head.text)), head.text) if pair else head.text
            the = [replace(tokens[name], text="the")] if pair and name == at + 1 else []
            told = [replace(tokens[at - 1], text=one), *tokens[at:name], *the, tokens[name], replace(head, text=one)]
            return [*tokens[:at], *told, *tokens[name + 2 :]]
    return tokens


def _all_alike(tokens: list[Token]) -> list[Token]:
    """`tokens` with "everything on the shelf is red: a cup, a vase" as "a red cup and a red vase are on the shelf"."""
    words = [token.text for token in tokens]
    colon = words.index(":") if ":" in words else 0
    verb = next((n for n in range(1, colon) if words[n] in ("is", "are")), 0)
    told = tokens[verb + 1 : colon]
    alike = bool(told) and all(is_modifier(token.text) for token in told)
    if words[0] not in ("everything", "all", "both") or not verb or not alike:
        return tokens
    named = []
    for item in items_of(tokens[colon + 1 : -1]):
        lead = next((n for n, token in enumerate(item) if token.text not in _LEADING), 0)
        named.append([*item[:lead], *told, *item[lead:]])
    where = next((n for n in range(1, verb) if link_at(tokens, n)), verb)
    are = [replace(tokens[verb], text="are")] if where < verb else []
    return [*joined(named, False, tokens[colon]), *are, *tokens[where:verb], tokens[-1]]


def _kinds(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two cans stand on a shelf: corn and tuna" as "a corn can and a tuna can stand on a shelf"."""
    words = [token.text for token in tokens]
    for colon in (n for n in range(2, len(words)) if words[n] == ":"):
        end = next((n for n in range(colon + 1, len(words)) if tokens[n].mark and words[n] != ","), len(words))
        listed = items_of(tokens[colon + 1 : end])
        start = next((n for n in range(colon - 1) if numeral(words[n]) == len(listed) > 1), None)
        kinds = all(len(item) <= 2 and item[0].text not in _LEADING and not singulars(item[-1].text) for item in listed)
        kinds = kinds and not all(is_modifier(item[-1].text) for item in listed)
        if start is None or not kinds:
            continue
        name = start + 1
        single = next((one for one in singulars(words[name]) if nouns.match([one])), None)
        if single is None or single in lexicon.GENERICS:
            continue
        whole = [item if item[-1].text in _BOTTLED else [*item, replace(item[-1], text=single)] for item in listed]
        return [*tokens[:start], *joined(whole, False, tokens[colon]), *tokens[name + 1 : colon], *tokens[end:]]
    return tokens


def _oranges(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a red, an orange and a blue box" so that "orange" is a colour there."""
    made = list(tokens)
    words = [token.text for token in tokens]
    for at in (n for n in range(1, len(words) - 2) if words[n] == "orange" and words[n + 1] in (",", "and")):
        before = at
        while before and (words[before - 1] in (",", "and") or words[before - 1] in _LEADING
                          or is_colour_word(words[before - 1])):  # fmt: skip
            before -= 1
        led = items_of(tokens[before:at])
        alone = sum(len(item) <= 2 and is_colour_word(item[-1].text) for item in led)
        several = numeral(words[at - 1]) > 1
        after = at + 1
        while words[after] in (",", "and") or words[after] in _LEADING:
            after += 1
        coloured = False
        while after < len(words) - 1 and is_colour_word(words[after]):
            coloured, after = True, after + 1
            while words[after] in (",", "and") or words[after] in _LEADING:
                after += 1
        named = coloured and not tokens[after].mark and nouns.match([words[after]]) is not None
        onward = words[at + 1 + (words[at + 1 : at + 3] == [",", "and"]) + 1]
        fruit = words[at - 1] in COLOURS and onward in _LEADING
        # "A green orange, a yellow mug": a fruit.
        if named and (alone or several) and not fruit:
            made[at] = replace(tokens[at], text="orange-colored")
    return made
