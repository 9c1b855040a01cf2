"""Poses in which a body rests on the floor: faces of its convex hull with the centre of mass above them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from pat3d.assets.library.body import Points
from pat3d.errors import AssetError
from pat3d.geometry.hulls import convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.planes import planes
from pat3d.geometry.rotations import quat_of
from pat3d.scene.physics import LEAST_TILT

MOST_POINTS = 400
"""Of the hull that is looked at: a scan's thousands of tiny faces tell nothing more."""


TOGETHER = 10.0
"""Poses whose up axes differ by less [degrees] are one."""

STEADY = 2.0 * LEAST_TILT
"""Tilt of the ground [degrees] that a pose stands at least to be preferred: scenes have to stand half of it."""

FLAT = 3e-4
"""Share of the longest side within which what is lowest carries."""

LEVEL, LEANING = 0.1, 30.0
"""Tilts [degrees] below which an object counts as resting as it is, and as leaning towards its nearest rest."""


@dataclass(frozen=True, kw_only=True)
class Rest:
    """One pose."""

    rotation: list[list[float]]
    """From the frame of the points to the pose, shape (3, 3)."""
    quat_wxyz: tuple[float, float, float, float]
    tilt: float
    """Angle between the frame's up axis and that of the pose [degrees]."""
    probability: float
    """That a random throw ends so."""
    margin: float
    """Tilt of the ground that upsets it [degrees]."""


def resting_poses(points: Points, least: float = 0.01, centre: Points | None = None) -> tuple[Rest, ...]:
    """Stable poses of a body whose hull is that of `points` [m], shape (n, 3), likeliest first.

    Its centre of mass [m], shape (3,), is `centre`; None for that of a body of uniform density that fills the hull.

    Poses within TOGETHER of a likelier one count as that one, the base of a scan being many faces, nearly level; where
    it is not steady, the steadiest of them stands for all. What is left out is less likely than `least` and more than
    that far from the frame's own up axis.

    Raises:
        AssetError: the points are flat.
    """
    import trimesh

    hull = convex_part(points)
    if centre is None:
        centre = np.array(mass_properties(hull.vertices, hull.faces, mass=1.0).centre_of_mass)
    sides = planes(hull)
    thin = convex_part(_thinned(hull.vertices)) if len(hull.vertices) > MOST_POINTS else hull
    body = trimesh.Trimesh(thin.vertices, thin.faces, process=False)
    try:
        # Faces that are nearly coplanar make it take the square root of nothing, which costs a face its chance.
        with np.errstate(invalid="ignore"):
            transforms, chances = trimesh.poses.compute_stable_poses(
                body, center_mass=centre, n_samples=1, threshold=0.0
            )
    except (ValueError, IndexError, np.linalg.LinAlgError) as error:
        raise AssetError(f"its resting poses cannot be found ({type(error).__name__}).") from error
    chances = np.nan_to_num(np.asarray(chances, dtype=np.float64))
    near = math.cos(math.radians(TOGETHER))
    groups = list[list[tuple[Points, float]]]()
    for index in np.argsort(-chances):
        up = _rolled(sides, centre, transforms[index][2, :3] / np.linalg.norm(transforms[index][2, :3]))
        group = next((one for one in groups if up @ one[0][0] > near), None)
        if group is None:
            groups.append(group := [])
        group.append((up, float(chances[index])))
    found = []
    for group in groups:
        up, share = group[0][0], sum(chance for _, chance in group)
        margin = _margin(hull.vertices, centre, up)
        if margin < STEADY:
            margin, up = max(((_margin(hull.vertices, centre, one), one) for one, _ in group), key=lambda one: one[0])
        # What trimesh says of the yaw is arbitrary: the smallest turn that brings the same side down is taken.
        tilt = math.degrees(math.acos(float(np.clip(up[2], -1.0, 1.0))))
        if share >= least or tilt < TOGETHER:
            turn = _to_z(up)
            found.append(
                Rest(rotation=turn.tolist(), quat_wxyz=quat_of(turn), tilt=tilt, probability=share, margin=margin)
            )
    return tuple(sorted(found, key=lambda rest: -rest.probability))


def standing(turn: Points, rests: Sequence[Rest]) -> tuple[Points, str]:
    """`turn`, shape (3, 3), followed by what brings the object to rest, and a doubt where that is no small correction.

    Args:
        turn: from the file's frame to the one in which the file has it upright.
        rests: resting poses in that frame.
    """
    if not rests:
        return turn, ""
    steady = [rest for rest in rests if rest.margin >= STEADY] or rests
    nearest = min(steady, key=lambda rest: rest.tilt)
    if nearest.tilt < LEVEL:
        return turn, ""
    # Nearly every object is meant to stand as its file has it, so the nearest rest counts before the likeliest.
    chosen = nearest if nearest.tilt < LEANING else steady[0]
    turned = np.array(chosen.rotation) @ turn
    if chosen.tilt < TOGETHER:
        return turned, ""
    why = f"it does not rest as its file has it, or not steadily; turned by {chosen.tilt:.0f} degrees to where it does"
    return turned, f"pose: {why}"


def _rolled(sides: Points, centre: Points, up: Points) -> Points:
    """Upward direction in which a body of `planes` [m] comes to rest that is put down with `up` upwards.

    It rolls over the edges of the face below its centre of mass, which sinks, until that face carries it.
    """
    level = np.inf
    for _ in range(len(sides)):
        falling = -(sides[:, :3] @ up)
        depth = -(sides[:, :3] @ centre + sides[:, 3])
        along = np.where(falling > 1e-12, depth / np.maximum(falling, 1e-12), np.inf)
        below = int(np.argmin(along))
        if depth[below] >= level * (1.0 - 1e-9):
            break
        level, up = float(depth[below]), -sides[below, :3]
    return up


def _margin(points: Points, centre: Points, up: Points) -> float:
    """Tilt of the ground [degrees] that upsets a body of these corners and centre of mass with `up` upwards."""
    heights = points @ up
    lowest = float(heights.min())
    low = points[heights < lowest + FLAT * float(np.ptp(points, axis=0).max())]
    flat = _to_z(up)[:2]
    try:
        sides = ConvexHull(low @ flat.T).equations
    except (QhullError, ValueError):
        return 0.0
    inside = -float((sides[:, :2] @ (flat @ centre) + sides[:, 2]).max())
    return math.degrees(math.atan2(max(0.0, inside), float(centre @ up) - lowest))


def _to_z(direction: Points) -> Points:
    """The smallest rotation that turns a unit vector to z."""
    x, y, z = direction
    if z < -1.0 + 1e-12:
        return np.diag([1.0, -1.0, -1.0])
    axis = np.array([y, -x, 0.0])
    cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + cross + cross @ cross / (1.0 + z)


def _thinned(points: Points) -> Points:
    """Those of `points` that are furthest along some of many directions."""
    count = 4 * MOST_POINTS
    k = np.arange(count) + 0.5
    polar, turn = np.arccos(1 - 2 * k / count), np.pi * (1 + 5**0.5) * k
    ways = np.stack([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)], axis=1)
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    return points[np.unique((np.concatenate([ways, axes]) @ points.T).argmax(axis=1))]
