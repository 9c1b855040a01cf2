# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Points of two bodies held together: ropes, hooks, strings.

P(q) = k / 2 |x_a - x_b|^2,   x = p + xbar_1 a_1 + xbar_2 a_2 + xbar_3 a_3

Points are linear in q, so P is quadratic, its Hessian k c c^T (x) I_3 constant and positive semidefinite, with c the
eight coefficients (1, xbar_a, -1, -xbar_b).
"""

from __future__ import annotations

import warp as wp

from pat3d.sim.model import Model
from pat3d.sim.terms.contact import first_unknown, pair_index

wp.set_module_options({"enable_backward": False, "max_unroll": 0})


class PointAttachment:
    """Stiff springs of no length between the anchors of attached bodies."""

    def __init__(self, model: Model):
        self.model = model

    def _inputs(self, worlds: wp.array) -> list:
        model = self.model
        return [
            model.body_world,
            model.body_dof,
            worlds,
            model.anchor_bodies,
            model.anchor_rest,
            model.anchor_stiffness,
        ]

    def add_value(self, q: wp.array, worlds: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """Add P [J] to `energy`, shape (worlds,), and dP/dq to `gradient`, shape (bodies, 4), vec3d."""
        wp.launch(
            _value,
            dim=len(self.model.anchor_bodies),
            device=self.model.device,
            inputs=[*self._inputs(worlds), q],
            outputs=[energy, gradient],
        )

    def add_hessian(self, worlds: wp.array, hessian: wp.array) -> None:
        """Add d2P/dq2 to the dense `hessian`, shape (worlds, unknowns, unknowns)."""
        wp.launch(
            _hessian,
            dim=len(self.model.anchor_bodies),
            device=self.model.device,
            inputs=self._inputs(worlds),
            outputs=[hessian],
        )


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
def _offset(bodies: wp.vec2i, rest_a: wp.vec3d, rest_b: wp.vec3d, q: wp.array2d(dtype=wp.vec3d)) -> wp.vec3d:
    """x_a - x_b [m]."""
    offset = q[bodies[0], 0] - q[bodies[1], 0]
    for j in range(3):
        offset += rest_a[j] * q[bodies[0], 1 + j] - rest_b[j] * q[bodies[1], 1 + j]
    return offset


@wp.kernel
def _value(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    worlds: wp.array(dtype=int),
    anchor_bodies: wp.array(dtype=wp.vec2i),
    anchor_rest: wp.array2d(dtype=wp.vec3d),
    stiffness: wp.array(dtype=wp.float64),
    # State in
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    i = wp.tid()
    bodies = anchor_bodies[i]
    world = body_world[bodies[0]]
    if worlds[world] == 0:
        return
    rest_a = anchor_rest[i, 0]
    rest_b = anchor_rest[i, 1]
    offset = _offset(bodies, rest_a, rest_b, q)
    wp.atomic_add(energy, world, wp.float64(0.5) * stiffness[i] * wp.dot(offset, offset))
    for k in range(4):
        wp.atomic_add(gradient, bodies[0], k, _coefficient(k, rest_a, rest_b) * stiffness[i] * offset)
        wp.atomic_add(gradient, bodies[1], k, _coefficient(4 + k, rest_a, rest_b) * stiffness[i] * offset)


@wp.kernel
def _hessian(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    worlds: wp.array(dtype=int),
    anchor_bodies: wp.array(dtype=wp.vec2i),
    anchor_rest: wp.array2d(dtype=wp.vec3d),
    stiffness: wp.array(dtype=wp.float64),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    a = wp.tid()
    bodies = anchor_bodies[a]
    world = body_world[bodies[0]]
    if worlds[world] == 0:
        return
    base_a = first_unknown(bodies[0], body_dof)
    base_b = first_unknown(bodies[1], body_dof)
    rest_a = anchor_rest[a, 0]
    rest_b = anchor_rest[a, 1]
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row >= 0:
            for j in range(8):
                column = pair_index(j, base_a, base_b)
                if column >= 0:
                    weight = stiffness[a] * _coefficient(i, rest_a, rest_b) * _coefficient(j, rest_a, rest_b)
                    for r in range(3):
                        wp.atomic_add(hessian, world, row + r, column + r, weight)
