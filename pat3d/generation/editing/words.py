"""What people write for moves, turns and sizes: "10 cm to the right", "90 degrees clockwise", "20 % larger"."""

from __future__ import annotations

import math
import re

from pat3d.errors import EditError

METRES = {"m": 1.0, "dm": 0.1, "cm": 0.01, "mm": 0.001, "in": 0.0254, "inch": 0.0254, "inches": 0.0254}
METRES |= {"metre": 1.0, "metres": 1.0, "meter": 1.0, "meters": 1.0, "centimetres": 0.01, "centimeters": 0.01}

DIRECTIONS = {
    "left": (-1.0, 0.0), "right": (1.0, 0.0),
    "forward": (0.0, -1.0), "forwards": (0.0, -1.0), "front": (0.0, -1.0), "closer": (0.0, -1.0),
    "back": (0.0, 1.0), "backward": (0.0, 1.0), "backwards": (0.0, 1.0), "behind": (0.0, 1.0), "away": (0.0, 1.0),
}  # fmt: skip
"""x and y; the viewer stands at -y."""

_NUMBER = r"(?P<number>[-+]?\d+(?:\.\d+)?|\.\d+)"
_LENGTH = re.compile(
    rf"{_NUMBER}\s*(?P<unit>{'|'.join(sorted(METRES, key=len, reverse=True))})\b\s*"
    rf"(?:to\s+the\s+|towards?\s+the\s+|to\s+)?(?P<way>{'|'.join(DIRECTIONS)})\b"
)
_ANGLE = re.compile(rf"{_NUMBER}\s*(?:degrees|degree|deg|°)?\s*(?P<way>clockwise|counter-?clockwise|anti-?clockwise)?")
_LONG = re.compile(rf"(?:to\s+)?{_NUMBER}\s*(?P<unit>{'|'.join(sorted(METRES, key=len, reverse=True))})")
_FACTOR = re.compile(
    rf"(?:by\s+)?(?:a\s+factor\s+of\s+)?{_NUMBER}\s*(?P<percent>%|percent)?\s*(?:times)?\s*(?P<way>larger|bigger|smaller)?"
)


def halves(text: str, what: str, example: str) -> tuple[str, str]:
    """An object and what is to be done to it, from "vase: 10 cm to the right".

    Raises:
        EditError: there is no colon, or nothing on one side of it.
    """
    name, colon, rest = text.partition(":")
    if not colon or not name.strip() or not rest.strip():
        raise EditError(f'--{what} "{text}": give the object, a colon and what to do, as in "{example}".')
    return name.strip(), rest.strip()


def offset_of(text: str) -> tuple[float, float] | None:
    """The offset along x and y [m] that `text` says; None where it says something else.

    "5 cm left and 2 cm back" is (-0.05, 0.02).
    """
    rest = text.strip().lower()
    x = y = 0.0
    while True:
        found = _LENGTH.match(rest)
        if found is None:
            return None
        length = float(found["number"]) * METRES[found["unit"]]
        x, y = x + length * DIRECTIONS[found["way"]][0], y + length * DIRECTIONS[found["way"]][1]
        rest = re.sub(r"^\s*(?:,|and|,\s*and)?\s*", "", rest[found.end() :])
        if not rest:
            return x, y


def angle_of(text: str) -> float:
    """The angle about the vertical that `text` says [rad], counter-clockwise as seen from above.

    Raises:
        EditError: it says none.
    """
    found = _ANGLE.fullmatch(text.strip().lower())
    if found is None:
        raise EditError(f'"{text}" is not an angle; valid: "90 degrees", "45 degrees clockwise", "-30".')
    angle = math.radians(float(found["number"]))
    return -angle if found["way"] == "clockwise" else angle


def factor_of(text: str, longest: float) -> float:
    """The factor on an object whose longest side is `longest` [m] that `text` says.

    Raises:
        EditError: it says none.
    """
    said = text.strip().lower()
    if found := _LONG.fullmatch(said):
        return float(found["number"]) * METRES[found["unit"]] / longest
    found = _FACTOR.fullmatch(said)
    if found is None:
        raise EditError(f'"{text}" is not a size; valid: "1.5", "20 % larger", "12 cm" for the longest side.')
    number = float(found["number"]) / (100.0 if found["percent"] else 1.0)
    if found["way"] is None:
        return number
    if found["percent"]:
        return 1.0 - number if found["way"] == "smaller" else 1.0 + number
    return 1.0 / number if found["way"] == "smaller" and number else number
