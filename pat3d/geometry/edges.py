"""Edges of closed triangle meshes: the two faces at each, and which edges are sharp (no part of a flat facet)."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import unit_normals

FLAT_EDGE = 1e-6
"""Edges whose two faces' normals differ by less than this [rad] are inside a flat facet: no contact needs them."""


def edges_and_faces(faces: NDArray[np.integer[Any]]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Vertex pairs of the edges in lexical order, and the two faces at each, both of shape (edges, 2).

    Raises:
        AssetError: an edge has another number of faces than two.
    """
    halves = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    order = np.lexsort((halves[:, 1], halves[:, 0]))
    edges = halves[order]
    same = np.all(edges[1:] == edges[:-1], axis=1)
    if len(edges) % 2 or not same[::2].all() or same[1::2].any():
        raise AssetError("a part's surface is open or not manifold; every edge needs exactly two faces.")
    return edges[::2], (order // 3).reshape(-1, 2)


def sharp_edges(part: ConvexPart) -> NDArray[np.int32]:
    """Edges of a part whose faces are not coplanar, shape (edges, 2).

    Raises:
        AssetError: the surface is open or not manifold.
    """
    edges, sides = edges_and_faces(part.faces)
    first, second = np.moveaxis(unit_normals(part.vertices[part.faces])[sides], 1, 0)
    angle_sine = np.linalg.norm(np.cross(first, second), axis=1)
    folded = np.einsum("ei,ei->e", first, second) < 0
    return edges[(angle_sine > FLAT_EDGE) | folded].astype(np.int32)
