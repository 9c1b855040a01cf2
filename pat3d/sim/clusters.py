"""Splits detailed surfaces into small compact clusters, so that few of their primitives are ever tested.

A part with a thousand triangles has one box, and everything that overlaps it would be tested against all of them.
Every vertex, edge and triangle of a part belongs to exactly one cluster; a cluster is a contiguous range of each.
Triangles reach vertices of other clusters, which a cluster lists as its halo so that its box can enclose them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

MOST_TRIANGLES = 128
"""Parts of at most so many triangles are one cluster, in the order they were given: no hull of 64 vertices has more."""

CLUSTER_TRIANGLES = 32
"""Clusters have at most so many triangles, and more than half as many."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ClusteredPart:
    """A closed surface in the order of its clusters."""

    vertices: NDArray[np.float64]
    """shape (vertices, 3)."""
    edges: NDArray[np.int32]
    """shape (edges, 2)."""
    triangles: NDArray[np.int32]
    """shape (triangles, 3)."""
    ranges: NDArray[np.int32]
    """First and past-last vertex, edge, triangle and entry of `halo` of every cluster, shape (clusters, 8)."""
    halo: NDArray[np.int32]
    """Vertices that edges and triangles of a cluster reach in other clusters."""


def cluster(
    vertices: NDArray[np.float64],
    edges: NDArray[np.int32],
    triangles: NDArray[np.int32],
    most: int = MOST_TRIANGLES,
    size: int = CLUSTER_TRIANGLES,
) -> ClusteredPart:
    """Reorder a surface so that every cluster is a contiguous range of vertices, edges and triangles.

    Args:
        vertices: shape (vertices, 3).
        edges: those of the triangles' edges that matter, shape (edges, 2).
        triangles: shape (triangles, 3).
        most: surfaces of at most so many triangles stay as they are.
        size: largest number of triangles of a cluster.
    """
    if len(triangles) <= most:
        whole = np.array([[0, len(vertices), 0, len(edges), 0, len(triangles), 0, 0]], dtype=np.int32)
        return ClusteredPart(
            vertices=vertices, edges=edges, triangles=triangles, ranges=whole, halo=np.zeros(0, dtype=np.int32)
        )
    home = _split(vertices[triangles].mean(axis=1), size)
    count = int(home.max()) + 1
    # A vertex or an edge belongs to the first cluster that has a triangle of it.
    of_vertex = np.full(len(vertices), count - 1)
    np.minimum.at(of_vertex, triangles, home[:, None])
    of_edge = _cluster_of_edges(edges, triangles, home)
    vertex_order, vertex_bounds = _grouped(of_vertex, count)
    edge_order, edge_bounds = _grouped(of_edge, count)
    triangle_order, triangle_bounds = _grouped(home, count)
    renamed = np.empty(len(vertices), dtype=np.int32)
    renamed[vertex_order] = np.arange(len(vertices), dtype=np.int32)
    reached = np.concatenate([triangles.ravel(), edges.ravel()])
    by = np.concatenate([np.repeat(home, 3), np.repeat(of_edge, 2)])
    foreign = of_vertex[reached] != by
    halo = np.unique(np.stack([by[foreign], renamed[reached[foreign]]], axis=1), axis=0)
    halo_bounds = np.searchsorted(halo[:, 0], np.arange(count + 1))
    bounds = (vertex_bounds, edge_bounds, triangle_bounds, halo_bounds)
    return ClusteredPart(
        vertices=vertices[vertex_order],
        edges=renamed[edges[edge_order]],
        triangles=renamed[triangles[triangle_order]],
        ranges=np.stack([side for bound in bounds for side in (bound[:-1], bound[1:])], axis=1).astype(np.int32),
        halo=halo[:, 1].astype(np.int32),
    )


def _split(points: NDArray[np.float64], size: int) -> NDArray[np.int64]:
    """Cluster of every point, halved at the median of the longest side until none holds more than `size`."""
    home = np.zeros(len(points), dtype=np.int64)
    stack, count = [np.arange(len(points))], 0
    while stack:
        members = stack.pop()
        if len(members) <= size:
            home[members] = count
            count += 1
            continue
        axis = int(np.argmax(np.ptp(points[members], axis=0)))
        order = members[np.argsort(points[members, axis], kind="stable")]
        middle = len(order) // 2
        stack += [order[middle:], order[:middle]]
    return home


def _cluster_of_edges(
    edges: NDArray[np.int32], triangles: NDArray[np.int32], home: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Lowest cluster of the triangles at every edge, shape (edges,)."""
    base = int(triangles.max()) + 1
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1).astype(np.int64)
    keys, inverse = np.unique(sides[:, 0] * base + sides[:, 1], return_inverse=True)
    lowest = np.full(len(keys), home.max())
    np.minimum.at(lowest, inverse.ravel(), np.repeat(home, 3))
    ends = np.sort(edges, axis=1).astype(np.int64)
    return lowest[np.searchsorted(keys, ends[:, 0] * base + ends[:, 1])]


def _grouped(of: NDArray[np.int64], count: int) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Order that groups members by cluster, and where in it every cluster begins, shape (count + 1,)."""
    order = np.argsort(of, kind="stable")
    return order, np.searchsorted(of[order], np.arange(count + 1))
