"""Convex hulls of point sets as convex parts, with exact boxes recognised."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import AssetError
from pat3d.geometry.normals import area_vectors, triangle_areas
from pat3d.geometry.rotations import quat_of

SLIVER_ASPECT = 1e-5
"""A face whose height is less than this share of its longest edge is a sliver; catalogue hulls have 5e-4 at least."""

SLIVER_AREA = 1e-12
"""So is a face of less than this [m^2]: Drake refuses a scene for a triangle without a normal."""

GRID = 1e-9
"""Of the size of a point set, what corners may be off where Qhull cannot do without."""


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
    """The convex hull of `points` [m], shape (n, 3), with outward faces, none a sliver; exact boxes are recognised.

    A corner that makes a sliver is left out, which takes less than SLIVER_ASPECT of an edge, or about the root of
    SLIVER_AREA, off the hull.

    Raises:
        AssetError: the points are flat or fewer than four.
    """
    points = np.asarray(points, dtype=np.float64)
    vertices, faces = _hull(points)
    while len(narrow := slivers(vertices, faces)):
        if len(vertices) == 4:
            raise AssetError(f"{len(points)} points span a sliver, not a volume, so they have no convex hull.")
        corners = faces[narrow[0]]
        vertices, faces = _hull(np.delete(vertices, _superfluous(vertices[corners], corners), axis=0))
    return ConvexPart(vertices=vertices, faces=faces, box=_as_box(vertices))


def slivers(vertices: NDArray[np.float64], faces: NDArray[np.integer[Any]]) -> NDArray[np.int64]:
    """Indices of the triangles that engines cannot find a normal of, the narrowest first.

    Args:
        vertices: [m], shape (vertices, 3).
        faces: shape (faces, 3).
    """
    corners = vertices[faces]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    area = triangle_areas(corners)
    aspect = 2.0 * area / np.maximum(longest, 1e-300) ** 2
    bad = np.flatnonzero((aspect < SLIVER_ASPECT) | (area < SLIVER_AREA))
    return bad[np.argsort(aspect[bad], kind="stable")]


def _superfluous(triangle: NDArray[np.float64], corners: NDArray[np.integer[Any]]) -> int:
    """The corner of a sliver that the hull loses least without: an end of its shortest edge, or the obtuse one."""
    lengths = np.linalg.norm(np.roll(triangle, -1, axis=0) - np.roll(triangle, -2, axis=0), axis=1)
    # The corner opposite the longest edge is obtuse, or an end of the shortest edge.
    return int(corners[np.argmax(lengths)])


def _hull(points: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Extreme points and outward triangles of the convex hull."""
    # Imported where it is used: reading a prompt needs the scene's types and no hulls.
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        # Points that lie in planes but for rounding make Qhull give up now and then; on a grid they lie in them.
        grid = GRID * float(np.ptp(points, axis=0).max(initial=0.0))
        try:
            hull = ConvexHull(np.round(points / grid) * grid if grid > 0.0 else points)
        except (QhullError, ValueError) as error:
            raise AssetError(f"{len(points)} points span no volume, so they have no convex hull.") from error
    keep = np.unique(hull.simplices)
    renumber = np.zeros(len(points), dtype=np.int32)
    renumber[keep] = np.arange(len(keep), dtype=np.int32)
    vertices = points[keep]
    faces = renumber[hull.simplices]
    inward = np.einsum("fi,fi->f", area_vectors(vertices[faces]), hull.equations[:, :3]) < 0
    faces[inward] = faces[inward][:, ::-1]
    return vertices, faces


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
