"""The camera of a photograph, from files: our own, and those that RGB-D recordings come with.

- JSON or YAML as CAMERA_SCHEMA says; `depth_per_metre` tells what the numbers of a depth PNG mean;
- JSON of Open3D (`intrinsic_matrix`, column by column) and of RealSense (`ppx`, `ppy` beside `fx`, `fy`);
- text: fx fy cx cy as in TUM's recordings, or the matrix, 3 x 3 or 4 x 4, as in ScanNet's and YCB-Video's. Such files
  do not say for which picture they are; the depth's is assumed.
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.errors import SpecError
from pat3d.scene.yaml_source import read_yaml, validate
from pat3d.vision.camera import USUAL_ANGLE, Pinhole

MILLIMETRES = 1000.0
"""Numbers of a depth PNG in a metre, where nothing says otherwise."""
MAX_TEXT = 2**16
"""Bytes of a file of numbers."""
SAME_SHAPE = 0.02
"""By how much proportions of pictures that belong together may differ."""
_POSITIVE = {"type": "number", "exclusiveMinimum": 0, "maximum": 1e6}
_KEYS = ("width", "height", "fx", "fy", "cx", "cy")

CAMERA_SCHEMA: dict[str, Any] = {
    "type": "object",
    "properties": {
        "width": {
            **_POSITIVE,
            "description": "Of the picture that the numbers are for [pixel], like all below.",
        },
        "height": _POSITIVE,
        "fx": _POSITIVE,
        "fy": _POSITIVE,
        "cx": {"type": "number"},
        "cy": {"type": "number"},
        "angle": {
            **_POSITIVE,
            "description": "Across the longer side [deg], instead of all the others.",
        },
        "depth_per_metre": {
            **_POSITIVE,
            "description": "Numbers of the depth PNG in a metre: 1000 where not given, 5000 in TUM's recordings.",
        },
    },
    "additionalProperties": False,
}
"""Of the file of the camera."""


def read_camera(path: Path, width: int, height: int) -> Pinhole:
    """The camera in a file, for a picture of `width` x `height` pixels.

    Raises:
        SpecError: it cannot be read, is of no known kind, or does not fit the picture.
    """
    if path.suffix.lower() == ".txt":
        return _of_numbers(path, width, height)
    known = _document(path)
    if "angle" in known:
        if set(known) - {"angle", "depth_per_metre"}:
            raise SpecError(f"{path}: give the angle alone, or width, height, fx, fy, cx and cy.")
        return Pinhole.of_angle(width, height, float(known["angle"]))
    missing = [key for key in _KEYS if key not in known]
    if missing:
        raise SpecError(f"{path}: {', '.join(missing)} missing; give these, or the angle alone.")
    made = Pinhole(
        width=round(known["width"]),
        height=round(known["height"]),
        **{key: float(known[key]) for key in ("fx", "fy", "cx", "cy")},
    )
    require_same_shape(path, (made.width, made.height), (width, height))
    return made.resized(width, height)


def depth_per_metre(path: Path | None) -> float:
    """What the numbers of a depth PNG mean, as the file of the camera says.

    Raises:
        SpecError: the file cannot be read.
    """
    if path is None or path.suffix.lower() == ".txt":
        return MILLIMETRES
    return float(_document(path).get("depth_per_metre", MILLIMETRES))


def usual_camera(width: int, height: int, angle: float | None) -> tuple[Pinhole, str]:
    """The camera of a picture of which no file tells, and a note of how it is known."""
    if angle is not None:
        note = f"the camera sees {angle:.0f} degrees across, as the photograph's notes or the depth model say"
        return Pinhole.of_angle(width, height, angle), note
    note = f"nobody says what camera it was: one that sees {USUAL_ANGLE:g} degrees across is assumed"
    return Pinhole.of_angle(width, height), note


def require_same_shape(what: object, size: tuple[int, int], other: tuple[int, int]) -> None:
    """Raise SpecError unless two sizes, width first, have the same proportions."""
    if abs(size[0] * other[1] / (size[1] * other[0]) - 1.0) > SAME_SHAPE:
        raise SpecError(f"{what}: {size[0]} x {size[1]} pixels have other proportions than {other[0]} x {other[1]}.")


def _document(path: Path) -> dict[str, Any]:
    """What a JSON or YAML file says, in the words of CAMERA_SCHEMA."""
    source = read_yaml(path)
    known = source.document
    if isinstance(known, dict) and "intrinsic_matrix" in known:
        matrix = known["intrinsic_matrix"]
        whole = isinstance(matrix, list) and len(matrix) == 9 and all(isinstance(one, int | float) for one in matrix)
        if not whole:
            raise source.error(("intrinsic_matrix",), "nine numbers were expected, column by column.")
        sizes = {key: known[key] for key in ("width", "height") if key in known}
        return _validated(path, {**sizes, "fx": matrix[0], "fy": matrix[4], "cx": matrix[6], "cy": matrix[7]})
    if isinstance(known, dict) and {"ppx", "ppy"} <= set(known):
        names = {"width": "width", "height": "height", "fx": "fx", "fy": "fy", "ppx": "cx", "ppy": "cy"}
        bent = known.get("coeffs", ())
        if not isinstance(bent, list | tuple) or any(not isinstance(one, int | float) for one in bent):
            raise source.error(("coeffs",), "numbers were expected.")
        if any(abs(one) > 1e-9 for one in bent):
            raise source.error(("coeffs",), "pictures with lens distortion are not read; rectify them first.")
        return _validated(path, {ours: known[theirs] for theirs, ours in names.items() if theirs in known})
    validate(source, CAMERA_SCHEMA)
    return known


def _validated(path: Path, found: dict[str, Any]) -> dict[str, Any]:
    from jsonschema import Draft202012Validator

    fault = next(iter(Draft202012Validator(CAMERA_SCHEMA).iter_errors(found)), None)
    if fault is not None:
        raise SpecError(f"{path}: {fault.json_path}: {fault.message[:200]}")
    return found


def _of_numbers(path: Path, width: int, height: int) -> Pinhole:
    """The camera of a text file of numbers."""
    try:
        if path.stat().st_size > MAX_TEXT:
            raise SpecError(f"{path} is larger than {MAX_TEXT} bytes.")
        lines = path.read_text(encoding="utf-8").splitlines()
        numbers = [float(word) for line in lines for word in line.partition("#")[0].replace(",", " ").split()]
    except (OSError, ValueError) as error:
        raise SpecError(f"{path}: not a file of numbers ({error}).") from error
    # TUM's files go on with coefficients of the lens, which has to be rectified.
    if len(numbers) in (4, 9) and not (len(numbers) == 9 and numbers[8] == 1.0 and numbers[6] == numbers[7] == 0.0):
        fx, fy, cx, cy = numbers[:4]
        bent = numbers[4:]
    elif len(numbers) in (9, 16):
        matrix = np.array(numbers).reshape(round(math.sqrt(len(numbers))), -1)
        fx, fy, cx, cy = (float(matrix[place]) for place in ((0, 0), (1, 1), (0, 2), (1, 2)))
        bent = [float(matrix[0, 1]), float(matrix[1, 0])]
    else:
        raise SpecError(f"{path}: {len(numbers)} numbers; fx fy cx cy, or a matrix of 3 x 3 or 4 x 4, were expected.")
    if any(abs(one) > 1e-9 for one in bent):
        raise SpecError(f"{path}: pictures with lens distortion or skew are not read; rectify them first.")
    if not (0.0 < cx < width and 0.0 < cy < height):
        raise SpecError(
            f"{path}: the middle ({cx:g}, {cy:g}) is not in the depth's {width} x {height} pixels; are these the "
            "intrinsics of another picture?"
        )
    return Pinhole(width=width, height=height, fx=fx, fy=fy, cx=cx, cy=cy)
