"""Two arms at one thing: carrying with both hands, and handing over from one to the other."""

from __future__ import annotations

import json
import math
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box, cylinder
from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping import remembered
from pat3d.envs.grasping.grasp import find_grasps
from pat3d.envs.grasping.pairwise import FIRM, LEVEL, paired_grasps
from pat3d.envs.grasping.standing import Needs
from pat3d.envs.robots.arms import measure_gripper
from pat3d.envs.tasks.registry import parse_task
from pat3d.errors import TaskError
from pat3d.geometry.pose import Pose
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, WOOD, asset_of, placed, scene_of

LONG, SIDE = 0.3, 0.04


@pytest.fixture(scope="module")
def own(tmp_path_factory):
    path = tmp_path_factory.mktemp("robots") / "arm.xml"
    path.write_text(own_arm())
    return str(path)


@pytest.fixture(scope="module")
def bar():
    """A bar with a cube on its middle, and a cube beside it."""
    cube = asset_of(box(0.03, 0.03, 0.03))
    return scene_of(
        placed("bar", asset_of(box(LONG, SIDE, SIDE)), (0.0, 0.0, GAP)),
        placed("cube", cube, (0.0, 0.12, GAP)),
    )


@pytest.fixture(scope="module")
def env(own, bar):
    made = TabletopEnv(scene=bar, robot=[own, own], task="carry:bar")
    yield made
    made.close()


def begin(env, info: dict) -> EpisodeStart:
    return EpisodeStart(
        instruction=info["instruction"], task=env.task.spec, seed=3, robot=env.config.arms, control="osc",
        action_size=14, control_freq=20.0, env=env,
    )  # fmt: skip


def attempt(env, task: str, steps: int = 400, watch=lambda info: None) -> dict:
    """The scripted policy at a task: the last info."""
    observation, info = env.reset(seed=3, options={"task": task})
    policy = ScriptedPolicy()
    policy.reset(begin(env, info))
    for _ in range(steps):
        observation, _, success, broken, info = env.step(policy.act(observation))
        watch(info)
        assert not broken
        if success:
            break
    return info


def test_pairs_are_of_different_ends_and_of_both_orders(bar, own):
    for wide in (True, False):
        pairs = paired_grasps(bar, "bar", (own, own), wide=wide)
        apart = [abs(left.position[0] - right.position[0]) for left, right in pairs]
        # Hands that close across the bar are 9 cm wide along it.
        assert min(apart) > 0.09
        assert any(pair == pairs[0][::-1] for pair in pairs)
        first = apart[0]
        assert first > 0.2 if wide else first < 0.15


def test_a_pin_is_handed_over_squarely_and_near_its_middle(own):
    """Pads that meet a cylinder at a height z above its axis face it by asin(z / r): boards keep them high."""
    radius, lying = 0.025, np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    pose = Pose.from_matrix(lying, np.array([-LONG / 2, 0.0, radius]))
    pin, board = placed("pin", asset_of(cylinder(radius, LONG, sides=120)), pose=pose), asset_of(box(LONG, 0.1, 0.03))
    pairs = paired_grasps(scene_of(pin), "pin", (own, own), wide=False)
    aside = [tuple(math.hypot(*one.position[:2]) for one in pair) for pair in pairs]
    assert aside == sorted(aside, key=lambda one: LEVEL * one[0] ** 2 + one[1] ** 2)
    # What is offered stays level, what is taken may hang.
    assert aside[0][0] < aside[0][1]
    boards = (placed(f"board {side}", board, (0.0, 0.08 * side, GAP)) for side in (-1, 1))
    beside = scene_of(pin, *boards)
    high = find_grasps(beside, "pin", measure_gripper(own))
    assert high
    for grasp in high:
        # The lowest of the rays that measure a grasp is a tenth of its bite above the fingertips.
        lowest = grasp.position[2] + 0.1 * min(grasp.bite, measure_gripper(own).pad) - radius
        assert grasp.facing == pytest.approx(math.cos(math.asin(lowest / radius)), abs=0.03)
        assert grasp.facing < FIRM
    with pytest.raises(TaskError, match=r'"pin" \(.*cannot be handed over: it would turn in the fingers of .* or slip'):
        paired_grasps(beside, "pin", (own, own), wide=False)


def test_what_would_turn_in_one_hand_is_carried_by_two_and_not_handed_over(own):
    lead = replace(WOOD, density=5000.0)
    heavy = scene_of(placed("bar", asset_of(box(LONG, SIDE, SIDE), material=lead), (0.0, 0.0, GAP)))
    assert paired_grasps(heavy, "bar", (own, own), wide=True)
    with pytest.raises(TaskError, match=r'"bar" (offers no two places at which one hand holds it|.*turn in the)'):
        paired_grasps(heavy, "bar", (own, own), wide=False)


def test_what_is_too_short_for_two_hands_and_one_arm_alone_are_refused(bar, own):
    with pytest.raises(TaskError, match='"cube" offers no two places'):
        TabletopEnv(scene=bar, robot=[own, own], task="carry:cube")
    with pytest.raises(TaskError, match=r'"bar" is taken by two arms, and .* is one'):
        TabletopEnv(scene=bar, robot=own, task="handover:bar")


def test_a_kept_placement_of_two_hands_is_what_was_found(bar, own, tmp_path, monkeypatch):
    monkeypatch.setenv("PAT3D_CACHE", str(tmp_path))
    needs, pair = Needs(grasp=("bar",), together="wide"), f"{own}+{own}"
    found = remembered.placed(bar, "a checksum", pair, needs)
    assert found.other is not None
    assert found.other.grasps["bar"] != found.grasps["bar"]
    remembered._known.clear()
    assert len(list(tmp_path.rglob("*.json"))) == 1
    assert remembered.placed(bar, "a checksum", pair, needs) == found
    assert json.loads(next(tmp_path.rglob("*.json")).read_text())["other"]["grasps"]


def test_the_left_hand_takes_the_end_on_its_side(env):
    placement = env.placement
    assert (placement.side, placement.other.side) == ("left", "right")
    c, s = np.cos(placement.yaw), np.sin(placement.yaw)
    aside = [
        -s * one.position[0] + c * one.position[1]
        for one in (placement.grasps["bar"][0], placement.other.grasps["bar"][0])
    ]
    assert aside[0] > aside[1]


def test_both_hands_carry_a_bar_level(env):
    seen = []
    info = attempt(env, "carry:bar", watch=lambda info: seen.append(info["progress"]))
    assert info["success"]
    assert all(info["predicates"].values())
    assert seen[-1] == 1.0
    assert max(seen[:-1]) < 1.0


@pytest.mark.slow
def test_a_bar_goes_from_the_left_hand_to_the_right_one(env):
    """Success needs the left hand to have had it alone and to be off it; progress only grows on the way."""
    seen = []
    info = attempt(env, "handover:bar", watch=lambda info: seen.append(dict(info["predicates"])))
    assert info["success"]
    shown = next(number for number, one in enumerate(seen) if one["shown"])
    taken = next(number for number, one in enumerate(seen) if one["right"])
    freed = next(number for number, one in enumerate(seen) if one["right"] and one["free"])
    assert shown < taken < freed


@pytest.mark.slow
def test_what_falls_from_the_left_hand_is_taken_and_handed_over_again(env):
    """The left fingers are opened for half a second when they have shown it: it falls, and the second try succeeds."""
    observation, info = env.reset(seed=3, options={"task": "handover:bar"})
    policy = ScriptedPolicy()
    policy.reset(begin(env, info))
    opened, lowest, success = 0, 1.0, False
    for _ in range(400):
        action = policy.act(observation)
        if info["predicates"]["shown"] and opened < 10:
            action[6], opened = -1.0, opened + 1
        observation, _, success, _, info = env.step(action)
        if opened:
            lowest = min(lowest, float(env.simulation.state.position("bar")[2]))
        if success:
            break
    assert lowest < env.placement.surface + 0.01
    assert success


def test_one_hand_is_not_two(env):
    """What is lifted by one hand alone, however high, is neither carried nor handed over."""
    from pat3d.envs.grasping.scripted import ScriptedPick

    for task in ("carry:bar", "handover:bar"):
        env.reset(seed=0, options={"task": task})
        hand, info = ScriptedPick(env, "bar"), {}
        for _ in range(100):
            _, _, success, _, info = env.step(hand.action())
            assert not success
        assert info["progress"] < 0.6
    assert info["predicates"]["shown"]


def test_instructions_name_the_hands(bar):
    assert parse_task("handover:bar").instruction(bar) == (
        "pick up the bar with the left hand and hand it over to the right hand"
    )
    assert "both hands" in parse_task("carry:bar").instruction(bar)
