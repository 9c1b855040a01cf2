"""Convex parts of solids of revolution that reach little beyond them.

Lines that touch a profile from outside enclose it between two heights; turned about the axis and cut to a regular
polygon they are a polyhedron around the solid. There are as few lines and sides as keep its corners within what is
allowed. Where 64 corners are too few the profile is cut at a height, up to MOST_PIECES times.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.mesh import split

MOST_CORNERS = 64
"""Of a convex part: what PhysX takes on a GPU, where coplanar triangles are one face of 64 at most, too."""

SIDES = (8, 12, 16, 20, 24, 32)
"""Of a ring. Even ones have flat sides left and right, on which what is turned lies; 32 leave room for two rings."""

MOST_PIECES = 7
"""That one turned solid is cut into: parts cost time in every stage and every engine."""

LEAST = 4e-4
"""How far a part may reach beyond a small solid [m]: pieces for less would cost more than they are worth."""

EXACT = 2e-4
"""The outline of a base or a top may be beyond the true one by this [m], or by what the most sides leave."""

_WIDE = 0.01
"""A flat end of at least this radius [m] is a base or a top."""

STEPS = 12
"""Stretches of a profile between which it may be cut, at most."""

HOPELESS = 2.0
"""What reaches this many times further than is allowed is not looked at for longer stretches around it."""

WORTH = 1.05
"""Another piece has to lessen by this factor how far parts reach, where that is more than is allowed."""

THINNEST = 1.2e-3
"""Least height of a piece [m]."""

_PICTURE = 0.96
"""Share of what is allowed beyond the smooth solid; its picture has flat sides a little inside."""

_STEEPEST = math.radians(89.0)
_SAME = 1e-9

Line = tuple[float, float, float]
"""(a, b, e): inside where a r + b z <= e."""


def allowed(size: float) -> float:
    """How far a part may reach beyond a solid of longest side `size`, both in metres."""
    return max(split.allowed(size), LEAST)


def sides_of(radius: float, limit: float = EXACT, least: int = 16) -> int:
    """Sides of the regular polygon around a circle of `radius` whose corners are at most `limit` [m] beyond it.

    At least `least`, at most the most there are.
    """
    wanted = [n for n in SIDES if n >= least and radius * (1.0 / math.cos(math.pi / n) - 1.0) <= limit]
    return wanted[0] if wanted else max(SIDES[-1], least)


def turned_parts(
    profile: NDArray[np.float64], heights: Sequence[float], *, angles: Sequence[float] = (), sides: int = 0
) -> list[NDArray[np.float64]]:
    """Corners [m] of convex parts around a solid of revolution about z, each of shape (n, 3).

    Args:
        profile: (radius, z) [m] from the bottom to the top, shape (n, 2).
        heights: [m], rising, at which the solid ends and between which it is cut in any case.
        angles: slopes of lines that touch the whole of each of these bands and beyond which nothing reaches [degrees];
            0 is an upright wall, 45 faces up. 0 is always one of them.
        sides: of the rings, at least; 0 for as few as are allowed.
    """
    profile = _silhouette(profile)
    low, high = float(profile[0, 1]), float(profile[-1, 1])
    limit = _PICTURE * allowed(max(high - low, 2.0 * float(profile[:, 0].max())))
    most = max(1, MOST_PIECES // (len(heights) - 1))
    pieces = []
    for start, stop in zip(heights, heights[1:], strict=False):
        band = between(profile, start, stop)
        # What is laid on its side lies on the flats of its widest ring.
        kept = tuple(_touching(band, math.radians(angle)) for angle in {0.0, *angles})
        pieces += _cut(band, kept, limit, sides, (start <= low, stop >= high), most)
    return [rings(piece.corners, piece.sides) for piece in pieces]


def outline(points: NDArray[np.float64], limit: float, most: int, kept: Sequence[Line] = ()) -> NDArray[np.float64]:
    """(radius, z) corners [m] of a convex line around a piece of a profile, from its lowest to its highest height.

    Args:
        points: the piece, shape (n, 2).
        limit: by which corners may be beyond it [m].
        most: corners, at least 2.
        kept: lines that bound it in any case.
    """
    hull = _hull(points)
    return min(_outlines(points, limit, most, kept), key=lambda one: max(limit, _distances(one, hull).max()))


def rings(corners: NDArray[np.float64], sides: int) -> NDArray[np.float64]:
    """Corners of regular polygons around circles of (radius, z) [m], shape (n, 2)."""
    turn = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    around = np.stack([np.cos(turn), np.sin(turn)], axis=1) / math.cos(math.pi / sides)
    distinct: list[NDArray[np.float64]] = []
    for point in corners:
        if not distinct or math.dist(point, distinct[-1]) > 1e-6:
            distinct.append(point)
    return np.concatenate([np.column_stack([max(r, 5e-4) * around, np.full(sides, z)]) for r, z in distinct])


def between(points: NDArray[np.float64], low: float, high: float) -> NDArray[np.float64]:
    """The part of a (radius, z) polyline between two heights, with its points on them."""
    pieces = [points[(points[:, 1] >= low) & (points[:, 1] <= high)]]
    for a, b in zip(points, points[1:], strict=False):
        for z in (low, high):
            if min(a[1], b[1]) < z < max(a[1], b[1]):
                part = (z - a[1]) / (b[1] - a[1])
                pieces.append(np.array([[a[0] + part * (b[0] - a[0]), z]]))
    found = np.concatenate(pieces)
    return found[np.argsort(found[:, 1], kind="stable")]


@dataclass(frozen=True, kw_only=True, eq=False)
class _Piece:
    points: NDArray[np.float64]
    kept: tuple[Line, ...]
    ends: tuple[bool, bool]
    """Whether things may stand on its bottom, or lie on its top."""
    corners: NDArray[np.float64]
    sides: int
    excess: float
    """How far its corners are beyond the solid, as a share of what is allowed."""


def _piece(
    points: NDArray[np.float64], kept: tuple[Line, ...], limit: float, sides: int, ends: tuple[bool, bool]
) -> _Piece:
    """The part of fewest corners that is within `limit`, or else the one that reaches least."""
    flats = [_end(points, top) if is_end else 0.0 for top, is_end in enumerate(ends)]
    steep = tuple(_edge(points, top) for top in (0, 1) if flats[top] >= _WIDE)
    choices = []
    for corners in _outlines(points, 0.5 * limit, MOST_CORNERS // SIDES[0], (*kept, *steep)):
        for n in (n for n in SIDES if n >= min(sides, SIDES[-1]) and n * len(corners) <= MOST_CORNERS):
            factor = 1.0 / math.cos(math.pi / n)
            excess = _distances(corners * (factor, 1.0), points).max() / limit
            for top, flat in enumerate(flats):
                if flat >= _WIDE:
                    exact = max(EXACT, 1.01 * flat * (1.0 / math.cos(math.pi / SIDES[-1]) - 1.0))
                    excess = max(excess, (factor * corners[-top, 0] - flat) / exact)
            choices.append((max(excess, 1.0), n * len(corners), excess, n, corners))
    _, _, excess, n, corners = min(choices, key=lambda one: one[:2])
    return _Piece(points=points, kept=kept, ends=ends, corners=corners, sides=n, excess=float(excess))


def _silhouette(profile: NDArray[np.float64]) -> NDArray[np.float64]:
    """The widest radius at every height of a (radius, z) polyline, from the bottom to the top, shape (n, 2)."""
    heights = np.unique(profile[:, 1])
    start, stop = profile[:-1], profile[1:]
    rising = np.abs(stop[:, 1] - start[:, 1]) > _SAME
    start, stop = start[rising], stop[rising]
    below, above = np.minimum(start[:, 1], stop[:, 1]), np.maximum(start[:, 1], stop[:, 1])
    found: list[tuple[float, float]] = []
    for low, high in itertools.pairwise(heights.tolist()):
        over = (below <= low + _SAME) & (above >= high - _SAME)
        for z in (low, high):
            share = (z - start[over, 1]) / (stop[over, 1] - start[over, 1])
            radius = start[over, 0] + share * (stop[over, 0] - start[over, 0])
            found.append((float(radius.max(initial=0.0)), z))
    points = np.array(found)
    apart = np.linalg.norm(np.diff(points, axis=0), axis=1) > _SAME
    return points[np.concatenate([[True], apart])]


def _cut(
    points: NDArray[np.float64], kept: tuple[Line, ...], limit: float, sides: int, ends: tuple[bool, bool], most: int
) -> list[_Piece]:
    """The fewest pieces that are within `limit`, or else the `most` that reach least beyond the solid."""
    whole = _piece(points, kept, limit, sides, ends)
    if whole.excess <= 1.0 or most == 1:
        return [whole]
    heights = _heights(points)
    last = len(heights) - 1
    tried: dict[tuple[int, int], _Piece] = {(0, last): whole}
    for first, end in sorted(itertools.combinations(range(last + 1), 2), key=lambda one: one[1] - one[0]):
        shorter = [tried.get(one) for one in ((first + 1, end), (first, end - 1))]
        hopeless = any(one is None or one.excess > HOPELESS for one in shorter)
        if (first, end) in tried or (hopeless and end - first > last / most + 1):
            continue
        flat = (ends[0] and first == 0, ends[1] and end == last)
        tried[first, end] = _piece(between(points, heights[first], heights[end]), kept, limit, sides, flat)
    # Least excess of the pieces up to each height, by their number.
    best: list[dict[int, tuple[float, tuple[int, ...]]]] = [{0: (0.0, (0,))}]
    for _ in range(most):
        step: dict[int, tuple[float, tuple[int, ...]]] = {}
        for (first, end), piece in tried.items():
            if first in best[-1]:
                excess, path = best[-1][first]
                step[end] = min(step.get(end, (math.inf, ())), (max(excess, piece.excess, 1.0), (*path, end)))
        best.append(step)
    _, path = min((step[last] for step in best[1:] if last in step), key=lambda one: one[0] * WORTH ** len(one[1]))
    return [tried[one] for one in itertools.pairwise(path)]


def _heights(points: NDArray[np.float64]) -> list[float]:
    """Heights [m] at which a piece may be cut, neither close to an end nor to one another.

    Where its line bends, if it has few points, or else evenly along it.
    """
    along = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    spread = points[:, 1]
    if len(points) > STEPS:
        spread = np.interp(np.linspace(0.0, along[-1], STEPS + 1), along, points[:, 1])
    low, high = float(points[0, 1]), float(points[-1, 1])
    found = [low]
    for height in spread[1:-1].tolist():
        if height - found[-1] > THINNEST and high - height > THINNEST:
            found.append(height)
    return [*found, high]


def _outlines(
    points: NDArray[np.float64], limit: float, most: int, kept: Sequence[Line]
) -> Iterator[NDArray[np.float64]]:
    """Outlines of a piece of ever more corners, until they are within `limit` of its hull or there are `most`.

    Of each number of lines those that turn evenly, as is best for what is round, and those at the furthest corners.
    """
    low, high = float(points[:, 1].min()), float(points[:, 1].max())
    hull = _hull(points)
    along = np.diff(hull, axis=0)
    turn = np.arctan2(-along[[0, -1], 0], along[[0, -1], 1])
    lines = [*kept] or [_touching(points, math.atan2(hull[0, 0] - hull[-1, 0], high - low))]
    for count in range(1, most):
        even = [_touching(points, float(turn[0] + (turn[1] - turn[0]) * (k + 0.5) / count)) for k in range(count)]
        evenly, corners = _envelope([*kept, *even], low, high), _envelope(lines, low, high)
        found = [one for one in (corners, evenly) if len(one) <= most]
        yield from found
        distances = _distances(corners, hull)
        if not found or min(_distances(one, hull).max() for one in found) <= limit:
            return
        far = int(np.argmax(distances))
        nearest = _nearest(corners[far], hull)
        lines.append(_touching(points, math.atan2(corners[far, 1] - nearest[1], corners[far, 0] - nearest[0])))


def _touching(points: NDArray[np.float64], angle: float) -> Line:
    """The line of a slope [rad] that `points` lie inside of and touch."""
    angle = min(max(angle, -_STEEPEST), _STEEPEST)
    a, b = math.cos(angle), math.sin(angle)
    return a, b, float((points @ (a, b)).max())


def _envelope(lines: Sequence[Line], low: float, high: float) -> NDArray[np.float64]:
    """(radius, z) corners of what is inside of all lines between two heights."""
    slopes = np.array([[-b / a, e / a] for a, b, e in lines])
    cuts = [low, high]
    for k, (m, c) in enumerate(slopes):
        for n, d in slopes[k + 1 :]:
            if abs(m - n) > _SAME and low < (z := (d - c) / (m - n)) < high:
                cuts.append(float(z))
    # Lines that meet in one point cross there several times, apart by rounding.
    heights = np.array([low, *(z for z in np.unique(np.round(cuts, 9)) if low + _SAME < z < high - _SAME), high])
    radius = (heights[:, None] * slopes[:, 0] + slopes[:, 1]).min(axis=1)
    corners = np.column_stack([radius, heights])
    bend = np.ones(len(corners), dtype=bool)
    for k in range(1, len(corners) - 1):
        before, at, after = corners[k - 1 : k + 2]
        straight = before[0] + (after[0] - before[0]) * (at[1] - before[1]) / (after[1] - before[1])
        bend[k] = at[0] - straight > 1e-7
    return corners[bend]


def _end(points: NDArray[np.float64], top: int) -> float:
    """Radius of the flat at the bottom of a piece, or at its top [m]."""
    level = points[:, 1].max() if top else points[:, 1].min()
    return float(points[np.abs(points[:, 1] - level) < _SAME, 0].max())


def _edge(points: NDArray[np.float64], top: int) -> Line:
    """The steepest line through the rim of the bottom, or of the top, that `points` lie inside of."""
    sign = -1.0 if top else 1.0
    level, radius = (points[:, 1].max() if top else points[:, 1].min()), _end(points, top)
    rise = sign * (points[:, 1] - level)
    slope = float(((points[:, 0] - radius)[rise > _SAME] / rise[rise > _SAME]).max(initial=0.0))
    return _touching(points, -sign * math.atan(slope))


def _hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """The outer line of a piece, its lowest point first, shape (n, 2)."""
    low, high = points[:, 1].min(), points[:, 1].max()
    try:
        kept = points[ConvexHull(np.concatenate([points, [[-1.0, low], [-1.0, high]]])).vertices % len(points)]
    except QhullError:
        return points
    return kept[np.argsort(kept[:, 1], kind="stable")]


def _distances(corners: NDArray[np.float64], line: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distance of each corner from a polyline [m], shapes (m, 2) and (n, 2)."""
    return np.linalg.norm(_closest(corners, line) - corners, axis=1)


def _nearest(corner: NDArray[np.float64], line: NDArray[np.float64]) -> NDArray[np.float64]:
    return _closest(corner[None], line)[0]


def _closest(corners: NDArray[np.float64], line: NDArray[np.float64]) -> NDArray[np.float64]:
    start, along = line[:-1], np.diff(line, axis=0)
    square = np.maximum(np.einsum("ni,ni->n", along, along), 1e-300)
    t = np.clip(np.einsum("mni,ni->mn", corners[:, None] - start, along) / square, 0.0, 1.0)
    points = start + t[..., None] * along
    distance = np.linalg.norm(points - corners[:, None], axis=2)
    return points[np.arange(len(corners)), distance.argmin(axis=1)]
