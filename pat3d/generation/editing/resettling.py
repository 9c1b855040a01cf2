"""A draft comes to rest from where it is: what the edits touched falls, then all find their equilibrium together.

While the touched objects fall, everything else stands still, so that it cannot be shaken. Then all are free, at the
contact distances of the end of settling, where what carries the same load as before moves by nanometres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from pat3d.check.verification import relations_at_rest
from pat3d.errors import EditError
from pat3d.generation.editing.draft import Draft, carried_by, support_under
from pat3d.generation.editing.steps import tilt
from pat3d.generation.settle_stage import SettledScene, settle_scene
from pat3d.layout.predicates import RelationResult
from pat3d.progress import Progress, silent
from pat3d.scene.arrangements import Posture
from pat3d.scene.model import GROUND, Scene

TOPPLED = (20.0, 0.1)
"""What falls over is tilted by more than this [degrees] from how it was put down, and its centre of mass is nearer to
its lowest point, or further from it, by more than this share of its longest side: a ball that rolls is not."""


@dataclass(frozen=True, kw_only=True)
class Motion:
    """How far an object went from the scene before to the one after."""

    mm: float
    """Of its centre of mass."""
    degrees: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Changes:
    """What edits did to a scene."""

    added: tuple[str, ...]
    removed: tuple[str, ...]
    moved: Mapping[str, Motion]
    """Of every object that was there before and is there after."""
    broke: tuple[str, ...]
    """What held before and does not any more, a line each."""
    notes: tuple[str, ...]
    """What was decided where the edits were silent."""

    @property
    def farthest(self) -> tuple[str, Motion] | None:
        """What moved the farthest."""
        return max(self.moved.items(), key=lambda one: one[1].mm, default=None)

    def as_dict(self) -> dict[str, Any]:
        """Plain data for report.json."""
        return {
            "added": list(self.added),
            "removed": list(self.removed),
            "moved": {name: {"mm": one.mm, "degrees": one.degrees} for name, one in self.moved.items()},
            "broke": list(self.broke),
            "notes": list(self.notes),
        }


def settled(
    draft: Draft, before: Scene, *, device: str = "cpu", progress: Progress = silent
) -> tuple[SettledScene, Scene, Changes]:
    """Bring `draft` to rest; `before` is the scene at rest that it was made of.

    Returns:
        How it settled, the scene at rest, and what the edits changed.

    Raises:
        EditError: it does not come to rest, something topples, or what an edit asks for does not hold.
        SimulationError: it cannot be simulated.
    """
    start = _from_here(draft.scene)
    found = _let_fall(start, draft.touched, device, progress)
    scene = found.of(start)
    if not found.at_rest:
        raise EditError(
            f"the edited scene does not come to rest ({found.record['residual']:.2g} of a weight is unbalanced). "
            "Nothing was written."
        )
    scene = _where_loose_things_lie(draft, scene)
    _require_standing(draft, start, scene)
    scene, broke = _judged(draft, scene, relations_at_rest(before))
    changes = Changes(
        added=tuple(obj.name for obj in scene.objects if obj.name not in _names(before)),
        removed=tuple(obj.name for obj in before.objects if obj.name not in _names(scene)),
        moved=_motions(before, scene),
        broke=broke,
        notes=draft.notes,
    )
    return found, scene, changes


def _let_fall(start: Scene, touched: frozenset[str], device: str, progress: Progress) -> SettledScene:
    falling = frozenset(name for name in touched if not start[name].fixed)
    scene, fell = start, None
    if falling:
        held = replace(start, objects=tuple(replace(obj, fixed=obj.name not in falling) for obj in start.objects))
        fell = settle_scene(held, device=device, progress=progress)
        scene = _from_here(fell.of(start))
    found = settle_scene(scene, device=device, progress=progress, near_rest=True)
    if not found.at_rest:
        # Something that stood leans now on what came: everything has to find its place.
        found = settle_scene(scene, device=device, progress=progress)
    if fell is None:
        return found
    counts = ("frames", "polish_steps", "newton_iterations", "unconverged_steps")
    record = {**found.record, **{key: found.record[key] + fell.record[key] for key in counts}}
    return replace(found, states=np.concatenate([fell.states, found.states]), record=record)


def _from_here(scene: Scene) -> Scene:
    return replace(scene, objects=tuple(replace(obj, initial_pose=obj.pose) for obj in scene.objects))


def _where_loose_things_lie(draft: Draft, scene: Scene) -> Scene:
    """`scene` with what lost its holder on whatever it came to lie on."""
    bodies = draft.with_scene(scene).placed()
    for name in sorted(draft.loose):
        under = support_under(bodies[name], [body for other, body in bodies.items() if other != name])
        parent = None if under in (None, GROUND) else under
        scene = replace(scene, relations=carried_by(scene.relations, name, parent))
    return scene


def _require_standing(draft: Draft, start: Scene, scene: Scene) -> None:
    for obj in scene.objects:
        if obj.name in draft.loose or obj.fixed:
            continue
        first, last = start[obj.name].pose, obj.pose
        centre = np.array([obj.asset.mass_properties.centre_of_mass])
        points = np.concatenate([part.vertices for part in obj.asset.parts])
        heights = [float(pose.apply(centre)[0, 2] - pose.apply(points)[:, 2].min()) for pose in (first, last)]
        angle = tilt(first.rotation, last.rotation)
        if angle > TOPPLED[0] and abs(heights[1] - heights[0]) > TOPPLED[1] * float(obj.asset.size.max()):
            raise EditError(
                f'"{obj.name}" would topple: it comes to rest {angle:.0f} degrees from upright. Nothing was written.'
            )


def _judged(draft: Draft, scene: Scene, before: Sequence[RelationResult]) -> tuple[Scene, tuple[str, ...]]:
    """`scene` without the relations beside one another that its edits broke, and a line for each of them."""
    results = relations_at_rest(scene)
    asked = {str(one) for one in draft.asked}
    faulty = {str(one.relation) for one in before if not one.holds}
    broken: list[RelationResult] = []
    for one in results:
        if one.holds:
            continue
        line = f"{one.relation} ({one.detail})"
        if str(one.relation) in asked:
            raise EditError(f"what was asked for does not hold at rest: {line}. Nothing was written.")
        if str(one.relation) in faulty and (isinstance(one.relation, Posture) or one.relation.supports):
            raise EditError(f"the scene did not hold before it was edited: {line}. Nothing was written.")
        if isinstance(one.relation, Posture) or one.relation.supports:
            raise EditError(f"the edited scene does not stay as it was: {line}. Nothing was written.")
        if str(one.relation) not in faulty:
            broken.append(one)
    gone = {one.relation for one in broken}
    kept = replace(
        scene,
        relations=tuple(one for one in scene.relations if one not in gone),
        arrangements=tuple(one for one in scene.arrangements if one not in gone),
    )
    return kept, tuple(f"{one.relation} ({one.detail})" for one in broken)


def _motions(before: Scene, after: Scene) -> dict[str, Motion]:
    there = _names(before)
    found = {}
    for obj in after.objects:
        if obj.name not in there:
            continue
        old = before[obj.name]
        centre = np.array([old.asset.mass_properties.centre_of_mass])
        way = obj.pose.apply(centre)[0] - old.pose.apply(centre)[0]
        turned = obj.pose.rotation @ old.pose.rotation.T
        sine = 0.5 * np.linalg.norm(
            [turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]
        )
        angle = float(np.degrees(np.arctan2(sine, 0.5 * (np.trace(turned) - 1.0))))
        found[obj.name] = Motion(mm=1e3 * float(np.linalg.norm(way)), degrees=angle)
    return found


def _names(scene: Scene) -> frozenset[str]:
    return frozenset(obj.name for obj in scene.objects)
