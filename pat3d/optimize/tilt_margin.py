"""A larger tilt margin for a scene that hardly stands: loads about to tip are moved over the middle of their support.

Seen from above, an object with everything that it carries tips about an edge of the hull of its contacts. With its
common centre of mass at height h over the contacts and d inside that edge, it endures a tilt of atan(d / h). Where that
is little, the object is moved on its parent until its weight is over the point of the hull that is deepest inside; the
leaves of the scene tree come first, so that what they weigh is counted where it will be.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, QhullError

from pat3d.errors import LayoutError
from pat3d.geometry.contacts import find_contacts
from pat3d.geometry.pose import Pose
from pat3d.optimize.placement import Placement
from pat3d.scene.model import GROUND, Scene

ENOUGH = 8.0
"""Tilt [degrees] that an object endures without being moved."""


def recentred(placement: Placement, scene: Scene) -> dict[str, Pose] | None:
    """A layout near that of `placement` in which what is about to tip at rest stands better.

    Args:
        placement: the layout that settles into `scene`.
        scene: at rest.

    Returns:
        Intersection-free poses; None where nothing can be moved for the better.
    """
    contacts = find_contacts(scene.objects)
    index = {obj.name: k for k, obj in enumerate(scene.objects)}
    centre = np.array(
        [obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0] for obj in scene.objects]
    )
    mass = np.array([obj.asset.mass_properties.mass for obj in scene.objects])
    loads = _loads(placement)
    variables = np.zeros((len(placement.names), 3))
    for name in reversed(placement.order):
        k = placement.names.index(name)
        if not placement.movable[k] or placement.parent[name] == GROUND or placement.kind[name] != "on":
            continue
        members = [index[one] for one in loads[name]]
        holds = np.isin(contacts.bodies, members)
        points = contacts.points[holds[:, 0] != holds[:, 1]]
        if not len(points):
            continue
        weight_at = mass[members] @ centre[members] / mass[members].sum()
        middle, depth = deepest(points[:, :2], weight_at[:2])
        height = max(float(weight_at[2] - points[:, 2].mean()), 1e-6)
        if math.degrees(math.atan2(depth, height)) >= ENOUGH:
            continue
        offset = middle - weight_at[:2]
        variables[k, :2] = offset
        centre[members, :2] += offset
    if not np.any(variables):
        return None
    try:
        return placement.project(variables)
    except LayoutError:
        return None


def deepest(points: NDArray[np.float64], inside: NDArray[np.float64]) -> tuple[NDArray[np.float64], float]:
    """The point deepest inside the hull of `points` [m], shape (2,), and how deep `inside`, shape (2,), is in it [m].

    Points on a line have no inside; their mean stands for it.

    Args:
        points: horizontal [m], shape (n, 2).
        inside: whose depth is asked for [m]; negative outside.
    """
    try:
        planes = ConvexHull(points).equations
    except (QhullError, ValueError):
        middle = points.mean(axis=0)
        return middle, -float(np.linalg.norm(inside - middle))
    # Largest inscribed circle: maximise r with n x + c + r <= 0 for every edge.
    found = linprog(
        [0.0, 0.0, -1.0],
        A_ub=np.column_stack([planes[:, :2], np.ones(len(planes))]),
        b_ub=-planes[:, 2],
        bounds=[(None, None), (None, None), (0.0, None)],
    )
    middle = found.x[:2] if found.success else points.mean(axis=0)
    return middle, -float(np.max(planes[:, :2] @ inside + planes[:, 2]))


def _loads(placement: Placement) -> Mapping[str, list[str]]:
    """Every object with all that it carries, holds or contains."""
    loads = {name: [name] for name in placement.names}
    for name in reversed(placement.order):
        if placement.parent[name] != GROUND:
            loads[placement.parent[name]].extend(loads[name])
    return loads
