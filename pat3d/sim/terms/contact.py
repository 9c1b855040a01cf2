# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Barrier contact between bodies and with the ground.

B(q) = sum over pairs of m b(d): the barrier b of the pair's distance, mollified by m for nearly parallel
edges. The Hessian is either exact or its Gauss-Newton part m b'' grad d grad d^T, which is
positive semidefinite and of rank one.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import warp as wp

from pat3d.sim.arrays import Bodies, filled
from pat3d.sim.contact.barrier import Barrier, barrier_curvature, barrier_slope, barrier_value
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.distance import Contact
from pat3d.sim.contact.pairs import Pairs, contact_at
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model
from pat3d.sim.terms.term import Evaluation, Launch
from pat3d.sim.terms.unknowns import add_block, first_unknown, pair_index

declare_kernels(__name__, most_records=8 * 8 * 9)


class BarrierContact:
    """Repulsion of every candidate pair closer than d_hat."""

    def __init__(self, model: Model, candidates: Candidates):
        self.model = model
        self.candidates = candidates
        self.stiffness = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        """kappa [N], shape (worlds,)."""
        self._d_hat_array = wp.zeros(1, dtype=wp.float64, device=model.device)
        self.barrier = filled(Barrier, stiffness=self.stiffness, d_hat=self._d_hat_array)
        """Both constants, for kernels."""
        self._d_hat = 0.0
        self.d_hat = 1.0e-3

    @property
    def d_hat(self) -> float:
        """Activation distance [m]."""
        return self._d_hat

    @d_hat.setter
    def d_hat(self, value: float) -> None:
        if value == self._d_hat:
            return
        self._d_hat = value
        self._d_hat_array.fill_(value)

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Those of B; the candidates must cover the state."""
        return [self._launch(_value, at, (), (energy, gradient))]

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Those of d2B/dq2 or its Gauss-Newton part."""
        return [self._launch(kernel, at, (exact,), (hessian,)) for kernel in (_gauss_newton_hessian, _exact_hessian)]

    def _launch(self, kernel: Any, at: Evaluation, more: tuple, outputs: tuple) -> Launch:
        inputs = (self.model.body_arrays, self.candidates.pairs, self.barrier, at.active, at.position, *more)
        return Launch(kernel=kernel, dim=self.candidates.capacity, inputs=inputs, outputs=outputs)


@wp.func
def cross_gradient_u(contact: Contact) -> wp.vec3d:
    """d|u x v|^2 / du."""
    return wp.float64(2.0) * (wp.dot(contact.v, contact.v) * contact.u - wp.dot(contact.u, contact.v) * contact.v)


@wp.func
def cross_gradient_v(contact: Contact) -> wp.vec3d:
    """d|u x v|^2 / dv."""
    return wp.float64(2.0) * (wp.dot(contact.u, contact.u) * contact.v - wp.dot(contact.u, contact.v) * contact.u)


@wp.func
def mollifier_slope(contact: Contact) -> wp.float64:
    """Derivative of the mollifier by |u x v|^2 [1/m^4]."""
    if contact.cross >= contact.threshold:
        return wp.float64(0.0)
    return wp.float64(2.0) * (wp.float64(1.0) - contact.cross / contact.threshold) / contact.threshold


@wp.func
def _rest_edge(k: int, contact: Contact) -> wp.float64:
    """Coefficient of the k-th vector in the edge direction u (k < 4) or v."""
    if k == 0 or k == 4:
        return wp.float64(0.0)
    if k < 4:
        return contact.rest_u[k - 1]
    return contact.rest_v[k - 5]


@wp.kernel
def _value(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    active: wp.array(dtype=int),
    position: wp.array(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    if active[world] == 0:
        return
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    if contact.distance >= d_hat:
        return
    value = barrier_value(contact.distance, d_hat, barrier.stiffness[world])
    wp.atomic_add(energy, world, contact.mollifier * value)
    force = contact.mollifier * barrier_slope(contact.distance, d_hat, barrier.stiffness[world]) * contact.normal
    for k in range(4):
        wp.atomic_add(gradient, contact.body_a, k, contact.coefficients[k] * force)
        if contact.body_b >= 0:
            wp.atomic_add(gradient, contact.body_b, k, contact.coefficients[4 + k] * force)
    slope = mollifier_slope(contact)
    if slope != wp.float64(0.0):
        gu = slope * value * cross_gradient_u(contact)
        gv = slope * value * cross_gradient_v(contact)
        for k in range(3):
            wp.atomic_add(gradient, contact.body_a, 1 + k, contact.rest_u[k] * gu)
            wp.atomic_add(gradient, contact.body_b, 1 + k, contact.rest_v[k] * gv)


@wp.kernel
def _gauss_newton_hessian(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    active: wp.array(dtype=int),
    position: wp.array(dtype=wp.vec3d),
    exact: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    if active[world] == 0 or exact[world] != 0:
        return
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    if contact.distance >= d_hat:
        return
    curvature = contact.mollifier * barrier_curvature(contact.distance, d_hat, barrier.stiffness[world])
    base_a = first_unknown(contact.body_a, bodies.dof)
    base_b = first_unknown(contact.body_b, bodies.dof)
    n = contact.normal
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row >= 0:
            for j in range(8):
                column = pair_index(j, base_a, base_b)
                if column >= 0:
                    weight = curvature * contact.coefficients[i] * contact.coefficients[j]
                    # A block of its own costs a fifth of the kernel's time.
                    for r in range(3):
                        for s in range(3):
                            wp.atomic_add(hessian, world, row + r, column + s, weight * n[r] * n[s])


@wp.kernel
def _exact_hessian(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    active: wp.array(dtype=int),
    position: wp.array(dtype=wp.vec3d),
    exact: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    if active[world] == 0 or exact[world] == 0:
        return
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    if contact.distance >= d_hat:
        return
    zero = wp.float64(0.0)
    one = wp.float64(1.0)
    two = wp.float64(2.0)
    d = contact.distance
    n = contact.normal
    value = barrier_value(d, d_hat, barrier.stiffness[world])
    slope = barrier_slope(d, d_hat, barrier.stiffness[world])
    curvature = barrier_curvature(d, d_hat, barrier.stiffness[world])

    # Inverse of G / 2 over the free closest-point parameters.
    g11 = zero
    g12 = zero
    g22 = zero
    if contact.free == 1:
        g11 = one / wp.dot(contact.e1, contact.e1)
    elif contact.free == 2:
        a = wp.dot(contact.e1, contact.e1)
        b = wp.dot(contact.e1, contact.e2)
        c = wp.dot(contact.e2, contact.e2)
        determinant = a * c - b * b
        if determinant > wp.float64(1.0e-12) * a * c:
            g11 = c / determinant
            g12 = -b / determinant
            g22 = a / determinant
        else:
            g11 = one / a
    m_slope = mollifier_slope(contact)
    mollifier_curvature = zero
    if m_slope != zero:
        mollifier_curvature = -two / (contact.threshold * contact.threshold)
    gu = cross_gradient_u(contact)
    gv = cross_gradient_v(contact)
    uu = wp.dot(contact.u, contact.u)
    vv = wp.dot(contact.v, contact.v)
    uv = wp.dot(contact.u, contact.v)

    identity = wp.identity(n=3, dtype=wp.float64)
    along = contact.mollifier * curvature
    across = contact.mollifier * slope / d
    base_a = first_unknown(contact.body_a, bodies.dof)
    base_b = first_unknown(contact.body_b, bodies.dof)
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row < 0:
            continue
        f1i = contact.h1[i] * d * n + contact.coefficients[i] * contact.e1
        f2i = contact.h2[i] * d * n + contact.coefficients[i] * contact.e2
        for j in range(8):
            column = pair_index(j, base_a, base_b)
            if column < 0:
                continue
            f1j = contact.h1[j] * d * n + contact.coefficients[j] * contact.e1
            f2j = contact.h2[j] * d * n + contact.coefficients[j] * contact.e2
            cc = contact.coefficients[i] * contact.coefficients[j]
            block = (along - across) * cc * wp.outer(n, n) + across * cc * identity
            block -= across * (
                g11 * wp.outer(f1i, f1j) + g12 * (wp.outer(f1i, f2j) + wp.outer(f2i, f1j)) + g22 * wp.outer(f2i, f2j)
            )
            if m_slope != zero:
                gi = gu
                if i >= 4:
                    gi = gv
                gj = gu
                if j >= 4:
                    gj = gv
                ri = _rest_edge(i, contact)
                rj = _rest_edge(j, contact)
                second = wp.mat33d()
                if i < 4 and j < 4:
                    second = two * (vv * identity - wp.outer(contact.v, contact.v))
                elif i >= 4 and j >= 4:
                    second = two * (uu * identity - wp.outer(contact.u, contact.u))
                elif i < 4:
                    second = two * (
                        two * wp.outer(contact.u, contact.v) - uv * identity - wp.outer(contact.v, contact.u)
                    )
                else:
                    second = two * (
                        two * wp.outer(contact.v, contact.u) - uv * identity - wp.outer(contact.u, contact.v)
                    )
                block += value * ri * rj * (mollifier_curvature * wp.outer(gi, gj) + m_slope * second)
                block += (
                    m_slope
                    * slope
                    * (ri * contact.coefficients[j] * wp.outer(gi, n) + rj * contact.coefficients[i] * wp.outer(n, gj))
                )
            add_block(hessian, world, row, column, block)
