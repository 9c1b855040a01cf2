"""Doors in the sockets of their case."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from pat3d.assets.catalogue import make
from pat3d.assets.catalogue.doors import COLLAR, DOORWAYS, LEAF, PIN, PLAY
from pat3d.check.certificate import certify
from pat3d.check.penetration import penetration
from pat3d.errors import LayoutError
from pat3d.geometry.pose import Pose
from pat3d.layout.bodies import place_all
from pat3d.layout.doors import OPEN, in_sockets, open_by
from pat3d.layout.layout import arrange
from pat3d.layout.predicates import check_relations
from pat3d.scene.model import Relation
from tests.doors import door_scene
from tests.drawers import at_rest


def placed(scene):
    """Door and case of a scene."""
    bodies = place_all({o.name: o.asset for o in scene.objects}, {o.name: o.pose for o in scene.objects})
    return bodies["door"], next(body for name, body in bodies.items() if name in DOORWAYS)


def held(scene) -> dict[str, bool]:
    poses, assets = {o.name: o.pose for o in scene.objects}, {o.name: o.asset for o in scene.objects}
    return {str(one.relation): one.holds for one in check_relations(scene.relations, assets, poses)}


@pytest.mark.parametrize("of", sorted(DOORWAYS))
def test_the_corners_of_a_door_clear_the_front_and_its_pins_their_sockets(of):
    way = DOORWAYS[of]
    # A prism of twelve sides around a pin is wider than it by 1 / cos(15 degrees).
    assert PIN / np.cos(np.pi / 12) < PIN + PLAY
    assert np.hypot(COLLAR, LEAF / 2) < way.front - way.axis[1]
    assert way.across[0] < way.axis[0] < way.axis[0] + way.width <= way.across[1]


@pytest.mark.parametrize("scale", [1.0, 0.75, 1.3])
@pytest.mark.parametrize("of", sorted(DOORWAYS))
def test_shut_and_open_doors_are_in_their_sockets_and_meet_nothing(of, scale):
    for state, angle in (("", 0.0), ("open ", OPEN)):
        scene = door_scene(of, state, scale=scale)
        door, case = placed(scene)
        assert np.degrees(open_by(door, case)) == pytest.approx(angle, abs=1e-9)
        assert in_sockets(door, case)[0]
        assert not penetration(scene).hulls


@pytest.mark.parametrize("state", ["", "open "])
@pytest.mark.parametrize("of", sorted(DOORWAYS))
def test_at_rest_doors_hang_where_they_were_and_the_scene_is_certified(of, state):
    scene = at_rest(door_scene(of, state, inside="mug"))
    assert held(scene) == {f"door in {of}": True, f"mug in {of}": True}
    assert certify(scene).passed
    assert not penetration(scene).hulls
    door, case = placed(scene)
    assert np.degrees(open_by(door, case)) == pytest.approx(OPEN if state else 0.0, abs=1.0)


@pytest.mark.parametrize(
    ("shift", "tilt", "holds"), [((0, 0, 0), 0.0, True), ((0.02, 0, 0), 0.0, False), ((0, 0, 0), 0.1, False)]
)
def test_a_door_beside_its_sockets_or_askew_is_not_in_its_case(shift, tilt, holds):
    scene = door_scene("microwave")
    door, case = placed(scene)
    pivot = door.rotation @ [door.body.vertices[:, 0].min(), 0.0, 0.0] + door.position
    turned = np.array([[np.cos(tilt), 0.0, np.sin(tilt)], [0.0, 1.0, 0.0], [-np.sin(tilt), 0.0, np.cos(tilt)]])
    pose = Pose.from_matrix(turned @ door.rotation, turned @ (door.position - pivot) + pivot + shift)
    moved = [replace(o, pose=pose) if o.name == "door" else o for o in scene.objects]
    bodies = place_all({o.name: o.asset for o in moved}, {o.name: o.pose for o in moved})
    assert in_sockets(bodies["door"], case)[0] == holds


@pytest.mark.parametrize("seed", range(4))
def test_nothing_is_laid_out_where_a_door_turns(seed):
    """Seen from above, what stands beside a microwave on a table is off the arc of its door."""
    names = ("microwave", "mug", "bowl", "apple", "can")
    assets = {name: make(name) for name in ("table", *names[1:])}
    assets |= {"microwave": make("hinged microwave"), "door": make("hinged microwave door")}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in names)
    poses = arrange(assets, (*on, Relation(child="door", kind="in", parent="microwave")), seed=seed).poses
    case, way = poses["microwave"], DOORWAYS["microwave"]
    axis = np.array(case.position)[:2] + case.rotation[:2, :2] @ way.axis
    for name in names[1:]:
        corners = np.concatenate([poses[name].apply(part.vertices) for part in assets[name].parts])[:, :2] - axis
        own = corners @ case.rotation[:2, :2]
        swept = (np.hypot(*own.T) < way.width) & (own[:, 0] > 0.0) & (own[:, 1] < 0.0)
        assert not swept.any(), name


def test_a_door_that_is_in_no_case_takes_up_what_it_stands_on():
    """As a plan of others may have it: on a table, beside a mug."""
    scene = door_scene("fridge")
    assets = {"table": make("table"), "door": scene["door"].asset, "mug": make("mug")}
    on = tuple(Relation(child=name, kind="on", parent="table") for name in ("door", "mug"))
    assert {*arrange(assets, on, seed=0).poses} == {"table", "door", "mug"}


def test_a_second_door_is_refused():
    scene = door_scene("fridge")
    assets = {o.name: o.asset for o in scene.objects} | {"other": scene["door"].asset}
    with pytest.raises(LayoutError, match='has one door; "other" is another'):
        arrange(assets, (*scene.relations, Relation(child="other", kind="in", parent="fridge")), seed=0)
