"""`library.yaml`: what a user knows better than the index, for the library or for objects by name.

licence: CC BY 4.0
units: mm
objects:
mug: {up: y, material: ceramic, names: [coffee mug]}
broken_chair: {skip: true}
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from pat3d.assets.materials import material_names
from pat3d.assets.mesh.importing import METRES, TO_Z_UP
from pat3d.scene.yaml_source import Source, read_yaml, validate

FILE = "library.yaml"

_POSITIVE = {"type": "number", "exclusiveMinimum": 0}
_TEXT = {"type": "string", "minLength": 1, "maxLength": 200}
_OBJECT = {
    "units": {"enum": list(METRES), "description": "Of the coordinates."},
    "up": {"enum": list(TO_Z_UP), "description": "Axis of the file that points up."},
    "size": {**_POSITIVE, "description": "Longest side [m], instead of the unit."},
    "mass": {**_POSITIVE, "description": "[kg]"},
    "material": {"enum": list(material_names()), "description": "For density and friction."},
    "friction": {"type": "number", "minimum": 0},
    "names": {"type": "array", "items": _TEXT, "minItems": 1, "maxItems": 20, "description": "Best first."},
    "licence": _TEXT,
    "parts": {"enum": ["coacd", "hull", "box"], "description": "How it becomes convex parts."},
    "skip": {"type": "boolean", "description": "Leave it out."},
}

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "PAT3D library",
    "type": "object",
    "properties": {
        **{key: _OBJECT[key] for key in ("units", "up", "material", "friction", "licence", "parts")},
        "objects": {
            "type": "object",
            "maxProperties": 100_000,
            "additionalProperties": {"type": "object", "properties": _OBJECT, "additionalProperties": False},
        },
    },
    "additionalProperties": False,
}


def read_overrides(*folders: Path) -> dict[str, Any]:
    """What the first `library.yaml` of `folders` says; empty where there is none.

    Raises:
        SpecError: it is not valid; the message names the line.
    """
    for folder in folders:
        if (folder / FILE).is_file():
            source: Source = read_yaml(folder / FILE)
            validate(source, SCHEMA)
            return source.document
    return {}


def settings_for(overrides: dict[str, Any], name: str) -> dict[str, Any]:
    """What is said of the object called `name`: the library's settings, then its own."""
    common = {key: value for key, value in overrides.items() if key != "objects"}
    own = overrides.get("objects", {}).get(name, {})
    if "size" in own:
        common.pop("units", None)
    return {**common, **own}
