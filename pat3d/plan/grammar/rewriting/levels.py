"""What is at the top or at the bottom of a stack: one of the stack, what stands on it, or what it stands on.

"A red cube is at the bottom of a tower of three cubes" becomes "a stack of a red cube and two cubes", "the plate at the
bottom of the stack" becomes "the bottom plate", and "at the bottom of a bowl" is in it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from pat3d.plan.grammar.rewriting.instructions import VERBS
from pat3d.plan.grammar.words import lexicon, vessels
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_LEVELS = {"top": "top", "bottom": "bottom", "base": "bottom", "foot": "bottom"}
_BESIDE = frozenset({"base", "foot"})
"""What other things than those of the stack stand beside."""
_FAR_ENDS = ("table", "desk", "bed", "rug", "mat", "carpet", "placemat", "chessboard")
"""Of what lies flat the top is its far end."""
_PUTTING = frozenset({"make", "move", "stack"})


@dataclass(frozen=True, kw_only=True)
class _Level:
    """Where in a sentence something is said to be at a level of what."""

    at: int
    """Of "at the top of"."""
    end: int
    """The token behind "of", or behind "the top" where there is none."""
    word: str
    first: int
    last: int
    """What is there: from its article up to its noun."""
    stated: bool
    """Whether a verb stands between the two: "is at the top"."""
    of: bool


def at_levels(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` of one sentence with what is at a level of something in words of who is on whom."""
    words = [token.text for token in tokens]
    found = [at for at in range(1, len(words) - 3) if words[at] in ("at", "on") and words[at + 1] == "the"
             and words[at + 2] in _LEVELS and (words[at] != "on" or words[at + 2] != "top")]  # fmt: skip
    middle = any(
        words[n : n + 2] in (["the", "middle"], ["the", "centre"], ["the", "center"]) for n in range(len(words))
    )
    if len(found) != 1 or middle or "on top" in " ".join(words):
        return list(tokens)
    level = _told(tokens, found[0], nouns)
    if level is None:
        return list(tokens)
    head = level.end + 1
    while level.of and head < len(words) - 1 and is_modifier(words[head]):
        head += 1
    verbs = words[: min(level.first, 3)]
    putting = any(
        VERBS.get(word) in _PUTTING and words[n - 1] not in lexicon.DETERMINERS for n, word in enumerate(verbs)
    )
    if level.of and words[head] in lexicon.TOWERS:
        if putting or words[head + 1] != "of":
            return _of_the_stack(tokens, level, head, putting=putting)
        return _of_a_stack(tokens, level, head, nouns)
    if level.of:
        return _of_a_thing(tokens, level, nouns)
    return list(tokens) if putting else _alone(tokens, level, nouns)


def _told(tokens: Sequence[Token], at: int, nouns: Nouns) -> _Level | None:
    words = [token.text for token in tokens]
    last = at
    while last > 1 and words[last - 1] in lexicon.COPULAS | lexicon.VERBS | lexicon.PARTICIPLES | {"goes", "comes"}:
        last -= 1
    named = last > 0 and (words[last - 1] == "one" or nouns.match([words[last - 1]]) is not None)
    first = last - 1
    while first > 0 and (is_modifier(words[first - 1]) or nouns.match(words[first - 1 : last])):
        first -= 1
    first -= first > 0 and words[first - 1] in ("a", "an", "the")
    if not named or words[first] not in ("a", "an", "the"):
        return None
    of = words[at + 3] == "of" and words[at + 4] in ("a", "an", "the", "this", "that")
    if words[at + 3] == "of" and not of:
        return None
    return _Level(at=at, end=at + 3 + of, word=words[at + 2], first=first, last=last, stated=last < at, of=of)


def _of_a_thing(tokens: Sequence[Token], level: _Level, nouns: Nouns) -> list[Token]:
    """Read "at the top of a cake" as on it, and "at the bottom of a bowl" as in it."""
    size = next((n for n in range(3, 0, -1) for at in range(level.end + 1, level.end + 3)
                 if nouns.match([token.text for token in tokens[at : at + n]])), 0)  # fmt: skip
    names = (
        nouns.match([token.text for token in tokens[at : at + size]]) for at in range(level.end + 1, level.end + 3)
    )
    name = next((found for found in names if size and found), None)
    if name is None:
        return list(tokens)
    if level.word == "top" and not nouns.of_class(name.noun, _FAR_ENDS):
        said = ("on", "top", "of")
    elif level.word == "bottom" and nouns.of_class(name.noun, (*vessels.HOLLOW, *vessels.OPENED)):
        said = ("in",)
    else:
        return list(tokens)
    return [*tokens[: level.at], *_said(tokens[level.at], said), *tokens[level.end :]]


def _of_the_stack(tokens: Sequence[Token], level: _Level, head: int, *, putting: bool) -> list[Token]:
    """Read "the plate at the bottom of the stack" as "the bottom plate", "at the top of the stack" as on it."""
    thing = list(tokens[level.first : level.last])
    side, like = _LEVELS[level.word], tokens[level.at]
    behind = list(tokens[head + 1 :])
    if not putting and not level.stated and thing[0].text == "the":
        # That they are stacked may not have been said before.
        return [*tokens[: level.first], thing[0], *_said(like, ("stacked", side)), *thing[1:], *behind]
    if side == "top":
        return [*tokens[: level.at], *_said(like, ("on", "top", "of")), *tokens[level.end :]]
    return _ranked(tokens, level, behind) if not putting and thing[0].text != "the" else list(tokens)


def _ranked(tokens: Sequence[Token], level: _Level, behind: Sequence[Token]) -> list[Token]:
    """Read "a red block is at the bottom" as "the bottom block is red"; as it is where it is not described."""
    thing, like = tokens[level.first : level.last], tokens[level.at]
    described = thing[1:-1]
    if not described or not level.stated or not all(is_modifier(token.text) for token in described):
        return list(tokens)
    of = _said(like, ("the", _LEVELS[level.word]))
    return [*tokens[: level.first], *of, thing[-1], *_said(like, ("is",)), *described, *behind]


def _alone(tokens: Sequence[Token], level: _Level, nouns: Nouns) -> list[Token]:
    """Read "the plate at the bottom" as "the bottom plate", and "a stack of cups with a bowl at the bottom"."""
    words = [token.text for token in tokens]
    thing = list(tokens[level.first : level.last])
    behind = list(tokens[level.end :])
    if thing[0].text == "the":
        if level.stated:
            return _ranked(tokens, level, behind)
        return [*tokens[: level.first], thing[0], *_said(tokens[level.at], (_LEVELS[level.word],)), *thing[1:], *behind]
    if level.stated or words[level.first - 1] not in ("with", "has", "having", "and") or level.first < 4:
        return list(tokens)
    head = next((n for n in range(level.first - 3, -1, -1) if words[n] in lexicon.TOWERS and words[n + 1] == "of"), -1)
    between = range(head + 2, level.first - 1)
    if head < 0 or any(tokens[n].mark or words[n] == "and" or link_at(tokens, n) for n in between):
        return list(tokens)
    if _LEVELS[level.word] == "top":
        with_it = [] if words[level.first - 1] == "has" else [tokens[level.first - 1]]
        joint = with_it or _said(tokens[level.first - 1], ("with",))
        on_top = _said(tokens[level.at], ("on", "top"))
        return [*tokens[: level.first - 1], *joint, *thing, *on_top, *behind]
    first = head
    while first > 0 and (is_modifier(words[first - 1]) or words[first - 1] in ("a", "an", "the")):
        first -= 1
    made = _stack(tokens[level.at], thing, tokens[head + 2 : level.first - 1], level, nouns)
    return list(tokens) if made is None else [*tokens[:first], *made, *behind]


def _of_a_stack(tokens: Sequence[Token], level: _Level, head: int, nouns: Nouns) -> list[Token]:
    """Read "a red cube is at the top of a stack of two blue cubes" as a stack of two blue cubes with it on top."""
    words = [token.text for token in tokens]
    stop = head + 2
    while not tokens[stop].mark and words[stop] not in ("and", "while") and not link_at(tokens, stop) and (
        words[stop] not in lexicon.COPULAS | lexicon.VERBS
    ):  # fmt: skip
        stop += 1
    thing, like = list(tokens[level.first : level.last]), tokens[level.at]
    members, behind = list(tokens[head + 2 : stop]), list(tokens[stop:])
    same = bool(members) and _same(thing[-1].text, members[-1].text, nouns)
    if same and thing[0].text == "the" and not level.stated:
        # "The book at the top of a stack of three books"
        one = _said(like, ("the", _LEVELS[level.word], "one", "of"))
        return [*tokens[: level.first], *one, *tokens[level.end :]]
    made = _stack(like, thing, members, level, nouns)
    if made is None:
        return list(tokens)
    if level.first == 0 and link_at(behind, 0):
        return [*behind[:-1], *_said(like, ("is",)), *made, behind[-1]]
    return [*tokens[: level.first], *made, *behind]


def _stack(
    like: Token, thing: Sequence[Token], members: Sequence[Token], level: _Level, nouns: Nouns
) -> list[Token] | None:
    """The stack of `members` with `thing` at its level, one of them where of their kind; None for beside."""
    if not members:
        return None
    same = _same(thing[-1].text, members[-1].text, nouns)
    if level.word in _BESIDE and not same:
        return None
    number = lexicon.NUMBERS.get(members[0].text, int(members[0].text[:2]) if members[0].text.isdecimal() else 0)
    if number > 1 and same and len(members) == 2:
        # Where the members are described they are all so, and it is one more.
        rest = number - 1
        word = next(word for word, value in lexicon.NUMBERS.items() if value == rest and word not in ("an", "single"))
        name = next((one for one in singulars(members[1].text) if nouns.match([one])), members[1].text)
        members = [
            replace(members[0], text="a" if rest == 1 else word),
            replace(members[1], text=name if rest == 1 else members[1].text),
        ]
        number = rest
    name = next((one for one in singulars(members[-1].text) if nouns.match([one])), members[-1].text)
    thing = [replace(token, text="a" if token.text == "the" else name if token.text == "one" and n else token.text)
             for n, token in enumerate(thing)]  # fmt: skip
    a_stack_of, joint = _said(like, ("a", "stack", "of")), _said(like, ("and",))
    if _LEVELS[level.word] == "bottom":
        return [*a_stack_of, *thing, *joint, *members]
    if number == 1:
        return [*a_stack_of, *members, *joint, *thing]
    return [*a_stack_of, *members, *_said(like, ("with",)), *thing, *_said(like, ("on", "top"))]


def _same(one: str, other: str, nouns: Nouns) -> bool:
    """Whether two names are of one noun; "one" is of any."""
    found = [nouns.match([word]) for word in (one, other)]
    return one == "one" or (found[0] is not None and found[1] is not None and found[0].noun == found[1].noun)


def _said(like: Token, words: Sequence[str]) -> list[Token]:
    return [replace(like, text=word, mark=False) for word in words]
