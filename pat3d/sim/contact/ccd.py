# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Continuous collision detection along straight vertex motions: additive conservative advancement.

A pair at distance d whose points approach each other by at most l over the whole motion cannot meet before
d / l. Advancing by that bound again and again converges to the time of impact from below (Li et al. 2021,
Codimensional IPC, section 5.4). Motions are straight because bodies move affinely.
"""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.arrays import Bodies
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.distance import POINT_GROUND, POINT_TRIANGLE, closest_on_edges, closest_on_triangle
from pat3d.sim.contact.pairs import Pairs
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)

REMAINING = wp.constant(wp.float64(0.1))
"""Fraction of the present distance that a full safe step may leave."""

ITERATIONS = wp.constant(64)
"""Bound on the advances; stopping early is safe because every advance is."""


def safe_step(model: Model, candidates: Candidates, start: wp.array, end: wp.array, step: wp.array) -> None:
    """Lower `step` of every world to a fraction of the motion along which no pair of `candidates` touches.

    Args:
        model: the worlds.
        candidates: pairs that cover the motion.
        start: vertex positions [m], shape (vertices,), vec3d, without intersection.
        end: vertex positions [m] at step 1, shape (vertices,), vec3d.
        step: fraction of the motion, lowered in place, shape (worlds,), float64; worlds at 0 are left out.
    """
    wp.launch(
        _advance,
        dim=candidates.capacity,
        device=model.device,
        inputs=[model.body_arrays, candidates.pairs, start, end],
        outputs=[step],
    )


def fractions(model: Model, candidates: Candidates, start: wp.array, end: wp.array) -> NDArray[np.float64]:
    """Fraction of the motion that every pair of `candidates` allows, shape (candidates.count,).

    Args:
        model: the worlds.
        candidates: pairs.
        start: vertex positions [m], shape (vertices,), vec3d.
        end: vertex positions [m] at step 1, shape (vertices,), vec3d.
    """
    found = wp.zeros(candidates.count, dtype=wp.float64, device=model.device)
    wp.launch(
        _fractions,
        dim=candidates.count,
        device=model.device,
        inputs=[candidates.pairs, start, end],
        outputs=[found],
    )
    return found.numpy()


@wp.func
def _distance(kind: int, a: wp.vec3d, b: wp.vec3d, c: wp.vec3d, d: wp.vec3d) -> wp.float64:
    if kind == POINT_TRIANGLE:
        wb, wc, _ = closest_on_triangle(a, b, c, d)
        return wp.length(a - (b + wb * (c - b) + wc * (d - b)))
    s, t = closest_on_edges(a, b, c, d)
    return wp.length(a + s * (b - a) - (c + t * (d - c)))


@wp.func
def _allowed(
    kind: int,
    index: wp.vec4i,
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    limit: wp.float64,
) -> wp.float64:
    """Fraction of the motion that a pair allows; `limit` or more where it allows that."""
    i = index[0]
    one = wp.float64(1.0)
    if kind == POINT_GROUND:
        height = start[i][2]
        fall = height - end[i][2]
        if fall * limit > (one - REMAINING) * height:
            return (one - REMAINING) * height / fall
        return limit
    a = start[i]
    b = start[index[1]]
    c = start[index[2]]
    d = start[index[3]]
    da = end[i] - a
    db = end[index[1]] - b
    dc = end[index[2]] - c
    dd = end[index[3]] - d
    # Motion common to the four points brings none of them closer.
    mean = wp.float64(0.25) * (da + db + dc + dd)
    da = da - mean
    db = db - mean
    dc = dc - mean
    dd = dd - mean
    approach = wp.float64(0.0)
    if kind == POINT_TRIANGLE:
        approach = wp.length(da) + wp.max(wp.length(db), wp.max(wp.length(dc), wp.length(dd)))
    else:
        approach = wp.max(wp.length(da), wp.length(db)) + wp.max(wp.length(dc), wp.length(dd))
    distance = _distance(kind, a, b, c, d)
    keep = REMAINING * distance
    if approach * limit <= distance - keep:
        return limit
    time = wp.float64(0.0)
    for _ in range(ITERATIONS):
        advance = (distance - keep) / approach
        if time + advance >= limit:
            return limit
        time += advance
        distance = _distance(kind, a + time * da, b + time * db, c + time * dc, d + time * dd)
        # Within ten per cent of the kept distance more advances gain nothing.
        if distance <= wp.float64(1.1) * keep:
            break
    return time


@wp.kernel
def _advance(
    bodies: Bodies,
    pairs: Pairs,
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    # Out
    step: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    limit = step[world]
    if limit == wp.float64(0.0):
        return
    allowed = _allowed(pairs.kind[pair], pairs.vertices[pair], start, end, limit)
    if allowed != limit:
        wp.atomic_min(step, world, allowed)


@wp.kernel
def _fractions(
    pairs: Pairs,
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    # Out
    fraction: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    fraction[pair] = _allowed(pairs.kind[pair], pairs.vertices[pair], start, end, wp.float64(1.0))
