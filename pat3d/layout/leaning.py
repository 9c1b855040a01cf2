"""What stands against or below another thing of the same surface: leaning on it, or under its overhang.

What leans is stood on end, its thinnest side to what it leans on, and tilted; an umbrella, which has no such side, with
its centre of mass straight before its foot. A ladder on floor and wall of friction mu stands up to a tilt of
atan(2 mu / (1 - mu^2)), 22 degrees at the friction that scenes settle with; it falls back where its centre of mass is
not beyond its lower edge, which thick things only have at a large tilt.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.rotations import turn
from pat3d.layout.bodies import Array, Body, Placed, Witness, distance
from pat3d.layout.containers import listed
from pat3d.layout.drop import clear
from pat3d.layout.flat import natural_gap
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map
from pat3d.layout.shelved import BOUND, STOOD

LEAST_TILT, LARGEST_TILT = math.radians(9.0), math.radians(20.0)
BEYOND = math.radians(6.0)
"""Tilt [rad] beyond the one at which the centre of mass is over the lower edge."""
SLIGHTLY = math.radians(3.0)
"""The same for a book: one that leans further topples the book that it leans on."""
AIR = 0.005
"""Room [m] above what is under something."""
SLENDER = 0.2
"""Width over length of what has no flat side to lean with."""
_FOOT = 2e-3
"""What is this near to the lowest point [m] stands on the floor."""
HELD = 1.2
"""Height of the support of what leans, over that of its centre of mass, which is enough: lower, and the foot slides."""
LOWEST = 0.5
"""Height of what something leans against, over that of its centre of mass, below which it slides in any case: leaning
by 9 degrees it needs a friction of 0.32 then."""
_ASIDE = (0.0, -0.85, 0.85, -0.6, 0.6, -0.3, 0.3)
"""Where something leans, as shares of the half width of what it leans on."""
_ELBOW = 0.02
"""Least distance of things that lean on one thing [m]."""
_HIGHER = 0.01
"""What is higher by this [m] is worth leaving the middle for."""
_TRIED = 15
"""Places across what something is put under."""
_UP = np.array([0.0, 0.0, 1.0])


def leaning_rotation(body: Body, way: Array) -> Array:
    """The rotation matrix, shape (3, 3), with which `body` stands on end and leans towards `way`, shape (3,).

    Raises:
        LayoutError: it is too thick to lean.
    """
    low, high = body.vertices.min(axis=0), body.vertices.max(axis=0)
    size = high - low
    long = 2 if size[2] > 0.999 * size.max() else int(np.argmax(size))
    thin = min((k for k in range(3) if k != long), key=lambda k: float(size[k]))
    # The front (-y), or the top of what lies flat, is turned away from what it leans on.
    sign = 1.0 if thin == 1 else -1.0
    axes = np.zeros((3, 3))
    axes[:, long], axes[:, thin] = _UP, sign * way
    rest = 3 - long - thin
    axes[:, rest] = np.cross(axes[:, (rest + 1) % 3], axes[:, (rest + 2) % 3])
    over = math.atan2(float(size[thin]), float(size[long]))
    tilt = max(LEAST_TILT, over + BEYOND)
    if body.asset.noun in BOUND and abs(way[0]) > abs(way[1]):
        axes, tilt = STOOD, over + SLIGHTLY
    if tilt > LARGEST_TILT:
        raise LayoutError(
            f'"{body.name}" ({size[long]:.2f} m long, {size[thin]:.2f} m thick) is too thick to lean against anything: '
            "it would stand by itself or slide. Nothing was written."
        )
    if max(size[thin], size[rest]) < SLENDER * size[long]:
        axes, already = _rolled(body, axes, way)
        tilt -= already
    return turn(np.cross(_UP, way), tilt) @ axes


def _rolled(body: Body, axes: Array, way: Array) -> tuple[Array, float]:
    """`axes`, shape (3, 3), turned about the vertical so that the centre of mass is straight before the foot.

    So nothing rolls it along what it leans on. Also by how much the line from the foot to the centre of mass is tilted
    then [rad].
    """
    standing = body.vertices @ axes.T
    low = float(standing[:, 2].min())
    foot = standing[standing[:, 2] < low + _FOOT, :2].mean(axis=0)
    centre = axes @ body.centre_of_mass
    beside = centre[:2] - foot
    roll = math.atan2(way[1], way[0]) - math.atan2(beside[1], beside[0])
    return turn(_UP, roll) @ axes, math.atan2(float(np.linalg.norm(beside)), float(centre[2]) - low)


def leaning_offsets(leaners: Mapping[str, tuple[Group, Array]], wall: Group, gap: float) -> dict[str, Array]:
    """`leaning_offset` of several, by name, each with its way to `wall`: beside each other, [m], shape (2,) each.

    Raises:
        LayoutError: one passes by, has no room beside the others, or would slide from under what is so low.
    """
    found: dict[str, Array] = {}
    standing: list[Placed] = []
    middle = (wall.root.low + wall.root.high) / 2
    for name, (group, way) in leaners.items():
        found[name] = leaning_offset(group, wall, way, gap, standing)
        own = (group.root.low + group.root.high) / 2
        high, weight = float(wall.high[2] - wall.low[2]), float(group.root.centre_of_mass[2] - group.low[2])
        if high < LOWEST * weight:
            raise LayoutError(
                f'"{wall.name}" ({high:.2f} m high) is too low for "{name}" to lean against: its centre of mass is '
                f"{weight:.2f} m up, and it would slide down. Nothing was written."
            )
        there = np.array([*(found[name] + middle[:2] - own[:2]), gap - float(group.low[2])])
        standing.extend(group.shifted(there).members)
    return found


def leaning_offset(group: Group, wall: Group, way: Array, gap: float, beside: Sequence[Placed] = ()) -> Array:
    """Where the middle of `group`, turned already, is from that of `wall` so that it nearly touches it [m], shape (2,).

    It leans on the middle, or where that is low (the seat of an armchair), on what is higher beside it (an arm); where
    something else leans already (`beside`), clear of that.

    Raises:
        LayoutError: it passes by.
    """
    low_wall = wall.shifted(np.array([0.0, 0.0, gap - float(wall.low[2])]))
    middle, half = (low_wall.root.low + low_wall.root.high) / 2, (low_wall.root.high - low_wall.root.low) / 2
    own = (group.root.low + group.root.high) / 2
    start = group.shifted(np.array([*(middle - own)[:2], gap - float(group.low[2])]))
    enough = gap + HELD * float(start.root.centre_of_mass[2] - gap)
    aside = np.cross(_UP, way)
    best: tuple[float, Array] | None = None
    for share in _ASIDE:
        met = _met(start.shifted(share * float(half @ np.abs(aside)) * aside), low_wall, way, gap)
        if met is not None and (best is None or met[0] > best[0] + _HIGHER):
            there = start.shifted(np.array([*(met[1] - middle)[:2], 0.0]))
            if all(clear(one, beside, _ELBOW) for one in there.members):
                best = met
        if best is not None and best[0] >= enough:
            break
    if best is None:
        taken = f" beside {listed([one.body.name for one in beside])}" if beside else ""
        raise LayoutError(f'"{group.name}" finds nothing of "{wall.name}" to lean against{taken}. Nothing was written.')
    return (best[1] - middle)[:2]


def _met(start: Group, wall: Group, way: Array, gap: float) -> tuple[float, Array] | None:
    """How high `start`, moved along `way`, meets `wall` [m], and where the middle of its root is then, shape (3,)."""
    back = (
        float((start.high - wall.low)[:2] @ np.abs(way[:2]))
        if way[:2].sum() > 0
        else float((wall.high - start.low)[:2] @ np.abs(way[:2]))
    )
    start = start.shifted(-way * (back + gap))
    furthest = 2.0 * (back + gap) + float(np.linalg.norm(wall.size[:2]))
    moved = 0.0
    while moved < furthest:
        here = start.shifted(way * moved)
        nearest = _nearest(here, wall)
        free = nearest.distance - gap
        if free < 2e-5:
            return float(nearest.first[2]), (here.root.low + here.root.high) / 2
        moved += free
    return None


def under_offsets(groups: Sequence[Group], cover: Group, gap: float) -> list[Array]:
    """Where the middle of each of `groups` is from that of `cover` so that all have room below it [m], shape (2,) each.

    Side by side along the longer way of the cover, or where that does not do, each as near to its middle as it can be.

    Raises:
        LayoutError: one has none.
    """
    over = cover.shifted(np.array([0.0, 0.0, gap - float(cover.low[2])]))
    middle, half = ((over.root.low + over.root.high) / 2)[:2], ((over.root.high - over.root.low) / 2)[:2]
    starts = [
        one.shifted(np.array([*(middle - ((one.root.low + one.root.high) / 2)[:2]), gap - float(one.low[2])]))
        for one in groups
    ]
    steps = np.stack(np.meshgrid(*[np.linspace(-0.8, 0.8, _TRIED)] * 2, indexing="ij"), axis=-1).reshape(-1, 2) * half
    most = 0
    for homes in (_abreast(groups, half), np.zeros((len(groups), 2))):
        found: list[Array] = []
        standing: list[Placed] = []
        for start, home in zip(starts, homes, strict=True):
            nearest = np.argsort(np.linalg.norm(steps - home, axis=1), kind="stable")
            for offset in (home, *steps[nearest]):
                here = start.shifted(np.array([*offset, 0.0]))
                free = all(clear(one, [*over.members, *standing], AIR) for one in here.members)
                if covered(here.root, over.root, AIR) and free:
                    found.append(offset)
                    standing.extend(here.members)
                    break
            else:
                break
        if len(found) == len(groups):
            return found
        most = max(most, len(found))
    last, before = groups[most], [one.name for one in groups[:most]]
    beside = f" beside {listed(before)}" if before else ""
    raise LayoutError(
        f'"{last.name}" ({last.size[0]:.2f} x {last.size[1]:.2f} x {last.size[2]:.2f} m) does not fit under '
        f'"{cover.name}"{beside}. Nothing was written.'
    )


def _abreast(groups: Sequence[Group], half: Array) -> Array:
    """Middles of `groups` in a line along the longer of `half` [m], shape (groups, 2), around the middle of both."""
    axis = int(half[1] > half[0])
    sizes = np.array([one.size[axis] for one in groups])
    free = max(2.0 * float(half[axis]) - float(sizes.sum()), 0.0) / (len(groups) + 1)
    gaps = [min(free, natural_gap(a.size[:2], b.size[:2])) for a, b in pairwise(groups)]
    along = np.cumsum([0.0, *(sizes[1:] + sizes[:-1]) / 2 + np.array(gaps)])
    return np.outer(along - (along[-1] + (sizes[-1] - sizes[0]) / 2) / 2, np.eye(2)[axis])


def covered(body: Placed, cover: Placed, air: float) -> bool:
    """Whether the underside of `cover` is over the centre of mass of `body`, and `air` [m] above its top."""
    above = float(bottom_map([cover], body.centre_of_mass[:2], 1.0, (1, 1), 0.0)[0, 0])
    return math.isfinite(above) and above >= float(body.high[2]) + air


def _nearest(group: Group, wall: Group) -> Witness:
    found = [distance(one, other) for one in group.members for other in wall.members]
    return min((one for one in found if one is not None), key=lambda one: one.distance)
