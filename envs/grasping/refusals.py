"""Why a robot cannot take an object, said of what is really in the way."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pat3d.envs.grasping.grasp import CLEARANCE, MIN_BITE, SQUEEZE, TIP_CLEARANCE, find_grasps, narrowest
from pat3d.envs.grasping.height_grid import CELL
from pat3d.envs.robots.robot import Gripper
from pat3d.scene.model import GROUND, Scene, SceneObject


def why_not(scene: Scene, name: str, gripper: Gripper) -> str:
    """What keeps the gripper from object `name`, of which it has no grasp where it stands; goes on after "because"."""
    parent = scene.parent(name)
    carrier = () if parent == GROUND else (parent,)
    if find_grasps(scene, name, gripper, among=carrier):
        return f"{_neighbours(scene, name, gripper)} no room for the fingers"
    if carrier and find_grasps(scene, name, gripper, among=()):
        return _in_its_place(scene[name], scene[parent], scene, gripper)
    return _by_itself(scene[name], gripper)


def _neighbours(scene: Scene, name: str, gripper: Gripper) -> str:
    """Which objects beside or on `name` would have to go, where one of them would do."""
    others = [obj.name for obj in scene.objects if obj.name != name]
    for one in others:
        if one != scene.parent(name) and find_grasps(scene, name, gripper, among=[o for o in others if o != one]):
            return f'"{one}" leaves'
    return "what stands around it leaves"


def _in_its_place(obj: SceneObject, carrier: SceneObject, scene: Scene, gripper: Gripper) -> str:
    """Of an object that could be taken if what carries it were not there."""
    if _covered(obj, carrier):
        return f'it is under a part of "{carrier.name}" and cannot be got at from above'
    below = 1e3 * (_rim(carrier) - _height(obj)[1])
    fingers_alone = replace(gripper, hand=(0.0, 0.0))
    if find_grasps(scene, obj.name, fingers_alone, among=(carrier.name,)):
        reach = 1e3 * (gripper.palm - MIN_BITE - CLEARANCE)
        return (
            f'its top is {below:.0f} mm below the rim of "{carrier.name}", where the hand does not fit in; the fingers '
            f"alone take what is at most {reach:.0f} mm below"
        )
    if below > 0.0:
        return f'"{carrier.name}" leaves no room for the fingers beside it'
    return f'"{carrier.name}" leaves no room for the fingers below its top'


def _covered(obj: SceneObject, carrier: SceneObject) -> bool:
    """Whether a part of the carrier is above the middle of the object."""
    middle = obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0]
    for part in carrier.asset.parts:
        points = carrier.pose.apply(part.vertices)
        low, high = points.min(axis=0), points.max(axis=0)
        if low[2] >= _height(obj)[1] and (low[:2] <= middle[:2]).all() and (middle[:2] <= high[:2]).all():
            return True
    return False


def _by_itself(obj: SceneObject, gripper: Gripper) -> str:
    """Of an object that could not be taken on an empty ground either."""
    low, high = _height(obj)
    width = narrowest(obj)
    if high - low < MIN_BITE + TIP_CLEARANCE:
        return (
            f"it is {1e3 * (high - low):.0f} mm high, and the fingers hold at least {1e3 * MIN_BITE:.0f} mm of it, "
            f"{1e3 * TIP_CLEARANCE:.0f} mm above what is below"
        )
    if width < gripper.closed + SQUEEZE:
        return f"it is {1e3 * width:.0f} mm thick, and the closed gripper leaves {1e3 * gripper.closed:.0f} mm"
    wide = f"it is {1e3 * width:.0f} mm wide at its narrowest, the gripper opens {1e3 * gripper.opening:.0f} mm"
    if width > gripper.opening:
        return f"{wide}, and it has no rim or handle that fits"
    if width > gripper.opening - 2 * (CLEARANCE + CELL):
        return f"{wide}, which leaves too little play, and it has no rim or handle that fits"
    return f"{wide}, and nowhere between do two of its sides face the fingers"


def _rim(obj: SceneObject) -> float:
    """Height of the rim of a container [m]; of the highest point of anything else."""
    region = obj.asset.region("in")
    if region is None:
        return _height(obj)[1]
    return float(obj.pose.apply(np.array([region.floor]) + [0.0, 0.0, region.height])[0, 2])


def _height(obj: SceneObject) -> tuple[float, float]:
    """Lowest and highest point [m]."""
    heights = np.concatenate([obj.pose.apply(part.vertices)[:, 2] for part in obj.asset.parts])
    return float(heights.min()), float(heights.max())
