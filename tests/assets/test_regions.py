"""Regions: free of the parts, on the right floor, as large as the object allows."""

import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.assets.mesh.cover import outside
from pat3d.assets.mesh.regions import cavity, find_regions, height_map, mesh_height_map
from pat3d.geometry.hulls import convex_part


def _parts(*pieces):
    return [convex_part(points) for shape in pieces for points in shape.hulls]


def _open_box(x, y, z, wall):
    side = shapes.box(wall, y, z), shapes.box(x, wall, z)
    return _parts(
        shapes.box(x, y, wall),
        side[0].moved(x=(x - wall) / 2),
        side[0].moved(x=-(x - wall) / 2),
        side[1].moved(y=(y - wall) / 2),
        side[1].moved(y=-(y - wall) / 2),
    )


def _free(region, parts, step=0.0005):
    """Smallest distance of points in the region from the parts (0 when one is inside)."""
    rng = np.random.default_rng(0)
    unit = rng.uniform(-1, 1, size=(4000, 2))
    if region.shape == "disc":
        unit = unit[np.linalg.norm(unit, axis=1) <= 1]
    points = np.column_stack([unit * region.half_size, rng.uniform(step, region.height, len(unit))])
    return outside(points + np.array(region.floor), parts)[0].min()


def test_open_box_has_a_cavity_of_its_inner_size_down_to_its_floor():
    parts = _open_box(0.3, 0.2, 0.1, 0.01)
    region = find_regions(parts)[0]
    assert (region.kind, region.shape) == ("in", "rectangle")
    cell = 0.3 / 128
    assert region.half_size == pytest.approx((0.14, 0.09), abs=1.5 * cell)
    assert max(region.half_size[0] - 0.14, region.half_size[1] - 0.09) < 0
    assert region.floor == pytest.approx((0, 0, 0.01), abs=1e-5)
    assert region.floor[2] + region.height == pytest.approx(0.1)
    assert _free(region, parts) > 0


def test_round_cavity_is_a_disc():
    angle = 2 * np.pi * np.arange(24) / 24
    wall = [shapes.box(0.004, 0.0115, 0.09).moved(x=0.042).turned("z", np.degrees(a)) for a in angle]
    parts = _parts(shapes.cylinder(0.044, 0.005), *wall)
    region = find_regions(parts)[0]
    assert (region.kind, region.shape) == ("in", "disc")
    assert region.half_size[0] == pytest.approx(0.04, rel=0.05)
    assert _free(region, parts) > 0


def test_table_top_is_the_place_to_put_things_on():
    legs = [shapes.box(0.05, 0.05, 0.7).moved(x, y) for x in (-0.5, 0.5) for y in (-0.3, 0.3)]
    regions = find_regions(_parts(shapes.box(1.2, 0.8, 0.04).moved(z=0.7), *legs))
    assert [region.kind for region in regions] == ["on"]
    assert regions[0].floor == pytest.approx((0, 0, 0.74), abs=1e-9)
    assert regions[0].half_size == pytest.approx((0.6, 0.4), abs=0.02)


def test_chair_offers_its_seat_rather_than_the_edge_of_its_back():
    regions = find_regions(_parts(shapes.box(0.4, 0.4, 0.45), shapes.box(0.4, 0.03, 0.9).moved(y=0.185)))
    on = regions[-1]
    assert on.floor[2] == pytest.approx(0.45)
    assert on.floor[1] == pytest.approx(-0.015, abs=0.01)


@pytest.mark.parametrize("solid", [shapes.box(0.1, 0.1, 0.1), shapes.ellipsoid(0.05).moved(z=0.05)])
def test_solid_things_have_no_cavity(solid):
    assert [region.kind for region in find_regions(_parts(solid))] == ["on"]


def test_a_ring_on_the_table_holds_nothing():
    """A hole right through is no container."""
    parts = [part for part in _open_box(0.3, 0.2, 0.1, 0.02) if part.bounds[1, 2] > 0.05]
    assert cavity(height_map(parts)) is None


def test_height_map_of_parts_equals_the_rays_of_embree():
    shape = shapes.frustum(0.05, 0.03, 0.08)
    (part,) = _parts(shape)
    seen, rays = height_map([part]), mesh_height_map(part.vertices, part.faces)
    both = np.isfinite(seen.height) & np.isfinite(rays.height)
    gap = np.abs(seen.height[both] - rays.height[both])
    assert both.sum() > 0.99 * np.isfinite(seen.height).sum() > 1000
    assert gap.max() < 1e-6
