"""Where the robot stands, so that its hand gets to everything a task needs.

A scene on the ground is set on a workbench to which the robot is bolted. A scene with a table of its own, or a room,
keeps its floor: the robot stands on a pedestal beside what carries the work.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.hand import hand_pose, hand_rotation
from pat3d.envs.grasping.leaning import LEANING_HOVER, LEANING_MARGIN
from pat3d.envs.grasping.taking import grasps_of
from pat3d.envs.robots.arms import arm_kinematics, measure_gripper
from pat3d.envs.robots.kinematics import ArmKinematics
from pat3d.errors import TaskError
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

RISER = 0.1
"""Least height of the robot's base above the surface of the work [m]."""

ABOVE_WORK = 0.2
"""Least height of a short arm's hand at the start above the surface of the work [m]; its base rises for that."""

SHORT = 0.7
"""Arms shorter than this [m] stand nearer to their work, in proportion."""

HIGHEST_BASE = 1.4
"""[m] above the floor."""

BASE_RADIUS = 0.16
"""Kept free around the robot's base [m]."""

HOVER = 0.1
"""The hand gets this far above every grasp [m]."""

LIFTED = 0.15
"""A leaning hand gets this far above its grasp [m]."""

DIRECTIONS = (90.0, 180.0, 0.0, 270.0, 135.0, 45.0, 225.0, 315.0)
"""Where to stand as seen from the work [degrees]: behind it, facing the viewer, first."""

DISTANCES = (0.0, -0.08, 0.08, 0.16, -0.16, 0.24)
"""Tried around the comfortable distance [m]."""


@dataclass(frozen=True, kw_only=True)
class Needs:
    """What a task asks of the robot's hand."""

    grasp: tuple[str, ...] = ()
    """Objects to take."""
    visit: tuple[tuple[float, float, float], ...] = ()
    """Points [m] that the fingertips have to get to, pointing down."""
    cleared: bool = False
    """Whether the objects are taken one after the other, so that what was taken is no longer in the way."""


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Where a scene stands and where its robot is bolted."""

    base_position: tuple[float, float, float]
    """Of the robot's base [m]."""
    yaw: float
    """Direction in which the robot faces [rad], about z from +x."""
    bench: tuple[tuple[float, float], tuple[float, float]] | None
    """Lower and upper corner of the workbench's top [m], whose surface is z = 0; None for a scene on the floor."""
    host: str | None
    """The object that carries the work, where it is not the ground itself."""
    surface: float
    """Height of the surface that the work stands on [m]."""
    floor: float
    """Height of the floor [m]."""
    focus: tuple[float, float, float]
    """Middle of the work [m], where the cameras look."""
    focus_radius: float
    """Half of the largest horizontal extent of the work [m]."""
    start: tuple[float, ...]
    """Joint positions of the arm at the start [rad]."""
    grasps: Mapping[str, tuple[Grasp, ...]] = field(default_factory=dict)
    """Grasps of every object of the task that are within reach, best first; objects in the order of taking them."""
    reach: Mapping[str, float] = field(default_factory=dict)
    """Horizontal distance of every object of the task from the base [m]."""
    pedestal_radius: float = 0.1
    """[m]"""

    def describe(self) -> str:
        """One sentence on where the robot stands and why."""
        x, y, z = self.base_position
        where = "on a workbench" if self.bench is not None else f'beside "{self.host}"' if self.host else "on the floor"
        reached = ", ".join(f'"{name}" at {distance:.2f} m' for name, distance in self.reach.items())
        return (
            f"base {where} at ({x:.2f}, {y:.2f}, {z:.2f}) m, facing {math.degrees(self.yaw):.0f} degrees; "
            f"reaches {reached or 'the work area'}"
        )


def place(scene: Scene, robot: str, needs: Needs) -> Placement:
    """Where `robot` stands to do what a task needs in `scene`.

    Raises:
        TaskError: an object is too wide for the gripper, is blocked, or nothing that is needed is in reach.
    """
    gripper = measure_gripper(robot)
    grasps = grasps_of(scene, needs.grasp, robot, put=bool(needs.visit), cleared=needs.cleared)
    site = _Site.of(scene, needs)
    arm = arm_kinematics(robot)
    hand, _ = arm.hand(arm.robot.home)
    scale = min(1.0, arm.length / SHORT)
    standing = _Standing(
        away=float(np.hypot(hand[0], hand[1])) + 0.1 * scale,
        riser=RISER if scale == 1.0 else max(RISER, ABOVE_WORK - float(hand[2])),
        scale=scale,
    )
    farthest: dict[str, tuple[float, float, float]] = {}
    for position, yaw in site.candidates(standing):
        frame = _Frame(position, yaw)
        reached: dict[str, tuple[Grasp, ...]] = {}
        for name, found in grasps.items():
            tried = (_reached(arm, frame, one, gripper.tip, gripper.closing_axis) for one in frame.ordered(found))
            reached[name] = tuple(one for one in tried if one is not None)
            if not reached[name]:
                aside, up = math.dist(position[:2], found[0].position[:2]), found[0].position[2] - position[2]
                farthest[name] = min(farthest.get(name, (math.inf, 0.0, 0.0)), (math.hypot(aside, up), aside, up))
                break
        else:
            if all(_reaches_point(arm, frame, np.array(point), gripper.tip) for point in needs.visit):
                return site.placement(arm, frame, reached, gripper.tip)
    if farthest:
        name, (_, aside, up) = max(farthest.items(), key=lambda item: item[1])
        height = f"{abs(up):.2f} m {'above' if up > 0.0 else 'below'}"
        raise TaskError(
            f'"{name}" is out of reach of {robot}: at best {aside:.2f} m beside and {height} a base that has room to '
            f"stand; choose another object or a smaller scene."
        )
    if not any(True for _ in site.candidates(standing)):
        raise TaskError(f"{robot} finds no free place to stand near {site.describe()}.")
    raise TaskError(f"{robot} cannot bring its hand to every point of the task near {site.describe()}.")


@dataclass(frozen=True, kw_only=True)
class _Standing:
    """How an arm likes to stand."""

    away: float
    """From its work [m]."""
    riser: float
    """Height of its base above the surface of the work [m]."""
    scale: float
    """Of the room that it takes, 1 for arms of usual size."""


@dataclass(frozen=True)
class _Frame:
    """The robot's base in the world."""

    position: tuple[float, float, float]
    yaw: float

    def local(self, point: Array) -> Array:
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


def _reached(
    arm: ArmKinematics, frame: _Frame, grasp: Grasp, tip: float, closing_axis: Sequence[float]
) -> Grasp | None:
    """The grasp, with its fingers the way round in which a leaning hand gets there best; None where it does not."""
    best, most = None, LEANING_MARGIN
    for half in (0.0, math.pi):
        back = LEANING_HOVER if grasp.lean else HOVER
        before = hand_pose(grasp, tip, closing_axis, back=back, half=half)
        poses = [before, hand_pose(grasp, tip, closing_axis, half=half)]
        if grasp.lean:
            # Above the place where the approach begins, and where the object is held up.
            (x, y, z), rotation = before
            poses = [
                (np.array([x, y, z + HOVER]), rotation),
                *poses,
                hand_pose(grasp.lifted(LIFTED), tip, closing_axis, half=half),
            ]
        joints: Array | None = None
        margin = math.inf
        for position, rotation in poses:
            joints = arm.solve(frame.local(position), frame.turned(rotation), joints)
            if joints is None:
                break
            margin = min(margin, arm.margin(joints))
        else:
            if not grasp.lean:
                return grasp
            if margin > most:
                best, most = replace(grasp, closing=grasp.closing + half), margin
    return best


def _reaches_point(arm: ArmKinematics, frame: _Frame, point: Array, tip: float) -> bool:
    at = frame.local(point + [0.0, 0.0, tip])
    axis = measure_gripper(arm.robot.name).closing_axis
    return any(
        arm.solve(at, hand_rotation(turn, axis)) is not None for turn in (math.pi / 2, 0.0, -math.pi / 2, math.pi)
    )


@dataclass(frozen=True, eq=False)
class _Site:
    """What the scene leaves of room for a robot."""

    boxes: Mapping[str, tuple[Array, Array]]
    """Bounding box of every object [m]."""
    bench: bool
    host: str | None
    surface: float
    focus: Array
    middle: Array
    """Middle of what the task is about [m]."""
    view: Array
    """Middle of what the cameras show [m]."""
    radius: float
    work: tuple[str, ...]

    @staticmethod
    def of(scene: Scene, needs: Needs) -> _Site:
        boxes = {}
        for obj in scene.objects:
            points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
            boxes[obj.name] = (points.min(axis=0), points.max(axis=0))
        low = np.min([box[0] for box in boxes.values()], axis=0)
        high = np.max([box[1] for box in boxes.values()], axis=0)
        work = needs.grasp or tuple(boxes)
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
        shown_low = np.min([boxes[name][0] for name in beside], axis=0)
        shown_high = np.max([boxes[name][1] for name in beside], axis=0)
        return _Site(
            boxes=boxes,
            bench=bench,
            host=host,
            surface=max(surface, 0.0),
            # On a workbench the same place serves every task of a scene, where it can.
            focus=np.array([*((low + high) / 2)[:2], middle[2]]) if bench else middle,
            middle=middle,
            view=np.array([*((shown_low + shown_high) / 2)[:2], middle[2]]),
            radius=float((shown_high - shown_low)[:2].max()) / 2,
            work=work,
        )

    def describe(self) -> str:
        return ", ".join(f'"{name}"' for name in self.work)

    def candidates(self, standing: _Standing) -> Iterator[tuple[tuple[float, float, float], float]]:
        """Places for the base [m] and the direction it faces [rad], best first."""
        height = self.surface + standing.riser
        if height > HIGHEST_BASE:
            return
        for direction in DIRECTIONS:
            angle = math.radians(direction)
            for centre in (self.focus, self.middle) if self.bench else (self.middle,):
                for change in DISTANCES:
                    away = standing.away + standing.scale * change
                    x, y = centre[0] + away * math.cos(angle), centre[1] + away * math.sin(angle)
                    if away > 0.25 * standing.scale and self._free(x, y, height, BASE_RADIUS * standing.scale):
                        yield (float(x), float(y), height), angle % (2 * math.pi) - math.pi

    def _free(self, x: float, y: float, height: float, radius: float) -> bool:
        for low, high in self.boxes.values():
            # A low object may stand where only the base's riser would be above it, but not on a workbench.
            beside = np.hypot(max(low[0] - x, 0.0, x - high[0]), max(low[1] - y, 0.0, y - high[1]))
            if beside < radius and low[2] < height + 0.5:
                return False
        return True

    def placement(
        self, arm: ArmKinematics, frame: _Frame, grasps: dict[str, tuple[Grasp, ...]], tip: float
    ) -> Placement:
        """The placement with its workbench and a start posture above everything near the hand."""
        bench = None
        if self.bench:
            low = np.min([box[0][:2] for box in self.boxes.values()], axis=0)
            high = np.max([box[1][:2] for box in self.boxes.values()], axis=0)
            base = np.array(frame.position[:2])
            low, high = np.minimum(low, base) - BENCH_RIM, np.maximum(high, base) + BENCH_RIM
            bench = ((float(low[0]), float(low[1])), (float(high[0]), float(high[1])))
        centre = {name: (self.boxes[name][0] + self.boxes[name][1]) / 2 for name in grasps}
        return Placement(
            base_position=frame.position,
            yaw=frame.yaw,
            bench=bench,
            host=self.host,
            surface=self.surface,
            floor=-BENCH_HEIGHT if self.bench else 0.0,
            focus=(float(self.view[0]), float(self.view[1]), float(self.view[2])),
            focus_radius=self.radius,
            start=tuple(map(float, self._start(arm, frame, tip))),
            grasps=grasps,
            reach={name: math.dist(frame.position[:2], middle[:2]) for name, middle in centre.items()},
        )

    def _start(self, arm: ArmKinematics, frame: _Frame, tip: float) -> Array:
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


def _root(scene: Scene, name: str) -> str:
    """What stands on the ground and carries `name`, which may be `name` itself."""
    while (parent := scene.parent(name)) != GROUND:
        name = parent
    return name
