"""Convex parts of recipes cut back to what is seen of them.

A part that reaches further beyond the picture than those of imported meshes may loses the corners that reach furthest,
to planes that touch what is seen inside of it. Where 64 corners are too few it is cut in two, across its longest side.
Everything that was seen in the parts stays in them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import manifold3d
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, KDTree, QhullError
from scipy.spatial.distance import pdist

from pat3d.assets.mesh.split import allowed
from pat3d.assets.shapes import Shape
from pat3d.assets.turned import MOST_CORNERS
from pat3d.geometry.planes import enclosed

MORE = 4
"""Parts that an object may have beyond those of its recipe: they cost time in every stage and every engine."""

MOST_PARTS = 8
"""With these; an object of more has no more than its recipe."""

HALVED, FITTED = 1.25, 48
"""What reaches so many times further than is allowed is cut in two, unless it has so many corners: these were fitted by
the recipe, and the halves of a pancake carry less evenly than it does."""

_DOZEN = 12
"""An object of more parts keeps its recipe's: they are many already, and corners of all of them cost time."""

WORTH, WORTHWHILE = 0.6, 0.4
"""Shares of their former reach to which a part, and the furthest of an object, have to come, if not to what is allowed;
else they stay simple."""

_PICTURE = 0.95
"""Share of what is allowed to which parts are cut: the hull of what is seen inside may itself be beyond it."""

AT_ONCE = 3
"""Planes that are added to a part before its corners are looked at again."""

_MANY = 20
"""Planes of a part that may leave too little room for others: half of it is begun as a box as well."""

_ALIKE = math.cos(math.radians(8.0))
"""Planes whose normals are this alike do the same."""

_SHORT, _THIN = 0.002, 0.05
"""Edges are not made shorter than this share of a part's longest side, and of its thickness."""

_HAIR = 2e-4
"""[m]"""

_SAME = 1e-6
"""Planes apart by less, in units of a part's size, are one."""


@dataclass(frozen=True, kw_only=True, eq=False)
class _Piece:
    """What is seen in a part, and the part around it."""

    seen: list[manifold3d.Manifold]
    planes: NDArray[np.float64]
    """Of the part of the recipe (outward normal, offset [m]), shape (n, 4)."""
    corners: NDArray[np.float64]
    """With those that reach too far cut off [m], shape (n, 3)."""
    before: float
    """How far the recipe's part reaches beyond the hull of what is seen [m]."""
    reach: float
    """How far `corners` do [m]."""
    recipe: NDArray[np.float64]
    """Corners of the recipe's part [m], shape (k, 3)."""

    def whole(self) -> _Piece:
        """With the recipe's part."""
        return replace(self, corners=self.recipe, reach=self.before)


def trimmed(shapes: Sequence[Shape], scale: float) -> list[Shape]:
    """`shapes` with parts that reach less far beyond what is seen, which contain all that theirs contained.

    Args:
        shapes: of one object; each is in the parts of all of them, if not in its own.
        scale: by which the object is scaled afterwards, for what is allowed is in metres.
    """
    count = sum(len(shape.hulls) for shape in shapes)
    if count > _DOZEN:
        return list(shapes)
    points = np.concatenate([hull for shape in shapes for hull in shape.hulls])
    limit = allowed(float(np.ptp(points, axis=0).max()) * scale) / scale
    solids = [shape.solid for shape in shapes]
    near = KDTree(_points(solids))
    far = {}
    for number, shape in enumerate(shapes):
        for place, hull in enumerate(shape.hulls):
            if near.query(hull)[0].max() > limit:
                piece = _piece(_seen(hull, solids), hull, limit, None)
                if piece is not None:
                    far[number, place] = piece
    pieces = {
        which: [piece if piece.reach <= max(limit, WORTH * piece.before) else piece.whole()]
        for which, piece in far.items()
    }
    pieces |= _halved(far, limit, min(MORE, MOST_PARTS - count))
    before, after = (
        max((piece.reach for own in some for piece in own), default=0.0)
        for some in ([[piece.whole()] for piece in far.values()], pieces.values())
    )
    if after > max(limit, WORTHWHILE * before):
        return list(shapes)
    found = {which: [piece.corners for piece in own] for which, own in pieces.items()}
    return [
        Shape(shape.solid, tuple(one for k, hull in enumerate(shape.hulls) for one in found.get((number, k), [hull])))
        for number, shape in enumerate(shapes)
    ]


def _halved(parts: Mapping[tuple[int, int], _Piece], limit: float, more: int) -> dict[tuple[int, int], list[_Piece]]:
    """The pieces of `parts` that are cut in two, those first that reach furthest; `more` pieces at most.

    None where that does not bring the whole object to what is allowed, or to WORTH of how far it reached.
    """
    pieces = {which: [piece] for which, piece in parts.items()}
    fitted = {which for which, piece in parts.items() if len(piece.recipe) > FITTED}

    def furthest() -> tuple[tuple[int, int], _Piece]:
        return max(((which, piece) for which, own in pieces.items() for piece in own), key=lambda one: one[1].reach)

    if more <= 0 or not pieces or (before := furthest()[1].reach) <= HALVED * limit:
        return {}
    for _ in range(more):
        which, worst = furthest()
        halves = _halves(worst, limit) if worst.reach > HALVED * limit and which not in fitted else []
        if not halves or max(half.reach for half in halves) > max(limit, WORTH * worst.reach):
            break
        pieces[which] = [half for piece in pieces[which] for half in (halves if piece is worst else [piece])]
    if furthest()[1].reach > max(limit, WORTH * before):
        return {}
    return {which: own for which, own in pieces.items() if len(own) > 1}


def _seen(hull: NDArray[np.float64], solids: Sequence[manifold3d.Manifold]) -> list[manifold3d.Manifold]:
    """What of `solids` is inside of a part: its own, and details that have no part or one elsewhere."""
    part = manifold3d.Manifold.hull_points(np.ascontiguousarray(hull))
    low, high = hull.min(axis=0), hull.max(axis=0)
    boxes = np.array([solid.bounding_box() for solid in solids])
    near = (boxes[:, :3] < high).all(axis=1) & (boxes[:, 3:] > low).all(axis=1)
    inside = [solid ^ part for solid, meets in zip(solids, near, strict=True) if meets]
    return [solid for solid in inside if not solid.is_empty()]


def _piece(
    seen: list[manifold3d.Manifold], corners: NDArray[np.float64], limit: float, planes: NDArray[np.float64] | None
) -> _Piece | None:
    """A part with those of `corners` cut off that reach too far; None where nothing is seen, or none does."""
    try:
        hull = ConvexHull(_points(seen)) if seen else None
    except QhullError:
        hull = None
    if hull is None or (planes is None and _beyond(corners, hull.equations).max() <= limit):
        return None
    recipe, planes = corners, _planes(corners) if planes is None else planes
    touching = _merged(hull.equations, float(np.ptp(corners, axis=0).max()))
    middle = hull.points[hull.vertices].mean(axis=0)
    before = reach = float(_beyond(corners, touching).max())
    short, uneven = _short(corners, planes), _uneven(corners)
    left = np.ones(len(touching), dtype=bool)
    bounds, corners = planes, _sorted(corners)
    at_once = AT_ONCE
    while reach > _PICTURE * limit and left.any():
        # Of corners and planes that are as good as one another by symmetry, the first: rounding decides nothing.
        beyond = np.round(_beyond(corners, touching), 7)
        chosen: list[int] = []
        for _ in range(at_once):
            inside = (beyond[:, chosen] <= 0.0).all(axis=1)
            far = beyond[np.ix_(inside, left)]
            if not far.size or far.max() <= (0.5 * min(limit, reach) if not chosen else limit):
                break
            chosen.append(int(np.flatnonzero(left)[far[far.max(axis=1).argmax()].argmax()]))
            left &= touching[:, :3] @ touching[chosen[-1], :3] < _ALIKE
        if not chosen:
            break
        more = np.concatenate([bounds, touching[chosen]])
        fewer = _sorted(enclosed(more, middle))
        full = max(len(more), len(fewer)) > MOST_CORNERS
        if full or pdist(fewer).min() < short or (_uneven(fewer) and not uneven):
            if len(chosen) > 1:
                left[chosen], at_once = True, 1
            elif full:
                break
            continue
        bounds, corners = more, fewer
        reach = float(_beyond(corners, touching).max())
    return _Piece(seen=seen, planes=planes, corners=corners, before=before, reach=reach, recipe=recipe)


def _halves(piece: _Piece, limit: float) -> list[_Piece]:
    """`piece` on both sides of the middle of its longest side; none where there is nothing to see on one."""
    low, high = piece.corners.min(axis=0), piece.corners.max(axis=0)
    axis = int(np.argmax(high - low))
    normal, middle = np.eye(3)[axis], float(low[axis] + high[axis]) / 2
    halves = []
    for sign in (1.0, -1.0):
        cut = [solid.trim_by_plane(tuple(-sign * normal), -sign * middle) for solid in piece.seen]
        seen = [solid for solid in cut if not solid.is_empty()]
        if not seen:
            return []
        points = _points(seen)
        planes = np.concatenate([piece.planes, [[*(sign * normal), -sign * middle]]])
        starts = [planes]
        if len(planes) > _MANY:
            bounds = [*points.min(axis=0), *-points.max(axis=0)]
            starts.append(np.column_stack([np.concatenate([-np.eye(3), np.eye(3)]), bounds]))
        tried = [_piece(seen, enclosed(start, points.mean(axis=0)), limit, start) for start in starts]
        half = min((one for one in tried if one), key=lambda one: one.reach, default=None)
        if half is None:
            return []
        halves.append(half)
    return halves


def _short(corners: NDArray[np.float64], planes: NDArray[np.float64]) -> float:
    """Distance below which no two corners of a part may be [m]."""
    thick = float(np.ptp(corners @ planes[:, :3].T, axis=0).min())
    size = float(np.ptp(corners, axis=0).max())
    return min(_SHORT * size, _THIN * thick, float(pdist(corners).min()))


def _uneven(corners: NDArray[np.float64]) -> bool:
    """Whether a corner is a hair above the lowest ones, or below the highest: after settling it would carry load."""
    heights = corners[:, 2]
    rise = np.minimum(heights - heights.min(), heights.max() - heights)
    return bool(((rise > _SAME) & (rise < _HAIR)).any())


def _beyond(corners: NDArray[np.float64], planes: NDArray[np.float64]) -> NDArray[np.float64]:
    """How far each corner is beyond each plane [m], shape (corners, planes)."""
    return corners @ planes[:, :3].T + planes[:, 3]


def _planes(hull: NDArray[np.float64]) -> NDArray[np.float64]:
    """Outward normals and offsets [m] of the faces of a part, those along the axes exactly so, shape (n, 4)."""
    normals = _merged(ConvexHull(hull).equations, float(np.ptp(hull, axis=0).max()))[:, :3]
    level = np.abs(normals).max(axis=1) > 1.0 - _SAME
    normals[level] = np.round(normals[level])
    return np.column_stack([normals, -(hull @ normals.T).max(axis=0)])


def _merged(equations: NDArray[np.float64], size: float) -> NDArray[np.float64]:
    """Distinct planes of a body of `size` [m] in the order of their normals, shape (n, 4)."""
    _, first = np.unique(np.round(equations / [1.0, 1.0, 1.0, size] / _SAME), axis=0, return_index=True)
    return equations[first]


def _sorted(points: NDArray[np.float64]) -> NDArray[np.float64]:
    return points[np.lexsort(np.round(points / _SAME).T)]


def _points(solids: Sequence[manifold3d.Manifold]) -> NDArray[np.float64]:
    return np.concatenate([np.asarray(solid.to_mesh64().vert_properties)[:, :3] for solid in solids])
