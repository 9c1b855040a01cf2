# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false

"""Projected Newton with a line search that never lets an accepted state intersect.

A straight step of an affine map stretches the body at second order of its rotation, which the stiff
orthogonality energy punishes: steps would be limited to about a hundredth of a radian. The search therefore follows a
curve with the same tangent, A(t) = exp(t [w]) (I + t S) A, where [w] and S are the skew and
symmetric parts of dA A^-1. Safety is checked on the straight segment to each point tried.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import warp as wp
from numpy.typing import NDArray

from pat3d.sim.model import Model
from pat3d.sim.potential import Potential
from pat3d.sim.solvers.linear import DenseSolver

wp.set_module_options({"enable_backward": False, "max_unroll": 0})

BACKTRACKS = 60
SUFFICIENT_DECREASE = 1.0e-4
"""Armijo constant."""

UNRESOLVED = 1.0e-14
"""Decreases below the heaviest body's weight over this height [m] drown in the energy's rounding."""


@dataclass(frozen=True, kw_only=True, eq=False)
class NewtonResult:
    """How the minimisation of every world ended."""

    converged: NDArray[np.bool_]
    """shape (worlds,)."""
    iterations: NDArray[np.int64]
    """shape (worlds,)."""


class Newton:
    """Minimises a potential in place, all active worlds at once."""

    def __init__(self, potential: Potential):
        self.potential = potential
        self.model: Model = potential.model
        self.solver = DenseSolver(self.model)
        device = self.model.device
        self._direction = wp.zeros((self.model.bodies, 4), dtype=wp.vec3d, device=device)
        self._trial = wp.zeros_like(self._direction)
        self._step = wp.zeros(self.model.worlds, dtype=wp.float64, device=device)

    def minimise(
        self,
        q: wp.array,
        active: NDArray[np.bool_],
        *,
        move_tolerance: float,
        residual_tolerance: float = np.inf,
        exact_below: float = 0.0,
        max_iterations: int = 200,
    ) -> NewtonResult:
        """Minimise the potential of the active worlds.

        Args:
            q: state, shape (bodies, 4), vec3d; on return the minimisers.
            active: worlds to minimise, shape (worlds,).
            move_tolerance: converged when a full step moves no vertex further than this [m] ...
            residual_tolerance: ... and no body's unbalanced force exceeds this fraction of its weight.
            exact_below: residual under which the Hessian is exact and progress is judged by the residual, because
                energy differences vanish in rounding there.
            max_iterations: per world.
        """
        potential = self.potential
        running = active.copy()
        stalled = np.zeros_like(active)
        iterations = np.zeros(self.model.worlds, dtype=np.int64)
        potential.cover(q)
        for _ in range(max_iterations):
            gradient = potential.gradient(q)
            residual = potential.residual(gradient)
            exact = bool(np.all(residual[running] < exact_below))
            direction = self.solver.direction(potential.hessian(q, exact), gradient, running)
            slope = potential.per_world(np.einsum("bij,bij->b", gradient.numpy().reshape(-1, 4, 3), direction))
            self._direction.assign(np.ascontiguousarray(direction))
            _, motion = self._try(q, running.astype(np.float64))
            running &= ~((motion < move_tolerance) & (residual < residual_tolerance))
            if not running.any():
                break
            iterations[running] += 1
            failed = self._search(q, slope, residual, running, exact_below)
            stalled |= failed
            running &= ~failed
            q.assign(self._trial)
        return NewtonResult(converged=active & ~running & ~stalled, iterations=iterations)

    def _try(self, q: wp.array, step: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Put the state at `step` along the search curve into `_trial`; returns its safe fraction and motion [m]."""
        self._step.assign(step)
        wp.launch(
            _along_curve, dim=self.model.bodies, device=self.model.device,
            inputs=[self.model.body_world, q, self._direction, self._step], outputs=[self._trial],
        )  # fmt: skip
        return self.potential.safe_fraction(q, self._trial)

    def _search(self, q, slope, residual, running, exact_below) -> NDArray[np.bool_]:
        """Backtrack until every running world decreases, into `_trial`; returns the worlds that cannot."""
        potential = self.potential
        step = running.astype(np.float64)
        before = potential.value(q)
        by_residual = (residual < exact_below) | (-slope < UNRESOLVED * self.model.weight)
        pending = running.copy()
        for _ in range(BACKTRACKS):
            fraction, _ = self._try(q, step)
            unsafe = pending & (fraction < 1.0)
            if unsafe.any():
                step[unsafe] *= 0.95 * fraction[unsafe]
                continue
            accepted = potential.value(self._trial) <= before + SUFFICIENT_DECREASE * step * slope
            if np.any(pending & ~accepted & by_residual):
                accepted |= by_residual & (potential.residual(potential.gradient(self._trial)) < residual)
            pending &= ~accepted
            if not pending.any():
                return pending
            step[pending] *= 0.5
        step[pending] = 0.0
        self._try(q, step)
        return pending


@wp.kernel
def _along_curve(
    # Model
    body_world: wp.array(dtype=int),
    # State in
    q: wp.array2d(dtype=wp.vec3d),
    direction: wp.array2d(dtype=wp.vec3d),
    step: wp.array(dtype=wp.float64),
    # Out
    trial: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    t = step[body_world[body]]
    half = wp.float64(0.5)
    trial[body, 0] = q[body, 0] + t * direction[body, 0]
    a = wp.matrix_from_cols(q[body, 1], q[body, 2], q[body, 3])
    rate = wp.matrix_from_cols(direction[body, 1], direction[body, 2], direction[body, 3]) * wp.inverse(a)
    stretch = half * (rate + wp.transpose(rate))
    w = t * half * wp.vec3d(rate[2, 1] - rate[1, 2], rate[0, 2] - rate[2, 0], rate[1, 0] - rate[0, 1])
    for k in range(3):
        x = q[body, 1 + k]
        y = x + t * (stretch * x)
        # Rodrigues' formula, with the series of its coefficients near zero.
        angle2 = wp.dot(w, w)
        first = wp.float64(1.0) - angle2 / wp.float64(6.0) + angle2 * angle2 / wp.float64(120.0)
        second = half - angle2 / wp.float64(24.0) + angle2 * angle2 / wp.float64(720.0)
        if angle2 > wp.float64(1.0e-4):
            angle = wp.sqrt(angle2)
            first = wp.sin(angle) / angle
            second = (wp.float64(1.0) - wp.cos(angle)) / angle2
        turn = wp.cross(w, y)
        trial[body, 1 + k] = y + first * turn + second * wp.cross(w, turn)
