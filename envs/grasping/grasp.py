"""Where a parallel gripper can take an object, found on height maps.

The fingers come down on both sides of something: where each of them goes, everything must be lower than its tip;
between them the object must reach up along the pads, and nothing else may. That covers bars, balls and boxes that fit
between the fingers as well as the rims of cups and bowls, of which one finger enters the inside. An approach that leans
is the same with the scene turned the other way, the ground with it.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from pat3d.envs.grasping.height_grid import CELL, HeightGrid, bounds
from pat3d.envs.robots.robot import Gripper
from pat3d.geometry.hulls import ConvexPart
from pat3d.geometry.planes import planes
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene, SceneObject
from pat3d.scene.physics import GRAVITY

Array = NDArray[np.float64]

CLEARANCE = 0.001
"""Kept between each finger and anything beside it [m]."""

TIP_CLEARANCE = 0.003
"""Kept below the fingertips [m]."""

MIN_BITE = 0.005
"""Least height of the object between the pads [m]."""

LOWEST = TIP_CLEARANCE + MIN_BITE
"""Least height of an object that can be taken from above where it lies [m]."""

SOLID = 0.003
"""What reaches less than this above the fingertips [m] does not count as between the fingers."""

SQUEEZE = 0.004
"""What is held must be thicker than the closed gripper by this [m]."""

STEADY = 0.6
"""What is put down somewhere may turn the fingers by this [N m]; beyond, it swings and slips in them."""

ANGLES = 16
"""Directions of closing that are tried over half a turn."""

DEPTHS = (0.35, 0.6, 0.95)
"""How deep to go between the fingers, as shares of the way to the palm or to where the gap gets narrower."""

FACING = math.cos(math.radians(31.0))
"""Least cosine between the closing direction and the surfaces that the pads meet."""

APART = 0.02
"""Grasps nearer than this to one another [m] count as one where they close alike."""

MAX_SIDE = 2.0
"""Objects wider than this [m] are not examined."""


@dataclass(frozen=True, kw_only=True)
class Grasp:
    """A place where the gripper closes on an object."""

    position: tuple[float, float, float]
    """Of the fingertips' middle [m] in the world."""
    closing: float
    """Angle [rad] of the direction in which the fingers close, about z from +x, before the hand leans."""
    bite: float
    """Extent of the object between the fingers, along the approach [m]."""
    score: float
    """Higher is better."""
    width: float = 0.0
    """Of what is between the fingers, along the closing direction [m]."""
    facing: float = 1.0
    """Least cosine between the closing direction and the surfaces that the pads meet."""
    lean: float = 0.0
    """Angle of the approach from straight down [rad]."""
    heading: float = 0.0
    """Direction from which a leaning hand comes [rad], about z from +x."""

    @property
    def turn(self) -> Array:
        """Rotation of a hand that points down to this one's approach, shape (3, 3)."""
        return leaning(self.lean, self.heading)

    def lifted(self, height: float) -> Grasp:
        """The same, `height` [m] further up."""
        x, y, z = self.position
        return replace(self, position=(x, y, z + height))


def leaning(lean: float, heading: float) -> Array:
    """Rotation by `lean` [rad] that brings what is above to the side of `heading` [rad], shape (3, 3)."""
    axis = np.array([-math.sin(heading), math.cos(heading), 0.0])
    cross = np.array([[0.0, 0.0, axis[1]], [0.0, 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + math.sin(lean) * cross + (1.0 - math.cos(lean)) * (cross @ cross)


def find_grasps(
    scene: Scene, name: str, gripper: Gripper, *, among: Collection[str] | None = None, count: int = 12
) -> list[Grasp]:
    """Grasps from above of object `name` where it stands in `scene`, best first, apart from one another.

    Args:
        scene: objects at rest.
        name: of the object.
        gripper: what it can take.
        among: the other objects that are in the way; None for all.
        count: of grasps, at most.
    """
    found = search(scene, name, gripper, among=among)
    return apart(sorted(found, key=lambda grasp: -grasp.score), count)


def search(
    scene: Scene,
    name: str,
    gripper: Gripper,
    *,
    among: Collection[str] | None = None,
    lean: float = 0.0,
    heading: float = 0.0,
    angles: int = ANGLES,
    wrist: tuple[float, float] | None = None,
) -> list[Grasp]:
    """Grasps along one approach, in no order.

    Args:
        scene: objects at rest.
        name: of the object.
        gripper: what it can take.
        among: see `find_grasps`.
        lean: see Grasp.
        heading: see Grasp.
        angles: directions of closing that are tried over half a turn.
        wrist: distance from the fingertips and width of what is behind the hand [m]; it is kept free too.
    """
    turn = leaning(lean, heading)
    target = _turned(scene[name], turn) if lean else scene[name]
    low, high = bounds(target)
    if float((high - low)[:2].max()) > MAX_SIDE:
        return []
    margin = max(gripper.opening / 2 + gripper.finger_thickness, gripper.hand[0] / 2, wrist[1] / 2 if wrist else 0.0)
    grid = HeightGrid.around(low[:2] - margin, high[:2] + margin)
    own = grid.heights([target])
    # What stands on the target or in it comes along and is in the way like anything else.
    others = [obj for obj in scene.objects if obj.name != name and (among is None or obj.name in among)]
    x, y = grid.world(0.0)
    ground = -(turn[2, 0] * x + turn[2, 1] * y) / turn[2, 2] if lean else np.zeros(x.shape)
    around = np.maximum(grid.heights([_turned(obj, turn) for obj in others] if lean else others), ground)
    centre = target.pose.apply(np.array([target.asset.mass_properties.centre_of_mass]))[0]
    found: list[Grasp] = []
    for number in range(angles):
        found += _along(math.pi * number / angles, grid, own, around, gripper, centre, wrist)
    found = _held(found, target, gripper)
    if not lean:
        return found
    places = [turn @ np.array(one.position) for one in found]
    return [
        replace(one, position=(float(x), float(y), float(z)), lean=lean, heading=heading)
        for one, (x, y, z) in zip(found, places, strict=True)
    ]


def _turned(obj: SceneObject, turn: Array) -> SceneObject:
    """An object in the frame of an approach, in which the hand points down."""
    pose = Pose.from_matrix(turn.T @ obj.pose.rotation, turn.T @ np.array(obj.pose.position))
    return replace(obj, pose=pose)


def torque(grasp: Grasp, mass: float, centre: Sequence[float]) -> float:
    """Of the weight of `mass` [kg] about a grasp from above [N m]; `centre` is where the centre of mass is [m]."""
    return mass * GRAVITY * math.dist(centre[:2], grasp.position[:2])


def narrowest(obj: SceneObject) -> float:
    """Least horizontal width of an object as it lies [m]."""
    points = np.concatenate([obj.pose.apply(part.vertices) for part in obj.asset.parts])[:, :2]
    angles = np.linspace(0.0, math.pi, 90, endpoint=False)
    return float(np.ptp(points @ np.stack([np.cos(angles), np.sin(angles)]), axis=0).min())


def _along(
    angle: float,
    grid: HeightGrid,
    own: Array,
    around: Array,
    gripper: Gripper,
    centre: Array,
    wrist: tuple[float, float] | None,
) -> list[Grasp]:
    """Places where the fingers fit when they close along `angle` [rad], at several depths."""
    turned_own, turned_other = grid.turned(own, angle), grid.turned(around, angle)
    turned_all = np.maximum(turned_own, turned_other)
    width = _odd(gripper.finger_width + 2 * CLEARANCE)
    thick = _odd(gripper.finger_thickness + 2 * CLEARANCE)
    # Rounded outwards: how much play the object itself leaves is measured exactly in `_held`.
    reach = math.ceil((gripper.opening / 2 + gripper.finger_thickness / 2) / CELL)
    # Axis 0 is the closing direction; a finger's highest obstacle, then shifted to either side.
    column = ndimage.maximum_filter(turned_all, size=(thick, width), mode="nearest")
    below = np.maximum(_shifted(column, reach), _shifted(column, -reach)) + TIP_CLEARANCE
    gap = max(3, 2 * round((gripper.opening / 2 - CLEARANCE) / CELL) + 1)
    # Nothing else stands between the fingers, which would close on that instead.
    below = np.maximum(below, ndimage.maximum_filter(turned_other, size=(gap, width), mode="nearest") + TIP_CLEARANCE)
    between = ndimage.maximum_filter(turned_own, size=(gap, 3), mode="nearest")
    hand = (_odd(gripper.hand[0]), _odd(gripper.hand[1]))
    below = np.maximum(below, ndimage.maximum_filter(turned_all, size=hand, mode="nearest") - gripper.palm + CLEARANCE)
    if wrist is not None:
        across = 2 * (_odd(wrist[1]),)
        below = np.maximum(below, ndimage.maximum_filter(turned_all, size=across, mode="nearest") - wrist[0])
    x, y = grid.world(angle)
    aside = np.hypot(x - centre[0], y - centre[1])
    found = []
    for share in DEPTHS:
        tip = np.maximum(below, np.where(np.isfinite(between), between, 0.0) - share * gripper.deepest)
        bite = np.where(np.isfinite(between), between - tip, -np.inf)
        # The middle of what is between the fingers belongs in the middle of the opening.
        solid = np.where(turned_own > tip + SOLID, 1.0, 0.0)
        amount = ndimage.uniform_filter1d(solid, gap, axis=0, mode="constant") * gap
        off = np.where(amount > 0.5, np.abs(_first_moment(solid, gap)) / np.maximum(amount, 1e-9), np.inf) * CELL
        score = np.minimum(bite, gripper.pad) / gripper.pad - 20.0 * off - 3.0 * aside
        rows, columns = np.nonzero((bite >= MIN_BITE) & (off < 0.01))
        best = np.argsort(-score[rows, columns], kind="stable")
        # Well spread ones, so that a better direction further from the middle is not crowded out.
        best = np.concatenate([best[:6], best[6 :: max(1, len(best) // 18)]])
        for row, column_ in zip(rows[best].tolist(), columns[best].tolist(), strict=True):
            found.append(
                Grasp(
                    position=(float(x[row, column_]), float(y[row, column_]), float(tip[row, column_])),
                    closing=angle,
                    bite=float(bite[row, column_]),
                    score=float(score[row, column_]),
                )
            )
    return found


def _held(grasps: list[Grasp], target: SceneObject, gripper: Gripper) -> list[Grasp]:
    """The grasps whose pads meet surfaces that face them, centred on those, the better facing ones ranked higher."""
    if not grasps:
        return []
    towards = np.array([[math.cos(one.closing), math.sin(one.closing), 0.0] for one in grasps])
    across = np.stack([-towards[:, 1], towards[:, 0], towards[:, 2]], axis=1)
    tips = np.array([one.position for one in grasps])
    heights = np.array([0.1, 0.35, 0.6, 0.85])[None] * np.minimum([one.bite for one in grasps], gripper.pad)[:, None]
    sides = np.array([-0.35, 0.0, 0.35]) * gripper.finger_width
    # One ray for every height and side, shape (grasps, heights, sides, 3), from the middle of the opening.
    start = tips[:, None, None] + heights[:, :, None, None] * [0.0, 0.0, 1.0]
    start = start + sides[None, None, :, None] * across[:, None, None]
    first = np.full(start.shape[:3], np.inf)
    last = np.full(start.shape[:3], -np.inf)
    facing = np.zeros((2, *start.shape[:3]))
    for part in target.asset.parts:
        normals, offsets = _half_spaces(part, target)
        enter, leave, cosines = _through(start, towards, normals, offsets)
        between = (enter > -gripper.opening / 2) & (leave < gripper.opening / 2) & (enter < leave)
        nearer, further = between & (enter < first), between & (leave > last)
        first[nearer], last[further] = enter[nearer], leave[further]
        facing[0][nearer], facing[1][further] = cosines[0][nearer], cosines[1][further]
    count = len(grasps)
    left, right = first.reshape(count, -1).argmin(axis=1), last.reshape(count, -1).argmax(axis=1)
    number = np.arange(count)
    low, high = first.reshape(count, -1)[number, left], last.reshape(count, -1)[number, right]
    thick = high - low
    met = (thick > gripper.closed + SQUEEZE) & (thick < gripper.opening - 2 * CLEARANCE)
    # Both fingers have to come down beside it, and one that meets it first pushes it.
    middles = tips + (np.where(met, low, 0.0) + np.where(met, high, 0.0))[:, None] / 2 * towards
    worse = np.minimum(facing[0].reshape(count, -1)[number, left], facing[1].reshape(count, -1)[number, right])
    touched = np.isfinite(first).mean(axis=(1, 2))
    return [
        replace(
            one,
            position=(float(middles[k, 0]), float(middles[k, 1]), float(middles[k, 2])),
            width=float(thick[k]),
            facing=float(worse[k]),
            score=one.score + 1.5 * float(worse[k]) + 0.5 * float(touched[k]),
        )
        for k, one in enumerate(grasps)
        if met[k] and worse[k] >= FACING
    ]


def _half_spaces(part: ConvexPart, target: SceneObject) -> tuple[Array, Array]:
    """Outward normals and offsets of a part in the world: inside where normals @ x <= offsets."""
    equations = planes(part)
    normals = equations[:, :3] @ target.pose.rotation.T
    return normals, normals @ np.array(target.pose.position) - equations[:, 3]


def _through(start: Array, towards: Array, normals: Array, offsets: Array) -> tuple[Array, Array, Array]:
    """Where lines enter and leave a convex part [m] and how squarely they meet its surface there.

    Returns:
        distances, shape (grasps, heights, sides) each, and the two cosines, shape (2, grasps, heights, sides).
    """
    slope = (towards @ normals.T)[:, None, None]
    ahead = offsets - start @ normals.T
    with np.errstate(divide="ignore", invalid="ignore"):
        cut = ahead / slope
    entering = np.where(slope < -1e-9, cut, -np.inf)
    leaving = np.where(slope > 1e-9, cut, np.inf)
    outside = ((np.abs(slope) <= 1e-9) & (ahead < 0.0)).any(axis=-1)
    first, last = entering.argmax(axis=-1), leaving.argmin(axis=-1)
    slopes = np.broadcast_to(slope, cut.shape)
    enter = np.where(outside, np.inf, np.take_along_axis(entering, first[..., None], -1)[..., 0])
    leave = np.where(outside, -np.inf, np.take_along_axis(leaving, last[..., None], -1)[..., 0])
    cosines = np.stack(
        [
            -np.take_along_axis(slopes, first[..., None], -1)[..., 0],
            np.take_along_axis(slopes, last[..., None], -1)[..., 0],
        ]
    )
    return enter, leave, cosines


def _first_moment(values: Array, size: int) -> Array:
    """Sum over a window along axis 0 of value times offset from its middle [cells]."""
    offsets = np.arange(size, dtype=np.float64) - size // 2
    return ndimage.correlate1d(values, offsets, axis=0, mode="constant")


def _shifted(values: Array, cells: int) -> Array:
    """`values` seen from `cells` further along axis 0; beyond the edge there is nothing."""
    out = np.full(values.shape, -np.inf)
    if cells > 0:
        out[:-cells] = values[cells:]
    else:
        out[-cells:] = values[:cells]
    return out


def _odd(length: float) -> int:
    return max(1, 2 * round(length / CELL / 2) + 1)


def apart(grasps: list[Grasp], count: int) -> list[Grasp]:
    """The best `count` that differ by APART or by 20 degrees."""
    kept: list[Grasp] = []
    for grasp in grasps:
        near = False
        for other in kept:
            turn = abs((grasp.closing - other.closing + math.pi / 2) % math.pi - math.pi / 2)
            near |= math.dist(grasp.position, other.position) < APART and turn < math.pi / 9
        if not near:
            kept.append(grasp)
            if len(kept) == count:
                break
    return kept
