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

from pat3d.sim.energies.contact_reach import pull_back_reach
from pat3d.sim.energies.friction_lag import pull_back_lag
from pat3d.sim.model import GRAVITY
from pat3d.sim.recording import Recording, Replay


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


def backward(
    record: Recording, states: NDArray[np.float64], losses: NDArray[np.float64], *, d_hat: bool = False
) -> Gradients:
    """Gradient of a loss of a recorded run.

    Args:
        record: of the run.
        states: its kept states, shape (kept, bodies, 4, 3).
        losses: derivative of the loss with respect to each, of the same shape.
        d_hat: whether its derivative is wanted.
    """
    pass_ = _Backward(record, states, d_hat)
    pass_.adjoint += losses[-1]
    for index in range(len(record.kept) - 2, -1, -1):
        pass_.stretch(index)
        pass_.adjoint += losses[index]
    return Gradients(
        q0=np.where(pass_.free, pass_.adjoint, 0.0),
        friction=pass_.friction,
        mass=np.where(record.model.is_free, pass_.mass, 0.0),
        d_hat=float(pass_.reach.numpy().sum()),
    )


class _Backward:
    def __init__(self, record: Recording, states: NDArray[np.float64], d_hat: bool):
        self.record, self.states, self.model, self.with_d_hat = record, states, record.model, d_hat
        self.replay = Replay(record)
        self.potential = self.replay.run.potential
        self.solver = self.replay.run.newton.solver
        model = self.model
        self.world, self.free = model.world_of, model.is_free[:, None, None]
        self.body_mass = model.body_mass.numpy()
        self.mass_matrix = np.zeros((model.bodies, 4, 4))
        self.mass_matrix[:, 0, 0] = self.body_mass
        self.mass_matrix[:, 1:, 1:] = model.body_moment.numpy()
        self.adjoint = np.zeros((model.bodies, 4, 3))
        self.anchored = np.zeros((model.bodies, 4, 3))
        self.friction = np.zeros(model.worlds)
        self.mass = np.zeros(model.bodies)
        self.reach = wp.zeros(model.worlds, dtype=wp.float64, device=model.device)

    def stretch(self, index: int) -> None:
        """Pull the adjoint of kept state `index` + 1 back to the one before."""
        first, last = (int(number) for number in self.record.kept[index : index + 2])
        inner = self.replay.stretch(first, last, self.states)
        for k in range(last - 1, first - 1, -1):
            reference = self.replay.reference(k, first, inner, self.states)
            self.step(k, inner[k - first], inner[k + 1 - first], reference)

    def step(
        self, k: int, start: NDArray[np.float64], end: NDArray[np.float64], reference: NDArray[np.float64]
    ) -> None:
        """Pull the adjoint of state k + 1 back to state k and to the friction reference of step k."""
        record, potential, model = self.record.steps[k], self.potential, self.model
        stepped = record.active[self.world][:, None, None] & self.free
        begun = self.replay.prepare(k, start, reference)
        ended = wp.array(np.ascontiguousarray(end), dtype=wp.vec3d, device=model.device)
        potential.cover(ended)
        hessian = potential.hessian(ended, exact=True)
        w = self.solver.solve(hessian, np.where(stepped, self.adjoint, 0.0), record.active)
        adjoint = wp.array(w, dtype=wp.vec3d, device=model.device)

        pull = record.sigma[self.world][:, None, None] * np.einsum("bij,bjk->bik", self.mass_matrix, w)
        self.parameters(w, pull, end - start, ended)
        if self.with_d_hat and record.d_hat == self.record.options.d_hat:
            pull_back_reach(model, potential.contact, potential.vertex_positions, adjoint, self.reach)

        recorded = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device=model.device)
        moved = wp.zeros_like(recorded)
        lagged = wp.zeros_like(self.reach)
        self.replay.run.set_reach(record.lag_d_hat)
        potential.cover(begun)
        pull_back_lag(
            model, potential.friction, potential.candidates, potential.vertex_positions, record.lag_d_hat,
            potential.contact.stiffness, ended, adjoint, recorded, moved, lagged,
        )  # fmt: skip
        if self.with_d_hat and record.lag_d_hat == self.record.options.d_hat:
            self.reach.assign(self.reach.numpy() - lagged.numpy())
        self.adjoint = np.where(stepped, pull, self.adjoint) - recorded.numpy().reshape(-1, 4, 3)
        self.anchored -= moved.numpy().reshape(-1, 4, 3)
        here = (record.active & (record.reference == k))[self.world][:, None, None]
        self.adjoint += np.where(here, self.anchored, 0.0)
        self.anchored = np.where(here, 0.0, self.anchored)

    def parameters(
        self, w: NDArray[np.float64], pull: NDArray[np.float64], motion: NDArray[np.float64], end: wp.array
    ) -> None:
        """Add -w . dF/dtheta for mass and friction; friction's record must be that of the step."""
        inertia = np.einsum("bij,bij->b", pull, motion) / self.body_mass
        self.mass -= inertia + GRAVITY * w[:, 0, 2]
        friction = self.potential.friction
        friction.coefficient.fill_(1.0)
        force = wp.zeros((self.model.bodies, 4), dtype=wp.vec3d, device=self.model.device)
        friction.add_value(end, self.potential.everywhere, wp.zeros_like(self.reach), force)
        friction.coefficient.assign(self.record.friction)
        power = np.einsum("bij,bij->b", w, force.numpy().reshape(-1, 4, 3))
        self.friction -= np.bincount(self.world, weights=power, minlength=self.model.worlds)
