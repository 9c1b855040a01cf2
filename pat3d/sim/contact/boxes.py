# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""Boxes of parts and of their clusters, and which of them overlap.

Boxes of parts prune those of clusters of primitives, and those prune primitives.
"""

from __future__ import annotations

from typing import Any

import warp as wp

from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)

LANES = 64
"""Threads that share a pair of parts or clusters on a GPU."""

CLUSTER_PAIRS = 1024
"""Pairs of clusters that the buffer holds at first."""


class Boxes:
    """Axis-aligned boxes of vertices, clusters and parts over a motion [m], one vec3d each for low and high corner."""

    def __init__(self, model: Model):
        self.model = model
        device, parts, clusters = model.device, len(model.part_body), len(model.cluster_ranges)
        self.low = wp.zeros(len(model.vertex_rest), dtype=wp.vec3d, device=device)
        self.high = wp.zeros_like(self.low)
        self.cluster_low = wp.zeros(clusters, dtype=wp.vec3d, device=device)
        self.cluster_high = wp.zeros_like(self.cluster_low)
        self._close = wp.zeros(max(1, len(model.part_pairs)), dtype=wp.vec2i, device=device)
        # Where every part is one cluster, the boxes and the close pairs of parts are those of clusters.
        self._detailed = clusters > parts
        self._part_low, self._part_high, self._close_clusters = self.cluster_low, self.cluster_high, self._close
        if self._detailed:
            self._part_low = wp.zeros(parts, dtype=wp.vec3d, device=device)
            self._part_high = wp.zeros_like(self._part_low)
            self._close_clusters = wp.zeros(CLUSTER_PAIRS, dtype=wp.vec2i, device=device)
        self.lanes = LANES if wp.get_device(device).is_cuda else 1
        self._counter = wp.zeros(1, dtype=int, device=device)

    def enclose(self, start: wp.array, end: wp.array, margin: float) -> None:
        """Box everything over straight motions from `start` to `end` [m], shape (vertices,), vec3d.

        Args:
            start: vertex positions [m], shape (vertices,), vec3d.
            end: vertex positions [m], shape (vertices,), vec3d.
            margin: added on every side [m].
        """
        model = self.model
        wp.launch(
            _vertex_boxes,
            dim=len(model.vertex_rest),
            device=model.device,
            inputs=[start, end, margin],
            outputs=[self.low, self.high],
        )
        wp.launch(
            _cluster_boxes,
            dim=len(model.cluster_ranges),
            device=model.device,
            inputs=[model.cluster_ranges, model.halo, model.triangles, self.low, self.high],
            outputs=[self.cluster_low, self.cluster_high],
        )
        if self._detailed:
            wp.launch(
                _part_boxes,
                dim=len(model.part_body),
                device=model.device,
                inputs=[model.part_ranges, self.cluster_low, self.cluster_high],
                outputs=[self._part_low, self._part_high],
            )

    def close_pairs(self) -> tuple[Any, Any]:
        """Pairs of parts and pairs of clusters whose boxes overlap, vec2i."""
        model = self.model
        self._counter.zero_()
        wp.launch(
            _close_parts,
            dim=len(model.part_pairs),
            device=model.device,
            inputs=[model.part_pairs, self._part_low, self._part_high],
            outputs=[self._counter, self._close],
        )
        parts = int(self._counter.numpy()[0])
        clusters = self._close_cluster_pairs(parts)
        return self._close[:parts], self._close_clusters[:clusters]

    def _close_cluster_pairs(self, parts: int) -> int:
        """List the overlapping pairs of clusters in the first `parts` close pairs of parts; returns their number."""
        if not self._detailed:
            return parts
        model = self.model
        while True:
            self._counter.zero_()
            wp.launch(
                _close_clusters,
                dim=(parts, self.lanes),
                device=model.device,
                inputs=[
                    self.lanes,
                    self._close,
                    model.part_ranges,
                    self._part_low,
                    self._part_high,
                    self.cluster_low,
                    self.cluster_high,
                ],
                outputs=[self._counter, self._close_clusters],
            )
            count = int(self._counter.numpy()[0])
            if count <= len(self._close_clusters):
                return count
            self._close_clusters = wp.zeros(2 * count, dtype=wp.vec2i, device=model.device)


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
def _cluster_boxes(
    # Model
    cluster_ranges: wp.array2d(dtype=int),
    halo: wp.array(dtype=int),
    triangles: wp.array(dtype=wp.vec3i),
    # State in
    low: wp.array(dtype=wp.vec3d),
    high: wp.array(dtype=wp.vec3d),
    # Out
    cluster_low: wp.array(dtype=wp.vec3d),
    cluster_high: wp.array(dtype=wp.vec3d),
):
    c = wp.tid()
    # A cluster may own no vertex, but has a triangle.
    first = triangles[cluster_ranges[c, 4]][0]
    a = low[first]
    b = high[first]
    for v in range(cluster_ranges[c, 0], cluster_ranges[c, 1]):
        a = wp.min(a, low[v])
        b = wp.max(b, high[v])
    for h in range(cluster_ranges[c, 6], cluster_ranges[c, 7]):
        a = wp.min(a, low[halo[h]])
        b = wp.max(b, high[halo[h]])
    cluster_low[c] = a
    cluster_high[c] = b


@wp.kernel
def _part_boxes(
    # Model
    part_ranges: wp.array2d(dtype=int),
    # State in
    cluster_low: wp.array(dtype=wp.vec3d),
    cluster_high: wp.array(dtype=wp.vec3d),
    # Out
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
):
    part = wp.tid()
    first = part_ranges[part, 6]
    a = cluster_low[first]
    b = cluster_high[first]
    for c in range(first + 1, part_ranges[part, 7]):
        a = wp.min(a, cluster_low[c])
        b = wp.max(b, cluster_high[c])
    part_low[part] = a
    part_high[part] = b


@wp.func
def boxes_overlap(low_a: wp.vec3d, high_a: wp.vec3d, low_b: wp.vec3d, high_b: wp.vec3d) -> bool:
    """Whether two boxes share a point."""
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
    if boxes_overlap(part_low[i], part_high[i], part_low[j], part_high[j]):
        close[wp.atomic_add(counter, 0, 1)] = pair


@wp.kernel
def _close_clusters(
    lanes: int,
    # Model
    close: wp.array(dtype=wp.vec2i),
    part_ranges: wp.array2d(dtype=int),
    # State in
    part_low: wp.array(dtype=wp.vec3d),
    part_high: wp.array(dtype=wp.vec3d),
    cluster_low: wp.array(dtype=wp.vec3d),
    cluster_high: wp.array(dtype=wp.vec3d),
    # Out
    counter: wp.array(dtype=int),
    close_clusters: wp.array(dtype=wp.vec2i),
):
    slot, lane = wp.tid()
    p = close[slot][0]
    q = close[slot][1]
    # What lies outside the region that the two parts share is close to nothing.
    low = wp.max(part_low[p], part_low[q])
    high = wp.min(part_high[p], part_high[q])
    for i in range(part_ranges[p, 6] + lane, part_ranges[p, 7], lanes):
        if boxes_overlap(cluster_low[i], cluster_high[i], low, high):
            for j in range(part_ranges[q, 6], part_ranges[q, 7]):
                if boxes_overlap(cluster_low[i], cluster_high[i], cluster_low[j], cluster_high[j]):
                    slot_out = wp.atomic_add(counter, 0, 1)
                    # Past the end only the count grows; the caller reserves more and runs again.
                    if slot_out < close_clusters.shape[0]:
                        close_clusters[slot_out] = wp.vec2i(i, j)
