"""What room a scene leaves for a robot: where its base may stand, what it starts above, and the workbench."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.standing import Needs, Placement, Stand
from pat3d.envs.robots.kinematics import ArmKinematics
from pat3d.envs.robots.pairs import Pair
from pat3d.scene.model import GROUND, Scene

Array = NDArray[np.float64]

BENCH_HEIGHT = 0.8
"""Of the workbench's top above the floor [m]."""

BENCH_LIMIT = (1.6, 1.2)
"""Scenes wider or deeper than this [m] do not stand on a workbench."""

BENCH_RIM = 0.2
"""Of free workbench around everything [m]."""

BENCH_TALLEST = 1.0
"""Scenes higher than this [m] do not stand on a workbench."""

HIGHEST_BASE = 1.4
"""[m] above the floor."""

BASE_RADIUS = 0.16
"""Kept free around the robot's base [m]."""

DIRECTIONS = (90.0, 180.0, 0.0, 270.0, 135.0, 45.0, 225.0, 315.0)
"""Where to stand as seen from the work [degrees]: behind it, facing the viewer, first."""

ASIDE = (0.0, 30.0, -30.0, 55.0, -55.0)
"""By how much the robot may stand aside of where a task needs it [degrees]."""

DISTANCES = (0.0, -0.08, 0.08, 0.16, -0.16, 0.24)
"""Tried around the comfortable distance [m]."""


APART = 0.6
"""Between the bases of two arms side by side [m], in proportion for short ones."""

SIDESTEPS = (0.0, 0.15, -0.15, 0.3, -0.3)
"""By which two arms are moved sideways from the middle of the work [m]."""


@dataclass(frozen=True, kw_only=True)
class Standing:
    """How an arm likes to stand."""

    away: float
    """From its work [m]."""
    riser: float
    """Height of its base above the surface of the work [m]."""
    scale: float
    """Of the room that it takes, 1 for arms of usual size."""


@dataclass(frozen=True)
class Frame:
    """The robot's base in the world."""

    position: tuple[float, float, float]
    yaw: float

    def local(self, point: Array) -> Array:
        """A point of the world [m] in the frame of the base, shape (3,)."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        x, y, z = point - np.array(self.position)
        return np.array([c * x + s * y, -s * x + c * y, z])

    def ordered(self, grasps: Sequence[Grasp]) -> list[Grasp]:
        """Grasps from above as they are; of those that lean, the ones first for which the hand comes from the robot."""

        def worth(grasp: Grasp) -> float:
            x, y = np.array(self.position[:2]) - grasp.position[:2]
            return grasp.score + math.cos(grasp.heading - math.atan2(y, x))

        return sorted(grasps, key=worth, reverse=True) if any(one.lean for one in grasps) else list(grasps)

    def turned(self, rotation: Array) -> Array:
        """A rotation of the world as the base sees it, shape (3, 3)."""
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]]) @ rotation


@dataclass(frozen=True, eq=False)
class Site:
    """What the scene leaves of room for a robot."""

    boxes: Mapping[str, tuple[Array, Array]]
    """Bounding box of every object [m]."""
    bench: bool
    host: str | None
    surface: float
    focus: Array
    middle: Array
    """Middle of what the task is about [m]."""
    shown: tuple[str, ...]
    """What the cameras show."""
    work: tuple[str, ...]
    visit: tuple[tuple[float, float, float], ...]
    room: tuple[tuple[float, float], ...]
    """What a workbench has to reach beside the objects [m]."""
    swept: tuple[tuple[float, float], ...]
    """See `Needs`."""
    directions: tuple[float, ...]
    """From which the robot may face the work [degrees], the preferred one first."""

    @staticmethod
    def of(scene: Scene, needs: Needs) -> Site:
        """What a scene leaves for what a task needs."""
        boxes = {}
        for obj in scene.objects:
            points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
            boxes[obj.name] = (points.min(axis=0), points.max(axis=0))
        low = np.min([box[0] for box in boxes.values()], axis=0)
        high = np.max([box[1] for box in boxes.values()], axis=0)
        work = (*needs.grasp, *needs.push) or tuple(boxes)
        support = max(float(boxes[name][0][2]) for name in work)
        fits = bool(high[0] - low[0] <= BENCH_LIMIT[0] and high[1] - low[1] <= BENCH_LIMIT[1])
        bench = fits and float(high[2]) <= BENCH_TALLEST and support < 0.4
        roots = {_root(scene, name) for name in work}
        host = None if bench else next((name for name in sorted(roots) if name not in work), None)
        points = [*needs.visit, *((boxes[name][0] + boxes[name][1]) / 2 for name in work)]
        middle = np.mean(points, axis=0)
        surface = 0.0 if bench else min(float(boxes[name][0][2]) for name in work)
        # On a table the cameras show everything on it; in a room, what the task is about.
        beside = {name for name in boxes if bench or (name != host and _root(scene, name) == host)} | set(work)
        return Site(
            boxes=boxes,
            bench=bench,
            host=host,
            surface=max(surface, 0.0),
            # On a workbench the same place serves every task of a scene, where it can.
            focus=np.array([*((low + high) / 2)[:2], middle[2]]) if bench else middle,
            middle=middle,
            shown=tuple(name for name in boxes if name in beside),
            work=work,
            visit=needs.visit,
            room=needs.room,
            swept=needs.swept,
            directions=_directions(needs),
        )

    def describe(self) -> str:
        """The objects that are worked on."""
        return ", ".join(f'"{name}"' for name in self.work)

    def candidates(self, standing: Standing) -> Iterator[tuple[tuple[float, float, float], float]]:
        """Places for the base [m] and the direction it faces [rad], best first."""
        height = self.surface + standing.riser
        if height > HIGHEST_BASE:
            return
        for direction in self.directions:
            angle = math.radians(direction)
            for centre in (self.focus, self.middle) if self.bench else (self.middle,):
                for change in DISTANCES:
                    away = standing.away + standing.scale * change
                    x, y = centre[0] + away * math.cos(angle), centre[1] + away * math.sin(angle)
                    if away > 0.25 * standing.scale and self._free((x, y, height), BASE_RADIUS * standing.scale):
                        yield (float(x), float(y), height), angle % (2 * math.pi) - math.pi

    def _free(self, base: tuple[float, float, float], radius: float) -> bool:
        x, y, height = base
        for low, high in self.boxes.values():
            # A low object may stand where only the base's riser would be above it, but not on a workbench.
            beside = np.hypot(max(low[0] - x, 0.0, x - high[0]), max(low[1] - y, 0.0, y - high[1]))
            if beside < radius and low[2] < height + 0.5:
                return False
        return all(math.dist((x, y), point) >= radius for point in self.swept)

    def pairs(self, left: Standing, right: Standing, pair: Pair) -> Iterator[tuple[tuple[Frame, Frame], float]]:
        """Where two arms may stand, the left one first, and where the cameras are as seen from the work [rad].

        Arms side by side stand on one side of the work, opposite to the cameras; of arms that face each other the left
        one stands to the left of who looks through the cameras.
        """
        both = (left, right)
        scale = max(left.scale, right.scale)
        if self.surface + max(left.riser, right.riser) > HIGHEST_BASE:
            return
        centres = (self.focus, self.middle) if self.bench else (self.middle,)
        for direction, centre, aside, change in product(self.directions, centres, SIDESTEPS, DISTANCES):
            angle = math.radians(direction)
            away = np.array([math.cos(angle), math.sin(angle)])
            # To the left of an arm that stands there and faces the work.
            across, yaw = np.array([away[1], -away[0]]), angle % (2 * math.pi) - math.pi
            frames = []
            for one, sign in zip(both, (1.0, -1.0), strict=True):
                if pair.facing is None:
                    offset = (one.away + one.scale * change) * away
                    offset = offset + (scale * aside + sign * scale * APART / 2) * across
                    faces = yaw
                else:
                    # The cameras are where such an arm would face, and their left is its right.
                    offset = scale * change * away - (scale * aside + sign * pair.facing / 2) * across
                    faces = math.atan2(sign * across[1], sign * across[0])
                x, y = centre[:2] + offset
                frames.append(Frame((float(x), float(y), self.surface + one.riser), faces))
            free = [
                self._free(frame.position, BASE_RADIUS * one.scale) for frame, one in zip(frames, both, strict=True)
            ]
            if all(free):
                yield (frames[0], frames[1]), yaw

    def placement(
        self,
        arm: ArmKinematics,
        frame: Frame,
        grasps: dict[str, tuple[Grasp, ...]],
        tip: float,
        other: Stand | None = None,
    ) -> Placement:
        """The placement with its workbench and a start posture above everything near the hand."""
        bench = None
        if self.bench:
            low = np.min([box[0][:2] for box in self.boxes.values()], axis=0)
            high = np.max([box[1][:2] for box in self.boxes.values()], axis=0)
            for point in (frame.position, *(() if other is None else (other.base_position,)), *self.room):
                low, high = np.minimum(low, np.array(point[:2])), np.maximum(high, np.array(point[:2]))
            low, high = low - BENCH_RIM, high + BENCH_RIM
            bench = ((float(low[0]), float(low[1])), (float(high[0]), float(high[1])))
        centre = {name: (self.boxes[name][0] + self.boxes[name][1]) / 2 for name in grasps}
        return Placement(
            base_position=frame.position,
            yaw=frame.yaw,
            bench=bench,
            host=self.host,
            surface=self.surface,
            floor=-BENCH_HEIGHT if self.bench else 0.0,
            shown=self.shown,
            start=tuple(map(float, self.start(arm, frame, tip))),
            grasps=grasps,
            visit=self.visit,
            reach={name: math.dist(frame.position[:2], middle[:2]) for name, middle in centre.items()},
            other=other,
        )

    def start(self, arm: ArmKinematics, frame: Frame, tip: float) -> Array:
        """The posture that robosuite starts in, or the hand raised above what it would touch there."""
        home = arm.robot.home
        hand, rotation = arm.hand(home)
        c, s = math.cos(frame.yaw), math.sin(frame.yaw)
        x, y = frame.position[0] + c * hand[0] - s * hand[1], frame.position[1] + s * hand[0] + c * hand[1]
        under = [
            float(high[2])
            for low, high in self.boxes.values()
            if np.hypot(max(low[0] - x, 0.0, x - high[0]), max(low[1] - y, 0.0, y - high[1])) < 0.2
        ]
        wanted = max([self.surface, *under]) + tip + 0.08 - frame.position[2]
        if hand[2] >= wanted:
            return home
        for height in np.arange(wanted, hand[2], -0.05):
            joints = arm.solve(np.array([hand[0], hand[1], height]), rotation, home)
            if joints is not None:
                return joints
        return home


def _directions(needs: Needs) -> tuple[float, ...]:
    """From which the robot may face its work [degrees], the preferred one first."""
    if needs.side is not None:
        side = math.degrees(needs.side)
        return tuple(side + turn for turn in ASIDE)
    return DIRECTIONS[:1] if needs.facing else DIRECTIONS


def _root(scene: Scene, name: str) -> str:
    """What stands on the ground and carries `name`, which may be `name` itself."""
    while (parent := scene.parent(name)) != GROUND:
        name = parent
    return name
