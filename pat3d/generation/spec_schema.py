"""JSON schema of the specifications that `pat3d build` reads."""

from __future__ import annotations

from typing import Any

from pat3d.scene.arrangements import ARRANGEMENTS, MANY, POSTURES
from pat3d.scene.physics import SETTLING_FRICTION
from pat3d.scene.relations import LATERAL_KINDS, MAX_CARRIERS, SUPPORT_KINDS

KINDS = sorted(SUPPORT_KINDS | LATERAL_KINDS)

_POSITIVE = {"type": "number", "exclusiveMinimum": 0}
_NAME = {"type": "string", "minLength": 1, "maxLength": 200}
_VECTOR = {"type": "array", "items": {"type": "number"}, "minItems": 3, "maxItems": 3}

_POSE = {
    "type": "object",
    "description": "Where the object starts; settling moves it from there unless it is fixed.",
    "properties": {
        "position": {**_VECTOR, "description": "Of the base's centre [m]; z is up."},
        "yaw_degrees": {"type": "number", "description": "Turn about the vertical, counter-clockwise from above."},
        "quat_wxyz": {
            "type": "array",
            "items": {"type": "number"},
            "minItems": 4,
            "maxItems": 4,
            "description": "Unit quaternion, scalar first, instead of yaw_degrees.",
        },
    },
    "required": ["position"],
    "additionalProperties": False,
}

_OBJECT = {
    "type": "object",
    "properties": {
        "name": {**_NAME, "description": "Unique in the scene."},
        "noun": {
            **_NAME,
            "description": "What to take from the catalogue (see pat3d catalogue) or a library: ycb/power_drill.",
        },
        "mesh": {
            "type": "string",
            "minLength": 1,
            "maxLength": 1000,
            "description": "OBJ, STL, PLY, OFF, GLB, glTF, DAE, FBX or 3MF file instead of a noun, relative to this "
            "file.",
        },
        "model": {
            "type": "string",
            "minLength": 1,
            "maxLength": 1000,
            "description": "MJCF, URDF, SDF or USD file of one rigid object instead of a noun, relative to this file: "
            "its collision shapes, mass, inertia and friction are kept.",
        },
        "colour": {**_NAME, "description": "Main colour of a noun."},
        "colours": {"type": "array", "items": _NAME, "minItems": 1, "maxItems": 16, "description": "Of a noun."},
        "material": {**_NAME, "description": "Decides density and friction where they are not given."},
        "units": {"enum": ["m", "cm", "mm", "in"], "description": "Of the mesh's coordinates."},
        "up": {"enum": ["x", "-x", "y", "-y", "z", "-z"], "description": "Axis of the mesh that points up."},
        "scale": {**_POSITIVE, "description": "Factor on the size."},
        "size": {
            "description": "Longest side [m]; for a mesh also [x, y, z] with null for sides that follow.",
            "anyOf": [
                _POSITIVE,
                {"type": "array", "items": {"anyOf": [_POSITIVE, {"type": "null"}]}, "minItems": 3, "maxItems": 3},
            ],
        },
        "parts": {"enum": ["coacd", "hull", "box"], "description": "How a mesh becomes convex parts."},
        "threshold": {
            "type": "number",
            "minimum": 0.01,
            "maximum": 1,
            "description": "Concavity that the decomposition of a mesh may leave.",
        },
        "max_hulls": {
            "type": "integer",
            "minimum": 1,
            "maximum": 1000,
            "description": "Most convex parts of the decomposition of a mesh.",
        },
        "decomposition_limit": {**_POSITIVE, "description": "Processor time for the decomposition of a mesh [s]."},
        "thickness": {**_POSITIVE, "description": "Wall thickness of an open mesh [m]."},
        "mass": {**_POSITIVE, "description": "[kg]"},
        "density": {**_POSITIVE, "description": "[kg/m^3] of the closed surface, instead of the mass."},
        "friction": {"type": "number", "minimum": 0, "description": "Coulomb coefficient that exports carry."},
        "fixed": {"type": "boolean", "description": "Never moves, neither while settling nor in exports."},
        "posture": {"enum": sorted(POSTURES), "description": "How it is turned before it settles, and checked after."},
        "pose": _POSE,
    },
    "required": ["name"],
    "additionalProperties": False,
}

_RELATION = {
    "type": "object",
    "properties": {
        "child": _NAME,
        "kind": {"enum": KINDS},
        "parent": {
            "description": "A name; for what lies on several objects, a list of them.",
            "anyOf": [
                _NAME,
                {"type": "array", "items": _NAME, "minItems": 2, "maxItems": MAX_CARRIERS, "uniqueItems": True},
            ],
        },
    },
    "required": ["child", "kind", "parent"],
    "additionalProperties": False,
}

_NAMES = {"type": "array", "items": _NAME, "maxItems": MANY}
_ARRANGEMENT = {
    "type": "object",
    "properties": {
        "kind": {
            "enum": sorted(ARRANGEMENTS),
            "description": "; ".join(f"{kind}: {rule.holds}" for kind, rule in ARRANGEMENTS.items()),
        },
        "objects": {**_NAMES, "minItems": 1, "description": "What stands so; in order, for rows and circles."},
        "of": {**_NAMES, "description": "What it stands so to: the neighbours, the surface, what it leans on."},
    },
    "required": ["kind", "objects"],
    "additionalProperties": False,
}

BUILD_SCHEMA: dict[str, Any] = {
    "$schema": "https://json-schema.org/draft/2020-12/schema",
    "title": "PAT3D scene specification",
    "type": "object",
    "properties": {
        "seed": {"type": "integer", "minimum": 0, "maximum": 2**32 - 1, "default": 0},
        "friction": {
            "type": "number",
            "exclusiveMinimum": 0,
            "maximum": 2,
            "default": SETTLING_FRICTION,
            "description": "Coulomb coefficient of every contact while settling.",
        },
        "objects": {"type": "array", "items": _OBJECT, "minItems": 1, "maxItems": 500},
        "relations": {
            "type": "array",
            "items": _RELATION,
            "maxItems": 5000,
            "description": "The parent may be ground; what nothing carries stands on the ground.",
        },
        "arrangements": {"type": "array", "items": _ARRANGEMENT, "maxItems": 5000},
    },
    "required": ["objects"],
    "additionalProperties": False,
}
