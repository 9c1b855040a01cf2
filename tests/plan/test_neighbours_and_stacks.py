"""What is between each two neighbours, stacks told by their height, gapped clauses, and drinks in vessels."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def names(plan: ScenePlan) -> list[str]:
    return [obj.name for obj in plan.objects]


def relations(plan: ScenePlan) -> set[tuple[str, str, str]]:
    return {(rel.child, rel.kind, rel.parent) for rel in plan.relations}


@pytest.mark.parametrize(
    ("prompt", "noun", "number", "high"),
    [
        ("On a pallet, boxes are stacked three high, in two stacks.", "box", 6, 3),
        ("On a desk, books are stacked four high, in two piles.", "book", 8, 4),
        ("Boxes stacked three high, in two stacks, on a pallet.", "box", 6, 3),
        ("Crates stacked two high in three stacks", "crate", 6, 2),
        ("Six boxes are stacked three high, in two stacks.", "box", 6, 3),
        ("Eight cans stacked two high.", "can", 8, 2),
    ],
)
def test_stacks_are_as_high_and_as_many_as_said(prompt: str, noun: str, number: int, high: int):
    plan = read(prompt)
    boxes = [obj.name for obj in plan.objects if obj.noun == noun]
    assert len(boxes) == number
    upon = [rel for rel in plan.relations if rel.kind == "on" and rel.child in boxes and rel.parent in boxes]
    assert len(upon) == number - number // high
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("The mug is behind the kettle and the spoon left of both.",
         {("mug", "behind", "kettle"), ("spoon", "left_of", "mug"), ("spoon", "left_of", "kettle")}),
        ("The chair is behind the table and the lamp to the right of the table.",
         {("chair", "behind", "table"), ("lamp", "right_of", "table")}),
        ("The monitor stands behind the keyboard and the mug to the left of the keyboard.",
         {("monitor", "behind", "keyboard"), ("mug", "left_of", "keyboard")}),
        ("The bin is left of the desk and the chair in front of the desk.",
         {("bin", "left_of", "desk"), ("chair", "in_front_of", "desk")}),
        ("The spoon lies in front of the bowl and the fork.",
         {("spoon", "in_front_of", "bowl"), ("spoon", "in_front_of", "fork")}),
    ],
)  # fmt: skip
def test_what_has_a_place_of_its_own_is_no_second_landmark(prompt: str, expected: set[tuple[str, str, str]]):
    plan = read(prompt)
    assert relations(plan) == expected
    assert plan.notes == ()


@pytest.mark.parametrize(
    ("prompt", "expected"),
    [
        ("A glass with beer and a plate with fries.", ["glass", "plate", "fries"]),
        ("A bowl with milk in front of a cat.", ["bowl", "cat"]),
        ("A wine glass with some beer on a coaster.", ["wine glass", "coaster"]),
        ("A cup with milk in it on a saucer.", ["cup", "saucer"]),
    ],
)
def test_a_vessel_with_a_drink_holds_no_bottle(prompt: str, expected: list[str]):
    plan = read(prompt)
    assert sorted(names(plan)) == sorted(expected)
    assert any("is no rigid body" in note for note in plan.notes)


def test_a_bottle_that_is_named_is_there():
    assert names(read("A glass with a juice bottle in it.")) == ["glass", "juice bottle"]
    assert any("comes in" in note for note in read("A cup containing milk on a saucer.").notes)
