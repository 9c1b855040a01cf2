# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""How the contact force depends on the barrier's activation distance h.

With F = sum m b' (c (x) n) + b m' d|u x v|^2/dq, and b = h f(d / h), so that b' = f'(d / h):

    dF/dh = sum -m (d / h) b'' (c (x) n) + (b - d b') / h m' d|u x v|^2/dq
"""

from __future__ import annotations

import warp as wp

from pat3d.sim.contact.barrier import barrier_curvature, barrier_slope, barrier_value
from pat3d.sim.contact.distance import contact_at
from pat3d.sim.model import Model
from pat3d.sim.terms.contact import BarrierContact, cross_gradient_u, cross_gradient_v, mollifier_slope

wp.set_module_options({"enable_backward": False, "max_unroll": 0})


def pull_back_reach(
    model: Model, contact: BarrierContact, position: wp.array, adjoint: wp.array, reach: wp.array
) -> None:
    """Add -w . dF/dh to `reach`.

    Args:
        model: the worlds.
        contact: activation distance, stiffness, and candidates that cover the state.
        position: vertex positions of the state [m], shape (vertices,), vec3d.
        adjoint: w, shape (bodies, 4), vec3d.
        reach: shape (worlds,), float64.
    """
    candidates = contact.candidates
    wp.launch(
        _pull_back,
        dim=candidates.capacity,
        device=model.device,
        inputs=[
            model.body_world,
            model.vertex_rest,
            model.vertex_body,
            contact.stiffness,
            contact.reach,
            candidates.size,
            candidates.kind,
            candidates.primitives,
            position,
            adjoint,
        ],
        outputs=[reach],
    )


@wp.kernel
def _pull_back(
    # Model
    body_world: wp.array(dtype=int),
    vertex_rest: wp.array(dtype=wp.vec3d),
    vertex_body: wp.array(dtype=int),
    stiffness: wp.array(dtype=wp.float64),
    activation: wp.array(dtype=wp.float64),
    # State in
    size: wp.array(dtype=int),
    kind: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
    position: wp.array(dtype=wp.vec3d),
    adjoint: wp.array2d(dtype=wp.vec3d),
    # Out
    reach: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= size[0]:
        return
    d_hat = activation[0]
    contact = contact_at(kind[pair], primitives[pair], position, vertex_rest, vertex_body)
    d = contact.distance
    if d >= d_hat:
        return
    a = contact.body_a
    b = contact.body_b
    world = body_world[a]
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
    slope = barrier_slope(d, d_hat, stiffness[world])
    curvature = barrier_curvature(d, d_hat, stiffness[world])
    power = -contact.mollifier * d / d_hat * curvature * wp.dot(contact.normal, along)
    bend = mollifier_slope(contact)
    if bend != wp.float64(0.0):
        turning = wp.dot(cross_gradient_u(contact), turned_u) + wp.dot(cross_gradient_v(contact), turned_v)
        power += (barrier_value(d, d_hat, stiffness[world]) - d * slope) / d_hat * bend * turning
    wp.atomic_add(reach, world, -power)
