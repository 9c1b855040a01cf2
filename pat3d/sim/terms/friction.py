# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Lagged smoothed Coulomb friction (Li et al. 2020, IPC, section 5.3).

D(q) = sum mu lambda f0(|u|),   u = (I - n n^T) sum_i c_i (q_i - q_ref_i)

The normal force lambda = -m b'(d), the normal n and the closest points c are those of the state at
which the contacts were last recorded; displacements count from a reference state, the start of the step or an
anchor. f0 is |u| beyond epsilon and a cubic below it, so that f0' = 1 means sliding:

    f0(y)  = y^2 / epsilon - y^3 / (3 epsilon^2) + epsilon / 3,   f0'(y) = 2 y / epsilon - y^2 / epsilon^2
"""

from __future__ import annotations

import warp as wp

from pat3d.sim.contact.barrier import barrier_slope
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.distance import contact_at, vec8d
from pat3d.sim.model import Model
from pat3d.sim.terms.contact import first_unknown, pair_index

wp.set_module_options({"enable_backward": False, "max_unroll": 0})


CAPACITY = 64
"""Contacts that there is room for at first."""


class Friction:
    """Friction of the contacts recorded last."""

    def __init__(self, model: Model):
        self.model = model
        self.scale = wp.zeros(1, dtype=wp.float64, device=model.device)
        """epsilon on the device [m], shape (1,)."""
        self._epsilon = 0.0
        self.epsilon = 1.0e-5
        self.reference = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        """State from which displacements count, shape (bodies, 4), vec3d."""
        self.coefficient = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)
        """mu [-], shape (worlds,)."""
        self.size = wp.zeros(1, dtype=int, device=model.device)
        """Number of contacts, shape (1,), int; kernels over `capacity` threads end at it."""
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
        self.scale.fill_(value)

    @property
    def capacity(self) -> int:
        """Number of contacts there is room for; programs that launch on them must be recorded anew when it changes."""
        return len(self._bodies)

    def _reserve(self, capacity: int) -> None:
        device = self.model.device
        self._bodies = wp.zeros(capacity, dtype=wp.vec2i, device=device)
        self._coefficients = wp.zeros(capacity, dtype=vec8d, device=device)
        self._normal = wp.zeros(capacity, dtype=wp.vec3d, device=device)
        self._force = wp.zeros(capacity, dtype=wp.float64, device=device)

    def launch_record(self, candidates: Candidates, position: wp.array, reach: wp.array, stiffness: wp.array) -> None:
        """Record normals, closest points and normal forces of the contacts at vertex positions [m]; part of a program.

        Where `size` exceeds `capacity` afterwards, not all of them were.
        """
        model = self.model
        self.size.zero_()
        wp.launch(
            _record,
            dim=candidates.capacity,
            device=model.device,
            inputs=[
                model.body_world,
                model.vertex_rest,
                model.vertex_body,
                stiffness,
                reach,
                candidates.size,
                candidates.kind,
                candidates.primitives,
                position,
            ],
            outputs=[self.size, self._bodies, self._coefficients, self._normal, self._force],
        )

    def fits(self, size: int) -> bool:
        """Take note that `size` contacts were found; without room for them, make it and return False."""
        self.count = size
        if size <= self.capacity:
            return True
        self._reserve(2 * size)
        return False

    def _inputs(self, q: wp.array, worlds: wp.array) -> list:
        model = self.model
        return [
            model.body_world,
            model.body_dof,
            self.coefficient,
            self.scale,
            worlds,
            self.size,
            self._bodies,
            self._coefficients,
            self._normal,
            self._force,
            self.reference,
            q,
        ]

    def add_value(self, q: wp.array, worlds: wp.array, energy: wp.array, gradient: wp.array) -> None:
        """Add D [J] to `energy`, shape (worlds,), and dD/dq to `gradient`, shape (bodies, 4), vec3d."""
        wp.launch(
            _value,
            dim=self.capacity,
            device=self.model.device,
            inputs=self._inputs(q, worlds),
            outputs=[energy, gradient],
        )

    def add_hessian(self, q: wp.array, worlds: wp.array, hessian: wp.array) -> None:
        """Add d2D/dq2, which is positive semidefinite, to `hessian`, shape (worlds, unknowns, unknowns)."""
        wp.launch(
            _hessian, dim=self.capacity, device=self.model.device, inputs=self._inputs(q, worlds), outputs=[hessian]
        )

    def largest_slip(self, q: wp.array, worlds: wp.array, slip: wp.array) -> None:
        """Raise `slip` [m], shape (worlds,), to the largest |u| of the contacts that carry force."""
        wp.launch(_slip, dim=self.capacity, device=self.model.device, inputs=self._inputs(q, worlds), outputs=[slip])


@wp.kernel
def _record(
    # Model
    body_world: wp.array(dtype=int),
    vertex_rest: wp.array(dtype=wp.vec3d),
    vertex_body: wp.array(dtype=int),
    stiffness: wp.array(dtype=wp.float64),
    reach: wp.array(dtype=wp.float64),
    # State in
    size: wp.array(dtype=int),
    kind: wp.array(dtype=int),
    primitives: wp.array(dtype=wp.vec4i),
    position: wp.array(dtype=wp.vec3d),
    # Out
    recorded: wp.array(dtype=int),
    bodies: wp.array(dtype=wp.vec2i),
    coefficients: wp.array(dtype=vec8d),
    normal: wp.array(dtype=wp.vec3d),
    force: wp.array(dtype=wp.float64),
):
    pair = wp.tid()
    if pair >= size[0]:
        return
    contact = contact_at(kind[pair], primitives[pair], position, vertex_rest, vertex_body)
    d_hat = reach[0]
    if contact.distance >= d_hat:
        return
    slot = wp.atomic_add(recorded, 0, 1)
    if slot < bodies.shape[0]:
        bodies[slot] = wp.vec2i(contact.body_a, contact.body_b)
        coefficients[slot] = contact.coefficients
        normal[slot] = contact.normal
        force[slot] = -contact.mollifier * barrier_slope(contact.distance, d_hat, stiffness[body_world[contact.body_a]])


@wp.func
def _displacement(
    pair: wp.vec2i,
    c: vec8d,
    n: wp.vec3d,
    reference: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
) -> wp.vec3d:
    u = wp.vec3d()
    for k in range(4):
        u += c[k] * (q[pair[0], k] - reference[pair[0], k])
        if pair[1] >= 0:
            u += c[4 + k] * (q[pair[1], k] - reference[pair[1], k])
    return u - wp.dot(n, u) * n


@wp.kernel
def _value(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    coefficient: wp.array(dtype=wp.float64),
    scale: wp.array(dtype=wp.float64),
    worlds: wp.array(dtype=int),
    # State in
    size: wp.array(dtype=int),
    bodies: wp.array(dtype=wp.vec2i),
    coefficients: wp.array(dtype=vec8d),
    normal: wp.array(dtype=wp.vec3d),
    force: wp.array(dtype=wp.float64),
    reference: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    energy: wp.array(dtype=wp.float64),
    gradient: wp.array2d(dtype=wp.vec3d),
):
    i = wp.tid()
    if i >= size[0]:
        return
    pair = bodies[i]
    world = body_world[pair[0]]
    if worlds[world] == 0:
        return
    epsilon = scale[0]
    u = _displacement(pair, coefficients[i], normal[i], reference, q)
    y = wp.length(u)
    strength = coefficient[world] * force[i]
    value = y
    # f0'(y) / y
    ratio = wp.float64(1.0) / wp.max(y, epsilon)
    if y < epsilon:
        value = y * y / epsilon - y * y * y / (wp.float64(3.0) * epsilon * epsilon) + epsilon / wp.float64(3.0)
        ratio = wp.float64(2.0) / epsilon - y / (epsilon * epsilon)
    wp.atomic_add(energy, world, strength * value)
    drag = strength * ratio * u
    for k in range(4):
        wp.atomic_add(gradient, pair[0], k, coefficients[i][k] * drag)
        if pair[1] >= 0:
            wp.atomic_add(gradient, pair[1], k, coefficients[i][4 + k] * drag)


@wp.kernel
def _hessian(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    coefficient: wp.array(dtype=wp.float64),
    scale: wp.array(dtype=wp.float64),
    worlds: wp.array(dtype=int),
    # State in
    size: wp.array(dtype=int),
    bodies: wp.array(dtype=wp.vec2i),
    coefficients: wp.array(dtype=vec8d),
    normal: wp.array(dtype=wp.vec3d),
    force: wp.array(dtype=wp.float64),
    reference: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    k = wp.tid()
    if k >= size[0]:
        return
    pair = bodies[k]
    world = body_world[pair[0]]
    if worlds[world] == 0:
        return
    epsilon = scale[0]
    n = normal[k]
    c = coefficients[k]
    u = _displacement(pair, c, n, reference, q)
    y = wp.length(u)
    strength = coefficient[world] * force[k]
    # P = f0'/y (I - n n^T) + (f0'' - f0'/y) u u^T / y^2
    ratio = wp.float64(1.0) / wp.max(y, epsilon)
    radial = -ratio
    if y < epsilon:
        ratio = wp.float64(2.0) / epsilon - y / (epsilon * epsilon)
        radial = -y / (epsilon * epsilon)
    direction = u / wp.max(y, wp.float64(1.0e-300))
    identity = wp.identity(n=3, dtype=wp.float64)
    block = strength * (ratio * (identity - wp.outer(n, n)) + radial * wp.outer(direction, direction))
    base_a = first_unknown(pair[0], body_dof)
    base_b = first_unknown(pair[1], body_dof)
    for i in range(8):
        row = pair_index(i, base_a, base_b)
        if row >= 0:
            for j in range(8):
                column = pair_index(j, base_a, base_b)
                if column >= 0:
                    for r in range(3):
                        for s in range(3):
                            wp.atomic_add(hessian, world, row + r, column + s, c[i] * c[j] * block[r, s])


@wp.kernel
def _slip(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    coefficient: wp.array(dtype=wp.float64),
    scale: wp.array(dtype=wp.float64),
    worlds: wp.array(dtype=int),
    # State in
    size: wp.array(dtype=int),
    bodies: wp.array(dtype=wp.vec2i),
    coefficients: wp.array(dtype=vec8d),
    normal: wp.array(dtype=wp.vec3d),
    force: wp.array(dtype=wp.float64),
    reference: wp.array2d(dtype=wp.vec3d),
    q: wp.array2d(dtype=wp.vec3d),
    # Out
    slip: wp.array(dtype=wp.float64),
):
    i = wp.tid()
    if i >= size[0]:
        return
    y = wp.length(_displacement(bodies[i], coefficients[i], normal[i], reference, q))
    wp.atomic_max(slip, body_world[bodies[i][0]], y)
