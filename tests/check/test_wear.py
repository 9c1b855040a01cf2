"""Faces drawn in at their edges, against closed forms."""

import math

import numpy as np
import pytest

from pat3d.assets.shapes import box, cylinder
from pat3d.check.certificate import certify
from pat3d.check.wear import WEAR, worn
from pat3d.geometry.contacts import GROUND_INDEX, Contacts, find_contacts
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of


def _contacts(points, normals=None):
    count = len(points)
    return Contacts(
        bodies=np.tile([0, GROUND_INDEX], (count, 1)),
        parts=np.tile([0, GROUND_INDEX], (count, 1)),
        points=np.array(points, dtype=float),
        normals=np.tile([0.0, 0.0, 1.0], (count, 1)) if normals is None else np.array(normals, dtype=float),
        gaps=np.full(count, 1e-5),
    )


@pytest.mark.parametrize("yaw", [0.0, 0.3, math.pi / 4])
def test_the_edges_of_a_rectangle_move_in_by_what_is_worn_however_it_is_turned(yaw):
    scene = scene_of(placed("box", asset_of(box(0.2, 0.06, 0.1)), pose=Pose.from_yaw(yaw, (0.3, -0.1, GAP))))
    before = find_contacts(scene.objects, 3e-5)
    after = worn(before)
    back = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    local = (after.points[:, :2] - [0.3, -0.1]) @ back.T
    assert np.abs(local).max(axis=0) == pytest.approx([0.1**2 / (0.1 + WEAR), 0.03**2 / (0.03 + WEAR)], rel=1e-6)
    assert after.points[:, 2] == pytest.approx(before.points[:, 2], abs=1e-12)


def test_a_round_foot_stays_round():
    scene = scene_of(placed("rod", asset_of(cylinder(0.01, 0.2)), (0, 0, GAP)))
    before = find_contacts(scene.objects, 3e-5)
    old, new = (np.linalg.norm(one.points[:, :2], axis=1) for one in (before, worn(before)))
    assert old.min() > 0.009
    assert new / old == pytest.approx(0.01 / (0.01 + WEAR), rel=1e-3)


def test_single_points_stay_and_a_line_shortens_at_its_ends():
    assert worn(_contacts([[1, 2, 3]])).points == pytest.approx(np.array([[1, 2, 3]]))
    line = worn(_contacts([[0, 0, 0], [0.03, 0.04, 0], [0.015, 0.02, 0]])).points
    assert np.linalg.norm(line[1] - line[0]) == pytest.approx(2 * 0.025**2 / (0.025 + WEAR))
    assert line.mean(axis=0) == pytest.approx([0.015, 0.02, 0.0])


def test_planes_of_one_pair_wear_each_by_itself():
    """Two points on a floor, and two on a wall above them: neither line draws the other in."""
    points = [[0, 0, 0], [0.1, 0, 0], [0.1, 0, 0.2], [0, 0, 0.2]]
    normals = [[0, 0, 1]] * 2 + [[0, 1, 0]] * 2
    after = worn(_contacts(points, normals)).points
    assert after[:, 2] == pytest.approx([0, 0, 0.2, 0.2])
    assert after[:, 0] == pytest.approx(
        [k + (0.05 - 0.05**2 / (0.05 + WEAR)) * s for k, s in ((0, 1), (0.1, -1), (0.1, -1), (0, 1))]
    )


@pytest.mark.parametrize(("factor", "verified"), [(0.97, True), (0.99, False)])
def test_a_pile_whose_weights_are_a_millimetre_inside_of_their_edges_is_refused(factor, verified):
    """At 99 % of the harmonic overhang rigid bricks stand 0.58 degrees; in Drake, Newton and Bullet they fall."""
    length, height, count = 0.2, 0.05, 5
    asset = asset_of(box(length, 0.1, height))
    x, objects = 0.0, []
    for level in range(count):
        objects.append(placed(f"brick {level}", asset, (x, 0, GAP + level * (height + GAP))))
        x += factor * length / (2 * (count - 1 - level)) if level < count - 1 else 0.0
    certificate = certify(scene_of(*objects), margin=True)
    assert not certificate.unbalanced
    assert certificate.passed is verified
