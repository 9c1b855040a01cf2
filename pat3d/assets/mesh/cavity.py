"""Cavity loss: how much of the free space in a mug or bowl its convex parts take away."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.planes import planes
from pat3d.scene.asset import Region


@dataclass(frozen=True, kw_only=True, eq=False)
class Probe:
    """Rays from the axis of a cavity to its wall, at several heights."""

    origins: NDArray[np.float64]
    """[m], shape (rays, 3)."""
    rays: NDArray[np.float64]
    """Horizontal unit vectors, shape (rays, 3)."""
    free: NDArray[np.float64]
    """Distance to the wall [m], shape (rays,)."""

    def reach(self, sides: NDArray[np.float64]) -> NDArray[np.float64]:
        """Distance along each ray to a convex polyhedron of planes `sides` [m], 0 inside, inf where it is missed."""
        return _entry(self.origins, self.rays, sides)

    def loss(self, left: NDArray[np.float64]) -> NDArray[np.float64]:
        """Fraction of every ray that is gone where `left` [m] of it is free."""
        return np.clip(1.0 - left / self.free, 0.0, 1.0)


def probe(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer[Any]],
    region: Region,
    *,
    directions: int = 64,
    levels: int = 8,
) -> Probe:
    """Rays that meet the wall of a cavity; the arguments as for `cavity_loss`."""
    import trimesh

    angle = 2.0 * np.pi * (np.arange(directions) + 0.5) / directions
    height = region.floor[2] + region.height * np.linspace(0.1, 0.9, levels)
    angle, height = (grid.ravel() for grid in np.meshgrid(angle, height))
    origins = np.stack([np.full_like(angle, region.floor[0]), np.full_like(angle, region.floor[1]), height], axis=1)
    rays = np.stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)], axis=1)
    mesh = trimesh.Trimesh(vertices, faces, process=False)
    points, index, _ = mesh.ray.intersects_location(origins, rays, multiple_hits=False)
    free = np.full(len(rays), np.inf)
    np.minimum.at(free, index, np.linalg.norm(points - origins[index], axis=1))
    walled = np.isfinite(free)
    return Probe(origins=origins[walled], rays=rays[walled], free=free[walled])


def cavity_loss(
    vertices: NDArray[np.float64],
    faces: NDArray[np.integer[Any]],
    parts: Sequence[ConvexPart],
    region: Region,
    *,
    directions: int = 64,
    levels: int = 8,
) -> NDArray[np.float64]:
    """Fraction by which the free radius around a cavity's axis shrinks from the mesh to its parts, shape (rays,).

    Args:
        vertices: of the closed mesh [m], shape (vertices, 3).
        faces: shape (faces, 3).
        parts: convex parts of the mesh.
        region: cavity of the mesh.
        directions: rays at each level.
        levels: heights between a tenth and nine tenths of the depth.
    """
    seen = probe(vertices, faces, region, directions=directions, levels=levels)
    left = np.full(len(seen.free), np.inf)
    for part in parts:
        left = np.minimum(left, seen.reach(planes(part)))
    return seen.loss(left)


def _entry(origins: NDArray[np.float64], rays: NDArray[np.float64], sides: NDArray[np.float64]) -> NDArray[np.float64]:
    """Distance along each ray to a convex polyhedron [m], 0 inside, inf where it is missed."""
    speed = rays @ sides[:, :3].T
    depth = origins @ sides[:, :3].T + sides[:, 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        cross = -depth / speed
    first = np.where(speed < -1e-12, cross, np.where((np.abs(speed) <= 1e-12) & (depth > 0), np.inf, 0.0)).max(axis=1)
    last = np.where(speed > 1e-12, cross, np.inf).min(axis=1)
    first = np.maximum(first, 0.0)
    return np.where(first <= last, first, np.inf)
