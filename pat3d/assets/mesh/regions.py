"""Where children belong on an imported object: its top and its cavity, from height maps.

Both are found on the convex parts, which contain the visual mesh, so a region is free of both.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage
from scipy.spatial import ConvexHull, QhullError

from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.planes import planes
from pat3d.scene.asset import Region

CELLS = 128
"""Cells of a height map along the longer side of the footprint."""

MIN_DEPTH = 0.15
"""Least depth of a cavity as a fraction of the object's height."""

MIN_WIDTH = 0.1
"""Least half width of a cavity as a fraction of the longer side of the footprint."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeightMap:
    """Height of the surface seen from above at the centres of square cells."""

    x: NDArray[np.float64]
    """[m], shape (nx,), with one empty cell around the object."""
    y: NDArray[np.float64]
    """[m], shape (ny,)."""
    height: NDArray[np.float64]
    """[m], shape (nx, ny); -inf where there is nothing."""

    @property
    def cell(self) -> float:
        """Width of a cell [m]."""
        return float(self.x[1] - self.x[0])


def find_regions(parts: Sequence[ConvexPart]) -> tuple[Region, ...]:
    """Places for children on and in an object made of `parts`, best first: a cavity, if any, then the top."""
    seen = height_map(parts)
    pit = cavity(seen)
    return (*((pit,) if pit else ()), top(seen))


def height_map(parts: Sequence[ConvexPart], cells: int = CELLS) -> HeightMap:
    """Height map of the union of convex `parts`."""
    corners = np.concatenate([part.bounds for part in parts])
    x, y = _axes(corners.min(axis=0), corners.max(axis=0), cells)
    height = np.full((len(x), len(y)), -np.inf)
    for part in parts:
        low, high = part.bounds
        i, j = np.searchsorted(x, [low[0], high[0]]), np.searchsorted(y, [low[1], high[1]])
        window = height[i[0] : i[1], j[0] : j[1]]
        if not window.size:
            continue
        px, py = np.meshgrid(x[i[0] : i[1]], y[j[0] : j[1]], indexing="ij")
        upper, lower = np.full(px.shape, np.inf), np.full(px.shape, -np.inf)
        for a, b, c, d in planes(part):
            value = -(a * px + b * py + d)
            if c > 1e-9:
                upper = np.minimum(upper, value / c)
            elif c < -1e-9:
                lower = np.maximum(lower, value / c)
            else:
                upper = np.where(value < 0, -np.inf, upper)
        np.maximum(window, np.where(upper >= lower, upper, -np.inf), out=window)
    return HeightMap(x=x, y=y, height=height)


def mesh_height_map(vertices: NDArray[np.float64], faces: NDArray[np.integer[Any]], cells: int = CELLS) -> HeightMap:
    """Height map of a triangle mesh by rays from above."""
    import trimesh

    mesh = trimesh.Trimesh(vertices, faces, process=False)
    x, y = _axes(vertices.min(axis=0), vertices.max(axis=0), cells)
    px, py = np.meshgrid(x, y, indexing="ij")
    start = vertices[:, 2].max() + 0.1 * np.ptp(vertices, axis=0).max()
    origins = np.stack([px.ravel(), py.ravel(), np.full(px.size, start)], axis=1)
    points, rays, _ = mesh.ray.intersects_location(
        origins, np.tile([0.0, 0.0, -1.0], (px.size, 1)), multiple_hits=False
    )
    height = np.full(px.size, -np.inf)
    np.maximum.at(height, rays, points[:, 2])
    return HeightMap(x=x, y=y, height=height.reshape(px.shape))


def cavity(seen: HeightMap) -> Region | None:
    """The largest disc or rectangle inside a hollow that is open to above, or None."""
    finite = np.isfinite(seen.height)
    low, high = float(seen.height[finite].min()), float(seen.height.max())
    rim = _water_level(seen.height)
    depth = np.zeros_like(rim)
    depth[finite] = rim[finite] - seen.height[finite]
    least = MIN_DEPTH * max(high, high - low)
    label = _labels(depth > 0.25 * least)
    best, largest = None, 0.0
    for index in range(1, int(label.max()) + 1):
        pit = label == index
        if depth[pit].max() < least:
            continue
        edge = float(rim[pit].max())
        floor_levels = np.linspace(float(seen.height[pit].min()), edge - 0.5 * least, 25)
        for level in floor_levels + 1e-6:
            shape, centre, half = _largest(seen, pit & (seen.height <= level))
            size = half[0] * half[1] * (np.pi if shape == "disc" else 4.0) * (edge - level)
            if size > largest and min(half) >= MIN_WIDTH * max(np.ptp(seen.x), np.ptp(seen.y)) / 2:
                largest = size
                best = Region(
                    kind="in", shape=shape, floor=(*centre, float(level)), half_size=half, height=edge - float(level)
                )
    return best


def top(seen: HeightMap) -> Region:
    """The highest large level area, with nothing above it, on which a flat thing can lie."""
    finite = np.isfinite(seen.height)
    values = seen.height[finite]
    high, span = float(values.max()), float(max(np.ptp(values), 1e-6))
    band = max(0.02 * span, 0.02 * high, 1e-6)
    counts, edges = np.histogram(values, bins=48)
    common = [float(edges[k + 1]) for k in np.flatnonzero(counts > 0.03 * len(values))]
    found = []
    for level in sorted({high, *common}, reverse=True):
        near = finite & (np.abs(seen.height - level) <= band)
        allowed = _filled(near) & (seen.height <= level + band)
        if not near.any():
            continue
        shape, centre, half = _largest(seen, allowed)
        inside = near & (np.abs(seen.x - centre[0]) <= half[0])[:, None] & (np.abs(seen.y - centre[1]) <= half[1])[None]
        floor = float(seen.height[inside].max(initial=-np.inf))
        area = half[0] * half[1] * (np.pi if shape == "disc" else 4.0)
        found.append((area, shape, centre, half, floor if np.isfinite(floor) else level))
    largest = max(area for area, *_ in found)
    _, shape, centre, half, floor = next(item for item in found if item[0] >= 0.5 * largest)
    return Region(kind="on", shape=shape, floor=(*centre, floor), half_size=half)


def _labels(mask: NDArray[np.bool_]) -> NDArray[np.int32]:
    """Connected cells of `mask`, numbered from 1; 0 elsewhere."""
    return np.asarray(ndimage.label(mask)[0])  # type: ignore[index]


def _axes(low: NDArray[np.float64], high: NDArray[np.float64], cells: int):
    cell = float(max(high[0] - low[0], high[1] - low[1])) / cells
    counts = np.ceil((high[:2] - low[:2]) / cell - 1e-9).astype(int) + 2
    middle = (low + high)[:2] / 2
    return tuple(middle[k] + (np.arange(counts[k]) - (counts[k] - 1) / 2) * cell for k in range(2))


def _water_level(height: NDArray[np.float64]) -> NDArray[np.float64]:
    """Level up to which rain would fill each cell; water leaves where there is nothing."""
    level = np.full(height.shape, np.inf)
    queue = []
    for i, j in zip(*np.nonzero(~np.isfinite(height)), strict=True):
        level[i, j] = -np.inf
        queue.append((-np.inf, int(i), int(j)))
    heapq.heapify(queue)
    rows, columns = height.shape
    while queue:
        water, i, j = heapq.heappop(queue)
        for p, q in ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)):
            if 0 <= p < rows and 0 <= q < columns and level[p, q] == np.inf:
                level[p, q] = max(water, height[p, q])
                heapq.heappush(queue, (level[p, q], p, q))
    return level


def _largest(
    seen: HeightMap, mask: NDArray[np.bool_]
) -> tuple[Literal["disc", "rectangle"], tuple[float, float], tuple[float, float]]:
    """The larger of the largest disc and rectangle within `mask`: shape, centre [m], half sizes [m]."""
    if not mask.any():
        return "rectangle", (0.0, 0.0), (0.0, 0.0)
    reach = np.asarray(ndimage.distance_transform_edt(np.pad(mask, 1)))[1:-1, 1:-1]
    # Cells at the same reach form a plateau: its middle is the centre.
    peak = np.argwhere(reach >= reach.max() - 0.51)
    middle = peak.mean(axis=0)
    i, j = peak[np.argmin(np.linalg.norm(peak - middle, axis=1) - reach[tuple(peak.T)] * 2)]
    radius = max(0.0, float(reach[i, j]) - 0.75) * seen.cell
    i0, i1, j0, j1 = _largest_rectangle(mask)
    half = (float(seen.x[i1] - seen.x[i0]) / 2, float(seen.y[j1] - seen.y[j0]) / 2)
    if np.pi * radius**2 >= 4.0 * half[0] * half[1]:
        return "disc", (float(seen.x[i]), float(seen.y[j])), (radius, radius)
    centre = (float(seen.x[i0] + seen.x[i1]) / 2, float(seen.y[j0] + seen.y[j1]) / 2)
    return "rectangle", centre, half


def _largest_rectangle(mask: NDArray[np.bool_]) -> tuple[int, int, int, int]:
    """First and last row and column of the largest rectangle of true cells."""
    best, result = 0, (0, 0, 0, 0)
    run = np.zeros(mask.shape[1] + 1, dtype=int)
    for row in range(mask.shape[0]):
        run[:-1] = np.where(mask[row], run[:-1] + 1, 0)
        stack: list[tuple[int, int]] = []
        for column, tall in enumerate(run.tolist()):
            start = column
            while stack and stack[-1][1] >= tall:
                start, above = stack.pop()
                if above * (column - start) > best:
                    best, result = above * (column - start), (row - above + 1, row, start, column - 1)
            stack.append((start, tall))
    return result


def _filled(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Cells in the convex hull of the true cells."""
    rows = np.flatnonzero(mask.any(axis=1))
    first, last = mask[rows].argmax(axis=1), mask.shape[1] - 1 - mask[rows][:, ::-1].argmax(axis=1)
    try:
        sides = ConvexHull(np.concatenate([np.stack([rows, first], axis=1), np.stack([rows, last], axis=1)])).equations
    except (QhullError, ValueError):
        return mask
    i, j = np.indices(mask.shape)
    return np.all([a * i + b * j + c <= 1e-9 for a, b, c in sides], axis=0)
