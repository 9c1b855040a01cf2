"""Tasks about one object: pick it up, put it somewhere, stack it."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from pat3d.envs.grasping.free_space import edge_margin, has_free_space
from pat3d.envs.grasping.grasp import narrowest
from pat3d.envs.grasping.placement import Needs
from pat3d.envs.tasks.naming import the
from pat3d.envs.tasks.paraphrase import listed, worded
from pat3d.envs.tasks.task import (
    Goal,
    Judge,
    Task,
    centre_of_mass,
    children,
    movable,
    origin,
    point,
    present,
    rests_upon,
    standing_on,
)
from pat3d.errors import TaskError
from pat3d.scene.model import GROUND, Scene

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States

CARRY_HEIGHT = 0.12
"""Above a container or a base, where the hand has to get [m]."""


@dataclass(frozen=True, kw_only=True)
class Pick(Task):
    """Lift an object by 10 cm and hold it for a second."""

    kind: ClassVar[str] = "pick"
    form: ClassVar[str] = "pick:OBJECT"
    from_the_side: ClassVar[bool] = True

    target: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return worded("pick", it=the(scene, self.target), source=origin(scene, self.target))

    def check(self, scene: Scene) -> None:
        movable(scene, self.target)

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,))

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        return [Goal(name=self.target)]

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.judges import LiftJudge

        return LiftJudge(states, self.target)


@dataclass(frozen=True, kw_only=True)
class Lift(Task):
    """Lift an object and put it back where it was: nothing in the scene shows afterwards that it was done."""

    kind: ClassVar[str] = "lift"
    form: ClassVar[str] = "lift:OBJECT"

    target: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return worded("lift", it=the(scene, self.target))

    def check(self, scene: Scene) -> None:
        movable(scene, self.target)
        if scene.parent(self.target) != GROUND or children(scene, self.target):
            raise TaskError(f'"{self.target}" does not stand on the table with nothing on it, and cannot be put back.')

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,), visit=(above(scene, self.target),))

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        x, y = state.start_centre(self.target)[:2]
        return [] if self.target in done else [Goal(name=self.target, where="", at=(float(x), float(y)))]

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.judges import LiftAndBackJudge

        return LiftAndBackJudge(states, self.target)


@dataclass(frozen=True, kw_only=True)
class Place(Task):
    """Put an object into a container, or onto something that has no inside, and let go."""

    kind: ClassVar[str] = "place"
    form: ClassVar[str] = "place:OBJECT:WHERE"

    target: str
    where: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return self.told(scene, [self.target])

    def told(self, scene: Scene, names: list[str]) -> tuple[str, ...]:
        """The wordings for several objects that go to the same place."""
        how, where = preposition(scene, self.where), the(scene, self.where)
        return worded("place", it=listed([the(scene, name) for name in names]), how=how, where=where)

    def check(self, scene: Scene) -> None:
        check_move(scene, self.target, self.where)
        if scene.parent(self.target) == self.where:
            raise TaskError(f'"{self.target}" is {preposition(scene, self.where)} "{self.where}" already.')

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,), visit=(above(scene, self.where),))

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        there = state.inside if state.scene[self.where].asset.region("in") is not None else state.on_top
        return [] if there(self.target, self.where) else [Goal(name=self.target, where=self.where)]

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.judges import PutJudge

        return PutJudge(states, self.target, self.where)


@dataclass(frozen=True, kw_only=True)
class Stack(Task):
    """Put an object on top of another that stays upright."""

    kind: ClassVar[str] = "stack"
    form: ClassVar[str] = "stack:OBJECT:BASE"

    target: str
    base: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return worded("stack", it=the(scene, self.target), where=the(scene, self.base))

    def check(self, scene: Scene) -> None:
        check_move(scene, self.target, self.base)
        if scene.parent(self.target) == self.base:
            raise TaskError(f'"{self.target}" is on "{self.base}" already.')
        if scene[self.base].asset.region("in") is not None:
            raise TaskError(f'"{self.base}" is a container; use "place:{self.target}:{self.base}".')

    def needs(self, scene: Scene) -> Needs:
        return Needs(grasp=(self.target,), visit=(above(scene, self.base),))

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        there = state.on_top(self.target, self.base)
        return [] if there else [Goal(name=self.target, where=self.base, on=True)]

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.judges import PutJudge

        return PutJudge(states, self.target, self.base, stacked=True)


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
    if rests_upon(scene, where, target):
        raise TaskError(f'"{where}" stands on "{target}".')
    region = scene[where].asset.region("in")
    if region is not None:
        width, inside = narrowest(scene[target]), 2 * min(region.half_size)
        if width > inside:
            raise TaskError(f'"{target}" ({width:.2f} m) does not fit into "{where}" ({inside:.2f} m wide inside).')
        return
    covering = [name for name in standing_on(scene, where) if name != target]
    top = scene[where].asset.region("on")
    if top is None or min(top.half_size) < edge_margin(scene, target):
        raise TaskError(f'"{where}" has no top wide enough for "{target}".')
    if not has_free_space(scene, target, where, top, covering):
        raise TaskError(f'"{covering[0]}" stands on "{where}" already and leaves no room for "{target}".')


def preposition(scene: Scene, where: str) -> Literal["on", "in"]:
    """What one says of things there: a plate has an inside too, but its first region is its top."""
    regions = scene[where].asset.regions
    return regions[0].kind if regions else "on"
