"""The first two, the last three, another two: which of several they are."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan

PLANNER = GrammarPlanner()


def carried(plan: ScenePlan, *carriers: str) -> list[int]:
    """How many things each of `carriers` carries."""
    return [sum(rel.parent == name and rel.supports for rel in plan.relations) for name in carriers]


def doubts(plan: ScenePlan) -> list[str]:
    return [note for note in plan.notes if "assumed." not in note and "with what it carries" not in note]


@pytest.mark.parametrize(
    ("prompt", "shares"),
    [
        ("Four jars on a bench. The first two hold figs.", [3, 3, 0, 0]),
        ("Four jars on a bench: the first three contain cookies, the last is empty.", [3, 3, 3, 0]),
        ("Four jars stand on a bench. The first three jars contain cookies.", [3, 3, 3, 0]),
        ("Four jars on a bench, the last two hold keys", [0, 0, 3, 3]),
        ("Four jars on a bench. The last two jars hold a key each.", [0, 0, 1, 1]),
        ("Four jars on a bench. The first two hold figs, the last two keys.", [3, 3, 3, 3]),
        ("Four jars on a bench: the first holds a fig, another two hold keys, the last is empty.", [1, 3, 3, 0]),
        ("Four jars on a bench. One holds a fig, another two hold a key and the last is empty.", [1, 1, 1, 0]),
        ("Four jars on a bench: one holds a fig, two others hold a key", [1, 1, 1, 0]),
        ("Four jars on a bench: one holds a fig, the other two hold a key", [1, 1, 1, 0]),
        ("There are four jars. Keys are in the last two jars.", [0, 0, 2, 2]),
    ],
)
def test_some_of_four_hold_something(prompt: str, shares: list[int]):
    plan = PLANNER.plan(prompt)
    assert carried(plan, "jar 1", "jar 2", "jar 3", "jar 4") == shares
    assert not [note for note in doubts(plan) if "keys" not in note]


@pytest.mark.parametrize(
    ("prompt", "colours"),
    [
        ("There are four jars. The first two are red.", ["red", "red", "", ""]),
        ("There are four jars. The last two are red.", ["", "", "red", "red"]),
        ("Four jars stand on a bench; the first three are red and the last is blue.", ["red", "red", "red", "blue"]),
    ],
)
def test_some_of_four_are_described(prompt: str, colours: list[str]):
    plan = PLANNER.plan(prompt)
    assert ["".join(obj.colours) for obj in plan.objects if obj.noun == "jar"] == colours
    assert not doubts(plan)


@pytest.mark.parametrize(
    ("prompt", "relations"),
    [
        ("Three pencils: one is in a jar, another two in a cup.",
         {"pencil 1 in jar", "pencil 2 in cup", "pencil 3 in cup"}),
        ("Four pencils: one is in a jar, another two are in a cup and the last lies on a book.",
         {"pencil 1 in jar", "pencil 2 in cup", "pencil 3 in cup", "pencil 4 on book"}),
        ("Five pencils: two are in a jar, another two in a cup, the last on a book.",
         {"pencil 1 in jar", "pencil 2 in jar", "pencil 3 in cup", "pencil 4 in cup", "pencil 5 on book"}),
        ("A pencil in a jar and another two in a cup", {"pencil 1 in jar", "pencil 2 in cup", "pencil 3 in cup"}),
    ],
)  # fmt: skip
def test_another_two_are_of_those_that_were_counted(prompt: str, relations: set[str]):
    plan = PLANNER.plan(prompt)
    assert set(map(str, plan.relations)) == relations
    assert not doubts(plan)


def test_the_first_two_of_two_and_two_are_not_the_last_named():
    plan = PLANNER.plan("Two red jars and two blue jars. The first two are upside down.")
    assert {posture.object for posture in plan.postures} != {"blue jar 1", "blue jar 2"}
