# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""Broad phase: candidate pairs of primitives that may come closer than d_hat along a motion.

Boxes enclose the motion of every vertex from its current to its trial position, inflated by half of d_hat plus a
skin; the candidates stay valid while every vertex remains within the skin of its box, so nearly converged iterations
reuse them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import warp as wp

from pat3d.sim.arrays import Bodies, Vertices, filled
from pat3d.sim.contact.boxes import Boxes, boxes_overlap
from pat3d.sim.contact.distance import EDGE_EDGE, POINT_GROUND, POINT_TRIANGLE
from pat3d.sim.contact.pairs import Pairs
from pat3d.sim.determinism import canonical, enabled
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)

CAPACITY = 256
"""Pairs of primitives that the buffers hold at first."""


@dataclass
class Candidates:
    """Pairs of primitives that may touch; grown as needed, never truncated."""

    model: Model
    pairs: Any = field(init=False)
    """`Pairs`, for kernels."""
    count: int = field(init=False, default=0)
    """`size` on the host."""

    def __post_init__(self) -> None:
        model, device = self.model, self.model.device
        self._boxes = boxes = Boxes(model)
        self._boxed = filled(
            Boxed,
            ranges=model.cluster_ranges,
            edges=model.edges,
            triangles=model.triangles,
            low=boxes.low,
            high=boxes.high,
            cluster_low=boxes.cluster_low,
            cluster_high=boxes.cluster_high,
        )
        self._size = wp.zeros(1, dtype=int, device=device)
        self._outside = wp.zeros(1, dtype=int, device=device)
        self._margin = wp.zeros(1, dtype=wp.float64, device=device)
        self.built = False
        """Whether the boxes hold for the present d_hat."""
        self._d_hat = 0.0
        self._reserve(CAPACITY)

    @property
    def capacity(self) -> int:
        """Number of pairs that the buffers hold; launch graphs over them must be recorded anew when it changes."""
        return len(self.kind)

    @property
    def kind(self) -> wp.array:
        """POINT_TRIANGLE, EDGE_EDGE or POINT_GROUND, shape (capacity,), int."""
        return self.pairs.kind

    @property
    def primitives(self) -> wp.array:
        """Vertex indices, shape (capacity,), vec4i."""
        return self.pairs.vertices

    def _reserve(self, capacity: int) -> None:
        model = self.model
        self.pairs = filled(
            Pairs,
            size=self._size,
            kind=wp.zeros(capacity, dtype=int, device=model.device),
            vertices=wp.zeros(capacity, dtype=wp.vec4i, device=model.device),
            rest=model.vertex_rest,
            body=model.vertex_body,
        )

    def require(self, d_hat: float) -> None:
        """Forget the boxes where they were made for a smaller barrier activation distance [m]."""
        self.built &= d_hat <= self._d_hat

    def cover(self, start: wp.array, end: wp.array, d_hat: float, skin: float) -> None:
        """Hold every pair that comes within `d_hat` while vertices move straight from `start` to `end`.

        Args:
            start: vertex positions [m], shape (vertices,), vec3d.
            end: vertex positions [m], shape (vertices,), vec3d.
            d_hat: barrier activation distance [m].
            skin: motion beyond this one that the pairs of a rebuild stay valid for [m].
        """
        self.require(d_hat)
        if self.built:
            self._outside.zero_()
            self.flag_outside(start, end, self._outside)
            if not self._outside.numpy()[0]:
                return
        self.rebuild(start, end, d_hat, skin)

    def flag_outside(self, start: wp.array, end: wp.array, flag: wp.array) -> None:
        """Set flag[0] where a vertex moves out of its box between two positions [m]."""
        wp.launch(
            _outside_boxes,
            dim=len(self.model.vertex_rest),
            device=self.model.device,
            inputs=[start, end, self._boxes.low, self._boxes.high, self._margin],
            outputs=[flag],
        )

    def rebuild(self, start: wp.array, end: wp.array, d_hat: float, skin: float) -> None:
        """Collect the pairs anew; arguments as of `cover`."""
        model = self.model
        self._d_hat = d_hat
        boxes = self._boxes
        boxes.enclose(start, end, 0.5 * d_hat + skin)
        _, close = boxes.close_pairs()
        self._margin.fill_(0.5 * d_hat)
        while True:
            self._size.zero_()
            wp.launch(
                _ground_candidates,
                dim=len(model.vertex_rest),
                device=model.device,
                inputs=[model.vertex_arrays, model.body_arrays, boxes.low, self._margin],
                outputs=[self._size, self.kind, self.primitives],
            )
            wp.launch(
                _pair_candidates,
                dim=(len(close), boxes.lanes),
                device=model.device,
                inputs=[boxes.lanes, close, self._boxed],
                outputs=[self._size, self.kind, self.primitives],
            )
            self.count = int(self._size.numpy()[0])
            if self.count <= self.capacity:
                break
            self._reserve(2 * self.count)
        if boxes.lanes > 1 and enabled():
            self.sort()
        self.built = True

    def sort(self) -> None:
        """Put the pairs into one order, whichever threads found them first."""
        kinds, primitives = self.kind.numpy()[: self.count], self.primitives.numpy()[: self.count]
        order = canonical(kinds, primitives)
        for array, values in ((self.kind, kinds), (self.primitives, primitives)):
            wp.copy(array, wp.array(values[order], dtype=array.dtype, device=array.device), count=self.count)


@wp.kernel
def _outside_boxes(
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
    margin: wp.array(dtype=wp.float64),
    # Out
    outside: wp.array(dtype=int),
):
    v = wp.tid()
    a = wp.min(start[v], end[v])
    b = wp.max(start[v], end[v])
    for i in range(3):
        if a[i] - margin[0] < low[v][i] or b[i] + margin[0] > high[v][i]:
            outside[0] = 1


@wp.func
def _append(
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
    kind: int,
    pair: wp.vec4i,
):
    slot = wp.atomic_add(counter, 0, 1)
    # Past the end only the count grows; the caller reserves more and runs again.
    if slot < kinds.shape[0]:
        kinds[slot] = kind
        primitives[slot] = pair


@wp.kernel
def _ground_candidates(
    vertices: Vertices,
    bodies: Bodies,
    low: wp.array(dtype=wp.vec3d),
    half_d_hat: wp.array(dtype=wp.float64),
    # Out
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    v = wp.tid()
    # One half of d_hat is in the vertex's box; the ground has no box to hold the other.
    if bodies.dof[vertices.body[v]] >= 0 and low[v][2] <= half_d_hat[0]:
        _append(counter, kinds, primitives, POINT_GROUND, wp.vec4i(v, -1, -1, -1))


@wp.struct
class Boxed:
    """Primitives of clusters, and the boxes of vertices and clusters."""

    ranges: wp.array2d(dtype=int)
    """`Model.cluster_ranges`."""
    edges: wp.array(dtype=wp.vec2i)
    triangles: wp.array(dtype=wp.vec3i)
    low: wp.array(dtype=wp.vec3d)
    """Of vertices [m]."""
    high: wp.array(dtype=wp.vec3d)
    cluster_low: wp.array(dtype=wp.vec3d)
    """[m]"""
    cluster_high: wp.array(dtype=wp.vec3d)


@wp.func
def _points_against_faces(
    points: int,
    faces: int,
    lane: int,
    lanes: int,
    boxed: Boxed,
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    for f in range(boxed.ranges[faces, 4] + lane, boxed.ranges[faces, 5], lanes):
        t = boxed.triangles[f]
        a = wp.min(wp.min(boxed.low[t[0]], boxed.low[t[1]]), boxed.low[t[2]])
        b = wp.max(wp.max(boxed.high[t[0]], boxed.high[t[1]]), boxed.high[t[2]])
        if boxes_overlap(a, b, boxed.cluster_low[points], boxed.cluster_high[points]):
            for v in range(boxed.ranges[points, 0], boxed.ranges[points, 1]):
                if boxes_overlap(a, b, boxed.low[v], boxed.high[v]):
                    _append(counter, kinds, primitives, POINT_TRIANGLE, wp.vec4i(v, t[0], t[1], t[2]))


@wp.kernel
def _pair_candidates(
    lanes: int,
    close: wp.array(dtype=wp.vec2i),
    boxed: Boxed,
    # Out
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    slot, lane = wp.tid()
    p = close[slot][0]
    q = close[slot][1]
    _points_against_faces(p, q, lane, lanes, boxed, counter, kinds, primitives)
    _points_against_faces(q, p, lane, lanes, boxed, counter, kinds, primitives)
    for i in range(boxed.ranges[p, 2] + lane, boxed.ranges[p, 3], lanes):
        e = boxed.edges[i]
        a = wp.min(boxed.low[e[0]], boxed.low[e[1]])
        b = wp.max(boxed.high[e[0]], boxed.high[e[1]])
        if boxes_overlap(a, b, boxed.cluster_low[q], boxed.cluster_high[q]):
            for j in range(boxed.ranges[q, 2], boxed.ranges[q, 3]):
                g = boxed.edges[j]
                low = wp.min(boxed.low[g[0]], boxed.low[g[1]])
                if boxes_overlap(a, b, low, wp.max(boxed.high[g[0]], boxed.high[g[1]])):
                    _append(counter, kinds, primitives, EDGE_EDGE, wp.vec4i(e[0], e[1], g[0], g[1]))
