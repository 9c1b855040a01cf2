"""What is set off within a list ends it not; what is asked of the robot names no can."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner

PLANNER = GrammarPlanner()


@pytest.mark.parametrize(
    ("prompt", "there"),
    [
        ("The crate holds four figs, one of which is withered, and a lime.",
         {f"fig {n} in crate" for n in range(1, 5)} | {"lime in crate"}),
        ("A bench with two jugs, one of which is green, and a bell.",
         {"green jug on bench", "jug on bench", "bell on bench"}),
        ("On the shelf are three vases, of which two are pink, and a globe.",
         {"pink vase 1 on shelf", "pink vase 2 on shelf", "vase on shelf", "globe on shelf"}),
        ("Two spoons, one of which is red, and a ladle are in a drawer. A cup is on a mat.",
         {"red spoon in drawer", "spoon in drawer", "ladle in drawer", "drawer in cabinet", "cup on mat"}),
    ],
)  # fmt: skip
def test_what_is_set_off_in_a_list_does_not_end_it(prompt: str, there: set[str]):
    assert {str(relation) for relation in PLANNER.plan(prompt).relations} == there


@pytest.mark.parametrize(
    ("prompt", "objects", "task"),
    [
        ("Could the robot pick up the jug?", {"jug"}, "pick:jug"),
        ("Would the robot put the fig in the crate?", {"fig", "crate"}, "place:fig:crate"),
        ("A jug is on a bench. Can the robot reach it?", {"jug", "bench"}, None),
        ("Can on a bench.", {"can", "bench"}, None),
    ],
)
def test_what_is_asked_of_the_robot_makes_no_can(prompt: str, objects: set[str], task: str | None):
    plan = PLANNER.plan(prompt)
    assert ({obj.name for obj in plan.objects}, plan.task) == (objects, task)
    assert task is not None or "Can on" in prompt or any("no task does that" in note for note in plan.notes)


@pytest.mark.parametrize(
    ("prompt", "hung"),
    [
        ("A bucket under a coat hanging on a hook.", "coat hangs_from hook"),
        ("A box under a lamp hanging from a beam.", "lamp hangs_from beam"),
        ("Two boots lie under a towel hanging on a rail.", "towel hangs_from rail"),
    ],
)
def test_what_is_under_something_that_hangs_does_not_hang(prompt: str, hung: str):
    plan = PLANNER.plan(prompt)
    assert [str(relation) for relation in plan.relations if relation.kind == "hangs_from"] == [hung]
    assert any("under" in note for note in plan.notes) or plan.arrangements
