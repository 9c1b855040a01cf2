"""Convex hulls of point sets as convex parts, with exact boxes recognised."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError
from pat3d.geometry.normals import area_vectors
from pat3d.geometry.rotations import quat_of


@dataclass(frozen=True, kw_only=True, eq=False)
class ConvexPart:
    """A convex polyhedron: what is simulated, certified and exported for contact."""

    vertices: NDArray[np.float64]
    """Extreme points [m], shape (vertices, 3), in the asset frame."""
    faces: NDArray[np.int32]
    """Triangulated surface, counter-clockwise seen from outside, shape (faces, 3)."""
    box: tuple[tuple[float, float, float], tuple[float, float, float], tuple[float, float, float, float]] | None = None
    """(centre [m], half sizes [m], quat_wxyz) where the part is exactly a box."""

    @property
    def bounds(self) -> NDArray[np.float64]:
        """Lower and upper corner of the bounding box [m], shape (2, 3)."""
        return np.stack([self.vertices.min(axis=0), self.vertices.max(axis=0)])


def convex_part(points: NDArray[np.float64]) -> ConvexPart:
    """The convex hull of `points` [m], shape (n, 3), with outward faces; exact boxes are recognised.

    Raises:
        AssetError: the points are flat or fewer than four.
    """
    points = np.asarray(points, dtype=np.float64)
    # Imported where it is used: reading a prompt needs the scene's types and no hulls.
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError) as error:
        raise AssetError(f"{len(points)} points span no volume, so they have no convex hull.") from error
    keep = np.unique(hull.simplices)
    renumber = np.zeros(len(points), dtype=np.int32)
    renumber[keep] = np.arange(len(keep), dtype=np.int32)
    vertices = points[keep]
    faces = renumber[hull.simplices]
    inward = np.einsum("fi,fi->f", area_vectors(vertices[faces]), hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    return ConvexPart(vertices=vertices, faces=faces, box=_as_box(vertices))


def _as_box(vertices: NDArray[np.float64]) -> Any:
    """(centre, half sizes, quat_wxyz) if the eight vertices are a box to 1e-9 of its size."""
    if len(vertices) != 8:
        return None
    centre = vertices.mean(axis=0)
    offsets = vertices - centre
    corner = offsets[0]
    # The three neighbours of a box corner are nearest but one another's diagonals; try all triples.
    others = vertices[1:] - vertices[0]
    lengths = np.linalg.norm(others, axis=1)
    scale = lengths.max()
    for i in range(7):
        for j in range(i + 1, 7):
            if abs(others[i] @ others[j]) > 1e-9 * scale**2:
                continue
            for k in range(j + 1, 7):
                if max(abs(others[i] @ others[k]), abs(others[j] @ others[k])) > 1e-9 * scale**2:
                    continue
                edges = others[[i, j, k]]
                if np.linalg.norm(corner + 0.5 * edges.sum(axis=0)) > 1e-9 * scale:
                    continue
                half = lengths[[i, j, k]] / 2
                axes = (edges / lengths[[i, j, k], None]).T
                # Order the axes so that an axis-aligned box gets the identity rotation.
                order = _closest_to_identity(axes)
                axes, half = axes[:, order], half[order]
                axes = axes * np.where(np.diag(axes) < 0, -1.0, 1.0)
                if np.linalg.det(axes) < 0:
                    axes[:, 2] *= -1
                projected = np.abs(offsets @ axes)
                if np.abs(projected - half).max() > 1e-9 * scale:
                    continue
                return (tuple(map(float, centre)), tuple(map(float, half)), quat_of(axes))
    return None


def _closest_to_identity(axes: NDArray[np.float64]) -> list[int]:
    """Permutation of the columns that puts the largest components on the diagonal."""
    remaining, order = [0, 1, 2], []
    for row in range(3):
        best = max(remaining, key=lambda column: abs(axes[row, column]))
        order.append(best)
        remaining.remove(best)
    return order
