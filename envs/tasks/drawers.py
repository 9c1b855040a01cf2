"""Opening and closing a drawer, which slides in its cabinet by contact alone."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, NamedTuple

import numpy as np

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.physics import predicates
from pat3d.envs.physics.snapshot import Array
from pat3d.envs.tasks.judges import REST_SECONDS
from pat3d.envs.tasks.naming import the
from pat3d.envs.tasks.paraphrase import worded
from pat3d.envs.tasks.task import Goal, Judge, Slide, Task, Verdicts, movable, point, steps_for
from pat3d.errors import TaskError
from pat3d.layout.drawers import pulled, shut_at, slides
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Scene

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States

OPENED, SHUT = 0.6, 0.12
"""Shares of how far an open drawer of a scene is out: more is open, less is shut."""

WANTED = {"open": 0.85, "close": 0.0}
"""The share to which the scripted policy moves it."""

MOST, ASTRAY = 1.5, 0.02
"""The share beyond which it is pulled right out, and how far it may be beside its row [m]."""

LEVEL = 0.98
"""Least cosine between the vertical of a drawer now and at the start."""

BEHIND, AWAY = 0.016, 0.03
"""Of the middle of fingers behind the bar that they pull at, and before a handle that they push [m]."""

HANDLE_ABOVE = 0.12
"""Over the handle, where the hand has to get [m]."""


class Rail(NamedTuple):
    """A drawer and its cabinet."""

    cabinet: str
    shut: float
    """Where the drawer's origin is along the depth of the cabinet when it is shut [m], in the cabinet's frame."""
    whole: float
    """By how much an open drawer is out [m]."""


def rail_of(scene: Scene, name: str) -> Rail:
    """The cabinet in which `name` slides.

    Raises:
        TaskError: it is no such drawer.
    """
    movable(scene, name)
    cabinet = scene.parent(name)
    if cabinet == GROUND or not slides(scene[name].asset, scene[cabinet].asset):
        raise TaskError(f'"{name}" is no drawer in a "drawer cabinet", and nothing else opens or closes.')
    return Rail(cabinet, shut_at(scene[name].asset, scene[cabinet].asset), pulled(scene[name].asset))


def out_at_rest(scene: Scene, name: str) -> float:
    """By how much the drawer is out in the scene [m]."""
    rail = rail_of(scene, name)
    drawer, cabinet = scene[name].pose, scene[rail.cabinet].pose
    along = cabinet.rotation.T @ (np.array(drawer.position) - np.array(cabinet.position))
    return rail.shut - float(along[1])


def at_handle(asset: Asset, kind: str) -> Array:
    """Where fingers begin to open or close a drawer [m], in its frame, shape (3,): behind the bar, or before it."""
    from pat3d.assets.catalogue.drawers import BAR, BOX, GRIP

    low, high = asset.bounds
    scale = float(high[2] - low[2]) / BOX[2]
    depth = scale * BAR + BEHIND if kind == "open" else -AWAY
    return np.array([0.0, low[1] + depth, scale * GRIP * BOX[2]])


@dataclass(frozen=True, kw_only=True)
class _Sliding(Task):
    """What opening and closing have in common."""

    target: str

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        return worded(self.kind, it=the(scene, self.target))

    def check(self, scene: Scene) -> None:
        rail = rail_of(scene, self.target)
        share = out_at_rest(scene, self.target) / rail.whole
        if self._done(share):
            raise TaskError(f'"{self.target}" is {"open" if self.kind == "open" else "shut"} already.')

    def _done(self, share: float) -> bool:
        return share >= OPENED if self.kind == "open" else share <= SHUT

    def needs(self, scene: Scene) -> Needs:
        pose, rail = scene[self.target].pose, rail_of(scene, self.target)
        front = scene[rail.cabinet].pose.rotation @ np.array([0.0, -1.0, 0.0])
        out = out_at_rest(scene, self.target)
        # An earlier step of a chain brings it to where this one begins.
        begin = WANTED["close" if self.kind == "open" else "open"] * rail.whole if self._done(out / rail.whole) else out
        start = pose.apply(at_handle(scene[self.target].asset, self.kind)[None])[0]
        ends = (start + (begin - out) * front, start + (WANTED[self.kind] * rail.whole - out) * front)
        visit = tuple(point([*end[:2], end[2] + up]) for end in ends for up in (0.0, HANDLE_ABOVE))
        return Needs(push=(self.target,), visit=visit, side=float(np.arctan2(front[1], front[0])))

    def horizon(self, scene: Scene, control_freq: float) -> int:
        return steps_for(1, control_freq)

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        return []

    def slide(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> Slide | None:
        rail = rail_of(state.scene, self.target)
        turned = state.rotation(rail.cabinet)
        along = turned.T @ (state.position(self.target) - state.position(rail.cabinet))
        now = rail.shut - float(along[1])
        if self._done(now / rail.whole) or self.spec in done:
            return None
        front = turned @ np.array([0.0, -1.0, 0.0])
        return Slide(name=self.target, spec=self.spec, by=WANTED[self.kind] * rail.whole - now, front=front)

    def judge(self, states: States) -> Judge:
        return DrawerJudge(states, self.target, self.kind)


@dataclass(frozen=True, kw_only=True)
class Open(_Sliding):
    """Pull a drawer out, and let go."""

    kind: ClassVar[str] = "open"
    form: ClassVar[str] = "open:DRAWER"


@dataclass(frozen=True, kw_only=True)
class Close(_Sliding):
    """Push a drawer in, and let go."""

    kind: ClassVar[str] = "close"
    form: ClassVar[str] = "close:DRAWER"


class DrawerJudge(Judge):
    """Success when the drawer has been open, or shut, level, at rest and untouched for half a second.

    Progress: a tenth for the hand's closeness (kept once it is there), eight tenths for the share of the way, a tenth
    for resting there.
    """

    def __init__(self, states: States, name: str, kind: str) -> None:
        super().__init__(states)
        scene = states.world.scene
        rail = rail_of(scene, name)
        self._kind, self._whole = kind, rail.whole
        self._target, cabinet = states.numbers[name], states.numbers[rail.cabinet]
        self._body, self._cabinet = states.bodies[self._target], states.bodies[cabinet]
        self._shut, self._handle = rail.shut, at_handle(scene[name].asset, kind)
        self._targets = np.full(states.count, self._target)
        self._first = out_at_rest(scene, name)
        pose, own = scene[name].pose, scene[rail.cabinet].pose
        self._row = (own.rotation.T @ (np.array(pose.position) - np.array(own.position)))[[0, 2]]

    def update(self, seconds: Array) -> Verdicts:
        now, count = self.states.snapshot, self.states.count
        frame = now.xmat[:, self._cabinet].reshape(count, 3, 3)
        depth = frame[:, :, 1]
        within = np.einsum("wji,wj->wi", frame, now.xpos[:, self._body] - now.xpos[:, self._cabinet])
        out = self._shut - within[:, 1]
        share = out / self._whole
        there = (share >= OPENED) & (share <= MOST) if self._kind == "open" else share <= SHUT
        there &= np.abs(within[:, [0, 2]] - self._row).max(axis=1) <= ASTRAY
        level = (now.xmat[:, self._body, 6:] * now.start_up[:, self._target]).sum(axis=1) >= LEVEL
        free = ~now.touching[:, predicates.ROBOT_ROW, predicates.OWNERS + self._target]
        still = np.array([predicates.still(now, world, self._target) for world in range(count)])
        resting = np.asarray(level & still)
        holds = there & resting & free
        self.timer[:] = np.where(holds, self.timer + seconds, 0.0)
        done = self.timer >= REST_SECONDS - 1e-9
        turned = now.xmat[:, self._body].reshape(count, 3, 3)
        grip = now.xpos[:, self._body] + turned @ self._handle
        near = 1.0 - np.tanh(np.linalg.norm(now.sites[:, now.hand] - grip, axis=1) / predicates.NEAR_HAND)
        goal = WANTED[self._kind] * self._whole
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
            goal=now.xipos[:, self._body] - depth * (goal - out)[:, None],
        )
