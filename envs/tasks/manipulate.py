"""Tasks about one object: pick it up, put it somewhere, stack it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from pat3d.assets.asset import Region
from pat3d.envs.grasp import narrowest
from pat3d.envs.placement import Needs
from pat3d.envs.predicates import at_rest, inside, on_top
from pat3d.envs.state import SimState
from pat3d.envs.tasks.room import has_room, overhang_room
from pat3d.envs.tasks.task import (
    Judge,
    Task,
    Timer,
    Verdict,
    centre_of_mass,
    closeness,
    movable,
    origin,
    point,
    present,
    standing_on,
)
from pat3d.errors import TaskError
from pat3d.scene import Scene

LIFT = 0.10
"""[m]"""

HOLD_SECONDS = 1.0
REST_SECONDS = 0.5

CARRY_HEIGHT = 0.12
"""Above a container or a base, where the hand has to get [m]."""


@dataclass(frozen=True, kw_only=True)
class Pick(Task):
    """Lift an object by 10 cm and hold it for a second."""

    kind: ClassVar[str] = "pick"
    form: ClassVar[str] = "pick:OBJECT"

    target: str

    def instruction(self, scene: Scene) -> str:
        return f"pick up the {self.target}{origin(scene, self.target)}"

    def check(self, scene: Scene) -> None:
        movable(scene, self.target)

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,))

    def begin(self, state: SimState) -> Judge:
        return LiftJudge(self.target, state)


class LiftJudge(Judge):
    """Success when the object has been 10 cm up in the robot's hand for a second.

    Progress, each a quarter: the hand's closeness, both fingers on the object, the height, the time held.
    """

    def __init__(self, target: str, state: SimState) -> None:
        self._target, self._timer = target, Timer(HOLD_SECONDS)
        start = state.start_centre(target)
        self._goal = point(start + [0.0, 0.0, LIFT])

    def update(self, state: SimState, seconds: float) -> Verdict:
        centre, touched = state.centre(self._target), state.touched(self._target)
        rise = float(centre[2] - state.start_centre(self._target)[2])
        lifted = rise >= LIFT and touched
        held = self._timer.update(lifted, seconds)
        near = closeness(math.dist(state.hand, centre), 0.2)
        grasped = state.held(self._target)
        progress = (
            near + float(grasped) + min(max(rise, 0.0) / LIFT, 1.0) * float(touched)
            + min(self._timer.held / HOLD_SECONDS, 1.0)
        ) / 4.0  # fmt: skip
        return Verdict(
            success=held,
            predicates={"grasped": grasped, "lifted": lifted, "held": held},
            progress=1.0 if held else progress,
            target=self._target,
            goal=self._goal,
        )


@dataclass(frozen=True, kw_only=True)
class Place(Task):
    """Put an object into a container, or onto something that has no inside, and let go."""

    kind: ClassVar[str] = "place"
    form: ClassVar[str] = "place:OBJECT:WHERE"

    target: str
    where: str

    def instruction(self, scene: Scene) -> str:
        return f"put the {self.target} {_preposition(scene, self.where)} the {self.where}"

    def check(self, scene: Scene) -> None:
        check_move(scene, self.target, self.where)
        if scene.parent(self.target) == self.where:
            raise TaskError(f'"{self.target}" is {_preposition(scene, self.where)} "{self.where}" already.')

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,), visit=(above(scene, self.where),))

    def begin(self, state: SimState) -> Judge:
        return PutJudge(self.target, self.where, state)


@dataclass(frozen=True, kw_only=True)
class Stack(Task):
    """Put an object on top of another that stays upright."""

    kind: ClassVar[str] = "stack"
    form: ClassVar[str] = "stack:OBJECT:BASE"

    target: str
    base: str

    def instruction(self, scene: Scene) -> str:
        return f"stack the {self.target} on the {self.base}"

    def check(self, scene: Scene) -> None:
        check_move(scene, self.target, self.base)
        if scene.parent(self.target) == self.base:
            raise TaskError(f'"{self.target}" is on "{self.base}" already.')
        if scene[self.base].asset.region("in") is not None:
            raise TaskError(f'"{self.base}" is a container; use "place:{self.target}:{self.base}".')

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,), visit=(above(scene, self.base),))

    def begin(self, state: SimState) -> Judge:
        return PutJudge(self.target, self.base, state, stacked=True)


class PutJudge(Judge):
    """Success when the object has rested in or on its place, untouched, for half a second.

    Progress: a fifth each for the hand's closeness and the grasp (kept once the object rests in place), two fifths for
    the object's closeness to its place, a fifth for resting there.
    """

    def __init__(self, target: str, where: str, state: SimState, *, stacked: bool = False) -> None:
        self._target, self._where, self._stacked = target, where, stacked
        self._timer = Timer(REST_SECONDS)

    def update(self, state: SimState, seconds: float) -> Verdict:
        region = None if self._stacked else state.scene[self._where].asset.region("in")
        if region is not None:
            relation, there = "in", inside(state, self._target, self._where)
        else:
            relation, there = "on", on_top(state, self._target, self._where)
            region = state.scene[self._where].asset.region("on")
        released, upright = at_rest(state, self._target), self._where not in state.toppled()
        done = self._timer.update(there and released and upright, seconds)
        goal = _goal(state, self._target, self._where, region)
        centre = state.centre(self._target)
        held = state.held(self._target)
        near = closeness(float(np.linalg.norm(state.hand - centre)), 0.2)
        progress = 0.2 * (1.0 if there else near) + 0.2 * float(there or held) + 0.2 * float(there and released)
        progress += 0.4 * (1.0 if there else closeness(float(np.linalg.norm(goal - centre)), 0.25))
        return Verdict(
            success=done,
            predicates={relation: there, "released": released, "upright": upright},
            progress=1.0 if done else min(progress, 1.0),
            target=self._target,
            goal=point(goal),
        )


def _goal(state: SimState, target: str, where: str, region: Region | None) -> np.ndarray:
    """Where the centre of `target` would be in or on `where` [m]."""
    floor = np.zeros(3) if region is None else np.array(region.floor)
    half_height = float(state.scene[target].asset.size[2]) / 2
    return state.position(where) + state.rotation(where) @ floor + [0.0, 0.0, half_height]


def above(scene: Scene, where: str) -> tuple[float, float, float]:
    """A point over the middle of a container or a base [m]."""
    obj = scene[where]
    region = obj.asset.region("in") or obj.asset.region("on")
    points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])
    middle = obj.pose.apply(np.array([region.floor]))[0] if region else centre_of_mass(scene, where)
    return point([*middle[:2], points[:, 2].max() + CARRY_HEIGHT])


def check_move(scene: Scene, target: str, where: str) -> None:
    """Raise TaskError unless `target` can be moved into or onto `where` as far as sizes and the scene tree go."""
    movable(scene, target)
    present(scene, where)
    if target == where:
        raise TaskError(f'"{target}" cannot be put into or onto itself.')
    above_target = where
    while above_target in {obj.name for obj in scene.objects}:
        above_target = scene.parent(above_target)
        if above_target == target:
            raise TaskError(f'"{where}" stands on "{target}".')
    region = scene[where].asset.region("in")
    if region is not None:
        width, room = narrowest(scene[target]), 2 * min(region.half_size)
        if width > room:
            raise TaskError(f'"{target}" ({width:.2f} m) does not fit into "{where}" ({room:.2f} m wide inside).')
        return
    covering = [name for name in standing_on(scene, where) if name != target]
    top = scene[where].asset.region("on")
    if top is None or min(top.half_size) < overhang_room(scene, target):
        raise TaskError(f'"{where}" has no top wide enough for "{target}".')
    if not has_room(scene, target, where, top, covering):
        raise TaskError(f'"{covering[0]}" stands on "{where}" already and leaves no room for "{target}".')


def _preposition(scene: Scene, where: str) -> str:
    """What one says of things there: a plate has an inside too, but its first region is its top."""
    regions = scene[where].asset.regions
    return regions[0].kind if regions else "on"
