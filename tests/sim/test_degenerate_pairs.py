"""Barrier energy of single pairs of primitives, at and a hair beside every degeneracy, against ipctk."""

from types import SimpleNamespace

import ipctk
import numpy as np
import pytest
import warp as wp

from pat3d.sim.arrays import Bodies, filled
from pat3d.sim.contact.distance import EDGE_EDGE, PARALLEL, POINT_TRIANGLE
from pat3d.sim.contact.pairs import Pairs
from pat3d.sim.terms.contact import BarrierContact
from pat3d.sim.terms.term import Evaluation

D_HAT = 2e-2
STIFFNESS = 3.0
GAPS = (1e-9, 1e-6, 1e-3)
HAIRS = (0.0, 1e-12, -1e-12)


def energies(kind: str, points: np.ndarray, exact: bool = True) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Value, gradient by q, shape (n, 24), and Hessian, shape (n, 24, 24); every pair is a world of its own."""
    n = len(points)
    ends = [0, 1, 1, 1] if kind == "pt" else [0, 0, 1, 1]
    body = (2 * np.arange(n)[:, None] + ends).ravel()

    def array(values, dtype=int):
        return wp.array(np.ascontiguousarray(values), dtype=dtype, device="cpu")

    position = array(points.reshape(-1, 3), wp.vec3d)
    vertex_body = array(body.astype(np.int32))
    model = SimpleNamespace(
        device="cpu",
        worlds=n,
        body_arrays=filled(
            Bodies,
            world=array(np.repeat(np.arange(n, dtype=np.int32), 2)),
            dof=array(np.tile(np.array([0, 1], dtype=np.int32), n)),
        ),
    )
    pairs = filled(
        Pairs,
        size=array([n]),
        kind=array(np.full(n, int(POINT_TRIANGLE if kind == "pt" else EDGE_EDGE), dtype=np.int32)),
        vertices=array(np.arange(4 * n, dtype=np.int32).reshape(-1, 4), wp.vec4i),
        # Every affine map is the identity, so rest positions are positions.
        rest=position,
        body=vertex_body,
    )
    contact = BarrierContact(model, SimpleNamespace(pairs=pairs, capacity=n))  # pyright: ignore[reportArgumentType]
    contact.d_hat = D_HAT
    contact.stiffness.fill_(STIFFNESS)
    value = wp.zeros(n, dtype=wp.float64, device="cpu")
    gradient = wp.zeros((2 * n, 4), dtype=wp.vec3d, device="cpu")
    hessian = wp.zeros((n, 24, 24), dtype=wp.float64, device="cpu")
    everywhere = wp.full(n, 1, dtype=int, device="cpu")
    how = wp.full(n, int(exact), dtype=int, device="cpu")
    at = Evaluation(q=position, position=position, active=everywhere)
    for launch in (*contact.value_launches(at, value, gradient), *contact.hessian_launches(at, how, hessian)):
        launch("cpu")
    return value.numpy(), gradient.numpy().reshape(n, 24), hessian.numpy()


def vertices_by_state(kind: str, points: np.ndarray) -> np.ndarray:
    """d(vertices)/dq of one pair, shape (12, 24): x = p + x_1 a_1 + x_2 a_2 + x_3 a_3."""
    jacobian = np.zeros((12, 24))
    for v, body in enumerate([0, 1, 1, 1] if kind == "pt" else [0, 0, 1, 1]):
        for k, coefficient in enumerate((1.0, *points[v])):
            column = 12 * body + 3 * k
            jacobian[3 * v : 3 * v + 3, column : column + 3] = coefficient * np.eye(3)
    return jacobian


def barrier(squared: float) -> tuple[float, float, float]:
    """b, db/dD and d2b/dD2 of the barrier -kappa d_hat (s - 1)^2 ln s by the squared distance D = (s d_hat)^2."""
    s = np.sqrt(squared) / D_HAT
    scale = STIFFNESS * D_HAT
    by_s = -scale * (2 * (s - 1) * np.log(s) + (s - 1) ** 2 / s)
    by_s2 = -scale * (2 * np.log(s) + 4 * (s - 1) / s - (s - 1) ** 2 / s**2)
    s_slope, s_curvature = 1 / (2 * s * D_HAT**2), -1 / (4 * s**3 * D_HAT**4)
    return -scale * (s - 1) ** 2 * np.log(s), by_s * s_slope, by_s2 * s_slope**2 + by_s * s_curvature


def oracles(kind: str, points: np.ndarray) -> list[tuple[tuple, tuple]]:
    """(value, gradient, Hessian) by the state, and the same before mollification, for every closest feature.

    On the border between two features the Hessian jumps, and the value of either side is right.
    """
    call = {"pt": "point_triangle_distance", "ee": "edge_edge_distance"}[kind]
    kinds = {"pt": ipctk.PointTriangleDistanceType, "ee": ipctk.EdgeEdgeDistanceType}[kind].__members__.values()
    closest = getattr(ipctk, call)(*points)
    by_state = vertices_by_state(kind, points)
    results = []
    for feature in kinds:
        # The distance between lines in space is 0/0 for parallel ones.
        cross = ipctk.edge_edge_cross_squarednorm(*points) if kind == "ee" else 1.0
        if feature.name == "AUTO" or (feature.name == "EA_EB" and cross < 1e-20):
            continue
        squared = getattr(ipctk, call)(*points, feature)
        if not abs(squared - closest) <= 1e-7 * closest + 1e-22:
            continue
        gradient = np.array(getattr(ipctk, call + "_gradient")(*points, feature))
        hessian = np.array(getattr(ipctk, call + "_hessian")(*points, feature))
        b, slope, curvature = barrier(closest)
        value, first = b, slope * gradient
        second = curvature * np.outer(gradient, gradient) + slope * hessian
        plain = (value, first @ by_state, by_state.T @ second @ by_state)
        if kind == "ee":
            u, v = points[1] - points[0], points[3] - points[2]
            threshold = float(PARALLEL) * (u @ u) * (v @ v)
            m = ipctk.edge_edge_mollifier(*points, threshold)
            m1 = np.array(ipctk.edge_edge_mollifier_gradient(*points, threshold))
            m2 = np.array(ipctk.edge_edge_mollifier_hessian(*points, threshold))
            second = m * second + np.outer(m1, first) + np.outer(first, m1) + b * m2
            first = m * first + b * m1
            value = m * b
        results.append(((value, first @ by_state, by_state.T @ second @ by_state), plain))
    return results


def point_triangle_cases() -> np.ndarray:
    """Points over corners, edges and the inside of a triangle, a hair beside them, and beside its plane."""
    a, b, c = np.array([[0.0, 0, 0], [0.1, 0, 0], [0.02, 0.08, 0]])
    feet = [a, b, c, (a + b) / 2, (b + c) / 2, (a + c) / 2, (a + b + c) / 3]
    lifts = np.array([[0.0, 0, 1], [0.6, 0, 0.8], [-0.6, -0.64, 0.48]])
    return np.array(
        [
            [foot + gap * lift + [hair, -hair, 0], a, b, c]
            for foot in feet
            for lift in lifts
            for gap in GAPS
            for hair in HAIRS
        ]
    )


def edge_edge_cases() -> np.ndarray:
    """Edges that cross, share an end, are parallel, collinear or nearly so."""
    u = np.array([0.1, 0, 0])
    # Of the mollifier's threshold, crosses of 1e-3 are a tenth and of 2.7e-3 three quarters.
    directions = [u, -u, 0.3 * u, [0, 0.1, 0], [0.1, 1e-3, 0], [0.1, 2.7e-3, 0], [0.1, 0, 1e-3], [0.05, 0.05, 0]]
    starts = [[0, 0], [0.05, 0], [0.1, 0]]
    return np.array(
        [
            [np.zeros(3), u, start, start + direction + [0, hair, hair]]
            for gap in GAPS
            for x, y in starts
            for start in (np.array([x, y, gap]),)
            for direction in np.array(directions)
            for hair in HAIRS
        ]
    )


@pytest.mark.parametrize(("kind", "cases"), [("pt", point_triangle_cases()), ("ee", edge_edge_cases())])
def test_degenerate_pairs_have_ipctk_energies_gradients_and_hessians(kind, cases):
    turn = np.linalg.qr(np.random.default_rng(0).normal(size=(3, 3)))[0]
    cases = cases @ turn.T
    values, gradients, hessians = energies(kind, cases)
    assert np.isfinite(values).all()
    assert np.isfinite(gradients).all()
    assert np.isfinite(hessians).all()
    compared = 0
    for points, value, gradient, hessian in zip(cases, values, gradients, hessians, strict=True):
        options = oracles(kind, points)
        distance = np.sqrt({"pt": ipctk.point_triangle_distance, "ee": ipctk.edge_edge_distance}[kind](*points))
        if distance >= D_HAT or not options:
            continue
        compared += 1
        # Positions of order 0.1 round to 1e-17, which is this much of the distance; curvature doubles it. The
        # mollifier of nearly parallel edges cancels in its own rounding, 1e-16 over the threshold of 1e-3.
        rounding = 1e-9 + 3e-15 / distance
        errors = [
            max(
                np.abs(x - e).max() / (rounding * np.abs(e).max() + 1e-12 * np.abs(p).max())
                for x, e, p in zip((value, gradient, hessian), map(np.asarray, expected), plain, strict=True)
            )
            for expected, plain in options
        ]
        assert min(errors) < 1, (points.tolist(), distance, errors)
    assert compared > 0.9 * len(cases)


@pytest.mark.parametrize("sine", [0.005, 0.02, 0.5])
def test_the_gauss_newton_hessian_is_the_curvature_along_the_distance(sine):
    """It is m b'' grad d grad d^T by the state; the mollifier weighs the edges with little, more, or nothing."""
    u, v = np.array([0.1, 0, 0]), 0.1 * np.array([np.sqrt(1 - sine**2), sine, 0])
    start = np.array([0.0, 0, 4e-3])
    points = np.array([-0.5 * u, 0.5 * u, start - 0.5 * v, start + 0.5 * v])
    by_state = vertices_by_state("ee", points)
    squared = ipctk.edge_edge_distance(*points)
    gradient = np.array(ipctk.edge_edge_distance_gradient(*points)) @ by_state / (2 * np.sqrt(squared))
    s = np.sqrt(squared) / D_HAT
    curvature = -STIFFNESS / D_HAT * (2 * np.log(s) + 4 * (s - 1) / s - (s - 1) ** 2 / s**2)
    mollifier = ipctk.edge_edge_mollifier(*points, float(PARALLEL) * 1e-4)
    assert (mollifier < 1) == (sine < 0.03)
    found = energies("ee", points[None], exact=False)[2][0]
    expected = mollifier * curvature * np.outer(gradient, gradient)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-10 * np.abs(expected).max())
