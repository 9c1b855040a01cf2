"""Faces as engines stand on them: a little smaller than they are.

What tips over the edge of a face presses on that edge alone, and sinks in there. By the time it presses on so little it
has turned, and its weight is further out than on a rigid floor. Five bricks whose weights are 2 mm inside of the edges
under them tip at 0.77 (MuJoCo) and 0.85 (Drake) of the tilt at which rigid ones do; with 1 mm they fall nearly
untilted in Newton's XPBD, Drake and Bullet.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull, QhullError

from pat3d.geometry.contacts import Contacts
from pat3d.geometry.footprints import Plane

WEAR = 3e-4
"""[m], by which edges of faces carry further in than they are; narrow faces keep a share."""

_ONE_PLANE = 1e-4
"""[m]"""


def worn(contacts: Contacts, wear: float = WEAR) -> Contacts:
    """`contacts`, those of one pair of bodies in one plane drawn in, by `wear` [m] at the edges of what is wide.

    Along each side of the least rectangle around them what is 2 a wide becomes 2 a^2 / (a + wear).
    """
    points = contacts.points.copy()
    for pair in np.unique(contacts.bodies, axis=0):
        members = np.flatnonzero((contacts.bodies == pair).all(axis=1))
        while len(members):
            normal, point = contacts.normals[members[0]], contacts.points[members[0]]
            same = contacts.normals[members] @ normal > 1.0 - 1e-10
            same &= np.abs((contacts.points[members] - point) @ normal) < _ONE_PLANE
            group = members[same]
            plane = Plane.through(point, normal)
            local = plane.seen(contacts.points[group])
            points[group] = plane.lifted(_drawn_in(local[:, :2], wear)) + local[:, 2:] * normal
            members = members[~same]
    return replace(contacts, points=points)


def _drawn_in(flat: NDArray[np.float64], wear: float) -> NDArray[np.float64]:
    """Points [m], shape (n, 2), drawn towards the middle of the least rectangle around them."""
    axes = _sides(flat)
    along = flat @ axes.T
    low, high = along.min(axis=0), along.max(axis=0)
    half = (high - low) / 2
    middle = (low + high) / 2
    return (middle + (along - middle) * half / (half + wear)) @ axes


def _sides(flat: NDArray[np.float64]) -> NDArray[np.float64]:
    """Directions of the sides of the least rectangle around points, shape (2, 2)."""
    try:
        corners = flat[ConvexHull(flat).vertices]
    except (QhullError, ValueError):
        # Too few points, or all on a line.
        apart = flat - flat.mean(axis=0)
        along = np.linalg.svd(apart)[2][0]
        return np.array([along, [-along[1], along[0]]])
    edges = np.roll(corners, -1, axis=0) - corners
    edges /= np.linalg.norm(edges, axis=1)[:, None]
    across = np.stack([-edges[:, 1], edges[:, 0]], axis=1)
    areas = np.ptp(corners @ edges.T, axis=0) * np.ptp(corners @ across.T, axis=0)
    best = int(np.argmin(areas))
    return np.array([edges[best], across[best]])
