"""What a board does on a mesh, by its true surface: exact prisms under its triangles, simulated in MuJoCo.

A board that is laid on something touches what faces up. So the judge needs no decomposition of the whole: every
triangle that faces up, clipped to the board's shadow and drawn down, is a convex hull whose top is the surface itself.

A board stands that stays where it is under the tilt that every verified scene has to stand, towards four sides. One
that stays only on level ground hardly stands: of that nothing is claimed.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, QhullError

from pat3d.check.settle import settle_in_mujoco
from pat3d.errors import AssetError
from pat3d.exporters.mjcf.writer import write_mjcf
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset
from pat3d.scene.physics import GRAVITY, LEAST_TILT
from tests.scenes import GAP, placed, scene_of

MOST_HULLS = 200
DEPTH = 5e-3
"""Of the surface that a board can meet before it has moved, and half of what prisms have under that [m]."""

BESIDE = 2e-3
"""Prisms reach this far beyond a board's shadow [m]."""

LEVEL = 2.0
"""What a board lies on is level up to this tilt [degrees]."""

STEEPEST = 10.0
"""A board lies on what is round, up to this tilt [degrees]; where it has to be steeper there is an edge."""

UP = 1e-3
"""Cosine from which a triangle faces up."""

SECONDS = 1.0
"""What tips over an edge 1 mm beside its weight has turned by a degree after a tenth of this [s]."""


@dataclass(frozen=True, kw_only=True)
class Shadow:
    """The rectangle over which a board is laid."""

    centre: tuple[float, float]
    """[m]"""
    yaw: float
    """Of its long side [rad]."""
    size: tuple[float, float]
    """Length and breadth [m]."""

    @property
    def axes(self) -> NDArray[np.float64]:
        """Rows: along and across."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return np.array([[c, s], [-s, c]])

    def over(self, vertices: NDArray[np.float64], faces: NDArray[np.int32], more: float = 0.0) -> list[NDArray]:
        """What of a mesh faces up in the rectangle grown by `more` [m]: polygons in its frame, each of shape (n, 3)."""
        local = np.column_stack([(vertices[:, :2] - self.centre) @ self.axes.T, vertices[:, 2]])
        half = np.array(self.size) / 2 + more
        corners = local[faces]
        normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
        near = (low < half).all(axis=1) & (high > -half).all(axis=1)
        corners = corners[near & (normal[:, 2] > UP * np.linalg.norm(normal, axis=1))]
        found = []
        for one in corners:
            polygon = one
            for axis in (0, 1):
                for sign in (1.0, -1.0):
                    polygon = _clipped(polygon, sign * polygon[:, axis] - half[axis])
            if len(polygon) >= 3:
                found.append(polygon)
        if not found:
            return []
        highest = max(polygon[:, 2].max() for polygon in found)
        return [polygon for polygon in found if polygon[:, 2].max() > highest - DEPTH]

    def laid(self, polygons: list[NDArray]) -> Pose:
        """Where a board rests on `polygons`, level if that is more than STEEPEST degrees steep or nowhere.

        A flat thing with its weight over a point rests on the lowest plane there that is nowhere below a surface.
        """
        # In millimetres, for the solver's tolerance.
        points = 1e3 * np.concatenate(polygons)
        steepest = math.tan(math.radians(STEEPEST))
        over = np.column_stack([-points[:, :2], -np.ones(len(points))])
        done = linprog(
            [0.0, 0.0, 1.0], over, -points[:, 2], bounds=[(-steepest, steepest)] * 2 + [(None, None)], method="highs"
        )
        along, across, height = done.x
        if max(abs(along), abs(across)) > 0.999 * steepest:
            along, across, height = 0.0, 0.0, points[:, 2].max()
        normal = np.array([-along, -across, 1.0])
        normal /= np.linalg.norm(normal)
        first = np.array([1.0, 0.0, along])
        first /= np.linalg.norm(first)
        turn = np.eye(3)
        turn[:2, :2] = self.axes.T
        rotation = turn @ np.stack([first, np.cross(normal, first), normal], axis=1)
        return Pose.from_matrix(rotation, np.array([*self.centre, 1e-3 * height]) + GAP * turn @ normal)


Outcome = Literal["stands", "hardly", "falls", "slopes"]


def outcome(mesh: Asset, board: Asset, shadow: Shadow) -> Outcome:
    """What `board` does on the true surface of `mesh`; it falls where there is none, and what is round has no edge."""
    polygons = shadow.over(mesh.visual.vertices, mesh.visual.faces)
    if not polygons:
        return "falls"
    pose = shadow.laid(polygons)
    if pose.rotation[2, 2] < math.cos(math.radians(LEVEL)):
        return "slopes"
    hulls = prisms(shadow, shadow.over(mesh.visual.vertices, mesh.visual.faces, BESIDE), polygons)
    if not hulls:
        return "falls"
    true = replace(mesh, visual=board.visual, parts=tuple(hulls))
    scene = scene_of(placed("mesh", true, fixed=True), placed("board", board, pose=pose))
    with tempfile.TemporaryDirectory() as folder:
        path = write_mjcf(scene, Path(folder) / "mjcf")
        if not settle_in_mujoco(path, SECONDS).passed:
            return "falls"
        sides = [shadow.yaw + math.pi / 2 * k for k in range(4)]
        leans = [settle_in_mujoco(path, SECONDS, change=leaning(side)) for side in sides]
        return "stands" if all(one.passed for one in leans) else "hardly"


def leaning(side: float, degrees: float = LEAST_TILT) -> Callable[[Any], None]:
    """What lets gravity lean towards `side` [rad]."""
    lean = math.radians(degrees)
    down = GRAVITY * np.array([math.sin(lean) * math.cos(side), math.sin(lean) * math.sin(side), -math.cos(lean)])

    def change(model: Any) -> None:
        model.opt.gravity[:] = down

    return change


def prisms(shadow: Shadow, polygons: list[NDArray], inside: list[NDArray]) -> list[ConvexPart]:
    """At most MOST_HULLS hulls in the world, the corners of what a flat board can touch first, then the highest."""
    points = np.concatenate(inside)
    floor = points[:, 2].min() - 2 * DEPTH
    try:
        outer = points[ConvexHull(np.concatenate([points, points * [1, 1, 0] + [0, 0, floor]])).vertices % len(points)]
    except QhullError:
        outer = points
    corners = {tuple(np.round(point, 9)) for point in outer}
    touched = [not corners.isdisjoint(map(tuple, np.round(polygon, 9))) for polygon in polygons]
    order = sorted(range(len(polygons)), key=lambda k: (not touched[k], -float(polygons[k][:, 2].max())))
    found = []
    for k in order:
        if len(found) == MOST_HULLS:
            break
        flat = polygons[k][:, :2] @ shadow.axes + shadow.centre
        top = np.column_stack([flat, polygons[k][:, 2]])
        try:
            found.append(convex_part(np.concatenate([top, np.column_stack([flat, np.full(len(flat), floor)])])))
        except AssetError:
            continue
    return found


def _clipped(polygon: NDArray[np.float64], beyond: NDArray[np.float64]) -> NDArray[np.float64]:
    """The part of a convex polygon, shape (n, 3), whose corners are `beyond` a line by at most 0."""
    kept = []
    for k in range(len(polygon)):
        a, b = beyond[k - 1], beyond[k]
        if (a < 0.0 < b) or (b < 0.0 < a):
            kept.append(polygon[k - 1] + a / (a - b) * (polygon[k] - polygon[k - 1]))
        if b <= 0.0:
            kept.append(polygon[k])
    return np.array(kept).reshape(-1, 3)
