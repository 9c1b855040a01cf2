"""The shape language: what a noun in YAML may say, as a JSON schema, and its limits.

    noun: candle
    family: decor
    material: wax
    colours: [cream, red]
    parameters:
      r: 0.03                          # varies by 6 % from one object to the next
      h: {value: 0.12, kind: height}   # and follows "tall" and "short"
    parts:
      - colour: 0
        shape: {cylinder: {radius: r, height: h}}
      - colour: [40, 40, 40]
        shape: {cylinder: {radius: 0.002, height: 0.015}, then: [{move: [0, 0, h]}]}

A length is a number [m], a parameter, or a sum of multiples of them: {h: 1, r: -0.5, plus: 0.01} is h - r/2 + 1 cm.
"""

from __future__ import annotations

from typing import Any

from pat3d.assets.materials import material_names

LARGEST = 20.0
"""Of any length [m], and of any factor."""
MAX_SHAPES = 1000
"""Shapes that a program makes, copies counted."""
MAX_HULLS = 400
"""Convex parts of an object."""
MAX_COPIES = 200
MAX_POINTS = 400
MAX_DEPTH = 12
"""Shapes within shapes."""

_LENGTH = {
    "description": "a number, a parameter, or a sum of multiples of parameters such as {h: 1, r: -0.5, plus: 0.01}",
    "anyOf": [
        {"type": "number", "minimum": -1000, "maximum": 1000},
        {"type": "string", "pattern": "^[a-z][a-z0-9_]{0,30}$"},
        {
            "type": "object",
            "minProperties": 1,
            "maxProperties": 12,
            "propertyNames": {"pattern": "^[a-z][a-z0-9_]{0,30}$"},
            "additionalProperties": {"type": "number", "minimum": -1000, "maximum": 1000},
        },
    ],
}
_ANGLE = {"type": "number", "minimum": -360, "maximum": 360}
_AXIS = {"enum": ["x", "y", "z"]}


def _list(of: dict[str, Any], least: int, most: int) -> dict[str, Any]:
    return {"type": "array", "items": of, "minItems": least, "maxItems": most}


_PAIR, _TRIPLE = _list(_LENGTH, 2, 2), _list(_LENGTH, 3, 3)
_PROFILE = {**_list(_PAIR, 2, MAX_POINTS), "description": "[radius, z] points with z increasing"}
_PATH = _list(_TRIPLE, 2, MAX_POINTS)


def _record(required: dict[str, Any], optional: dict[str, Any] | None = None) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": {**required, **(optional or {})},
        "required": list(required),
        "additionalProperties": False,
    }


_SHAPE = {"$ref": "#/$defs/shape"}
_SIDES = {"sides": {"type": "integer", "minimum": 3, "maximum": 32}}
_SEGMENTS = {"type": "integer", "enum": [3, 4, 6, 8, 12, 16, 24]}

VERBS: dict[str, Any] = {
    "box": {**_TRIPLE, "description": "sizes, standing on z = 0"},
    "soft_box": _record({"size": _TRIPLE, "radius": _LENGTH}),
    "slab": _record({"size": _TRIPLE, "corner": _LENGTH}),
    "taper": _record({"bottom": _PAIR, "top": _PAIR, "height": _LENGTH}),
    "frustum": _record({"bottom": _LENGTH, "top": _LENGTH, "height": _LENGTH}, _SIDES),
    "cylinder": _record({"radius": _LENGTH, "height": _LENGTH}, _SIDES),
    "cone": _record({"radius": _LENGTH, "height": _LENGTH}, _SIDES),
    "ellipsoid": {**_TRIPLE, "description": "semi-axes, centred at the origin"},
    "spot": {**_TRIPLE, "description": "a small ellipsoid without a convex part: seeds, eyes, paint"},
    "rod": _record({"from": _TRIPLE, "to": _TRIPLE, "radius": _LENGTH}, {"end_radius": _LENGTH, **_SIDES}),
    "bent_rod": _record({"points": _PATH, "radius": _LENGTH}, _SIDES),
    "tube": _record(
        {"path": _PATH, "radius": {"anyOf": [*_LENGTH["anyOf"], _list(_LENGTH, 2, MAX_POINTS)]},
         "groups": {"type": "integer", "minimum": 1, "maximum": 32}},
        {"up": _list({"type": "number"}, 3, 3), "closed": {"type": "boolean"},
         "flatness": {"type": "number", "exclusiveMinimum": 0, "maximum": 10},
         "smooth": {"type": "integer", "minimum": 4, "maximum": 100}, **_SIDES},
    ),
    "hull": {**_list(_TRIPLE, 4, MAX_POINTS), "description": "points whose convex hull it is"},
    "lump": {**_list(_TRIPLE, 4, MAX_POINTS), "description": "a hull of many points, in a part of 18 faces"},
    "prism": _record({"outline": _list(_PAIR, 3, MAX_POINTS), "height": _LENGTH}),
    "extruded": _record({"outline": _list(_PAIR, 3, MAX_POINTS), "height": _LENGTH}, _SIDES),
    "revolve": _record({"profile": _PROFILE}, _SIDES),
    "lathe": _record(
        {"profile": _PROFILE},
        {"cuts": _list(_LENGTH, 0, 16), "angles": _list({"type": "number", "minimum": -89, "maximum": 89}, 1, 7),
         "smooth": {"type": "integer", "minimum": 4, "maximum": 100},
         "sides": {"type": "integer", "minimum": 0, "maximum": 32}},
    ),
    "vessel": _record({"outer": _PROFILE, "inner": _PROFILE}, {"segments": _SEGMENTS}),
    "hollow": _record(
        {"outer": _PROFILE, "inner": _PROFILE}, {"levels": _list(_LENGTH, 0, 16), "segments": _SEGMENTS}
    ),
    "tray": _record({"size": _TRIPLE, "wall": _LENGTH, "floor": _LENGTH}, {"flare": _LENGTH}),
    "join": {**_list(_SHAPE, 1, 200), "description": "shapes of one colour"},
    "cut": {**_record({"of": _SHAPE, "holes": _list(_SHAPE, 1, 100)}),
            "description": "holes that are only seen: the convex parts stay whole"},
    "dressed": {**_record({"looks": _SHAPE, "parts": _SHAPE}),
                "description": "the look of one shape with the convex parts of another, which contains it"},
    "wrap": {**_SHAPE, "description": "a convex shape with one part of 18 sides around it"},
    "ball": {**_LENGTH, "description": "radius of a ball that lies on a flat of its convex part, on z = 0"},
    "use": {"type": "string", "description": "a shape of `shapes`"},
}  # fmt: skip
"""What a shape is made by; exactly one in each shape."""

STEPS: dict[str, Any] = {
    "move": _TRIPLE,
    "turn": {
        "type": "object", "properties": {"x": _ANGLE, "y": _ANGLE, "z": _ANGLE}, "minProperties": 1, "maxProperties": 1,
        "additionalProperties": False, "description": "degrees about an axis through the origin: {y: 90}",
    },
    "scale": {"anyOf": [*_LENGTH["anyOf"], _TRIPLE]},
    "mirror": _AXIS,
    "cut_below": _LENGTH,
    "cut_above": _LENGTH,
    "line": _record({"count": {"type": "integer", "minimum": 1, "maximum": MAX_COPIES}, "step": _TRIPLE}),
    "circle": _record(
        {"count": {"type": "integer", "minimum": 1, "maximum": MAX_COPIES}, "radius": _LENGTH}, {"start": _ANGLE}
    ),
    "lobed": _record({"lobes": {"type": "integer", "minimum": 1, "maximum": 48},
                      "depth": {"type": "number", "minimum": 0, "maximum": 0.9}}),
    "unseen": {"const": True, "description": "without convex parts: another part of the object contains it"},
}  # fmt: skip
"""What is done to a shape, in the order of `then`; exactly one in each step."""

_COLOUR = {
    "description": "0 for the main colour, 1 and more for what follows, a name, [red, green, blue], or "
    "{of: 0, shade: 0.8}",
    "anyOf": [
        {"type": "integer", "minimum": 0, "maximum": 15},
        {"type": "string"},
        _list({"type": "integer", "minimum": 0, "maximum": 255}, 3, 3),
        _record({"of": {"type": "integer", "minimum": 0, "maximum": 15}, "shade": {"type": "number", "minimum": 0}}),
    ],
}
_COLOURED = _record({"colour": _COLOUR, "shape": _SHAPE})
_NAME = {"type": "string", "minLength": 1, "maxLength": 60, "pattern": "^[a-z][a-z0-9' -]*$"}
_NAMES = _list(_NAME, 0, 30)

REGION = _record(
    {},
    {
        "kind": {"enum": ["on", "in"]},
        "disc": _LENGTH,
        "rectangle": {**_PAIR, "description": "full sizes along x and y"},
        "at": {**_TRIPLE, "description": "centre of the floor"},
        "height": _LENGTH,
        "enclosed": {"type": "boolean", "description": "Whether something above limits what goes there."},
        "cavity": _record(
            {"inner": _PROFILE},
            {"levels": _list(_LENGTH, 0, 16), "segments": _SEGMENTS},
        ),
    },
)
"""A place for things: {kind: on, disc: r, at: [0, 0, h]}, or the cavity of a `hollow` of the same profile."""

SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "PAT3D noun",
    **_record(
        {"noun": _NAME, "parts": _list(_COLOURED, 1, 200)},
        {
            "family": _NAME,
            "names": {**_NAMES, "description": "Synonyms."},
            "plurals": {**_NAMES, "description": "Irregular ones."},
            "material": {"enum": list(material_names())},
            "colours": {**_list({"type": "string"}, 1, 16), "description": "One is chosen by seed."},
            "accents": _list({"type": "string"}, 0, 15),
            "parameters": {
                "type": "object",
                "maxProperties": 60,
                "propertyNames": {"pattern": "^[a-z][a-z0-9_]{0,30}$", "not": {"const": "plus"}},
                "additionalProperties": {
                    "anyOf": [
                        {"type": "number", "minimum": -1000, "maximum": 1000},
                        _record(
                            {"value": _LENGTH},
                            {
                                "spread": {"type": "number", "minimum": 0, "maximum": 0.9,
                                           "description": "It varies by this share; 0.06 where nothing is said."},
                                "kind": {"enum": ["height", "length"],
                                         "description": "Follows tall and short, or long and short."},
                            },
                        ),
                        _record({"is": _LENGTH}),
                    ]
                },
            },
            "shapes": {"type": "object", "maxProperties": 100, "additionalProperties": _SHAPE},
            "paint": {**_list(_COLOURED, 0, 200), "description": "Volumes that recolour the surface inside them."},
            "regions": _list(REGION, 0, 20),
            "anchors": _list(_TRIPLE, 0, 16),
            "mass": {**_LENGTH, "description": "[kg], where density times volume would be wrong."},
        },
    ),
    "$defs": {
        "shape": {
            "type": "object",
            "properties": {
                **VERBS,
                "then": _list({"type": "object", "properties": STEPS, "minProperties": 1, "maxProperties": 1,
                               "additionalProperties": False}, 0, 20),
            },
            "minProperties": 1,
            "maxProperties": 2,
            "additionalProperties": False,
        }
    },
}  # fmt: skip
