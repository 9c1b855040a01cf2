"""Packing things into a cavity: the lowest collision-free resting place over positions and orientations.

Every child is tried as it stands, turned about the vertical, and, where it is long and thin, on its end with
a lean; height maps find the resting height at every position of the cavity at once and the few best are
lowered exactly. Low potential energy is what the heap would look for itself, so it is what ranks the places.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import LayoutError
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.drop import clear, fall
from pat3d.layout.group import Group, yaw_matrix
from pat3d.layout.heightmap import bottom_map, resting_heights, top_map

CELLS = 36
"""Positions tried across the cavity."""
CENTRING = 0.05
"""Height [m] that one metre off the cavity's axis costs when places are ranked."""


@dataclass(frozen=True, kw_only=True)
class Column:
    """The free column of a cavity, in the container's frame turned to the world's axes."""

    centre: Array
    """Centre of the floor [m], shape (3,)."""
    half_size: Array
    """Half extents of the floor [m], shape (2,)."""
    yaw: float
    """Rotation of a rectangular floor [rad]."""
    disc: bool
    height: float
    """From the floor to the rim [m]."""
    capped: bool
    """Whether nothing may rise above the rim (a shelf)."""

    @property
    def rim(self) -> float:
        """Height of the rim [m]."""
        return float(self.centre[2] + self.height)

    @property
    def reach(self) -> Array:
        """Half extents of the bounding box of the floor in world axes [m], shape (2,)."""
        if self.disc:
            return self.half_size
        c, s = abs(math.cos(self.yaw)), abs(math.sin(self.yaw))
        return np.array([c * self.half_size[0] + s * self.half_size[1], s * self.half_size[0] + c * self.half_size[1]])

    def holds(self, points: Array, share: float = 1.0) -> NDArray[np.bool_]:
        """Which horizontal points [m], shape (..., 2), lie in the middle `share` of the column."""
        offset = points - self.centre[:2]
        if self.disc:
            return np.linalg.norm(offset / self.half_size, axis=-1) <= share
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        local = np.stack([c * offset[..., 0] + s * offset[..., 1], c * offset[..., 1] - s * offset[..., 0]], axis=-1)
        return np.all(np.abs(local) <= share * self.half_size, axis=-1)


def pack(
    container: Placed,
    column: Column,
    groups: Sequence[Group],
    *,
    obstacles: Sequence[Placed],
    rng: np.random.Generator,
    gap: float,
) -> list[Group]:
    """Place every group inside the container's cavity, in order.

    Args:
        container: what holds them.
        column: its cavity.
        groups: what to place; roots' origins at zero.
        obstacles: further bodies in the way.
        rng: orders equal places.
        gap: distance kept from everything [m].

    Raises:
        LayoutError: one is larger than the cavity, or the cavity is full.
    """
    placed: list[Group] = []
    settled = [container, *obstacles]
    for group in groups:
        found = _best_place(container, column, group, settled, heap=bool(placed), rng=rng, gap=gap)
        if found is None:
            raise _refusal(container, column, group, [other.name for other in placed])
        placed.append(found)
        settled.extend(found.members)
    return placed


def _best_place(
    container: Placed,
    column: Column,
    group: Group,
    settled: list[Placed],
    *,
    heap: bool,
    rng: np.random.Generator,
    gap: float,
) -> Group | None:
    cell = float(2 * column.reach.max() / CELLS)
    counts = np.maximum(1, np.round(2 * column.reach / cell).astype(int))
    corner = column.centre[:2] - cell * (counts - 1) / 2
    x, y = (corner[k] + cell * np.arange(counts[k]) for k in range(2))
    spots = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    ranked: list[tuple[float, int, Group, Array]] = []
    for turned in (group.turned(rotation) for rotation in orientations(group, column, rng)):
        low, high = turned.low, turned.high
        centre = turned.centre_of_mass
        before = np.ceil((-low[:2] + gap + cell) / cell).astype(int)
        after = np.ceil((high[:2] + gap + cell) / cell).astype(int)
        shape = tuple(before + after + 1)
        underside = bottom_map(turned.members, -cell * before, cell, shape, gap + cell / 2)
        span = tuple(counts + np.array(shape) - 1)
        top = top_map(settled, corner - cell * before, cell, span, cell / 2)
        heights = np.maximum(resting_heights(top, underside), container.low[2] - low[2]) + gap
        lowest = heights + low[2]
        allowed = column.holds(spots + centre[:2], 0.95 if not heap else 0.85)
        allowed &= _deep_enough(lowest, turned, column, heap)
        if column.capped:
            allowed &= heights + high[2] + gap < column.rim
        if not allowed.any():
            continue
        off_axis = np.linalg.norm(spots + centre[:2] - column.centre[:2], axis=-1)
        cost = heights + centre[2] + CENTRING * off_axis + 1e-4 * rng.random(heights.shape)
        cost = np.where(allowed, cost, np.inf)
        for index in np.argsort(cost, axis=None)[:3]:
            i, j = np.unravel_index(index, cost.shape)
            if np.isfinite(cost[i, j]):
                spot = np.array([*spots[i, j], heights[i, j]])
                ranked.append((float(cost[i, j]), len(ranked), turned, spot))
    best: tuple[float, Group] | None = None
    for attempt, (_, _, turned, spot) in enumerate(sorted(ranked, key=lambda item: item[:2])):
        if attempt >= 16 or (attempt >= 3 and best is not None):
            break
        lowered = lower(turned, spot, settled, floor=float(container.low[2]), gap=gap)
        if lowered is None or not _deep_enough(np.array(lowered.low[2]), lowered, column, heap):
            continue
        energy = float(lowered.centre_of_mass[2])
        if best is None or energy < best[0]:
            best = energy, lowered
    return None if best is None else best[1]


def _deep_enough(lowest: Array, group: Group, column: Column, heap: bool) -> NDArray[np.bool_]:
    """Whether a body with its lowest point at `lowest` [m] is in the cavity, or on a heap that stays in it."""
    tall = float(group.high[2] - group.low[2])
    inside = lowest <= column.rim - 0.25 * min(column.height, tall)
    if heap and not column.capped and np.sort(group.size)[1] <= 2 * column.half_size.max():
        inside |= lowest <= column.rim + 0.5 * tall
    return inside


def lower(group: Group, spot: Array, settled: Sequence[Placed], *, floor: float, gap: float) -> Group | None:
    """`group` with its origin over `spot` [m], shape (3,), lowered until `gap` from `settled` or the floor.

    It starts at the height of `spot`, or higher where that is too near something; None where no start is clear.
    """
    above = max(float(body.high[2]) for body in settled) - float(group.low[2]) + 2 * gap
    for height in (spot[2] + 1e-4, spot[2] + 0.004, spot[2] + 0.02, max(above, spot[2])):
        start = group.shifted(np.array([spot[0], spot[1], height]))
        if all(clear(member, settled, gap - 2e-4) for member in start.members):
            drop = min(fall(member, settled, floor=floor, gap=gap) for member in start.members)
            return start.shifted(np.array([0.0, 0.0, -drop]))
    return None


def orientations(group: Group, column: Column, rng: np.random.Generator) -> Iterator[Array]:
    """Rotations, shape (3, 3), worth trying for `group` in `column`."""
    start = float(rng.uniform(-math.pi, math.pi))
    size = group.size
    order = np.argsort(size)
    thin, wide, long = size[order]
    upright = len(group.members) > 1
    round_about = abs(size[0] - size[1]) < 0.05 * max(size[0], size[1])
    yaws = [start] if round_about and not upright else [0.1 * start / math.pi + k * math.pi / 4 for k in range(4)]
    for yaw in yaws:
        yield yaw_matrix(yaw)
    if upright or long < 2.2 * wide:
        if not upright and long > 1.3 * thin and min(size[0], size[1]) > 1.8 * column.half_size.min():
            yield from (yaw_matrix(start) @ _onto_end(group, int(order[2]), end) for end in (1.0, -1.0))
        return
    on_end = _onto_end(group, int(order[2]), _wide_end(group.root, int(order[2])))
    steepest = min(math.atan2(max(0.0, 2 * column.half_size.min() - 1.2 * wide), column.height), math.radians(50))
    spins = (0.0, math.pi / 2) if thin < 0.6 * wide else (0.0,)
    for share in (1.0, 0.85, 0.6, 0.0):
        lean = _about("y", share * steepest)
        for k in range(6 if share else 1):
            for spin in spins:
                yield yaw_matrix(start + k * math.pi / 3) @ lean @ yaw_matrix(spin) @ on_end


def _onto_end(group: Group, axis: int, end: float) -> Array:
    """The rotation that takes the `end` (+1 or -1) of the box's `axis` up."""
    if axis == 2:
        return np.eye(3) if end > 0 else _about("x", math.pi)
    return _about("y", -end * math.pi / 2) if axis == 0 else _about("x", end * math.pi / 2)


def _wide_end(body: Placed, axis: int) -> float:
    """Which end (+1 or -1) of a long thing is wider: brush heads, spoon bowls and scissor handles belong up."""
    along = body.vertices[:, axis]
    across = np.delete(body.vertices, axis, axis=1)
    middle = (along.min() + along.max()) / 2
    reach = 0.25 * (along.max() - along.min())
    spread = [
        float(np.prod(np.ptp(across[end * (along - middle) >= reach], axis=0) + 1e-6)) for end in (1.0, -1.0)
    ]
    return 1.0 if axis == 2 and abs(spread[0] - spread[1]) < 0.1 * max(spread) else float(np.sign(spread[0] - spread[1]) or 1.0)


def _about(axis: str, angle: float) -> Array:
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler(axis, angle).as_matrix()


def _refusal(container: Placed, column: Column, group: Group, before: list[str]) -> LayoutError:
    width = 2 * float(column.half_size.min())
    size = float(np.max(group.root.body.asset.size))
    holder = container.body.name
    if before:
        return LayoutError(
            f'"{holder}" ({width:.2f} m wide, {column.height:.2f} m deep) is full: no room for "{group.name}" '
            f"({size:.2f} m) with {listed(before)} inside. Fewer or smaller objects, or a larger "
            f'"{holder}", would fit. Nothing was written.'
        )
    return LayoutError(
        f'"{group.name}" ({size:.2f} m) does not fit inside "{holder}" ({width:.2f} m wide). Nothing was written.'
    )


def listed(names: Sequence[str]) -> str:
    """The first few names, quoted."""
    quoted = [f'"{name}"' for name in names[:4]]
    return ", ".join(quoted) + (f" and {len(names) - 4} more" if len(names) > 4 else "")
