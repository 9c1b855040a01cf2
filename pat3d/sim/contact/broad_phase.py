# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""Which primitives may come within the barrier's reach along a motion.

Body boxes prune part boxes, part boxes prune primitives. Boxes enclose the motion of every vertex from
its current to its trial position, inflated by half the reach plus a skin; the candidates stay valid while every
vertex remains within the skin of its box, so nearly converged iterations reuse them.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import warp as wp

from pat3d.sim.contact.distance import EDGE_EDGE, POINT_GROUND, POINT_TRIANGLE
from pat3d.sim.model import Model

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

LANES = 64
"""Threads that share a pair of parts on a GPU."""


@dataclass
class Candidates:
    """Pairs of primitives that may touch; grown as needed, never truncated."""

    model: Model
    kind: wp.array = field(init=False)
    """POINT_TRIANGLE, EDGE_EDGE or POINT_GROUND, shape (capacity,), int."""
    primitives: wp.array = field(init=False)
    """Vertex indices, shape (capacity,), vec4i."""
    size: wp.array = field(init=False)
    """Number of pairs, shape (1,), int; kernels over `capacity` threads end at it."""
    count: int = field(init=False, default=0)
    """`size` on the host."""

    def __post_init__(self) -> None:
        model, device = self.model, self.model.device
        vertices, parts = len(model.vertex_rest), len(model.part_body)
        self._low = wp.zeros(vertices, dtype=wp.vec3d, device=device)
        self._high = wp.zeros(vertices, dtype=wp.vec3d, device=device)
        self._part_low = wp.zeros(parts, dtype=wp.vec3d, device=device)
        self._part_high = wp.zeros(parts, dtype=wp.vec3d, device=device)
        self._close = wp.zeros(max(1, len(model.part_pairs)), dtype=wp.vec2i, device=device)
        self._counter = wp.zeros(1, dtype=int, device=device)
        self.size = wp.zeros(1, dtype=int, device=device)
        self._outside = wp.zeros(1, dtype=int, device=device)
        self._margin = wp.zeros(1, dtype=wp.float64, device=device)
        self.built = False
        """Whether the boxes hold for the present reach."""
        self._reach = 0.0
        self._reserve(256)

    @property
    def capacity(self) -> int:
        """Number of pairs there is room for; programs that launch on them must be recorded anew when it changes."""
        return len(self.kind)

    def _reserve(self, capacity: int) -> None:
        self.kind = wp.zeros(capacity, dtype=int, device=self.model.device)
        self.primitives = wp.zeros(capacity, dtype=wp.vec4i, device=self.model.device)

    def require(self, reach: float) -> None:
        """Forget the boxes where they were made for a shorter reach of the barrier [m]."""
        self.built &= reach <= self._reach

    def cover(self, start: wp.array, end: wp.array, reach: float, skin: float) -> None:
        """Hold every pair that comes within `reach` while vertices move straight from `start` to `end`.

        Args:
            start: vertex positions [m], shape (vertices,), vec3d.
            end: vertex positions [m], shape (vertices,), vec3d.
            reach: barrier activation distance d_hat [m].
            skin: motion beyond the boxes that a rebuild leaves room for [m].
        """
        self.require(reach)
        if self.built:
            self._outside.zero_()
            self.flag_outside(start, end, self._outside)
            if not self._outside.numpy()[0]:
                return
        self.rebuild(start, end, reach, skin)

    def flag_outside(self, start: wp.array, end: wp.array, flag: wp.array) -> None:
        """Set flag[0] where a vertex moves out of its box between two positions [m]."""
        wp.launch(
            _outside_boxes, dim=len(self.model.vertex_rest), device=self.model.device,
            inputs=[start, end, self._low, self._high, self._margin], outputs=[flag],
        )  # fmt: skip

    def rebuild(self, start: wp.array, end: wp.array, reach: float, skin: float) -> None:
        """Collect the pairs anew; arguments as of `cover`."""
        model = self.model
        close = self._prune(start, end, 0.5 * reach + skin)
        self._reach = reach
        self._margin.fill_(0.5 * reach)
        lanes = LANES if wp.get_device(model.device).is_cuda else 1
        while True:
            self.size.zero_()
            wp.launch(
                _ground_candidates, dim=len(model.vertex_rest), device=model.device,
                inputs=[model.vertex_body, model.body_dof, self._low, self._margin],
                outputs=[self.size, self.kind, self.primitives],
            )  # fmt: skip
            wp.launch(
                _pair_candidates, dim=(close, lanes), device=model.device,
                inputs=[
                    lanes, self._close, model.part_ranges, self._part_low, self._part_high,
                    model.edges, model.triangles, self._low, self._high,
                ],
                outputs=[self.size, self.kind, self.primitives],
            )  # fmt: skip
            self.count = int(self.size.numpy()[0])
            if self.count <= self.capacity:
                break
            self._reserve(2 * self.count)
        self.built = True

    def close_parts(self, position: wp.array) -> tuple[wp.array, int]:
        """Pairs of parts whose boxes overlap at vertex positions [m], vec2i, and how many of the array they fill."""
        self.built = False
        return self._close, self._prune(position, position, 0.0)

    def _prune(self, start: wp.array, end: wp.array, margin: float) -> int:
        """Box vertices and parts over the motion and list the overlapping pairs of parts; returns their number."""
        model = self.model
        wp.launch(
            _vertex_boxes, dim=len(model.vertex_rest), device=model.device,
            inputs=[start, end, margin], outputs=[self._low, self._high],
        )  # fmt: skip
        wp.launch(
            _part_boxes, dim=len(model.part_body), device=model.device,
            inputs=[model.part_ranges, self._low, self._high], outputs=[self._part_low, self._part_high],
        )  # fmt: skip
        self._counter.zero_()
        wp.launch(
            _close_parts, dim=len(model.part_pairs), device=model.device,
            inputs=[model.part_pairs, self._part_low, self._part_high], outputs=[self._counter, self._close],
        )  # fmt: skip
        return int(self._counter.numpy()[0])


@wp.kernel
def _vertex_boxes(
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    margin: wp.float64,
    # Out
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
):
    v = wp.tid()
    m = wp.vec3d(margin, margin, margin)
    low[v] = wp.min(start[v], end[v]) - m
    high[v] = wp.max(start[v], end[v]) + m


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


@wp.kernel
def _part_boxes(
    # Model
    part_ranges: wp.array2d(dtype=int),
    # State in
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
    # Out
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
):
    part = wp.tid()
    first = part_ranges[part, 0]
    a = low[first]
    b = high[first]
    for v in range(first + 1, part_ranges[part, 1]):
        a = wp.min(a, low[v])
        b = wp.max(b, high[v])
    part_low[part] = a
    part_high[part] = b


@wp.func
def _overlap(low_a: wp.vec3d, high_a: wp.vec3d, low_b: wp.vec3d, high_b: wp.vec3d) -> bool:
    return (
        low_a[0] <= high_b[0]
        and low_b[0] <= high_a[0]
        and low_a[1] <= high_b[1]
        and low_b[1] <= high_a[1]
        and low_a[2] <= high_b[2]
        and low_b[2] <= high_a[2]
    )


@wp.kernel
def _close_parts(
    # Model
    part_pairs: wp.array(dtype=wp.vec2i),
    # State in
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
    # Out
    counter: wp.array(dtype=int),
    close: wp.array(dtype=wp.vec2i),
):
    pair = part_pairs[wp.tid()]
    i = pair[0]
    j = pair[1]
    if _overlap(part_low[i], part_high[i], part_low[j], part_high[j]):
        close[wp.atomic_add(counter, 0, 1)] = pair


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
    # Model
    vertex_body: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    # State in
    low: wp.array(dtype=wp.vec3d),
    half_reach: wp.array(dtype=wp.float64),
    # Out
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    v = wp.tid()
    # One half of the reach is in the vertex's box; the ground has no box to hold the other.
    if body_dof[vertex_body[v]] >= 0 and low[v][2] <= half_reach[0]:
        _append(counter, kinds, primitives, POINT_GROUND, wp.vec4i(v, -1, -1, -1))


@wp.func
def _points_against_faces(
    points: int,
    faces: int,
    lane: int,
    lanes: int,
    part_ranges: wp.array2d(dtype=int),
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
    triangles: wp.array(dtype=wp.vec3i),
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    for f in range(part_ranges[faces, 4] + lane, part_ranges[faces, 5], lanes):
        t = triangles[f]
        a = wp.min(wp.min(low[t[0]], low[t[1]]), low[t[2]])
        b = wp.max(wp.max(high[t[0]], high[t[1]]), high[t[2]])
        if _overlap(a, b, part_low[points], part_high[points]):
            for v in range(part_ranges[points, 0], part_ranges[points, 1]):
                if _overlap(a, b, low[v], high[v]):
                    _append(counter, kinds, primitives, POINT_TRIANGLE, wp.vec4i(v, t[0], t[1], t[2]))


@wp.kernel
def _pair_candidates(
    lanes: int,
    # Model
    close: wp.array(dtype=wp.vec2i),
    part_ranges: wp.array2d(dtype=int),
    # State in
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
    edges: wp.array(dtype=wp.vec2i),
    triangles: wp.array(dtype=wp.vec3i),
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
    # Out
    counter: wp.array(dtype=int),
    kinds: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
):
    slot, lane = wp.tid()
    p = close[slot][0]
    q = close[slot][1]
    _points_against_faces(
        p, q, lane, lanes, part_ranges, part_low, part_high, triangles, low, high, counter, kinds, primitives
    )  # fmt: skip
    _points_against_faces(
        q, p, lane, lanes, part_ranges, part_low, part_high, triangles, low, high, counter, kinds, primitives
    )  # fmt: skip
    for i in range(part_ranges[p, 2] + lane, part_ranges[p, 3], lanes):
        e = edges[i]
        a = wp.min(low[e[0]], low[e[1]])
        b = wp.max(high[e[0]], high[e[1]])
        if _overlap(a, b, part_low[q], part_high[q]):
            for j in range(part_ranges[q, 2], part_ranges[q, 3]):
                g = edges[j]
                if _overlap(a, b, wp.min(low[g[0]], low[g[1]]), wp.max(high[g[0]], high[g[1]])):
                    _append(counter, kinds, primitives, EDGE_EDGE, wp.vec4i(e[0], e[1], g[0], g[1]))
