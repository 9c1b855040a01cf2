"""Quarter turns, turned regions, sides and rings of the flat arrangement, against what they mean."""

import math

import numpy as np
import pytest

from pat3d.assets import shapes
from pat3d.geometry.pose import Pose
from pat3d.geometry.rotations import yaw_matrix
from pat3d.layout.bodies import Body, place
from pat3d.layout.clearance import require_clearance
from pat3d.layout.flat import Item, Lateral, Surface
from pat3d.layout.frames import flat_regions
from pat3d.layout.group import Group
from pat3d.layout.predicates import check_relations
from pat3d.layout.surfaces import arrange_flat, ring_angles
from pat3d.layout.tops import item_of
from pat3d.scene.asset import Region
from pat3d.scene.model import Relation
from tests.layout.things import asset, block


def hook() -> Group:
    """An L seen from above, whose origin and centre of mass are not in its middle."""
    shape = shapes.join(shapes.box(0.3, 0.05, 0.04).moved(x=0.1), shapes.box(0.05, 0.1, 0.04).moved(x=0.22, y=0.07))
    return Group((Body("hook", asset("hook", shape)).at(np.eye(3), np.zeros(3)),))


def test_a_quarter_turn_of_the_outline_is_the_outline_of_the_turned_thing():
    item = item_of(hook(), turnable=True).quarter()
    turned = item_of(hook().turned(yaw_matrix(math.pi / 2)), turnable=False)
    np.testing.assert_allclose(item.low, turned.low, atol=1e-12)
    np.testing.assert_allclose(item.high, turned.high, atol=1e-12)
    np.testing.assert_allclose(item.centre_of_mass, turned.centre_of_mass, atol=1e-12)
    corners = {tuple(np.round(point, 9) + 0.0) for point in turned.outline}
    assert {tuple(np.round(point, 9) + 0.0) for point in item.outline} == corners
    assert (item.tall, item.turnable) == (turned.tall, False)


@pytest.mark.parametrize("degrees", [0, 90, 180, -90])
def test_a_rectangle_turned_by_right_angles_keeps_its_area(degrees):
    region = Region(kind="on", shape="rectangle", floor=(0, 0, 0.02), half_size=(0.3, 0.1))
    board = place(
        "board", asset("board", shapes.box(0.6, 0.2, 0.02), region), Pose.from_yaw(math.radians(degrees), (0, 0, 0))
    )
    wide, deep = (0.3, 0.1) if degrees % 180 == 0 else (0.1, 0.3)
    assert flat_regions(board)[0].surface.half_size == pytest.approx((wide, deep))


def test_a_turned_square_offers_the_square_inside_it_and_a_disc_stays_whole():
    for shape, expected in (("rectangle", 0.1 / math.sqrt(2)), ("disc", 0.1)):
        region = Region(kind="on", shape=shape, floor=(0, 0, 0.02), half_size=(0.1, 0.1))
        board = place(
            "board", asset("board", shapes.box(0.2, 0.2, 0.02), region), Pose.from_yaw(math.pi / 4, (0, 0, 0))
        )
        surface = flat_regions(board)[0].surface
        assert surface.half_size == pytest.approx((expected, expected))
        assert surface.disc is (shape == "disc")


@pytest.mark.parametrize("count", [3, 4, 5])
def test_a_ring_starts_at_the_left_front_and_is_even(count):
    names = [f"chair {k}" for k in range(count)]
    angles = ring_angles([Lateral(child=name, kind="around", parent="table") for name in names])
    x, y = math.cos(angles[names[0]]), math.sin(angles[names[0]])
    assert x < -0.1
    assert y < -0.1
    turns = np.sort(np.array([angles[name] for name in names]) % (2 * math.pi))
    np.testing.assert_allclose(np.diff(turns), 2 * math.pi / count)


def test_two_stand_left_and_right():
    angles = ring_angles([Lateral(child=name, kind="around", parent="table") for name in "ab"])
    assert [round(math.cos(angles[name])) for name in "ab"] == [-1, 1]


@pytest.mark.parametrize(("disc", "fits"), [(False, True), (True, False)])
def test_a_weight_towards_the_corner_is_on_a_square_and_off_a_disc(disc, fits):
    """At 0.8 of both half sides it is at 1.13 radii of the disc."""
    corners = 0.01 * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    item = Item(
        name="a",
        low=corners.min(axis=0),
        high=corners.max(axis=0),
        outline=corners,
        centre_of_mass=np.full(2, 0.08),
        tall=0.1,
    )
    assert (arrange_flat([item], [], Surface(half_size=(0.1, 0.1), disc=disc)) is not None) is fits


@pytest.mark.parametrize("kind", ["left_of", "right_of", "in_front_of", "behind", "next_to", "around"])
def test_a_relation_does_not_depend_on_where_the_scene_is(kind):
    assets = {"a": block(), "b": block(0.2, 0.1, 0.05)}
    relation = Relation(child="a", kind=kind, parent="b")
    rng = np.random.default_rng(0)
    seen = set()
    for _ in range(60):
        offset = rng.uniform(-0.3, 0.3, 2)
        verdicts = [
            check_relations(
                (relation,), assets, {"a": Pose(position=(*(offset + away), 0.0)), "b": Pose(position=(*away, 0.0))}
            )[0]
            for away in (np.zeros(2), np.array([8.0, 8.0]), np.array([-8.0, -8.0]))
        ]
        assert len({verdict.holds for verdict in verdicts}) == 1
        assert len({verdict.detail for verdict in verdicts}) == 1
        seen.add(verdicts[0].holds)
    assert True in seen


def test_heights_apart_are_told():
    assets = {"a": block(), "b": block()}
    beside = Relation(child="a", kind="next_to", parent="b")
    far, near = (
        check_relations((beside,), assets, {"a": Pose(position=(0.1, 0.0, z)), "b": Pose()})[0] for z in (0.36, 0.06)
    )
    assert "0.30 m between their heights" in far.detail
    assert "between" not in near.detail


def test_the_lowest_point_of_a_layout_is_that_of_its_lowest_body():
    bodies = [place(name, block(), Pose(position=(x, 0.0, z))) for name, x, z in (("a", 0.0, 0.01), ("b", 0.5, 0.2))]
    assert require_clearance(bodies).lowest == pytest.approx(0.01)
