"""Closing the seams of a surface that was cut in pieces and simplified piece by piece.

A boolean library drops vertices in the middle of straight borders, on each piece by itself, so the two
sides of a cut can divide the same line differently. Splitting the triangles at the other side's vertices
closes the surface again without moving it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def close_seams(
    points: NDArray[np.float64], faces: NDArray[np.int32], tolerance: float = 1e-6
) -> tuple[NDArray[np.int32], NDArray[np.int64]]:
    """Split triangles where a vertex of another open edge lies on one of theirs.

    Args:
        points: [m], shape (points, 3).
        faces: shape (faces, 3); edges without a partner are open.
        tolerance: how far [m] off an edge a vertex may lie.

    Returns:
        The faces, shape (more faces, 3), and for each the row of `faces` that it is a piece of.
    """
    source = np.arange(len(faces))
    for _ in range(20):
        directed = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
        _, inverse, count = np.unique(np.sort(directed, axis=1), axis=0, return_inverse=True, return_counts=True)
        is_open = (count[inverse.reshape(-1)] % 2 == 1).reshape(-1, 3)
        ends = np.unique(directed[is_open.reshape(-1)])
        pieces: list[NDArray[np.int32]] = []
        origin: list[int] = []
        replaced: list[int] = []
        for row in np.flatnonzero(is_open.any(axis=1)):
            for side in np.flatnonzero(is_open[row]):
                a, b, tip = np.roll(faces[row], -side)
                chain = [a, *_between(points, ends, a, b, tolerance), b]
                if len(chain) > 2:
                    pieces += [np.array([p, q, tip], dtype=np.int32) for p, q in zip(chain, chain[1:], strict=False)]
                    origin += [int(source[row])] * (len(chain) - 1)
                    replaced.append(int(row))
                    break
        if not replaced:
            break
        faces = np.concatenate([np.delete(faces, replaced, axis=0), np.array(pieces, dtype=np.int32)])
        source = np.concatenate([np.delete(source, replaced), origin])
    return faces, source


def _between(points: NDArray[np.float64], ends: NDArray[np.int32], a: int, b: int, tolerance: float) -> list[int]:
    """Those of the vertices `ends` that lie on the segment from a to b, in order."""
    along = points[b] - points[a]
    offset = points[ends] - points[a]
    part = offset @ along / (along @ along)
    gap = np.linalg.norm(offset - part[:, None] * along, axis=1)
    inside = (gap < tolerance) & (part > 0) & (part < 1) & (ends != a) & (ends != b)
    return [int(end) for end in ends[inside][np.argsort(part[inside])]]
