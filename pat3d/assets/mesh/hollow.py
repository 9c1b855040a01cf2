"""Pieces of a wall cut where they bridge the hollow that they bound: a chord of a round wall becomes two.

A decomposition measures how concave a piece is, whichever side it is concave on. What a cavity loses is decided by the
pieces that rays from its axis meet first, so those alone are cut, along the wall or across it, and what is left of the
solid in each half gets a hull of its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.mesh.cavity import Probe
from pat3d.assets.mesh.repair import Solid, manifold_of

_CAP = 4.0
"""Times what is wanted that a ray counts for at most: half a chord takes a quarter, so worse ones need many cuts."""

_HELPS = 0.95
"""Share of what a piece took that its halves may take for the cut to help."""

_UP = np.array([0.0, 0.0, 1.0])

WANTED = 0.014
"""Median fraction of the radius that hulls may take; reduction and growth take some more."""

_LEAST_VOLUME = 1e-6
"""Share of a piece below which what is cut off is left to the growth of its neighbours."""


def opened(
    pieces: Sequence[NDArray[np.float64]], solid: Solid, seen: Probe, most: int, wanted: float = WANTED
) -> list[NDArray[np.float64]]:
    """The pieces, those that take most of a cavity cut until their hulls take `wanted`, or there are `most`.

    Args:
        pieces: points of each [m], shape (n, 3), whose hulls contain the solid together.
        solid: what the pieces stand for.
        seen: rays from the cavity's axis to its wall.
        most: pieces to end with.
        wanted: median fraction of the radius that may be lost.
    """
    whole = manifold_of(solid.vertices, solid.faces)
    if whole is None or not len(seen.free):
        return list(pieces)
    walls = [_wall(piece, whole, seen) for piece in pieces]
    while len(walls) < most:
        lost = np.array([wall.lost for wall in walls])
        if np.median(lost.max(axis=0)) <= wanted:
            break
        gains = _gains(lost, walls, wanted)
        gains[[len(walls) + len(wall.halves) - 1 > most for wall in walls]] = 0.0
        best = int(np.argmax(gains))
        if gains[best] <= 0.0:
            break
        walls[best : best + 1] = [_wall(half, whole, seen) for half in walls[best].halves]
    return [wall.points for wall in walls]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Wall:
    """A piece, and what cutting it would make of it."""

    points: NDArray[np.float64]
    """[m], shape (n, 3)."""
    lost: NDArray[np.float64]
    """What its hull takes of every ray, shape (rays,)."""
    halves: list[NDArray[np.float64]]
    """Points of what the better cut leaves; none where it takes nothing, or no cut helps."""
    left: NDArray[np.float64]
    """What their hulls take of every ray, shape (rays,)."""


def _gains(lost: NDArray[np.float64], walls: Sequence[_Wall], wanted: float) -> NDArray[np.float64]:
    """What the cut of every piece gives back, for each piece that it adds, shape (pieces,).

    A ray counts for what it loses beyond `wanted`, up to _CAP times that.
    """
    order = np.sort(lost, axis=0)
    first, second = order[-1], order[-2] if len(order) > 1 else np.zeros_like(order[-1])
    others = np.where(lost == first, second, first)
    after = np.maximum(others, np.array([wall.left for wall in walls]))
    least, most = wanted, _CAP * wanted
    gain = np.clip(first, least, most).sum() - np.clip(after, least, most).sum(axis=1)
    added = np.array([max(1, len(wall.halves) - 1) for wall in walls])
    return np.array([bool(wall.halves) for wall in walls]) * gain / added


def _wall(piece: NDArray[np.float64], whole: manifold3d.Manifold, seen: Probe) -> _Wall:
    lost = seen.loss(_reach(piece, seen))
    halves, left = _cut(piece, whole, seen, lost) if lost.any() else ([], lost)
    return _Wall(points=piece, lost=lost, halves=halves, left=left)


def _reach(piece: NDArray[np.float64], seen: Probe) -> NDArray[np.float64]:
    try:
        return seen.reach(np.unique(ConvexHull(piece).equations, axis=0))
    except QhullError:
        return np.full(len(seen.free), np.inf)


def _cut(
    piece: NDArray[np.float64], whole: manifold3d.Manifold, seen: Probe, lost: NDArray[np.float64]
) -> tuple[list[NDArray[np.float64]], NDArray[np.float64]]:
    """Points of the solid's parts on either side of the better of two planes, none where neither helps; what they take.

    One plane holds the cavity's axis and the middle of the rays that the piece shortens, the other is level.
    """
    best: list[NDArray[np.float64]] = []
    left = lost
    body = manifold3d.Manifold.hull_points(np.ascontiguousarray(piece)) ^ whole
    if body.is_empty():
        return best, left
    hit = lost > 0.0
    rays, heights = seen.rays[hit], seen.origins[hit, 2]
    towards = rays.mean(axis=0)
    towards /= max(float(np.linalg.norm(towards)), 1e-300)
    side = rays @ np.cross(towards, _UP)
    middle = towards + np.cross(towards, _UP) * (side.min() + side.max()) / 2.0
    along = np.cross(middle, _UP)
    along /= max(float(np.linalg.norm(along)), 1e-300)
    planes = ((along, float(along @ seen.origins[0])), (_UP, float(heights.min() + heights.max()) / 2.0))
    for normal, offset in planes:
        found = [
            np.asarray(one.to_mesh64().vert_properties)[:, :3]
            for half in body.split_by_plane(tuple(normal), offset)
            for one in half.decompose()
            if one.volume() > _LEAST_VOLUME * body.volume()
        ]
        if len(found) < 2:
            continue
        after = seen.loss(np.minimum.reduce([_reach(one, seen) for one in found]))
        if after.sum() < min(_HELPS * lost.sum(), left.sum()):
            best, left = found, after
    return best, left
