"""Opening and closing a drawer, which slides in its cabinet, or a door, which turns in its case: by contact alone."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array
from pat3d.envs.tasks.judges import REST_SECONDS
from pat3d.envs.tasks.mechanisms import Mechanism, mechanism_of
from pat3d.envs.tasks.naming import the
from pat3d.envs.tasks.paraphrase import worded
from pat3d.envs.tasks.task import Goal, Judge, Opening, Task, Verdicts, movable, point, steps_for
from pat3d.errors import TaskError
from pat3d.scene.model import Scene

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States

SHUT = 0.12
"""Share of how far an open one of a scene is open: less is shut."""

LEVEL = 0.98
"""Least cosine between its vertical now and at the start."""

HANDLE_ABOVE = 0.12
"""Over the handle, where the hand has to get [m]."""

VISITED = (0.0, 0.25, 0.5, 0.75, 1.0)
"""Shares of a way at which the hand has to get to the handle."""


def out_now(state: SimState, name: str, mechanism: Mechanism) -> float:
    """By how much `name` is open, in the unit of its way."""
    turned = state.rotation(mechanism.holder).T
    position = turned @ (state.position(name) - state.position(mechanism.holder))
    return float(mechanism.out(position[None], (turned @ state.rotation(name))[None])[0])


@dataclass(frozen=True, kw_only=True)
class _Moving(Task):
    """What opening and closing have in common."""

    target: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return worded(self.kind, it=the(scene, self.target))

    def check(self, scene: Scene) -> None:
        movable(scene, self.target)
        mechanism = mechanism_of(scene, self.target)
        if self._done(mechanism.out_in(scene, self.target) / mechanism.whole, mechanism.opened):
            raise TaskError(f'"{self.target}" is {"open" if self.kind == "open" else "shut"} already.')

    def _done(self, share: float, opened: float) -> bool:
        return share >= opened if self.kind == "open" else share <= SHUT

    def needs(self, scene: Scene) -> Needs:
        movable(scene, self.target)
        mechanism = mechanism_of(scene, self.target)
        out, holder = mechanism.out_in(scene, self.target), scene[mechanism.holder].pose
        # An earlier step of a chain brings it to where this one begins.
        before, goal = mechanism.goal("close" if self.kind == "open" else "open"), mechanism.goal(self.kind)
        begin = before if self._done(out / mechanism.whole, mechanism.opened) else out
        visits, swept = [], list[tuple[float, float]]()
        low, high = scene[self.target].asset.bounds
        outline = np.array([[x, y, 0.0] for x in np.linspace(low[0], high[0], 5) for y in (low[1], high[1])])
        for share in VISITED:
            by = begin + share * (goal - begin) - out
            position, rotation = mechanism.moved(*mechanism.within(scene, self.target), by)
            at = holder.apply((rotation @ mechanism.at_handle(self.kind) + position)[None])[0]
            front = holder.rotation @ rotation @ [0.0, -1.0, 0.0]
            across = round(float(np.arctan2(front[1], front[0])), 6)
            visits += [(point([*at[:2], at[2] + up]), across) for up in (0.0, HANDLE_ABOVE)]
            corners = holder.apply(outline @ rotation.T + position)
            swept += [(round(float(x), 6), round(float(y), 6)) for x, y, _ in corners]
        front = holder.rotation @ [0.0, -1.0, 0.0]
        visits = list(dict.fromkeys(visits))
        return Needs(
            push=(self.target,),
            visit=tuple(at for at, _ in visits),
            fronts=tuple(across for _, across in visits),
            side=float(np.arctan2(front[1], front[0])),
            swept=tuple(dict.fromkeys(swept)),
        )

    def horizon(self, scene: Scene, control_freq: float) -> int:
        return steps_for(1, control_freq)

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        return []

    def opening(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> Opening | None:
        mechanism = mechanism_of(state.scene, self.target)
        now = out_now(state, self.target, mechanism)
        if self._done(now / mechanism.whole, mechanism.opened) or self.spec in done:
            return None
        return Opening(name=self.target, spec=self.spec, by=mechanism.goal(self.kind) - now, mechanism=mechanism)

    def judge(self, states: States) -> Judge:
        return OpeningJudge(states, self.target, self.kind)


@dataclass(frozen=True, kw_only=True)
class Open(_Moving):
    """Pull a drawer out, or a door open, and let go."""

    kind: ClassVar[str] = "open"
    form: ClassVar[str] = "open:DRAWER_OR_DOOR"


@dataclass(frozen=True, kw_only=True)
class Close(_Moving):
    """Push a drawer in, or a door shut, and let go."""

    kind: ClassVar[str] = "close"
    form: ClassVar[str] = "close:DRAWER_OR_DOOR"


class OpeningJudge(Judge):
    """Success when it has been open, or shut, level, at rest and untouched for half a second.

    Progress: a tenth for the hand's closeness (kept once it is there), eight tenths for the share of the way, a tenth
    for resting there.
    """

    def __init__(self, states: States, name: str, kind: str) -> None:
        super().__init__(states)
        scene = states.world.scene
        mechanism = self._mechanism = mechanism_of(scene, name)
        self._kind, self._handle = kind, mechanism.at_handle(kind)
        self._target, holder = states.numbers[name], states.numbers[mechanism.holder]
        self._body, self._holder = states.bodies[self._target], states.bodies[holder]
        self._targets = np.full(states.count, self._target)
        self._first = mechanism.out_in(scene, name)
        middle = scene[name].asset.mass_properties.centre_of_mass
        position, rotation = mechanism.moved(*mechanism.within(scene, name), mechanism.goal(kind) - self._first)
        self._goal = position + rotation @ np.array(middle)
        """Of its centre of mass in the frame of what holds it [m]."""

    def update(self, seconds: Array) -> Verdicts:
        now, count, mechanism = self.states.snapshot, self.states.count, self._mechanism
        frame = now.xmat[:, self._holder].reshape(count, 3, 3)
        turned = now.xmat[:, self._body].reshape(count, 3, 3)
        position = np.einsum("wji,wj->wi", frame, now.xpos[:, self._body] - now.xpos[:, self._holder])
        rotation = np.einsum("wji,wjk->wik", frame, turned)
        out = mechanism.out(position, rotation)
        share = out / mechanism.whole
        opened = (share >= mechanism.opened) & (share <= mechanism.most)
        there = (opened if self._kind == "open" else share <= SHUT) & ~mechanism.astray(position, rotation)
        level = (now.xmat[:, self._body, 6:] * now.start_up[:, self._target]).sum(axis=1) >= LEVEL
        free = ~now.touching[:, predicates.ROBOT_ROW, predicates.OWNERS + self._target]
        still = np.array([predicates.still(now, world, self._target) for world in range(count)])
        resting = np.asarray(level & still)
        holds = there & resting & free
        self.timer[:] = np.where(holds, self.timer + seconds, 0.0)
        done = self.timer >= REST_SECONDS - 1e-9
        grip = now.xpos[:, self._body] + turned @ self._handle
        near = 1.0 - np.tanh(np.linalg.norm(now.sites[:, now.hand] - grip, axis=1) / predicates.NEAR_HAND)
        goal = mechanism.goal(self._kind)
        covered = np.clip((out - self._first) / (goal - self._first), 0.0, 1.0)
        progress = (0.1 * np.where(there, 1.0, near) + 0.8 * covered + 0.1 * holds) * level
        return Verdicts(
            success=np.asarray(done),
            predicates={
                "open" if self._kind == "open" else "shut": np.asarray(there),
                "released": np.asarray(free),
                "at rest": resting,
            },
            progress=np.where(done, 1.0, progress),
            target=self._targets,
            goal=now.xpos[:, self._holder] + frame @ self._goal,
        )
