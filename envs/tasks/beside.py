"""Putting an object beside another: to its left or right, in front of it, behind it, or next to it.

The relations mean what they mean of scenes: `pat3d.layout.lateral` decides on them here, in the judge and in the
predicates of scenes. Left, right, front and back are those of who looks along +y, and the robot then faces him.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from pat3d.envs.grasping.placement import Needs
from pat3d.envs.physics.predicates import CONTACT_DEPTH, UPRIGHT_DEGREES
from pat3d.envs.tasks.beside_spots import at_present, at_rest, carrier_of, spots
from pat3d.envs.tasks.manipulate import CARRY_HEIGHT
from pat3d.envs.tasks.naming import the
from pat3d.envs.tasks.paraphrase import worded
from pat3d.envs.tasks.task import Goal, Judge, Task, children, movable, present, rests_upon
from pat3d.errors import TaskError
from pat3d.layout.lateral import related
from pat3d.scene.model import GROUND, Scene
from pat3d.scene.relations import RELATION_WORDS, SIDES

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState, States
    from pat3d.envs.tasks.beside_spots import Outlook

RELATIONS = (*SIDES, "next_to")

NEARLY = 0.05
"""A drawn relation does not hold either when the object is moved by this along an axis [m]."""


@dataclass(frozen=True, kw_only=True)
class Beside(Task):
    """Put an object beside another, upright, on the surface on which that stands, and let go."""

    kind: ClassVar[str] = "beside"
    form: ClassVar[str] = f"beside:OBJECT:RELATION:LANDMARK, where RELATION is {', '.join(RELATIONS)}"

    target: str
    relation: str
    landmark: str

    def __post_init__(self) -> None:
        if self.relation not in RELATIONS:
            raise TaskError(f'no relation "{self.relation}". Relations: {", ".join(RELATIONS)}.')

    @property
    def names(self) -> tuple[str, ...]:
        return (self.target, self.landmark)

    def wordings(self, scene: Scene) -> tuple[str, ...]:
        it, landmark = the(scene, self.target), the(scene, self.landmark)
        said = worded("beside", it=it, where=f"{RELATION_WORDS[self.relation]} {landmark}")
        also = worded("beside", it=it, where=f"beside {landmark}")[:2] if self.relation == "next_to" else ()
        return said + also

    def tree(self, scene: Scene) -> Scene:
        """A scene in which things stand on one another as they do when this begins."""
        return scene

    def outlook(self, scene: Scene) -> Outlook:
        """What the scene at rest tells of where the object may be put."""
        return at_rest(scene, self.target, self.landmark)

    def check_names(self, scene: Scene) -> None:
        """Raise TaskError unless one of the objects can be put beside the other as far as the scene tree goes."""
        movable(scene, self.target)
        present(scene, self.landmark)
        if self.target == self.landmark:
            raise TaskError(f'"{self.target}" cannot be put beside itself.')
        if rests_upon(scene, self.landmark, self.target):
            raise TaskError(f'"{self.landmark}" stands on "{self.target}".')
        if carried := children(scene, self.target):
            raise TaskError(f'"{self.target}" carries "{carried[0]}" and cannot be put beside something on its own.')

    def check(self, scene: Scene) -> None:
        self.check_names(scene)
        view, words = self.outlook(scene), RELATION_WORDS[self.relation]
        if related(self.relation, view.own, view.landmark):
            raise TaskError(f'"{self.target}" is {words} "{self.landmark}" already.')
        found = spots(self.relation, view)
        if not found.free:
            met = ", ".join(f'"{name}"' for name in found.met[:3]) or "the edge of the surface"
            raise TaskError(f'there is no room for "{self.target}" {words} "{self.landmark}": in the way is {met}.')

    def needs(self, scene: Scene) -> Needs:
        view = self.outlook(scene)
        found = spots(self.relation, view)
        x, y = found.free[0] if found.free else found.best
        tall = float(view.own.box.high[2] - view.own.box.low[2])
        above = (float(x), float(y), view.surface.height + CARRY_HEIGHT + tall)
        corners = view.own.footprint + (np.array([x, y]) - view.own.centre)
        room = tuple((float(a), float(b)) for a, b in (corners.min(axis=0), corners.max(axis=0)))
        return Needs(grasp=(self.target,), visit=(above,), room=room, facing=self.relation in SIDES)

    def goals(self, state: SimState, graspable: Collection[str], done: Collection[str] = ()) -> list[Goal]:
        view = at_present(state, self.target, self.landmark, self.tree(state.scene))
        level = abs(float(view.own.box.low[2]) - view.surface.height) <= CONTACT_DEPTH
        upright = state.tilt(self.target) <= UPRIGHT_DEGREES
        if level and upright and self._carried(state) and related(self.relation, view.own, view.landmark):
            return []
        found = spots(self.relation, view)
        # Where there is no room it is the planner that finds what is in the way.
        return [
            Goal(name=self.target, where="", at=(x, y), height=round(view.surface.height, 4))
            for x, y in (np.round(spot, 3).tolist() for spot in found.free or [found.best])
        ]

    def _carried(self, state: SimState) -> bool:
        """Whether the target is on the surface on which the landmark stands when this begins."""
        carrier = carrier_of(self.tree(state.scene), self.landmark)
        return state.grounded(self.target) if carrier == GROUND else state.on_top(self.target, carrier)

    def judge(self, states: States) -> Judge:
        from pat3d.envs.tasks.beside_judge import BesideJudge

        scene = states.world.scene
        carrier = carrier_of(self.tree(scene), self.landmark)
        return BesideJudge(states, self.target, self.relation, self.landmark, carrier, self.outlook(scene))


def _nearly(scene: Scene, task: Beside) -> bool:
    """Whether the relation would hold if the object stood a little elsewhere."""
    view = at_rest(scene, task.target, task.landmark)
    ways = np.array([[NEARLY, 0.0], [-NEARLY, 0.0], [0.0, NEARLY], [0.0, -NEARLY]])
    return any(related(task.relation, view.own.shifted(way), view.landmark) for way in ways)


def drawn_beside(scene: Scene, target: str, landmark: str, random: np.random.Generator) -> Beside:
    """A task for two objects of a scene, with a relation drawn among those that are possible as far as sizes go.

    Raises:
        TaskError: none is.
    """
    for number in random.permutation(len(RELATIONS)).tolist():
        task = Beside(target=target, relation=RELATIONS[number], landmark=landmark)
        try:
            task.check(scene)
        except TaskError:
            continue
        if not _nearly(scene, task):
            return task
    raise TaskError(f'"{target}" can be put to no side of "{landmark}".')
