"""How far a denied list goes: "no cup, plate or fork" denies all three, "a mug without a handle and a plate" one."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from pat3d.plan.grammar.chunking.phrases import Phrase
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.boundaries import link_at
from pat3d.plan.grammar.words.lexing import Span, Token, singulars
from pat3d.plan.grammar.words.links import FINITE

Read = Callable[[int], "tuple[Phrase, int] | None"]
_OF_SEVERAL = frozenset({"are", "were", "stand", "lie", "sit", "have", "hold", "hang", "rest"})
_OF_ONE = frozenset({"is", "was", "stands", "lies", "sits", "has", "holds", "hangs", "rests"})


@dataclass(frozen=True, kw_only=True)
class Denied:
    """What stands behind "without" or "no"."""

    end: int
    """The token behind all that is denied."""
    doubtful: Span | None = None
    """The rest of the list behind its first, where it is not plain whether that is denied."""


@dataclass(frozen=True, kw_only=True)
class _Item:
    start: int
    end: int
    bare: bool
    plural: bool
    part: bool
    stuff: bool


def denied(tokens: Sequence[Token], at: int, read: Read) -> Denied:
    """How far goes what "without" or "no" at token `at` denies."""
    said = read(at + 1)
    first = _item(tokens, at + 1, read)
    if first is None:
        return Denied(end=said[1] if said else at + 1)
    items, closer = [first], ""
    while (joint := _joint(tokens, items[-1].end, closer)) and (item := _item(tokens, items[-1].end + joint, read)):
        word = tokens[item.start - 1].text
        if word == "," and closer:
            break
        closer = word if word != "," else ""
        items.append(item)
    if closer in ("or", "nor"):
        return Denied(end=items[-1].end)
    if not closer:
        return Denied(end=first.end)
    whole, plain = _together(tokens, at, items)
    end = items[-1].end if whole else first.end
    return Denied(end=end, doubtful=None if plain else (items[1].start, items[-1].end))


def _joint(tokens: Sequence[Token], at: int, closer: str) -> int:
    """How many words join what begins behind them to a list that ends before token `at`; 0 where none do."""
    words = [token.text for token in tokens[at : at + 2]]
    closers = ("or", "nor") if closer in ("or", "nor") else () if closer else ("and", "or", "nor")
    if words[0] in closers:
        return 1
    if words[0] != "," or closer:
        return 0
    return 2 if words[1] in ("and", "or", "nor") else 1


def _item(tokens: Sequence[Token], at: int, read: Read) -> _Item | None:
    said = read(at) if tokens[at].text not in lexicon.PRONOUNS and not link_at(tokens, at) else None
    if said is None or said[1] == at:
        return None
    phrase, end = said
    if phrase.other or phrase.kind in ("pronoun", "pieces"):
        # "A plate without a fork and another with a knife"
        return None
    head = tokens[end - 1].text
    heads = {head, *singulars(head)}
    own = bool(heads & (lexicon.PARTS | lexicon.DETACHED)) or phrase.possessive
    stuff = not own and not phrase.determined and bool(heads & lexicon.SUBSTANCES)
    part = own or phrase.kind == "part" or stuff
    bare = not phrase.determined and not phrase.possessive
    return _Item(start=at, end=end, bare=bare, plural=phrase.plural, part=part, stuff=stuff)


def _together(tokens: Sequence[Token], at: int, items: Sequence[_Item]) -> tuple[bool, bool]:
    """Whether all of `items`, which "and" joins, are denied at token `at`, and whether that is plain."""
    first, *others = items
    shared = not first.bare and all(item.bare and not item.plural for item in others)
    if shared or all(item.part for item in items):
        # "Without its saucer and spoon"
        return True, True
    # "A hall without a door, a bench and a plant": no bench is told of beside a hall.
    room = at > 0 and tokens[at - 1].text in lexicon.BACKGROUND
    if not room and (first.part or (first.bare and not any(item.bare for item in others))):
        # "A mug without a handle, a fork and a knife"; "a sink without soap and a cup" is not plain.
        return False, len(items) > 2 or (first.part and not first.stuff)
    if len(items) == 2 and tokens[first.end].text == ",":
        # "A mug, without a spoon, and a plate are on a tray."
        return False, True
    behind = tokens[items[-1].end].text
    if behind in _OF_SEVERAL or behind in _OF_ONE:
        begun = any(token.text in FINITE | {"there"} for token in tokens[_opening(tokens, at) : at])
        # "There is a mug without a spoon, and a plate is on the tray."
        return behind in _OF_ONE and not begun, not begun or len(items) == 2
    before = tokens[at - 1].text if at else "."
    if before in (",", ".", ";", "and", "but") or all(item.bare for item in items):
        return True, True
    told = behind in lexicon.HAVING or link_at(tokens, items[-1].end)
    return len(items) > 2 and not told, False


def _opening(tokens: Sequence[Token], at: int) -> int:
    """Where the clause begins in which token `at` stands."""
    return next((n + 1 for n in range(at - 1, -1, -1) if tokens[n].mark and tokens[n].text != ","), 0)
