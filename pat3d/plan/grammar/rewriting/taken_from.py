"""Where something is taken from, as what is there: "get the shoe out from under the bed"."""

from __future__ import annotations

from dataclasses import replace

from pat3d.plan.grammar.rewriting.instructions import known_verb
from pat3d.plan.grammar.rewriting.wordings import reworded, wordings
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.links import LINKS
from pat3d.plan.grammar.words.vocabulary import Nouns
from pat3d.scene.relations import LATERAL_KINDS

_SIDES = {"left": ("to", "the", "left", "of"), "right": ("to", "the", "right", "of"), "front": ("in", "front", "of"),
          "back": ("behind",), "rear": ("behind",)}  # fmt: skip
_COUNTED = rf"(?:(?:{'|'.join(lexicon.NUMBERS.keys() | lexicon.DETERMINERS)}) )?"
_OFF_THE_TOP = wordings(((
    rf"(?:the|a|an|one) (?P<one>\w+) ((?:off|from|off of|out of) (?:the|a|that|this) (?:{'|'.join(lexicon.TOWERS)}) of "
    rf"{_COUNTED}(?P=one)e?s )", r"the top \1 \2"),))  # fmt: skip
_LEADS = lexicon.DETERMINERS | lexicon.POSSESSIVES | lexicon.NUMBERS.keys() | {"it", "them"}
_SIDED = frozenset({"side", "end", "corner", "edge"})
_HANGING = frozenset({"hang", "suspend", "dangle"})
_JOINING = frozenset({"and", "then", ",", "please"})
_RANKS = frozenset({"top", "bottom"})
_ENDING = frozenset({"and", "then", "to", "onto", "into"})


def from_where(sentence: list[Token], nouns: Nouns) -> list[Token]:
    """`sentence` with "get the shoe out from under the bed" as "get the shoe that is under the bed".

    "The opposite side of" is the other one. What is to hang "from" a hook is on it afterwards.
    """
    made, hangs = list(sentence), False
    for at in range(1, len(made) - 2):
        verb = made[at - 1].text
        deed = verb in _HANGING and (at == 1 or made[at - 2].text in _JOINING)
        hangs = deed or (hangs and not known_verb(verb))
        made[at - 1] = replace(made[at - 1], text="hang") if deed else made[at - 1]
        if hangs and made[at].text in ("from", "off") and made[at + 1].text in _LEADS:
            made[at] = replace(made[at], text="on")
        if (made[at - 1].text, made[at].text) == ("the", "opposite") and made[at + 1].text in _SIDED:
            made[at] = replace(made[at], text="other")
    for at in (n for n in range(len(made) - 4, 1, -1) if made[n].text == "from"):
        words = [token.text for token in made]
        size, sided = link_at(made, at + 1), _side(words, at)
        place = LINKS.get(tuple(words[at + 1 : at + 1 + size])) if link_at(made, at) == 1 else None
        near = place is not None and not place.finite and (place.manner in ("under", "between") or (
            place.manner == "place" and place.kind in LATERAL_KINDS))  # fmt: skip
        of = at + (sided or 1 + size)
        asks = (known_verb(words[n]) for n in range(at - 1) if not n or words[n - 1] in _JOINING)
        if not (sided or near) or words[of] not in _LEADS or not any(asks):
            continue
        end = next(n for n in range(of + 1, len(words)) if made[n].mark or link_at(made, n) or words[n] in _ENDING)
        found = nouns.match([words[end - 1]]) if sided else None
        level = found is not None and nouns.of_class(found.noun, lexicon.LEVEL)
        # What is on the left side of a table is on it.
        where = _SIDES[words[at + 2]] if sided else words[at + 1 : of]
        where = ("on", "the", words[at + 2], "side", "of") if level else where
        start = at - (words[at - 1] in ("out", "up", "off"))
        told = [] if words[start - 1] in lexicon.PRONOUNS else ["that", "is"]
        # "From the front of the plate to the back of it"
        back = _side(words, end) if sided and not level and words[end + 2 : end + 3] in (["back"], ["rear"]) else 0
        rest = [*([replace(made[end], text="behind")] if back else []), *made[end + back :]]
        made[start:] = [*(replace(made[at], text=word) for word in (*told, *where)), *made[of:end], *rest]
    return made


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
    sentence = reworded(sentence, _OFF_THE_TOP)
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
        plural = name if singulars(name) else f"{name}es" if name.endswith(("s", "x", "ch", "sh")) else f"{name}s"
        ones = replace(sentence[number], text=plural)
        return [*sentence[: number + 1], ones, *sentence[number + 1 :]]
    return sentence
