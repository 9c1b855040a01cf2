"""When arrangements hold: blocks at given places, moved across the border of every definition."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import Body, distance, place, place_all
from pat3d.layout.layout import arrange
from pat3d.layout.leaning import BEYOND, leaning_rotation
from pat3d.layout.postures import posture_rotation
from pat3d.layout.predicates import check_arranged, check_relations
from pat3d.layout.spans import crossing
from pat3d.scene.arrangements import Arrangement, Posture
from pat3d.scene.asset import Region
from pat3d.scene.model import Relation
from tests.layout.things import asset, ball, block, mug, pen, shelf, table, vessel

SIDE = 0.06


def holds(kind, places, objects, of=(), assets=None) -> bool:
    """Whether `kind` holds for blocks at `places`: x, y [m] and a yaw [degrees], or poses."""
    poses = {
        name: at
        if isinstance(at, Pose)
        else Pose.from_yaw(math.radians(at[2] if len(at) > 2 else 0.0), (at[0], at[1], 0.0))
        for name, at in places.items()
    }
    things = {name: block() for name in places} | (assets or {})
    one = Arrangement(kind=kind, objects=tuple(objects), of=tuple(of))
    return check_arranged((one,), (), things, poses)[0].holds


def test_between_two_is_a_lens():
    """Seen from the middle of 1 m at a distance y the ends are 2 atan(0.5 / y) apart: 135 degrees at y = 0.207 m."""
    edge = 0.5 / math.tan(math.radians(135.0 / 2))
    for y, expected in ((0.0, True), (0.99 * edge, True), (1.01 * edge, False)):
        assert holds("between", {"a": (0, y), "b": (-0.5, 0), "c": (0.5, 0)}, "a", "bc") is expected
    assert not holds("between", {"a": (0.8, 0), "b": (-0.5, 0), "c": (0.5, 0)}, "a", "bc")


def test_between_three_is_inside_their_triangle():
    corners = {"b": (-0.5, 0), "c": (0.5, 0), "d": (0, 1)}
    assert holds("between", {"a": (0, 0.1), **corners}, "a", "bcd")
    assert not holds("between", {"a": (0, -0.1), **corners}, "a", "bcd")


def test_far_is_beyond_what_next_to_allows():
    """Blocks of 6 cm: next to each other up to a gap of 0.25 m, far from 1.5 times that."""
    for gap, near, far in ((0.24, True, False), (0.3, False, False), (0.38, False, True)):
        places = {"a": (0, 0), "b": (SIDE + gap, 0)}
        poses = {name: Pose.from_yaw(0.0, (*at, 0.0)) for name, at in places.items()}
        beside = Relation(child="a", kind="next_to", parent="b")
        assert check_relations((beside,), dict.fromkeys("ab", block()), poses)[0].holds is near
        assert holds("far_from", places, "a", "b") is far
        assert holds("far_from", places, "ab") is far


def test_a_row_is_straight_in_order_and_evenly_spaced():
    assert holds("row", {"a": (0, 0), "b": (0.2, 0), "c": (0.4, 0)}, "abc")
    assert holds("row", {"a": (0, 0), "b": (-0.1, 0.1), "c": (-0.2, 0.2)}, "abc")
    assert not holds("row", {"a": (0, 0), "b": (0.4, 0), "c": (0.2, 0)}, "abc"), "not in order"
    assert not holds("row", {"a": (0, 0), "b": (0.1, 0), "c": (0.4, 0)}, "abc"), "uneven"
    assert not holds("row", {"a": (0, 0), "b": (0.2, 0.05), "c": (0.4, 0)}, "abc"), "not straight"


def test_the_ends_of_what_is_in_a_row_are_off_the_line_by_no_more_than_its_middles_may_be():
    """Boards of 0.2 m that stand 25 cm apart: 37.5 mm allowed at an end 0.1 m away, 22 degrees, of which 15 at most.

    Of boards 0.4 m long, 5 cm apart, end to end at 0.4012 m: 10 mm at 0.2 m are 2.9 degrees.
    """
    board = dict.fromkeys("abc", block(x=0.2, y=0.02))
    for yaw, expected in ((14, True), (16, False), (90, False)):
        places = {"a": (0, 0), "b": (0.25, 0, yaw), "c": (0.5, 0)}
        assert holds("row", places, "abc", assets=board) is expected, yaw
    long = dict.fromkeys("abc", block(x=0.02, y=0.4))
    limit = math.degrees(math.asin(0.01 / math.hypot(0.2, 0.01)))
    for share, expected in ((0.95, True), (1.05, False)):
        places = {"a": (0, 0), "b": (0.05, 0, share * limit), "c": (0.1, 0)}
        assert holds("row", places, "abc", assets=long) is expected, share


def test_a_round_thing_in_a_row_is_turned_anyhow_and_a_turned_row_is_one():
    assert holds("row", {"a": (0, 0), "b": (0.2, 0, 77), "c": (0.4, 0)}, "abc", assets=dict.fromkeys("abc", ball()))
    slanted = {name: (0.2 * k * math.cos(0.5), 0.2 * k * math.sin(0.5), 28.6) for k, name in enumerate("abc")}
    assert holds("row", slanted, "abc")
    tipped = Pose(position=(0.2, SIDE / 2, 0.0), quat_wxyz=(0.5**0.5, 0.5**0.5, 0.0, 0.0))
    assert holds("row", {"a": (0, 0), "b": tipped, "c": (0.4, 0)}, "abc"), "on its side and turned by nothing"


def test_a_row_of_unequal_things_may_have_equal_gaps_or_equal_distances():
    wide = {"b": block(x=0.2)}
    assert holds("row", {"a": (0, 0), "b": (0.2, 0), "c": (0.4, 0), "d": (0.53, 0)}, "abcd", assets=wide)
    assert holds("row", {"a": (0, 0), "b": (0.2, 0), "c": (0.4, 0), "d": (0.6, 0)}, "abcd", assets=wide)
    assert not holds("row", {"a": (0, 0), "b": (0.2, 0), "c": (0.4, 0), "d": (0.72, 0)}, "abcd", assets=wide)


def test_side_by_side_is_near_and_turned_alike():
    assert holds("side_by_side", {"a": (0, 0), "b": (0.1, 0)}, "ab")
    assert holds("side_by_side", {"a": (0, 0), "b": (0.1, 0, 10)}, "ab")
    assert not holds("side_by_side", {"a": (0, 0), "b": (0.1, 0, 40)}, "ab")
    assert not holds("side_by_side", {"a": (0, 0), "b": (0.5, 0)}, "ab")


@pytest.mark.parametrize("sense", [1, -1])
def test_a_circle_is_round_even_and_in_order(sense):
    ring = [(0.3 * math.cos(a), 0.3 * sense * math.sin(a)) for a in np.linspace(0, 2 * math.pi, 6)[:5]]
    places = dict(zip("abcde", ring, strict=True))
    assert holds("circle", places, "abcde")
    assert holds("circle", {**places, "m": (0, 0)}, "abcde", "m")
    assert not holds("circle", {**places, "m": (0.1, 0)}, "abcde", "m"), "the centre is elsewhere"
    assert not holds("circle", places, "acbde"), "not in order"
    assert not holds("circle", {**places, "a": (0.2, 0)}, "abcde"), "not round"
    assert not holds("circle", {**places, "a": (0.3 * math.cos(0.5), 0.3 * math.sin(0.5))}, "abcde"), "uneven"


def test_the_front_is_at_minus_y():
    assert holds("facing", {"a": (0, 0), "b": (0, -1)}, "a", "b")
    assert not holds("facing", {"a": (0, 0), "b": (0, 1)}, "a", "b")
    assert holds("facing", {"a": (0, 0, 90), "b": (1, 0)}, "a", "b")
    assert holds("facing", {"a": (0, 0, 90), "b": (1, math.tan(math.radians(19)))}, "a", "b")
    assert not holds("facing", {"a": (0, 0, 90), "b": (1, math.tan(math.radians(21)))}, "a", "b")
    assert holds("facing", {"a": (0, 0, 90), "b": (1, 0, -90)}, "ab")
    assert not holds("facing", {"a": (0, 0, 90), "b": (1, 0, 90)}, "ab")


@pytest.mark.parametrize("yaw", [0.0, 30.0])
def test_places_are_measured_in_the_frame_of_the_surface(yaw):
    """On a table of 1.2 x 0.8 m: at the edge within 15 % of half its size, 9 cm along x and 6 cm along y."""
    top = 0.74
    turned = Pose.from_yaw(math.radians(yaw), (0.3, 0.2, 0.0))

    def at(kind: str, x: float, y: float) -> bool:
        position = turned.apply(np.array([[x, y, top]]))[0]
        places = {"t": turned, "a": Pose.from_yaw(math.radians(yaw), tuple(position))}
        return holds(kind, places, "a", "t", {"t": table()})

    assert at("in_middle", 0.08, 0.05)
    assert not at("in_middle", 0.1, 0.0)
    assert at("at_edge", 0.49, 0.0)
    assert not at("at_edge", 0.47, 0.0)
    assert not at("in_corner", 0.49, 0.0)
    assert at("in_corner", 0.49, -0.32)
    assert not at("at_edge", 2.0, 0.0), "beside the table"


def test_what_is_under_has_its_top_below_the_underside():
    """The top of the table is 4 cm thick, its underside 0.7 m high."""
    assert holds("under", {"t": (0, 0), "a": (0.3, 0.1)}, "a", "t", {"t": table()})
    assert not holds("under", {"t": (0, 0), "a": (0.7, 0.1)}, "a", "t", {"t": table()})
    assert not holds("under", {"t": (0, 0), "a": Pose(position=(0, 0, 0.65))}, "a", "t", {"t": table()})
    assert not holds("under", {"t": (0, 0), "a": Pose(position=(0, 0, 0.741))}, "a", "t", {"t": table()})


def test_a_small_thing_under_a_vessel_that_is_upside_down_is_in_its_cavity():
    """The vessel is 10 cm tall with a floor of 6 mm: inside it, 9.4 cm are free."""
    over = {"v": Pose(position=(0.0, 0.0, 0.1), quat_wxyz=(0.0, 1.0, 0.0, 0.0))}
    vessels = {"v": vessel(0.09, 0.1)}
    assert holds("under", {**over, "a": (0.01, 0)}, "a", "v", vessels)
    assert not holds("under", {**over, "a": (0.2, 0)}, "a", "v", vessels), "beside it"
    assert not holds("under", {**over, "a": Pose(position=(0, 0, 0.1))}, "a", "v", vessels), "on it"
    assert not holds("under", {**over, "a": (0, 0)}, "a", "v", {**vessels, "a": block(z=0.096)}), "through it"


@pytest.mark.parametrize("seed", range(3))
def test_what_is_under_one_thing_stands_there_together(seed):
    """Two under a table on the floor, two under a vessel that stands upside down on it; one more has no room."""
    assets = {"table": table(), "pot": vessel(0.12, 0.1), **{name: block(0.05, 0.05, 0.05) for name in "ab"},
              "c": block(0.4, 0.3, 0.4), "d": block(0.3, 0.3, 0.5)}  # fmt: skip
    on = tuple(Relation(child=name, kind="on", parent="table") for name in ("pot", "a", "b"))
    asked = (
        Arrangement(kind="under", objects=("a", "b"), of=("pot",)),
        Arrangement(kind="under", objects=("c",), of=("table",)),
        Arrangement(kind="under", objects=("d",), of=("table",)),
    )
    poses = arrange(assets, on, seed=seed, arrangements=asked, postures={"pot": "upside_down"}).poses
    assert [result for result in check_arranged(asked, (), assets, poses) if not result.holds] == []
    more = (replace(asked[0], objects=("a", "b", "e")), *asked[1:])
    further = Relation(child="e", kind="on", parent="table")
    with pytest.raises(LayoutError, match=r'"e" .* does not fit under "pot" beside "a", "b"'):
        arrange({**assets, "e": block(0.05, 0.15, 0.05)}, (*on, further), seed=seed, arrangements=more,
                postures={"pot": "upside_down"})  # fmt: skip


def test_in_corners_is_one_in_each_and_in_a_corner_is_all_in_one():
    """On 1.2 x 0.8 m; blocks of 6 cm."""
    tops = {"t": table()}
    corner = {"a": (0.53, 0.33), "b": (-0.53, 0.33), "c": (0.44, 0.33), "d": (0.53, -0.33)}

    def at(kind: str, names: str) -> bool:
        poses = {name: Pose(position=(*corner[name], 0.74)) for name in names}
        return holds(kind, {**poses, "t": (0, 0)}, names, "t", tops)

    assert at("in_corners", "abd")
    assert not at("in_corners", "ac"), "both in the same corner"
    assert at("in_corner", "ac")
    assert not at("in_corner", "ab"), "in two corners"
    assert not at("in_corner", "bd"), "in opposite corners"


def test_two_at_the_ends_are_one_at_each_of_the_longer_side():
    """On 1.2 x 0.8 m, and on the same a quarter turned; blocks of 6 cm."""
    end = {"a": (0.53, 0.0), "b": (-0.53, 0.2), "c": (0.0, 0.35), "d": (0.0, -0.35), "e": (-0.4, 0.0)}

    def at(names: str, width: float = 1.2, depth: float = 0.8) -> bool:
        poses = {name: Pose(position=(*end[name], 0.74)) for name in names}
        return holds("at_ends", {**poses, "t": (0, 0)}, names, "t", {"t": table(width, depth)})

    assert at("ab")
    assert not at("cd"), "at the middles of the longer sides"
    assert not at("ae"), "one of them 17 cm from its end"
    assert at("cd", width=0.8, depth=0.8) is False
    assert at("cd", width=0.7, depth=0.8)


@pytest.mark.parametrize("seed", range(3))
def test_layouts_put_things_at_the_ends_they_are_asked_for(seed):
    assets = {"table": table(), **{name: block() for name in "abc"}}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in "abc")
    asked = Arrangement(kind="at_ends", objects=("a", "b"), of=("table",))
    poses = arrange(assets, on, seed=seed, arrangements=(asked,)).poses
    assert [result for result in check_arranged((asked,), (), assets, poses) if not result.holds] == []
    assert abs(poses["a"].position[0] - poses["b"].position[0]) > 1.0


@pytest.mark.parametrize("seed", range(3))
def test_layouts_put_things_into_the_corners_they_are_asked_for(seed):
    assets = {"table": table(), **{name: block() for name in "abcdefg"}}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in "abcdefg")
    for asked in (
        Arrangement(kind="in_corners", objects=tuple("abcd"), of=("table",)),
        Arrangement(kind="in_corner", objects=tuple("efg"), of=("table",)),
    ):
        poses = arrange(assets, on, seed=seed, arrangements=(asked,)).poses
        assert [result for result in check_arranged((asked,), (), assets, poses) if not result.holds] == []


def test_a_round_table_has_no_corner():
    round_table = asset("table", shapes.cylinder(0.5, 0.7, sides=32),
                        Region(kind="on", shape="disc", floor=(0, 0, 0.7), half_size=(0.5, 0.5)))  # fmt: skip
    on = (Relation(child="a", kind="on", parent="table"),)
    asked = (Arrangement(kind="in_corner", objects=("a",), of=("table",)),)
    with pytest.raises(LayoutError, match='a corner of "table", which is round'):
        arrange({"table": round_table, "a": block()}, on, seed=0, arrangements=asked)


def test_a_circle_around_several_things_has_all_of_them_inside():
    ring = {
        name: (0.3 * math.cos(k * math.tau / 5), 0.3 * math.sin(k * math.tau / 5)) for k, name in enumerate("abcde")
    }
    assert holds("circle", {**ring, "m": (-0.05, 0), "n": (0.05, 0)}, "abcde", "mn")
    assert not holds("circle", {**ring, "m": (-0.35, 0), "n": (0.35, 0)}, "abcde", "mn"), "around neither"
    assert not holds("circle", {**ring, "m": (0.05, 0), "n": (0.15, 0)}, "abcde", "mn"), "their middle is elsewhere"


@pytest.mark.parametrize("inside", [2, 4])
def test_layouts_have_a_circle_around_several_things(inside):
    assets = {"table": table(), **{name: block() for name in "abcdefg"}, **{name: mug() for name in "wxyz"[:inside]}}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in assets if name != "table")
    asked = (Arrangement(kind="circle", objects=tuple("abcdefg"), of=tuple("wxyz"[:inside])),)
    poses = arrange(assets, on, seed=0, arrangements=asked).poses
    assert check_arranged(asked, (), assets, poses)[0].holds


def test_rows_that_cross_are_a_grid_only_at_right_angles():
    """2 x 2 blocks 20 cm apart: any two things are a row, four need their lines to cross at 75 degrees at least."""
    rows = tuple(Arrangement(kind="row", objects=tuple(names)) for names in ("ab", "cd", "ac", "bd"))
    for askew, expected in ((0.0, True), (10.0, True), (20.0, False)):
        shift = 0.2 * math.tan(math.radians(askew))
        places = {"a": (0, 0), "b": (0.2, 0), "c": (shift, 0.2), "d": (0.2 + shift, 0.2)}
        poses = {name: Pose(position=(*at, 0.0)) for name, at in places.items()}
        found = check_arranged(rows, (), dict.fromkeys(places, block()), poses)
        assert {result.holds for result in found} == {expected}
    poses["c"], poses["d"] = Pose(position=(0, 0.2, 0)), Pose(position=(0.36, 0.2, 0))
    assert not any(result.holds for result in check_arranged(rows, (), dict.fromkeys(places, block()), poses))


@pytest.mark.parametrize("names", ["ab", "abc", "abcd", "abcdef"])
@pytest.mark.parametrize("wide", [0.2, 0.8, 1.6])
def test_several_that_face_one_thing_stand_in_a_row_before_it(names, wide):
    assets = {"tv": block(wide, 0.2, 0.6), **{name: block(0.4, 0.4, 0.9, noun="chair") for name in names}}
    asked = (Arrangement(kind="facing", objects=tuple(names), of=("tv",)),)
    poses = arrange(assets, (), seed=0, arrangements=asked).poses
    row = Arrangement(kind="row", objects=tuple(names))
    assert [result for result in check_arranged((*asked, row), (), assets, poses) if not result.holds] == []


@pytest.mark.parametrize("seed", range(2))
def test_what_leans_on_a_stack_touches_one_of_it(seed):
    """A board of 25 cm on three blocks, 18 cm high: in the layout it is a gap from one, and far from the lowest."""
    assets = {"a": block(0.1, 0.01, 0.25), "x": block(), "y": block(0.05, 0.05, 0.06), "z": block()}
    stack = (Relation(child="y", kind="on", parent="x"), Relation(child="z", kind="on", parent="y"))
    asked = Arrangement(kind="leaning_against", objects=("a",), of=("x", "y", "z"))
    poses = arrange(assets, stack, seed=seed, arrangements=(asked,)).poses
    near = 0.003
    assert check_arranged((asked,), (), assets, poses, touch=near)[0].holds
    assert not check_arranged((replace(asked, of=("x",)),), (), assets, poses, touch=near)[0].holds
    assert not check_arranged((asked,), (), assets, poses, touch=1e-4)[0].holds


def test_several_lean_on_one_thing_beside_each_other_and_on_nothing_low():
    assets = {
        "bench": block(1.0, 0.3, 0.4),
        "low": block(1.0, 0.3, 0.05),
        **{name: block(0.1, 0.01, 0.5) for name in "abc"},
    }
    lean = tuple(Arrangement(kind="leaning_against", objects=(name,), of=("bench",)) for name in "abc")
    poses = arrange(assets, (), seed=0, arrangements=lean).poses
    assert all(result.holds for result in check_arranged(lean, (), assets, poses, touch=0.003))
    bodies = place_all(assets, poses)
    gaps = [distance(bodies[a], bodies[b]) for a, b in ("ab", "bc", "ac")]
    assert all(one is not None and one.distance > 0.015 for one in gaps)
    with pytest.raises(LayoutError, match=r'"low" \(0.05 m high\) is too low for "a"'):
        arrange(assets, (), seed=0, arrangements=(replace(lean[0], of=("low",)),))


def test_what_leans_would_fall_without():
    wall, board = block(0.1, 0.1, 0.3), block(0.1, 0.01, 0.25)
    tilted = leaning_rotation(Body("board", board), np.array([0.0, 1.0, 0.0]))
    turned = board.bounds.mean(axis=0) + (np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T) * (
        board.size / 2
    )
    reach = turned @ tilted.T
    touching = Pose.from_matrix(tilted, np.array([0.0, -0.05 - reach[:, 1].max() - 1e-4, -reach[:, 2].min()]))
    both = {"wall": wall, "a": board}
    assert holds("leaning_against", {"wall": (0, 0), "a": touching}, "a", ["wall"], both)
    apart = Pose(position=(0, touching.position[1] - 0.01, touching.position[2]), quat_wxyz=touching.quat_wxyz)
    assert not holds("leaning_against", {"wall": (0, 0), "a": apart}, "a", ["wall"], both)
    standing = Pose(position=(0, -0.0551, 0.0))
    assert not holds("leaning_against", {"wall": (0, 0), "a": standing}, "a", ["wall"], both)


def test_leaning_things_are_tilted_enough_to_fall_to_the_wall_and_little_enough_not_to_slide():
    """A board 1 cm thick, 25 cm long: 9 degrees. One 10 cm thick and 30 long needs 24; ladders slide from 22.6 on."""
    tilt = leaning_rotation(Body("board", block(0.1, 0.01, 0.25)), np.array([1.0, 0.0, 0.0]))
    assert math.degrees(math.acos(tilt[2, 2])) == pytest.approx(9.0)
    lying = leaning_rotation(Body("pen", block(0.3, 0.1, 0.02)), np.array([0.0, 1.0, 0.0]))
    assert lying[2, 0] == pytest.approx(math.cos(math.atan2(0.02, 0.3) + BEYOND)), "its length is up"
    assert lying[1, 2] < -0.9, "its top is turned away"
    assert np.linalg.det(lying) == pytest.approx(1.0)
    with pytest.raises(LayoutError, match="too thick to lean"):
        leaning_rotation(Body("chest", block(0.3, 0.1, 0.25)), np.array([0.0, 1.0, 0.0]))


def bent(*points: tuple[float, float], heavy: float = 0.0):
    """A bar 1 cm wide and 2 mm thick whose underside goes through (x, z); with a box on it that starts at `heavy`."""
    bars = [
        shapes.convex([(x, y, z + up) for x, z in pair for y in (-0.005, 0.005) for up in (0.0, 0.002)])
        for pair in zip(points, points[1:], strict=False)
    ]
    if heavy:
        bars.append(shapes.box(0.02, 0.01, 0.02).moved(heavy, 0.0, points[0][1] + 0.001))
    return asset("bar", shapes.join(*bars))


def crossing_of(bar, carrier=None):
    return crossing(place("a", bar, Pose()), place("b", carrier or vessel(0.05, 0.05), Pose()))


def test_what_lies_across_has_its_centre_of_mass_between_its_supports_and_not_its_middle():
    """The box on the left moves the centre of mass 5 cm from the middle of a bar of 20 cm, beyond a rim of 10 cm."""
    bar = bent((-0.1, 0.0), (0.1, 0.0), heavy=-0.085)
    found = crossing_of(bar)
    centre = bar.mass_properties.centre_of_mass[0] + found.position[0]
    assert bar.mass_properties.centre_of_mass[0] < -0.04
    assert abs(centre) < 0.042
    assert crossing_of(bent((-0.1, 0.0), (0.1, 0.0))).position == pytest.approx([0.0, 0.0], abs=1e-3)


def test_what_lies_across_is_tilted_until_both_supports_are_level():
    """The underside steps up by 1 cm: over 10 cm between the supports that is 5.7 degrees."""
    bar = bent((-0.1, 0.0), (-0.005, 0.0), (0.005, 0.01), (0.1, 0.01))
    found = crossing_of(bar)
    pitch = math.degrees(math.asin(found.rotation[2, 0]))
    assert pitch == pytest.approx(-math.degrees(math.atan2(0.01, 0.096)), abs=0.3)


@pytest.mark.parametrize(("slope", "stays"), [(2.0, True), (5.0, True), (8.0, False), (15.0, False)])
def test_what_slides_down_its_own_slope_does_not_lie_across(slope, stays):
    """Two halves that both slope down to the right by `slope`, a step between; friction may have to hold 6 degrees."""
    rise = 0.0525 * math.tan(math.radians(slope))
    saw = bent((-0.11, rise), (-0.005, -rise), (0.005, rise), (0.11, -rise))
    assert (crossing_of(saw, vessel(0.062, 0.05)) is not None) == stays


def test_postures_put_a_flat_face_down():
    down = posture_rotation(Body("mug", mug()), "upside_down")
    assert down[2, 2] == pytest.approx(-1.0)
    side = posture_rotation(Body("block", block(0.05, 0.06, 0.2)), "on_its_side")
    np.testing.assert_allclose(side[:, 2], [1.0, 0.0, 0.0], atol=1e-9)
    assert abs((side.T @ [0, 0, -1])[0]) == pytest.approx(1.0), "on one of its wider sides, 6 x 20 cm"
    assert check_arranged((), (Posture(object="a", kind="on_its_side"),), {"a": block()},
                          {"a": Pose.from_matrix(side, np.zeros(3))})[0].holds  # fmt: skip
    domino = posture_rotation(Body("domino", block(0.05, 0.025, 0.009, noun="domino")), "on_its_side")
    np.testing.assert_allclose(domino @ [1, 0, 0], [0, 0, 1], atol=1e-9, err_msg="on its end")
    np.testing.assert_allclose(np.abs(domino @ [0, 0, 1]), [1, 0, 0], atol=1e-9, err_msg="its face to the next")
    with pytest.raises(LayoutError, match='"pin" cannot stay upside down'):
        posture_rotation(Body("pin", block(0.004, 0.004, 0.2)), "upside_down")


@pytest.mark.parametrize("seed", range(4))
def test_layouts_have_what_they_are_asked_for(seed):
    """On one table: a row with one of it in a corner, something between, far off, and upside down."""
    assets = {"table": table(), **{name: block() for name in "abcd"}, "mug": mug(), "ball": ball()}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in assets if name != "table")
    asked = (
        Arrangement(kind="row", objects=("a", "b", "c")),
        Arrangement(kind="in_corner", objects=("a",), of=("table",)),
        Arrangement(kind="between", objects=("mug",), of=("c", "d")),
        Arrangement(kind="far_from", objects=("ball",), of=("a",)),
    )
    layout = arrange(assets, on, seed=seed, arrangements=asked, postures={"mug": "upside_down"})
    found = check_arranged(asked, (Posture(object="mug", kind="upside_down"),), assets, layout.poses)
    assert [result for result in found if not result.holds] == []


@pytest.mark.parametrize(("deep", "across"), [(0.6, 90.0), (0.1, 0.0)])
def test_slender_things_in_a_row_lie_side_by_side_where_there_is_room_across(deep, across):
    rod = block(0.2, 0.02, 0.02, noun="ruler")
    assets = {"table": table(y=deep), **dict.fromkeys("abc", rod)}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in "abc")
    asked = (Arrangement(kind="row", objects=tuple("abc")),)
    poses = arrange(assets, on, seed=0, arrangements=asked).poses
    quats = [poses[name].quat_wxyz for name in "abc"]
    assert [round(math.degrees(2 * math.atan2(one[3], one[0])), 6) for one in quats] == [across] * 3
    assert [result for result in check_arranged(asked, (), assets, poses) if not result.holds] == []


def test_what_is_in_the_middle_leaves_room_for_what_stands_before_it():
    """A desk 0.52 m deep: in front of a monitor in its very middle a keyboard would stick out too far."""
    assets = {"table": table(y=0.52), "a": block(0.3, 0.22, 0.4), "b": block(0.44, 0.17, 0.02)}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in "ab")
    before = Relation(child="b", kind="in_front_of", parent="a")
    asked = (Arrangement(kind="in_middle", objects=("a",), of=("table",)),)
    poses = arrange(assets, (*on, before), seed=0, arrangements=asked).poses
    assert [result for result in check_arranged(asked, (), assets, poses) if not result.holds] == []
    assert [result for result in check_relations((before,), assets, poses) if not result.holds] == []


def test_a_layout_without_arrangements_does_not_depend_on_them():
    """Asking for nothing, and for what the layout does anyway, give the same poses."""
    assets = {"table": table(), "mug": mug()}
    on = (Relation(child="mug", kind="on", parent="table"),)
    plain = arrange(assets, on, seed=3)
    assert arrange(assets, on, seed=3, arrangements=(), postures={"mug": "upright"}).poses == plain.poses


def test_across_is_beyond_the_rim_at_both_ends():
    """A pen of 15 cm over a bowl 12 cm wide may be 15 mm off the middle, along it, whatever its yaw."""
    bowl = vessel(0.06, 0.05)
    rim = Body("bowl", bowl).at(np.eye(3), np.zeros(3)).vertices[:, :2]
    for yaw in (0.0, math.radians(40)):
        wide = float(np.ptp(rim @ np.array([math.cos(yaw), math.sin(yaw)])))
        room = (0.15 - wide) / 2
        for off, expected in ((0.0, True), (room - 1e-3, True), (room + 1e-3, False), (-room - 1e-3, False)):
            at = Pose.from_yaw(yaw, (off * math.cos(yaw), off * math.sin(yaw), 0.054))
            assert holds("across", {"a": at, "b": (0, 0)}, "a", "b", {"a": pen(), "b": bowl}) is expected
    leaning = Pose(position=(0.02, 0, 0.04), quat_wxyz=(math.cos(0.4), 0, math.sin(0.4), 0))
    assert not holds("across", {"a": leaning, "b": (0, 0)}, "a", "b", {"a": pen(), "b": bowl})


def test_what_is_laid_across_a_bowl_bridges_it_and_what_is_too_short_is_refused():
    relations = (Relation(child="a", kind="on", parent="b"),)
    across = Arrangement(kind="across", objects=("a",), of=("b",))
    things = {"a": pen(), "b": vessel(0.06, 0.05)}
    layout = arrange(things, relations, seed=0, arrangements=(across,))
    assert check_arranged((across,), (), things, layout.poses)[0].holds
    with pytest.raises(LayoutError, match=r'"a" \(0.10 m long\) does not reach across "b"'):
        arrange({**things, "a": pen(0.1)}, relations, seed=0, arrangements=(across,))


def book(thick: float = 0.03):
    return block(x=0.16, y=0.22, z=thick, noun="book")


def on_shelf(names):
    return tuple(Relation(child=name, kind="on", parent="shelf") for name in names)


@pytest.mark.parametrize("seed", range(3))
def test_books_in_a_row_stand_on_one_tier_close_together_between_bookends_that_turn_their_plates_to_them(seed):
    books = {name: book(0.02 + 0.005 * k) for k, name in enumerate("abcd")}
    ends = {
        "left": block(x=0.12, y=0.12, z=0.15, noun="bookend"),
        "right": block(x=0.12, y=0.12, z=0.15, noun="bookend"),
    }
    assets = {"shelf": shelf(), **books, **ends}
    asked = (
        Arrangement(kind="row", objects=tuple(books)),
        Arrangement(kind="between", objects=tuple(books), of=("left", "right")),
    )
    stood = dict.fromkeys(books, "on_its_side")
    poses = arrange(assets, on_shelf([*books, *ends]), seed=seed, arrangements=asked, postures=stood).poses
    found = check_arranged(asked, tuple(Posture(object=name, kind="on_its_side") for name in books), assets, poses)
    assert [result for result in found if not result.holds] == []
    placed = place_all(assets, poses)
    order = ["left", *books, "right"]
    gaps = [placed[b].low[0] - placed[a].high[0] for a, b in pairwise(order)]
    assert gaps == pytest.approx([0.003] * 5, abs=1e-6)
    for name in books:
        assert placed[name].rotation @ [-1, 0, 0] == pytest.approx([0, -1, 0], abs=1e-9), "its spine is in front"
        assert placed[name].rotation @ [0, -1, 0] == pytest.approx([0, 0, -1], abs=1e-9), "on its lower edge"
    # The plate of a bookend is at -x of its own.
    assert placed["left"].rotation[0, 0] == pytest.approx(-1.0)
    assert placed["right"].rotation[0, 0] == pytest.approx(1.0)


@pytest.mark.parametrize("count", [4, 9])
def test_what_stands_beside_another_is_never_on_another_tier(count):
    """Boxes of 20 cm, each left of the next: four fit a tier of 0.78 m, and nine are refused, not parted."""
    names = [f"box {k}" for k in range(count)]
    assets = {"shelf": shelf(), **dict.fromkeys(names, block(0.18, 0.1, 0.1, noun="box"))}
    beside = tuple(Relation(child=a, kind="left_of", parent=b) for a, b in pairwise(names))
    if count > 4:
        with pytest.raises(LayoutError, match='finds no room on "shelf"'):
            arrange(assets, on_shelf(names) + beside, seed=0)
        return
    poses = arrange(assets, on_shelf(names) + beside, seed=0).poses
    assert len({round(poses[name].position[2], 3) for name in names}) == 1
    assert [found for found in check_relations(beside, assets, poses) if not found.holds] == []


@pytest.mark.parametrize("tall", [0.2, 0.24])
def test_of_books_side_by_side_the_second_leans_on_the_first_and_the_third_stands_by_it(tall):
    """It may be the taller one, whose top is then above the first."""
    assets = {"shelf": shelf(), **{name: book() for name in "abc"}, "b": block(x=0.16, y=tall, z=0.03, noun="book")}
    asked = (
        Arrangement(kind="side_by_side", objects=tuple("abc")),
        Arrangement(kind="leaning_against", objects=("b",), of=("a",)),
    )
    beside = (Relation(child="a", kind="left_of", parent="b"), Relation(child="b", kind="left_of", parent="c"))
    postures = dict.fromkeys("ac", "on_its_side")
    poses = arrange(assets, on_shelf("abc") + beside, seed=0, arrangements=asked, postures=postures).poses
    placed = place_all(assets, poses)
    row, _ = check_arranged(asked, (), assets, poses)
    assert row.holds, row.detail
    upper = placed["b"].rotation @ [0, 1, 0]
    assert upper[0] < -0.1, "to the left"
    assert distance(placed["a"], placed["b"]).distance < 0.003
    assert placed["c"].low[0] > placed["b"].high[0]
