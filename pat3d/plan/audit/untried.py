"""Wording that is unlike all that the reader is known to read rightly: a note quotes it, whatever was made of it.

What a sentence says can be compared with its plan only where a rule knows the wording. Beyond that, how likely a
reading is wrong shows in the wording itself: of patterns of three words (see wording), names and numbers left out,
those are known that occur in several sentences whose reading was checked (benchmarks/tried.py collects them).
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from functools import cache
from pathlib import Path

from pat3d.plan.audit.text import Said
from pat3d.plan.audit.wording import LENGTH, Piece, patterns, worded
from pat3d.plan.scene_plan import ScenePlan

TRIED = Path(__file__).with_name("tried.txt")
"""A line for every two words that begin patterns: "the N", a tab, and the words that end one, with spaces between."""
_RUN = 2
"""Untried patterns in turn that make wording untried: one alone joins two that were tried."""
_LONGEST = 5
"""Words of a quotation that names them: one of a whole clause says nothing of what in it may be misread."""
_MISSING = ("not ", "cannot ")
"""How notes begin that say what is missing, not how something is made."""
_QUOTED = re.compile(r'"([^"]*)"')
_WORD = re.compile(r"[^\W_]+(?:['-][^\W_]+)*|\d+[.]\d+")


def untried(plan: ScenePlan, said: Said, notes: Collection[str]) -> Iterator[str]:
    """A note that quotes the untried wording of `said`, read as `plan`, where none of `notes` quotes it already."""
    pieces, known = worded(said, plan), tried()
    missing = [note for note in notes if note.startswith(_MISSING)]
    covered = _covered(said.words, (*missing, *(f'"{aside}"' for aside in plan.set_aside)))
    runs: list[list[tuple[int, int]]] = []
    for pattern, first, last in patterns(pieces):
        if pattern in known or any(covered & {*range(one.start, one.end)} for one in pieces[first : last + 1]):
            continue
        if runs and runs[-1][-1][1] == last - 1:
            runs[-1].append((first, last))
        else:
            runs.append([(first, last)])
    spans = [_core(pieces, run[0][0], run[-1][1]) for run in runs if len(run) >= _RUN]
    quoted = dict.fromkeys(_text(said.words, start, end) for start, end in _apart(spans))
    if quoted:
        yield f"worded like nothing that was tried, see whether it is read as meant: {', '.join(quoted)}"


@cache
def tried() -> frozenset[tuple[str, ...]]:
    """The patterns of sentences whose reading was checked."""
    rows = (line.split("\t") for line in TRIED.read_text().splitlines())
    return frozenset((*first.split(), last) for first, lasts in rows for last in lasts.split())


def _core(pieces: Sequence[Piece], first: int, last: int) -> tuple[int, int]:
    """Words of `pieces` from `first` to `last` without the tried ones at the ends that only lead to what is untried."""
    if last - first > LENGTH:
        first, last = first + 1, last - 1
    return pieces[first].start, pieces[last].end


def _apart(spans: Sequence[tuple[int, int]]) -> list[tuple[int, int]]:
    """`spans` with those that touch as one."""
    made: list[tuple[int, int]] = []
    for start, end in spans:
        if made and start <= made[-1][1] + 1:
            made[-1] = made[-1][0], max(end, made[-1][1])
        else:
            made.append((start, end))
    return made


def _text(words: Sequence[str], start: int, end: int) -> str:
    said = re.sub(r" (?=[,.:;)]|'s)|(?<=\() ", "", " ".join(words[start:end])).strip(" ,.:;")
    return f'"{said}"'


def _covered(words: Sequence[str], notes: Collection[str]) -> set[int]:
    """The words that one of `notes` quotes."""
    made: set[int] = set()
    for quoted in {quoted for note in notes for quoted in _QUOTED.findall(note.lower())}:
        part = _WORD.findall(quoted)
        at = [n for n in range(len(words)) if words[n][0].isalnum()]
        plain = [words[n] for n in at]
        for n in range(len(plain) - len(part) + 1 if 0 < len(part) <= _LONGEST else 0):
            if plain[n : n + len(part)] == part:
                made |= {*at[n : n + len(part)]}
    return made
