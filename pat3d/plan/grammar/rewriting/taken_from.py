"""Where something is taken from, as what is there: "move the cup from the left of the plate to the right of it".

That is "the cup is to the left of the plate", and "move the cup to the right of the plate".
"""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import LINKS
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_SIDES = {"left": ("to", "the", "left", "of"), "right": ("to", "the", "right", "of"), "front": ("in", "front", "of"),
          "back": ("behind",), "rear": ("behind",)}  # fmt: skip
_OFF = (("off",), ("from",), ("off", "of"), ("out", "of"))
_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | {"it", "them"}
_SIDED = frozenset({"side", "end", "corner", "edge"})
_JOINING = frozenset({"and", "then", ",", "please"})
_RANKS = frozenset({"top", "bottom"})
_ENDING = frozenset({"and", "then", "to", "onto", "into"})


def from_where(sentence: list[Token]) -> list[Token]:
    """`sentence` with "get the shoe out from under the bed" as "get the shoe that is under the bed".

    "The opposite side of" is the other one: nothing is opposite something there.
    """
    made = list(sentence)
    for at in range(1, len(made) - 2):
        if (made[at - 1].text, made[at].text) == ("the", "opposite") and made[at + 1].text in _SIDED:
            made[at] = replace(made[at], text="other")
    for at in range(len(made) - 4, 1, -1):
        place = LINKS.get(tuple(token.text for token in made[at + 1 : at + 1 + link_at(made, at + 1)]))
        near = place is not None and not place.finite and (place.manner in ("under", "between") or (
            place.manner == "place" and place.kind in LATERAL_KINDS))  # fmt: skip
        behind = made[at + 1 + link_at(made, at + 1)].text
        if made[at].text != "from" or not near or link_at(made, at) > 1 or behind not in _LEADS:
            continue
        start = at - (made[at - 1].text in ("out", "up", "off"))
        pronoun = made[start - 1].text in lexicon.PRONOUNS
        told = [] if pronoun else [replace(made[start], text="that"), replace(made[at], text="is")]
        asks = (known_verb(made[n].text) for n in range(start - 1) if not n or made[n - 1].text in _JOINING)
        made[start : at + 1] = told if any(asks) else made[start : at + 1]
    return made


def from_side(sentence: list[Token], nouns: Nouns) -> list[list[Token]]:
    """Tell "move the cup from the left of the plate to the right of it" as two sentences."""
    sentence = from_where(sentence)
    words = [token.text for token in sentence]
    verb = int(words[0] == "please")
    first = verb + 1 + (words[min(verb + 1, len(words) - 1)] in ("up", "out"))
    at = next((n for n in range(first + 2, len(words) - 5) if words[n] == "from" and _side(words, n)), 0)
    moved = sentence[first:at]
    plain = not any(token.mark or link_at(sentence, n + first) for n, token in enumerate(moved))
    if not at or not plain or not known_verb(words[verb]) or words[first] not in lexicon.DEFINITE:
        return [sentence]
    of = at + _side(words, at)
    end = next(n for n in range(of + 1, len(words)) if sentence[n].mark or link_at(sentence, n) or words[n] in _ENDING)
    mark = sentence[of:end]
    found = nouns.match([words[end - 1]])
    many = words[first] in ("all", "both", "these", "those") or words[first + 1] in lexicon.NUMBERS
    level = found is not None and nouns.of_class(found.noun, lexicon.LEVEL)
    # What is on the left side of a table is on it.
    where = ("on", "the", words[at + 2], "side", "of") if level else _SIDES[words[at + 2]]
    there = [replace(sentence[at + 2], text=word) for word in ("are" if many else "is", *where)]
    rest = sentence[end:]
    to = _side(words[end:], 0) if not level and words[end] == "to" else 0
    if to:
        beside = [replace(rest[2], text=word) for word in _SIDES[rest[2].text]]
        again = [replace(each, number=rest[to].number, start=rest[to].start, end=rest[to].end) for each in mark]
        rest = [*beside, *(again if rest[to].text == "it" else [rest[to]]), *rest[to + 1 :]]
    return [[*moved, *there, *mark, replace(sentence[-1])], [*sentence[:at], *rest]]


def _side(words: list[str], at: int) -> int:
    """How many words "from the left side of" at word `at` has, where somewhere is named behind; 0 for others."""
    if words[at + 1 : at + 2] != ["the"] or words[min(at + 2, len(words) - 1)] not in _SIDES:
        return 0
    of = at + 3 + (words[at + 3] == "side")
    named = words[of] == "of" and words[of + 1] in lexicon.DETERMINERS | lexicon.POSSESSIVES | {"it"}
    return of + 1 - at if named else 0


def stack_of(sentence: list[Token]) -> list[Token]:
    """Read "the book at the bottom of the stack of four" as "... of the stack of four books".

    So is "a plate from the stack of plates" the top one of it.
    """
    sentence = _off_the_top(sentence)
    words = [token.text for token in sentence]
    for at in range(2, len(words) - 3):
        number = at + 2
        counted = words[at] in lexicon.TOWERS and words[at + 1] == "of" and words[number] in lexicon.NUMBERS
        if not counted or words[number] in ("a", "an", "one") or not (
            sentence[number + 1].mark or words[number + 1] in _ENDING
            or link_at(sentence, number + 1)):  # fmt: skip
            continue
        rank = next((n for n in range(at - 1, 1, -1) if words[n] in _RANKS), 0)
        if not rank or rank < at - 4:
            return sentence
        # "the book at the bottom of the stack", "the bottom book of the stack"
        name = words[rank + 1] if words[rank + 1] not in ("of", "in") else words[rank - 3] if rank > 2 else ""
        if not name.isalpha() or name in lexicon.DETERMINERS | {"one", "pick", "take"}:
            return sentence
        plural = f"{name}es" if name.endswith(("s", "x", "ch", "sh")) else f"{name}s"
        ones = replace(sentence[number], text=plural)
        return [*sentence[: number + 1], ones, *sentence[number + 1 :]]
    return sentence


def _off_the_top(sentence: list[Token]) -> list[Token]:
    words = [token.text for token in sentence]
    for at in range(3, len(words) - 4):
        piled = words[at + 2] == "of" and words[at + 1] in lexicon.TOWERS and words[at] in ("the", "a", "that", "this")
        off = next((at - size for size in (2, 1) if tuple(words[at - size : at]) in _OFF), 0)
        if not piled or off < 2 or words[off - 2] not in ("the", "a", "an", "one"):
            continue
        listed = at + 3 + (words[at + 3] in lexicon.NUMBERS or words[at + 3] in lexicon.DETERMINERS)
        if words[off - 1] in singulars(words[listed]):
            one, name = sentence[off - 2 : off]
            return [*sentence[: off - 2], replace(one, text="the"), replace(name, text="top"), *sentence[off - 1 :]]
    return sentence
