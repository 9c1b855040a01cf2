# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Lagged friction's derivative with respect to the state at which its contacts were recorded.

The friction force on the body vectors is F = sum mu lambda k(|u|) c (x) u with k = f0'/|u|. Its normal force
lambda, normal n and closest points c come from the recorded state q_n, and where displacements count from q_n, so
does u. This module pulls an adjoint w back through all four: it adds d(w . F)/dq_n. With s = sum_i c_i w_i:

    w . F = mu lambda k(|u|) (s . u),   u = (I - n n^T) sum_i c_i (q_i - q_ref_i)
    dlambda = -(m b'' n . dx + b' dm),  dn = (I - n n^T) dr / d,  dc = sum_k h_k dbeta_k
    dbeta_k = -sum_l (E^-1)_kl (h_l (x) r + c (x) e_l) . dq,  E_kl = e_k . e_l,  dr = dx + sum_k e_k dbeta_k

where dx = sum_i c_i dq_i. Without the normal and the closest points, curved bodies are wrong by tens of per cent.
"""

from __future__ import annotations

from typing import Any

import warp as wp

from pat3d.sim.arrays import Bodies
from pat3d.sim.contact.barrier import Barrier, barrier_curvature, barrier_slope
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.pairs import Pairs, contact_at
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.terms.contact import cross_gradient_u, cross_gradient_v, mollifier_slope
from pat3d.sim.terms.friction import Friction, FrictionLaw, mobilisation

declare_kernels(__name__, most_records=8, gradients=True)


def pull_back_lag(
    friction: Friction,
    candidates: Candidates,
    position: wp.array,
    barrier: Any,
    q: wp.array,
    adjoint: wp.array,
    recorded: wp.array,
    reference: wp.array,
    d_hat: wp.array,
) -> None:
    """Pull an adjoint of the friction force at state q back to the state it was recorded at.

    Args:
        friction: coefficient, epsilon and reference state of the step.
        candidates: pairs that cover the recorded state.
        position: vertex positions of the recorded state [m], shape (vertices,), vec3d.
        barrier: `Barrier`, of the record.
        q: state at the end of the step, shape (bodies, 4), vec3d.
        adjoint: w, shape (bodies, 4), vec3d.
        recorded: increased by d(w . F)/dq_n through lambda, n and c, shape (bodies, 4), vec3d.
        reference: increased by d(w . F)/dq_ref, shape (bodies, 4), vec3d.
        d_hat: increased by d(w . F)/dd_hat through lambda [N], shape (worlds,).
    """
    model = friction.model
    wp.launch(
        _pull_back,
        dim=candidates.capacity,
        device=model.device,
        inputs=[model.body_arrays, candidates.pairs, barrier, friction.law, position, q, adjoint],
        outputs=[recorded, reference, d_hat],
    )


@wp.func
def _body_vector(x: wp.array2d(dtype=wp.vec3d), i: int, body_a: int, body_b: int) -> wp.vec3d:
    if i < 4:
        return x[body_a, i]
    if body_b < 0:
        return wp.vec3d()
    return x[body_b, i - 4]


@wp.func
def _add(x: wp.array2d(dtype=wp.vec3d), i: int, body_a: int, body_b: int, value: wp.vec3d):
    if i < 4:
        wp.atomic_add(x, body_a, i, value)
    elif body_b >= 0:
        wp.atomic_add(x, body_b, i - 4, value)


@wp.kernel
def _pull_back(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    law: FrictionLaw,
    position: wp.array(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
    adjoint: wp.array2d(dtype=wp.vec3d),
    # Out
    recorded: wp.array2d(dtype=wp.vec3d),
    reference: wp.array2d(dtype=wp.vec3d),
    by_d_hat: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    epsilon = law.epsilon[0]
    d = contact.distance
    if d >= d_hat:
        return
    zero = wp.float64(0.0)
    a = contact.body_a
    b = contact.body_b
    n = contact.normal
    c = contact.coefficients
    slope = barrier_slope(d, d_hat, barrier.stiffness[world])
    mu = law.coefficient[world]
    normal_force = -contact.mollifier * slope

    s = wp.vec3d()
    full = wp.vec3d()
    for i in range(8):
        s += c[i] * _body_vector(adjoint, i, a, b)
        full += c[i] * (_body_vector(q, i, a, b) - _body_vector(law.reference, i, a, b))
    u = full - wp.dot(n, full) * n
    y = wp.length(u)
    direction = u / wp.max(y, wp.float64(1.0e-300))
    # k = f0'/y and y k'
    k, radial = mobilisation(y, epsilon)
    su = wp.dot(s, u)
    strength = mu * normal_force
    bar_u = strength * (radial * wp.dot(s, direction) * direction + k * s)
    bar_s = strength * k * u
    bar_force = mu * k * su
    bar_full = bar_u - wp.dot(n, bar_u) * n
    bar_n = -(wp.dot(n, full) * bar_u + wp.dot(n, bar_u) * full)
    bar_r = (bar_n - wp.dot(n, bar_n) * n) / d

    # Closest-point parameters: directly through c, and through r.
    beta1 = wp.dot(bar_r, contact.e1)
    beta2 = wp.dot(bar_r, contact.e2)
    for i in range(8):
        bar_c = wp.dot(bar_s, _body_vector(adjoint, i, a, b)) + wp.dot(
            bar_full, _body_vector(q, i, a, b) - _body_vector(law.reference, i, a, b)
        )
        beta1 += contact.h1[i] * bar_c
        beta2 += contact.h2[i] * bar_c
    e11 = wp.dot(contact.e1, contact.e1)
    e12 = wp.dot(contact.e1, contact.e2)
    e22 = wp.dot(contact.e2, contact.e2)
    solved1 = zero
    solved2 = zero
    if contact.free == 1:
        solved1 = beta1 / e11
    elif contact.free == 2:
        determinant = e11 * e22 - e12 * e12
        if determinant > wp.float64(1.0e-12) * e11 * e22:
            solved1 = (e22 * beta1 - e12 * beta2) / determinant
            solved2 = (e11 * beta2 - e12 * beta1) / determinant
        else:
            solved1 = beta1 / e11

    bar_distance = -bar_force * contact.mollifier * barrier_curvature(d, d_hat, barrier.stiffness[world])
    # The slope depends on d / d_hat alone.
    wp.atomic_add(by_d_hat, world, -bar_distance * d / d_hat)
    bar_cross = -bar_force * slope * mollifier_slope(contact)
    gu = wp.vec3d()
    gv = wp.vec3d()
    if bar_cross != zero:
        gu = bar_cross * cross_gradient_u(contact)
        gv = bar_cross * cross_gradient_v(contact)
    for i in range(8):
        value = c[i] * (bar_r + bar_distance * n)
        value -= solved1 * (contact.h1[i] * d * n + c[i] * contact.e1)
        value -= solved2 * (contact.h2[i] * d * n + c[i] * contact.e2)
        if i > 0 and i < 4:
            value += contact.rest_u[i - 1] * gu
        elif i > 4:
            value += contact.rest_v[i - 5] * gv
        _add(recorded, i, a, b, value)
        _add(reference, i, a, b, -c[i] * bar_full)
