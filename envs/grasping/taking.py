"""How a robot can take the objects of a task where they stand, or why it cannot."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import NoReturn

import numpy as np

from pat3d.envs.grasping.grasp import STEADY, Grasp, find_grasps, torque
from pat3d.envs.grasping.leaning import LEANING_PAYLOAD, find_leaning_grasps
from pat3d.envs.grasping.refusals import why_not
from pat3d.envs.robots.arms import make_robot, measure_gripper
from pat3d.errors import TaskError
from pat3d.scene.model import Scene

GRASPS_TRIED = 6
"""Grasps from above of an object, at most."""


def grasps_of(scene: Scene, names: Sequence[str], robot: str, *, put: bool, cleared: bool) -> dict[str, list[Grasp]]:
    """Grasps of every object, best first, in the order in which the objects are taken.

    Args:
        scene: at rest.
        names: of the objects.
        robot: name of the arm.
        put: whether they are put somewhere, for which they have to be held from above and steadily.
        cleared: whether they are taken one after the other, so that what was taken is no longer in the way.

    Raises:
        TaskError: an object is too heavy, too wide, or blocked.
    """
    if not cleared:
        return {name: _grasps(scene, name, robot, put=put) for name in names}
    grasps: dict[str, list[Grasp]] = {}
    while left := [name for name in names if name not in grasps]:
        rest = _without(scene, grasps)
        refused: TaskError | None = None
        for name in left:
            # What still carries one of the others has to wait for it.
            if any(name in rest.carriers(other) for other in left):
                continue
            try:
                grasps[name] = _grasps(rest, name, robot, put=True)
                break
            except TaskError as error:
                refused = refused or error
        else:
            raise refused or TaskError(f"{', '.join(left)} carry one another.")
    return grasps


def _grasps(scene: Scene, name: str, robot: str, *, put: bool) -> list[Grasp]:
    """Grasps of an object among everything in the scene, at least one."""
    gripper, properties = measure_gripper(robot), scene[name].asset.mass_properties
    mass = properties.mass
    payload = make_robot(robot).payload
    if mass > payload:
        raise TaskError(
            f'"{name}" is too heavy for {robot}: it weighs {mass:.1f} kg, the arm carries {payload:.1f} kg.'
        )
    found = find_grasps(scene, name, gripper)
    if not found and not put and mass <= LEANING_PAYLOAD:
        return find_leaning_grasps(scene, name, gripper) or _refused(scene, name, robot)
    if not found:
        _refused(scene, name, robot)
    centre = scene[name].pose.apply(np.array([properties.centre_of_mass]))[0]
    steady = [one for one in found if not put or torque(one, mass, centre) <= STEADY]
    if not steady:
        raise TaskError(
            f'"{name}" ({mass:.1f} kg) cannot be put anywhere by {robot}: it can only be held so far from its middle '
            f"that it turns in the fingers."
        )
    return steady[:GRASPS_TRIED]


def _refused(scene: Scene, name: str, robot: str) -> NoReturn:
    raise TaskError(f'"{name}" cannot be taken by {robot}: {why_not(scene, name, measure_gripper(robot))}.')


def _without(scene: Scene, gone: Collection[str]) -> Scene:
    """The scene when some objects are gone."""
    objects = tuple(obj for obj in scene.objects if obj.name not in gone)
    relations = tuple(one for one in scene.relations if not {one.child, one.parent} & set(gone))
    arrangements = tuple(one for one in scene.arrangements if not {*one.names} & set(gone))
    attachments = tuple(one for one in scene.attachments if not {one.child, one.parent} & set(gone))
    kept = {"relations": relations, "arrangements": arrangements, "attachments": attachments}
    return replace(scene, objects=objects, task=None, **kept)
