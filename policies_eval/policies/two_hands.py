"""What the scripted policy does with two arms at once: carry something together, hand it over.

Each arm has its own grasp of the object, found where the scene is at rest; it follows the object as that moves.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.placement import HOVER
from pat3d.envs.grasping.scripted import Servo
from pat3d.envs.robots.pairs import SIDES
from pat3d.envs.tasks.hands import LIFT, TakingHand, hands_of
from pat3d.envs.tasks.together import Carry, HandOver

Array = NDArray[np.float64]
Aim = Callable[[], tuple[Array, Array]]
"""Where a hand should be now: position [m] and rotation of its grip site."""

STEP = 0.006
"""By how much the object is raised in a control step [m]."""

RISE, FURTHER = 0.13, 0.15
"""What was handed over is held up until its centre has risen by so much, or the hand by so much more [m]."""

OPEN, CLOSED = -1.0, 1.0
CLOSE_STEPS, OPEN_STEPS = 18, 12
NEAR, EXACT = 0.02, 0.006
"""Errors at which a hand is there on the way, and where it takes something [m]."""

DEEPER = (0.0, 0.006)
"""How much further down than its grasp the second hand takes what slipped out of its fingers [m]."""

PASSING = 0.03
"""Between the fingers and what they pass above [m]."""

PATIENCE = 60
"""Control steps after which a move is over anyway."""

TWO_HANDED = (Carry.kind, HandOver.kind)


class TwoHands:
    """Does a task of `TWO_HANDED`.

    Args:
        env: a TabletopEnv with two arms, after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env = env
        self._name = env.task.names[0]
        self._servos = {side: Servo(env, side) for side in SIDES}
        self._fingers = dict.fromkeys(SIDES, OPEN)
        self._holds = {side: self._now(side) for side in SIDES}
        """Aims of hands that have nothing to do."""
        pose = env.scene[self._name].pose
        self._rest = pose.rotation, np.array(pose.position)
        hands, _ = hands_of(env, at_once=env.task.kind == Carry.kind)
        self._grasps = {side: hand.pose for side, hand in hands.items()}
        self._high = {side: self._passing(hand) for side, hand in hands.items()}
        """How far above its grasp each hand comes from the side [m]."""
        self._script = self._carry() if env.task.kind == Carry.kind else self._hand_over()

    def act(self) -> NDArray[np.float32]:
        """The next action, of both arms."""
        return next(self._script)

    def _carry(self) -> Iterator[NDArray[np.float32]]:
        yield from self._go({side: self._over(side, self._high[side]) for side in SIDES}, NEAR)
        yield from self._go({side: self._over(side, HOVER) for side in SIDES}, NEAR)
        yield from self._go({side: self._over(side, 0.0) for side in SIDES}, EXACT)
        yield from self._grip({side: self._now(side) for side in SIDES}, CLOSED)
        yield from self._raise(SIDES)

    def _hand_over(self) -> Iterator[NDArray[np.float32]]:
        """From the left hand to the right one, again from the start where it falls."""
        left, right = SIDES
        while True:
            yield from self._go({left: self._over(left, self._high[left])}, NEAR)
            yield from self._take(left, 0.0)
            if self._holding(left):
                yield from self._raise((left,), LIFT)
                yield from self._give(left, right)
            if self._holding(right) and not self._holding(left):
                break
            yield from self._grip({side: self._now(side) for side in SIDES}, OPEN, OPEN_STEPS)
            yield from self._withdraw(right)
            yield from self._withdraw(left)
        yield from self._hold_up(right)
        yield from self._wait()

    def _give(self, left: str, right: str) -> Iterator[NDArray[np.float32]]:
        """The right hand takes what the left one holds, deeper each time, and the left one lets go once it has it."""
        for deeper in DEEPER:
            yield from self._take(right, -deeper)
            if self._holding(right):
                yield from self._grip({left: self._now(left)}, OPEN, OPEN_STEPS)
                yield from self._withdraw(left)
                return
            if not self._holding(left):
                return
            yield from self._grip({right: self._now(right)}, OPEN, OPEN_STEPS)

    def _take(self, side: str, back: float) -> Iterator[NDArray[np.float32]]:
        """One hand to its grasp, or `back` above it [m], and its fingers closed there."""
        yield from self._go({side: self._over(side, HOVER)}, NEAR)
        yield from self._go({side: self._over(side, back)}, EXACT)
        yield from self._grip({side: self._now(side)}, CLOSED)

    def _withdraw(self, side: str) -> Iterator[NDArray[np.float32]]:
        position, rotation = self._now(side)()
        yield from self._go({side: self._fixed((position + [0.0, 0.0, HOVER], rotation))}, NEAR)

    def _holding(self, side: str) -> bool:
        return self._env.simulation.state.holding(self._name)[SIDES.index(side)]

    def _go(self, aims: dict[str, Aim], tolerance: float) -> Iterator[NDArray[np.float32]]:
        """Hands to where they should be; the others stay."""
        self._holds |= aims
        for _ in range(PATIENCE):
            action, errors = self._together()
            if max(errors[side] for side in aims) < tolerance:
                break
            yield action
        self._holds |= {side: self._fixed(aims[side]()) for side in aims}

    def _grip(self, aims: dict[str, Aim], fingers: float, steps: int = CLOSE_STEPS) -> Iterator[NDArray[np.float32]]:
        """Open or close hands where they are."""
        self._holds |= aims
        self._fingers |= dict.fromkeys(aims, fingers)
        for _ in range(steps):
            yield self._together()[0]

    def _raise(self, sides: tuple[str, ...], height: float | None = None) -> Iterator[NDArray[np.float32]]:
        """Hands straight up, slowly and side by side; they stay there for ever without a `height`."""
        start = {side: self._holds[side]() for side in sides}
        for step in range(1, math.ceil(LIFT / STEP) + 1):
            up = np.array([0.0, 0.0, min(step * STEP, LIFT)])
            self._holds |= {side: self._fixed((start[side][0] + up, start[side][1])) for side in sides}
            yield self._together()[0]
        if height is None:
            yield from self._wait()

    def _hold_up(self, side: str) -> Iterator[NDArray[np.float32]]:
        """One hand further up, as far as what it holds has sunk: what is taken beside its middle hangs askew."""
        state, (position, rotation) = self._env.simulation.state, self._holds[side]()
        for step in range(1, math.ceil(FURTHER / STEP) + 1):
            if float(state.centre(self._name)[2] - state.start_centre(self._name)[2]) >= RISE:
                break
            self._holds[side] = self._fixed((position + [0.0, 0.0, step * STEP], rotation))
            yield self._together()[0]

    def _wait(self) -> Iterator[NDArray[np.float32]]:
        while True:
            yield self._together()[0]

    def _together(self) -> tuple[NDArray[np.float32], dict[str, float]]:
        """The action of both hands towards their aims, and how far each is from its own [m]."""
        found = {side: self._servos[side].towards(*self._holds[side](), self._fingers[side]) for side in SIDES}
        # Each is of all arms, in which the other one holds still.
        return np.sum([action for action, _ in found.values()], axis=0), {s: error for s, (_, error) in found.items()}

    def _passing(self, hand: TakingHand) -> float:
        """Above its grasp and above everything that stands there [m], as far as the arm gets up."""
        state = self._env.simulation.state
        highest = max(float(state.points(obj.name)[:, 2].max()) for obj in self._env.scene.objects)
        wanted = highest + hand.tip + PASSING - float(hand.pose[0][2])
        heights = np.arange(wanted, HOVER, -PASSING)
        return next((float(up) for up in heights if hand.joints(float(up)) is not None), HOVER)

    def _over(self, side: str, back: float) -> Aim:
        """The grasp of one hand, or before it along the world's vertical, as the object is now."""

        def aim() -> tuple[Array, Array]:
            state, (rotation, position) = self._env.simulation.state, self._rest
            turn = state.rotation(self._name) @ rotation.T
            at, own = self._grasps[side]
            moved = turn @ (at - position) + state.position(self._name)
            return moved + [0.0, 0.0, back], turn @ own

        return aim

    def _now(self, side: str) -> Aim:
        position, rotation, _ = self._servos[side].hand
        return self._fixed((position.copy(), rotation.copy()))

    def _fixed(self, pose: tuple[Array, Array]) -> Aim:
        return lambda: pose
