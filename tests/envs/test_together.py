"""Two arms at one thing: carrying with both hands, and handing over from one to the other."""

from __future__ import annotations

import json

import numpy as np
import pytest

pytest.importorskip("gymnasium")

from pat3d.assets.shapes import box
from pat3d.envs.env import TabletopEnv
from pat3d.envs.grasping import remembered
from pat3d.envs.grasping.pairwise import paired_grasps
from pat3d.envs.grasping.standing import Needs
from pat3d.envs.tasks.registry import parse_task
from pat3d.errors import TaskError
from pat3d.policies_eval.policies.policy import EpisodeStart
from pat3d.policies_eval.policies.scripted import ScriptedPolicy
from tests.envs.own_arm import own_arm
from tests.scenes import GAP, asset_of, placed, scene_of

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


def attempt(env, task: str, steps: int = 400, watch=lambda info: None) -> dict:
    """The scripted policy at a task: the last info."""
    observation, info = env.reset(seed=3, options={"task": task})
    policy = ScriptedPolicy()
    policy.reset(
        EpisodeStart(
            instruction=info["instruction"], task=task, seed=3, robot=env.config.arms, control="osc",
            action_size=14, control_freq=20.0, env=env,
        )
    )  # fmt: skip
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
