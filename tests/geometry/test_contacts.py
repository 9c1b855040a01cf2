import fcl
import numpy as np
import pytest
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box, convex, join
from pat3d.check.certificate import certify
from pat3d.geometry.contacts import find_contacts, merged
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of


def _bvh(points, faces):
    model = fcl.BVHModel()
    model.beginModel(len(points), len(faces))
    model.addSubModel(np.ascontiguousarray(points), np.ascontiguousarray(faces))
    model.endModel()
    return fcl.CollisionObject(model)


@pytest.mark.parametrize("seed", range(20))
def test_the_least_gap_of_random_hulls_is_what_fcl_measures(seed):
    """Two random polyhedra are moved together until FCL says they are 50 um apart; any features may be nearest."""
    rng = np.random.default_rng(seed)
    assets = [asset_of(convex(rng.normal(size=(12, 3)) * 0.05)) for _ in range(2)]
    rotations = [Rotation.random(random_state=rng).as_matrix() for _ in range(2)]
    direction = rng.normal(size=3)
    direction /= np.linalg.norm(direction)

    def poses(distance):
        return Pose.from_matrix(rotations[0], np.array([0, 0, 5.0])), Pose.from_matrix(
            rotations[1], np.array([0, 0, 5.0]) + distance * direction
        )

    def fcl_distance(distance):
        shapes = [
            _bvh(pose.apply(asset.parts[0].vertices), asset.parts[0].faces)
            for asset, pose in zip(assets, poses(distance), strict=True)
        ]
        return fcl.distance(*shapes)

    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (low, middle) if fcl_distance(middle) > 5e-5 else (middle, high)
    pair = poses(high)
    contacts = find_contacts(
        scene_of(placed("a", assets[0], pose=pair[0]), placed("b", assets[1], pose=pair[1])).objects, activation=1e-4
    )
    assert contacts.gaps.min() == pytest.approx(fcl_distance(high), rel=1e-6)
    # The normal points from the second body to the first: moving apart along it opens the gap.
    nearest = np.argmin(contacts.gaps)
    first, second = contacts.bodies[nearest]
    assert contacts.normals[nearest] @ np.array(pair[first].position - np.array(pair[second].position)) > 0


def test_turned_squares_touch_at_the_corners_of_an_octagon():
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(
        placed("low", asset, (0, 0, GAP)), placed("high", asset, pose=Pose.from_yaw(np.pi / 4, (0, 0, 0.1 + 2 * GAP)))
    )
    contacts = find_contacts(scene.objects)
    between = contacts.pick((contacts.bodies == (1, 0)).all(axis=1))
    assert len(between) == 8
    assert ConvexHull(between.points[:, :2]).volume == pytest.approx(0.1**2 * 2 * (np.sqrt(2) - 1), rel=1e-6)
    np.testing.assert_allclose(between.normals, np.tile([0, 0, 1], (8, 1)), atol=1e-12)
    np.testing.assert_allclose(between.gaps, GAP, rtol=1e-9)
    np.testing.assert_allclose(between.points[:, 2], 0.1 + 1.5 * GAP, atol=1e-12)


def test_a_seam_between_two_parts_makes_no_slanted_contact():
    """A block across the seam of a two-part table: a corner just beside the seam is no corner contact."""
    halves = join(box(0.2, 0.2, 0.02).moved(x=-0.1), box(0.2, 0.2, 0.02).moved(x=0.1))
    scene = scene_of(
        placed("table", asset_of(halves), fixed=True),
        placed("block", asset_of(box(0.04, 0.04, 0.04)), (0.02 + 1e-5, 0, 0.02 + GAP)),
    )
    contacts = find_contacts(scene.objects)
    assert len(contacts) >= 4
    np.testing.assert_allclose(contacts.normals[:, 2], 1.0, atol=1e-12)


@pytest.mark.parametrize("beyond", [0.0, 0.03])
@pytest.mark.parametrize("gaps", [(1e-5, 1.4e-5), (1.4e-5, 1e-5), (5e-6, 1.4e-5), (1e-5, 1e-5)])
def test_an_edge_in_a_hollow_between_two_parts_leans_on_both(gaps, beyond):
    """A wedge on its edge at the bottom of a trough: it needs no friction, but both sides, the further one too.

    Args:
        gaps: between the edge and either side.
        beyond: by how much the left part reaches under the right one [m].
    """
    slope = 0.1 * np.tan(np.radians(30))
    left = [(beyond, -10 * beyond * slope), (-0.1, slope), (-0.1, -0.05), (beyond, -0.05)]
    right = [(0, 0), (0.1, slope), (0.1, -0.05), (0, -0.05)]
    trough = join(*(convex(_along_y(outline, 0.1)) for outline in (left, right)))
    edge = np.linalg.solve([[0.5, np.sqrt(0.75)], [-0.5, np.sqrt(0.75)]], gaps)
    wedge = convex(_along_y([(0, 0), (-0.02, 0.06), (0.02, 0.06)], 0.03))
    scene = scene_of(
        placed("trough", asset_of(trough), (0, 0, 0.05), fixed=True),
        placed("wedge", asset_of(wedge), (edge[0], 0, 0.05 + edge[1])),
    )
    contacts = find_contacts(scene.objects)
    assert sorted(np.sign(contacts.normals[:, 0])) == [-1, -1, 1, 1]
    assert sorted(contacts.gaps) == pytest.approx(sorted([*gaps, *gaps]), rel=0.02)
    assert certify(scene, friction=0.01).passed


def _along_y(outline, half):
    """Corners of an outline (x, z) drawn out from -half to half."""
    return np.array([(x, y, z) for x, z in outline for y in (-half, half)])


def test_merging_keeps_the_corners_of_a_patch():
    fine = box(0.1, 0.1, 0.02)
    scene = scene_of(placed("tiles", asset_of(join(fine.moved(x=-0.05), fine.moved(x=0.05))), (0, 0, GAP)))
    contacts = find_contacts(scene.objects)
    corners = merged(contacts)
    assert (len(contacts), len(corners)) == (8, 4)
    np.testing.assert_allclose(np.sort(corners.points[:, 0]), [-0.1, -0.1, 0.1, 0.1])


def test_far_objects_and_fixed_pairs_have_no_contacts():
    asset = asset_of(box(0.1, 0.1, 0.1))
    high = scene_of(placed("a", asset, (0, 0, 1)), placed("b", asset, (0, 0, 2)))
    assert len(find_contacts(high.objects)) == 0
    assert len(merged(find_contacts(high.objects))) == 0
    fixed = scene_of(placed("a", asset, fixed=True), placed("b", asset, (0, 0, 0.1 + GAP), fixed=True))
    assert len(find_contacts(fixed.objects)) == 0
