"""Which axis of a mesh points up where its file does not say, with the reasons and how sure that is.

Evidence is counted in nats. Worth most is a hollow open to above, then the proportions of what the object is like in
the catalogue, then whether it would rest so, and on how much of its outline; habits of tools are worth the least.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.library.body import Body, Points
from pat3d.assets.library.guess import Guess, Typical, likeliest
from pat3d.assets.library.resting import TOGETHER, Rest, resting_poses
from pat3d.assets.mesh.importing import TO_Z_UP, UpAxis
from pat3d.errors import AssetError

_UPS: tuple[UpAxis, ...] = ("z", "y", "-y", "-z", "x", "-x")

HABIT = {"z": 1.2, "y": 0.7}
"""Robots' meshes have z up, games' y."""
UNUSUAL = -2.2
"""Hardly any file has another axis."""

RESTS, STANDS, HOLLOW, ALIKE, GROUNDED = 1.5, 1.5, 2.5, 2.5, 0.5
"""What it is worth to rest so, to do it on all of the outline, to be open to above, a nat of difference from the
proportions of its kind, and to have the origin at its lowest point."""

MOST_UNLIKE = 1.5
"""Nats of difference beyond which proportions only say that the object is not like that at all."""

_LOWEST = 0.015
"""Share of the longest side within which points of a scan stand on the floor."""


def guess_up(body: Body, typical: Typical | None) -> Guess:
    """The axis of `body` that points up as it usually stands.

    Raises:
        AssetError: the mesh is flat.
    """
    if body.up is not None:
        return Guess(value=body.up, reason=f"{body.declared} says so", confidence=1.0, source="declared")
    points = body.mesh.vertices[np.unique(body.mesh.faces)]
    rests = resting_poses(points / max(float(np.ptp(points, axis=0).max()), 1e-300), least=0.0)
    corners = points[ConvexHull(points).vertices]
    scores: dict[str, float] = {}
    told: dict[str, list[str]] = {}
    for up in _UPS:
        turn = np.array(TO_Z_UP[up], dtype=np.float64)
        score, why = HABIT.get(up, UNUSUAL), list[str]()
        rest = _nearest(rests, turn[2])
        if rest is not None:
            share = _standing(corners, np.array(rest.rotation))
            score += RESTS + STANDS * share
            if share > 0.5:
                why.append(f"it rests on {100 * share:.0f} % of its outline")
        if (depth := _opening(body, turn)) > 0.3:
            score += HOLLOW * depth
            why.append(f"a hollow open to above, {100 * depth:.0f} % of its height deep")
        if typical is not None:
            off = _unlike(corners @ turn.T, typical)
            score -= ALIKE * min(off, MOST_UNLIKE)
            if off < 0.35:
                why.append(f"the proportions of a {typical.noun}")
        if _grounded(points @ turn[2]):
            score += GROUNDED
            why.append("its lowest point is at the origin")
        scores[up], told[up] = score, why
    up, confidence = likeliest(scores)
    reason = "; ".join(told[up]) or "most files of this kind have it so"
    return Guess(value=up, reason=reason, confidence=confidence)


@dataclass(frozen=True, kw_only=True)
class _Outline:
    """The smallest rectangle around something seen from above."""

    longer: float
    shorter: float
    area: float
    """Of the convex hull of what is seen, at most that of the rectangle."""


def _outline(flat: Points) -> _Outline:
    """Of points in the plane, shape (n, 2); a side of the rectangle lies along one of the hull."""
    try:
        hull = ConvexHull(flat)
    except QhullError as error:
        raise AssetError("the mesh is flat: seen from one side it is a line.") from error
    corners = flat[hull.vertices]
    along = np.roll(corners, -1, axis=0) - corners
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    across = np.column_stack([-along[:, 1], along[:, 0]])
    sides = np.ptp(corners @ along.T, axis=0), np.ptp(corners @ across.T, axis=0)
    best = int(np.argmin(sides[0] * sides[1]))
    shorter, longer = sorted((float(sides[0][best]), float(sides[1][best])))
    return _Outline(longer=longer, shorter=shorter, area=float(hull.volume))


def _nearest(rests: Sequence[Rest], up: Points) -> Rest | None:
    """The resting pose whose up direction is that of `up`, a unit vector, to TOGETHER degrees."""
    near = max(rests, key=lambda rest: float(up @ np.array(rest.rotation[2])), default=None)
    if near is None or float(up @ np.array(near.rotation[2])) < math.cos(math.radians(TOGETHER)):
        return None
    return near


def _standing(corners: Points, rotation: Points) -> float:
    """Area of what stands on the floor over that of the whole outline, at most 1."""
    placed = corners @ rotation.T
    lowest = placed[placed[:, 2] < placed[:, 2].min() + _LOWEST * np.ptp(placed, axis=0).max()]
    try:
        return min(1.0, float(ConvexHull(lowest[:, :2]).volume) / _outline(placed[:, :2]).area)
    except (QhullError, ValueError):
        return 0.0


def _unlike(corners: Points, typical: Typical) -> float:
    """How far length, width and height differ from those of the noun, whatever the scale and the yaw [nats]."""
    seen = _outline(corners[:, :2])
    width, depth = sorted(typical.size[:2], reverse=True)
    sides = np.array([seen.longer, seen.shorter, float(np.ptp(corners[:, 2]))])
    ratios = np.log(np.maximum(sides, 1e-9 * sides.max()) / np.array([width, depth, typical.size[2]]))
    return float(np.abs(ratios - np.median(ratios)).sum())


def _grounded(heights: Points) -> bool:
    """Whether the origin is at the lowest point."""
    return bool(abs(heights.min()) < 0.005 * np.ptp(heights))


def _opening(body: Body, turn: Points) -> float:
    """Depth of the deepest hollow open to above, over the height; from a coarse height map."""
    from pat3d.assets.mesh.regions import cavity, mesh_height_map

    if len(body.mesh.faces) > 100_000:
        return 0.0
    vertices = body.mesh.vertices @ turn.T
    vertices = vertices - [0.0, 0.0, vertices[:, 2].min()]
    try:
        pit = cavity(mesh_height_map(vertices, body.mesh.faces, cells=40))
    except (ValueError, IndexError):
        return 0.0
    return 0.0 if pit is None else min(1.0, pit.height / float(np.ptp(vertices[:, 2])))
