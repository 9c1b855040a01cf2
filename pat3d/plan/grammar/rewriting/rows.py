"""Rows told before what stands in them: "Row 1: a cup, a can", "the front row has two cups, the back row three".

Each becomes "a cup and a can are in a row".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import FINITE
from pat3d.plan.grammar.words.modifiers import is_colour_word, is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_HAVING = (("consists", "of"), ("consisting", "of"), ("made", "up", "of"), ("has",), ("contains",), ("holds",),
           ("containing",), ("is", "made", "of"), ("consist", "of"), ("of",))  # fmt: skip
_SIDES = ("end", "side")
_ROWS = ("row", "line")
_OPPOSITE = {("front", "back"): "in front of", ("back", "front"): "behind", ("first", "second"): "in front of"}
"""How the first row stands to the second."""

_STACKS = frozenset({"stack", "tower", "pile"})
_UPWARDS = (("from", "bottom", "to", "top"), ("from", "top", "to", "bottom"))
_ORDERS = (["from", "left", "to", "right"], ["from", "right", "to", "left"])
_ONE_EACH = (
    ("one and one", "one of them and one", "one and the other", "the front one and the back one",
     "the front row and the back row", "the first and the second", "the front and the back"),
    ("the back one and the front one", "the back row and the front row", "the second and the first"),
)  # fmt: skip
"""What tells two rows apart around their colours, from the front and from the back."""


def _there_too(tokens: Sequence[Token], nouns: Nouns) -> Sequence[Token]:
    """`tokens` with "there are two jars in a row and a cup on it" as "two jars in a row and a cup are on it"."""
    words = [token.text for token in tokens]
    row = next((n for n in range(3, len(words) - 6) if words[n : n + 2] == ["in", "a"] and words[n + 2] in _ROWS), 0)
    if words[:2] != ["there", "are"] or not row or words[row + 3] not in ("and", ",") or FINITE & {*words[2:]}:
        return tokens
    links = [n for n in range(2, len(words)) if n != row and link_at(tokens, n)]
    match = nouns.match([words[row - 1]])
    if len(links) != 1 or links[0] < row or words[links[0]] != "on" or match is None:
        return tokens
    on = links[0]
    loose = any(token.mark for token in tokens[on:-1]) or tokens[on - 1].mark
    if loose or nouns.of_class(match.noun, lexicon.FLOOR):
        return tokens
    return [*tokens[2:on], replace(tokens[1], text="are"), *tokens[on:]]


def told_rows(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with what stands in a row before the row."""
    if " ".join(each.text for each in tokens[-4:-1]) == "between the rows":  # "with a jug between the rows": in no cup
        tokens = [replace(token, text="and") if token.text == "with" else token for token in tokens]
    told = _end_to_end(_told_stack(_from_one_end(_there_too(tokens, nouns), nouns)))
    tokens = _at_its_end(_of_a_kind(_of_two_colours(told), nouns))
    words = [token.text for token in tokens]
    colon = words.index(":") if ":" in words else 0
    if words[0] == "row" and colon and words[1].isdecimal():
        return _stand(tokens, list(tokens[colon + 1 : -1]), nouns)
    if words[:2] == ["a", "row"] and (size := _having(words, 2)) and words[2] != "of":
        return _stand(tokens, list(tokens[2 + size : -1]), nouns)
    if words[0] != "the" or words[2:3] != ["row"] or not (size := _having(words, 3)):
        return list(tokens)
    other = next((n for n in range(4, len(words) - 3) if words[n] == "the" and words[n + 2] == "row"), 0)
    relation = _OPPOSITE.get((words[1], words[other + 1])) if other else None
    if relation is None:
        return list(tokens)
    end = other
    while words[end - 1] in (",", "and", "while"):
        end -= 1
    here = list(tokens[3 + size : end])
    behind = list(tokens[other + 3 + _having(words, other + 3) : -1])
    if not (here and behind):
        return list(tokens)
    if len(behind) == 1:
        # "The front row has two cups, the back row three."
        behind += [token for token in here if token.text not in lexicon.NUMBERS and not token.text.isdecimal()]
    made = [replace(here[0], text=word) for word in ("a", "row", "of")]
    row = [replace(behind[0], text=word) for word in ("is", *relation.split(), "a", "row", "of")]
    return [*made, *here, *row, *behind, tokens[-1]]


def _at_its_end(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "three cans in a row, a jar at the end of the row" as "..., a jar at the right end"."""
    words = [token.text for token in tokens]
    for at in range(4, len(words) - 5):
        end = at + 2 + (words[at + 2] in ("left", "right", "far"))
        row = words[end + 3] if words[end : end + 3] == ["end", "of", "the"] else ""
        if words[at] in ("at", "on") and words[at + 1] == "the" and row in ("row", "line") and row in words[:at]:
            side = replace(tokens[at + 1], text=words[at + 2] if words[at + 2] == "left" else "right")
            return [*tokens[: at + 2], side, tokens[end], *tokens[end + 4 :]]
    return list(tokens)


def _of_a_kind(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a row of toys on a shelf: a car and a ball" as "a car and a ball are in a row on a shelf"."""
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 6) if words[n : n + 3] == ["a", "row", "of"]), -1)
    colon = words.index(":", at + 3) if at >= 0 and ":" in words[at + 4 :] else 0
    if not colon:
        return list(tokens)
    stop = next(n for n in range(colon, len(words)) if words[n] == ".")
    kind = words[at + 3]
    general = {kind, *singulars(kind)} & lexicon.GENERICS.keys() or nouns.match([kind]) is None
    place = tokens[at + 4 : colon]
    led = not at or words[at - 1] in FINITE
    if not general or not led or is_modifier(kind) or (place and not link_at(tokens, at + 4)):
        return list(tokens)
    if any(token.mark for token in place) or sum(word in ("a", "an", "one", "and") for word in words[colon:stop]) < 2:
        return list(tokens)
    are = [] if at else [replace(tokens[at], text="are")]
    row = [replace(tokens[at + n % 2], text=word) for n, word in enumerate(("in", "a", "row"))]
    return [*tokens[:at], *tokens[colon + 1 : stop], *are, *row, *place, *tokens[stop:]]


def _end_to_end(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "from one end to the other" as "from left to right", and "of the bench" in it as "on the bench".

    Where something is to be done the other is that end: "move the cup from one end of the bench to the other".
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 6) if words[n : n + 2] == ["from", "one"] and words[n + 2] in _SIDES), -1)
    to = next((n for n in range(at + 3, min(at + 9, len(words) - 2)) if words[n : n + 3] == ["to", "the", "other"]), 0)
    if at < 0 or not to or any(token.mark for token in tokens[at:to]):
        return tokens
    again = words[to + 3] == words[at + 2]
    if known_verb(words[0]):
        other = [] if again else [replace(tokens[to + 2], text=words[at + 2])]
        return [*tokens[: to + 3], *other, *tokens[to + 3 :]]
    place = list(tokens[at + 3 : to])
    if not place or place[-1].text in words[:at] or place[-1].text in lexicon.PRONOUNS:
        place = []
    else:
        place[0] = replace(place[0], text="on")
    row = [replace(tokens[at], text=word) for word in ("from", "left", "to", "right")]
    return [*tokens[:at], *place, *row, *tokens[to + 3 + again :]]


def _told_stack(tokens: Sequence[Token]) -> Sequence[Token]:
    """`tokens` with "the stack consists of, from bottom to top, a cup and a can" as "a stack, ...: a cup and a can"."""
    words = [token.text for token in tokens]
    # "A stack of books is on a desk. The stack consists of ...": of those books.
    led = words[0] in (("the", "a") if tokens[0].number == 1 else ("a",)) and words[1:2] and words[1] in _STACKS
    is_ = words[2:4] == ["is", "made"]
    size = is_ + _having(words, 2 + is_) if led else 0
    if size < 2 or words[2] not in ("consists", "is"):
        return tokens
    a, first = replace(tokens[0], text="a"), 2 + size
    comma = first + (words[first] == ",")
    if tuple(words[comma : comma + 4]) not in _UPWARDS:
        return [a, tokens[1], replace(tokens[first - 1], text="of"), *tokens[first:]]
    mark = replace(tokens[1], text=",", mark=True)
    behind = comma + 4 + (words[comma + 4] in (",", ":"))
    return [a, tokens[1], mark, *tokens[comma : comma + 4], replace(mark, text=":"), *tokens[behind:]]


def _from_one_end(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a desk, from the left: a mug, a can" as "on a desk, from left to right: a mug, a can"."""
    made: list[Token] = []
    at = 0
    while at < len(tokens):
        words = [token.text for token in tokens[at : at + 3]]
        size = 2 + (words[1:2] == ["the"])
        end = tokens[min(at + size, len(tokens) - 1)]
        ahead = not made or made[-1].mark or made[-1].text in FINITE
        side = words[size - 1] if words[:1] == ["from"] and len(words) >= size else ""
        if ahead and side in ("left", "right") and end.text in (":", ","):
            last = tokens[at + size - 1]
            other = "right" if side == "left" else "left"
            made += [tokens[at], *(replace(last, text=word) for word in (side, "to", other))]
            at += size
            continue
        made.append(tokens[at])
        at += 1
    colon = next((n for n, token in enumerate(made) if token.text == ":"), 0)
    order = next((n for n in range(2, colon) if made[n].mark), 0)
    named = nouns.longest([token.text for token in made[:order]]) if order + 5 == colon else None
    said = [token.text for token in made[order + 1 : colon]]
    if named is None or said not in _ORDERS or made[0].text not in lexicon.DETERMINERS:
        return made
    if any(token.text in FINITE or link_at(made, n) for n, token in enumerate(made[:order])):
        return made
    level = nouns.of_class(named[0].noun, lexicon.LEVEL)
    return [replace(made[0], text="on"), *made] if level else made


def _of_two_colours(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "two rows of cans, one red and one blue" as "a row of red cans is in front of a row of blue cans".

    "The front one red and the back one blue" says which; where nothing does, the first is in front.
    """
    words = [token.text for token in tokens]
    at = next((n for n in range(len(words) - 9) if words[n : n + 3] == ["two", "rows", "of"]), -1)
    comma = next((n for n in range(len(words) - 6, 2, -1) if words[n] == "," and at >= 0), 0)
    said = words[comma + 1 : -1]
    pair = [word for word in said if is_colour_word(word)]
    rest = " ".join(word for word in said if word not in pair)
    order = next((turn for turn, told in enumerate(_ONE_EACH) if rest in told), -1)
    opens = not at or (words[at - 1] in FINITE and (at == 2 or link_at(tokens, 0) > 0))
    if order < 0 or len(pair) != 2 or pair[0] == pair[1] or not opens:
        return list(tokens)
    end = next(n for n in range(at + 3, comma + 1) if n == comma or words[n] in FINITE or link_at(tokens, n))
    number = at + 3 + (words[at + 3] in lexicon.NUMBERS or words[at + 3].isdecimal())
    front, back = (
        next(token for token in tokens[comma:] if token.text == word) for word in pair[:: -1 if order else 1]
    )
    row = [replace(tokens[at], text=word) for word in ("a", "row", "of")]
    stands = [replace(tokens[at + 1], text=word) for word in ("is", "in", "front", "of")]
    first, second = ([*row, *tokens[at + 3 : number], colour, *tokens[number:end]] for colour in (front, back))
    there = [token for token in tokens[: max(0, at - 1)] if token.text not in ("there", *FINITE)]
    place = [*tokens[end + (words[end] in FINITE) : comma], *there]
    return [*first, *stands, *second, *place, tokens[-1]]


def _having(words: Sequence[str], at: int) -> int:
    return next((len(said) for said in _HAVING if tuple(words[at : at + len(said)]) == said), 0)


def _stand(tokens: Sequence[Token], named: list[Token], nouns: Nouns) -> list[Token]:
    """`named` with an article before each thing that has none, "in a row"."""
    if not named:
        return list(tokens)
    made: list[Token] = []
    for at, token in enumerate(named):
        opens = not at or named[at - 1].mark or named[at - 1].text == "and"
        bare = token.text not in lexicon.DETERMINERS | lexicon.NUMBERS.keys() and not token.text.isdecimal()
        last = next((n for n in range(at, len(named)) if named[n].mark or named[n].text == "and"), len(named)) - 1
        match = nouns.match([named[last].text]) if last >= at else None
        if opens and bare and match is not None and not match.plural:
            made.append(replace(token, text="a"))
        made.append(token)
    row = [replace(named[-1], text=word) for word in ("are", "in", "a", "row")]
    return [*made, *row, tokens[-1]]
