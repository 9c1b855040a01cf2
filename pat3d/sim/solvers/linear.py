# Kernel signatures and bodies are Warp's language, which a checker of Python misreads.
# pyright: reportInvalidTypeForm=false, reportOperatorIssue=false, reportIndexIssue=false
# pyright: reportCallIssue=false, reportGeneralTypeIssues=false, reportArgumentType=false, reportAssignmentType=false

"""Dense Newton systems, one per world: a Cholesky factorisation each, by LAPACK on a CPU and by torch on a GPU.

Indefinite Hessians are made definite by absolute-eigenvalue filtering (Chen et al. 2024, Stabler Neo-Hookean
Simulation): negative eigenvalues count as positive ones. Where primitives are aligned (a vertex over a vertex, an edge
over an edge) exact Hessians have eigenvalues as negative as they are positive: a shift that outweighs them makes every
step a hundred times too short, absolute eigenvalues keep Newton's pace.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
import warp as wp
from numpy.typing import NDArray
from scipy.linalg import LinAlgError, cho_factor, cho_solve, eigh, solve

from pat3d.errors import SimulationError
from pat3d.sim.arrays import Bodies
from pat3d.sim.kernel_modules import declare_kernels
from pat3d.sim.model import Model

declare_kernels(__name__)

SMALLEST = 1.0e-12
"""Least eigenvalue of a system scaled to a unit diagonal."""


class DenseSolver:
    """Solves H x = b for the free bodies of every active world."""

    def __init__(self, model: Model):
        self.model = model
        shape = (model.worlds, model.unknowns)
        self._right = wp.zeros(shape, dtype=wp.float64, device=model.device)
        self._solution = wp.zeros(shape, dtype=wp.float64, device=model.device)
        self._free = wp.array(model.free_bodies, dtype=int, device=model.device)
        self._uneven = bool(np.any(model.free_bodies * 12 < model.unknowns))
        self.on_gpu = wp.get_device(model.device).is_cuda
        """Whether torch solves the systems, with all worlds at once."""
        self.torch = _import_torch() if self.on_gpu else None
        self.unsolved = wp.zeros(model.worlds, dtype=int, device=model.device)
        """Nonzero for worlds whose Hessian `launch_solve` found not to be positive definite, shape (worlds,), int."""

    def set_right_side(self, hessian: wp.array, gradient: wp.array) -> None:
        """Take b = -gradient, shape (bodies, 4), vec3d, and complete the systems of worlds with fewer free bodies."""
        model = self.model
        wp.launch(
            _gather,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_arrays, gradient],
            outputs=[self._right],
        )
        if self._uneven:
            wp.launch(
                _pad, dim=(model.worlds, model.unknowns), device=model.device, inputs=[self._free], outputs=[hessian]
            )

    def get_solution(self, x: wp.array) -> None:
        """Write the solution to `x`, shape (bodies, 4), vec3d; zero for fixed bodies."""
        model = self.model
        wp.launch(
            _scatter,
            dim=model.bodies,
            device=model.device,
            inputs=[model.body_arrays, self._solution],
            outputs=[x],
        )

    def factorise_and_solve(self, hessian: wp.array, active: NDArray[np.bool_]) -> None:
        """Solve the systems of the active worlds by their absolute eigenvalues.

        Args:
            hessian: shape (worlds, unknowns, unknowns), float64.
            active: worlds to solve, shape (worlds,).

        Raises:
            SimulationError: a system is not finite.
        """
        if self.torch is not None:
            self._solve_some(self.torch, hessian, np.flatnonzero(active), _solve_convex_batch)
            return
        matrices, right, solution = hessian.numpy(), self._right.numpy(), self._solution.numpy()
        for w in np.flatnonzero(active):
            size = 12 * int(self.model.free_bodies[w])
            if size:
                solution[w, :size] = _solve_convex(matrices[w, :size, :size], right[w, :size])

    def solve_symmetric(self, hessian: wp.array, active: NDArray[np.bool_]) -> None:
        """Solve the systems of the active worlds as they are, definite or not; arguments as above."""
        if self.torch is not None:
            self._solve_some(self.torch, hessian, np.flatnonzero(active), _solve_symmetric_batch)
            return
        matrices, right, solution = hessian.numpy(), self._right.numpy(), self._solution.numpy()
        for w in np.flatnonzero(active):
            size = 12 * int(self.model.free_bodies[w])
            if size:
                solution[w, :size] = solve(matrices[w, :size, :size], right[w, :size], assume_a="sym")

    def launch_solve(self, hessian: wp.array) -> None:
        """Solve the systems of all worlds on the GPU, or mark them as unsolved; part of a launch graph."""
        with self._on_stream() as torch:
            matrix, right, solution = (wp.to_torch(x) for x in (hessian, self._right, self._solution))
            factor, info = torch.linalg.cholesky_ex(matrix)
            solution.copy_(torch.cholesky_solve(right[..., None], factor)[..., 0])
            wp.to_torch(self.unsolved).copy_(info)

    def solve_unsolved(self, hessian: wp.array) -> None:
        """Solve the systems that are not positive definite by their absolute eigenvalues."""
        worlds = np.flatnonzero(self.unsolved.numpy())
        self._solve_some(self.torch, hessian, worlds, _solve_absolute_batch)
        self.unsolved.zero_()

    def _solve_some(self, torch: Any, hessian: wp.array, worlds: NDArray[np.int64], solve_batch: Any) -> None:
        with self._on_stream():
            matrix, right, solution = (wp.to_torch(x) for x in (hessian, self._right, self._solution))
            chosen = torch.as_tensor(worlds, device=matrix.device)
            solution[chosen] = solve_batch(torch, matrix[chosen], right[chosen])

    @contextmanager
    def _on_stream(self) -> Iterator[Any]:
        """Torch, working on the stream of Warp."""
        torch: Any = self.torch
        with torch.cuda.stream(wp.stream_to_torch(wp.get_stream(self.model.device))):
            yield torch


def _import_torch() -> Any:
    try:
        import torch
    except ImportError as error:
        raise SimulationError(
            "simulating on a GPU needs torch for its linear systems: pip install 'pat3d[gpu]'."
        ) from error
    return torch


def _solve_convex_batch(torch: Any, matrix: Any, right: Any) -> Any:
    """Batched solution by absolute eigenvalues, shape (worlds, unknowns)."""
    factor, info = torch.linalg.cholesky_ex(matrix)
    x = torch.cholesky_solve(right[..., None], factor)[..., 0]
    if bool(info.any()):
        bad = info.nonzero()[:, 0]
        x[bad] = _solve_absolute_batch(torch, matrix[bad], right[bad])
    return x


def _solve_symmetric_batch(torch: Any, matrix: Any, right: Any) -> Any:
    """Batched solution of symmetric systems, shape (worlds, unknowns)."""
    factor, info = torch.linalg.cholesky_ex(matrix)
    x = torch.cholesky_solve(right[..., None], factor)[..., 0]
    if bool(info.any()):
        bad = info.nonzero()[:, 0]
        x[bad] = torch.linalg.solve(matrix[bad], right[bad])
    return x


def _solve_absolute_batch(torch: Any, matrix: Any, right: Any) -> Any:
    """As `_solve_convex_batch` of matrices that are not positive definite, scaled to a unit diagonal."""
    if not bool(torch.isfinite(matrix).all()):
        raise SimulationError("the simulation produced values that are not finite.")
    scale = torch.diagonal(matrix, dim1=-2, dim2=-1).abs().clamp_min(1e-300).rsqrt()
    values, vectors = torch.linalg.eigh(matrix * scale[:, :, None] * scale[:, None, :])
    x = (vectors.mT @ (scale * right)[..., None]) / values.abs().clamp_min(SMALLEST)[..., None]
    return scale * (vectors @ x)[..., 0]


def _solve_convex(matrix: NDArray[np.float64], right: NDArray[np.float64]) -> NDArray[np.float64]:
    """Solution with the absolute eigenvalues of the matrix scaled to a unit diagonal."""
    try:
        return cho_solve(cho_factor(matrix, lower=True, check_finite=False), right, check_finite=False)
    except LinAlgError:
        if not np.all(np.isfinite(matrix)):
            raise SimulationError("the simulation produced values that are not finite.") from None
    # Unknowns are translations and (dimensionless) affine entries.
    scale = 1.0 / np.sqrt(np.maximum(np.abs(np.diagonal(matrix)), 1e-300))
    values, vectors = eigh(matrix * np.outer(scale, scale), check_finite=False)
    return scale * (vectors @ ((vectors.T @ (scale * right)) / np.maximum(np.abs(values), SMALLEST)))


@wp.kernel
def _gather(
    bodies: Bodies,
    gradient: wp.array2d(dtype=wp.vec3d),
    # Out
    right: wp.array2d(dtype=wp.float64),
):
    body = wp.tid()
    if bodies.dof[body] >= 0:
        for i in range(4):
            for k in range(3):
                right[bodies.world[body], 12 * bodies.dof[body] + 3 * i + k] = -gradient[body, i][k]


@wp.kernel
def _pad(
    free_bodies: wp.array(dtype=int),
    # Out
    hessian: wp.array3d(dtype=wp.float64),
):
    world, i = wp.tid()
    if i >= 12 * free_bodies[world]:
        hessian[world, i, i] = wp.float64(1.0)


@wp.kernel
def _scatter(
    bodies: Bodies,
    solution: wp.array2d(dtype=wp.float64),
    # Out
    x: wp.array2d(dtype=wp.vec3d),
):
    body = wp.tid()
    for i in range(4):
        value = wp.vec3d()
        if bodies.dof[body] >= 0:
            for k in range(3):
                value[k] = solution[bodies.world[body], 12 * bodies.dof[body] + 3 * i + k]
        x[body, i] = value
