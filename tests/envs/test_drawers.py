"""Opening and shutting a drawer: what a scene allows, and when it is done."""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.envs.tasks.registry import parse_task, possible_tasks
from pat3d.errors import TaskError
from pat3d.layout.drawers import pulled
from tests.drawers import at_rest, cabinet_scene
from tests.envs.beside_scenes import put, rest, scripted


@pytest.fixture(scope="module")
def shut():
    return at_rest(cabinet_scene("drawer"))


@pytest.fixture(scope="module")
def opened():
    return at_rest(cabinet_scene("open drawer", inside="cube"))


def test_a_shut_drawer_opens_and_an_open_one_shuts(shut, opened):
    assert [task.spec for task in possible_tasks(shut) if task.kind in ("open", "close")] == ["open:drawer 0"]
    assert [task.spec for task in possible_tasks(opened) if task.kind in ("open", "close")] == ["close:drawer 0"]


def test_what_is_done_already_or_no_drawer_is_told(shut, opened):
    for scene, spec, said in (
        (shut, "close:drawer 0", "is shut already"),
        (opened, "open:drawer 0", "is open already"),
        (opened, "open:cube", "is no drawer"),
    ):
        with pytest.raises(TaskError, match=said):
            parse_task(spec).check(scene)


def test_the_robot_stands_before_the_cabinet_and_reaches_both_ends_of_the_way(shut):
    needs = parse_task("open:drawer 0").needs(shut)
    assert needs.push == ("drawer 0",)
    front = shut["cabinet"].pose.rotation @ [0.0, -1.0, 0.0]
    assert needs.side == pytest.approx(np.arctan2(front[1], front[0]))
    way = (np.array(needs.visit[-2]) - np.array(needs.visit[0])) @ front
    assert way == pytest.approx(0.85 * pulled(shut["drawer 0"].asset), abs=5e-4)


@pytest.fixture(scope="module")
def env(shut):
    from pat3d.envs.env import TabletopEnv

    env = TabletopEnv(scene=shut, task="open:drawer 0")
    yield env
    env.close()


@pytest.mark.parametrize(("share", "done"), [(0.9, True), (0.3, False)])
def test_it_is_open_when_it_is_far_enough_out(env, shut, share, done):
    env.reset(seed=0)
    drawer, front = shut["drawer 0"], shut["cabinet"].pose.rotation @ [0.0, -1.0, 0.0]
    put(env, "drawer 0", np.array(drawer.pose.position) + share * pulled(drawer.asset) * front, drawer.pose.quat_wxyz)
    info = rest(env)
    assert info["success"] == done


def test_a_drawer_that_stands_before_its_cabinet_is_not_open(env, shut):
    env.reset(seed=0)
    drawer, front = shut["drawer 0"], shut["cabinet"].pose.rotation @ [0.0, -1.0, 0.0]
    at = np.array(drawer.pose.position) + 1.2 * drawer.asset.size[1] * front
    put(env, "drawer 0", (at[0], at[1], 0.001), drawer.pose.quat_wxyz)
    info = rest(env)
    assert not info["success"]


def test_a_drawer_that_tips_is_not_open(env, shut):
    env.reset(seed=0)
    drawer, front = shut["drawer 0"], shut["cabinet"].pose.rotation @ [0.0, -1.0, 0.0]
    at = np.array(drawer.pose.position) + 1.2 * drawer.asset.size[1] * front + [0.0, 0.0, 0.2]
    info = put(env, "drawer 0", at, (np.cos(0.4), np.sin(0.4), 0.0, 0.0))
    assert not info["predicates"]["at rest"]
    assert not info["predicates"]["open"]


def test_what_a_chain_opens_and_then_shuts_need_not_stay_open(env, shut):
    spec = "chain:open:drawer 0:then:close:drawer 0"
    parse_task(spec).check(shut)
    env.reset(seed=0, options={"task": spec})
    drawer, front = shut["drawer 0"], shut["cabinet"].pose.rotation @ [0.0, -1.0, 0.0]
    at = np.array(drawer.pose.position)
    put(env, "drawer 0", at + 0.9 * pulled(drawer.asset) * front, drawer.pose.quat_wxyz)
    info = rest(env, 20)
    assert not info["success"]
    put(env, "drawer 0", at, drawer.pose.quat_wxyz)
    info = rest(env)
    assert info["success"]
    assert info["predicates"]["kept"]


@pytest.mark.parametrize(("share", "aside", "there"), [(0.9, 0.0, True), (1.6, 0.0, False), (0.9, 0.6, False)])
def test_it_is_open_neither_right_out_nor_beside_its_row(env, shut, share, aside, there):
    env.reset(seed=0, options={"task": "open:drawer 0"})
    drawer, turned = shut["drawer 0"], shut["cabinet"].pose.rotation
    way = turned @ [aside, -share * pulled(drawer.asset), 0.0]
    info = put(env, "drawer 0", np.array(drawer.pose.position) + way, drawer.pose.quat_wxyz)
    assert info["predicates"]["open"] == there


@pytest.mark.parametrize("spec", ["open:drawer 0", "chain:open:drawer 0:then:close:drawer 0"])
def test_the_scripted_policy_opens_a_drawer_and_shuts_it(env, spec):
    assert scripted(env, spec)["success"]
