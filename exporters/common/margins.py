"""What MuJoCo needs to know of the contacts of a scene: their margins, and which boxes it cannot take as boxes."""

from __future__ import annotations

import numpy as np

from pat3d.errors import ExportError
from pat3d.geometry.contacts import GROUND_INDEX, Contacts
from pat3d.geometry.pose import Pose
from pat3d.scene.model import Scene

_SAME_SPOT = 5e-4
"""Contacts of one pair closer together than this [m] are one support."""

_FLUSH = 2e-6
"""Sides of two boxes closer to one plane than this [m] confuse the box-box collider."""


def needed_margins(contacts: Contacts) -> dict[tuple[int, int], float]:
    """Contact margin that each pair of touching bodies needs to exceed its gap [m].

    A fifth more than the gap, and at least a micrometre a pair, keeps the contact from flickering.
    """
    needed: dict[tuple[int, int], float] = {}
    for pair in np.unique(contacts.bodies, axis=0).tolist():
        members = np.flatnonzero((contacts.bodies == pair).all(axis=1))
        points, gaps = contacts.points[members], contacts.gaps[members]
        # Just outside a rim the nearest surface is further than the one that carries; only the nearest counts.
        beside = np.linalg.norm(points[:, None] - points[None], axis=2) < _SAME_SPOT
        carrying = gaps <= np.where(beside, gaps[None], np.inf).min(axis=1) + 1e-9
        needed[pair[0], pair[1]] = max(1.2 * float(gaps[carrying].max()), 1e-6)
    return needed


def largest_margins(scene: Scene, contacts: Contacts) -> list[float]:
    """Contact margin of every object [m] for an engine that takes the larger of a pair's: the most its pairs need."""
    margins = [0.0] * len(scene.objects)
    for pair, margin in needed_margins(contacts).items():
        for body in pair:
            if body != GROUND_INDEX:
                margins[body] = max(margins[body], margin)
    return margins


def contact_margins(scene: Scene, contacts: Contacts) -> list[float]:
    """Contact margin of every object [m]: the least that makes each pair's sum exceed its gap.

    The ground has none of its own.
    """
    needed = needed_margins(contacts)
    if not needed:
        return [0.0] * len(scene.objects)
    from scipy.optimize import linprog
    from scipy.sparse import lil_matrix

    rows = lil_matrix((len(needed), len(scene.objects)))
    for row, pair in enumerate(needed):
        for body in pair:
            if body != GROUND_INDEX:
                rows[row, body] = -1.0
    # In units of the largest margin: the solver's tolerances are absolute.
    unit = max(needed.values())
    result = linprog(np.ones(len(scene.objects)), A_ub=rows.tocsr(), b_ub=-np.array(list(needed.values())) / unit)
    if result.x is None:
        raise ExportError(f"no contact margins found for gaps up to {unit:.3g} m ({result.message}).")
    return (np.clip(result.x, 0.0, 1.0) * unit).tolist()


def flush_boxes(scene: Scene, contacts: Contacts) -> set[int]:
    """Identities of the assets with a box that touches another box whose sides lie in the same plane as its own."""
    found: set[int] = set()
    pairs = np.unique(np.concatenate([contacts.bodies, contacts.parts], axis=1), axis=0).tolist()
    for first, second, p, q in pairs:
        if second == GROUND_INDEX:
            continue
        one, other = scene.objects[first], scene.objects[second]
        part, counterpart = one.asset.parts[p], other.asset.parts[q]
        if part.box is None or counterpart.box is None:
            continue
        a, b = one.pose.apply(part.vertices), other.pose.apply(counterpart.vertices)
        for axis in (one.pose.rotation @ Pose(quat_wxyz=part.box[2]).rotation).T:
            gaps = np.subtract.outer((np.min(a @ axis), np.max(a @ axis)), (np.min(b @ axis), np.max(b @ axis)))
            if np.abs(np.diag(gaps)).min() < _FLUSH:
                found |= {id(one.asset), id(other.asset)}
    return found
