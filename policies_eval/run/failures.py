"""Why an episode failed, counted from the state of the simulation after every control step.

One outcome an episode, the first of these that holds:

    policy_error      the policy did what no policy may
    simulation_error  the simulation blew up
    success
    timed_out         the task was still getting on when the time was over
    toppled           an object that is none of the task's was knocked over or off its surface
    dropped           an object of the task was lost from at least 2 cm above its place, or fell off the surface
    slipped           it was held and lost before that
    collided          it was never held, and the hand pushed it or something else by more than 2 cm
    missed            it was never held
    timed_out         held or put somewhere, but the task was not done in time

Getting on means: within the last two seconds, further than ever before in the episode.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

OUTCOMES = (
    "success",
    "missed",
    "slipped",
    "dropped",
    "toppled",
    "collided",
    "timed_out",
    "policy_error",
    "simulation_error",
)

LIFTED = 0.02
"""Higher than this above its start an object is in the air [m]."""

PUSHED = 0.02
"""An object that was moved this far without being held was pushed [m]."""

GETTING_ON = 2.0
"""Before the end [s]."""

FURTHER = 0.01
"""By this much at least, of a progress from 0 to 1."""

LOST_STEPS = 3
"""Control steps without a finger on it after which an object is no longer held."""


@dataclass(frozen=True, kw_only=True)
class Events:
    """What happened in an episode."""

    grasped: bool
    """Both fingers were on an object of the task."""
    lifted: bool
    """It was in the hand at least 2 cm above its start."""
    slipped: bool
    """It was lost from the hand below that."""
    dropped: bool
    """It was lost from the hand in the air, and fell."""
    toppled: tuple[str, ...]
    """Objects that turned over or fell from the surface, those of the task too."""
    collided: tuple[str, ...]
    """Other objects that the robot pushed by more than 2 cm."""
    closest: float
    """Least distance between the hand and the centre of an object of the task [m]."""
    highest: float
    """Greatest rise of an object of the task in the hand [m]."""


class Watcher:
    """Follows one episode.

    Args:
        env: the TabletopEnv, after its reset.
    """

    def __init__(self, env: Any) -> None:
        self._env = env
        state = env.simulation.state
        self._targets = tuple(env.task.needs(env.scene).grasp)
        self._start = {obj.name: state.centre(obj.name).copy() for obj in env.scene.objects}
        self._lost = dict.fromkeys(self._targets, 0)
        self._height = dict.fromkeys(self._targets, 0.0)
        self._holding: set[str] = set()
        self._grasped = self._lifted = self._slipped = self._dropped = False
        self._toppled: dict[str, None] = {}
        self._touched: set[str] = set()
        self._collided: dict[str, None] = {}
        self._closest, self._highest = np.inf, 0.0
        self._furthest = float(env.verdict.progress)
        self._idle = math.inf
        """Control steps since it was further than ever before."""
        self._patience = GETTING_ON * env.control_freq

    def update(self, info: dict[str, Any]) -> None:
        """Look at the state after a control step, whose `info` the environment gave."""
        state = self._env.simulation.state
        hand = state.hand.tolist()
        self._idle += 1
        if info["progress"] > self._furthest + FURTHER:
            self._furthest, self._idle = info["progress"], 0
        self._toppled.update(dict.fromkeys((*info["toppled"], *info["fell"])))
        for name in self._targets:
            centre = state.centre(name).tolist()
            rise = centre[2] - float(self._start[name][2])
            self._closest = min(self._closest, math.dist(hand, centre))
            if state.held(name):
                self._holding.add(name)
                self._lost[name], self._grasped = 0, True
                self._height[name] = rise
                self._highest = max(self._highest, rise)
                self._lifted |= rise > LIFTED
            elif name in self._holding:
                self._lost[name] += not state.touched(name)
                if self._lost[name] >= LOST_STEPS:
                    self._holding.discard(name)
                    self._released(name, rise)
        for name in info["touched"]:
            self._touched.add(name)
        for name in self._touched:
            if name not in self._targets and np.linalg.norm(state.centre(name) - self._start[name]) > PUSHED:
                self._collided[name] = None

    def _released(self, name: str, rise: float) -> None:
        """An object left the hand: put down is fine, fallen or slid out is not."""
        held_at = self._height[name]
        if held_at > LIFTED:
            self._dropped |= held_at - rise > LIFTED / 2
        else:
            self._slipped = True

    def events(self) -> Events:
        """What has happened so far."""
        return Events(
            grasped=self._grasped,
            lifted=self._lifted,
            slipped=self._slipped,
            dropped=self._dropped,
            toppled=tuple(self._toppled),
            collided=tuple(self._collided),
            closest=float(self._closest) if np.isfinite(self._closest) else -1.0,
            highest=float(self._highest),
        )

    def outcome(self, *, success: bool, broken: bool) -> str:
        """The one name of how the episode ended, policy errors aside."""
        if broken:
            return "simulation_error"
        if success:
            return "success"
        if self._idle < self._patience:
            return "timed_out"
        if any(name not in self._targets for name in self._toppled):
            return "toppled"
        if self._dropped or (self._grasped and self._toppled):
            return "dropped"
        if self._slipped:
            return "slipped"
        if not self._grasped:
            return "collided" if self._collided or self._pushed_target() else "missed"
        return "timed_out"

    def _pushed_target(self) -> bool:
        state = self._env.simulation.state
        return any(float(np.linalg.norm(state.centre(name) - self._start[name])) > PUSHED for name in self._targets)
