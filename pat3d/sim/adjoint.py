"""The backward pass through recorded time steps.

A step from q_n to q ends where the gradient F(q, q_n) of its potential vanishes, so by the implicit function theorem
dq/dq_n = -H^-1 dF/dq_n with the exact Hessian H = dF/dq. Backward, with an adjoint l of q:

    H w = l,    l_n = sigma M w - d(w . F_friction)/dq_n

(the paper prints the factor of H^-1 inverted; finite differences refute that form).
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.energies.friction_lag import pull_back_lag
from pat3d.sim.model import Model
from pat3d.sim.potential import Potential
from pat3d.sim.settle import SettleOptions, StepRecord, Tape, barrier_stiffness
from pat3d.sim.solvers.linear import DenseSolver


def backward(
    model: Model, options: SettleOptions, tape: Tape, losses: Mapping[int, NDArray[np.float64]]
) -> NDArray[np.float64]:
    """Gradient of a loss with respect to the first state of a recorded run.

    Args:
        model: the worlds of the run.
        options: settings of the run.
        tape: states and steps of the run.
        losses: derivative of the loss with respect to recorded states by their index, shape (bodies, 4, 3) each.

    Returns:
        Derivative with respect to the first state, shape (bodies, 4, 3); zero for fixed bodies.
    """
    pass_ = _Backward(model, options)
    adjoints = [np.zeros_like(tape.states[0]) for _ in tape.states]
    for index, gradient in losses.items():
        adjoints[index] += gradient
    for k in range(len(tape.steps) - 1, -1, -1):
        pass_.step(tape, k, adjoints)
    return np.where(pass_.free[:, None, None], adjoints[0], 0.0)


class _Backward:
    def __init__(self, model: Model, options: SettleOptions):
        self.model = model
        self.potential = Potential(model)
        self.potential.contact.stiffness.assign(barrier_stiffness(model))
        self.potential.friction.coefficient.fill_(options.friction)
        self.solver = DenseSolver(model)
        self.world, self.free = model.world_of, model.is_free
        mass = np.zeros((model.bodies, 4, 4))
        mass[:, 0, 0] = model.body_mass.numpy()
        mass[:, 1:, 1:] = model.body_moment.numpy()
        self.mass = mass

    def step(self, tape: Tape, k: int, adjoints: list[NDArray[np.float64]]) -> None:
        """Pull the adjoint of state k + 1 back to state k and to the friction reference of step k."""
        record: StepRecord = tape.steps[k]
        potential, model = self.potential, self.model
        stepped = record.active[self.world] & self.free
        incoming = adjoints[k + 1]
        start = self._array(tape.states[k])
        end = self._array(tape.states[k + 1])
        reference = np.stack([tape.states[record.reference[w]][b] for b, w in enumerate(self.world)])
        potential.inertia.start.assign(start)
        potential.inertia.sigma.assign(record.sigma)
        potential.friction.epsilon = record.epsilon
        potential.friction.reference.assign(reference)
        self._reach(record.lag_d_hat)
        potential.record_friction(start)
        self._reach(record.d_hat)
        potential.cover(end)
        hessian = potential.hessian(end, exact=True)
        w = self.solver.solve(hessian, np.where(stepped[:, None, None], incoming, 0.0), record.active)
        adjoints[k] += np.where(stepped[:, None, None], 0.0, incoming)
        sigma = record.sigma[self.world][:, None, None]
        adjoints[k] += sigma * np.einsum("bij,bjk->bik", self.mass, w)

        recorded = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        moved = wp.zeros_like(recorded)
        self._reach(record.lag_d_hat)
        potential.cover(start)
        pull_back_lag(
            model, potential.friction, potential.candidates, potential.vertex_positions, record.lag_d_hat,
            potential.contact.stiffness, end, self._array(w), recorded, moved,
        )  # fmt: skip
        adjoints[k] -= recorded.numpy().reshape(-1, 4, 3)
        share = moved.numpy().reshape(-1, 4, 3)
        for index in np.unique(record.reference):
            members = (record.reference[self.world] == index)[:, None, None]
            adjoints[index] -= np.where(members, share, 0.0)

    def _reach(self, d_hat: float) -> None:
        self.potential.contact.d_hat = d_hat
        self.potential.candidates.invalidate()

    def _array(self, values: NDArray[np.float64]) -> wp.array:
        return wp.array(np.ascontiguousarray(values), dtype=wp.vec3d, device=self.model.device)
