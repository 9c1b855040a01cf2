"""Intersections found by ipctk, which shares no code with the simulator."""

from __future__ import annotations

import ipctk
import numpy as np
from numpy.typing import NDArray

from pat3d.sim.model import Model
from pat3d.sim.settling import Settled


class IntersectionOracle:
    """Says which parts of different bodies intersect at a state, and which bodies reach the ground.

    Parts of one body may overlap, so every pair of parts whose boxes overlap is a collision mesh of its own.
    """

    def __init__(self, model: Model):
        self.body = model.vertex_body.numpy()
        self.rest = model.vertex_rest.numpy()
        self.owner = model.part_body.numpy()
        self.ranges = model.part_ranges.numpy()
        self.triangles = model.triangles.numpy()
        self.pairs = model.part_pairs.numpy()
        self.free = model.is_free
        self._meshes: dict[tuple[int, int], ipctk.CollisionMesh] = {}

    def positions(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        """Vertex positions [m] at state q, shape (bodies, 4, 3)."""
        return q[self.body, 0] + np.einsum("vj,vji->vi", self.rest, q[self.body, 1:])

    def pairs_at(self, q: NDArray[np.float64]) -> set[tuple[int, int]]:
        """Intersecting bodies at state q, shape (bodies, 4, 3); the second is -1 for the ground."""
        x = self.positions(q)
        starts = self.ranges[:, 0]
        low, high = np.minimum.reduceat(x, starts), np.maximum.reduceat(x, starts)
        a, b = self.pairs[:, 0], self.pairs[:, 1]
        close = np.all((low[a] <= high[b]) & (low[b] <= high[a]), axis=1)
        found = {
            (int(self.owner[i]), int(self.owner[j])) for i, j in self.pairs[close] if self._intersect(int(i), int(j), x)
        }
        return found | {(int(b), -1) for b in np.unique(self.body[(x[:, 2] <= 0) & self.free[self.body]])}

    def _intersect(self, i: int, j: int, x: NDArray[np.float64]) -> bool:
        first, second = slice(*self.ranges[i, :2]), slice(*self.ranges[j, :2])
        both = np.asfortranarray(np.vstack([x[first], x[second]]))
        if (i, j) not in self._meshes:
            count = first.stop - first.start
            faces = np.vstack([self._faces(i), self._faces(j) + count])
            self._meshes[i, j] = ipctk.CollisionMesh(both, ipctk.edges(faces), faces)
        if ipctk.has_intersections(self._meshes[i, j], both):
            return True
        return _inside(x[first][0], x[second], self._faces(j)) or _inside(x[second][0], x[first], self._faces(i))

    def _faces(self, part: int) -> NDArray[np.int32]:
        return self.triangles[slice(*self.ranges[part, 4:])] - self.ranges[part, 0]


def _inside(point: NDArray[np.float64], vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> bool:
    """Whether a closed surface, convex or not, winds around the point."""
    a, b, c = np.moveaxis(vertices[faces] - point, 1, 0)
    la, lb, lc = (np.linalg.norm(side, axis=1) for side in (a, b, c))
    determinant = np.einsum("fi,fi->f", a, np.cross(b, c))
    ab, bc, ca = (np.einsum("fi,fi->f", *pair) for pair in ((a, b), (b, c), (c, a)))
    angle = 2 * np.arctan2(determinant, la * lb * lc + ab * lc + bc * la + ca * lb)
    return bool(abs(angle.sum()) > 2 * np.pi)


def intersections(model: Model, settled: Settled) -> dict[int, set[tuple[int, int]]]:
    """Frames of a settling run (the last is the state at rest) in which bodies intersect, and which."""
    oracle = IntersectionOracle(model)
    frames = [*settled.trajectory.astype(np.float64), settled.q]
    return {i: pairs for i, q in enumerate(frames) if (pairs := oracle.pairs_at(q))}
