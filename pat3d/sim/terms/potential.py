# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""The energy of one artificial time step: the sum of its terms.

E(q) = inertia and gravity + affine stiffness + attachments + barrier contact + lagged friction, all over dt^2
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.scene.physics import GRAVITY
from pat3d.sim.arrays import Bodies, Vertices
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.launch_graph import LaunchGraph, Mirror
from pat3d.sim.model import Model
from pat3d.sim.terms.attachment import PointAttachment
from pat3d.sim.terms.contact import BarrierContact
from pat3d.sim.terms.friction import Friction
from pat3d.sim.terms.inertia import Inertia
from pat3d.sim.terms.orthogonality import Orthogonality
from pat3d.sim.terms.term import Evaluation, Term

declare_kernels(__name__)

SKIN = 5.0e-4
"""Further motion that the candidate pairs of the broad phase stay valid for [m]."""

LIGHTEST = 1.0e-4
"""Weights are judged as at least this fraction of the heaviest body's, whose contact forces round to more than a
millionth of anything lighter."""


class Potential:
    """Value, gradient and Hessian of the incremental potential of all worlds, and the pairs that it covers.

    Methods that return nothing only launch kernels and can be part of a `LaunchGraph`.
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
        self.terms: tuple[Term, ...] = (
            self.inertia,
            self.orthogonality,
            self.attachment,
            self.contact,
            self.friction,
        )
        """What the energy is the sum of; sums are taken in this order."""
        self.all_active = wp.full(model.worlds, 1, dtype=int, device=device)
        """Active mask of all worlds, shape (worlds,), int."""
        self._energy = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._gradient = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=device)
        self._hessian = wp.zeros((model.worlds, model.unknowns, model.unknowns), dtype=wp.float64, device=device)
        self._position = wp.zeros(len(model.vertex_rest), dtype=wp.vec3d, device=device)
        self._start = wp.zeros_like(self._position)
        self._end = wp.zeros_like(self._position)
        self._per_world = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._counts = Mirror(wp.zeros(2, dtype=int, device=device))
        self._recorded: Any = None
        self._record = LaunchGraph(device, self._launch_record)
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
            inputs=[model.vertex_arrays, q],
            outputs=[out],
        )
        return out

    def cover(self, q: wp.array) -> None:
        """Hold every pair that is closer than d_hat at state q."""
        position = self.positions(q, self._position)
        self.candidates.cover(position, position, self.contact.d_hat, SKIN)

    def record_friction(self, q: wp.array) -> None:
        """Lag the friction's normal forces and directions at state q; afterwards the candidates cover it."""
        if q is not self._recorded:
            self._recorded = q
            self._record = LaunchGraph(self.model.device, self._launch_record)
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
        self.friction.launch_record(self.candidates, position, self.contact.barrier)
        wp.copy(self._counts.array, self.friction.size, dest_offset=1, count=1)
        self._counts.fetch()

    def evaluate(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> None:
        """E [J], shape (worlds,), and dE/dq [N, N m], shape (bodies, 4), vec3d, both overwritten.

        The candidates must cover the state.
        """
        energy.zero_()
        gradient.zero_()
        for term in self.terms:
            for launch in term.value_launches(at, energy, gradient):
                launch(self.model.device)

    def assemble(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> None:
        """d2E/dq2, or a positive semidefinite stand-in, shape (worlds, unknowns, unknowns).

        Args:
            at: state and active worlds.
            exact: nonzero for worlds that get the derivative itself, shape (worlds,), int.
            hessian: overwritten.
        """
        hessian.zero_()
        for term in self.terms:
            for launch in term.hessian_launches(at, exact, hessian):
                launch(self.model.device)

    def everywhere(self, q: wp.array, position: wp.array) -> Evaluation:
        """State q, shape (bodies, 4), vec3d, with its vertex positions [m], shape (vertices,), vec3d, in all worlds."""
        return Evaluation(q=q, position=position, active=self.all_active)

    def measure_residual(self, gradient: wp.array, residual: wp.array) -> None:
        """Equilibrium residual of every world, shape (worlds,).

        The largest unbalanced force or moment of any free body over its weight (times its radius).
        """
        residual.zero_()
        wp.launch(
            _residual,
            dim=self.model.bodies,
            device=self.model.device,
            inputs=[self.model.body_arrays, self._force_scale, gradient],
            outputs=[residual],
        )

    def measure_motion(self, start: wp.array, end: wp.array, motion: wp.array) -> None:
        """Largest distance between two positions [m] of any vertex, shape (worlds,)."""
        motion.zero_()
        wp.launch(
            _motion,
            dim=len(self.model.vertex_rest),
            device=self.model.device,
            inputs=[self.model.vertex_arrays, self.model.body_arrays, start, end],
            outputs=[motion],
        )

    def value(self, q: wp.array) -> NDArray[np.float64]:
        """E [J], shape (worlds,); candidates must cover q."""
        at = self.everywhere(q, self.positions(q, self._position))
        self.evaluate(at, self._energy, self._gradient)
        return self._energy.numpy().copy()

    def gradient(self, q: wp.array, inertia: bool = True) -> wp.array:
        """dE/dq [N, N m], shape (bodies, 4), vec3d; without inertia it is the unbalanced force at rest."""
        at = self.everywhere(q, self.positions(q, self._position))
        self.evaluate(replace(at, at_rest=not inertia), self._energy, self._gradient)
        return self._gradient

    def hessian(self, q: wp.array, exact: bool) -> wp.array:
        """d2E/dq2 or a positive semidefinite stand-in, shape (worlds, unknowns, unknowns)."""
        how = wp.full(self.model.worlds, int(exact), dtype=int, device=self.model.device)
        self.assemble(self.everywhere(q, self.positions(q, self._position)), how, self._hessian)
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
    vertices: Vertices,
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    position: wp.array(dtype=wp.vec3d),
):
    v = wp.tid()
    body = vertices.body[v]
    rest = vertices.rest[v]
    position[v] = q[body, 0] + rest[0] * q[body, 1] + rest[1] * q[body, 2] + rest[2] * q[body, 3]


@wp.kernel
def _motion(
    vertices: Vertices,
    bodies: Bodies,
    start: wp.array(dtype=wp.vec3d),
    end: wp.array(dtype=wp.vec3d),
    # Out
    motion: wp.array(dtype=wp.float64),
):
    v = wp.tid()
    wp.atomic_max(motion, bodies.world[vertices.body[v]], wp.length(end[v] - start[v]))


@wp.kernel
def _residual(
    bodies: Bodies,
    force_scale: wp.array2d(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
    # Out
    residual: wp.array(dtype=wp.float64),
):
    body = wp.tid()
    for i in range(4):
        wp.atomic_max(residual, bodies.world[body], wp.length(gradient[body, i]) / force_scale[body, i])
