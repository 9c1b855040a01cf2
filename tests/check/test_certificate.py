import math
import time
from dataclasses import replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from pat3d.assets.shapes import box, cylinder, vessel
from pat3d.check.balance import SHARPNESS
from pat3d.check.certificate import (
    DIRECTIONS,
    FRICTION_STEP,
    MAX_TILT,
    TOLERANCE,
    certify,
    smallest_friction,
    steadiness,
)
from pat3d.check.wear import WEAR
from pat3d.errors import CheckError
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Material
from pat3d.scene.model import Attachment
from tests.scenes import GAP, asset_of, placed, scene_of, tower


def _on_slope(degrees: float):
    """A block on a fixed ramp."""
    turn = Rotation.from_euler("y", degrees, degrees=True)

    def pose(x, y, z):
        return Pose.from_matrix(turn.as_matrix(), turn.apply([x, y, z]) + (0, 0, 1))

    return scene_of(
        placed("ramp", asset_of(box(1, 1, 0.2)), pose=pose(0, 0, 0), fixed=True),
        placed("block", asset_of(box(0.05, 0.05, 0.02)), pose=pose(0, 0, 0.2 + GAP)),
    )


@pytest.mark.parametrize("degrees", [5, 20, 35])
def test_a_block_holds_on_a_slope_from_the_tangent_of_its_angle(degrees):
    scene = _on_slope(degrees)
    least = math.tan(math.radians(degrees))
    assert certify(scene, friction=least * 1.001).passed
    assert not certify(scene, friction=least * 0.98).passed
    assert smallest_friction(scene) == pytest.approx(least, abs=FRICTION_STEP)


def test_the_residual_below_the_slope_is_the_force_that_is_missing():
    """Sliding without friction on 30 degrees leaves g sin(30) along the slope; the least residual is that distance."""
    certificate = certify(_on_slope(30), friction=0.0)
    assert certificate.worst == pytest.approx(0.5, abs=1e-6)
    assert certificate.unbalanced == ("block",)


def test_a_tower_needs_no_friction():
    assert smallest_friction(tower(8)) == 0.0
    assert certify(tower(8), friction=0.0).worst < 1e-6


@pytest.mark.parametrize(("count", "yaw"), [(1, 0.0), (3, 0.0), (1, math.pi / 4), (1, 0.2)])
def test_a_tower_stands_a_tilt_until_its_weight_leaves_its_base(count, yaw):
    """A tower of height H on a base of width w tips at atan(w / H), over the side that lies lowest.

    What is claimed is that of a base whose edges are worn.
    """
    width, height = 0.02, 0.24 / count
    tilted = tower(count, (width, width, height))
    objects = (replace(obj, pose=Pose.from_yaw(yaw, obj.pose.position)) for obj in tilted.objects)
    scene = replace(tilted, objects=tuple(objects))
    certificate = certify(scene, margin=True)
    sides = yaw not in (0.0, math.pi / 4)
    base = width * (width / 2) / (width / 2 + WEAR)
    assert_tilt(steadiness(scene), math.atan(base / (count * height)), sides=sides)
    assert_tilt(certificate.largest_tilt, math.atan(base / (count * height)), sides=sides)
    assert certificate.first_to_go[0] == f"box {count}"


@pytest.mark.parametrize("friction", [0.03, 0.1])
def test_a_flat_block_stands_a_tilt_until_it_slides(friction):
    scene = scene_of(placed("slab", asset_of(box(0.2, 0.2, 0.01)), (0, 0, GAP)))
    assert_tilt(steadiness(scene, friction), math.atan(friction), sides=True)
    assert steadiness(scene, 1.0) == pytest.approx(MAX_TILT)


@pytest.mark.parametrize(("below", "above"), [(0.05, 0.5), (0.5, 0.05)])
def test_what_slides_does_so_at_the_lower_of_two_exported_frictions(below, above):
    plate, slab = (
        asset_of(box(side, side, 0.01), material=Material(name="any", density=900.0, friction=friction))
        for side, friction in ((0.3, below), (0.1, above))
    )
    scene = scene_of(placed("plate", plate, (0, 0, GAP)), placed("slab", slab, (0, 0, 0.01 + 2 * GAP)))
    certificate = certify(scene, friction=0.5, margin=True)
    assert_tilt(certificate.largest_tilt, math.atan(0.05), sides=True)
    assert "slab" in certificate.first_to_go


@pytest.mark.parametrize(("width", "stands"), [(0.0009, False), (0.00105, True)])
def test_what_balances_on_a_tip_is_verified_if_a_hundredth_of_its_weight_does_not_push_it_over(width, stands):
    """A block whose centre is 3 cm over a tip bears a sideways push of half the worn tip's width over 3 cm."""
    scene = scene_of(
        placed("tip", asset_of(box(width, width, 0.05)), (0, 0, GAP), fixed=True),
        placed("block", asset_of(box(0.06, 0.06, 0.06)), (0, 0, 0.05 + 2 * GAP)),
    )
    assert certify(scene).passed
    certificate = certify(scene, margin=True)
    assert certificate.passed is stands
    assert certificate.fragile is not stands
    assert certificate.first_to_go == ("block",)
    assert not certificate.unbalanced
    assert_tilt(certificate.largest_tilt, math.atan((width / 2) ** 2 / (width / 2 + WEAR) / 0.03), sides=False)


def test_what_is_not_balanced_on_level_ground_stands_no_tilt():
    scene = scene_of(placed("block", asset_of(box(0.1, 0.1, 0.1)), (0, 0, 0.05)))
    assert steadiness(scene) == 0.0
    assert not certify(scene, margin=True).fragile


@pytest.mark.parametrize(("height", "expected"), [(0.04, MAX_TILT), (0.0, 0.0)])
def test_what_hangs_below_its_anchor_swings_and_what_stands_on_one_falls(height, expected):
    """A bar of 4 cm held by a point at its upper or at its lower side."""
    scene = scene_of(
        placed("beam", asset_of(box(0.5, 0.1, 0.1)), (0, 0, 1), fixed=True),
        placed("bar", asset_of(box(0.3, 0.04, 0.04)), (0, 0, 0.5)),
        attachments=(Attachment(child="bar", parent="beam", anchors=(((0, 0, height), (0, 0, height - 0.5)),)),),
    )
    assert certify(scene).passed
    # A hundredth of a degree is what the torque of a thousandth of the weight balances.
    assert steadiness(scene) == pytest.approx(expected, abs=0.5)


def assert_tilt(found: float | None, expected: float, *, sides: bool) -> None:
    """`found` [degrees] is `expected` [radians], or below it by what a polygon lacks of a circle where `sides`.

    What may stay unbalanced adds to it: a torque in proportion to the size, which here is up to three times the arm.
    """
    least = math.degrees(expected) * (math.cos(math.pi / DIRECTIONS) if sides else 1.0)
    assert found is not None
    assert least - 1e-3 <= found <= math.degrees(expected) + math.degrees(4 * SHARPNESS * TOLERANCE)


@pytest.mark.parametrize(("factor", "stands"), [(0.99, True), (1.02, False)])
def test_bricks_overhang_up_to_the_harmonic_limit(factor, stands):
    """The k-th brick from the top of a pile may jut out by L / 2k."""
    length, height, count = 0.2, 0.05, 5
    asset = asset_of(box(length, 0.1, height))
    x, objects = 0.0, []
    for level in range(count):
        objects.append(placed(f"brick {level}", asset, (x, 0, GAP + level * (height + GAP))))
        x += factor * length / (2 * (count - 1 - level)) if level < count - 1 else 0.0
    assert certify(scene_of(*objects), friction=0.2).passed is stands


@pytest.mark.parametrize("degrees", [50, 65])
def test_a_plank_leans_on_a_wall_from_the_friction_of_the_ladder_formula(degrees):
    length, thickness = 0.5, 0.02
    angle = math.radians(degrees)
    turn = Rotation.from_euler("y", -degrees, degrees=True)
    plank = asset_of(box(length, 0.1, thickness).moved(x=length / 2))
    reach = length * math.cos(angle)
    scene = scene_of(
        placed("plank", plank, pose=Pose.from_matrix(turn.as_matrix(), np.array([0.0, 0.0, GAP]))),
        placed("wall", asset_of(box(0.1, 1, 1)), (reach + GAP + 0.05, 0, 0), fixed=True),
    )
    # Both contacts slip at once: x_c (1 + mu^2) = mu L (mu cos + sin), with the centre of mass at x_c.
    centre = reach / 2 - thickness / 2 * math.sin(angle)
    least = min(root for root in np.roots([centre - reach, -length * math.sin(angle), centre]).real if root > 0)
    assert smallest_friction(scene) == pytest.approx(least, abs=2 * FRICTION_STEP)


@pytest.mark.parametrize(("gap", "carried"), [(2e-5, True), (5e-5, False), (1.5e-4, False)])
def test_what_is_further_from_its_support_than_the_tolerance_is_not_carried(gap, carried):
    """The simulator presses within 0.015 mm; a tolerance of twice that leaves 0.15 mm of air visible as such."""
    certificate = certify(tower(2, gap=gap), margin=True)
    assert certificate.passed is carried
    assert set(certificate.unbalanced) == (set() if carried else {"box 1", "box 2"})
    if carried:
        assert certificate.largest_gap == pytest.approx(gap)


def _between_walls(clearance, *, floor=False, lean=0.0):
    """A block between two fixed walls, `clearance` [m] from either, in mid-air or on the ground."""
    walls = asset_of(box(0.1, 0.3, 0.5))
    x = 0.05 + 0.05 + clearance
    height = GAP if floor else 0.2
    return scene_of(
        placed("left", walls, (-x, 0, 0), fixed=True),
        placed("right", walls, (x, 0, 0), fixed=True),
        placed("block", asset_of(box(0.1, 0.1, 0.1)), (0, 0, height)),
    )


def test_a_block_jammed_in_mid_air_by_forces_that_nothing_causes_is_refused():
    """Friction alone would do at any coefficient: the walls need only press hard enough, and nothing makes them."""
    scene = _between_walls(1.2e-5)
    assert not certify(scene, friction=0.01).unbalanced
    certificate = certify(scene, margin=True)
    assert certificate.jammed == ("block",)
    assert not certificate.passed
    assert '"block" is jammed' in certificate.unreal[0]


def test_the_same_block_on_the_ground_is_carried_by_it():
    certificate = certify(_between_walls(1.2e-5, floor=True), margin=True)
    assert not certificate.jammed
    assert certificate.passed


def test_weight_presses_a_wedge_into_its_groove_and_a_plank_against_its_wall():
    """Both are held by forces that slope against each other; here weight is their cause."""
    turn = Rotation.from_euler("y", 45, degrees=True)
    side = asset_of(box(0.3, 0.2, 0.02).moved(x=0.15, z=-0.02))
    half = math.sqrt(0.5)
    mirrored = Rotation.from_euler("z", 180, degrees=True) * Rotation.from_euler("y", -45, degrees=True)
    slopes = [Rotation.from_euler("y", -45, degrees=True), mirrored]
    cube = asset_of(box(0.1, 0.1, 0.1).moved(z=-0.05))
    centre = 0.05 / half + GAP / half
    scene = scene_of(
        *(
            placed(f"side {k}", side, pose=Pose.from_matrix(slope.as_matrix(), np.array([0.0, 0.0, 0.3])), fixed=True)
            for k, slope in enumerate(slopes)
        ),
        placed("cube", cube, pose=Pose.from_matrix(turn.as_matrix(), np.array([0.0, 0.0, 0.3 + centre]))),
    )
    certificate = certify(scene, margin=True)
    assert not certificate.unbalanced
    assert not certificate.jammed


def test_lifting_one_object_by_5_mm_convicts_it_and_only_it():
    scene = tower(4)
    top = scene.objects[-1]
    raised = replace(top, pose=Pose(position=(0, 0, top.pose.position[2] + 0.005)))
    certificate = certify(replace(scene, objects=(*scene.objects[:-1], raised)))
    assert certificate.unbalanced == ("box 4",)
    assert certificate.residuals["box 4"] == 1.0


def test_taking_away_the_middle_of_a_tower_convicts_what_stood_on_it():
    scene = tower(4)
    certificate = certify(replace(scene, objects=(scene.objects[0], *scene.objects[2:])))
    assert set(certificate.unbalanced) == {"box 3", "box 4"}


def test_a_block_with_its_centre_beyond_the_edge_is_convicted_and_a_fixed_one_is_not():
    table, block = asset_of(box(0.4, 0.4, 0.05)), asset_of(box(0.1, 0.1, 0.1))

    def scene(x, fixed=False):
        return scene_of(
            placed("table", table, (0, 0, GAP)), placed("block", block, (x, 0, 0.05 + 2 * GAP), fixed=fixed)
        )

    assert certify(scene(0.199)).passed
    assert not certify(scene(0.201)).passed
    assert list(certify(scene(0.201, fixed=True)).residuals) == ["table"]


def test_light_objects_count_as_much_as_heavy_ones():
    """A floating 2 g cup beside a 20 kg table is found, and the certificate says how bad in units of its own weight."""
    table = asset_of(box(1, 1, 0.03))
    cup = asset_of(vessel([(0.02, 0), (0.025, 0.04)], [(0.0195, 0.0005), (0.0245, 0.04)], segments=12))
    standing = scene_of(placed("table", table, (0, 0, GAP)), placed("cup", cup, (0.2, 0, 0.03 + 2 * GAP)))
    assert certify(standing).passed
    floating = scene_of(placed("table", table, (0, 0, GAP)), placed("cup", cup, (0.2, 0, 0.031)))
    assert certify(floating).unbalanced == ("cup",)


def test_twenty_bodies_take_under_a_second():
    cylinder_asset = asset_of(cylinder(0.03, 0.05))
    objects = [placed("table", asset_of(box(1, 1, 0.03)), (0, 0, GAP))]
    rng = np.random.default_rng(0)
    for k in range(20):
        column, level = k % 4, k // 4
        position = (0.2 * column - 0.3, *rng.uniform(-0.005, 0.005, 1), 0.03 + 2 * GAP + level * (0.05 + GAP))
        objects.append(placed(f"can {k}", cylinder_asset, pose=Pose.from_yaw(rng.uniform(0, 6), position)))
    start = time.perf_counter()
    certificate = certify(scene_of(*objects))
    assert certificate.passed
    assert certificate.worst < TOLERANCE / 10
    assert certificate.contacts > 300
    assert time.perf_counter() - start < 3.0  # 0.4 s on an idle core.


def test_friction_must_be_a_number():
    with pytest.raises(CheckError, match="friction"):
        certify(tower(1), friction=float("nan"))


def test_an_overhanging_object_alone_has_no_smallest_friction():
    asset = asset_of(box(0.1, 0.1, 0.1))
    scene = scene_of(placed("hovering", asset, (0, 0, 1)))
    assert math.isinf(smallest_friction(scene))
    assert certify(scene, margin=True).as_dict()["smallest_friction"] is None


def _hung(*points, gap=0.002, apart=0.0):
    """A bar under a fixed beam, held at `points` of its upper side."""
    anchors = tuple(((x, y, 0.04), (x, y, apart - gap)) for x, y in points)
    return scene_of(
        placed("beam", asset_of(box(0.5, 0.1, 0.1)), (0, 0, 1), fixed=True),
        placed("bar", asset_of(box(0.3, 0.04, 0.04)), (0, 0, 1 - gap - 0.04)),
        attachments=(Attachment(child="bar", parent="beam", anchors=anchors),),
    )


@pytest.mark.parametrize(
    ("points", "balanced"),
    [(((0, 0),), True), (((-0.1, 0), (0.1, 0)), True), (((0.1, 0),), False), (((-0.1, 0.01), (0.1, 0.01)), False)],
)
def test_anchors_carry_what_is_plumb_below_them(points, balanced):
    """A point holds the centre of mass below it; two hold what is below their line; friction plays no part."""
    assert certify(_hung(*points), friction=0.0).passed is balanced


def test_what_is_missing_for_a_bar_held_off_its_middle_is_the_least_possible():
    """Held 3 cm off and 2 cm above its centre, a tenth and a fifteenth of its size.

    Errors of the force, a share t of the weight in any direction, change the torque of a tenth by at most
    t |(1/10, 1/15)|; the least t equals what is left of the torque.
    """
    expected = 0.1 / (1.0 + math.hypot(1 / 10, 1 / 15))
    assert certify(_hung((0.03, 0.0)), friction=0.0).worst == pytest.approx(expected, abs=1e-6)


def test_an_anchor_that_came_apart_carries_nothing():
    assert not certify(_hung((0, 0), apart=0.002)).passed


@pytest.mark.parametrize(("y", "balanced"), [(0.0, True), (0.008, False)])
def test_what_lies_on_a_hanging_bar_is_carried_with_it(y, balanced):
    """A cube on the bar, beside the line of the anchors, turns the bar."""
    scene = _hung((-0.1, 0), (0.1, 0), gap=0.05)
    top = scene["bar"].pose.position[2] + 0.04 + GAP
    cube = placed("cube", asset_of(box(0.03, 0.03, 0.03)), (0.05, y, top))
    assert certify(replace(scene, objects=(*scene.objects, cube))).passed is balanced
