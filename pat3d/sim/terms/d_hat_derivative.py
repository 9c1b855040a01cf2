# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The derivative of the contact force with respect to the barrier's activation distance h (d_hat).

With F = sum m b' (c (x) n) + b m' d|u x v|^2/dq, and b = h f(d / h), so that b' = f'(d / h):

    dF/dh = sum -m (d / h) b'' (c (x) n) + (b - d b') / h m' d|u x v|^2/dq
"""

from __future__ import annotations

import warp as wp

from pat3d.sim.arrays import Bodies
from pat3d.sim.contact.barrier import Barrier, barrier_curvature, barrier_slope, barrier_value
from pat3d.sim.contact.pairs import Pairs, contact_at
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.terms.contact import BarrierContact, cross_gradient_u, cross_gradient_v, mollifier_slope

declare_kernels(__name__, most_records=1, gradients=True)


def pull_back_d_hat(contact: BarrierContact, position: wp.array, adjoint: wp.array, d_hat: wp.array) -> None:
    """Add -w . dF/dh to `d_hat`.

    Args:
        contact: activation distance, stiffness, and candidates that cover the state.
        position: vertex positions of the state [m], shape (vertices,), vec3d.
        adjoint: w, shape (bodies, 4), vec3d.
        d_hat: shape (worlds,), float64.
    """
    model, candidates = contact.model, contact.candidates
    wp.launch(
        _pull_back,
        dim=candidates.capacity,
        device=model.device,
        inputs=[model.body_arrays, candidates.pairs, contact.barrier, position, adjoint],
        outputs=[d_hat],
    )


@wp.kernel
def _pull_back(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    position: wp.array(dtype=wp.vec3d),
    adjoint: wp.array2d(dtype=wp.vec3d),
    # Out
    derivative: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    d = contact.distance
    if d >= d_hat:
        return
    a = contact.body_a
    b = contact.body_b
    along = wp.vec3d()
    turned_u = wp.vec3d()
    turned_v = wp.vec3d()
    for i in range(4):
        along += contact.coefficients[i] * adjoint[a, i]
        if i > 0:
            turned_u += contact.rest_u[i - 1] * adjoint[a, i]
        if b >= 0:
            along += contact.coefficients[4 + i] * adjoint[b, i]
            if i > 0:
                turned_v += contact.rest_v[i - 1] * adjoint[b, i]
    slope = barrier_slope(d, d_hat, barrier.stiffness[world])
    curvature = barrier_curvature(d, d_hat, barrier.stiffness[world])
    power = -contact.mollifier * d / d_hat * curvature * wp.dot(contact.normal, along)
    bend = mollifier_slope(contact)
    if bend != wp.float64(0.0):
        turning = wp.dot(cross_gradient_u(contact), turned_u) + wp.dot(cross_gradient_v(contact), turned_v)
        power += (barrier_value(d, d_hat, barrier.stiffness[world]) - d * slope) / d_hat * bend * turning
    wp.atomic_add(derivative, world, -power)
