"""R, how much the surfaces of different objects pass through each other (Table 1 of the paper).

R = (T_p - sum_i T_p,i) l_e / l

T_p counts the pairs of triangles, of all objects together, that pass through each other, T_p,i those of object i with
itself; what is left are pairs of different objects. l_e is the edge length of the triangles and l the diagonal of the
scene's bounding box. The paper remeshes with fTetWild at l_e = 0.05 l; on delivered meshes l_e is their mean edge.

An object that lies wholly inside another has no such pair: the definition does not see it. The count is FCL's.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.check.metrics.subject import Subject

EDGE = 0.05
"""Edge length of the remeshed surfaces over the scene's diagonal [-]."""
MOST_PAIRS = 10_000_000

Surface = tuple[NDArray[np.float64], NDArray[np.int32]]
"""World vertices [m], shape (n, 3), and triangles, shape (m, 3)."""


@dataclass(frozen=True, kw_only=True)
class Interpenetration:
    """R of a scene."""

    value: float
    """R [-]"""
    pairs: int
    """Pairs of triangles of different objects that pass through each other."""
    edge: float
    """l_e / l [-]"""
    objects: tuple[tuple[str, str, int], ...]
    """The objects that do, with their pairs of triangles."""


def interpenetration(subject: Subject, surfaces: Sequence[Surface] | None = None) -> Interpenetration:
    """R of the delivered surfaces, or of remeshed ones.

    Args:
        subject: the objects.
        surfaces: remeshed, one for every object, with edges of EDGE of the diagonal; the delivered ones where None.
    """
    if surfaces is None:
        found = [(body.vertices, body.visual.faces) for body in subject.bodies]
        corners = np.concatenate([vertices[faces] for vertices, faces in found])
        edge = float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean()) / subject.diagonal
    else:
        found, edge = list(surfaces), EDGE
    names = [body.name for body in subject.bodies]
    pairs = []
    for i, first in enumerate(found):
        for j in range(i):
            count = penetrating_pairs(first, found[j])
            if count:
                pairs.append((names[j], names[i], count))
    total = sum(count for _, _, count in pairs)
    return Interpenetration(value=total * edge, pairs=total, edge=edge, objects=tuple(pairs))


def penetrating_pairs(a: Surface, b: Surface) -> int:
    """Number of pairs of a triangle of `a` and one of `b` that have a point in common."""
    low = np.maximum(a[0].min(axis=0), b[0].min(axis=0))
    high = np.minimum(a[0].max(axis=0), b[0].max(axis=0))
    if np.any(low > high):
        return 0
    near = [_within(surface, low, high) for surface in (a, b)]
    if any(not len(faces) for _, faces in near):
        return 0
    import fcl

    result = fcl.CollisionResult()
    request = fcl.CollisionRequest(num_max_contacts=MOST_PAIRS, enable_contact=True)
    fcl.collide(*map(_bvh, near), request, result)
    return len({(contact.b1, contact.b2) for contact in result.contacts})


def _within(surface: Surface, low: NDArray[np.float64], high: NDArray[np.float64]) -> Surface:
    """The triangles whose bounding boxes meet a box."""
    vertices, faces = surface
    corners = vertices[faces]
    meet = np.all(corners.min(axis=1) <= high, axis=1) & np.all(corners.max(axis=1) >= low, axis=1)
    return vertices, faces[meet]


def _bvh(surface: Surface) -> Any:
    import fcl

    vertices, faces = surface
    model = fcl.BVHModel()
    model.beginModel(len(vertices), len(faces))
    model.addSubModel(np.ascontiguousarray(vertices), np.ascontiguousarray(faces, dtype=np.int32))
    model.endModel()
    return fcl.CollisionObject(model)
