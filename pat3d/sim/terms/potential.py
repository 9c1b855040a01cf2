# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The energy of one artificial time step: the sum of its terms.

E(q) = inertia and gravity + affine stiffness + attachments + barrier contact + lagged friction, all over dt^2
"""

from __future__ import annotations

from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.scene.physics import GRAVITY
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.model import Model
from pat3d.sim.program import Mirror, Program
from pat3d.sim.terms.attachment import PointAttachment
from pat3d.sim.terms.contact import BarrierContact
from pat3d.sim.terms.friction import Friction
from pat3d.sim.terms.inertia import Inertia
from pat3d.sim.terms.orthogonality import Orthogonality

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

SKIN = 5.0e-4
"""Motion that the candidate pairs of the broad phase leave room for [m]."""

LIGHTEST = 1.0e-4
"""Weights are judged as at least this fraction of the heaviest body's, whose contact forces round to more than a
millionth of anything lighter."""


class Potential:
    """Value, gradient and Hessian of the incremental potential of all worlds, and the pairs that it covers.

    Methods that return nothing only launch kernels and can be part of a `Program`.
    """

    def __init__(self, model: Model):
        self.model = model
        device = model.device
        self.candidates = Candidates(model)
        self.inertia = Inertia(model)
        self.orthogonality = Orthogonality(model)
        self.attachment = PointAttachment(model)
        self.contact = BarrierContact(model, self.candidates)
        self.friction = Friction(model)
        self.everywhere = wp.full(model.worlds, 1, dtype=int, device=device)
        """Selects all worlds, shape (worlds,), int."""
        self._energy = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._gradient = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=device)
        self._hessian = wp.zeros((model.worlds, model.unknowns, model.unknowns), dtype=wp.float64, device=device)
        self._position = wp.zeros(len(model.vertex_rest), dtype=wp.vec3d, device=device)
        self._start = wp.zeros_like(self._position)
        self._end = wp.zeros_like(self._position)
        self._per_world = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._no_inertia = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._counts = Mirror(wp.zeros(2, dtype=int, device=device))
        self._recorded: Any = None
        self._record = Program(device, self._launch_record)
        free, world = model.is_free, model.world_of
        weight = np.maximum(model.body_mass.numpy() * GRAVITY, LIGHTEST * model.weight[world])
        scale = np.stack([weight, *[weight * model.body_radius] * 3], axis=1)
        self._force_scale = wp.array(np.where(free[:, None], scale, np.inf), dtype=wp.float64, device=device)

    @property
    def vertex_positions(self) -> wp.array:
        """Vertex positions of the state evaluated or covered last [m], shape (vertices,), vec3d."""
        return self._position

    def positions(self, q: wp.array, out: wp.array) -> wp.array:
        """Vertex positions [m] at state q, shape (vertices,), vec3d, written to `out`."""
        model = self.model
        wp.launch(
            _positions,
            dim=len(model.vertex_rest),
            device=model.device,
            inputs=[model.vertex_rest, model.vertex_body, q],
            outputs=[out],
        )
        return out

    def cover(self, q: wp.array) -> None:
        """Hold every pair within the barrier's reach at state q."""
        position = self.positions(q, self._position)
        self.candidates.cover(position, position, self.contact.d_hat, SKIN)

    def record_friction(self, q: wp.array) -> None:
        """Lag the friction's normal forces and directions at state q; afterwards the candidates cover it."""
        if q is not self._recorded:
            self._recorded = q
            self._record = Program(self.model.device, self._launch_record)
        while True:
            self._record.run((self.candidates.capacity, self.friction.capacity))
            outside, size = self._counts.read()
            if outside or not self.candidates.built:
                self.candidates.rebuild(self._position, self._position, self.contact.d_hat, SKIN)
            elif self.friction.fits(int(size)):
                return

    def _launch_record(self) -> None:
        position = self.positions(self._recorded, self._position)
        self._counts.array.zero_()
        self.candidates.flag_outside(position, position, self._counts.array)
        self.friction.launch_record(self.candidates, position, self.contact.reach, self.contact.stiffness)
        wp.copy(self._counts.array, self.friction.size, dest_offset=1, count=1)
        self._counts.fetch()

    def evaluate(self, q: wp.array, position: wp.array, worlds: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """E [J], shape (worlds,), and dE/dq [N, N m], shape (bodies, 4), vec3d; candidates must cover q.

        Args:
            q: state, shape (bodies, 4), vec3d.
            position: vertex positions at q [m], shape (vertices,), vec3d.
            worlds: nonzero for those to evaluate, shape (worlds,), int.
            energy: overwritten.
            gradient: overwritten.
        """
        energy.zero_()
        gradient.zero_()
        self.inertia.add_value(q, worlds, energy, gradient)
        self.orthogonality.add_value(q, worlds, energy, gradient)
        self.attachment.add_value(q, worlds, energy, gradient)
        self.contact.add_value(position, worlds, energy, gradient)
        self.friction.add_value(q, worlds, energy, gradient)

    def evaluate_everywhere(self, q: wp.array, position: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """`evaluate` in all worlds."""
        self.evaluate(q, position, self.everywhere, energy, gradient)

    def evaluate_at_rest(self, q: wp.array, position: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """`evaluate` in all worlds without the pull of inertia."""
        sigma, self.inertia.sigma = self.inertia.sigma, self._no_inertia
        self.evaluate_everywhere(q, position, energy, gradient)
        self.inertia.sigma = sigma

    def assemble(self, q: wp.array, position: wp.array, exact: wp.array, worlds: wp.array, hessian: wp.array) -> None:
        """d2E/dq2, or a positive semidefinite stand-in, shape (worlds, unknowns, unknowns).

        Args:
            q: state, shape (bodies, 4), vec3d.
            position: vertex positions at q [m], shape (vertices,), vec3d.
            exact: nonzero for worlds that get the derivative itself, shape (worlds,), int.
            worlds: nonzero for those to assemble, shape (worlds,), int.
            hessian: overwritten.
        """
        hessian.zero_()
        self.inertia.add_hessian(worlds, hessian)
        self.orthogonality.add_hessian(q, exact, worlds, hessian)
        self.attachment.add_hessian(worlds, hessian)
        self.contact.add_hessian(position, exact, worlds, hessian)
        self.friction.add_hessian(q, worlds, hessian)

    def measure_residual(self, gradient: wp.array, residual: wp.array) -> None:
        """Largest unbalanced force or moment of any free body over its weight (times its radius), shape (worlds,)."""
        residual.zero_()
        wp.launch(
            _residual,
            dim=self.model.bodies,
            device=self.model.device,
            inputs=[self.model.body_world, self._force_scale, gradient],
            outputs=[residual],
        )

    def measure_motion(self, start: wp.array, end: wp.array, motion: wp.array) -> None:
        """Largest distance between two positions [m] of any vertex, shape (worlds,)."""
        motion.zero_()
        wp.launch(
            _motion,
            dim=len(self.model.vertex_rest),
            device=self.model.device,
            inputs=[self.model.vertex_body, self.model.body_world, start, end],
            outputs=[motion],
        )

    def value(self, q: wp.array) -> NDArray[np.float64]:
        """E [J], shape (worlds,); candidates must cover q."""
        self.evaluate_everywhere(q, self.positions(q, self._position), self._energy, self._gradient)
        return self._energy.numpy().copy()

    def gradient(self, q: wp.array, inertia: bool = True) -> wp.array:
        """dE/dq [N, N m], shape (bodies, 4), vec3d; without inertia it is the unbalanced force at rest."""
        evaluate = self.evaluate_everywhere if inertia else self.evaluate_at_rest
        evaluate(q, self.positions(q, self._position), self._energy, self._gradient)
        return self._gradient

    def hessian(self, q: wp.array, exact: bool) -> wp.array:
        """d2E/dq2 or a positive semidefinite stand-in, shape (worlds, unknowns, unknowns)."""
        how = wp.full(self.model.worlds, int(exact), dtype=int, device=self.model.device)
        self.assemble(q, self.positions(q, self._position), how, self.everywhere, self._hessian)
        return self._hessian

    def residual(self, gradient: wp.array) -> NDArray[np.float64]:
        """`measure_residual` on the host, shape (worlds,)."""
        self.measure_residual(gradient, self._per_world)
        return self._per_world.numpy().copy()

    def per_world(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Sums of values of bodies, shape (bodies,), over every world, shape (worlds,)."""
        return np.bincount(self.model.world_of, weights=values, minlength=self.model.worlds).astype(np.float64)

    def motion(self, q: wp.array, q_end: wp.array) -> NDArray[np.float64]:
        """Largest distance of any vertex between two states [m], shape (worlds,)."""
        self.measure_motion(self.positions(q, self._start), self.positions(q_end, self._end), self._per_world)
        return self._per_world.numpy().copy()


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


@wp.kernel
def _residual(
    # Model
    body_world: wp.array(dtype=int),
    force_scale: wp.array2d(dtype=wp.float64),
    # State in
    gradient: wp.array2d(dtype=wp.vec3d),
    # Out
    residual: wp.array(dtype=wp.float64),
):
    body = wp.tid()
    for i in range(4):
        wp.atomic_max(residual, body_world[body], wp.length(gradient[body, i]) / force_scale[body, i])
