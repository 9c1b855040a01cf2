"""Whether a task is told to put something in what holds it, or on it; and what the sentence said otherwise."""

from __future__ import annotations

import pytest

from pat3d.assets import catalogue
from pat3d.plan.grammar.planner import GrammarPlanner
from pat3d.plan.telling import FLAT, holds, tell


@pytest.mark.parametrize(
    ("prompt", "told"),
    [
        ("Put the pear on top of the fridge.", "on the fridge"),
        ("Put the pear on the microwave.", "on the microwave"),
        ("Put the pear in the jar.", "in the jar"),
        ("Put the pear on the tray.", "on the tray"),
        ("Put the pear in the pan.", "in the pan"),
        ("Put the pear onto the pan.", "on the pan"),
        ("Put the pear in the box.", "in the box"),
        ("Put the pear on the box.", "on the box"),
    ],
)
def test_a_task_is_told_as_it_is_done(prompt: str, told: str):
    plan = GrammarPlanner().plan(prompt)
    assert f"put the pear {told} (" in tell(plan)
    assert plan.notes == ()


@pytest.mark.parametrize("closed", ["washing machine", "backpack", "toaster"])
def test_nothing_is_put_in_what_is_closed(closed: str):
    plan = GrammarPlanner().plan(f"Put the pear into the {closed}.")
    assert f"put the pear on the {closed} (" in tell(plan)
    assert f'not arranged: "the pear" inside "the {closed}"; the task puts it on it' in plan.notes


@pytest.mark.parametrize(
    ("said", "noun"),
    [("refrigerator", "open fridge"), ("icebox", "open fridge"), ("cupboard", "open cabinet"), ("oven", "open oven"),
     ("microwave", "open microwave"), ("wardrobe", "open wardrobe"), ("dishwasher", "open dishwasher")],
)  # fmt: skip
def test_what_opens_in_front_is_open_for_what_goes_into_it(said: str, noun: str):
    plan = GrammarPlanner().plan(f"Put the pear into the {said}.")
    assert f"put the pear in the {said} (" in tell(plan)
    assert {obj.name: obj.noun for obj in plan.objects} == {"pear": "pear", said: noun}
    assert plan.notes == (f'"the {said}" is made open, as what is in it is reached so.',)


@pytest.mark.parametrize(
    ("sentence", "told"),
    [
        ("A sock is in the wardrobe.", {("sock", "in", "wardrobe")}),
        ("The fridge contains a melon and has a cake on top of it.",
         {("melon", "in", "fridge"), ("cake", "on", "fridge")}),
        ("A cabinet with a lamp on it and two cups in it.",
         {("lamp", "on", "cabinet"), ("cup 1", "in", "cabinet"), ("cup 2", "in", "cabinet")}),
        ("A pot on the stove and a pie in the oven.", {("pot", "on", "stove"), ("pie", "in", "oven")}),
        ("Take the pie from the oven.", {("pie", "in", "oven")}),
        ("A cabinet with a microwave.", {("microwave", "on", "cabinet")}),
    ],
)  # fmt: skip
def test_what_is_in_what_opens_in_front_is_inside_and_what_is_on_it_is_not(sentence: str, told: set):
    plan = GrammarPlanner().plan(sentence)
    assert {(rel.child, rel.kind, rel.parent) for rel in plan.relations} == told
    inside = {parent for _, kind, parent in told if kind == "in"}
    assert {obj.name for obj in plan.objects if obj.noun.startswith("open ")} == inside


def test_a_pan_is_returned_to_the_stove_and_not_into_its_oven():
    plan = GrammarPlanner().plan("Return the pan to the stove.")
    assert [obj.noun for obj in plan.objects] == ["pan", "stove"]


def test_the_refrigerator_is_the_fridge_and_water_that_is_poured_is_its_bottle():
    plan = GrammarPlanner().plan("Take the jar from the refrigerator, put it on the table and close the fridge.")
    assert [obj.noun for obj in plan.objects if "fridge" in obj.noun] == ["hinged fridge", "open hinged fridge door"]
    assert [obj.noun for obj in GrammarPlanner().plan("Pour the water from the bottle into the mug.").objects] == [
        "bottle", "mug",
    ]  # fmt: skip


def test_what_is_to_go_on_a_vessel_goes_into_it():
    plan = GrammarPlanner().plan("Place the lemon on the jar.")
    assert "put the lemon in the jar (" in tell(plan)
    assert plan.notes == ('not arranged: "the lemon" on "the jar"; the task puts it in it',)


def test_a_box_that_is_to_hold_something_is_open():
    (box,) = (obj for obj in GrammarPlanner().plan("Put the lemon in the box.").objects if obj.name == "box")
    assert box.noun == "storage box"


@pytest.mark.parametrize("noun", ["fridge", "jam jar", "box", "storage box", "lunch box", "mug", "sugar bowl", "crate"])
def test_what_holds_things_has_room_inside(noun: str):
    assert holds(noun) is (catalogue.make(noun, seed=0).region("in") is not None)


@pytest.mark.slow
def test_every_noun_of_the_catalogue_holds_things_where_it_has_room_inside():
    nouns = [entry.noun for entry in catalogue.entries() if entry.noun not in FLAT]
    wrong = [noun for noun in nouns if holds(noun) is not (catalogue.make(noun, seed=0).region("in") is not None)]
    assert wrong == []
