"""The scripted policy: grasps found on the true shapes and poses, done through the same actions as any policy.

It plans a grasp from the object's present pose, approaches, closes and lifts; where the task names a place, it carries
the object there, lowers it, lets go and withdraws. When it notices that the hand is empty it tries the next grasp.
"""

from __future__ import annotations

import math
from collections import deque
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasp import Grasp
from pat3d.envs.hand import hand_pose
from pat3d.envs.hand_path import HandPath
from pat3d.envs.leaning import LEANING_HOVER, find_leaning_grasps
from pat3d.envs.placement import HOVER
from pat3d.envs.robots import measure_gripper
from pat3d.envs.scripted import Servo
from pat3d.errors import EnvironmentSetupError
from pat3d.policies_eval.policy import EpisodeStart

Array = NDArray[np.float64]

NEAR, EXACT = 0.02, 0.005
"""Errors at which a move on the way, and one that matters, is done [m]."""

ON_THE_WAY = 0.04
"""The same, of a pose that is only passed [m]."""

PATIENCE = 45
"""Control steps after which a move is done anyway."""

CLOSE_STEPS, OPEN_STEPS = (8, 24), 8
"""Control steps; the fingers close for at least and at most so many, until they stand still."""

STANDING = 2e-4
"""Fingers that move by less in a control step stand still [m or rad]."""

LIFT_STEP = 0.015
"""The hand is raised by so much in a control step [m]: what is jerked slips."""

LIFT = 0.15
"""[m]"""

RISE = 0.13
"""What is picked up is lifted until its centre has risen by this [m], as what is held by its rim hangs askew."""

HIGHEST_LIFT = 0.35
"""[m]"""

CARRY_CLEARANCE = 0.06
"""Kept below what is carried, above everything that it passes [m]."""

DROP_HEIGHT = 0.008
"""Objects are let go this far above their place [m]."""

LEANING_DEGREES = 20.0
"""An object that tilted by more is taken with grasps found on its present pose."""

FREE_PLACES = 24


class ScriptedPolicy:
    """Knows the true poses; needs control="osc" and an environment of this package."""

    privileged = True

    def reset(self, episode: EpisodeStart) -> None:
        """Plan for a new episode."""
        env = episode.env
        if env is None or env.control != "osc":
            raise EnvironmentSetupError('the scripted policy needs control="osc" and the environment itself.')
        self._env, self._servo, self._gripper = env, Servo(env), measure_gripper(env.robot)
        self._grasps = {name: tuple(found) for name, found in env.placement.grasps.items()}
        self._tried = dict.fromkeys(self._grasps, 0)
        self._kind = env.task.kind
        self._begin()

    def act(self, observation: Any) -> NDArray[np.float32]:
        """The next action, shape (7,)."""
        while True:
            action = getattr(self, f"_{self._phase}")()
            if action is not None:
                return action

    def _begin(self) -> None:
        """Choose the object, and a grasp of it where it is now."""
        self._name = self._target()
        state, grasps = self._env.simulation.state, self._grasps.get(self._name) or ()
        if not grasps:
            raise EnvironmentSetupError(f'no grasp of "{self._name}" is known; {", ".join(self._grasps)} have one.')
        tried = self._tried[self._name]
        self._tried[self._name] += 1
        grasp = self._moved(grasps[tried % len(grasps)], self._name)
        if state.tilt(self._name) > LEANING_DEGREES:
            grasp = self._found(self._name, tried) or grasp
        self._grasp = grasp
        self._at, _ = hand_pose(grasp, self._gripper.tip, self._gripper.closing_axis)
        back = LEANING_HOVER if grasp.lean else HOVER
        self._before, _ = hand_pose(grasp, self._gripper.tip, self._gripper.closing_axis, back=back)
        self._rotation, self._height = self._servo.nearer(grasp), LIFT
        self._enter("rise")

    def _target(self) -> str:
        """What to take next: the bottom object of a retrieval last, else what the task says."""
        if self._kind == "retrieve":
            for name in self._grasps:
                if name != self._env.task.target and not self._cleared(name):
                    return name
            return self._env.task.target
        return self._env.verdict.target

    def _cleared(self, name: str) -> bool:
        state = self._env.simulation.state
        return bool(np.linalg.norm(state.centre(name)[:2] - state.start_centre(name)[:2]) > 0.08)

    def _moved(self, grasp: Grasp, name: str) -> Grasp:
        """A grasp of the scene at rest, moved along with the object's turn about z and its shift."""
        state, pose = self._env.simulation.state, self._env.scene[name].pose
        turn = state.rotation(name) @ pose.rotation.T
        yaw = math.atan2(turn[1, 0] - turn[0, 1], turn[0, 0] + turn[1, 1])
        c, s = math.cos(yaw), math.sin(yaw)
        flat = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        # About the centre of mass, which is known exactly at the start and now.
        centre = pose.apply(np.array([self._env.scene[name].asset.mass_properties.centre_of_mass]))[0]
        position = flat @ (np.array(grasp.position) - centre) + state.centre(name)
        at = (float(position[0]), float(position[1]), float(position[2]))
        return replace(grasp, position=at, closing=grasp.closing + yaw, heading=grasp.heading + yaw)

    def _found(self, name: str, tried: int) -> Grasp | None:
        """A grasp searched on the present poses."""
        from pat3d.envs.grasp import find_grasps
        from pat3d.scene import Pose

        state, scene = self._env.simulation.state, self._env.scene
        objects = tuple(
            replace(obj, pose=Pose.from_matrix(state.rotation(obj.name), state.position(obj.name)))
            for obj in scene.objects
        )
        present = replace(scene, objects=objects)
        found = find_grasps(present, name, self._gripper)
        if not found and self._kind == "pick":
            found = find_leaning_grasps(present, name, self._gripper)
        return found[tried % len(found)] if found else None

    # Phases: each returns the next action, or None after it has entered another phase.

    def _enter(self, phase: str) -> None:
        self._phase, self._steps = phase, 0

    def _go(self, position: Array, fingers: float, tolerance: float, then: str) -> NDArray[np.float32] | None:
        action, error = self._servo.towards(position, self._rotation, fingers)
        self._steps += 1
        if error < tolerance or self._steps > PATIENCE:
            self._enter(then)
            return None
        return action

    def _rise(self) -> NDArray[np.float32] | None:
        """Straight up first where the way to the grasp is low."""
        hand = self._env.simulation.state.hand
        above, then = self._at[2] + HOVER, "hover"
        if self._grasp.lean:
            above, then = self._clear(), "over"
        if hand[2] > above - 0.02 or (not self._grasp.lean and np.hypot(*(hand - self._at)[:2]) < 0.03):
            self._enter(then)
            return None
        return self._go(np.array([hand[0], hand[1], above]), -1.0, NEAR, then)

    def _clear(self) -> float:
        """A height for the hand [m] above the object and above where a leaning approach begins."""
        top = float(self._env.simulation.state.points(self._name)[:, 2].max())
        return max(top + HOVER, self._before[2] + HOVER)

    def _over(self) -> NDArray[np.float32] | None:
        """To where a leaning approach begins, from above, on a way that the joints can go while the hand turns."""
        if self._steps == 0:
            above = np.array([*self._before[:2], self._clear()])
            way = HandPath(self._env).through([(above, self._rotation), (self._before, self._rotation)])
            if way is None:
                # The hand is led there directly, as far as the arm goes.
                self._enter("hover")
                return None
            self._way = deque(way)
        self._steps += 1
        action, error = self._servo.towards(self._way[0][0], self._way[0][1], -1.0)
        if error < ON_THE_WAY or self._steps > PATIENCE:
            self._way.popleft()
            self._steps = 1
            if not self._way:
                self._enter("hover")
                return None
        return action

    def _hover(self) -> NDArray[np.float32] | None:
        # Fingers that come down beside their place push what they should take.
        return self._go(self._before, -1.0, 0.006, "descend")

    def _descend(self) -> NDArray[np.float32] | None:
        return self._go(self._at, -1.0, EXACT, "close")

    def _close(self) -> NDArray[np.float32] | None:
        self._steps += 1
        fingers = self._env.simulation.fingers.copy()
        standing = self._steps > 1 and float(np.abs(fingers - self._fingers).max()) < STANDING
        self._fingers = fingers
        if self._steps > CLOSE_STEPS[1] or (standing and self._steps > CLOSE_STEPS[0]):
            self._offset = self._env.simulation.state.centre(self._name) - self._env.simulation.state.hand
            self._enter("lift")
            return None
        return self._servo.towards(self._at, self._rotation, 1.0)[0]

    def _lift(self) -> NDArray[np.float32] | None:
        state = self._env.simulation.state
        if self._steps > 12 and not state.touched(self._name):
            return self._retry()
        keep = self._kind == "pick" or (self._kind == "retrieve" and self._name == self._env.task.target)
        if keep and state.touched(self._name):
            short = RISE - float(state.centre(self._name)[2] - state.start_centre(self._name)[2])
            if float(state.hand[2] - self._at[2]) > self._height - NEAR and short > 0.0:
                self._height = min(self._height + min(short, 0.02), HIGHEST_LIFT)
        height = min(self._height, LIFT_STEP * (self._steps + 2))
        action, error = self._servo.towards(self._at + [0.0, 0.0, height], self._rotation, 1.0)
        error += self._height - height
        self._steps += 1
        if not keep and (error < NEAR or self._steps > PATIENCE):
            self._place = self._destination()
            self._enter("carry")
            return None
        return action

    def _carry(self) -> NDArray[np.float32] | None:
        if not self._env.simulation.state.touched(self._name):
            return self._retry()
        hand = self._env.simulation.state.hand
        high = max(self._place[2] + CARRY_CLEARANCE + 0.06, self._at[2] + LIFT)
        if hand[2] < high - 0.03 and self._steps < PATIENCE:
            self._steps += 1
            return self._servo.towards(np.array([hand[0], hand[1], high]), self._rotation, 1.0)[0]
        return self._go(np.array([self._place[0], self._place[1], high]), 1.0, 0.012, "lower")

    def _lower(self) -> NDArray[np.float32] | None:
        # What has arrived stops the hand; pushing further would tip it.
        state = self._env.simulation.state
        touching = any(state.touch(self._name, obj.name) for obj in self._env.scene.objects if obj.name != self._name)
        if touching and state.hand[2] < self._place[2] + 0.02:
            self._enter("open")
            return None
        return self._go(self._place, 1.0, EXACT, "open")

    def _open(self) -> NDArray[np.float32] | None:
        self._steps += 1
        if self._steps == 1:
            self._from = self._env.simulation.state.hand.copy()
        if self._steps > OPEN_STEPS:
            self._enter("withdraw")
            return None
        return self._servo.towards(self._from, self._rotation, -1.0)[0]

    def _withdraw(self) -> NDArray[np.float32] | None:
        return self._go(self._from + [0.0, 0.0, LIFT], -1.0, NEAR, "wait")

    def _wait(self) -> NDArray[np.float32] | None:
        """See whether the task is done or goes on with another object."""
        self._steps += 1
        if self._steps > 14:
            self._begin()
            return None
        return self._servo.towards(self._from + [0.0, 0.0, LIFT], self._rotation, -1.0)[0]

    def _retry(self) -> None:
        self._begin()

    def _destination(self) -> Array:
        """Where the hand lets go [m], so that the object stands in its place."""
        state, verdict = self._env.simulation.state, self._env.verdict
        bottom = float(state.centre(self._name)[2] - state.points(self._name)[:, 2].min())
        offset = state.centre(self._name) - state.hand
        if self._kind in ("unload", "retrieve"):
            centre = self._free_place() + [0.0, 0.0, bottom + DROP_HEIGHT]
        else:
            centre = np.array(verdict.goal) + self._aside(verdict.goal)
            half = float(self._env.scene[self._name].asset.size[2]) / 2
            centre[2] += bottom - half + DROP_HEIGHT
        return centre - offset

    def _aside(self, goal: Any) -> Array:
        """How far from the middle of a container [m] to let go, so that nothing lands on what is there already."""
        state, name = self._env.simulation.state, self._name
        own = float(np.ptp(state.points(name)[:, :2], axis=0).max()) / 2
        near = [
            state.centre(obj.name)[:2]
            for obj in self._env.scene.objects
            if obj.name != name and not obj.fixed and obj.asset.region("in") is None
        ]
        near = [point for point in near if math.dist(point, goal[:2]) < 0.12]
        room = self._room(goal)
        if not near or room <= own:
            return np.zeros(3)
        angles = np.linspace(0.0, 2 * math.pi, 16, endpoint=False)
        places = (room - own) * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        gaps = [min(math.dist(place + goal[:2], point) for point in near) for place in places]
        best = places[int(np.argmax(gaps))]
        return np.array([best[0], best[1], 0.0])

    def _room(self, goal: Any) -> float:
        """Half of the width of the container whose middle is nearest to `goal` [m]; 0 for none."""
        state = self._env.simulation.state
        found = [
            (math.dist(state.position(obj.name)[:2], goal[:2]), min(region.half_size))
            for obj in self._env.scene.objects
            if (region := obj.asset.region("in")) is not None
        ]
        return min(found)[1] if found and min(found)[0] < 0.1 else 0.0

    def _free_place(self) -> Array:
        """A place on the surface of the work, near the robot and away from everything [m]."""
        state, placement = self._env.simulation.state, self._env.placement
        own = state.points(self._name)[:, :2]
        radius = float(np.linalg.norm(own - own.mean(axis=0), axis=1).max()) + 0.05
        clouds = [
            state.points(obj.name)[:, :2]
            for obj in self._env.scene.objects
            if obj.name not in (self._name, placement.host)
        ]
        boxes = [(cloud.min(axis=0), cloud.max(axis=0)) for cloud in clouds]
        base, focus = np.array(placement.base_position), np.array(placement.focus)
        best, room = focus[:2], -math.inf
        for turn in np.linspace(-1.3, 1.3, FREE_PLACES):
            for away in (0.45, 0.52, 0.6, 0.68):
                angle = placement.yaw + turn
                point = base[:2] + away * np.array([math.cos(angle), math.sin(angle)])
                if placement.bench is not None:
                    inner = np.array(placement.bench) + [[0.12], [-0.12]]
                    if (point < inner[0]).any() or (point > inner[1]).any():
                        continue
                gaps = [np.linalg.norm(np.maximum(np.maximum(low - point, point - high), 0.0)) for low, high in boxes]
                gap = float(min(gaps, default=1.0)) - radius
                # Enough room is enough; the nearest such place wins.
                score = min(gap, 0.03) - 0.05 * float(np.linalg.norm(point - state.hand[:2]))
                if score > room:
                    best, room = point, score
        return np.array([best[0], best[1], placement.surface])
