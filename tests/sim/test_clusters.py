"""Detailed surfaces in clusters: nothing is lost, and the same pairs are found as without them."""

import numpy as np
import pytest
import trimesh
import warp as wp

from pat3d.errors import SimulationError
from pat3d.geometry.edges import sharp_edges
from pat3d.geometry.hulls import ConvexPart, convex_part
from pat3d.geometry.mass import mass_properties
from pat3d.geometry.pose import Pose
from pat3d.sim import clusters
from pat3d.sim.contact.broad_phase import Candidates
from pat3d.sim.contact.intersection import GROUND_BODY, intersecting_bodies
from pat3d.sim.model import ModelBuilder
from pat3d.sim.run import Run, SettleOptions
from tests.sim.builders import box_points


def lumpy(subdivisions: int = 3) -> ConvexPart:
    """A non-convex closed surface of 20 * 4^subdivisions triangles about the origin, about 0.1 m across."""
    sphere = trimesh.creation.icosphere(subdivisions=subdivisions)
    x = np.asarray(sphere.vertices)
    radius = 0.05 * (1 + 0.22 * np.sin(5 * x[:, 0] + 1) * np.sin(4 * x[:, 1]) + 0.1 * np.cos(6 * x[:, 2]))
    return ConvexPart(vertices=radius[:, None] * x, faces=np.asarray(sphere.faces, dtype=np.int32))


def torus() -> ConvexPart:
    """A ring around z, 0.1 m across its centre line and 0.04 m thick, of 1,024 triangles."""
    mesh = trimesh.creation.torus(0.05, 0.02, major_sections=32, minor_sections=16)
    return ConvexPart(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces, dtype=np.int32))


def add(builder: ModelBuilder, part: ConvexPart, pose: Pose, fixed: bool = False) -> int:
    properties = mass_properties(part.vertices, part.faces, density=500.0)
    return builder.add_body(
        [part],
        mass=properties.mass,
        volume=properties.volume,
        centre=np.array(properties.centre_of_mass),
        second_moment=properties.second_moment,
        pose=pose,
        fixed=fixed,
    )


def pair_of_lumps(gap: float = 0.001) -> ModelBuilder:
    part, builder = lumpy(), ModelBuilder()
    height = -part.vertices[:, 2].min() + 0.001
    add(builder, part, Pose(position=(0, 0, height)))
    add(builder, part, Pose(position=(0.02, 0.01, height + np.ptp(part.vertices[:, 2]) - 0.006 + gap)))
    return builder


def positions(model) -> wp.array:
    body, rest, q = model.vertex_body.numpy(), model.vertex_rest.numpy(), model.q0
    return wp.array(q[body, 0] + np.einsum("vj,vji->vi", rest, q[body, 1:]), dtype=wp.vec3d, device="cpu")


def found_pairs(model) -> set:
    """Candidates by the rest positions of their vertices, whatever their order."""
    candidates, x = Candidates(model), positions(model)
    candidates.cover(x, x, 2e-3, 1e-3)
    place = [tuple(row) for row in np.round(x.numpy(), 12)]
    pairs = zip(candidates.kind.numpy()[: candidates.count], candidates.primitives.numpy(), strict=False)
    named = [(int(kind), frozenset(place[i] for i in four if i >= 0)) for kind, four in pairs]
    assert len(set(named)) == len(named)
    return set(named)


def test_every_primitive_is_in_exactly_one_cluster_whose_halo_lists_what_it_reaches():
    part = lumpy()
    edges = sharp_edges(part)
    split = clusters.cluster(part.vertices, edges, part.faces)
    assert len(split.ranges) == 64
    assert np.all(split.ranges[:, 5] - split.ranges[:, 4] == 20)
    for column, count in ((0, len(part.vertices)), (2, len(edges)), (4, len(part.faces)), (6, len(split.halo))):
        np.testing.assert_array_equal(split.ranges[1:, column], split.ranges[:-1, column + 1])
        assert (split.ranges[0, column], split.ranges[-1, column + 1]) == (0, count)
    for row in split.ranges:
        reached = {*split.edges[row[2] : row[3]].ravel(), *split.triangles[row[4] : row[5]].ravel()}
        assert reached <= {*range(row[0], row[1]), *split.halo[row[6] : row[7]]}


def test_the_surface_stays_the_same():
    part = lumpy()
    edges = sharp_edges(part)
    split = clusters.cluster(part.vertices, edges, part.faces)

    def corners(vertices, indices):
        return {frozenset(map(tuple, vertices[row])) for row in indices}

    assert corners(part.vertices, part.faces) == corners(split.vertices, split.triangles)
    assert corners(part.vertices, edges) == corners(split.vertices, split.edges)
    assert trimesh.Trimesh(split.vertices, split.triangles, process=False).is_volume


def test_clusters_are_compact():
    part = lumpy()
    split = clusters.cluster(part.vertices, sharp_edges(part), part.faces)
    size = [
        np.ptp(split.vertices[split.triangles[row[4] : row[5]]].reshape(-1, 3), axis=0).max() for row in split.ranges
    ]
    assert np.median(size) < 0.3 * np.ptp(part.vertices, axis=0).max()


def test_a_hull_keeps_its_order():
    part = convex_part(box_points(0.1, 0.2, 0.3))
    split = clusters.cluster(part.vertices, sharp_edges(part), part.faces)
    assert len(split.ranges) == 1
    assert split.vertices is part.vertices
    assert split.triangles is part.faces


@pytest.mark.parametrize("size", [1, 7, 32])
def test_candidates_are_those_found_without_clusters(monkeypatch, size):
    builder = pair_of_lumps()
    monkeypatch.setattr(clusters.cluster, "__defaults__", (10**9, size))
    whole = found_pairs(builder.finalize("cpu"))
    monkeypatch.setattr(clusters.cluster, "__defaults__", (128, size))
    model = builder.finalize("cpu", worlds=1)
    assert len(model.cluster_ranges) > len(model.part_body)
    assert len(whole) > 20
    assert found_pairs(model) == whole


def test_copies_of_a_detailed_world_have_the_candidates_of_every_copy():
    builder = pair_of_lumps()
    one, three = builder.finalize("cpu"), builder.finalize("cpu", worlds=3)

    def rows(model):
        candidates, x = Candidates(model), positions(model)
        candidates.cover(x, x, 2e-3, 1e-3)
        found = np.column_stack([candidates.kind.numpy(), candidates.primitives.numpy()])[: candidates.count]
        return {tuple(map(int, row)) for row in found}

    shift = len(one.vertex_rest)
    expected = {(k, *(i + shift * w if i >= 0 else i for i in four)) for w in range(3) for k, *four in rows(one)}
    assert rows(three) == expected


def test_lumps_that_fall_on_each_other_never_intersect():
    model = pair_of_lumps().finalize("cpu")
    run = Run(model, SettleOptions(), lambda *_: None)
    run.refuse_intersections()
    run.set_d_hat(1e-3)
    run.drop(6)
    run.refuse_intersections()
    x = run.potential.positions(run.q, run.potential._start).numpy()
    half = len(x) // 2
    first, second = (
        trimesh.Trimesh(x[k * half : (k + 1) * half], model.triangles.numpy()[: len(model.triangles) // 2])
        for k in range(2)
    )
    assert not first.contains(second.vertices).any()
    assert not second.contains(first.vertices).any()
    assert x[:, 2].min() > 0


@pytest.mark.parametrize("seed", range(8))
def test_a_small_body_anywhere_in_a_lump_intersects_where_trimesh_says(seed):
    rng = np.random.default_rng(seed)
    part, small = lumpy(), convex_part(box_points(0.002, 0.002, 0.002))
    shape = trimesh.Trimesh(part.vertices, part.faces)
    centres = rng.uniform(-0.06, 0.06, (60, 3))
    builder = ModelBuilder()
    for centre in centres:
        builder.new_world()
        add(builder, part, Pose(position=(0, 0, 0.2)))
        add(builder, small, Pose(position=(*(centre + [0, 0, 0.2]),)))
    model = builder.finalize("cpu")
    pairs = intersecting_bodies(model, positions(model))
    corners = small.vertices + centres[:, None]
    inside = shape.contains(corners.reshape(-1, 3)).reshape(60, 8)
    assert inside.all(axis=1).any()
    clear = inside.all(axis=1) | ~inside.any(axis=1)
    hit = np.isin(np.arange(60), pairs[:, 0] // 2)
    # Cubes across the surface intersect; those that only a face's bulge could touch are not judged by their corners.
    assert hit[~clear].all()
    far = np.abs(np.asarray(trimesh.proximity.signed_distance(shape, centres))) > 0.003
    np.testing.assert_array_equal(hit[clear & far], np.any(inside, axis=1)[np.flatnonzero(clear & far)])


def test_a_ball_in_the_hole_of_a_ring_is_no_intersection_and_inside_its_tube_it_is():
    ball = convex_part(0.01 * np.asarray(trimesh.creation.icosphere(subdivisions=1).vertices))
    for place, expected in (((0, 0, 0.1), 0), ((0.05, 0, 0.1), 1)):
        builder = ModelBuilder()
        add(builder, torus(), Pose(position=(0, 0, 0.1)))
        add(builder, ball, Pose(position=place))
        model = builder.finalize("cpu")
        assert len(intersecting_bodies(model, positions(model))) == expected


def test_a_body_under_the_ground_is_named_and_a_start_inside_a_detailed_surface_refused():
    builder = ModelBuilder()
    add(builder, lumpy(), Pose(position=(0, 0, 0.01)))
    model = builder.finalize("cpu")
    np.testing.assert_array_equal(intersecting_bodies(model, positions(model)), [[0, GROUND_BODY]])
    builder = ModelBuilder()
    add(builder, lumpy(), Pose(position=(0, 0, 0.1)))
    add(builder, convex_part(box_points(0.01, 0.01, 0.01)), Pose(position=(0, 0, 0.1)))
    with pytest.raises(SimulationError, match='"body" and "body"'):
        Run(builder.finalize("cpu"), SettleOptions(), lambda *_: None).refuse_intersections()


@pytest.mark.parametrize("rings", [6, 12, 13, 25])
def test_clusters_have_at_most_32_triangles_and_more_than_half_as_many(rings):
    """A ring of 22 triangles a segment: of 132 and of 264, halving leaves 33 at one time."""
    mesh = trimesh.creation.torus(0.05, 0.02, major_sections=rings, minor_sections=11)
    part = ConvexPart(vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces, dtype=np.int32))
    assert len(part.faces) == 22 * rings
    split = clusters.cluster(part.vertices, sharp_edges(part), part.faces)
    counts = split.ranges[:, 5] - split.ranges[:, 4]
    assert counts.sum() == len(part.faces)
    assert counts.max() <= 32
    assert counts.min() >= 16
