"""Newton systems against dense linear algebra of another library."""

import numpy as np
import pytest
import torch
import warp as wp
from scipy.linalg import polar

from pat3d.errors import SimulationError
from pat3d.geometry.pose import Pose
from pat3d.sim.model import Model, ModelBuilder
from pat3d.sim.solvers import linear
from tests.sim.builders import add_hull, box_points


def worlds_of(*free_bodies: int) -> Model:
    """Worlds of so many free bodies beside a fixed one."""
    builder = ModelBuilder()
    for count in free_bodies:
        builder.new_world()
        add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 1.0)), fixed=True)
        for i in range(count):
            add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 2.0 + i)))
    return builder.finalize("cpu")


def solved(model: Model, matrices: np.ndarray, gradient: np.ndarray, method: str) -> np.ndarray:
    """Solution of the systems H x = -gradient of all worlds, shape (bodies, 12)."""
    solver = linear.DenseSolver(model)
    hessian = wp.array(matrices, dtype=wp.float64, device="cpu")
    solver.set_right_side(hessian, wp.array(gradient.reshape(-1, 4, 3), dtype=wp.vec3d, device="cpu"))
    getattr(solver, method)(hessian, np.ones(model.worlds, dtype=bool))
    x = wp.zeros((model.bodies, 4), dtype=wp.vec3d, device="cpu")
    solver.get_solution(x)
    return x.numpy().reshape(model.bodies, 12)


def indefinite(size: int, seed: int) -> np.ndarray:
    """A symmetric matrix with eigenvalues of both signs over two decades, in units that differ by a thousand."""
    rng = np.random.default_rng(seed)
    turn = np.linalg.qr(rng.normal(size=(size, size)))[0]
    values = 10 ** rng.uniform(-1, 1, size) * np.where(np.arange(size) % 3 == 0, -1, 1)
    units = 10 ** rng.uniform(-1.5, 1.5, size)
    matrix = units[:, None] * (turn * values @ turn.T) * units
    return 0.5 * (matrix + matrix.T)


def absolute_solution(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """D |D H D|^-1 D b: the matrix absolute value, by the polar decomposition, of H scaled to a unit diagonal."""
    scale = np.diag(np.abs(np.diagonal(matrix)) ** -0.5)
    return scale @ np.linalg.solve(polar(scale @ matrix @ scale)[1], scale @ right)


@pytest.mark.parametrize("seed", range(4))
def test_indefinite_systems_are_solved_by_absolute_eigenvalues(seed):
    model = worlds_of(1, 2)
    matrices = np.zeros((2, 24, 24))
    matrices[0, :12, :12], matrices[1] = indefinite(12, seed), indefinite(24, seed + 10)
    gradient = np.random.default_rng(seed).normal(size=(model.bodies, 12))
    x = solved(model, matrices, gradient, "factorise_and_solve")
    free = np.flatnonzero(model.is_free)
    small, large = (
        absolute_solution(matrices[0, :12, :12], -gradient[free[0]]),
        absolute_solution(matrices[1], -gradient[free[1:]].ravel()),
    )
    np.testing.assert_allclose(x[free[0]], small, rtol=1e-8, atol=1e-10 * np.abs(small).max())
    np.testing.assert_allclose(x[free[1:]].ravel(), large, rtol=1e-8, atol=1e-10 * np.abs(large).max())
    assert np.sum(x * gradient) < 0, "a descent direction"
    assert not x[~model.is_free].any()


def test_the_batched_solver_of_a_gpu_agrees():
    """Two systems are indefinite, one is definite; on torch's CPU."""
    definite = indefinite(12, 5)
    matrices = np.stack([indefinite(12, 3), definite @ definite.T, indefinite(12, 4)])
    right = np.random.default_rng(0).normal(size=(3, 12))
    expected = [absolute_solution(*pair) for pair in zip(matrices, right, strict=True)]
    expected[1] = np.linalg.solve(matrices[1], right[1])
    x = linear._solve_convex_batch(torch, torch.tensor(matrices), torch.tensor(right)).numpy()
    for found, value in zip(x, expected, strict=True):
        np.testing.assert_allclose(found, value, rtol=1e-7, atol=1e-9 * np.abs(value).max())


def test_symmetric_systems_are_solved_as_they_are():
    model = worlds_of(2)
    matrix, gradient = indefinite(24, 1), np.random.default_rng(1).normal(size=(model.bodies, 12))
    x = solved(model, matrix[None], gradient, "solve_symmetric")[model.is_free].ravel()
    np.testing.assert_allclose(matrix @ x, -gradient[model.is_free].ravel(), atol=1e-8)


def test_a_system_that_is_neither_definite_nor_finite_is_refused():
    model = worlds_of(1)
    matrix = -np.eye(12)
    matrix[11, 11] = np.nan
    with pytest.raises(SimulationError, match="not finite"):
        solved(model, matrix[None], np.zeros((model.bodies, 12)), "factorise_and_solve")
