"""Boxes, footprints and centres of affine bodies as differentiable functions of their states.

A state q = (p, a_1, a_2, a_3) holds the centre of mass and the columns of the linear map, so a rest point xbar
about the centre of mass sits at x = p + xbar_1 a_1 + xbar_2 a_2 + xbar_3 a_3.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
import torch
from scipy.spatial import ConvexHull

from pat3d.scene.asset import Asset


@dataclass(frozen=True, eq=False)
class Box:
    """Axis-aligned bounding box."""

    low: torch.Tensor
    """Lower corner [m], shape (..., 3)."""
    high: torch.Tensor
    """Upper corner [m], shape (..., 3)."""

    @property
    def centre(self) -> torch.Tensor:
        """[m], shape (..., 3)."""
        return (self.low + self.high) / 2

    @property
    def size(self) -> torch.Tensor:
        """[m], shape (..., 3)."""
        return self.high - self.low


class Outline:
    """The rest shape of one asset: its bounding box and the extreme points of its parts, about the centre of mass."""

    def __init__(self, asset: Asset) -> None:
        centre = np.array(asset.mass_properties.centre_of_mass)
        points = np.concatenate([part.vertices for part in asset.parts]) - centre
        corners = np.array(list(itertools.product(*(asset.bounds - centre).T)))
        self.corners = torch.from_numpy(corners)
        """Corners of the bounding box at rest [m], shape (8, 3)."""
        self.points = torch.from_numpy(points[ConvexHull(points).vertices])
        """Extreme points at rest [m], shape (points, 3)."""

    def box(self, q: torch.Tensor) -> Box:
        """Bounding box of the shape at states `q`, shape (..., 12)."""
        points = moved(self.points, q)
        return Box(points.amin(dim=-2), points.amax(dim=-2))

    def footprint(self, q: torch.Tensor) -> torch.Tensor:
        """Corners [m] of the shape seen from above, counter-clockwise, shape (n, 2), at one state `q`, shape (12,)."""
        points = moved(self.points, q)[:, :2]
        return points[torch.from_numpy(ConvexHull(points.detach().numpy()).vertices.astype(np.int64))]


def moved(rest: torch.Tensor, q: torch.Tensor) -> torch.Tensor:
    """Rest points [m], shape (n, 3), at states `q`, shape (..., 12); returns shape (..., n, 3)."""
    q = q.unflatten(-1, (4, 3))
    return q[..., :1, :] + rest @ q[..., 1:, :]


def outside(point: torch.Tensor, polygon: torch.Tensor) -> torch.Tensor:
    """How far a point, shape (2,), is outside the nearest edge line of a convex polygon, shape (n, 2); negative inside.

    Never more than the distance to the polygon, and positive exactly outside.
    """
    edges = torch.roll(polygon, -1, dims=0) - polygon
    normals = torch.stack([edges[:, 1], -edges[:, 0]], dim=1) / torch.linalg.vector_norm(edges, dim=1, keepdim=True)
    return torch.sum((point - polygon) * normals, dim=1).max()


def polygon_gap(first: torch.Tensor, second: torch.Tensor) -> torch.Tensor:
    """Distance [m] between two convex polygons, shape (n, 2) and (m, 2), that do not overlap."""
    best = []
    for polygon, points in ((first, second), (second, first)):
        edges = torch.roll(polygon, -1, dims=0) - polygon
        relative = points[None] - polygon[:, None]
        share = torch.einsum("epi,ei->ep", relative, edges) / torch.sum(edges**2, dim=1, keepdim=True)
        feet = share.clamp(0.0, 1.0)[..., None] * edges[:, None]
        # Square roots of zero have no derivative.
        best.append(torch.sum((relative - feet) ** 2, dim=-1).clamp(min=1e-24).min())
    return torch.sqrt(torch.minimum(*best))
