"""Text, JSON, OBJ and PNG files compared: what one says that the other does not."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from itertools import zip_longest
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import ExportError
from pat3d.exporters.contents.values import FOREIGN, same_numbers, same_words, shown
from pat3d.scene.obj_files import MAX_FILE_BYTES, read_texture

_NORMAL = 3e-6
"""Normals are written to six digits [-]."""


def text_differences(found: Path, expected: Path) -> Iterator[str]:
    """The first line that differs, and how many do; the space before a line counts, that within it does not.

    Raises:
        ExportError: a file cannot be read, or is not text.
    """
    here, there = _lines(found), _lines(expected)
    pairs = enumerate(zip_longest(here, there, fillvalue=""), start=1)
    wrong = [
        number
        for number, (one, other) in pairs
        if _indent(one) != _indent(other) or not same_words(_spaced(one), _spaced(other))
    ]
    if wrong:
        first = wrong[0] - 1
        mine, theirs = (shown(lines[first]) if first < len(lines) else "" for lines in (here, there))
        more = f", and {len(wrong) - 1} more lines differ" if len(wrong) > 1 else ""
        yield f'line {wrong[0]} says "{mine}" instead of "{theirs}"{more}'


def json_differences(found: Path, expected: Path) -> Iterator[str]:
    """Values that differ, with where they stand.

    Raises:
        ExportError: a file cannot be read, or is not JSON with every key once.
    """
    yield from _json(_parsed(found), _parsed(expected), "")


def obj_differences(found: Path, expected: Path) -> Iterator[str]:
    """What differs between two meshes: corners, texture coordinates, normals, and everything else that a file says.

    Raises:
        ExportError: a file cannot be read, or is no OBJ of triangles.
    """
    here, there = _Mesh(found), _Mesh(expected)
    if here.rest != there.rest:
        yield f"says something that {FOREIGN}, or lacks what it writes"
    for what, mine, theirs, relative in (
        ("vertices", here.points, there.points, 1e-9),
        ("triangles", here.corners, there.corners, 1e-9),
        ("texture coordinates", here.uv, there.uv, 1e-9),
        ("normals", here.normals, there.normals, _NORMAL),
    ):
        if mine.shape != theirs.shape:
            yield f"has {len(mine)} {what} instead of {len(theirs)}"
        elif not same_numbers(mine, theirs, relative):
            yield f"has other {what}, by up to {np.abs(mine - theirs).max():.3g}"


def png_differences(found: Path, expected: Path) -> Iterator[str]:
    """Whether two pictures show something else.

    Raises:
        ExportError: one is no picture.
    """
    if not np.array_equal(read_texture(found), read_texture(expected)):
        yield "shows another picture"


class _Mesh:
    """An OBJ file with its indices looked up."""

    def __init__(self, path: Path) -> None:
        tables: dict[str, list[list[float]]] = {"v": [], "vt": [], "vn": []}
        faces: list[list[list[int]]] = []
        self.rest: list[str] = []
        try:
            for line in _lines(path):
                key, _, words = line.partition(" ")
                if key in tables:
                    tables[key].append([float(word) for word in words.split()])
                elif key == "f":
                    faces.append([[int(index or 0) for index in word.split("/")] for word in words.split()])
                elif line.strip():
                    self.rest.append(line.strip())
            index = np.array(faces, dtype=np.int64).reshape(len(faces), 3, -1)
            points, uv, normals = (np.array(rows, dtype=np.float64) for rows in tables.values())
            self.points = points
            self.corners = points[index[:, :, 0] - 1]
            self.uv = _looked_up(uv, index, 1)
            self.normals = _looked_up(normals, index, 2)
        except (ValueError, IndexError) as error:
            raise ExportError(f"{path.name}: no OBJ of triangles ({error}).") from error


def _looked_up(table: NDArray[np.float64], index: NDArray[np.int64], column: int) -> NDArray[np.float64]:
    """Rows of `table` for every corner; where no corner refers to it, the table itself."""
    return table[index[:, :, column] - 1] if index.shape[2] > column and len(table) else table


def _lines(path: Path) -> list[str]:
    try:
        if path.stat().st_size > MAX_FILE_BYTES:
            raise ExportError(f"{path.name}: larger than {MAX_FILE_BYTES} bytes.")
        return path.read_text(encoding="utf-8").split("\n")
    except OSError as error:
        raise ExportError(f"{path.name}: cannot be read ({error.strerror or error}).") from error
    except UnicodeDecodeError as error:
        raise ExportError(f"{path.name}: not text ({error.reason}).") from error


def _spaced(line: str) -> str:
    """Numbers apart from the brackets and commas around them."""
    return re.sub(r"([\[\](){},])", r" \1 ", line)


def _indent(line: str) -> str:
    return line[: len(line) - len(line.lstrip())] if line.strip() else ""


def _parsed(path: Path) -> Any:
    def once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        # Of a key that is there twice one reader takes the first value and another the last.
        if len(dict(pairs)) != len(pairs):
            raise ExportError(f"{path.name}: a key is there twice.")
        return dict(pairs)

    try:
        return json.loads("\n".join(_lines(path)), object_pairs_hook=once)
    except (ValueError, RecursionError) as error:
        raise ExportError(f"{path.name}: not JSON ({error}).") from error


def _json(found: Any, expected: Any, place: str) -> Iterator[str]:
    if isinstance(found, dict) and isinstance(expected, dict):
        for key in [*expected, *(key for key in found if key not in expected)]:
            where = f"{place}.{key}".lstrip(".")
            if key not in found:
                yield f"{where} is missing"
            elif key not in expected:
                yield f"{where} is there, which {FOREIGN}"
            else:
                yield from _json(found[key], expected[key], where)
    elif _are_numbers(found) and _are_numbers(expected):
        if not same_numbers(np.array(found), np.array(expected)):
            yield f"{place} is {shown(found)} instead of {shown(expected)}"
    elif isinstance(found, list) and isinstance(expected, list) and len(found) == len(expected):
        for number, (one, other) in enumerate(zip(found, expected, strict=True)):
            yield from _json(one, other, f"{place}[{number}]")
    elif type(found) is not type(expected) or found != expected:
        yield f"{place} is {shown(found)} instead of {shown(expected)}"


def _are_numbers(value: Any) -> bool:
    values = value if isinstance(value, list) else [value]
    return bool(values) and all(isinstance(one, int | float) and not isinstance(one, bool) for one in values)
