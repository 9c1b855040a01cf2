"""The scene's own task is what an environment is about, unless a person says another."""

from dataclasses import replace

import pytest

pytest.importorskip("gymnasium")

from pat3d.envs import env as module
from pat3d.errors import TaskError
from pat3d.generation.request import request_of
from pat3d.plan.grammar.planner import GrammarPlanner


@pytest.fixture(autouse=True)
def placed(monkeypatch):
    """The robot stands anywhere: what is tested is which task is chosen."""
    monkeypatch.setattr(module, "placed", lambda scene, checksum, robot, needs: None)


def test_a_scene_s_own_task_is_chosen_where_none_is_given(breakfast):
    told = replace(breakfast, task="place:green apple:blue bowl")
    assert module.choose(told, None, "panda")[0].spec == "place:green apple:blue bowl"


def test_a_person_s_task_wins(breakfast):
    told = replace(breakfast, task="place:green apple:blue bowl")
    assert module.choose(told, "pick:banana", "panda")[0].spec == "pick:banana"


def test_a_scene_without_a_task_has_its_first_object_picked(breakfast):
    assert module.choose(breakfast, None, "panda")[0].spec.startswith("pick:")


def test_a_scene_s_own_task_that_cannot_be_done_says_why(breakfast):
    with pytest.raises(TaskError):
        module.choose(replace(breakfast, task="unload:banana"), None, "panda")


def test_an_instruction_s_task_is_asked_of_the_scene():
    plan = GrammarPlanner().plan("put the green apple in the bowl")
    assert request_of(plan, allow_proxies=False).task == plan.task == "place:green apple:bowl"
