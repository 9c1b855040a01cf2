"""Hull reduction: the original is contained, the caps hold, support faces stay, edges are not short."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import ConvexHull

from pat3d.assets.mesh.inflation import inflation
from pat3d.assets.mesh.reduce import SHORT_EDGE, reduce_hull
from pat3d.errors import AssetError


def _outside(points, part):
    """Largest distance of points from the part's hull, by qhull's planes."""
    hull = ConvexHull(part.vertices)
    return float((points @ hull.equations[:, :3].T + hull.equations[:, 3]).max())


def _edges(part):
    pairs = np.unique(np.sort(part.faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    return np.linalg.norm(part.vertices[pairs[:, 0]] - part.vertices[pairs[:, 1]], axis=1)


def _sphere(count, seed=0):
    points = np.random.default_rng(seed).normal(size=(count, 3))
    return points / np.linalg.norm(points, axis=1)[:, None]


@settings(max_examples=10, deadline=None)
@given(
    seed=st.integers(0, 10_000),
    count=st.integers(8, 90),
    flat=st.booleans(),
    stretch=st.tuples(*[st.floats(0.05, 1.0)] * 3),
    scale=st.sampled_from([1e-2, 1.0, 30.0]),
)
def test_reduced_hull_contains_the_original_within_the_caps_and_keeps_its_base(seed, count, flat, stretch, scale):
    points = _sphere(count, seed) * np.array(stretch) * scale + np.array([0.3, -2.0, 5.0]) * scale
    if flat:
        points[:, 2] = np.maximum(points[:, 2], (5.0 - 0.5 * stretch[2]) * scale)
    part = reduce_hull(points, max_vertices=20, max_faces=36)
    assert len(part.vertices) <= 20
    assert len(part.faces) <= 36
    assert _outside(points, part) <= 1e-9 * scale
    assert len(part.faces) == 2 * len(part.vertices) - 4
    # What stands on the base stands as high as before; where nothing else lets an edge go, levels give way by a tenth
    # of the shortest edge.
    hair = 0.1 * SHORT_EDGE * np.ptp(points, axis=0).max() * (1 + 1e-9)
    assert points[:, 2].min() - hair <= part.bounds[0, 2] <= points[:, 2].min() + 1e-9 * scale
    assert points[:, 2].max() - 1e-9 * scale <= part.bounds[1, 2] <= points[:, 2].max() + hair


def test_base_and_top_of_a_fine_cylinder_stay_exactly_coplanar_and_cover_the_old_ones():
    angle = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    ring = np.stack([np.cos(angle), np.sin(angle), np.zeros(48)], axis=1) * 0.04
    part = reduce_hull(np.concatenate([ring, ring + [0, 0, 0.1]]))
    base = part.vertices[part.vertices[:, 2] == 0.0]
    assert len(part.vertices[part.vertices[:, 2] == 0.1]) + len(base) == len(part.vertices)
    hull = ConvexHull(base[:, :2])
    assert (ring[:, :2] @ hull.equations[:, :2].T + hull.equations[:, 2]).max() < 1e-12
    # 17 sides around a circle add tan(pi/17) / (pi/17) - 1 = 1.16 % of area at best, from a 48-gon a little less.
    assert inflation(part, np.concatenate([ring, ring + [0, 0, 0.1]])).volume < 0.015


def test_sphere_of_64_triangles_adds_little():
    """The best polyhedron of 64 triangles about a sphere adds about 6.5 %; 14 hexagons and 5 others add 19 %."""
    grown = inflation(reduce_hull(_sphere(150)), _sphere(150))
    assert grown.volume < 0.12
    assert grown.distance < 0.25


def test_tilted_support_face_keeps_its_plane():
    """A dome on a large slanted face: the face stays, to rounding."""
    from scipy.spatial.transform import Rotation

    turn = Rotation.from_euler("xyz", [0.4, 0.7, 0.2]).as_matrix()
    dome = _sphere(140)
    dome[:, 2] = np.maximum(dome[:, 2], 0.0)
    part = reduce_hull(dome @ turn.T)
    height = part.vertices @ turn[:, 2]
    on_face = height < 1e-9
    assert height.min() > -1e-9
    assert ConvexHull((part.vertices[on_face] @ turn)[:, :2]).volume > 0.95 * np.pi


def test_short_edges_go_even_when_there_is_room():
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
    rng = np.random.default_rng(1)
    points = np.concatenate([corners + rng.normal(scale=1e-4, size=(8, 3)) for _ in range(3)])
    part = reduce_hull(points)
    assert _edges(part).min() > 0.9 * SHORT_EDGE
    assert _outside(points, part) < 1e-9


def test_thin_plate_keeps_its_thickness():
    plate = np.array([[x, y, z] for x in (0, 0.3) for y in (0, 0.2) for z in (0, 0.001)])
    part = reduce_hull(plate)
    assert np.ptp(part.vertices[:, 2]) == 0.001
    assert part.box is not None


def test_small_hull_is_returned_as_it_is():
    points = _sphere(20)
    assert sorted(map(tuple, reduce_hull(points).vertices)) == sorted(map(tuple, points))


@pytest.mark.parametrize("points", [np.zeros((10, 3)), np.eye(3), np.c_[_sphere(9)[:, :2], np.zeros(9)]])
def test_flat_points_are_an_asset_error(points):
    with pytest.raises(AssetError, match="no volume"):
        reduce_hull(points)


def test_impossible_caps_are_an_asset_error():
    with pytest.raises(AssetError, match="4 vertices"):
        reduce_hull(_sphere(20), max_vertices=3)


def test_faces_that_are_nearly_parallel_do_not_meet_in_a_needle():
    """A splinter of a mug's wall [mm]: the planes around its short edges meet 270 mm away, almost in the faces."""
    points = np.array(
        [
            [0.81, 4.81, -38.75],
            [-3.39, 4.81, 27.17],
            [0.87, 4.81, 6.98],
            [0.87, 2.88, 7.29],
            [0.87, 2.46, 7.36],
            [0.87, 0.45, 8.42],
        ]
    )
    part = reduce_hull(points)
    assert _outside(points, part) < 1e-9
    assert inflation(part, points).distance < 0.05 * np.ptp(points)
    assert inflation(part, points).volume < 0.5


def test_a_bar_of_many_corners_fits_within_half_a_millimetre():
    """Half of a round bar of 36 x 100 mm, as a scanner has it: 10 sides around the half have corners 0.22 mm out."""
    rng = np.random.default_rng(3)
    angle, along = np.pi * rng.uniform(size=3000), rng.uniform(0.0, 0.1, size=3000)
    bar = np.stack([0.018 * np.cos(angle), along, 0.018 * np.sin(angle)], axis=1)
    bar = np.concatenate([bar, [[x, y, 0.0] for x in (-0.018, 0.018) for y in (0.0, 0.1)]])
    part = reduce_hull(bar)
    assert len(part.vertices) <= 34
    assert _outside(bar, part) <= 1e-12
    assert inflation(part, bar).distance < 5e-4
    assert part.bounds[0, 2] == 0.0
