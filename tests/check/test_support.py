import math
from dataclasses import replace

import numpy as np
import pytest
import shapely

from pat3d.assets.shapes import Shape, box, cylinder, ellipsoid, frustum
from pat3d.check.certificate import certify
from pat3d.check.surfaces import beyond
from pat3d.check.wear import WEAR
from pat3d.geometry.pose import Pose
from tests.scenes import GAP, asset_of, placed, scene_of, tower

RADIUS, THICK = 0.05, 0.026


def _puck(spike):
    """A disc whose one convex part has a corner `spike` [m] beyond its rim towards x, as bad reductions leave them."""
    disc = cylinder(RADIUS, THICK)
    corners = [(RADIUS + spike, 0.0, z) for z in (0.0, THICK)]
    return asset_of(Shape(disc.solid, (np.concatenate([disc.hulls[0], corners]),)), noun="puck")


def _plank_on_puck(inside, spike=0.02):
    """A plank whose centre of mass is `inside` [m] within the puck's true rim."""
    plank = asset_of(box(0.06, 0.02, 0.01))
    return scene_of(
        placed("puck", _puck(spike), (0, 0, 0), fixed=True),
        placed("plank", plank, (RADIUS - inside, 0, THICK + GAP)),
    )


@pytest.mark.parametrize("inside", [0.003, 0.005])
def test_a_plank_with_its_weight_inside_a_true_rim_is_held(inside):
    certificate = certify(_plank_on_puck(inside), margin=True)
    assert certificate.passed
    assert certificate.support is not None
    assert certificate.support.excess["plank"] == pytest.approx(0.02, abs=2e-3)
    # The plank tips over the rim, 5 mm below its centre.
    assert certificate.largest_tilt <= math.degrees(math.atan(inside / 0.005)) + 0.1


@pytest.mark.parametrize("inside", [-0.001, -0.003, -0.005])
def test_a_plank_with_its_weight_on_the_excess_of_a_hull_is_refused(inside):
    """Its convex part reaches 2 cm beyond the rim and balances it; what a person sees falls."""
    scene = _plank_on_puck(inside)
    assert certify(scene).passed
    certificate = certify(scene, margin=True)
    assert not certificate.passed
    assert set(certificate.support.unsupported) == {"plank"}
    (line,) = certificate.unreal
    assert '"plank" is held only by convex parts that stick out' in line
    assert '"puck"' in line


def test_boxes_are_their_own_hulls():
    """No air, no excess, and the tilt of the convex parts."""
    support = certify(tower(3), margin=True).support
    assert support.failures == ()
    assert max(support.excess.values()) < 1e-6
    assert set(support.air.values()) == {1e-4}


def _lidded(depth):
    """A tin with a recess of `depth` [m] in its lid, 6 cm wide, that its convex part fills."""
    tin = cylinder(0.04, 0.1)
    return asset_of(Shape(tin.solid - cylinder(0.03, 0.05).moved(z=0.1 - depth).solid, tin.hulls), noun="tin")


@pytest.mark.parametrize(("depth", "held"), [(0.0005, True), (0.002, False), (0.003, False)])
def test_a_cube_over_a_filled_recess_floats(depth, held):
    """It fits into the recess, and the part that fills it carries it above the floor that is seen."""
    cube = asset_of(box(0.03, 0.03, 0.03))
    scene = scene_of(placed("tin", _lidded(depth), (0, 0, GAP)), placed("cube", cube, (0, 0, 0.1 + 2 * GAP)))
    certificate = certify(scene, margin=True)
    assert certify(scene).passed
    assert certificate.passed is held
    if held:
        assert certificate.support.air["cube"] == pytest.approx(depth, rel=0.05)
    else:
        assert certificate.support.unsupported["cube"][0].air == pytest.approx(depth, rel=0.05)


@pytest.mark.parametrize(("step", "held"), [(0.0002, True), (0.0006, False)])
def test_what_lies_on_the_high_side_of_a_lid_is_not_carried_by_its_low_side(step, held):
    """4 mm of the cube are on a ledge; under its weight the lid is lower, and it tips by degrees to reach that."""
    whole = box(0.1, 0.1, 0.05)
    low = box(0.1, 0.2, 0.01).moved(x=0.03, z=0.05 - step).solid
    lid = asset_of(Shape(whole.solid - low, whole.hulls), noun="lid")
    cube = asset_of(box(0.02, 0.02, 0.02))
    scene = scene_of(placed("lid", lid, fixed=True), placed("cube", cube, (-0.014, 0, 0.05 + GAP)))
    assert certify(scene).passed
    assert certify(scene, margin=True).passed is held


def test_a_cube_as_wide_as_the_rim_stands_on_it():
    """The recess is 3 mm deep and the rim 1 cm wide; a larger cube rests on the rim all around."""
    cube = asset_of(box(0.07, 0.07, 0.07))
    scene = scene_of(placed("tin", _lidded(0.003), (0, 0, GAP)), placed("cube", cube, (0, 0, 0.1 + 2 * GAP)))
    certificate = certify(scene, margin=True)
    assert certificate.passed
    assert certificate.support.air["cube"] == 1e-4


@pytest.mark.parametrize("sides", [6, 16])
def test_a_round_foot_tips_over_its_true_edge(sides):
    """The convex part of a tall cone on its small end has corners beyond the foot; the tilt is that of the circle."""
    radius, height = 0.01, 0.2
    asset = asset_of(cylinder(radius, height, sides=sides))
    scene = scene_of(placed("rod", asset, pose=Pose.from_yaw(0.1, (0, 0, GAP))))
    certificate = certify(scene, margin=True)
    ideal = math.degrees(math.atan(radius / (height / 2)))
    # 48 sides of the picture, sixteen corners of the support, sixteen directions: each inscribed in a circle.
    assert 0.93 * ideal <= certificate.outline_tilt <= 1.005 * ideal
    # Engines keep four of its contact points.
    assert 0.73 * ideal <= certificate.largest_tilt <= 0.92 * ideal


def test_a_thin_foot_of_a_wide_part_has_its_own_tilt():
    """A cone on its tip, cut to a foot of 1 cm, inside a part as wide as the cone: 20 cm over a foot of 5 mm radius."""
    cone = frustum(0.005, 0.03, 0.2)
    scene = scene_of(placed("cone", asset_of(Shape(cone.solid, cylinder(0.03, 0.2).hulls)), (0, 0, GAP)))
    certificate = certify(scene, margin=True)
    centre = float(scene["cone"].asset.mass_properties.centre_of_mass[2])
    foot = 0.005**2 / (0.005 + WEAR)
    assert certificate.outline_tilt == pytest.approx(math.degrees(math.atan(foot / centre)), rel=0.05)


def test_a_ball_in_a_part_around_it_touches_where_the_ball_does():
    """A ball on the flat side of its polyhedron: the surfaces meet in the middle of that side, within a cap."""
    ball = asset_of(ellipsoid(0.03).cut_below(-0.0299).moved(z=0.0299))
    certificate = certify(scene_of(placed("ball", ball, (0, 0, GAP))), margin=True)
    assert certificate.passed
    cap = math.sqrt(2 * 0.03 * 2e-4)
    assert certificate.largest_tilt <= math.degrees(math.atan(cap / 0.0299)) * 1.2


def test_what_leans_may_touch_a_little_further_on_than_what_stands():
    """A board against a wall whose part stands off 8 mm, over 1 % of its size, is held, and the air is said."""
    length, angle, off = 0.3, math.radians(70), 0.008
    wall = box(0.1, 0.6, 0.6)
    asset = asset_of(Shape(wall.moved(x=off).solid ^ wall.solid, wall.hulls), noun="wall")
    turn = np.array(
        [[math.sin(angle), 0, math.cos(angle)], [0, 1, 0], [-math.cos(angle), 0, math.sin(angle)]], dtype=np.float64
    )
    board = asset_of(box(0.02, 0.1, length))
    low = float((board.parts[0].vertices @ turn.T)[:, 2].min())
    right = float((board.parts[0].vertices @ turn.T)[:, 0].max())
    scene = scene_of(
        placed("wall", asset, (right + 0.05 + GAP, 0, 0), fixed=True),
        placed("board", board, pose=Pose.from_matrix(turn, np.array([0.0, 0.0, GAP - low]))),
        settling_friction=0.4,
    )
    certificate = certify(scene, margin=True)
    assert certificate.passed
    assert certificate.support.air["board"] == pytest.approx(off, rel=0.05)


def test_a_part_far_from_any_surface_carries_nothing():
    """A box seen as a small cube at the bottom of its tall part."""
    tall = Shape(box(0.1, 0.1, 0.1).solid, box(0.1, 0.1, 0.15).hulls)
    cube = asset_of(box(0.05, 0.05, 0.05))
    scene = scene_of(placed("tall", asset_of(tall), (0, 0, GAP)), placed("cube", cube, (0, 0, 0.15 + 2 * GAP)))
    certificate = certify(scene, margin=True)
    assert set(certificate.support.unsupported) == {"cube"}
    assert "more than 10 mm away" in certificate.unreal[0]
    assert certificate.as_dict()["support"]["unsupported"]["cube"][0]["second"] == "tall"


def test_a_ball_is_marked_as_neutral_on_a_table_and_as_rolling_off_another_ball():
    """Flat sides of their convex parts hold them still in engines; the round things are told apart."""
    ball, table = asset_of(ellipsoid(0.03).moved(z=0.03)), asset_of(box(0.3, 0.3, 0.02))
    # A polyhedron around a ball may stand on a corner; a block stands in for it.
    block = replace(ball, parts=asset_of(box(0.06, 0.06, 0.06)).parts)
    on_table = scene_of(placed("table", table, (0, 0, GAP)), placed("ball", block, (0, 0, 0.02 + 2 * GAP)))
    support = certify(on_table, margin=True).support
    assert dict(support.rolling) == {"ball": "neutral"}
    on_ball = scene_of(placed("under", block, (0, 0, 0), fixed=True), placed("ball", block, (0, 0, 0.06 + GAP)))
    certificate = certify(on_ball, margin=True)
    assert dict(certificate.support.rolling) == {"ball": "unstable"}
    assert not certificate.passed
    assert any('"ball" rests in one point' in line for line in certificate.unreal)
    assert certify(on_table, margin=True).passed


def test_an_egg_lies_on_its_side_and_a_box_does_not_roll():
    flat = asset_of(ellipsoid(0.05, 0.05, 0.03).moved(z=0.03))
    pebble = replace(flat, parts=asset_of(box(0.1, 0.1, 0.06)).parts)
    scene = scene_of(placed("pebble", pebble, (0, 0, GAP)), placed("box", asset_of(box(0.1, 0.1, 0.1)), (1, 0, GAP)))
    assert dict(certify(scene, margin=True).support.rolling) == {"pebble": "stable"}


def test_what_a_residual_may_leave_unbalanced_is_no_support_where_a_surface_a_little_further_off_is():
    """Of two posts the picture of one ends 0.4 mm below its part; the plank's weight is 60 um beside the other.

    Over the one post it is balanced but for 60 um of its 20 cm, which a residual may be, and stands no tilt; over both
    it stands any.
    """
    posts = (box(0.05, 0.06, 0.1).moved(x=-0.025 - 6e-5), box(0.05, 0.06, 0.1).moved(x=0.075))
    seen = posts[0].solid + box(0.05, 0.06, 0.0996).moved(x=0.075).solid
    trestle = asset_of(Shape(seen, (posts[0].hulls[0], posts[1].hulls[0])))
    scene = scene_of(
        placed("trestle", trestle, fixed=True), placed("plank", asset_of(box(0.2, 0.05, 0.01)), (0, 0, 0.1 + GAP))
    )
    certificate = certify(scene, margin=True)
    assert certificate.passed
    assert certificate.largest_tilt == pytest.approx(8.0)


@pytest.mark.parametrize("seed", range(5))
def test_the_distance_beyond_a_polygon_is_shapely_s(seed):
    rng = np.random.default_rng(seed)
    corners = np.array(shapely.MultiPoint(rng.normal(size=(8, 2))).convex_hull.exterior.coords)[:-1]
    points = rng.normal(scale=0.3 * seed, size=(6, 2))
    furthest = shapely.distance(shapely.Polygon(corners), shapely.points(points)).max()
    # The corners may come in any order.
    assert beyond(points, corners[rng.permutation(len(corners))]) == pytest.approx(furthest, abs=1e-12)


def test_a_log_on_a_table_may_roll_and_one_on_its_end_stands():
    """Its block of a part holds it still; what is seen is straight along one way and as round as it is high."""
    log = asset_of(cylinder(0.03, 0.2).turned("y", 90).moved(x=-0.1, z=0.03))
    lying = replace(log, parts=asset_of(box(0.2, 0.06, 0.06)).parts)
    standing = asset_of(cylinder(0.03, 0.2))
    scene = scene_of(
        placed("table", asset_of(box(0.8, 0.4, 0.02)), (0, 0, GAP)),
        placed("lying", lying, (0.2, 0, 0.02 + 2 * GAP)),
        placed("standing", standing, (-0.2, 0, 0.02 + 2 * GAP)),
    )
    certificate = certify(scene, margin=True)
    assert dict(certificate.support.rolling) == {"lying": "neutral"}
    assert certificate.passed
