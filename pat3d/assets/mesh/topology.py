"""Connectivity of triangle soups: welding, sheets, winding, boundary loops, winding numbers.

A sheet is a maximal set of faces connected across edges. Where more than two faces meet at an edge they
are paired around it, or, if that is impossible, cut apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order, connected_components
from scipy.spatial import KDTree

from pat3d.geometry.normals import enclosed_volume

Points = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]


def weld(vertices: Points, faces: Indices, tolerance: float) -> tuple[Points, Indices, int]:
    """Join equal vertices, then vertices on open edges closer than `tolerance`; returns how many of the latter."""
    vertices, inverse = np.unique(vertices + 0.0, axis=0, return_inverse=True)
    faces = inverse.reshape(-1)[faces]
    pairs, counts = edge_counts(faces)
    rim = np.unique(pairs[counts == 1])
    if not len(rim):
        return vertices, faces, 0
    near = KDTree(vertices[rim]).query_pairs(tolerance, output_type="ndarray")
    label = components(len(vertices), rim[near])
    first = np.unique(label, return_index=True)[1]
    return vertices[first], label[faces], len(vertices) - len(first)


def components(count: int, pairs: Indices) -> Indices:
    """Label of each of `count` nodes joined by `pairs`, shape (pairs, 2)."""
    pairs = pairs.reshape(-1, 2)
    graph = coo_matrix((np.ones(len(pairs), dtype=np.int8), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
    return connected_components(graph, directed=False)[1].astype(np.int64)


def edge_counts(faces: Indices) -> tuple[Indices, Indices]:
    """Undirected edges, shape (edges, 2), and how many faces have each."""
    code, counts = np.unique(_edge_code(faces), return_counts=True)
    return np.stack(np.divmod(code, _span(faces)), axis=1), counts


@dataclass(frozen=True, kw_only=True, eq=False)
class Sheets:
    """Faces whose vertices are split so that every edge has one or two of them, consistently wound."""

    vertices: Points
    faces: Indices
    corners: Indices
    """Corner of the input (3 face + corner) that each face corner was, shape (faces, 3)."""
    label: Indices
    """Sheet of each face."""
    cut: NDArray[np.bool_]
    """Whether the edge from corner k to the next was cut where several faces meet, shape (faces, 3)."""
    turned: int
    """Faces whose winding was reversed."""
    orientable: bool


def split_sheets(vertices: Points, faces: Indices) -> Sheets:
    """Split a welded mesh without degenerate or duplicate faces into sheets."""
    count = len(faces)
    corners = np.arange(3 * count, dtype=np.int64).reshape(-1, 3)
    code = _edge_code(faces)
    order = np.argsort(code, kind="stable")
    bounds = np.flatnonzero(np.diff(code[order], prepend=-1, append=-1))
    sizes = np.diff(bounds)
    twos = bounds[:-1][sizes == 2]
    first, second = order[twos], order[twos + 1]
    flip, orientable = _winding(faces, first, second)
    turned = faces.copy()
    turned[flip] = turned[flip][:, ::-1]
    corners[flip] = corners[flip][:, ::-1]
    # Reversing a face moves edge k (corner k to k + 1) to 1 - k modulo 3.
    half = np.arange(3 * count)
    face, edge = np.divmod(half, 3)
    place = np.where(flip[face], 3 * face + (1 - edge) % 3, half)
    pairs = [np.stack([place[first], place[second]], axis=1)]
    cut = np.zeros(3 * count, dtype=bool)
    known = components(count, pairs[0] // 3)
    for start, size in zip(bounds[:-1][sizes > 2], sizes[sizes > 2], strict=True):
        around = place[order[start : start + size]]
        matched = _pair_within(turned, around, known[around // 3])
        if not len(matched):
            matched = _pair_around(vertices, turned, around)
        cut[around] = not len(matched)
        pairs.append(matched)
    joined = np.concatenate(pairs).astype(np.int64)
    label = components(count, joined // 3)
    # Corners are one vertex when a fan of paired edges joins them.
    a, b = joined[:, 0], joined[:, 1]
    forward = turned.reshape(-1)[a] == turned.reshape(-1)[b]
    next_a, next_b = _next(a), _next(b)
    start_b, end_b = np.where(forward, b, next_b), np.where(forward, next_b, b)
    fans = components(3 * count, np.concatenate([np.stack([a, start_b], 1), np.stack([next_a, end_b], 1)]))
    representative = np.unique(fans, return_index=True)[1]
    return Sheets(
        vertices=vertices[turned.reshape(-1)[representative]],
        faces=fans.reshape(-1, 3),
        corners=corners,
        label=label,
        cut=cut.reshape(-1, 3),
        turned=int(flip.sum()),
        orientable=orientable,
    )


def boundary_loops(faces: Indices) -> list[Indices]:
    """Loops of half-edges (3 face + corner) along the boundary of a manifold sheet, in the faces' direction."""
    code = _edge_code(faces)
    _, inverse, counts = np.unique(code, return_inverse=True, return_counts=True)
    free = np.flatnonzero(counts[inverse.reshape(-1)] == 1)
    flat = faces.reshape(-1)
    leaving = {int(flat[half]): int(half) for half in free}
    loops = []
    while leaving:
        start, half = leaving.popitem()
        loop, vertex = [half], int(flat[_next(np.array(half))])
        while vertex != start and vertex in leaving:
            half = leaving.pop(vertex)
            loop.append(half)
            vertex = int(flat[_next(np.array(half))])
        if vertex == start and len(loop) >= 2:
            loops.append(np.array(loop))
    return loops


def signed_volume(vertices: Points, faces: Indices) -> float:
    """Volume enclosed by closed faces, positive when they face outwards."""
    return enclosed_volume((vertices - vertices[faces[0, 0]])[faces])


def winding_number(points: Points, vertices: Points, faces: Indices) -> NDArray[np.float64]:
    """Generalised winding number of `points` about the faces (van Oosterom and Strackee 1983), shape (points,)."""
    result = np.empty(len(points))
    for k, point in enumerate(points):
        a, b, c = np.moveaxis(vertices[faces] - point, 1, 0)
        la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
        top = np.einsum("fi,fi->f", a, np.cross(b, c))
        dots = [np.einsum("fi,fi->f", p, q) for p, q in ((a, b), (b, c), (c, a))]
        result[k] = np.arctan2(top, la * lb * lc + dots[0] * lc + dots[1] * la + dots[2] * lb).sum() / (2.0 * np.pi)
    return result


def _span(faces: Indices) -> int:
    return int(faces.max(initial=0)) + 1


def _edge_code(faces: Indices) -> Indices:
    """One number per half-edge (corner k to the next), equal for the same undirected edge."""
    ends = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2).reshape(-1, 2).astype(np.int64)
    return ends.min(axis=1) * _span(faces) + ends.max(axis=1)


def _next(half: Indices) -> Indices:
    return 3 * (half // 3) + (half + 1) % 3


def _winding(faces: Indices, first: Indices, second: Indices) -> tuple[NDArray[np.bool_], bool]:
    """Which faces to reverse so that neighbours agree, and whether that is possible."""
    flat = faces.reshape(-1)
    differ = flat[first] == flat[second]
    flip = np.zeros(len(faces), dtype=bool)
    if not differ.any():
        return flip, True
    one, two = first // 3, second // 3
    weight = np.where(differ, 2, 1).astype(np.int8)
    graph = coo_matrix((weight, (one, two)), shape=(len(faces), len(faces))).tocsr()
    graph = graph.maximum(graph.T).tocsr()
    label = connected_components(graph, directed=False)[1]
    wrong = np.unique(label[one[differ]])
    for root in np.unique(label, return_index=True)[1][wrong]:
        order, parent = breadth_first_order(graph, root, directed=False)
        opposed = np.asarray(graph[order[1:], parent[order[1:]]]).reshape(-1) == 2
        for face, above, opposite in zip(order[1:], parent[order[1:]], opposed, strict=True):
            flip[face] = flip[above] ^ opposite
        if 2 * flip[order].sum() > len(order):
            flip[order] = ~flip[order]
    return flip, bool((flip[one] ^ flip[two] == differ).all())


def _pair_within(faces: Indices, halves: Indices, label: Indices) -> Indices:
    """Pairs of half-edges of one edge that belong to the same piece, where every piece has exactly one pair."""
    order = np.argsort(label, kind="stable")
    halves, label = halves[order].reshape(-1), label[order]
    none = np.zeros((0, 2), dtype=np.int64)
    if len(halves) % 2 or (label[::2] != label[1::2]).any() or (label[1:-1:2] == label[2::2]).any():
        return none
    first, second = halves[::2], halves[1::2]
    flat = faces.reshape(-1)
    return none if (flat[first] == flat[second]).any() else np.stack([first, second], axis=1)


def _pair_around(vertices: Points, faces: Indices, halves: Indices) -> Indices:
    """Pairs of the half-edges `halves` of one edge that bound the same wedge of solid; none if they do not match."""
    flat = faces.reshape(-1)
    start, end = flat[halves], flat[_next(halves)]
    along = start == start.min()
    if 2 * along.sum() != len(halves):
        return np.zeros((0, 2), dtype=np.int64)
    low, high = vertices[min(start[0], end[0])], vertices[max(start[0], end[0])]
    axis = (high - low) / max(float(np.linalg.norm(high - low)), 1e-300)
    arms = vertices[flat[_next(_next(halves))]] - low
    arms = arms - np.outer(arms @ axis, axis)
    x = arms[0] / max(float(np.linalg.norm(arms[0])), 1e-300)
    angle = np.arctan2(arms @ np.cross(axis, x), arms @ x) % (2.0 * np.pi)
    # Turning about the edge, the solid lies behind a face that runs along the edge, until one that runs against it.
    order = np.argsort(angle, kind="stable")
    sequence = along[order]
    if (sequence == np.roll(sequence, 1)).any():
        return np.zeros((0, 2), dtype=np.int64)
    opening = np.flatnonzero(~sequence)
    return np.stack([halves[order[opening]], halves[order[(opening + 1) % len(order)]]], axis=1)
