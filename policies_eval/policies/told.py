"""What a task needs, told by the environment: the object to move next, where it goes, its shape and what is around it.

A policy that is told this has neither to understand the instruction nor to find anything. What it still has to learn is
how to take an object of such a shape and how to bring it to its place.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.height_grid import HeightGrid
from pat3d.envs.grasping.spots import free_spots, spots_over
from pat3d.envs.tasks.task import Goal
from pat3d.geometry.pose import Pose

Array = NDArray[np.float64]

SIDE = 12
"""Cells along a side of a map of what is around an object."""

STEP = 5
"""Cells of `pat3d.envs.grasping.height_grid` along one of those."""

DEEPEST = 0.15
"""Heights in a map are told down to this below the object's top, and as far up [m]."""

HELD = 0.13
"""What is to be held is to be brought this far up [m]."""

FACTS = 9
"""Whether the object is to be held, to be put in or on something, or somewhere free; whether the robot touches it, it
rests, it touches something else, both fingers are on it; and for how long they have been, and have not been, as
shares of WHILE."""

WHILE = 12
"""Actions; who has held something for so long may be sure of it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Told:
    """What is told before an action; in the frame of the world but for the maps, which are turned as the arm faces."""

    pose: Array
    """Of the object to move: its centre of mass [m] and its rotation, shape (4, 3)."""
    goal: Array
    """Where its centre is to get [m], shape (3,)."""
    facts: Array
    """Shape (FACTS,)."""
    extents: Array
    """Of the object about its centre of mass, as the arm faces: lower and upper corner [m], shape (2, 3)."""
    maps: Array
    """Heights above the object's top, divided by DEEPEST: its own, and those of everything else, shape (2, SIDE, SIDE);
    -1 where nothing is that high. As they were before it was touched."""


class Teller:
    """Tells one episode.

    Args:
        env: a TabletopEnv after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env = env
        self._goal: Goal | None = None
        self._held_for, self._free_for = 0, WHILE

    def tell(self) -> Told:
        """What holds now."""
        env, state = self._env, self._env.simulation.state
        goal = self._next()
        if goal != self._goal:
            self._goal = goal
            self._place = self._aim(goal)
            self._maps = self._look(goal.name)
        name, centre = goal.name, state.centre(goal.name)
        bottom = float(centre[2] - state.points(name)[:, 2].min())
        wanted = self._place + [0.0, 0.0, bottom] if goal.where is not None else self._place
        others = (one.name for one in env.scene.objects if one.name != name)
        held = state.held(name)
        self._held_for = min(self._held_for + 1, WHILE) if held else 0
        self._free_for = 0 if held else min(self._free_for + 1, WHILE)
        facts = [
            goal.where is None, bool(goal.where), goal.where == "", state.touched(name), state.still(name),
            any(state.touch(name, one) for one in others), held, self._held_for / WHILE, self._free_for / WHILE,
        ]  # fmt: skip
        return Told(
            pose=np.vstack([centre, state.rotation(name)]),
            goal=wanted,
            facts=np.array(facts, dtype=np.float64),
            extents=self._extents(name),
            maps=self._maps,
        )

    def _next(self) -> Goal:
        """The goal that is being done until its object is let go and rests, then the first that is left."""
        state, before = self._env.simulation.state, self._goal
        if before is not None and (state.touched(before.name) or not state.still(before.name)):
            return before
        left = self._env.task.goals(state, tuple(self._env.placement.grasps))
        if left:
            return left[0]
        return before or Goal(name=next(iter(self._env.placement.grasps)))

    def _aim(self, goal: Goal) -> Array:
        """Where the lowest point of an object is to get, or its centre if it is to be held [m]."""
        env, state = self._env, self._env.simulation.state
        if goal.where is None:
            return state.start_centre(goal.name) + [0.0, 0.0, HELD]
        if goal.at is not None:
            return np.array([*goal.at, env.placement.surface if goal.height is None else goal.height])
        if goal.where:
            return spots_over(env, goal.name, goal.where, on=goal.on, more=goal.shared)[0]
        free = free_spots(env, goal.name)
        return free[0] if free else state.centre(goal.name).copy()

    def _facing(self) -> Array:
        c, s = math.cos(self._env.placement.yaw), math.sin(self._env.placement.yaw)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def _extents(self, name: str) -> Array:
        state = self._env.simulation.state
        around = (state.points(name) - state.centre(name)) @ self._facing()
        return np.stack([around.min(axis=0), around.max(axis=0)])

    def _look(self, name: str) -> Array:
        """The maps around an object as it is now."""
        state, scene = self._env.simulation.state, self._env.scene
        now = {
            obj.name: replace(obj, pose=Pose.from_matrix(state.rotation(obj.name), state.position(obj.name)))
            for obj in scene.objects
        }
        half = SIDE * STEP // 2
        # Wide enough for the square however it is turned.
        grid = HeightGrid(state.centre(name)[:2].copy(), math.ceil(math.sqrt(2.0) * half) + 1)
        own = grid.heights([now[name]])
        other = grid.heights([obj for key, obj in now.items() if key != name])
        top = float(state.points(name)[:, 2].max())
        maps = []
        for heights in (own, other):
            turned = grid.turned(heights, self._env.placement.yaw)[grid.half - half :, grid.half - half :]
            cells = turned[: 2 * half, : 2 * half].reshape(SIDE, STEP, SIDE, STEP).max(axis=(1, 3))
            maps.append(np.clip((cells - top) / DEEPEST, -1.0, 1.0))
        return np.stack(maps)
