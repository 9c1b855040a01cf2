"""Which way is up, and how high the camera is: the plane on which things stand.

A plane n . X + d = 0 in camera axes is linear in what a depth camera measures: with X = z s, s the slopes of a pixel,

    1/z = -(n . s) / d = a . s,      n = -a / |a| turned upwards,      d = 1 / |a|.

Errors of the depth grow with it, as those of every sensor and every model do; so the errors of z (a . s) = 1 are alike
in all pixels, and the fit is one of least squares, reweighted until outliers have no part in it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from pat3d.errors import LayoutError
from pat3d.vision.camera import Array, PlacedCamera
from pat3d.vision.observation import Observation

SAMPLES = 4000
"""Pixels that a plane is fitted to at most."""
TRIALS = 400
"""Planes through three random pixels."""
WIDEST_ROLL = 35.0
"""How far the horizon of a photograph may be turned [deg]."""
LEAST_PITCH = 6.0
"""How far the camera has to look down for a plane to be what things stand on [deg]; walls are beyond."""
LEAST_SHARE = 0.15
"""Of the pixels that may show the ground, those that have to lie in one plane."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Plane:
    """Points X of n . X + height = 0 in camera axes."""

    up: Array
    """Unit normal n on the camera's side, shape (3,)."""
    height: float
    """Distance of the camera from the plane [m]."""
    share: float
    """Of the pixels that it was looked for in, those that lie in it."""


def ground_plane(seen: Observation, *, seed: int = 0) -> Plane | None:
    """The plane of what is no object; None where no such plane lies under the objects.

    Args:
        seen: what is seen.
        seed: of the random pixels.
    """
    rng = np.random.default_rng(seed)
    return _find_plane(seen, seen.instances == 0, _object_points(seen, rng), rng)


def surface_plane(seen: Observation, name: str, *, seed: int = 0) -> Plane | None:
    """The plane of the top of object `name` (a table); None where most of what is seen of it is no such plane."""
    rng = np.random.default_rng(seed)
    # A table's own legs are below its top, and so may be others' feet.
    return _find_plane(seen, seen.mask(name), (np.zeros((0, 3)), np.zeros(0)), rng)


def _find_plane(
    seen: Observation, where: np.ndarray, others: tuple[Array, Array], rng: np.random.Generator
) -> Plane | None:
    """The plane with most of the pixels `where`, shape (height, width), that can be level and under `others`."""
    rows, columns = np.nonzero(where & seen.known)
    if len(rows) < 100:
        return None
    chosen = rng.permutation(len(rows))[:SAMPLES]
    rows, columns = rows[chosen], columns[chosen]
    slopes = seen.camera.slopes(columns + 0.5, rows + 0.5)
    depth = seen.depth[rows, columns].astype(np.float64)
    tolerance = 2.5 * max(seen.noise, 0.004)
    best: Array | None = None
    most = 0
    for _ in range(TRIALS):
        three = rng.choice(len(rows), 3, replace=False)
        try:
            a = np.asarray(np.linalg.solve(slopes[three], 1.0 / depth[three]), dtype=np.float64)
        except np.linalg.LinAlgError:
            continue
        if not _may_carry(a, others, tolerance):
            continue
        count = int(np.count_nonzero(np.abs(depth * (slopes @ a) - 1.0) < tolerance))
        if count > most:
            best, most = a, count
    if best is None or most < LEAST_SHARE * len(rows):
        return None
    for _ in range(10):
        error = depth * (slopes @ best) - 1.0
        weight = np.clip(1.0 - (error / (1.6 * tolerance)) ** 2, 0.0, None) * depth
        solved = np.linalg.lstsq(slopes * weight[:, None], weight / depth, rcond=None)[0]
        best = np.asarray(solved, dtype=np.float64)
    if not _may_carry(best, others, tolerance):
        # The front of a thing passes for a floor until it is looked at closely.
        return None
    length = float(np.linalg.norm(best))
    share = float(np.mean(np.abs(depth * (slopes @ best) - 1.0) < tolerance))
    return Plane(up=-best / length, height=1.0 / length, share=share)


def _object_points(seen: Observation, rng: np.random.Generator) -> tuple[Array, Array]:
    """Slopes and depths of some pixels of objects."""
    rows, columns = np.nonzero((seen.instances > 0) & seen.known)
    chosen = rng.permutation(len(rows))[:500]
    rows, columns = rows[chosen], columns[chosen]
    return seen.camera.slopes(columns + 0.5, rows + 0.5), seen.smooth_depth[rows, columns].astype(np.float64)


def _may_carry(a: Array, others: tuple[Array, Array], tolerance: float) -> bool:
    """Whether the plane 1/z = a . s is a floor: under the camera, nearly level with the picture, under the objects."""
    up = -a / np.linalg.norm(a)
    # The picture's own up is -y; of a floor seen from above, part of the normal points at the camera.
    if abs(up[0]) > math.sin(math.radians(WIDEST_ROLL)) or -up[1] < math.sin(math.radians(LEAST_PITCH)) or up[2] > 0.5:
        return False
    slopes, depth = others
    below = depth * (slopes @ a) - 1.0 > 2.0 * tolerance
    return bool(below.mean() < 0.05) if len(below) else True


def level_camera(seen: Observation, plane: Plane, *, beneath: float = 0.0) -> PlacedCamera:
    """The camera in the scene's frame: z up, the ground at 0, the viewer at -y, the objects around the origin.

    Args:
        seen: what is seen.
        plane: a level plane.
        beneath: height of that plane above the ground [m].
    """
    up = plane.up
    forward = np.array([0.0, 0.0, 1.0]) - up[2] * up
    if np.linalg.norm(forward) < 0.05:
        # Straight from above, the picture's up is the scene's depth.
        forward = np.array([0.0, -1.0, 0.0]) + up[1] * up
    forward /= np.linalg.norm(forward)
    rotation = np.asarray(np.stack([np.cross(forward, up), forward, up]), dtype=np.float64)
    rows, columns = np.nonzero((seen.instances > 0) & seen.known)
    if not len(rows):
        raise LayoutError("no object of the picture has a known depth.")
    points = seen.camera.slopes(columns + 0.5, rows + 0.5) * seen.depth[rows, columns, None]
    middle = np.median(points @ rotation.T, axis=0)
    position = np.array([-middle[0], -middle[1], plane.height + beneath])
    return PlacedCamera(pinhole=seen.camera, rotation=rotation, position=position)
