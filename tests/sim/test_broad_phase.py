"""Candidates against every pair of primitives, by brute force."""

import numpy as np
import pytest
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.distance import EDGE_EDGE, POINT_GROUND, POINT_TRIANGLE
from pat3d.sim.model import Model, ModelBuilder
from tests.sim.builders import add_hull, random_hull
from tests.sim.test_clusters import pair_of_lumps

D_HAT, SKIN = 8e-3, 3e-3


def hulls(seed: int) -> Model:
    """Three hulls and a fixed one close to one another and to the ground."""
    rng = np.random.default_rng(seed)
    builder = ModelBuilder()
    for i, place in enumerate([(0, 0, 0.05), (0.08, 0.01, 0.045), (0.04, 0.02, 0.12), (-0.08, 0, 0.05)]):
        add_hull(builder, random_hull(rng), Pose(position=place), fixed=i == 3)
    return builder.finalize("cpu")


def motion(model: Model, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertex positions at the start and at the end of a motion of a few d_hat."""
    body = model.vertex_body.numpy()
    start = np.einsum("vj,vjk->vk", model.vertex_rest.numpy(), model.q0[body, 1:]) + model.q0[body, 0]
    end = start + np.random.default_rng(seed).uniform(-2, 2, size=(model.bodies, 3))[body] * D_HAT
    return start, np.where(model.is_free[body, None], end, start)


def on_device(*arrays: np.ndarray) -> list[wp.array]:
    return [wp.array(x, dtype=wp.vec3d, device="cpu") for x in arrays]


def held(candidates: Candidates) -> set[tuple[int, ...]]:
    kinds, primitives = candidates.kind.numpy(), candidates.primitives.numpy()
    rows = [
        (int(k), *map(int, p)) for k, p in zip(kinds[: candidates.count], primitives[: candidates.count], strict=True)
    ]
    assert len(set(rows)) == len(rows), "no pair twice"
    return set(rows)


def boxes_of(primitives: np.ndarray, start: np.ndarray, end: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners of the boxes of primitives, shape (n, k), over the motion, each (n, 3)."""
    points = np.concatenate([start[primitives], end[primitives]], axis=1)
    return points.min(axis=1), points.max(axis=1)


def close_boxes(first: np.ndarray, second: np.ndarray, model: Model, start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Rows of pairs of primitives of different bodies, one of them free, whose boxes are at most the margins apart."""
    (low_a, high_a), (low_b, high_b) = boxes_of(first, start, end), boxes_of(second, start, end)
    apart = np.maximum(low_a[:, None] - high_b, low_b - high_a[:, None]).max(axis=-1)
    owner = model.vertex_body.numpy()
    a, b = owner[first[:, 0]], owner[second[:, 0]]
    other = (a[:, None] != b) & (model.is_free[a][:, None] | model.is_free[b])
    return np.argwhere((apart <= D_HAT + 2 * SKIN) & other)


@pytest.mark.parametrize("lanes", [1, 5])
@pytest.mark.parametrize("scene", [hulls(0), hulls(1), pair_of_lumps().finalize("cpu")], ids=["a", "b", "lumps"])
def test_candidates_are_the_pairs_whose_boxes_are_within_d_hat_and_skin(scene, lanes):
    """Half of d_hat and a skin are on either side of a box; the ground has no box, and counts d_hat and a skin."""
    start, end = motion(scene, 0)
    candidates = Candidates(scene)
    # As many threads share a pair on a GPU.
    candidates._boxes.lanes = lanes
    candidates.cover(*on_device(start, end), D_HAT, SKIN)
    triangles, edges = scene.triangles.numpy(), scene.edges.numpy()
    vertices = np.arange(len(start))[:, None]
    expected = {(int(POINT_TRIANGLE), v, *triangles[t]) for v, t in close_boxes(vertices, triangles, scene, start, end)}
    expected |= {
        (int(EDGE_EDGE), *edges[i], *edges[j]) for i, j in close_boxes(edges, edges, scene, start, end) if i < j
    }
    low = np.minimum(start, end)[:, 2] <= D_HAT + SKIN
    free = scene.is_free[scene.vertex_body.numpy()]
    expected |= {(int(POINT_GROUND), int(v), -1, -1, -1) for v in np.flatnonzero(low & free)}
    assert {tuple(map(int, row)) for row in expected} == held(candidates)
    assert len({row[0] for row in expected}) == 3 or scene.bodies == 2


@pytest.mark.parametrize(("share", "outside"), [(0.999, False), (1.001, True)])
@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1, 1])
def test_candidates_hold_until_a_vertex_leaves_the_skin(share, outside, axis, sign):
    """At either end of a later motion, in any direction: whoever is then closer than d_hat was within the margins."""
    model = hulls(2)
    start, _ = motion(model, 0)
    candidates = Candidates(model)
    candidates.cover(*on_device(start, start), D_HAT, SKIN)
    moved = start.copy()
    moved[7, axis] += sign * share * SKIN
    for pair in ((start, moved), (moved, start)):
        flag = wp.zeros(1, dtype=int, device="cpu")
        candidates.flag_outside(*on_device(*pair), flag)
        assert bool(flag.numpy()[0]) == outside
    before = held(candidates)
    candidates.cover(*on_device(start, moved), D_HAT, SKIN)
    assert outside or held(candidates) == before


def test_a_larger_d_hat_asks_for_new_candidates_and_a_smaller_one_does_not():
    model = hulls(3)
    x = on_device(motion(model, 0)[0])[0]
    candidates = Candidates(model)
    candidates.cover(x, x, D_HAT, SKIN)
    few = held(candidates)
    candidates.require(0.5 * D_HAT)
    assert candidates.built
    candidates.require(2 * D_HAT)
    assert not candidates.built
    candidates.cover(x, x, 2 * D_HAT, SKIN)
    assert few < held(candidates)
