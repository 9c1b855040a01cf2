"""How to move a drawer or a door along its way: fingertips behind its handle open it, before it they shut it.

The fingers are closed, point down and stand in the gap between the handle's bar and the front, which is wider than
they are; nothing is gripped, so that the hand does not twist a drawer in its cabinet. With a door the hand turns.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from pat3d.envs.grasping.hand import hand_rotation
from pat3d.envs.physics.snapshot import Array
from pat3d.envs.tasks.mechanisms import Mechanism
from pat3d.envs.tasks.moves import Planner
from pat3d.envs.tasks.opening import HANDLE_ABOVE
from pat3d.envs.tasks.task import Opening
from pat3d.errors import TaskError
from pat3d.geometry.rotations import yaw_of

BELOW = 0.012
"""Of fingertips under the middle of the bar [m]."""

PASSING, AROUND = 0.04, 0.12
"""Kept above what the hand passes within this distance [m]."""

MARGIN = 0.03
"""Least distance of every joint from its limits [rad]."""

CHECKED = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Shares of a way at which it is looked whether the arm gets there."""


@dataclass(frozen=True, kw_only=True)
class Pull:
    """One way of the hand, by how much what it moves is opened from where it began (below zero: shut)."""

    by: float
    """All of it, in the unit of the way of the mechanism."""
    mechanism: Mechanism
    position: Array
    """Of the moved body at the beginning, in the frame of its holder [m], shape (3,)."""
    rotation: Array
    """The same, shape (3, 3)."""
    holder_position: Array
    """Of the holder [m], shape (3,)."""
    holder_rotation: Array
    """The same, shape (3, 3)."""
    tip: float
    """Of the hand over its fingertips, and of these under the bar [m]."""
    half: float
    """0 or pi: the fingers either way round [rad]."""
    closing_axis: Sequence[float]
    high: float = 0.0
    """Of the hand on its way there [m]."""

    @property
    def begin(self) -> float:
        """By how much the moved body is open at the beginning, in the unit of its way."""
        return float(self.mechanism.out(self.position[None], self.rotation[None])[0])

    @property
    def above(self) -> Array:
        """Position of the hand over where it begins [m], shape (3,)."""
        return self.hand(0.0)[0] + [0.0, 0.0, HANDLE_ABOVE]

    def hand(self, by: float) -> tuple[Array, Array]:
        """Pose of the hand after that much of the way, shapes (3,) and (3, 3)."""
        position, rotation = self.mechanism.moved(self.position, self.rotation, by)
        handle = position + rotation @ self.mechanism.at_handle("open" if self.by > 0.0 else "close")
        turned = self.holder_rotation @ rotation
        return (
            self.holder_position + self.holder_rotation @ handle + [0.0, 0.0, self.tip],
            hand_rotation(yaw_of(turned) + self.half, self.closing_axis),
        )

    def covered(self, hand: Array) -> float:
        """How much of the way the hand has covered, at a position of it [m]."""
        first, now = (self.holder_rotation.T @ (at - self.holder_position) for at in (self.hand(0.0)[0], hand))
        return self.mechanism.along(now) - self.mechanism.along(first)


class PullPlanner(Planner):
    """Plans for one drawer or door at a time; see `Planner`."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self.margin = MARGIN

    def pull(self, opening: Opening) -> Pull:
        """The way of the hand that does `opening`, the fingers either way round.

        Raises:
            TaskError: the arm does not get there, or would be in something.
        """
        state, gripper = self._env.simulation.state, self._gripper
        holder = state.rotation(opening.mechanism.holder)
        at = state.position(opening.mechanism.holder)
        closed = np.array(gripper.closed_joints)
        found: list[tuple[float, Pull]] = []
        for half in (0.0, math.pi):
            pull = Pull(
                by=opening.by,
                mechanism=opening.mechanism,
                position=holder.T @ (state.position(opening.name) - at),
                rotation=holder.T @ state.rotation(opening.name),
                holder_position=at.copy(),
                holder_rotation=holder.copy(),
                tip=gripper.tip - BELOW,
                half=half,
                closing_axis=gripper.closing_axis,
            )
            pull = replace(pull, high=self._high(opening, pull))
            turn, first = 0.0, pull.hand(0.0)[1]
            over = np.array([*pull.above[:2], pull.high])
            ways = [(over, first), (pull.above, first), *(pull.hand(share * pull.by) for share in CHECKED)]
            for place, rotation in ways:
                joints = self._reached(place, rotation)
                if joints is None or self._blocked(joints, closed, opening.name):
                    break
                turn = max(turn, float(np.abs(joints - self._env.simulation.arm).max()))
            else:
                found.append((turn, pull))
        if found:
            # The wrist turns the shorter way.
            return min(found, key=lambda one: one[0])[1]
        met = self.obstacles.most_common(1)
        why = f'its hand would be in "{met[0][0]}"' if met else "its arm does not get there"
        raise TaskError(f'{self._env.robot} finds no way to move "{opening.name}" by its handle: {why}.')

    def _high(self, opening: Opening, pull: Pull) -> float:
        """Height of the hand on its way to where it begins [m]; from in front it does not pass what it opens."""
        state, hand, above = self._env.simulation.state, self._env.simulation.state.hand, pull.above
        names: list[str] = []
        if (hand - above) @ (pull.holder_rotation @ pull.rotation)[:, 1] < 0.0:
            holder = opening.mechanism.holder
            inside = (obj.name for obj in self._env.scene.objects if obj.name != holder)
            names = [holder, *(name for name in inside if state.inside(name, holder)), opening.name]
        passed = self.passing(hand, above, AROUND, *names)
        return max(passed + self._gripper.tip + PASSING, float(above[2]))
