"""Where something may be pushed: to a point, by a distance, to an edge of the table, next to something else.

Left, right, front and back are those of the scene: a viewer at -y looks along +y.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array, corners
from pat3d.errors import TaskError

if TYPE_CHECKING:
    from pat3d.envs.physics.state import States

SIDES = {"left": (-1.0, 0.0), "right": (1.0, 0.0), "front": (0.0, -1.0), "back": (0.0, 1.0)}
"""Directions in the plane of the table."""

THERE = 0.04
"""An object whose centre of mass is this near to its point, seen from above, is there [m]."""

AT_EDGE, AIMED_AT_EDGE = 0.06, 0.03
"""An object this near to an edge of the table is at it, and how near it is pushed [m]."""

NEXT, AIMED_NEXT = 0.06, 0.025
"""An object this near to another, seen from above, is next to it, and how near it is pushed [m]."""

SHORTEST, LONGEST = 5, 60
"""Of a distance [cm]."""

AROUND = 96
"""Directions in which outlines are compared: of a face 20 cm long a gap is seen as up to 7 mm smaller than it is."""

_ANGLES = 2.0 * math.pi * np.arange(AROUND) / AROUND
DIRECTIONS = np.column_stack([np.cos(_ANGLES), np.sin(_ANGLES), np.zeros(AROUND)])
"""Shape (AROUND, 3); the opposite of one is AROUND / 2 further on."""

SIDES_TRIED = 16
"""Of an object next to which something is pushed."""

_HALVINGS = 24
_SHIFT = re.compile(r"(\d{1,2}) cm (left|right|front|back)")


class Outlook(NamedTuple):
    """What has to be known to say where an object should be pushed, seen from above."""

    own: Array
    """Corners of the object [m], shape (n, 2)."""
    centre: Array
    """Its centre of mass [m], shape (2,)."""
    start: Array
    """Where that was at the start of the episode [m]."""
    other: Array | None
    """Corners of what it should get next to [m], shape (m, 2)."""
    bench: tuple[tuple[float, float], tuple[float, float]] | None
    """Lower and upper corner of the workbench [m]."""


Measure = Callable[[], tuple[Array, Array]]
"""How much further the object of every world has to get [m], shape (worlds,), not positive where it is there, and where
its centre should get to [m], shape (worlds, 2)."""


class Where(Protocol):
    """A place to push something to."""

    @property
    def text(self) -> str:
        """As the task's specification has it."""
        ...

    @property
    def names(self) -> tuple[str, ...]:
        """Objects that it is about."""
        ...

    def words(self, *names: str) -> str:
        """As one tells it to a person who knows those objects by `names`."""
        ...

    def ways(self, outlook: Outlook) -> list[Array]:
        """By which the object may be moved so that it is there [m], shape (2,), best first; none when it is."""
        ...

    def measure(self, states: States, target: str) -> Measure:
        """The same for judging all worlds at once."""
        ...


@dataclass(frozen=True, kw_only=True)
class Spot:
    """To a point, as a goal picture shows it."""

    at: tuple[float, float]
    """Of the centre of mass, seen from above, in the frame of the scene [m]."""

    @property
    def text(self) -> str:
        """See `Where`."""
        return f"@{self.at[0]:g},{self.at[1]:g}"

    @property
    def names(self) -> tuple[str, ...]:
        """See `Where`."""
        return ()

    def words(self, *names: str) -> str:
        """See `Where`."""
        return "to where the goal picture shows it"

    def ways(self, outlook: Outlook) -> list[Array]:
        """See `Where`."""
        return _unless_there(np.array(self.at) - outlook.centre)

    def measure(self, states: States, target: str) -> Measure:
        """See `Where`."""
        body, at = states.bodies[states.numbers[target]], np.array(self.at)
        return lambda: _to_point(states.snapshot.xipos[:, body, :2], np.broadcast_to(at, (states.count, 2)))


@dataclass(frozen=True, kw_only=True)
class Shift:
    """By a distance from where it stands at the start."""

    centimetres: int
    side: str

    @property
    def text(self) -> str:
        """See `Where`."""
        return f"{self.centimetres} cm {self.side}"

    @property
    def names(self) -> tuple[str, ...]:
        """See `Where`."""
        return ()

    def words(self, *names: str) -> str:
        """See `Where`."""
        to = f"to the {self.side}" if self.side in ("left", "right") else f"towards the {self.side} of the table"
        return f"{self.centimetres} cm {to}"

    @property
    def _by(self) -> Array:
        return self.centimetres / 100.0 * np.array(SIDES[self.side])

    def ways(self, outlook: Outlook) -> list[Array]:
        """See `Where`."""
        return _unless_there(outlook.start + self._by - outlook.centre)

    def measure(self, states: States, target: str) -> Measure:
        """See `Where`."""
        number = states.numbers[target]
        body = states.bodies[number]

        def measured() -> tuple[Array, Array]:
            now = states.snapshot
            return _to_point(now.xipos[:, body, :2], now.start_centre[:, number, :2] + self._by)

        return measured


@dataclass(frozen=True, kw_only=True)
class Edge:
    """To an edge of the workbench."""

    side: str

    @property
    def text(self) -> str:
        """See `Where`."""
        return f"{self.side} edge"

    @property
    def names(self) -> tuple[str, ...]:
        """See `Where`."""
        return ()

    def words(self, *names: str) -> str:
        """See `Where`."""
        return f"to the {self.side} edge of the table"

    def _short(self, reach: Array | float, bench: tuple[tuple[float, float], tuple[float, float]]) -> Array | float:
        """How far what reaches to `reach` along the side's direction is from the edge [m]."""
        along = np.array(SIDES[self.side])
        return float(np.array(bench[int(along.sum() > 0.0)]) @ along) - reach

    def ways(self, outlook: Outlook) -> list[Array]:
        """See `Where`."""
        along = np.array(SIDES[self.side])
        if outlook.bench is None:
            return []
        short = float(self._short(float((outlook.own @ along).max()), outlook.bench))
        return [] if short <= AT_EDGE else [(short - AIMED_AT_EDGE) * along]

    def measure(self, states: States, target: str) -> Measure:
        """See `Where`."""
        bench = states.world.placement.bench
        if bench is None:
            raise TaskError("edges are those of a workbench, and the scene has a table of its own.")
        body, own = states.bodies[states.numbers[target]], corners(states.world.scene[target].asset)
        along = np.array([[*SIDES[self.side], 0.0]])

        def measured() -> tuple[Array, Array]:
            now = states.snapshot
            short = np.asarray(self._short(predicates.supports(now, body, own, along)[:, 0], bench))
            return short - AT_EDGE, now.xipos[:, body, :2] + (short - AIMED_AT_EDGE)[:, None] * along[0, :2]

        return measured


@dataclass(frozen=True, kw_only=True)
class Touching:
    """Next to another object, or touching it."""

    name: str

    @property
    def text(self) -> str:
        """See `Where`."""
        return self.name

    @property
    def names(self) -> tuple[str, ...]:
        """See `Where`."""
        return (self.name,)

    def words(self, *names: str) -> str:
        """See `Where`."""
        return f"next to {names[0]}"

    def ways(self, outlook: Outlook) -> list[Array]:
        """See `Where`; from several sides, the nearest first."""
        if outlook.other is None or separation(outlook.own, outlook.other) <= NEXT:
            return []
        middle = (outlook.other.min(axis=0) + outlook.other.max(axis=0)) / 2
        found = []
        for direction in DIRECTIONS[:: AROUND // SIDES_TRIED, :2]:
            # Far enough out along this direction the two are apart; the nearest place that leaves the aimed gap.
            low, high = 0.0, float(np.ptp(outlook.own, axis=0).sum() + np.ptp(outlook.other, axis=0).sum())
            for _ in range(_HALVINGS):
                far = (low + high) / 2
                way = middle + far * direction - outlook.centre
                low, high = (low, far) if separation(outlook.own + way, outlook.other) > AIMED_NEXT else (far, high)
            found.append(middle + high * direction - outlook.centre)
        return sorted(found, key=lambda way: float(np.linalg.norm(way)))

    def measure(self, states: States, target: str) -> Measure:
        """See `Where`."""
        scene = states.world.scene
        (body, own), (other, its) = (
            (states.bodies[states.numbers[name]], hull(corners(scene[name].asset))) for name in (target, self.name)
        )

        def measured() -> tuple[Array, Array]:
            now = states.snapshot
            reach = predicates.supports(now, body, own, DIRECTIONS)
            facing = np.roll(predicates.supports(now, other, its, DIRECTIONS), AROUND // 2, axis=1)
            apart = (-facing - reach).max(axis=1)
            towards = now.xipos[:, other, :2] - now.xipos[:, body, :2]
            towards /= np.maximum(np.linalg.norm(towards, axis=1), 1e-9)[:, None]
            return apart - NEXT, now.xipos[:, body, :2] + np.maximum(apart - AIMED_NEXT, 0.0)[:, None] * towards

        return measured


def hull(points: Array) -> Array:
    """Those of points that no plane leaves inside, shape (n, 3)."""
    from scipy.spatial import ConvexHull

    return points[ConvexHull(points).vertices]


def where_to(text: str) -> Where:
    """The place that `text` means: "right edge", "20 cm left", or the name of an object.

    Raises:
        TaskError: a distance that is too short or too long.
    """
    side, _, edge = text.rpartition(" ")
    if edge == "edge" and side in ("left", "right", "front"):
        return Edge(side=side)
    shift = _SHIFT.fullmatch(text)
    if shift is None:
        return Touching(name=text)
    centimetres = int(shift[1])
    if not SHORTEST <= centimetres <= LONGEST:
        raise TaskError(f"things are pushed by {SHORTEST} to {LONGEST} cm, not {centimetres}.")
    return Shift(centimetres=centimetres, side=shift[2])


def separation(first: Array, second: Array) -> float:
    """Between the hulls of points in the plane [m], as `AROUND` directions see it; negative where they overlap."""
    flat = DIRECTIONS[:, :2]
    return float(((second @ flat.T).min(axis=0) - (first @ flat.T).max(axis=0)).max())


def _unless_there(way: Array) -> list[Array]:
    # Half the tolerance: what a judge in single precision sees must not hang on rounding.
    return [] if float(np.linalg.norm(way)) <= THERE / 2 else [way]


def _to_point(centre: Array, at: Array) -> tuple[Array, Array]:
    return np.linalg.norm(at - centre, axis=1) - THERE, at
