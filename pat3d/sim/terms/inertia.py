# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Inertia of the artificial time step and gravity.

E(q) = sigma / 2 |q - q_n|^2_M - m g . (p - p_n),   M = diag(m, S) (x) I_3,   sigma = w / dt^2

With w = 1 this is one backward-Euler step from rest, divided by dt^2; w < 1 relaxes the pull to q_n.
Gradients are in newtons (translation) and newton metres (affine part).
"""

from __future__ import annotations

import warp as wp

from pat3d.scene.physics import GRAVITY
from pat3d.sim.model import Model

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

_G = wp.constant(wp.float64(GRAVITY))


class Inertia:
    """Pull towards the state at the start of the step, and gravity."""

    def __init__(self, model: Model):
        self.model = model
        self.start = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        """q_n, shape (bodies, 4), vec3d."""
        self.sigma = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        """w / dt^2 [1/s^2], shape (worlds,)."""

    def _inputs(self) -> list:
        model = self.model
        return [
            model.body_world,
            model.body_dof,
            model.body_mass,
            model.body_moment,
            self.sigma,
            self.start,
        ]

    def add_value(self, q: wp.array, worlds: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """Add E [J] to `energy`, shape (worlds,), and dE/dq to `gradient`, shape (bodies, 4), vec3d."""
        wp.launch(
            _value,
            dim=self.model.bodies,
            device=self.model.device,
            inputs=[*self._inputs(), worlds, q],
            outputs=[energy, gradient],
        )

    def add_hessian(self, worlds: wp.array, hessian: wp.array) -> None:
        """Add d2E/dq2 to the dense `hessian`, shape (worlds, unknowns, unknowns)."""
        wp.launch(
            _hessian,
            dim=self.model.bodies,
            device=self.model.device,
            inputs=[*self._inputs(), worlds],
            outputs=[hessian],
        )


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
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    body_mass: wp.array(dtype=wp.float64),
    body_moment: wp.array(dtype=wp.mat33d),
    # State in
    sigma: wp.array(dtype=wp.float64),
    start: wp.array2d(dtype=wp.vec3d),
    worlds: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    world = body_world[body]
    if body_dof[body] < 0 or worlds[world] == 0:
        return
    s = sigma[world]
    mass = body_mass[body]
    total = mass * _G * (q[body, 0][2] - start[body, 0][2])
    for i in range(4):
        pull = wp.vec3d()
        for j in range(4):
            pull += s * mass_matrix(i, j, mass, body_moment[body]) * (q[body, j] - start[body, j])
        total += wp.float64(0.5) * wp.dot(q[body, i] - start[body, i], pull)
        if i == 0:
            pull += wp.vec3d(wp.float64(0.0), wp.float64(0.0), mass * _G)
        gradient[body, i] = gradient[body, i] + pull
    wp.atomic_add(energy, world, total)


@wp.kernel
def _hessian(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    body_mass: wp.array(dtype=wp.float64),
    body_moment: wp.array(dtype=wp.mat33d),
    # State in
    sigma: wp.array(dtype=wp.float64),
    start: wp.array2d(dtype=wp.vec3d),
    worlds: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    body = wp.tid()
    world = body_world[body]
    if body_dof[body] < 0 or worlds[world] == 0:
        return
    base = 12 * body_dof[body]
    for i in range(4):
        for j in range(4):
            weight = sigma[world] * mass_matrix(i, j, body_mass[body], body_moment[body])
            for k in range(3):
                hessian[world, base + 3 * i + k, base + 3 * j + k] += weight
