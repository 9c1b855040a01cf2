"""Two things told of as "one box" and "the other", and likes of which a clause leaves out the verb."""

from __future__ import annotations

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan
from tests.plan.vocabulary import chain


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def nouns(plan: ScenePlan, noun: str) -> list[str]:
    return [obj.name for obj in plan.objects if obj.noun == noun]


@pytest.mark.parametrize("verb", ["Sort", "Put", "Separate"])
def test_one_and_the_other_are_two(verb: str):
    plan = read(f"{verb} the nuts into one jar and the bolts into the other.")
    assert nouns(plan, "jar") == ["jar 1", "jar 2"]


def test_one_and_the_other_are_those_named_before():
    plan = read("There are two jars on the shelf. A spoon is in one jar and a fork in the other.")
    assert nouns(plan, "jar") == ["jar 1", "jar 2"]
    assert {(rel.child, rel.parent) for rel in plan.relations if rel.kind == "in"} == {
        ("spoon", "jar 1"), ("fork", "jar 2")
    }  # fmt: skip
    assert plan.notes == ()


def test_the_other_of_two_trays_is_no_side():
    plan = read("Put the lemon on one tray and the lime on the other.")
    assert nouns(plan, "tray") == ["tray 1", "tray 2"]
    assert plan.relations == ()
    assert plan.task == chain("place:lemon:tray 1", "place:lime:tray 2")


def test_a_like_stands_where_its_own_clause_has_it():
    plan = read("The white mugs are on the shelf and the black mugs on the desk.")
    on = {(rel.child.rpartition(" ")[0], rel.parent) for rel in plan.relations if rel.kind == "on"}
    assert on == {("white mug", "shelf"), ("black mug", "desk")}


def test_what_is_not_described_so_is_the_rest_of_the_kind():
    plan = read("Put the two green cubes in the bowl and the rest in the crate.")
    assert [obj.colours for obj in plan.objects if obj.noun == "cube"] == [("green",), ("green",), (), (), ()]
