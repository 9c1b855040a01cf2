"""Whether one more fits on a top: strips and blocks that leave exactly known room."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from pat3d.envs.grasping.free_space import FINGER_GAP, NARROWEST_BASE, edge_margin, has_free_space
from pat3d.geometry.pose import Pose
from pat3d.scene.asset import Region
from pat3d.scene.model import Scene, SceneObject
from tests.envs.test_grasp import bar

HALF = 0.155
"""Of the table's side [m]; with the margin of 1 cm the outermost spots are 14 cm from its middle."""

OUTERMOST = 0.14
CUBE = 0.04
NEEDED = CUBE / math.sqrt(2) + FINGER_GAP
"""From the middle of the cube to what stands there, however the cube is turned [m]."""


def table(half: float = HALF, shape: str = "rectangle") -> SceneObject:
    made = bar("table", (2 * half, 2 * half, 0.02))
    region = Region(kind="on", shape=shape, floor=(0.0, 0.0, 0.02), half_size=(half, half))
    return replace(made, asset=replace(made.asset, regions=(region,)))


def strip(name: str, low: float, high: float, quarter: int = 0) -> SceneObject:
    """A block from x = low to x = high along the whole table, turned by quarters of a turn about its middle."""
    turn, middle = quarter * math.pi / 2, (low + high) / 2
    return bar(name, (high - low, 2 * HALF, 0.05), (middle * math.cos(turn), middle * math.sin(turn)), turn)


def moved(obj: SceneObject, yaw: float, shift: tuple[float, float, float]) -> SceneObject:
    """An object and what is around it turned about the origin and shifted."""
    motion = Pose.from_yaw(yaw, shift)
    return replace(
        obj, pose=Pose.from_matrix(motion.rotation @ obj.pose.rotation, motion.apply([obj.pose.position])[0])
    )


def fits(*covering: SceneObject, on: SceneObject | None = None, size: float = CUBE) -> bool:
    """Whether a cube from somewhere else fits on the table beside `covering`."""
    base = on or table()
    cube = bar("cube", (size, size, 0.04), (1.3, -0.8), 0.3)
    scene = Scene(objects=(base, cube, *covering))
    return has_free_space(scene, "cube", "table", base.asset.regions[0], [one.name for one in covering])


@pytest.mark.parametrize("quarter", range(4))
def test_beside_a_strip_it_fits_as_soon_as_a_finger_does(quarter):
    """The spots furthest from the strip are 14 cm from the middle, on any of the four sides."""
    border = OUTERMOST - NEEDED
    assert fits(strip("strip", -HALF, border - 1e-6, quarter))
    assert not fits(strip("strip", -HALF, border + 1e-6, quarter))


def test_between_two_strips_it_needs_the_room_on_both_sides():
    for middle, room, free in (
        (0.0, NEEDED + 1e-6, True), (0.0, NEEDED - 1e-6, False),
        (0.03, NEEDED + 1e-6, True), (-0.01, NEEDED + 1e-6, True),
    ):  # fmt: skip
        pair = strip("left", -HALF, middle - room), strip("right", middle + room, HALF)
        assert fits(*pair) == free
        assert fits(pair[0])
        assert fits(pair[1])


@pytest.mark.parametrize(("yaw", "shift"), [(0.7, (2.0, -1.0, 0.3)), (-2.2, (-0.4, 0.9, 0.0))])
def test_where_the_table_stands_does_not_matter(yaw, shift):
    border = OUTERMOST - NEEDED
    for width, free in ((-1e-6, True), (1e-6, False)):
        cover = moved(strip("strip", -HALF, border + width, 1), yaw, shift)
        assert fits(cover, on=moved(table(), yaw, shift)) == free


def test_an_object_is_as_large_as_the_circle_around_it_wherever_its_origin_is():
    base, cube = table(), bar("cube", (CUBE, CUBE, 0.04), (1.3, -0.8), 0.3)
    part = cube.asset.parts[0]
    aside = replace(part, vertices=part.vertices + [0.5, -0.2, 0.0])
    cube = replace(cube, asset=replace(cube.asset, parts=(aside,)))
    for width, free in ((-1e-6, True), (1e-6, False)):
        cover = strip("strip", -HALF, OUTERMOST - NEEDED + width)
        scene = Scene(objects=(base, cube, cover))
        assert has_free_space(scene, "cube", "table", base.asset.regions[0], ["strip"]) == free


def test_a_disc_has_no_corners():
    """Around a block of 18 cm a square table has room at its corners only, around one of 16 cm at its sides too."""
    for half, square, disc in ((0.09, True, False), (0.08, True, True), (0.1, False, False)):
        block = bar("block", (2 * half, 2 * half, 0.05))
        assert fits(block) == square
        assert fits(block, on=table(shape="disc")) == disc


def test_of_a_top_smaller_than_its_margin_the_middle_is_left():
    assert fits(on=table(0.005), size=0.3)
    assert not fits(bar("block", (0.01, 0.01, 0.05)), on=table(0.005), size=0.3)
    assert fits(bar("block", (0.01, 0.01, 0.05), (1.0, 0.0)), on=table(0.005), size=0.3)


@pytest.mark.parametrize(
    ("size", "margin"), [((0.1, 0.3, 0.1), 0.02), ((0.3, 0.2, 0.1), 0.04), ((0.04, 0.04, 0.1), 0.01)]
)
def test_the_margin_keeps_the_least_base_under_the_object(size, margin):
    """On a base that is narrower than 0.4 of it nothing stands; a centimetre at least."""
    assert edge_margin(Scene(objects=(bar("box", size),)), "box") == pytest.approx(margin, rel=1e-9)
    assert margin == pytest.approx(max(0.01, NARROWEST_BASE * min(size[:2]) / 2))
