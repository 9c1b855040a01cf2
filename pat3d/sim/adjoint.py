# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""The backward pass through recorded time steps.

A step from q_n to q ends where the gradient F(q, q_n, theta) of its potential vanishes, so by the implicit function
theorem dq/dq_n = -H^-1 dF/dq_n with the exact Hessian H = dF/dq. Backward, with an adjoint l of q:

    H w = l,    l_n = sigma M w - d(w . F_friction)/dq_n,    dL/dtheta -= w . dF/dtheta

(the paper prints the factor of H^-1 inverted; finite differences refute that form). Where friction counts from an
anchor, its share d(w . F)/dq_ref waits until the pass reaches the step at whose start the anchor was set.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.scene.physics import GRAVITY
from pat3d.sim.program import Mirror, Program
from pat3d.sim.recording import Recording, Replay
from pat3d.sim.tape import StepRecord
from pat3d.sim.terms.contact_reach import pull_back_reach
from pat3d.sim.terms.friction_lag import pull_back_lag
from pat3d.sim.terms.inertia import mass_matrix
from pat3d.sim.terms.potential import SKIN

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

_G = wp.constant(wp.float64(GRAVITY))


@dataclass(frozen=True, kw_only=True, eq=False)
class Gradients:
    """Derivatives of a loss."""

    q0: NDArray[np.float64]
    """By the first state, shape (bodies, 4, 3); zero for fixed bodies."""
    friction: NDArray[np.float64]
    """By the coefficient of every world, shape (worlds,)."""
    mass: NDArray[np.float64]
    """By the mass of every body, its second moment in proportion [1/kg], shape (bodies,); zero for fixed bodies."""
    d_hat: float
    """By the barrier activation distance of the drop [1/m]; zero unless asked for."""


def backward(record: Recording, states: wp.array, losses: wp.array, *, d_hat: bool = False) -> Gradients:
    """Gradient of a loss of a recorded run.

    Args:
        record: of the run.
        states: its kept states, shape (kept, bodies, 4), vec3d, on the device of the model.
        losses: derivative of the loss with respect to each, of the same shape.
        d_hat: whether its derivative is wanted.
    """
    pass_ = _Backward(record, states, d_hat)
    pass_.add(losses[len(record.kept) - 1])
    for index in range(len(record.kept) - 2, -1, -1):
        pass_.stretch(index)
        pass_.add(losses[index])
    free = record.model.is_free
    return Gradients(
        q0=np.where(free[:, None, None], pass_.adjoint.numpy().reshape(-1, 4, 3), 0.0),
        friction=pass_.friction.numpy(),
        mass=np.where(free, pass_.mass.numpy(), 0.0),
        d_hat=float(pass_.reach.numpy().sum()),
    )


class _Backward:
    def __init__(self, record: Recording, states: wp.array, d_hat: bool):
        self.record, self.states, self.model, self.with_d_hat = record, states, record.model, d_hat
        self.replay = Replay(record)
        self.potential = self.replay.run.potential
        self.solver = self.replay.run.newton.solver
        model, device = self.model, self.model.device

        def state() -> wp.array:
            return wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=device)

        self.adjoint, self.anchored = state(), state()
        self.friction = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self.mass = wp.zeros(model.bodies, dtype=wp.float64, device=device)
        self.reach = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._end, self._w, self._recorded, self._moved, self._force = state(), state(), state(), state(), state()
        self._lagged, self._energy = wp.zeros_like(self.reach), wp.zeros_like(self.reach)
        self._one = wp.full(model.worlds, 1.0, dtype=wp.float64, device=device)
        self._worlds = wp.zeros((2, model.worlds), dtype=int, device=device)
        """Which worlds were stepped, and which of them anchored friction at the start of the step."""
        self._known = np.zeros((2, model.worlds), dtype=np.int32)
        self._outside = Mirror(wp.zeros(1, dtype=int, device=device))
        self._by_reach = self._by_lag = False
        self._assemble = Program(device, self._launch_assemble)
        self._pull = Program(device, self._launch_pull)

    def add(self, losses: wp.array) -> None:
        """Add derivatives of the loss by a kept state to the adjoint of that state."""
        wp.launch(_add, dim=losses.shape, device=self.model.device, inputs=[losses], outputs=[self.adjoint])

    def stretch(self, index: int) -> None:
        """Pull the adjoint of kept state `index` + 1 back to the one before."""
        first, last = (int(number) for number in self.record.kept[index : index + 2])
        inner = self.replay.stretch(first, last, self.states)
        for k in range(last - 1, first - 1, -1):
            reference = self.replay.reference(k, first, inner, self.states)
            self.step(k, inner[k - first], inner[k + 1 - first], reference)

    def step(self, k: int, start: wp.array, end: wp.array, reference: wp.array) -> None:
        """Pull the adjoint of state k + 1 back to state k and to the friction reference of step k."""
        record, potential = self.record.steps[k], self.potential
        self.replay.prepare(k, start, reference)
        wp.copy(self._end, end)
        worlds = np.stack([record.active, record.active & (record.reference == k)]).astype(np.int32)
        if not np.array_equal(worlds, self._known):
            self._known = worlds
            self._worlds.assign(worlds)
        while True:
            self._assemble.run((potential.candidates.capacity, potential.friction.capacity))
            if not self._outside.read()[0]:
                break
            # Both ends, so that the pairs also cover the state at which friction was recorded.
            potential.candidates.rebuild(potential._start, potential._end, self._longest_reach(record), SKIN)
        self.solver.solve_symmetric(potential._hessian, record.active)
        drop = self.record.options.d_hat
        self._by_reach = self.with_d_hat and record.d_hat == drop
        self._by_lag = self.with_d_hat and record.lag_d_hat == drop
        self._pull.run((potential.candidates.capacity, potential.friction.capacity, self._by_reach, self._by_lag))

    @staticmethod
    def _longest_reach(record: StepRecord) -> float:
        return max(record.d_hat, record.lag_d_hat)

    def _launch_assemble(self) -> None:
        """H at the end of the step and the adjoint as the right side."""
        potential, start, end = self.potential, self.potential._start, self.potential._end
        potential.positions(self.replay.start, start)
        potential.positions(self._end, end)
        self._outside.array.zero_()
        potential.candidates.flag_outside(start, end, self._outside.array)
        potential.assemble(self._end, end, potential.everywhere, self._worlds[0], potential._hessian)
        wp.launch(_negate, dim=self.model.bodies, device=self.model.device, inputs=[self.adjoint], outputs=[self._w])
        self.solver.set_right_side(potential._hessian, self._w)
        self._outside.fetch()

    def _launch_pull(self) -> None:
        """Pull back through inertia, friction's record and reference, and the parameters."""
        model, potential, friction = self.model, self.potential, self.potential.friction
        for buffer in (self._recorded, self._moved, self._lagged):
            buffer.zero_()
        self.solver.get_solution(self._w)
        wp.launch(
            _select,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_world, self._worlds[0]],
            outputs=[self._w],
        )
        if self._by_reach:
            pull_back_reach(model, potential.contact, potential._end, self._w, self.reach)
        pull_back_lag(
            model,
            friction,
            potential.candidates,
            potential._start,
            self.replay.lag_reach,
            potential.contact.stiffness,
            self._end,
            self._w,
            self._recorded,
            self._moved,
            self._lagged,
        )
        if self._by_lag:
            wp.launch(_subtract, dim=model.worlds, device=model.device, inputs=[self._lagged], outputs=[self.reach])
        coefficient, friction.coefficient = friction.coefficient, self._one
        self._force.zero_()
        friction.add_value(self._end, self._worlds[0], self._energy, self._force)
        friction.coefficient = coefficient
        wp.launch(
            _pull,
            dim=model.bodies,
            device=model.device,
            inputs=[
                model.body_world,
                model.body_dof,
                model.body_mass,
                model.body_moment,
                potential.inertia.sigma,
                self._worlds,
                self.replay.start,
                self._end,
                self._w,
                self._recorded,
                self._moved,
                self._force,
            ],
            outputs=[self.adjoint, self.anchored, self.mass, self.friction],
        )


@wp.kernel
def _add(x: wp.array2d(dtype=wp.vec3d), total: wp.array2d(dtype=wp.vec3d)):
    body, i = wp.tid()
    total[body, i] = total[body, i] + x[body, i]


@wp.kernel
def _subtract(x: wp.array(dtype=wp.float64), total: wp.array(dtype=wp.float64)):
    world = wp.tid()
    total[world] = total[world] - x[world]


@wp.kernel
def _negate(x: wp.array2d(dtype=wp.vec3d), y: wp.array2d(dtype=wp.vec3d)):
    body = wp.tid()
    for i in range(4):
        y[body, i] = -x[body, i]


@wp.kernel
def _select(
    body_world: wp.array(dtype=int),
    worlds: wp.array(dtype=int),
    # In and out
    x: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if worlds[body_world[body]] == 0:
        for i in range(4):
            x[body, i] = wp.vec3d()


@wp.kernel
def _pull(
    # Model
    body_world: wp.array(dtype=int),
    body_dof: wp.array(dtype=int),
    body_mass: wp.array(dtype=wp.float64),
    body_moment: wp.array(dtype=wp.mat33d),
    # State in
    sigma: wp.array(dtype=wp.float64),
    worlds: wp.array2d(dtype=int),
    start: wp.array2d(dtype=wp.vec3d),
    end: wp.array2d(dtype=wp.vec3d),
    w: wp.array2d(dtype=wp.vec3d),
    recorded: wp.array2d(dtype=wp.vec3d),
    moved: wp.array2d(dtype=wp.vec3d),
    force: wp.array2d(dtype=wp.vec3d),
    # In and out
    adjoint: wp.array2d(dtype=wp.vec3d),
    anchored: wp.array2d(dtype=wp.vec3d),
    mass: wp.array(dtype=wp.float64),
    friction: wp.array(dtype=wp.float64),
):
    body = wp.tid()
    world = body_world[body]
    stepped = worlds[0, world] != 0 and body_dof[body] >= 0
    power = wp.float64(0.0)
    inertia = wp.float64(0.0)
    for i in range(4):
        pull = wp.vec3d()
        for j in range(4):
            pull += sigma[world] * mass_matrix(i, j, body_mass[body], body_moment[body]) * w[body, j]
        inertia += wp.dot(pull, end[body, i] - start[body, i])
        power += wp.dot(w[body, i], force[body, i])
        waiting = anchored[body, i] - moved[body, i]
        value = -recorded[body, i]
        if stepped:
            value += pull
        else:
            value += adjoint[body, i]
        # The share of the anchor set at this start waits no longer.
        if worlds[1, world] != 0:
            value += waiting
            waiting = wp.vec3d()
        adjoint[body, i] = value
        anchored[body, i] = waiting
    mass[body] = mass[body] - inertia / body_mass[body] - _G * w[body, 0][2]
    wp.atomic_add(friction, world, -power)
