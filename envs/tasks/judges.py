"""Judges: what follows the episodes of all worlds and says how far each of them is."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array, Numbers, floors
from pat3d.envs.physics.state import States
from pat3d.envs.tasks.task import Judge, Verdicts

LIFT = 0.10
"""[m]"""

RAISED, BACK = 0.05, 0.05
"""How high [m] what is put back has to get, and how near to its place it rests afterwards."""

HOLD_SECONDS = 1.0
REST_SECONDS = 0.5

UPRIGHT = math.cos(math.radians(predicates.UPRIGHT_DEGREES))

OUT = 0.15
"""How far up from its start what is to be unloaded has to get first [m]."""


class LiftJudge(Judge):
    """Success when the object has been 10 cm up in the robot's hand for a second.

    Progress, each a quarter: the hand's closeness to a grasp, both fingers on the object, the height, the time held.
    """

    def __init__(self, states: States, target: str) -> None:
        super().__init__(states)
        self._target = states.numbers[target]
        self._targets = np.full(states.count, self._target)

    def update(self, seconds: Array) -> Verdicts:
        grasped, lifted, held, progress, goal = predicates.judge_lift(
            self.states.snapshot, self._target, LIFT, HOLD_SECONDS, self.timer, seconds
        )
        return Verdicts(
            success=held,
            predicates={"grasped": grasped, "lifted": lifted, "held": held},
            progress=progress,
            target=self._targets,
            goal=goal,
        )


class LiftAndBackJudge(Judge):
    """Success when the object was raised by 5 cm and then has rested where it was, untouched, for half a second.

    Progress: a sixth each for the hand's closeness to a grasp, the grasp and the height; once it was raised, half,
    three tenths for its closeness to its place, a fifth for resting there.
    """

    def __init__(self, states: States, target: str) -> None:
        super().__init__(states)
        self._target = states.numbers[target]
        self._targets = np.full(states.count, self._target)
        self._raised = np.zeros(states.count, dtype=np.bool_)

    def begin(self, worlds: Numbers) -> None:
        super().begin(worlds)
        self._raised[worlds] = False

    def update(self, seconds: Array) -> Verdicts:
        now, target = self.states.snapshot, self._target
        centre, start = now.xipos[:, now.bodies[target]], now.start_centre[:, target]
        row = predicates.OWNERS + target
        held = (now.pinched[:, 0, row] & now.pinched[:, 1, row]) | (now.pinched[:, -2, row] & now.pinched[:, -1, row])
        touched = now.touching[:, predicates.ROBOT_ROW, row]
        rise = centre[:, 2] - start[:, 2]
        self._raised |= touched & (rise >= RAISED)
        upright = (now.xmat[:, now.bodies[target], 6:] * now.start_up[:, target]).sum(axis=1) >= UPRIGHT
        away = np.linalg.norm(centre - start, axis=1)
        back = np.asarray(upright & (away <= BACK))
        still = np.array([predicates.still(now, world, target) for world in range(self.states.count)])
        resting = back & still & ~touched
        self.timer[:] = np.where(self._raised & resting, self.timer + seconds, 0.0)
        done = np.asarray(self.timer >= REST_SECONDS - 1e-9)
        near = np.array([predicates.reached(now, world, target) for world in range(self.states.count)])
        before = (near + held + np.clip(rise / RAISED, 0.0, 1.0) * touched) / 6.0
        after = 0.5 + 0.3 * (1.0 - np.tanh(away / predicates.NEAR_GOAL)) + 0.19 * resting
        return Verdicts(
            success=done,
            predicates={"back": back, "raised": self._raised.copy(), "released": ~touched},
            progress=np.where(done, 1.0, np.where(self._raised, after, before)),
            target=self._targets,
            goal=np.where(self._raised[:, None], start, start + [0.0, 0.0, LIFT]),
        )


class PutJudge(Judge):
    """Success when the object has rested in or on its place, untouched, for half a second.

    Progress: a fifth each for the hand's closeness to a grasp and the grasp (kept once the object rests in place), two
    fifths for the object's closeness to its place, a fifth for resting there.
    """

    def __init__(self, states: States, target: str, where: str, *, stacked: bool = False) -> None:
        super().__init__(states)
        scene = states.world.scene
        self._within = not stacked and scene[where].asset.region("in") is not None
        self._relation = "in" if self._within else "on"
        self._floors = floors(states.world, [(target, where)], self._relation)
        self._above = float(scene[target].asset.size[2]) / 2
        self._targets = np.full(states.count, states.numbers[target])

    def update(self, seconds: Array) -> Verdicts:
        there, released, upright, done, progress, goal = predicates.judge_put(
            self.states.snapshot, self._floors, self._within, self._above, REST_SECONDS, self.timer, seconds
        )
        return Verdicts(
            success=done,
            predicates={self._relation: there, "released": released, "upright": upright},
            progress=progress,
            target=self._targets,
            goal=goal,
        )


class SortJudge(Judge):
    """Success when everything has rested in its home, untouched, for half a second.

    Progress is the share of objects in place, and of the next one how near it is to its home.
    """

    def __init__(self, states: States, pairs: dict[str, str]) -> None:
        super().__init__(states)
        self._titles = tuple(f'"{name}" sorted' for name in pairs)
        self._floors = floors(states.world, list(pairs.items()), "in")

    def update(self, seconds: Array) -> Verdicts:
        there, resting, done, progress, target, goal = predicates.judge_sort(
            self.states.snapshot, self._floors, REST_SECONDS, self.timer, seconds
        )
        return Verdicts(
            success=done,
            predicates={**dict(zip(self._titles, there.T, strict=True)), "released": resting},
            progress=progress,
            target=target,
            goal=goal,
        )


class UnloadJudge(Judge):
    """Success when everything has rested outside, untouched, for half a second, and nothing fell.

    Progress is the share of objects outside, and of the next one how high it is.
    """

    def __init__(self, states: States, container: str, contents: tuple[str, ...]) -> None:
        super().__init__(states)
        self._floors = floors(states.world, [(name, container) for name in contents], "in")

    def update(self, seconds: Array) -> Verdicts:
        empty, resting, safe, done, progress, target, goal = predicates.judge_unload(
            self.states.snapshot, self._floors, OUT, REST_SECONDS, self.timer, seconds
        )
        return Verdicts(
            success=done,
            predicates={"empty": empty, "released": resting, "nothing fell": safe},
            progress=progress,
            target=target,
            goal=goal,
        )


class RetrieveJudge(Judge):
    """A lift during which nothing else topples or falls; progress is that of the lift until something does."""

    def __init__(self, states: States, target: str) -> None:
        super().__init__(states)
        self._lift, self._target = LiftJudge(states, target), states.numbers[target]
        self._sound = np.ones(states.count, dtype=np.bool_)

    def begin(self, worlds: Numbers) -> None:
        self._lift.begin(worlds)
        self._sound[worlds] = True

    def update(self, seconds: Array) -> Verdicts:
        lift = self._lift.update(seconds)
        predicates.judge_others(self.states.snapshot, self._target, self._sound)
        sound = self._sound.copy()
        return Verdicts(
            success=lift.success & sound,
            predicates={**lift.predicates, "nothing toppled": sound},
            progress=lift.progress * sound,
            target=lift.target,
            goal=lift.goal,
        )


class RearrangeJudge(Judge):
    """Success when every object has rested at its point, upright and untouched, for half a second.

    Progress is the share of objects at their points, and of the next one how near it is.
    """

    def __init__(self, states: States, targets: Mapping[str, tuple[float, float]], there: float) -> None:
        super().__init__(states)
        self._titles = tuple(f'"{name}" there' for name in targets)
        self._objects = np.array([states.numbers[name] for name in targets], dtype=np.int64)
        self._points, self._there = np.array(list(targets.values())), there

    def update(self, seconds: Array) -> Verdicts:
        now, objects = self.states.snapshot, self._objects
        centres = now.xipos[:, now.bodies[objects]]
        away = np.linalg.norm(centres[..., :2] - self._points, axis=-1)
        free = ~now.touching[:, predicates.ROBOT_ROW, predicates.OWNERS + objects]
        upright = (now.xmat[:, now.bodies[objects], 6:] * now.start_up[:, objects]).sum(axis=-1) >= UPRIGHT
        still = [[predicates.still(now, world, obj) for obj in objects.tolist()] for world in range(self.states.count)]
        resting = upright & np.array(still)
        there = (away <= self._there) & resting & free
        every = there.all(axis=1)
        self.timer[:] = np.where(every, self.timer + seconds, 0.0)
        due = np.argmin(there, axis=1)
        worlds = self.states.everyone
        near = np.exp(-away[worlds, due] / predicates.NEAR_GOAL)
        share = there.sum(axis=1) + np.where(every, 0.0, 0.9 * near)
        goal = np.column_stack([self._points[due], centres[worlds, due, 2]])
        return Verdicts(
            success=every & (self.timer >= REST_SECONDS),
            predicates={
                **dict(zip(self._titles, (away <= self._there).T, strict=True)),
                "released": np.asarray(free.all(axis=1)),
                "at rest": np.asarray(resting.all(axis=1)),
            },
            progress=share / len(objects),
            target=objects[due],
            goal=goal,
        )
