"""How to move a drawer along its way: fingertips behind its handle pull it out, before it they push it in.

The fingers are closed, point down and stand in the gap between the handle's bar and the front, which is wider than
they are; nothing is gripped, so that the hand does not twist the drawer in its cabinet.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from pat3d.envs.grasping.hand import hand_rotation
from pat3d.envs.physics.snapshot import Array
from pat3d.envs.tasks.drawers import HANDLE_ABOVE, at_handle
from pat3d.envs.tasks.moves import Planner
from pat3d.envs.tasks.task import Slide
from pat3d.errors import TaskError

BELOW = 0.012
"""Of fingertips under the middle of the bar [m]."""

MARGIN = 0.03
"""Least distance of every joint from its limits [rad]."""


@dataclass(frozen=True, kw_only=True)
class Pull:
    """One straight way of the hand."""

    above: Array
    """Position of the hand over where it begins [m], shape (3,)."""
    start: Array
    """Where it begins [m]."""
    direction: Array
    """Of the drawer and the hand, shape (3,)."""
    length: float
    """Of the drawer's way [m]."""
    rotation: Array
    """Of the hand, shape (3, 3)."""


class PullPlanner(Planner):
    """Plans for one drawer at a time; see `Planner`."""

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self.margin = MARGIN

    def pull(self, slide: Slide) -> Pull:
        """The way of the hand that does `slide`, the fingers either way round.

        Raises:
            TaskError: the arm does not get there, or would be in something.
        """
        state, gripper = self._env.simulation.state, self._gripper
        kind, direction = ("open", slide.front) if slide.by > 0.0 else ("close", -slide.front)
        own = at_handle(self._env.scene[slide.name].asset, kind)
        start = state.position(slide.name) + state.rotation(slide.name) @ own + [0.0, 0.0, gripper.tip - BELOW]
        above = start + [0.0, 0.0, HANDLE_ABOVE]
        along = math.atan2(slide.front[1], slide.front[0]) + math.pi / 2
        closed = np.array(gripper.closed_joints)
        length = abs(slide.by)
        found: list[tuple[float, Pull]] = []
        for half in (0.0, math.pi):
            rotation = hand_rotation(along + half, gripper.closing_axis)
            turn = 0.0
            for place in (above, start, start + length * direction):
                joints = self._reached(place, rotation)
                if joints is None or self._blocked(joints, closed, slide.name):
                    break
                turn = max(turn, float(np.abs(joints - self._env.simulation.arm).max()))
            else:
                way = Pull(above=above, start=start, direction=direction, length=length, rotation=rotation)
                found.append((turn, way))
        if found:
            # The wrist turns the shorter way.
            return min(found, key=lambda one: one[0])[1]
        met = self.obstacles.most_common(1)
        why = f'its hand would be in "{met[0][0]}"' if met else "its arm does not get there"
        raise TaskError(f'{self._env.robot} finds no way to move "{slide.name}" by its handle: {why}.')
