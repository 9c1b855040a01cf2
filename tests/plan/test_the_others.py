"""What "the others", "the other" and "each" speak of, and how many of it there are."""

from __future__ import annotations

from collections import Counter

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def nouns(plan: ScenePlan) -> Counter[str]:
    return Counter(obj.noun for obj in plan.objects)


def held(plan: ScenePlan) -> set[tuple[str, str]]:
    return {(each.child, each.parent) for each in plan.relations if each.supports}


def loads(plan: ScenePlan, noun: str) -> list[int]:
    """How many objects each object of `noun` carries."""
    names = [obj.name for obj in plan.objects if obj.name.rstrip(" 0123456789") == noun]
    return [sum(parent == name for _, parent in held(plan)) for name in names]


@pytest.mark.parametrize("rest", ["the others", "the rest", "the remaining ones"])
@pytest.mark.parametrize("told", ["the yellow lemons", "the lemons that are yellow", "two lemons", "the large lemons"])
def test_the_others_are_no_task_of_the_same_ones(told, rest):
    plan = read(f"Put {told} in the basket and {rest} in the crate.")
    tasks = " ".join((str(plan.task), *plan.notes))
    lemons = [obj.name for obj in plan.objects if obj.noun == "lemon"]
    assert all(not (f"place:{name}:basket" in tasks and f"place:{name}:crate" in tasks) for name in lemons)
    assert sum(f"place:{name}:crate" in tasks for name in lemons) == 3
    assert any(rest.removeprefix("the ") in note and "3 assumed" in note for note in plan.notes)


def test_the_other_of_two_is_the_one_that_is_left():
    plan = read(
        "A red lemon and a green lemon are on a bench. Put the red lemon in the basket and the other in the crate."
    )
    assert nouns(plan)["lemon"] == 2
    assert plan.task == chain("place:red lemon:basket", "place:green lemon:crate")


def test_the_others_of_those_of_which_one_is_told_leave_that_one_out():
    plan = read("One of the lemons is behind a jug, the others are behind a kettle.")
    behind = {(each.child, each.parent) for each in plan.relations if each.kind == "behind"}
    assert behind == {("lemon 1", "jug"), ("lemon 2", "kettle"), ("lemon 3", "kettle")}


def test_one_of_them_and_the_other_are_two():
    plan = read("Put one of the lemons in the basket and the other in the crate.")
    assert nouns(plan)["lemon"] == 2


@pytest.mark.parametrize("other", ["on the other", "on the other one"])
def test_on_the_other_is_on_a_thing_where_one_of_them_was_said(other):
    plan = read(f"There are two benches. A jug is on one of them and a kettle {other}.")
    assert held(plan) == {("jug", "bench 1"), ("kettle", "bench 2")}


def test_on_the_other_side_is_a_side():
    plan = read("A lamp on one side of the bed and a clock on the other.")
    assert {str(each) for each in plan.relations} == {"lamp left_of bed", "clock right_of bed"}


@pytest.mark.parametrize(
    ("prompt", "noun", "each"),
    [
        ("Three saucers on a bench with two nuts on each.", "saucer", [2, 2, 2]),
        ("Two crates with three lemons in each of them.", "crate", [3, 3]),
        ("Three jugs on a bench hold two spoons each.", "jug", [2, 2, 2]),
        ("Two mugs each with a spoon.", "mug", [1, 1]),
        ("There are two saucers on a bench and two green nuts on each.", "saucer", [2, 2]),
        ("A bench with three saucers on it. On each of them lies a nut.", "saucer", [1, 1, 1]),
    ],
)
def test_each_has_as_many(prompt, noun, each):
    assert loads(read(prompt), noun) == each


@pytest.mark.parametrize(
    ("prompt", "noun", "each"),
    [
        ("Two saucers with a bun.", "saucer", [1, 1]),
        ("Three mugs with a lid.", "mug", [1, 1, 1]),
        ("Two crates with a lemon and a lime.", "crate", [2, 2]),
    ],
)
def test_one_with_several_vessels_is_one_for_each_and_said_so(prompt, noun, each):
    plan = read(prompt)
    assert loads(plan, noun) == each
    assert any("one for each is assumed" in note for note in plan.notes)


def test_what_is_with_several_and_elsewhere_is_one_thing():
    for prompt in (
        "Two saucers with a bun between them.",
        "Two saucers with a bun on the left one.",
        "Two chairs with a table.",
    ):
        plan = read(prompt)
        assert sorted(nouns(plan).values()) == [1, 2]
        assert not any("one for each" in note for note in plan.notes)
