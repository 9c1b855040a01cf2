"""Scenes whose poses were edited after they had settled: which objects, and a start from which all settle again."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from pat3d.errors import LayoutError
from pat3d.layout.bodies import Placed, distance, place
from pat3d.scene.folder import read_trajectory
from pat3d.scene.model import GROUND, Scene

MOVED, TURNED = 2e-5, 1e-3
"""An object is elsewhere than it settled from this much on: its centre of mass [m], and its rotation matrix [-]. The
trajectory is kept in single precision, and its linear maps are rotations to about 1e-5."""

GAP = 1e-4
"""What is lifted out of something keeps this distance from it [m]."""

_FIRST_LIFT, _MAX_LIFT = 1e-3, 10.0
"""[m]"""


def edited(scene: Scene, folder: Path) -> frozenset[str]:
    """Objects of `scene` that are elsewhere than where the trajectory in its `folder` ends.

    All of them where the trajectory is of other objects; none where there is no trajectory to tell.
    """
    trajectory = read_trajectory(folder / "trajectory.npz")
    names = [obj.name for obj in scene.objects]
    if trajectory is None:
        return frozenset()
    if trajectory["names"].tolist() != names:
        return frozenset(names)
    found = set()
    for obj, state, centre in zip(scene.objects, trajectory["states"][-1], trajectory["centres"], strict=True):
        moved = np.abs(obj.pose.apply(centre[None])[0] - state[0]).max()
        turned = np.abs(obj.pose.rotation - state[1:].T).max()
        if moved > MOVED or turned > TURNED:
            found.add(obj.name)
    return frozenset(found)


def laid_out_as_posed(scene: Scene, changed: Collection[str] = ()) -> Scene:
    """`scene` with its poses for the initial layout; what intersects is lifted, with what it carries, until clear.

    Of two objects that intersect, the one that `changed` names is lifted, else the one that is carried.

    Raises:
        LayoutError: an object would have to be lifted through the ceiling of any room.
    """
    moving = [obj for obj in scene.objects if not obj.fixed]
    placed = {obj.name: place(obj.name, obj.asset, obj.pose) for obj in scene.objects}
    settled = [placed[obj.name] for obj in scene.objects if obj.fixed]
    lifts = dict.fromkeys(placed, 0.0)
    order = sorted(moving, key=lambda obj: (_depth(scene, obj.name), obj.name in changed, placed[obj.name].low[2]))
    for obj in order:
        carried = max(lifts.get(one, 0.0) for one in scene.carriers(obj.name))
        body = _raised(placed[obj.name], carried)
        more = _lift(body, settled)
        lifts[obj.name] = carried + more
        settled.append(_raised(body, more))
    objects = []
    for obj in scene.objects:
        x, y, z = obj.pose.position
        pose = replace(obj.pose, position=(x, y, z + lifts[obj.name])) if lifts[obj.name] else obj.pose
        objects.append(replace(obj, pose=pose, initial_pose=pose))
    return replace(scene, objects=tuple(objects))


def _depth(scene: Scene, name: str) -> int:
    """How many objects are under `name` in the scene tree, at most."""
    return max(0 if one == GROUND else 1 + _depth(scene, one) for one in scene.carriers(name))


def _lift(body: Placed, others: Sequence[Placed]) -> float:
    """How far `body` has to rise to be clear of `others` and of the ground [m]; 0 where it is."""

    def clear(lift: float, gap: float) -> bool:
        raised = _raised(body, lift)
        nearest = (distance(raised, other, max(gap, 1e-12)) for other in others)
        return raised.low[2] > 0.0 and all(one is None or one.distance > gap for one in nearest)

    if clear(0.0, 0.0):
        return 0.0
    low, high = 0.0, _FIRST_LIFT
    while not clear(high, GAP):
        low, high = high, 1.5 * high
        if high > _MAX_LIFT:
            raise LayoutError(
                f'"{body.body.name}" intersects something even {_MAX_LIFT:g} m higher. Nothing was written.'
            )
    while high - low > GAP / 4:
        middle = (low + high) / 2
        low, high = (low, middle) if clear(middle, GAP) else (middle, high)
    return high


def _raised(body: Placed, lift: float) -> Placed:
    return body.shifted(np.array([0.0, 0.0, lift])) if lift else body
