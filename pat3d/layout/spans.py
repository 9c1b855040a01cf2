"""What lies on several objects: a plank across two blocks, the upper cans of a pyramid.

In the tree it belongs to the last thing that all of its carriers stand on. There it is put down after them, its middle
over the middle between them, its length from the first to the last. What lies across one thing (a spoon across a bowl)
rests on two opposite parts of its rim, its centre of mass between them, where its underside has no slope to slide on.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.polygons import outline
from pat3d.geometry.rotations import about, yaw_matrix
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.containers import listed, lower
from pat3d.layout.group import Group
from pat3d.layout.heightmap import bottom_map
from pat3d.scene.relations import GROUND, Relation, carriers_of

_RIM = 2e-3
"""What is this near to the highest point [m] belongs to the rim."""
_LONG = 1.15
"""What is this many times longer than wide lies along its carriers."""
STEEPEST = math.radians(6.0)
"""Angle of friction that may be needed to lie across something; scenes settle with 11.3 degrees."""
_WALL = 2e-3
"""A rim carries this far inside its outer edge [m]."""
_BEYOND = 5e-3
"""What lies across something reaches beyond its rim by this at least [m]."""
_BETWEEN = 0.08
"""Distance of a centre of mass from the supports on its sides, at least, over that of these."""
_CENTRED = 0.3
"""A centre of mass that is away from the middle by a share of the span counts this many times that share [rad]."""
_SAMPLES = 240
"""Of an underside, along its length."""


@dataclass(frozen=True, kw_only=True)
class Crossing:
    """How something lies across one carrier."""

    rotation: Array
    """How it is turned, shape (3, 3)."""
    position: Array
    """Where its origin is then [m], shape (2,)."""
    cost: float
    """Angle of friction that holds it, and how far its centre of mass is from the middle [rad]."""


def homes(names: Sequence[str], relations: tuple[Relation, ...]) -> tuple[dict[str, str], dict[str, tuple[str, ...]]]:
    """On what every object is put down, and what has several carriers, those below first, with these carriers."""
    carriers = {name: carriers_of(name, relations) for name in names}
    parents: dict[str, str] = {}
    spans: dict[str, tuple[str, ...]] = {}

    def path(name: str) -> list[str]:
        found = [name]
        while found[-1] != GROUND:
            found.append(home(found[-1]))
        return found

    def home(name: str) -> str:
        if name not in parents:
            own = carriers[name]
            if len(own) == 1:
                parents[name] = own[0]
            else:
                paths = [path(one)[1:] for one in own]
                parents[name] = next(one for one in paths[0] if all(one in other for other in paths))
                spans[name] = own
        return parents[name]

    for name in names:
        home(name)
    return {name: parents[name] for name in names}, spans


def overhang(body: Placed, carrier: Placed) -> float:
    """By how much `body` reaches beyond the rim of `carrier`, along its own length, at its shorter end [m]."""
    corners = outline(body.vertices[:, :2])
    ways = (corners[:, None] - corners[None]).reshape(-1, 2)
    way = max(ways, key=lambda one: float(one @ one))
    way = way / np.linalg.norm(way)
    along = body.vertices[:, :2] @ way
    rim = carrier.vertices[carrier.vertices[:, 2] > carrier.high[2] - _RIM, :2] @ way
    return float(min(rim.min() - along.min(), along.max() - rim.max()))


def crossing(body: Placed, carrier: Placed) -> Crossing | None:
    """The best way for `body` to lie across `carrier`, along x or y; None where it is too short or would slide.

    Args:
        body: with its origin at zero, turned as its posture asks for.
        carrier: what has the rim.
    """
    rim = carrier.vertices[carrier.vertices[:, 2] > carrier.high[2] - _RIM, :2]
    size = body.high - body.low
    lengthwise = yaw_matrix(-math.pi / 2) if size[1] > size[0] else np.eye(3)
    along = body.turned(lengthwise, np.zeros(3))
    low, high = rim.min(axis=0), rim.max(axis=0)
    best: Crossing | None = None
    for axis in (0, 1):
        found = _resting(along, float((high - low)[axis]) - 2.0 * _WALL)
        if found is not None and (best is None or found[0] < best.cost):
            cost, level, point = found
            rotation = yaw_matrix(axis * math.pi / 2) @ level
            position = (low + high) / 2 - (rotation @ point)[:2]
            best = Crossing(rotation=rotation @ lengthwise, position=position, cost=cost)
    return best


def _resting(body: Placed, span: float) -> tuple[float, Array, Array] | None:
    """How `body`, its length along x, rests on two supports at a distance of `span` [m].

    Returns:
        What it costs (see Crossing), the rotation that brings it about, shape (3, 3), and which of its points is in the
        middle between the supports [m], shape (3,).
    """
    low, high = float(body.low[0]), float(body.high[0])
    cell = (high - low) / _SAMPLES
    rows = max(1, math.ceil(float(np.ptp(body.vertices[:, 1])) / cell))
    # The lowest point of every section.
    under = bottom_map([body], np.array([low, body.low[1]]) + cell / 2, cell, (_SAMPLES, rows), cell / 2).min(axis=1)
    x = low + cell * (np.arange(_SAMPLES) + 0.5)
    apart = round(span / cell)
    edge = math.ceil(_BEYOND / cell)
    if apart < 1 or apart + 2 * edge >= _SAMPLES:
        return None
    near = max(1, math.ceil(_WALL / cell))
    first = np.arange(max(edge, near), _SAMPLES - apart - max(edge, near))
    last = first + apart
    pitch = np.arctan2(under[last] - under[first], span)
    share = (float(body.centre_of_mass[0]) - x[first]) / span
    # Slopes on both sides of a support: the force there may have any direction between their normals, and friction adds
    # its angle. The two forces balance where their sideways parts can cancel.
    sides = [
        np.arctan((under[at + ahead] - under[at + behind]) / (near * cell)) - pitch
        for at in (first, last)
        for behind, ahead in ((-near, 0), (0, near))
    ]
    least = (1.0 - share) * np.minimum(*sides[:2]) + share * np.minimum(*sides[2:])
    most = (1.0 - share) * np.maximum(*sides[:2]) + share * np.maximum(*sides[2:])
    slope = np.maximum(0.0, np.maximum(least, -most))
    possible = (slope < STEEPEST) & (np.abs(share - 0.5) < 0.5 - _BETWEEN)
    cost = np.where(possible, slope + _CENTRED * np.abs(share - 0.5), np.inf)
    best = int(np.argmin(cost))
    if not math.isfinite(cost[best]):
        return None
    level = about("y", float(pitch[best]))
    ends = [np.array([x[at[best]], (body.low[1] + body.high[1]) / 2, under[at[best]]]) for at in (first, last)]
    return float(cost[best]), level, (ends[0] + ends[1]) / 2


def put_across(group: Group, carriers: Sequence[str], placed: Sequence[Group], *, gap: float) -> Group:
    """`group`, whose root's origin is at zero, lowered onto `carriers`, which are among `placed`.

    Raises:
        LayoutError: something is in the way.
    """
    bodies: Mapping = {member.body.name: member for other in placed for member in other.members}
    middles = np.stack([(bodies[name].low + bodies[name].high) / 2 for name in carriers])[:, :2]
    size = group.root.high - group.root.low
    found = crossing(group.root, bodies[carriers[0]]) if len(carriers) == 1 else None
    if len(carriers) == 1 and found is None:
        wide, deep = (bodies[carriers[0]].high - bodies[carriers[0]].low)[:2]
        stays = "does not reach" if max(size[:2]) < min(wide, deep) else "does not stay"
        raise LayoutError(
            f'"{group.name}" ({max(size[:2]):.2f} m long) {stays} across "{carriers[0]}" ({wide:.2f} x {deep:.2f} m). '
            "Something longer or straighter, or a smaller carrier, would. Nothing was written."
        )
    if len(carriers) == 2 and max(size[:2]) > _LONG * min(size[:2]):
        along = middles[1] - middles[0]
        yaw = math.atan2(along[1], along[0]) - (0.0 if size[0] > size[1] else math.pi / 2)
        group = group.turned(yaw_matrix(yaw))
    if found is not None:
        group, position = group.turned(found.rotation), found.position
    else:
        position = middles.mean(axis=0) - ((group.root.low + group.root.high) / 2)[:2]
    top = max(float(bodies[name].high[2]) for name in carriers)
    spot = np.array([*position, top - float(group.low[2]) + gap])
    floor = min(float(body.low[2]) for body in bodies.values())
    resting = lower(group, spot, list(bodies.values()), floor=floor, gap=gap)
    if resting is None:
        raise LayoutError(f'"{group.name}" finds no room across {listed(carriers)}. Nothing was written.')
    return resting
