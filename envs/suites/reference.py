"""Reference suites: named, versioned requests with what they have to become, so that anybody's copy can be checked.

A reference says of every scene which candidate it is, its task and instruction, where its objects rest, and the
checksum of its files. Compositions are the same on every machine. Files are the same bit for bit with the same versions
on the same kind of processor; poses agree elsewhere to less than TOLERANCE, or the suite is another one.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

from pat3d.envs.suites.folder import RECORD, SuiteFolder, read_document, write_document
from pat3d.envs.suites.request import Request
from pat3d.errors import SuiteError
from pat3d.scene.io import load_scene

REFERENCES = ("tabletop-v1",)

TOLERANCE = 1e-4
"""Of every object's position [m]."""

DIGITS = 6
"""After the point, of positions in a reference [m]."""


@dataclass(frozen=True, kw_only=True)
class Reference:
    """What a named suite has to be."""

    name: str
    """As "pat3d/tabletop-v1"."""
    request: Request
    checksum: str
    """Of the whole suite where it was made."""
    versions: Mapping[str, Any]
    """It was made with."""
    scenes: tuple[Mapping[str, Any], ...]
    """Of every place: "candidate", "task", "instruction", "checksum", "positions" by object [m]."""
    baselines: tuple[Mapping[str, Any], ...]
    """Measured on it: "policy", "split", "successes", "episodes"."""


@cache
def reference(name: str) -> Reference:
    """The reference suite of a name, with or without "pat3d/".

    Raises:
        SuiteError: there is none; says which there are.
    """
    plain = name.removeprefix("pat3d/")
    if plain not in REFERENCES:
        raise SuiteError(f'no reference suite "{name}". There are: {", ".join(REFERENCES)}.')
    data = read_document(Path(str(files("pat3d.envs"))) / "suites" / "references" / f"{plain}.json")
    return Reference(
        name=data["name"],
        request=Request.from_dict(data["request"], plain),
        checksum=data["checksum"],
        versions=data["versions"],
        scenes=tuple(data["scenes"]),
        baselines=tuple(data["baselines"]),
    )


def reference_of(request: Request) -> Reference | None:
    """The reference suite that a request is for, or for the beginning of; None for none."""
    for name in REFERENCES:
        found = reference(name)
        # Pictures are no part of what is evaluated.
        same = replace(request, scenes=found.request.scenes, picture=found.request.picture) == found.request
        if same and request.scenes <= found.request.scenes:
            return found
    return None


def differences(folder: SuiteFolder, request: Request) -> tuple[list[str], int]:
    """How the suite in a folder differs from the reference that it is for, a line a scene.

    Returns:
        What is another scene; and how many scenes are the same bit for bit.
    """
    wanted = reference_of(request)
    if wanted is None:
        return [], 0
    lines, equal = [], 0
    for place, expected in enumerate(wanted.scenes[: request.scenes]):
        record = read_document(folder.scene(place) / RECORD)
        equal += record.get("checksum") == expected["checksum"]
        wrong = [name for name in ("candidate", "task", "instruction") if record.get(name) != expected[name]]
        if wrong:
            said = ", ".join(f"{name} {record.get(name)!r} for {expected[name]!r}" for name in wrong)
            lines.append(f"scene {place} is not that of {wanted.name}: {said}.")
            continue
        found = positions(folder.scene(place))
        if found.keys() != expected["positions"].keys():
            lines.append(f"scene {place} is not that of {wanted.name}: it has other objects.")
            continue
        away = {name: float(np.linalg.norm(np.subtract(found[name], at))) for name, at in expected["positions"].items()}
        name = max(away, key=lambda one: away[one])
        if away[name] > TOLERANCE:
            lines.append(f'scene {place} is not that of {wanted.name}: "{name}" is {1000 * away[name]:.3g} mm away.')
    return lines, equal


def positions(scene: Path) -> dict[str, list[float]]:
    """Where the objects of the scene in a folder are [m]."""
    return {obj.name: [round(float(value), DIGITS) for value in obj.pose.position] for obj in load_scene(scene).objects}


def write_reference(
    folder: SuiteFolder, document: Mapping[str, Any], name: str, baselines: list[dict[str, Any]], to: Path
) -> None:
    """Write down what a finished suite is, for those who make it again.

    Args:
        folder: of the suite.
        document: its suite.json.
        name: of the reference.
        baselines: see Reference.
        to: the file.
    """
    scenes = [
        {
            **{key: scene[key] for key in ("candidate", "task", "instruction", "checksum")},
            "positions": positions(folder.scene(scene["place"])),
        }
        for scene in document["scenes"]
    ]
    write_document(
        to,
        {
            "name": f"pat3d/{name}",
            "request": document["request"],
            "checksum": document["checksum"],
            "versions": document["versions"],
            "baselines": baselines,
            "scenes": scenes,
        },
    )
