"""Chains: what they may be made of, and a judge that remembers which steps were done in their turn."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from pat3d.envs.env import TabletopEnv
from pat3d.envs.tasks.chain import Chain, ChainJudge
from pat3d.envs.tasks.manipulate import Pick, Place
from pat3d.envs.tasks.registry import parse_task
from pat3d.envs.tasks.task import Verdicts
from pat3d.errors import TaskError

TWO = "chain:place:green apple:blue bowl:then:pick:red mug"


def test_a_chain_survives_its_specification():
    task = parse_task(TWO)
    assert isinstance(task, Chain)
    assert task.steps == (Place(target="green apple", where="blue bowl"), Pick(target="red mug"))
    assert parse_task(task.spec) == task
    assert task.names == ("green apple", "blue bowl", "red mug")


@pytest.mark.parametrize(
    ("spec", "said"),
    [
        ("chain:pick:a", "2 to 5 steps"),
        ("chain:" + ":then:".join(f"pick:{k}" for k in range(6)), "2 to 5 steps"),
        ("chain:pick:a:then:place:b:c", "steps put, stack, lift, open or close, the last may pick"),
        ("chain:place:a:b:then:sort", "steps put, stack, lift, open or close"),
        ("chain:place:a:b:then:place:a:c", "another object"),
        ("chain:place:a:b:then:chain:pick:c", "no step of a chain"),
        ("chain:place:a:then:pick:c", "does not fit"),
        ("chain", "no task"),
    ],
)
def test_what_is_no_chain_is_told(spec, said):
    with pytest.raises(TaskError, match=said):
        parse_task(spec)


def test_a_chain_is_said_in_its_order_and_needs_what_its_steps_need(breakfast):
    task = parse_task(TWO)
    task.check(breakfast)
    wordings = task.wordings(breakfast)
    assert wordings[0] == "first put the green apple in the blue bowl, then pick up the red mug from the wooden tray"
    assert all(text.index("green apple") < text.index("red mug") for text in wordings)
    assert task.needs(breakfast).grasp == ("green apple", "red mug")
    assert task.horizon(breakfast, 20.0) == 700


def test_a_scene_s_own_chain_is_what_an_environment_asks_for(breakfast):
    task = "chain:place:green apple:blue bowl:then:place:banana:blue bowl"
    env = TabletopEnv(scene=replace(breakfast, task=task))
    assert env.task.spec == task
    assert set(env.placement.grasps) >= {"green apple", "banana"}


class Step:
    """In place of a judge: what it says is set by hand, and success takes two updates in a row."""

    def __init__(self, worlds: int) -> None:
        self.there = np.zeros(worlds, dtype=np.bool_)
        self.timer = np.zeros(worlds)

    def begin(self, worlds):
        self.timer[worlds] = 0.0

    def update(self, seconds):
        self.timer = np.where(self.there, self.timer + seconds, 0.0)
        success = self.timer >= 2.0
        count = len(self.there)
        return Verdicts(
            success=success,
            predicates={"in": self.there.copy()},
            progress=np.where(success, 1.0, 0.25 * self.there),
            target=np.zeros(count, dtype=np.int64),
            goal=np.zeros((count, 3)),
        )


@pytest.fixture
def chained():
    """A judge of three steps in two worlds."""
    steps = [Step(2) for _ in range(3)]
    tasks = [SimpleNamespace(judge=lambda states, one=one: one, spec=f"s{k}") for k, one in enumerate(steps)]
    judge = ChainJudge(SimpleNamespace(count=2), tuple(tasks))  # type: ignore[arg-type]
    return judge, steps


def after(judge, seconds=1.0):
    return judge.update(np.full(2, seconds))


def test_steps_are_done_in_turn_each_in_its_own_world(chained):
    judge, steps = chained
    assert (after(judge, 0.0).progress == 0.0).all()
    steps[0].there[0] = True
    after(judge)
    found = after(judge)
    assert found.predicates["step 1: s0"].tolist() == [True, False]
    assert found.progress.tolist() == pytest.approx([1 / 3, 0.0])
    for number in (1, 2):
        steps[number].there[0] = True
        after(judge)
        found = after(judge)
    assert found.success.tolist() == [True, False]
    assert found.progress.tolist() == pytest.approx([1.0, 0.0])


def test_what_is_done_ahead_of_its_turn_does_not_count_until_it_has_lasted_in_its_turn(chained):
    judge, steps = chained
    steps[2].there[:] = True
    steps[1].there[:] = True
    for _ in range(5):
        assert not after(judge).predicates["step 2: s1"].any()
    steps[0].there[:] = True
    after(judge)
    assert after(judge).predicates["step 1: s0"].all()
    assert not after(judge).predicates["step 2: s1"].any()
    assert after(judge).predicates["step 2: s1"].all()


def test_a_chain_has_not_succeeded_while_an_earlier_thing_is_not_where_it_was_put(chained):
    judge, steps = chained
    for one in steps[:2]:
        one.there[:] = True
        after(judge)
        after(judge)
    steps[0].there[0] = False
    found = after(judge)
    assert found.predicates["kept"].tolist() == [False, True]
    assert found.progress[0] < found.progress[1]
    steps[2].there[:] = True
    after(judge)
    assert after(judge).success.tolist() == [False, True]
    steps[0].there[0] = True
    assert after(judge).success.all()


def test_an_episode_that_begins_again_begins_with_the_first_step(chained):
    judge, steps = chained
    steps[0].there[:] = True
    after(judge)
    assert after(judge).predicates["step 1: s0"].all()
    judge.begin(np.array([1]))
    steps[0].there[1] = False
    assert after(judge).predicates["step 1: s0"].tolist() == [True, False]


@pytest.mark.slow
def test_the_scripted_policy_does_a_chain():
    pytest.importorskip("robosuite")
    from pat3d.policies_eval.policies.scripted import ScriptedPolicy
    from pat3d.policies_eval.run.episodes import Episode
    from pat3d.policies_eval.run.rollout import Runner
    from pat3d.policies_eval.run.settings import RolloutSettings

    runner = Runner(RolloutSettings())
    try:
        result = runner.run(Episode(index=0, scene="", task=TWO, seed=1), ScriptedPolicy())
    finally:
        runner.close()
    assert (result.outcome, result.progress) == ("success", 1.0)
