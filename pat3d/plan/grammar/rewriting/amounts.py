"""Numbers said otherwise than before their noun, in plainer words: "as many forks as plates", "three of each"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from pat3d.plan.grammar.rewriting.counted_places import from_one_side
from pat3d.plan.grammar.rewriting.even_shares import counted_in_each, shared
from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.rewriting.outnumbered import outnumbering
from pat3d.plan.grammar.rewriting.stacked_high import stacked_high
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.number_words import counted_before, is_number, number_of
from pat3d.plan.grammar.words.vocabulary import Nouns

_BUT = frozenset({"but", "except", "save", "excepting", "bar"})
_ABOUT = frozenset({"about", "approximately", "roughly", "around", "exactly"})


_SIDED = frozenset({"side", "sides", "end", "ends", "edge", "hand"})
"""Words by which "on the other" is of a place, and of no thing."""
_OPENING = frozenset({".", ";", ":", ",", "and", "while"})
"""What stands before the subject of a clause."""
_SURROUNDING = frozenset({
    "circle", "ring", "stand", "stands", "standing", "sit", "sits", "sitting", "lie", "lies", "lying", "placed", "set",
    "arranged", "gathered", "grouped", "seated", "scattered", "all",
})  # fmt: skip
"""Words behind which "around" says where."""


def counted(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with every number before its noun."""
    whole = _some_of(_one_of_two(_any_of(_rounded(_of_whole(tokens), nouns)), nouns))
    return _of_each(_equal(_multiples(shared(_on_sides(whole), nouns), nouns), nouns), nouns)


def worked_out(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of a prompt with the number where it says "half of" or "all but one of" what it has counted."""
    tokens = from_one_side(outnumbering(tokens, nouns), nouns)
    whole = _one_and_others(_on_the_other(stacked_high(_all_but(_fractions(tokens)))))
    return counted_in_each(whole, nouns)


def _rounded(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "about ten" as "ten"; what stands, or is formed, "around two vases" surrounds them."""
    single = ("a", "an", "one", "both")
    made: list[Token] = []
    for at, token in enumerate(tokens):
        about = token.text in _ABOUT and at + 1 < len(tokens) and is_number(tokens[at + 1].text)
        before = tokens[at - 1].text if at and not tokens[at - 1].mark else ""
        place = token.text == "around" and (before in _SURROUNDING or nouns.match([before]) is not None)
        if place or not about or tokens[at + 1].text in single:
            made.append(token)
    return made


def _fractions(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "half of the ten balls" as "five of the ten balls", and "the other half" as "the other five"."""
    made = list(tokens)
    at = half = 0
    while at < len(made) - 2:
        words = [token.text for token in made[at : at + 5]]
        half = 0 if words[0] == "." else half
        bare = words[0] == "half" and is_colour_word(words[1]) and at > 1 and made[at - 1].text in (",", ":", "and")
        if (
            bare
            and (half or singulars(made[at - 2].text))
            and (half or counted_before(made, at) % 2 == 0 < counted_before(made, at))
        ):
            # "Six pens, half red, half blue"
            made[at + 1 : at + 1] = [replace(made[at], text=word) for word in ("of", "them")]
            words = [token.text for token in made[at : at + 5]]
        size = 2 if words[:2] == ["half", "of"] else 1
        if words[0] == "half" and words[size] in ("the", "them", "these"):
            # "Six pens, half of them red and half of them blue": both of the six.
            number = number_of(words[size + 1]) if words[size] == "the" else 2 * half or counted_before(made, at)
            if number and number % 2 == 0:
                half = number // 2
                of = replace(made[at], text="of")
                made[at : at + size] = [replace(made[at], text=str(half)), of]
        elif words[:3] == ["the", "other", "half"] and half:
            made[at + 2 : at + 3] = [replace(made[at + 2], text=str(half))]
        at += 1
    return made


_OF_ONE = {"are": "is", "have": "has", "hold": "holds", "contain": "contains", "lie": "lies", "stand": "stands"}
"""Verbs of several, and of one."""


def _all_but(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "six cups, all but one of them red" as "six cups, five of them red".

    Those that are left out are the last: "all red except the last one" leaves that one out.
    """
    made = list(tokens)
    for at, token in enumerate(tokens[:-2]):
        but = at + 1
        while but < len(tokens) - 2 and but - at < 6 and not (tokens[but].mark or tokens[but].text in _BUT):
            but += 1
        if token.text not in ("all", "are") or tokens[but].text not in _BUT or (token.text == "are") > (but > at + 1):
            continue
        after = but + 1 + (tokens[but + 1].text in ("for", "from"))
        words = [each.text for each in tokens[after : after + 4]]
        last = words[:2] == ["the", "last"]
        left = 1 if last or words[0] in ("one", "a") else number_of(words[0])
        end = after + (2 + (words[2] == "one") if last else 1)
        predicate = tokens[at + 1 : but]
        of = [each.text for each in tokens[end : end + 4]]
        what = of[:3] == [",", "which", "is"] or is_colour_word("".join(words[1:2]))
        if not left or words[0] == "a" or link_at(predicate, 0) or (what and is_colour_word(tokens[but - 1].text)):
            continue
        named = of[:2] == ["of", "the"] and len(of) > 2
        total = (number_of(of[2]) if named else 0) or counted_before(tokens, at, of[2] if named else "")
        if total <= left or (not named and of[:1] == ["of"] and of[1:2] not in (["them"], ["these"], ["those"])):
            continue
        number = replace(token, text="one" if total - left == 1 else str(total - left))
        of_them = [replace(token, text=text) for text in ("of", "them")]
        verb = next((n for n in range(end, len(made)) if made[n].text in _OF_ONE), 0)
        if verb and total - left == 1:
            made[verb] = replace(made[verb], text=_OF_ONE[made[verb].text])
        made[at:end] = [number, *([] if of[:1] == ["of"] else of_them), *predicate]
        return made
    return made


def _one_and_others(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "one cup is red, the other two are blue" as "one of the three cups is red, ..."."""
    words = [token.text for token in tokens]
    other = next((at for at in range(3, len(words) - 2) if words[at] == "other" and number_of(words[at + 1])), 0)
    verb = next((at for at in range(2, min(other, 6)) if words[at] in FINITE), 0)
    if words[0] != "one" or not verb or any(map(number_of, words[:other])):
        return list(tokens)
    of, the = (replace(tokens[0], text=text) for text in ("of", "the"))
    total = replace(tokens[0], text=str(number_of(words[other + 1]) + 1))
    several = replace(tokens[verb - 1], text=f"{words[verb - 1]}s")
    return [tokens[0], of, the, total, *tokens[1 : verb - 1], several, *tokens[verb:]]


def _on_the_other(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a fig is on one of them and a pear on the other" as "... atop the other": of a thing, no side.

    So in "Two trays side by side. The left one is empty, on the other is a fig." The side of a bed needs its word.
    """
    words = [token.text for token in tokens]
    one_of = next((at for at, pair in enumerate(pairwise(words)) if pair == ("one", "of")), len(words))
    told = next((at for at in range(len(words) - 1) if _tells_one_of_two(words, at)), len(words))
    sided = [at for at, word in enumerate(words) if word in _SIDED and "by" not in words[at - 1 : at + 2]]
    others = [at for at in range(min(one_of, told), len(words) - 3) if words[at : at + 3] == ["on", "the", "other"]]
    others = [at for at in others if words[at + 3] not in _SIDED and not any(side < at for side in sided)]
    ones = [at for at in range(max(others, default=0)) if words[at : at + 2] == ["on", "one"] and at + 1 >= told]
    # "One leans on the other": beside it.
    upon = {at for at in (*others, *ones) if words[at - 1] not in ("leaning", "leans")}
    return [replace(token, text="atop") if at in upon else token for at, token in enumerate(tokens)]


def _tells_one_of_two(words: Sequence[str], at: int) -> bool:
    """Whether `words` at `at` are the one of two that were counted: "two bowls ... the left one", no "a red one"."""
    anew = words[at - 2 : at - 1] in (["a"], ["an"])
    one = words[at] in ("one", "first") and words[at + 1] not in _SIDED and not anew
    opens = at > 1 and words[at - 1] == "the" and words[at - 2] in _OPENING
    named = opens and words[at] in ("left", "right") and words[at + 1] not in FINITE | _SIDED
    return (one or named) and bool({"two", "2", "both", "pair"} & {*words[:at]})


def _some_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "four of the ten cups are red, the others blue" as "ten cups: four of them are red, ..."."""
    words = [token.text for token in tokens]
    opens = words[1:3] == ["of", "the"] and 0 < (number_of(words[0]) or words[0] == "one") < number_of(words[3])
    end = next((at for at in range(4, len(words)) if tokens[at].mark or words[at] in FINITE), 0)
    if not opens or words[end] not in FINITE:
        return list(tokens)
    colon, them = replace(tokens[0], text=":", mark=True), replace(tokens[2], text="them")
    return [*tokens[2:end], colon, *tokens[:2], them, *tokens[end:]]


def _one_of_two(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "put one fig in a bowl and the other in a box" as "put one of the two figs in a bowl and ..."."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 4):
        found = nouns.match([words[at + 1]]) if words[at] == "one" and known_verb(words[at - 1]) else None
        others = [n for n in range(at + 3, len(words) - 1) if words[n - 1 : n + 1] == ["the", "other"]]
        if found is None or found.plural or not others or not link_at(tokens, others[0] + 1):
            continue
        of_two = [replace(tokens[at], text=text) for text in ("of", "the", "two")]
        several = replace(tokens[at + 1], text=f"{words[at + 1]}s")
        return [*tokens[: at + 1], *of_two, several, *tokens[at + 2 :]]
    return list(tokens)


def _of_whole(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "of three cups, one is red" as "one of three cups is red", "cups, six of them," as "six cups"."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 4):
        of_them = words[at] == "," and words[at + 2 : at + 4] == ["of", "them"]
        if not of_them or not is_number(words[at + 1]) or not tokens[at + 4].mark:
            continue
        ends = (
            n + 1
            for n in range(at - 1, -1, -1)
            if tokens[n].mark or words[n] in FINITE | {"and", "with"} or (link_at(tokens, n) and words[n] != "of")
        )
        start = next(ends, 0)
        start += words[start] == "the"
        # "Cups and plates, four of them": of which is not told.
        named = [] if start and words[start - 1] == "and" else words[start:at]
        plain = named and not any(is_number(word) or word in lexicon.DETERMINERS for word in named)
        if plain and any(singulars(word) for word in named):
            behind = at + 4 + (words[at + 4] == ",")
            return _of_whole([*tokens[:start], tokens[at + 1], *tokens[start:at], *tokens[behind:]])
    first = 1 + (words[1:2] == ["the"])
    if words[:1] != ["of"] or not number_of(words[min(first, len(words) - 1)]):
        return list(tokens)
    at = next((n for n in range(first + 2, min(first + 6, len(words) - 1)) if is_number(words[n])), 0)
    if not at or words[at + 1] not in FINITE:
        return list(tokens)
    end = at - (words[at - 1] == ",")
    # It is quoted from the first word on.
    number = replace(tokens[at], start=tokens[0].start, end=tokens[0].end)
    return [number, *tokens[:end], *tokens[at + 1 :]]


def _on_sides(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "two on either side of a cake" as "two to the left of a cake and two to the right of the cake"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 6):
        several = number_of(words[at]) and tokens[at - 1].mark
        if not several or words[at + 1] != "on" or words[at + 3 : at + 5] != ["side", "of"]:
            continue
        end = next(n for n in range(at + 6, len(words)) if tokens[n].mark or words[n] == "and" or link_at(tokens, n))
        landmark = tokens[at + 5 : end]
        if words[at + 2] not in ("either", "each"):
            continue
        left, right = ([replace(tokens[at + 1], text=text) for text in ("to", "the", side, "of")]
                       for side in ("left", "right"))  # fmt: skip
        joint, again = replace(tokens[at], text="and"), [replace(landmark[0], text="the"), *landmark[1:]]
        return [*tokens[: at + 1], *left, *landmark, joint, tokens[at], *right, *again, *tokens[end:]]
    return list(tokens)


def _any_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "any of the screws" as "one of the screws"."""
    made = list(tokens)
    for at, token in enumerate(made[:-2]):
        if token.text == "any" and made[at + 1].text == "of":
            made[at] = replace(token, text="one")
    return made


def _multiples(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two cups and twice as many jars" as "two cups and four jars", and "... forks as plates" counted.

    Half of what is odd is no number, and is left as it is said.
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(1, len(words) - 2) if words[n : n + 2] == ["as", "many"]), 0)
    if not at or words[at - 1] not in ("half", "twice", "times"):
        return list(tokens)
    first = at - (2 if words[at - 1] == "times" else 1)
    factor = {"half": 0.5, "twice": 2.0}.get(words[at - 1], float(number_of(words[first])))
    end = next((n for n in range(at + 3, min(at + 6, len(words))) if words[n] == "as"), 0)
    if end and not any((found := nouns.match([word])) and found.plural for word in words[end + 1 : end + 4]):
        return list(tokens)
    before = end + 1 + (words[end + 1] in ("the", "there")) if end else next(
        (n for n in range(first - 1, -1, -1) if number_of(words[n])), 0)  # fmt: skip
    number = number_of(words[before]) or (1 if words[before] in ("a", "an", "one") else 0)
    told = number or (lexicon.BARE_PLURAL + 1 if end else 0)
    if not factor or told * factor != int(told * factor):
        return list(tokens)
    amount = replace(tokens[first], text="one" if told * factor == 1 else str(int(told * factor)))
    if not end:
        return [*tokens[:first], amount, *tokens[at + 2 :]]
    joint, base = replace(tokens[end], text="and"), replace(tokens[end], text=str(told))
    counted = [base] if not number else []
    return [*tokens[:first], amount, *tokens[at + 2 : end], joint, *counted, *tokens[end + 1 :]]


def _equal(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "as many forks as plates" as "forks and plates", "two cups and as many jars" as "two jars"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 3) if words[n : n + 2] == ["as", "many"]), None)
    if at is None or (at and words[at - 1] in ("half", "twice", "times")):
        return list(tokens)
    end = next((n for n in range(at + 3, min(at + 6, len(words))) if words[n] == "as"), None)
    if end is not None and words[end + 1] == "there":
        return list(tokens)
    if end is not None:
        namely = next((n for n in range(end, len(words) - 2) if is_number(words[n + 1]) and
                       (words[n] == "namely" or (words[n] in (":", ",") and tokens[n + 2].mark))), None)  # fmt: skip
        if namely is not None:
            number = tokens[namely + 1]
            end_of = namely - (words[namely - 1] == ",")
            tokens = [*tokens[: end + 1], number, *tokens[end + 1 : end_of], *tokens[namely + 2 :]]
            words = [token.text for token in tokens]
        told = (n for n in range(at) if is_number(words[n]) and words[end + 1] in words[n + 1 : min(n + 4, at)])
        if (known := next(told, None)) is not None:
            # "Two balls and as many cups as balls": the balls are counted.
            return [*tokens[:at], replace(tokens[at], text=words[known]), *tokens[at + 2 : end], *tokens[end + 2 :]]
        joint = replace(tokens[end], text="and")
        number = next((n for n in range(end + 1, min(end + 3, len(words))) if is_number(words[n])), None)
        count = [tokens[number]] if number is not None else []
        return [*tokens[:at], *count, *tokens[at + 2 : end], joint, *tokens[end + 1 :]]
    before = next(
        (n for n in range(at - 1, -1, -1) if is_number(words[n]) and lexicon.NUMBERS.get(words[n], 2) > 1), None
    )
    if before is None or not any(nouns.match(words[n : n + 1]) for n in range(before, at)):
        return list(tokens)
    return [*tokens[:at], replace(tokens[at], text=words[before]), *tokens[at + 2 :]]


def _of_each(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "mugs and bowls, three of each," and "..., three each," as "three mugs and three bowls"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(1, len(words) - 2) if is_number(words[n]) and words[n - 1] in (",", ":", "-")
               and ("each" in words[n + 1 : n + 2] or words[n + 1 : n + 3] == ["of", "each"])), None)  # fmt: skip
    end = 0 if at is None else at + 2 + (words[at + 1] == "of")
    heads = [n for n in range((at or 1) - 1) if singulars(words[n]) and nouns.match([words[n]])]
    if at is None or not tokens[min(end, len(tokens) - 1)].mark:
        return list(tokens)
    if words[at + 1] == "each" and not _counts_kinds(words, heads[-2:], number_of(words[at])):
        return list(tokens)
    made = [*tokens[: at - 1], *tokens[end + (words[end] == ",") :]]
    for head in reversed(heads[-2:]):
        first = head
        while first and is_modifier(words[first - 1]) and not is_number(words[first - 1]):
            first -= 1
        if not first or not is_number(words[first - 1]):
            made.insert(first, replace(tokens[at], start=tokens[first].start, end=tokens[first].start))
    return made


def _counts_kinds(words: Sequence[str], heads: Sequence[int], number: int) -> bool:
    """Whether ", three each" says how many there are of two kinds, and not what each of several has.

    They are listed at the two `heads`, with that `number` or with none.
    """
    if len(heads) < 2 or not number:
        return False
    between = [word for word in words[heads[0] + 1 : heads[1]] if not is_modifier(word) and not is_number(word)]
    counts: list[int] = []
    for head in heads:
        first = head
        while first and is_modifier(words[first - 1]) and not is_number(words[first - 1]):
            first -= 1
        counts.append(number_of(words[first - 1]) if first else 0)
    return between in (["and"], [",", "and"], [","]) and {*counts} <= {0, number}
