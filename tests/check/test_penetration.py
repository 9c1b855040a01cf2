import numpy as np
import pytest

from pat3d.assets.shapes import box, cylinder, ellipsoid, vessel
from pat3d.check.penetration import penetration
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of, tower


def test_a_settled_tower_overlaps_nowhere_and_its_gaps_are_listed():
    report = penetration(tower(4))
    assert report.passed
    assert report.volume_ratio == 0.0
    assert len(report.gaps) == 4
    np.testing.assert_allclose([gap.distance for gap in report.gaps], GAP, rtol=1e-9)


@pytest.mark.parametrize("depth", [1e-3, 1e-6, 1e-8])
def test_overlapping_boxes_are_found_with_their_depth_and_volume(depth):
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(placed("low", asset, (0, 0, GAP)), placed("high", asset, (0.03, 0.02, 0.1 + GAP - depth)))
    report = penetration(scene)
    assert not report.passed
    (hull,), (visual,) = report.hulls, report.visuals
    assert {hull.first, hull.second} == {"low", "high"}
    assert hull.depth == pytest.approx(depth, rel=1e-6, abs=1e-12)
    assert visual.volume == pytest.approx(0.07 * 0.08 * depth, rel=1e-4)
    assert report.volume_ratio == pytest.approx(0.07 * 0.08 * depth / 2e-3, rel=1e-4)


def test_hulls_may_overlap_where_the_round_shapes_they_contain_do_not():
    """Two balls 0.1 mm apart: their circumscribed polyhedra intersect, the visual meshes do not."""
    ball = asset_of(ellipsoid(0.05).moved(z=0.05))
    report = penetration(scene_of(placed("a", ball, (0, 0, 0.1)), placed("b", ball, (0.1001, 0, 0.1))))
    assert len(report.hulls) == 1
    assert report.hulls[0].depth > 1e-5
    assert not report.visuals
    assert report.volume_ratio == 0.0


def test_a_small_object_swallowed_by_a_large_one_is_found():
    """Surfaces that do not meet: one solid lies inside the other."""
    report = penetration(
        scene_of(placed("crate", asset_of(box(1, 1, 1))), placed("pea", asset_of(ellipsoid(0.01)), (0, 0, 0.5)))
    )
    assert [(o.first, o.second) for o in report.hulls] == [("pea", "crate")]
    assert [(o.first, o.second) for o in report.visuals] == [("pea", "crate")]


def test_an_object_in_the_cavity_of_a_bowl_is_free():
    bowl = asset_of(vessel([(0.05, 0), (0.1, 0.08)], [(0.04, 0.01), (0.09, 0.08)]))
    peas = asset_of(cylinder(0.01, 0.02))
    scene = scene_of(placed("bowl", bowl, (0, 0, GAP)), placed("peas", peas, (0, 0, 0.01 + 2 * GAP)))
    assert penetration(scene).passed


def test_reaching_into_the_ground_is_found_and_touching_it_is_not():
    asset = asset_of(box(0.1, 0.1, 0.1))
    report = penetration(scene_of(placed("sunk", asset, (0, 0, -1e-6)), placed("flush", asset, (1, 0, 0))))
    assert [(o.first, o.second) for o in report.hulls] == [("sunk", "ground")]
    assert report.hulls[0].depth == pytest.approx(1e-6)


def test_far_turned_objects_are_apart():
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(placed("a", asset), placed("b", asset, pose=Pose.from_yaw(np.pi / 4, (0.13, 0, 0))))
    report = penetration(scene)
    assert report.passed
    assert report.least_gap == pytest.approx(0.0)  # Both stand on the ground; they are 9 mm apart.
    assert {gap.second for gap in report.gaps} == {"ground"}


def test_fixed_objects_in_mid_air_are_said_to_be_fixed_by_the_user():
    """A shelf on a wall touches nothing that holds it; a fixed table stands on the ground."""
    shelf, table = asset_of(box(0.3, 0.2, 0.02)), asset_of(box(0.4, 0.4, 0.3))
    scene = scene_of(
        placed("shelf", shelf, (0, 0, 0.6), fixed=True),
        placed("table", table, (0, 0, GAP), fixed=True),
        placed("cup", asset_of(box(0.05, 0.05, 0.05)), (0, 0, 0.3 + 2 * GAP)),
    )
    assert penetration(scene).afloat == ("shelf",)
