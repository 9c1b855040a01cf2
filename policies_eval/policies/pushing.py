"""What the scripted policy does to push something: one straight stroke after the other, watched and corrected.

A stroke ends where the object has come far enough, or has left its line or turned; then the hand goes back, up, and
round to where the next one begins.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.arms import measure_gripper
from pat3d.envs.tasks.strokes import Stroke, StrokePlanner

Array = NDArray[np.float64]

NEAR, EXACT = 0.02, 0.006
"""Errors at which a hand is there on the way, and where it matters [m]."""

PATIENCE = 60
"""Control steps after which a move is over anyway."""

LEADS = (0.008, 0.03)
"""How far ahead of itself the hand is sent while it pushes, near the end and before [m]."""

HARDER, HARDEST = 0.004, 0.08
"""By how much more in every control step in which nothing moves, and at most [m]."""

MOVING = 5e-4
"""In a control step [m]."""

ARRIVED = 0.006
"""A stroke is over this far before its end [m]: what is pushed follows a little."""

ASTRAY, TURNED = 0.03, math.radians(20.0)
"""A stroke is also over where the object is this far beside its line [m], or turned by so much."""

PASSING, AROUND = 0.03, 0.12
"""Kept above what the hand passes within this distance [m]."""

MARGIN = 0.02
"""Least distance of every joint from its limits [rad]."""

WAIT = 12
"""Control steps until it is looked again whether something is left to do."""


class Pusher:
    """Does a `Push`.

    Args:
        env: a TabletopEnv after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env, self._name = env, env.task.target
        self._servo, self._gripper = Servo(env), measure_gripper(env.robot)
        self._planner = StrokePlanner(env)
        # What was rehearsed is within reach with more to spare: an object that went astray still is.
        self._planner.margin = MARGIN
        self._rotation = env.simulation.state.hand_rotation.copy()
        self._script = self._all()

    def act(self) -> NDArray[np.float32]:
        """The next action."""
        return next(self._script)

    def _all(self) -> Iterator[NDArray[np.float32]]:
        while True:
            strokes = self._planner.strokes()
            if strokes:
                yield from self._do(strokes[0])
            else:
                stay = self._env.simulation.state.hand.copy()
                for _ in range(WAIT):
                    yield self._servo.towards(stay, self._rotation, 0.0)[0]

    def _do(self, stroke: Stroke) -> Iterator[NDArray[np.float32]]:
        fingers = -1.0 if stroke.open else 1.0
        hand = self._env.simulation.state.hand.copy()
        high = self._planner.passing(hand, stroke.back, AROUND) + self._gripper.tip + PASSING
        high = max(high, float(stroke.back[2]))
        yield from self._go(np.array([*hand[:2], max(high, float(hand[2]))]), fingers, NEAR)
        self._rotation = stroke.rotation
        yield from self._go(np.array([*stroke.back[:2], high]), fingers, NEAR)
        yield from self._go(stroke.back, fingers, EXACT)
        yield from self._push(stroke, fingers)
        hand = self._env.simulation.state.hand.copy()
        back = hand + (stroke.back - stroke.start)
        yield from self._go(back, fingers, NEAR)
        yield from self._go(np.array([*back[:2], max(high, float(back[2]))]), fingers, NEAR)

    def _push(self, stroke: Stroke, fingers: float) -> Iterator[NDArray[np.float32]]:
        """Along the line of a stroke, ahead of the hand by no more than it takes."""
        state, along = self._env.simulation.state, stroke.direction
        before, turn = state.centre(self._name)[:2].copy(), state.rotation(self._name).copy()
        harder, last = 0.0, state.hand.copy()
        for _ in range(4 * PATIENCE):
            moved = state.centre(self._name)[:2] - before
            done = float(moved @ along)
            aside = abs(float(moved[1] * along[0] - moved[0] * along[1]))
            now = turn.T @ state.rotation(self._name)
            turned = abs(math.atan2(now[1, 0] - now[0, 1], now[0, 0] + now[1, 1]))
            if stroke.length - done < ARRIVED or aside > ASTRAY or turned > TURNED:
                return
            hand = state.hand.copy()
            stuck = float(np.linalg.norm(hand - last)) < MOVING
            harder, last = (min(harder + HARDER, HARDEST) if stuck else 0.9 * harder), hand
            lead = min(LEADS[1], max(LEADS[0], 0.5 * (stroke.length - done))) + harder
            far = float((hand - stroke.start)[:2] @ along) + lead
            position = stroke.start + far * np.array([*along, 0.0])
            yield self._servo.towards(position, stroke.rotation, fingers)[0]

    def _go(self, position: Array, fingers: float, tolerance: float) -> Iterator[NDArray[np.float32]]:
        for _ in range(PATIENCE):
            action, error = self._servo.towards(position, self._rotation, fingers)
            if error < tolerance:
                return
            yield action
