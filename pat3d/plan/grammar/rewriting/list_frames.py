"""Frames around what is listed, in plainer words: "a row of a cup and a jar" is "a cup and a jar in a row"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.wordings import reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexicon import STANDING
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import EACH_OTHER
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.number_words import number_of
from pat3d.plan.grammar.words.vocabulary import Nouns

_ONE = frozenset({"a", "an", "one", "the"})
_OF_KINDS = frozenset({"has", "have", "contains", "contain", "includes", "include"})
_EACH_SHELF = [["on", each, "shelf"] for each in ("each", "every")]
_SHELVED = ("bookshelf", "cabinet", "wardrobe", "dresser", "fridge", "tv stand", "cart")
_ON = (("on",), ("atop",), ("on", "top", "of"))
_PLACES = {
    **{("one", near, each, "corner"): "in the corners of" for near in ("in", "at", "on") for each in ("each", "every")},
    **{("one", near, each, "end"): "at the ends of" for near in ("at", "on") for each in ("each", "either", "every")},
    **{("at", which, "ends"): "at the ends of" for which in ("its", "opposite", "the", "both")},
    **{(near, one, "corner"): "in a corner of" for near in ("in", "at") for one in ("a", "one", "the")},
    **{(near, "the", "edge"): "at the edge of" for near in ("at", "on", "near")},
}
"""Places behind a comma, as they are said of a surface."""
_EACH_OF = {(4, "sides"): "around", (2, "ends"): "at the ends of", (4, "corners"): "in the corners of"}
"""All of the sides that a thing has, and where is what stands at each."""
_NOT_ONLY = wordings(((r"not (?:only|just) ((?:[^ ]+ )+?)(?:, )?but (?:also |even )?", r"\1 and"),))


def listed_plainly(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence without the frames around a list."""
    tokens = _other_level(_heading(tokens, nouns))
    tokens = _on_each_shelf(_of_what_kind(reworded(_on_itself(tokens, nouns), _NOT_ONLY), nouns), nouns)
    return _form_ahead(_rows_of(_at_places_of(_at_each_of(tokens)), nouns))


def _heading(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "kitchen counter, a bowl, two eggs" as "kitchen counter: a bowl, two eggs": they are on it."""
    words = [token.text for token in tokens]
    comma = words.index(",") if "," in words[:-1] else 0
    name = nouns.match(words[:comma]) if comma else None
    table = name is not None and not name.plural and nouns.of_class(name.noun, lexicon.LEVEL)
    counted = bool({*words[comma + 1 : comma + 2]} & (lexicon.DETERMINERS - {"the"} | lexicon.NUMBERS.keys()))
    placed = any(link_at(tokens, n) and words[n] not in ("of", "with") for n in range(comma, len(words)))
    named = [nouns.match([word]) for word in words[comma:]]
    floor = any(found is not None and nouns.of_class(found.noun, lexicon.FLOOR) for found in named)
    if name is None or not (table and nouns.of_class(name.noun, lexicon.FLOOR) and counted) or placed or floor:
        return tokens
    return [*tokens[:comma], replace(tokens[comma], text=":"), *tokens[comma + 1 :]]


def _other_level(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "books on the lower shelf, a radio on the upper one" with "the upper shelf" for the second."""
    made, part = list[Token](), ""
    for at, token in enumerate(tokens):
        level = at > 1 and tokens[at - 1].text in (*lexicon.LEVELS, "middle") and tokens[at - 2].text == "the"
        if level and token.text in lexicon.STORAGE_PARTS:
            part = token.text
        made.append(replace(token, text=part) if level and part and token.text == "one" else token)
    return made


def _of_what_kind(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a dish of food that has rice and beans" as "a dish with rice and beans": that is the food."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 4):
        kind = {words[at], *singulars(words[at])} & lexicon.GENERICS.keys() and not nouns.match([words[at]])
        after = at + 3
        stands = words[at - 1] == "of" and words[at + 2] in STANDING and link_at(tokens, after)
        if kind and at > 1 and words[at + 1] in ("that", "which") and stands:
            # "A plate of food that is on a table": so is the plate.
            return [*tokens[: at + 1], *tokens[after:]]
        if not kind or words[at + 1] not in ("that", "which") or words[at + 2] not in _OF_KINDS:
            continue
        start = after + (words[after] in lexicon.DETERMINERS | lexicon.NUMBERS.keys())
        end = _end_of_name(words, start, nouns)
        placed = end and link_at(tokens, end) and words[end + link_at(tokens, end)] in lexicon.PRONOUNS
        if not end or placed:
            # "a table with food that has a vase on it"
            continue
        held = at > 0 and words[at - 1] in ("of", "with")
        told = replace(tokens[at + 1], text="with" if held else "including", end=tokens[at + 2].end)
        return [*tokens[: at - 1 if held else at + 1], told, *tokens[after:]]
    return list(tokens)


def _on_each_shelf(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "two bookshelves with four vases on every shelf" as "... on each": a shelf of theirs is no other.

    There are as many for each of them as for a shelf; that the shelf is none of its own a note says.
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(3, len(words) - 3) if words[n : n + 3] in _EACH_SHELF), 0)
    known = [found for n in range(1, at) if (found := nouns.match(words[n : n + 1])) is not None]
    owners = [found for found in known if nouns.of_class(found.noun, _SHELVED)]
    if not at or {"shelf", "shelves"} & {*words[:at]} or len(owners) != 1 or not owners[0].plural:
        return list(tokens)
    return [*tokens[: at + 1], replace(tokens[at + 1], text="each"), *tokens[at + 3 :]]


def _on_itself(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "on the desk itself" as "on the desk", and "a desk has on it a jar" as "a desk has a jar"."""
    words = [token.text for token in tokens]
    made: list[Token] = []
    for at, token in enumerate(tokens):
        if words[at] in ("itself", "themselves") and at and nouns.match([words[at - 1]]):
            continue
        behind = next((n for n in (1, 2) if at >= n and words[at - n] in ("has", "have")), 0)
        owned = behind and words[at - behind + 1] in ("on", "in") and words[at - behind + 2] in ("it", "them")
        after = words[min(at - behind + 3, len(words) - 1)]
        named = after in lexicon.DETERMINERS or after in lexicon.NUMBERS or after.isdecimal()
        if owned and named and words[max(at - behind - 1, 0)] not in (*lexicon.ROWS, "to", ","):
            continue
        made.append(token)
    return made


def _rows_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a row of a cup, a jar and a pan on a desk" as "a cup, a jar and a pan in a row on a desk"."""
    words = [token.text for token in tokens]
    for at in range(len(words) - 6):
        if words[at] != "a" or words[at + 1] not in lexicon.ROWS or words[at + 2] != "of" or words[at + 3] not in _ONE:
            continue
        end = _end_of_list(words, at + 3, nouns)
        if end:
            form = [
                replace(token, text=word) for token, word in zip(tokens[at : at + 3], ("in", "a", "row"), strict=True)
            ]
            return [*tokens[:at], *tokens[at + 3 : end], *form, *tokens[end:]]
    return list(tokens)


def _end_of_list(words: Sequence[str], start: int, nouns: Nouns) -> int:
    """The word behind "a cup, a jar and a pan" at word `start`; 0 where no list of single things is there."""
    at, joined = start, False
    while at < len(words) and words[at] in _ONE:
        at = _end_of_name(words, at + 1, nouns)
        if not at or joined:
            return at
        joined = words[at] == "and" or words[at : at + 2] == [",", "and"]
        if words[at] not in (",", "and"):
            return 0
        at += 1 + (words[at] == "," and joined)
    return 0


def _end_of_name(words: Sequence[str], start: int, nouns: Nouns) -> int:
    """The word behind the noun that "red glass bowl" at word `start` ends in; 0 where there is none."""
    for first in range(start, min(start + 4, len(words))):
        size = next((n for n in (3, 2, 1) if nouns.match(words[first : first + n])), 0)
        ends = size > 1 or not (is_modifier(words[first]) and nouns.match([words[first + 1]]))
        if size and ends:
            return first + size
        if not is_modifier(words[first]):
            return 0
    return 0


def _at_places_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "two forks are on a desk, one at each end" as "two forks are at the ends of a desk"."""
    words = [token.text for token in tokens]
    comma = next((n for n in range(len(words) - 4, 2, -1) if words[n] == ","), 0)
    end = len(words) - 3 if words[-3:-1] == ["of", "it"] else len(words) - 1
    said = _PLACES.get(tuple(words[comma + 1 : end])) if comma else None
    links: list[int] = []
    at = 0
    while at < comma:
        links += [at] if link_at(tokens, at) else []
        at += link_at(tokens, at) or 1
    if said is None or len(links) != 1:
        return list(tokens)
    start = links[0]
    owner = start + link_at(tokens, start)
    named = tuple(words[start:owner]) in _ON and words[owner] in lexicon.DETERMINERS
    if not start or not named or any(token.mark or token.text == "and" for token in tokens[owner:comma]):
        return list(tokens)
    place = [replace(tokens[start], text=word, end=tokens[owner - 1].end) for word in said.split()]
    return [*tokens[:start], *place, *tokens[owner:comma], tokens[-1]]


def _at_each_of(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "a stool at each of its four sides" as "4 stools around it"."""
    words = [token.text for token in tokens]
    for at in range(2, len(words) - 4):
        number = number_of(words[at + 4])
        part = words[at + 5] if number and at + 5 < len(words) else ""
        of = words[at + 6] == "of" if part and at + 6 < len(words) else False
        said = _EACH_OF.get((number, part))
        owned = words[at + 3] == "its" or (words[at + 3] == "the" and of)
        if (
            said is None
            or not owned
            or words[at] not in ("at", "on", "in", "by")
            or words[at + 1 : at + 3] != ["each", "of"]
        ):
            continue
        first = next(
            (n for n in range(at - 2, max(at - 6, -1), -1) if number_of(words[n]) or words[n] in ("a", "an")), -1
        )
        if first < 0 or any(token.mark or token.text in ("and", "of") for token in tokens[first:at]):
            continue
        each = number_of(words[first]) or 1
        several = replace(tokens[first], text=str(each * number))
        thing = tokens[at - 1] if words[at - 1].endswith("s") else replace(tokens[at - 1], text=f"{words[at - 1]}s")
        where = [replace(tokens[at], text=word, end=tokens[at + 5].end) for word in said.split()]
        it = [] if of else [replace(tokens[at + 3], text="it")]
        after = at + 6 + of
        return [*tokens[:first], several, *tokens[first + 1 : at - 1], thing, *where, *it, *tokens[after:]]
    return list(tokens)


def _form_ahead(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "side by side on a desk are a cup and a jar" as "on a desk are a cup and a jar side by side"."""
    words = [token.text for token in tokens]
    size = next((n for n in range(2, 5) if tuple(words[:n]) in EACH_OTHER and words[n : n + 1] != [","]), 0)
    if not size or not link_at(tokens, size):
        return list(tokens)
    verb = next((n for n in range(size + 2, len(words)) if words[n] in STANDING or words[n] == "there"), 0)
    stop = next((n for n in range(size, len(words)) if tokens[n].mark and words[n] != ","), 0)
    if not size < verb < stop:
        return list(tokens)
    return [*tokens[size:stop], *tokens[:size], *tokens[stop:]]
