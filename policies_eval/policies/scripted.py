"""The scripted policy: moves planned on the true shapes and poses, done through the same actions as any policy.

It takes an object as `moves` says, lifts it; where the task names a place, it carries the object there, lowers it, lets
go and withdraws. When it notices that the hand is empty or stuck it plans again.
"""

from __future__ import annotations

from collections import deque
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.grasp import torque
from pat3d.envs.grasping.hand_path import HandPath
from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.arms import measure_gripper
from pat3d.envs.tasks.moves import ABOVE, RELEASE, Move, Planner
from pat3d.envs.tasks.push import Push
from pat3d.errors import EnvironmentSetupError
from pat3d.policies_eval.policies.opening import move_along
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.pushing import Pusher
from pat3d.policies_eval.policies.two_hands import TWO_HANDED, TwoHands
from pat3d.scene.task_spec import steps_of

Array = NDArray[np.float64]

NEAR, ALIGNED, EXACT = 0.02, 0.006, 0.004
"""Errors at which a move on the way, one before the hand comes down, and one that matters is done [m]."""

FUNNEL = 4.0
"""How much higher a hand stays that comes down beside its place, for each metre beside it."""

ON_THE_WAY = 0.04
"""The same, of a pose that is only passed [m]."""

PATIENCE = 45
"""Control steps after which a move is done anyway."""

STUCK_STEPS, STUCK = 10, 0.002
"""So many control steps in which a hand comes no nearer to its goal than this [m] show that something is in the way."""

CLOSE_STEPS = (8, 24)
"""Control steps; the fingers close for at least and at most so many, until they stand still."""

OPEN_STEPS = 16
"""Control steps in which the fingers let go at the latest."""

STANDING = 2e-4
"""Fingers that move by less in a control step stand still [m or rad]."""

LIFT_STEP, GENTLE_STEP = 0.015, 0.005
"""The hand is raised by so much in a control step [m]: what is jerked slips. The second is for what turns in it."""

TURNING = 0.35
"""What turns the fingers by more than this [N m] is lifted gently."""

RISE = 0.13
"""What is picked up is lifted until its centre has risen by this [m], as what is held by its rim hangs askew."""

LIFT, HIGHEST_LIFT = 0.15, 0.35
"""[m]"""

PASSING = 0.03
"""Kept between the hand, or what it carries, and what it passes above [m]."""

HAND_RADIUS = 0.12
"""Of everything about the hand, seen from above [m]."""

SETTLE_STEPS = 14
"""Control steps that are waited at most for what was let go to come to rest."""

AGAIN_STEPS = 10
"""Control steps after which one who waits looks whether something is left to do."""


class ScriptedPolicy:
    """Knows the true poses; needs control="osc" and an environment of this package."""

    privileged = True

    def reset(self, episode: EpisodeStart) -> None:
        """Plan for a new episode."""
        env = episode.env
        if env is None or env.control != "osc":
            raise EnvironmentSetupError('the scripted policy needs control="osc" and the environment itself.')
        for kind, *names in steps_of(episode.task):
            room = env.scene[names[-1]].asset.region("in") if kind == "place" else None
            if room is not None and room.enclosed:
                raise EnvironmentSetupError(
                    f'the scripted policy puts things down from above, and "{names[-1]}" is open in front alone.'
                )
        self._other: TwoHands | Pusher | None = None
        """What does a task that is no sequence of moves."""
        if env.task.kind in TWO_HANDED:
            self._other = TwoHands(env)
        elif isinstance(env.task, Push):
            self._other = Pusher(env)
        if self._other is not None:
            return
        self._env, self._servo, self._gripper = env, Servo(env), measure_gripper(env.robot)
        self._planner = self._plan()
        self._failures: dict[str, int] = {}
        self._begin()

    def act(self, observation: Any) -> NDArray[np.float32]:
        """The next action, shape (7,); of two arms (14,), the other holding still but in tasks for both."""
        if self._other is not None:
            return self._other.act()
        while True:
            action = getattr(self, f"_{self._phase}")()
            if action is not None:
                return action

    def _plan(self) -> Planner:
        return Planner(self._env)

    def _begin(self) -> None:
        """Choose the next move."""
        state, grasps = self._env.simulation.state, tuple(self._env.placement.grasps)
        opening = self._env.task.opening(state, grasps, self._planner.put)
        if opening is not None:
            self._opening, self._script = opening, move_along(self._env, opening)
            self._enter("move_along")
            return
        move = self._planner.next(self._failures)
        if move is None:
            self._stay = self._env.simulation.state.hand.copy()
            self._rotation = self._env.simulation.state.hand_rotation.copy()
            self._enter("wait")
            return
        self._move: Move = move
        self._rotation, self._height = move.rotation, LIFT
        mass, state = self._env.scene[move.name].asset.mass_properties.mass, self._env.simulation.state
        turning = torque(move.grasp, mass, state.centre(move.name)) > TURNING
        self._lift_step = GENTLE_STEP if turning and not move.grasp.lean else LIFT_STEP
        hand = self._from = state.hand.copy()
        if move.grasp.lean:
            top = float(state.points(move.name)[:, 2].max())
            self._high = max(top + HOVER, move.before[2] + HOVER)
        else:
            passed = self._planner.passing(hand, move.before, HAND_RADIUS)
            self._high = max(float(move.before[2]), passed + self._gripper.tip + PASSING)
        self._enter("rise")

    # Phases: each returns the next action, or None after it has entered another phase.

    def _enter(self, phase: str) -> None:
        self._phase, self._steps = phase, 0
        self._errors: list[float] = []

    def _go(
        self, position: Array, fingers: float, tolerance: float, then: str, *, patient: bool = False
    ) -> NDArray[np.float32] | None:
        """Towards a position until it is reached or something is in the way; the `patient` hand waits and pushes on."""
        action, error = self._servo.towards(position, self._rotation, fingers)
        self._steps += 1
        self._errors.append(error)
        there = error < tolerance and (not patient or self._errors[-2:][0] < 2 * tolerance)
        impatient = not patient and len(self._errors) > STUCK_STEPS
        stuck = impatient and self._errors[-STUCK_STEPS - 1] - min(self._errors[-STUCK_STEPS:]) < STUCK
        if there or stuck or self._steps > PATIENCE:
            self._enter(then)
            return None
        return action

    def _move_along(self) -> NDArray[np.float32] | None:
        """Until the drawer or door is where it should be; what was done is not begun again where it is undone later."""
        action = next(self._script, None)
        if action is None:
            self._stay, self._rotation = (
                self._env.simulation.state.hand.copy(),
                self._env.simulation.state.hand_rotation,
            )
            self._enter("moved")
        return action

    def _moved(self) -> NDArray[np.float32] | None:
        self._steps += 1
        if self._steps > SETTLE_STEPS:
            grasps = tuple(self._env.placement.grasps)
            left = self._env.task.opening(self._env.simulation.state, grasps, self._planner.put)
            if left is None or left.spec != self._opening.spec:
                self._planner.put.add(self._opening.spec)
            self._begin()
            return None
        return self._servo.towards(self._stay, self._rotation, -1.0)[0]

    def _rise(self) -> NDArray[np.float32] | None:
        """Straight up first where the way to the grasp is low."""
        hand, lean = self._env.simulation.state.hand, self._move.grasp.lean
        then = "over" if lean else "across"
        if hand[2] > self._high - NEAR or (not lean and np.hypot(*(hand - self._move.at)[:2]) < 0.03):
            self._enter(then)
            return None
        return self._go(np.array([*self._from[:2], self._high]), -1.0, NEAR, then)

    def _across(self) -> NDArray[np.float32] | None:
        """Above everything on the way."""
        return self._go(np.array([*self._move.before[:2], self._high]), -1.0, ON_THE_WAY, "hover")

    def _over(self) -> NDArray[np.float32] | None:
        """To where a leaning approach begins, from above, on a way that the joints can go while the hand turns."""
        before = self._move.before
        if self._steps == 0:
            above = np.array([*before[:2], self._high])
            way = HandPath(self._env).through([(above, self._rotation), (before, self._rotation)])
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
        return self._go(self._move.before, -1.0, ALIGNED, "descend", patient=True)

    def _descend(self) -> NDArray[np.float32] | None:
        """Down as far as the hand is above its place: it still swings when it gets there."""
        at, lean = self._move.at, self._move.grasp.lean
        aside = float(np.hypot(*(self._env.simulation.state.hand - at)[:2]))
        above = 0.0 if lean else FUNNEL * max(0.0, aside - ALIGNED)
        return self._go(at + [0.0, 0.0, above], -1.0, EXACT, "close", patient=True)

    def _close(self) -> NDArray[np.float32] | None:
        self._steps += 1
        fingers = self._env.simulation.fingers.copy()
        standing = self._steps > 1 and float(np.abs(fingers - self._fingers).max()) < STANDING
        self._fingers = fingers
        if self._steps > CLOSE_STEPS[1] or (standing and self._steps > CLOSE_STEPS[0]):
            self._enter("lift")
            if self._move.spot is not None:
                self._aim(self._move.spot)
                self._height = self._high - float(self._move.at[2])
            return None
        return self._servo.towards(self._move.at, self._rotation, 1.0)[0]

    def _aim(self, spot: Array) -> None:
        """Where the hand lets go [m], so that the object stands in its place, and how high it goes there."""
        state, name = self._env.simulation.state, self._move.name
        points = state.points(name)
        self._place = self._planner.resting(name, spot) - state.centre(name) + state.hand
        own = float(np.linalg.norm(points[:, :2] - state.hand[:2], axis=1).max())
        hanging = max(float(state.hand[2] - points[:, 2].min()), self._gripper.tip)
        below = self._planner.passing(state.hand, self._place, max(own, HAND_RADIUS / 2), name) + hanging
        beside = self._planner.passing(state.hand, self._place, HAND_RADIUS, name)
        palm = beside + self._gripper.tip - self._gripper.palm
        self._high = max(max(below, palm) + PASSING, float(self._place[2]) + ABOVE)

    def _lift(self) -> NDArray[np.float32] | None:
        state, move = self._env.simulation.state, self._move
        if self._steps > 12 and not state.touched(move.name):
            return self._failed()
        if move.spot is None and state.touched(move.name):
            short = RISE - float(state.centre(move.name)[2] - state.start_centre(move.name)[2])
            if float(state.hand[2] - move.at[2]) > self._height - NEAR and short > 0.0:
                self._height = min(self._height + min(short, 0.02), HIGHEST_LIFT)
        height = min(self._height, self._lift_step * (self._steps + 2))
        action, error = self._servo.towards(move.at + [0.0, 0.0, height], self._rotation, 1.0)
        error += self._height - height
        self._steps += 1
        # What is lifted gently over something high takes longer.
        patience = max(PATIENCE, 1.2 * self._height / self._lift_step)
        if move.spot is not None and (error < ON_THE_WAY or self._steps > patience):
            self._aim(move.spot)
            self._enter("carry")
            return None
        return action

    def _carry(self) -> NDArray[np.float32] | None:
        if not self._env.simulation.state.touched(self._move.name):
            return self._failed()
        return self._go(np.array([*self._place[:2], self._high]), 1.0, 0.012, "lower")

    def _lower(self) -> NDArray[np.float32] | None:
        # What has arrived stops the hand; pushing further would tip it.
        state, name = self._env.simulation.state, self._move.name
        touching = any(state.touch(name, obj.name) for obj in self._env.scene.objects if obj.name != name)
        if touching and state.hand[2] < self._place[2] + NEAR:
            self._enter("open")
            return None
        return self._go(self._place, 1.0, EXACT, "open")

    def _open(self) -> NDArray[np.float32] | None:
        """Let go, no wider than needed: there may be neighbours."""
        fingers = self._env.simulation.fingers.copy()
        if self._steps == 0:
            self._from, self._fingers = self._env.simulation.state.hand.copy(), fingers
        self._steps += 1
        apart = self._gripper.joints(self._gripper.closed + RELEASE) - self._gripper.joints(self._gripper.closed)
        wide = float(np.abs(fingers - self._fingers).max()) > float(np.abs(apart).max())
        free = wide and not self._env.simulation.state.touched(self._move.name)
        if free or self._steps > OPEN_STEPS:
            self._enter("withdraw")
            top = float(self._env.simulation.state.points(self._move.name)[:, 2].max())
            self._stay = self._from.copy()
            self._stay[2] = max(self._from[2] + 2 * NEAR, top + self._gripper.tip + NEAR)
            return None
        return self._servo.towards(self._from, self._rotation, -1.0)[0]

    def _withdraw(self) -> NDArray[np.float32] | None:
        return self._go(self._stay, 0.0, NEAR, "settle")

    def _settle(self) -> NDArray[np.float32] | None:
        """Until what was let go is at rest, so that what is left to do is seen."""
        self._steps += 1
        if self._steps > 1 and (self._env.simulation.state.still(self._move.name) or self._steps > SETTLE_STEPS):
            self._planner.put.add(self._move.name)
            self._begin()
            return None
        return self._servo.towards(self._stay, self._rotation, -1.0)[0]

    def _wait(self) -> NDArray[np.float32] | None:
        """Nothing is left to do, unless something moves again."""
        self._steps += 1
        if self._steps > AGAIN_STEPS:
            self._begin()
            return None
        return self._servo.towards(self._stay, self._rotation, -1.0)[0]

    def _failed(self) -> None:
        self._failures[self._move.name] = self._failures.get(self._move.name, 0) + 1
        self._begin()
