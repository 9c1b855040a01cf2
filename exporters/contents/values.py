"""When two pieces of text say the same: word by word, numbers to rounding.

The same scene written twice by one computer is the same to the bit. Another computer may round a computed number
otherwise in its last digits, and that is all the room there is.
"""

from __future__ import annotations

import re

import numpy as np
from numpy.typing import ArrayLike

RELATIVE = 1e-9
"""Of the largest number beside it."""

ABSOLUTE = 1e-12
"""Where all of them are tiny, such as a coordinate that is zero but for rounding."""

FOREIGN = "PAT3D does not write"
"""Words in the line of everything that is there although it should not be; other differences are of values."""

_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
"""Stricter than Python, which reads 1_0 as ten."""


def same_words(found: str | None, expected: str | None) -> bool:
    """Whether two attributes or lines agree."""
    here, there = (found or "").split(), (expected or "").split()
    if here == there:
        return True
    if len(here) != len(there):
        return False
    mine: list[float] = []
    theirs: list[float] = []
    for one, other in zip(here, there, strict=True):
        if _NUMBER.fullmatch(one) and _NUMBER.fullmatch(other):
            mine.append(float(one))
            theirs.append(float(other))
        elif one != other:
            return False
    return same_numbers(mine, theirs)


def same_numbers(found: ArrayLike, expected: ArrayLike, relative: float = RELATIVE) -> bool:
    """Whether two arrays of numbers agree; the largest of all is the measure."""
    here, there = np.asarray(found, dtype=np.float64), np.asarray(expected, dtype=np.float64)
    if here.shape != there.shape:
        return False
    if np.array_equal(here, there):
        return True
    limit = relative * float(np.abs(there).max(initial=0.0)) + ABSOLUTE
    return bool((np.abs(here - there) <= limit).all())


def shown(value: object, length: int = 60) -> str:
    """A value for a line of text."""
    words = " ".join(str(value).split())
    return words if len(words) <= length else words[: length - 3] + "..."
