import ipctk
import numpy as np
import pytest
import warp as wp

from pat3d.sim.contact.distance import PARALLEL, edge_edge, point_triangle

wp.set_module_options({"enable_backward": False, "max_unroll": 0})


@wp.kernel
def _measure(
    kind: int,
    x: wp.array2d(dtype=wp.vec3d),
    distance: wp.array(dtype=wp.float64),
    mollifier: wp.array(dtype=wp.float64),
):
    i = wp.tid()
    if kind == 0:
        contact = point_triangle(x[i, 0], x[i, 1], x[i, 2], x[i, 3], x[i, 0], x[i, 1], x[i, 2], x[i, 3])
        distance[i] = contact.distance
        mollifier[i] = contact.mollifier
    else:
        contact = edge_edge(x[i, 0], x[i, 1], x[i, 2], x[i, 3], x[i, 0], x[i, 1], x[i, 2], x[i, 3])
        distance[i] = contact.distance
        mollifier[i] = contact.mollifier


def measure(kind: str, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    distance = wp.zeros(len(points), dtype=wp.float64, device="cpu")
    mollifier = wp.zeros(len(points), dtype=wp.float64, device="cpu")
    x = wp.array(points, dtype=wp.vec3d, device="cpu")
    wp.launch(_measure, dim=len(points), device="cpu", inputs=[int(kind == "ee"), x, distance, mollifier])
    return distance.numpy(), mollifier.numpy()


def oracle(kind: str, points: np.ndarray) -> np.ndarray:
    function = ipctk.point_triangle_distance if kind == "pt" else ipctk.edge_edge_distance
    return np.sqrt([function(*quad) for quad in points])


@pytest.mark.parametrize("kind", ["pt", "ee"])
def test_random_pairs_have_ipctk_distances(kind):
    points = np.random.default_rng(0).uniform(-1, 1, size=(3000, 4, 3))
    # Both sides round squares of order one: 1e-16 there is 1e-12 at the smallest distances sampled (about 1e-3).
    np.testing.assert_allclose(measure(kind, points)[0], oracle(kind, points), atol=1e-12)


@pytest.mark.parametrize("kind", ["pt", "ee"])
@pytest.mark.parametrize("offset", [0.0, 1e-12, -1e-12])
def test_degenerate_pairs_have_ipctk_distances(kind, offset):
    """Coincident vertices, collinear and parallel edges, points above corners and edges, and hairs beside each."""
    rng = np.random.default_rng(1)
    if kind == "pt":
        a, b, c = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
        feet = [a, b, c, (a + b) / 2, (b + c) / 2, (a + c) / 2, (a + b + c) / 3, 2 * a - b, 2 * b - a]
        points = np.array([[foot + [offset, offset, h], a, b, c] for foot in feet for h in (0.0, 1e-3, 0.5)])
    else:
        u = np.array([1.0, 0, 0])
        starts = [[0, 0.1, 0], [0.5, 0.1, 0], [1, 0.1, 0], [2, 0.1, 0], [-3, 0, 0.1], [0, 0, 1e-3], [1.5, 0, 0]]
        points = np.array(
            [
                [np.zeros(3), u, np.array(s), np.array(s) + scale * u + [0, offset, 0]]
                for s in starts
                for scale in (1, -1, 0.3)
            ]
        )
    points = points @ np.linalg.qr(rng.normal(size=(3, 3)))[0].T
    # At exactly zero distance the square root turns rounding of 1e-16 into 1e-8.
    np.testing.assert_allclose(measure(kind, points)[0], oracle(kind, points), atol=2e-8)


def test_mollifier_is_ipctk_s():
    rng = np.random.default_rng(2)
    points = rng.uniform(-1, 1, size=(200, 4, 3))
    points[:, 3] = points[:, 2] + (points[:, 1] - points[:, 0]) + 0.02 * rng.normal(size=(200, 3))
    u, v = points[:, 1] - points[:, 0], points[:, 3] - points[:, 2]
    threshold = float(PARALLEL) * np.einsum("ij,ij->i", u, u) * np.einsum("ij,ij->i", v, v)
    expected = [ipctk.edge_edge_mollifier(*quad, eps) for quad, eps in zip(points, threshold, strict=True)]
    assert min(expected) < 0.9
    np.testing.assert_allclose(measure("ee", points)[1], expected, rtol=1e-9)
