"""Putting an object beside another that an earlier step of a chain moves."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from pat3d.envs.grasping.grasp import narrowest
from pat3d.envs.grasping.placement import Needs
from pat3d.envs.tasks.beside import Beside
from pat3d.envs.tasks.beside_spots import Outlook, alone, carrier_of, spots
from pat3d.envs.tasks.manipulate import CARRY_HEIGHT, Lift, Place, Stack, above, preposition
from pat3d.envs.tasks.task import Task, rests_upon
from pat3d.errors import TaskError
from pat3d.scene.model import GROUND, Scene
from pat3d.scene.relations import Relation


@dataclass(frozen=True, kw_only=True)
class BesideMoved(Beside):
    """The same where the landmark has come to another surface before: what is free there is not known at rest."""

    earlier: tuple[Task, ...]
    """Steps of the chain before this one."""

    @property
    def spec(self) -> str:
        return Beside(target=self.target, relation=self.relation, landmark=self.landmark).spec

    @property
    def mover(self) -> Task:
        """The step that moves the landmark."""
        return next(step for step in self.earlier if step.names[0] == self.landmark)

    def tree(self, scene: Scene) -> Scene:
        for step in self.earlier:
            scene = _after(scene, step)
        return scene

    def outlook(self, scene: Scene) -> Outlook:
        return alone(scene, self.target, self.landmark)

    def check(self, scene: Scene) -> None:
        mover = self.mover
        if isinstance(mover, Place) and preposition(scene, mover.where) == "in":
            raise TaskError(
                f'"{self.spec}" cannot be a step of this chain: "{mover.spec}" puts "{self.landmark}" into a container.'
            )
        then = self.tree(scene)
        self.check_names(then)
        carrier = carrier_of(then, self.landmark)
        top = None if carrier == GROUND else scene[carrier].asset.region("on")
        if top is not None:
            widest = 2 * (top.half_size[0] if top.shape == "disc" else math.hypot(*top.half_size))
            if narrowest(scene[self.target]) + narrowest(scene[self.landmark]) > widest:
                raise TaskError(
                    f'"{carrier}" has no top wide enough for "{self.landmark}" with "{self.target}" beside it.'
                )

    def needs(self, scene: Scene) -> Needs:
        carrier = carrier_of(self.tree(scene), self.landmark)
        if carrier != GROUND:
            return Needs(grasp=(self.target,), visit=(above(scene, carrier),))
        # The landmark is put beside something on the ground, and this goes beside the place where it comes.
        middle, view = np.array(self.mover.needs(scene).visit[0][:2]), self.outlook(scene)
        way, size = spots(self.relation, view).best - view.landmark.centre, view.own.box.high - view.own.box.low
        x, y = (middle + way).tolist()
        around = float(np.abs(way).max() + size[:2].max())
        (a, b), (c, d) = (middle - around).tolist(), (middle + around).tolist()
        return Needs(grasp=(self.target,), visit=((x, y, CARRY_HEIGHT + float(size[2])),), room=((a, b), (c, d)))


def in_place(steps: tuple[Task, ...]) -> tuple[Task, ...]:
    """Steps of a chain, those that put something beside what another has moved by then as `BesideMoved`."""
    found: list[Task] = []
    for step in steps:
        moved = [one.names[0] for one in found if not isinstance(one, Lift)]
        if isinstance(step, Beside) and step.landmark in moved:
            target, relation, landmark = step.target, step.relation, step.landmark
            step = BesideMoved(target=target, relation=relation, landmark=landmark, earlier=tuple(found))
        found.append(step)
    return tuple(found)


def _after(scene: Scene, step: Task) -> Scene:
    """The scene, but that things stand on one another as they do after a step; poses stay as they are."""
    name, kind = step.names[0], "on"
    if isinstance(step, Place):
        parent, kind = step.where, preposition(scene, step.where)
    elif isinstance(step, Stack):
        parent = step.base
    elif isinstance(step, Beside):
        parent = scene.parent(step.landmark)
    else:
        return scene
    if parent == name or rests_upon(scene, parent, name):
        raise TaskError(f'"{parent}" stands on "{name}" when it is to carry that.')
    relations = [rel for rel in scene.relations if rel.supports and rel.child != name]
    if parent != GROUND:
        relations.append(Relation(child=name, kind=kind, parent=parent))
    return replace(scene, relations=tuple(relations), arrangements=())
