"""What leans, at every height of the wall and above every floor; and what is turned to face something."""

import math

import numpy as np
import pytest

from pat3d.assets.catalogue import make
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.arranged import arrangement_holds
from pat3d.layout.bodies import Body, place
from pat3d.layout.formations import ASKEW, Sight
from pat3d.layout.group import Group
from pat3d.layout.leaning import leaning_offset, leaning_rotation
from pat3d.layout.turning import turned_to_targets
from pat3d.scene.arrangements import Arrangement
from tests.layout.things import block, gap_by_manifold

GAP = 0.002
LONG = 0.25
WAYS = [(1, 0), (-1, 0), (0, 1), (0, -1)]


def leaning(way, wall_height: float) -> tuple[Group, Group]:
    """A board that leans `way` on a wall, a layout's gap above the floor and from the wall."""
    towards = np.array([*map(float, way), 0.0])
    body = Body("board", block(0.1, 0.01, LONG))
    board = Group((body.at(leaning_rotation(body, towards), np.array([0.3, 0.2, 0.7])),))
    wall = Group((place("wall", block(0.12, 0.14, wall_height), Pose(position=(0.1, -0.4, 0.5))),))
    offset = leaning_offset(board, wall, towards, GAP)
    middle = (board.root.low + board.root.high) / 2
    there = (wall.root.low + wall.root.high) / 2
    base = np.array([*(there[:2] + offset - middle[:2]), GAP - board.low[2]])
    return board.shifted(base), wall.shifted(np.array([0.0, 0.0, GAP - wall.low[2]]))


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("wall_height", [0.02, 0.1, 0.3])
def test_what_leans_is_a_gap_from_the_wall_and_straight_before_it(way, wall_height):
    """On a wall lower than the board their boxes overlap: it touches the upper edge, not the side."""
    board, wall = leaning(way, wall_height)
    bodies = {"board": board.root, "wall": wall.root}
    gap, _ = gap_by_manifold(
        {name: body.body.asset for name, body in bodies.items()}, {name: body.pose for name, body in bodies.items()}
    )
    assert gap == pytest.approx(GAP, abs=3e-5)
    off = (board.root.low + board.root.high - wall.root.low - wall.root.high)[:2] / 2
    assert float(off @ np.array(way)) < 0.0
    assert float(off @ np.array([-way[1], way[0]])) == pytest.approx(0.0, abs=1e-9)


def test_a_wall_that_is_only_beside_the_board_is_nothing_to_lean_against():
    board, wall = leaning((1, 0), 0.3)
    far = Group((wall.root, place("post", block(0.02, 0.02, 0.3), Pose(position=(0.1, 0.6, GAP)))))
    # Its middle is the wall's, so that a wall above the board alone cannot be met.
    above = Group((far.root.shifted(np.array([0.0, 0.0, 1.0])), far.members[1]))
    with pytest.raises(LayoutError, match="finds nothing of"):
        leaning_offset(board, above, np.array([1.0, 0.0, 0.0]), GAP)


@pytest.mark.parametrize("way", WAYS)
def test_it_leans_on_an_arm_where_the_seat_is_lower_than_its_centre_of_mass(way):
    """The centre of mass of a board 25 cm long is 12.5 cm up; the seat is 10 cm high, its arms are 22."""
    towards = np.array([*map(float, way), 0.0])
    body = Body("board", block(0.03, 0.01, LONG))
    board = Group((body.at(leaning_rotation(body, towards), np.zeros(3)),))
    seat = place("seat", block(0.3, 0.3, 0.1), Pose())
    arms = [place(f"arm {k}", block(0.05, 0.05, 0.22), Pose(position=(x, y, 0.0)))
            for k, (x, y) in enumerate((x, y) for x in (-0.125, 0.125) for y in (-0.125, 0.125))]  # fmt: skip
    offset = leaning_offset(board, Group((seat, *arms)), towards, GAP)
    aside = abs(float(offset @ np.array([-way[1], way[0]])))
    assert 0.1 < aside < 0.15
    middle = leaning_offset(board, Group((seat,)), towards, GAP)
    assert float(middle @ np.array([-way[1], way[0]])) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("way", WAYS)
def test_an_umbrella_leans_tip_down_with_its_centre_of_mass_straight_before_its_tip(way):
    umbrella = make("umbrella")
    towards = np.array([*map(float, way), 0.0])
    turned = umbrella.visual.vertices @ leaning_rotation(Body("umbrella", umbrella), towards).T
    centre = leaning_rotation(Body("umbrella", umbrella), towards) @ umbrella.mass_properties.centre_of_mass
    tip = turned[turned[:, 2] < turned[:, 2].min() + 2e-3].mean(axis=0)
    before = centre - tip
    assert np.degrees(np.arctan2(float(before @ towards), before[2])) == pytest.approx(9.0, abs=2.0), (
        "the foot has an edge"
    )
    assert float(before @ np.cross(towards, [0.0, 0.0, 1.0])) == pytest.approx(0.0, abs=3e-3)
    assert np.ptp(turned[turned[:, 2] > turned[:, 2].max() - 0.06, :2], axis=0).max() > 0.07, "the crook is up"


@pytest.mark.parametrize("floor", [0.0, 3.0])
@pytest.mark.parametrize(("wall_height", "expected"), [(0.015, False), (0.04, True), (0.3, True)])
def test_what_leans_touches_above_a_tenth_of_its_height_wherever_its_floor_is(floor, wall_height, expected):
    up = np.array([0.0, 0.0, floor])
    board, wall = (one.shifted(up).root for one in leaning((0, 1), wall_height))
    one = Arrangement(kind="leaning_against", objects=("board",), of=("wall",))
    holds, detail = arrangement_holds(one, {"board": board, "wall": wall}, touch=GAP + 1e-4)
    assert holds is expected, detail
    share = min(1.0, wall_height / float((board.high - board.low)[2]))
    assert f"touches at {share:.0%}" in detail or share == 1.0


@pytest.mark.parametrize("way", WAYS)
def test_a_sight_is_met_within_its_angle(way):
    """Every 5 degrees but for the border of 10: whatever the distance, and whatever the number of places asked for."""
    angles = np.array([angle for angle in range(-180, 180, 5) if abs(angle) != ASKEW])
    turned = np.radians(angles) + math.atan2(way[1], way[0])
    offsets = np.linspace(0.2, 3.0, len(angles))[:, None] * np.stack([np.cos(turned), np.sin(turned)], axis=1)
    sight = Sight(observer="a", target="b", way=way)
    np.testing.assert_array_equal(sight.meets(offsets), np.abs(angles) < ASKEW)
    for k in range(len(angles) - 1):
        np.testing.assert_array_equal(sight.meets(offsets[k : k + 2]), np.abs(angles[k : k + 2]) < ASKEW)


def watching(yaw: float, *, loaded: bool = False) -> Group:
    """A board whose front is `yaw` [rad] from -y, perhaps with a bar on it (one group)."""
    board = place("board", block(0.3, 0.1, 0.02), Pose.from_yaw(yaw, (0.2, 0.1, 0.0)))
    if not loaded:
        return Group((board,))
    return Group((board, place("bar", block(0.3, 0.04, 0.1), Pose.from_yaw(yaw, (0.2, 0.1, 0.1)))))


@pytest.mark.parametrize("yaw", [0.0, 1.0, -2.5])
def test_an_observer_is_turned_about_its_middle_to_face_its_target(yaw):
    target = Group((place("target", block(), Pose(position=(0.9, -0.6, 0.0))),))
    group = watching(yaw)
    turned, same = turned_to_targets([group, target], [("board", "target")], gap=GAP)
    middle = (turned.root.low + turned.root.high)[:2] / 2
    np.testing.assert_allclose(middle, [0.2, 0.1], atol=1e-9)
    way = np.array([0.7, -0.7]) / math.hypot(0.7, 0.7)
    np.testing.assert_allclose(-turned.root.rotation[:2, 1], way, atol=1e-9)
    assert same is target


@pytest.mark.parametrize("loaded", [False, True])
def test_a_group_is_only_turned_where_all_of_it_has_room(loaded):
    """The thing in the way is higher than the board and beside its bar: the bar alone would hit it."""
    group = watching(0.0, loaded=loaded)
    target = Group((place("target", block(), Pose(position=(1.2, 0.1, 0.0))),))
    hanging = Group((place("hanging", block(0.05, 0.05, 0.1), Pose(position=(0.2, 0.21, 0.1))),))
    found = turned_to_targets([group, target, hanging], [("board", "target")], gap=GAP)[0]
    assert (found is group) is loaded
