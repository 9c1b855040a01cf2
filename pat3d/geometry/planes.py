"""Face planes of convex parts: half-space form n . x + d <= 0 inside, and which of several planes a point is beyond."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.normals import area_vectors

_SAME_PLANE = 1e-6
"""Distance of one triangle's corners from the plane of the next, over the part's size, up to which they are one face;
ten times what is lost where corners are kept in single precision."""


def planes(part: ConvexPart) -> NDArray[np.float64]:
    """Outward unit normals n and offsets d [m] of a part's faces, inside where n . x + d <= 0, shape (faces, 4)."""
    corners = part.vertices[part.faces]
    normals = area_vectors(corners)
    lengths = np.linalg.norm(normals, axis=1)
    keep = lengths > 1e-12 * lengths.max()
    normals = normals[keep] / lengths[keep, None]
    return np.column_stack([normals, -np.einsum("fi,fi->f", normals, corners[keep].mean(axis=1))])


def enclosed(planes: NDArray[np.float64], inside: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners [m] of the polyhedron inside of all `planes`, each once, shape (n, 3).

    Args:
        planes: outward unit normals and offsets [m], shape (planes, 4).
        inside: a point well inside of it [m], shape (3,).
    """
    from scipy.spatial import HalfspaceIntersection, KDTree

    offsets = planes[:, 3] + planes[:, :3] @ inside
    size = float(np.abs(offsets).max())
    corners = HalfspaceIntersection(np.column_stack([planes[:, :3], offsets / size]), np.zeros(3)).intersections
    # Where more than three planes meet, the corner comes out several times, apart by rounding.
    again = KDTree(corners).query_pairs(3e-7, p=np.inf, output_type="ndarray")
    return np.delete(corners, again.max(axis=1), axis=0) * size + inside


def face_count(part: ConvexPart) -> int:
    """Flat faces of a part, coplanar neighbours as one."""
    import trimesh
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    mesh = trimesh.Trimesh(part.vertices, part.faces, process=False)
    pairs, apart = mesh.face_adjacency, mesh.face_adjacency_unshared
    corners = np.asarray(part.vertices)[np.asarray(part.faces)]
    normals = area_vectors(corners)
    areas = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(areas, np.finfo(np.float64).tiny)[:, None]
    # The plane of the larger of two triangles is known better: a sliver's normal is mostly rounding.
    first_larger = (areas[pairs[:, 0]] > areas[pairs[:, 1]])[:, None]
    one, _ = np.where(first_larger, pairs, pairs[:, ::-1]).T
    tip = np.where(first_larger[:, 0], apart[:, 1], apart[:, 0])
    away = np.einsum("ij,ij->i", normals[one], np.asarray(part.vertices)[tip] - corners[one, 0])
    same = pairs[np.abs(away) <= _SAME_PLANE * float(np.ptp(part.bounds, axis=0).max())]
    size = len(corners)
    graph = coo_array((np.ones(len(same)), (same[:, 0], same[:, 1])), shape=(size, size))
    return int(connected_components(graph, directed=False)[0])


def plane_distances(points: NDArray[np.float64], sides: NDArray[np.float64]) -> NDArray[np.float64]:
    """Largest signed distance of each of `points` [m], shape (n, 3), to the planes `sides`; negative inside."""
    return (points @ sides[:, :3].T + sides[:, 3]).max(axis=1)
