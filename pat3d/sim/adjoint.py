# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""The backward pass through recorded time steps.

A step from q_n to q ends where the gradient F(q, q_n, theta) of its potential vanishes, so by the implicit function
theorem dq/dq_n = -H^-1 dF/dq_n with the exact Hessian H = dF/dq. Backward, with an adjoint l of q:

    H w = l,    l_n = sigma M w - d(w . F_friction)/dq_n,    dL/dtheta -= w . dF/dtheta

(the paper prints the factor of H^-1 inverted; finite differences refute that form). Where friction counts from a
friction anchor, its share d(w . F)/dq_ref waits until the pass reaches the step at whose start the anchor was set.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.scene.physics import GRAVITY
from pat3d.sim.arrays import Bodies
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.launch_graph import LaunchGraph, Mirror
from pat3d.sim.recording import Recording, Replay
from pat3d.sim.terms.d_hat_derivative import pull_back_d_hat
from pat3d.sim.terms.friction_lag import pull_back_lag
from pat3d.sim.terms.inertia import Step, mass_matrix
from pat3d.sim.terms.potential import SKIN
from pat3d.sim.terms.term import Evaluation

declare_kernels(__name__, most_records=1, gradients=True)

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
        d_hat=float(pass_.d_hat.numpy().sum()),
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
        self.d_hat = wp.zeros(model.worlds, dtype=wp.float64, device=device)
        self._end, self._w, self._recorded, self._moved, self._force = state(), state(), state(), state(), state()
        self._lagged, self._energy = wp.zeros_like(self.d_hat), wp.zeros_like(self.d_hat)
        self._active = wp.zeros((2, model.worlds), dtype=int, device=device)
        """Active masks: worlds that were stepped, and those of them that anchored friction at the start of the step."""
        self._known = np.zeros((2, model.worlds), dtype=np.int32)
        self._outside = Mirror(wp.zeros(1, dtype=int, device=device))
        self._by_barrier = self._by_lag = False
        self._assemble = LaunchGraph(device, self._launch_assemble)
        self._pull = LaunchGraph(device, self._launch_pull)

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
        active = np.stack([record.active, record.active & (record.reference == k)]).astype(np.int32)
        if not np.array_equal(active, self._known):
            self._known = active
            self._active.assign(active)
        while True:
            self._assemble.run((potential.candidates.capacity, potential.friction.capacity))
            if not self._outside.read()[0]:
                break
            # Both ends, so that the pairs also cover the state at which friction was recorded.
            potential.candidates.rebuild(potential._start, potential._end, max(record.d_hat, record.lag_d_hat), SKIN)
        self.solver.solve_symmetric(potential._hessian, record.active)
        drop = self.record.options.d_hat
        self._by_barrier = self.with_d_hat and record.d_hat == drop
        self._by_lag = self.with_d_hat and record.lag_d_hat == drop
        self._pull.run((potential.candidates.capacity, potential.friction.capacity, self._by_barrier, self._by_lag))

    def _launch_assemble(self) -> None:
        """H at the end of the step and the adjoint as the right side."""
        potential, start, end = self.potential, self.potential._start, self.potential._end
        potential.positions(self.replay.start, start)
        potential.positions(self._end, end)
        self._outside.array.zero_()
        potential.candidates.flag_outside(start, end, self._outside.array)
        at = Evaluation(q=self._end, position=end, active=self._active[0])
        potential.assemble(at, potential.all_active, potential._hessian)
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
            inputs=[model.body_arrays, self._active[0]],
            outputs=[self._w],
        )
        if self._by_barrier:
            pull_back_d_hat(potential.contact, potential._end, self._w, self.d_hat)
        pull_back_lag(
            friction,
            potential.candidates,
            potential._start,
            self.replay.lag_barrier,
            self._end,
            self._w,
            self._recorded,
            self._moved,
            self._lagged,
        )
        if self._by_lag:
            wp.launch(_subtract, dim=model.worlds, device=model.device, inputs=[self._lagged], outputs=[self.d_hat])
        self._force.zero_()
        at = Evaluation(q=self._end, position=potential._end, active=self._active[0])
        for launch in friction.unit_value_launches(at, self._energy, self._force):
            launch(model.device)
        wp.launch(
            _pull,
            dim=model.bodies,
            device=model.device,
            inputs=[
                model.body_arrays,
                potential.inertia.step,
                self._active,
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
    bodies: Bodies,
    active: wp.array(dtype=int),
    # In and out
    x: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    if active[bodies.world[body]] == 0:
        for i in range(4):
            x[body, i] = wp.vec3d()


@wp.kernel
def _pull(
    bodies: Bodies,
    step: Step,
    active: wp.array2d(dtype=int),
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
    world = bodies.world[body]
    stepped = active[0, world] != 0 and bodies.dof[body] >= 0
    power = wp.float64(0.0)
    inertia = wp.float64(0.0)
    for i in range(4):
        pull = wp.vec3d()
        for j in range(4):
            pull += step.sigma[world] * mass_matrix(i, j, step.mass[body], step.moment[body]) * w[body, j]
        inertia += wp.dot(pull, end[body, i] - step.start[body, i])
        power += wp.dot(w[body, i], force[body, i])
        waiting = anchored[body, i] - moved[body, i]
        value = -recorded[body, i]
        if stepped:
            value += pull
        else:
            value += adjoint[body, i]
        # The share of the anchor set at this start waits no longer.
        if active[1, world] != 0:
            value += waiting
            waiting = wp.vec3d()
        adjoint[body, i] = value
        anchored[body, i] = waiting
    mass[body] = mass[body] - inertia / step.mass[body] - _G * w[body, 0][2]
    wp.atomic_add(friction, world, -power)
