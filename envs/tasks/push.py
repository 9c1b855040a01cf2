"""Pushing an object along the table without lifting it: what is too wide or too flat for fingers can be moved so."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.grasping.site import BENCH_RIM, Site
from pat3d.envs.physics.snapshot import Array
from pat3d.envs.tasks.goals import FARTHEST, footprint, footprint_gap, on_table, points_of
from pat3d.envs.tasks.naming import the
from pat3d.envs.tasks.paraphrase import worded
from pat3d.envs.tasks.push_goals import THERE, Edge, Outlook, Spot, Touching, Where, where_to
from pat3d.envs.tasks.task import Goal, Judge, Task, centre_of_mass, children, movable, present, steps_for
from pat3d.errors import TaskError
from pat3d.scene.model import GROUND, Scene

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States

FLATTEST = 0.012
"""Lower things slip under fingers that do not scrape the table [m]."""

BEHIND = 0.06
"""Room for the hand behind what it pushes [m]."""

LEVEL = 0.015
"""Height of fingertips that push, when it is asked where the robot may stand [m]."""

FREE = 0.02
"""Kept between an object at a drawn goal and everything else [m]."""

MOVES = 2
"""Of which the time limit is made: a push may take two strokes, and another to correct them."""

_TRIES = 200
_NEAREST, _FARTHEST = 0.10, 0.30
_POINT = re.compile(r"(.+?)@(-?\d{1,2}(?:\.\d{1,6})?),(-?\d{1,2}(?:\.\d{1,6})?)")


@dataclass(frozen=True, kw_only=True)
class Push(Task):
    """Push an object to where it should be, never lift it, and let it rest there."""

    kind: ClassVar[str] = "push"
    form: ClassVar[str] = (
        "push:OBJECT:WHERE or push:OBJECT@X,Y, where WHERE is an object, left, right or front edge, or as 20 cm right"
    )

    target: str
    where: Where

    @property
    def spec(self) -> str:
        between = "" if isinstance(self.where, Spot) else ":"
        return f"{self.kind}:{self.target}{between}{self.where.text}"

    @property
    def names(self) -> tuple[str, ...]:
        return (self.target, *self.where.names)

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        where = self.where.words(*(the(scene, name) for name in self.where.names))
        return worded("push", it=the(scene, self.target), where=where)

    def targets(self, scene: Scene) -> Mapping[str, tuple[float, float]]:
        outlook = self._at_rest(scene)
        ways = self.where.ways(outlook)
        x, y = outlook.centre + (ways[0] if ways else 0.0)
        return {self.target: (float(x), float(y))}

    def check(self, scene: Scene) -> None:
        movable(scene, self.target)
        for name in self.where.names:
            present(scene, name)
        if self.target in self.where.names:
            raise TaskError(f'"{self.target}" cannot be pushed next to itself.')
        if scene.parent(self.target) != GROUND:
            raise TaskError(f'"{self.target}" does not stand on the table and cannot be pushed along it.')
        if children(scene, self.target):
            raise TaskError(f'"{self.target}" carries something and cannot be pushed on its own.')
        height = float(np.ptp(points_of(scene, self.target)[:, 2]))
        if height < FLATTEST:
            raise TaskError(f'"{self.target}" ({1e3 * height:.0f} mm high) is too flat for fingers that push it.')
        outlook = self._at_rest(scene)
        if isinstance(self.where, Edge) and outlook.bench is None:
            raise TaskError("edges are those of a workbench, and the scene has a table of its own.")
        ways = self.where.ways(outlook)
        if not ways:
            raise TaskError(f'"{self.target}" is where it should be pushed already.')
        blocked = [self._blocked(scene, way) for way in ways]
        if all(blocked):
            raise TaskError(f'where "{self.target}" should be pushed is "{blocked[0]}".')

    def _at_rest(self, scene: Scene) -> Outlook:
        own, centre = points_of(scene, self.target)[:, :2], centre_of_mass(scene, self.target)[:2]
        other = points_of(scene, self.where.names[0])[:, :2] if self.where.names else None
        return Outlook(own=own, centre=centre, start=centre, other=other, bench=bench_at_rest(scene, self.target))

    def _blocked(self, scene: Scene, way: Array) -> str:
        """What stands where the object would get to [m], seen from above; nothing where it is free."""
        low, high = footprint(scene, self.target)
        final = low + way, high + way
        others = (name for name in on_table(scene) if name not in (self.target, *self.where.names))
        return next((name for name in others if footprint_gap(final, footprint(scene, name)) <= 0.0), "")

    def needs(self, scene: Scene) -> Needs:
        outlook = self._at_rest(scene)
        way = (self.where.ways(outlook) or [np.zeros(2)])[0]
        length = float(np.linalg.norm(way))
        along = way / length if length else np.array([1.0, 0.0])
        back = outlook.centre + along * (float((outlook.own @ along).min() - outlook.centre @ along) - BEHIND)
        ends = (back, back + way)
        visit = tuple((float(x), float(y), LEVEL) for x, y in ends)
        return Needs(push=(self.target,), visit=visit, facing=not isinstance(self.where, Spot | Touching))

    def horizon(self, scene: Scene, control_freq: float) -> int:
        return steps_for(MOVES, control_freq)

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        return [Goal(name=self.target)] if self.ways(state) else []

    def ways(self, state: SimState) -> list[Array]:
        """By which the object may be moved now so that it is where it should be [m], best first; none when it is."""
        return self.where.ways(
            Outlook(
                own=state.points(self.target)[:, :2],
                centre=state.centre(self.target)[:2].copy(),
                start=state.start_centre(self.target)[:2],
                other=state.points(self.where.names[0])[:, :2] if self.where.names else None,
                bench=state.world.placement.bench,
            )
        )

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.push_judge import PushJudge

        return PushJudge(states, self.target, self.where)


def push_task(arguments: list[str]) -> Push:
    """The task with these arguments: "book", "right edge"; or "book@0.1,0.2".

    Raises:
        TaskError: they are something else.
    """
    text = ":".join(arguments)
    point = _POINT.fullmatch(text)
    if point is not None:
        at = (float(point[2]), float(point[3]))
        if any(not (math.isfinite(value) and abs(value) <= FARTHEST) for value in at):
            raise TaskError(f"points are within {FARTHEST:g} m of the scene's origin.")
        return Push(target=point[1].strip(), where=Spot(at=at))
    if len(arguments) != 2 or not all(arguments) or "@" in text:
        raise TaskError(f'"{Push.kind}:{text}" does not fit "{Push.form}".')
    return Push(target=arguments[0], where=where_to(arguments[1]))


def drawn_push(scene: Scene, name: str, random: np.random.Generator) -> Push:
    """A task for one object of a scene: a point drawn on the table, to which it can be pushed as far as sizes go.

    Raises:
        TaskError: no such point was found.
    """
    centre = centre_of_mass(scene, name)[:2]
    own = footprint(scene, name)
    others = [footprint(scene, one) for one in on_table(scene) if one != name]
    for _ in range(_TRIES):
        angle, length = float(random.uniform(-math.pi, math.pi)), float(random.uniform(_NEAREST, _FARTHEST))
        way = length * np.array([math.cos(angle), math.sin(angle)])
        along = way / length
        # From behind the object to where it should get: room for the hand and for the object itself.
        passed = [along * far for far in (*np.arange(-BEHIND, length, FREE), length)]
        if all(footprint_gap((own[0] + one, own[1] + one), box) > FREE for one in passed for box in others):
            x, y = (round(float(value), 3) for value in centre + way)
            if math.dist((x, y), centre) > THERE:
                return Push(target=name, where=Spot(at=(x, y)))
    raise TaskError(f'no point of the table is free for "{name}".')


def drawn_shift(scene: Scene, name: str, random: np.random.Generator) -> Push:
    """The same with a distance along one of the scene's axes, or to an edge of the table.

    Raises:
        TaskError: nothing of that is possible.
    """
    texts = ["left edge", "right edge", "front edge"]
    texts += [f"{cm} cm {side}" for side in ("left", "right", "front", "back") for cm in (10, 15, 20, 25)]
    for number in random.permutation(len(texts)).tolist():
        task = Push(target=name, where=where_to(texts[number]))
        try:
            task.check(scene)
        except TaskError:
            continue
        return task
    raise TaskError(f'"{name}" can be pushed to no side.')


def drawn_neighbour(scene: Scene, name: str, random: np.random.Generator) -> Push:
    """The same with something else on the table, next to which it should get.

    Raises:
        TaskError: there is nothing of that kind.
    """
    others = [one for one in on_table(scene) if one != name and not children(scene, one)]
    for number in random.permutation(len(others)).tolist():
        task = Push(target=name, where=where_to(others[number]))
        try:
            task.check(scene)
        except TaskError:
            continue
        return task
    raise TaskError(f'there is nothing to which "{name}" could be pushed.')


def bench_at_rest(scene: Scene, name: str) -> tuple[tuple[float, float], tuple[float, float]] | None:
    """Lower and upper corner of the workbench [m], but for the room that the robot takes; None for a scene without one.

    Args:
        scene: at rest.
        name: of what is moved.
    """
    site = Site.of(scene, Needs(push=(name,)))
    if not site.bench:
        return None
    low = np.min([box[0][:2] for box in site.boxes.values()], axis=0) - BENCH_RIM
    high = np.max([box[1][:2] for box in site.boxes.values()], axis=0) + BENCH_RIM
    return (float(low[0]), float(low[1])), (float(high[0]), float(high[1]))
