"""What the scripted policy does to open or shut a drawer: one straight way of closed fingers, watched on the drawer."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.arms import measure_gripper
from pat3d.envs.tasks.pulls import Pull, PullPlanner
from pat3d.envs.tasks.task import Slide
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
"""Of the drawer in a control step, and how near to its end it is done [m]."""

LOOSE = 0.012
"""By which the hand goes back from what it has moved [m]."""

PASSING, AROUND = 0.04, 0.12
"""Kept above what the hand passes within this distance [m]."""


def move_drawer(env: Any, slide: Slide) -> Actions:
    """Actions that do `slide`; none where the arm does not get there."""
    planner, servo, gripper = PullPlanner(env), Servo(env), measure_gripper(env.robot)
    try:
        pull = planner.pull(slide)
    except TaskError:
        return
    state = env.simulation.state

    def go(position: Array, rotation: Array, tolerance: float) -> Actions:
        for _ in range(PATIENCE):
            action, error = servo.towards(position, rotation, 1.0)
            if error < tolerance:
                return
            yield action

    hand, now = state.hand.copy(), state.hand_rotation.copy()
    high = planner.passing(hand, pull.above, AROUND, "") + gripper.tip + PASSING
    high = max(high, float(pull.above[2]))
    yield from go(np.array([*hand[:2], max(high, float(hand[2]))]), now, NEAR)
    # What comes down beside its gap is stopped by the top of the cabinet.
    yield from go(np.array([*pull.above[:2], high]), pull.rotation, EXACT)
    for height in np.arange(high, float(pull.start[2]), -STEP):
        yield from go(np.array([*pull.start[:2], height]), pull.rotation, STRAIGHT)
    yield from go(pull.start, pull.rotation, EXACT)
    yield from _along(env, servo, slide.name, pull)
    hand = state.hand.copy()
    back = hand - LOOSE * pull.direction
    yield from go(back, pull.rotation, EXACT)
    yield from go(np.array([*back[:2], float(pull.above[2])]), pull.rotation, NEAR)


def _along(env: Any, servo: Servo, name: str, pull: Pull) -> Actions:
    """Along the way of a pull until the drawer has come far enough."""
    state = env.simulation.state
    begin, last, ahead = state.position(name).copy(), 0.0, LEAD
    for _ in range(4 * PATIENCE):
        done = float((state.position(name) - begin) @ pull.direction)
        if done > pull.length - ARRIVED:
            return
        ahead = min(ahead + HARDER, HARDEST) if done - last < MOVING else max(LEAD, 0.9 * ahead)
        last = done
        far = float((state.hand - pull.start) @ pull.direction) + ahead
        yield servo.towards(pull.start + far * pull.direction, pull.rotation, 1.0)[0]
