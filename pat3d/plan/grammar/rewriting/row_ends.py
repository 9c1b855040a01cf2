"""The ends of a row told by what stands beside it: "the cup closest to the jar" is its leftmost one.

"The row" itself, of which a sentence before told, is all that stands in it: "to the left of the row is a jar".
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from pat3d.plan.grammar.rewriting.told_by_rank import counted_in
from pat3d.plan.grammar.words import lexicon
from pat3d.plan.grammar.words.lexing import Token, singulars
from pat3d.plan.grammar.words.vocabulary import Nouns

_NEAR = (("nearest", "to"), ("nearest",), ("closest", "to"), ("closest",))
_FAR = (("farthest", "away", "from"), ("furthest", "away", "from"), ("farthest", "from"), ("furthest", "from"))
_ROWS = frozenset({"row", "line"})
_OF_ROWS = (("left", "of"), ("right", "of"), ("in", "front", "of"), ("behind",))
_OTHER = {"left": "right", "right": "left"}
_LONGEST = 3
"""Words of a name."""


def at_row_ends(tokens: Sequence[Token], nouns: Nouns) -> list[Token]:
    """`tokens` with "a jar is left of a row of three cups. The one nearest the jar" as "... The leftmost one"."""
    words = [token.text for token in tokens]
    row = next((n for n in range(1, len(words)) if words[n] in _ROWS and words[n - 1] == "a"), 0)
    stop = next((n for n in range(row, len(words)) if words[n] == "."), 0) if row else 0
    counted = counted_in(words, stop, nouns) if stop else None
    if counted is None:
        return list(tokens)
    made = _rows_by_name(tokens, stop, counted[1])
    beside = _beside(made, row, stop, counted[1], nouns)
    return _ranked(made, stop, counted[1], *beside) if beside is not None else made


def _rows_by_name(tokens: Sequence[Token], stop: int, said: str) -> list[Token]:
    """`tokens` with "to the left of the row" behind `stop` as "to the left of the cups", which are what is `said`."""
    made: list[Token] = []
    plural = next(
        (token.text for token in tokens[:stop] if said.split()[-1] in (token.text, *singulars(token.text))), ""
    )
    words = [token.text for token in tokens]
    for at, token in enumerate(tokens):
        whose = any(tuple(words[at - 1 - len(link) : at - 1]) == link for link in _OF_ROWS)
        if at > stop and token.text in _ROWS and words[at - 1] == "the" and whose and plural and words[at + 1] != "of":
            made += [replace(token, text=word) for word in (*said.split()[:-1], plural)]
        else:
            made.append(token)
    return made


def _beside(tokens: Sequence[Token], row: int, stop: int, said: str, nouns: Nouns) -> tuple[str, str] | None:
    """The last word of what stands alone beside the row at word `row`, and at which side of it; None without."""
    words = [token.text for token in tokens]
    for at in range(1, len(words) - 2):
        side = words[at]
        if side not in _OTHER or at > stop + _LONGEST * 4:
            continue
        start = next((n + 1 for n in range(at, -1, -1) if words[n] == "."), 0)
        end = next((n for n in range(at, len(words)) if words[n] == "."), len(words))
        before = [n for n in _names(words, start, at, nouns) if said not in _said(words, n)]
        if words[at + 1 : at + 4] == ["of", "a", "row"] and at + 3 == row:
            subject = [n for n in before if words[n + 1] in lexicon.STANDING]
            return (words[subject[0]], side) if subject else None
        if row < at < stop and words[at - 2 : at] in (["to", "its"], ["on", "its"]) and before:
            return words[before[-1]], side
        if at > stop and words[at + 1 : at + 3] == ["of", "the"] and said in _said(words, at + 2 + len(said.split())):
            behind = [n for n in _names(words, at + 3, end, nouns) if said not in _said(words, n)]
            others = before if before and words[before[0] + 1] in lexicon.STANDING else behind
            return (words[others[0]], side) if len(others) == 1 else None
    return None


def _said(words: Sequence[str], last: int) -> set[str]:
    """The names that end at word `last`, each as one and as several."""
    names = {" ".join(words[max(last + 1 - size, 0) : last + 1]) for size in range(1, _LONGEST + 1)}
    lead = {name: name.split()[:-1] for name in names if name}
    return names | {" ".join([*lead[name], one]) for name in lead for one in singulars(name.split()[-1])}


def _names(words: Sequence[str], start: int, end: int, nouns: Nouns) -> list[int]:
    """The last words of what is named from word `start` to before `end`."""
    made: list[int] = []
    at = start
    while at < end:
        size = next((n for n in range(_LONGEST, 0, -1) if at + n <= end and nouns.match(words[at : at + n])), 0)
        made += [at + size - 1] if size else []
        at += max(size, 1)
    return made


def _ranked(tokens: Sequence[Token], stop: int, said: str, mark: str, side: str) -> list[Token]:
    """`tokens` with "the one closest to the jar" behind `stop` as "the leftmost one": the `mark` is at that `side`."""
    words = [token.text for token in tokens]
    made = list(tokens[:stop])
    at = stop
    while at < len(tokens):
        size = next((n for n in range(1, _LONGEST + 1) if words[at + n : at + n + 1] == ["one"]
                     or said in (name := " ".join(words[at + 1 : at + 1 + n]), *singulars(name))), 0)  # fmt: skip
        how = at + 1 + size
        how += 2 * (words[how : how + 2] in (["that", "is"], ["which", "is"]))
        near, far = (next((len(each) for each in told if tuple(words[how : how + len(each)]) == each), 0)
                     for told in (_NEAR, _FAR))  # fmt: skip
        to = how + max(near, far)
        end = to + 1 if words[to : to + 1] == ["it"] else 0
        if words[to : to + 1] == ["the"]:
            end = next((to + n for n in (2, 3, 4) if words[to + n - 1 : to + n] == [mark]), 0)
        if words[at] == "the" and size and (near or far) and end:
            most = f"{side if near else _OTHER[side]}most"
            made += [tokens[at], replace(tokens[how], text=most), *tokens[at + 1 : at + 1 + size]]
            at = end
        else:
            made.append(tokens[at])
            at += 1
    return made
