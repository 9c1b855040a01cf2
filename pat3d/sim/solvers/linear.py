"""Dense Newton systems, one per world: a Cholesky factorisation each."""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, solve

from pat3d.errors import SimulationError
from pat3d.sim.model import Model


class DenseSolver:
    """Solves H d = -g for the free bodies of every active world."""

    def __init__(self, model: Model):
        self.model = model
        world, dof = model.body_world.numpy(), model.body_dof.numpy()
        self._bodies = []
        for w in range(model.worlds):
            members = np.flatnonzero((world == w) & (dof >= 0))
            self._bodies.append(members[np.argsort(dof[members])])

    def direction(self, hessian: wp.array, gradient: wp.array, active: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Newton direction, shape (bodies, 4, 3); zero for fixed bodies and inactive worlds.

        A Hessian that is not positive definite is shifted until it is, so the result is a descent direction.

        Args:
            hessian: shape (worlds, unknowns, unknowns), float64.
            gradient: shape (bodies, 4), vec3d.
            active: worlds to solve, shape (worlds,).
        """
        return self._each_world(hessian, -gradient.numpy().reshape(-1, 4, 3), active, _solve_shifted)

    def solve(self, hessian: wp.array, right: NDArray[np.float64], active: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Solution of H x = right for symmetric H, not necessarily definite; shapes as in `direction`."""
        return self._each_world(hessian, right, active, lambda matrix, vector: solve(matrix, vector, assume_a="sym"))

    def _each_world(self, hessian, vectors, active, solve_one) -> NDArray[np.float64]:
        matrices = hessian.numpy()
        result = np.zeros_like(vectors)
        for w in np.flatnonzero(active):
            bodies = self._bodies[w]
            if len(bodies):
                size = 12 * len(bodies)
                solution = solve_one(matrices[w, :size, :size], vectors[bodies].reshape(-1))
                result[bodies] = solution.reshape(-1, 4, 3)
        return result


def _solve_shifted(matrix: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    diagonal = np.diagonal(matrix)
    # Unknowns are translations and (dimensionless) affine entries, so the shift is relative to each diagonal.
    for shift in (0.0, 1e-8, 1e-6, 1e-4, 1e-2, 1.0, 1e2):
        trial = matrix if shift == 0.0 else matrix + np.diag(shift * np.abs(diagonal))
        try:
            return cho_solve(cho_factor(trial, lower=True, check_finite=False), right, check_finite=False)
        except LinAlgError:
            continue
    if not np.all(np.isfinite(matrix)):
        raise SimulationError("the simulation produced values that are not finite.")
    return right / np.maximum(np.abs(diagonal), 1e-12)
