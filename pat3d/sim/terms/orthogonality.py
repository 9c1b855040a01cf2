# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Affine-body stiffness: the energy that keeps an affine map close to a rotation.

Psi(A) = kappa V |A^T A - I|_F^2                                    (Lan et al. 2022, Eq. 8)
dPsi/da_j = 4 kappa V sum_i E_ij a_i,   E = A^T A - I
d2Psi/da_j da_l = 4 kappa V (E_jl I + a_l a_j^T + delta_jl sum_i a_i a_i^T)

Without the first term the Hessian is positive semidefinite; E is of the order of the strain, 1e-6.
"""

from __future__ import annotations

from collections.abc import Sequence

import warp as wp

from pat3d.sim.arrays import Bodies
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model
from pat3d.sim.terms.term import Evaluation, Launch

declare_kernels(__name__, most_records=1)


class Orthogonality:
    """Stiff potential on the linear part of every body's affine map."""

    def __init__(self, model: Model, stiffness: float = 1.0e8):
        self.model = model
        self.stiffness = wp.full(model.worlds, stiffness, dtype=wp.float64, device=model.device)
        """kappa [Pa], shape (worlds,); 100 MPa keeps strains under 1e-5 for household loads."""

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Those of Psi."""
        inputs = (self.model.body_arrays, self.model.body_volume, self.stiffness, at.active, at.q)
        return [Launch(kernel=_value, dim=self.model.bodies, inputs=inputs, outputs=(energy, gradient))]

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Those of d2Psi/dq2 or its positive semidefinite part."""
        inputs = (self.model.body_arrays, self.model.body_volume, self.stiffness, at.active, at.q, exact)
        return [Launch(kernel=_hessian, dim=self.model.bodies, inputs=inputs, outputs=(hessian,))]


@wp.func
def _strain(q: wp.array2d(dtype=wp.vec3d), body: int, i: int, j: int) -> wp.float64:
    value = wp.dot(q[body, 1 + i], q[body, 1 + j])
    if i == j:
        value -= wp.float64(1.0)
    return value


@wp.kernel
def _value(
    bodies: Bodies,
    volume: wp.array(dtype=wp.float64),
    stiffness: wp.array(dtype=wp.float64),
    active: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    world = bodies.world[body]
    if bodies.dof[body] < 0 or active[world] == 0:
        return
    factor = stiffness[world] * volume[body]
    total = wp.float64(0.0)
    for j in range(3):
        force = wp.vec3d()
        for i in range(3):
            strain = _strain(q, body, i, j)
            total += strain * strain
            force += wp.float64(4.0) * factor * strain * q[body, 1 + i]
        gradient[body, 1 + j] = gradient[body, 1 + j] + force
    wp.atomic_add(energy, world, factor * total)


@wp.kernel
def _hessian(
    bodies: Bodies,
    volume: wp.array(dtype=wp.float64),
    stiffness: wp.array(dtype=wp.float64),
    active: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    exact: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    body = wp.tid()
    world = bodies.world[body]
    if bodies.dof[body] < 0 or active[world] == 0:
        return
    base = 12 * bodies.dof[body] + 3
    factor = wp.float64(4.0) * stiffness[world] * volume[body]
    spread = wp.mat33d()
    for i in range(3):
        spread += wp.outer(q[body, 1 + i], q[body, 1 + i])
    for j in range(3):
        for m in range(3):
            block = wp.outer(q[body, 1 + m], q[body, 1 + j])
            if j == m:
                block += spread
            if exact[world] != 0:
                block += _strain(q, body, j, m) * wp.identity(n=3, dtype=wp.float64)
            for r in range(3):
                for s in range(3):
                    hessian[world, base + 3 * j + r, base + 3 * m + s] += factor * block[r, s]
