"""Where an object can be put down: in or on another, or somewhere free near the robot."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.free_space import edge_margin
from pat3d.scene.asset import Region

Array = NDArray[np.float64]

CELL, ACROSS = 0.015, 12
"""Least distance of the spots that are tried in or on something [m], and how many there are at most along a side."""

GAP = 0.02
"""What stands nearer to a spot than this [m] makes it a worse one."""

CROWDED = 5.0
"""By how much worse [m], for a metre of gap that is missing."""

FREE_GAP = 0.05
"""Kept free around what is put down beside everything [m], for the fingers that take its neighbours."""

EDGE = 0.12
"""Kept from the edge of a workbench [m]."""

DISTANCES = np.arange(0.42, 0.67, 0.04)
"""From the robot's base at which things are put down [m]."""

TURNS = np.linspace(-1.3, 1.3, 27)
"""And directions, from where it faces [rad]."""


def spots_over(env: Any, name: str, where: str, *, on: bool, more: bool) -> list[Array]:
    """Points of the floor of `where` at which the middle of object `name` may be put down [m], best first.

    Args:
        env: a TabletopEnv.
        name: what is put down.
        where: a container or a base.
        on: onto its top, though it has an inside.
        more: others are still to come there, so that its middle is left free.
    """
    state = env.simulation.state
    asset = env.scene[where].asset
    region = asset.region("on") if on or asset.region("in") is None else asset.region("in")
    if region is None:
        return [state.position(where).copy()]
    radius = _radius(state.points(name))
    # What is in a container has to get between its walls; what is on a top may stick out.
    margin = radius if region.kind == "in" else edge_margin(env.scene, name)
    there = [
        state.local(state.points(obj.name), where)[:, :2]
        for obj in env.scene.objects
        if obj.name not in (name, where) and (state.touch(obj.name, where) or _stands(state, obj.name, where, region))
    ]
    points = _cells(region, margin)
    away = np.linalg.norm(points - np.array(region.floor[:2]), axis=1)
    cost = away.max() - away if (more or there) and region.kind == "in" else away
    cost = cost + CROWDED * np.maximum(GAP - (_gaps(points, there) - radius), 0.0)
    order = np.argsort(cost, kind="stable")
    local = np.column_stack([points, np.full(len(points), region.floor[2])])[order]
    return list(local @ state.rotation(where).T + state.position(where))


def free_spots(env: Any, name: str) -> list[Array]:
    """Points of the surface of the work that are free around object `name` [m], those with the shortest way first."""
    state, placement = env.simulation.state, env.placement
    base = np.array(placement.base_position)
    angles = placement.yaw + TURNS
    points = (DISTANCES[:, None, None] * np.stack([np.cos(angles), np.sin(angles)], axis=1)).reshape(-1, 2) + base[:2]
    low, high = _surface(env)
    points = points[((points >= low + EDGE) & (points <= high - EDGE)).all(axis=1)]
    if not len(points):
        return []
    clouds = [state.points(obj.name)[:, :2] for obj in env.scene.objects if obj.name not in (name, placement.host)]
    gap = _gaps(points, clouds) - _radius(state.points(name))
    # The hand comes back from there, so that a way that is long is long twice.
    cost = np.linalg.norm(points - state.centre(name)[:2], axis=1) + CROWDED * np.maximum(FREE_GAP - gap, 0.0)
    order = np.argsort(cost, kind="stable")
    return [np.array([*points[k], placement.surface]) for k in order]


def _surface(env: Any) -> tuple[Array, Array]:
    """Lower and upper corner of what the work stands on [m]; everywhere for a floor."""
    placement = env.placement
    if placement.bench is not None:
        return np.array(placement.bench[0]), np.array(placement.bench[1])
    if placement.host is not None:
        points = env.simulation.state.points(placement.host)[:, :2]
        return points.min(axis=0), points.max(axis=0)
    return np.full(2, -math.inf), np.full(2, math.inf)


def _gaps(points: Array, clouds: list[Array]) -> Array:
    """Least distance of every point, shape (n, 2), from the bounding boxes of clouds [m], shape (n,)."""
    gaps = np.full(len(points), math.inf)
    for cloud in clouds:
        low, high = cloud.min(axis=0), cloud.max(axis=0)
        gaps = np.minimum(gaps, np.linalg.norm(np.maximum(np.maximum(low - points, points - high), 0.0), axis=1))
    return gaps


def _radius(points: Array) -> float:
    """Of the circle around the middle of what is seen from above [m]."""
    flat = points[:, :2]
    return float(np.linalg.norm(flat - (flat.min(axis=0) + flat.max(axis=0)) / 2, axis=1).max())


def _stands(state: Any, name: str, where: str, region: Region) -> bool:
    """Whether something is over a region, though it touches only what else is there."""
    x, y, z = state.local(state.centre(name)[None], where)[0] - np.array(region.floor)
    return bool(abs(x) < region.half_size[0] and abs(y) < region.half_size[1] and z > -0.01)


def _cells(region: Region, margin: float) -> Array:
    """Points of a floor that are `margin` [m] inside its edge, its middle at least, shape (n, 2)."""
    half = np.maximum(np.array(region.half_size[:2]) - margin, 0.0)
    cell = max(CELL, 2 * float(half.max()) / ACROSS)
    x, y = (cell * np.arange(-int(side / cell), int(side / cell) + 1) for side in half)
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    if region.shape == "disc":
        points = points[np.linalg.norm(points, axis=1) <= half[0] + 1e-9]
    return np.asarray(points + np.array(region.floor[:2]), dtype=np.float64)
