"""Where there is room for an object beside another: spots of the surface that carries the other, on a side of it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pat3d.envs.grasping.spots import CROWDED, FREE_GAP, GAP
from pat3d.envs.physics.predicates import CONTACT_DEPTH
from pat3d.envs.physics.snapshot import Array, Mask
from pat3d.envs.tasks.goals import points_of
from pat3d.envs.tasks.push import bench_at_rest
from pat3d.envs.tasks.push_goals import DIRECTIONS
from pat3d.envs.tasks.task import centre_of_mass, rests_upon
from pat3d.errors import TaskError
from pat3d.layout.lateral import Seen, related
from pat3d.scene.asset import Region
from pat3d.scene.model import GROUND, Scene
from pat3d.scene.relations import SIDES

if TYPE_CHECKING:
    from pat3d.envs.physics.state import SimState

GAPS = (0.05, 0.08, 0.12, 0.16)
"""Between the bounding boxes of the two along the axis of the relation [m]; fingers have room in the first."""

STEP = 0.03
"""Between the spots that are tried across that axis [m]."""

MARGIN = 0.02
"""The relation holds at a spot, and this far from it along both axes [m]."""

RIM = 0.02
"""Kept from the edge of the surface [m]."""

SPOTS = 6
"""That are offered, at most."""


@dataclass(frozen=True, kw_only=True)
class Surface:
    """What carries an object: a top of something else, the workbench, or the floor."""

    height: float
    """[m]"""
    bench: tuple[tuple[float, float], tuple[float, float]] | None = None
    """Lower and upper corner of the workbench [m]."""
    region: Region | None = None
    """The top of what carries it, in the frame of that."""
    rotation: Array | None = None
    """Of that frame, shape (3, 3)."""
    position: Array | None = None
    """[m], shape (3,)."""

    def holds(self, points: Array) -> Mask:
        """Which points seen from above [m], shape (..., 2), are on it and away from its edge."""
        if self.bench is not None:
            low, high = np.array(self.bench)
            return np.asarray(((points >= low + RIM) & (points <= high - RIM)).all(axis=-1))
        if self.region is None or self.rotation is None or self.position is None:
            return np.ones(points.shape[:-1], dtype=np.bool_)
        flat = (points - self.position[:2]) @ self.rotation[:2, :2] - np.array(self.region.floor[:2])
        half = np.array(self.region.half_size) - RIM
        if self.region.shape == "disc":
            return np.asarray(np.linalg.norm(flat, axis=-1) <= half[0])
        return np.asarray((np.abs(flat) <= half).all(axis=-1))


class Outlook(NamedTuple):
    """What has to be known to say where an object may be put beside another."""

    own: Seen
    landmark: Seen
    others: Mapping[str, Array]
    """Corners of everything else that stands up from the surface, seen from above [m], shape (n, 2) each."""
    surface: Surface


class Spots(NamedTuple):
    """Where the centre of the object may get to, seen from above [m], shape (2,) each."""

    free: list[Array]
    """Best first."""
    best: Array
    """Where it would go if nothing were in the way."""
    met: list[str]
    """What is in the way elsewhere, the most frequent first."""


def carrier_of(scene: Scene, name: str) -> str:
    """What an object stands on, or the ground, as far as the tree of a scene tells.

    Raises:
        TaskError: it stands on no surface on which something could be put beside it.
    """
    carriers = scene.carriers(name)
    kinds = {rel.kind for rel in scene.relations if rel.child == name and rel.supports}
    if len(carriers) > 1 or kinds - {"on"}:
        carried = ", ".join(f'"{one}"' for one in carriers)
        raise TaskError(f'"{name}" does not stand on a surface but in, from or across {carried}.')
    carrier = scene.parent(name)
    if carrier != GROUND and scene[carrier].asset.region("on") is None:
        raise TaskError(f'"{carrier}", on which "{name}" stands, has no top on which there is room.')
    return carrier


def at_rest(scene: Scene, target: str, landmark: str) -> Outlook:
    """The scene as it was loaded, on a workbench that is to be made as large as it takes.

    Raises:
        TaskError: as `carrier_of`, and where the landmark floats.
    """
    if carrier_of(scene, landmark) == GROUND and abs(float(points_of(scene, landmark)[:, 2].min())) > CONTACT_DEPTH:
        raise TaskError(f'"{landmark}" does not stand on the ground, and nothing carries it.')
    bench, its = bench_at_rest(scene, target), points_of(scene, target)[:, :2]
    if bench is not None:
        wide = float(np.ptp(its, axis=0).max()) + GAPS[-1]
        bench = tuple(np.array(bench[0]) - wide), tuple(np.array(bench[1]) + wide)
    return _outlook(
        scene,
        (target, landmark),
        points=lambda name: points_of(scene, name),
        centre=lambda name: centre_of_mass(scene, name),
        frame=lambda name: (scene[name].pose.rotation, np.array(scene[name].pose.position)),
        bench=bench,
    )


def alone(scene: Scene, target: str, landmark: str) -> Outlook:
    """The two as they are at rest, on a surface without end on which nothing else stands."""
    own, its = (Seen.of(points_of(scene, name), centre_of_mass(scene, name)) for name in (target, landmark))
    return Outlook(own=own, landmark=its, others={}, surface=Surface(height=float(its.box.low[2])))


def at_present(state: SimState, target: str, landmark: str, tree: Scene) -> Outlook:
    """A world as it is now, in which things stand on one another as the scene `tree` says; raises as `carrier_of`."""
    return _outlook(
        tree,
        (target, landmark),
        points=state.points,
        centre=state.centre,
        frame=lambda name: (state.rotation(name), state.position(name)),
        bench=state.world.placement.bench,
    )


def _outlook(
    scene: Scene,
    pair: tuple[str, str],
    *,
    points: Callable[[str], Array],
    centre: Callable[[str], Array],
    frame: Callable[[str], tuple[Array, Array]],
    bench: tuple[tuple[float, float], tuple[float, float]] | None,
) -> Outlook:
    target, landmark = pair
    carrier = carrier_of(scene, landmark)
    its = points(landmark)
    height = float(its[:, 2].min())
    if carrier == GROUND:
        surface = Surface(height=height, bench=bench)
    else:
        rotation, position = frame(carrier)
        region = scene[carrier].asset.region("on")
        surface = Surface(height=height, region=region, rotation=rotation, position=position)
    under = {obj.name for obj in scene.objects if obj.name == carrier or _carries(scene, obj.name, carrier)}
    around = {obj.name: points(obj.name) for obj in scene.objects if obj.name not in {*pair, *under}}
    return Outlook(
        own=Seen.of(points(target), centre(target)),
        landmark=Seen.of(its, centre(landmark)),
        others={name: corners[:, :2] for name, corners in around.items() if corners[:, 2].max() > height + 1e-3},
        surface=surface,
    )


def _carries(scene: Scene, name: str, carrier: str) -> bool:
    return carrier != GROUND and rests_upon(scene, carrier, name)


def spots(relation: str, view: Outlook) -> Spots:
    """Where the object may be put, turned as it is, so that the relation holds with a margin and nothing is met."""
    own, landmark = view.own, view.landmark
    shifts, worse = _shifts(relation, view)
    holds = np.asarray(view.surface.holds(own.footprint + shifts[:, None]).all(axis=1))
    names = list(view.others)
    gaps = _gaps(own.footprint, list(view.others.values()), shifts)
    nearest = gaps.min(axis=0, initial=np.inf)
    cost = worse + CROWDED * np.maximum(FREE_GAP - nearest, 0.0)
    free: list[Array] = []
    for number in np.argsort(cost, kind="stable").tolist():
        if holds[number] and nearest[number] >= GAP and _safely(relation, own.shifted(shifts[number]), landmark):
            free.append(own.centre + shifts[number])
            if len(free) == SPOTS:
                break
    met = Counter(name for name, near in zip(names, gaps, strict=True) for one in near[holds].tolist() if one < GAP)
    return Spots(free, own.centre + shifts[int(np.argmin(worse))], [name for name, _ in met.most_common()])


def _shifts(relation: str, view: Outlook) -> tuple[Array, Array]:
    """By which the object may be moved [m], shape (n, 2), and how much worse than straight beside it each is [m]."""
    own, its = view.own.box, view.landmark.box
    found, worse = [], []
    for axis, sign in SIDES.values() if relation == "next_to" else [SIDES[relation]]:
        across = 1 - axis
        half = ((own.high - own.low + its.high - its.low) / 2)[across]
        aside = STEP * np.arange(-int(half / STEP), int(half / STEP) + 1)
        middle = ((its.low + its.high - own.low - own.high) / 2)[across]
        for gap in GAPS:
            shift = np.empty((len(aside), 2))
            shift[:, axis] = its.high[axis] - own.low[axis] + gap if sign > 0 else its.low[axis] - own.high[axis] - gap
            shift[:, across] = middle + aside
            found.append(shift)
            worse.append(np.abs(aside) + gap - GAPS[0])
    shifts = np.concatenate(found)
    # Which side of the other it is matters to nobody then, and the nearest is taken.
    way = 1.0 if relation == "next_to" else 0.2
    return shifts, np.concatenate(worse) + way * np.linalg.norm(shifts, axis=1)


def _gaps(own: Array, others: list[Array], shifts: Array) -> Array:
    """Between an outline moved by `shifts` and others [m], never larger than they are, shape (others, shifts)."""
    flat = DIRECTIONS[:, :2]
    ahead = (own @ flat.T).max(axis=0) + shifts @ flat.T
    rear = [(other @ flat.T).min(axis=0) for other in others]
    return np.array([(one - ahead).max(axis=1) for one in rear]).reshape(len(others), len(shifts))


def _safely(relation: str, own: Seen, landmark: Seen) -> bool:
    """Whether a relation holds, and would with a margin."""
    ways = np.array([[0.0, 0.0], [MARGIN, 0.0], [-MARGIN, 0.0], [0.0, MARGIN], [0.0, -MARGIN]])
    return all(related(relation, own.shifted(way), landmark) for way in ways)
