"""Intersection test that ends every layout: no two objects intersect and nothing is under the ground."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import Placed, box_gap, distance, place_all
from pat3d.scene.asset import Asset
from pat3d.scene.model import GROUND


@dataclass(frozen=True, kw_only=True)
class PairDistance:
    """Two objects that are near each other."""

    first: str
    second: str
    distance: float
    """Smallest distance between their convex parts [m]; zero or negative where they intersect."""


@dataclass(frozen=True, kw_only=True)
class Clearance:
    """What lies near what, and near the ground."""

    pairs: tuple[PairDistance, ...]
    """Pairs nearer than the cutoff, nearest first."""
    lowest: float
    """Height of the lowest vertex above the ground [m]."""

    @property
    def min_distance(self) -> float:
        """Smallest distance between two objects [m]; infinite where none are near each other."""
        return self.pairs[0].distance if self.pairs else float("inf")


def pair_distances(
    assets: Mapping[str, Asset], poses: Mapping[str, Pose], *, cutoff: float = 0.05
) -> tuple[PairDistance, ...]:
    """Distances of all pairs of objects nearer than `cutoff` [m], nearest first."""
    return measure(list(place_all(assets, poses).values()), cutoff=cutoff)


def measure(bodies: list[Placed], *, cutoff: float = 0.05) -> tuple[PairDistance, ...]:
    """`pair_distances` of bodies already placed."""
    found = []
    for i, j in near_pairs(bodies, cutoff):
        closest = distance(bodies[i], bodies[j], cutoff)
        if closest is not None:
            found.append(PairDistance(first=bodies[i].body.name, second=bodies[j].body.name, distance=closest.distance))
    return tuple(sorted(found, key=lambda pair: pair.distance))


def near_pairs(bodies: list[Placed], cutoff: float) -> Iterator[tuple[int, int]]:
    """Indices of the bodies whose bounding boxes are nearer than `cutoff` [m]."""
    if not bodies:
        return
    low, high = np.stack([body.low for body in bodies]), np.stack([body.high for body in bodies])
    gaps = box_gap(low[:, None], high[:, None], low[None], high[None])
    for i, j in np.argwhere(np.triu(gaps < cutoff, k=1)):
        yield int(i), int(j)


def require_clearance(bodies: list[Placed], *, cutoff: float = 0.05) -> Clearance:
    """Check that `bodies` neither intersect nor reach under the ground.

    Raises:
        LayoutError: two bodies intersect or touch, or one is under the ground.
    """
    for body in bodies:
        if body.low[2] < -1e-9:
            raise LayoutError(
                f'"{body.body.name}" reaches {-body.low[2] * 1e3:.1f} mm under the {GROUND}. Nothing was written.'
            )
    pairs = measure(bodies, cutoff=cutoff)
    if pairs and pairs[0].distance <= 0.0:
        raise LayoutError(f'"{pairs[0].first}" and "{pairs[0].second}" intersect in the layout. Nothing was written.')
    return Clearance(pairs=pairs, lowest=float(min((body.low[2] for body in bodies), default=0.0)))
