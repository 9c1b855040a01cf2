"""From fits, which touch and sink into one another by their errors, to poses where nothing does.

Breadth first over the scene tree: what carries comes before what it carries. Every object keeps its orientation, is
moved sideways as little as sets it free of its neighbours and over its support, and comes down from above until it is a
gap away from what carries it. The simulator does the rest.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.polygons import contains, outline
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import Array, Placed
from pat3d.layout.drop import clear, fall
from pat3d.scene.model import GROUND, Relation, parent_of

GAP = 0.001
"""Between an object and what will carry it [m]."""
STEPS, WAYS = 40, 16
"""Distances and directions in which a place is looked for."""
FARTHEST = 0.75
"""How far an object may be moved, over its own larger horizontal side."""


def from_the_ground(names: Sequence[str], relations: tuple[Relation, ...]) -> list[str]:
    """`names`, every parent before its children."""
    order: list[str] = []
    waiting = list(names)
    while waiting:
        ready = [name for name in waiting if parent_of(name, relations) in (GROUND, *order)]
        order += ready
        waiting = [name for name in waiting if name not in ready]
    return order


def placed_apart(bodies: Mapping[str, Placed], relations: tuple[Relation, ...]) -> tuple[dict[str, Pose], list[str]]:
    """Poses of `bodies` at which nothing touches, each just above what carries it.

    Args:
        bodies: at their fitted poses, z up, the ground at 0.
        relations: the scene tree.

    Returns:
        Poses by name, and notes of what was moved by more than a centimetre.

    Raises:
        LayoutError: there is no room for an object near where it was seen.
    """
    done: dict[str, Placed] = {}
    notes: list[str] = []
    # Of what stands side by side, the lower ones first, and those in whose way nothing is.
    for name in from_the_ground(list(bodies), relations):
        body, parent = bodies[name], parent_of(name, relations)
        inside = any(rel.child == name and rel.kind == "in" for rel in relations)
        found = _set_down(body, done, parent, inside=inside)
        if found is None:
            raise LayoutError(
                f'"{name}" finds no room on "{parent}" near where the picture shows it; is its mask, or that of '
                "what is beside it, another object's?"
            )
        moved = float(np.linalg.norm((found.position - body.position)[:2]))
        if moved > 0.01:
            notes.append(f'"{name}" was moved by {1000 * moved:.0f} mm, off what it would have intersected.')
        done[name] = found
    return {name: done[name].pose for name in bodies}, notes


def _set_down(body: Placed, done: Mapping[str, Placed], parent: str, *, inside: bool) -> Placed | None:
    """`body` at the nearest free place, a gap above what carries it there; None where there is none."""
    others = list(done.values())
    carrier = done.get(parent)
    outlined = None if carrier is None or inside else outline(carrier.vertices[:, :2])
    top = max([float(body.high[2]), *(float(other.high[2]) for other in others)]) + 2.0 * GAP
    for offset in _offsets(float((body.high - body.low)[:2].max())):
        moved = body.shifted(np.array([*offset, 0.0]))
        if outlined is not None and not contains(outlined, moved.centre_of_mass[:2]):
            continue
        raised = moved.shifted(np.array([0.0, 0.0, top - float(moved.low[2])]))
        # Among all others, what comes down has to end on what carries it, not on what stands beside that.
        below = [carrier] if carrier is not None and not inside else []
        if inside:
            below = others
        down = fall(raised, below, floor=0.0, gap=GAP)
        lowered = raised.shifted(np.array([0.0, 0.0, -down]))
        if clear(lowered, others, 0.9 * GAP) and lowered.low[2] > 0.0:
            return lowered
    return None


def _offsets(side: float) -> list[Array]:
    """Horizontal offsets [m], the shortest first."""
    angles = np.arange(WAYS) * 2.0 * math.pi / WAYS
    ways = np.column_stack([np.cos(angles), np.sin(angles)])
    reach = max(FARTHEST * side, 0.02)
    distances = reach * (np.arange(1, STEPS + 1) / STEPS) ** 1.5
    return [np.zeros(2), *(distance * way for distance in distances for way in ways)]
