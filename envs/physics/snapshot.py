"""What predicates read: the state of worlds that are copies of one another, and the floors of containers and bases."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from pat3d.envs.grasping.hand import hand_pose
from pat3d.envs.physics.world import World
from pat3d.envs.robots.arms import measure_gripper
from pat3d.scene.asset import Asset, Region

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]
Mask = NDArray[np.bool_]

REGION_MARGIN = 0.01
"""An object counts as over a floor up to this far beyond its edge [m]."""

SLACK = 1e-4
"""By which bounds are wider than what they bound [m], for states in single precision."""


class Grips(NamedTuple):
    """How the hand is where it grasps an object: its grip site in the object's frame, grasp by grasp."""

    position: Array
    """[m], shape (grasps, 3)."""
    approach: Array
    """Where the fingers point, shape (grasps, 3)."""
    closing: Array
    """In which direction, or its opposite, they close, shape (grasps, 3)."""
    ends: Numbers
    """Grasps of object k are those from ends[k] to ends[k + 1]."""
    axis: Array
    """The direction in which they close in the frame of the grip site, shape (3,)."""


class Snapshot(NamedTuple):
    """The state of worlds as the predicates read it."""

    xpos: Array
    """Of body frames [m], shape (worlds, bodies, 3)."""
    xmat: Array
    """Of body frames, shape (worlds, bodies, 9)."""
    xipos: Array
    """Of centres of mass [m], shape (worlds, bodies, 3)."""
    qvel: Array
    """[m/s] and [rad/s], shape (worlds, degrees of freedom)."""
    sites: Array
    """[m], shape (worlds, sites, 3)."""
    site_xmat: Array
    """Of their frames, shape (worlds, sites, 9)."""
    touching: Mask
    """Who touches whom, symmetric, shape (worlds, OWNERS + objects, OWNERS + objects)."""
    pinched: Mask
    """What the fingers press on in closing or opening, two of each arm, shape (worlds, 2 or 4, OWNERS + objects)."""
    start_centre: Array
    """Of mass at the start of the episode [m], shape (worlds, objects, 3)."""
    start_up: Array
    """The world's upright direction in the objects' frames at the start, shape (worlds, objects, 3)."""
    bodies: Numbers
    """Of every object."""
    dofs: Numbers
    """First of every object, -1 where it cannot move."""
    hand: int
    """Site of the grip, of the arm that does the task where there are two."""
    surface: float
    """Height below which an object is off the work [m]."""
    grips: Grips


def grips(world: World) -> Grips:
    """The grasps that the arm of a world's task knows, where the objects stand at rest."""
    gripper, scene = measure_gripper(world.robot.name), world.scene
    known = [world.placement.grasps.get(obj.name, ()) for obj in scene.objects]
    position, approach, closing = np.empty((3, sum(map(len, known)), 3))
    pairs = [(obj, grasp) for obj, found in zip(scene.objects, known, strict=True) for grasp in found]
    for row, (obj, grasp) in enumerate(pairs):
        at, turn = hand_pose(grasp, gripper.tip, gripper.closing_axis)
        own = obj.pose.rotation.T
        position[row] = own @ (at - obj.pose.position)
        approach[row], closing[row] = own @ turn[:, 2], own @ turn @ gripper.closing_axis
    ends = np.cumsum([0, *map(len, known)], dtype=np.int64)
    return Grips(position, approach, closing, ends, np.array(gripper.closing_axis, dtype=np.float64))


class Floors(NamedTuple):
    """Children and the floors of their parents, pair by pair."""

    children: Numbers
    parents: Numbers
    present: Mask
    """Whether the parent has such a floor."""
    disc: Mask
    floor: Array
    """Its centre in the parent's frame [m], shape (pairs, 3)."""
    half: Array
    """Its half extents with the margin [m], shape (pairs, 2)."""
    height: Array
    """Free above it [m]."""
    corners: Array
    """Of all children, each in its own frame [m], shape (corners, 3)."""
    ends: Numbers
    """Corners of pair k are those from ends[k] to ends[k + 1]."""
    reach: Array
    """No corner of the child is further from its centre of mass [m]."""


def floors(world: World, pairs: Sequence[tuple[str, str]], kind: Literal["in", "on"]) -> Floors:
    """The floors of one kind for pairs of child and parent."""
    scene = world.scene
    numbers = {obj.name: number for number, obj in enumerate(scene.objects)}
    regions = [scene[parent].asset.region(kind) for _, parent in pairs]
    none = Region(kind=kind, shape="disc", floor=(0.0, 0.0, 0.0), half_size=(0.0, 0.0))
    known = [region or none for region in regions]
    assets = [scene[child].asset for child, _ in pairs]
    hulls = [corners(asset) for asset in assets]
    middles = [np.array(asset.mass_properties.centre_of_mass) for asset in assets]
    reach = [np.linalg.norm(own - middle, axis=1).max() for own, middle in zip(hulls, middles, strict=True)]
    return Floors(
        children=np.array([numbers[child] for child, _ in pairs], dtype=np.int64),
        parents=np.array([numbers[parent] for _, parent in pairs], dtype=np.int64),
        present=np.array([region is not None for region in regions], dtype=np.bool_),
        disc=np.array([region.shape == "disc" for region in known], dtype=np.bool_),
        floor=np.array([region.floor for region in known], dtype=np.float64),
        half=np.array([region.half_size for region in known], dtype=np.float64) + REGION_MARGIN,
        height=np.array([region.height for region in known], dtype=np.float64),
        corners=np.ascontiguousarray(np.concatenate(hulls)),
        ends=np.cumsum([0, *map(len, hulls)], dtype=np.int64),
        reach=np.array(reach) + SLACK,
    )


_CORNERS: WeakKeyDictionary[Asset, Array] = WeakKeyDictionary()
"""Gone with the assets, whose meshes and textures take megabytes."""


def corners(asset: Asset) -> Array:
    """Of the convex parts of an asset, in its frame [m], shape (n, 3)."""
    found = _CORNERS.get(asset)
    if found is None:
        found = _CORNERS[asset] = np.concatenate([part.vertices for part in asset.parts])
    return found
