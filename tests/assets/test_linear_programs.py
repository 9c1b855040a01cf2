"""Small linear programs against HiGHS, and those without a minimum."""

import numpy as np
import pytest
from scipy.optimize import linprog

from pat3d.assets.mesh.linear_programs import minima


def _unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


@pytest.mark.parametrize("planes", [3, 6, 14])
def test_minima_are_those_of_highs(planes):
    """Half-spaces above random planes; the objective is a combination of their normals, so it is bounded below."""
    rng = np.random.default_rng(planes)
    normals = rng.normal(size=(60, planes, 3))
    normals[:, :, 2] = np.abs(normals[:, :, 2]) + 0.1
    normals = _unit(normals)
    offsets = -rng.uniform(-0.5, 0.5, size=(60, planes))
    objectives = np.einsum("pki,pk->pi", normals, rng.uniform(0.1, 1.0, size=(60, planes)))
    found, good = minima(normals, offsets, objectives)
    assert good.all()
    assert (np.einsum("pki,pi->pk", normals, found) + offsets).min() >= -1e-11
    for k in range(60):
        oracle = linprog(objectives[k], A_ub=-normals[k], b_ub=offsets[k], bounds=[(None, None)] * 3)
        assert objectives[k] @ found[k] == pytest.approx(oracle.fun, abs=1e-8)


def test_opposite_planes_hold_the_point_and_rows_of_zeros_do_nothing():
    normals = np.array([[[0, 0, 1], [0, 0, -1], [1, 0, 1], [-1, 0, 1], [0, 1, 0], [0, 0, 0]]], dtype=float)
    offsets = np.array([[-0.25, 0.25, 0.5, 0.5, 0.125, 0.0]])
    found, good = minima(normals, offsets, np.array([[1.0, 1.0, 0.0]]))
    assert good.all()
    np.testing.assert_allclose(found, [[-0.75, -0.125, 0.25]], atol=1e-12)


def test_no_minimum_is_told():
    """Nothing is above z = 0.5 and below z = 0.25; nothing keeps x from falling."""
    below = [[[0, 0, 1], [0, 0, -1], [1, 0, 0], [0, 1, 0]], [[0, 0, 1], [0, 1, 0], [0, -1, 0], [0, 0, 0]]]
    offsets = np.array([[-0.5, 0.25, 0.0, 0.0], [0.0, 0.5, 0.5, 0.0]])
    _, good = minima(np.array(below, dtype=float), offsets, np.array([[0.3, 0.3, 1.0], [1.0, 0.2, 0.3]]))
    assert not good.any()
