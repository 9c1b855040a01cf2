"""From what a finder sees to the masks of a picture: as many of each kind as are sought, none twice, none empty."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ModelError
from pat3d.progress import Event, Progress, silent
from pat3d.vision.detection import Finder, Found
from pat3d.vision.files import MAX_OBJECTS
from pat3d.vision.observation import LEAST_PIXELS

SAME = 0.8
"""Overlap (intersection over union) of masks that show one thing."""
_NUMBER = re.compile(r"\s+#?\d+$")


@dataclass(frozen=True, kw_only=True)
class Sought:
    """A kind of object that somebody says is in a picture."""

    phrase: str
    """As a detector is asked: "red mug"."""
    count: int = 1


@dataclass(frozen=True, kw_only=True, eq=False)
class Masks:
    """The objects that were found."""

    values: NDArray[np.int32]
    """1 + index of the object that a pixel shows, 0 for none, shape (height, width)."""
    phrases: tuple[str, ...]
    """What each of them was found as."""
    scores: tuple[float, ...]
    notes: tuple[str, ...] = ()
    """What was sought and not found."""


def sought_of(names: Sequence[str]) -> tuple[Sought, ...]:
    """What objects of these names are sought as: "book 1" and "book 2" are two of "book"."""
    counts = Counter(_NUMBER.sub("", name) for name in names)
    return tuple(Sought(phrase=phrase, count=count) for phrase, count in counts.items())


def find_masks(
    picture: NDArray[np.uint8], sought: Sequence[Sought], finder: Finder, *, progress: Progress = silent
) -> Masks:
    """Find what is sought in an RGB picture, shape (height, width, 3).

    Raises:
        ModelError: nothing of it is there.
    """
    found: list[Found] = []
    for number, one in enumerate(sought):
        progress(Event(stage="finding objects", detail=one.phrase, step=number, steps=len(sought)))
        found += finder.find(picture, one.phrase)
    chosen = _chosen(found, sought)
    values, kept = _layered(chosen, picture.shape[:2])
    counts = Counter(one.phrase for one in kept)
    notes = tuple(
        f'{counts[one.phrase]} of {one.count} "{one.phrase}" found by {finder.name}'
        for one in sought
        if counts[one.phrase] < one.count
    )
    if not kept:
        raise ModelError(
            f"{finder.name} finds nothing of: {', '.join(one.phrase for one in sought)}. Give --masks, or other words."
        )
    return Masks(
        values=values,
        phrases=tuple(one.phrase for one in kept),
        scores=tuple(one.score for one in kept),
        notes=notes,
    )


def _chosen(found: Sequence[Found], sought: Sequence[Sought]) -> list[Found]:
    """Of what shows one thing the likeliest, and of each kind as many as are sought."""
    left = {one.phrase: one.count for one in sought}
    chosen: list[Found] = []
    for one in sorted(found, key=lambda each: -each.score):
        wanted = left[one.phrase] > 0 and len(chosen) < MAX_OBJECTS and one.mask.sum() >= LEAST_PIXELS
        if wanted and all(_overlap(one.mask, other.mask) < SAME for other in chosen):
            chosen.append(one)
            left[one.phrase] -= 1
    return chosen


def _layered(chosen: Sequence[Found], shape: tuple[int, ...]) -> tuple[NDArray[np.int32], list[Found]]:
    """Values of the pixels and what has some, from left to right; smaller things lie over larger ones.

    The mask of a table often has what stands on it, that of a cup seldom has the table.
    """

    def painted(ones: Sequence[Found]) -> NDArray[np.int32]:
        values = np.zeros(shape, dtype=np.int32)
        for number, one in sorted(enumerate(ones, start=1), key=lambda each: -int(each[1].mask.sum())):
            values[one.mask] = number
        return values

    ordered = sorted(chosen, key=lambda one: float(np.nonzero(one.mask)[1].mean()))
    counts = np.bincount(painted(ordered).ravel(), minlength=len(ordered) + 1)[1:]
    kept = [one for one, count in zip(ordered, counts, strict=True) if count >= LEAST_PIXELS]
    return painted(kept), kept


def _overlap(one: NDArray[np.bool_], other: NDArray[np.bool_]) -> float:
    either = np.count_nonzero(one | other)
    return np.count_nonzero(one & other) / max(either, 1)
