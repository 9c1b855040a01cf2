"""Follows an object that is put beside another: the relation in all worlds at once, and that it rests on a surface."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array, Mask, Numbers, corners, floors
from pat3d.envs.tasks.beside_spots import Outlook, spots
from pat3d.envs.tasks.judges import REST_SECONDS, UPRIGHT
from pat3d.envs.tasks.push_goals import AROUND, DIRECTIONS, hull
from pat3d.envs.tasks.push_judge import STAYED
from pat3d.envs.tasks.task import Judge, Verdicts, centre_of_mass
from pat3d.layout.lateral import APART, Box, Seen, height_gap, on_side, reach, related
from pat3d.scene.model import GROUND
from pat3d.scene.relations import SIDES

if TYPE_CHECKING:
    from pat3d.envs.physics.state import States

_AXES = np.concatenate([-np.identity(3), np.identity(3)])
"""Directions in which bounding boxes reach, shape (6, 3)."""

_ASKEW = math.sin(math.pi / AROUND)
"""Sine of the largest angle between any direction in the plane and the nearest of `DIRECTIONS`."""


class Related:
    """Whether one object is in a relation to another, in every world.

    `pat3d.layout.lateral` decides, as it does for scenes. Of next_to, outlines as `DIRECTIONS` see them tell in nearly
    every world, within the bounds of what those directions miss; the exact outlines do in the others.

    Args:
        states: the worlds.
        relation: one of `beside.RELATIONS`.
        child: name of the object.
        parent: of the other.
    """

    def __init__(self, states: States, relation: str, child: str, parent: str) -> None:
        self._states, self._relation = states, relation
        numbers = [states.numbers[name] for name in (child, parent)]
        self._bodies = [int(states.bodies[number]) for number in numbers]
        self._corners = [hull(corners(states.world.scene[name].asset)) for name in (child, parent)]

    def boxes(self) -> tuple[Box, Box]:
        """Bounding boxes of both now."""
        child, parent = (self._reaches(number, _AXES) for number in (0, 1))
        return Box(-child[:, :3], child[:, 3:]), Box(-parent[:, :3], parent[:, 3:])

    def holds(self, child: Box, parent: Box) -> Mask:
        """Where the relation holds, shape (worlds,).

        Args:
            child: bounding boxes as `boxes` gives them.
            parent: of the other.
        """
        if self._relation in SIDES:
            return on_side(self._relation, child, parent).holds
        near, unsure = self._next_to(child, parent)
        for world in np.flatnonzero(unsure).tolist():
            near[world] = related(self._relation, self._seen(0, world), self._seen(1, world))
        return near

    def _reaches(self, number: int, directions: Array) -> Array:
        """How far one of the two reaches along directions [m], shape (worlds, directions)."""
        return predicates.supports(self._states.snapshot, self._bodies[number], self._corners[number], directions)

    def _next_to(self, child: Box, parent: Box) -> tuple[Mask, Mask]:
        """Where the two are next to one another, and where that is not sure, shape (worlds,) each."""
        first, second = (self._reaches(number, DIRECTIONS) for number in (0, 1))
        sizes = [(one.high - one.low)[:, :2] for one in (child, parent)]
        wide, wider = (_ASKEW * np.linalg.norm(size, axis=1) for size in sizes)
        seen = (-np.roll(second, AROUND // 2, axis=1) - first).max(axis=1)
        limit = reach(*sizes)
        # The gap is no smaller than it is seen, and no larger than this.
        largest = (seen + wide + wider) / math.sqrt(1.0 - _ASKEW**2)
        apart = height_gap(child, parent) > APART
        centres = [self._states.snapshot.xipos[:, body, :2] for body in self._bodies]
        beyond = [
            (centre @ DIRECTIONS[:, :2].T - other).max(axis=1)
            for centre, other in ((centres[0], second), (centres[1], first))
        ]
        # A centre that is seen outside of an outline is so; one deep inside is over it.
        over = (beyond[0] < -wider) | (beyond[1] < -wide)
        never = (seen > limit) | apart | over
        surely = ~never & (largest <= limit) & (beyond[0] > 1e-9) & (beyond[1] > 1e-9)
        return surely, ~never & ~surely

    def _seen(self, number: int, world: int) -> Seen:
        now, body = self._states.snapshot, self._bodies[number]
        points = self._corners[number] @ now.xmat[world, body].reshape(3, 3).T + now.xpos[world, body]
        return Seen.of(points, now.xipos[world, body])


class BesideJudge(Judge):
    """Success when the object has rested in its relation, upright on the other's surface, untouched for half a second.

    The other has to stay where it was when the judge began, within 5 cm, and upright. Progress: a fifth each for the
    hand's closeness to a grasp and the grasp (kept once the object is there), two fifths for the object's closeness to
    the best free spot as the scene is at rest, a fifth for resting in the relation; nothing when the other was moved.

    Args:
        states: the worlds.
        target: name of the object.
        relation: one of `beside.RELATIONS`.
        landmark: name of the other.
        carrier: what the other stands on when the object is put there, or the ground.
        view: tells the best free spot.
    """

    def __init__(self, states: States, target: str, relation: str, landmark: str, carrier: str, view: Outlook) -> None:
        super().__init__(states)
        self._relation, self._related = relation, Related(states, relation, target, landmark)
        self._target, self._landmark = states.numbers[target], states.numbers[landmark]
        self._targets = np.full(states.count, self._target)
        self._floors = None if carrier == GROUND else floors(states.world, [(target, carrier)], "on")
        found = spots(relation, view)
        spot = found.free[0] if found.free else found.best
        above = float(centre_of_mass(states.world.scene, target)[2] - view.own.box.low[2])
        self._way = np.array([*(spot - view.landmark.centre), above])
        """Where the target's centre should get to [m]: along x and y from the landmark's, and above the surface."""
        self._before = np.full((states.count, 2), np.nan)
        """Where the landmark was when the judge began [m]; unknown until the first look."""

    def begin(self, worlds: Numbers) -> None:
        super().begin(worlds)
        self._before[worlds] = np.nan

    def update(self, seconds: Array) -> Verdicts:
        now, target = self.states.snapshot, self._target
        child, parent = self._related.boxes()
        beside = self._related.holds(child, parent)
        level = np.abs(child.low[:, 2] - parent.low[:, 2]) <= predicates.CONTACT_DEPTH
        surface = np.asarray(level & self._carried())
        upright, steady = (
            np.asarray((now.xmat[:, now.bodies[one], 6:] * now.start_up[:, one]).sum(axis=1) >= UPRIGHT)
            for one in (target, self._landmark)
        )
        middle = now.xipos[:, now.bodies[self._landmark], :2]
        self._before = np.where(np.isnan(self._before), middle, self._before)
        stays = np.asarray(steady & (np.linalg.norm(middle - self._before, axis=1) <= STAYED))
        row = predicates.OWNERS + target
        held = (now.pinched[:, 0, row] & now.pinched[:, 1, row]) | (now.pinched[:, -2, row] & now.pinched[:, -1, row])
        released = np.asarray(self._each(predicates.still) & ~now.touching[:, predicates.ROBOT_ROW, row])
        there = beside & surface & upright
        self.timer[:] = np.where(there & released & stays, self.timer + seconds, 0.0)
        done = np.asarray(self.timer >= REST_SECONDS - 1e-9)
        goal = np.column_stack([middle + self._way[:2], parent.low[:, 2] + self._way[2]])
        away = np.linalg.norm(now.xipos[:, now.bodies[target]] - goal, axis=1)
        steps = 0.2 * np.where(there, 1.0, self._each(predicates.reached))
        steps += 0.2 * (there | held) + 0.2 * (there & released)
        steps += 0.4 * np.where(there, 1.0, 1.0 - np.tanh(away / predicates.NEAR_GOAL))
        return Verdicts(
            success=done,
            predicates={
                "there": there,
                self._relation: beside,
                "same surface": surface,
                "upright": upright,
                "released": released,
                "landmark stays": stays,
            },
            progress=np.where(done, 1.0, np.minimum(steps, 1.0) * stays),
            target=self._targets,
            goal=goal,
        )

    def _carried(self) -> Mask:
        """Whether the surface carries the target, shape (worlds,)."""
        if self._floors is None:
            row = predicates.OWNERS + self._target
            touching = self.states.snapshot.touching
            return np.asarray(touching[:, predicates.SUPPORT_ROW, row] | touching[:, predicates.FLOOR_ROW, row])
        return predicates.pairs_that(self.states.snapshot, self._floors, False)[:, 0]

    def _each(self, predicate: Callable[..., Any]) -> Any:
        """A predicate of the target in every world, shape (worlds,)."""
        now = self.states.snapshot
        return np.array([predicate(now, world, self._target) for world in range(self.states.count)])
