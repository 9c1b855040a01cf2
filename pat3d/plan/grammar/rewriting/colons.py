"""What stands behind the colon of an instruction: the things that it speaks of, or where each of them is to go.

"Put the fruit in the bowl: a fig and two limes" is "put the fig and the two limes in the bowl", and "tidy up: pens in
the cup, books on the shelf" is "tidy up: put the pens in the cup and put the books on the shelf".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.english import plural
from pat3d.plan.grammar.rewriting.commands import SORTS
from pat3d.plan.grammar.rewriting.enumerated import items_of, joined, kind_at, start_of
from pat3d.plan.grammar.rewriting.instructions import asked, known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.number_words import numeral
from pat3d.plan.grammar.words.vocabulary import Nouns

_TIDYING = frozenset({
    "tidy", "separate", "clean", "clear", "organize", "organise", "sort", "pack", "store", "stow", "unpack",
    "distribute", "rearrange", "collect", "gather", "group", "restore", "straighten", "put", "move", "return", "empty",
    "unload",
})  # fmt: skip
"""Verbs of what is there, behind which "pens in the cup" is no scene to make."""
_PUTTING = frozenset({"put", "place", "set", "lay", "move", "bring", "take", "return"})
_WHOLE = frozenset({"everything", "these", "following", "items", "things", "objects"})
"""Words for what the list names."""
_ORDER = frozenset({"first", "then", "next", "finally", "last", "lastly"})
_INSIDE = frozenset({"of", "with"})
_SOURCES = frozenset({"from", "off", "out"})


def behind_colons(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """`sentence`, where it is an instruction, with what its list names, or with where each thing is to go."""
    colon = next((n for n in range(2, len(sentence) - 2) if sentence[n].text in (":", "-")), 0)
    comma = next((n for n in range(2, len(sentence) - 2) if sentence[n].mark or _placed(sentence, n)), 0)
    goals = sentence[comma].mark and _lists_goals(sentence[:comma], sentence[comma + 1 :], nouns)
    colon = colon or (comma if goals else 0)
    verb = asked(sentence, nouns) if colon else ""
    # "Tidy up: the plates go in the rack"
    goes = {n for n in range(colon + 2, len(sentence) - 3) if sentence[n].text in ("go", "goes")
            and (size := link_at(sentence, n + 1)) and sentence[n + 1 + size].text in lexicon.DEFINITE}  # fmt: skip
    told = [each for n, each in enumerate(sentence[:-1]) if n > colon and n not in goes and each.text not in _ORDER]
    if not verb or not told:
        return [sentence]
    head, end = sentence[:colon], sentence[colon:]
    if told[0].text in lexicon.PRONOUNS and told[min(1, len(told) - 1)].text in lexicon.COPULAS:
        # "Put the cups in the sink: they are on the table."
        return [[*head, end[-1]], [*told, end[-1]]]
    if (placed := _goals(verb, head, told, end, nouns)) is not None:
        return [placed]
    listed = items_of(told)
    if not all(_is_named(item, nouns) for item in listed):
        return [sentence]
    if _counted(head, listed, nouns):
        there = [replace(head[0], text=word) for word in ("there", "are")]
        return [[*there, *told, end[-1]], [*head, end[-1]]]
    return [[*_listed(head, listed, end, nouns), end[-1]]]


def with_goals(told: Sequence[list[Token]], nouns: Nouns) -> list[list[Token]]:
    """`told` with "empty the box; pens in the cup, books on the shelf" as "empty the box: pens in the cup, ..."."""
    made: list[list[Token]] = []
    for sentence in told:
        if made and _lists_goals(made[-1][:-1], sentence, nouns):
            made[-1] = [*made[-1][:-1], replace(made[-1][-1], text=":"), *sentence]
        else:
            made.append(sentence)
    return made


def _lists_goals(head: Sequence[Token], told: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `told`, which ends in a stop, says where each thing is to go that `head` tidies."""
    plain = bool(told) and not any(token.mark or _placed(head, n) for n, token in enumerate(head))
    bare = plain and told[0].text not in ("a", "an", "there") and not numeral(told[0].text)
    bare = bare and not {"go", "goes"} & {token.text for token in told}
    tidies = bare and asked([*head, told[-1]], nouns) in _TIDYING - _PUTTING
    return tidies and len(goals_of(told[:-1])) > 1 and not asked(told, nouns)


def _placed(tokens: Sequence[Token], at: int) -> bool:
    """Whether a place stands at token `at`; "sort the cups by size" has none."""
    behind = "".join(token.text for token in tokens[at + 1 : at + 2])
    return link_at(tokens, at) > 0 and not (tokens[at].text == "by" and behind in SORTS)


def _is_named(item: Sequence[Token], nouns: Nouns) -> bool:
    """Whether `item` is the name of a thing, or "the red one", and nothing else is told of it."""
    words = [token.text for token in item]
    inner = next((n for n in range(1, len(words)) if words[n] in _INSIDE), len(words))
    if any(link_at(item, n) and words[n] not in _INSIDE for n in range(len(words))) or FINITE & {*words}:
        return False
    bare = words[0] not in lexicon.DETERMINERS | lexicon.POSSESSIVES and not numeral(words[0])
    thing = any(nouns.match(words[inner - n : inner]) for n in (1, 2, 3) if n <= inner)
    return thing or (inner > 1 and words[inner - 1] in ("one", "ones") and not bare)


def _listed(
    head: Sequence[Token], listed: Sequence[list[Token]], rest: Sequence[Token], nouns: Nouns
) -> Sequence[Token]:
    """`head` with the things of `listed` in the place of the word for all of them; before `rest` where it has none."""
    words = [token.text for token in head]
    ones = all(item[-1].text in ("one", "ones") for item in listed)
    total = sum(numeral(item[0].text) or 1 for item in listed)
    for end in range(len(words), 1, -1) if "order" not in words else ():
        name, generic = kind_at(words, end, nouns)
        whole = words[end - 1] in _WHOLE and (end == len(words) or link_at(head, end) > 0)
        name = end - 1 if whole else name
        if name == end or not (generic or whole or ones):
            continue
        first = max(start_of(words, name), 1)
        while first > 1 and words[first - 1] in ("all", "both", "of"):
            first -= 1
        said = next((numeral(word) for word in words[first:name] if numeral(word)), total)
        made_up = first < name and not whole and not (lexicon.DEFINITE | lexicon.POSSESSIVES) & {*words[first:name]}
        if said != total or (len(listed) == 1 and not whole):
            continue
        kind, one = words[name:end], next(iter(singulars(words[end - 1])), words[end - 1])
        called = [[*kind[:-1], one] if item[-1].text == "one" else kind for item in listed] if ones else []
        things = [[*item[:-1], *(replace(item[-1], text=word) for word in name)]
                  for item, name in zip(listed, called, strict=True)] if ones else listed  # fmt: skip
        return [*head[:first], *joined(things, not made_up, rest[0]), *head[end:]]
    return [*head, *rest[:-1]]


def _counted(head: Sequence[Token], listed: Sequence[list[Token]], nouns: Nouns) -> bool:
    """Whether `listed` only says how many there are of what `head` names: "a pen in every cup: two pens, two cups"."""
    names = {one for token in head for one in (token.text, *singulars(token.text))}
    many = all(numeral(item[0].text) and {item[-1].text, *singulars(item[-1].text)} & names for item in listed)
    return many and all(nouns.match([item[-1].text]) for item in listed)


def _goals(
    verb: str, head: Sequence[Token], told: list[Token], end: Sequence[Token], nouns: Nouns
) -> list[Token] | None:
    """`head` before "put the pens in the cup and put ..." for the "pens in the cup, ..." told; None for no such list.

    "Sort the cups: red ones into the left box" speaks of the cups.
    """
    parts = goals_of(told)
    words = [token.text for token in head]
    deeds = any(known_verb(part[0].text) and nouns.match([part[0].text]) is None for part in parts)
    if verb not in _TIDYING or not parts or deeds:
        return None
    source = next((n for n in range(2, len(words) - 1) if words[n] in _SOURCES and link_at(head, n)), len(words))
    plain = verb != "separate" and not any(token.text in _SOURCES for token in told)
    kind, into = _kind(head), [word for word in words if singulars(word)]
    made: list[Token] = []
    ones = False
    for part in parts:
        at = places_of(part)[0][0]
        thing, goal = part[part[0].text in ("the", "a", "an") : at], part[at:]
        if thing[-1].text in ("one", "ones") and kind:
            ones = True
            called = [each.text for each in kind if not numeral(each.text)]
            if thing[-1].text == "one":
                called[-1] = next(iter(singulars(called[-1])), called[-1])
            thing = [*thing[:-1], *(replace(thing[-1], text=word) for word in called)]
        if goal[-1].text == "one" and (made or into):
            # "Into the left tray, big ones into the right one"
            goal = [*goal[:-1], replace(goal[-1], text=made[-1].text if made else next(iter(singulars(into[-1]))))]
        owned = part[0].text in lexicon.DEFINITE | lexicon.POSSESSIVES and part[0].text != "the"
        lead = [] if owned else [replace(part[0], text="the")]
        again = [replace(part[0], text="and")] if made else []
        made += [*again, replace(part[0], text="put"), *lead, *thing, *(head[source:] if plain else []), *goal]
    if verb == "sort" and (ones or "by" in words or "into" in words):
        return [*made, end[-1]]
    return [*(head[:source] if plain else head), replace(end[0], text=":"), *made, end[-1]]


def _kind(head: Sequence[Token]) -> list[Token]:
    """The name behind "the" that `head` begins with: "cubes" of "sort the cubes by colour"."""
    the = next((n for n, token in enumerate(head) if token.text in lexicon.DEFINITE), len(head))
    ends = (n for n in range(the + 1, len(head)) if link_at(head, n) or head[n].text in ("by", "according", "from"))
    return list(head[the + 1 : next(ends, len(head))])


def goals_of(tokens: Sequence[Token]) -> list[list[Token]]:
    """The members of "the pens and nibs in the cup, the books on the shelf", a goal for each; none for another list."""
    made: list[list[Token]] = []
    for part in items_of(tokens):
        if made and not places_of(made[-1]):
            made[-1] += [replace(part[0], text="and"), *part]
        else:
            made.append(list(part))
    return made if all(places_of(part) and not FINITE & {token.text for token in part} for part in made) else []


def places_of(part: Sequence[Token]) -> list[tuple[int, int]]:
    """Where each "in" or "next to" behind the name of `part` begins and ends."""
    made: list[tuple[int, int]] = []
    at = 1
    while at < len(part):
        size = link_at(part, at)
        if size and part[at].text not in _INSIDE:
            made.append((at, at + size))
        at += size or 1
    return made


def one_for_each(told: list[list[Token]]) -> list[list[Token]]:
    """`told` with "put a pen in every cup" as "put the pens in the cups" where it is told of as many of both."""
    numbers: dict[str, int] = {}
    made: list[list[Token]] = []
    for sentence in told:
        words = [token.text for token in sentence]
        each = next((n for n in range(4, len(words) - 2) if words[n] in ("each", "every")), 0)
        at = next((n for n in range(2, each) if link_at(sentence, n) == each - n), 0)
        name = each + 1 + 2 * (words[each + 1 : each + 3] == ["of", "the"])
        each = each if name + 1 < len(words) else 0
        counted = bool(each) and name + 2 < len(words) and numeral(words[name]) > 1
        if counted:
            numbers[next(iter(singulars(words[name + 1])), "")] = numeral(words[name])
            name += 1
        ends = sentence[name + 1].mark if each else False
        goal = next(iter(singulars(words[name])), words[name]) if each else ""
        several = numbers.get(goal, 0)
        single = words[0] in _PUTTING and words[1] in ("a", "an", "one")
        if single and at and ends and several > 1 and numbers.get(words[at - 1]) == several:
            the, many = replace(sentence[1], text="the"), replace(sentence[at - 1], text=plural(words[at - 1]))
            goals = [replace(sentence[each], text="the"), *sentence[name - counted : name]]
            goals += [replace(sentence[name], text=plural(goal)), *sentence[name + 1 :]]
            sentence = [sentence[0], the, *sentence[2 : at - 1], many, *sentence[at:each], *goals]
        for count, token in zip(words, sentence[1:], strict=False):
            if numeral(count) > 1 and singulars(token.text):
                numbers[next(iter(singulars(token.text)))] = numeral(count)
        made.append(sentence)
    return made
