"""Where the robot stands, so that its hand gets to everything a task needs.

A scene on the ground is set on a workbench to which the robot is bolted. A scene with a table of its own, or a room,
keeps its floor: the robot stands on a pedestal beside what carries the work. Two arms stand so that one of them gets to
everything; the nearer one is asked first.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.hand import hand_pose, hand_rotation
from pat3d.envs.grasping.leaning import LEANING_HOVER, LEANING_MARGIN
from pat3d.envs.grasping.pairwise import paired_grasps
from pat3d.envs.grasping.site import Frame, Site, Standing
from pat3d.envs.grasping.standing import Needs, Placement, Stand
from pat3d.envs.grasping.taking import grasps_of
from pat3d.envs.robots.arms import arm_kinematics, measure_gripper
from pat3d.envs.robots.kinematics import ArmKinematics
from pat3d.envs.robots.pairs import SIDES, Pair, pair_of
from pat3d.envs.robots.robot import Gripper
from pat3d.errors import TaskError
from pat3d.scene.model import Scene

Array = NDArray[np.float64]

HOVER = 0.1
"""The hand gets this far above every grasp [m]."""

LIFTED = 0.15
"""A leaning hand gets this far above its grasp [m]."""

ABOVE_WORK = 0.2
"""Least height of a short arm's hand at the start above the surface of the work [m]; its base rises for that."""

SHORT = 0.7
"""Arms shorter than this [m] stand nearer to their work, in proportion."""

RISER = 0.1
"""Least height of the robot's base above the surface of the work [m]."""

ALONG_MARGIN = 0.08
"""Least distance of every joint from its limits where a hand goes along the front of something [rad]."""

ACROSS = 0.9
"""By how much the cameras are aside of a robot that has to stand in front of something [rad]."""

TOGETHER_TRIED = 12
"""Pairs of grasps that are tried for two arms where they may stand, and kept, at most."""

PAIRS_TRIED = 240
"""Places of two arms that are tried, at most."""


def place(scene: Scene, robot: str, needs: Needs) -> Placement:
    """Where `robot`, one arm or two, stands to do what a task needs in `scene`.

    Raises:
        TaskError: an object is too wide for the gripper, is blocked, or nothing that is needed is in reach.
    """
    pair = pair_of(robot)
    if needs.together:
        return _place_together(scene, robot, pair, needs)
    if pair is not None:
        return _place_pair(scene, robot, pair, needs)
    reach = _Reach.of(scene, robot, needs)
    site = Site.of(scene, needs)
    for position, yaw in site.candidates(reach.standing):
        frame = Frame(position, yaw)
        reached = reach.at(frame)
        if reached is not None:
            found = site.placement(reach.arm, frame, reached | dict.fromkeys(needs.push, ()), reach.tip)
            return found if needs.side is None else replace(found, view=needs.side + ACROSS)
    raise reach.refusal(robot, site, any(True for _ in site.candidates(reach.standing)))


def _place_pair(scene: Scene, robot: str, pair: Pair, needs: Needs) -> Placement:
    """The same of two arms: the first place from which one of them gets to everything."""
    reaches: list[_Reach | None] = []
    refused: list[TaskError] = []
    for name in pair.arms:
        try:
            reaches.append(_Reach.of(scene, name, needs))
        except TaskError as error:
            reaches.append(None)
            refused.append(error)
    if len(refused) == len(pair.arms):
        raise refused[0]
    site = Site.of(scene, needs)
    left, right = (_standing(arm_kinematics(name)) for name in pair.arms)
    room = False
    for frames, view in islice(site.pairs(left, right, pair), PAIRS_TRIED):
        room = True
        nearer = sorted((0, 1), key=lambda side: math.dist(frames[side].position[:2], site.middle[:2]))
        for side in nearer:
            reach = reaches[side]
            reached = None if reach is None else reach.at(frames[side])
            if reach is None or reached is None:
                continue
            idle, name = 1 - side, pair.arms[1 - side]
            start = site.start(arm_kinematics(name), frames[idle], measure_gripper(name).tip)
            other = Stand(
                robot=name,
                side=SIDES[idle],
                base_position=frames[idle].position,
                yaw=frames[idle].yaw,
                start=tuple(map(float, start)),
            )
            about = reached | dict.fromkeys(needs.push, ())
            found = site.placement(reach.arm, frames[side], about, reach.tip, other)
            return replace(found, robot=pair.arms[side], side=SIDES[side], view=view)
    known = next(reach for reach in reaches if reach is not None)
    raise known.refusal(robot, site, room)


def _place_together(scene: Scene, robot: str, pair: Pair | None, needs: Needs) -> Placement:
    """Of two arms that take one object at once: the first place from which each gets to its own end of it."""
    name = needs.grasp[0]
    if pair is None:
        raise TaskError(f'"{name}" is taken by two arms, and {robot} is one; give two, as "panda+panda".')
    both = paired_grasps(scene, name, pair.arms, wide=needs.together == "wide")
    arms = tuple(arm_kinematics(one) for one in pair.arms)
    grippers = tuple(measure_gripper(one) for one in pair.arms)
    site = Site.of(scene, needs)
    for frames, view in islice(site.pairs(_standing(arms[0]), _standing(arms[1]), pair), PAIRS_TRIED):
        # Hands that crossed one another would meet on the way.
        apart = [one for one in both if not _crossed(frames, *one)]
        reached = [one for one in apart[:TOGETHER_TRIED] if _both_reach(frames, one, arms, grippers)]
        if not reached:
            continue
        lefts, rights = zip(*reached, strict=True)
        other = Stand(
            robot=pair.arms[1],
            side=SIDES[1],
            base_position=frames[1].position,
            yaw=frames[1].yaw,
            start=tuple(map(float, site.start(arms[1], frames[1], grippers[1].tip))),
            grasps={name: rights},
        )
        found = site.placement(arms[0], frames[0], {name: lefts}, grippers[0].tip, other)
        return replace(found, robot=pair.arms[0], side=SIDES[0], view=view)
    raise TaskError(f'{robot} gets with both hands to "{name}" from nowhere.')


def _crossed(frames: Sequence[Frame], left: Grasp, right: Grasp) -> bool:
    """Whether the left arm would take the right arm's end."""
    across = np.subtract(frames[1].position, frames[0].position)[:2]
    return float(across @ np.subtract(right.position, left.position)[:2]) < 0.0


def _both_reach(
    frames: Sequence[Frame], grasps: Sequence[Grasp], arms: Sequence[ArmKinematics], grippers: Sequence[Gripper]
) -> bool:
    """Whether each arm gets to its own grasp, and up with it."""
    return all(
        _reached(arm, frame, one, gripper.tip, gripper.closing_axis) is not None
        for arm, frame, grasp, gripper in zip(arms, frames, grasps, grippers, strict=True)
        for one in (grasp, grasp.lifted(LIFTED))
    )


@dataclass(eq=False)
class _Reach:
    """What one arm can take, and what it gets to from where it stands."""

    arm: ArmKinematics
    tip: float
    closing_axis: Sequence[float]
    grasps: Mapping[str, list[Grasp]]
    visits: Sequence[tuple[tuple[float, float, float], float | None]]
    """See `Needs`."""

    @staticmethod
    def of(scene: Scene, robot: str, needs: Needs) -> _Reach:
        gripper = measure_gripper(robot)
        grasps = grasps_of(scene, needs.grasp, robot, put=bool(needs.visit), cleared=needs.cleared)
        return _Reach(arm_kinematics(robot), gripper.tip, gripper.closing_axis, grasps, needs.visits)

    def __post_init__(self) -> None:
        self.standing = _standing(self.arm)
        self._farthest: dict[str, tuple[float, float, float]] = {}

    def at(self, frame: Frame) -> dict[str, tuple[Grasp, ...]] | None:
        """The grasps that are within reach from a place; None where something that is needed is not."""
        reached: dict[str, tuple[Grasp, ...]] = {}
        for name, found in self.grasps.items():
            tried = (_reached(self.arm, frame, one, self.tip, self.closing_axis) for one in frame.ordered(found))
            reached[name] = tuple(one for one in tried if one is not None)
            if not reached[name]:
                aside = math.dist(frame.position[:2], found[0].position[:2])
                up = found[0].position[2] - frame.position[2]
                known = self._farthest.get(name, (math.inf, 0.0, 0.0))
                self._farthest[name] = min(known, (math.hypot(aside, up), aside, up))
                return None
        there = all(_reaches_point(self.arm, frame, np.array(point), self.tip, side) for point, side in self.visits)
        return reached if there else None

    def refusal(self, robot: str, site: Site, room: bool) -> TaskError:
        """Why there was no place, with `room` for a base or not."""
        if self._farthest:
            name, (_, aside, up) = max(self._farthest.items(), key=lambda item: item[1])
            height = f"{abs(up):.2f} m {'above' if up > 0.0 else 'below'}"
            return TaskError(
                f'"{name}" is out of reach of {robot}: at best {aside:.2f} m beside and {height} a base that has room '
                f"to stand; choose another object or a smaller scene."
            )
        if not room:
            return TaskError(f"{robot} finds no free place to stand near {site.describe()}.")
        return TaskError(f"{robot} cannot bring its hand to every point of the task near {site.describe()}.")


def _standing(arm: ArmKinematics) -> Standing:
    """How an arm likes to stand."""
    hand, _ = arm.hand(arm.robot.home)
    scale = min(1.0, arm.length / SHORT)
    return Standing(
        away=float(np.hypot(hand[0], hand[1])) + 0.1 * scale,
        riser=RISER if scale == 1.0 else max(RISER, ABOVE_WORK - float(hand[2])),
        scale=scale,
    )


def _reached(arm: ArmKinematics, frame: Frame, grasp: Grasp, tip: float, closing_axis: Sequence[float]) -> Grasp | None:
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


def _reaches_point(arm: ArmKinematics, frame: Frame, point: Array, tip: float, side: float | None = None) -> bool:
    """Whether the hand gets to a point, pointing down.

    With a `side` it has room to spare, its fingers along the front of what is there.
    """
    at = frame.local(point + [0.0, 0.0, tip])
    axis = measure_gripper(arm.robot.name).closing_axis
    turns = (math.pi / 2, 0.0, -math.pi / 2, math.pi)
    if side is not None:
        turns = (side + math.pi / 2 - frame.yaw, side - math.pi / 2 - frame.yaw)
    found = (arm.solve(at, hand_rotation(turn, axis)) for turn in turns)
    return any(joints is not None and (side is None or arm.margin(joints) > ALONG_MARGIN) for joints in found)
