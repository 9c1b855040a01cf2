"""Cutting shapes flat: the hull stays around the solid and ends exactly at the plane."""

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from pat3d.assets.catalogue.creature import limb
from pat3d.assets.shapes import box, ellipsoid


@pytest.mark.parametrize("depth", [0.02, 0.1, 0.3, 0.7, 0.9])
@pytest.mark.parametrize("seed", range(4))
def test_cut_ellipsoid_is_contained_flat_and_small(depth, seed):
    rng = np.random.default_rng(seed)
    shape = ellipsoid(*rng.uniform(0.02, 0.1, 3)).turned("x", rng.uniform(-40, 40)).turned("y", rng.uniform(-40, 40))
    low, high = shape.solid.bounding_box()[2], shape.solid.bounding_box()[5]
    z = low + depth * (high - low)
    cut = shape.cut_below(z)
    (points,) = cut.hulls
    hull = ConvexHull(points)
    assert points[:, 2].min() == z
    assert len(hull.simplices) <= 64
    vertices = np.asarray(cut.solid.to_mesh64().vert_properties)[:, :3]
    assert vertices[:, 2].min() == pytest.approx(z, abs=1e-12)
    assert np.max(vertices @ hull.equations[:, :3].T + hull.equations[:, 3]) < 1e-9
    base = ConvexHull(points[points[:, 2] == z][:, :2])
    section = np.asarray(cut.solid.slice(z + 1e-9).to_polygons()[0])
    if depth > 0.05:
        assert base.volume < 2.2 * ConvexHull(section).volume


def test_cut_box_is_the_smaller_box():
    shape = box(0.2, 0.1, 0.3).cut_below(0.1).cut_above(0.25)
    (points,) = shape.hulls
    assert ConvexHull(points).volume == pytest.approx(0.2 * 0.1 * 0.15)
    assert shape.solid.volume() == pytest.approx(0.2 * 0.1 * 0.15)


def test_parts_wholly_below_the_cut_vanish():
    assert box(0.1, 0.1, 0.1).cut_below(0.2).hulls == ()


@pytest.mark.parametrize(("radius", "end"), [(0.02, 0.02), (0.03, 0.01), (0.01, 0.03), (0.02, 0.019)])
def test_limb_contains_its_round_solid_in_one_small_hull(radius, end):
    shape = limb((0.01, -0.02, 0.03), (0.05, 0.04, 0.11), radius, end)
    (points,) = shape.hulls
    hull = ConvexHull(points)
    assert len(hull.simplices) <= 64
    vertices = np.asarray(shape.solid.to_mesh64().vert_properties)[:, :3]
    assert np.max(vertices @ hull.equations[:, :3].T + hull.equations[:, 3]) < 1e-9
    assert hull.volume < 1.45 * shape.solid.volume()
