"""What a file does not say of its mesh: a guess with its reason, and how sure it is; here of the unit.

Evidence is counted in nats: what the object is like in the catalogue tells how long it usually is.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal, cast

import numpy as np

from pat3d.assets.library.body import Body
from pat3d.assets.mesh.importing import METRES, Units, UpAxis
from pat3d.errors import AssetError

SURE = 0.75
"""Confidence below which a guess is a doubt for the user to settle."""

HABIT: Mapping[str, float] = {"m": 0.0, "mm": -1.0, "cm": -1.3, "in": -3.0}
"""How usual each unit is, other things equal."""

USUAL = (0.015, 1.5)
"""Longest side [m] of things that lie about in scenes."""


UNLIKE = 4.0
"""Times by which the size of a thing of its kind is usually missed at most."""


@dataclass(frozen=True, kw_only=True)
class Guess:
    """What was decided, why, and how sure that is."""

    value: str
    reason: str
    confidence: float
    """In [0, 1]; 1 where the file or the user says it."""
    source: Literal["declared", "guessed", "given"] = "guessed"


@dataclass(frozen=True, kw_only=True)
class Typical:
    """How large a catalogue noun is."""

    noun: str
    size: tuple[float, float, float]
    """Width, depth, height [m]."""


def guess_unit(body: Body, typical: Typical | None) -> Guess:
    """The unit of the coordinates of `body`."""
    if body.metres is not None:
        known = next((unit for unit, metres in METRES.items() if math.isclose(metres, body.metres)), f"{body.metres}")
        longest = longest_side(body) * body.metres
        if _log_off(longest, USUAL) > math.log(10):
            reason = f"{body.declared} says so, yet it would be {longest:.3g} m long"
            return Guess(value=known, reason=reason, confidence=0.5, source="declared")
        if typical is not None and abs(math.log(longest / max(typical.size))) > math.log(UNLIKE):
            # Models made for pictures are of any size, whatever their format says.
            reason = (
                f"{body.declared} says so, yet it would be {longest:.3g} m long, and a {typical.noun} of the catalogue "
                f"is {max(typical.size):.2g} m"
            )
            return Guess(value=known, reason=reason, confidence=0.5, source="declared")
        return Guess(value=known, reason=f"{body.declared} says so", confidence=1.0, source="declared")
    longest = longest_side(body)
    scores = {}
    for unit, metres in METRES.items():
        length = longest * metres
        score = HABIT[unit] - 2.0 * _log_off(length, USUAL)
        if typical is not None:
            score -= 1.2 * max(0.0, abs(math.log(length / max(typical.size))) - math.log(1.5))
        scores[unit] = score
    unit, confidence = likeliest(scores)
    length = longest * METRES[unit]
    reason = f"{length:.3g} m long"
    if typical is not None:
        reason += f", a {typical.noun} of the catalogue is {max(typical.size):.2g} m"
    return Guess(value=unit, reason=reason, confidence=confidence)


def longest_side(body: Body) -> float:
    """Of the bounding box, in the file's unit.

    Raises:
        AssetError: it has no extent.
    """
    longest = float(np.ptp(body.mesh.vertices[np.unique(body.mesh.faces)], axis=0).max())
    if not (math.isfinite(longest) and longest > 0):
        raise AssetError("the mesh has no extent: all its vertices coincide.")
    return longest


def axis_of(guess: Guess) -> UpAxis:
    """A guess of `guess_up` as an axis."""
    return cast(UpAxis, guess.value)


def unit_of(guess: Guess) -> Units:
    """A guess of `guess_unit` as a unit."""
    return cast(Units, guess.value)


def likeliest(scores: Mapping[str, float]) -> tuple[str, float]:
    """The highest score and its share of all by softmax."""
    best = max(scores, key=lambda key: scores[key])
    total = sum(math.exp(score - scores[best]) for score in scores.values())
    return best, 1.0 / total


def _log_off(length: float, band: tuple[float, float]) -> float:
    """By how many nats `length` lies outside `band`."""
    low, high = band
    return max(0.0, math.log(low / length), math.log(length / high))
