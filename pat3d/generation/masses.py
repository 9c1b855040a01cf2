"""Masses of the meshes of a folder, from a table that people keep in a spreadsheet."""

from __future__ import annotations

import csv
import math
from collections.abc import Set
from pathlib import Path

from pat3d.errors import SpecError
from pat3d.scene.naming import slug

MAX_BYTES = 10_000_000


def read_masses(path: Path, known: Set[str]) -> dict[str, float]:
    """Mass [kg] of every mesh that the CSV file at `path` names.

    A row is the name of a mesh, with its suffix or without, and its mass; a first row that is no mass is a heading.

    Args:
        path: the file.
        known: names of the meshes at hand.

    Raises:
        SpecError: unreadable, a row that is none, a mass that is none, a name twice, or one that no mesh has.
    """
    try:
        if path.stat().st_size > MAX_BYTES:
            raise SpecError(f"{path} has more than {MAX_BYTES} bytes.")
        rows = list(csv.reader(path.read_text(encoding="utf-8-sig").splitlines()))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise SpecError(f"{path}: not a readable CSV file ({error}).") from error
    masses: dict[str, float] = {}
    for number, row in enumerate(rows, start=1):
        if not any(cell.strip() for cell in row):
            continue
        if len(row) < 2:
            raise SpecError(f"{path}, line {number}: a row is a name and a mass in kg, such as mug,0.31.")
        try:
            mass = float(row[1])
        except ValueError as error:
            if not masses and number == 1:
                continue
            raise SpecError(f'{path}, line {number}: "{row[1]}" is no mass in kg.') from error
        if not (math.isfinite(mass) and mass > 0.0):
            raise SpecError(f"{path}, line {number}: a mass is more than 0 kg, got {row[1]}.")
        given = row[0].strip()
        names = [name for name in (slug(given), slug(Path(given).stem)) if name in known]
        if not names:
            raise SpecError(f'{path}, line {number}: no mesh is called "{given}". Known: {", ".join(sorted(known))}.')
        if names[0] in masses:
            raise SpecError(f'{path}, line {number}: "{given}" is there twice.')
        masses[names[0]] = mass
    return masses
