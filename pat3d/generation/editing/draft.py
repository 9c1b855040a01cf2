"""A scene between edits: where everything starts when it settles again, and what has to be true in the end."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from pat3d.errors import EditError
from pat3d.geometry.polygons import contains, outline
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import Placed, distance, place
from pat3d.layout.drop import fall
from pat3d.layout.group import Group
from pat3d.scene.arrangements import Arrangement
from pat3d.scene.model import GROUND, Relation, Scene, SceneObject

LIFT, GAP = 2e-3, 1e-3
"""How far what is moved is lifted on its way, and how far over its new support it is let go [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Draft:
    """A scene whose objects are free of intersections, some of them just over where they will come to rest."""

    scene: Scene
    touched: frozenset[str] = frozenset()
    """Objects that are not where they were at rest, or are not what they were."""
    loose: frozenset[str] = frozenset()
    """Objects that lost what held them and may come to lie in any way."""
    asked: tuple[Relation | Arrangement, ...] = ()
    """What the edits ask for."""
    notes: tuple[str, ...] = field(default=())
    """What was decided where the edits were silent."""

    def with_scene(self, scene: Scene, touched: Iterable[str] = (), *, notes: Iterable[str] = ()) -> Draft:
        """The draft with another scene; `touched` is added, what is no longer there is forgotten."""
        names = {obj.name for obj in scene.objects}
        known = {*scene.relations, *scene.arrangements}
        return replace(
            self,
            scene=scene,
            touched=(self.touched | set(touched)) & names,
            loose=self.loose & names,
            asked=tuple(one for one in self.asked if one in known),
            notes=(*self.notes, *notes),
        )

    def placed(self, names: Iterable[str] | None = None) -> dict[str, Placed]:
        """Bodies of the objects `names`, of all where None, at their poses."""
        wanted = None if names is None else set(names)
        objects = [obj for obj in self.scene.objects if wanted is None or obj.name in wanted]
        return {obj.name: place(obj.name, obj.asset, obj.pose) for obj in objects}


def carried(scene: Scene, names: Collection[str]) -> list[str]:
    """`names` and everything that they carry, directly or not, in the order of the scene."""
    found = set(names)
    while grown := {rel.child for rel in scene.relations if rel.supports and rel.parent in found} - found:
        found |= grown
    return [obj.name for obj in scene.objects if obj.name in found]


def group_of(draft: Draft, name: str) -> tuple[Group, list[Placed]]:
    """Object `name` with everything that it carries, and everything else."""
    bodies = draft.placed()
    members = [name, *(one for one in carried(draft.scene, [name]) if one != name)]
    return Group(tuple(bodies[one] for one in members)), [bodies[one] for one in bodies if one not in members]


def put_down(group: Group, others: Sequence[Placed]) -> Group:
    """`group`, let down from where it is until something carries it.

    Raises:
        EditError: something else is there.
    """
    lifted = group.shifted(np.array([0.0, 0.0, LIFT]))
    for other in others:
        if any(distance(member, other, GAP / 2) is not None for member in lifted.members):
            raise EditError(
                f'"{group.name}" has no room there: "{other.body.name}" is in the way. Nothing was written.'
            )
    down = min(fall(member, others, floor=0.0, gap=GAP) for member in lifted.members)
    return lifted.shifted(np.array([0.0, 0.0, -down]))


def support_under(body: Placed, others: Sequence[Placed]) -> str | None:
    """What carries `body`, which was put down: what it is over, of all that it nearly touches; None for nothing."""
    if body.low[2] <= 2.0 * GAP:
        return GROUND
    near = [(other, found) for other in others if (found := distance(body, other, 2.0 * GAP)) is not None]
    # What it only leans on is beside it: the nearest points are above its own lowest by more than the gap.
    over = [other for other, _ in near if contains(outline(other.vertices[:, :2]), body.centre_of_mass[:2])]
    if over:
        return max(over, key=lambda other: float(other.low[2])).body.name
    return min(near, key=lambda one: one[1].distance)[0].body.name if near else None


def posed(scene: Scene, bodies: Iterable[Placed]) -> Scene:
    """`scene` with objects where `bodies` are."""
    poses = {body.body.name: body.pose for body in bodies}
    return replace(scene, objects=tuple(_at(obj, poses.get(obj.name, obj.pose)) for obj in scene.objects))


def _at(obj: SceneObject, pose: Pose) -> SceneObject:
    return obj if pose is obj.pose else replace(obj, pose=pose)


def carried_by(relations: Iterable[Relation], child: str, parent: str | None) -> tuple[Relation, ...]:
    """`relations` where nothing carries `child` but `parent`; the ground where None."""
    kept = [rel for rel in relations if not (rel.supports and rel.child == child)]
    return (*kept, *([] if parent is None else [Relation(child=child, kind="on", parent=parent)]))


def shifted(group: Group, rotation: NDArray[np.float64], offset: NDArray[np.float64]) -> Group:
    """`group` turned by `rotation`, shape (3, 3), about its root's origin and moved by `offset` [m], shape (3,)."""
    pivot = group.root.position
    return Group(tuple(member.turned(rotation, pivot - rotation @ pivot + offset) for member in group.members))
