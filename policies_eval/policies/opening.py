"""What the scripted policy does to open or shut a drawer or a door: one way of closed fingers, until it is there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.tasks.opening import out_now
from pat3d.envs.tasks.pulls import Pull, PullPlanner
from pat3d.envs.tasks.task import Opening
from pat3d.errors import TaskError

Array = NDArray[np.float64]
Actions = Iterator[NDArray[np.float32]]

NEAR, EXACT = 0.02, 0.006
"""Errors at which a hand is there on the way, and where it matters [m]."""

STEP, STRAIGHT = 0.02, 0.008
"""The hand comes down by so much at a time, and so straight [m]."""

PATIENCE = 70
"""Control steps after which a move is over anyway."""

LEAD, HARDER, HARDEST = 0.02, 0.003, 0.06
"""How far the hand is sent ahead of itself; by how much more in every step in which nothing moves; at most [m]."""

MOVING, ARRIVED = 4e-4, 0.005
"""Of the handle in a control step, and how near to its end it is done [m]."""

LOOSE = 0.012
"""By which the hand goes back from what it has moved [m]."""


def move_along(env: Any, opening: Opening) -> Actions:
    """Actions that do `opening`; none where the arm does not get there."""
    servo = Servo(env)
    try:
        pull = PullPlanner(env).pull(opening)
    except TaskError:
        return
    state = env.simulation.state

    def go(position: Array, rotation: Array, tolerance: float) -> Actions:
        for _ in range(PATIENCE):
            action, error = servo.towards(position, rotation, 1.0)
            if error < tolerance:
                return
            yield action

    hand, now, above = state.hand.copy(), state.hand_rotation.copy(), pull.above
    start, turned = pull.hand(0.0)
    high = pull.high
    yield from go(np.array([*hand[:2], max(high, float(hand[2]))]), now, NEAR)
    # What comes down beside its gap is stopped by the top of what is there.
    yield from go(np.array([*above[:2], high]), turned, EXACT)
    for height in np.arange(high, float(start[2]), -STEP):
        yield from go(np.array([*start[:2], height]), turned, STRAIGHT)
    yield from go(start, turned, EXACT)
    yield from _along(env, servo, opening, pull)
    hand = state.hand.copy()
    back, turned = pull.hand(pull.covered(hand) - np.sign(pull.by) * LOOSE / pull.mechanism.lever)
    yield from go(np.array([*back[:2], hand[2]]), turned, EXACT)
    yield from go(np.array([*back[:2], float(above[2])]), turned, NEAR)


def _along(env: Any, servo: Servo, opening: Opening, pull: Pull) -> Actions:
    """Along the way of a pull until the drawer or door has come far enough."""
    state, lever, sign = env.simulation.state, pull.mechanism.lever, float(np.sign(pull.by))
    last, ahead = 0.0, LEAD
    for _ in range(4 * PATIENCE):
        done = sign * lever * (out_now(state, opening.name, pull.mechanism) - pull.begin)
        if done > lever * abs(pull.by) - ARRIVED:
            return
        ahead = min(ahead + HARDER, HARDEST) if done - last < MOVING else max(LEAD, 0.9 * ahead)
        last = done
        yield servo.towards(*pull.hand(pull.covered(state.hand) + sign * ahead / lever), 1.0)[0]
