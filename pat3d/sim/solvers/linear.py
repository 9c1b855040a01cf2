"""Dense Newton systems, one per world: a Cholesky factorisation each."""

from __future__ import annotations

import numpy as np
import warp as wp
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, eigh, solve

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

        Negative eigenvalues of the Hessian count as positive ones, so the result is a descent direction.

        Args:
            hessian: shape (worlds, unknowns, unknowns), float64.
            gradient: shape (bodies, 4), vec3d.
            active: worlds to solve, shape (worlds,).
        """
        return self._each_world(hessian, -gradient.numpy().reshape(-1, 4, 3), active, _solve_convex)

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


def _solve_convex(matrix: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solution with the eigenvalues of the matrix, scaled to a unit diagonal, made positive.

    Where primitives are aligned (a vertex over a vertex, an edge over an edge) exact Hessians have eigenvalues as
    negative as they are positive: a shift that outweighs them makes every step a hundred times too short, turned
    eigenvalues keep Newton's pace.
    """
    try:
        return cho_solve(cho_factor(matrix, lower=True, check_finite=False), right, check_finite=False)
    except LinAlgError:
        if not np.all(np.isfinite(matrix)):
            raise SimulationError("the simulation produced values that are not finite.") from None
    # Unknowns are translations and (dimensionless) affine entries.
    scale = 1.0 / np.sqrt(np.maximum(np.abs(np.diagonal(matrix)), 1e-300))
    values, vectors = eigh(matrix * np.outer(scale, scale), check_finite=False)
    return scale * (vectors @ ((vectors.T @ (scale * right)) / np.maximum(np.abs(values), 1e-12)))
