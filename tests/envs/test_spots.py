"""Spots at which things are put down, on tops whose spots can be counted, with the price of each worked out again."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from pat3d.envs.grasping.spots import (
    ACROSS,
    CELL,
    CROWDED,
    DISTANCES,
    EDGE,
    FREE_GAP,
    GAP,
    TURNS,
    free_spots,
    spots_over,
)
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Region
from pat3d.scene.model import Scene, SceneObject
from tests.envs.test_grasp import bar

CUBE = 0.04
RADIUS = CUBE / math.sqrt(2)


class Standing:
    """What a SimState says of a scene as it is, with given contacts."""

    def __init__(self, scene: Scene, touching: Collection[frozenset[str]] = ()) -> None:
        self.scene, self.touching = scene, touching

    def position(self, name: str):
        return np.array(self.scene[name].pose.position)

    def rotation(self, name: str):
        return self.scene[name].pose.rotation

    def centre(self, name: str):
        obj = self.scene[name]
        return obj.pose.apply(np.array([obj.asset.mass_properties.centre_of_mass]))[0]

    def points(self, name: str):
        obj = self.scene[name]
        return obj.pose.apply(np.concatenate([part.vertices for part in obj.asset.parts]))

    def local(self, points, name: str):
        return (points - self.position(name)) @ self.rotation(name)

    def touch(self, first: str, second: str) -> bool:
        return {first, second} in self.touching


def standing(*objects: SceneObject, touching: Sequence[tuple[str, str]] = (), **placement: Any) -> Any:
    """An environment, as far as spots look at it."""
    scene = Scene(objects=objects)
    about = {"base_position": (0.0, 0.0, 0.1), "yaw": 0.0, "bench": None, "host": None, "surface": 0.0, **placement}
    state = Standing(scene, [frozenset(pair) for pair in touching])
    return SimpleNamespace(scene=scene, simulation=SimpleNamespace(state=state), placement=SimpleNamespace(**about))


def top(
    half: tuple[float, float], *, kind="on", shape="rectangle", floor=(0.0, 0.0, 0.02), name="table"
) -> SceneObject:
    made = bar(name, (2 * half[0], 2 * half[1], 0.02))
    regions = (Region(kind=kind, shape=shape, floor=floor, half_size=half, height=0.1),)
    if kind == "in":
        regions = (Region(kind="on", shape="disc", floor=(0.0, 0.0, 0.1), half_size=(0.05, 0.05)), *regions)
    return replace(made, asset=replace(made.asset, regions=regions))


def at(obj: SceneObject, pose: Pose) -> SceneObject:
    return replace(obj, pose=pose, initial_pose=pose)


CUBE_AWAY = bar("cube", (CUBE, CUBE, CUBE), (3.0, 2.0))


def over(*objects: SceneObject, where: str = "table", on: bool = True, more: bool = False, **others: Any):
    """The spots for the cube, shape (n, 3)."""
    return np.array(spots_over(standing(CUBE_AWAY, *objects, **others), "cube", where, on=on, more=more))


def test_spots_lie_evenly_on_a_top_around_its_middle_nearest_first():
    """28 cm by 18 cm inside the margins: 13 by 9 of them, a twelfth of the longer side apart."""
    floor = (0.05, -0.03, 0.02)
    found = over(top((0.15, 0.1), floor=floor))
    cell = 0.28 / ACROSS
    wanted = {(i, j) for i in range(-6, 7) for j in range(-3, 4)}
    local = (found - floor) / [cell, cell, 1.0]
    assert {tuple(pair) for pair in np.rint(local[:, :2]).astype(int).tolist()} == wanted
    assert len(found) == len(wanted)
    np.testing.assert_allclose(local[:, :2], np.rint(local[:, :2]), atol=1e-9)
    np.testing.assert_array_equal(found[:, 2], 0.02)
    away = np.linalg.norm(found - floor, axis=1)
    assert away[0] == 0.0
    assert (np.diff(away) >= -1e-12).all()


def test_on_a_small_top_spots_are_no_nearer_than_a_hand_can_tell():
    found = over(top((0.05, 0.05)))
    steps = np.unique(np.round(found[:, 0], 9))
    np.testing.assert_allclose(steps, CELL * np.arange(-2, 3), atol=1e-9)
    assert len(found) == 25
    assert len(over(top((0.005, 0.005)))) == 1


def test_spots_move_along_with_what_they_are_on():
    pose = Pose.from_yaw(0.8, (1.0, -2.0, 0.5))
    made = top((0.15, 0.1), floor=(0.05, -0.03, 0.02))
    np.testing.assert_allclose(over(at(made, pose)), pose.apply(over(made)), atol=1e-12)


def test_in_a_round_container_the_object_stays_between_the_walls_and_may_touch_them():
    """Of the circle that is left for its middle, the ends of both diameters are spots, the corners around it not."""
    room = 0.12
    bowl = top((room + RADIUS,) * 2, kind="in", shape="disc", floor=(0.01, 0.02, 0.01))
    found = over(bowl, on=False)
    away = np.linalg.norm(found[:, :2] - [0.01, 0.02], axis=1)
    cell = 2 * room / ACROSS
    assert len(found) == sum(math.hypot(i, j) * cell <= room + 1e-9 for i in range(-6, 7) for j in range(-6, 7))
    assert away.max() == pytest.approx(room, rel=1e-12)
    assert (away > room - 1e-9).sum() >= 4
    # The first one goes to the middle, where others follow to the wall.
    assert away[0] == 0.0
    assert (np.diff(away) >= -1e-12).all()
    shared = np.linalg.norm(over(bowl, on=False, more=True)[:, :2] - [0.01, 0.02], axis=1)
    assert shared[0] == pytest.approx(room, rel=1e-12)
    assert shared[-1] == 0.0
    assert (np.diff(shared) <= 1e-12).all()


def test_on_a_container_the_top_counts_where_it_is_asked_for():
    bowl = top((0.2, 0.2), kind="in", shape="disc", floor=(0.0, 0.0, 0.01))
    assert set(over(bowl, on=False)[:, 2]) == {0.01}
    above = over(bowl, on=True)
    assert set(above[:, 2]) == {0.1}
    assert np.linalg.norm(above[:, :2], axis=1).max() <= 0.04 + 1e-9
    # More to come leaves the middle free in a container, not on a top.
    np.testing.assert_array_equal(over(bowl, on=True, more=True), above)


def test_what_has_neither_top_nor_inside_is_its_own_spot():
    made = bar("table", (0.1, 0.1, 0.1), (0.4, 0.5))
    bare = replace(made, asset=replace(made.asset, regions=()))
    np.testing.assert_array_equal(over(bare), [[0.4, 0.5, 0.0]])


def gap_of(point, cloud) -> float:
    """From a point to the bounding box of a cloud, as seen from above [m]."""
    low, high = cloud[:, :2].min(axis=0), cloud[:, :2].max(axis=0)
    return math.dist(point[:2], np.clip(point[:2], low, high))


@pytest.mark.parametrize("more", [False, True])
@pytest.mark.parametrize("kind", ["on", "in"])
def test_a_spot_without_a_gap_costs_five_times_what_is_missing(kind, more):
    """Against the price of every spot by itself: its way from the middle, or to it, and the gap to both neighbours."""
    base = top((0.2, 0.2), kind=kind)
    there = [bar("post", (0.03, 0.05, 0.1), (0.06, -0.02)), bar("ball", (0.02, 0.02, 0.02), (-0.05, 0.1))]
    there = [at(one, replace(one.pose, position=(*one.pose.position[:2], 0.02))) for one in there]
    found = over(base, *there, on=kind == "on", more=more)
    clouds = [one.pose.apply(one.asset.parts[0].vertices) for one in there]
    away = np.linalg.norm(found[:, :2], axis=1)
    first = away.max() - away if kind == "in" else away
    missing = [max(GAP - (min(gap_of(point, cloud) for cloud in clouds) - RADIUS), 0.0) for point in found]
    cost = first + CROWDED * np.array(missing)
    assert (np.diff(cost) >= -1e-9).all()
    assert 10 < np.count_nonzero(missing) < len(found) - 10
    # Neighbours make no spot impossible, only dear.
    alone = over(base, on=kind == "on", more=more)
    assert {tuple(np.round(point, 9)) for point in found} == {tuple(np.round(point, 9)) for point in alone}


@pytest.mark.parametrize(
    ("position", "touching", "counts"),
    [
        ((0.0, 0.0, 0.02), False, True),
        ((0.0, 0.0, 0.3), False, True),
        ((0.0, 0.0, -0.04), False, False),
        ((0.0, 0.0, -0.04), True, True),
        ((0.199, 0.0, 0.02), False, True),
        ((0.201, 0.0, 0.02), False, False),
        ((0.201, 0.0, 0.02), True, True),
        ((0.0, -0.099, 0.02), False, True),
        ((0.0, -0.101, 0.02), False, False),
    ],
)  # fmt: skip
def test_neighbours_are_what_stands_over_the_top_or_touches_what_carries_it(position, touching, counts):
    """The centre of mass of a cube of 6 cm over the top and not a centimetre below it, or contact."""
    base, cube = top((0.2, 0.1)), bar("other", (0.06, 0.06, 0.06))
    cube = at(cube, replace(cube.pose, position=position))
    pairs = [("other", "table")] if touching else []
    changed = not np.array_equal(over(base, cube, touching=pairs), over(base))
    assert changed == counts


def free(*objects: SceneObject, **placement: Any):
    """Where the cube may be put down beside everything, shape (n, 3)."""
    return np.array(free_spots(standing(*objects, **placement), "cube"))


HERE = bar("cube", (CUBE, CUBE, CUBE), (0.3, 0.2))


def test_on_the_floor_spots_are_in_front_of_the_robot_within_its_reach_the_nearest_first():
    base, yaw = np.array([1.0, -2.0, 0.1]), 2.5
    found = free(HERE, base_position=tuple(base), yaw=yaw, surface=0.07)
    assert len(found) == len(DISTANCES) * len(TURNS) == 189
    np.testing.assert_array_equal(found[:, 2], 0.07)
    x, y = (found - base)[:, :2].T
    away, turn = np.hypot(x, y), (np.arctan2(y, x) - yaw + math.pi) % (2 * math.pi) - math.pi
    np.testing.assert_allclose(np.unique(np.round(away, 9)), np.arange(42, 67, 4) / 100, atol=1e-9)
    np.testing.assert_allclose(np.unique(np.round(turn, 9)), np.linspace(-1.3, 1.3, 27), atol=1e-9)
    way = np.linalg.norm(found[:, :2] - [0.3, 0.2], axis=1)
    assert (np.diff(way) >= -1e-12).all()


def test_on_a_workbench_and_on_a_host_spots_keep_from_the_edge():
    everywhere = {tuple(point) for point in np.round(free(HERE), 9).tolist()}
    low, high = np.array([-0.2, -0.6]), np.array([0.6, 0.3])
    inside = {
        point for point in everywhere
        if all(low[k] + EDGE <= point[k] <= high[k] - EDGE for k in (0, 1))
    }  # fmt: skip
    assert 10 < len(inside) < len(everywhere)
    on_bench = free(HERE, bench=(tuple(low), tuple(high)))
    assert {tuple(point) for point in np.round(on_bench, 9).tolist()} == inside
    size, middle = high - low, (low + high) / 2
    host = bar("desk", (*size, 0.7), tuple(middle))
    on_host = free(HERE, host, host="desk")
    # What carries the work is below all spots, not beside them.
    np.testing.assert_allclose(on_host, on_bench, atol=1e-12)
    assert not len(free(HERE, bench=((2.0, 2.0), (2.5, 2.5))))


def test_a_spot_that_leaves_no_room_for_fingers_costs_five_times_what_is_missing():
    posts = [bar("post", (0.05, 0.09, 0.1), (0.45, 0.1)), bar("ball", (0.04, 0.04, 0.04), (0.35, 0.4))]
    found = free(HERE, *posts)
    clouds = [one.pose.apply(one.asset.parts[0].vertices) for one in posts]
    missing = [max(FREE_GAP - (min(gap_of(point, cloud) for cloud in clouds) - RADIUS), 0.0) for point in found]
    cost = np.linalg.norm(found[:, :2] - [0.3, 0.2], axis=1) + CROWDED * np.array(missing)
    assert (np.diff(cost) >= -1e-9).all()
    assert 10 < np.count_nonzero(missing) < len(found) - 10
    # The cube's own place is free for it.
    assert len(found) == 189
