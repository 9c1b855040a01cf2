# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The energy of one artificial time step: the sum of its terms.

E(q) = inertia and gravity + affine stiffness + attachments + barrier contact + lagged friction, all over dt^2
"""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.ccd import safe_step
from pat3d.sim.energies.attachment import PointAttachment
from pat3d.sim.energies.contact import BarrierContact
from pat3d.sim.energies.friction import Friction
from pat3d.sim.energies.inertia import Inertia
from pat3d.sim.energies.orthogonality import Orthogonality
from pat3d.sim.model import GRAVITY, Model

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

SKIN = 5.0e-4
"""Motion that the candidate pairs of the broad phase leave room for [m]."""

LIGHTEST = 1.0e-4
"""Weights are judged as at least this fraction of the heaviest body's, whose contact forces round to more than a
millionth of anything lighter."""


class Potential:
    """Value, gradient and Hessian of the incremental potential of all worlds, and safe steps along it."""

    def __init__(self, model: Model):
        self.model = model
        device = model.device
        self.candidates = Candidates(model)
        self.inertia = Inertia(model)
        self.orthogonality = Orthogonality(model)
        self.attachment = PointAttachment(model)
        self.contact = BarrierContact(model, self.candidates)
        self.friction = Friction(model)
        self._energy = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._gradient = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=device)
        self._hessian = wp.zeros((model.worlds, model.unknowns, model.unknowns), dtype=wp.float64, device=device)
        self._position = wp.zeros(len(model.vertex_rest), dtype=wp.vec3d, device=device)
        self._start = wp.zeros_like(self._position)
        self._end = wp.zeros_like(self._position)
        self._per_world = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._free, self._world = model.is_free, model.world_of
        mass = model.body_mass.numpy()
        weight = np.where(self._free, mass * GRAVITY, 1.0)
        weight = np.maximum(weight, LIGHTEST * model.weight[model.world_of])
        self._force_scale = np.stack([weight, *[weight * model.body_radius] * 3], axis=1)

    @property
    def vertex_positions(self) -> wp.array:
        """Vertex positions of the state evaluated or covered last [m], shape (vertices,), vec3d."""
        return self._position

    def positions(self, q: wp.array, out: wp.array) -> wp.array:
        """Vertex positions [m] at state q, shape (vertices,), vec3d, written to `out`."""
        model = self.model
        wp.launch(
            _positions, dim=len(model.vertex_rest), device=model.device,
            inputs=[model.vertex_rest, model.vertex_body, q], outputs=[out],
        )  # fmt: skip
        return out

    def cover(self, q: wp.array) -> None:
        """Hold every pair within the barrier's reach at state q."""
        position = self.positions(q, self._position)
        self.candidates.cover(position, position, self.contact.d_hat, SKIN)

    def record_friction(self, q: wp.array) -> None:
        """Lag the friction's normal forces and directions at state q."""
        self.cover(q)
        self.friction.record(self.candidates, self._position, self.contact.d_hat, self.contact.stiffness)

    def value(self, q: wp.array) -> NDArray[np.float64]:
        """E [J], shape (worlds,); candidates must cover q."""
        self._energy.zero_()
        position = self.positions(q, self._position)
        self.inertia.add_value(q, self._energy)
        self.orthogonality.add_value(q, self._energy)
        self.attachment.add_value(q, self._energy)
        self.contact.add_value(position, self._energy)
        self.friction.add_value(q, self._energy)
        return self._energy.numpy().copy()

    def gradient(self, q: wp.array, inertia: bool = True) -> wp.array:
        """dE/dq [N, N m], shape (bodies, 4), vec3d; without inertia it is the unbalanced force at rest."""
        self._gradient.zero_()
        position = self.positions(q, self._position)
        sigma = self.inertia.sigma
        if not inertia:
            self.inertia.sigma = wp.zeros_like(sigma)
        self.inertia.add_gradient(q, self._gradient)
        self.inertia.sigma = sigma
        self.orthogonality.add_gradient(q, self._gradient)
        self.attachment.add_gradient(q, self._gradient)
        self.contact.add_gradient(position, self._gradient)
        self.friction.add_gradient(q, self._gradient)
        return self._gradient

    def hessian(self, q: wp.array, exact: bool) -> wp.array:
        """d2E/dq2 or a positive semidefinite stand-in, shape (worlds, unknowns, unknowns)."""
        self._hessian.zero_()
        position = self.positions(q, self._position)
        self.inertia.add_hessian(self._hessian)
        self.orthogonality.add_hessian(q, self._hessian, exact)
        self.attachment.add_hessian(self._hessian)
        self.contact.add_hessian(position, self._hessian, exact)
        self.friction.add_hessian(q, self._hessian)
        return self._hessian

    def residual(self, gradient: wp.array) -> NDArray[np.float64]:
        """Largest unbalanced force or moment of any free body over its weight (times its radius), shape (worlds,)."""
        size = np.linalg.norm(gradient.numpy().reshape(-1, 4, 3), axis=2) / self._force_scale
        result = np.zeros(self.model.worlds)
        np.maximum.at(result, self._world[self._free], size[self._free].max(axis=1))
        return result

    def per_world(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums of values of bodies, shape (bodies,), over every world, shape (worlds,)."""
        return np.bincount(self._world, weights=values, minlength=self.model.worlds).astype(np.float64)

    def motion(self, q: wp.array, q_end: wp.array) -> NDArray[np.float64]:
        """Largest distance of any vertex between two states [m], shape (worlds,)."""
        model = self.model
        start = self.positions(q, self._start)
        end = self.positions(q_end, self._end)
        self._per_world.zero_()
        wp.launch(
            _motion, dim=len(model.vertex_rest), device=model.device,
            inputs=[model.vertex_body, model.body_world, start, end], outputs=[self._per_world],
        )  # fmt: skip
        return self._per_world.numpy().copy()

    def safe_fraction(self, q: wp.array, q_end: wp.array) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """How far every world can go from q to q_end without touching, and its largest vertex motion.

        Afterwards the candidates cover the whole motion.

        Returns:
            Fraction in [0, 1], shape (worlds,), and motion [m], shape (worlds,).
        """
        motion = self.motion(q, q_end)
        self.candidates.cover(self._start, self._end, self.contact.d_hat, SKIN)
        self._per_world.fill_(1.0)
        safe_step(self.model, self.candidates, self._start, self._end, self._per_world)
        return self._per_world.numpy().copy(), motion


@wp.kernel
def _positions(
    # Model
    vertex_rest: wp.array(dtype=wp.vec3d),
    vertex_body: wp.array(dtype=int),
    # State in
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    position: wp.array(dtype=wp.vec3d),
):
    v = wp.tid()
    body = vertex_body[v]
    rest = vertex_rest[v]
    position[v] = q[body, 0] + rest[0] * q[body, 1] + rest[1] * q[body, 2] + rest[2] * q[body, 3]


@wp.kernel
def _motion(
    # Model
    vertex_body: wp.array(dtype=int),
    body_world: wp.array(dtype=int),
    # State in
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    # Out
    motion: wp.array(dtype=wp.float64),
):
    v = wp.tid()
    wp.atomic_max(motion, body_world[vertex_body[v]], wp.length(end[v] - start[v]))
