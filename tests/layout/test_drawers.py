"""Drawers in the rows of their cabinet."""

from __future__ import annotations

import numpy as np
import pytest

from pat3d.assets.catalogue.drawers import ABOVE, BEHIND, BOX, DEPTH, FLOORS, ROOM, SIDE, WALL, WIDTH
from pat3d.check.certificate import certify
from pat3d.check.penetration import penetration
from pat3d.errors import LayoutError
from pat3d.layout.drawers import pulled, shut_at
from pat3d.layout.predicates import check_relations
from tests.drawers import at_rest, cabinet_scene


def out(scene, name: str) -> float:
    """By how much a drawer is out [m], as its cabinet sees it."""
    cabinet, drawer = scene["cabinet"], scene[name]
    along = cabinet.pose.rotation.T @ (np.array(drawer.pose.position) - np.array(cabinet.pose.position))
    return shut_at(drawer.asset, cabinet.asset) - along[1]


def test_a_drawer_has_the_stated_air_on_every_side():
    assert BOX[0] == pytest.approx(WIDTH - 2 * WALL - 2 * SIDE)
    assert BOX[1] == pytest.approx(DEPTH - WALL - BEHIND)
    assert BOX[2] == pytest.approx(ROOM - ABOVE)


@pytest.mark.parametrize("scale", [1.0, 0.75, 1.3])
def test_shut_and_open_drawers_are_as_far_out_as_they_should_be_and_meet_nothing(scale):
    scene = cabinet_scene("drawer", "open drawer", "drawer", scale=scale)
    assert out(scene, "drawer 0") == pytest.approx(0.0, abs=1e-9)
    assert out(scene, "drawer 1") == pytest.approx(0.38 * scene["drawer 1"].asset.size[1], rel=1e-9)
    assert pulled(scene["drawer 1"].asset) > 0.0
    assert not penetration(scene).hulls


def test_at_rest_what_is_shut_and_what_is_in_a_drawer_is_held_and_the_scene_is_certified():
    scene = at_rest(cabinet_scene("open drawer", "drawer", inside="cube"))
    poses, assets = {o.name: o.pose for o in scene.objects}, {o.name: o.asset for o in scene.objects}
    held = {str(one.relation): one.holds for one in check_relations(scene.relations, assets, poses)}
    assert len(held) == 3
    assert all(held.values())
    assert certify(scene).passed
    assert not penetration(scene).hulls


def test_drawers_take_the_rows_from_above():
    scene = cabinet_scene("drawer", "drawer", "drawer")
    heights = [scene[f"drawer {at}"].pose.position[2] - scene["cabinet"].pose.position[2] for at in range(3)]
    # They float by the gap of the layout.
    np.testing.assert_allclose(heights, FLOORS, atol=4e-3)


def test_what_is_put_into_an_open_drawer_is_in_front_of_the_cabinet():
    scene = cabinet_scene("open drawer", inside="cube")
    cabinet = scene["cabinet"].pose
    along = cabinet.rotation.T @ (np.array(scene["cube"].pose.position) - np.array(cabinet.position))
    assert along[1] < -DEPTH / 2
    assert not penetration(scene).hulls


def test_what_is_too_high_for_a_row_is_refused():
    with pytest.raises(LayoutError, match="does not fit into"):
        cabinet_scene("drawer", inside="cube", inside_scale=3.0)


def test_a_fourth_drawer_is_refused():
    with pytest.raises(LayoutError, match="no row of that is free"):
        cabinet_scene("drawer", "drawer", "drawer", "drawer")
