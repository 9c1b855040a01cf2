"""What the scripted policy does next: which object, held where, put down where, so that nothing is in the way.

A move is chosen among the grasps of an object and the spots where it may go. For each pair inverse kinematics says
whether the arm gets there, and collision detection what hand, arm and object would be in; the best pair without either
fault is taken.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import STEADY, Grasp, find_grasps, torque
from pat3d.envs.grasping.hand import hand_pose
from pat3d.envs.grasping.leaning import LEANING_HOVER, LEANING_PAYLOAD, find_leaning_grasps
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.grasping.spots import free_spots, spots_over
from pat3d.envs.physics.clearance import Clearance
from pat3d.envs.robots.arms import arm_kinematics, measure_gripper
from pat3d.envs.robots.kinematics import PlacedArm
from pat3d.envs.tasks.task import Goal
from pat3d.geometry.pose import Pose

Array = NDArray[np.float64]

LEANING_DEGREES = 20.0
"""An object that tilted by more is taken with grasps found on its present pose."""

DROP_HEIGHT = 0.008
"""Objects are let go this far above their place [m]."""

HIGHER = (0.0, 0.015, 0.03, 0.05, 0.08, 0.11)
"""By how much further up they are let go in a container into which the hand does not fit [m]."""

RELEASE = 0.02
"""The pads open by this much when they let go [m]."""

ABOVE = 0.08
"""What is put down comes from this far above its place [m]."""

JOINT_MARGIN = 0.08
"""Least distance of every joint from its limits [rad]."""

DISTANCE_WORTH = 40.0
"""Of how much worth it is to stay away from everything [1/m]."""

GRASPS = 4
"""Grasps that are compared, where so many are within reach."""

PAIRS = 100
"""Pairs of a grasp and a spot that are tried, at most."""


@dataclass(frozen=True, kw_only=True)
class Move:
    """One object taken, and put down unless the task is to hold it."""

    name: str
    grasp: Grasp
    rotation: Array
    """Of the hand, shape (3, 3)."""
    before: Array
    """Position of the hand before it takes the object [m]."""
    at: Array
    """The same when its fingers close."""
    spot: Array | None = None
    """Point at which the object's lowest point is, a little above, when it is let go [m]; None to keep it."""
    floor: float = 0.0
    """Height of that surface [m], above which it may be let go further up than usual."""
    worth: float = 0.0
    """Of the grasp and of the distance of the hand from everything; higher is better."""


class Planner:
    """Plans for one episode.

    Args:
        env: a TabletopEnv after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env, self._gripper = env, measure_gripper(env.robot)
        self._arm = PlacedArm(arm_kinematics(env.robot), env.placement.base_position, env.placement.yaw)
        self.clearance = Clearance(env)
        self.margin = JOINT_MARGIN
        """Least distance of every joint from its limits [rad]."""
        self.put: set[str] = set()
        """What was taken and put down already."""
        self.obstacles: Counter[str] = Counter()
        """How often each object was in the way of a grasp or a spot."""

    def next(self, failures: Mapping[str, int]) -> Move | None:
        """The next move; None when nothing is left to do but to wait.

        Args:
            failures: how often each object was missed or lost; so many of its grasps are passed over.
        """
        goals = self.goals()
        for goal in goals:
            move = self.clear(goal, failures.get(goal.name, 0))
            if move is not None:
                return move
        return self._anyhow(goals[0], failures.get(goals[0].name, 0)) if goals else None

    def goals(self) -> list[Goal]:
        """Objects to move next, and where to."""
        env = self._env
        return env.task.goals(env.simulation.state, tuple(env.placement.grasps), self.put)

    def clear(self, goal: Goal, failures: int = 0) -> Move | None:
        """A move that the arm can do without touching anything else; None where there is none.

        Args:
            goal: what to move, and where to.
            failures: see `next`.
        """
        name, where = goal.name, goal.where
        for grasps in self._grasps(name):
            if where is not None:
                mass, centre = self._env.scene[name].asset.mass_properties.mass, self._env.simulation.state.centre(name)
                grasps = [one for one in grasps if torque(one, mass, centre) <= STEADY]
            found = list(islice((one for grasp in grasps for one in self._taken(name, grasp)), GRASPS + failures))
            found.sort(key=lambda one: -one.worth)
            skipped = failures % max(1, len(found))
            found = found[skipped:] + found[:skipped]
            if where is None and found:
                return found[0]
            spots = self._spots(goal) if where is not None and found else []
            # The best spot that any of the grasps can serve.
            pairs = [(move, spot) for spot in spots for move in found]
            for move, spot in pairs[:PAIRS]:
                high = self._let_go(move, spot, into=bool(where))
                if high is not None:
                    return replace(move, spot=spot + [0.0, 0.0, high], floor=float(spot[2]))
        return None

    def _anyhow(self, goal: Goal, failures: int) -> Move:
        """A move of an object for which there is none without a fault."""
        name, where = goal.name, goal.where
        grasps = next(found for found in (*self._grasps(name), self._moved(name)) if found)
        move = self.as_move(name, grasps[failures % len(grasps)])
        spots = [] if where is None else self._spots(goal)
        return replace(move, spot=spots[0] + [0.0, 0.0, HIGHER[-1] if where else 0.0]) if spots else move

    def _spots(self, goal: Goal) -> list[Array]:
        if goal.at is not None:
            surface = self._env.placement.surface if goal.height is None else goal.height
            return [np.array([*goal.at, surface])]
        if not goal.where:
            return free_spots(self._env, goal.name)
        return spots_over(self._env, goal.name, goal.where, on=goal.on, more=goal.shared)

    def _grasps(self, name: str) -> Iterator[list[Grasp]]:
        """Grasps of the scene at rest, moved along with the object, and those searched where it is now."""
        state = self._env.simulation.state
        if state.tilt(name) <= LEANING_DEGREES:
            yield self._moved(name)
        objects = tuple(
            replace(obj, pose=Pose.from_matrix(state.rotation(obj.name), state.position(obj.name)))
            for obj in self._env.scene.objects
        )
        present = replace(self._env.scene, objects=objects)
        found = find_grasps(present, name, self._gripper)
        light = self._env.scene[name].asset.mass_properties.mass <= LEANING_PAYLOAD
        if not found and light and self._env.task.from_the_side:
            found = find_leaning_grasps(present, name, self._gripper)
        yield found

    def _moved(self, name: str) -> list[Grasp]:
        """Grasps of the scene at rest, moved along with the object's turn about z and its shift."""
        state, pose = self._env.simulation.state, self._env.scene[name].pose
        turn = state.rotation(name) @ pose.rotation.T
        yaw = math.atan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1])
        c, s = math.cos(yaw), math.sin(yaw)
        flat = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        # About the centre of mass, which is known exactly at the start and now.
        centre = pose.apply(np.array([self._env.scene[name].asset.mass_properties.centre_of_mass]))[0]
        moved = []
        for grasp in self._env.placement.grasps[name]:
            x, y, z = flat @ (np.array(grasp.position) - centre) + state.centre(name)
            at = (float(x), float(y), float(z))
            moved.append(replace(grasp, position=at, closing=grasp.closing + yaw, heading=grasp.heading + yaw))
        return moved

    def as_move(self, name: str, grasp: Grasp, half: float = 0.0) -> Move:
        """A grasp as a move, its hand turned by `half` [rad] about the approach; nothing is checked."""
        tip, axis = self._gripper.tip, self._gripper.closing_axis
        back = LEANING_HOVER if grasp.lean else HOVER
        at, rotation = hand_pose(grasp, tip, axis, half=half)
        before, _ = hand_pose(grasp, tip, axis, back=back, half=half)
        return Move(name=name, grasp=grasp, rotation=rotation, before=before, at=at)

    def _taken(self, name: str, grasp: Grasp) -> list[Move]:
        """The grasp, the hand turned the nearer way round first, as far as the arm gets there through nothing."""
        # A grasp that leans knows its own way round: for the other one the wrist may not turn far enough.
        both = [self.as_move(name, grasp, half) for half in ((0.0,) if grasp.lean else (0.0, math.pi))]
        found = [(turn, move) for move in both for turn, move in self._checked(move)]
        return [move for _, move in sorted(found, key=lambda one: one[0])]

    def _checked(self, move: Move) -> list[tuple[float, Move]]:
        """Largest motion of a joint [rad], and the move with its worth; nothing where the arm cannot do it."""
        wide, distance = np.array(self._gripper.open_joints), math.inf
        turn = 0.0
        for position in (move.at, move.before):
            joints = self._reached(position, move.rotation)
            if joints is None or self._blocked(joints, wide, move.name):
                return []
            turn = float(np.abs(joints - self._env.simulation.arm).max())
            # The hand turns the shorter way, and a joint that would have to go the longer one stops at its limit.
            if turn > math.pi and not move.grasp.lean:
                return []
            distance = min(distance, self.clearance.distance(joints, wide, move.name))
        return [(turn, replace(move, worth=move.grasp.score + DISTANCE_WORTH * distance))]

    def _blocked(self, joints: Array, fingers: Array, name: str, shift: Array | None = None) -> bool:
        obstacle = self.clearance.obstacle(joints, fingers, name, shift)
        if obstacle:
            self.obstacles[obstacle] += 1
        return bool(obstacle)

    def _reached(self, position: Array, rotation: Array) -> Array | None:
        """Joint positions for a pose of the hand, away from their limits."""
        home = np.array(self._env.placement.start)
        joints = self._arm.solve(position, rotation, home, home)
        return joints if joints is not None and self._arm.margin(joints) > self.margin else None

    def _let_go(self, move: Move, spot: Array, *, into: bool) -> float | None:
        """How much higher than usual to let go above a spot [m]; None where something is always in the way."""
        fingers = self._gripper.joints(move.grasp.width + RELEASE)
        resting = self.resting(move.name, spot) - self._env.simulation.state.centre(move.name)
        for high in HIGHER if into else HIGHER[:1]:
            for up in (high, high + ABOVE):
                shift = resting + [0.0, 0.0, up]
                joints = self._reached(move.at + shift, move.rotation)
                if joints is None:
                    return None
                if self._blocked(joints, fingers, move.name, shift):
                    break
            else:
                return high
        return None

    def resting(self, name: str, spot: Array) -> Array:
        """Where the centre of an object is when it is let go above a spot as it is turned now [m]."""
        state = self._env.simulation.state
        bottom = float(state.centre(name)[2] - state.points(name)[:, 2].min())
        return spot + [0.0, 0.0, bottom + DROP_HEIGHT]

    def passing(self, start: Array, end: Array, radius: float, *names: str) -> float:
        """Height of the highest thing [m] within `radius` [m] of the way from one point to another, but for `names`."""
        state = self._env.simulation.state
        along = (end - start)[:2]
        steps = np.linspace(0.0, 1.0, 2 + int(np.linalg.norm(along) / 0.02))[:, None]
        points = start[:2] + steps * along
        highest = self._env.placement.surface
        for obj in self._env.scene.objects:
            if obj.name not in names:
                cloud = state.points(obj.name)
                low, high = cloud[:, :2].min(axis=0), cloud[:, :2].max(axis=0)
                away = np.linalg.norm(np.maximum(np.maximum(low - points, points - high), 0.0), axis=1)
                if float(away.min()) < radius:
                    highest = max(highest, float(cloud[:, 2].max()))
        return highest
