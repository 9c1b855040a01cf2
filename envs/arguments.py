"""Arguments of environments, checked once; what is wrong is answered with what is valid."""

from __future__ import annotations

from collections.abc import Sequence
from numbers import Integral, Real
from typing import Any

import numpy as np

from pat3d.errors import EnvironmentSetupError

SMALLEST_PICTURE, LARGEST_PICTURE = 8, 2048
"""Sides of a picture [pixel]."""


def one_of(what: str, value: Any, valid: Sequence[str]) -> str:
    """`value`, where it is one of the valid names."""
    if value not in valid:
        raise EnvironmentSetupError(f'no {what} "{value}". Valid: {", ".join(valid)}.')
    return value


def number(what: str, value: Any, least: float, most: float, unit: str) -> float:
    """`value`, where it is a number from `least` to `most`."""
    if isinstance(value, bool) or not isinstance(value, Real) or not least <= float(value) <= most:
        raise EnvironmentSetupError(f"{what} is {least:g} to {most:g} {unit}, not {value!r}.")
    return float(value)


def whole(what: str, value: Any, least: int) -> int:
    """`value`, where it is a whole number from `least`."""
    if isinstance(value, bool) or not isinstance(value, Integral) or int(value) < least:
        raise EnvironmentSetupError(f"{what} is a whole number from {least}, not {value!r}.")
    return int(value)


def picture_size(what: str, value: Any) -> tuple[int, int]:
    """Height and width [pixel]."""
    sides: list[Any] = list(value) if isinstance(value, Sequence | np.ndarray) else []
    good = [isinstance(side, Integral) and SMALLEST_PICTURE <= int(side) <= LARGEST_PICTURE for side in sides]
    if good != [True, True]:
        raise EnvironmentSetupError(
            f"{what} is height and width, {SMALLEST_PICTURE} to {LARGEST_PICTURE} pixels each, not {value!r}."
        )
    return int(sides[0]), int(sides[1])


def names(what: str, value: Any, valid: Sequence[str]) -> tuple[str, ...]:
    """One or more of the valid names."""
    given = (value,) if isinstance(value, str) else tuple(value) if isinstance(value, Sequence) else ()
    unknown = [str(name) for name in given if name not in valid]
    if unknown or not given:
        said = f'no {what} "{", ".join(unknown)}"' if unknown else f"name at least one {what}"
        raise EnvironmentSetupError(f"{said}. {what.capitalize()}s: {', '.join(valid)}.")
    return given
