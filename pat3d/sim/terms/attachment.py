# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Points of two bodies held together: ropes, hooks, strings.

P(q) = k / 2 |x_a - x_b|^2,   x = p + xbar_1 a_1 + xbar_2 a_2 + xbar_3 a_3

Points are linear in q, so P is quadratic, its Hessian k c c^T (x) I_3 constant and positive semidefinite, with c the
eight coefficients (1, xbar_a, -1, -xbar_b).
"""

from __future__ import annotations

from collections.abc import Sequence

import warp as wp

from pat3d.sim.arrays import AttachmentPoints, Bodies, filled
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model
from pat3d.sim.terms.term import Evaluation, Launch
from pat3d.sim.terms.unknowns import first_unknown, pair_index

declare_kernels(__name__, most_records=8 * 8 * 3)


class PointAttachment:
    """Stiff springs of no length between the attachment points of attached bodies."""

    def __init__(self, model: Model):
        self.model = model
        self._points = filled(
            AttachmentPoints,
            bodies=model.attachment_bodies,
            rest=model.attachment_rest,
            stiffness=model.attachment_stiffness,
        )

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Those of P; none where nothing is attached."""
        count = len(self.model.attachment_bodies)
        inputs = (self.model.body_arrays, self._points, at.active, at.q)
        return [Launch(kernel=_value, dim=count, inputs=inputs, outputs=(energy, gradient))] if count else []

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Those of d2P/dq2, which is constant and positive semidefinite."""
        count = len(self.model.attachment_bodies)
        inputs = (self.model.body_arrays, self._points, at.active)
        return [Launch(kernel=_hessian, dim=count, inputs=inputs, outputs=(hessian,))] if count else []


@wp.func
def _coefficient(k: int, rest_a: wp.vec3d, rest_b: wp.vec3d) -> wp.float64:
    """Weight of the k-th of the pair's eight vectors in x_a - x_b."""
    if k == 0:
        return wp.float64(1.0)
    if k < 4:
        return rest_a[k - 1]
    if k == 4:
        return wp.float64(-1.0)
    return -rest_b[k - 5]


@wp.func
def _offset(pair: wp.vec2i, rest_a: wp.vec3d, rest_b: wp.vec3d, q: wp.array2d(dtype=wp.vec3d)) -> wp.vec3d:
    """x_a - x_b [m]."""
    offset = q[pair[0], 0] - q[pair[1], 0]
    for j in range(3):
        offset += rest_a[j] * q[pair[0], 1 + j] - rest_b[j] * q[pair[1], 1 + j]
    return offset


@wp.kernel
def _value(
    bodies: Bodies,
    points: AttachmentPoints,
    active: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    i = wp.tid()
    pair = points.bodies[i]
    world = bodies.world[pair[0]]
    if active[world] == 0:
        return
    rest_a = points.rest[i, 0]
    rest_b = points.rest[i, 1]
    offset = _offset(pair, rest_a, rest_b, q)
    wp.atomic_add(energy, world, wp.float64(0.5) * points.stiffness[i] * wp.dot(offset, offset))
    for k in range(4):
        wp.atomic_add(gradient, pair[0], k, _coefficient(k, rest_a, rest_b) * points.stiffness[i] * offset)
        wp.atomic_add(gradient, pair[1], k, _coefficient(4 + k, rest_a, rest_b) * points.stiffness[i] * offset)


@wp.kernel
def _hessian(
    bodies: Bodies,
    points: AttachmentPoints,
    active: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    a = wp.tid()
    pair = points.bodies[a]
    world = bodies.world[pair[0]]
    if active[world] == 0:
        return
    base_a = first_unknown(pair[0], bodies.dof)
    base_b = first_unknown(pair[1], bodies.dof)
    rest_a = points.rest[a, 0]
    rest_b = points.rest[a, 1]
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row >= 0:
            for j in range(8):
                column = pair_index(j, base_a, base_b)
                if column >= 0:
                    weight = points.stiffness[a] * _coefficient(i, rest_a, rest_b) * _coefficient(j, rest_a, rest_b)
                    for r in range(3):
                        wp.atomic_add(hessian, world, row + r, column + r, weight)
