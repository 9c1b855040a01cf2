"""What is said behind "on it" of the thing that is on it: "a desk with a bucket on it that holds a comb"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.links import FINITE, LINKS
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import number_of
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import SUPPORT_KINDS

_HOLDING = frozenset({"holds", "hold", "contains", "contain", "carries", "carry"})
_OF_ALL = ([",", "all", "on"], [",", "all", "in"], [",", "each", "with"])
_TOO = (("too",), ("as", "well"))


def of_the_carried(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a desk with a bucket on it that holds a comb" as "... on it. The bucket holds a comb"."""
    return _as_many(_its_own(_on_it_too(_rug_under(_also_there(list(tokens), nouns), nouns)), nouns), nouns)


def _rug_under(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a lamp on the table and a rug under it" as "... under the table": no rug lies on a table."""
    words = [token.text for token in tokens]
    for at in (n for n in range(5, len(words)) if words[n] == "it"):
        under = LINKS.get((words[at - 1],), None)
        rug = nouns.match([words[at - 2 - (words[at - 2] in lexicon.STANDING)]])
        on = max((n for n in range(at) if words[n] == "on" and words[n + 1] in lexicon.DETERMINERS), default=0)
        stop = next(n for n in range(on + 1, len(words)) if tokens[n].mark or words[n] in FINITE | {"and", "with"})
        table = nouns.longest(words[on + 2 : stop]) if on and under is not None and under.manner == "under" else None
        alone = not any(link_at(tokens, n) and words[n] != "with" for n in range(stop, at - 1))
        floor = (*lexicon.FLOOR, "mat")
        if rug and table and alone and nouns.of_class(rug.noun, floor) and nouns.of_class(table[0].noun, floor):
            name = [replace(tokens[at], text=word) for word in ("the", *words[on + 2 : stop])]
            return [*tokens[:at], *name, *tokens[at + 1 :]]
    return tokens


def _also_there(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "on the desk is a lamp. There is also a pen." as "... There is a pen on the desk."."""
    words, place, start = [token.text for token in tokens], list[Token](), 0
    for stop in [n for n, word in enumerate(words) if word == "."]:
        said = words[start:stop]
        opens = (n for n in range(min(3, len(said) - 2)) if said[n] == "there" and said[n + 1] in ("is", "are"))
        there = next(opens, -1)
        more = {"also", *(each[-1] for each in _TOO)} & {*said[:there], said[there + 2], said[-1]} if there >= 0 else {}
        links = [n for n in range(start, stop) if link_at(tokens, n) and words[n] not in ("of", "with", "as")]
        names = [found for n in range(start, stop) if (found := nouns.match(words[n : n + 1])) is not None]
        floor = any(nouns.of_class(found.noun, lexicon.FLOOR) for found in names)
        if more and place and not links and not floor:
            at = [replace(each, start=tokens[stop].start, end=tokens[stop].start) for each in place]
            return _also_there([*tokens[:stop], *at, *tokens[stop:]], nouns)
        if not more:
            place = _fronted(tokens[start : stop + 1], [n - start for n in links], nouns)
        start = stop + 1
    return tokens


def _fronted(tokens: list[Token], links: list[int], nouns: Nouns) -> list[Token]:
    """Where the things of a sentence are told to be before they are named, or in "with a fig in it"; or nothing."""
    words = [token.text for token in tokens]
    size = link_at(tokens, links[0]) if len(links) == 1 else 0
    link = LINKS.get(tuple(words[links[0] : links[0] + size])) if size else None
    if link is None or link.kind not in SUPPORT_KINDS or link.inverse:
        return []
    end = links[0] + size
    joint = next((n for n, word in enumerate(words) if word in ("and", "with")), 0) if words[end] == "it" else 0
    stop = joint or next((n for n in range(end, len(words)) if words[n] in ("is", "are", "there", ",")), 0)
    found = nouns.longest(words[end * (not joint) : stop]) if joint or not links[0] else None
    if found is None or nouns.of_class(found[0].noun, lexicon.SEATS):
        return []
    the = [replace(tokens[links[0]], text="the")] if joint else []
    return [*tokens[links[0] : end], *the, *tokens[stop - len(found[1]) if joint else end : stop]]


def _its_own(tokens: list[Token], nouns: Nouns) -> list[Token]:
    words = [token.text for token in tokens]
    for at in range(4, len(words) - 3):
        place = words[at - 2] in ("on", "in", "inside") and words[at - 1] == "it"
        stop = next(n for n in range(at, len(words)) if tokens[n].mark)
        if words[at] not in ("that", "which") or not place or words[at + 1] not in _HOLDING or words[stop] != ".":
            continue
        size = next((n for n in (3, 2, 1) if n < at - 2 and nouns.match(words[at - 2 - n : at - 2])), 0)
        lead = at - 2 - size
        while lead and is_modifier(words[lead - 1]):
            lead -= 1
        counted = words[lead - 1] in lexicon.NUMBERS or words[lead - 1].isdecimal()
        if size and (counted or words[lead - 1] in lexicon.DETERMINERS) and words[lead - 2] == "with":
            cut = replace(tokens[at], text=".", mark=True, end=tokens[at].start)
            name = tokens[at - 2 - size : at - 2]
            return [*tokens[:at], cut, replace(tokens[at], text="the"), *name, *tokens[at + 1 :]]
    return tokens


def _on_it_too(tokens: list[Token]) -> list[Token]:
    """`tokens` with "a tray with a cup on it and a fork on it too" as "a tray with a cup and a fork on it"."""
    words = [token.text for token in tokens]
    for at in range(3, len(words) - 5):
        here = words[at : at + 2]
        if here not in (["on", "it"], ["in", "it"]) or words[at + 2] != "and" or "with" not in words[:at]:
            continue
        again = next((n for n in range(at + 4, min(at + 10, len(words) - 1)) if words[n : n + 2] == here), 0)
        too = next((said for said in _TOO if tuple(words[again + 2 : again + 2 + len(said)]) == said), ())
        if again and too and not any(token.mark for token in tokens[at:again]):
            return [*tokens[:at], *tokens[at + 2 : again + 2], *tokens[again + 2 + len(too) :]]
    return tokens


def _as_many(tokens: list[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two cups on saucers, a spoon on each saucer" as "two cups on two saucers, ..."."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 3):
        size, name = next(((n, one) for n in (2, 1) if (one := nouns.match(words[at : at + n])) is not None), (0, None))
        first = at
        while first > 2 and is_modifier(words[first - 1]) and words[first - 1] != "in":
            first -= 1
        if name is None or not name.plural or words[first - 1] not in ("on", "in"):
            continue
        above = next((n for n in range(first - 2, 0, -1) if nouns.match(words[n : first - 1])), 0)
        lead = above
        while lead and is_modifier(words[lead - 1]) and not number_of(words[lead - 1]):
            lead -= 1
        stop = next((n for n in range(at, len(words)) if words[n] == "."), len(words))
        apiece = [words[n + 1 : n + 1 + size] for n in range(at + size, stop) if words[n] in ("each", "every")]
        again = any((one := nouns.match(said)) is not None and one.noun == name.noun for said in apiece)
        all_ = any(words[n : n + 3] in _OF_ALL for n in range(at, stop))
        if above and lead and number_of(words[lead - 1]) and (again or all_):
            number = replace(tokens[lead - 1], start=tokens[first].start, end=tokens[first].start)
            return [*tokens[:first], number, *_on_one(tokens[first:], tokens[at : at + size], again)]
    return tokens


def _on_one(tokens: list[Token], name: Sequence[Token], again: bool) -> list[Token]:
    """`tokens` with "a spoon on each saucer, all on a tray" as "a spoon on each saucer. The saucers are on a tray"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words)) if words[n : n + 3] in _OF_ALL[:2]), 0) if again else 0
    if not at:
        return tokens
    the, are = (replace(tokens[at + 1], text=word) for word in ("the", "are"))
    return [*tokens[:at], replace(tokens[at], text="."), the, *name, are, *tokens[at + 2 :]]
