"""Drawers told by what they are in: "the top drawer of the cabinet", "the cabinet's drawer", "the cabinet drawer"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.drawers import CABINETS
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token
from pat3d.plan.grammar.words.modifiers import is_modifier
from pat3d.plan.grammar.words.vocabulary import Nouns

_COUNTED = {
    f"{number} from the {end}": row
    for end, rows in (("top", ("top", "middle", "bottom")), ("bottom", ("bottom", "middle", "top")))
    for number, row in zip(("first", "second", "third"), rows, strict=True)
}
"""Rows of three that are counted: "the second drawer from the top"."""
_FAR = 5
"""Words of what a drawer is of, and between an owner and its drawer."""
_PULLING, _PUSHING = ("pull", "slide", "yank", "swing"), ("push", "slide", "shove", "swing")
_IN = ("closed", "shut", "in")


def drawer_of(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "the top drawer of the cabinet" as "the top drawer": what it is in is made with it."""
    words = [token.text for token in tokens]
    for at in (at for at, word in enumerate(words) if word == "drawer"):
        row = _COUNTED.get(" ".join([words[at - 1], *words[at + 1 : at + 4]]))
        if row:
            return drawer_of(
                [*tokens[: at - 1], replace(tokens[at - 1], text=row), tokens[at], *tokens[at + 4 :]], nouns
            )
        behind = next((n for n in range(at + 2, min(at + _FAR, len(words))) if _is_cabinet(words, n, nouns)), 0)
        if behind and words[at + 1] in ("of", "in") and words[at + 2] in ("the", "a", "this", "that"):
            last = behind + (words[behind + 1] in ("cabinet", "table"))
            if all(is_modifier(word) for word in words[at + 3 : behind]):
                return drawer_of([*tokens[: at + 1], *tokens[last + 1 :]], nouns)
        first = next((n for n in range(at - 1, max(at - _FAR, -1), -1) if words[n] in ("the", "a", "its")), -1)
        owner = next((n for n in range(first + 1, at) if _is_cabinet(words, n, nouns)), -1)
        owned = owner > first >= 0 and all(
            is_modifier(word) or word in lexicon.LEVELS or word in ("'s", "middle", "open", "closed")
            for word in [*words[first + 1 : owner], *words[owner + 1 : at]]
        )
        if owned:
            rest = tokens[owner + 1 + (words[owner + 1] == "'s") : at + 1]
            kept = tokens[first + 1 : owner] if words[owner + 1] != "'s" else ()
            return drawer_of([*tokens[: first + 1], *kept, *rest, *tokens[at + 1 :]], nouns)
        if first >= 0 and words[first] == "its":
            return drawer_of([*tokens[:first], replace(tokens[first], text="the"), *tokens[first + 1 :]], nouns)
    return list(tokens)


def drawers_moved(tokens: Sequence[Token]) -> list[Token]:
    """`tokens` with "pull the drawer open" and "pull out the drawer" as "open the drawer", as of doors and closing."""
    words = [token.text for token in tokens]
    for at in (at for at, word in enumerate(words) if word in {*_PULLING, *_PUSHING}):
        end = next((n for n in range(at + 2, min(at + _FAR + 1, len(words) - 1)) if words[n] in ("drawer", "door")), 0)
        particle = at + 1 if words[at + 1] in ("open", "out", *_IN) else end + 1
        led = end and words[at + 1 + (particle == at + 1)] in lexicon.DETERMINERS
        verb = (
            "open"
            if words[at] in _PULLING and words[particle] in ("open", "out")
            else "close"
            if words[at] in _PUSHING and words[particle] in _IN
            else ""
        )
        if not led or not verb or words[end + 1 : end + 3] == ["in", "the"]:
            continue
        said = replace(tokens[at], text=verb)
        return drawers_moved([*tokens[:at], said, *tokens[at + 1 : particle], *tokens[particle + 1 :]])
    return list(tokens)


def _is_cabinet(words: Sequence[str], at: int, nouns: Nouns) -> bool:
    found = nouns.match(words[at : at + 1])
    return found is not None and found.noun in CABINETS
