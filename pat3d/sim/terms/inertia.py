# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Inertia of the artificial time step and gravity.

E(q) = sigma / 2 |q - q_n|^2_M - m g . (p - p_n),   M = diag(m, S) (x) I_3,   sigma = w / dt^2

With w = 1 this is one backward-Euler step from rest, divided by dt^2; w < 1 relaxes the pull to q_n.
Gradients are in newtons (translation) and newton metres (affine part).
"""

from __future__ import annotations

from collections.abc import Sequence

import warp as wp

from pat3d.scene.physics import GRAVITY
from pat3d.sim.arrays import Bodies, filled
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model
from pat3d.sim.terms.term import Evaluation, Launch

declare_kernels(__name__, most_records=1)

_G = wp.constant(wp.float64(GRAVITY))


@wp.struct
class Step:
    """What a time step pulls with, and where to."""

    mass: wp.array(dtype=wp.float64)
    """[kg], shape (bodies,)."""
    moment: wp.array(dtype=wp.mat33d)
    """Second moment of mass [kg m^2], shape (bodies,)."""
    sigma: wp.array(dtype=wp.float64)
    """w / dt^2 [1/s^2], shape (worlds,)."""
    start: wp.array2d(dtype=wp.vec3d)
    """q_n, shape (bodies, 4)."""


class Inertia:
    """Pull towards the state at the start of the step, and gravity."""

    def __init__(self, model: Model):
        self.model = model
        self.start = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        """q_n, shape (bodies, 4), vec3d."""
        self.sigma = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        """w / dt^2 [1/s^2], shape (worlds,)."""
        self.step, self._rest = (
            filled(Step, mass=model.body_mass, moment=model.body_moment, sigma=sigma, start=self.start)
            for sigma in (self.sigma, wp.zeros_like(self.sigma))
        )
        """`Step`s, for kernels."""

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Those of E, or of gravity alone at rest."""
        inputs = (self.model.body_arrays, self._rest if at.at_rest else self.step, at.active, at.q)
        return [Launch(kernel=_value, dim=self.model.bodies, inputs=inputs, outputs=(energy, gradient))]

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Those of d2E/dq2, which is constant and positive definite."""
        inputs = (self.model.body_arrays, self.step, at.active)
        return [Launch(kernel=_hessian, dim=self.model.bodies, inputs=inputs, outputs=(hessian,))]


@wp.func
def mass_matrix(i: int, j: int, mass: wp.float64, moment: wp.mat33d) -> wp.float64:
    """Entry of diag(m, S) [kg, kg m^2]."""
    if i == 0 or j == 0:
        if i == j:
            return mass
        return wp.float64(0.0)
    return moment[i - 1, j - 1]


@wp.kernel
def _value(
    bodies: Bodies,
    step: Step,
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
    s = step.sigma[world]
    mass = step.mass[body]
    total = mass * _G * (q[body, 0][2] - step.start[body, 0][2])
    for i in range(4):
        pull = wp.vec3d()
        for j in range(4):
            pull += s * mass_matrix(i, j, mass, step.moment[body]) * (q[body, j] - step.start[body, j])
        total += wp.float64(0.5) * wp.dot(q[body, i] - step.start[body, i], pull)
        if i == 0:
            pull += wp.vec3d(wp.float64(0.0), wp.float64(0.0), mass * _G)
        gradient[body, i] = gradient[body, i] + pull
    wp.atomic_add(energy, world, total)


@wp.kernel
def _hessian(
    bodies: Bodies,
    step: Step,
    active: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    body = wp.tid()
    world = bodies.world[body]
    if bodies.dof[body] < 0 or active[world] == 0:
        return
    base = 12 * bodies.dof[body]
    for i in range(4):
        for j in range(4):
            weight = step.sigma[world] * mass_matrix(i, j, step.mass[body], step.moment[body])
            for k in range(3):
                hessian[world, base + 3 * i + k, base + 3 * j + k] += weight
