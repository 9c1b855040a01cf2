"""Assets at poses, ready for distance queries between their convex parts.

`Body` holds what does not move (vertices and faces of the parts), `Placed` a body at a pose. Part
distances come from `part_distance` alone; everything else in this folder is built on it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import fcl
import numpy as np
from numpy.typing import NDArray

from pat3d.geometry.normals import unit_normals
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Asset

Array = NDArray[np.float64]


class Body:
    """An asset's convex parts, flattened into arrays, with the collision shapes built once."""

    def __init__(self, name: str, asset: Asset) -> None:
        self.name = name
        self.asset = asset
        self.vertices: Array = np.concatenate([part.vertices for part in asset.parts])
        """Vertices of all parts [m], shape (vertices, 3), asset frame."""
        counts = [len(part.vertices) for part in asset.parts]
        self.starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        """First vertex of every part, shape (parts,)."""
        self.part_corners = [
            slice(int(first), int(first) + count) for first, count in zip(self.starts, counts, strict=True)
        ]
        """Vertices of every part in `vertices`."""
        corners = np.concatenate([part.vertices[part.faces] for part in asset.parts])
        self.normals: Array = unit_normals(corners)
        """Outward unit normals of all faces, shape (faces, 3), asset frame."""
        self.offsets: Array = np.einsum("fi,fi->f", self.normals, corners[:, 0])
        """Face planes are normal . x = offset [m], shape (faces,)."""
        ends = np.cumsum([len(part.faces) for part in asset.parts])
        self.part_faces = [
            slice(int(end) - len(part.faces), int(end)) for part, end in zip(asset.parts, ends, strict=True)
        ]
        """Faces of every part in `normals`."""
        self.centre_of_mass: Array = np.array(asset.mass_properties.centre_of_mass)
        self.shapes = [
            fcl.Convex(
                np.ascontiguousarray(part.vertices),
                len(part.faces),
                np.column_stack([np.full(len(part.faces), 3), part.faces]).ravel().astype(int),
            )
            for part in asset.parts
        ]

    def at(self, rotation: Array, position: Array) -> Placed:
        """The body with rotation matrix `rotation`, shape (3, 3), and `position` [m], shape (3,)."""
        return Placed(self, rotation, position)


class Placed:
    """A body at a pose; world-frame arrays are computed once, translation is cheap."""

    def __init__(self, body: Body, rotation: Array, position: Array, turned: Array | None = None) -> None:
        self.body = body
        self.rotation = np.asarray(rotation, dtype=np.float64)
        self.position = np.asarray(position, dtype=np.float64)
        self._turned = body.vertices @ self.rotation.T if turned is None else turned
        self.vertices: Array = self._turned + self.position
        """Part vertices [m], shape (vertices, 3), world frame."""
        self._objects: dict[int, Any] = {}

    @cached_property
    def part_low(self) -> Array:
        """Lower corners of the parts' bounding boxes [m], shape (parts, 3)."""
        return np.minimum.reduceat(self.vertices, self.body.starts, axis=0)

    @cached_property
    def part_high(self) -> Array:
        """Upper corners of the parts' bounding boxes [m], shape (parts, 3)."""
        return np.maximum.reduceat(self.vertices, self.body.starts, axis=0)

    @cached_property
    def low(self) -> Array:
        """Lower corner of the bounding box [m], shape (3,)."""
        return self.vertices.min(axis=0)

    @cached_property
    def high(self) -> Array:
        """Upper corner of the bounding box [m], shape (3,)."""
        return self.vertices.max(axis=0)

    def part_vertices(self, index: int) -> Array:
        """Vertices of part `index` [m], shape (n, 3), world frame."""
        return self.vertices[self.body.part_corners[index]]

    @property
    def centre_of_mass(self) -> Array:
        """Centre of mass [m], shape (3,), world frame."""
        return self.rotation @ self.body.centre_of_mass + self.position

    def shifted(self, offset: Array) -> Placed:
        """The same orientation, moved by `offset` [m], shape (3,)."""
        return Placed(self.body, self.rotation, self.position + offset, self._turned)

    def turned(self, rotation: Array, position: Array) -> Placed:
        """This placement mapped by x -> rotation x + position."""
        return Placed(self.body, rotation @ self.rotation, rotation @ self.position + position)

    def part(self, index: int) -> Any:
        """The collision object of part `index`."""
        found = self._objects.get(index)
        if found is None:
            found = fcl.CollisionObject(self.body.shapes[index], fcl.Transform(self.rotation, self.position))
            self._objects[index] = found
        return found

    @property
    def pose(self) -> Pose:
        """The placement as a Pose."""
        return Pose.from_matrix(self.rotation, self.position)


@dataclass(frozen=True)
class Witness:
    """The closest points of two bodies."""

    distance: float
    """[m]; zero or negative where they intersect."""
    first: Array
    """Point on the first body [m], shape (3,); meaningless where they intersect."""
    second: Array
    """Point on the second body [m], shape (3,)."""


def place(name: str, asset: Asset, pose: Pose) -> Placed:
    """`asset` at `pose`."""
    return Body(name, asset).at(pose.rotation, np.array(pose.position))


def place_all(assets: Mapping[str, Asset], poses: Mapping[str, Pose]) -> dict[str, Placed]:
    """Every posed asset, with collision shapes shared between equal assets' names."""
    return {name: place(name, assets[name], poses[name]) for name in poses}


def part_distance(first: Any, second: Any) -> Witness:
    """Distance and closest points of two convex collision objects."""
    result = fcl.DistanceResult()
    distance = fcl.distance(first, second, fcl.DistanceRequest(True), result)
    if distance <= 0.0:
        return Witness(float(distance), np.zeros(3), np.zeros(3))
    a, b = result.nearest_points
    return Witness(float(distance), np.asarray(a), np.asarray(b))


def box_gap(low_a: Array, high_a: Array, low_b: Array, high_b: Array) -> Array:
    """Euclidean distance [m] between axis-aligned boxes; arrays of shape (..., 3) broadcast."""
    apart = np.maximum(0.0, np.maximum(low_a - high_b, low_b - high_a))
    return np.sqrt(np.sum(apart * apart, axis=-1))


def distance(first: Placed, second: Placed, cutoff: float = np.inf) -> Witness | None:
    """The closest pair of convex parts of two bodies, or None where all are `cutoff` [m] or more apart."""
    if float(box_gap(first.low, first.high, second.low, second.high)) >= cutoff:
        return None
    bound = box_gap(
        first.part_low[:, None], first.part_high[:, None], second.part_low[None], second.part_high[None]
    ).ravel()
    best: Witness | None = None
    limit = cutoff
    columns = len(second.body.shapes)
    near = np.flatnonzero(bound < limit)
    for pair in near[np.argsort(bound[near], kind="stable")]:
        if bound[pair] >= limit:
            break
        i, j = divmod(int(pair), columns)
        found = part_distance(first.part(i), second.part(j))
        if found.distance < limit:
            best, limit = found, found.distance
            if limit <= 0.0:
                break
    return best
