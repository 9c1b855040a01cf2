# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Which bodies intersect at a state: the proof that a simulation may start.

Two closed convex parts intersect when an edge of one pierces a face of the other, or when one contains the
other and so a vertex of it.
"""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.model import Model

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

GROUND_BODY = -1


def intersecting_bodies(model: Model, position: wp.array) -> NDArray[np.int64]:
    """Pairs of bodies that intersect, and bodies at or under the ground.

    Args:
        model: the worlds; parts must be convex.
        position: vertex positions [m], shape (vertices,), vec3d.

    Returns:
        Body indices, shape (pairs, 2); the second is GROUND_BODY for the ground.
    """
    pairs, count = Candidates(model).close_parts(position)
    hit = wp.zeros(max(1, count), dtype=int, device=model.device)
    wp.launch(
        _intersect, dim=count, device=model.device,
        inputs=[pairs, model.part_ranges, model.edges, model.triangles, position], outputs=[hit],
    )  # fmt: skip
    owner, body = model.part_body.numpy(), model.vertex_body.numpy()
    touching = np.flatnonzero(hit.numpy()[:count])
    bodies = np.sort(owner[pairs.numpy()[touching]].reshape(-1, 2), axis=1)
    free = model.body_dof.numpy() >= 0
    low = np.unique(body[(position.numpy()[:, 2] <= 0.0) & free[body]])
    ground = np.stack([low, np.full(len(low), GROUND_BODY)], axis=1)
    return np.concatenate([np.unique(bodies, axis=0), ground]).astype(np.int64)


@wp.func
def _pierces(p: wp.vec3d, q: wp.vec3d, a: wp.vec3d, b: wp.vec3d, c: wp.vec3d) -> bool:
    """Whether segment pq crosses triangle abc."""
    zero = wp.float64(0.0)
    normal = wp.cross(b - a, c - a)
    side_p = wp.dot(normal, p - a)
    side_q = wp.dot(normal, q - a)
    if (side_p > zero and side_q > zero) or (side_p < zero and side_q < zero):
        return False
    if side_p == side_q:
        return False
    x = p + (side_p / (side_p - side_q)) * (q - p)
    return (
        wp.dot(normal, wp.cross(b - a, x - a)) >= zero
        and wp.dot(normal, wp.cross(c - b, x - b)) >= zero
        and wp.dot(normal, wp.cross(a - c, x - c)) >= zero
    )


@wp.func
def _edges_pierce(
    part: int,
    other: int,
    part_ranges: wp.array2d(dtype=int),
    edges: wp.array(dtype=wp.vec2i),
    triangles: wp.array(dtype=wp.vec3i),
    position: wp.array(dtype=wp.vec3d),
) -> bool:
    for e in range(part_ranges[part, 2], part_ranges[part, 3]):
        p = position[edges[e][0]]
        q = position[edges[e][1]]
        for f in range(part_ranges[other, 4], part_ranges[other, 5]):
            t = triangles[f]
            if _pierces(p, q, position[t[0]], position[t[1]], position[t[2]]):
                return True
    return False


@wp.func
def _contains(
    part: int,
    x: wp.vec3d,
    part_ranges: wp.array2d(dtype=int),
    triangles: wp.array(dtype=wp.vec3i),
    position: wp.array(dtype=wp.vec3d),
) -> bool:
    for f in range(part_ranges[part, 4], part_ranges[part, 5]):
        t = triangles[f]
        a = position[t[0]]
        if wp.dot(wp.cross(position[t[1]] - a, position[t[2]] - a), x - a) > wp.float64(0.0):
            return False
    return True


@wp.kernel
def _intersect(
    # Model
    pairs: wp.array(dtype=wp.vec2i),
    part_ranges: wp.array2d(dtype=int),
    edges: wp.array(dtype=wp.vec2i),
    triangles: wp.array(dtype=wp.vec3i),
    # State in
    position: wp.array(dtype=wp.vec3d),
    # Out
    hit: wp.array(dtype=int),
):
    i = wp.tid()
    a = pairs[i][0]
    b = pairs[i][1]
    if (
        _edges_pierce(a, b, part_ranges, edges, triangles, position)
        or _edges_pierce(b, a, part_ranges, edges, triangles, position)
        or _contains(a, position[part_ranges[b, 0]], part_ranges, triangles, position)
        or _contains(b, position[part_ranges[a, 0]], part_ranges, triangles, position)
    ):
        hit[i] = 1
