"""Postures: the rotation that turns an object as it is wanted, with a face of its hull flat on what carries it.

Every flat face of the convex hull on which the object does not tip is a way to lie. The steadiest one of those that
belong to the posture is taken, of a book the lower edge; where there is none, the posture is refused.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.spatial import ConvexHull

from pat3d.errors import LayoutError
from pat3d.geometry.polygons import polygon_margin
from pat3d.geometry.rotations import turn
from pat3d.layout.bodies import Array, Body
from pat3d.layout.shelved import stood

ASTRAY = math.radians(14.0)
"""Largest angle [rad] between a face's normal and the direction that the posture has down."""
STEADIEST = math.radians(3.0)
"""A face on which the object endures a smaller tilt [rad] than this is none to lie on."""
_FLAT = 2e-4
"""What is this near to the plane of a face [m] is on it."""
_SAID = {"upright": "upright", "upside_down": "upside down", "on_its_side": "on its side"}


def posture_rotation(body: Body, kind: str) -> Array:
    """The rotation matrix, shape (3, 3), that puts `body` into the posture `kind`.

    Raises:
        LayoutError: it does not stay so.
    """
    if kind == "upright":
        return np.eye(3)
    standing = stood(body.asset.noun) if kind == "on_its_side" else None
    if standing is not None and _endured(body, -standing[2]) > STEADIEST:
        return standing
    best: tuple[float, Array] | None = None
    for normal in _faces(body.vertices):
        astray = math.acos(min(1.0, float(normal[2]))) if kind == "upside_down" else abs(math.asin(float(normal[2])))
        if astray > ASTRAY:
            continue
        endured = _endured(body, normal)
        if endured > STEADIEST and (best is None or endured > best[0] + 1e-9):
            best = endured, normal
    if best is None:
        raise LayoutError(
            f'"{body.name}" cannot stay {_SAID[kind]}: it has no face there on which it endures a tilt of '
            f"{math.degrees(STEADIEST):.0f} degrees. Nothing was written."
        )
    rotation = _down(best[1])
    if kind == "on_its_side":
        # Its own vertical along x, where the viewer at -y sees its whole length.
        up = rotation[:, 2]
        rotation = turn(np.array([0.0, 0.0, 1.0]), -math.atan2(up[1], up[0])) @ rotation
    return rotation


def _faces(vertices: Array) -> list[Array]:
    """Outward unit normals of the hull's flat faces, each once."""
    found: list[Array] = []
    for equation in ConvexHull(vertices).equations:
        normal = equation[:3]
        if all(float(normal @ other) < 1.0 - 1e-6 for other in found):
            found.append(normal)
    return found


def _endured(body: Body, normal: Array) -> float:
    """Tilt [rad] that the body endures on the face with outward `normal`; negative where it tips at once."""
    turned = body.vertices @ _down(normal).T
    centre = _down(normal) @ body.centre_of_mass
    low = float(turned[:, 2].min())
    foot = turned[turned[:, 2] < low + _FLAT, :2]
    if len(foot) < 3 or np.linalg.matrix_rank(foot - foot[0], tol=1e-4) < 2:
        return -1.0
    return math.atan2(polygon_margin(foot, centre[:2], tolerance=0.0), float(centre[2]) - low)


def _down(normal: Array) -> Array:
    """The shortest rotation that takes the unit vector `normal` to -z."""
    axis = np.cross(normal, [0.0, 0.0, -1.0])
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        return np.eye(3) if normal[2] < 0 else turn(np.array([1.0, 0.0, 0.0]), math.pi)
    return turn(axis / sine, math.atan2(sine, -float(normal[2])))
