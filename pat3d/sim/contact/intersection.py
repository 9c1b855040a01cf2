# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""Which bodies intersect at a state: the verification that a simulation may start.

Two closed parts intersect when an edge of one pierces a face of the other, or when one contains the other. Where
nothing pierces, one vertex tells: a surface winds around a point inside it once, and around one outside not at all
(the solid angles of its triangles as in van Oosterom and Strackee 1983, The solid angle of a plane triangle).
"""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.contact.boxes import Boxes
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)

GROUND_BODY = -1


def intersecting_bodies(model: Model, position: wp.array) -> NDArray[np.int64]:
    """Pairs of bodies that intersect, and bodies at or under the ground.

    Args:
        model: the worlds.
        position: vertex positions [m], shape (vertices,), vec3d.

    Returns:
        Body indices, shape (pairs, 2); the second is GROUND_BODY for the ground.
    """
    boxes = Boxes(model)
    boxes.enclose(position, position, 0.0)
    parts, clusters = boxes.close_pairs()
    pierced = _launch(_pierce, model, clusters, [model.cluster_ranges, model.edges, model.triangles, position])
    contained = _launch(_contain, model, parts, [model.part_ranges, model.triangles, position])
    body = model.vertex_body.numpy()
    # Of a cluster, the body is that of any corner of its triangles.
    corner = model.triangles.numpy()[model.cluster_ranges.numpy()[:, 4], 0]
    bodies = np.concatenate([body[corner[pierced]], model.part_body.numpy()[contained]])
    bodies = np.sort(bodies, axis=1)
    free = model.body_dof.numpy() >= 0
    low = np.unique(body[(position.numpy()[:, 2] <= 0.0) & free[body]])
    ground = np.stack([low, np.full(len(low), GROUND_BODY)], axis=1)
    return np.concatenate([np.unique(bodies, axis=0), ground]).astype(np.int64)


def _launch(kernel: wp.Kernel, model: Model, pairs: wp.array, inputs: list) -> NDArray[np.int32]:
    """Those of `pairs` for which a kernel over two directions of each finds a hit, shape (hits, 2)."""
    count = len(pairs)
    if not count:
        return np.zeros((0, 2), dtype=np.int32)
    hit = wp.zeros(count, dtype=int, device=model.device)
    wp.launch(kernel, dim=(count, 2), device=model.device, inputs=[pairs, *inputs], outputs=[hit])
    return np.asarray(pairs.numpy(), dtype=np.int32)[hit.numpy() != 0]


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


@wp.kernel
def _pierce(
    # Model
    pairs: wp.array(dtype=wp.vec2i),
    cluster_ranges: wp.array2d(dtype=int),
    edges: wp.array(dtype=wp.vec2i),
    triangles: wp.array(dtype=wp.vec3i),
    # State in
    position: wp.array(dtype=wp.vec3d),
    # Out
    hit: wp.array(dtype=int),
):
    i, side = wp.tid()
    own = pairs[i][side]
    other = pairs[i][1 - side]
    for e in range(cluster_ranges[own, 2], cluster_ranges[own, 3]):
        p = position[edges[e][0]]
        q = position[edges[e][1]]
        for f in range(cluster_ranges[other, 4], cluster_ranges[other, 5]):
            t = triangles[f]
            if _pierces(p, q, position[t[0]], position[t[1]], position[t[2]]):
                hit[i] = 1
                return


@wp.kernel
def _contain(
    # Model
    pairs: wp.array(dtype=wp.vec2i),
    part_ranges: wp.array2d(dtype=int),
    triangles: wp.array(dtype=wp.vec3i),
    # State in
    position: wp.array(dtype=wp.vec3d),
    # Out
    hit: wp.array(dtype=int),
):
    i, side = wp.tid()
    own = pairs[i][side]
    other = pairs[i][1 - side]
    x = position[part_ranges[own, 0]]
    turns = wp.float64(0.0)
    for f in range(part_ranges[other, 4], part_ranges[other, 5]):
        t = triangles[f]
        a = position[t[0]] - x
        b = position[t[1]] - x
        c = position[t[2]] - x
        la = wp.length(a)
        lb = wp.length(b)
        lc = wp.length(c)
        volume = wp.dot(a, wp.cross(b, c))
        turns += wp.atan2(volume, la * lb * lc + wp.dot(a, b) * lc + wp.dot(b, c) * la + wp.dot(c, a) * lb)
    # Half of the solid angle: 2 pi inside, 0 outside.
    if wp.abs(turns) > wp.float64(3.141592653589793):
        hit[i] = 1
