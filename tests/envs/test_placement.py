"""Where a robot stands: an arm that reaches everything takes the first place that is free, and free is known."""

from __future__ import annotations

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.envs.grasping import placement
from pat3d.envs.grasping.grasp import Grasp
from pat3d.envs.grasping.placement import HOVER, RISER, Needs, place
from pat3d.envs.grasping.site import BASE_RADIUS, BENCH_HEIGHT, BENCH_RIM, Site
from pat3d.errors import TaskError
from pat3d.geometry.hulls import convex_part
from pat3d.scene.model import Scene, SceneObject
from tests.envs.test_grasp import GRIPPER, bar

HAND = (0.4, 0.0, 5.0)
"""Of the arm at home, in the frame of its base [m]; robots like to stand 10 cm further away from their work."""

AWAY = 0.5


class Arm:
    """Reaches every pose unless `reaches` says otherwise, and says its joints are the position."""

    length = 1.0

    def __init__(self, hand=HAND, reaches=lambda position, rotation: True) -> None:
        self.robot = SimpleNamespace(name="arm", home=np.array(hand))
        self._reaches = reaches
        self.asked: list[tuple[np.ndarray, np.ndarray]] = []

    def hand(self, joints):
        return np.array(joints), np.diag([1.0, -1.0, -1.0])

    def solve(self, position, rotation, *_):
        self.asked.append((np.array(position), np.array(rotation)))
        return np.array(position) if self._reaches(position, rotation) else None

    def margin(self, joints) -> float:
        return 1.0


def block(name: str, low, high) -> SceneObject:
    """From corner to corner [m], to the last bit."""
    made = bar(name, (0.1, 0.1, 0.1))
    corners = np.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])])
    return replace(made, asset=replace(made.asset, parts=(convex_part(corners),)))


WORK = block("cube", (-0.0625, -0.5625, 0.0), (0.0625, -0.4375, 0.125))
"""Half a metre in front of the origin, where the robot stands if nothing is in its way."""

FAR = block("far", (3.0, 3.0, 0.0), (3.5, 3.5, 0.1))
"""Makes the scene too wide for a workbench."""


@pytest.fixture
def stand(monkeypatch):
    """Places an arm in front of the cube, with what else there is."""

    def placed(*others: SceneObject, arm: Arm | None = None, visit=(), on_bench: bool = False):
        scene = Scene(objects=(WORK, *others) if on_bench else (WORK, FAR, *others))
        x, y, z = 0.0, -0.5, 0.1
        grasp = Grasp(position=(x, y, z), closing=0.0, bite=0.02, score=1.0)
        used = arm or Arm()
        monkeypatch.setattr(placement, "arm_kinematics", lambda _: used)
        monkeypatch.setattr(placement, "measure_gripper", lambda _: GRIPPER)
        monkeypatch.setattr(placement, "grasps_of", lambda *_, **__: {"cube": [grasp]})
        return place(scene, "arm", Needs(grasp=("cube",), visit=visit))

    return placed


def test_a_robot_stands_behind_its_work_and_faces_it(stand):
    found = stand()
    np.testing.assert_allclose(found.base_position, (0.0, 0.0, RISER), atol=1e-12)
    assert found.yaw == pytest.approx(-math.pi / 2)
    assert found.reach == {"cube": pytest.approx(0.5)}
    assert (found.bench, found.host, found.surface, found.floor) == (None, None, 0.0, 0.0)
    assert found.shown == ("cube",)
    assert found.describe() == 'base on the floor at (0.00, 0.00, 0.10) m, facing -90 degrees; reaches "cube" at 0.50 m'


def test_on_a_workbench_its_rim_goes_around_everything_and_the_base(stand):
    found = stand(block("post", (0.5, -0.6, 0.0), (0.6, -0.3, 0.2)), on_bench=True)
    x, y, z = found.base_position
    # In front of the middle of everything, which serves every task of the scene.
    np.testing.assert_allclose((x, y, z), (0.26875, 0.05, RISER), atol=1e-12)
    np.testing.assert_allclose(found.bench[0], (-0.0625 - BENCH_RIM, -0.6 - BENCH_RIM))
    np.testing.assert_allclose(found.bench[1], (0.6 + BENCH_RIM, y + BENCH_RIM))
    assert found.floor == -BENCH_HEIGHT
    assert found.shown == ("cube", "post")


@pytest.mark.parametrize("side", ["ahead", "behind", "left", "right"])
def test_the_base_is_as_near_to_a_wall_as_its_radius_and_no_nearer(stand, side):
    """At exactly the radius it stands where it likes to; a bit nearer, somewhere else."""
    # The cosine of a right angle is 6e-17, which shifts the base sideways by as much.
    hair = 1e-12 if side in ("left", "right") else 0.0
    for radius, free in ((BASE_RADIUS + hair, True), (np.nextafter(BASE_RADIUS, 0.0) - hair, False)):
        low, high = {
            "ahead": ((-1.0, radius, 0.0), (1.0, radius + 0.1, 0.3)),
            "behind": ((-1.0, -radius - 0.1, 0.0), (1.0, -radius, 0.3)),
            "left": ((-radius - 0.1, -0.1, 0.0), (-radius, 1.0, 0.3)),
            "right": ((radius, -0.1, 0.0), (radius + 0.1, 1.0, 0.3)),
        }[side]
        found = stand(block("wall", low, high))
        assert np.allclose(found.base_position, (0.0, 0.0, RISER), atol=1e-9) == free
        x, y, _ = found.base_position
        away = math.hypot(max(low[0] - x, 0.0, x - high[0]), max(low[1] - y, 0.0, y - high[1]))
        assert away >= BASE_RADIUS - 1e-12


def test_under_a_shelf_half_a_metre_above_its_base_a_robot_can_stand(stand):
    for height, free in ((RISER + 0.5, True), (np.nextafter(RISER + 0.5, 0.0), False)):
        shelf = block("shelf", (-0.5, -0.2, height), (0.5, 0.5, height + 0.02))
        assert np.allclose(stand(shelf).base_position, (0.0, 0.0, RISER), atol=1e-9) == free


def test_where_the_place_behind_is_taken_the_nearest_other_distance_is_tried_then_another_side(stand):
    """8 cm nearer to the work it is free of a wall behind; with the work walled in behind, it stands to the left."""
    wall = block("wall", (-1.0, 0.1, 0.0), (1.0, 0.2, 0.3))
    np.testing.assert_allclose(stand(wall).base_position, (0.0, -0.08, RISER), atol=1e-12)
    near = block("wall", (-1.0, -0.3, 0.0), (1.0, 0.5, 0.3))
    found = stand(near)
    np.testing.assert_allclose(found.base_position, (-AWAY, -0.5, RISER), atol=1e-12)
    assert math.cos(found.yaw) == pytest.approx(1.0)


def test_the_hand_is_asked_for_above_the_grasp_and_above_every_point_it_visits(stand):
    """As the base sees them: it faces the work, which is half a metre ahead; the fingertips are 1 cm below the site."""
    arm = Arm()
    stand(arm=arm, visit=((0.3, -0.6, 0.2),))
    places = [position for position, _ in arm.asked]
    down = [rotation[:, 2] for _, rotation in arm.asked]
    tip = GRIPPER.tip
    # The place behind the mean of the cube and the point is the first to be tried.
    np.testing.assert_allclose(places[0] - places[1], (0.0, 0.0, HOVER), atol=1e-12)
    np.testing.assert_allclose(places[1][2], 0.1 + tip - RISER, atol=1e-12)
    middle = (np.array([0.0, -0.5]) + [0.3, -0.6]) / 2
    base = middle + [0.0, AWAY]

    def seen(x: float, y: float) -> tuple[float, float]:
        """Ahead and to the left of a base that faces -y."""
        return base[1] - y, x - base[0]

    np.testing.assert_allclose(places[1][:2], seen(0.0, -0.5), atol=1e-12)
    np.testing.assert_allclose(places[-1], (*seen(0.3, -0.6), 0.2 + tip - RISER), atol=1e-12)
    np.testing.assert_allclose(down, np.tile([0.0, 0.0, -1.0], (len(down), 1)), atol=1e-12)


def test_a_point_is_visited_with_the_hand_turned_any_way(stand):
    """An arm that only closes along the base's y reaches it too, and one that never does reaches nothing."""

    def along(k: int, sign: float):
        return lambda position, rotation: position[2] < 0.5 or sign * rotation[k, 1] > 0.99

    high = ((0.0, -0.5, 1.0),)
    for k, sign in ((0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)):
        assert stand(arm=Arm(reaches=along(k, sign)), visit=high).start
    with pytest.raises(TaskError, match='arm cannot bring its hand to every point of the task near "cube"'):
        stand(arm=Arm(reaches=lambda position, rotation: position[2] < 0.5), visit=high)


def test_what_is_out_of_reach_is_said_with_the_least_distance_that_was_tried(stand):
    """16 cm nearer than comfortable, the nearest place is 34 cm away; the cube is taken at the height of the base."""
    with pytest.raises(TaskError, match=r'"cube" is out of reach of arm: at best 0\.34 m beside and 0\.00 m below'):
        stand(arm=Arm(reaches=lambda *_: False))
    with pytest.raises(TaskError, match='arm finds no free place to stand near "cube"'):
        stand(block("floor", (-2.0, -2.0, 0.0), (2.0, 2.0, 0.01)), arm=Arm(reaches=lambda *_: False))


@pytest.mark.parametrize("toward", [(1, 0), (-1, 0), (0, 1), (0, -1)])
@pytest.mark.parametrize(("away", "counts"), [(0.19, True), (0.21, False)])
def test_the_hand_starts_eight_centimetres_above_what_is_near_it(stand, toward, away, counts):
    """Within 20 cm of the hand, which is 10 cm short of the work; nothing else raises it."""
    hand = np.array([0.0, -0.4])
    corner = hand + away * np.array(toward)
    side = 0.01 * np.array([[min(toward[0], 0), min(toward[1], 0)], [max(toward[0], 0), max(toward[1], 0)]])
    across = 0.01 * np.abs(np.array(toward[::-1]))
    post = block("post", (*(corner + side[0] - across), 0.0), (*(corner + side[1] + across), 0.3))
    # The work itself is as high as 12.5 cm.
    under = 0.3 if counts else 0.125
    found = stand(post, arm=Arm(hand=(0.4, 0.0, 0.05)))
    np.testing.assert_allclose(found.base_position, (0.0, 0.0, RISER), atol=1e-12)
    np.testing.assert_allclose(found.start, (0.4, 0.0, under + GRIPPER.tip + 0.08 - RISER), atol=1e-9)
    assert stand(post, arm=Arm(hand=(0.4, 0.0, 0.6))).start == (0.4, 0.0, 0.6)


@pytest.mark.parametrize(
    ("low", "high", "bench"),
    [
        ((0.0, 0.0, 0.0), (1.6, 1.2, 1.0), True),
        ((0.0, 0.0, 0.0), (1.6 + 1e-6, 1.2, 1.0), False),
        ((0.0, 0.0, 0.0), (1.6, 1.2 + 1e-6, 1.0), False),
        ((0.0, 0.0, 0.0), (1.6, 1.2, 1.0 + 1e-6), False),
        ((0.0, 0.0, 0.4 - 1e-6), (0.1, 0.1, 0.5), True),
        ((0.0, 0.0, 0.4), (0.1, 0.1, 0.5), False),
    ],
)
def test_on_a_workbench_goes_what_fits_there_and_stands_low(low, high, bench):
    """At most 1.6 m by 1.2 m and 1 m high; what is to be taken stands less than 40 cm above the ground."""
    site = Site.of(Scene(objects=(block("cube", low, high),)), Needs(grasp=("cube",)))
    assert site.bench == bench
    assert site.surface == (0.0 if bench else low[2])
