"""What stands beside several things, and which of several things stand elsewhere than the others."""

from __future__ import annotations

from collections import Counter

import pytest

from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.scene_plan import ScenePlan


def read(prompt: str) -> ScenePlan:
    return GrammarPlanner().plan(prompt)


def related(plan: ScenePlan, kind: str) -> list[tuple[str, str]]:
    return [(each.child, each.parent) for each in plan.relations if each.kind == kind]


def carried(plan: ScenePlan) -> Counter[str]:
    """How many objects each object carries directly."""
    return Counter(each.parent for each in plan.relations if each.supports)


@pytest.mark.parametrize(
    ("prompt", "kind"),
    [
        ("A kettle is to the left of two jars.", "left_of"),
        ("Two jars are on a bench. A kettle is to the right of the jars.", "right_of"),
        ("A kettle stands behind both jars. There are two jars.", "behind"),
        ("A red jar and a blue jar. A kettle is in front of both jars.", "in_front_of"),
        ("Two jars are on a bench and a kettle is next to both.", "next_to"),
    ],
)
def test_one_beside_several_is_one_thing_beside_each(prompt, kind):
    plan = read(prompt)
    assert sum(obj.noun == "kettle" for obj in plan.objects) == 1
    assert len(related(plan, kind)) == 2
    assert {child for child, _ in related(plan, kind)} == {"kettle"}
    assert not any("counted" in note for note in plan.notes)


def test_several_before_several_are_all_of_them_before_all():
    plan = read("Two kettles are in front of three jars.")
    assert len(related(plan, "in_front_of")) == 6


@pytest.mark.parametrize(
    "prompt", ["Each of the two kettles is behind a jar.", "There are two jars. A kettle is behind each jar."]
)
def test_each_is_before_its_own(prompt):
    assert sorted(related(read(prompt), "behind")) == [("kettle 1", "jar 1"), ("kettle 2", "jar 2")]


def test_what_both_have_beside_them_is_one_for_each():
    assert sorted(related(read("Both jars have a kettle beside them."), "next_to")) == [
        ("kettle 1", "jar 1"), ("kettle 2", "jar 2"),
    ]  # fmt: skip


def test_next_to_more_than_can_be_is_noted():
    plan = read("A kettle is next to five jars.")
    assert len(related(plan, "next_to")) == 1
    assert any('"five jars", all of them' in note for note in plan.notes)


def test_one_plate_is_under_each_of_two():
    plan = read("A plate under each jar. There are two jars.")
    assert sorted(related(plan, "on")) == [("jar 1", "plate 1"), ("jar 2", "plate 2")]


@pytest.mark.parametrize(
    ("prompt", "total", "inside"),
    [
        ("Nine lemons, two of which are outside the basket.", 9, 7),
        ("Nine lemons are in a basket, two of them beside it.", 9, 7),
        ("A basket of nine lemons, three of which are outside it.", 9, 6),
        ("There are four lemons in a basket. One of them is on a saucer.", 4, 3),
        ("Nine lemons in a basket, four of them on the floor.", 9, 5),
    ],
)
def test_some_are_elsewhere_than_the_others(prompt, total, inside):
    plan = read(prompt)
    assert sum(obj.noun == "lemon" for obj in plan.objects) == total
    assert carried(plan)["basket"] == inside
    assert not any("counted" in note or "not as said" in note for note in plan.notes)


def test_that_the_others_are_inside_is_assumed():
    assert any("7 of 9 assumed in" in note for note in read("Nine lemons, two of which are outside the basket.").notes)
    told = read("Nine lemons, two of which are outside the basket. The others are on a shelf.")
    assert not any("assumed in" in note for note in told.notes)


def test_what_some_are_on_stands_on_the_furniture_with_the_others():
    plan = read("Six jars are on a bench, two of them on a tray.")
    assert carried(plan) == {"bench": 5, "tray": 2}


@pytest.mark.parametrize(
    "prompt", ["Five lemons are in a basket and two are on a saucer.", "Five lemons in a basket and two beside it."]
)
def test_a_number_behind_and_is_of_further_ones(prompt):
    plan = read(prompt)
    assert sum(obj.noun == "lemon" for obj in plan.objects) == 7
    assert any("further ones, 7 in all" in note for note in plan.notes)


def test_shares_of_a_number_are_no_further_ones():
    plan = read("Seven lemons: five in a basket and two on a saucer.")
    assert sum(obj.noun == "lemon" for obj in plan.objects) == 7


@pytest.mark.parametrize(
    ("prompt", "left", "right"),
    [
        ("Two stools on each side of a bench", 2, 2),
        ("There are three stools on each side of the bench.", 3, 3),
        ("A kettle with two jars on each side", 2, 2),
        ("On each side of the kettle are two jars.", 2, 2),
        ("Two jars, one on each side of a kettle", 1, 1),
        ("Two jars on either side of a kettle", 1, 1),
        ("A bench with four stools, two on each side", 2, 2),
        ("Two jars. They are on each side of a kettle.", 1, 1),
    ],
)
def test_each_side_has_as_many(prompt: str, left: int, right: int):
    plan = read(prompt)
    assert (len(related(plan, "left_of")), len(related(plan, "right_of"))) == (left, right)
    assert len([obj for obj in plan.objects if obj.noun in ("stool", "jar")]) == left + right


def test_two_on_each_side_are_noted_to_be_four():
    assert '"Two stools": as many on each side, 4 in all.' in read("Two stools on each side of a bench").notes


@pytest.mark.parametrize(
    ("prompt", "one", "beside"),
    [
        ("a spoon on a tray next to bread, cheese and a pear", "tray", ["bread", "cheese", "pear"]),
        ("A can is on a plate next to a jug, a pot and a vase.", "plate", ["jug", "pot", "vase"]),
        ("A jar next to a book, a fork and a clock", "jar", ["book", "fork", "clock"]),
        ("a rabbit beside a basket, a ball, and a bucket", "rabbit", ["basket", "ball", "bucket"]),
        ("Two eggs on a plate beside a jug, a cup and a spoon", "plate", ["jug", "cup", "spoon"]),
    ],
)
def test_a_list_that_ends_the_sentence_is_of_neighbours(prompt, one, beside):
    plan = GrammarPlanner().plan(prompt)
    edges = [(rel.child, rel.parent) for rel in plan.relations if rel.kind == "next_to"]
    assert edges == [(one, other) for other in beside]
    assert not any("is not read as said" in note or "where is not said" in note for note in plan.notes)


def test_a_list_that_goes_on_behind_a_neighbour_is_of_more():
    plan = GrammarPlanner().plan("a jar, a cup next to a jug, a pot and a pan")
    assert [(rel.child, rel.parent) for rel in plan.relations] == [("cup", "jug")]
    assert sum("is not read as said of it" in note or "where is not said" in note for note in plan.notes) == 3


def test_of_more_neighbours_than_find_room_one_of_each_is_beside():
    plan = GrammarPlanner().plan("A cup on a desk next to a radio, books and pens")
    assert {str(rel) for rel in plan.relations if rel.kind == "next_to"} == {
        "cup next_to radio", "cup next_to book 1", "cup next_to pen 1"}  # fmt: skip
    assert sum(rel.kind == "on" and rel.parent == "desk" for rel in plan.relations) == 8
    assert any("all of them; each is next to one of them" in note for note in plan.notes)
