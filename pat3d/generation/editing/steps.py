"""Edits of what is there: taken away, moved, turned, scaled, weighed, fixed. Each takes a draft and returns another."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from pat3d.errors import EditError
from pat3d.generation.editing.assets import scaled, with_value
from pat3d.generation.editing.draft import (
    GAP,
    Draft,
    carried,
    carried_by,
    group_of,
    posed,
    put_down,
    shifted,
    support_under,
)
from pat3d.generation.editing.laying import laid_out
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.frames import upright
from pat3d.layout.group import Group
from pat3d.scene.arrangements import Arrangement, PostureKind
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND, Relation, Scene, SceneObject
from pat3d.scene.task_spec import named, renamed


def remove(draft: Draft, names: Sequence[str]) -> Draft:
    """Take `names` away; what they carried comes down onto what is below.

    Raises:
        EditError: nothing would be left.
    """
    scene, gone = draft.scene, set(names)
    kept = tuple(obj for obj in scene.objects if obj.name not in gone)
    if not kept:
        raise EditError("a scene needs at least one object; this would remove the last. Nothing was written.")
    lost = [rel for rel in scene.relations if rel.supports and rel.parent in gone and rel.child not in gone]
    orphans = dict.fromkeys(rel.child for rel in lost)
    # What was in it or hung from it is held no more; what lay on it is to come down as it stands.
    loose = {rel.child for rel in lost if rel.kind != "on"}
    notes = [f'"{name}" was held by what is removed, and comes down.' for name in orphans]
    below = {name: _first_kept(scene, name, gone) for name in orphans}
    relations = tuple(rel for rel in scene.relations if not {rel.child, rel.parent} & gone)
    for name, parent in below.items():
        if not any(rel.supports and rel.child == name for rel in relations):
            relations = carried_by(relations, name, None if parent == GROUND else parent)
    arrangements, dropped = without(scene, gone)
    notes += [f"no longer said, as part of it is removed: {one}." for one in dropped]
    task = scene.task if scene.task is None or not gone & {*named(scene.task)} else None
    if task != scene.task:
        notes.append(f'the task "{scene.task}" is dropped with what it is about.')
    left = replace(
        scene,
        objects=kept,
        relations=relations,
        arrangements=arrangements,
        attachments=tuple(one for one in scene.attachments if not {one.child, one.parent} & gone),
        task=task,
    )
    found = draft.with_scene(left, notes=notes)
    found = replace(found, loose=found.loose | loose)
    bodies = found.placed(name for name in orphans if not found.scene[name].fixed)
    for name in sorted(bodies, key=lambda one: float(bodies[one].low[2])):
        found = _let_down(found, name)
    return found


def _first_kept(scene: Scene, name: str, gone: set[str]) -> str:
    """What was under `name` below everything that is `gone`."""
    parent = scene.parent(name)
    while parent in gone:
        parent = scene.parent(parent)
    return parent


def _let_down(draft: Draft, name: str) -> Draft:
    """`name`, whose support is gone, just over what is below it, with what it carries."""
    from pat3d.layout.drop import fall

    group, others = group_of(draft, name)
    down = min(fall(member, others, floor=0.0, gap=GAP) for member in group.members)
    lowered = group.shifted(np.array([0.0, 0.0, -down]))
    scene = posed(draft.scene, lowered.members) if down else draft.scene
    under = support_under(lowered.root, others)
    if under is not None and len(scene.carriers(name)) == 1:
        scene = replace(scene, relations=carried_by(scene.relations, name, None if under == GROUND else under))
    return draft.with_scene(scene, carried(scene, [name]))


def without(scene: Scene, gone: set[str]) -> tuple[tuple[Arrangement, ...], list[Arrangement]]:
    """The arrangements of `scene` that have nothing to do with `gone`, and the others."""
    kept = tuple(one for one in scene.arrangements if not gone & set(one.names))
    return kept, [one for one in scene.arrangements if one not in kept]


def move(draft: Draft, name: str, x: float, y: float) -> Draft:
    """Move `name` by x and y [m], with what it carries.

    Raises:
        EditError: something is in the way, or nothing but the ground is under it there.
    """
    return _brought(draft, name, np.eye(3), np.array([x, y, 0.0]))


def turn(draft: Draft, name: str, angle: float) -> Draft:
    """Turn `name` by `angle` [rad] about the vertical, with what it carries.

    Raises:
        EditError: something is in the way.
    """
    return _brought(draft, name, yaw_matrix(angle), np.zeros(3))


def _brought(draft: Draft, name: str, rotation: np.ndarray, offset: np.ndarray) -> Draft:
    scene, parent = draft.scene, draft.scene.parent(name)
    if any(name == one.child for one in scene.attachments):
        raise EditError(f'"{name}" hangs; what hangs cannot be moved by itself. Nothing was written.')
    group, others = group_of(draft, name)
    there = shifted(group, rotation, offset)
    if scene[name].fixed:
        blocked = next((other for other in others if _intersects(there, other)), None)
        if blocked is not None:
            raise EditError(f'"{name}" has no room there: "{blocked.body.name}" is in the way. Nothing was written.')
        return draft.with_scene(posed(scene, there.members), carried(scene, [name]))
    down = put_down(there, others)
    under = support_under(down.root, others)
    if under is None:
        raise EditError(f'nothing would carry "{name}" there. Nothing was written.')
    if under == GROUND and parent != GROUND:
        raise EditError(
            f'"{name}" would leave "{parent}": only the ground is under it there, {there.low[2] - down.low[2]:.2f} m '
            f'below. To put it there: "{name}: onto the ground". Nothing was written.'
        )
    scene = posed(scene, down.members)
    notes = []
    if len(scene.carriers(name)) > 1 or under != parent:
        kinds = {rel.kind for rel in scene.relations if rel.supports and rel.child == name}
        if not (kinds == {"in"} and under == parent):
            scene = replace(scene, relations=carried_by(scene.relations, name, None if under == GROUND else under))
            notes.append(
                f'"{name}" now stands on the {under}.' if under == GROUND else f'"{name}" is now on "{under}".'
            )
    return draft.with_scene(scene, carried(scene, [name]), notes=notes)


def _intersects(group: Group, other) -> bool:
    from pat3d.layout.bodies import distance

    return any((found := distance(member, other, 1e-6)) is not None and found.distance <= 0 for member in group.members)


def posture(draft: Draft, name: str, kind: PostureKind) -> Draft:
    """Lay `name` down, stand it up or put it upside down, on what carries it now.

    Raises:
        LayoutError: there is no room for it.
    """
    objects = tuple(replace(obj, posture=kind) if obj.name == name else obj for obj in draft.scene.objects)
    return laid_out(draft.with_scene(replace(draft.scene, objects=objects)), carried(draft.scene, [name]))


def related(draft: Draft, name: str, relations: Sequence[Relation], arrangements: Sequence[Arrangement] = ()) -> Draft:
    """Put `name` where `relations` and `arrangements` say; what carries it and where it stood are forgotten.

    Raises:
        LayoutError: there is no room for it.
        SpecError: it cannot be there.
    """
    scene = draft.scene
    said = any(rel.supports and rel.child == name for rel in relations)
    kept = [
        rel for rel in scene.relations if name not in (rel.child, rel.parent) or (rel.supports and rel.parent == name)
    ]
    if not said:
        kept += [rel for rel in scene.relations if rel.supports and rel.child == name]
    onto_ground = [rel for rel in relations if rel.supports and rel.parent == GROUND]
    new = [rel for rel in relations if rel not in onto_ground]
    others, dropped = without(scene, {name})
    changed = replace(
        scene,
        relations=(*kept, *new),
        arrangements=(*others, *arrangements),
        attachments=tuple(one for one in scene.attachments if one.child != name),
    )
    notes = [f"no longer said, as it is moved: {one}." for one in dropped]
    found = laid_out(draft.with_scene(changed, notes=notes), carried(changed, [name]))
    return replace(found, asked=(*found.asked, *new, *arrangements))


def resized(draft: Draft, name: str, factor: float) -> Draft:
    """Make `name` `factor` times as large where it stands, with what it carries put on it again.

    Raises:
        EditError: there is no room for it.
        LayoutError: there is no room on it.
    """
    return exchanged(draft, name, lambda asset: scaled(asset, factor))


def exchanged(
    draft: Draft,
    name: str,
    change: Callable[[Asset], Asset],
    rename: Callable[[SceneObject], SceneObject] | None = None,
) -> Draft:
    """Put another asset in the place of that of `name`: the same foot, the same direction.

    Raises:
        EditError: there is no room for it.
        LayoutError: there is no room on it.
    """
    scene = draft.scene
    old = scene[name]
    new = replace(old, asset=change(old.asset))
    new = rename(new) if rename is not None else new
    scene = _exchanged(scene, old, new)
    above = [one for one in carried(scene, [new.name]) if one != new.name]
    found = draft.with_scene(scene, [new.name, *above])
    body = found.placed([new.name])[new.name]
    kinds = {rel.kind for rel in scene.relations if rel.supports and rel.child == new.name}
    if new.fixed or (upright(body) and kinds <= {"on"}):
        rest = found.placed(set(found.placed()) - {new.name, *above})
        group = Group((body,))
        if new.fixed:
            if any(_intersects(group, other) for other in rest.values()):
                raise EditError(f'"{new.name}" has no room where it is. Nothing was written.')
        else:
            found = found.with_scene(posed(scene, put_down(group, list(rest.values())).members))
        return laid_out(found, above) if above else found
    return laid_out(found, [new.name, *above])


def _exchanged(scene: Scene, old: SceneObject, new: SceneObject) -> Scene:
    """`scene` with `new` in the place of `old`, under its own name everywhere."""

    def called(name: str) -> str:
        return new.name if name == old.name else name

    return replace(
        scene,
        objects=tuple(new if obj is old else obj for obj in scene.objects),
        relations=tuple(replace(rel, child=called(rel.child), parent=called(rel.parent)) for rel in scene.relations),
        arrangements=tuple(
            replace(one, objects=tuple(map(called, one.objects)), of=tuple(map(called, one.of)))
            for one in scene.arrangements
        ),
        attachments=tuple(
            replace(one, child=called(one.child), parent=called(one.parent)) for one in scene.attachments
        ),
        task=None if scene.task is None else renamed(scene.task, {old.name: new.name}),
    )


def set_value(draft: Draft, name: str, what: str, value: str) -> Draft:
    """Give `name` another mass, density, friction or material.

    Raises:
        EditError: no such quantity, or no such value of it.
        AssetError: no such material.
    """
    old = draft.scene[name]
    new = replace(old, asset=with_value(old.asset, what, value))
    objects = tuple(new if obj is old else obj for obj in draft.scene.objects)
    return draft.with_scene(replace(draft.scene, objects=objects))


def set_fixed(draft: Draft, name: str, fixed: bool) -> Draft:
    """Fix `name` where it is, or let it go."""
    objects = tuple(replace(obj, fixed=fixed) if obj.name == name else obj for obj in draft.scene.objects)
    touched = () if fixed else carried(draft.scene, [name])
    return draft.with_scene(replace(draft.scene, objects=objects), touched)


def tilt(before: np.ndarray, after: np.ndarray) -> float:
    """Angle between the verticals of two rotation matrices, shape (3, 3) each [degrees]."""
    return math.degrees(math.acos(float(np.clip(before[2] @ after[2], -1.0, 1.0))))
