"""Opening and shutting a door that turns: when it is done, and what the scripted policy makes of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.grasping.site import Site
from pat3d.envs.tasks.mechanisms import mechanism_of
from pat3d.envs.tasks.registry import parse_task, possible_tasks
from pat3d.errors import TaskError
from pat3d.geometry.pose import Pose
from pat3d.layout.doors import OPEN
from tests.doors import door_scene
from tests.drawers import at_rest
from tests.envs.beside_scenes import put, rest, scripted


@pytest.fixture(scope="module")
def shut():
    return at_rest(door_scene("microwave"))


@pytest.fixture(scope="module")
def opened():
    return at_rest(door_scene("microwave", "open "))


def test_a_shut_door_opens_and_an_open_one_shuts(shut, opened):
    assert [task.spec for task in possible_tasks(shut) if task.kind in ("open", "close")] == ["open:door"]
    assert [task.spec for task in possible_tasks(opened) if task.kind in ("open", "close")] == ["close:door"]


@pytest.mark.parametrize(
    ("state", "spec", "said"),
    [("", "close:door", "is shut already"), ("open ", "open:door", "is open already"),
     ("", "open:microwave", "no door of a microwave")],
)  # fmt: skip
def test_what_is_done_already_or_no_door_is_told(state, spec, said, shut, opened):
    with pytest.raises(TaskError, match=said):
        parse_task(spec).check(opened if state else shut)


def test_a_door_turns_about_its_hinge(shut):
    """After a turn the pins are where they were, and the handle is as far from them."""
    way = mechanism_of(shut, "door")
    position, rotation = way.within(shut, "door")
    turned = way.moved(position, rotation, np.radians(60.0))
    assert way.out(turned[0][None], turned[1][None])[0] - way.out_in(shut, "door") == pytest.approx(np.radians(60.0))
    pivot = way.hinge.pivot
    np.testing.assert_allclose(turned[0] + turned[1] @ pivot, position + rotation @ pivot, atol=1e-12)
    handle = way.at_handle("open") - pivot
    before, after = rotation @ handle, turned[1] @ handle
    assert np.linalg.norm(after) == pytest.approx(np.linalg.norm(before))
    # It opens towards the front, -y, about an axis at the left.
    assert after[1] < before[1]
    assert way.along(position + rotation @ (handle + pivot)) < way.along(turned[0] + turned[1] @ (handle + pivot))


def test_no_robot_stands_where_the_door_turns(shut):
    needs = parse_task("open:door").needs(shut)
    way = mechanism_of(shut, "door")
    case = shut["microwave"].pose
    for share in (0.0, 0.5, 1.0):
        position, rotation = way.moved(*way.within(shut, "door"), share * way.goal("open"))
        end = case.apply((rotation @ [shut["door"].asset.bounds[1][0], 0.0, 0.0] + position)[None])[0]
        assert np.linalg.norm(np.array(needs.swept) - end[:2], axis=1).min() < 0.08
    assert len(needs.fronts) == len(needs.visit)
    assert needs.fronts[-1] - needs.fronts[0] == pytest.approx(-way.goal("open"), abs=0.02)


def test_a_base_has_no_room_beside_where_a_door_turns(shut):
    """A metre before the microwave a base has room, and none where something is swept there."""
    needs = parse_task("open:door").needs(shut)
    free, spot = Site.of(shut, needs), (0.0, -1.0, 0.0)
    assert free._free(spot, 0.1)
    assert not Site.of(shut, replace(needs, swept=((0.05, -1.0),)))._free(spot, 0.1)


@pytest.fixture(scope="module")
def env(shut):
    from pat3d.envs.env import TabletopEnv

    env = TabletopEnv(scene=shut, task="open:door")
    yield env
    env.close()


def turned_by(scene, degrees: float) -> Pose:
    """The pose of the door when it is open by so much."""
    way, case = mechanism_of(scene, "door"), scene["microwave"].pose
    by = np.radians(degrees) - way.out_in(scene, "door")
    position, rotation = way.moved(*way.within(scene, "door"), by)
    return Pose.from_matrix(case.rotation @ rotation, case.apply(position[None])[0])


@pytest.mark.parametrize(("degrees", "done"), [(0.7 * OPEN, True), (0.4 * OPEN, False)])
def test_it_is_open_when_it_is_turned_far_enough(env, shut, degrees, done):
    env.reset(seed=0)
    pose = turned_by(shut, degrees)
    put(env, "door", pose.position, pose.quat_wxyz)
    assert rest(env)["success"] == done


def test_a_door_that_is_out_of_its_sockets_is_not_open(env, shut):
    env.reset(seed=0)
    pose = turned_by(shut, 0.7 * OPEN)
    info = put(env, "door", (pose.position[0], pose.position[1] - 0.05, pose.position[2]), pose.quat_wxyz)
    assert not info["predicates"]["open"]


@pytest.mark.parametrize("spec", ["open:door", "chain:open:door:then:close:door"])
def test_the_scripted_policy_opens_a_door_and_shuts_it(env, spec):
    assert scripted(env, spec)["success"]


@pytest.mark.slow
@pytest.mark.parametrize("of", ["cabinet", "fridge"])
@pytest.mark.parametrize(("state", "spec"), [("", "open:door"), ("open ", "close:door")])
def test_the_scripted_policy_moves_the_doors_of_cabinets_and_fridges(of, state, spec):
    from pat3d.envs.env import TabletopEnv

    env = TabletopEnv(scene=at_rest(door_scene(of, state)), task=spec)
    assert scripted(env, spec)["success"]
    env.close()
