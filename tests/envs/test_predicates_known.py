"""Predicates and verdicts on states of known geometry, world by world, without a simulation."""

from __future__ import annotations

import math

import numpy as np
import pytest

from pat3d.envs.physics.predicates import (
    CONTACT_DEPTH,
    FLOOR_ROW,
    LEVER,
    NEAR_GRASP,
    NEAR_HAND,
    OWNERS,
    ROBOT_ROW,
    judge_lift,
    judge_others,
    judge_put,
    judge_sort,
    judge_unload,
    pairs_that,
    reached,
    upsets,
)
from pat3d.envs.physics.snapshot import Floors, Grips, Snapshot

HAIR = 1e-9
HAND = 1
"""Site of the hand; another one is beside it."""

CHILD, PARENT, OTHER = 0, 1, 2

Vector = tuple[float, float, float]


def at_rest(worlds: int, objects: int = 3) -> Snapshot:
    """Objects a metre apart and 1 m up, that touch nothing; the last one cannot move."""
    bodies = np.arange(1, objects + 1)
    xpos = np.zeros((worlds, objects + 1, 3))
    xpos[:, bodies, 0], xpos[:, bodies, 2] = np.arange(objects), 1.0
    turns = np.tile(np.eye(3).reshape(9), (worlds, objects + 1, 1))
    count = OWNERS + objects
    return Snapshot(
        xpos=xpos,
        xmat=turns,
        xipos=xpos.copy(),
        qvel=np.zeros((worlds, 6 * objects)),
        sites=np.full((worlds, 2, 3), 50.0),
        site_xmat=np.tile(np.eye(3).reshape(9), (worlds, 2, 1)),
        touching=np.zeros((worlds, count, count), dtype=np.bool_),
        pinched=np.zeros((worlds, 2, count), dtype=np.bool_),
        start_centre=np.ascontiguousarray(xpos[:, bodies]),
        start_up=np.tile([0.0, 0.0, 1.0], (worlds, objects, 1)),
        bodies=bodies,
        dofs=np.array([*(6 * np.arange(objects - 1)), -1]),
        hand=HAND,
        surface=0.5,
        grips=grips_of(),
    )


def grips_of(*grasps: tuple[Vector, Vector, Vector], axis: Vector = (0.0, 1.0, 0.0), objects: int = 3) -> Grips:
    """Grasps of the first object: where the grip site is, where the fingers point and in which direction they close."""
    position, approach, closing = np.array(grasps, dtype=np.float64).reshape(-1, 3, 3).transpose(1, 0, 2).copy()
    ends = np.array([0, *([len(grasps)] * objects)], dtype=np.int64)
    return Grips(position, approach, closing, ends, np.array(axis))


def floor_of(*pairs: tuple[int, int], half: float = 0.01, height: float = 0.1, disc: bool = False) -> Floors:
    """Cubes as children; parents with a floor of 0.2 m by 0.1 m at 2 cm above, and 1 cm beside, their origin."""
    cube = half * np.array([(x, y, z) for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])
    count = len(pairs)
    return Floors(
        children=np.array([child for child, _ in pairs]),
        parents=np.array([parent for _, parent in pairs]),
        present=np.ones(count, dtype=np.bool_),
        disc=np.full(count, disc),
        floor=np.tile([0.01, 0.0, 0.02], (count, 1)),
        half=np.tile([0.1, 0.05], (count, 1)),
        height=np.full(count, height),
        corners=np.concatenate(count * [cube]),
        ends=np.arange(count + 1) * 8,
        reach=np.full(count, half * math.sqrt(3.0)),
    )


def put(s: Snapshot, world: int, obj: int, position) -> None:
    s.xpos[world, s.bodies[obj]] = s.xipos[world, s.bodies[obj]] = position


def turn(s: Snapshot, world: int, obj: int, axis: int, degrees: float) -> None:
    c, t = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    one = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    one[i, i], one[i, j], one[j, i], one[j, j] = c, -t, t, c
    s.xmat[world, s.bodies[obj]] = one.reshape(9)


def meet(s: Snapshot, world: int, first: int, second: int) -> None:
    """Contact; rows below zero count from the owners that are no objects."""
    s.touching[world, first, second] = s.touching[world, second, first] = True


def lifted(s: Snapshot, timer=None, seconds: float = 0.0, needed: float = 1.0):
    worlds = len(s.xpos)
    timer = np.zeros(worlds) if timer is None else timer
    return judge_lift(s, CHILD, 0.1, needed, timer, np.full(worlds, seconds))


def closeness(distance: float, scale: float) -> float:
    return 1.0 - math.tanh(distance / scale)


def test_an_object_is_held_by_both_fingers_and_not_by_one():
    s = at_rest(4)
    s.pinched[1:3, 0, OWNERS + CHILD] = s.pinched[2:, 1, OWNERS + CHILD] = True
    s.pinched[3, 0, OWNERS + OTHER] = True
    np.testing.assert_array_equal(lifted(s)[0], [False, False, True, False])


def test_an_object_rests_when_it_neither_moves_nor_turns_nor_is_touched():
    """Half of each limit along all three axes is 0.87 of it, six tenths are 1.04."""
    cases = [(0.5, 0.5), (0.6, 0.5), (0.5, 0.6), (0.6, 0.6), (0.0, 0.0)]
    s, f = at_rest(len(cases)), floor_of((CHILD, PARENT))
    for world, (along, about) in enumerate(cases):
        s.qvel[world, :3], s.qvel[world, 3:6] = 0.05 * along, -0.5 * about
    meet(s, 4, ROBOT_ROW, OWNERS + CHILD)
    # The speed of another object does not count, nor does what cannot move have any.
    s.qvel[:, 6:] = 9.0
    released = judge_put(s, f, False, 0.0, 1.0, np.zeros(len(cases)), np.zeros(len(cases)))[1]
    np.testing.assert_array_equal(released, [True, False, False, False, False])
    resting = judge_sort(s, floor_of((OTHER, PARENT)), 1.0, np.zeros(len(cases)), np.zeros(len(cases)))[1]
    assert resting.all()


@pytest.mark.parametrize("axis", [0, 1])
def test_an_object_topples_beyond_thirty_degrees_unless_it_is_held(axis):
    s = at_rest(4)
    for world, degrees in enumerate((30.0 - 1e-6, 30.0 + 1e-6, 180.0, -90.0)):
        turn(s, world, CHILD, axis, degrees)
    turn(s, 0, PARENT, 2, 90.0)
    s.pinched[3, :, OWNERS + CHILD] = True
    np.testing.assert_array_equal(
        upsets(s)[0], [[False, False, False], [True, False, False], [True, False, False], [False, False, False]]
    )


def test_an_object_falls_off_the_surface_or_to_the_floor_from_where_it_was():
    """The surface is at 0.5 m; what began below it, as a table on the floor, falls by 5 cm onto the floor at least."""
    cases = [
        (1.0, 0.5 - HAIR, False, True),
        (1.0, 0.5 + HAIR, False, False),
        (0.5, 0.4, False, True),
        (0.5 - HAIR, 0.4, False, False),
        (0.4, 0.35 - HAIR, True, True),
        (0.4, 0.35 + HAIR, True, False),
        (0.4, 0.3, False, False),
        (1.0, 0.9, True, True),
    ]
    s = at_rest(len(cases))
    for world, (before, now, floor, _) in enumerate(cases):
        s.start_centre[world, CHILD, 2] = before
        put(s, world, CHILD, (0.0, 0.0, now))
        s.touching[world, FLOOR_ROW, OWNERS + CHILD] = s.touching[world, OWNERS + CHILD, FLOOR_ROW] = floor
    np.testing.assert_array_equal(upsets(s)[1][:, CHILD], [falls for *_, falls in cases])
    assert not upsets(s)[1][:, PARENT:].any()


def test_others_are_sound_while_none_of_them_topples_or_falls():
    s = at_rest(5)
    for world, obj in ((1, CHILD), (2, OTHER)):
        turn(s, world, obj, 0, 90.0)
    for world, obj in ((3, CHILD), (4, PARENT)):
        put(s, world, obj, (0.0, 0.0, 0.1))
    sound = np.ones(5, dtype=np.bool_)
    judge_others(s, CHILD, sound)
    np.testing.assert_array_equal(sound, [True, True, False, True, False])
    # What was unsound once stays so.
    judge_others(at_rest(5), CHILD, sound)
    np.testing.assert_array_equal(sound, [True, True, False, True, False])
    everyone = np.ones(5, dtype=np.bool_)
    judge_others(s, -1, everyone)
    np.testing.assert_array_equal(everyone, [True, False, False, False, False])


def judged_over(places, *, within: bool, lean: float = 0.0, **shape):
    """Whether a cube with its middle at `places` of a parent's frame, elsewhere and turned, is in it or on it."""
    s, f = at_rest(len(places)), floor_of((CHILD, PARENT), **shape)
    for world, place in enumerate(places):
        turn(s, world, PARENT, 2, 40.0)
        yaw = s.xmat[world, s.bodies[PARENT]].reshape(3, 3).copy()
        turn(s, world, PARENT, 1, lean)
        frame = yaw @ s.xmat[world, s.bodies[PARENT]].reshape(3, 3) @ yaw
        s.xmat[world, s.bodies[PARENT]] = frame.reshape(9)
        put(s, world, CHILD, frame @ np.array(place) + s.xpos[world, s.bodies[PARENT]])
        # The cube leans along.
        s.xmat[world, s.bodies[CHILD]] = frame.reshape(9)
        meet(s, world, OWNERS + CHILD, OWNERS + PARENT)
    return pairs_that(s, f, within)[:, 0].tolist()


@pytest.mark.parametrize("lean", [0.0, 20.0])
@pytest.mark.parametrize("within", [False, True])
def test_the_middle_of_what_is_in_or_on_something_is_over_its_floor(within, lean):
    """The floor goes from -0.09 to 0.11 m along x and from -0.05 to 0.05 m along y; a disc has a radius of 0.1 m.

    A cube that is in it with a corner over the floor is in it, so that for a container the cube is a crumb.
    """
    border, half = HAIR, 1e-10
    places = [
        (0.11 - border, 0.0, 0.03), (0.11 + border, 0.0, 0.03),
        (-0.09 + border, 0.0, 0.03), (-0.09 - border, 0.0, 0.03),
        (0.0, 0.05 - border, 0.03), (0.0, 0.05 + border, 0.03),
        (0.0, -0.05 + border, 0.03), (0.0, -0.05 - border, 0.03),
    ]  # fmt: skip
    assert judged_over(places, within=within, lean=lean, half=half) == 4 * [True, False]
    round_ = [
        (0.01 + r * math.cos(a), r * math.sin(a), 0.03) for a in (0.3, 2.0, 4.0) for r in (0.1 - border, 0.1 + border)
    ]
    assert judged_over(round_, within=within, lean=lean, half=half, disc=True) == 3 * [True, False]


def test_what_is_in_a_container_is_above_its_floor_and_lowest_below_the_rim():
    """The floor is at 2 cm, the rim at 12 cm; a cube of 2 cm is in it up to 13 cm and down to a centimetre below."""
    heights = [0.02 - CONTACT_DEPTH + HAIR, 0.02 - CONTACT_DEPTH - HAIR, 0.025, 0.13 - HAIR, 0.13 + HAIR, 0.5]
    assert judged_over([(0.0, 0.0, z) for z in heights], within=True) == [True, False, True, True, False, False]


def test_what_stands_on_a_top_is_not_sunk_into_it():
    """Its lowest point at most a centimetre below the floor, which is at 2 cm; as high as one likes, if it touches."""
    heights = [0.02 + HAIR, 0.02 - HAIR, 0.5]
    assert judged_over([(0.0, 0.0, z) for z in heights], within=False) == [True, False, True]


def test_what_leans_on_the_rim_is_inside_when_its_foot_is():
    """A cube turned by 45 degrees stands on its edge, which is under its middle; turned by 30, 3.7 mm beside."""
    s, f = at_rest(4), floor_of((CHILD, PARENT))
    foot = 0.01 * math.sqrt(2.0) * math.sin(math.radians(15.0))
    for world, (beyond, degrees) in enumerate(
        [(foot - 1e-6, -30.0), (foot + 1e-6, -30.0), (foot - 1e-6, 30.0), (-1e-6, 45.0)]
    ):
        turn(s, world, CHILD, 1, degrees)
        put(s, world, CHILD, s.xpos[world, s.bodies[PARENT]] + [0.11 + beyond, 0.0, 0.05])
    assert pairs_that(s, f, True)[:, 0].tolist() == [True, False, False, True]


@pytest.mark.parametrize("within", [False, True])
def test_what_leans_too_far_holds_nothing_and_what_has_no_floor_neither(within):
    place = [(0.0, 0.0, 0.03)]
    assert judged_over(place, within=within, lean=30.0 - 1e-6) == [True]
    assert judged_over(place, within=within, lean=30.0 + 1e-6) == [False]
    s, f = at_rest(1), floor_of((CHILD, PARENT))
    put(s, 0, CHILD, s.xpos[0, s.bodies[PARENT]] + [0.0, 0.0, 0.03])
    meet(s, 0, OWNERS + CHILD, OWNERS + PARENT)
    assert pairs_that(s, f, within)[0, 0]
    assert not pairs_that(s, f._replace(present=np.array([False])), within)[0, 0]
    s.touching[:] = False
    # A top holds what touches it; what is in something need not.
    assert pairs_that(s, f, within)[0, 0] == within


def test_a_lift_is_by_ten_centimetres_in_touch_and_for_a_second_without_a_break():
    s = at_rest(4)
    s.xipos[:, s.bodies[CHILD], 2] += np.array([0.1 + HAIR, 0.1 - HAIR, 0.2, 0.2])
    for world in (0, 1, 3):
        meet(s, world, ROBOT_ROW, OWNERS + CHILD)
    timer = np.zeros(4)
    _, up, done, progress, goal = lifted(s, timer, 0.5)
    np.testing.assert_array_equal(up, [True, False, False, True])
    assert not done.any()
    np.testing.assert_array_equal(goal, np.tile([0.0, 0.0, 1.1], (4, 1)))
    # No hand near and no grasp: a quarter for the height where it is touched, and half of one for half the second.
    np.testing.assert_allclose(progress, [0.375, 0.25 * (1 - HAIR / 0.1), 0.0, 0.375], atol=1e-12)
    s.touching[3] = False
    done = lifted(s, timer, 0.5)[2]
    np.testing.assert_array_equal(done, [True, False, False, False])
    np.testing.assert_array_equal(timer, [1.0, 0.0, 0.0, 0.0])
    assert lifted(s, timer, 0.5)[3][0] == 1.0


@pytest.mark.parametrize(
    "away", [(0.1, 0.0, 0.0), (0.0, -0.1, 0.0), (0.0, 0.0, 0.1), (0.06, 0.0, -0.08), (0.02, 0.1, 0.05)]
)
def test_the_hand_comes_closer_over_a_fifth_of_a_metre_whichever_way(away):
    s = at_rest(1)
    s.sites[0, HAND] = s.xipos[0, s.bodies[CHILD]] + away
    distance = float(np.linalg.norm(away))
    assert lifted(s)[3][0] == pytest.approx(closeness(distance, 0.2) / 4, abs=1e-12)
    s.pinched[0, :, OWNERS + CHILD] = True
    assert lifted(s)[3][0] == pytest.approx((1 + closeness(distance, 0.2)) / 4, abs=1e-12)


def test_progress_of_putting_adds_nearness_grasp_release_and_the_way_to_the_goal():
    """A fifth each for hand, grasp and release, two for the way: to a point above the middle of the floor."""
    s, f = at_rest(5), floor_of((CHILD, PARENT))
    parent = s.xpos[0, s.bodies[PARENT]].copy()
    inside, away = parent + [0.0, 0.0, 0.03], parent + [0.0, 0.3, 0.03]
    for world, place in enumerate((away, away, inside, inside, inside)):
        put(s, world, CHILD, place)
    s.sites[:, HAND] = away + [0.0, 0.1, 0.0]
    s.pinched[1, :, OWNERS + CHILD] = True
    meet(s, 1, ROBOT_ROW, OWNERS + CHILD)
    meet(s, 3, ROBOT_ROW, OWNERS + CHILD)
    turn(s, 4, PARENT, 0, 29.0)
    timer = np.zeros(5)
    there, released, upright, done, progress, goal = judge_put(s, f, True, 0.05, 1.0, timer, np.full(5, 0.5))
    np.testing.assert_array_equal(there, [False, False, True, True, True])
    np.testing.assert_array_equal(released, [True, False, True, False, True])
    assert upright.all()
    assert not done.any()
    np.testing.assert_allclose(goal[0], parent + [0.01, 0.0, 0.07], atol=1e-12)
    # The middle of a floor that leans goes along with it, what is above it stays above it.
    lean = math.radians(29.0)
    np.testing.assert_allclose(
        goal[4], parent + [0.01, -0.02 * math.sin(lean), 0.02 * math.cos(lean) + 0.05], atol=1e-12
    )
    way = 0.2 * closeness(0.1, 0.2) + 0.4 * closeness(math.dist(away, goal[0]), 0.25)
    np.testing.assert_allclose(progress[:4], [way, way + 0.2, 1.0, 0.8], atol=1e-12)
    done, progress = judge_put(s, f, True, 0.05, 1.0, timer, np.full(5, 0.5))[3:5]
    np.testing.assert_array_equal(done, [False, False, True, False, True])
    np.testing.assert_array_equal(progress[[2, 4]], 1.0)


def test_what_is_put_onto_something_that_topples_is_not_there():
    s, f = at_rest(2), floor_of((CHILD, PARENT))
    for world, degrees in enumerate((0.0, 31.0)):
        turn(s, world, PARENT, 0, degrees)
        put(s, world, CHILD, s.xpos[world, s.bodies[PARENT]] + [0.0, 0.0, 0.03])
        meet(s, world, OWNERS + CHILD, OWNERS + PARENT)
    there, released, upright, done, *_ = judge_put(s, f, False, 0.05, 1.0, np.zeros(2), np.ones(2))
    np.testing.assert_array_equal(there, [True, False])
    np.testing.assert_array_equal(released, [True, True])
    np.testing.assert_array_equal(upright, [True, False])
    np.testing.assert_array_equal(done, [True, False])


def test_progress_of_sorting_is_the_share_at_home_and_the_next_ones_way():
    """Two children, one home: none, the first, the second or both are in it; the next one is the first that is not."""
    s, f = at_rest(5, 4), floor_of((0, 2), (1, 2))
    home = s.xpos[0, s.bodies[2]].copy()
    inside, away = home + [0.0, 0.0, 0.05], home + [0.0, 0.4, 0.05]
    cases = [(away, away), (inside, away), (away, inside), (inside, inside), (inside, inside)]
    for world, (first, second) in enumerate(cases):
        put(s, world, 0, first)
        put(s, world, 1, second)
    s.sites[:, HAND] = away + [0.0, 0.0, 0.1]
    s.qvel[4, :3] = 0.1
    s.pinched[1, :, OWNERS + 1] = True
    timer = np.zeros(5)
    there, resting, done, progress, target, goal = judge_sort(s, f, 1.0, timer, np.full(5, 1.0))
    np.testing.assert_array_equal(there, [[False, False], [True, False], [False, True], [True, True], [True, True]])
    np.testing.assert_array_equal(resting, [True, True, True, True, False])
    np.testing.assert_array_equal(done, [False, False, False, True, False])
    np.testing.assert_array_equal(target, [0, 1, 0, 0, 0])
    np.testing.assert_array_equal(goal, np.tile(home, (5, 1)))
    begun = 0.2 * closeness(0.1, 0.2) + 0.5 * closeness(math.dist(away, home), 0.25)
    wanted = [begun / 2, (1 + begun + 0.2) / 2, (1 + begun) / 2, 1.0, 1.0]
    np.testing.assert_allclose(progress, wanted, atol=1e-12)


def test_something_is_unloaded_when_nothing_is_left_and_nothing_fell():
    """Two children: both there, the upper one gone, both gone, both gone with one fallen, one still moving."""
    s, f = at_rest(5, 4), floor_of((0, 2), (1, 2))
    base = s.xpos[0, s.bodies[2]].copy()
    low, high, beside = base + [0.0, 0.0, 0.03], base + [0.02, 0.0, 0.06], base + [0.0, 0.5, 0.0]
    cases = [(low, high), (low, beside), (beside, beside), (beside, [0.0, 0.0, 0.1]), (beside, beside)]
    for world, pair in enumerate(cases):
        for child, place in enumerate(pair):
            put(s, world, child, place)
    for world in (0, 1):
        meet(s, world, OWNERS + 0, OWNERS + 2)
    s.sites[:, HAND] = high + [0.0, 0.0, 0.1]
    s.qvel[4, 6:9] = 0.1
    timer = np.zeros(5)
    empty, resting, safe, done, progress, target, goal = judge_unload(s, f, 0.15, 1.0, timer, np.full(5, 1.0))
    np.testing.assert_array_equal(empty, [False, False, True, True, True])
    np.testing.assert_array_equal(resting, [True, True, True, True, False])
    np.testing.assert_array_equal(safe, [True, True, True, False, True])
    np.testing.assert_array_equal(done, [False, False, True, False, False])
    # The highest of those that are there; where none is, the highest of all.
    np.testing.assert_array_equal(target, [1, 0, 0, 0, 0])
    np.testing.assert_allclose(goal, s.start_centre[np.arange(5), target] + [0.0, 0.0, 0.15], atol=1e-12)

    def begun(place, start) -> float:
        hand = closeness(math.dist(place, high + [0.0, 0.0, 0.1]), 0.2)
        return 0.2 * hand + 0.5 * closeness(math.dist(place, start + [0.0, 0.0, 0.15]), 0.25)

    start = s.start_centre[0]
    wanted = [begun(high, start[1]) / 2, (1 + begun(low, start[0])) / 2, 1.0, 0.5, 1.0]
    np.testing.assert_allclose(progress, wanted, atol=1e-12)


DOWN: Vector = (0.0, 0.0, -1.0)


def hand_at(s: Snapshot, world: int, position, frame) -> None:
    s.sites[world, HAND], s.site_xmat[world, HAND] = position, np.asarray(frame).reshape(9)


def closeness_to_grasp(away: float) -> float:
    return 1.0 - 0.5 * (math.tanh(away / NEAR_HAND) + math.tanh(away / NEAR_GRASP))


def test_a_hand_in_a_grasp_has_reached_it_wherever_the_object_has_got_to_and_whichever_finger_is_where():
    """The object is turned about z and moved; the hand is moved with it, and once more with its fingers exchanged."""
    grasp: tuple[Vector, Vector, Vector] = ((0.02, 0.0, 0.05), DOWN, (0.0, 1.0, 0.0))
    s = at_rest(2)._replace(grips=grips_of(((0.3, 0.0, 0.0), DOWN, (1.0, 0.0, 0.0)), grasp))
    c, t = math.cos(math.radians(40.0)), math.sin(math.radians(40.0))
    about = np.array([[c, -t, 0.0], [t, c, 0.0], [0.0, 0.0, 1.0]])
    for world, sign in enumerate((1.0, -1.0)):
        put(s, world, 0, (0.4, 0.1, 1.3))
        s.xmat[world, s.bodies[0]] = about.reshape(9)
        # Columns: x, the closing direction y, and the approach z, down.
        hand = about @ np.diag([-sign, sign, -1.0])
        hand_at(s, world, np.array([0.4, 0.1, 1.3]) + about @ grasp[0], hand)
        assert reached(s, world, 0) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("axis", [(0.0, 1.0, 0.0), (1.0, 0.0, 0.0)])
@pytest.mark.parametrize(
    ("moved", "tilted", "turned"), [(0.07, 0.0, 0.0), (0.0, 0.5, 0.0), (0.0, 0.0, 0.4), (0.03, 0.2, -0.3)]
)
def test_closeness_falls_with_the_way_the_lean_and_the_turn_that_are_missing(axis, moved, tilted, turned):
    """Of two grasps the nearer counts; a lean about the closing direction leaves that as it is."""
    near: tuple[Vector, Vector, Vector] = ((0.0, 0.0, 0.1), DOWN, (0.0, 1.0, 0.0))
    s = at_rest(1)._replace(grips=grips_of(((0.5, 0.5, 0.5), DOWN, (0.0, 1.0, 0.0)), near, axis=axis))
    put(s, 0, 0, (0.0, 0.0, 1.0))
    # The frame of the grip site in which `axis` is along the grasp's closing direction and z points down.
    down = np.diag([-1.0, 1.0, -1.0]) if axis[1] else np.array([[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    lean = np.array(
        [[math.cos(tilted), 0.0, math.sin(tilted)], [0.0, 1.0, 0.0], [-math.sin(tilted), 0.0, math.cos(tilted)]]
    )
    spin = np.array(
        [[math.cos(turned), -math.sin(turned), 0.0], [math.sin(turned), math.cos(turned), 0.0], [0.0, 0.0, 1.0]]
    )
    hand_at(s, 0, (0.0, moved, 1.1), spin @ lean @ down)
    expected = closeness_to_grasp(moved + LEVER * (abs(tilted) + abs(turned)))
    assert reached(s, 0, 0) == pytest.approx(expected, abs=1e-6)


def test_without_a_known_grasp_the_middle_of_the_object_is_what_counts():
    s = at_rest(1)
    hand_at(s, 0, (0.0, 0.15, 1.0), np.eye(3))
    assert reached(s, 0, 0) == pytest.approx(1.0 - math.tanh(0.15 / NEAR_HAND))
