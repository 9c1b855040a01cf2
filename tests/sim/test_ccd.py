import ipctk
import numpy as np
import pytest
import warp as wp

from pat3d.geometry.pose import Pose
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.ccd import safe_step
from pat3d.sim.contact.distance import EDGE_EDGE, POINT_TRIANGLE
from pat3d.sim.contact.intersection import intersecting_bodies
from pat3d.sim.model import ModelBuilder
from tests.sim.builders import add_hull, box_points, random_hull


def two_hulls(rng: np.random.Generator):
    """Two apart hulls above the ground and a motion that drives one through the other."""
    builder = ModelBuilder()
    add_hull(builder, random_hull(rng), Pose(position=(0, 0, 0.5)))
    add_hull(builder, random_hull(rng), Pose(position=(0.13, 0.01, 0.51)))
    model = builder.finalize("cpu")
    rest, body = model.vertex_rest.numpy(), model.vertex_body.numpy()
    start = rest + model.q0[body, 0]
    moved = start @ (np.eye(3) + 0.05 * rng.normal(size=(3, 3))) + rng.normal([-0.3, 0, 0], 0.05)
    end = np.where(body[:, None] == 1, moved, start)
    return model, start, end


def impact_by_ipctk(candidates: Candidates, start: np.ndarray, end: np.ndarray) -> float:
    ccd = ipctk.TightInclusionCCD()
    first = 1.0
    kinds, primitives = candidates.kind.numpy(), candidates.primitives.numpy()
    for kind, index in zip(kinds[: candidates.count], primitives[: candidates.count], strict=True):
        call = {int(POINT_TRIANGLE): ccd.point_triangle_ccd, int(EDGE_EDGE): ccd.edge_edge_ccd}[int(kind)]
        hit, time = call(*start[index], *end[index])
        first = min(first, time) if hit else first
    return first


def closest_ratio(candidates: Candidates, start: np.ndarray, reached: np.ndarray) -> float:
    """Smallest distance of any pair over its distance at the start."""
    ratios = []
    kinds, primitives = candidates.kind.numpy(), candidates.primitives.numpy()
    for kind, index in zip(kinds[: candidates.count], primitives[: candidates.count], strict=True):
        distance = {int(POINT_TRIANGLE): ipctk.point_triangle_distance, int(EDGE_EDGE): ipctk.edge_edge_distance}[
            int(kind)
        ]
        ratios.append(np.sqrt(distance(*reached[index]) / distance(*start[index])))
    return min(ratios)


def test_steps_stay_short_of_the_impact_that_tight_inclusion_finds():
    rng = np.random.default_rng(0)
    hits = 0
    for _ in range(40):
        model, start, end = two_hulls(rng)
        x0, x1 = (wp.array(x, dtype=wp.vec3d, device="cpu") for x in (start, end))
        candidates = Candidates(model)
        candidates.cover(x0, x1, 1e-3, 1e-4)
        step = wp.full(1, 1.0, dtype=wp.float64, device="cpu")
        safe_step(model, candidates, x0, x1, step)
        fraction, impact = float(step.numpy()[0]), impact_by_ipctk(candidates, start, end)
        assert fraction <= impact
        if fraction < 1:
            # A step that was cut short stops where some pair keeps a tenth of its distance, to ten per cent.
            reached = start + fraction * (end - start)
            assert 0.1 * 0.999 <= closest_ratio(candidates, start, reached) <= 0.1 * 1.1 * 1.001
        hits += impact < 1
        reached = wp.array(start + fraction * (end - start), dtype=wp.vec3d, device="cpu")
        assert len(intersecting_bodies(model, reached)) == 0
    assert hits > 20


@pytest.mark.parametrize("turning", [0, 1])
@pytest.mark.parametrize("end_that_swings", [-1, 1])
def test_a_bar_that_swings_about_one_end_stops_short_of_the_bar_that_it_crosses(turning, end_that_swings):
    """One end of every edge along a bar hardly moves, the other comes down twice as far as the bars are apart."""
    builder = ModelBuilder()
    sizes = [(0.4, 0.02, 0.02), (0.02, 0.4, 0.02)]
    for k, size in enumerate(sizes if turning == 0 else sizes[::-1]):
        across = 0.16 * end_that_swings if k != turning else 0.0
        add_hull(builder, box_points(*size), Pose(position=(across, 0, 0.53 if k == turning else 0.5)))
    model = builder.finalize("cpu")
    body = model.vertex_body.numpy()
    start = model.vertex_rest.numpy() + model.q0[body, 0]
    along = 0.5 + end_that_swings * start[:, 0] / 0.4
    end = start - np.where(body == turning, 0.02 * along, 0.0)[:, None] * [0, 0, 1]
    x0, x1 = (wp.array(x, dtype=wp.vec3d, device="cpu") for x in (start, end))
    candidates = Candidates(model)
    candidates.cover(x0, x1, 1e-3, 1e-4)
    step = wp.full(1, 1.0, dtype=wp.float64, device="cpu")
    safe_step(model, candidates, x0, x1, step)
    # The further edge of the other bar, 17 cm from the middle and 1 cm lower, is met first.
    impact = 0.01 / (0.02 * (0.5 + 0.17 / 0.4))
    assert 0.8 * impact < step.numpy()[0] < impact


def test_intersections_are_those_of_ipctk():
    rng = np.random.default_rng(1)
    seen = set()
    for _ in range(60):
        model, start, end = two_hulls(rng)
        positions = start + rng.uniform(0, 0.6) * (end - start)
        ours = len(intersecting_bodies(model, wp.array(positions, dtype=wp.vec3d, device="cpu"))) > 0
        mesh = ipctk.CollisionMesh(positions, model.edges.numpy(), model.triangles.numpy())
        assert ours == ipctk.has_intersections(mesh, positions)
        seen.add(ours)
    assert seen == {True, False}


def test_a_body_inside_another_and_one_under_the_ground_are_found():
    builder = ModelBuilder()
    add_hull(builder, box_points(0.2, 0.2, 0.2), Pose(position=(0, 0, 0.5)))
    add_hull(builder, box_points(0.02, 0.02, 0.02), Pose(position=(0, 0, 0.5)))
    add_hull(builder, box_points(0.02, 0.02, 0.02), Pose(position=(1, 0, 0.005)))
    model = builder.finalize("cpu")
    positions = model.vertex_rest.numpy() + model.q0[model.vertex_body.numpy(), 0]
    pairs = intersecting_bodies(model, wp.array(positions, dtype=wp.vec3d, device="cpu"))
    assert pairs.tolist() == [[0, 1], [2, -1]]


def test_candidates_hold_every_pair_within_reach():
    rng = np.random.default_rng(2)
    close = 0
    for _ in range(6):
        model, start, end = two_hulls(rng)
        middle = start + 0.3 * (end - start)
        candidates = Candidates(model)
        candidates.cover(*(wp.array(x, dtype=wp.vec3d, device="cpu") for x in (start, middle)), 0.05, 1e-4)
        kinds, primitives = candidates.kind.numpy(), candidates.primitives.numpy()
        held = {
            (int(k), *map(int, p))
            for k, p in zip(kinds[: candidates.count], primitives[: candidates.count], strict=True)
        }
        body = model.vertex_body.numpy()
        for v in range(len(start)):
            for t in model.triangles.numpy():
                if body[v] != body[t[0]] and ipctk.point_triangle_distance(middle[v], *middle[t]) < 0.05**2:
                    close += 1
                    assert (int(POINT_TRIANGLE), v, *t) in held
        for e in model.edges.numpy():
            for g in model.edges.numpy():
                if body[e[0]] == 0 and body[g[0]] == 1 and ipctk.edge_edge_distance(*middle[e], *middle[g]) < 0.05**2:
                    close += 1
                    assert (int(EDGE_EDGE), *e, *g) in held
    assert close > 20


@pytest.mark.parametrize("depth", [0.5, 0.91, 1.01, 4.0])
def test_a_fall_towards_the_ground_keeps_a_tenth_of_the_height(depth):
    """Falls that leave that much are free; others, through the ground or nearly to it, are cut short there."""
    builder = ModelBuilder()
    add_hull(builder, box_points(0.1, 0.1, 0.1), Pose(position=(0, 0, 0.06)))
    model = builder.finalize("cpu")
    start = model.vertex_rest.numpy() + model.q0[0, 0]
    end = start - [0, 0, depth * 0.01]
    x0, x1 = (wp.array(x, dtype=wp.vec3d, device="cpu") for x in (start, end))
    candidates = Candidates(model)
    candidates.cover(x0, x1, 1e-3, 1e-4)
    step = wp.full(1, 1.0, dtype=wp.float64, device="cpu")
    safe_step(model, candidates, x0, x1, step)
    lowest = (start + step.numpy()[0] * (end - start))[:, 2].min()
    assert lowest == pytest.approx(max(0.1, 1 - depth) * 0.01, rel=1e-9)
