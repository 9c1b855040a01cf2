# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Lagged smoothed Coulomb friction (Li et al. 2020, IPC, section 5.3).

D(q) = sum mu lambda f0(|u|),   u = (I - n n^T) sum_i c_i (q_i - q_ref_i)

The normal force lambda = -m b'(d), the normal n and the closest points c are those of the state at
which the contacts were last recorded; displacements count from a reference state, the start of the step or a friction
anchor. f0 is |u| beyond epsilon and a cubic below it, so that f0' = 1 means sliding:

    f0(y)  = y^2 / epsilon - y^3 / (3 epsilon^2) + epsilon / 3,   f0'(y) = 2 y / epsilon - y^2 / epsilon^2
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import warp as wp

from pat3d.sim.arrays import Bodies, filled
from pat3d.sim.contact.barrier import Barrier, barrier_slope
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.distance import vec8d
from pat3d.sim.contact.pairs import Pairs, contact_at
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model
from pat3d.sim.terms.term import Evaluation, Launch
from pat3d.sim.terms.unknowns import add_block, first_unknown, pair_index

declare_kernels(__name__, most_records=8 * 8 * 9)

CAPACITY = 64
"""Contacts that the buffers hold at first."""


@wp.struct
class FrictionRecord:
    """Contacts as they were recorded last."""

    size: wp.array(dtype=int)
    """Number of contacts, shape (1,); kernels over the capacity of the buffers end at it."""
    bodies: wp.array(dtype=wp.vec2i)
    """The second is -1 for the ground, shape (capacity,)."""
    coefficients: wp.array(dtype=vec8d)
    """c, shape (capacity,)."""
    normal: wp.array(dtype=wp.vec3d)
    """n, shape (capacity,)."""
    force: wp.array(dtype=wp.float64)
    """lambda [N], shape (capacity,)."""


@wp.struct
class FrictionLaw:
    """How contacts resist, and from where displacements count."""

    coefficient: wp.array(dtype=wp.float64)
    """mu [-], shape (worlds,)."""
    epsilon: wp.array(dtype=wp.float64)
    """Displacement at which friction is fully mobilised [m], shape (1,)."""
    reference: wp.array2d(dtype=wp.vec3d)
    """q_ref, shape (bodies, 4)."""


class Friction:
    """Friction of the contacts recorded last."""

    def __init__(self, model: Model):
        self.model = model
        self._epsilon_array = wp.zeros(1, dtype=wp.float64, device=model.device)
        self._epsilon = 0.0
        self.epsilon = 1.0e-5
        self.reference = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        """State from which displacements count, shape (bodies, 4), vec3d."""
        self.coefficient = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        """mu [-], shape (worlds,)."""
        self.law = self._law(self.coefficient)
        """Constants and reference state, for kernels."""
        self._unit_law = self._law(wp.full(model.worlds, 1.0, dtype=wp.float64, device=model.device))
        self.size = wp.zeros(1, dtype=int, device=model.device)
        """Number of contacts, shape (1,), int."""
        self.count = 0
        """`size` on the host."""
        self._reserve(CAPACITY)

    @property
    def epsilon(self) -> float:
        """Displacement at which friction is fully mobilised [m]."""
        return self._epsilon

    @epsilon.setter
    def epsilon(self, value: float) -> None:
        if value == self._epsilon:
            return
        self._epsilon = value
        self._epsilon_array.fill_(value)

    @property
    def capacity(self) -> int:
        """Number of contacts that the buffers hold; launch graphs over them must be recorded anew when it changes."""
        return len(self.record.bodies)

    def _law(self, coefficient: wp.array) -> Any:
        return filled(FrictionLaw, coefficient=coefficient, epsilon=self._epsilon_array, reference=self.reference)

    def _reserve(self, capacity: int) -> None:
        device = self.model.device
        self.record = filled(
            FrictionRecord,
            size=self.size,
            bodies=wp.zeros(capacity, dtype=wp.vec2i, device=device),
            coefficients=wp.zeros(capacity, dtype=vec8d, device=device),
            normal=wp.zeros(capacity, dtype=wp.vec3d, device=device),
            force=wp.zeros(capacity, dtype=wp.float64, device=device),
        )

    def launch_record(self, candidates: Candidates, position: wp.array, barrier: Any) -> None:
        """Record normals, closest points and normal forces of the contacts at vertex positions [m].

        Part of a launch graph. Where `size` exceeds `capacity` afterwards, not all contacts were recorded.
        """
        record = self.record
        self.size.zero_()
        wp.launch(
            _record,
            dim=candidates.capacity,
            device=self.model.device,
            inputs=[self.model.body_arrays, candidates.pairs, barrier, position],
            outputs=[self.size, record.bodies, record.coefficients, record.normal, record.force],
        )

    def fits(self, size: int) -> bool:
        """Take note that `size` contacts were found; where the buffers are too small, grow them and return False."""
        self.count = size
        if size <= self.capacity:
            return True
        self._reserve(2 * size)
        return False

    def value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """Those of D."""
        return [self._launch(_value, self.law, (at.active, at.q), (energy, gradient))]

    def unit_value_launches(self, at: Evaluation, energy: wp.array, gradient: wp.array) -> Sequence[Launch]:
        """As `value_launches` at a coefficient of one, which is the derivative by the coefficient."""
        return [self._launch(_value, self._unit_law, (at.active, at.q), (energy, gradient))]

    def hessian_launches(self, at: Evaluation, exact: wp.array, hessian: wp.array) -> Sequence[Launch]:
        """Those of d2D/dq2, which is positive semidefinite."""
        return [self._launch(_hessian, self.law, (at.active, at.q), (hessian,))]

    def launch_largest_slip(self, q: wp.array, slip: wp.array) -> None:
        """Raise `slip` [m], shape (worlds,), to the largest |u| of the contacts; part of a launch graph."""
        self._launch(_slip, self.law, (q,), (slip,))(self.model.device)

    def _launch(self, kernel: Any, law: Any, more: tuple, outputs: tuple) -> Launch:
        inputs = (self.model.body_arrays, self.record, law, *more)
        return Launch(kernel=kernel, dim=self.capacity, inputs=inputs, outputs=outputs)


@wp.kernel
def _record(
    bodies: Bodies,
    pairs: Pairs,
    barrier: Barrier,
    position: wp.array(dtype=wp.vec3d),
    # Out
    recorded: wp.array(dtype=int),
    pair_bodies: wp.array(dtype=wp.vec2i),
    coefficients: wp.array(dtype=vec8d),
    normal: wp.array(dtype=wp.vec3d),
    force: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= pairs.size[0]:
        return
    world = bodies.world[pairs.body[pairs.vertices[pair][0]]]
    contact = contact_at(pairs.kind[pair], pairs.vertices[pair], position, pairs.rest, pairs.body)
    d_hat = barrier.d_hat[0]
    if contact.distance >= d_hat:
        return
    slot = wp.atomic_add(recorded, 0, 1)
    if slot < pair_bodies.shape[0]:
        pair_bodies[slot] = wp.vec2i(contact.body_a, contact.body_b)
        coefficients[slot] = contact.coefficients
        normal[slot] = contact.normal
        force[slot] = -contact.mollifier * barrier_slope(contact.distance, d_hat, barrier.stiffness[world])


@wp.func
def mobilisation(y: wp.float64, epsilon: wp.float64):
    """f0'(y) / y and f0''(y) - f0'(y) / y [1/m]."""
    if y < epsilon:
        return wp.float64(2.0) / epsilon - y / (epsilon * epsilon), -y / (epsilon * epsilon)
    ratio = wp.float64(1.0) / y
    return ratio, -ratio


@wp.func
def _displacement(
    pair: wp.vec2i,
    c: vec8d,
    n: wp.vec3d,
    reference: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
) -> wp.vec3d:
    """Displacement u of a contact [m]."""
    u = wp.vec3d()
    for k in range(4):
        u += c[k] * (q[pair[0], k] - reference[pair[0], k])
        if pair[1] >= 0:
            u += c[4 + k] * (q[pair[1], k] - reference[pair[1], k])
    return u - wp.dot(n, u) * n


@wp.kernel
def _value(
    bodies: Bodies,
    record: FrictionRecord,
    law: FrictionLaw,
    active: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    i = wp.tid()
    if i >= record.size[0]:
        return
    pair = record.bodies[i]
    world = bodies.world[pair[0]]
    if active[world] == 0:
        return
    epsilon = law.epsilon[0]
    u = _displacement(pair, record.coefficients[i], record.normal[i], law.reference, q)
    y = wp.length(u)
    strength = law.coefficient[world] * record.force[i]
    value = y
    if y < epsilon:
        value = y * y / epsilon - y * y * y / (wp.float64(3.0) * epsilon * epsilon) + epsilon / wp.float64(3.0)
    ratio, _ = mobilisation(y, epsilon)
    wp.atomic_add(energy, world, strength * value)
    drag = strength * ratio * u
    for k in range(4):
        wp.atomic_add(gradient, pair[0], k, record.coefficients[i][k] * drag)
        if pair[1] >= 0:
            wp.atomic_add(gradient, pair[1], k, record.coefficients[i][4 + k] * drag)


@wp.kernel
def _hessian(
    bodies: Bodies,
    record: FrictionRecord,
    law: FrictionLaw,
    active: wp.array(dtype=int),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    k = wp.tid()
    if k >= record.size[0]:
        return
    pair = record.bodies[k]
    world = bodies.world[pair[0]]
    if active[world] == 0:
        return
    epsilon = law.epsilon[0]
    n = record.normal[k]
    c = record.coefficients[k]
    u = _displacement(pair, c, n, law.reference, q)
    y = wp.length(u)
    strength = law.coefficient[world] * record.force[k]
    # P = f0'/y (I - n n^T) + (f0'' - f0'/y) u u^T / y^2
    ratio, radial = mobilisation(y, epsilon)
    direction = u / wp.max(y, wp.float64(1.0e-300))
    identity = wp.identity(n=3, dtype=wp.float64)
    block = strength * (ratio * (identity - wp.outer(n, n)) + radial * wp.outer(direction, direction))
    base_a = first_unknown(pair[0], bodies.dof)
    base_b = first_unknown(pair[1], bodies.dof)
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row >= 0:
            for j in range(8):
                column = pair_index(j, base_a, base_b)
                if column >= 0:
                    add_block(hessian, world, row, column, c[i] * c[j] * block)


@wp.kernel
def _slip(
    bodies: Bodies,
    record: FrictionRecord,
    law: FrictionLaw,
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    slip: wp.array(dtype=wp.float64),
):
    i = wp.tid()
    if i >= record.size[0]:
        return
    pair = record.bodies[i]
    u = _displacement(pair, record.coefficients[i], record.normal[i], law.reference, q)
    wp.atomic_max(slip, bodies.world[pair[0]], wp.length(u))
