"""Packing things into a cavity: the lowest collision-free resting place over positions and orientations.

Every child is tried as it stands, turned about the vertical, and, where it is long and thin, on its end with
a lean; height maps find the resting height at every position of the cavity at once and the few best are
lowered exactly. Low potential energy is what the heap would look for itself, so it is what ranks the places.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import about, yaw_matrix
from pat3d.layout.balance import support_margin
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.drop import clear, fall
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map, resting_heights, top_map

CELLS = 36
"""Positions tried across the cavity."""
COARSEST = 90
"""Cells across twice the reach of the largest thing to place, so that large things in small cavities stay cheap."""
CENTRING = 0.03
"""Height [m] that one metre off the cavity's axis costs when places are ranked."""
BALANCING = 0.1
"""The same for the common centre of mass of everything inside, so that light containers do not tip."""
LONG = 2.2
"""Things this many times longer than wide are stood on end in narrow cavities."""
TIPPING = 1.0
"""Height [m] that one metre of the centre of mass outside the contacts costs."""
_PICKS = np.array([0, 1, 2])
_SPREAD_PICKS = np.array([0, 1, 2, 4, 8, 16, 32, 48, 64, 96])
"""Ranks of the places that are tried exactly, of each orientation."""


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
    steady: bool = False,
    kept: Collection[str] = (),
) -> list[Group]:
    """Place every group inside the container's cavity.

    Args:
        container: what holds them.
        column: its cavity.
        groups: what to place; roots' origins at zero.
        obstacles: further bodies in the way.
        rng: orders equal places.
        gap: distance kept from everything [m].
        steady: whether to accept only places where nothing tips: there are no walls to lean on.
        kept: what is only turned about the vertical, however it would fit.

    Raises:
        LayoutError: one is larger than the cavity, or the cavity is full.
    """
    bulky = sorted(groups, key=lambda group: -float(np.prod(np.sort(group.size)[1:])))
    refusals = []
    reach = max(_reach(group) for group in groups)
    # Large before small packs densest; small below large lets the large ones form the heap's top. Only when
    # neither stays within the walls may the heap rise above the rim.
    small_first = bulky[::-1]
    attempts = [(bulky, 0.0), (small_first, 0.0), (bulky, 0.5), (bulky, 1.0), (small_first, 1.0)]
    for order, above_rim in attempts[3:] if steady else attempts:
        heap = _Heap(container, column, obstacles, reach=reach, gap=gap, steady=steady, above_rim=above_rim)
        for group in order:
            found = next(
                (
                    found
                    for rotations in _choices(group, column, rng, upright=group.name in kept)
                    if (found := heap.place(group, list(rotations), rng)) is not None
                ),
                None,
            )
            if found is None:
                refusals.append(_refusal(container, column, group, [other.name for other in heap.placed]))
                break
            heap.add(found)
        else:
            return heap.placed
        if not heap.placed:
            break
    raise refusals[-1]


def _choices(group: Group, column: Column, rng: np.random.Generator, *, upright: bool) -> Iterator[Iterator[Array]]:
    """Rotations for `group`, the likelier ones first."""
    if upright:
        start = float(rng.uniform(-math.pi, math.pi))
        yield (yaw_matrix(start + k * math.pi / 4) for k in range(8))
        return
    yield orientations(group, column, rng)
    yield other_faces(group, rng)


def _compact(group: Group) -> bool:
    """Whether the group is not long and thin."""
    size = np.sort(group.size)
    return bool(size[2] < LONG * size[1])


def _reach(group: Group) -> float:
    """Largest distance of the group from its root's origin [m]."""
    return max(float(np.linalg.norm(member.vertices, axis=1).max()) for member in group.members)


class _Heap:
    """What is in the container so far, its height map, and the search for the next place."""

    def __init__(
        self,
        container: Placed,
        column: Column,
        obstacles: Sequence[Placed],
        *,
        reach: float,
        gap: float,
        steady: bool,
        above_rim: float,
    ) -> None:
        self.container, self.column, self.gap, self.steady = container, column, gap, steady
        self.above_rim = above_rim
        """How much of the height of a thing on the heap may rise above the rim beyond its upper half."""
        self.placed: list[Group] = []
        self.settled = [container, *obstacles]
        self.cell = max(float(2 * column.reach.max()) / CELLS, 2 * reach / COARSEST)
        self.counts = np.maximum(1, np.round(2 * column.reach / self.cell).astype(int))
        self.corner = column.centre[:2] - self.cell * (self.counts - 1) / 2
        x, y = (self.corner[k] + self.cell * np.arange(self.counts[k]) for k in range(2))
        self.spots = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
        """Positions tried for the root's origin [m], shape (columns, rows, 2)."""
        self.border = int(np.ceil((reach + gap) / self.cell)) + 2
        """Cells of the height map around the spots."""
        columns, rows = (int(count) + 2 * self.border for count in self.counts)
        self.top = np.full((columns, rows), -np.inf)
        self._raise(self.settled)

    def add(self, group: Group) -> None:
        """Count `group` among what is settled."""
        self.placed.append(group)
        self.settled.extend(group.members)
        self._raise(group.members)

    def place(self, group: Group, rotations: Sequence[Array], rng: np.random.Generator) -> Group | None:
        """`group` at the lowest place found over all `rotations`, or None."""
        # Long things lean on walls; whether others tip is asked of the few best places.
        compact = _compact(group)
        picks = _SPREAD_PICKS if self.steady or (compact and self.placed) else _PICKS
        ranked: list[tuple[float, int, Group, Array]] = []
        for rotation in rotations:
            turned = group.turned(rotation)
            heights, cost = self._survey(turned, rng)
            order = np.argsort(cost, axis=None)
            for index in order[picks[picks < len(order)]]:
                i, j = np.unravel_index(index, cost.shape)
                if np.isfinite(cost[i, j]):
                    spot = np.array([*self.spots[i, j], heights[i, j]])
                    ranked.append((float(cost[i, j]), len(ranked), turned, spot))
        best: tuple[float, Group] | None = None
        tries = len(picks)
        for attempt, (_, _, turned, spot) in enumerate(sorted(ranked, key=lambda item: item[:2])):
            if attempt >= 4 * tries or (attempt >= tries and best is not None):
                break
            lowered = lower(turned, spot, self.settled, floor=float(self.container.low[2]), gap=self.gap)
            if lowered is None or not self._deep_enough(np.array(lowered.low[2]), lowered):
                continue
            energy = float(lowered.centre_of_mass[2])
            if self.steady or (compact and self.placed):
                margin = support_margin(lowered, self.settled, gap=self.gap)
                if self.steady and margin <= 0.0:
                    continue
                energy += TIPPING * float(np.clip(-margin, 0.0, 0.5 * np.sort(group.size)[1]))
            if best is None or energy < best[0]:
                best = energy, lowered
        return None if best is None else best[1]

    def _survey(self, turned: Group, rng: np.random.Generator) -> tuple[Array, Array]:
        """Resting height [m] and cost of every spot for one orientation; costs are inf where it may not go."""
        low, high, centre = turned.low, turned.high, turned.centre_of_mass
        before = np.ceil((-low[:2] + self.gap + self.cell) / self.cell).astype(int)
        after = np.ceil((high[:2] + self.gap + self.cell) / self.cell).astype(int)
        shape = tuple(before + after + 1)
        underside = bottom_map(turned.members, -self.cell * before, self.cell, shape, self.gap + self.cell / 2)
        # What is above everything even when the body stands on the floor never decides its height.
        underside[underside > low[2] + float(self.top.max()) - self.container.low[2]] = np.inf
        (i, j), (m, n) = self.border - before, self.counts + np.array(shape) - 1
        heights = resting_heights(self.top[i : i + m, j : j + n], underside)
        heights = np.maximum(heights, self.container.low[2] - low[2]) + self.gap
        reach = self.spots + centre[:2]
        allowed = self.column.holds(reach, 0.85 if self.placed else 0.95)
        allowed &= self._deep_enough(heights + low[2], turned)
        if self.steady:
            # Not beside what carries.
            allowed &= heights + low[2] > self.container.low[2] + 2 * self.gap
        if self.column.capped:
            allowed &= heights + high[2] + self.gap < self.column.rim
        off_axis = np.linalg.norm(reach - self.column.centre[:2], axis=-1)
        cost = heights + centre[2] + CENTRING * off_axis + BALANCING * self._imbalance(turned, reach)
        cost += 1e-4 * rng.random(heights.shape)
        return heights, np.where(allowed, cost, np.inf)

    def _imbalance(self, turned: Group, reach: Array) -> Array:
        """How far off the axis the common centre of mass of the contents would be [m]."""
        moment, mass = np.zeros(2), 0.0
        for member in (member for group in self.placed for member in group.members):
            own = member.body.asset.mass_properties.mass
            moment, mass = moment + own * (member.centre_of_mass[:2] - self.column.centre[:2]), mass + own
        own = sum(member.body.asset.mass_properties.mass for member in turned.members)
        return np.linalg.norm((moment + own * (reach - self.column.centre[:2])) / (mass + own), axis=-1)

    def _deep_enough(self, lowest: Array, group: Group) -> NDArray[np.bool_]:
        """Whether a body with its lowest point at `lowest` [m] is in the cavity, or on a heap that stays in it."""
        column = self.column
        inside = lowest <= column.rim - 0.25 * column.height
        if not self.placed or column.capped or group.size[:2].max() > 2.1 * column.half_size.max():
            return inside
        on_heap = lowest <= column.rim + (self.above_rim - 0.5) * float(group.size[2])
        return on_heap if _compact(group) else inside | on_heap

    def _raise(self, bodies: Sequence[Placed]) -> None:
        origin = self.corner - self.cell * self.border
        columns, rows = (int(count) + 2 * self.border for count in self.counts)
        np.maximum(self.top, top_map(bodies, origin, self.cell, (columns, rows), self.cell / 2), out=self.top)


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
    thin, wide = size[order][:2]
    upright = len(group.members) > 1
    round_about = abs(size[0] - size[1]) < 0.05 * max(size[0], size[1])
    yaws = [start] if round_about and not upright else [0.1 * start / math.pi + k * math.pi / 4 for k in range(4)]
    for yaw in yaws:
        yield yaw_matrix(yaw)
    if upright or _compact(group):
        return
    on_end = _onto_end(group, int(order[2]), _upper_end(group.root, int(order[2]), column.height))
    steepest = min(math.atan2(max(0.0, 2 * column.half_size.min() - 1.2 * wide), column.height), math.radians(50))
    spins = (0.0, math.pi / 2) if thin < 0.6 * wide else (0.0,)
    for share in (1.0, 0.85, 0.6, 0.0):
        lean = about("y", share * steepest)
        for k in range(6 if share else 1):
            for spin in spins:
                yield yaw_matrix(start + k * math.pi / 3) @ lean @ yaw_matrix(spin) @ on_end


def other_faces(group: Group, rng: np.random.Generator) -> Iterator[Array]:
    """Rotations, shape (3, 3), that lay a single thing on its back, front, sides and head, turned four ways."""
    if len(group.members) > 1:
        return
    start = float(rng.uniform(-math.pi, math.pi))
    for axis in ("x", "y"):
        for angle in (-math.pi / 2, math.pi / 2):
            for k in range(4):
                yield yaw_matrix(start + k * math.pi / 4) @ about(axis, angle)
    yield about("x", math.pi)


def _onto_end(group: Group, axis: int, end: float) -> Array:
    """The rotation that takes the `end` (+1 or -1) of the box's `axis` up."""
    if axis == 2:
        return np.eye(3) if end > 0 else about("x", math.pi)
    return about("y", -end * math.pi / 2) if axis == 0 else about("x", end * math.pi / 2)


def _upper_end(body: Placed, axis: int, deep: float) -> float:
    """Which end (+1 or -1) of a long thing belongs up in a cavity `deep` [m].

    The wider one (brush heads, spoon bowls, scissor handles), unless the centre of mass would then stand above the
    rim and the thing could fall out.
    """
    along = body.vertices[:, axis]
    across = np.delete(body.vertices, axis, axis=1)
    middle = (along.min() + along.max()) / 2
    heavy = float(body.centre_of_mass[axis]) - middle
    reach = 0.25 * (along.max() - along.min())
    top, bottom = (
        float(np.prod(np.ptp(across[end * (along - middle) >= reach], axis=0) + 1e-6)) for end in (1.0, -1.0)
    )
    as_made = axis == 2 and abs(top - bottom) < 0.1 * max(top, bottom)
    wide = 1.0 if as_made or top >= bottom else -1.0
    return -wide if heavy * wide > 0.0 and 2 * reach + heavy * wide > deep else wide


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
